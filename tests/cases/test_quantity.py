"""Quantities with units against conversions done by hand."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.cases.amounts import Amount, Amounts, Count
from ehlectric.quantities.units import to_si
from tests.helpers.each import each


@each(
    "text, unit, expected",
    [
        ("14.1 mm", "m", 0.0141),
        ("226 GPa", "Pa", 226e9),
        ("1.57 MN/m", "N/m", 1.57e6),
        ("0.04 Pa s", "Pa*s", 0.04),
        ("40 mPa s", "Pa*s", 0.04),
        ("40 cP", "Pa*s", 0.04),
        ("22 1/GPa", "1/Pa", 22e-9),
        ("22 GPa^-1", "1/Pa", 22e-9),
        ("-1 V", "V", -1.0),
        ("3.6 km/h", "m/s", 1.0),
        ("1e-3kN/mm", "N/m", 1e3),
        ("1 µm", "m", 1e-6),
        ("+.5 bar", "Pa", 5e4),
        ("22 /GPa", "1/Pa", 22e-9),
        ("5 N/mm2", "Pa", 5e6),
        ("5 N/mm²", "Pa", 5e6),
        ("5 N·mm^-2", "Pa", 5e6),
    ],
)
def test_units(text, unit, expected):
    assert to_si(text, unit) == pytest.approx(expected, rel=1e-14, abs=0.0)


@each(
    "text",
    ["226 kg", "226", "GPa", "", "226 GPaa", "nan Pa", "1 Pa Pa", "0x10 Pa", "1 )(", "1 m**9**9**9", "1 Gpa"],
)
def test_wrong_units_are_refused(text):
    with pytest.raises(ValueError, match=r"it |unit"):
        to_si(text, "Pa")


LENGTH = Amount("m", above=0.0, most=10.0, reason="a test")


@each(
    "given", [0.0, -1.0, 11, math.nan, math.inf, True, None, [1.0], {}, "inf m", "-1 m", 10**400, "1e999 m"]
)
def test_quantity_says_what_it_got_and_takes(given):
    with pytest.raises(ValueError, match=r"got .* in m .*above 0 .* 10: a test"):
        LENGTH.parse(given)


@given(st.floats(1e-6, 9.0))
def test_number_and_text_are_the_same(value):
    assert LENGTH.parse(value) == value
    assert LENGTH.parse(f"{value!r} m") == pytest.approx(value, rel=1e-14, abs=0.0)
    assert LENGTH.parse(f"{1e3 * value!r} mm") == pytest.approx(value, rel=1e-13, abs=0.0)


PREFIXES = {"": 0, "k": 3, "M": 6, "G": 9, "m": -3, "µ": -6, "u": -6, "n": -9}


@given(
    number=st.decimals(-9999, 9999, places=3),
    prefix=st.sampled_from(sorted(PREFIXES)),
    unit=st.sampled_from(["m", "Pa", "V", "N/m", "m/s", "Pa s"]),
)
def test_prefixes_are_powers_of_ten(number, prefix, unit):
    """The float nearest to the decimal number: 0.1 mm is 1e-4 m, not 1.0000000000000002e-4 m."""
    expected = float(number.scaleb(PREFIXES[prefix]))
    assert to_si(f"{number} {prefix}{unit}", unit.replace(" ", "*")) == expected


@each("given", [4, 101, 10.0, True, "10", None, [10], math.nan])
def test_count_takes_whole_numbers_only(given):
    with pytest.raises(ValueError, match=r"got .* 5 to 100: a test"):
        Count(5, 100, "a test").parse(given)


@each(
    "text, unit, advice",
    [
        ("20 cSt", "Pa*s", "multiply a kinematic viscosity by the density"),
        ("3000 rpm", "m/s", "multiply a rotational speed, in rad/s, by the radius"),
        ("250 kN", "N/m", "divide a load by the length of the line"),
    ],
)
def test_what_is_often_given_instead(text, unit, advice):
    with pytest.raises(ValueError, match=f"is not a unit of this quantity; {advice}"):
        to_si(text, unit)
    with pytest.raises(ValueError, match=r"is not a unit of this quantity$"):
        to_si("1 kg", unit)


@each("text", ["70 delta_degC", "70 c", "1 degC/m", "70", "1 kg"])
def test_other_temperatures_are_refused(text):
    """Only units whose zero is known: a difference of degrees is no temperature."""
    with pytest.raises(
        ValueError,
        match=r"is not a unit of an absolute temperature, such as K, °C or °F$|no unit|a difference of temp",
    ):
        to_si(text, "K")


def test_lists_of_quantities():
    lengths = Amounts(LENGTH, least=2)
    assert lengths.parse(["1 mm", 2.0]) == (0.001, 2.0)
    for wrong, message in (
        ([1.0], r"got \[1\.0\]; expected a list of 2 .* in m"),
        (1.0, r"got 1\.0; expected a list"),
        ("1 mm", r"got '1 mm'; expected a list"),
        ([1.0, 11.0], r"got 11\.0; expected .* in m"),
        ([1.0, None], r"got None"),
    ):
        with pytest.raises(ValueError, match=message):
            lengths.parse(wrong)
