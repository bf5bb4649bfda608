"""Table ``ranges`` of a bearing file: what is taken, what is refused in one line, and where it goes."""

import pytest

from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.input_ranges import InputRange
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
