"""Where the model of a bearing ends: duties that are refused, and what is to be warned of. SI units."""

from __future__ import annotations

import math

import numpy as np
from scipy.constants import g as gravity

from ehlectric.bearing.conditions import BearingDuty
from ehlectric.bearing.loads.balls import BallEquilibrium
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.bearing.loads.rollers import RollerEquilibrium
from ehlectric.bearing.ring_contacts import Race, line_contact, point_contact
from ehlectric.cases.bearing import Bearing
from ehlectric.errors import InputError
from ehlectric.formulas.film_line import moes
from ehlectric.formulas.film_point import nijenbanning_venner_moes

Equilibrium = BallEquilibrium | RollerEquilibrium

# Films up to this part of (f - 1/2) D, by which the groove is the larger circle, leave contact angles and gap
# what they are without; a roller whose film builds up over a length sqrt(2 R h) of up to this part of its
# radius is a parabola.
_ROOM = 0.1

# A contact that carries less than this part of the most loaded one may have its middle beyond the shoulder.
_LIGHT = 0.02

# Part of the clearance, or of what the elements are pressed in by, that films take up without a word.
TAKEN = 1.0 / 3.0


def check_load(bearing: Bearing, duty: BearingDuty) -> None:
    """Refuse loads below the weight of one element, which is left out of the equilibrium.

    Raises
    ------
    InputError
        With the weight.
    """
    weight = duty.geometry.element_mass(duty.element.density) * gravity
    if math.hypot(bearing.radial_load, bearing.axial_load) < weight:
        raise InputError(
            "bearing.radial_load",
            got=f"{bearing.radial_load:g} N, with {bearing.axial_load:g} N axial;",
            takes=f"more than {weight:.2g} N, the weight of an element, which is left out",
        )


def shoulder_angle(bearing: Bearing, *, inner: bool) -> float:
    """Angle from the bottom of a ball's groove to its shoulder, arccos(1 - H/f) [rad].

    Examples
    --------
    >>> bearing = Bearing.from_dict(
    ...     {
    ...         "base": "6208", "radial_clearance": 1e-5, "radial_load": 1000.0, "inner_speed": 300.0,
    ...         "temperature": 343.15, "composite_rq": 3e-8,
    ...     }
    ... )
    >>> round(math.degrees(shoulder_angle(bearing, inner=True)), 1)
    50.6
    """
    return math.acos(1.0 - _shoulder_height(bearing) / groove_ratio(bearing, inner=inner))


def _shoulder_height(bearing: Bearing) -> float:
    assert bearing.shoulder_height is not None
    return bearing.shoulder_height


def groove_ratio(bearing: Bearing, *, inner: bool) -> float:
    """Radius of a ball's groove over the ball's diameter."""
    groove = bearing.inner_groove if inner else bearing.outer_groove
    assert groove is not None
    return groove


def check_shoulders(bearing: Bearing, at: Equilibrium) -> None:
    """Refuse balls whose contact has left the groove.

    Raises
    ------
    InputError
        For a contact whose middle is beyond the shoulder, unless its load is next to nothing.
    """
    if not isinstance(at, BallEquilibrium):
        return
    for name, angle, load in (
        ("inner", at.inner_angle, at.inner_load),
        ("outer", at.outer_angle, at.outer_load),
    ):
        furthest = float(np.max(np.abs(angle), where=load > _LIGHT * np.max(load), initial=0.0))
        end = shoulder_angle(bearing, inner=name == "inner")
        if furthest >= end:
            raise InputError(
                "bearing.shoulder_height",
                got=f"{_shoulder_height(bearing):g}, an {name} groove that ends {math.degrees(end):.1f} "
                f"deg up, and a contact at {math.degrees(furthest):.1f} deg;",
                takes="a higher shoulder, a smaller contact angle, or less axial load",
            )


def check_film(duty: BearingDuty, race: Race, load: float) -> None:
    """Refuse films for which there is no room between element and raceway.

    Parameters
    ----------
    duty, race : BearingDuty and Race
        The contacts with one ring.
    load : float
        Of the most loaded of them [N].

    Raises
    ------
    InputError
        Where a film formula that holds for light contacts too gives more than a tenth of (f - 1/2) D, or of a
        roller's film builds up over more than a tenth of its radius.
    """
    if isinstance(duty.geometry, RollerBearing):
        line = line_contact(duty, race, load)
        film = moes(line).central_thickness
        most = (_ROOM * 0.5 * duty.geometry.roller_diameter) ** 2 / (2.0 * line.reduced_radius)
    else:
        film = nijenbanning_venner_moes(point_contact(duty, race, load)).central_thickness
        most = _ROOM * duty.geometry.offsets[0 if race.inner else 1]
    if film > most:
        name, oil = "inner" if race.inner else "outer", duty.lubricant.viscosity
        raise InputError(
            "bearing",
            got=f"an {name} film of {1e6 * film:.3g} um, at {load:.3g} N, {race.speed:.3g} m/s and "
            f"{oil:.3g} Pa s;",
            takes=f"a load, a speed and an oil at its temperature for at most {1e6 * most:.3g} um, "
            "beyond which the bodies leave it no room",
        )
