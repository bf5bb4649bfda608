"""Over-relaxation on a Cartesian grid: coefficients, cut cells, order and damping factor."""

import numpy as np
import pytest
from scipy.constants import epsilon_0

from ehlectric.errors import ConvergenceError
from ehlectric.field.poisson import FieldProblem
from ehlectric.paper.cartesian import EAST, NORTH, SOUTH, WEST, CartesianGrid, stencil
from ehlectric.paper.sor import cartesian, over_relax, solve_field, young_factor


def plates(nx=9, height=1.0, **changes):
    x = np.linspace(0.0, 1.0, nx)
    values = {"permittivity": 1.0 + 0.0 * x, "potential_1": -1.0, "potential_2": 1.0} | changes
    return FieldProblem(x, 0.0 * x, 0.0 * x + height, **values)


def test_coefficients_of_square_cells_are_those_of_the_appendix():
    """(A1) to (A5) by hand at node (4, 3) of square cells, permittivities all different."""
    x = np.arange(9.0)
    grid = CartesianGrid.over(x, 0.0 * x, 0.0 * x + 8.0, rows=8)
    cells = 1.0 + np.arange((x.size - 1) * (grid.y.size - 1)).reshape(x.size - 1, grid.y.size - 1) ** 0.5
    built = stencil(grid, cells, charge_density=np.full(grid.column.size, 3.0 * epsilon_0))
    (node,) = np.flatnonzero((grid.column == 4) & (grid.row == 3))
    # eps_(l,k) is the cell up and right of node (l, k).
    e, west, south, both = cells[4, 3], cells[3, 3], cells[4, 2], cells[3, 2]
    a0 = e + west + south + both
    a1, a2, a3, a4 = 0.5 * (e + south), 0.5 * (west + e), 0.5 * (both + west), 0.5 * (south + both)
    assert a1 + a2 + a3 + a4 == pytest.approx(a0)
    np.testing.assert_allclose(built.share[:, node], np.array([a1, a2, a3, a4]) / a0)
    assert built.source[node] == pytest.approx(3.0 / a0)
    column, row = grid.column, grid.row
    neighbours = {EAST: (5, 3), NORTH: (4, 4), WEST: (3, 3), SOUTH: (4, 2)}
    for side, place in neighbours.items():
        other = built.neighbour[side, node]
        assert (column[other], row[other]) == place


def test_flat_cells_are_weighted_by_their_shape():
    """East and west a1 and a3 times (dy/dx)^2 for cells that are not square."""
    x = np.arange(9.0)
    grid = CartesianGrid.over(x, 0.0 * x, 0.0 * x + 2.0, rows=8)
    built = stencil(grid, np.ones((x.size - 1, grid.y.size - 1)))
    (node,) = np.flatnonzero((grid.column == 4) & (grid.row == 3))
    ratio = 0.25**2
    expected = np.array([ratio, 1.0, ratio, 1.0]) / (2.0 + 2.0 * ratio)
    np.testing.assert_allclose(built.share[:, node], expected)


def test_arms_end_on_the_surfaces():
    """A wedge: the cut along x lies where the surface is as high as the row."""
    x = np.linspace(0.0, 1.0, 5)
    grid = CartesianGrid.over(x, 0.0 * x, 1.0 + x, rows=4)
    built = stencil(grid, np.ones((x.size - 1, grid.y.size - 1)))
    (node,) = np.flatnonzero((grid.column == 2) & np.isclose(grid.y[grid.row], 1.25))
    # Column 2 is 1.5 high and column 1 is 1.25: the surface passes the row just there.
    assert built.arm[WEST, node] == pytest.approx(0.25)
    assert built.neighbour[WEST, node] == grid.column.size + 1
    # The next row up is the surface itself.
    assert built.arm[NORTH, node] == pytest.approx(0.25)
    assert built.neighbour[NORTH, node] == grid.column.size + 1
    assert built.arm[SOUTH, node] == pytest.approx(0.25)


def test_plates_are_solved_at_once():
    relaxed = over_relax(*cartesian(plates(), 8), factor=1.0)
    assert relaxed.sweeps == 1
    field = solve_field(plates())
    assert field.capacitance == pytest.approx(epsilon_0, rel=1e-12, abs=0.0)
    assert field.capacitance_by_charge == pytest.approx(epsilon_0, rel=1e-12, abs=0.0)
    np.testing.assert_allclose(field.strength, 2.0, rtol=1e-12)


def test_youngs_factor_is_the_best_for_a_disturbed_capacitor():
    grid_equations, linear = cartesian(plates(nx=33), 32)
    rng = np.random.default_rng(5)
    start = linear.copy()
    start[:-2] += 0.1 * rng.standard_normal(linear.size - 2)
    best = young_factor(grid_equations.grid)
    sweeps = {
        factor: over_relax(grid_equations, start, factor=factor).sweeps
        for factor in (0.97 * best, best, 1.03 * best)
    }
    assert sweeps[best] == min(sweeps.values())
    assert over_relax(grid_equations, start, factor=1.0).sweeps > 8 * sweeps[best]


def test_what_the_paper_has_not_is_refused():
    problem = plates()
    for changes in (
        {"charge_density": np.zeros((9, 7))},
        {"end_potentials": (np.zeros(7), np.zeros(7))},
        {"permittivity": np.ones((9, 7))},
    ):
        with pytest.raises(ValueError, match="paper's"):
            solve_field(plates(**changes))
    assert solve_field(problem).voltage == 2.0


def test_sweeps_without_end_are_an_error(monkeypatch):
    monkeypatch.setattr("ehlectric.paper.sor.MOST_SWEEPS", 3)
    x = np.linspace(0.0, 1.0, 9)
    problem = FieldProblem(x, 0.0 * x, 1.0 + x, 1.0 + 0.0 * x, -1.0, 1.0)
    with pytest.raises(ConvergenceError, match="after 3 sweeps"):
        solve_field(problem)
