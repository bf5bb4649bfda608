"""Values that no machine has are asked about, in contacts and in bearings: factors of 2 and of 1000."""

import pytest

from ehlectric import BearingCase, Case, DriveCase, load, save, solve
from ehlectric.bearing.warnings import bearing_warnings, input_warning_conditions
from ehlectric.cases.plausibility import PLAUSIBLE, modulus_of_steel, unusual, unusual_machine
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.contact.warnings import case_warnings
from ehlectric.drive.warnings import machine_warnings
from ehlectric.formulas.capacitances import Machine, machine_capacitances
from ehlectric.formulas.hertz import body_compliance, reduced_modulus
from ehlectric.quantities.result_warnings import active
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

NAMES = ("winding_rotor", "rotor_frame", "winding_frame")
LINE = {"reduced_radius": "8 mm", "reduced_modulus": "226 GPa", "load_per_length": "300 kN/m"}
LINE |= {"entrainment_speed": "2 m/s"}
OIL = {"base": "paper"}
BARUS = {"viscosity_law": "barus", "pressure_viscosity_coefficient": "22 1/GPa"}
MPA = {"viscosity": 46.0, **BARUS, "density_law": "incompressible", "relative_permittivity": 2.2}


def told(contact=None, oil=None, **tables):
    """Warnings of plausibility of a contact by code."""
    case = Case.from_dict({"contact": LINE | (contact or {}), "lubricant": oil or OIL, **tables})
    conditions = (resolve if case.contact.geometry == "line" else resolve_point)(case)
    codes = ("radius-large", "modulus-low", "modulus-factor", "value-unusual", "temperature-extreme")
    return {one.code: one.text for one in case_warnings(case, conditions) if one.code in codes}


@each(
    "contact, oil, code, words",
    [
        ({}, None, "", ()),
        # 2/E' = 2 (1 - 0.09)/210 GPa gives E' = 230.8 GPa, of which E* is half.
        ({"reduced_modulus": "115.4 GPa"}, None, "modulus-factor", ("115.4 GPa", "half", "glass")),
        ({"reduced_modulus": "461.5 GPa"}, None, "modulus-factor", ("461.5 GPa", "twice")),
        ({"reduced_modulus": 226e6, "load_per_length": "300 N/m"}, None, "modulus-low", ("226 MPa",)),
        ({}, MPA, "value-unusual", ("46 Pa s", "10 Pa s", "mPa s")),
        ({}, MPA | {"viscosity": "46 uPa s"}, "value-unusual", ("4.6e-05 Pa s",)),
        ({"entrainment_speed": "0.5 um/s"}, None, "value-unusual", ("m/s", "rotational")),
        ({"entrainment_speed": "3000 m/s"}, None, "value-unusual", ("3000 m/s", "rotational")),
        ({"load_per_length": "3 N/m"}, None, "value-unusual", ("MPa", "load")),
        (
            {"reduced_radius": "8 um", "load_per_length": "300 N/m"},
            None,
            "value-unusual",
            ("8e-06 m", "radii"),
        ),
        ({"reduced_radius": 8.0}, None, "radius-large", ("8 m",)),
        ({"temperature": "343 degC"}, None, "temperature-extreme", ("343 °C",)),
        ({}, MPA | {"viscosity": 0.046, "relative_permittivity": 220.0}, "value-unusual", ("220", "oil")),
    ],
)
def test_contacts(contact, oil, code, words):
    found = told(contact, oil)
    assert list(found) == ([code] if code else [])
    assert [word for word in words if word not in found[code]] == []


def test_glass_on_steel_by_its_moduli_is_not_doubted():
    """E' of glass on steel is 117 GPa, near the E* of steel on steel; both moduli contain no factor."""
    glass, steel = body_compliance(75e9, 0.22), body_compliance(206e9, 0.3)
    assert 104e9 < reduced_modulus(glass, steel) < 118.5e9
    bodies = {
        "body_1": {"youngs_modulus": "75 GPa", "poissons_ratio": 0.22},
        "body_2": {"youngs_modulus": "206 GPa", "poissons_ratio": 0.3},
    }
    contact = {key: value for key, value in LINE.items() if key != "reduced_modulus"} | bodies
    case = Case.from_dict({"contact": contact, "lubricant": OIL})
    assert "modulus-factor" not in {one.code for one in case_warnings(case, resolve(case))}


AIR_AND_PAPER = {"permittivity": 1.0, "liner_permittivity": 3.5}
LARGE = {"length": 1.0, "bore": 1.0, "gap": 1.5e-3, "slots": 72, "opening": 0.011, "depth": 2e-3}
LARGE |= {"liner_width": 0.3, "liner": 1e-3}
SMALL = {"length": 0.01, "bore": 0.015, "gap": 3e-4, "slots": 6, "opening": 1e-3, "depth": 5e-4}
SMALL |= {"liner_width": 5e-3, "liner": 2e-4}


