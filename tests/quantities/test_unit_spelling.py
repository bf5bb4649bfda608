"""Units as people type them, in every place that reads a quantity.

Factors: inch 25.4 mm, pound 0.45359237 kg and standard gravity 9.80665 m/s^2 by definition, and
degF = 9/5 degC + 32.
"""

import math

import pandas as pd
import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import BearingCase, Case, InputError
from ehlectric.app.form_fields.field import field_of, shown_text, written_text
from ehlectric.cases.amounts import Amount
from ehlectric.cases.measurements import CYCLE, column_of, read_measurement
from ehlectric.quantities.unit_spelling import plain, typed
from ehlectric.quantities.units import factor, in_unit, parts
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each

INCH, POUND = 0.0254, 0.45359237 * 9.80665


@each(
    "text",
    [
        *("158 degF", "158 °F", "158 ℉", "158 F", "158 ° F", "158 deg F", "158 fahrenheit", "１５８ ℉"),
        *("70 ℃", "70 °C", "70 ºC", "70 ˚C", "70 deg C", "70 degrees C", "70 Celsius", "70\u00a0°C"),
        *("343.15 K", "343.15 kelvin", "343150 mK", "617.67 degR"),
    ],
)
def test_absolute_temperatures(text):
    assert Amount("K", least=200.0, most=600.0).parse(text) == pytest.approx(343.15, rel=1e-14)


def test_the_whole_scale_in_fahrenheit():
    """32 degF is 0 degC, -40 is the same number on both scales, and 212 degF is 100 degC."""
    kelvin = Amount("K", least=200.0, most=600.0)
    assert [kelvin.parse(f"{f} degF") for f in (32, -40, 212)] == [273.15, 233.15, 373.15]


@each(
    "text, unit, value",
    [
        *((f"3 {name}", "m", 3e-6) for name in ("um", "µm", "μm", "㎛", "micron", "ｕｍ")),
        *((f"14 {name}", "m", 14e-3) for name in ("mm", "㎜", "ｍｍ")),
        *((f"50 {name}", "m", 5e-9) for name in ("Å", "\u212b", "angstrom", "Å")),
        *((f"5 {name}", "Pa", 5e9) for name in ("GPa", "㎬")),
        *((f"2 {name}", "ohm", 2e3) for name in ("kΩ", "k\u2126", "㏀", "kOhm", "kohm")),
        *((f"1.5 {name}", "m", 1.5e-3 * INCH) for name in ("mil", "mils", "thou")),
        ("0.5 in", "m", 0.5 * INCH),
        ("16 µin", "m", 16e-6 * INCH),
        ("380 V/mil", "V/m", 380.0 / (1e-3 * INCH)),
        ("15 kV/mm", "V/m", 15e6),
        ("15 MV/m", "V/m", 15e6),
        ("450 lbf", "N", 450.0 * POUND),
        ("450 lbf/in", "N/m", 450.0 * POUND / INCH),
        ("145 psi", "Pa", 145.0 * POUND / INCH**2),
        ("30e3 ksi", "Pa", 30e6 * POUND / INCH**2),
        ("46 cSt", "m**2/s", 46e-6),
        ("46 ㎟/s", "m**2/s", 46e-6),
        ("40 cP", "Pa*s", 0.04),
        *((f"40 {name}", "Pa*s", 0.04) for name in ("mPas", "mPa.s", "mPa·s", "mPa⋅s", "mPa*s", "㎩ s")[:5]),
        *((f"0.14 {name}", "W/m/K", 0.14) for name in ("W/(m K)", "W/(m·K)", "W/m/°C", "W/m/K", "W m⁻¹ K⁻¹")),
        ("2000 J/(kg*K)", "J/kg/K", 2000.0),
        ("6.5e-4 1/℃", "1/K", 6.5e-4),
        ("3.6e-4 1/degF", "1/K", 6.48e-4),
        ("3 m∕s", "m/s", 3.0),
        ("８７０　kg/m³", "kg/m**3", 870.0),
        ("–3 V", "V", -3.0),
    ],
)
def test_units_that_practitioners_type(text, unit, value):
    assert Amount(unit).parse(text) == pytest.approx(value, rel=1e-13)


@each(
    "text, unit, message",
    [
        ("5² mm", "m", "is not a unit"),
        ("½ in", "m", "."),
        ("5 °m", "m", "is not a unit"),
        ("３，５ ㎜", "m", "decimal comma: write 3.5 mm"),
        ("70 degF", "m", "is not a unit of this quantity"),
        ("100 lb", "N", "a mass is not a force: write N, lbf or kgf"),
        ("10 mil", "rad", "is not a unit of this quantity"),
        ("70 delta_degF", "K", "a difference of temperatures"),
        ("70 m", "K", "is not a unit of an absolute temperature"),
    ],
)
def test_texts_that_are_no_quantity(text, unit, message):
    with pytest.raises(InputError, match=message):
        Amount(unit).parse(text)


@each(
    "text, kelvin",
    [("48 K", 48.0), ("48 delta_degC", 48.0), ("86.4 delta_degF", 48.0), ("86.4 Δ°F", 48.0), ("48 Δ℃", 48.0)],
)
def test_differences_of_temperatures(text, kelvin):
    assert Amount("K", difference=True).parse(text) == pytest.approx(kelvin, rel=1e-14)


