"""Spellings of units, quantities of pint, and numbers whose unit is missing."""

import json
import math
import tomllib

import numpy as np
import pint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import Case, InputError
from ehlectric.cases.amounts import Amount, Amounts, Count
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities import units
from ehlectric.quantities.units import comma_advice
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, changed
from tests.helpers.each import each

UNITS = pint.UnitRegistry()
SPEED = Amount("rad/s", above=0.0, most=1e5)
ANGLE = Amount("rad", above=0.0, below=1.0)
TEMPERATURE = Amount("K", least=200.0, most=600.0)
LENGTH = Amount("m", least=0.0, most=10.0)
NUMBER = Amount("", least=0.0, most=5.0)
SHARE = Amount("", least=0.0, most=1.0, fraction=True)
HUNDRED_PI = 314.159265358979


@each(
    "unit",
    [
        "rpm",
        "RPM",
        "Rpm",
        "min^-1",
        "min-1",
        "min**-1",
        "min⁻¹",
        "1/min",
        "1 / min",
        "/min",
        "r/min",
        "rev/min",
        "U/min",
    ],
)
def test_revolutions_per_minute(unit):
    assert SPEED.parse(f"3000 {unit}") == HUNDRED_PI


@each("unit", ["Hz", "1/s", "s^-1", "s⁻¹"])
def test_frequencies_are_refused(unit):
    with pytest.raises(InputError, match=r"is a frequency.*rpm"):
        SPEED.parse(f"50 {unit}")


def test_revolutions_are_a_unit_of_rotational_speeds_only():
    with pytest.raises(InputError, match="is not a unit of this quantity; multiply a rotational speed"):
        Amount("m/s").parse("3000 min^-1")


@each(
    "text, unit, value",
    [
        ("22 GPa⁻¹", "1/Pa", 2.2e-8),
        ("46 mm²/s", "m**2/s", 46e-6),
        ("46 mm² s⁻¹", "m**2/s", 46e-6),
        ("870 kg·m⁻³", "kg/m**3", 870.0),
        ("\N{MINUS SIGN}3 V", "V", -3.0),
        ("3·10⁻⁶ m", "m", None),
    ],
)
def test_superscripts(text, unit, value):
    if value is None:
        with pytest.raises(InputError):
            Amount(unit).parse(text)
    else:
        assert Amount(unit).parse(text) == value


@each("unit", ["C", "°C", "degC"])
def test_celsius(unit):
    assert TEMPERATURE.parse(f"70 {unit}") == 343.15
    with pytest.raises(InputError, match="is not a unit"):
        LENGTH.parse(f"70 {unit}")


@each(
    "text, advice",
    [
        ("14,1 mm", "decimal comma: write 14.1 mm"),
        ("-0,08", "decimal comma: write -0.08"),
        ("1,5e-3 m", "decimal comma: write 1.5e-3 m"),
        ("1,000 mm", "decimal comma: write 1 mm, or 1000 mm if the comma separates thousands"),
        ("14.1 mm", None),
        ("1,2,3", None),
        ("a,1", None),
    ],
)
def test_decimal_commas(text, advice):
    assert comma_advice(text) == advice


@each("quantity, text", [(LENGTH, "14,1 mm"), (NUMBER, "0,52"), (SHARE, "3,5 %")])
def test_decimal_commas_of_every_kind_of_number(quantity, text):
    with pytest.raises(InputError, match=r"decimal comma: write \d+\.\d+"):
        quantity.parse(text)


