"""Table ``ranges`` of a bearing file: what is taken, what is refused in one line, and where it goes."""

import re

import pytest

from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.ranges import InputRange
from ehlectric.errors import InputError
from tests.helpers.bearings import BALLS, bearing_case, changed

STRENGTH, TEMPERATURE = "discharge.dielectric_strength", "bearing.temperature"
BOTH = {STRENGTH: ["10 V/um", "20 V/um"], TEMPERATURE: ["60 degC", "80 degC"]}


def with_ranges(ranges, **changes):
    return BearingCase.from_dict(changed(BALLS, **changes) | {"ranges": ranges})


def test_dotted_keys_and_tables_are_the_same():
    nested = {"discharge": {"dielectric_strength": BOTH[STRENGTH]}, "bearing.temperature": BOTH[TEMPERATURE]}
    case = with_ranges(BOTH)
    assert case == with_ranges(nested)
    assert case.ranges[0] == InputRange(STRENGTH, 10e6, 20e6)
    assert (case.ranges[1].low, case.ranges[1].high) == pytest.approx((333.15, 353.15))


def test_ranges_are_written_and_read(tmp_path):
    case = with_ranges(BOTH)
    path = tmp_path / "bearing.toml"
    path.write_text(case.to_toml(), encoding="utf-8")
    assert BearingCase.from_toml(path) == case
    assert hash(case) != hash(bearing_case(BALLS))
    assert "ranges" not in bearing_case(BALLS).to_dict()
    assert with_ranges({}) == bearing_case(BALLS)


def test_a_whole_number_keeps_its_kind():
    case = with_ranges({"bearing.elements": [8, 10]})
    assert all(isinstance(end, int) for end in (case.ranges[0].low, case.ranges[0].high))
    assert BearingCase.from_dict(case.to_dict()) == case
    assert case.replace({TEMPERATURE: "60 degC"}).ranges == case.ranges


def test_a_range_goes_with_its_value():
    """A changed value has no range any more, nor has one that another key replaces."""
    case = with_ranges(BOTH)
    assert [one.key for one in case.replace({TEMPERATURE: "90 degC"}).ranges] == [STRENGTH]
    weibull = {"scale": "15 V/um", "shape": 10, "reference_area": "1 mm^2"}
    assert [one.key for one in case.replace({"discharge.weibull": weibull}).ranges] == [TEMPERATURE]
    assert case.replace({TEMPERATURE: 350.0, STRENGTH: 1e7}).ranges is None
    assert case.replace({"bearing.radial_load": 900.0}).ranges == case.ranges


@pytest.mark.parametrize(
    ("ranges", "message"),
    [
        (
            {"bearing.temprature": [1, 2]},
            "bearing.temprature: unknown key; the nearest known one is bearing.temp",
        ),
        ({"ranges": [1, 2]}, "ranges.ranges: unknown key"),
        ({"bearing": [1, 2]}, "bearing: is a table; expected one of its keys"),
        ({STRENGTH: ["20 V/um", "10 V/um"]}, "got '20 V/um' and '10 V/um'; expected the smaller one first"),
        ({STRENGTH: ["15 V/um", "15 V/um"]}, "expected the smaller one first"),
        ({STRENGTH: ["15 V/um"]}, "expected a list of two values"),
        ({STRENGTH: "10 to 20 V/um"}, "expected a list of two values"),
        ({STRENGTH: ["15 V", "20 V"]}, f"ranges.{STRENGTH}: got '15 V'"),
        ({"bearing.fill": ["air", "oil"]}, "expected numbers: only they have a range"),
        ({"title": ["a", "b"]}, "ranges.title: got 'a'; expected numbers"),
        (
            {"bearing.contact_angle": [0.1, 0.2]},
            "expected a number for bearing.contact_angle in the file too",
        ),
        ({"bearing.film_factor": [0.5, 1.0]}, "expected a number for bearing.film_factor in the file too"),
        (
            {STRENGTH: [1e7, 2e7], "discharge": {"dielectric_strength": [1e7, 3e7]}},
            "got it twice; expected it once",
        ),
        (
            {STRENGTH: ["20 V/um", "30 V/um"]},
            "got 2e+07 to 3e+07; expected a range that contains the value of the file, 1.5e+07 (in SI units)",
        ),
        ([1, 2], "ranges: got [1, 2]; expected a table of keys"),
    ],
)
def test_wrong_ranges_are_one_line(ranges, message):
    with pytest.raises(InputError, match=re.escape(message)) as raised:
        with_ranges(ranges)
    assert str(raised.value).startswith("ranges")
    assert "\n" not in str(raised.value)
