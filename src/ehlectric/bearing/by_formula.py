"""Contacts of a bearing by film formulas: a uniform film under Hertz's pressure, the dry gap around it."""

from __future__ import annotations

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.bearing.contacts import ContactSolution, ContactValues, ball_case, roller_case, without_regime
from ehlectric.bearing.ring_contacts import (
    BallContact,
    Contact,
    RollerContact,
    around_ball,
    around_roller,
    of_contact,
)
from ehlectric.cases.discharge import Discharge
from ehlectric.cases.lubricant import Lubricant, density_law, effective_alpha, permittivity_law
from ehlectric.contact.case_warnings import line_case_warnings, point_case_warnings
from ehlectric.contact.conditions import default_side
from ehlectric.contact.resolve import resolve, resolve_point
from ehlectric.errors import InputError, ResultWarning
from ehlectric.field.zones import areas
from ehlectric.formulas.film_line import pan_hamrock
from ehlectric.formulas.film_point import chittenden
from ehlectric.formulas.hertz_line import line_gap, line_pressure
from ehlectric.formulas.hertz_point import point_deflection, point_pressure

# Domain in half-widths or semi-axes along entrainment, as of solved contacts; nodes along it and across.
_POINT, _LINE = (-4.5, 1.5), (-4.0, 2.0)
_NODES = 97, 65
_LINE_NODES = 1601


def check_formula(discharge: Discharge, lubricant: Lubricant) -> None:
    """Refuse what the formulas know nothing of.

    Raises
    ------
    InputError
        For a Weibull law and a table over pressure, which take more of a field than its largest value, and
        for a viscosity that does not grow with pressure.
    """
    if effective_alpha(lubricant) == 0.0:
        raise InputError(
            "lubricant.viscosity_law",
            got=f"{lubricant.viscosity_law!r} with contacts by formula, which are for piezoviscous oils;",
            takes="another law, or solved contacts",
        )
    table = discharge.strength_table
    if discharge.weibull is not None or (table is not None and table.over == "pressure"):
        key = "weibull" if discharge.weibull is not None else "strength_table"
        raise InputError(
            f"discharge.{key}",
            got="it with contacts by formula, which know no field;",
            takes="dielectric_strength, a table over temperature, or solved contacts",
        )


def ball_by_formula(contact: BallContact) -> ContactSolution:
    """A ball's contact by film formulas.

    Parameters
    ----------
    contact : BallContact
        Contact and load.

    Returns
    -------
    ContactSolution
        Without an error estimate: the formulas may be 30 % off, and more where the contact is light.

    Raises
    ------
    InputError
        Where the dry contact is wider than its bodies allow.

    Notes
    -----
    Chittenden, Dowson, Dunn and Taylor (1985), doi:10.1098/rspa.1985.0014. The capacitance is that of the dry
    gap a central film apart, with the permittivity under Hertz's pressure; the largest field the voltage over
    the minimum film.
    """
    with of_contact(contact):
        case = ball_case(contact, {})
        conditions = resolve_point(case)
        point, dry, modulus = contact.point, contact.dry, contact.point.reduced_modulus
        b, a = dry.semi_axis_x, dry.semi_axis_y
        film = chittenden(point)
        side = a * default_side(a / b)
        x, y = b * np.linspace(*_POINT, _NODES[0]), np.linspace(-side, side, _NODES[1])
        at_x, at_y = x[:, np.newaxis], y
        rigid = at_x**2 / (2.0 * point.radius_x) + at_y**2 / (2.0 * point.radius_y)
        opened = point_deflection(at_x, at_y, dry, modulus)
        gap = film.central_thickness + np.maximum(0.0, rigid + opened - dry.approach)
        pressure = dry.max_pressure * point_pressure(at_x / b, at_y / b, a / b)
        outside, mismatch = around_ball(contact, (x, y), gap)
        return _solution(
            contact,
            max_pressure=dry.max_pressure,
            semi_axes=(b, a),
            films=(film.minimum_thickness, film.central_thickness),
            inside=float(np.vdot(areas((x, y)), _permittivity(contact, pressure) / gap)),
            outside=outside,
            area=np.pi * a * b,
            moes=(point.moes_m, point.moes_l),
            mismatch=mismatch,
            warnings=without_regime(point_case_warnings(case, conditions)),
        )


def roller_by_formula(contact: RollerContact) -> ContactSolution:
    """A roller's contact by film formulas.

    Parameters
    ----------
    contact : RollerContact
        Contact and load.

    Returns
    -------
    ContactSolution
        Without an error estimate: the formulas may be 30 % off, and more where the contact is light.

    Raises
    ------
    InputError
        Where the dry contact is wider than its bodies allow.

    Notes
    -----
    Pan and Hamrock (1989), doi:10.1115/1.3261900. The capacitance is that of the dry gap a central film
    apart, with the permittivity under Hertz's pressure; the largest field the voltage over the minimum film.
    """
    with of_contact(contact):
        case = roller_case(contact, {})
        conditions = resolve(case)
        line, length = contact.line, contact.length
        b, highest = conditions.half_width, conditions.max_pressure
        film = pan_hamrock(line)
        x = np.linspace(*_LINE, _LINE_NODES)
        gap = film.central_thickness + b**2 / line.reduced_radius * line_gap(x)
        inside = np.vdot(areas((b * x,)), _permittivity(contact, highest * line_pressure(x)) / gap)
        return _solution(
            contact,
            max_pressure=highest,
            semi_axes=(b, 0.5 * length),
            films=(film.minimum_thickness, film.central_thickness),
            inside=length * float(inside),
            outside=around_roller(contact.ring, b, b * x, gap),
            area=2.0 * b * length,
            moes=(line.moes_m, line.moes_l),
            mismatch=0.0,
            warnings=without_regime(line_case_warnings(case, conditions)),
        )


def _permittivity(contact: Contact, pressure: Array) -> Array:
    """Relative permittivity of the oil under pressure [Pa]."""
    oil = contact.ring.conditions.lubricant
    return permittivity_law(oil)(density_law(oil)(pressure)[0])


def _solution(
    contact: Contact,
    *,
    max_pressure: float,
    semi_axes: tuple[float, float],
    films: tuple[float, float],
    inside: float,
    outside: float,
    area: float,
    moes: tuple[float, float],
    mismatch: float,
    warnings: tuple[ResultWarning, ...],
) -> ContactSolution:
    """Numbers of either contact; integrals of eps_r dA/h and dA/h are not yet times eps0."""
    conditions = contact.ring.conditions
    eps_r = conditions.lubricant.relative_permittivity
    values = ContactValues(
        max_pressure=max_pressure,
        semi_axis_x=semi_axes[0],
        semi_axis_y=semi_axes[1],
        minimum_thickness=films[0],
        central_thickness=films[1],
        inside=epsilon_0 * inside,
        outside_oil=outside * eps_r,
        outside_air=outside,
        plate=epsilon_0 * eps_r * area / films[1],
        strength_per_volt=1.0 / films[0],
        breakdown_voltage=conditions.gap_breakdown(films[0]),
    )
    return ContactSolution(
        load=contact.load,
        values=values,
        error=None,
        moes_m=moes[0],
        moes_l=moes[1],
        mismatch=mismatch,
        converged=True,
        warnings=warnings,
    )