def test_a_difference_is_no_temperature_in_any_spelling():
    units = pint.UnitRegistry()
    difference = Amount("K", difference=True)
    assert difference.parse(units.Quantity(36.0, "delta_degF")) == pytest.approx(20.0)
    for entry in ("48 ℃", "118 ℉", "118 degF", units.Quantity(118.0, "degF")):
        with pytest.raises(InputError, match="difference of temperatures"):
            difference.parse(entry)


@given(st.text("abcdefghijkxyzGMkmµ/*^0123456789 -"))
def test_plain_units_stay(text):
    """Letters, numbers and signs that are spelled as units.py and pint spell them."""
    assert typed(text) == text
    if not any(word in text for word in ("deg", "mil", "kelvin", "kp")):
        assert plain(text) == text.strip()


@each("unit", ["mil", "lbf", "psi", "ksi", "Å", "µin", "ft", "kgf", "atm", "micron", "V/mil", "lbf/in"])
def test_factors_without_the_registry_are_those_of_pint(unit):
    """Pint knows a mil as an angle, and by the name thou as a length."""
    registry = pint.UnitRegistry()
    one = registry.Quantity(1.0, registry.parse_units(unit.replace("mil", "thou")))
    assert factor(unit, f"{one.to_base_units().units:~}".replace(" ", "")) == pytest.approx(
        one.to_base_units().magnitude, rel=1e-12
    )


def test_command_python_sweep_and_bearing_read_the_same_value():
    case = bearing_case(BALLS, bearing__temperature="158 ℉", bearing__radial_load="450 lbf")
    assert case.bearing.temperature == pytest.approx(343.15)
    assert case.bearing.radial_load == pytest.approx(450.0 * POUND)
    assert BearingCase.from_dict(case.to_dict()) == case
    sweep = Sweep.from_dict({"case": case, "vary": {"bearing.temperature": ["140 degF", "70 ℃"]}})
    assert sweep.axes["bearing.temperature"] == pytest.approx((333.15, 343.15))
    spread = Sweep.from_dict(
        {"case": case, "vary": {"bearing.temperature": {"from": "140 degF", "to": "158 degF", "count": 2}}}
    )
    assert spread.axes["bearing.temperature"] == pytest.approx((333.15, 343.15))


def test_an_uncertainty_in_degf_is_a_difference():
    """18 degF of a difference are 10 K."""
    case = bearing_case(BALLS, bearing__temperature="158 degF +- 18 degF")
    (spread,) = case.ranges
    assert (spread.key, spread.low, spread.high) == pytest.approx(("bearing.temperature", 333.15, 353.15))


def test_heads_of_columns():
    assert column_of("temperature [℉]", CYCLE).value(158.0) == pytest.approx(343.15)
    assert column_of("speed （rpm）", CYCLE).value(3000.0) == pytest.approx(100.0 * math.pi)
    assert column_of("radial load [lbf]", CYCLE).value(450.0) == pytest.approx(450.0 * POUND)
    assert column_of("film [㎚]").value(100.0) == pytest.approx(1e-7)
    assert column_of("impedance [㏀]").value(2.0) == pytest.approx(2e3)


def test_an_uncertainty_of_a_temperature_in_a_file():
    heads = ["speed [rpm]", "capacitance [pF]", "temperature [degF]", "uncertainty of temperature [degF]"]
    table = read_measurement(pd.DataFrame([[1000, 50, 158, 9], [2000, 40, 158, 9]], columns=heads))
    assert table.uncertainties["temperature"] == pytest.approx([5.0, 5.0])


@each(
    "key, text, written, shown, number",
    [
        ("bearing.temperature", "70 ℃", "70 degC", "70 °C", 70.0),
        ("bearing.temperature", "158 degF", "158 degF", "158 °F", 70.0),
        ("bearing.temperature", "158 ℉", "158 ℉", "158 °F", 70.0),
        ("bearing.bore", "40 ㎜", "40 mm", "40 mm", 40.0),
        ("bearing.radial_load", "450 lbf", "450 lbf", "450 lbf", 450.0 * POUND),
        ("bearing.composite_rq", "2 µin", "2 µin", "2 µin", 2.0 * 25.4e-3),
    ],
)
def test_fields_show_and_keep_the_unit(key, text, written, shown, number):
    field = field_of(key)
    assert written_text(field, text) == written
    assert shown_text(field, written) == shown
    unit = {"N": 1.0, "kN": 1e-3}.get(field.unit, 1.0)
    assert field.number(written) == pytest.approx(number * unit)
    assert field.from_text(written) == written


def test_parts_of_a_text():
    assert parts("７０．５ ℃") == ("70.5", "°C")
    assert in_unit("70 ℃", "degF") == pytest.approx(158.0)


def test_an_unquoted_temperature_is_explained(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text("a = 70 ℃\nb = 3 ㎜\n", encoding="utf-8")
    with pytest.raises(InputError, match='write a number with a unit in quotes, "70 ℃"'):
        Case.from_toml(path)
