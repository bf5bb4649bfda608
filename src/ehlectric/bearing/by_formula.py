"""Contacts of a bearing by film formulas: the gap of the dry contact, widened by the central film."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import gap_breakdown
from ehlectric.bearing.contacts import ContactSolution, ContactValues, without_regime
from ehlectric.bearing.domain import ball_grid, roller_grid
from ehlectric.bearing.ring_contacts import (
    BallContact,
    Contact,
    RollerContact,
    around_ball,
    around_roller,
    check_contact,
)
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.discharge import Discharge
from ehlectric.contact.case_warnings import line_case_warnings, point_case_warnings
from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError, ResultWarning
from ehlectric.field.zones import areas
from ehlectric.formulas.film_line import pan_hamrock
from ehlectric.formulas.film_point import chittenden
from ehlectric.formulas.hertz_line import line_gap, line_pressure
from ehlectric.formulas.hertz_point import DryContact, axis_ratio, point_deflection, point_pressure
from ehlectric.lubricant.oil import Oil

# Domain along entrainment, in semi-axes of a ball's contact or half-widths of a roller's: the default domain
# of solved contacts.
_POINT, _LINE = (-4.5, 1.5), (-4.0, 2.0)

# Nodes along and across entrainment of a ball's contact, and along entrainment of a roller's.
_NODES = 97, 65
_LINE_NODES = 1601

# Pressures of a dry contact over its maximum, and the parts of its area that have them. Over an ellipse the
# part with ratios up to t is t^2; over a strip the ratio is the cosine of an angle whose sine is the place.
_RATIO, _WEIGHT = np.polynomial.legendre.leggauss(24)
_ELLIPSE = 0.5 * (_RATIO + 1.0), 0.5 * (_RATIO + 1.0) * _WEIGHT
_STRIP = np.sqrt(1.0 - _RATIO**2), 0.5 * _WEIGHT


def check_formula(discharge: Discharge, oil: Oil) -> None:
    """Refuse an oil or a dielectric strength for which contacts by formula have no result.

    Raises
    ------
    InputError
        For a Weibull law and for a strength over pressure, which need the field in the whole film; for a
        viscosity that does not grow with pressure.
    """
    if oil.alpha == 0.0:
        raise InputError(
            "lubricant.viscosity_law",
            got=f"{oil.laws['viscosity']!r} with contacts by formula, which are for piezoviscous oils;",
            takes="another law, or solved contacts",
        )
    table = discharge.strength_table
    if discharge.weibull is not None or (table is not None and table.over == "pressure"):
        key = "weibull" if discharge.weibull is not None else "strength_table"
        raise InputError(
            f"discharge.{key}",
            got="a strength that needs the field, with contacts by formula, which have none",
            takes="dielectric_strength, a table over temperature, or solved contacts",
        )


def formula_case(
    case: BearingCase, *, constant: bool = False
) -> tuple[BearingCase | None, InputError | None]:
    """Case of a bearing with contacts by formula, and what the formulas cannot compute.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing.
    constant : bool
        Whether a constant strength takes the place of one that needs the field: the scale of a Weibull law,
        or the first strength of a table over pressure. It cancels in ratios of voltages.

    Returns
    -------
    case : BearingCase or None
        Case with contacts by formula; without a dielectric strength where it needs the field, unless
        ``constant``. None for an oil that the formulas do not describe.
    refused : InputError or None
        Key that the formulas cannot use, and why.
    """
    changed, discharge, bearing = case.replace({"contacts": "formula"}), case.discharge, case.bearing
    try:
        check_formula(discharge, case.lubricant.at(bearing.oil_temperature, bearing.temperature_key()))
    except InputError as error:
        if not (error.key or "").startswith("discharge"):
            return None, error
        strength = None
        if constant and discharge.weibull is not None:
            strength = discharge.weibull.scale
        elif constant and discharge.strength_table is not None:
            strength = discharge.strength_table.strength[0]
        update = {"weibull": None, "strength_table": None, "dielectric_strength": strength}
        return changed.model_copy(update={"discharge": discharge.model_copy(update=update)}), error
    return changed, None


# Factors by which films from formulas, and margins with them, may be off either way. Balls have the formula
# of Chittenden, Dowson, Dunn and Taylor: solved films of bearings are within 30 % of it. Rollers have that
# of Pan and Hamrock: formulas for line contacts differ from solved films by up to 40 %.
_FACTOR_OF_BALLS, _FACTOR_OF_ROLLERS = 1.3, 1.4


def formula_factor(kind: str) -> float:
    """Factor by which films from formulas may be off either way, by the kind of the bearing.

    Examples
    --------
    >>> formula_factor("deep-groove ball"), formula_factor("cylindrical roller")
    (1.3, 1.4)
    """
    return _FACTOR_OF_ROLLERS if kind == "cylindrical roller" else _FACTOR_OF_BALLS


def formula_error(kind: str) -> str:
    """Text of the error of films from formulas, such as "30 %", by the kind of the bearing."""
    return f"{100.0 * (formula_factor(kind) - 1.0):.0f} %"


def ball_by_formula(contact: BallContact) -> ContactSolution:
    """Film, capacitances and voltages of a ball's contact by film formulas.

    Parameters
    ----------
    contact : BallContact
        Contact and load.

    Returns
    -------
    ContactSolution
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
    conditions, dry, oil = contact.conditions, contact.dry, contact.ring.oil
    b, a = dry.semi_axis_x, dry.semi_axis_y
    film = chittenden(conditions.contact)
    side = a * conditions.side
    x, y = b * np.linspace(*_POINT, _NODES[0]), np.linspace(-side, side, _NODES[1])
    at_x, at_y = x[:, np.newaxis], y
    rigid = at_x**2 / (2.0 * conditions.radius_x) + at_y**2 / (2.0 * conditions.radius_y)
    ratio = axis_ratio(conditions.radius_x, conditions.radius_y)
    opened = dry.max_pressure * b / conditions.reduced_modulus * _unit_opening(ratio, conditions.side)
    gap = film.central_thickness + np.maximum(0.0, rigid + opened - dry.approach)
    pressure = dry.max_pressure * point_pressure(at_x / b, at_y / b, a / b)
    area = np.pi * a * b
    outside, mismatch = around_ball(contact, (x, y), gap)
    setup = Setup(oil=oil, grid=ball_grid(contact))
    return _solution(
        contact,
        semi_axes=(b, a),
        films=(film.minimum_thickness, film.central_thickness),
        inside=float(np.vdot(areas((x, y)), _permittivity(oil, pressure) / gap)),
        outside=outside,
        area=area,
        hertz=_mean_permittivity(oil, dry.max_pressure, _ELLIPSE) * area / film.central_thickness,
        mismatch=mismatch,
        warnings=without_regime(point_case_warnings(setup, conditions)),
    )


