"""Equivalent circuit of the films of a solved bearing: capacitance, resistance and breakdown voltage."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from ehlectric.bearing.breakdown import breakdown_of
from ehlectric.bearing.discharges.leakage import oil_conductance
from ehlectric.bearing.impedance import oil_relaxation_time
from ehlectric.bearing.intermittency.duty import duty_of
from ehlectric.bearing.solution import BearingSolution, capacitance, lambda_text, lubrication
from ehlectric.errors import InputError
from ehlectric.quantities.units import rpm_text

# Resistance in place of an insulator [Ohm]. It has no effect on a drive: with the capacitance of a bearing it
# has a time constant of minutes. Without it, a node between capacitors has no voltage before the first step.
OPEN = 1e12

# What lies between the rings: films of oil, ceramic elements, or contacts of metal.
State = Literal["films", "ceramic", "metal"]


@dataclass(frozen=True)
class Equivalent:
    """Equivalent circuit of what lies between the rings of a bearing, at one speed.

    Attributes
    ----------
    speed : float
        Speed of the inner ring [rad/s].
    state : str
        "films"; "ceramic" for elements that insulate; "metal" where the surfaces touch.
    capacitance : float
        Capacitance with smooth films, mean over the positions of the cage [F].
    resistance : float or None
        Resistance parallel to it, of the oil or of contacts of metal [Ohm]; None for oil without a
        conductivity and for ceramic elements.
    threshold : float or None
        Smallest voltage from ring to ring at which an element breaks down [V]; None where there is none.
    """

    speed: float
    state: State
    capacitance: float
    resistance: float | None
    threshold: float | None


def equivalent_of(solution: BearingSolution) -> Equivalent:
    """Equivalent circuit of what lies between the rings of a solved bearing.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    Equivalent
        Values in SI units.

    Raises
    ------
    InputError
        Where the surfaces touch, and the case has no ``bearing.contact_resistance``.

    Notes
    -----
    Where the surfaces touch, an element conducts while both of its contacts are closed, by two contact
    resistances in series. The conductance is the mean over time of that of all elements.
    """
    speed, own = solution.case.bearing.inner_speed, capacitance(solution)
    if solution.conditions.ceramic:
        return Equivalent(speed, "ceramic", own, None, None)
    if lubrication(solution) == "conducting":
        return Equivalent(speed, "metal", own, _metal_resistance(solution), None)
    tau, breakdown = oil_relaxation_time(solution), breakdown_of(solution)
    return Equivalent(
        speed,
        "films",
        own,
        None if tau is None else 1.0 / oil_conductance(solution, tau),
        None if breakdown is None else breakdown.through_breakdown,
    )


def _metal_resistance(solution: BearingSolution) -> float:
    """Reciprocal mean conductance of contacts that close at times [Ohm]."""
    resistance = solution.case.bearing.contact_resistance
    if resistance is None:
        raise InputError.missing(
            "bearing.contact_resistance",
            f"a value: at {rpm_text(solution.case.bearing.inner_speed)} rpm the surfaces touch (lambda ratio "
            f"{lambda_text(solution)}), so that the bearing is a resistance; or a film that parts them",
        )
    shares = [
        float(np.sum(inner.contact_time_share * outer.contact_time_share))
        for inner, outer in duty_of(solution).rings
    ]
    mean = float(np.mean(shares))
    return OPEN if mean * OPEN <= 2.0 * resistance else 2.0 * resistance / mean
