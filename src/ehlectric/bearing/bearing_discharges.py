"""Breakdown voltages of a bearing and its shaft, and its discharges: energy, pit, current density and
leakage.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from operator import mul, truediv

import numpy as np
from scipy.linalg import expm

from ehlectric.arrays import Array
from ehlectric.bearing.circuit import leakage_conductance, shaft_first_break, shaft_through_breakdown
from ehlectric.bearing.impedance import film_share, oil_relaxation_time, shaft_capacitance, shaft_path
from ehlectric.bearing.solution import (
    BearingSolution,
    capacitance,
    capacitance_is_bound,
    dry_areas,
    insulating,
    lubrication,
)
from ehlectric.cases.bearing_inputs import Motor
from ehlectric.discharge.discharge_laws import (
    CURRENT_DENSITY_LIMITS,
    beside_limits,
    known,
    pit_diameter,
    stored_energy,
    volume_of_pit,
)
from ehlectric.errors import ResultWarning
from ehlectric.quantities.formats import amount


def voltage_ratio(winding_rotor: float, rotor_frame: float, first: float, second: float) -> float:
    """Bearing voltage ratio of a motor: share of the common-mode voltage that lies on its bearings.

    The capacitive divider gives C_wr/(C_wr + C_rf + C_DE + C_NDE).

    ``winding_rotor`` and ``rotor_frame``, capacitance C_wr from winding to rotor, and C_rf from rotor to
    frame [F]; ``first`` and ``second``, capacitances C_DE and C_NDE from shaft to housing at the drive end
    and the non-drive end [F]. Returns bearing voltage ratio, dimensionless.

    Examples
    --------
    >>> round(voltage_ratio(20e-12, 1e-9, 70e-12, 70e-12), 4)
    0.0172
    """
    return winding_rotor / (winding_rotor + rotor_frame + first + second)


def bearing_voltage_ratio(solution: BearingSolution) -> float | None:
    """Share of the motor's common-mode voltage between shaft and housing of a solved bearing.

    None without a motor, where surfaces touch and conduct, and where only an upper bound of the capacitance
    is known.
    """
    motor = solution.case.motor
    if motor is None or lubrication(solution) == "conducting" or capacitance_is_bound(solution):
        return None
    own = shaft_capacitance(solution)
    second = motor.second_bearing_capacitance
    return voltage_ratio(
        motor.winding_rotor_capacitance,
        motor.rotor_frame_capacitance,
        own,
        own if second is None else second,
    )


def shaft_voltage(solution: BearingSolution) -> float | None:
    """Shaft voltage by the capacitive divider [V]; None where ``bearing_voltage_ratio`` is None."""
    motor, ratio = solution.case.motor, bearing_voltage_ratio(solution)
    return None if motor is None or ratio is None else ratio * motor.common_mode_voltage


def film_voltage(solution: BearingSolution) -> float | None:
    """Part of the shaft voltage across the films, from ring to ring [V]; None as ``shaft_voltage``."""
    return known(mul, film_share(solution), shaft_voltage(solution))


@dataclass(frozen=True)
class Breakdown:
    """Voltages at which films break down, over the positions of the cage.

    The bearing voltage is that across the films, from ring to ring. The shaft voltage is that from shaft to
    housing; it is larger where a coating on a ring takes a part of it.
    """

    # first_break and first_break_mean: bearing voltage at which the first contact breaks down, minimum and
    # mean over the positions [V].
    first_break: float
    first_break_mean: float
    first_break_at: str  # name of the contact that breaks down first
    # through_breakdown and through_breakdown_mean: bearing voltage at which the first element breaks down
    # from ring to ring, minimum and mean over the positions [V].
    through_breakdown: float
    through_breakdown_mean: float
    # shaft_first_break and shaft_through_breakdown: shaft voltages of both breakdowns, minimum over the
    # positions [V].
    shaft_first_break: float
    shaft_through_breakdown: float


def breakdown_of(solution: BearingSolution) -> Breakdown | None:
    """Bearing and shaft voltages at which the films of a solved bearing break down.

    None for ceramic elements, where surfaces touch, and without a dielectric strength.
    """
    circuits, path = solution.circuits(), shaft_path(solution)
    first = np.array([circuit.first_break for circuit in circuits])
    through = np.array([circuit.through_breakdown for circuit in circuits])
    if not insulating(solution) or not np.all(np.isfinite(through)):
        return None
    weakest = circuits[int(np.argmin(first))]
    k = int(np.argmin(weakest.first_breaks))
    return Breakdown(
        first_break=float(np.min(first)),
        first_break_mean=float(np.mean(first)),
        first_break_at=f"{'inner' if weakest.inner_first[k] else 'outer'} contact of element {k}",
        through_breakdown=float(np.min(through)),
        through_breakdown_mean=float(np.mean(through)),
        shaft_first_break=min(shaft_first_break(circuit, path) for circuit in circuits),
        shaft_through_breakdown=min(shaft_through_breakdown(circuit, path) for circuit in circuits),
    )


def first_margin(solution: BearingSolution) -> float | None:
    """Margin of a solved bearing: shaft voltage of its first breakdown over its shaft voltage, or None."""
    breakdown = breakdown_of(solution)
    return None if breakdown is None else known(truediv, breakdown.shaft_first_break, shaft_voltage(solution))


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


@dataclass(frozen=True)
class BearingCosts:
    """Energy of a discharge through a bearing, the pit that it melts, and the current density.

    A value is None if the case lacks an input that it needs. Energies and pits are None for ceramic elements,
    and below a lambda ratio of 1, where no voltage is computed.
    """

    # Capacitance that a discharge through the films empties [F]: that of the films, and those between the
    # shaft and everything else, which a coating on a ring puts in series with its own.
    discharged_capacitance: float | None
    bearing_energy: float | None  # energy C V^2/2 that is stored in the films alone, at the shaft voltage [J]
    # Energy C V^2/2 of ``discharged_capacitance`` at the shaft voltage, of which V is across the films [J].
    discharge_energy: float | None
    # Energy C V^2/2 that is stored in ``discharged_capacitance``, at the first breakdown [J].
    breakdown_energy: float | None
    pit_volume: float | None  # volume of one surface that ``discharge_energy`` melts [m^3]
    pit_diameter: float | None  # diameter of a hemisphere of that volume [m]
    breakdown_pit_diameter: float | None  # diameter of the hemisphere that ``breakdown_energy`` melts [m]
    # Area of the dry contacts through which a current flows [m^2]: the smaller contact of every element that
    # both rings load, with the cage at its first position.
    hertz_area: float
    current_density: float | None  # peak current over ``hertz_area`` [A/m^2]
    # Peak current over the smaller contact of the most loaded element, as if it flowed through this element
    # alone [A/m^2].
    element_current_density: float | None
    current_density_limits: tuple[float, ...] | None  # published limits of ``current_density`` [A/m^2]


def bearing_costs(solution: BearingSolution) -> BearingCosts:
    """Energy of a discharge through a solved bearing, the pit that it melts, and the current density. Returns
    values in SI units.

    One discharge empties all of the charge. Winding and frame have fixed potentials meanwhile, so that their
    capacitances to the rotor and those of both bearings are parallel. If the first breakdown leaves the other
    contact of its element intact, the energy flows only at the ring-to-ring breakdown.

    Behind a coating of the capacitance C_c, a discharge of films of the capacitance C at the voltage V moves
    the charge of all other capacitances C_s of the shaft only as far as the coating lets it pass. The energy
    that the discharge releases is V^2/2 [C + C_s C_c/(C_s + C_c)].
    """
    case, breakdown = solution.case, breakdown_of(solution)
    across = film_voltage(solution) if insulating(solution) else None
    total, pit = _discharged(solution), case.discharge.pit
    discharged = known(stored_energy, total, across)
    at_break = known(stored_energy, total, None if breakdown is None else breakdown.first_break)
    volume, at_first = (volume_of_pit(pit, energy) for energy in (discharged, at_break))
    areas = conducting_areas(solution)
    whole, largest = float(np.sum(areas)), float(np.max(areas))
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
        current_density=known(truediv, current, whole or None),
        element_current_density=known(truediv, current, largest or None),
        current_density_limits=None if current is None else CURRENT_DENSITY_LIMITS,
    )


def _discharged(solution: BearingSolution) -> float | None:
    """Capacitance that a discharge empties [F]; None where nothing says what is connected to the bearing."""
    if not insulating(solution):
        return None
    case, own, path = solution.case, capacitance(solution), shaft_path(solution)
    motor, external = case.motor, case.discharge.external_capacitance
    if motor is not None:
        second = motor.second_bearing_capacitance
        beside = motor.winding_rotor_capacitance + motor.rotor_frame_capacitance + path.parallel
        return own + path.behind_coating(beside + (shaft_capacitance(solution) if second is None else second))
    return None if external is None else own + path.behind_coating(external + path.parallel)


def conducting_areas(solution: BearingSolution) -> Array:
    """Area of the smaller dry contact of each element, shape (n,) [m^2]; 0 where a ring does not load it."""
    inner, outer = (dry_areas(solution, ring) for ring in solution.positions[0].rings)
    return np.minimum(inner, outer)


def current_warnings(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warning of an apparent current density above the lowest of the published limits."""
    density = bearing_costs(solution).current_density
    if density is None or density <= CURRENT_DENSITY_LIMITS[0]:
        return
    limits = beside_limits(density)
    yield ResultWarning.of("current-density-high", "bearing", density=1e-6 * density, limits=limits)


