"""Breakdown voltages of a bearing and its shaft, and its discharges: energy, pit, current density and
leakage.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from operator import mul, truediv
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray, Numbers, labels, where
from ehlectric.bearing.circuit import (
    EQUAL,
    Circuit,
    leakage_conductance,
    shaft_first_break,
    shaft_ring_to_ring_breakdown,
)
from ehlectric.bearing.impedance import film_share, oil_relaxation_time, shaft_capacitance, shaft_path
from ehlectric.bearing.solution import (
    BearingSolution,
    capacitance,
    capacitance_is_bound,
    conducts,
    dry_areas,
    insulating,
)
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Motor
from ehlectric.discharge.discharge_laws import (
    CURRENT_DENSITY_LIMITS,
    compared_with_limits,
    known,
    pit_diameter,
    stored_energy,
    volume_of_pit,
)
from ehlectric.quantities.formats import amount
from ehlectric.quantities.result_warnings import WarningCondition
from ehlectric.readable import readable


def voltage_ratio(winding_rotor: Numbers, rotor_frame: Numbers, first: Numbers, second: Numbers) -> Numbers:
    """Bearing voltage ratio of a motor: share of the common-mode voltage that lies on its bearings.

    The capacitive divider gives C_wr/(C_wr + C_rf + C_DE + C_NDE).

    ``winding_rotor`` and ``rotor_frame``, capacitance C_wr from winding to rotor, and C_rf from rotor to
    frame [F]; ``first`` and ``second``, capacitances C_DE and C_NDE from shaft to housing at the drive end
    and the non-drive end [F]; all of shape (...). Returns bearing voltage ratio, dimensionless, shape (...).

    Examples
    --------
    >>> round(voltage_ratio(20e-12, 1e-9, 70e-12, 70e-12), 4)
    0.0172
    """
    return winding_rotor / (winding_rotor + rotor_frame + first + second)


def bearing_voltage_ratio(solution: BearingSolution) -> Numbers | None:
    """Share of the motor's common-mode voltage between shaft and housing of a solved bearing, shape (...).

    None without a motor, where surfaces touch and conduct, and where only an upper bound of the capacitance
    is known; of many points NaN where surfaces touch.
    """
    motor = solution.case.motor
    if motor is None or capacitance_is_bound(solution):
        return None
    first = shaft_capacitance(solution)
    second = motor.second_bearing_capacitance
    ratio = voltage_ratio(
        motor.winding_rotor_capacitance,
        motor.rotor_frame_capacitance,
        first,
        first if second is None else second,
    )
    return where(~np.asarray(conducts(solution)), ratio)


def shaft_voltage(solution: BearingSolution) -> Numbers | None:
    """Shaft voltage by the capacitive divider [V]; None where ``bearing_voltage_ratio`` is None."""
    motor, ratio = solution.case.motor, bearing_voltage_ratio(solution)
    return None if motor is None or ratio is None else ratio * motor.common_mode_voltage


def edge_current(solution: BearingSolution) -> Numbers | None:
    """Peak capacitive current through films and coating at an edge of the inverter, C BVR dv/dt [A]; None
    without the slope of the common-mode voltage, and where ``bearing_voltage_ratio`` is None.
    """
    motor, ratio = solution.case.motor, bearing_voltage_ratio(solution)
    if motor is None or motor.voltage_slope is None or ratio is None:
        return None
    films = shaft_capacitance(solution) - shaft_path(solution).parallel
    return films * ratio * motor.voltage_slope


def film_voltage(solution: BearingSolution) -> Numbers | None:
    """Part of the shaft voltage across the films, from ring to ring [V]; None as ``shaft_voltage``."""
    return known(mul, film_share(solution), shaft_voltage(solution))


@dataclass(frozen=True)
class Breakdown:
    """Voltages at which films break down, over the positions of the cage; NaN where a point has none.

    The bearing voltage is that across the films, from ring to ring. The shaft voltage is that from shaft to
    housing; it is larger where a coating on a ring takes a part of it.
    """

    # first_break and first_break_mean: bearing voltage at which the first contact breaks down, minimum and
    # mean over the positions [V].
    first_break: Numbers
    first_break_mean: Numbers
    first_break_at: Any  # name of the contact that breaks down first
    # ring_to_ring_breakdown and ring_to_ring_breakdown_mean: bearing voltage at which the first element
    # breaks down from ring to ring, minimum and mean over the positions [V].
    ring_to_ring_breakdown: Numbers
    ring_to_ring_breakdown_mean: Numbers
    # shaft_first_break and shaft_ring_to_ring_breakdown: shaft voltages of both breakdowns, minimum over the
    # positions [V].
    shaft_first_break: Numbers
    shaft_ring_to_ring_breakdown: Numbers


def breakdown_of(solution: BearingSolution) -> Breakdown | None:
    """Bearing and shaft voltages at which the films of a solved bearing break down.

    None for ceramic elements, where surfaces touch, and without a dielectric strength; of many points NaN
    and an empty name where surfaces touch.
    """
    circuits, path = solution.circuits(), shaft_path(solution)
    first = np.array([circuit.first_break for circuit in circuits])
    through = np.array([circuit.ring_to_ring_breakdown for circuit in circuits])
    known = insulating(solution) & np.all(np.isfinite(through), axis=0)
    if not np.any(known):
        return None
    voltages = {
        "first_break": np.min(first, axis=0),
        "first_break_mean": np.mean(first, axis=0),
        "ring_to_ring_breakdown": np.min(through, axis=0),
        "ring_to_ring_breakdown_mean": np.mean(through, axis=0),
        "shaft_first_break": np.min(
            np.array([shaft_first_break(circuit, path) for circuit in circuits]), axis=0
        ),
        "shaft_ring_to_ring_breakdown": np.min(
            np.array([shaft_ring_to_ring_breakdown(circuit, path) for circuit in circuits]), axis=0
        ),
    }
    at: dict[str, Any] = {name: where(known, values) for name, values in voltages.items()}
    return Breakdown(
        first_break_at=labels((known, _weakest(circuits, _first_of_least(first, axis=0))), ""), **at
    )


def _first_of_least(values: Array, axis: int) -> IntArray:
    """Place of the first value along an axis that is the least one within rounding."""
    least = np.min(values, axis=axis, keepdims=True)
    first: IntArray = np.argmax(values <= least * (1.0 + EQUAL), axis=axis)
    return first


def _weakest(circuits: Sequence[Circuit], at: IntArray) -> Any:
    """Name of the contact that breaks down first at the position ``at`` of each point, shape (...)."""
    points = tuple(np.indices(at.shape))
    breaks = np.array([circuit.first_breaks for circuit in circuits])[at, *points]
    element = _first_of_least(breaks, axis=-1)
    inner = np.array([circuit.inner_first for circuit in circuits])[at, *points, element]
    names = [
        [f"{ring} contact of element {k}" for ring in ("outer", "inner")]
        for k in range(circuits[0].inner.shape[-1])
    ]
    weakest = np.array(names)[element, inner.astype(int)]
    return weakest if weakest.ndim else str(weakest)


def first_margin(solution: BearingSolution) -> Numbers | None:
    """Margin of a solved bearing: shaft voltage of its first breakdown over its shaft voltage, or None."""
    breakdown = breakdown_of(solution)
    return None if breakdown is None else known(truediv, breakdown.shaft_first_break, shaft_voltage(solution))


# Roughness of both surfaces: films that are f times as thick have the lambda ratios of 1/f of it.
ROUGHNESS = "bearing.composite_rq"


def with_films_scaled(case: BearingCase, scale: Numbers) -> BearingCase:
    """Case that has the lambda ratios of films that are ``scale`` times as thick, shape (...)."""
    return case.with_values({ROUGHNESS: case.bearing.composite_rq / scale})


# Factor on all films with which no surfaces touch.
_APART = 1e6


def margin_apart(solution: BearingSolution) -> Numbers | None:
    """Margin that a solved bearing has with films so thick that its surfaces do not touch, shape (...).

    Only ratios of such margins are of use: margins of smooth films, in units of the thicker ones. None where
    there is no margin for another reason: without a motor or a dielectric strength, or with ceramic elements.
    """
    return first_margin(replace(solution, case=with_films_scaled(solution.case, _APART)))


def margin_with_films(solution: BearingSolution, scale: Array) -> Array:
    """Margins of a single bearing with all films ``scale`` times as thick, shape (n,); 0 where it touches.

    Breakdown voltages follow the films and what summits leave of them; capacitances stay as they are.
    """
    margin = first_margin(replace(solution, case=with_films_scaled(solution.case, scale)))
    margins: Array = np.zeros_like(scale) if margin is None else scale * np.nan_to_num(margin)
    return margins


def strength_per_volt(solution: BearingSolution) -> Numbers | None:
    """Maximum field strength per volt across the films, of all contacts and positions of the cage [1/m]:
    the field strength under the highest summits.

    None for ceramic elements, and where surfaces touch; of many points NaN where surfaces touch.
    """
    strengths = [
        np.max(share * ring.values.strength_per_volt / ring.part_left(solution.summits), axis=-1)
        for position, circuit in zip(solution.positions, solution.circuits(), strict=True)
        for share, ring in (
            (position.inner_share(circuit), position.inner),
            (1.0 - position.inner_share(circuit), position.outer),
        )
    ]
    largest: Numbers = np.max(strengths, axis=0)
    return where(insulating(solution), largest)


@dataclass(frozen=True)
class BearingCosts:
    """Energy of a discharge through a bearing, the pit that it melts, and the current density.

    A value is None if the case lacks an input that it needs. Energies and pits are None for ceramic elements,
    and below a lambda ratio of 1, where no voltage is computed.
    """

    # Capacitance that a discharge through the films empties [F]: the capacitance of the films, and the
    # capacitances between the shaft and everything else, which a coating on a ring puts in series with its
    # own.
    discharged_capacitance: Numbers | None
    # Energy C V^2/2 that is stored only in the films, at the shaft voltage [J].
    bearing_energy: Numbers | None
    # Energy C V^2/2 of ``discharged_capacitance`` at the shaft voltage, of which V is across the films [J].
    discharge_energy: Numbers | None
    # Energy C V^2/2 that is stored in ``discharged_capacitance``, at the first breakdown [J].
    breakdown_energy: Numbers | None
    pit_volume: Numbers | None  # volume of one surface that ``discharge_energy`` melts [m^3]
    pit_diameter: Numbers | None  # diameter of a hemisphere of that volume [m]
    breakdown_pit_diameter: Numbers | None  # diameter of the hemisphere that ``breakdown_energy`` melts [m]
    # Area of the dry contacts through which a current flows [m^2]: the smaller contact of every element that
    # both rings load, with the cage at its first position.
    hertz_area: Numbers
    current_density: Numbers | None  # peak current over ``hertz_area`` [A/m^2]
    # Peak current over the smaller contact of the most loaded element, as if it flowed only through this
    # element [A/m^2].
    element_current_density: Numbers | None
    current_density_limits: tuple[float, ...] | None  # published limits of ``current_density`` [A/m^2]


def bearing_costs(solution: BearingSolution) -> BearingCosts:
    """Energy of a discharge through a solved bearing, the pit that it melts, and the current density. Returns
    values in SI units.

    One discharge empties all of the charge. Winding and frame have fixed potentials meanwhile, so that their
    capacitances to the rotor and the capacitances of both bearings are parallel. If the first breakdown
    leaves the other contact of its element intact, the energy flows only at the ring-to-ring breakdown.

    Behind a coating of the capacitance C_c, a discharge of films of the capacitance C at the voltage V moves
    the charge of all other capacitances C_s of the shaft only as far as the coating lets it pass. The energy
    that the discharge releases is V^2/2 [C + C_s C_c/(C_s + C_c)].
    """
    case, breakdown = solution.case, breakdown_of(solution)
    across = None if solution.conditions.ceramic else film_voltage(solution)
    total, pit = _discharged(solution), case.discharge.pit
    discharged = known(stored_energy, total, across)
    at_break = known(stored_energy, total, None if breakdown is None else breakdown.first_break)
    volume, at_first = (volume_of_pit(pit, energy) for energy in (discharged, at_break))
    areas = conducting_areas(solution)
    whole, largest = np.sum(areas, axis=-1), np.max(areas, axis=-1)
    current = case.discharge.peak_current
    return BearingCosts(
        discharged_capacitance=total,
        bearing_energy=known(stored_energy, capacitance(solution), across),
        discharge_energy=discharged,
        breakdown_energy=at_break,
        pit_volume=volume,
        pit_diameter=known(pit_diameter, volume),
        breakdown_pit_diameter=known(pit_diameter, at_first),
        hertz_area=whole,
        current_density=_density(current, whole),
        element_current_density=_density(current, largest),
        current_density_limits=None if current is None else CURRENT_DENSITY_LIMITS,
    )


def _density(current: Numbers | None, area: Numbers) -> Numbers | None:
    """Current density [A/m^2] of a current [A] through an area [m^2]; None where no area carries it."""
    return None if current is None else where(area > 0.0, current / np.where(area > 0.0, area, 1.0)[()])


def _discharged(solution: BearingSolution) -> Numbers | None:
    """Capacitance that a discharge empties [F]; None where nothing says what is connected to the bearing."""
    connected = _connected(solution)
    return None if connected is None else where(insulating(solution), connected)


def _connected(solution: BearingSolution) -> Numbers | None:
    """Capacitance of the films and of what is connected to them [F]; None where nothing says what that is."""
    case, films, path = solution.case, capacitance(solution), shaft_path(solution)
    motor, external = case.motor, case.discharge.external_capacitance
    if motor is not None:
        second = motor.second_bearing_capacitance
        machine = motor.winding_rotor_capacitance + motor.rotor_frame_capacitance + path.parallel
        return films + path.behind_coating(
            machine + (shaft_capacitance(solution) if second is None else second)
        )
    return None if external is None else films + path.behind_coating(external + path.parallel)


def conducting_areas(solution: BearingSolution) -> Array:
    """Area of the smaller dry contact of each element, shape (..., n) [m^2]; 0 where not both are loaded."""
    inner, outer = (dry_areas(solution, ring) for ring in solution.positions[0].rings)
    return np.minimum(inner, outer)


# Apparent current density [A/m^2] below which life was shortened by white etching cracks under some
# conditions, doi:10.3390/lubricants11040164. A thousandth of it is taken as no current.
WHITE_ETCHING = 1e3


def current_warning_conditions(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Warning of an apparent current density above the lowest of the published limits, or so low that only
    white etching cracks are known of it.
    """
    density = bearing_costs(solution).current_density
    if density is not None:
        low = np.logical_and(density > 1e-3 * WHITE_ETCHING, density < WHITE_ETCHING)
        yield WarningCondition.of(low, "white-etching", density=1e-6 * density)
        yield WarningCondition.of(
            density > CURRENT_DENSITY_LIMITS[0],
            "current-density-high",
            "bearing",
            density=1e-6 * density,
            limits=lambda: compared_with_limits(float(density)),
        )


