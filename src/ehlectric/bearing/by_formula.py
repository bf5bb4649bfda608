"""Contacts of a bearing by film formulas: a uniform film under Hertz's pressure, the dry gap around it."""

from __future__ import annotations

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import BearingDuty
from ehlectric.bearing.contacts import ContactSolution, contact_case, without_regime
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.bearing.ring_contacts import Race, around_ball, around_roller, of_contact
from ehlectric.cases.bearing import Bearing
from ehlectric.cases.discharge import Discharge
from ehlectric.cases.lubricant import Lubricant, density_law, effective_alpha, permittivity_law
from ehlectric.contact.case_warnings import line_case_warnings, point_case_warnings
from ehlectric.contact.conditions import default_side
from ehlectric.contact.resolve import resolve, resolve_point
from ehlectric.discharge.utilisation import dielectric_strength
from ehlectric.errors import InputError, ResultWarning
from ehlectric.field.zones import areas
from ehlectric.formulas.film_line import pan_hamrock
from ehlectric.formulas.film_point import chittenden
from ehlectric.formulas.hertz_line import line_gap, line_pressure
from ehlectric.formulas.hertz_point import dry_contact, point_deflection, point_pressure

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


def formula_contact(
    bearing: Bearing, duty: BearingDuty, race: Race, load: float, *, discharge: Discharge
) -> ContactSolution:
    """One contact of a bearing by film formulas.

    Parameters
    ----------
    bearing, duty : Bearing and BearingDuty
        The bearing.
    race : Race
        Which contact.
    load : float
        [N].
    discharge : Discharge
        Strength of the film.

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
    Chittenden, Dowson, Dunn and Taylor (1985), doi:10.1098/rspa.1985.0014, for balls; Pan and Hamrock (1989),
    doi:10.1115/1.3261900, for rollers. The capacitance is that of the dry gap a central film apart, with the
    permittivity under Hertz's pressure; the largest field the voltage over the minimum film.
    """
    with of_contact(race, load):
        if isinstance(duty.geometry, RollerBearing):
            return _roller(duty, race, load, discharge)
        return _ball(bearing, duty, race, load, discharge)


def _ball(
    bearing: Bearing, duty: BearingDuty, race: Race, load: float, discharge: Discharge
) -> ContactSolution:
    case = contact_case(duty, race, load, discharge, {})
    conditions = resolve_point(case)
    contact = conditions.formulas
    rx, ry = contact.radius_x, contact.radius_y
    dry = dry_contact(load, rx, ry, duty.modulus)
    b, a = dry.semi_axis_x, dry.semi_axis_y
    film = chittenden(contact)
    side = a * default_side(a / b)
    x, y = b * np.linspace(*_POINT, _NODES[0]), np.linspace(-side, side, _NODES[1])
    at_x, at_y = x[:, np.newaxis], y
    opened = point_deflection(at_x, at_y, dry, duty.modulus)
    gap = film.central_thickness + np.maximum(
        0.0, at_x**2 / (2.0 * rx) + at_y**2 / (2.0 * ry) + opened - dry.approach
    )
    pressure = dry.max_pressure * point_pressure(at_x / b, at_y / b, a / b)
    outside, mismatch = around_ball(bearing, contact, race, (x, y), gap)
    return _solution(
        duty,
        discharge,
        load=load,
        max_pressure=dry.max_pressure,
        semi_axes=(b, a),
        films=(film.minimum_thickness, film.central_thickness),
        inside=float(np.vdot(areas((x, y)), _permittivity(duty, pressure) / gap)),
        outside=outside,
        area=np.pi * a * b,
        moes=(contact.moes_m, contact.moes_l),
        mismatch=mismatch,
        warnings=without_regime(point_case_warnings(case, conditions)),
    )


def _roller(duty: BearingDuty, race: Race, load: float, discharge: Discharge) -> ContactSolution:
    assert isinstance(duty.geometry, RollerBearing)
    case = contact_case(duty, race, load, discharge, {})
    conditions = resolve(case)
    contact, length = conditions.formulas, duty.geometry.roller_length
    radius, b, highest = contact.reduced_radius, conditions.half_width, conditions.max_pressure
    film = pan_hamrock(contact)
    x = np.linspace(*_LINE, _LINE_NODES)
    gap = film.central_thickness + b**2 / radius * line_gap(x)
    inside = np.vdot(areas((b * x,)), _permittivity(duty, highest * line_pressure(x)) / gap)
    return _solution(
        duty,
        discharge,
        load=load,
        max_pressure=highest,
        semi_axes=(b, 0.5 * length),
        films=(film.minimum_thickness, film.central_thickness),
        inside=length * float(inside),
        outside=around_roller(duty, race, b, b * x, gap),
        area=2.0 * b * length,
        moes=(contact.moes_m, contact.moes_l),
        mismatch=0.0,
        warnings=without_regime(line_case_warnings(case, conditions)),
    )


def _permittivity(duty: BearingDuty, pressure: Array) -> Array:
    """Relative permittivity of the oil under pressure [Pa]."""
    return permittivity_law(duty.lubricant)(density_law(duty.lubricant)(pressure)[0])


def _solution(
    duty: BearingDuty,
    discharge: Discharge,
    *,
    load: float,
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
    """What the formulas of either contact give; integrals of eps_r dA/h and dA/h are not yet times eps0."""
    strength = float(dielectric_strength(discharge, np.zeros(1))[0])
    eps_r = duty.lubricant.relative_permittivity
    return ContactSolution(
        load=load,
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
        breakdown_voltage=strength * films[0] if discharge.has_strength else np.inf,
        error=None,
        moes_m=moes[0],
        moes_l=moes[1],
        mismatch=mismatch,
        converged=True,
        warnings=warnings,
    )
