"""Domains on which the contacts of a bearing are solved, wide enough for the thick films of light loads."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ehlectric.bearing.conditions import BearingDuty
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.bearing.ring_contacts import Race, line_contact, point_contact
from ehlectric.contact.conditions import default_side
from ehlectric.formulas.film_line import LineContact, moes
from ehlectric.formulas.film_point import nijenbanning_venner_moes
from ehlectric.formulas.hertz_line import line_half_width
from ehlectric.formulas.hertz_point import dry_contact

# Domain of a lightly loaded contact in lengths over which its pressure builds up, before, beside and behind
# it. It costs below 1 % of the film, or 15 % where a ball hardly presses. And the most that a grid holds of
# what is before and beside, in semi-axes.
_ALONG, _ACROSS, _BEHIND, _MOST = 10.0, 4.0, 1.0, (48.0, 24.0)

# As much of rollers before and behind the contact: they cost 0.6 % of the film. Beyond a hundred half-widths
# eight lengths do, and three hundred half-widths at the most, for 2 % of the film: with longer inlets the
# films of hardly loaded rollers often did not converge.
_LINE_INLET, _LINE_OUTLET = 10.0, 2.0
_LINE_FAR, _LINE_SHORTER, _LINE_MOST = 100.0, 8.0, 300.0


def _line_length(duty: BearingDuty, race: Race, load: float) -> float:
    """Length sqrt(2 R h) over which a roller's pressure builds up, in half-widths; load in N."""
    contact = line_contact(duty, race, load)
    film = moes(contact).central_thickness
    return math.sqrt(2.0 * contact.reduced_radius * film) / _half_width(contact)


def _half_width(contact: LineContact) -> float:
    return line_half_width(contact.load_per_length, contact.reduced_radius, contact.reduced_modulus)


def line_domain(duty: BearingDuty, race: Race, load: float) -> dict[str, Any]:
    """Domain of a roller's contact at a load [N], long enough for the thick film of a light one too."""
    length, most = _line_length(duty, race, load), _line_most(duty, race, load)
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


def _line_most(duty: BearingDuty, race: Race, load: float) -> float:
    """Half-widths to where a roller begins to fall away from a parabola, or what a grid takes."""
    roller = duty.radii(race.angle, inner=race.inner).element_x
    return min(0.5 * roller / _half_width(line_contact(duty, race, load)), _LINE_MOST)


def _point_lengths(duty: BearingDuty, race: Race, load: float) -> tuple[float, float, float]:
    """Lengths sqrt(2 R h) over which a ball's pressure builds up, in semi-axes, and the ratio of these."""
    contact = point_contact(duty, race, load)
    film = nijenbanning_venner_moes(contact).central_thickness
    dry = dry_contact(load, contact.radius_x, contact.radius_y, duty.modulus)
    along, across = (
        math.sqrt(2.0 * radius * film) / axis
        for radius, axis in ((contact.radius_x, dry.semi_axis_x), (contact.radius_y, dry.semi_axis_y))
    )
    return along, across, dry.semi_axis_y / dry.semi_axis_x


def point_domain(duty: BearingDuty, race: Race, load: float) -> dict[str, Any]:
    """Domain and nodes of a ball's contact: as of other points, wider for a light load's thick film."""
    along, across, ratio = _point_lengths(duty, race, load)
    inlet, outlet = max(4.5, min(_ALONG * along, _MOST[0])), max(1.5, min(_BEHIND * along, 0.1 * _MOST[0]))
    side = max(default_side(ratio), min(1.0 + _ACROSS * across, _MOST[1]))
    nodes = max(257, 8 * math.ceil(inlet + outlet) + 1, 16 * math.ceil(side) + 1)
    return {"inlet": -inlet, "outlet": outlet, "side": side, "nodes": nodes}


def least_load(duty: BearingDuty, race: Race) -> float:
    """Load [N] below which a contact's film builds up over more than its domain can hold, to a third.

    Lighter contacts have thicker films than this one's, so that its voltage is a lower bound of theirs.
    """
    for load in np.geomspace(1e-6, 1e6, 121):
        if isinstance(duty.geometry, RollerBearing):
            fits = _line_inlet(_line_length(duty, race, load)) <= _line_most(duty, race, load)
        else:
            along, across, _ = _point_lengths(duty, race, load)
            fits = _ALONG * along <= _MOST[0] and 1.0 + _ACROSS * across <= _MOST[1]
        if fits:
            return float(load)
    return math.inf