# Switching frequencies of inverters for low-voltage motors [Hz], with which the leakage is compared where the
# case gives none. They are typical values of catalogues.
TYPICAL = 4e3, 20e3


@dataclass(frozen=True)
class ShaftLeakage:
    """Decay of the shaft voltage, and of its part across the films, through the oil of both bearings."""

    time_constant: Numbers  # time constant T of the shaft voltage right after an edge of the inverter [s]
    # Time constant of the voltage across the films right after an edge [s]. Without a coating on a ring, it
    # is the time constant of the shaft voltage.
    film_time_constant: Numbers
    # Part of the shaft voltage that is left after a period of the inverter, dimensionless; exp(-1/(f T))
    # without a coating. None without a switching frequency.
    after_period: Numbers | None
    # Part of the voltage across the films that is left after a period, dimensionless; None likewise.
    film_after_period: Numbers | None
    # Shaft voltage at the end of an edge divided by the voltage of the capacitive divider, dimensionless;
    # None without a rise time.
    after_rise: Numbers | None


@dataclass(frozen=True)
class Decay:
    """Two voltages in series, across films and coating, that decay through the oil, with a capacitance in
    parallel.

    The current i into films and coating changes their voltages by V' = (i - G V)/C and V_c' = i/C_c. The sum
    of both falls by (i + G_s (V + V_c))/C_s. The coating itself does not leak.

    Examples
    --------
    Films with nothing else at the shaft except a large coating have the time constant C/G of their oil:

    >>> decay = Decay(films=1e-10, conductance=1e-8, elastance=1e-3, shaft=1e-20, leak=0.0)
    >>> round(decay.film_time_constant, 6)
    0.01
    """

    # films and conductance: capacitance C [F] and conductance G [S] of the films, shape (...).
    films: Numbers
    conductance: Numbers
    elastance: Numbers  # reciprocal capacitance 1/C_c of the coating [1/F]; 0 without a coating, shape (...)
    shaft: Numbers  # all other capacitances C_s of the shaft [F], shape (...)
    leak: Numbers  # conductance G_s parallel to them [S], shape (...)

    @property
    def start(self) -> tuple[Numbers, Numbers]:
        """Voltages across films and coating right after an edge, over the shaft voltage, shape (...)."""
        share = 1.0 / (1.0 + self.films * self.elastance)
        return share, 1.0 - share

    def rates(self, films: Numbers, coating: Numbers) -> tuple[Numbers, Numbers]:
        """Rates A x of voltages x across films and coating, in the unit of the voltages over s."""
        leak_rate = self.conductance / self.films
        current = leak_rate * films - self.leak / self.shaft * (films + coating)
        current = current / (1.0 / self.films + self.elastance + 1.0 / self.shaft)
        return current / self.films - leak_rate * films, current * self.elastance

    @property
    def time_constant(self) -> Numbers:
        """Time constant of the sum of both voltages right after an edge [s]."""
        films, coating = self.rates(*self.start)
        return -1.0 / (films + coating)

    @property
    def film_time_constant(self) -> Numbers:
        """Time constant of the voltage across the films right after an edge [s]."""
        return -self.start[0] / self.rates(*self.start)[0]

    def after(self, time: Numbers) -> tuple[Numbers, Numbers]:
        """Voltages across films and coating a time [s] after an edge, over the shaft voltage."""
        return self._along(lambda rate: np.exp(rate * time))

    def after_rise(self, time: Numbers) -> Numbers:
        """Shaft voltage at the end of an edge that lasts a time [s], divided by the voltage of the capacitive
        divider.

        It is the mean over the edge of the voltages that its parts leave.
        """

        def mean(rate: Numbers) -> Numbers:
            exponent = rate * time
            zero = exponent == 0.0
            return np.where(zero, 1.0, np.expm1(exponent) / np.where(zero, 1.0, exponent))

        films, coating = self._along(mean)
        return np.asarray(films + coating)[()]

    def _along(self, function: Callable[[Numbers], Numbers]) -> tuple[Numbers, Numbers]:
        """Function f of the matrix A, f(A) x = f(a) x + (f(a) - f(b))/(a - b) (A x - a x), at the start x.

        Both eigenvalues a and b are real and not above 0, as the circuit has no inductance.
        """
        start = self.start
        rates = self.rates(*start)
        first, second = self.rates(1.0, 0.0), self.rates(0.0, 1.0)
        middle = 0.5 * (first[0] + second[1])
        apart = np.sqrt((0.5 * (first[0] - second[1])) ** 2 + second[0] * first[1])
        slow, fast = middle + apart, middle - apart
        # Two eigenvalues that are alike are both 0: nothing conducts.
        slope = (function(slow) - function(fast)) / np.where(apart > 0.0, slow - fast, np.inf)
        films, coating = (
            function(slow) * voltage + slope * (rate - slow * voltage)
            for voltage, rate in zip(start, rates, strict=True)
        )
        return films, coating


