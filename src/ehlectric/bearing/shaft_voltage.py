"""Shaft voltage: the part of the common-mode voltage of a motor that lies on its bearings."""

from __future__ import annotations

from ehlectric.bearing.solution import BearingSolution, capacitance, capacitance_is_bound, lubrication


def voltage_ratio(winding_rotor: float, rotor_frame: float, first: float, second: float) -> float:
    """Part of the common-mode voltage that is on the bearings.

    C_wr/(C_wr + C_rf + C_DE + C_NDE)

    Parameters
    ----------
    winding_rotor, rotor_frame : float
        Capacitance from winding to rotor and from rotor to frame [F].
    first, second : float
        Capacitance of both bearings [F].

    Returns
    -------
    float
        Dimensionless.

    Examples
    --------
    >>> round(voltage_ratio(20e-12, 1e-9, 70e-12, 70e-12), 4)
    0.0172
    """
    return winding_rotor / (winding_rotor + rotor_frame + first + second)


def bearing_voltage_ratio(solution: BearingSolution) -> float | None:
    """Part of the common-mode voltage of its motor that is on a bearing, dimensionless.

    None without a motor, where surfaces touch and conduct, and of a capacitance that is a bound.
    """
    motor = solution.case.motor
    if motor is None or lubrication(solution) == "conducting" or capacitance_is_bound(solution):
        return None
    own = capacitance(solution)
    second = motor.second_bearing_capacitance
    return voltage_ratio(
        motor.winding_rotor_capacitance,
        motor.rotor_frame_capacitance,
        own,
        own if second is None else second,
    )


def shaft_voltage(solution: BearingSolution) -> float | None:
    """Voltage of the shaft by the capacitive divider [V]; None where its ``bearing_voltage_ratio`` is."""
    motor, ratio = solution.case.motor, bearing_voltage_ratio(solution)
    return None if motor is None or ratio is None else ratio * motor.common_mode_voltage


def margin(voltage: float, shaft: float | None) -> float | None:
    """A breakdown voltage [V] over the shaft voltage [V], dimensionless; None without a shaft voltage."""
    return None if shaft is None else voltage / shaft
