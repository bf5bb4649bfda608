"""Grids of a bearing's contacts, on domains wide enough for the thick films of light loads."""

from __future__ import annotations

import math
from functools import lru_cache

from ehlectric.bearing.ring_contacts import BallContact, RollerContact
from ehlectric.cases.grid import Grid, point_grid
from ehlectric.contact.domain import FARTHEST

# Discretisation error of the minimum film, relative, to which the grid of each contact is refined.
REFINE = 0.02

# Domain of a ball's contact ahead of it, beside it and behind it, in lengths sqrt(2 R h) over which the
# pressure builds up, and the most that a grid holds ahead and beside, in semi-axes. The domain costs below
# 1 % of the film, or 15 % where a ball hardly presses.
_ALONG, _ACROSS, _BEHIND, _MOST = 10.0, 4.0, 1.0, FARTHEST["point"]

# Domain of a roller's contact ahead of it and behind it, in the same lengths; it costs 0.3 to 1.2 % of the
# film. Beyond a hundred half-widths the inlet has eight lengths, and three hundred half-widths at the most,
# which costs 2.5 % of the film and 1.3 % of the capacitance: with longer inlets the films of hardly loaded
# rollers often did not converge.
_LINE_INLET, _LINE_OUTLET = 10.0, 2.0
_LINE_FAR, _LINE_SHORTER, _LINE_MOST = 100.0, 8.0, FARTHEST["line"][0]


def roller_grid(contact: RollerContact) -> Grid:
    """Grid of a roller's contact, on a domain long enough for the thick film of a light load.

    Parameters
    ----------
    contact : RollerContact
        Contact and load.

    Returns
    -------
    Grid
        Lengths in half-widths of the dry contact.
    """
    length, most = _line_length(contact), _line_most(contact)
    inlet = max(4.0, min(_line_inlet(length), most))
    outlet = max(2.0, min(_LINE_OUTLET * length, most))
    return Grid.from_dict(
        {
            "inlet": -inlet,
            "outlet": outlet,
            # A grid takes sixteen nodes or more in the Hertz zone.
            "nodes": max(801, 8 * math.ceil(inlet + outlet) + 1),
            # Grids reach a hundred half-widths for the field at the most, and 1.25 by default.
            "field_range": [-max(1.25, min(length, inlet, 100.0)), max(1.25, min(length, outlet, 100.0))],
            "refine": REFINE,
        }
    )


def _line_length(contact: RollerContact) -> float:
    """Length sqrt(2 R h) over which a roller's pressure builds up, in half-widths."""
    conditions = contact.conditions
    return math.sqrt(2.0 * conditions.reduced_radius * contact.film) / conditions.half_width


def _line_inlet(length: float) -> float:
    """Inlet of a roller in half-widths, for a length over which the pressure builds up in half-widths."""
    return min(_LINE_INLET * length, max(_LINE_FAR, _LINE_SHORTER * length))


def _line_most(contact: RollerContact) -> float:
    """Longest inlet in half-widths: as far as a parabola describes the roller, or what a grid holds."""
    return min(0.5 * contact.ring.radii.element_x / contact.conditions.half_width, _LINE_MOST)


def roller_fits(contact: RollerContact) -> bool:
    """Whether the domain holds the length over which a roller's film builds up."""
    return _line_inlet(_line_length(contact)) <= _line_most(contact)


def ball_grid(contact: BallContact) -> Grid:
    """Grid of a ball's contact, on a domain wide enough for the thick film of a light load.

    Parameters
    ----------
    contact : BallContact
        Contact and load.

    Returns
    -------
    Grid
        Lengths in semi-axes of the dry contact; heavy loads have the default domain of point contacts.
    """
    along, across = _point_lengths(contact)
    inlet, outlet = max(4.5, min(_ALONG * along, _MOST[0])), max(1.5, min(_BEHIND * along, 0.1 * _MOST[0]))
    side = max(contact.conditions.side, min(1.0 + _ACROSS * across, _MOST[1]))
    nodes = max(129, 8 * math.ceil(inlet + outlet) + 1, 16 * math.ceil(side) + 1)
    return _point_grid(inlet, outlet, side, nodes)


@lru_cache(maxsize=128)
def _point_grid(inlet: float, outlet: float, side: float, nodes: int) -> Grid:
    """Grid with lengths in semi-axes; it is made once, as most contacts have the same one."""
    table = {"inlet": -inlet, "outlet": outlet, "side": side, "nodes": nodes, "refine": REFINE}
    return Grid.from_dict(point_grid(table))


def _point_lengths(contact: BallContact) -> tuple[float, float]:
    """Lengths sqrt(2 R h) over which a ball's pressure builds up, along and across, in semi-axes."""
    radii, dry = contact.ring.radii, contact.dry
    along, across = (
        math.sqrt(2.0 * radius * contact.film) / axis
        for radius, axis in ((radii.radius_x, dry.semi_axis_x), (radii.radius_y, dry.semi_axis_y))
    )
    return along, across


def ball_fits(contact: BallContact) -> bool:
    """Whether the domain holds the lengths over which a ball's film builds up, along and across."""
    along, across = _point_lengths(contact)
    return _ALONG * along <= _MOST[0] and 1.0 + _ACROSS * across <= _MOST[1]