def roller_by_formula(contact: RollerContact) -> ContactSolution:
    """Film, capacitances and voltages of a roller's contact by film formulas.

    Parameters
    ----------
    contact : RollerContact
        Contact and load.

    Returns
    -------
    ContactSolution
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
    b, film = conditions.half_width, pan_hamrock(conditions.contact)
    x = np.linspace(*_LINE, _LINE_NODES)
    gap = film.central_thickness + b**2 / conditions.reduced_radius * line_gap(x)
    permittivity = _permittivity(oil, conditions.max_pressure * line_pressure(x))
    area = 2.0 * b * length
    setup = Setup(oil=oil, grid=roller_grid(contact))
    return _solution(
        contact,
        semi_axes=(b, 0.5 * length),
        films=(film.minimum_thickness, film.central_thickness),
        inside=length * float(np.vdot(areas((b * x,)), permittivity / gap)),
        outside=around_roller(contact.ring, b, b * x, gap),
        area=area,
        hertz=_mean_permittivity(oil, conditions.max_pressure, _STRIP) * area / film.central_thickness,
        mismatch=0.0,
        warnings=without_regime(line_case_warnings(setup, conditions)),
    )


@lru_cache(maxsize=32)
def _unit_opening(ratio: float, side: float) -> Array:
    """Deflection over p_h b/E' at the nodes of a ball's contact, shape ``_NODES``, dimensionless.

    In semi-axes it depends on their ratio alone, so all loads of a ring have the same one.
    """
    x, y = np.linspace(*_POINT, _NODES[0]), ratio * np.linspace(-side, side, _NODES[1])
    unit = DryContact(semi_axis_x=1.0, semi_axis_y=ratio, max_pressure=1.0, approach=0.0)
    opened = point_deflection(x[:, np.newaxis], y, unit, 1.0)
    opened.flags.writeable = False
    return opened


def _permittivity(oil: Oil, pressure: Array) -> Array:
    """Relative permittivity of the oil under pressure [Pa], dimensionless."""
    return oil.permittivity(pressure, oil.density_ratio(pressure)[0])


def _mean_permittivity(oil: Oil, pressure: float, part: tuple[Array, Array]) -> float:
    """Mean relative permittivity over a Hertz area with a maximum pressure [Pa]."""
    ratio, weights = part
    return float(np.vdot(weights, _permittivity(oil, pressure * ratio)))


def _solution(
    contact: Contact,
    *,
    semi_axes: tuple[float, float],
    films: tuple[float, float],
    inside: float,
    outside: float,
    area: float,
    hertz: float,
    mismatch: float,
    warnings: tuple[ResultWarning, ...],
) -> ContactSolution:
    """Numbers of a contact: integrals of eps_r dA/h over the domain, ``inside``, and the Hertz area [m]."""
    ring, groups = contact.ring, contact.conditions.contact
    eps_r = ring.conditions.oil.relative_permittivity
    values = ContactValues(
        max_pressure=contact.conditions.max_pressure,
        semi_axis_x=semi_axes[0],
        semi_axis_y=semi_axes[1],
        minimum_thickness=films[0],
        central_thickness=films[1],
        inside=epsilon_0 * inside,
        outside_oil=outside * eps_r,
        outside_air=outside,
        plate=epsilon_0 * ring.oil.relative_permittivity * area / films[1],
        strength_per_volt=1.0 / films[0],
        breakdown_voltage=gap_breakdown(ring.discharge, films[0]),
        hertz=epsilon_0 * hertz,
    )
    return ContactSolution(
        load=contact.load,
        values=values,
        error=None,
        moes_m=groups.moes_m,
        moes_l=groups.moes_l,
        mismatch=mismatch,
        converged=True,
        warnings=warnings,
    )
