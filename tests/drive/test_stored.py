"""File of a drive: what is saved comes back, with the same numbers."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric import DriveCase, InputError, load, save, solve, solve_drive
from ehlectric.drive import run as of_drives
from ehlectric.drive.preparation import prepare
from ehlectric.drive.result import DriveResult
from ehlectric.drive.stored import check, parts_of
from ehlectric.drive.summary import checked_summary
from ehlectric.drive.warnings import unused_keys
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.file_rules import UnfitError
from ehlectric.tables.drive_tables import drive_rows
from tests.helpers.drives import drive_with_remedy, small_drive
from tests.helpers.each import each

# Keys of the rates of discharges by the sign of the shaft.
SIGNS = ("events_per_second_positive", "events_per_second_negative")


@pytest.fixture(scope="module")
def drive():
    """Drive with two different bearings, and a warning about a file."""
    case = drive_with_remedy().replace(
        {
            "non_drive_end.bearing.radial_load": "500 N",
            "non_drive_end.bearing.parallel_capacitance": "20 pF",
            "non_drive_end.bearing.life": {"contamination_factor": 0.5, "dynamic_rating": 29_100.0},
        }
    )
    result = solve_drive(case, workers=1)
    told = (ResultWarning("waveform-coarse", "told by hand"), *result.solution.prior_warnings)
    return replace(result, solution=replace(result.solution, prior_warnings=told))


@pytest.mark.slow
def test_a_loaded_result_equals_the_saved_one(drive, tmp_path):
    files = save(drive, tmp_path)
    assert [file.name for file in files] == ["summary.json", "events.csv", "spectrum.csv", "drive.nc"]
    for path in (tmp_path, tmp_path / "drive.nc", tmp_path / "events.csv"):
        again = load(path)
        assert again == drive
        assert again.summary() == drive.summary()
        assert again.events() == drive.events()
        assert again.spectrum().equals(drive.spectrum())
        assert list(map(str, again.warnings)) == list(map(str, drive.warnings))
    assert again.solution.bearings == ()
    assert len(drive.solution.bearings) == 2


@pytest.mark.slow
def test_each_bearing_of_a_drive_has_its_rating_life(drive):
    """The life of the bearing alone, and L_10 by hand from 29.1 kN and the load at the non-drive end."""
    first, second = (drive.summary()[end]["life"] for end in ENDS)
    assert first["basic_life"] is None
    bearing = drive.case.bearings[1]
    alone = solve(bearing).summary(probable=False)["life"]
    assert second == alone
    turns = bearing.bearing.inner_speed / (2.0 * np.pi)
    expected = (29_100.0 / second["equivalent_load"]) ** 3 * 1e6 / turns
    assert second["basic_life"] == pytest.approx(expected, rel=1e-9)
    rows = {row.key: row for row in drive_rows(drive.summary())}
    assert rows["non_drive_end.life.dynamic_rating"].text == "29\xa0100 N, given"
    assert "drive_end.life.basic_life" not in rows
    checked = checked_summary(prepare(drive.case, workers=1))
    assert checked["non_drive_end"]["life"]["basic_life"] == pytest.approx(expected, rel=1e-9)


@pytest.mark.slow
@pytest.mark.gate
def test_a_file_of_version_1_0_has_no_spectrum(drive, tmp_path):
    """Its variables are missing, and half of them are a damaged file."""
    whole = drive.to_xarray()
    earlier = of_drives.result_of(whole.drop_vars(["line_count", "line_amplitude"]), tmp_path / "drive.nc")
    assert len(earlier.spectrum()) == 0
    assert earlier.summary() == drive.summary()
    save(earlier, tmp_path)
    assert (tmp_path / "spectrum.csv").read_text().splitlines() == ["frequency [Hz],shaft_voltage [V]"]
    assert load(tmp_path) == earlier
    with pytest.raises(UnfitError):
        check(whole.drop_vars("line_count"), 2)
    with pytest.raises(UnfitError):
        check(whole.drop_vars("line_amplitude"), 2)


@pytest.mark.slow
@pytest.mark.gate
def test_a_file_that_knows_no_summits_has_smooth_films(drive):
    dataset = drive.to_xarray()
    lines = drive.case.replace({"bearings.bearing.film_factor": 0.9}).to_toml().splitlines()
    without = [line for line in lines if not line.startswith("summit_height")]
    assert len(without) == len(lines) - len(ENDS)
    dataset.attrs["case"] = "\n".join(without)
    solution, *_ = parts_of(dataset)
    assert [one.bearing.summit_height for one in solution.case.bearings] == [0.0, 0.0]


@pytest.mark.slow
@pytest.mark.gate
def test_a_result_without_discharges_is_loaded_too(drive, tmp_path):
    _, _, grounded = drive.remedies[0]
    result = DriveResult(replace(grounded, case=grounded.case.replace({"remedies": []})))
    save(result, tmp_path)
    again = load(tmp_path)
    assert again == result
    assert len(again.solution.record.events) == 0
    assert not [name for name in again.to_xarray() if str(name).startswith("event_b")]


def test_numbers_that_differ_make_another_result(drive):
    record = drive.solution.record
    events = record.events.copy()
    events[-1, 3] = np.nextafter(events[-1, 3], 0.0)
    other = replace(drive, solution=replace(drive.solution, record=replace(record, events=events)))
    assert other != drive


@pytest.mark.slow
def test_a_file_of_version_1_0_has_no_numbers_of_the_shaft_and_of_signs(drive, tmp_path):
    """Their keys are null; all other numbers are the same, and what is saved again is the same result."""
    whole = drive.to_xarray()
    ends = [f"{name}_{end}" for name in ("shaft", "source") for end in ("lowest", "highest")]
    later = ["positive_events", "shaft_mean", "shaft_rms", *ends]
    earlier = of_drives.result_of(whole.drop_vars(later), tmp_path / "drive.nc")
    found, known = earlier.summary(), drive.summary()
    assert set(found["shaft"].values()) == {None}
    assert found["shaft"].keys() == known["shaft"].keys()
    known["shaft"] = found["shaft"]
    for table, keys in (("source", ["peak_to_peak"]), *((end, SIGNS) for end in ENDS)):
        known[table] |= dict.fromkeys(keys)
    for one in known["remedies"]:
        for end in ENDS:
            one[end] |= dict.fromkeys(SIGNS)
    assert found == known
    save(earlier, tmp_path)
    assert load(tmp_path) == earlier


@each(
    "name, change",
    [
        ("event_bearing", lambda values: values + 1),
        ("event_count", lambda values: values + 1),
        ("voltage_edge", lambda values: -values),
        ("position_breakdown", lambda values: 0.0 * values),
        ("time_at_voltage", lambda values: values - 1.0),
    ],
)
def test_what_is_wrong_is_named(drive, tmp_path, name, change):
    dataset = drive.to_xarray()
    changed = dataset.assign({name: (dataset[name].dims, change(dataset[name].values))})
    with pytest.raises(InputError, match=name):
        of_drives.result_of(changed, tmp_path / "drive.nc")


@pytest.mark.slow
@pytest.mark.gate
def test_the_file_of_another_result_is_refused(drive, tmp_path):
    other = drive.to_xarray().assign_attrs(schema="ehlectric.bearing.solution/1")
    with pytest.raises(InputError, match=r"drive\.nc: "):
        of_drives.result_of(other, tmp_path / "drive.nc")


def test_events_of_another_bearing_than_counted_are_refused(drive):
    """They would have no statistics, or those of the other bearing."""
    dataset = drive.to_xarray()
    films = dataset["event_bearing"]
    assert films.size > 10
    parts_of(dataset)
    for edited in (films * 0, films * 0 + 1, 1 - films):
        with pytest.raises(UnfitError, match=r"event_bearing .*block_events"):
            parts_of(dataset.assign(event_bearing=edited))


def test_equal_bearings_have_one_note_also_after_loading():
    """A file with one bearing is written with two."""
    motor = {
        "common_mode_voltage": 300.0,
        "winding_rotor_capacitance": 2e-11,
        "rotor_frame_capacitance": 1e-9,
    }
    tables = small_drive().to_dict()
    tables["drive_end"]["motor"] = motor
    del tables["non_drive_end"]
    case = DriveCase.from_dict(tables)
    notes = [str(note) for note in unused_keys(case)]
    assert len(notes) == 1
    assert [str(note) for note in unused_keys(DriveCase.from_dict(case.to_dict()))] == notes
