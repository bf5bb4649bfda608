"""Starved contacts: stored values of the supply of oil, and warnings about it."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.cases.case import Case
from ehlectric.cases.film_inputs import Inlet
from ehlectric.contact.setup import Setup
from ehlectric.film import Film, PointFilm, Starvation, lost_film
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable

# Part of the flooded central film above which the layer of oil has no effect, and relative difference of the
# ratio of films from the one asked for above which there is a warning.
_FLOODED, _MISSED = 0.999, 0.01

# Share by which a domain that is too small makes the flooded film too thin, above which there is a
# warning: the film itself does not depend on it.
_LOST = 0.05

# Distance of the meniscus from the Hertz zone in half-widths, in addition to a grid spacing, up to which it
# is at the edge of the zone.
_AT_HERTZ = 0.01

# Distance of the meniscus from the inlet edge, as a part of the length of the inlet, below which the domain
# is too short for it.
_AT_EDGE = 0.05


def starvation_warnings(setup: Case | Setup, film: Film | PointFilm) -> Iterator[ResultWarning]:
    """Warnings about the supply of oil of a film; none for a film without ``[inlet]``."""
    supply, inlet = film.starvation, setup.inlet
    if supply is None or inlet is None:
        return
    yield from _of_flooded(film, supply, inlet)
    if not film.converged:
        return
    table = inlet.layer_table
    if table is not None and isinstance(film, PointFilm):
        side = film.semi_axis_y
        if table.y[0] > -side or table.y[-1] < side:
            yield ResultWarning.of(
                "layer-table-short",
                first=1e6 * table.y[0],
                last=1e6 * table.y[-1],
                lower=-1e6 * side,
                upper=1e6 * side,
            )
    target, ratio = inlet.film_ratio, supply.film_ratio
    if target is not None and ratio is not None and abs(ratio / target - 1.0) > _MISSED:
        yield ResultWarning.of("film-ratio-missed", ratio=ratio, target=target)
    nearly = ratio is not None and ratio > _FLOODED
    if target is None and (film.film_fraction is None or nearly):
        flooded = "the film is flooded"
        if film.film_fraction is not None:
            flooded = (
                f"the central film is {readable(100.0 * (supply.film_ratio or 1.0), 4)} % of the flooded one"
            )
        yield ResultWarning.of("oil-layer-thick", layer=_layer(inlet), flooded=flooded)
    if film.film_fraction is not None:
        yield from _of_meniscus(setup, film, supply, nearly=nearly)


def _layer(inlet: Inlet) -> str:
    """Name of a layer of oil that is given."""
    if inlet.oil_layer is None:
        return "the layer of oil of inlet.layer_table"
    return f"the layer of oil of {readable(1e6 * inlet.oil_layer)} µm"


def _of_flooded(film: Film | PointFilm, supply: Starvation, inlet: Inlet) -> Iterator[ResultWarning]:
    """Warning about a flooded film that is unknown or wrong.

    Where the ratio of films is given, a domain that is too small for the flooded film is too small for the
    film, which has a warning about it.
    """
    upstream, sides = supply.flooded_inlet_deficit, supply.flooded_side_deficit
    if upstream is None or supply.flooded_central_thickness is None:
        given = "layer" if inlet.film_ratio is None else "ratio"
        yield ResultWarning.of("flooded-film-wrong", given)
    elif inlet.film_ratio is None and film.film_fraction is not None:
        lost = upstream
        if sides is not None:
            flooded = supply.flooded_central_thickness / film.scales.thickness
            lost = lost_film(flooded, upstream, sides)
        if lost > _LOST:
            sideways = "" if sides is None else " and raise grid.side"
            yield ResultWarning.of("flooded-film-wrong", "domain", percent=100.0 * lost, sideways=sideways)


def _of_meniscus(
    setup: Case | Setup, film: Film | PointFilm, supply: Starvation, *, nearly: bool
) -> Iterator[ResultWarning]:
    """Warning about a meniscus at the edge of the domain or of the Hertz zone.

    Where the central film is ``nearly`` flooded, the place of a meniscus far upstream changes nothing.
    """
    b, place = film.scales.length, supply.meniscus
    if place is not None and place > -(1.0 + _AT_HERTZ) * b - float(film.x[1] - film.x[0]):
        yield ResultWarning.of("meniscus-at-edge", "hertz", place=place / b)
    elif not nearly and (place is None or place < (1.0 - _AT_EDGE) * film.x[0] - _AT_EDGE * b):
        where = "on y = 0 already" if place is None else f"from x/b = {readable(place / b)},"
        yield ResultWarning.of("meniscus-at-edge", "domain", where=where, inlet=setup.grid.ends[0])
