"""Results that were damaged or edited are refused in one line, and never end in another error."""

import random
import re
from pathlib import Path

import pytest
import xarray as xr

from ehlectric import Case, InputError, load, save, solve, solve_drive
from ehlectric.bearing import run as of_bearings
from ehlectric.contact import run as of_contacts
from ehlectric.drive import run as of_drives
from ehlectric.errors import DamagedError
from ehlectric.figures.result_figures import draw_figures
from ehlectric.motion.result import MotionResult
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored import solved_part
from ehlectric.runtime.file_rules import refusing
from ehlectric.runtime.hdf5_guard import sealed
from ehlectric.runtime.netcdf import read_dataset
from tests.helpers.damage import with_damaged_bytes, with_edited_values
from tests.helpers.drives import drive_with_remedy
from tests.helpers.moving_cases import moving
from tests.helpers.share import share

CONTACT = {
    "reduced_radius": "14.1 mm",
    "reduced_modulus": "226 GPa",
    "max_hertz_pressure": "1 GPa",
    "entrainment_speed": "4 m/s",
}
BEARING = {
    "contacts": "formula",
    "bearing": {
        "base": "6208",
        "radial_load": "1 kN",
        "inner_speed": "3000 rpm",
        "temperature": "70 degC",
        "radial_clearance": "10 um",
        "composite_rq": "0.03 um",
    },
    "lubricant": {"base": "paper", "viscosity": "20 mPa s"},
}
NAMES = {"contact": "result.nc", "motion": "motion.nc", "bearing": "bearing.nc", "drive": "drive.nc"}
READERS = {"contact": of_contacts, "bearing": of_bearings, "drive": of_drives}


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """File of a small result of each kind."""
    folder = tmp_path_factory.mktemp("stored")
    table = {"contact": CONTACT, "lubricant": {"base": "paper"}, "grid": {"nodes": 65}}
    save(solve(Case.from_dict(table)), folder / "contact")
    save(solve(BEARING), folder / "bearing")
    save(solve_drive(drive_with_remedy(**{"drive.duration": 1e-3}), workers=1), folder / "drive")
    run_motion(moving(motion={"passes": 0.375, "steps": 12, "record": 4}), folder / "motion")
    return {kind: folder / kind / name for kind, name in NAMES.items()}


def result_of(kind, dataset):
    """Result of a dataset as it is read from a file, and what its figures are drawn from."""
    path = Path("stored.nc")
    if kind == "motion":
        with refusing(path):
            part = solved_part(dataset)
        return MotionResult.of(part), part
    result = READERS[kind].result_of(dataset, path)
    return result, result


def raw(path):
    with xr.open_dataset(path, engine="h5netcdf") as file:
        return file.load()


@pytest.mark.slow
@pytest.mark.parametrize("kind", NAMES)
def test_a_changed_byte_is_noticed(kind, stored, tmp_path):
    """Each file has a seal, so that damage is noticed also where all numbers remain plausible."""
    assert sealed(stored[kind])
    content, path = stored[kind].read_bytes(), tmp_path / NAMES[kind]
    whole, draw = load(stored[kind]), random.Random(1)
    for _ in range(40):
        at = draw.randrange(len(content) - 40)
        path.write_bytes(content[:at] + bytes([content[at] ^ 1 << draw.randrange(8)]) + content[at + 1 :])
        with pytest.raises(InputError, match=r"is (damaged: its bytes are not those|not a NetCDF file)"):
            load(path)
    path.write_bytes(content)
    assert load(path) == whole


def edit_and_use(kind, dataset, seeds, folder=None):
    """Edit a dataset, use it, and return how many edits are refused and how many are used."""
    counts, told = {"refused": 0, "used": 0}, []
    for seed in seeds:
        edited, what = with_edited_values(dataset, seed)
        try:
            result, drawn = result_of(kind, edited)
            assert result.summary(), what
            if folder is not None:
                draw_figures(drawn, folder)
            counts["used"] += 1
        except InputError as error:
            told.append(str(error))
            counts["refused"] += 1
    assert not [text for text in told if "\n" in text or not text.startswith("stored.nc: is ")]
    return counts


@pytest.mark.slow
@pytest.mark.parametrize("kind", NAMES)
def test_edited_values_are_refused_or_used(kind, stored):
    counts = edit_and_use(kind, raw(stored[kind]), range(60))
    assert min(counts.values()) > 5


@pytest.mark.slow
@pytest.mark.parametrize("kind", NAMES)
def test_edited_values_are_refused_or_drawn(kind, stored, tmp_path):
    counts = edit_and_use(kind, raw(stored[kind]), share(range(1000, 1400), 4))
    assert min(counts.values()) > 12
    edit_and_use(kind, raw(stored[kind]), share(range(2000, 2030), 6), tmp_path)


def read_damaged(kind, stored, path, seeds, capfd):
    """Read files without a seal whose bytes are damaged, and count those that are refused."""
    with stored[kind].open("rb") as file:
        content = file.read()[:-25]  # without its seal
    told = []
    for seed in seeds:
        path.write_bytes(with_damaged_bytes(content, seed))
        try:
            load(path).summary()
        except InputError as error:
            told.append(str(error))
    assert capfd.readouterr() == ("", "")
    assert not [text for text in told if "\n" in text]
    return len(told)


@pytest.mark.slow
def test_damaged_files_without_a_seal(stored, tmp_path, capfd):
    read_damaged("contact", stored, tmp_path / "result.nc", range(4), capfd)


@pytest.mark.slow
@pytest.mark.parametrize("kind", NAMES)
def test_many_damaged_files_without_a_seal(kind, stored, tmp_path, capfd):
    assert read_damaged(kind, stored, tmp_path / NAMES[kind], share(range(100, 150), 3), capfd) > 3


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("strength", 0.0, "strength "),
        ("strength", 2.0e6, "strength "),
        ("thin_gap_strength", 3.0, "thin_gap_strength "),
        ("thickness", 0.0, "thickness "),
        ("permittivity", -1.0, "permittivity "),
        ("x", 1.0, "x "),
        ("y", 0.0, "y "),
        ("cavitated", 3, "cavitated .* 0 or 1"),
    ],
)
def test_what_is_wrong_is_named(name, value, says, stored, tmp_path):
    dataset = raw(stored["contact"])
    values = dataset[name].values.copy()
    values[...] = value
    dataset = dataset.assign({name: (dataset[name].dims, values, dataset[name].attrs)})
    dataset.to_netcdf(tmp_path / "result.nc", engine="h5netcdf")
    with pytest.raises(DamagedError) as caught:
        load(tmp_path)
    path, _, told = str(caught.value).partition(": is damaged: ")
    assert path == str(tmp_path / "result.nc")
    assert re.match(says, told)


@pytest.mark.slow
def test_results_that_another_program_has_written_have_no_seal(stored, tmp_path):
    dataset = read_dataset(stored["contact"])
    dataset.to_netcdf(tmp_path / "result.nc", engine="h5netcdf")
    assert not sealed(tmp_path / "result.nc")
    assert load(tmp_path).film.x.size == 65
