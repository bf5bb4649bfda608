"""Contacts of a bearing at once: from the atlas of films or by film formulas, without solving them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, partial

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.bearing.ball_gaps import UnitContact, around_directly, between_directly, parts_around_ellipse
from ehlectric.bearing.conditions import gap_breakdown
from ehlectric.bearing.gap_tables import around_of_rollers
from ehlectric.bearing.ring_contacts import (
    BALL_DOMAINS,
    BallContact,
    Contact,
    ContactSolution,
    RollerContact,
    check_contact,
    raceway_of,
    roller_raceway_of,
    solution_of,
    without_regime,
)
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import ROLLERS
from ehlectric.cases.defaults import OF_CONTACTS, QUICK, quick_way
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.grid_inputs import DEFAULT_ENDS, Grid
from ehlectric.contact.problems import Setup
from ehlectric.contact.warnings import case_warnings
from ehlectric.errors import InputError, ResultWarning
from ehlectric.field.zones import areas
from ehlectric.film.atlas.atlas_films import ContactFilm, contact_film
from ehlectric.formulas.film_line import BothThicknesses, pan_hamrock
from ehlectric.formulas.film_point import chittenden
from ehlectric.formulas.hertz import (
    DryContact,
    axis_ratio,
    line_gap,
    line_pressure,
    point_deflection,
    point_pressure,
)
from ehlectric.lubricant.oil import Oil

# Factors by which films from formulas, and margins with them, may be off either way. Balls have the formula
# of Chittenden, Dowson, Dunn and Taylor: solved films of bearings are within 30 % of it. Rollers have that
# of Pan and Hamrock: formulas for line contacts differ from solved films by up to 40 %.
_FORMULA_OF_BALLS, _FORMULA_OF_ROLLERS = 1.3, 1.4


def formula_factor(kind: str) -> float:
    """Factor by which films from formulas may be off either way, by the kind of the bearing.

    Examples
    --------
    >>> formula_factor("deep-groove ball"), formula_factor("cylindrical roller")
    (1.3, 1.4)
    """
    return _FORMULA_OF_ROLLERS if kind == ROLLERS else _FORMULA_OF_BALLS


def is_quick(case: object) -> bool:
    """Whether a case is a bearing whose contacts are not solved."""
    return isinstance(case, BearingCase) and case.contacts in QUICK


def check_quick(contacts: str, discharge: Discharge, oil: Oil) -> None:
    """Refuse an oil or a dielectric strength for which contacts that are not solved have no result. Raises
    InputError for a Weibull law and for a strength over pressure, which need the field in the whole film; for
    a viscosity that does not grow with pressure.
    """
    name = OF_CONTACTS[contacts]
    if oil.alpha == 0.0:
        raise InputError(
            "lubricant.viscosity_law",
            got=f"{oil.laws['viscosity']!r} with {name}, which are for piezoviscous oils;",
            takes="another law, or solved contacts",
        )
    table = discharge.strength_table
    if discharge.weibull is not None or (table is not None and table.over == "pressure"):
        key = "weibull" if discharge.weibull is not None else "strength_table"
        raise InputError(
            f"discharge.{key}",
            got=f"a strength that needs the field, with {name}, which have none",
            takes="dielectric_strength, a table over temperature, or solved contacts",
        )


def heat_by_formula(case: BearingCase) -> BearingCase:
    """Case whose heat in the films is that of "inlet-shear" where it would be solved, which takes seconds."""
    solved = case.bearing.film_factor == "solved"
    return case.replace({"bearing.film_factor": "inlet-shear"}) if solved else case


def quick_case(case: BearingCase, *, constant: bool = False) -> tuple[BearingCase | None, InputError | None]:
    """Case of a bearing with contacts that are not solved, and what cannot be computed without that.

    Returns ``case``, case with contacts from the atlas or by formula, and with the heat of its films by
    formula where it is solved; without a dielectric strength where it needs the field, unless ``constant``;
    None for an oil that neither describes; ``refused``, key that cannot be used, and why.
    """
    contacts = quick_way(case.contacts)
    changed = heat_by_formula(case).replace({"contacts": contacts})
    discharge, bearing = case.discharge, case.bearing
    try:
        oil = case.lubricant.at(bearing.oil_temperature, bearing.temperature_key())
        check_quick(contacts, discharge, oil)
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


def _ball_gap(contact: BallContact, central: float) -> tuple[tuple[Array, ...], Array, Array]:
    """Nodes along and across entrainment [m] of a ball, the gap of its dry contact, widened by its central
    film [m], and the Hertz pressure over its maximum.
    """
    conditions, dry = contact.conditions, contact.dry
    b, a = contact.axes
    side = a * conditions.side
    x, y = b * np.linspace(*POINT, _NODES[0]), np.linspace(-side, side, _NODES[1])
    rigid = x[:, np.newaxis] ** 2 / (2.0 * conditions.radius_x) + y**2 / (2.0 * conditions.radius_y)
    ratio = axis_ratio(conditions.radius_x, conditions.radius_y)
    opened = dry.max_pressure * b / conditions.reduced_modulus * _unit_opening(ratio, conditions.side)
    gap = central + np.maximum(0.0, rigid + opened - dry.approach)
    return (x, y), gap, point_pressure(x[:, np.newaxis] / b, y / b, a / b)


def _roller_gap(contact: RollerContact, central: float) -> tuple[tuple[Array, ...], Array, Array]:
    """Nodes along entrainment [m] of a roller, the gap of its dry contact, widened by its central film [m],
    and the Hertz pressure over its maximum.
    """
    conditions = contact.conditions
    unit, b = np.linspace(*LINE, _LINE_NODES), conditions.half_width
    x, gap = b * unit, central + b**2 / conditions.reduced_radius * line_gap(unit)
    return (x,), gap, line_pressure(x / b)


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


@dataclass(frozen=True)
class QuickContact:
    """Contact without a solved film, before the capacitance around its domain is computed."""

    contact: Contact
    films: tuple[float, float]  # minimum and central film thickness [m]
    # inside and hertz: integral of eps_r dA/h over the domain, and over the Hertz area [m].
    inside: float
    hertz: float
    grid: Grid
    domain: tuple[float, float, float]  # ends along entrainment and side of the domain in semi-axes
    error: float | None = None  # relative error of the films; None where it is unknown
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
    """Contact without a solved film. ``films``, minimum and central film thickness [m]; ``inside`` and
    ``hertz``, integral of eps_r dA/h over the default domain of solved contacts, and over the Hertz area [m];
    ``error``, relative error of the films; None where it is unknown.
    """
    grid = contact.grid
    domain = _domain(contact, grid if wide else None)
    if wide:
        inside += contact.ring.oil.relative_permittivity * _further(contact, domain, films[1])
    return QuickContact(contact, films, inside, hertz, grid, domain, error)


def quick_solutions(contacts: Sequence[QuickContact]) -> list[ContactSolution]:
    """Solutions of quick contacts with one ring; the largest field is the voltage over the minimum film."""
    return [_solution(contact, around) for contact, around in zip(contacts, _around(contacts), strict=True)]


def _solution(quick: QuickContact, around: tuple[float, float]) -> ContactSolution:
    """Solution of a quick contact with the capacitance around its domain in vacuum [F]."""
    contact, (least, central) = quick.contact, quick.films
    oil = contact.ring.oil
    setup = Setup(oil=oil, grid=quick.grid)
    warnings = case_warnings(setup, contact.conditions)
    return solution_of(
        contact,
        quick.films,
        around,
        inside=epsilon_0 * quick.inside,
        plate=epsilon_0 * oil.relative_permittivity * contact.area / central,
        strength_per_volt=1.0 / least,
        breakdown_voltage=gap_breakdown(contact.ring.discharge, least),
        hertz=epsilon_0 * quick.hertz,
        error=quick.error,
        converged=True,
        warnings=(*quick.warnings, *without_regime(warnings)),
    )


def _domain(contact: Contact, grid: Grid | None) -> tuple[float, float, float]:
    """Ends along entrainment and side of the domain in semi-axes: of a grid, or the default ones."""
    if grid is not None:
        return *grid.ends, grid.side or 1.0
    return (*POINT, contact.conditions.side) if isinstance(contact, BallContact) else (*LINE, 1.0)


def _around(contacts: Sequence[QuickContact]) -> Iterator[tuple[float, float]]:
    """Capacitances in vacuum [F] around domains, and how far their gaps are off at the edge, relative."""
    balls = [(quick, quick.contact) for quick in contacts if isinstance(quick.contact, BallContact)]
    if balls:
        yield from _around_balls(balls)
        return
    rollers = [quick.contact for quick in contacts if isinstance(quick.contact, RollerContact)]
    b = np.array([contact.conditions.half_width for contact in rollers])
    inlet, outlet, _ = np.array([quick.domain for quick in contacts]).T
    films = np.array([quick.films[1] for quick in contacts])
    race = roller_raceway_of(rollers[0].ring)
    around = rollers[0].length * around_of_rollers(race, b, (-inlet, outlet), films)
    # The gap outside continues the film at both ends.
    yield from ((outside, 0.0) for outside in around.tolist())


def _around_balls(balls: Sequence[tuple[QuickContact, BallContact]]) -> Iterator[tuple[float, float]]:
    """Capacitances in vacuum [F] around the domains of balls, and how far their gaps are off, relative."""
    b = np.array([contact.dry.semi_axis_x for _, contact in balls])
    inlet, outlet, side = np.array([quick.domain for quick, _ in balls]).T
    films = np.array([quick.films[1] for quick, _ in balls])
    found = around_directly(raceway_of(balls[0][1].ring), b, (inlet, outlet, side), films)
    yield from zip(*(values.tolist() for values in found), strict=True)


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
    conditions, b = contact.conditions, contact.dry.semi_axis_x
    unit = UnitContact.of(conditions.radius_x, conditions.radius_y)
    default, wide = (-POINT[0], POINT[1], conditions.side), (-domain[0], *domain[1:])
    middle = np.array([central * conditions.radius_x / b**2])
    return float(conditions.radius_x * between_directly(unit, default, wide, middle)[0])


def _geometric(near: float, far: float) -> tuple[Array, Array]:
    """Nodes and weights from ``near`` to ``far``, denser at the near end."""
    ratio = np.log(far / near)
    nodes = near * np.exp(ratio * _AT)
    return nodes, ratio * nodes * _PART


def by_formula(
    contact: Contact, films: tuple[float, float] | None = None, *, wide: bool = False
) -> QuickContact:
    """Film, capacitances and voltages of a contact by film formulas. ``films``, minimum and central film
    thickness [m] in place of those of the formula. Returns numbers without an error estimate: the formulas
    may be 30 % off for balls and 40 % for rollers, and more for light loads. Raises InputError as
    ``check_contact`` does.

    Film thickness of balls by Chittenden, Dowson, Dunn and Taylor (1985), doi:10.1098/rspa.1985.0014, and of
    rollers by Pan and Hamrock (1989), doi:10.1115/1.3261900. The gap is the gap of the dry contact plus the
    central film thickness. The capacitance is computed with the permittivity under the Hertz pressure; the
    maximum field strength is the voltage divided by the minimum film thickness.
    """
    check_contact(contact)
    if isinstance(contact, BallContact):
        films = films or _films(chittenden(contact.conditions.contact))
        nodes, gap, ratio = _ball_gap(contact, films[1])
    else:
        films = films or _films(pan_hamrock(contact.conditions.contact))
        nodes, gap, ratio = _roller_gap(contact, films[1])
    law = partial(permittivity, contact.ring.oil)
    pressure = contact.conditions.max_pressure * ratio
    inside = contact.length * float(np.vdot(areas(nodes), law(pressure) / gap))
    # The Hertz area is a plate with the permittivity under the Hertz pressure.
    hertz = hertz_mean(contact, law) * contact.area / films[1]
    return quick_contact(contact, films, inside=inside, hertz=hertz, wide=wide)


def _films(film: BothThicknesses) -> tuple[float, float]:
    """Minimum and central film thickness of a formula [m]."""
    return film.minimum_thickness, film.central_thickness


# Keys of the errors with which the atlas says that it has no film of a contact.
_LEFT = ("moes_m", "moes_n", "moes_y", "ratio", "atlas")

# Loads at which the atlas is asked for the nearest film that it has: their ratio, how many there are either
# way, and how often the last ratio is halved.
_STEP, _STEPS, _HALVINGS = 1.3, 15, 6

# Nodes and weights on 0 to 1 with which the gap outside the Hertz area is integrated. The integrals are
# within 1e-4 of those with three times as many nodes.
_ATLAS_NODES, _WEIGHTS = (0.5 * values for values in np.polynomial.legendre.leggauss(32))
_ATLAS_NODES = _ATLAS_NODES + 0.5

# Integral over a part of the dry gap outside the Hertz area: weights and gaps, both dimensionless.
_Part = tuple[Array, Array]


def by_atlas(contact: Contact) -> QuickContact:
    """Film, capacitances and voltages of a contact from the atlas of films. Returns numbers with the error
    that the atlas states for the films. Raises InputError as ``check_contact`` does.

    Over the Hertz area the capacitance is that of the film of the atlas with the permittivity under the Hertz
    pressure, which is lowered to the central pressure of the atlas in light contacts. Around it, inside the
    domain of the atlas, it is that of the dry gap plus the central film, times the ratio that the atlas has
    for inlet or outlet, with the permittivity at ambient pressure. The largest field strength is the voltage
    over the minimum film thickness.
    """
    check_contact(contact)
    film = _film(contact)
    if film is None:
        return _left(contact)
    oil, numbers, radii, b = contact.ring.oil, film.film, contact.ring.radii, contact.axes[0]
    # The gap over b^2/Rx depends on the ratio of the radii alone, and dA/h of a ball has the unit Rx.
    if isinstance(contact, BallContact):
        unit, parts = radii.radius_x, _around_ball(float(radii.radius_y / radii.radius_x))
    else:
        unit, parts = contact.length * radii.radius_x / b, _around_roller()
    middle = film.central_thickness * radii.radius_x / b**2
    inlet, outlet = (unit * _integral(part, middle) for part in parts)
    outside = oil.relative_permittivity * (numbers.inlet * inlet + numbers.outlet * outlet)
    # The atlas has the mean of 1/(rho h) over that in the middle, where the mass is most alike for all oils.
    mass = film.central_thickness * numbers.mass / numbers.central
    # In a light contact the pressure reaches far ahead of the zone, and is lower in it. Where a spike passes
    # the middle, its pressure is not that of the zone.
    share = min(1.0, numbers.central_pressure)
    mean = hertz_mean(contact, lambda pressure: _permittivity_of_mass(oil, share * pressure))
    hertz = numbers.zone * mean * contact.area / mass
    return quick_contact(
        contact,
        (film.minimum_thickness, film.central_thickness),
        inside=hertz + outside,
        hertz=hertz,
        error=max(film.errors["central"], film.errors["minimum"]),
        wide=True,
    )


# Functions that compute a contact without solving it, by ``contacts`` of a bearing file.
QUICK_METHODS: Mapping[str, Callable[[Contact], QuickContact]] = {"atlas": by_atlas, "formula": by_formula}


def _film(contact: Contact) -> ContactFilm | None:
    """Film of a contact; None outside the atlas."""
    try:
        return contact_film(contact.conditions.contact, contact.ring.oil)
    except InputError as error:
        if error.key not in _LEFT:
            raise
        return None


def _left(contact: Contact) -> QuickContact:
    """Contact outside the atlas: by formula, joined to the atlas at the nearest load that it has."""
    error = formula_factor(contact.ring.conditions.bearing.kind) - 1.0
    edge = _edge(contact)
    if edge is None:
        solution = by_formula(contact, wide=True)
    else:
        # Without a step at the edge of the atlas, all quantities can be interpolated over the load. From
        # there the films change as those of a formula that holds for light contacts, too.
        last, trend = by_atlas(edge), contact.film / edge.film
        least, central = last.films
        joined = by_formula(edge, last.films, wide=True)
        solution = by_formula(contact, (trend * least, trend * central), wide=True)
        inside, hertz = last.inside / joined.inside, last.hertz / joined.hertz
        solution = replace(solution, inside=inside * solution.inside, hertz=hertz * solution.hertz)
    warning = ResultWarning.of("atlas-left", percent=100.0 * error)
    return replace(solution, error=error, warnings=(warning,))


def _edge(contact: Contact) -> Contact | None:
    """Same contact under the load nearest to its own that the atlas has; None where it has none near."""
    for number in range(1, _STEPS + 1):
        for step in (_STEP, 1.0 / _STEP):
            inside = replace(contact, load=contact.load * step**number)
            if _film(inside) is None:
                continue
            outside, ratio = contact.load * step ** (number - 1), step
            for _ in range(_HALVINGS):
                ratio = math.sqrt(ratio)
                between = replace(contact, load=outside * ratio)
                if _film(between) is None:
                    outside = between.load
                else:
                    inside = between
            return inside
    return None


def _permittivity_of_mass(oil: Oil, pressure: Array) -> Array:
    """Relative permittivity times density ratio of an oil under pressure [Pa]."""
    return permittivity(oil, pressure) * oil.density_ratio(pressure)[0]


def _integral(part: _Part, middle: float) -> float:
    """Integral of dA/h over a part of the gap, widened by the film in the middle; dimensionless."""
    weights, gap = part
    return float(np.sum(weights / (middle + gap)))


@lru_cache(maxsize=1)
def _around_roller() -> tuple[_Part, _Part]:
    """Gap before and behind the Hertz zone of a roller, with lengths in b and gaps in b^2/R.

    Nodes are dense at the edge of the zone, where the gap begins with a power of 1.5.
    """
    parts = []
    for end in LINE:
        length = abs(end) - 1.0
        x = 1.0 + length * _ATLAS_NODES**3
        parts.append((length * 3.0 * _ATLAS_NODES**2 * _WEIGHTS, line_gap(x)))
    return parts[0], parts[1]


def _around_ball(radius_ratio: float) -> tuple[_Part, _Part]:
    """Gap before and behind the middle of a ball's contact, outside the Hertz ellipse.

    Lengths are in b and gaps in b^2/Rx.
    """
    return parts_around_ellipse(radius_ratio, BALL_DOMAINS)
