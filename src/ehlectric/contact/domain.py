"""Domain of a contact's film, made larger until what it cuts off is below the error that is asked for.

Pressure that would build up upstream of the domain, or beside it, is missing in the film. Its share falls
with about the cube of the distance. A light contact has a thick film whose pressure builds up over many
half-widths.
"""

from __future__ import annotations

import math
from dataclasses import replace

from ehlectric.cases.grid import Grid, point_grid
from ehlectric.contact.check import PreparedContact
from ehlectric.contact.conditions import PointConditions
from ehlectric.contact.memory import check_grid
from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm

# Part of the error asked for at which a longer domain aims, and bounds of the factor of one step.
_AIM, _LEAST, _MOST = 0.3, 1.25, 4.0

# Least domain that is taken ahead, behind and beside once the first one is too small, in lengths sqrt(2 R h)
# over which the pressure builds up.
_AHEAD, _BEHIND, _BESIDE = 6.0, 2.0, 3.0

# Largest domain ahead and beside, in half-widths or semi-axes, and largest number of larger domains. Films of
# hardly loaded contacts often do not converge on longer ones.
FARTHEST = {"line": (300.0, 0.0), "point": (48.0, 24.0)}
MOST_STEPS = 3

# Loss of the film above which no domain that is taken here is large enough.
_HOPELESS = {"line": math.inf, "point": 1.0}

# Nodes in a half-width or semi-axis of the first grid, along and across, and the least number of nodes.
_DENSITY = {"line": (16, 0, 401), "point": (8, 16, 129)}


def widened(contact: PreparedContact, film: Film | PointFilm) -> PreparedContact | None:
    """Contact on a larger domain, where that of its film cuts off more than the error that is asked for.

    Parameters
    ----------
    contact : PreparedContact
        Contact whose film is solved.
    film : Film or PointFilm
        Its film.

    Returns
    -------
    PreparedContact or None
        None where the domain is large enough or cannot be larger, where the grid has nodes and no error to
        reach, where surfaces are rough, and where oil is supplied at the inlet.
    """
    case, grid, loss = contact.case, contact.case.grid, film.domain_loss
    if not film.converged or loss is None or grid.target is None or loss <= grid.target:
        return None
    if contact.rough or case.inlet is not None or loss > _HOPELESS[contact.conditions.geometry]:
        return None
    larger = _larger(contact, film, loss, grid.target)
    if larger is None:
        return None
    grid, side = larger
    conditions = contact.conditions
    case = replace(case, grid=grid) if isinstance(case, Setup) else case.model_copy(update={"grid": grid})
    if isinstance(conditions, PointConditions):
        conditions = replace(conditions, side=side)
    return PreparedContact(case, conditions, contact.kind.domain(case, conditions), ())


def _larger(
    contact: PreparedContact, film: Film | PointFilm, loss: float, target: float
) -> tuple[Grid, float] | None:
    """Grid and side of a larger domain; None where the film has the largest one."""
    grid, conditions = contact.case.grid, contact.conditions
    geometry = conditions.geometry
    ahead, beside = FARTHEST[geometry]
    factor = min(_MOST, max(_LEAST, math.cbrt(loss / (_AIM * target))))
    length = math.sqrt(2.0 * film.central_thickness / film.scales.thickness)
    start, end = grid.ends
    inlet = min(ahead, max(factor * -start, _AHEAD * length))
    outlet = max(end, min(_BEHIND * length, 0.5 * ahead))
    side = 0.0
    table = grid.model_dump(mode="json", exclude_none=True) | {"inlet": -_rounded(inlet)}
    if isinstance(conditions, PointConditions):
        across = length * math.sqrt(conditions.radius_y / conditions.radius_x) / conditions.ratio
        side = _rounded(min(beside, max(factor * conditions.side, 1.0 + _BESIDE * across)))
        table["side"] = side
    if inlet <= -start and side <= getattr(conditions, "side", 0.0):
        return None
    along, wide, least = _DENSITY[geometry]
    table["outlet"] = outlet = _rounded(outlet)
    nodes = max(least, along * math.ceil(inlet + outlet) + 1, wide * math.ceil(side) + 1)
    table["nodes"] = max(nodes, table.get("nodes", 0))
    table["refine"] = table.pop("error", target)
    try:
        larger = Grid.from_dict(point_grid(table) if geometry == "point" else table)
        check_grid(geometry, larger.first(), rough=False)
    except InputError:
        return None
    return larger, side


def _rounded(length: float) -> float:
    """Length, rounded up to a half."""
    return math.ceil(2.0 * length) / 2.0
