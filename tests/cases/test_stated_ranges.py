"""Inputs of bearing files that are written with their uncertainty."""

import pytest

from ehlectric import BearingCase, InputError
from tests.helpers.each import each

BEARING = {
    "base": "6208",
    "radial_clearance": "10 um",
    "radial_load": "1 kN",
    "inner_speed": "3000 rpm",
    "temperature": "70 degC",
    "composite_rq": "0.03 um",
}


def case(strength="15 V/um", ranges=None, **bearing):
    tables = {
        "title": "3 V to 5 V +- 1",
        "bearing": BEARING | bearing,
        "lubricant": {"base": "paper"},
        "discharge": {"dielectric_strength": strength},
    }
    return BearingCase.from_written(tables | ({} if ranges is None else {"ranges": ranges}))


@each(
    ("key", "text", "low", "middle", "high"),
    [
        ("radial_load", "1 kN +- 10 %", 900.0, 1000.0, 1100.0),
        ("radial_load", "1 kN ± 50 N", 950.0, 1000.0, 1050.0),
        ("radial_load", "1 kN to 3 kN", 1000.0, 2000.0, 3000.0),
        ("temperature", "70 degC +/- 5 K", 338.15, 343.15, 348.15),
        ("temperature", "70 degC +- 5 degC", 338.15, 343.15, 348.15),
        ("inner_speed", "100 rad/s +- 5 percent", 95.0, 100.0, 105.0),
    ],
)
def test_a_value_with_its_uncertainty_is_its_middle_and_a_range(key, text, low, middle, high):
    made = case(**{key: text})
    assert getattr(made.bearing, key) == pytest.approx(middle, rel=1e-12)
    (found,) = made.ranges
    assert found.key == f"bearing.{key}"
    assert (found.low, found.high) == pytest.approx((low, high), rel=1e-12)
    assert BearingCase.from_dict(made.to_dict()) == made
    assert made.title == "3 V to 5 V +- 1"


def test_uncertainties_join_the_ranges_of_the_file_and_of_changes():
    made = case("15 V/um +- 20 %", {"bearing.temperature": ["60 degC", "80 degC"]})
    assert {one.key for one in made.ranges} == {"bearing.temperature", "discharge.dielectric_strength"}
    changed = made.replace({"bearing.radial_load": "2 kN +- 5 %"})
    assert {one.key for one in changed.ranges} == {one.key for one in made.ranges} | {"bearing.radial_load"}


@each(
    ("bearing", "text"),
    [
        ({"temperature": "70 degC +- 10 %"}, "in K or degC"),
        ({"temperature": "70 degC +- 500 K"}, "-156.85 K"),
        ({"radial_load": "1 kN +- 5 um"}, "with the unit of the value or in %"),
        ({"radial_load": "1 kN +- -3 %"}, "a difference above 0"),
        ({"radial_load": "2 kN to 1 kN"}, "the smaller value first"),
        ({"composite_rq": "0.03 um +- 200 %"}, "above 0"),
        ({"radial_clearance": "C3 +- 2 um"}, "not a number with a unit"),
    ],
)
def test_wrong_uncertainties_are_refused_with_their_key(bearing, text):
    (key,) = bearing
    with pytest.raises(InputError, match=text) as caught:
        case(**bearing)
    assert caught.value.key == f"bearing.{key}"


def test_an_uncertainty_beside_a_range_of_the_same_key_is_refused():
    with pytest.raises(InputError, match="one of the two"):
        case("15 V/um +- 20 %", {"discharge.dielectric_strength": ["10 V/um", "20 V/um"]})
