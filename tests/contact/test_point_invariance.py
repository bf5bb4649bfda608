"""What must not change of a point contact: its groups, its mirror image, the half that is solved for."""

import dataclasses
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric import Case, solve
from ehlectric.contact.conditions import resolve_point
from ehlectric.contact.problems import point_film_problem
from ehlectric.film.isothermal_film import solve_point_film
from tests.cases.test_point_case import point
from tests.contact.test_line_invariance import LUBRICANT

CONTACT = {
    "geometry": "point",
    "radius_x": 10e-3,
    "radius_y": 20e-3,
    "reduced_modulus": 226e9,
    "load": 30.0,
    "entrainment_speed": 2.0,
}
factor = st.floats(0.25, 4.0)


def scaled(*, radius=1.0, modulus=1.0, load=1.0, viscosity=1.0):
    """A contact of the same M, L and ratio, and of the same laws over p/p_h.

    ``load`` multiplies W = F/(E' Rx^2). M = W U^(-3/4) then asks for U = eta0 u_s/(E' Rx) times its power
    4/3; p_h goes with E' W^(1/3), and every pressure of the lubricant with it.
    """
    pressure = modulus * load ** (1 / 3)
    contact = CONTACT | {
        "radius_x": radius * CONTACT["radius_x"],
        "radius_y": radius * CONTACT["radius_y"],
        "reduced_modulus": modulus * CONTACT["reduced_modulus"],
        "load": load * modulus * radius**2 * CONTACT["load"],
        "entrainment_speed": load ** (4 / 3) * modulus * radius / viscosity * CONTACT["entrainment_speed"],
    }
    lubricant = LUBRICANT | {
        name: pressure * LUBRICANT[name] for name in ("roelands_pressure", "density_c1", "ambient_pressure")
    }
    lubricant["viscosity"] *= viscosity
    lubricant["pressure_viscosity_coefficient"] /= pressure
    return Case.from_dict({"contact": contact, "lubricant": lubricant, "grid": {"nodes": 65}})


def film_of(case):
    """P and H, and the groups they depend on."""
    conditions = resolve_point(case)
    film = solve_point_film(point_film_problem(case, conditions))
    groups = conditions.contact.moes_m, conditions.contact.moes_l, conditions.ratio
    return film.pressure / conditions.max_pressure, film.thickness / conditions.thickness_scale, groups


@cache  # no fixture: hypothesis would write it out
def unscaled():
    return film_of(scaled())


@pytest.mark.slow
@settings(deadline=None, max_examples=3)
@given(radius=factor, modulus=factor, load=factor, viscosity=factor)
def test_the_film_depends_on_m_l_and_the_ratio_alone(radius, modulus, load, viscosity):
    pressure, thickness, groups = film_of(
        scaled(radius=radius, modulus=modulus, load=load, viscosity=viscosity)
    )
    assert groups == pytest.approx(unscaled()[2], rel=1e-12, abs=0.0)
    np.testing.assert_allclose(pressure, unscaled()[0], rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(thickness, unscaled()[1], rtol=1e-9)


@pytest.mark.slow
def test_field_of_similar_contacts_is_similar():
    """Of the same W the gaps are copies of each other."""
    ours, theirs = (solve(scaled(radius=s)).summary()["field"] for s in (3.0, 1.0))
    for name in ("max_dimensionless", "central_dimensionless", "thin_gap_error"):
        assert ours[name] == pytest.approx(theirs[name], rel=1e-7, abs=0.0)
    assert ours["capacitance"] == pytest.approx(3.0 * theirs["capacitance"], rel=1e-7, abs=0.0)
    assert ours["high_field_area"] == pytest.approx(9.0 * theirs["high_field_area"], rel=1e-7, abs=0.0)
    for name, capacitance in ours["capacitance_by_zone"].items():
        assert capacitance == pytest.approx(3.0 * theirs["capacitance_by_zone"][name], rel=1e-7, abs=0.0)


@pytest.mark.parametrize(
    "wedge", [pytest.param("first-order", marks=pytest.mark.slow), "second-order", "third-order"]
)
def test_half_of_the_contact_is_the_whole_one(wedge):
    """Solved for y >= 0 or for the whole domain, to the tolerance of both."""
    case = point(grid={"nodes": 65, "wedge": wedge})
    conditions = resolve_point(case)
    problem = point_film_problem(case, conditions)
    assert problem.width.halved
    whole = dataclasses.replace(problem, width=dataclasses.replace(problem.width, symmetric=False))
    ours, theirs = solve_point_film(problem), solve_point_film(whole)
    np.testing.assert_array_equal(ours.y, theirs.y)
    np.testing.assert_allclose(ours.thickness, theirs.thickness, rtol=1e-8)
    np.testing.assert_allclose(ours.pressure, theirs.pressure, atol=1e-8 * conditions.max_pressure)
    np.testing.assert_array_equal(ours.cavitated, theirs.cavitated)
    assert ours.minimum_thickness == pytest.approx(theirs.minimum_thickness, rel=1e-8, abs=0.0)
    assert ours.load_residual < 1e-10
    assert ours.discretisation_error == pytest.approx(theirs.discretisation_error, rel=1e-4, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
def test_any_number_of_nodes_across():
    """Odd numbers are solved by half, even ones as a whole: neighbours differ by their grids alone."""
    films = {}
    for nodes_y in (72, 73, 74):
        case = point(grid={"nodes": 65, "nodes_y": nodes_y, "wedge": "second-order"})
        problem = point_film_problem(case, resolve_point(case))
        assert problem.width.halved == (nodes_y % 2 == 1)
        film = films[nodes_y] = solve_point_film(problem)
        assert film.converged
        assert film.y.size == nodes_y
        np.testing.assert_allclose(film.thickness, film.thickness[:, ::-1], rtol=1e-8)
    odd = films[73]
    for even in (films[72], films[74]):
        assert even.central_thickness == pytest.approx(odd.central_thickness, rel=5e-4, abs=0.0)
        # The lowest node is up to half a spacing from the lowest place.
        assert even.minimum_thickness == pytest.approx(odd.minimum_thickness, rel=5e-3, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("nodes", [66, 70])
def test_any_number_of_nodes_along(nodes):
    case = point({"entrainment_speed": 4.0}, grid={"nodes": nodes, "nodes_y": 65})
    film = solve_point_film(point_film_problem(case, resolve_point(case)))
    assert film.converged
    assert film.thickness.shape == (nodes, 65)
    assert film.load_residual < 1e-10