@each(
    "quantity, entry, value",
    [
        (LENGTH, UNITS.Quantity(14.1, "mm"), 0.0141),
        (LENGTH, UNITS.Quantity(np.array(14.1), "mm"), 0.0141),
        (SPEED, UNITS.Quantity(3000, "rpm"), HUNDRED_PI),
        (SPEED, UNITS.Quantity(2.0, "rad/s"), 2.0),
        (TEMPERATURE, UNITS.Quantity(70, "degC"), 343.15),
        (NUMBER, UNITS.Quantity(0.5, "dimensionless"), 0.5),
        (SHARE, UNITS.Quantity(3, "percent"), 0.03),
        (LENGTH, np.array(2.0), 2.0),
        (LENGTH, np.float32(0.5), 0.5),
        (LENGTH, np.array(2), 2.0),
    ],
)
def test_quantities_of_pint_and_arrays_without_dimensions(quantity, entry, value):
    found = quantity.parse(entry)
    assert found == value
    assert type(found) is float


@each(
    "quantity, entry, message",
    [
        (LENGTH, UNITS.Quantity(1.0, "s"), "second is not a unit of this quantity"),
        (LENGTH, UNITS.Quantity(20.0, "m"), "expected a number in m or a string with its unit, at least 0"),
        (LENGTH, UNITS.Quantity([1.0, 2.0], "m"), "is not a single number"),
        (SPEED, UNITS.Quantity(50.0, "Hz"), "hertz is a frequency"),
        (SPEED, UNITS.Quantity(50.0, "m"), "meter is not a unit of this quantity"),
        (TEMPERATURE, UNITS.Quantity(70.0, "delta_degC"), "is a difference of temperatures"),
        (NUMBER, UNITS.Quantity(1.0, "rad"), "radian is a unit, and this number has none"),
        (ANGLE, UNITS.Quantity(25.0, "percent"), "percent is not a unit of an angle"),
        (ANGLE, "25 percent", "percent is not a unit of an angle"),
        (LENGTH, np.array([1.0]), "is not a number"),
        (LENGTH, np.array(True), "is not a number"),
    ],
)
def test_refused_quantities(quantity, entry, message):
    with pytest.raises(InputError, match=message):
        quantity.parse(entry)


def test_lists_and_counts_of_numpy():
    assert Amounts(LENGTH, least=2).parse(np.array([1.0, 2.0])) == (1.0, 2.0)
    assert Amounts(LENGTH).parse(UNITS.Quantity([1.0, 2.0], "mm")) == (1e-3, 2e-3)
    assert Count(1, 9, "a test").parse(np.array(3)) == 3
    with pytest.raises(InputError, match="expected a list of 1 or more"):
        Amounts(LENGTH).parse(np.ones((2, 2)))


def test_a_bare_rotational_speed():
    """Refused where a person wrote it. Saved cases hold floats in rad/s, which are read as before."""
    both = r"'3000 rpm' or '3000 rad/s' \(= 28648 rpm\)"
    for entry in (3000, np.int64(3000), np.array(3000)):
        with pytest.raises(InputError, match=both):
            SPEED.parse(entry)
    assert SPEED.parse(3000.0) == 3000.0
    with pytest.raises(InputError, match=r"got 3000\.0; expected"):
        SPEED.parse(3000.0, written=True)


@each("entry", [70, 70.0, -40])
def test_a_bare_temperature_in_celsius(entry):
    with pytest.raises(InputError, match=f"'{entry} °C'.* kelvin"):
        TEMPERATURE.parse(entry)
    wide = Amount("K", least=100.0, most=1000.0)
    with pytest.raises(InputError, match="kelvin"):
        wide.parse(entry, written=True)
    assert wide.parse(150.0) == 150.0
    assert TEMPERATURE.parse(343.15, written=True) == 343.15


FILE = """\
[bearing]
base = "6208"
radial_clearance = "10 um"
radial_load = "1 kN"
inner_speed = {speed}
temperature = "70 degC"
composite_rq = "0.03 um"
[lubricant]
base = "paper"
"""


def test_files_of_bearings(tmp_path):
    path = tmp_path / "bearing.toml"
    path.write_text(FILE.format(speed='"300 rad/s"'))
    assert BearingCase.from_toml(path).bearing.inner_speed == 300.0


