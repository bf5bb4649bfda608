"""What a case says of its discharge: alternatives, bounds, temperatures, messages, replacement, files."""

import pytest

from ehlectric import Case, InputError
from ehlectric.quantities.units import to_si
from tests.cases.test_point_case import table as point_table
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each

LINE = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}}
WEIBULL = {"scale": "30 V/um", "shape": 8.0, "reference_area": "1 mm**2"}
PRESSURES = {"pressure": ["0 GPa", "1 GPa"], "strength": ["15 V/um", "25 V/um"]}
TEMPERATURES = {"temperature": ["20 degC", "343.15 K"], "strength": ["15 V/um", "10 V/um"]}
PIT = {"efficiency": "20 %", "melting_energy": "10 GJ/m^3"}


def line(**discharge):
    return Case.from_dict(LINE | {"discharge": discharge})


def point(**discharge):
    return Case.from_dict(point_table(discharge=discharge))


def test_nothing_is_assumed_of_a_material():
    assert Case.from_dict(LINE).discharge is None
    given = line().discharge.model_dump(exclude_none=True)
    assert given == {"outlet": "full"}


def test_units():
    given = line(
        weibull=WEIBULL, conductivity="1 pS/m", external_capacitance="1 nF", length="10 mm",
        peak_current="300 mA", pit=PIT, outlet="layers",
    ).discharge  # fmt: skip
    assert (given.weibull.scale, given.weibull.shape, given.weibull.reference_area) == (30e6, 8.0, 1e-6)
    assert (given.conductivity, given.external_capacitance, given.length) == (1e-12, 1e-9, 0.01)
    assert (given.peak_current, given.pit.efficiency, given.pit.melting_energy) == (0.3, 0.2, 1e10)
    assert line(dielectric_strength="15 V/um").discharge.dielectric_strength == 15e6
    assert line(dielectric_strength="15 kV/mm").discharge.dielectric_strength == 15e6


@each(
    "text, kelvin",
    [
        ("70 degC", 343.15),
        ("70 °C", 343.15),
        ("343.15 K", 343.15),
        ("-20.5 degC", 252.65),
        ("0 degC", 273.15),
        ("1e2 degC", 373.15),
    ],
)
def test_temperatures_are_absolute(text, kelvin):
    """0 degC is 273.15 K by definition; no difference of temperatures is meant."""
    assert to_si(text, "K") == kelvin
    tempered = line(strength_table=TEMPERATURES | {"temperature": ["200 K", "400 K"]}, temperature=text)
    assert tempered.discharge.temperature == kelvin


def test_a_point_contact_knows_its_area():
    assert point(weibull=WEIBULL, external_capacitance=0, peak_current=1, pit=PIT).discharge.length is None


GIVEN = [
    {},
    {"dielectric_strength": "15 V/um", "conductivity": "1 pS/m"},
    {"strength_table": PRESSURES},
    {"strength_table": TEMPERATURES, "temperature": "70 degC", "outlet": "fingers"},
    {"weibull": WEIBULL, "length": "10 mm", "external_capacitance": 0, "pit": PIT, "peak_current": 2},
]


@each("discharge", GIVEN)
def test_round_trip(discharge, tmp_path):
    case = line(**discharge)
    path = tmp_path / "case.toml"
    path.write_text(case.to_toml(), encoding="utf-8")
    assert Case.from_toml(path) == case == Case.from_dict(case.to_dict()) == case.replace()
    assert case.discharge is not None


def strengths_of(case):
    names = ("dielectric_strength", "strength_table", "temperature", "weibull")
    return {name for name in names if getattr(case.discharge, name) is not None}


@each("old", GIVEN)
@each(
    "changes, left",
    [
        ({"discharge.dielectric_strength": "20 V/um"}, {"dielectric_strength"}),
        ({"discharge": {"strength_table": PRESSURES}}, {"strength_table"}),
        (
            {"discharge": {"strength_table": TEMPERATURES, "temperature": 300}},
            {"strength_table", "temperature"},
        ),
        ({"discharge": {"weibull": WEIBULL, "length": "5 mm"}}, {"weibull"}),
    ],
)  # fmt: skip
def test_a_new_strength_displaces_the_old_one(old, changes, left):
    dotted = {key: value for key, value in changes.items() if "." in key}
    tables = {key: value for key, value in changes.items() if "." not in key}
    changed = line(**old, **({} if "length" in old else {"length": 0.01})).replace(dotted, **tables)
    assert strengths_of(changed) == left
    assert changed.discharge.conductivity == line(**old).discharge.conductivity
    table = changed.discharge.strength_table
    assert table is None or (table.pressure is None) == ("temperature" in left)


def test_keys_within_a_strength_change_it_alone():
    case = line(weibull=WEIBULL, length=0.01).replace({"discharge.weibull.shape": 3})
    assert (case.discharge.weibull.shape, case.discharge.weibull.scale) == (3.0, 30e6)
    case = line(strength_table=TEMPERATURES, temperature="70 degC").replace({"discharge.temperature": 300})
    assert (case.discharge.temperature, case.discharge.strength_table.strength) == (300.0, (15e6, 10e6))
    assert strengths_of(line(dielectric_strength=1e7).replace({"discharge.outlet": "layers"})) == {
        "dielectric_strength"
    }
    with pytest.raises(InputError, match=r"dielectric_strength and weibull together"):
        line().replace({"discharge.dielectric_strength": 1e7}, discharge={"weibull": WEIBULL})


def test_another_geometry_drops_the_length():
    case = line(dielectric_strength=1e7, length=0.01, external_capacitance=1e-9)
    contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": 20}
    ball = case.replace(contact=contact)
    assert ball.discharge.length is None
    assert (ball.discharge.dielectric_strength, ball.discharge.external_capacitance) == (1e7, 1e-9)
    with pytest.raises(InputError, match=r"discharge\.length: missing; external_capacitance needs it"):
        ball.replace(contact=PAPER_CONTACT | {"geometry": "line"})
    assert Case.from_dict(LINE).replace(contact=contact).discharge is None
