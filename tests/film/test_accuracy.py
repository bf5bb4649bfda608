"""Error estimates of rough films and of the maximum pressure, against shapes whose errors are known."""

from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric.film.film_errors import (
    between_nodes,
    change_near,
    change_of_minimum,
    max_pressure_error,
    roughness_between_nodes,
)
from ehlectric.film.mesh import Mesh, Width
from tests.helpers.each import each


def over(nodes, values, width=None):
    mesh = Mesh.over(nodes, -2.0, 2.0, width)
    return mesh, values(mesh.x[:, np.newaxis], mesh.y) + np.zeros(mesh.shape)


def grid(film, status="converged"):
    return SimpleNamespace(
        level=SimpleNamespace(mesh=film[0]), state=SimpleNamespace(pressure=film[1]), status=status
    )


@each("width", [None, Width(41, 2.0, symmetric=False), Width(41, 2.0)])
@each("share", [0.01, 0.3])
def test_peaks_between_the_nodes_are_found(width, share):
    """A wave of two spacings has its peaks half-way, where no node sees it."""
    mesh = Mesh.over(41, -2.0, 2.0, width)

    def wave(x, y):
        return -0.1 * share * np.sin(np.pi * (x - mesh.x[0]) / mesh.dx)[:, np.newaxis] ** 2 + 0.0 * y

    film = np.full(mesh.shape, 0.1)
    assert roughness_between_nodes(wave, mesh, film) == pytest.approx(share, rel=1e-6, abs=0.0)
    # The same wave on a grid of sixteen times the nodes: what is left is 1 - cos(pi/32)^2 of it.
    fine = Mesh.over(641, -2.0, 2.0, None if width is None else Width(3, 2.0))
    resolved = roughness_between_nodes(wave, fine, 0.1 + wave(fine.x, fine.y))
    assert resolved < 0.02 * share


def test_roughness_that_the_nodes_see_whole_adds_nothing():
    """Straight flanks with their corners at nodes."""
    mesh = Mesh.over(81, -2.0, 2.0)
    corners = np.where(np.arange(81) % 4 == 0, -0.01, 0.01)

    def zigzag(x, y):
        return np.interp(x, mesh.x, corners)[:, np.newaxis] + 0.0 * y

    assert roughness_between_nodes(zigzag, mesh, 0.1 + zigzag(mesh.x, mesh.y)) < 1e-12


def test_deep_valleys_do_not_count_but_high_peaks_do():
    mesh = Mesh.over(41, -2.0, 2.0)

    def gap(x, y):
        return 0.02 * (np.abs(x - 1.05) < 0.02)[:, np.newaxis] + 0.0 * y

    film = np.full((41, 1), 0.1)
    assert roughness_between_nodes(gap, mesh, film) == pytest.approx(0.0, abs=1e-12)
    peaks = roughness_between_nodes(lambda x, y: -gap(x, y), mesh, film)
    assert peaks == pytest.approx(0.2, rel=1e-9, abs=0.0)


def test_change_far_from_the_minimum_does_not_count():
    """The film rises steeply behind the constriction, where grids differ most."""
    fine, coarse = over(81, lambda x, _: 1.0 + x**2), over(41, lambda x, _: 1.0 + x**2)
    shifted = coarse[0], coarse[1] + np.where(coarse[0].x > 1.5, 0.5, 0.01)[:, np.newaxis]
    assert change_of_minimum(fine, shifted) == pytest.approx(0.01, rel=1e-9, abs=0.0)


def test_minima_that_agree_by_chance_are_told_by_their_places():
    fine = over(81, lambda x, _: 1.0 - 0.5 * np.exp(-20 * (x - 1) ** 2) - 0.4 * np.exp(-20 * (x + 1) ** 2))
    coarse = over(41, lambda x, _: 1.0 - 0.4 * np.exp(-20 * (x - 1) ** 2) - 0.5 * np.exp(-20 * (x + 1) ** 2))
    assert np.min(fine[1]) == pytest.approx(np.min(coarse[1]))
    assert change_of_minimum(fine, coarse) == pytest.approx(0.1, rel=1e-6, abs=0.0)


def test_change_is_looked_for_near_the_places_only():
    width = Width(41, 2.0, symmetric=False)
    fine = over(81, lambda x, y: x * y, Width(81, 2.0, symmetric=False))
    coarse = over(41, lambda x, y: x * y + 0.3 * ((x > 1.0) & (y > 1.0)), width)
    places = [(1.5, 1.5), (1.5, -1.5), (-1.5, 1.5), (0.0, 0.0)]
    assert [change_near(fine, coarse, [place]) > 0.2 for place in places] == [True, False, False, False]


def peak(nodes, width=0.3, at=0.013):
    return over(nodes, lambda x, y: np.exp(-(((x - at) / width) ** 2)) + 0.0 * y)


def test_error_of_a_resolved_peak_falls_and_bounds_the_true_one():
    """A Gaussian peak, whose true maximum is one."""
    errors = []
    for nodes in (41, 81, 161):
        fine, coarse = peak(nodes), peak(nodes // 2 + 1)
        true = 1.0 / float(np.max(fine[1])) - 1.0
        errors.append(max_pressure_error(grid(fine), grid(coarse)))
        assert true <= errors[-1]
    assert errors[0] > 3.0 * errors[1] > 9.0 * errors[2]


def test_a_spike_narrower_than_the_spacing_is_not_resolved():
    """Its height on both grids is the same: their difference tells nothing."""
    spike = [over(n, lambda x, _: 0.5 * (np.abs(x) < 1.5) + 0.1 * (np.abs(x - 1.0) < 1e-3)) for n in (81, 41)]
    assert np.max(spike[0][1]) == np.max(spike[1][1])
    assert max_pressure_error(grid(spike[0]), grid(spike[1])) > 0.3


def test_a_spike_that_is_not_yet_the_maximum_counts():
    """The Hertz peak of 1 is the maximum; next to it a spike of 0.9 stands on one node."""
    film = over(401, lambda x, _: (1.0 - x**2) * (np.abs(x) < 1.0) + 0.9 * (np.abs(x - 0.9) < 5e-3) * x)
    assert np.argmax(film[1]) == 200
    assert between_nodes(*film) > 0.3


def test_a_ridge_along_either_axis_is_a_ridge():
    along, across = (
        over(41, lambda x, y, t=turned: 1.0 * (np.abs(y if t else x) < 0.01), Width(41, 2.0, symmetric=False))
        for turned in (False, True)
    )
    assert between_nodes(*along) == pytest.approx(between_nodes(*across))
    # Half of six, and an eighth of two.
    assert between_nodes(*along) == pytest.approx(3.25)
    # Half of a symmetric contact is told as its whole: the ridge on the line of symmetry too.
    half = over(41, lambda _, y: 1.0 * (np.abs(y) < 0.01), Width(41, 2.0))
    assert between_nodes(*half) == pytest.approx(3.25)


@pytest.mark.parametrize("coarse", [None, "stalled"])
def test_no_estimate_without_a_coarser_film(coarse):
    other = None if coarse is None else grid(peak(21), status=coarse)
    assert max_pressure_error(grid(peak(41)), other) is None
    assert max_pressure_error(grid(peak(41), status="stalled"), grid(peak(21))) is None
