"""Breakdown voltages of a bearing and of its shaft, and the largest field strength in its films."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.bearing.circuit import Circuit
from ehlectric.bearing.meter.path import shaft_first_break, shaft_through_breakdown
from ehlectric.bearing.meter.reading import shaft_path
from ehlectric.bearing.solution import BearingSolution, insulating


@dataclass(frozen=True)
class Breakdown:
    """Voltages at which films break down, over the positions of the cage.

    The bearing voltage is that across the films, from ring to ring. The shaft voltage is that from shaft to
    housing; it is larger where a coating on a ring takes a part of it.

    Attributes
    ----------
    first_break, first_break_mean : float
        Bearing voltage at which the first contact breaks down, minimum and mean over the positions [V].
    first_break_at : str
        Name of the contact that breaks down first.
    through_breakdown, through_breakdown_mean : float
        Bearing voltage at which the first element breaks down from ring to ring, minimum and mean over the
        positions [V].
    shaft_first_break, shaft_through_breakdown : float
        Shaft voltages of both breakdowns, minimum over the positions [V].
    """

    first_break: float
    first_break_mean: float
    first_break_at: str
    through_breakdown: float
    through_breakdown_mean: float
    shaft_first_break: float
    shaft_through_breakdown: float


def breakdown_of(solution: BearingSolution) -> Breakdown | None:
    """Bearing and shaft voltages at which the films of a solved bearing break down.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    Breakdown or None
        None for ceramic elements, where surfaces touch, or without a dielectric strength.
    """
    circuits, path = solution.circuits(), shaft_path(solution)
    first = np.array([circuit.first_break for circuit in circuits])
    through = np.array([circuit.through_breakdown for circuit in circuits])
    if not insulating(solution) or not np.all(np.isfinite(through)):
        return None
    return Breakdown(
        first_break=float(np.min(first)),
        first_break_mean=float(np.mean(first)),
        first_break_at=_weakest(circuits[int(np.argmin(first))]),
        through_breakdown=float(np.min(through)),
        through_breakdown_mean=float(np.mean(through)),
        shaft_first_break=min(shaft_first_break(circuit, path) for circuit in circuits),
        shaft_through_breakdown=min(shaft_through_breakdown(circuit, path) for circuit in circuits),
    )


def _weakest(circuit: Circuit) -> str:
    """Name of the contact that breaks down first."""
    k = int(np.argmin(circuit.first_breaks))
    return f"{'inner' if circuit.inner_first[k] else 'outer'} contact of element {k}"


def strength_per_volt(solution: BearingSolution) -> float | None:
    """Maximum field strength per volt across the films, of all contacts and positions of the cage [1/m].

    None for ceramic elements, and where surfaces touch.
    """
    if not insulating(solution):
        return None
    return max(
        float(np.max(share * ring.values.strength_per_volt))
        for position, circuit in zip(solution.positions, solution.circuits(), strict=True)
        for share, ring in (
            (circuit.inner_share, position.inner),
            (1.0 - circuit.inner_share, position.outer),
        )
    )
