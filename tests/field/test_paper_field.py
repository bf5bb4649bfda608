"""Observed order of the paper's over-relaxation on its Cartesian grid."""

import numpy as np
import pytest
import sympy as sp
from scipy.constants import epsilon_0

from ehlectric.paper.cartesian import CartesianGrid, stencil
from ehlectric.paper.sor import over_relax, young_factor

pytestmark = pytest.mark.convergence


def manufactured():
    """V = s + s (1 - s) cos(2 pi x)/4 between wavy walls, no flux at x = 0 and 1, and its charge."""
    x, y = sp.symbols("x y")
    wave = sp.cos(2 * sp.pi * x)
    lower, upper = -sp.Rational(1, 2) - wave / 10, sp.Rational(1, 2) + wave / 20
    s = (y - lower) / (upper - lower)
    v = s + s * (1 - s) * wave / 4
    eps = 2 + wave / 2 + y / 3
    charge = -(sp.diff(eps * sp.diff(v, x), x) + sp.diff(eps * sp.diff(v, y), y))
    return [sp.lambdify((x, y), f, "numpy") for f in (lower, upper, v, eps, charge)]


@pytest.mark.slow
@pytest.mark.gate
def test_manufactured_solution_is_met_to_second_order(slope):
    """Cut cells, varying permittivity across and along, and free charge."""
    lower, upper, v, eps, charge = manufactured()
    sizes, errors = np.array([17, 33, 65, 129]), []
    for nx in sizes:
        x = np.linspace(0.0, 1.0, nx)
        grid = CartesianGrid.over(x, lower(x, 0.0), upper(x, 0.0), rows=nx - 1)
        centre_x, centre_y = 0.5 * (x[1:] + x[:-1]), 0.5 * (grid.y[1:] + grid.y[:-1])
        at_x, at_y = x[grid.column], grid.y[grid.row]
        built = stencil(
            grid, eps(centre_x[:, np.newaxis], centre_y), charge_density=epsilon_0 * charge(at_x, at_y)
        )
        start = np.zeros(at_x.size + 2)
        start[-1] = 1.0
        relaxed = over_relax(built, start, factor=young_factor(grid), tolerance=1e-11)
        errors.append(np.max(np.abs(relaxed.potential[:-2] - v(at_x, at_y))))
    assert errors[-1] < 1e-4
    assert slope(1.0 / (sizes - 1), errors) == pytest.approx(2.0, abs=0.25)
