"""Mistakes in cases: names that mean another key, one mistake of a drive, and doubtful values in Python."""

import re
import tomllib

import pytest

from ehlectric import AxleCase, Case, DriveCase, GearCase, InputError, Sweep
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.table import nearest_key, similar_keys
from ehlectric.quantities.inputs import aliases
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

CONTACT = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "max_hertz_pressure": "1 GPa"}
CONTACT |= {"entrainment_speed": "4 m/s", "lubricant": "paper"}


@pytest.mark.slow
def test_every_alias_leads_to_keys_that_exist():
    """A key whose name changes would otherwise stay in messages; an alias that became a key is none."""
    for name, keys in aliases().items():
        kinds = (Case, BearingCase, DriveCase, GearCase, AxleCase, Sweep)
        hints = [nearest_key(name, model) for model in kinds]
        hints += similar_keys(name, [f"vary.{key}" for key in ("from", "to", "count", "spacing")])
        for key in keys:
            assert any(key in hint for hint in hints), (name, key)


POINT = {"contact": {"geometry": "point"}}


@each(
    "model, given, name, key",
    [
        (Case, POINT, "electric.voltage", "electric.potential_1"),
        (Case, POINT, "voltage", "electric.potential_1"),
        (Case, POINT, "rpm", "contact.entrainment_speed"),
        (Case, POINT, "speed", "contact.entrainment_speed"),
        (Case, POINT, "contact.fn", "contact.load"),
        (Case, POINT, "contact.ph", "contact.max_hertz_pressure"),
        (Case, POINT, "contact.temp", "contact.temperature"),
        (Case, POINT, "contact.radius_across", "contact.radius_y"),
        (Case, POINT, "contact.composite_ra", "meter.ra"),
        (Case, POINT, "contact.composite_rq", "meter.rq"),
        (Case, POINT, "meter.composite_ra", "meter.ra"),
        (Case, POINT, "composite_ra", "meter.ra"),
        (Case, POINT, "lubricant.eta0", "lubricant.viscosity"),
        (Case, POINT, "lubricant.alpha_star", "lubricant.pressure_viscosity_coefficient"),
        (Case, POINT, "lubricant.dielectric_constant", "lubricant.relative_permittivity"),
        (Case, POINT, "lubricant.viscosity_1", "lubricant.temperature.dynamic_viscosity_1"),
        (Case, POINT, "lubricant.viscosity_40", "lubricant.temperature.kinematic_viscosity_40"),
        (Case, POINT, "lubricant.vi", "lubricant.temperature.viscosity_index"),
        (Case, POINT, "lubricant.rho", "lubricant.density"),
        (Case, POINT, "lubricant.cp", "lubricant.heat_capacity"),
        (Case, POINT, "oil", "lubricant.base"),
        (Case, POINT, "discharge.breakdown_field", "discharge.dielectric_strength"),
        (Case, POINT, "grid.nx", "grid.nodes"),
        (BearingCase, {}, "bearing.ra", "bearing.composite_ra"),
        (BearingCase, {}, "bearing.rq", "bearing.composite_rq"),
        (BearingCase, {}, "bearing.Fr", "bearing.radial_load"),
        (BearingCase, {}, "bearing.Fa", "bearing.axial_load"),
        (BearingCase, {}, "bearing.preload", "bearing.axial_load"),
        (BearingCase, {}, "bearing.n", "bearing.inner_speed"),
        (BearingCase, {}, "bearing.temp", "bearing.temperature"),
        (BearingCase, {}, "bearing.z", "bearing.elements"),
        (BearingCase, {}, "bearing.d", "bearing.bore"),
        (BearingCase, {}, "bearing.dw", "bearing.element_diameter"),
        (BearingCase, {}, "bearing.alpha", "bearing.contact_angle"),
        (BearingCase, {}, "bearing.c0", "bearing.life.static_rating"),
        (BearingCase, {}, "bearing.voltage", "motor.common_mode_voltage"),
        (BearingCase, {}, "speed", "bearing.inner_speed"),
        (BearingCase, {}, "oil", "lubricant.base"),
        (DriveCase, {}, "drive.n", "drive.speed"),
        (DriveCase, {}, "source.u_dc", "source.dc_link"),
        (DriveCase, {}, "source.pwm_frequency", "source.switching_frequency"),
        (DriveCase, {}, "motor.c_wr", "circuit.winding_rotor_capacitance"),
        (DriveCase, {}, "circuit.cwr", "circuit.winding_rotor_capacitance"),
        (DriveCase, {}, "remedies.name", "remedies.title"),
        (DriveCase, {}, "remedies.set", "remedies.changes"),
        (DriveCase, {}, "variants", "remedies"),
        (BearingCase, {}, "duty.path", "duty.file"),
        (BearingCase, {}, "duty_cycle", "duty.file"),
        (DriveCase, {}, "cycle", "duty.file"),
        (Sweep, {}, "variables", "vary"),
        (Sweep, {}, "method", "design"),
        (Sweep, {}, "base", "case"),
        (DriveCase, {}, "drive_end.bearing.ra", "drive_end.bearing.composite_ra"),
    ],
)
def test_the_hint_for_a_name_of_practice_is_the_key(model, given, name, key):
    assert key in re.split(", | or ", nearest_key(name, model, given))


SPEEDS = {"from": "1 m/s", "to": "2 m/s", "count": 2}


