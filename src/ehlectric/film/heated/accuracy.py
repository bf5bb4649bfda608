"""Error of the temperature rise of a film with heat, from differences between solutions of the same film."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.heated.course import Course, HeatedGrid, close_enough
from ehlectric.film.sheared.laws import UNBOUNDED
from ehlectric.film.sheared.profile import Across, on_mesh
from ehlectric.film.thermal.energy import Heat

# Another way to solve a film: course and temperature -> course and initial temperature.
Variation: TypeAlias = Callable[[Course, Heat], tuple[Course, Heat]]

# Growth of the temperature at the pressure spike on a grid that is four times finer, over that from the next
# coarser grid: as much again. Where the stress grows with the spike, the second doubling adds twice as much.
_GROWTH, _GROWTH_UNBOUNDED = 1.0, 3.0

# Smallest error that is stated [K].
_LEAST = 0.1

# Degree of the polynomial across the film with which the solution is compared.
_FINE_DEGREE = 20


def mid_film(temperature: Array) -> Array:
    """Temperature at mid-film (nx, ny) [K], from that across the film (nz, nx, ny)."""
    weights = Across.of(len(temperature) - 1).at(np.array([0.5]))[0]
    return np.asarray(np.tensordot(weights, temperature, axes=1))


def largest_rise(course: Course, grid: HeatedGrid) -> float | None:
    """Largest rise of the mid-film temperature over that of the oil that enters [K]; None without heat."""
    thermal = course.physics.thermal
    if grid.heat is None or thermal is None:
        return None
    return float(np.max(mid_film(grid.heat.temperature))) - thermal.inlet_temperature


def rise_error(found: list[tuple[Course, HeatedGrid]]) -> float | None:
    """Estimated error of the largest rise of the mid-film temperature.

    Parameters
    ----------
    found : list of (Course, HeatedGrid)
        Films with heat on all grids, the finest one last.

    Returns
    -------
    float or None
        Sum of the errors by the grid along the film, by the polynomial across it and by properties of the oil
        beyond the range in which its laws have values [K]. None without a converged film on the next coarser
        grid, or where a solution for comparison did not converge.
    """
    along = _along(found)
    if along is None:
        return None
    others = [_finer_across, _curved_oil] if _beyond(*found[-1]) else [_finer_across]
    parts = [_change(*found[-2], other) for other in others]
    known = [part for part in parts if part is not None]
    return along + sum(known) if len(known) == len(parts) else None


def _along(found: list[tuple[Course, HeatedGrid]]) -> float | None:
    """Error by the grid along the film [K].

    At first order the error is the difference to the next coarser grid, and half of the difference between
    the two grids before. The larger one counts, as a difference of two maxima passes through zero. A peak
    that the grid hardly shows may still become the largest one.
    """
    known = [(course, grid) for course, grid in found[-3:] if grid.converged and grid.heat is not None]
    if len(known) < 2 or known[-2:] != found[-2:]:
        return None
    rises = [rise for each in reversed(known) if (rise := largest_rise(*each)) is not None]
    changes = (0.5**k * abs(fine - coarse) for k, (fine, coarse) in enumerate(pairwise(rises)))
    return max(*changes, _LEAST, close_enough(rises[0]), _growing_peak(*known[-2:]))


def _growing_peak(coarse: tuple[Course, HeatedGrid], fine: tuple[Course, HeatedGrid]) -> float:
    """Largest rise less that of the fine grid [K], if the growth from the coarse grid goes on."""
    meshes = [course.levels[0].mesh for course, _ in (coarse, fine)]
    before, now = (mid_film(grid.heat.temperature) for _, grid in (coarse, fine) if grid.heat is not None)
    growth = np.maximum(now - on_mesh(before[np.newaxis], *meshes)[0], 0.0)
    times = _GROWTH_UNBOUNDED if fine[0].physics.rheology.name in UNBOUNDED else _GROWTH
    return float(np.max(now + times * growth) - np.max(now))


def _beyond(course: Course, grid: HeatedGrid) -> bool:
    """Whether the film is hotter than the range in which the laws of the oil have values."""
    thermal = course.physics.thermal
    assert thermal is not None and grid.heat is not None
    return bool(np.max(grid.heat.temperature) > thermal.oil.highest)


def _finer_across(course: Course, heat: Heat) -> tuple[Course, Heat]:
    """Course and initial temperature of the film with a polynomial of higher degree across it."""
    rows = Across.of(course.degree).at(Across.of(_FINE_DEGREE).zeta)
    temperature, by_pressure = (np.tensordot(rows, v, axes=1) for v in (heat.temperature, heat.by_pressure))
    finer = replace(heat, temperature=temperature, by_pressure=by_pressure)
    return replace(course, degree=_FINE_DEGREE), finer


def _curved_oil(course: Course, heat: Heat) -> tuple[Course, Heat]:
    """Course of the film whose oil goes on beyond its range as parabolas, and not as straight lines."""
    thermal = course.physics.thermal
    assert thermal is not None
    physics = replace(course.physics, thermal=replace(thermal, oil=replace(thermal.oil, curved=True)))
    return replace(course, problem=replace(course.problem, physics=physics)), heat


def _change(course: Course, grid: HeatedGrid, other: Variation) -> float | None:
    """Change of the largest rise [K] by another way to solve the film; None if that does not converge."""
    now = largest_rise(course, grid)
    if now is None or grid.heat is None:
        return None
    course, heat = other(replace(course, finer=0), grid.heat)
    varied = course(grid.solution.state, heat, spike=False)
    rise = largest_rise(course, varied)
    return abs(rise - now) if rise is not None and varied.converged else None