@pytest.mark.slow
@given(st.floats(1e-3, 1e5, exclude_max=True))
def test_a_written_bearing_is_the_same_bearing(speed):
    """The float itself, not one that differs in the last digit; and files of earlier versions with floats."""
    case = bearing_case(BALLS, bearing__inner_speed=speed)
    table = tomllib.loads(case.to_toml())
    assert table["bearing"]["inner_speed"] == f"{speed!r} rad/s"
    assert BearingCase.from_written(table) == BearingCase.from_dict(table) == case
    assert BearingCase.from_dict(json.loads(json.dumps(case.to_dict()))) == case


def test_sweeps_in_python_take_floats():
    case = bearing_case(BALLS)
    sweep = Sweep.from_dict({"case": case, "vary": {"bearing.inner_speed": ["1000 min^-1", 200.0]}})
    assert sweep.axes["bearing.inner_speed"] == (pytest.approx(100.0 * math.pi / 3.0), 200.0)


@each(
    "line, message",
    [
        ("a = 14,1", "line 2 is 'a = 14,1': decimal comma, write 14.1"),
        ("a = 14,1 mm # x", "line 2 is 'a = 14,1 mm # x': decimal comma, write \"14.1 mm\""),
        ("a = 226 GPa", "line 2 is 'a = 226 GPa': write a number with a unit in quotes, \"226 GPa\""),
        ('a = ["1 m", 2 m]', 'write a number with a unit in quotes, "2 m"'),
        ("a = 70 °C", 'write a number with a unit in quotes, "70 °C"'),
        (
            'a = "1 m" b',
            "line 2, column 11",
        ),
        ("a =", "line 2, column 4"),
    ],
)
def test_lines_that_are_no_toml(tmp_path, line, message):
    path = tmp_path / "case.toml"
    path.write_text(f"# first\n{line}\n", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        Case.from_toml(path)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("model", [Case, BearingCase, Sweep])
def test_json_schemas(model):
    """Plain JSON, in which every table has its keys, and a key that may have a unit may be a string."""
    schema = model.model_json_schema()
    assert json.loads(json.dumps(schema)) == schema
    assert set(schema["properties"]) == set(model.known_keys())
    if model is Case:
        tables = schema["$defs"]
        assert {"type": "string"} in tables["Contact"]["properties"]["reduced_radius"]["anyOf"][0]["anyOf"]
        assert set(tables["Lubricant"]["properties"]) == set(
            Case.model_fields["lubricant"].annotation.known_keys()
        )
        assert tables["Grid"]["properties"]["nodes"]["anyOf"][0]["minimum"] == 65
        assert "required" not in tables["Lubricant"]
    if model is BearingCase:
        assert schema["$defs"]["Bearing"]["properties"]["inner_speed"]["type"] == "string"


CLEARANCES = {
    ("deep-groove ball", "C3"): (15e-6, 33e-6),
    ("deep-groove ball", "CN"): (6e-6, 20e-6),
    ("cylindrical roller", "C3"): (45e-6, 70e-6),
}


@each("kind, name", CLEARANCES)
def test_clearance_classes_of_a_bore_of_40_mm(kind, name):
    low, high = CLEARANCES[kind, name]
    tables = ROLLERS if kind == "cylindrical roller" else BALLS
    for key in ("radial_clearance", "clearance_class"):
        given_ = {"bearing__radial_clearance": None, "bearing__bore": "40 mm", f"bearing__{key}": name}
        bearing = bearing_case(tables, **given_).bearing
        assert bearing.radial_clearance == pytest.approx(0.5 * (low + high), rel=1e-12)
        assert bearing.clearance_class == name


def test_a_class_and_its_clearance():
    case = bearing_case(BALLS, bearing__radial_clearance="c3", bearing__bore="40 mm")
    assert (
        BearingCase.from_dict(case.to_dict())
        == BearingCase.from_written(tomllib.loads(case.to_toml()))
        == case
    )
    other = case.replace({"bearing.radial_clearance": "10 um"}).bearing
    assert (other.clearance_class, other.radial_clearance) == (None, 10e-6)
    assert case.replace({"bearing.clearance_class": "CN"}).bearing.radial_clearance == pytest.approx(13e-6)
    assert case.replace({"bearing.bore": "41 mm"}).bearing.radial_clearance == pytest.approx(27e-6)
    assert case.replace({"title": "A"}).bearing == case.bearing
    # C0 is the older name of the normal class, and a class replaces the clearance of the library.
    assert (
        bearing_case(BALLS, bearing__radial_clearance="C0", bearing__bore="40 mm").bearing.clearance_class
        == "CN"
    )
    library = changed(BALLS, bearing__radial_clearance=None, bearing__clearance_class="C4")
    library["bearing"] |= {"base": "209-hamrock"}
    assert BearingCase.from_dict(library).bearing.radial_clearance == pytest.approx(40.5e-6)


BOTH = {
    "lubricant__temperature__kinematic_viscosity_40": None,
    "lubricant__temperature__kinematic_viscosity_100": None,
}


@each("grade", [46, "46", "VG 46", "ISO VG 46", "iso-vg46", np.int64(46)])
def test_viscosity_grades(grade):
    case = bearing_case(
        BALLS, **BOTH, lubricant__temperature__iso_vg=grade, lubricant__temperature__viscosity_index=100
    )
    oil = case.lubricant.temperature
    assert (oil.iso_vg, oil.at_40()) == (46, 46e-6)
    assert oil.at_100() == pytest.approx(6.77e-6, rel=2e-3)
    assert BearingCase.from_dict(case.to_dict()) == case
    # Either of the two keys can be replaced alone.
    changed_case = case.replace({"lubricant.temperature.kinematic_viscosity_40": "50 mm^2/s"})
    assert changed_case.lubricant.temperature.iso_vg is None
    assert changed_case.lubricant.temperature.viscosity_index == 100.0
    measured = case.replace(
        {"lubricant.temperature.kinematic_viscosity_100": "7 mm^2/s"}
    ).lubricant.temperature
    assert (measured.at_40(), measured.at_100(), measured.viscosity_index) == (46e-6, 7e-6, None)


# Names of units that are read without pint, with every prefix, and compound units of files and forms.
NAMES = [f"{prefix}{name}" for prefix in ("", *units._POWERS) for name in units._PREFIXED]
COMPOUND = [
    *("kN/m", "MN/m", "V/um", "kV/mm", "pS/m", "W/m/K", "J/kg/K", "mm**2/s", "kg/m**3", "g/cm**3", "mPa s"),
    *("Pa s", "ohm m", "ohm m**2", "GJ/m**3", "MJ/m**3/K", "A/mm**2", "kJ/mol", "1/GPa", "1/mm**2", "1/K"),
]


@pytest.mark.slow
@each("written", sorted({*NAMES, *units._PLAIN_NAMES, *COMPOUND} - {"C"}))
def test_units_that_are_read_without_pint_are_those_of_pint(written):
    """Pint is the reference; it rounds products of prefixes. C alone may also be a degree Celsius."""
    quantity = UNITS.Quantity(1.0, written).to_base_units()
    found = units.known_factor(written, units.si_unit(written))
    si = UNITS.Quantity(1.0, units.si_unit(written)).to_base_units()
    assert quantity.dimensionality == si.dimensionality
    assert found == pytest.approx(quantity.magnitude / si.magnitude, rel=1e-15)


@each("written, unit", [("kN", "N/m"), ("1/s", "rad/s"), ("Hz", "rad/s"), ("furlong", "m"), ("", "m")])
def test_units_of_other_quantities_are_left_to_pint(written, unit):
    assert units.known_factor(written, unit) is None