@each(
    "name, replaced, key",
    [
        ("start", "from", "from"), ("min", "from", "from"), ("stop", "to", "to"), ("max", "to", "to"),
        ("n", "count", "count"), ("points", "count", "count"), ("spacin", "", "spacing"), ("colour", "", ""),
        ("list", "", ""),
    ],
)  # fmt: skip
def test_hints_in_the_range_of_a_sweep(name, replaced, key):
    """The nearest of four names was proposed whatever the name, as "from" for "max"."""
    speeds = {one: value for one, value in SPEEDS.items() if one != replaced} | {name: 2}
    contact = {one: value for one, value in CONTACT.items() if one != "lubricant"}
    case = Case.from_dict({"contact": contact, "lubricant": "paper"})
    with pytest.raises(InputError) as refused:
        Sweep.from_dict({"case": case, "vary": {"contact.entrainment_speed": speeds}})
    nearest = f"the nearest known one is contact.entrainment_speed.{key}"
    hint = nearest if key else "no known key has a similar name"
    assert str(refused.value) == f"vary.contact.entrainment_speed.{name}: unknown key; {hint}"


def test_hints_in_the_sweep_of_a_drive_are_keys_of_both_bearings():
    case = DriveCase.from_toml(EXAMPLES / "drive.toml")
    with pytest.raises(InputError, match=r"bearings\.bearing\.radial_load or bearings\.bearing\.axial_load$"):
        Sweep.from_dict({"case": case, "vary": {"bearing.load": ["1 kN", "2 kN"]}})


@each(
    "table, name",
    [
        ({}, "film_thickness"),
        ({"contact": {"film_thickness": 1e-7}}, "contact.film_thickness"),
        ({"contact": {"capacitance": 1e-12}}, "contact.capacitance"),
        ({"discharge": {"breakdown_voltage": 3.0}}, "discharge.breakdown_voltage"),
    ],
)
def test_a_result_that_is_given_as_an_input_is_named(table, name):
    contact = {key: value for key, value in CONTACT.items() if key != "lubricant"}
    case = {"contact": contact, "lubricant": "paper"}
    given = case | {"film_thickness": 1e-7} if not table else case | table
    with pytest.raises(InputError, match=r"unknown key; the .* is computed") as refused:
        Case.from_dict(given)
    assert name in str(refused.value)


@each(
    "model, name",
    [
        (Case, "contact.colour"), (Case, "lubricant.price"), (Case, "quux"), (BearingCase, "bearing.ip"),
        (BearingCase, "bearing.oilpump"), (DriveCase, "drive.torque"), (DriveCase, "motor.frame"),
    ],
)  # fmt: skip
def test_a_name_that_resembles_no_key_has_no_hint(model, name):
    assert nearest_key(name, model) == ""
    with pytest.raises(InputError, match=r"unknown key; no known key has a similar name"):
        raise InputError.unknown(name, nearest_key(name, model))


@pytest.mark.parametrize(
    ("changes", "key", "number"),
    [
        ({"reduced_radius": "14.1 m"}, "contact.reduced_radius", "14.1 m"),
        ({"reduced_modulus": "226 MPa"}, "reduced modulus", "226 MPa"),
    ],
)
def test_a_doubtful_unit_is_a_warning_in_python(changes, key, number):
    with pytest.warns(UserWarning, match=key) as told:
        Case.line(**CONTACT | changes)
    assert number in str(told[0].message)
    # The warning names the line of the user.
    assert told[0].filename == __file__


def test_a_usual_contact_has_no_doubts():
    Case.line(**CONTACT)


def test_one_mistake_of_a_drive_is_told_once():
    """The bearing of the drive end stands at both ends, so that its mistake was that of both."""
    table = tomllib.loads((EXAMPLES / "drive.toml").read_text(encoding="utf-8"))
    table["drive_end"] = tomllib.loads((EXAMPLES / "bearing_thin_oil.toml").read_text(encoding="utf-8"))
    table["drive_end"]["contacts"] = "solvd"
    with pytest.raises(InputError) as told:
        DriveCase.from_dict(table)
    assert told.value.key == "drive_end.contacts"
    assert told.value.several == ()


@pytest.mark.parametrize("table", ["", "bearing."])
def test_many_unknown_keys_are_refused_without_a_search_for_each(monkeypatch, table):
    """The first hundred are named, with the number of all."""
    monkeypatch.setattr("ehlectric.cases.table.nearest_key", None)
    unknown = {f"a{number}": 1 for number in range(5000)}
    tables = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").to_dict()
    tables = tables | unknown if not table else tables | {"bearing": tables["bearing"] | unknown}
    with pytest.raises(InputError) as caught:
        BearingCase.from_dict(tables)
    text = str(caught.value)
    assert text.startswith(
        f"{table}a0: unknown key, one of 5000 in this file; the next are {table}a1, {table}a2, "
    )
    assert f"{table}a99" in text
    assert f"{table}a100" not in text


def test_all_wrong_keys_of_a_table_of_keys_are_named():
    """Ranges, varied keys and shared keys of bearings are no fields, and each is checked by itself."""
    tables = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").to_dict()
    wrong = {"bearing.radial_lode": ["1 kN", "2 kN"], "bearing.sped": ["1 rpm", "2 rpm"]}
    with pytest.raises(InputError, match=r"^ranges\.bearing\.radial_lode: .*also ranges\.bearing\.sped: "):
        BearingCase.from_dict(tables | {"ranges": wrong})
    with pytest.raises(InputError, match=r"^vary\.bearing\.radial_lode: .*also vary\.bearing\.sped: "):
        Sweep.from_dict({"case": BearingCase.from_dict(tables), "vary": wrong})
    axle = AxleCase.from_toml(EXAMPLES / "e_axle.toml").to_dict()
    with pytest.raises(InputError, match=r"^bearings\.ballz: .*also bearings\.clearence: "):
        AxleCase.from_dict(axle | {"bearings": {"ballz": 3, "clearence": "CN"}})