def shaft_leakage(solution: BearingSolution) -> ShaftLeakage | None:
    """Decay of the shaft voltage of a solved bearing through the oil of both bearings. Returns None without a
    conductivity or a motor, for ceramic elements, and below a lambda ratio of 1.

    Without a coating, the capacitances from the shaft to winding, frame and both bearings have the sum C, and
    both bearings the conductance G, so that T = C/G. An edge that rises over the time t_r leaves
    V T/t_r (1 - exp(-t_r/T)), where V is the voltage of the capacitive divider. The other bearing has the
    same oil as this one. If its capacitance is not given, it has the same coating and parallel capacitance.
    """
    tau, motor, insulates = oil_relaxation_time(solution), solution.case.motor, insulating(solution)
    if tau is None or motor is None or not np.any(insulates):
        return None
    decay = _decay(solution, motor, tau)
    constant, of_films = (where(insulates, time) for time in (decay.time_constant, decay.film_time_constant))
    assert constant is not None and of_films is not None
    left = None if motor.switching_frequency is None else decay.after(1.0 / motor.switching_frequency)
    return ShaftLeakage(
        time_constant=constant,
        film_time_constant=of_films,
        after_period=None if left is None else where(insulates, left[0] + left[1]),
        film_after_period=None if left is None else where(insulates, left[0] / decay.start[0]),
        after_rise=None if motor.rise_time is None else where(insulates, decay.after_rise(motor.rise_time)),
    )