# Switching frequencies of inverters for low-voltage motors [Hz], with which the leakage is compared where the
# case gives none. They are typical values of catalogues.
TYPICAL = 4e3, 20e3


@dataclass(frozen=True)
class ShaftLeakage:
    """Decay of the shaft voltage, and of its part across the films, through the oil of both bearings."""

    time_constant: float  # time constant T of the shaft voltage right after an edge of the inverter [s]
    # Time constant of the voltage across the films right after an edge [s]. Without a coating on a ring, it
    # is that of the shaft voltage.
    film_time_constant: float
    # Part of the shaft voltage that is left after a period of the inverter, dimensionless; exp(-1/(f T))
    # without a coating. None without a switching frequency.
    after_period: float | None
    # Part of the voltage across the films that is left after a period, dimensionless; None likewise.
    film_after_period: float | None
    # Shaft voltage at the end of an edge over that of the capacitive divider, dimensionless; None without a
    # rise time.
    after_rise: float | None


@dataclass(frozen=True)
class Decay:
    """Two voltages in series, across films and coating, that decay through the oil beside a capacitance.

    The current i into films and coating changes their voltages by V' = (i - G V)/C and V_c' = i/C_c. The sum
    of both falls by (i + G_s (V + V_c))/C_s. The coating itself does not leak.

    Examples
    --------
    Films alone, with nothing else at the shaft but a large coating, have the time constant C/G of their oil:

    >>> decay = Decay(films=1e-10, conductance=1e-8, elastance=1e-3, beside=1e-20, leak=0.0)
    >>> round(decay.film_time_constant, 6)
    0.01
    """

    # films and conductance: capacitance C [F] and conductance G [S] of the films.
    films: float
    conductance: float
    elastance: float  # reciprocal capacitance 1/C_c of the coating [1/F]; 0 without a coating
    beside: float  # all other capacitances C_s of the shaft [F]
    leak: float  # conductance G_s parallel to them [S]

    @property
    def start(self) -> Array:
        """Voltages across films and coating right after an edge, over the shaft voltage, shape (2,)."""
        share = 1.0 / (1.0 + self.films * self.elastance)
        return np.array([share, 1.0 - share])

    @property
    def rates(self) -> Array:
        """Matrix A of the rates x' = A x of both voltages, shape (2, 2) [1/s]."""
        own = self.conductance / self.films
        current = np.array([own, 0.0]) - self.leak / self.beside
        current /= 1.0 / self.films + self.elastance + 1.0 / self.beside
        return np.array([current / self.films - np.array([own, 0.0]), current * self.elastance])

    @property
    def time_constant(self) -> float:
        """Time constant of the sum of both voltages right after an edge [s]."""
        return -1.0 / float(np.sum(self.rates @ self.start))

    @property
    def film_time_constant(self) -> float:
        """Time constant of the voltage across the films right after an edge [s]."""
        return -float(self.start[0]) / float((self.rates @ self.start)[0])

    def after(self, time: float) -> Array:
        """Voltages across films and coating a time [s] after an edge, over the shaft voltage, shape (2,)."""
        left: Array = expm(time * self.rates) @ self.start
        return left

    def after_rise(self, time: float) -> float:
        """Shaft voltage at the end of an edge that lasts a time [s], over that of the capacitive divider."""
        ramp = np.zeros((3, 3))
        ramp[:2, :2], ramp[:2, 2] = time * self.rates, self.start
        return float(np.sum(expm(ramp)[:2, 2]))


