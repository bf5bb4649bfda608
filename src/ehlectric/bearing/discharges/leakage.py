"""Leakage of the shaft voltage through the oil of the bearings, beside the period of the inverter."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ehlectric.bearing.circuit import leakage_conductance
from ehlectric.bearing.impedance import oil_relaxation_time
from ehlectric.bearing.shaft_voltage import shaft_voltage
from ehlectric.bearing.solution import BearingSolution, capacitance, insulating
from ehlectric.cases.bearing import Motor
from ehlectric.cases.row import amount
from ehlectric.errors import ResultWarning

# Switching frequencies of inverters for low-voltage motors [Hz], with which the leakage is compared where the
# case gives none. They are typical values of catalogues.
TYPICAL = 4e3, 20e3


@dataclass(frozen=True)
class ShaftLeakage:
    """Decay of the shaft voltage through the oil of both bearings.

    Attributes
    ----------
    time_constant : float
        Time constant T of the shaft voltage right after an edge of the inverter [s].
    after_period : float or None
        Part of the shaft voltage that is left after a period of the inverter, exp(-1/(f T)), dimensionless;
        None without a switching frequency.
    after_rise : float or None
        Shaft voltage at the end of an edge over that of the capacitive divider, dimensionless; None without
        a rise time.
    """

    time_constant: float
    after_period: float | None
    after_rise: float | None


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
    The capacitances from the shaft to winding, frame and both bearings have the sum C, and both bearings the
    conductance G, so that T = C/G. An edge that rises over the time t_r leaves V T/t_r (1 - exp(-t_r/T)),
    where V is the voltage of the capacitive divider. The other bearing has the same oil as this one.
    """
    tau, motor = oil_relaxation_time(solution), solution.case.motor
    if tau is None or motor is None or not insulating(solution):
        return None
    own = capacitance(solution)
    second = motor.second_bearing_capacitance
    both = own + (own if second is None else second)
    beside = motor.winding_rotor_capacitance + motor.rotor_frame_capacitance
    time = (beside + both) / (_conductance(solution, tau) * both / own)
    return ShaftLeakage(time, _after_period(motor, time), _after_rise(motor, time))


def _conductance(solution: BearingSolution, tau: float) -> float:
    """Conductance of the oil of a bearing, mean over the positions of the cage [S]."""
    fill = solution.case.bearing.fill
    values = []
    for position in solution.positions:
        inner, outer = (
            (ring.capacitance(fill), ring.capacitance("oil") if fill == "oil" else ring.values.inside)
            for ring in position.rings
        )
        values.append(leakage_conductance(inner, outer, tau))
    return float(np.mean(values))


def _after_period(motor: Motor, time: float) -> float | None:
    frequency = motor.switching_frequency
    return None if frequency is None else math.exp(-1.0 / (frequency * time))


def _after_rise(motor: Motor, time: float) -> float | None:
    if motor.rise_time is None:
        return None
    ratio = motor.rise_time / time
    return -math.expm1(-ratio) / ratio


def leakage_warnings(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warning of a shaft voltage that leaks away through the oil within a period of the inverter."""
    leaks, motor = shaft_leakage(solution), solution.case.motor
    tau, shaft = oil_relaxation_time(solution), shaft_voltage(solution)
    if leaks is None or motor is None or tau is None or shaft is None:
        return
    frequency = motor.switching_frequency
    if leaks.time_constant >= 1.0 / (TYPICAL[0] if frequency is None else frequency):
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
    yield ResultWarning(
        "shaft-leaks",
        f"the oil conducts: its relaxation time is {amount(tau, 's')}, and the shaft voltage decays with a "
        f"time constant of {amount(leaks.time_constant, 's')}, compared with {period}; the shaft voltage of "
        f"{shaft:.3g} V by the capacitive divider is an upper bound; {at}",
    )
