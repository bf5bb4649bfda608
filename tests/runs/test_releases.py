"""Files of every release are read by this version, and have the numbers that the release gave."""

import json
import shutil

import h5netcdf
import pandas
import pytest

from ehlectric import Sweep, load
from ehlectric.errors import InputError
from ehlectric.runs.file_kinds import read_input
from ehlectric.runs.solve import case_of
from ehlectric.sweep.store import read_sweep
from ehlectric.version import __version__
from tests.helpers.damage import seal
from tests.helpers.each import each
from tests.helpers.places import ROOT

RELEASES = ROOT / "tests" / "data" / "releases"
RESULTS = sorted(path.parent for path in RELEASES.glob("*/*/*.nc"))
CASES = sorted(RELEASES.glob("*/cases/*.toml"))
SWEEPS = sorted(path.parent for path in RELEASES.glob("*/*/sweep.sqlite"))

# What a summary says in words may be worded anew, and what a computation took is not that of reading.
_WORDS = {"schema", "version", "warnings", "warning_codes", "warning_severities", "verdict", "margin"}


def name_of(folder):
    return f"{folder.parent.name}-{folder.name}"


def numbers(value, path=()):
    """Numbers and their keys in nested tables and lists."""
    if isinstance(value, dict):
        for key, item in value.items():
            if path or key not in _WORDS:
                yield from numbers(item, (*path, key))
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from numbers(item, (*path, index))
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path, value


@each("file", CASES, ids=lambda path: f"{path.parents[1].name}-{path.name}")
def test_a_case_file_is_taken(file):
    """Files of the examples as the release had them; their surfaces are not read here."""
    if read_input(file).kind == "sweep":
        Sweep.from_toml(file)
    else:
        case_of(file)


def test_this_release_has_files():
    """python tests/data/releases/kept.py makes them."""
    kinds = {path.name for path in RELEASES.glob(f"{__version__}/*/*.*") if path.suffix in {".nc", ".sqlite"}}
    assert kinds == {"result.nc", "bearing.nc", "drive.nc", "motion.nc", "sweep.sqlite"}


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("folder", RESULTS, ids=name_of)
def test_a_stored_result_has_its_numbers(folder):
    """Numbers of the summary follow from the stored arrays and the case: those of a later version too."""
    stored = dict(numbers(json.loads((folder / "summary.json").read_text(encoding="utf-8"))))
    found = dict(numbers(json.loads(json.dumps(load(folder).summary()))))
    assert len(stored) > 80
    assert stored.keys() <= found.keys()
    # Oil that a film loses is a sum of residuals: in a converged film it is the rounding of the processor.
    lost = stored.pop(("asperities", "oil_lost"), 0.0), found.pop(("asperities", "oil_lost"), 0.0)
    assert lost[1] == pytest.approx(lost[0], rel=1e-6, abs=1e-12)
    assert {path: found[path] for path in stored} == pytest.approx(stored, rel=1e-6, abs=0.0)


@pytest.mark.parametrize("folder", SWEEPS, ids=name_of)
def test_a_stored_sweep_has_its_numbers(folder):
    stored = pandas.read_csv(folder / "sweep.csv").select_dtypes("number").dropna(axis=1, how="all")
    found = read_sweep(folder).to_dataframe()
    assert len(stored) == len(found) > 5
    assert len(stored.columns) > 30
    for head, values in stored.items():
        name = head.partition(" [")[0]
        if not name.startswith("seconds."):
            assert list(found[name]) == pytest.approx(list(values), rel=1e-5, abs=0.0, nan_ok=True), name


def test_a_file_without_a_format_is_refused(tmp_path):
    shutil.copytree(RELEASES / "1.0.0" / "line", tmp_path / "out")
    with h5netcdf.File(tmp_path / "out" / "result.nc", "a") as file:
        del file.attrs["schema"]
    seal(tmp_path / "out" / "result.nc")
    with pytest.raises(InputError, match=r"result\.nc: is not a result of ehlectric$"):
        load(tmp_path / "out")


def test_a_renamed_run_with_moving_roughness_is_read(tmp_path):
    folder = RELEASES / "1.0.0" / "motion"
    shutil.copy(folder / "motion.nc", tmp_path / "run7.nc")
    assert load(tmp_path / "run7.nc") == load(folder)


@pytest.mark.slow
@pytest.mark.parametrize("folder", [path for path in RESULTS if path.parent.name == __version__], ids=name_of)
def test_a_later_format_is_told(folder, tmp_path):
    shutil.copytree(folder, tmp_path / "out")
    (path,) = (tmp_path / "out").glob("*.nc")
    with h5netcdf.File(path, "a") as file:
        kind, _, version = file.attrs["schema"].partition("/")
        file.attrs["schema"] = f"{kind}/{int(version) + 1}"
    seal(path)
    with pytest.raises(InputError, match=rf"{path.name}: is of a later version of ehlectric; expected"):
        load(tmp_path / "out")
