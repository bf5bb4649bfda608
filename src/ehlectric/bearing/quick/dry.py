"""Dry contacts of a bearing, a film apart: the gap, and what contacts without a solved film share."""

from __future__ import annotations

from collections.abc import Callable
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
)
from ehlectric.contact.case_warnings import line_case_warnings, point_case_warnings
from ehlectric.contact.setup import Setup
from ehlectric.formulas.hertz_line import line_gap
from ehlectric.formulas.hertz_point import DryContact, axis_ratio, point_deflection
from ehlectric.lubricant.oil import Oil

# Domain along entrainment, in semi-axes of a ball's contact or half-widths of a roller's: the default domain
# of solved contacts, and that of the atlas.
POINT, LINE = (-4.5, 1.5), (-4.0, 2.0)

# Nodes along and across entrainment of a ball's contact, and along entrainment of a roller's.
_NODES = 97, 65
_LINE_NODES = 1601

# Nodes and weights on 0 to 1 with which the gap further away is integrated.
_AT, _PART = (0.5 * values for values in np.polynomial.legendre.leggauss(12))
_AT = _AT + 0.5

# Pressures of a dry contact over its maximum, and the parts of its area that have them. Over an ellipse the
# part with ratios up to t is t^2; over a strip the ratio is the cosine of an angle whose sine is the place.
_RATIO, _WEIGHT = np.polynomial.legendre.leggauss(24)
_ELLIPSE = 0.5 * (_RATIO + 1.0), 0.5 * (_RATIO + 1.0) * _WEIGHT
_STRIP = np.sqrt(1.0 - _RATIO**2), 0.5 * _WEIGHT


def ball_gap(contact: BallContact, central: float) -> tuple[tuple[Array, Array], Array]:
    """Gap of a ball's dry contact, widened by its central film.

    Parameters
    ----------
    contact : BallContact
        Contact and load.
    central : float
        Central film thickness [m].

    Returns
    -------
    nodes : tuple of ndarray, shapes (nx,), (ny,)
        Nodes along and across entrainment [m].
    gap : ndarray, shape (nx, ny)
        Gap [m].
    """
    conditions, dry = contact.conditions, contact.dry
    b, side = dry.semi_axis_x, dry.semi_axis_y * conditions.side
    x, y = b * np.linspace(*POINT, _NODES[0]), np.linspace(-side, side, _NODES[1])
    rigid = x[:, np.newaxis] ** 2 / (2.0 * conditions.radius_x) + y**2 / (2.0 * conditions.radius_y)
    ratio = axis_ratio(conditions.radius_x, conditions.radius_y)
    opened = dry.max_pressure * b / conditions.reduced_modulus * _unit_opening(ratio, conditions.side)
    return (x, y), central + np.maximum(0.0, rigid + opened - dry.approach)


def roller_gap(contact: RollerContact, central: float) -> tuple[Array, Array]:
    """Gap of a roller's dry contact, widened by its central film [m].

    Returns
    -------
    x, gap : ndarray, shape (n,)
        Nodes along entrainment, and the gap [m].
    """
    conditions = contact.conditions
    x, b = np.linspace(*LINE, _LINE_NODES), conditions.half_width
    return b * x, central + b**2 / conditions.reduced_radius * line_gap(x)


@lru_cache(maxsize=32)
def _unit_opening(ratio: float, side: float) -> Array:
    """Deflection over p_h b/E' at the nodes of a ball's contact, shape ``_NODES``, dimensionless.

    In semi-axes it depends on their ratio alone, so all loads of a ring have the same one.
    """
    x, y = np.linspace(*POINT, _NODES[0]), ratio * np.linspace(-side, side, _NODES[1])
    unit = DryContact(semi_axis_x=1.0, semi_axis_y=ratio, max_pressure=1.0, approach=0.0)
    opened = point_deflection(x[:, np.newaxis], y, unit, 1.0)
    opened.flags.writeable = False
    return opened


def permittivity(oil: Oil, pressure: Array) -> Array:
    """Relative permittivity of the oil under pressure [Pa], dimensionless."""
    return oil.permittivity(pressure, oil.density_ratio(pressure)[0])


def hertz_mean(contact: Contact, law: Callable[[Array], Array]) -> float:
    """Mean over the Hertz area of a number that depends on the Hertz pressure [Pa]."""
    ratio, weights = _ELLIPSE if isinstance(contact, BallContact) else _STRIP
    return float(np.vdot(weights, law(contact.conditions.max_pressure * ratio)))


def hertz_area(contact: Contact) -> float:
    """Area of the dry contact [m^2]."""
    along, across = _axes(contact)
    return float(np.pi * along * across if isinstance(contact, BallContact) else 4.0 * along * across)


def _axes(contact: Contact) -> tuple[float, float]:
    """Semi-axes of the dry contact along and across entrainment [m]; half of a roller's length across."""
    if isinstance(contact, BallContact):
        return contact.dry.semi_axis_x, contact.dry.semi_axis_y
    return contact.conditions.half_width, 0.5 * contact.length


