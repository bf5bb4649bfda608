"""Bearing files: what is read out of them, and every mistake told in one line."""

import math
import tomllib
from importlib import resources

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.bearing.conditions import Solid
from ehlectric.bearing.loads.geometry import BallBearing, RollerBearing
from ehlectric.bearing.preparation import equilibria_of, resolve_bearing
from ehlectric.bearing.result import check_bearing, solve_bearing
from ehlectric.bearing.solution import lambda_ratio
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.cases import library
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case_oil import Lubricant
from ehlectric.formulas.film_point import hamrock_dowson
from ehlectric.formulas.inlet_supply import inlet_shear_factor
from tests.helpers.bearings import BALLS, OIL, ROLLERS, bearing_case, changed, contact_of, ring_of
from tests.helpers.each import each


def test_temperature_is_absolute():
    """70 degC is 343.15 K, and 343.15 without a unit is the same."""
    for given in ("70 degC", "343.15 K", 343.15):
        assert bearing_case(BALLS, bearing__temperature=given).bearing.temperature == pytest.approx(
            343.15, rel=1e-12, abs=0.0
        )


def test_units_and_defaults():
    case = bearing_case(BALLS)
    bearing = case.bearing
    assert bearing.inner_speed == pytest.approx(3000.0 * 2.0 * math.pi / 60.0, rel=1e-12, abs=0.0)
    assert bearing.radial_clearance == pytest.approx(10e-6, rel=1e-12, abs=0.0)
    assert (bearing.element_material, bearing.ring_material) == ("steel", "steel")
    assert (bearing.fill, bearing.film_factor) == ("oil", "none")
    assert case.lubricant.temperature.expansion == 6.5e-4
    # What is read back in is the same bearing.
    assert BearingCase.from_dict(case.to_dict()) == case


@each("kind", ["balls", "angular", "rollers"])
def test_every_kind_has_its_geometry(kind):
    if kind == "rollers":
        geometry = resolve_bearing(bearing_case(ROLLERS)).geometry
        assert geometry == RollerBearing(14, 11e-3, 60e-3, 10e-3, pytest.approx(20e-6), "logarithmic")
        return
    angle = {"bearing__kind": "angular-contact ball", "bearing__contact_angle": "25 deg"}
    tables = changed(BALLS, **angle, bearing__radial_clearance=None) if kind == "angular" else BALLS
    geometry = resolve_bearing(BearingCase.from_dict(tables)).geometry
    assert isinstance(geometry, BallBearing)
    if kind == "angular":
        assert geometry.free_angle == pytest.approx(math.radians(25.0), rel=1e-9, abs=0.0)
    else:
        # cos a = 1 - P/(2 A), A = (0.52 + 0.52 - 1) D.
        cosine = 1.0 - 10e-6 / (2.0 * 0.04 * 11.906e-3)
        assert geometry.free_angle == pytest.approx(math.acos(cosine), rel=1e-9, abs=0.0)


def test_a_table_without_a_bearing_is_refused():
    with pytest.raises(InputError, match=r"^bearing: missing"):
        bearing_case(BALLS, bearing=None)


ANGULAR = {
    "bearing__kind": "angular-contact ball",
    "bearing__contact_angle": "25 deg",
    "bearing__radial_clearance": None,
}


@each("contacts", ["solved", "formula"])
@each(
    "changes, text",
    [
        (
            {**ANGULAR, "bearing__axial_load": None},
            "bearing.axial_load: got 0 N; expected one above 0: an an",
        ),
        # Semi-axes go with the cube root of the load: 1.44 mm at 876 N, over a fourth of the ball at 10 kN.
        ({"bearing__radial_load": "3 MN"}, "bearing: outer contact at "),
    ],
)
def test_what_a_bearing_cannot_carry_is_said_of_the_bearing(changes, text, contacts):
    """No word of a table ``contact``, which a bearing file has not."""
    with pytest.raises(InputError) as error:
        check_bearing(bearing_case(BALLS, **changes, contacts=contacts))
    assert str(error.value).startswith(text)
    assert "contact:" not in str(error.value)
    assert "\n" not in str(error.value)


def test_the_oil_at_its_temperature():
    """46 and 6.8 mm^2/s give 14.85 at 70 degC, times 838.9 kg/m^3; alpha by Roelands at that viscosity."""
    lubricant = bearing_case(BALLS).lubricant.at(343.15)
    assert lubricant.viscosity == pytest.approx(14.85e-6 * 838.9, rel=5e-4, abs=0.0)
    alpha = 0.67 * (math.log(14.85e-6 * 838.9) + 9.67) / 0.198e9
    assert lubricant.alpha == pytest.approx(alpha, rel=5e-4, abs=0.0)
    # The base's own viscosity and alpha, of another temperature, are gone; its other laws are there.
    assert lubricant.relative_permittivity == 2.4
    assert lubricant.laws["viscosity"] == "roelands"


