"""Hydrodynamic rolling resistance of all contacts of a bearing, from one solved contact of each ring.

It is one part of the friction of a bearing. Spin and the slip along the ellipse of a ball, cage, ribs and
ends of rollers, seals, oil that is churned, and hysteresis of the steel have no part in it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import ContactFriction
from ehlectric.bearing.kinds import kind_of
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.bearing.solution import BearingSolution
from ehlectric.contact.conditions import PointConditions
from ehlectric.formulas.rolling_resistance import line_rolling_force, point_rolling_force

# Numbers of the contact of each ring in the summary, by the attribute of its friction.
_OF_CONTACT = {
    "rolling_coefficient": "rolling_coefficient",
    "contact_power_loss": "power_loss",
    "inlet_temperature_rise": "inlet_temperature_rise",
    "max_temperature_rise": "max_temperature_rise",
    "temperature_rise_error": "temperature_rise_error",
}


def rolling_force(ring: RingContacts[Any], friction: ContactFriction, load: Array) -> Array:
    """Hydrodynamic rolling force on each surface of the contacts with a ring.

    Parameters
    ----------
    ring : RingContacts
        Contacts with the ring, without their loads.
    friction : ContactFriction
        Friction of the solved contact.
    load : ndarray, shape (...)
        Loads of the contacts [N]; 0 without contact.

    Returns
    -------
    ndarray, shape (...)
        Force [N]: that of the solved contact times the ratio of the forces at both loads by formula.

    Notes
    -----
    The formulas are those of Biboulet and Houpert (2010), doi:10.1243/13506501JET790 and JET791. The force of
    a heavily loaded ball goes with the cube root of the load, that of a roller does not depend on it. Heat
    reduces the force of all contacts as that of the solved one, and lightly loaded ones too much.
    """
    # The formulas take the speed of the surfaces, which a film factor would reduce.
    conditions = replace(kind_of(ring).contact(ring, friction.load).conditions, film_factor=1.0)
    loads = np.array([friction.load, *np.ravel(load)])
    if isinstance(conditions, PointConditions):
        by_formula = point_rolling_force(conditions.formulas, loads)
    else:
        per_length = loads * (conditions.load_per_length / friction.load)
        by_formula = line_rolling_force(conditions.formulas, per_length)
    solved = friction.rolling_coefficient * friction.load
    return np.reshape(solved * by_formula[1:] / by_formula[0], np.shape(load))


def rolling_power_loss(solution: BearingSolution) -> float | None:
    """Power that the hydrodynamic rolling resistance of all contacts takes, mean over the positions.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    float or None
        Power [W] with flooded contacts, 2 F u for each of them; None where no heat is solved.
    """
    power = 0.0
    for ring in (solution.inner, solution.outer):
        own = solution.conditions.inner if ring.inner else solution.conditions.outer
        if own.friction is None:
            return None
        states = [position.inner if ring.inner else position.outer for position in solution.positions]
        force = rolling_force(ring, own.friction, np.array([state.load for state in states]))
        power += 2.0 * ring.speed * float(np.mean(np.sum(force, axis=-1)))
    return power


def friction_summary(solution: BearingSolution) -> dict[str, float | None]:
    """Friction of the solved contacts and of the bearing as in summary.json; None where no heat is solved."""
    power = rolling_power_loss(solution)
    numbers: dict[str, float | None] = {
        "rolling_power_loss": power,
        "rolling_moment": None if power is None else power / solution.case.bearing.inner_speed,
    }
    for name, own in (("inner", solution.conditions.inner), ("outer", solution.conditions.outer)):
        for key, attribute in _OF_CONTACT.items():
            value = None if own.friction is None else getattr(own.friction, attribute)
            numbers[f"{name}_{key}"] = value
    return numbers
