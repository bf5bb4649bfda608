"""Values that no machine has are asked about, in contacts and in bearings: factors of 2 and of 1000."""

import pytest

from ehlectric import Case, load, save, solve
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.cases.plausibility import PLAUSIBLE, modulus_of_steel, unusual
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.contact.warnings import case_warnings
from ehlectric.errors import raised
from ehlectric.formulas.hertz import body_compliance, reduced_modulus
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each

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
    assert not list(raised(unusual(key, entry.low)))
    assert not list(raised(unusual(key, entry.high)))
    beyond = [entry.low - 0.01 * abs(entry.low), entry.high * 1.01]
    assert [one.code for value in beyond for one in raised(unusual(key, value))] == ["value-unusual"] * 2


def test_steel_is_no_multiple_of_itself():
    assert not list(raised(modulus_of_steel(226e9)))
    assert not list(raised(modulus_of_steel(70e9)))


@pytest.mark.slow
def test_notes_are_those_of_the_stored_result(tmp_path):
    case = Case.from_dict(
        {"contact": LINE | {"reduced_modulus": 115.4e9}, "lubricant": OIL, "grid": {"nodes": 401}}
    )
    result = solve(case)
    save(result, tmp_path)
    assert "modulus-factor" in {one.code for one in load(tmp_path).warnings}
