"""Shaft voltage: the part of the common-mode voltage of a motor that lies on its bearings."""

from __future__ import annotations

from ehlectric.bearing.meter.reading import film_share, shaft_capacitance
from ehlectric.bearing.solution import BearingSolution, capacitance_is_bound, lubrication


def voltage_ratio(winding_rotor: float, rotor_frame: float, first: float, second: float) -> float:
    """Bearing voltage ratio of a motor: share of the common-mode voltage that lies on its bearings.

    The capacitive divider gives C_wr/(C_wr + C_rf + C_DE + C_NDE).

    Parameters
    ----------
    winding_rotor, rotor_frame : float
        Capacitance C_wr from winding to rotor, and C_rf from rotor to frame [F].
    first, second : float
        Capacitances C_DE and C_NDE from shaft to housing at the drive end and the non-drive end [F].

    Returns
    -------
    float
        Bearing voltage ratio, dimensionless.

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
    shaft, share = shaft_voltage(solution), film_share(solution)
    return None if shaft is None or share is None else share * shaft


def margin(voltage: float, shaft: float | None) -> float | None:
    """Shaft voltage at breakdown [V] over shaft voltage [V], dimensionless; None without a shaft voltage."""
    return None if shaft is None else voltage / shaft
