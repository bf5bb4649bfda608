"""Warnings about a contact whose surfaces touch."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.setup import Setup
from ehlectric.contact.spots.asperities import UNRESOLVED_LOAD, UNRESOLVED_SHARE
from ehlectric.contact.spots.mechanics import Coarser, load_of, spots_of
from ehlectric.contact.spots.oil_balance import OilBalance, oil_balance
from ehlectric.errors import ResultWarning
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.quantities.formats import formatted

# Oil that a film may make or lose without a warning, over the mean flow through its contact.
MASS_ERROR = 1e-3

_ROUNDING = 1e-9

# Smallest load share, and smallest part of the mean flow of the oil, that a text states as a number.
_LEAST_SHARE = 1e-4


def share_text(share: float, coarser: float | None) -> str:
    """Share in per cent, with no more digits than its change from a coarser grid leaves.

    Examples
    --------
    >>> share_text(0.2369, 0.2371), share_text(0.2369, 0.21), share_text(0.0511, 0.12), share_text(4e-7, 0.0)
    ('23.7', '24', '5', '< 0.01')
    """
    if 0.0 < share < _LEAST_SHARE:
        return f"< {100.0 * _LEAST_SHARE:g}"
    error = share if coarser is None else abs(share - coarser)
    relative = error / share if share > 0.0 else 0.0
    digits = 3 if relative < 0.01 else 2 if relative < 0.2 else 1
    return f"{float(f'{100.0 * share:.{digits}g}'):g}"


def about_share(share: float, coarser: float | None) -> str:
    """Share in per cent within a sentence, with the digits of ``share_text``.

    Examples
    --------
    >>> about_share(0.2369, 0.2371), about_share(4e-7, 0.03)
    ('about 23.7 %', 'less than 0.01 %')
    """
    text = share_text(share, coarser)
    return f"less than {text.removeprefix('< ')} %" if text.startswith("<") else f"about {text} %"


def spot_warnings(
    case: Case | Setup,
    conditions: Conditions | PointConditions,
    film: Film | PointFilm,
    coarser: Coarser | None,
) -> Iterator[ResultWarning]:
    """Warnings about a converged film that is rough or touches: what it means, and what is not resolved.

    Parameters
    ----------
    case : Case or Setup
        Case of the contact.
    conditions : Conditions or PointConditions
        Operating conditions.
    film : Film or PointFilm
        Film; there are no warnings where it has not converged.
    coarser : Coarser or None
        Asperities on a grid with half the nodes; None if it was not solved.

    Yields
    ------
    ResultWarning
        That the surfaces touch at the edge of the domain; oil that appears; that they touch in the domain,
        and where so a load share that depends on the grid.
    """
    if not film.converged:
        return
    if conditions.boundary_film > 0.0 and _edge_gap(film) <= (1.0 + _ROUNDING) * conditions.boundary_film:
        yield ResultWarning(
            "domain-too-small",
            "the surfaces touch at the edge of the domain, where asperities carry nothing in this solution; "
            "lower grid.inlet or raise grid.outlet" + (" or grid.side" if film.thickness.ndim == 2 else ""),
        )
    if case.roughness or np.any(film.contact):
        balance = oil_balance(case, conditions, film)
        if balance is not None and balance.mass_error > MASS_ERROR:
            yield _not_conserved(balance)
    if not np.any(film.contact):
        return
    spots = spots_of(film)
    share = float(np.sum(spots.loads)) / load_of(conditions)
    before = None if coarser is None else coarser.load_share
    what = "spot, which carries" if spots.number == 1 else "spots, which carry"
    yield ResultWarning(
        "asperities-touch",
        f"the surfaces touch in {spots.number} {what} {about_share(share, before)} of "
        "the load: the film conducts there, and the minimum film, the maximum field, the capacitance and a "
        "breakdown voltage are those of the boundary film; use the values of asperities, around the spots",
    )
    if before is None:
        grids = "is not known on a coarser grid"
    elif abs(share - before) > max(UNRESOLVED_SHARE * share, UNRESOLVED_LOAD):
        grids = f"was {about_share(before, share)} on a grid with half the nodes"
    else:
        return
    yield ResultWarning(
        "load-share-unresolved",
        f"the load share of the asperities depends on the grid: it {grids}; use more grid.nodes and compare",
    )


def _edge_gap(film: Film | PointFilm) -> float:
    """Least gap on the edges of the domain [m]."""
    edges = (film.thickness[[0, -1]], film.thickness[..., [0, -1]])
    return min(float(np.min(edge)) for edge in edges)


def _not_conserved(balance: OilBalance) -> ResultWarning:
    made, lost = (
        f"{formatted(100.0 * each, '.2g')} %" if each >= _LEAST_SHARE else "none"
        for each in (balance.oil_made, balance.oil_lost)
    )
    return ResultWarning(
        "oil-not-conserved",
        f"the film does not keep its oil: {made} of the mean flow through the contact appears where "
        f"cavitated gaps fill again, and {lost} is lost in spots, since cavities count as full where a line "
        "contact touches, or no film that carries its oil was found; the film is rather too thick and the "
        "load share of the asperities too low; use more grid.nodes, or [motion]",
    )
