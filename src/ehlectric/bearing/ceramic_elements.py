"""Ceramic elements: the voltage that they have to insulate, the field in them, and what they insulate."""

from __future__ import annotations

from operator import mul, truediv

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing.bearing_discharges import film_voltage, voltage_ratio
from ehlectric.bearing.solution import BearingSolution, RingState, capacitance_is_bound
from ehlectric.discharge.discharge_laws import known


def element_voltage(solution: BearingSolution) -> Numbers | None:
    """Voltage from ring to ring that each ceramic element has to insulate [V], shape (...).

    It is the part of the shaft voltage behind a coating. Without ``element_capacitance`` it is an upper
    bound, with elements that have no capacitance and take nothing off the shaft voltage. None for elements
    that conduct, and without a motor.
    """
    motor = solution.case.motor
    if motor is None or not solution.conditions.ceramic:
        return None
    if not capacitance_is_bound(solution):
        return film_voltage(solution)
    first, second = solution.case.bearing.parallel_capacitance or 0.0, motor.second_bearing_capacitance
    capacitances = motor.winding_rotor_capacitance, motor.rotor_frame_capacitance
    second = first if second is None else second
    return motor.common_mode_voltage * voltage_ratio(*capacitances, first, second)


def element_breakdown(solution: BearingSolution) -> Numbers | None:
    """Voltage from ring to ring that each ceramic element insulates at least [V], shape (...).

    It is the strength of its material over ``field_per_volt``. None for elements that conduct.
    """
    strength = solution.conditions.element.dielectric_strength
    return None if strength is None else strength / field_per_volt(solution)


def element_field(solution: BearingSolution) -> Numbers | None:
    """Field in the ceramic below a contact of the most loaded element, from above [V/m]; None as
    ``element_voltage`` is.
    """
    return known(mul, field_per_volt(solution), element_voltage(solution))


def field_per_volt(solution: BearingSolution) -> Numbers:
    r"""Field in the ceramic per volt on the element, from above [1/m], shape (...).

    The whole voltage is taken to lie on one contact, as if the film and the other contact had none of it. A
    disc of the radius b at the voltage V on a half-space of the permittivity eps has the charge 4 eps b V
    (J. D. Jackson, Classical Electrodynamics, 3rd ed., 1999, section 3.13: 8 eps b V on both of its sides),
    and a mean field of 4 V/(pi b). An ellipse with the minor semi-axis b has a lower one. The ring around the
    contact is at the same voltage, and takes field off it.
    """
    least = np.minimum(*(_minor_axis(ring) for ring in solution.positions[0].rings))
    return 4.0 / (np.pi * least)


def _minor_axis(ring: RingState) -> Array:
    """Minor semi-axis of the dry contact of the most loaded element with a ring [m], shape (...)."""
    most = np.argmax(ring.load, axis=-1, keepdims=True)
    minor = np.minimum(ring.values.semi_axis_x, ring.values.semi_axis_y)
    return np.take_along_axis(minor, most, axis=-1)[..., 0]


def ceramic_summary(solution: BearingSolution) -> dict[str, Numbers | None]:
    """Numbers of ceramic elements as in the table ``bearing`` of summary.json; None for others."""
    ceramic = solution.conditions.ceramic
    voltage, most = element_voltage(solution), element_breakdown(solution)
    return {
        "element_voltage": voltage,
        "element_field": element_field(solution) if ceramic else None,
        "element_breakdown": most,
        "element_margin": known(truediv, most, voltage),
    }