@each("sizes, factor", [(LARGE, 1e3), (SMALL, 1e-3)])
def test_capacitances_of_machines_are_not_doubted(sizes, factor):
    found = machine_capacitances(Machine(**AIR_AND_PAPER, **sizes))
    values = {f"circuit.{name}_capacitance": getattr(found, name) for name in NAMES}
    assert list(active(unusual_machine(values))) == []
    # A wrong prefix of a unit is a factor of 1000.
    assert len(list(active(unusual_machine({key: factor * value for key, value in values.items()})))) == 3


@each(
    "key, value, words",
    [
        ("motor.winding_rotor_capacitance", "40 nF", ("40 nF", "0.1 pF to 10 nF", "slot openings")),
        ("motor.rotor_frame_capacitance", "1 uF", ("1 µF", "5 pF to 50 nF", "air gaps")),
        ("motor.common_mode_voltage", "300 kV", ("300 kV", "100 mV to 10 kV", "medium voltage")),
    ],
)
def test_motors(key, value, words):
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    assert "machine-unusual" not in {one.code for one in active(input_warning_conditions(case, 0.01))}
    changed = case.replace({key: value})
    (found,) = [
        one for one in active(input_warning_conditions(changed, 0.01)) if one.code == "machine-unusual"
    ]
    assert [word for word in (key, *words) if word not in found.text.replace("\xa0", " ")] == []


@each(
    "key, value",
    [
        ("circuit.winding_rotor_capacitance", "40 nF"),
        ("circuit.winding_frame_capacitance", "5 fF"),
        ("source.dc_link", "560 kV"),
        ("breakdown.arc_resistance", "10 kohm"),
    ],
)
def test_drives(key, value):
    case = DriveCase.from_toml(EXAMPLES / "drive.toml")
    found = [one for one in machine_warnings(case.replace({key: value}), ()) if one.code == "machine-unusual"]
    assert [one.text.partition(" is ")[0] for one in found] == [key]
    assert "machine-unusual" not in {one.code for one in machine_warnings(case, ())}


def test_python_warns_where_the_case_is_made():
    with pytest.warns(UserWarning, match="half of the 226 GPa"):
        Case.line(**LINE | {"reduced_modulus": "115.4 GPa"}, lubricant="paper")


def test_strength_and_roughness():
    table = {"discharge": {"dielectric_strength": "15 V/mm"}}
    assert "15" in told(**table)["value-unusual"]
    rough = {"surface": 1, "generator": "gaussian", "rq": "50 um", "correlation_length": "100 um"}
    rough |= {"seed": 1}
    assert "50 µm" in told(roughness=[rough])["value-unusual"]


@each(
    "changes, word",
    [
        ({}, ""),
        ({"bearing__composite_rq": "30 um"}, "30 µm"),
        ({"discharge__dielectric_strength": "15 V/mm"}, "V/µm"),
        ({"bearing__radial_clearance": "0.7 mm"}, "700 µm"),
        # 9 balls of 5.953 mm, the radius of those of a 6208, fill 9 * 5.953/(60 pi) = 0.284 of the circle.
        ({"bearing__element_diameter": "5.953 mm"}, "0.2842"),
    ],
)
def test_bearings(changes, word):
    from ehlectric.bearing.result import solve_bearing

    case = bearing_case(BALLS, **changes).replace({"contacts": "formula"})
    texts = [
        one.text
        for one in bearing_warnings(solve_bearing(case, workers=1).solution)
        if one.code == "value-unusual"
    ]
    assert len(texts) == bool(word)
    assert all(word in text for text in texts)


@each("key", list(PLAUSIBLE))
def test_limits_are_allowed_and_values_beyond_are_not(key):
    entry = PLAUSIBLE[key]
    assert not list(active(unusual(key, entry.low)))
    assert not list(active(unusual(key, entry.high)))
    beyond = [entry.low - 0.01 * abs(entry.low), entry.high * 1.01]
    assert [one.code for value in beyond for one in active(unusual(key, value))] == ["value-unusual"] * 2


def test_steel_is_no_multiple_of_itself():
    assert not list(active(modulus_of_steel(226e9)))
    assert not list(active(modulus_of_steel(70e9)))


@pytest.mark.slow
def test_notes_are_those_of_the_stored_result(tmp_path):
    case = Case.from_dict(
        {"contact": LINE | {"reduced_modulus": 115.4e9}, "lubricant": OIL, "grid": {"nodes": 401}}
    )
    result = solve(case)
    save(result, tmp_path)
    assert "modulus-factor" in {one.code for one in load(tmp_path).warnings}