def _decay(solution: BearingSolution, motor: Motor, tau: Numbers) -> Decay:
    """Circuit of the shaft of a motor whose oil has a relaxation time [s]."""
    films, path = capacitance(solution), shaft_path(solution)
    conductance, second = oil_conductance(solution, tau), motor.second_bearing_capacitance
    machine = motor.winding_rotor_capacitance + motor.rotor_frame_capacitance
    share: Numbers
    leak: Numbers
    if second is None:
        # Two equal bearings share what is parallel to them: half of it belongs to each.
        share, leak = 0.5 * machine + path.parallel, 0.0
    else:
        share, leak = machine + path.parallel + second, conductance * second / films
    return Decay(films, conductance, 1.0 / path.coating, share, leak)


def oil_conductance(solution: BearingSolution, tau: Numbers) -> Numbers:
    """Conductance of the oil of a bearing with its relaxation time [s], mean over the positions [S]."""
    fill = solution.case.bearing.fill
    values = [leakage_conductance(*position.capacitances(fill), tau) for position in solution.positions]
    mean: Numbers = np.mean(np.array(values), axis=0)
    return mean


def leakage_warning_conditions(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Warning of a shaft voltage that leaks away through the oil within a period of the inverter."""
    leaks, motor = shaft_leakage(solution), solution.case.motor
    if leaks is None or motor is None:
        return
    frequency = motor.switching_frequency
    period = 1.0 / (TYPICAL[0] if frequency is None else frequency)
    tau, shaft = oil_relaxation_time(solution), shaft_voltage(solution)
    coated = shaft_path(solution).coated
    yield WarningCondition.of(
        leaks.film_time_constant < period,
        "shaft-leaks",
        relaxation=lambda: amount(float(tau or 0.0), "s"),
        part="part of the shaft voltage across the films" if coated else "shaft voltage",
        decay=lambda: amount(float(leaks.film_time_constant), "s"),
        period=lambda: _period_text(frequency),
        shaft=shaft,
        advice=lambda: _edge_text(motor, leaks, float(shaft or 0.0)),
    )


def _period_text(frequency: float | None) -> str:
    """Period of the inverter [s] by its frequency [Hz], or the periods of typical inverters, as text."""
    if frequency is not None:
        return f"{amount(1.0 / frequency, 's')}, a period of the inverter"
    longest, shortest = (amount(1.0 / at, "s") for at in TYPICAL)
    return (
        f"{shortest} to {longest}, the periods of typical inverters (give motor.switching_frequency for "
        "your inverter)"
    )


def _edge_text(motor: Motor, leaks: ShaftLeakage, shaft: float) -> str:
    """Voltage after an edge of the inverter as text, from the shaft voltage of the divider [V]."""
    if leaks.after_rise is None or motor.rise_time is None:
        return "Give motor.rise_time for the voltage after an edge"
    left = float(leaks.after_rise * shaft)
    return f"After an edge of {amount(motor.rise_time, 's')} it is {readable(left)} V; check the conductivity"
