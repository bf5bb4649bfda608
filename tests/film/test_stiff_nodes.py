"""The direct solver of stiff nodes and H00, by the operators of the film."""

import numpy as np
import pytest

from ehlectric.film.deflection import LINE, point_geometry
from ehlectric.film.gap import Gap
from ehlectric.film.levels import hierarchy
from ehlectric.film.mesh import Width
from ehlectric.film.reynolds import ACROSS, ALONG, Stencil
from ehlectric.film.stiff_nodes import StiffSolver

CIRCLE = point_geometry(radius_ratio=1.0, ellipse_ratio=1.0, compliance=2.0 / np.pi**2)

WIDTHS = {
    "line": None,
    "whole": Width(13, 1.2, symmetric=False),
    "half": Width(13, 1.2, symmetric=True),
}


@pytest.mark.parametrize("name", WIDTHS)
def test_solution_fulfils_the_rows_of_its_nodes_and_the_load(name):
    """The deflection by FFT and the stencils give back the right side at these nodes."""
    width = WIDTHS[name]
    geometry = LINE if width is None else CIRCLE
    level = hierarchy(33, inlet=-2.0, outlet=1.5, geometry=geometry, wedge_order=3, width=width)[0]
    mesh, random = level.mesh, np.random.default_rng(1)
    rows = ALONG if width is None else ACROSS
    by_p, by_h = (Stencil(random.normal(size=(rows, *mesh.shape))) for _ in range(2))
    by_p.coefficients[2] += 6.0
    if mesh.symmetric:
        # The neighbour beyond the line of symmetry is the neighbour on this side.
        by_p.coefficients[4, :, 0] = by_h.coefficients[4, :, 0] = 0.0
    nodes = mesh.inner & (random.random(mesh.shape) < 0.4)
    # The wedge term of the first inner node has no second node upstream.
    nodes[1] = False
    right = random.normal(size=mesh.shape)
    gap = Gap(level, np.ones(mesh.shape))
    dp, dh00 = StiffSolver.of(gap, by_p, by_h, nodes)(right, 0.7)
    dh, load = gap.change(dp, dh00)
    assert not np.any(dp[~nodes])
    # Single precision in point contacts.
    close = 1e-10 if width is None else 2e-3
    np.testing.assert_allclose((by_p(dp) + by_h(dh))[nodes], right[nodes], atol=close)
    assert load == pytest.approx(0.7, abs=close)


def test_matrix_without_rows_is_refused():
    level = hierarchy(33, inlet=-2.0, outlet=1.5, geometry=LINE, wedge_order=1)[0]
    empty = Stencil(np.zeros((ALONG, *level.mesh.shape)))
    with pytest.raises(np.linalg.LinAlgError):
        StiffSolver.of(Gap(level, np.ones(level.mesh.shape)), empty, empty, level.mesh.inner)
