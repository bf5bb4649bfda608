"""Layer of oil for which a starved film is a given part of the flooded one."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.mesh import at_centre
from ehlectric.film.starved.course import Course, StarvedFilm, at_centre_line
from ehlectric.film.state import State

# Relative difference from the ratio asked for at which the search ends, and its largest number of films.
_CLOSE, _MOST_FILMS = 1e-4, 8

# Exponent of the start of the search, r/(1 + r^gamma)^(1/gamma): between those of light and heavy circles.
# Lines, whose layer is the film, start with the ratio itself.
_EXPONENT = 3.0

# Largest factor between two layers of the search, and the ratio above which a film is flooded.
_MOST_FACTOR, _FLOODED = 4.0, 1.0 - 1e-9


def film_of_ratio(
    course: Course, ratio: float, near: tuple[State, Mask] | None, last: StarvedFilm | None
) -> tuple[Array | None, StarvedFilm | None]:
    """Uniform layer of oil (ny,) for a ratio of central films, and its starved film.

    Parameters
    ----------
    course : Course
        Equations of the starved film on a grid.
    ratio : float
        Central film thickness over that of the flooded film, above 0 and up to 1.
    near : tuple of State and ndarray, or None
        State and filled nodes that are likely to be close.
    last : StarvedFilm or None
        Film of the coarser grid, whose layer is the first of the search.

    Returns
    -------
    layer : ndarray, shape (ny,), or None
        Thickness H of the layer. None where it is not known: for a flooded film that did not converge, and
        for that of a point contact, the least layer of which depends on the domain.
    film : StarvedFilm or None
        Its film; None for the flooded film, also where that did not converge and has no parts. The ratio may
        be missed where a film did not converge.

    Notes
    -----
    Secant method for ln(film) over ln(layer), whose slope is between 0 and 1.
    """
    lines, mesh = np.ones_like(course.level.mesh.y), course.level.mesh
    ambient = float(course.flooded.final.coefficients.density[0, 0])
    if course.flooded.status != "converged":
        return None, None
    if ratio >= _FLOODED:
        return (taken_layer(course) if mesh.dy is None else None), None
    flooded = at_centre(mesh, course.flooded.state.thickness)
    layer = first_layer(ratio, line=mesh.dy is None) * course.flooded_mass / ambient
    if last is not None:
        layer = at_centre_line(last.solution.level, last.layer)
    found: list[tuple[float, float]] = []
    best: tuple[float, StarvedFilm] | None = None
    for _ in range(_MOST_FILMS):
        film = course.solved(layer * lines, near)
        if film.solution.status != "converged":
            break
        missed = float(np.log(at_centre(mesh, film.solution.state.thickness) / (ratio * flooded)))
        if best is None or abs(missed) < best[0]:
            best = abs(missed), film
        if abs(missed) < _CLOSE:
            break
        found.append((float(np.log(layer)), missed))
        near = film.solution.state, film.content.filled
        layer = float(np.exp(_next(found)))
    chosen = film if best is None else best[1]
    return chosen.layer, chosen


def taken_layer(course: Course) -> Array:
    """Thickness H (ny,) at ambient pressure of the oil that the flooded film takes through the inlet edge."""
    flooded, mesh = course.flooded, course.level.mesh
    flow = flooded.final.flow
    density = flow.coefficients.density
    mass = density * flooded.state.thickness
    edge = mass[0] if course.order == 1 else 0.5 * (mass[0] + mass[1])
    taken: Array = (edge - mesh.dx * flow.along.flux[0]) / density[0]
    return taken


def first_layer(ratio: float, *, line: bool) -> float:
    """Mass of the first layer of a search over that of the flooded film at the centre.

    Examples
    --------
    >>> first_layer(0.5, line=True), round(first_layer(0.5, line=False), 3)
    (0.5, 0.523)
    """
    return ratio if line else float((ratio**-_EXPONENT - 1.0) ** (-1.0 / _EXPONENT))


def _next(found: list[tuple[float, float]]) -> float:
    """Logarithm of the next layer, from those of the last layers and what their films miss."""
    at, missed = found[-1]
    slope = 1.0
    if len(found) > 1:
        before, before_missed = found[-2]
        slope = min(1.0, max(0.05, (missed - before_missed) / (at - before))) if at != before else 1.0
    most = float(np.log(_MOST_FACTOR))
    return at - min(most, max(-most, missed / slope))