def shaft_leakage(solution: BearingSolution) -> ShaftLeakage | None:
    """Decay of the shaft voltage of a solved bearing through the oil of both bearings. Returns None without a
    conductivity or a motor, for ceramic elements, and below a lambda ratio of 1.

    Without a coating, the capacitances from the shaft to winding, frame and both bearings have the sum C, and
    both bearings the conductance G, so that T = C/G. An edge that rises over the time t_r leaves
    V T/t_r (1 - exp(-t_r/T)), where V is the voltage of the capacitive divider. The other bearing has the
    same oil as this one. If its capacitance is not given, it has the same coating and parallel capacitance.
    """
    tau, motor = oil_relaxation_time(solution), solution.case.motor
    if tau is None or motor is None or not insulating(solution):
        return None
    decay = _decay(solution, motor, tau)
    left = None if motor.switching_frequency is None else decay.after(1.0 / motor.switching_frequency)
    return ShaftLeakage(
        time_constant=decay.time_constant,
        film_time_constant=decay.film_time_constant,
        after_period=None if left is None else float(np.sum(left)),
        film_after_period=None if left is None else float(left[0] / decay.start[0]),
        after_rise=None if motor.rise_time is None else decay.after_rise(motor.rise_time),
    )


def _decay(solution: BearingSolution, motor: Motor, tau: float) -> Decay:
    """Circuit of the shaft of a motor whose oil has a relaxation time [s]."""
    own, path = capacitance(solution), shaft_path(solution)
    conductance, second = oil_conductance(solution, tau), motor.second_bearing_capacitance
    beside = motor.winding_rotor_capacitance + motor.rotor_frame_capacitance
    if second is None:
        # Two equal bearings share what is beside them: half of it belongs to each.
        share, leak = 0.5 * beside + path.parallel, 0.0
    else:
        share, leak = beside + path.parallel + second, conductance * second / own
    return Decay(own, conductance, 1.0 / path.coating, share, leak)