def test_a_given_alpha_and_a_given_viscosity_stay():
    tables = changed(BALLS, lubricant__pressure_viscosity_coefficient="15 1/GPa")
    assert BearingCase.from_dict(tables).lubricant.at(343.15).alpha == pytest.approx(
        15e-9, rel=1e-12, abs=0.0
    )
    without = bearing_case(BALLS, lubricant__temperature=None, lubricant__viscosity="0.02 Pa s").lubricant
    assert without.at(343.15).viscosity == 0.02
    assert without.at(343.15).alpha == 22e-9
    assert bearing_case(BALLS, lubricant__temperature=None).lubricant.at(343.15).viscosity == 0.04


def test_an_oil_without_constants_of_roelands_needs_its_alpha():
    barus = {
        "base": None,
        "viscosity_law": "barus",
        "density_law": "incompressible",
        "relative_permittivity": 2.4,
    }
    changes = {f"lubricant__{key}": value for key, value in barus.items()}
    with pytest.raises(
        InputError, match=r"lubricant\.pressure_viscosity_coefficient: missing; expected it, or"
    ):
        bearing_case(BALLS, **changes).lubricant.at(343.15)


def test_film_factor_goes_through_the_entrainment_product():
    """Films of Hamrock and Dowson go with (eta0 u)^0.67 but for eta0's part in alpha, which stays."""
    rings = [ring_of(bearing_case(BALLS, bearing__film_factor=f), speed=4.0) for f in ("none", 0.7)]
    assert [ring.conditions.film_factor for ring in rings] == [1.0, 0.7]
    contacts = [contact_of(ring, 500.0).conditions.contact for ring in rings]
    full, less = (hamrock_dowson(contact).central_thickness for contact in contacts)
    assert less / full == pytest.approx(0.7, rel=1e-9, abs=0.0)


def test_inlet_shear_factor_of_a_bearing():
    """Of the speed n pi (d_m^2 - D^2)/(2 d_m) at zero angle, the inner race's against the cage."""
    changes = {
        "bearing__film_factor": "inlet-shear",
        "lubricant__temperature__thermal_conductivity": "0.14 W/m/K",
    }
    case = bearing_case(BALLS, **changes)
    duty = resolve_bearing(case)
    n = 3000.0 / 60.0
    speed = math.pi * n * (0.06**2 - 0.011906**2) / (2.0 * 0.06)
    # -d ln eta/dT of viscosity times density, by a difference over 0.1 K.
    eta = [case.lubricant.at(343.15 + d).viscosity for d in (-0.05, 0.05)]
    factor = inlet_shear_factor(duty.oil.viscosity, math.log(eta[0] / eta[1]) / 0.1, speed, 0.14)
    assert 0.9 < factor < 1.0
    assert duty.film_factor == pytest.approx(factor, rel=2e-4, abs=0.0)


def test_heat_in_the_inlet_is_the_default_where_the_viscosity_follows_the_temperature():
    """The default follows the oil of a changed case; an oil with one viscosity has no heat in the inlet."""
    case = bearing_case(BALLS, bearing__film_factor=None)
    assert case.bearing.film_factor == "inlet-shear"
    constant = case.replace({"lubricant.base": "paper"})
    assert constant.bearing.film_factor == "none"
    assert constant.replace({"lubricant": OIL}).bearing.film_factor == "inlet-shear"
    assert BearingCase.from_dict(case.to_dict()) == case
    # A given factor stays, whatever the oil.
    given = case.replace({"bearing.film_factor": "none"}).replace({"lubricant.base": "fva-3"})
    assert given.bearing.film_factor == "none"
    with pytest.raises(InputError, match=r"lubricant\.viscosity: is one for all temperatures"):
        constant.replace({"bearing.film_factor": "inlet-shear"})


def test_films_say_what_they_are_worth():
    """Best estimates with heat; bounds without, by choice or because the oil says too little."""
    told = {}
    for name, changes in {
        "best": {"bearing__film_factor": None},
        "chosen": {},
        "unknown": {"bearing__film_factor": None, "lubricant": {"base": "paper"}},
        "starved": {"bearing__supply": 0.8},
    }.items():
        solution = solve_bearing(bearing_case(BALLS, contacts="formula", motor=None, **changes)).solution
        (told[name],) = [one for one in bearing_warnings(solution) if one.code.endswith("-film")]
    assert [one.code for one in told.values()] == ["smooth-film", *["isothermal-film"] * 2, "smooth-film"]
    bounds = {name for name, one in told.items() if "upper bound" in one.text}
    assert bounds == {"chosen", "unknown", "starved"}
    assert "best estimate" in told["best"].text
    assert "viscosity at other temperatures is not known" in told["unknown"].text


