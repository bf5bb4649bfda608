"""Limits of the model of a bearing: loads, contact angles and films that are refused. SI units."""

from __future__ import annotations

import math

import numpy as np
from scipy.constants import g as gravity

from ehlectric.bearing.conditions import BearingConditions
from ehlectric.bearing.loads.geometry import Geometry
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.ring_contacts import Contact
from ehlectric.cases.bearings.bearing import Bearing
from ehlectric.errors import InputError

# Contacts with less than this part of the largest load may have their centre beyond the shoulder.
_LIGHT = 0.02

# Part of the clearance, or of the elastic approach of preloaded elements, that films may take up without a
# warning.
TAKEN = 1.0 / 3.0


def check_load(conditions: BearingConditions[Geometry]) -> None:
    """Refuse loads below the weight of one element, because the equilibrium neglects weights.

    Raises
    ------
    InputError
        Where the load is too small; the message states the weight.
    """
    bearing = conditions.bearing
    weight = conditions.geometry.element_mass(conditions.element.density) * gravity
    if math.hypot(bearing.radial_load, bearing.axial_load) < weight:
        raise InputError(
            "bearing.radial_load",
            got=f"{bearing.radial_load:g} N, with {bearing.axial_load:g} N axial;",
            takes=f"more than {weight:.2g} N, the weight of an element, which is left out",
        )


def shoulder_angle(bearing: Bearing, *, inner: bool) -> float:
    """Angle from the bottom of a ball's groove to its shoulder, arccos(1 - H/f) [rad].

    H is the height of the shoulder over the diameter of the ball, and f the osculation. The angle is infinite
    for a cylindrical raceway, which has no shoulder.

    Examples
    --------
    Inner ring of a 6208, in degrees:

    >>> bearing = Bearing.from_dict(
    ...     {
    ...         "base": "6208", "radial_clearance": 1e-5, "radial_load": 1000.0, "inner_speed": 300.0,
    ...         "temperature": 343.15, "composite_rq": 3e-8,
    ...     }
    ... )
    >>> round(math.degrees(shoulder_angle(bearing, inner=True)), 1)
    50.6
    """
    if bearing.shoulder_height is None:
        return math.inf
    return math.acos(1.0 - bearing.shoulder_height / groove_ratio(bearing, inner=inner))


def groove_ratio(bearing: Bearing, *, inner: bool) -> float:
    """Osculation f: radius of the groove over the diameter of the ball; infinite for a cylinder."""
    groove = bearing.inner_groove if inner else bearing.outer_groove
    return math.inf if groove is None else groove


def check_shoulders(bearing: Bearing, at: Equilibrium) -> None:
    """Refuse ball contacts outside the groove.

    Raises
    ------
    InputError
        Where the centre of a contact is beyond the shoulder. Contacts with less than 2 % of the largest load
        do not count.
    """
    for name, inner in (("inner", True), ("outer", False)):
        ring = at.ring(inner=inner)
        loaded = ring.load > _LIGHT * np.max(ring.load)
        furthest = float(np.max(np.abs(ring.angle), where=loaded, initial=0.0))
        end = shoulder_angle(bearing, inner=inner)
        if furthest >= end:
            raise InputError(
                "bearing.shoulder_height",
                got=f"{bearing.shoulder_height:g}, an {name} groove that ends {math.degrees(end):.1f} "
                f"deg up, and a contact at {math.degrees(furthest):.1f} deg;",
                takes="a higher shoulder, a smaller contact angle, or less axial load",
            )


def check_film(contact: Contact) -> None:
    """Refuse films that are too thick for the space between element and raceway.

    Parameters
    ----------
    contact : BallContact or RollerContact
        Most loaded contact with one ring.

    Raises
    ------
    InputError
        Where the film of a ball is thicker than a tenth of (f - 1/2) D, or the film of a roller builds up
        over more than a tenth of its radius. The film is that of a formula that holds for light contacts,
        too.
    """
    film, most, ring = contact.film, contact.thickest_film, contact.ring
    if film > most:
        oil = ring.oil.viscosity
        raise InputError(
            "bearing",
            got=f"an {ring.name} film of {1e6 * film:.3g} um, at {contact.load:.3g} N, "
            f"{ring.speed:.3g} m/s and {oil:.3g} Pa s;",
            takes=f"a load, a speed and an oil at its temperature for at most {1e6 * most:.3g} um, "
            "beyond which the bodies leave it no room",
        )
