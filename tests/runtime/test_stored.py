"""Stored form of dataclasses and of warnings: it comes back, and what does not fit is refused."""

import json
from dataclasses import dataclass, field

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.quantities.field_metadata import number, stored
from ehlectric.quantities.result_warnings import CODES, ResultWarning, texts_and_codes, warnings_of
from ehlectric.runtime.file_rules import UnfitError
from ehlectric.runtime.stored import (
    Part,
    check_parts,
    numbers_of,
    read_numbers,
    values_of,
    warnings_as_attributes,
    warnings_in,
    warnings_in_tables,
)
from ehlectric.sweep.points import Point
from tests.helpers.each import each

words = st.one_of(st.text(), st.sampled_from(["do not use this film", "the film may be 32 % off"]))
lists = st.lists(st.builds(ResultWarning, st.sampled_from(list(CODES)), words))


@dataclass(frozen=True)
class Film:
    thickness: np.ndarray = field(metadata=stored("nodes", "m", "positive", "film thickness"))
    touching: np.ndarray = field(metadata=stored("nodes", None, "0 or 1", dtype="i1"))
    status: str = field(metadata=number(("converged", "stalled")))
    residual: float = field(metadata=number("not negative"))
    error: float | None = field(default=None, metadata=number())
    fraction: np.ndarray | None = field(default=None, metadata=stored("nodes", needed=False))


@dataclass(frozen=True)
class Drive:
    voltage: float = field(metadata=stored("", "V", name="peak_voltage"))
    coating: float | None = field(metadata=stored("", "V", "finite or NaN", unknown=True))
    converged: bool = field(metadata=stored("", None, "0 or 1"))
    events: np.ndarray = field(metadata=stored("event", "s", count="event_count"))


FILM = Part(Film, axes={"nodes": ("x", "y")})
DRIVES = Part(Drive, ("variant",), "drive_")


@pytest.mark.slow
@given(lists)
def test_what_is_stored_comes_back(warnings):
    table = json.loads(json.dumps(texts_and_codes(warnings)))
    assert table == {"warnings": [w.text for w in warnings], "warning_codes": [w.code for w in warnings]}
    assert warnings_of(table) == warnings_in(warnings_as_attributes(warnings)) == tuple(warnings)


@given(lists)
def test_doubtful_points_are_those_with_a_severe_warning(warnings):
    """Whatever the texts say."""
    point = Point(0, {}, "solved", summary=texts_and_codes(warnings))
    assert point.warnings == tuple(warnings)
    assert point.doubtful == any(CODES[warning.code].severity == "severe" for warning in warnings)


@each(
    "code, text, doubtful",
    [
        ("grid-far-too-coarse", "the film may be 32 % off", True),
        ("grid-too-coarse", "do not use it", False),
        ("tunnelling", "do not use this film, it is no solution: stalled", False),
    ],
)
def test_prose_decides_nothing(code, text, doubtful):
    summary = {"warnings": [text], "warning_codes": [code]}
    assert Point(0, {}, "solved", summary=summary).doubtful == doubtful
    assert not Point(0, {}, "not converged", summary=summary).doubtful


def test_codes_of_later_versions_are_read_by_their_text():
    known, unknown = warnings_of({"warnings": ["do not use it", "warm"], "warning_codes": ["cold", "heat"]})
    assert (known.code, unknown.code) == ("not-usable", "unclassified")


def test_a_summary_without_warnings_has_none():
    assert warnings_of({}) == warnings_of({"warnings": []}) == ()


def test_codes_that_are_not_one_a_text_are_damage():
    with pytest.raises(ValueError, match="argument 2"):
        warnings_of({"warnings": ["a", "b"], "warning_codes": ["regime"]})


@each(
    "edited, says",
    [
        ({"warnings": '["a"]'}, "warning_codes is missing"),
        ({"warnings": '["a"]', "warning_codes": "[]"}, "warning_codes is not as it was written"),
        ({"warnings": "[1]", "warning_codes": '["regime"]'}, "warnings is not as it was written"),
    ],
)
def test_warnings_without_their_codes_are_refused(edited, says):
    with pytest.raises(UnfitError, match=f"^{says}$"):
        warnings_in(edited)


