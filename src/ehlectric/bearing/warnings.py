"""Warnings of a solved bearing."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from ehlectric.bearing.conditions import BearingDuty
from ehlectric.bearing.contacts import ContactSolution
from ehlectric.bearing.limits import TAKEN, Equilibrium, groove_ratio, shoulder_angle
from ehlectric.bearing.loads.balls import BallEquilibrium
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.bearing.state import RaceState
from ehlectric.cases.bearing import Bearing
from ehlectric.errors import ResultWarning


def edge_warnings(
    bearing: Bearing, states: Sequence[tuple[Equilibrium, RaceState, RaceState]]
) -> Iterator[ResultWarning]:
    """Warnings of contact ellipses that reach over the shoulder of a groove, one for each ring.

    Parameters
    ----------
    bearing : Bearing
        Its grooves.
    states : sequence of (equilibrium, RaceState, RaceState)
        At each position of the cage, with the contacts of the inner and of the outer ring.
    """
    for k, name in enumerate(("inner", "outer")):
        shoulder, load, reached = math.inf, 0.0, 0.0
        for at, *races in states:
            if not isinstance(at, BallEquilibrium):
                return
            shoulder = shoulder_angle(bearing, inner=k == 0)
            arc = races[k].semi_axis_y / (groove_ratio(bearing, inner=k == 0) * bearing.element_diameter)
            ends = np.abs(getattr(at, f"{name}_angle")) + arc
            over = np.where(ends > shoulder, races[k].load, 0.0)
            heaviest = int(np.argmax(over))
            if over[heaviest] > load:
                load, reached = float(over[heaviest]), float(ends[heaviest])
        if load > 0.0:
            yield ResultWarning(
                "shoulder-reached",
                f"{name} ring: the contact with {load:.3g} N would reach {math.degrees(reached):.1f} deg up "
                f"a groove that ends at {math.degrees(shoulder):.1f} deg: the shoulder cuts it off, and the "
                "pressure on that edge is not in this",
            )


def clearance_warnings(
    duty: BearingDuty, at: Equilibrium, inner: RaceState, outer: RaceState
) -> Iterator[ResultWarning]:
    """Warning of films that take up the clearance, which the equilibrium leaves out.

    Parameters
    ----------
    duty : BearingDuty
        The bearing.
    at : BallEquilibrium or RollerEquilibrium
        Its loads.
    inner, outer : RaceState
        Its films.
    """
    most = int(np.argmax(at.inner_load))
    films = float(inner.central_thickness[most] + outer.central_thickness[most])
    geometry = duty.geometry
    room = geometry.radial_clearance if isinstance(geometry, RollerBearing) else geometry.clearance
    beside = "a clearance of"
    if room <= 0.0:
        # Preloaded elements have none, but are pressed in.
        room, beside = float(at.inner_approach[most] + at.outer_approach[most]), "elements pressed in by"
    if films > TAKEN * room:
        yield ResultWarning(
            "clearance-taken-up",
            f"both films of the most loaded element are {1e6 * films:.2g} um, beside {beside} "
            f"{1e6 * room:.2g} um: loads are those of dry contacts, which such films change",
        )


def contact_warnings(rings: Mapping[str, Sequence[ContactSolution]]) -> list[ResultWarning]:
    """Warnings of the contacts of a bearing, equal ones of several contacts as one.

    Parameters
    ----------
    rings : mapping of str to sequence of ContactSolution
        Contacts that were solved, by the name of their ring.

    Returns
    -------
    list of ResultWarning
        In the order in which they come up. A warning that all contacts share, such as one about their oil,
        names none of them; other texts name ring and load.
    """
    told: dict[ResultWarning, dict[str, list[float]]] = {}
    for ring, contacts in rings.items():
        for contact in contacts:
            for warning in dict.fromkeys(contact.warnings):
                told.setdefault(warning, {}).setdefault(ring, []).append(contact.load)
    every = sum(map(len, rings.values()))
    return [
        warning
        if sum(map(len, loads.values())) == every
        else ResultWarning(
            warning.code, ", ".join(_named(ring, those) for ring, those in loads.items()) + f": {warning}"
        )
        for warning, loads in told.items()
    ]


def _named(ring: str, loads: Sequence[float]) -> str:
    """One contact or some of a ring, by their loads [N].

    Examples
    --------
    >>> _named("inner", [800.0]), _named("outer", [20.0, 40.0, 80.0])
    ('inner contact at 800 N', '3 outer contacts at 20 to 80 N')
    """
    if len(loads) == 1:
        return f"{ring} contact at {loads[0]:.4g} N"
    return f"{len(loads)} {ring} contacts at {min(loads):.4g} to {max(loads):.4g} N"
