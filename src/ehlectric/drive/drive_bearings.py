"""Bearings as elements of a circuit: what a solved bearing says of its capacitance and its breakdown."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.bearing import (
    BearingResult,
    BearingSolution,
    Path,
    conducting_areas,
    duty_of,
    oil_conductance,
    oil_relaxation_time,
    shaft_path,
)
from ehlectric.cases.drive_inputs import Breakdown
from ehlectric.errors import InputError
from ehlectric.quantities.field_metadata import stored
from ehlectric.readable import readable

# Contacts in series between both rings, which a touching element closes.
_IN_SERIES = 2.0

# Voltage of a discharge over the lowest one at which its arc burns: just above it.
_BURNS = 1.001

# Share of time with metallic contact below which it is ignored: a second in a week.
_NEVER = 1e-6


@dataclass(frozen=True, eq=False)
class BearingElement:
    """Bearing between the shaft and its housing, over the positions of its elements."""

    capacitance: Array = field(
        metadata=stored("position", "F", "positive", name="position_capacitance", count="position_count")
    )  # capacitance of the films at each position [F], shape (p,)
    # Conductance of the oil of the films, mean over the positions [S].
    conductance: float = field(metadata=stored("", "S", "not negative"))
    # Voltage across the films at which one element breaks down from ring to ring [V]; infinite for ceramic
    # elements, shape (p,). Under summits it is at least the voltage of an arc.
    breakdown: Array = field(
        metadata=stored(
            "position", "V", "positive or infinite", name="position_breakdown", count="position_count"
        )
    )
    # Shape of Weibull's law of that voltage; infinite for a voltage without scatter.
    shape: float = field(metadata=stored("", "", "positive or infinite"))
    step: float = field(metadata=stored("", "s", "positive"))  # time from one position to the next [s]
    path: Path  # coating, and capacitance parallel to the films
    # Share of time in which asperities close the films.
    touching: float = field(metadata=stored("", "", "not negative"))
    # Resistance of the elements that touch both rings, mean number of them while any does [Ohm]; infinite
    # where the bearing has no resistance of a closed contact.
    touch_resistance: float = field(metadata=stored("", "ohm", "positive or infinite"))
    # Sum of the dry contact areas that conduct [m^2].
    hertz_area: float = field(metadata=stored("", "m**2", "not negative"))
    largest_area: float = field(metadata=stored("", "m**2", "not negative"))  # the largest of them [m^2]
    # Time in which oil passes the most loaded contact with the inner ring [s].
    transit: float = field(metadata=stored("", "s", "positive"))
    # Real area of contact of all elements that touch both rings, while any does [m^2]; 0 where it is not
    # known, or nothing touches.
    real_area: float = field(default=0.0, metadata=stored("", "m**2", "not negative"))

    @property
    def mean_capacitance(self) -> float:
        """Mean capacitance of the films over the positions [F]."""
        return float(np.mean(self.capacitance))


def bearing_element(result: BearingResult, breakdown: Breakdown) -> BearingElement:
    """Element of the circuit that a solved bearing is. Raises InputError where the bearing has no dielectric
    strength, or touches and has no ``contact_resistance``.
    """
    solution = result.solution
    bearing, ceramic = solution.case.bearing, solution.conditions.ceramic
    duty = duty_of(solution)
    touching = float(duty.contact_time_share) if duty.contact_time_share > _NEVER else 0.0
    if touching and bearing.contact_resistance is None:
        raise InputError(
            "bearing.contact_resistance",
            f"missing; asperities close the films of this bearing for {readable(100.0 * touching)} % of "
            "the time",
            takes="the resistance of one closed contact; about 0.1 to 1 ohm",
        )
    circuits = solution.circuits()
    strengths = _breakdown(solution, breakdown.lowest_voltage)
    if not ceramic and not np.all(np.isfinite(strengths)):
        raise InputError.missing("discharge.dielectric_strength", "the strength of the oil")
    films = np.array([circuit.capacitance for circuit in circuits])
    if bearing.element_capacitance is not None:
        films = np.full(films.size, bearing.rows * bearing.elements * bearing.element_capacitance)
    count, tau = films.size, oil_relaxation_time(solution)
    areas = conducting_areas(solution)
    first = solution.positions[0]
    return BearingElement(
        capacitance=films,
        conductance=float(0.0 if ceramic or tau is None else oil_conductance(solution, tau)),
        breakdown=np.full(count, math.inf) if ceramic else strengths,
        shape=float(breakdown.weibull_shape or circuits[0].shape or math.inf),
        step=float(2.0 * math.pi / (bearing.elements * first.equilibrium.cage_speed * count)),
        path=shaft_path(solution),
        touching=touching,
        touch_resistance=float(_IN_SERIES * (bearing.contact_resistance or math.inf) / max(duty.closed, 1.0)),
        hertz_area=float(np.sum(areas)),
        largest_area=float(np.max(areas)),
        transit=float(2.0 * float(np.max(first.inner.values.semi_axis_x)) / solution.inner.speed),
        real_area=float((duty.real_area or 0.0) if touching else 0.0),
    )


def _breakdown(solution: BearingSolution, lowest: float) -> Array:
    """Voltage from ring to ring at which an element breaks down at each position of the cage, shape (p,) [V].

    Films under high summits break down below the ``lowest`` voltage [V] at which an arc burns, and to no
    effect: they discharge as soon as an arc burns. That also holds for summits that touch.
    """
    smooth_circuits = [position.circuit(solution.case.bearing.fill) for position in solution.positions]
    smooth, rough = (
        np.array([circuit.ring_to_ring_breakdown for circuit in circuits])
        for circuits in (smooth_circuits, solution.circuits())
    )
    return fed_by_arcs(smooth, rough, lowest)


def fed_by_arcs(smooth: Array, rough: Array, lowest: float) -> Array:
    """Breakdown voltages at which an arc burns [V]: of films under high summits, and as smooth as they would
    be; ``lowest`` voltage at which an arc burns.

    A film whose summits break down below this voltage discharges as soon as an arc burns. Arcs that a smooth
    film would not feed either are refused by ``check_extinction``.
    """
    least = _BURNS * lowest
    return np.where(smooth > least, np.maximum(rough, least), rough)


def check_extinction(breakdown: Breakdown, limits: ArrayLike, name: str) -> None:
    """Refuse arcs that go out at a voltage at which the films of a bearing or a mesh break down.

    ``limits`` are its breakdown voltages [V].
    """
    lowest, least = breakdown.lowest_voltage, float(np.min(limits))
    if lowest < least:
        return
    takes = f"less than {readable(least)} V, at which the films of {name} break down"
    if breakdown.extinction_voltage is not None:
        raise InputError("breakdown.extinction_voltage", got=f"{readable(lowest)} V", takes=takes)
    current, through = breakdown.extinction_current, breakdown.arc_resistance
    raise InputError(
        "breakdown.extinction_current",
        got=f"{readable(current or 0.0)} A through arc_resistance of {readable(through)} ohm, which "
        f"is {readable(lowest)} V",
        takes=takes,
    )
