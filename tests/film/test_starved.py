"""Parts of the starved film: derivatives, runs of cavitated nodes, and the search for a layer."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric import Case
from ehlectric.film.face_flow import flow
from ehlectric.film.film_solver import starved_solution
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.nested import levels_of, nested_iteration
from ehlectric.film.newton import Asperities, State
from ehlectric.film.oil_content import Carried, Runs, Scheme, Supply, carried_rows, filled_anew
from ehlectric.film.problem import OilSupply
from ehlectric.film.reynolds import poiseuille_weight
from ehlectric.film.starved_solver import first_layer
from ehlectric.film.touching_film import TouchingJacobian, assess_touching
from ehlectric.runtime.threads import quiet_solution
from tests.helpers.starved_films import posed, supplied

LINE = Case.line(
    reduced_radius="14.1 mm",
    reduced_modulus="226 GPa",
    max_hertz_pressure="0.5 GPa",
    entrainment_speed="4 m/s",
    lubricant="paper",
    grid={"nodes": 129},
)
POINT = Case.point(
    radius_x="10 mm",
    radius_y="10 mm",
    reduced_modulus="226 GPa",
    load="5 N",
    entrainment_speed="4 m/s",
    lubricant="paper",
    grid={"nodes": 65, "nodes_y": 65},
)


def state_of(case):
    """Problem, grids and flooded state of a case, and filled nodes with a meniscus and a pocket."""
    problem = posed(case)
    with quiet_solution():
        found = nested_iteration(problem, None)[-1]
    levels = levels_of(problem)
    mesh, filled = levels[0].mesh, found.final.full_film.copy()
    x, y = mesh.x[:, np.newaxis], mesh.y
    filled &= x > -1.6 + 0.3 * y**2
    filled &= ~((x > 0.1) & (x < 0.3) & (np.abs(y) < 0.3))
    pressure = np.where(filled, found.state.pressure, problem.fluid.ambient_pressure)
    return problem, levels, State.of(levels[0], pressure, found.state.h00), filled


@pytest.mark.parametrize("case", [LINE, POINT], ids=["line", "point"])
def test_jacobian_is_the_derivative_of_the_rows(case):
    """Central differences of the rows after the elimination, with the masses that change along."""
    problem, levels, state, filled = state_of(case)
    level, fluid = levels[0], problem.fluid
    carried = Carried(Supply(np.full(level.mesh.y.shape, 0.3), problem.wedge_order), filled)
    now = assess_touching(fluid, level, state, Asperities())
    now = replace(now, carried=carried, full_film=filled & level.mesh.inner)
    with quiet_solution():
        jacobian = TouchingJacobian.of(fluid, levels, state.pressure, now, damping=0.0)
    change = np.where(now.full_film, np.random.default_rng(1).normal(size=filled.shape), 0.0)
    step, dh00 = 1e-7, 0.3

    def rows(sign):
        moved = State.of(level, state.pressure + sign * step * change, state.h00 + sign * step * dh00)
        at_faces = flow(fluid, moved.pressure, moved.thickness, level.mesh)
        return carried_rows(level, at_faces, moved.thickness, carried)[0]

    expected = (rows(1.0) - rows(-1.0)) / (2.0 * step)
    image = jacobian.image(np.append(change, dh00))
    found, load = jacobian.finest.unscale * image[:-1].reshape(filled.shape), float(image[-1])
    np.testing.assert_allclose(found, expected, atol=1e-5 * np.abs(expected).max())
    assert load == pytest.approx(float(np.vdot(level.weights, change)), rel=1e-12)


def test_content_conserves_mass_at_any_state():
    """The sum of all rows of a line is the flow through its ends, whatever the pressure is."""
    problem, levels, state, filled = state_of(LINE)
    level = levels[0]
    carried = Carried(Supply(np.array([0.3]), problem.wedge_order), filled)
    at_faces = flow(problem.fluid, state.pressure, state.thickness, level.mesh)
    rows, mass = carried_rows(level, at_faces, state.thickness, carried)
    assert not filled[-3:].any()
    balance = level.mesh.dx * float(rows.sum())
    assert mass[-2, 0] - 0.3 == pytest.approx(balance, rel=1e-9)


def test_nodes_that_overflow_or_are_under_tension_change():
    problem, levels, state, filled = state_of(LINE)
    level = levels[0]
    # A layer thicker than the gap at the meniscus overflows there; none is left at the inlet edge.
    thick = float(state.thickness[int(np.argmax(filled[:, 0])) - 1, 0]) * 1.01
    carried = Carried(Supply(np.array([thick]), problem.wedge_order), filled)

    at_faces = flow(problem.fluid, state.pressure, state.thickness, level.mesh)
    poiseuille = poiseuille_weight(at_faces, level.mesh)

    def moved(excess):
        return filled_anew(level, at_faces, state.thickness, poiseuille, excess, carried)[0].filled

    first = int(np.argmax(filled[:, 0]))
    excess = state.pressure - problem.fluid.ambient_pressure
    assert moved(excess)[first - 1, 0]
    assert moved(excess)[first + 3, 0]
    excess[first + 3] = -1.0
    assert not moved(excess)[first + 3, 0]


@pytest.mark.slow
@pytest.mark.parametrize("part", [1.0, 0.025], ids=["uniform", "little beside the middle"])
def test_a_layer_that_fills_the_gap_at_the_inlet_edge_on_some_lines(part):
    """The gap at the edge is 11.5 in the middle and grows to the sides: a layer of 12 fills the middle."""
    problem = posed(POINT)
    problem = replace(problem, nodes=49, width=replace(problem.width, nodes=33))
    found = supplied(problem, lambda y: np.where(np.abs(y) < 0.3, 12.0, 12.0 * part))
    filled = found.last.content.filled[0]
    assert filled.any()
    assert not filled.all()
    assert found.last.status == "converged"


def test_runs_of_two_lines():
    """By hand: rows of a run are added to the first filled node behind it, line by line."""
    filled = np.array([[False, True], [True, False], [False, False], [True, True]])
    rows = np.array([[1.0, 10.0], [2.0, 20.0], [4.0, 40.0], [8.0, 80.0]])
    reduced = Runs.of(filled).reduced(rows)
    assert reduced[filled].tolist() == [10.0, 3.0, 12.0, 140.0]


def test_first_layer_of_a_search_inverts_the_published_relation():
    for ratio in (0.1, 0.5, 0.9):
        for width, exponent in ((0.5, 3.0), (1.0, 3.0), (4.0, 12.0)):
            part = first_layer(ratio, width)
            assert part / (1.0 + part**exponent) ** (1.0 / exponent) == pytest.approx(ratio, rel=1e-12)
        # A line, and with it an ellipse without end, has its layer as its film.
        assert first_layer(ratio, 50.0) == pytest.approx(first_layer(ratio, None), rel=1e-6)


@pytest.mark.parametrize(("first_order", "behind"), [(False, 0.83125), (True, 0.88125)])
def test_mass_behind_a_steep_node(first_order, behind):
    """The gap closes from 2.3 to 1, where half of the mass behind is extrapolated.

    The other half is the mean of 1 and 0.8, or 1. Before, it is extrapolated from 2.3 and 2.3.
    """
    mass = np.array([[2.3], [2.3], [2.3], [1.0], [0.8]])
    supply = Supply(np.array([np.inf]), 3, scheme=Scheme(first_order=first_order)).at_gap(mass)
    wedge = supply.wedge(Mesh.over(5, 0.0, 4.0), np.ones(mass.shape, dtype=bool))
    assert wedge(mass)[3, 0] == pytest.approx(behind - 1.8125, abs=1e-14)


@pytest.mark.parametrize("order", [2, 3])
@pytest.mark.parametrize("first_order", [False, True])
def test_derivative_of_the_wedge_where_gaps_close_steeply(order, first_order):
    """Against central differences, at random gaps with cavities."""
    random, mesh = np.random.default_rng(1), Mesh.over(40, 0.0, 1.0)
    full, change = np.exp(random.normal(size=(40, 1))), random.normal(size=(40, 1))
    filled = random.random((40, 1)) < 0.8
    full, change = full * filled, change * filled
    supply = Supply(np.array([np.inf]), order, scheme=Scheme(first_order=first_order))

    def wedge(mass):
        return supply.at_gap(np.where(filled, mass, 1.0)).wedge(mesh, filled)(mass)

    derivative = supply.at_gap(np.where(filled, full, 1.0)).wedge(mesh, filled, full)(change)
    numerical = (wedge(full + 1e-6 * change) - wedge(full - 1e-6 * change)) / 2e-6
    np.testing.assert_allclose(derivative, numerical, rtol=1e-5, atol=1e-5 * np.abs(derivative).max())


@pytest.mark.parametrize("ratio", [0.6])
def test_a_layer_gives_the_film_of_its_ratio(ratio):
    """Both central films, by the ratio asked for; the oil of the layer flows through the middle of the line:
    rho H = rho_0 layer, but for the small flow by pressure there.
    """
    with quiet_solution():
        found = starved_solution(replace(posed(LINE), supply=OilSupply(film_ratio=ratio)), None)
    mesh, last = found.last.level.mesh, found.last
    assert at_centre(mesh, last.state.thickness) == pytest.approx(
        ratio * at_centre(mesh, found.flooded.state.thickness), rel=2e-4
    )
    mass = at_centre(mesh, last.final.coefficients.density * last.state.thickness)
    assert mass == pytest.approx(float(found.layer[0]), rel=0.01)