def test_a_thermal_conductivity_that_is_not_known_is_assumed():
    """0.137 W/(m K), with the factors 1/(1 + 0.241 L^0.64) at 0.12 and 0.16 W/(m K) in the note."""
    case = bearing_case(BALLS, contacts="formula", motor=None, bearing__film_factor=None)
    solution = solve_bearing(case).solution
    factors = [
        resolve_bearing(case.replace({"lubricant.temperature.thermal_conductivity": value})).film_factor
        for value in (0.137, 0.12, 0.16)
    ]
    assert solution.conditions.film_factor == pytest.approx(factors[0], rel=1e-12)
    (note,) = [one for one in bearing_warnings(solution) if one.code == "conductivity-assumed"]
    assert note.severity == "note"
    assert f"{factors[1]:.3g} to {factors[2]:.3g}" in note.text
    # A tenth of the conductivity changes the factor by less than 1 %.
    assert factors[2] / factors[1] == pytest.approx(1.0, abs=0.01)


@each("changes", [
    {"temperature": OIL["temperature"]},
    {"atmospheric_law": "vogel", "vogel_viscosity": "0.1 mPa s", "vogel_b": "800 K", "vogel_c": "170 K",
     "pressure_viscosity_coefficient": "15 1/GPa", "roelands_z": 0.6},
])  # fmt: skip
def test_an_own_viscosity_keeps_the_conductivity_of_the_base(changes):
    """Public models have 0.154 W/(m K) of a polyalphaolefin, which is that of the library's fluid."""
    oil = Lubricant.from_dict({"base": "e-axle-fluid", **changes})
    assert oil.at(343.15).thermal_conductivity == pytest.approx(0.154)


@each("kind", ["solid", "bearing", "coating"])
def test_library_says_where_its_numbers_are_from(kind):
    names = getattr(library, f"{kind}_names")()
    assert names
    for name in names:
        folder = resources.files("ehlectric.cases.library") / f"{kind}s"
        table = tomllib.loads((folder / f"{name}.toml").read_text(encoding="utf-8"))
        assert {"source", kind} <= set(table) <= {"source", kind, "rating", "title", "needs"}
        sources = table["source"] if isinstance(table["source"], list) else [table["source"]]
        assert all(len(source.get("citation") or source["note"]) > 20 for source in sources)


@each("name", library.bearing_names())
def test_library_bearings_carry_a_load(name):
    changes = {"base": name, "radial_load": "500 N", "inner_speed": "1000 rpm", "temperature": "40 degC"}
    others = {
        "deep-groove ball": {"radial_clearance": "15 um"},
        "angular-contact ball": {"axial_load": "500 N"},
        "cylindrical roller": {"radial_clearance": "15 um", "profile": "logarithmic"},
    }
    bearing = changes | {"composite_rq": "0.1 um"} | others[library.bearing(name)["kind"]]
    case = BearingCase.from_dict({"bearing": bearing, "lubricant": BALLS["lubricant"]})
    at = equilibria_of(resolve_bearing(case), 1)[0]
    # Vertical balance of the ring.
    angle = getattr(at, "inner_angle", 0.0)  # rollers have none
    vertical = (at.inner_load * np.cos(angle)) @ np.cos(at.position)
    assert vertical == pytest.approx(500.0, rel=1e-6, abs=0.0)
    # What a file gives stands before what the library has.
    assert BearingCase.from_dict(
        {"bearing": bearing | {"elements": 7}, "lubricant": BALLS["lubricant"]}
    ).bearing.elements == 7  # fmt: skip


def test_ball_bearing_6208_of_the_library_has_its_balls_on_its_pitch_circle():
    """Bore 40 mm and outside diameter 80 mm of ISO 15: the pitch circle is in the middle of them."""
    table = library.bearing("6208")
    assert table["pitch_diameter"] == "60 mm" == f"{(40 + 80) // 2} mm"


@each("name", library.solid_names())
def test_library_solids(name):
    """Materials of a bearing and around it; E between those of aluminium and tungsten carbide."""
    solid = Solid.of(name)
    assert 70e9 <= solid.youngs_modulus < 700e9
    assert 0.2 < solid.poissons_ratio < 0.35
    assert 2e3 < solid.density < 2e4
    assert solid.conducting == (name != "silicon-nitride")
    assert solid.compliance == pytest.approx(
        (1.0 - solid.poissons_ratio**2) / solid.youngs_modulus, rel=1e-12
    )


def over_temperature(*temperatures):
    """A strength from 20 to 10 V/um over two temperatures, and no other."""
    table = {"temperature": list(temperatures), "strength": ["20 V/um", "10 V/um"]}
    return {"discharge__dielectric_strength": None, "discharge__strength_table": table}


