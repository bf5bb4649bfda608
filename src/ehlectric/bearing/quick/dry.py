"""Dry contacts of a bearing, a film apart: the gap, and what contacts without a solved film share."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import astuple, dataclass
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
    around_balls,
    around_roller,
)
from ehlectric.cases.grid import DEFAULT_ENDS, Grid
from ehlectric.contact.case_warnings import line_case_warnings, point_case_warnings
from ehlectric.contact.setup import Setup
from ehlectric.errors import ResultWarning
from ehlectric.formulas.hertz_line import line_gap
from ehlectric.formulas.hertz_point import DryContact, axis_ratio, point_deflection
from ehlectric.lubricant.oil import Oil

# Domain along entrainment, in semi-axes of a ball's contact or half-widths of a roller's: the default domain
# of solved contacts, and that of the atlas.
LINE, POINT = DEFAULT_ENDS[False], DEFAULT_ENDS[True]

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


@dataclass(frozen=True)
class QuickContact:
    """Contact without a solved film, before the capacitance around its domain is computed.

    Attributes
    ----------
    contact : BallContact or RollerContact
        Contact and load.
    films : tuple of float
        Minimum and central film thickness [m].
    inside, hertz : float
        Integral of eps_r dA/h over the domain, and over the Hertz area [m].
    grid : Grid
        Grid on which the contact would be solved.
    domain : tuple of float
        Ends along entrainment and side of the domain in semi-axes.
    error : float or None
        Relative error of the films; None where it is unknown.
    warnings : tuple of ResultWarning
        Warnings on the way to the films.
    """

    contact: Contact
    films: tuple[float, float]
    inside: float
    hertz: float
    grid: Grid
    domain: tuple[float, float, float]
    error: float | None = None
    warnings: tuple[ResultWarning, ...] = ()

    @property
    def load(self) -> float:
        """Load of the contact [N]."""
        return self.contact.load


def quick_contact(
    contact: Contact,
    films: tuple[float, float],
    *,
    inside: float,
    hertz: float,
    error: float | None = None,
    wide: bool = False,
) -> QuickContact:
    """Contact without a solved film.

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
    QuickContact
        Contact with its domain.
    """
    grid = ball_grid(contact) if isinstance(contact, BallContact) else roller_grid(contact)
    domain = _domain(contact, grid if wide else None)
    if wide:
        inside += contact.ring.oil.relative_permittivity * _further(contact, domain, films[1])
    return QuickContact(contact, films, inside, hertz, grid, domain, error)


def quick_solutions(contacts: Sequence[QuickContact]) -> list[ContactSolution]:
    """Numbers of contacts with one ring without solved films.

    Parameters
    ----------
    contacts : sequence of QuickContact
        Contacts with the same ring. The capacitance around their domains is computed for all at once.

    Returns
    -------
    list of ContactSolution
        Their largest field strength is the voltage over the minimum film thickness.
    """
    around = _around(contacts)
    return [_solution(contact, *found) for contact, found in zip(contacts, around, strict=True)]


def _solution(quick: QuickContact, outside: float, mismatch: float) -> ContactSolution:
    """Numbers of a contact with the capacitance in vacuum around its domain [F]."""
    contact, (least, central) = quick.contact, quick.films
    groups, ring, oil = contact.conditions.contact, contact.ring, contact.ring.oil
    axes = _axes(contact)
    values = ContactValues(
        max_pressure=contact.conditions.max_pressure,
        semi_axis_x=axes[0],
        semi_axis_y=axes[1],
        minimum_thickness=least,
        central_thickness=central,
        inside=epsilon_0 * quick.inside,
        outside_oil=outside * ring.conditions.oil.relative_permittivity,
        outside_air=outside,
        plate=epsilon_0 * oil.relative_permittivity * hertz_area(contact) / central,
        strength_per_volt=1.0 / least,
        breakdown_voltage=gap_breakdown(ring.discharge, least),
        hertz=epsilon_0 * quick.hertz,
    )
    setup = Setup(oil=oil, grid=quick.grid)
    if isinstance(contact, BallContact):
        warnings = point_case_warnings(setup, contact.conditions)
    else:
        warnings = line_case_warnings(setup, contact.conditions)
    return ContactSolution(
        load=contact.load,
        values=values,
        error=quick.error,
        moes_m=groups.moes_m,
        moes_l=groups.moes_l,
        mismatch=mismatch,
        converged=True,
        warnings=(*quick.warnings, *without_regime(warnings)),
    )


def _domain(contact: Contact, grid: Grid | None) -> tuple[float, float, float]:
    """Ends along entrainment and side of the domain in semi-axes: of a grid, or the default ones."""
    if isinstance(contact, RollerContact):
        return (*LINE, 1.0) if grid is None else (*grid.ends, 1.0)
    if grid is None:
        return (*POINT, contact.conditions.side)
    assert grid.side is not None
    return *grid.ends, grid.side


def _around(contacts: Sequence[QuickContact]) -> Iterator[tuple[float, float]]:
    """Capacitances in vacuum [F] around domains, and how far their gaps are off at the edge, relative."""
    balls = [(quick, quick.contact) for quick in contacts if isinstance(quick.contact, BallContact)]
    if balls:
        yield from _around_balls(balls)
        return
    for quick in contacts:
        contact = quick.contact
        assert isinstance(contact, RollerContact)
        b, x = contact.conditions.half_width, np.array(quick.domain[:2])
        gap = quick.films[1] + b**2 / contact.conditions.reduced_radius * line_gap(x)
        yield around_roller(contact.ring, b, b * x, gap), 0.0


def _around_balls(balls: Sequence[tuple[QuickContact, BallContact]]) -> Iterator[tuple[float, float]]:
    """Capacitances in vacuum [F] around the domains of balls, and how far their gaps are off, relative."""
    ring, conditions = balls[0][1].ring, balls[0][1].conditions
    rx, ry, modulus = conditions.radius_x, conditions.radius_y, conditions.reduced_modulus
    dry = DryContact(*np.array([astuple(contact.dry) for _, contact in balls]).T)
    domains = np.array([quick.domain for quick, _ in balls]).T
    films = np.array([quick.films[1] for quick, _ in balls])[:, np.newaxis]
    rims = np.stack([_unit_rim(axis_ratio(rx, ry), *quick.domain) for quick, _ in balls], axis=1)
    b, a, pressure, approach = (values[:, np.newaxis] for values in vars(dry).values())
    x, y, opened = b * rims[0], a * rims[1], pressure * b / modulus * rims[2]
    gap = np.maximum(0.0, x**2 / (2.0 * rx) + y**2 / (2.0 * ry) + opened - approach)
    domain = dry.semi_axis_x * domains[0], dry.semi_axis_x * domains[1], dry.semi_axis_y * domains[2]
    found = around_balls(ring, dry, domain, (x, y), films + gap, opened)
    yield from ((float(outside), float(mismatch)) for outside, mismatch in zip(*found, strict=True))


@lru_cache(maxsize=128)
def _unit_rim(ratio: float, inlet: float, outlet: float, side: float) -> Array:
    """Nodes on the edge of a ball's domain in semi-axes, and deflection over p_h b/E', shape (3, n).

    The deflection is the same on both sides across entrainment.
    """
    along, across = np.linspace(inlet, outlet, _NODES[0]), np.linspace(0.0, side, _NODES[1] // 2 + 1)
    # Both ends from the middle to the side, and the side without its ends.
    x = np.concatenate([np.full(across.shape, inlet), np.full(across.shape, outlet), along[1:-1]])
    y = np.concatenate([across, across, np.full(along.size - 2, side)])
    unit = DryContact(semi_axis_x=1.0, semi_axis_y=ratio, max_pressure=1.0, approach=0.0)
    half = np.stack([x, y, point_deflection(x, ratio * y, unit, 1.0)])
    other = half[:, y > 0.0] * np.array([[1.0], [-1.0], [1.0]])
    rim = np.concatenate([half, other], axis=1)
    rim.flags.writeable = False
    return rim


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
    dry, conditions = contact.dry, contact.conditions
    b, a = dry.semi_axis_x, dry.semi_axis_y
    for x, y, weights, opened in _unit_beyond(a / b, conditions.side, domain):
        rigid = (b * x) ** 2 / (2.0 * conditions.radius_x) + (a * y) ** 2 / (2.0 * conditions.radius_y)
        bent = dry.max_pressure * b / conditions.reduced_modulus * opened
        gap = central + np.maximum(0.0, rigid + bent - dry.approach)
        total += 2.0 * b * a * float(np.sum(weights / gap))
    return total


def _geometric(near: float, far: float) -> tuple[Array, Array]:
    """Nodes and weights from ``near`` to ``far``, denser at the near end."""
    ratio = np.log(far / near)
    nodes = near * np.exp(ratio * _AT)
    return nodes, ratio * nodes * _PART


@lru_cache(maxsize=128)
def _unit_beyond(
    ratio: float, side: float, domain: tuple[float, float, float]
) -> list[tuple[Array, Array, Array, Array]]:
    """Nodes in semi-axes, weights, deflection over p_h b/E' between the default domain and a wider one."""
    far = domain[2]
    across = far * _AT**2, far * 2.0 * _AT * _PART
    strips = [
        (_geometric(abs(near), abs(end)), across)
        for near, end in zip(POINT, domain[:2], strict=True)
        if end != near
    ]
    if far > side:
        strips += [((end * _AT, abs(end) * _PART), _geometric(side, far)) for end in POINT]
    unit = DryContact(semi_axis_x=1.0, semi_axis_y=ratio, max_pressure=1.0, approach=0.0)
    return [
        (
            x[:, np.newaxis],
            y,
            np.outer(along, beside),
            point_deflection(x[:, np.newaxis], ratio * y, unit, 1.0),
        )
        for (x, along), (y, beside) in strips
    ]
