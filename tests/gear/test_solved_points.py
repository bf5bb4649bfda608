"""Films of gear pairs that are solved with heat and sliding, and the friction losses of the mesh."""

import numpy as np
import pytest

import ehlectric
from tests.gear.pairs import case_of

HEAT = {
    "contacts": "solved",
    "lubricant.heat_capacity_law": "constant",
    "lubricant.heat_capacity": "2000 J/kg/K",
    "lubricant.eyring_stress": "5 MPa",
}


@pytest.fixture(scope="module")
def hot():
    """FZG type C, whose films are solved with heat and sliding."""
    return ehlectric.solve_gear(case_of(operation__load_sharing="rigid").replace(HEAT))


def contact_at(result, place, load):
    """Solved contact at a place of the path of contact [m] under a line load [N/m], from its own case."""
    path, flanks = result.solution.path, result.solution.flanks
    first, second = path.speeds(place, flanks.pinion_speed, flanks.ratio)
    mean = 0.5 * (first + second)
    return ehlectric.solve(
        ehlectric.Case.from_dict(
            {
                "contact": {
                    "geometry": "line",
                    "reduced_radius": path.reduced_radius(place),
                    "reduced_modulus": flanks.modulus,
                    "load_per_length": load,
                    "entrainment_speed": mean,
                    "slide_to_roll_ratio": (first - second) / mean,
                    "temperature": "90 degC",
                    "body_1": {"material": "steel"},
                    "body_2": {"material": "steel"},
                },
                "lubricant": {
                    "base": "fva-3",
                    "heat_capacity": "2000 J/kg/K",
                    "heat_capacity_law": "constant",
                    "eyring_stress": "5 MPa",
                },
                "film": {"thermal": True, "rheology": "eyring"},
                "grid": {"error": "1 %"},
            }
        )
    ).summary()["film"]


def test_the_points_have_the_film_and_friction_of_their_contact(hot):
    for name in ("A", "C", "E"):
        point = hot.summary()["points"][name]
        film = contact_at(hot, point["place"], point["load_per_length"])
        assert point["central_thickness"] == pytest.approx(film["central_thickness"], rel=1e-3)
        assert point["minimum_thickness"] == pytest.approx(film["minimum_thickness"], rel=1e-3)
        assert point["friction"] == pytest.approx(abs(film["traction_coefficient"]), rel=1e-3, abs=1e-6)


def test_pure_rolling_has_no_friction_and_the_heat_of_the_inlet(hot):
    """At the pitch point only the inlet is heated: its factor is known within 2 %."""
    films = hot.solution.point_films
    atlas = ehlectric.solve_gear(hot.case.replace({"contacts": "atlas"})).solution.point_films
    assert films.friction[2] < 1e-5
    assert films.heat_factor[2] == pytest.approx(atlas.heat_factor[2], abs=0.02)


@pytest.mark.slow
def test_the_loss_of_the_films_is_the_sum_over_contacts_along_the_path(hot):
    """Spur gears with rigid load sharing: half of the load outside single contact, and contacts solved one by
    one at 32 places instead of a curve through five.
    """
    solution, path = hot.solution, hot.solution.path
    whole = solution.normal_force / solution.pair.face_width
    edges = np.linspace(path.start, path.end, 33)
    places = 0.5 * (edges[1:] + edges[:-1])
    points = path.points
    power = 0.0
    for place, step in zip(places.tolist(), np.diff(edges).tolist(), strict=True):
        load = whole * (1.0 if points["B"] < place < points["D"] else 0.5)
        slide = abs(path.sliding_speed(place, solution.flanks.pinion_speed, solution.pair.ratio))
        power += abs(contact_at(hot, place, load)["traction_coefficient"]) * load * slide * step
    expected = power * solution.pair.face_width / path.base_pitch
    assert hot.summary()["gear"]["film_loss"] == pytest.approx(expected, rel=0.05)


def test_asperities_that_carry_all_load_have_the_loss_of_their_friction():
    rough = case_of(
        flank_ra="100 um", operation__friction_coefficient=0.12, operation__boundary_friction=0.12
    )
    gear = ehlectric.solve_gear(rough).summary()["gear"]
    assert gear["asperity_loss"] == pytest.approx(gear["loss"], rel=0.02)
    assert gear["film_loss"] is None
    smooth = ehlectric.solve_gear(rough.replace({"gear.flank_ra": "10 nm"})).summary()["gear"]
    assert smooth["asperity_loss"] < 1e-3 * gear["asperity_loss"]


@pytest.mark.parametrize(
    ("changes", "key"),
    [({}, "lubricant.heat_capacity"), ({**HEAT, "gear.material": "aluminium"}, "aluminium")],
)
def test_solved_films_without_a_thermal_property_are_isothermal_and_say_so(changes, key):
    result = ehlectric.solve_gear(case_of().replace({"contacts": "solved", **changes}))
    (text,) = [str(each) for each in result.warnings if each.code == "flank-films-without-heat"]
    assert key in text
    assert result.summary()["gear"]["film_loss"] is None
    assert result.summary()["points"]["A"]["friction"] is None