def test_a_strength_over_temperature_is_that_of_the_bearing():
    """Linear from 20 V/um at 20 degC to 10 at 120 degC: 15 at 70 degC; swept with bearing.temperature."""
    case = bearing_case(BALLS, contacts="formula", **over_temperature("20 degC", "120 degC"))
    assert BearingCase.from_dict(case.to_dict()) == case
    for celsius, strength in ((70.0, 15e6), (45.0, 17.5e6)):
        at = case.replace({"bearing.temperature": 273.15 + celsius})
        found = solve_bearing(at).solution.inner_curve.solutions[-1].values
        expected = strength * found.minimum_thickness
        assert found.breakdown_voltage == pytest.approx(expected, rel=1e-9, abs=0.0)


def test_a_strength_does_not_reach_beyond_its_temperatures():
    case = bearing_case(BALLS, contacts="formula", **over_temperature("20 degC", "60 degC"))
    line = (
        r"^bearing\.temperature: got 343\.15 K; expected one within the strength_table, 293\.15 to 333\.15 K$"
    )
    for refused in (check_bearing, solve_bearing):
        with pytest.raises(InputError, match=line):
            refused(case)


def test_a_given_viscosity_knows_no_temperature():
    """Warned of, since films at any bearing.temperature are the same."""
    given = {"lubricant__temperature": None, "lubricant__viscosity": "20 mPa s", "contacts": "formula"}
    results = [
        solve_bearing(bearing_case(BALLS, bearing__temperature=at, **given)) for at in ("70 degC", "20 degC")
    ]
    assert lambda_ratio(results[0].solution) == lambda_ratio(results[1].solution)
    for result in results:
        assert any("lubricant.viscosity is given" in text for text in map(str, result.warnings))
    over = solve_bearing(bearing_case(BALLS, contacts="formula"))
    assert not any("lubricant.viscosity" in text for text in map(str, over.warnings))


def test_ball_bearing_6205_of_the_library_has_the_published_frequencies():
    """Printed by the Bearing Data Center for one turn of the shaft, with the outer ring at rest: 5.4152 ball
    passes at the inner ring, 3.5848 at the outer ring, 0.39828 turns of the cage; contact angle 0."""
    table = library.bearing("6205")
    inches = [float(table[name].removesuffix(" inch")) for name in ("element_diameter", "pitch_diameter")]
    ratio = inches[0] / inches[1]
    assert 0.5 * table["elements"] * (1.0 + ratio) == pytest.approx(5.4152, rel=0.0, abs=1e-4)
    assert 0.5 * table["elements"] * (1.0 - ratio) == pytest.approx(3.5848, rel=0.0, abs=1e-4)
    assert 0.5 * (1.0 - ratio) == pytest.approx(0.39828, rel=0.0, abs=5e-5)


def test_replace_takes_tables_by_keyword_as_a_contact_does():
    case = bearing_case(BALLS, contacts="formula")
    by_key = case.replace({"bearing.radial_load": "1 kN", "bearing.temperature": "60 degC", "title": "A"})
    assert case.replace(bearing={"radial_load": "1 kN", "temperature": "60 degC"}, title="A") == by_key
    # A dotted key wins, and ranges have dotted keys of their own.
    ranges = {"bearing.radial_load": ["1 kN", "3 kN"]}
    mixed = case.replace({"bearing.radial_load": "2 kN"}, bearing={"radial_load": "1 kN"}, ranges=ranges)
    assert mixed.bearing.radial_load == 2000.0
    assert [(one.key, one.low, one.high) for one in mixed.ranges] == [("bearing.radial_load", 1e3, 3e3)]


def test_another_base_brings_its_dimensions():
    """Balls of 7.94 mm on 39.04 mm, as the library has them, and not those of the 6208 under a new name."""
    duty = {"radial_clearance": "10 um", "radial_load": "1 kN", "inner_speed": "3000 rpm"}
    duty |= {"temperature": "70 degC", "composite_rq": "0.03 um", "inner_groove": 0.515}
    tables = {"lubricant": {"base": "paper", "viscosity": "20 mPa s"}}
    case = BearingCase.from_dict({"bearing": {"base": "6208"} | duty, **tables})
    small = case.replace({"bearing.base": "6205"})
    assert small.bearing.element_diameter == pytest.approx(0.3126 * 25.4e-3, rel=1e-3)
    assert small.bearing.pitch_diameter == pytest.approx(1.537 * 25.4e-3, rel=1e-3)
    del duty["inner_groove"]
    assert small == BearingCase.from_dict({"bearing": {"base": "6205"} | duty, **tables})
    given = case.replace({"bearing.base": "6205", "bearing.inner_groove": 0.51})
    assert given.bearing.inner_groove == 0.51