def quick_solution(
    contact: Contact,
    films: tuple[float, float],
    *,
    inside: float,
    hertz: float,
    error: float | None = None,
    wide: bool = False,
) -> ContactSolution:
    """Numbers of a contact without a solved film.

    Parameters
    ----------
    contact : BallContact or RollerContact
        Contact and load.
    films : tuple of float
        Minimum and central film thickness [m].
    inside, hertz : float
        Integral of eps_r dA/h over the default domain of solved contacts, and over the Hertz area [m].
    error : float or None
        Relative error of the films; None where it is unknown.
    wide : bool
        Whether the domain is that on which the contact would be solved, which is wider for light loads. The
        dry gap is integrated in the part that is added.

    Returns
    -------
    ContactSolution
        Its largest field strength is the voltage over the minimum film thickness.
    """
    ring, groups, oil = contact.ring, contact.conditions.contact, contact.ring.oil
    eps_r = ring.conditions.oil.relative_permittivity
    domain = _domain(contact, wide=wide)
    outside, mismatch = _outside(contact, domain, films[1])
    if wide:
        inside += oil.relative_permittivity * _further(contact, domain, films[1])
    axes = _axes(contact)
    values = ContactValues(
        max_pressure=contact.conditions.max_pressure,
        semi_axis_x=axes[0],
        semi_axis_y=axes[1],
        minimum_thickness=films[0],
        central_thickness=films[1],
        inside=epsilon_0 * inside,
        outside_oil=outside * eps_r,
        outside_air=outside,
        plate=epsilon_0 * oil.relative_permittivity * hertz_area(contact) / films[1],
        strength_per_volt=1.0 / films[0],
        breakdown_voltage=gap_breakdown(ring.discharge, films[0]),
        hertz=epsilon_0 * hertz,
    )
    grid = ball_grid(contact) if isinstance(contact, BallContact) else roller_grid(contact)
    setup = Setup(oil=oil, grid=grid)
    if isinstance(contact, BallContact):
        warnings = point_case_warnings(setup, contact.conditions)
    else:
        warnings = line_case_warnings(setup, contact.conditions)
    return ContactSolution(
        load=contact.load,
        values=values,
        error=error,
        moes_m=groups.moes_m,
        moes_l=groups.moes_l,
        mismatch=mismatch,
        converged=True,
        warnings=without_regime(warnings),
    )


def _domain(contact: Contact, *, wide: bool) -> tuple[float, float, float]:
    """Ends along entrainment and side of the domain in semi-axes: default, or that of a solved contact."""
    if isinstance(contact, RollerContact):
        grid = roller_grid(contact)
        return (grid.inlet, grid.outlet, 1.0) if wide else (*LINE, 1.0)
    grid = ball_grid(contact)
    assert grid.side is not None
    return (grid.inlet, grid.outlet, grid.side) if wide else (*POINT, contact.conditions.side)


def _outside(contact: Contact, domain: tuple[float, float, float], central: float) -> tuple[float, float]:
    """Capacitance in vacuum [F] around the domain, and how far its gap is off at the edge, relative."""
    if isinstance(contact, RollerContact):
        b = contact.conditions.half_width
        x = np.array(domain[:2])
        gap = central + b**2 / contact.conditions.reduced_radius * line_gap(x)
        return around_roller(contact.ring, b, b * x, gap), 0.0
    dry, side = contact.dry, domain[2]
    x = dry.semi_axis_x * np.linspace(*domain[:2], _NODES[0])
    y = dry.semi_axis_y * np.linspace(-side, side, _NODES[1])
    # Only the gap at the edge is used.
    gap = np.full(_NODES, central)
    for edge in (np.s_[0, :], np.s_[-1, :], np.s_[:, 0], np.s_[:, -1]):
        gap[edge] = central + _opened(contact, *(axis[edge] for axis in np.meshgrid(x, y, indexing="ij")))
    return around_ball(contact, (x, y), gap)


def _opened(contact: BallContact, x: Array, y: Array) -> Array:
    """Gap of a ball's dry contact [m] at positions [m]."""
    conditions, dry = contact.conditions, contact.dry
    rigid = x**2 / (2.0 * conditions.radius_x) + y**2 / (2.0 * conditions.radius_y)
    return np.maximum(0.0, rigid + point_deflection(x, y, dry, conditions.reduced_modulus) - dry.approach)


def _further(contact: Contact, domain: tuple[float, float, float], central: float) -> float:
    """Integral of dA/h [m] between the default domain and a wider one."""
    total = 0.0
    if isinstance(contact, RollerContact):
        b = contact.conditions.half_width
        scale = b**2 / contact.conditions.reduced_radius
        for near, far in zip(LINE, domain[:2], strict=True):
            x, weights = _geometric(abs(near), abs(far))
            total += contact.length * b * float(np.sum(weights / (central + scale * line_gap(x))))
        return total
    dry, side, far = contact.dry, contact.conditions.side, domain[2]
    across = far * _AT**2, far * 2.0 * _AT * _PART
    strips = [(_geometric(abs(near), abs(end)), across) for near, end in zip(POINT, domain[:2], strict=True)]
    for sign in (-1.0, 1.0):
        end = abs(POINT[0 if sign < 0.0 else 1])
        strips.append(((end * _AT, end * _PART), _geometric(side, far)))
    for (x, along), (y, beside) in strips:
        if along[0] * beside[0] == 0.0:
            continue
        at = dry.semi_axis_x * x[:, np.newaxis], dry.semi_axis_y * y
        inverse = 1.0 / (central + _opened(contact, *np.broadcast_arrays(*at)))
        total += 2.0 * dry.semi_axis_x * dry.semi_axis_y * float(along @ inverse @ beside)
    return total


def _geometric(near: float, far: float) -> tuple[Array, Array]:
    """Nodes and weights from ``near`` to ``far``, denser at the near end."""
    ratio = np.log(far / near)
    nodes = near * np.exp(ratio * _AT)
    return nodes, ratio * nodes * _PART