def oil_conductance(solution: BearingSolution, tau: float) -> float:
    """Conductance of the oil of a bearing with its relaxation time [s], mean over the positions [S]."""
    fill = solution.case.bearing.fill
    values = []
    for position in solution.positions:
        inner, outer = ((ring.capacitance(fill), ring.oil_capacitance(fill)) for ring in position.rings)
        values.append(leakage_conductance(inner, outer, tau))
    return float(np.mean(values))


def leakage_warnings(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warning of a shaft voltage that leaks away through the oil within a period of the inverter."""
    leaks, motor = shaft_leakage(solution), solution.case.motor
    tau, shaft = oil_relaxation_time(solution), shaft_voltage(solution)
    if leaks is None or motor is None or tau is None or shaft is None:
        return
    frequency = motor.switching_frequency
    if leaks.film_time_constant >= 1.0 / (TYPICAL[0] if frequency is None else frequency):
        return
    if frequency is None:
        longest, shortest = (amount(1.0 / at, "s") for at in TYPICAL)
        period = (
            f"{shortest} to {longest}, the periods of typical inverters; motor.switching_frequency gives "
            "that of yours"
        )
    else:
        period = f"{amount(1.0 / frequency, 's')}, a period of the inverter"
    edge = "give motor.rise_time for the voltage after an edge"
    if leaks.after_rise is not None and motor.rise_time is not None:
        edge = f"after an edge of {amount(motor.rise_time, 's')} it is {leaks.after_rise * shaft:.3g} V"
    part = (
        "shaft voltage" if not shaft_path(solution).coated else "part of the shaft voltage across the films"
    )
    yield ResultWarning.of(
        "shaft-leaks",
        relaxation=amount(tau, "s"),
        part=part,
        decay=amount(leaks.film_time_constant, "s"),
        period=period,
        shaft=shaft,
        edge=edge,
    )