def test_nested_warnings_come_back():
    warnings = (ResultWarning("regime", "a"),)
    table = json.dumps([[texts_and_codes(warnings), texts_and_codes(())], []])
    assert warnings_in_tables({"warnings": table}, depth=2) == [[warnings, ()], []]
    with pytest.raises(UnfitError):
        warnings_in_tables({"warnings": table})


def test_an_object_comes_back():
    film = Film(np.array([[1.0, 2.0]]), np.array([[True, False]]), "converged", 1e-9)
    dataset = xr.Dataset(FILM.written(film), attrs={"film": numbers_of(film)})
    assert dataset["thickness"].dims == ("x", "y")
    assert dataset["thickness"].attrs == {"long_name": "film thickness", "units": "m"}
    assert dataset["touching"].dtype == np.int8
    assert "fraction" not in dataset
    check_parts(dataset, [FILM])
    again = Film(**FILM.read(values_of(dataset)), **read_numbers(Film, dataset.attrs, "film"))
    assert again.touching.dtype == bool
    np.testing.assert_array_equal(again.touching, film.touching)
    assert (again.status, again.residual, again.error, again.fraction) == ("converged", 1e-9, None, None)
    with pytest.raises(UnfitError, match=r"^thickness is not positive$"):
        check_parts(-dataset, [FILM])


@each(
    "edited",
    ['{"status": "found", "residual": 0}', '{"status": "stalled"}', '{"status": 1, "residual": 0}', "[]"],
)
def test_numbers_that_do_not_fit_are_refused(edited):
    with pytest.raises(UnfitError):
        read_numbers(Film, {"film": edited}, "film")


def test_a_share_of_an_earlier_version_is_read_without_its_rounding():
    """Version 1.0.0 wrote film_fraction of -4e-16, and refused its own file."""

    @dataclass(frozen=True)
    class Oil:
        share: np.ndarray = field(metadata=stored("x", "1", "0 to 1"))

    part = Part(Oil)
    written = xr.Dataset(part.written(Oil(np.array([-4e-16, 0.5, 1.0 + 2e-16]))))
    check_parts(written, [part])
    np.testing.assert_array_equal(Oil(**part.read(values_of(written))).share, [0.0, 0.5, 1.0])
    with pytest.raises(UnfitError, match=r"^share is not from 0 to 1, but -0\.001$"):
        part.check(Oil(np.array([-1e-3, 0.5])))


def test_objects_with_arrays_of_different_lengths_come_back():
    drives = [
        Drive(1.5, None, True, np.array([1.0, 2.0])),
        Drive(2.5, 3.0, False, np.zeros(0)),
        Drive(3.5, 4.0, True, np.array([3.0])),
    ]
    dataset = xr.Dataset(DRIVES.written(drives))
    assert {"peak_voltage", "drive_coating", "event_count", "drive_events"} <= set(dataset.variables)
    assert dataset["event_count"].values.tolist() == [2, 0, 1]
    check_parts(dataset, [DRIVES])
    values = values_of(dataset)
    for k, drive in enumerate(drives):
        again = DRIVES.read(values, k)
        assert again.pop("events").tolist() == drive.events.tolist()
        assert again == {"voltage": drive.voltage, "coating": drive.coating, "converged": drive.converged}
    for edited in (dataset.drop_vars("drive_events"), dataset.assign(event_count=dataset["event_count"] + 1)):
        with pytest.raises(UnfitError, match="event"):
            check_parts(edited, [DRIVES])


def test_objects_without_events_have_no_variable_of_them():
    dataset = xr.Dataset(DRIVES.written([Drive(1.5, None, True, np.zeros(0))]))
    assert "drive_events" not in dataset
    check_parts(dataset, [DRIVES])
    assert DRIVES.read(values_of(dataset), 0)["events"].size == 0
