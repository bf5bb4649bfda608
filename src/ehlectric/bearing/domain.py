"""Domains on which the contacts of a bearing are solved, wide enough for the thick films of light loads."""

from __future__ import annotations

import math
from typing import Any

from ehlectric.bearing.ring_contacts import BallContact, RollerContact
from ehlectric.contact.conditions import default_side

# Domain of a lightly loaded contact in lengths over which its pressure builds up, before, beside and behind
# it. It costs below 1 % of the film, or 15 % where a ball hardly presses. And the most that a grid holds of
# what is before and beside, in semi-axes.
_ALONG, _ACROSS, _BEHIND, _MOST = 10.0, 4.0, 1.0, (48.0, 24.0)

# As much of rollers before and behind the contact: they cost 0.6 % of the film. Beyond a hundred half-widths
# eight lengths do, and three hundred half-widths at the most, for 2 % of the film: with longer inlets the
# films of hardly loaded rollers often did not converge.
_LINE_INLET, _LINE_OUTLET = 10.0, 2.0
_LINE_FAR, _LINE_SHORTER, _LINE_MOST = 100.0, 8.0, 300.0


def _line_length(contact: RollerContact) -> float:
    """Length sqrt(2 R h) over which a roller's pressure builds up, in half-widths."""
    return math.sqrt(2.0 * contact.line.reduced_radius * contact.film) / contact.half_width


def line_domain(contact: RollerContact) -> dict[str, Any]:
    """Domain of a roller's contact, long enough for the thick film of a light one too."""
    length, most = _line_length(contact), _line_most(contact)
    inlet = max(4.0, min(_line_inlet(length), most))
    outlet = max(2.0, min(_LINE_OUTLET * length, most))
    # Sixteen nodes in the Hertz zone are the least that a case takes.
    nodes = max(3201, 8 * math.ceil(inlet + outlet) + 1)
    # The field's ends are those of a case's.
    field = [-max(1.25, min(length, inlet, 100.0)), max(1.25, min(length, outlet, 100.0))]
    return {"inlet": -inlet, "outlet": outlet, "nodes": nodes, "field_range": field}


def _line_inlet(length: float) -> float:
    """Half-widths before a roller for a length in them over which its pressure builds up."""
    return min(_LINE_INLET * length, max(_LINE_FAR, _LINE_SHORTER * length))


def _line_most(contact: RollerContact) -> float:
    """Half-widths to where a roller begins to fall away from a parabola, or what a grid takes."""
    return min(0.5 * contact.ring.radii.element_x / contact.half_width, _LINE_MOST)


def roller_fits(contact: RollerContact) -> bool:
    """Whether the domain holds the length over which a roller's film builds up."""
    return _line_inlet(_line_length(contact)) <= _line_most(contact)


def _point_lengths(contact: BallContact) -> tuple[float, float]:
    """Lengths sqrt(2 R h) over which a ball's pressure builds up, along and across, in semi-axes."""
    point, dry = contact.point, contact.dry
    along, across = (
        math.sqrt(2.0 * radius * contact.film) / axis
        for radius, axis in ((point.radius_x, dry.semi_axis_x), (point.radius_y, dry.semi_axis_y))
    )
    return along, across


def point_domain(contact: BallContact) -> dict[str, Any]:
    """Domain and nodes of a ball's contact: as of other points, wider for a light load's thick film."""
    (along, across), dry = _point_lengths(contact), contact.dry
    inlet, outlet = max(4.5, min(_ALONG * along, _MOST[0])), max(1.5, min(_BEHIND * along, 0.1 * _MOST[0]))
    usual = default_side(dry.semi_axis_y / dry.semi_axis_x)
    side = max(usual, min(1.0 + _ACROSS * across, _MOST[1]))
    nodes = max(257, 8 * math.ceil(inlet + outlet) + 1, 16 * math.ceil(side) + 1)
    return {"inlet": -inlet, "outlet": outlet, "side": side, "nodes": nodes}


def ball_fits(contact: BallContact) -> bool:
    """Whether the domain holds the lengths over which a ball's film builds up."""
    along, across = _point_lengths(contact)
    return _ALONG * along <= _MOST[0] and 1.0 + _ACROSS * across <= _MOST[1]
