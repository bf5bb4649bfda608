"""Reduced modulus and speeds of a contact from its two bodies, and checks of the limits of the model."""

from __future__ import annotations

import numpy as np

from ehlectric.cases.contact import Body, Contact
from ehlectric.errors import InputError
from ehlectric.formulas import hertz_line as hertz
from ehlectric.lubricant.oil import Oil


def modulus_of(contact: Contact) -> tuple[float, float]:
    """Reduced modulus E' [Pa], and surface 1's share of 2/E': 0.5 if only E' is known."""
    if contact.reduced_modulus is not None:
        return contact.reduced_modulus, 0.5
    assert contact.body_1 is not None and contact.body_2 is not None
    first, second = (_compliance(body) for body in (contact.body_1, contact.body_2))
    return hertz.reduced_modulus(first, second), first / (first + second)


def _compliance(body: Body) -> float:
    assert body.youngs_modulus is not None and body.poissons_ratio is not None
    return hertz.body_compliance(body.youngs_modulus, body.poissons_ratio)


def speeds_of(contact: Contact) -> tuple[float, float]:
    """Entrainment speed [m/s] and slide-to-roll ratio of a contact."""
    if contact.entrainment_speed is not None:
        return contact.entrainment_speed, contact.slide_to_roll_ratio or 0.0
    assert contact.speed_1 is not None and contact.speed_2 is not None
    mean = 0.5 * (contact.speed_1 + contact.speed_2)
    return mean, (contact.speed_1 - contact.speed_2) / mean


def surface_ratios(slide_to_roll_ratio: float) -> tuple[float, float]:
    """Speeds of surfaces 1 and 2, each divided by the entrainment speed.

    Examples
    --------
    >>> surface_ratios(0.5)
    (1.25, 0.75)
    """
    return 1.0 + 0.5 * slide_to_roll_ratio, 1.0 - 0.5 * slide_to_roll_ratio


def check_width(half_width: float, radius: float) -> None:
    """Raise an InputError if the half-width [m] exceeds half the smallest radius [m].

    Half-space deflection and a parabolic gap hold only for contacts that are small compared to the bodies.
    """
    if half_width > 0.5 * radius:
        raise InputError(
            "contact",
            f"the dry contact would be {half_width:.3g} m wide on each side, more than half of "
            f"the smallest radius {radius:.3g} m;",
            takes="less load, a larger modulus or less conforming bodies",
        )


def check_pressure(pressure: float, oil: Oil) -> None:
    """Raise an InputError if the Hertz pressure [Pa] is near the ambient pressure.

    An InputError is also raised if the permittivity law has no value at this pressure.
    """
    least = max(1e4, 10.0 * oil.ambient_pressure)
    if pressure < least:
        raise InputError(
            "contact",
            f"the Hertz pressure would be {pressure:.3g} Pa",
            takes=f"a load that gives at least {least:.3g} Pa, well above the ambient "
            f"{oil.ambient_pressure:.3g} Pa",
        )
    # A permittivity law that has no value at the Hertz pressure raises its error here. A law that fails only
    # at the higher pressure spike raises it after the film has been computed.
    at = np.array([pressure])
    oil.permittivity(at, oil.density_ratio(at)[0])
