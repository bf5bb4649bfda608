"""Contacts of a bearing by film formulas: the gap of the dry contact, widened by the central film."""

from __future__ import annotations

import numpy as np

from ehlectric.bearing.quick.dry import (
    QuickContact,
    ball_gap,
    hertz_area,
    hertz_mean,
    permittivity,
    quick_contact,
    roller_gap,
)
from ehlectric.bearing.ring_contacts import BallContact, RollerContact, check_contact
from ehlectric.field.zones import areas
from ehlectric.formulas.film_line import BothThicknesses, pan_hamrock
from ehlectric.formulas.film_point import chittenden
from ehlectric.formulas.hertz_line import line_pressure
from ehlectric.formulas.hertz_point import point_pressure


def ball_by_formula(
    contact: BallContact, films: tuple[float, float] | None = None, *, wide: bool = False
) -> QuickContact:
    """Film, capacitances and voltages of a ball's contact by film formulas.

    Parameters
    ----------
    contact : BallContact
        Contact and load.
    films : tuple of float, optional
        Minimum and central film thickness [m] in place of those of the formula.
    wide : bool
        Whether the domain is that on which the contact would be solved, instead of the default one.

    Returns
    -------
    QuickContact
        Numbers without an error estimate: the formulas may be 30 % off, and more for light loads.

    Raises
    ------
    InputError
        As ``check_contact`` does.

    Notes
    -----
    Film thickness by Chittenden, Dowson, Dunn and Taylor (1985), doi:10.1098/rspa.1985.0014. The gap is
    the gap of the dry contact plus the central film thickness. The capacitance is computed with the
    permittivity under the Hertz pressure; the maximum field strength is the voltage divided by the
    minimum film thickness.
    """
    check_contact(contact)
    dry, oil = contact.dry, contact.ring.oil
    b, a = dry.semi_axis_x, dry.semi_axis_y
    least, central = films or _films(chittenden(contact.conditions.contact))
    (x, y), gap = ball_gap(contact, central)
    pressure = dry.max_pressure * point_pressure(x[:, np.newaxis] / b, y / b, a / b)
    mean = hertz_mean(contact, lambda p: permittivity(oil, p))
    return quick_contact(
        contact,
        (least, central),
        inside=float(np.vdot(areas((x, y)), permittivity(oil, pressure) / gap)),
        hertz=mean * hertz_area(contact) / central,
        wide=wide,
    )


def roller_by_formula(
    contact: RollerContact, films: tuple[float, float] | None = None, *, wide: bool = False
) -> QuickContact:
    """Film, capacitances and voltages of a roller's contact by film formulas.

    Parameters
    ----------
    contact : RollerContact
        Contact and load.
    films : tuple of float, optional
        Minimum and central film thickness [m] in place of those of the formula.
    wide : bool
        Whether the domain is that on which the contact would be solved, instead of the default one.

    Returns
    -------
    QuickContact
        Numbers without an error estimate: the formulas may be 40 % off, and more for light loads.

    Raises
    ------
    InputError
        As ``check_contact`` does.

    Notes
    -----
    Film thickness by Pan and Hamrock (1989), doi:10.1115/1.3261900. The gap is the gap of the dry contact
    plus the central film thickness. The capacitance is computed with the permittivity under the Hertz
    pressure; the largest field strength is the voltage over the minimum film thickness.
    """
    check_contact(contact)
    conditions, length, oil = contact.conditions, contact.length, contact.ring.oil
    least, central = films or _films(pan_hamrock(conditions.contact))
    x, gap = roller_gap(contact, central)
    pressure = conditions.max_pressure * line_pressure(x / conditions.half_width)
    mean = hertz_mean(contact, lambda p: permittivity(oil, p))
    return quick_contact(
        contact,
        (least, central),
        inside=length * float(np.vdot(areas((x,)), permittivity(oil, pressure) / gap)),
        hertz=mean * hertz_area(contact) / central,
        wide=wide,
    )


def _films(film: BothThicknesses) -> tuple[float, float]:
    """Minimum and central film thickness of a formula [m]."""
    return film.minimum_thickness, film.central_thickness
