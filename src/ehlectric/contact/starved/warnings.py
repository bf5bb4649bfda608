"""Warnings about the supply of oil of a solved contact."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.setup import Setup
from ehlectric.errors import ResultWarning
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm

# Part of the flooded central film above which the layer of oil has no effect, and relative difference of the
# ratio of films from the one asked for above which there is a warning.
_FLOODED, _MISSED = 0.999, 0.01

# Distance of the meniscus from the Hertz zone in half-widths, beside a grid spacing, up to which it is at the
# edge of the zone.
_AT_HERTZ = 0.01

# Distance of the meniscus from the inlet edge, as a part of the length of the inlet, below which the domain
# is too short for it.
_AT_EDGE = 0.05


def starvation_warnings(
    setup: Case | Setup, conditions: Conditions | PointConditions, film: Film | PointFilm
) -> Iterator[ResultWarning]:
    """Warnings about the supply of oil of a converged film; none for a film without ``[inlet]``."""
    found, inlet = film.starvation, setup.inlet
    if found is None or inlet is None or not film.converged:
        return
    if film.minimum_thickness < conditions.boundary_film:
        yield ResultWarning(
            "surfaces-touch",
            f"the starved film is {1e9 * film.minimum_thickness:.2g} nm thick in places, thinner than the "
            f"boundary film of {1e9 * conditions.boundary_film:.3g} nm: the surfaces would touch there, "
            "which is not solved with [inlet]",
        )
    asked = inlet.film_ratio
    if asked is not None and abs(found.film_ratio / asked - 1.0) > _MISSED:
        yield ResultWarning(
            "film-ratio-missed",
            f"the film is {found.film_ratio:.3g} of the flooded one, not {asked:.3g} as inlet.film_ratio "
            "asks for; give inlet.oil_layer",
        )
    if asked is None and (found.meniscus is None or found.film_ratio > _FLOODED):
        yield ResultWarning(
            "oil-layer-thick",
            f"the layer of oil of {1e6 * found.oil_layer:.3g} µm is thicker than what the contact takes: "
            "the film is flooded",
        )
    if found.meniscus is None:
        return
    b = film.scales.length
    places = f"x/b = {found.meniscus / b:.3g}"
    if found.meniscus > -(1.0 + _AT_HERTZ) * b - float(film.x[1] - film.x[0]):
        yield ResultWarning(
            "meniscus-at-edge",
            f"the oil fills the gap only from {places}, at the edge of the Hertz zone: the film is about "
            "as thick as the layer of oil, whatever speed and viscosity are",
        )
    elif found.meniscus < (1.0 - _AT_EDGE) * film.x[0] - _AT_EDGE * b:
        yield ResultWarning(
            "meniscus-at-edge",
            f"the oil fills the gap from {places}, at the edge of the domain; lower grid.inlet from "
            f"{setup.grid.inlet:g}",
        )
