"""Contacts of a bearing at once: from the atlas of films or by film formulas, without solving them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers
from ehlectric.bearing.ball_gaps import around_directly
from ehlectric.bearing.bearing_kinds import kind_of
from ehlectric.bearing.conditions import gap_breakdown
from ehlectric.bearing.gap_tables import around_ellipses, around_of_balls, around_of_rollers, between_domains
from ehlectric.bearing.ring_contacts import (
    BallContact,
    Contact,
    ContactCurve,
    ContactValues,
    RollerContact,
    beyond_model,
    check_contact,
    roller_raceway_of,
    without_regime,
)
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_kinds import has_rollers
from ehlectric.cases.defaults import OF_CONTACTS, QUICK, quick_way
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.grid_inputs import DEFAULT_ENDS
from ehlectric.constants import EPSILON_0
from ehlectric.contact import Setup, case_warnings
from ehlectric.errors import InputError
from ehlectric.film import contact_film
from ehlectric.formulas.dry_means import ELLIPSE, STRIP, pressure_mean, wedge_integral
from ehlectric.formulas.film_line import LineContact, martin, pan_hamrock
from ehlectric.formulas.film_point import PointContact, brewe_hamrock_taylor, chittenden
from ehlectric.formulas.hertz import line_gap
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.result_warnings import ResultWarning

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
    return _FORMULA_OF_ROLLERS if has_rollers(kind) else _FORMULA_OF_BALLS


def is_quick(case: object) -> bool:
    """Whether a case is a bearing whose contacts are not solved."""
    return isinstance(case, BearingCase) and case.contacts in QUICK


def check_quick(contacts: str, discharge: Discharge, oil: Oil) -> None:
    """Refuse an oil or a dielectric strength for which contacts that are not solved have no result. Raises
    InputError for a Weibull law and for a strength over pressure, which need the field in the whole film; for
    a viscosity that does not grow with pressure.
    """
    name = OF_CONTACTS[contacts]
    if np.all(np.equal(oil.alpha, 0.0)):
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
    """Case whose heat in the films is "inlet-shear" where it would be solved, which takes seconds."""
    solved = case.bearing.film_factor == "solved"
    return case.replace({"bearing.film_factor": "inlet-shear"}) if solved else case


def quick_case(case: BearingCase, *, constant: bool = False) -> tuple[BearingCase | None, InputError | None]:
    """Case of a bearing with contacts that are not solved, and what cannot be computed without that.

    Returns ``case``, case with contacts from the atlas or from formulas, and with the heat of its films by
    formula where it is solved; without a dielectric strength where it needs the field, unless ``constant``;
    None for an oil that neither describes; ``refused``, key that cannot be used, and why.
    """
    contacts = quick_way(case.contacts)
    changed = heat_by_formula(case)
    if changed.contacts != contacts:
        changed = changed.replace({"contacts": contacts})
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


def required_quick_case(
    case: BearingCase, *, constant: bool = False
) -> tuple[BearingCase, InputError | None]:
    """Case of ``quick_case``, and what it neglects; raises this InputError where there is no case."""
    quick, refused = quick_case(case, constant=constant)
    if quick is None:
        assert refused is not None
        raise refused
    return quick, refused


# Domain along entrainment, in semi-axes of a ball's contact or half-widths of a roller's: the default domain
# of solved contacts, and the domain of the atlas.
LINE, POINT = DEFAULT_ENDS[False], DEFAULT_ENDS[True]

# Nodes on the edge of the domain of a ball's contact, along and across entrainment.
_NODES = 97, 65

# Nodes and weights on 0 to 1 with which the gap further away is integrated.
_AT, _PART = (0.5 * values for values in np.polynomial.legendre.leggauss(12))
_AT = _AT + 0.5


def permittivity(oil: Oil, pressure: Array) -> Array:
    """Relative permittivity of the oil under pressure [Pa], dimensionless."""
    return oil.permittivity(pressure, oil.density_ratio(pressure)[0])


def hertz_mean(contact: Contact, law: Callable[[Array], Array], share: Numbers = 1.0) -> Array:
    """Mean over the Hertz area of a number that depends on the Hertz pressure [Pa], times ``share``."""
    area = ELLIPSE if isinstance(contact, BallContact) else STRIP
    return pressure_mean(area, law, np.asarray(share * contact.conditions.max_pressure))


@dataclass(frozen=True)
class QuickContact:
    """Contacts of a ring without solved films, before the capacitance around their domains is computed.

    Numbers have the shape (m, ...) of the loads, with the points of operation last.
    """

    contact: Contact
    films: tuple[Numbers, Numbers]  # minimum and central film thickness [m]
    # inside and hertz: integral of eps_r dA/h over the domain, and over the Hertz area [m].
    inside: Array
    hertz: Array
    domain: tuple[Numbers, Numbers, Numbers]  # ends along entrainment and side of the domain in semi-axes
    error: Array  # relative error of the films; NaN where it is unknown
    left: Mask  # contacts outside the atlas
    refused: Mask  # contacts beyond the model, whose numbers have no meaning

    @property
    def load(self) -> Array:
        """Loads of the contacts [N]."""
        return np.broadcast_to(self.contact.load, self.inside.shape)


def quick_contact(
    contact: Contact,
    films: tuple[Array, Array],
    *,
    inside: Array,
    hertz: Array,
    refused: Mask,
    wide: bool = False,
) -> QuickContact:
    """Contacts without solved films. ``films``, minimum and central film thickness [m]; ``inside`` and
    ``hertz``, integral of eps_r dA/h over the default domain of solved contacts, and over the Hertz area [m];
    ``refused``, contacts beyond the model; ``wide``, whether light contacts have the domain of their film.
    """
    domain = _domain(contact, wide=wide)
    if wide:
        inside = inside + contact.ring.oil.relative_permittivity * _beyond(contact, domain, films[1])
    unknown, none = np.full(inside.shape, np.nan), np.zeros(inside.shape, dtype=bool)
    return QuickContact(contact, films, inside, hertz, domain, unknown, none, refused)


# Quantities of the dry contact, which are powers of the load, and those that go with another quantity.
_DRY = ("max_pressure", "semi_axis_x", "semi_axis_y")
_FOLLOWS = {
    "strength_per_volt": ("minimum_thickness", -1.0),
    "breakdown_voltage": ("minimum_thickness", 1.0),
    "outside_oil": ("outside_air", 1.0),
}


def quick_curve(
    quick: QuickContact, used: Mask | None = None, around: tuple[Array, Array] | None = None
) -> ContactCurve:
    """Curve of estimated contacts over their loads; the largest field is the voltage over the minimum film.

    ``used``, loads in use of each point, shape (..., m), all by default; ``around``, capacitances in vacuum
    around the domains [F], and how far their gaps are off at the edge, relative, shape (m, ...), where they
    are known already.
    """
    contact, (least, central) = quick.contact, quick.films
    oil, strength, shape = contact.ring.oil, contact.ring.discharge, quick.inside.shape
    outside, mismatch = _around_all(quick) if around is None else around
    groups, (along, across) = contact.conditions.contact, contact.axes
    values = ContactValues(
        max_pressure=contact.conditions.max_pressure,
        semi_axis_x=along,
        semi_axis_y=across,
        minimum_thickness=least,
        central_thickness=central,
        inside=EPSILON_0 * quick.inside,
        outside_oil=outside * contact.ring.conditions.oil.relative_permittivity,
        outside_air=outside,
        plate=EPSILON_0 * oil.relative_permittivity * contact.area / central,
        strength_per_volt=1.0 / least,
        breakdown_voltage=gap_breakdown(strength, least),
        hertz=EPSILON_0 * quick.hertz,
    )

    def column(numbers: Numbers | Mask) -> Any:
        """Numbers with the axis of the loads last."""
        return np.ascontiguousarray(np.moveaxis(np.broadcast_to(numbers, shape), 0, -1))

    refused = np.any(quick.refused, axis=0)
    exponents = (("load", exponent) for exponent in kind_of(contact.ring).dry_exponents)
    return ContactCurve(
        loads=column(contact.load),
        values=ContactValues(*map(column, values.columns())),
        error=column(quick.error),
        moes_m=column(groups.moes_m),
        moes_l=column(groups.moes_l),
        mismatch=column(mismatch),
        converged=np.ones((*shape[1:], shape[0]), dtype=bool),
        used=np.ones((*shape[1:], shape[0]), dtype=bool) if used is None else used,
        warnings_of=partial(quick_warnings, quick),
        left=column(quick.left),
        follows=_FOLLOWS | dict(zip(_DRY, exponents, strict=True)),
        refused=refused if shape[1:] else bool(refused),
    )


def outside_atlas(error: float, *, light: bool = False) -> ResultWarning:
    """Warning about contacts that the atlas does not have, with the relative error of their films; a note
    about ``light`` contacts.
    """
    code = "atlas-left-light" if light else "atlas-left"
    return ResultWarning.of(code, percent=100.0 * min(1.0, error))


def quick_warnings(quick: QuickContact) -> list[tuple[ResultWarning, ...]]:
    """Warnings about the contacts of a single bearing, by increasing load."""
    warnings_of_loads: list[tuple[ResultWarning, ...]] = []
    setup: Setup | None = None
    rows = zip(quick.load.tolist(), quick.left.tolist(), quick.error.tolist(), strict=True)
    for load, left, error in rows:
        contact = replace(quick.contact, load=load)
        grid = contact.grid
        setup = Setup(oil=contact.ring.oil, grid=grid) if setup is None else replace(setup, grid=grid)
        warnings = case_warnings(setup, contact.conditions_on(grid))
        of_atlas = (outside_atlas(error),) if left else ()
        warnings_of_loads.append((*of_atlas, *without_regime(warnings)))
    return warnings_of_loads


def _around_all(quick: QuickContact) -> tuple[Array, Array]:
    """Capacitances in vacuum [F] around domains, and how far their gaps are off at the edge, relative, shape
    (m, ...). Of balls of many points this difference is not computed, and NaN.
    """
    contact, central, shape = quick.contact, quick.films[1], quick.inside.shape
    (inlet, outlet, side), b = quick.domain, contact.axes[0]
    if isinstance(contact, RollerContact):
        tails = around_of_rollers(roller_raceway_of(contact.ring), b, (-inlet, outlet), central)
        # The gap outside continues the film at both ends.
        return np.broadcast_to(contact.length * tails, shape), np.zeros(shape)
    race = contact.ring.raceway
    if not contact.ring.shape:
        return around_directly(race, b, quick.domain, central, nodes=contact.domains.nodes)
    return around_of_balls(race, b, (-inlet, outlet, side), central, contact.domains), np.full(shape, np.nan)


def _domain(contact: Contact, *, wide: bool) -> tuple[Numbers, Numbers, Numbers]:
    """Ends along entrainment and side of the domain in semi-axes: of the contact, or the default domain."""
    if wide:
        inlet, outlet, side = contact.domain
        return -inlet, outlet, side
    return (*POINT, contact.conditions.side) if isinstance(contact, BallContact) else (*LINE, 1.0)


def _beyond(contact: Contact, domain: tuple[Numbers, Numbers, Numbers], central: Array) -> Array:
    """Integral of dA/h [m] between the default domain and a wider one, shape (m, ...)."""
    radius, b = contact.ring.radii.radius_x, contact.axes[0]
    inlet, outlet, side = domain
    if isinstance(contact, BallContact):
        middle, ends = central * radius / b**2, (-inlet, outlet, side)
        return np.asarray(radius * between_domains(contact.ring.raceway, ends, middle, contact.domains))
    total, scale = np.zeros(central.shape), b**2 / radius
    for near, far in zip(LINE, (inlet, outlet), strict=True):
        x, weights = _geometric(abs(near), np.abs(far))
        gap = central[..., np.newaxis] + np.asarray(scale)[..., np.newaxis] * line_gap(x)
        total += contact.length * b * np.sum(weights / gap, axis=-1)
    return total


def _geometric(near: float, far: Array) -> tuple[Array, Array]:
    """Nodes and weights from ``near`` to each of ``far``, denser at the near end, shape (..., k)."""
    ratio = np.log(far / near)[..., np.newaxis]
    nodes = near * np.exp(ratio * _AT)
    return nodes, ratio * nodes * _PART


def by_formula(
    contact: Contact, films: tuple[Array, Array] | None = None, *, wide: bool = False
) -> QuickContact:
    """Films, capacitances and voltages of contacts of a ring by film formulas. ``films``, minimum and central
    film thickness [m] instead of the thicknesses from the formula. Returns numbers without an error estimate:
    the formulas may be 30 % off for balls and 40 % for rollers, and more for light loads. Raises InputError
    as ``check_contact`` does for the contacts of a single bearing.

    Film thickness of balls by Chittenden, Dowson, Dunn and Taylor (1985), doi:10.1098/rspa.1985.0014, and of
    rollers by Pan and Hamrock (1989), doi:10.1115/1.3261900. Light contacts have the films of rigid bodies by
    Martin, and by Brewe, Hamrock and Taylor. The gap is the gap of the dry contact plus the central film
    thickness. The capacitance is computed with the permittivity under the Hertz pressure; the
    maximum field strength is the voltage divided by the minimum film thickness.
    """
    refused = _refused(contact)
    if films is None:
        groups = contact.conditions.contact
        heavy, rigid = _FORMULAS[type(groups)]
        film, light = heavy(groups), rigid(groups).minimum_thickness
        films = _down_to_rigid(film.minimum_thickness, light), _down_to_rigid(film.central_thickness, light)
    oil = contact.ring.oil
    # The Hertz area is a plate with the permittivity under the Hertz pressure.
    hertz = hertz_mean(contact, partial(permittivity, oil)) * contact.area / films[1]
    inside = hertz + oil.relative_permittivity * sum(_around_hertz(contact, films[1]))
    return quick_contact(contact, films, inside=inside, hertz=hertz, refused=refused, wide=wide)


# Formulas for heavy contacts and for rigid bodies, which light ones are.
_FORMULAS: Mapping[Any, tuple[Callable[[Any], Any], Callable[[Any], Any]]] = {
    PointContact: (chittenden, brewe_hamrock_taylor),
    LineContact: (pan_hamrock, martin),
}

# Power in which the films of both formulas are added. The sum is within 16 % of the films of the atlas, from
# 1 N to 2 kN in bearings of 40 mm.
_ADDED = 4.0


def _down_to_rigid(film: Array, rigid: Array) -> Array:
    """Film [m] from the films of deformed and of rigid bodies, of which the thicker one counts."""
    larger, smaller = np.maximum(film, rigid), np.minimum(film, rigid)
    return np.asarray(larger * (1.0 + (smaller / larger) ** _ADDED) ** (1.0 / _ADDED))


def _refused(contact: Contact) -> Mask:
    """Contacts beyond the model, shape (m, ...); a single bearing is refused with an InputError."""
    refused, loads = beyond_model(contact), np.asarray(contact.load)
    if contact.ring.shape:
        pressure = np.where(refused, 0.0, contact.conditions.max_pressure)
        return np.asarray(refused | np.isnan(permittivity(contact.ring.oil, pressure)))
    # The heaviest contact has the largest pressure, at which a law may have no value.
    for load in loads[refused | (loads == loads.max())][::-1]:
        check_contact(replace(contact, load=float(load)))
    return np.asarray(refused)


def _around_hertz(contact: Contact, central: Array) -> tuple[Array, Array]:
    """Integral of dA/h [m] before and behind the middle of a contact, inside the default domain and outside
    the Hertz area, shape (m, ...).
    """
    # The gap over b^2/Rx depends only on the ratio of the radii, and dA/h of a ball has the unit Rx.
    radius, b = contact.ring.radii.radius_x, contact.axes[0]
    middle = central * radius / b**2
    if isinstance(contact, BallContact):
        inlet, outlet = around_ellipses(contact.ring.raceway, middle, contact.domains)
        return radius * inlet, radius * outlet
    unit = contact.length * radius / b
    return unit * wedge_integral(middle, LINE[0]), unit * wedge_integral(middle, LINE[1])


def by_atlas(contact: Contact) -> QuickContact:
    """Films, capacitances and voltages of contacts of a ring from the atlas of films. Returns numbers with
    the error that the atlas states for the films. Raises InputError as ``check_contact`` does for the
    contacts of a single bearing.

    The film of a contact outside the atlas continues the film at its edge by a formula, with an error that
    grows with the distance.

    Over the Hertz area the capacitance follows from the film of the atlas with the permittivity under the
    Hertz pressure, which is lowered to the central pressure of the atlas in light contacts. Around it, inside
    the domain of the atlas, it follows from the dry gap plus the central film, times the ratio that the atlas
    has for inlet or outlet, with the permittivity at ambient pressure. The largest field strength is the
    voltage over the minimum film thickness.
    """
    refused, oil = _refused(contact), contact.ring.oil
    ellipse = contact.ring.ellipse if isinstance(contact, BallContact) else None
    film = contact_film(contact.conditions.contact, oil, ellipse, beyond=True)
    numbers = film.film
    least, central = np.asarray(film.minimum_thickness), np.asarray(film.central_thickness)
    inlet, outlet = _around_hertz(contact, central)
    outside = oil.relative_permittivity * (numbers.inlet * inlet + numbers.outlet * outlet)
    # The atlas has the mean of 1/(rho h) over that in the middle, where the mass is most alike for all oils.
    mass = central * numbers.mass / numbers.central
    # In a light contact the pressure reaches far ahead of the zone, and is lower in it. If a spike passes
    # the middle, its pressure is not the pressure of the zone.
    share = np.minimum(1.0, numbers.central_pressure)
    hertz = (
        numbers.zone * hertz_mean(contact, partial(permittivity_of_mass, oil), share) * contact.area / mass
    )
    quick = quick_contact(
        contact, (least, central), inside=hertz + outside, hertz=hertz, refused=refused, wide=True
    )
    error = np.maximum(film.errors["central"], film.errors["minimum"])
    return replace(quick, error=error, left=~np.asarray(numbers.known) & ~refused)


# Functions that compute contacts without solving them, by ``contacts`` of a bearing file.
QUICK_METHODS: Mapping[str, Callable[[Contact], QuickContact]] = {"atlas": by_atlas, "formula": by_formula}


def permittivity_of_mass(oil: Oil, pressure: Array) -> Array:
    """Relative permittivity times density ratio of an oil under pressure [Pa]."""
    density = oil.density_ratio(pressure)[0]
    return np.asarray(oil.permittivity(pressure, density) * density)
