"""Leakage of the shaft voltage through the oil of the bearings, beside the period of the inverter."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

from ehlectric.arrays import Array
from ehlectric.bearing.circuit import leakage_conductance
from ehlectric.bearing.impedance import oil_relaxation_time
from ehlectric.bearing.meter.reading import shaft_path
from ehlectric.bearing.shaft_voltage import shaft_voltage
from ehlectric.bearing.solution import BearingSolution, capacitance, insulating
from ehlectric.cases.bearings.motor import Motor
from ehlectric.errors import ResultWarning
from ehlectric.quantities.formats import amount

# Switching frequencies of inverters for low-voltage motors [Hz], with which the leakage is compared where the
# case gives none. They are typical values of catalogues.
TYPICAL = 4e3, 20e3


@dataclass(frozen=True)
class ShaftLeakage:
    """Decay of the shaft voltage, and of its part across the films, through the oil of both bearings.

    Attributes
    ----------
    time_constant : float
        Time constant T of the shaft voltage right after an edge of the inverter [s].
    film_time_constant : float
        Time constant of the voltage across the films right after an edge [s]. Without a coating on a ring, it
        is that of the shaft voltage.
    after_period : float or None
        Part of the shaft voltage that is left after a period of the inverter, dimensionless; exp(-1/(f T))
        without a coating. None without a switching frequency.
    film_after_period : float or None
        Part of the voltage across the films that is left after a period, dimensionless; None likewise.
    after_rise : float or None
        Shaft voltage at the end of an edge over that of the capacitive divider, dimensionless; None without
        a rise time.
    """

    time_constant: float
    film_time_constant: float
    after_period: float | None
    film_after_period: float | None
    after_rise: float | None


@dataclass(frozen=True)
class Decay:
    """Two voltages in series, across films and coating, that decay through the oil beside a capacitance.

    Attributes
    ----------
    films, conductance : float
        Capacitance C [F] and conductance G [S] of the films.
    elastance : float
        Reciprocal capacitance 1/C_c of the coating [1/F]; 0 without a coating.
    beside : float
        All other capacitances C_s of the shaft [F].
    leak : float
        Conductance G_s parallel to them [S].

    Notes
    -----
    The current i into films and coating changes their voltages by V' = (i - G V)/C and V_c' = i/C_c. The sum
    of both falls by (i + G_s (V + V_c))/C_s. The coating itself does not leak.

    Examples
    --------
    Films alone, with nothing else at the shaft but a large coating, have the time constant C/G of their oil:

    >>> decay = Decay(films=1e-10, conductance=1e-8, elastance=1e-3, beside=1e-20, leak=0.0)
    >>> round(decay.film_time_constant, 6)
    0.01
    """

    films: float
    conductance: float
    elastance: float
    beside: float
    leak: float

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
    """Decay of the shaft voltage of a solved bearing through the oil of both bearings.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    ShaftLeakage or None
        None without a conductivity or a motor, for ceramic elements, and below a lambda ratio of 1.

    Notes
    -----
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
    at = "give motor.rise_time for the voltage after an edge"
    if leaks.after_rise is not None and motor.rise_time is not None:
        at = f"after an edge of {amount(motor.rise_time, 's')} it is {leaks.after_rise * shaft:.3g} V"
    decays = (
        "shaft voltage" if not shaft_path(solution).coated else "part of the shaft voltage across the films"
    )
    yield ResultWarning(
        "shaft-leaks",
        f"the oil conducts: its relaxation time is {amount(tau, 's')}, and the {decays} decays with a "
        f"time constant of {amount(leaks.film_time_constant, 's')}, compared with {period}; the shaft "
        f"voltage of {shaft:.3g} V by the capacitive divider is an upper bound; {at}",
    )
