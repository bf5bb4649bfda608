"""Films of smooth contacts from the atlas, dimensionless and in SI units, with the error of each number."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers, as_float
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_groups import SKEW, Ellipse, Groups, lubricant_coordinate
from ehlectric.film.atlas.atlas_table import NAMES, Table, table
from ehlectric.film.far_field import left_of_load, lost_by_load, missing_load
from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import PointContact
from ehlectric.formulas.hertz import axis_ratio
from ehlectric.lubricant.density import dowson_higginson
from ehlectric.lubricant.law import PressureLaw
from ehlectric.lubricant.oil import Oil
from ehlectric.lubricant.viscosity import reciprocal_asymptotic_alpha, roelands

# Pressure at which the integral of the coefficient ends, over 1/alpha*, as in Bair's film coefficient.
_END = 3.0

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_ENDS = np.linspace(0.0, _END, 17)


@dataclass(frozen=True)
class OilGroups:
    """Coefficient and weak groups of an oil, from its laws of viscosity and density over pressure.

    Groups of many oils, whose laws have parameters of shape (n,), have the shape (n,).
    """

    alpha: Numbers  # pressure-viscosity coefficient of the atlas [1/Pa]
    shape: Numbers  # ln(alpha/alpha*), which grows with the curvature of the viscosity law, dimensionless
    compressibility: Numbers  # slope of the density ratio at zero pressure over alpha, dimensionless

    @classmethod
    def of(cls, viscosity: PressureLaw, density: PressureLaw, alpha_star: Numbers | None = None) -> OilGroups:
        """Groups of an oil from ln(eta/eta0) and rho/rho0 over pressure [Pa].

        ``alpha_star``, reciprocal asymptotic coefficient of the oil [1/Pa], where it is known.
        """
        if alpha_star is None:
            alpha_star = reciprocal_asymptotic_alpha(viscosity)
        alpha = film_coefficient(viscosity, density, alpha_star)
        slope = as_float(np.asarray(density(np.zeros(()))[1]))
        return cls(alpha, as_float(np.log(alpha / alpha_star)), slope / alpha)


def film_coefficient(
    viscosity: PressureLaw, density: PressureLaw, alpha_star: Numbers | None = None
) -> Numbers:
    """Pressure-viscosity coefficient of the atlas: Bair's film coefficient of eta rho^2, in 1/Pa.

    alpha_m = (1 - e^-3)/Int_0^(3/alpha*) (eta(0)/eta(p)) (rho(0)/rho(p))^2 dp

    ``viscosity``, ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa];
    ``density``, rho/rho0 and its derivative by pressure [1/Pa], as a function of the pressure [Pa];
    ``alpha_star``, reciprocal asymptotic coefficient [1/Pa], where it is known. The parameters of the laws of
    many oils have the shape (n,), and the laws then take pressures of shape (k, n). Returns coefficient
    [1/Pa], shape () or (n,); alpha for an incompressible oil of Barus' law.

    With the mass per area m = rho h, the Reynolds equation of the inlet is
    dp/dx = 12 u eta rho^2 (m - m0)/m^3. The density therefore acts as a factor rho^2 of the viscosity.

    Examples
    --------
    >>> from ehlectric.lubricant.density import incompressible
    >>> from ehlectric.lubricant.viscosity import barus
    >>> law = lambda p: barus(p, pressure_viscosity_coefficient=2e-8)
    >>> round(film_coefficient(law, incompressible) * 1e9, 6)
    20.0
    """
    if alpha_star is None:
        alpha_star = reciprocal_asymptotic_alpha(viscosity)
    # Only one of both laws may have parameters of many oils.
    alpha_star = alpha_star + np.zeros_like(density(np.zeros(()))[0])
    middle, half = 0.5 * (_ENDS[1:] + _ENDS[:-1]), 0.5 * np.diff(_ENDS)
    ratio = (middle + half * _NODES[:, np.newaxis]).ravel()
    weights = (half * _WEIGHTS[:, np.newaxis]).ravel()
    pressure = np.multiply.outer(ratio, 1.0 / np.asarray(alpha_star))
    integrand = np.exp(-np.asarray(viscosity(pressure)[0])) / np.asarray(density(pressure)[0]) ** 2
    return as_float(-math.expm1(-_END) * alpha_star / (weights @ integrand))


# Oil of the atlas: Roelands' law and the density of Dowson and Higginson, with typical parameters. The films
# of other oils are corrected by their weak groups.
REFERENCE: dict[str, dict[str, float]] = {
    "viscosity": {"pressure_viscosity_coefficient": 20e-9, "roelands_z": 0.67, "roelands_pressure": 0.2e9},
    "density": {"density_c1": 0.59e9, "density_c2": 1.34},
}


def reference_laws() -> tuple[Callable[..., Any], Callable[..., Any]]:
    """Viscosity and density laws of the oil with which the atlas is computed."""
    return (
        partial(roelands, **REFERENCE["viscosity"]),
        partial(dowson_higginson, **REFERENCE["density"]),
    )


# Largest Hertz pressure of points over 1/alpha: 5 GPa with 20 1/GPa. Higher ones converge slowly.
MOST_HERTZ = 100.0

Laws = tuple[Callable[..., Any], Callable[..., Any]]

# The logarithms of the film mass at the centre, the minimum, the mean over the central film, and the ratios
# inlet and outlet change with the differences of an oil's shape (first row) and compressibility (second row)
# from the shape and compressibility of the reference oil, times (1, l, m, m^2, l m) with l = ln(L/10) and m =
# ln(M/50), times these numbers. They are fitted to 585 line contacts of 38 oils with M from 0.3 to 500; M of
# a point contact is the M of the line contact with the same velocity parameter.
_OIL = {
    "central": ((0.116, -0.195, -0.024, 0.009, 0.010), (-0.089, 0.155, 0.001, 0.005, -0.053)),
    "minimum": ((0.078, -0.192, -0.048, 0.002, -0.005), (-1.153, -0.274, 0.004, 0.033, -0.045)),
    "mean": ((-0.256, -0.163, -0.102, -0.010, -0.040), (0.683, 0.318, 0.150, -0.002, 0.083)),
    "inlet": ((0.126, 0.114, 0.091, 0.014, 0.041), (-0.562, -0.187, -0.154, -0.004, -0.063)),
    "outlet": ((0.246, 0.176, 0.108, 0.011, 0.050), (-0.782, -0.315, -0.160, 0.005, -0.089)),
}

# Further changes of point contacts, fitted to 32 of them with oils that are not compressed: these numbers
# times (1, l, m) and the square of the part by which an oil is compressed less than the reference oil.
_STIFF = {
    "central": (0.007, 0.003, 0.0),
    "minimum": (0.022, 0.011, 0.003),
    "mean": (-0.028, -0.007, 0.001),
    "zone": (0.007, 0.006, 0.0),
    "inlet": (0.026, 0.007, 0.002),
    "outlet": (0.035, 0.013, 0.001),
}

# Further changes of point contacts, whose minimum is next to the centre: these numbers times (1, l, m, ln k)
# and the difference of the shape, fitted to 152 pairs of contacts that differ only in their oil.
_POINTS = {"minimum": (0.318, 0.012, 0.065, -0.069)}

# Group L below which the changes fall in proportion to it: at L = 0 the film knows no law of the oil. Of 300
# line contacts with L from 0.5 to 45, of which 68 have less, 97 % are then within the stated error.
_LEAST_FITTED = 1.5

# Spread between oils that 95 % of the fitted contacts keep: after the correction, and without it, for
# contacts whose oil is not known. Below ``_LIGHT``, by M of a line, the spread and the error of the table are
# twice as large, and the spread and error of the central film four times: the spike of the pressure passes
# the centre there.
_SPREAD = {"central": 0.006, "minimum": 0.011, "mean": 0.016, "zone": 0.003, "inlet": 0.025, "outlet": 0.028}
_WHOLE = {"central": 0.020, "minimum": 0.032, "mean": 0.021, "zone": 0.004, "inlet": 0.030, "outlet": 0.031}
_OTHER = 0.01
_LIGHT = 5.0

# More of the errors for oils that are compressed less than the oils of the fit, times what they are
# compressed less, for films of nearly constant viscosity, and for the central film of contacts that are wide
# along entrainment. In light contacts with incompressible oils the spike of the pressure passes the centre at
# other loads, and films there are up to 20 % off. With L of 0.66 to 0.86 the film was 1.8 % off, where 1.5 %
# were stated.
_STIFF_ERROR = {"central": 0.004, "minimum": 0.016, "mean": 0.02, "zone": 0.005}
_STIFF_LIGHT = {"central": 0.2, "mean": 0.1, "zone": 0.15}
_LIGHTEST, _ISOVISCOUS, _WIDE = 2.5, 0.008, 0.01

# Load group N of points above which the mean films of oils differ more, and by how much.
_HEAVY, _HEAVY_ERROR = 1000.0, 0.006

# Number of nodes of a problem of which only the domain counts.
_ANY = 65

# Largest change of the density for a change of the pressure by a factor of e, at pressures of light contacts.
_DENSITY = 0.15


@dataclass(frozen=True)
class AtlasFilm:
    """Film of a smooth, fully flooded, isothermal contact, interpolated in the atlas.

    Films are in Moes' unit, R (eta0 u_s/(E' R))^(1/2), with the radius R along entrainment. Numbers of many
    contacts have the shape (...), and are NaN for contacts that the atlas does not have.
    """

    # central, minimum and mean: film thickness at x = y = 0, smallest film thickness, and mean over the Hertz
    # zone.
    central: Numbers
    minimum: Numbers
    mean: Numbers
    mass: Numbers  # density ratio times film thickness at x = y = 0, which depends least on the oil
    central_pressure: Numbers  # pressure at x = y = 0 over the Hertz pressure
    # zone, inlet and outlet: mean of rho(0) h(0)/(rho h) over the Hertz zone; integral of dA/h before and
    # behind the middle of the contact, outside the Hertz zone, divided by the integral of the dry gap plus
    # the central film.
    zone: Numbers
    inlet: Numbers
    outlet: Numbers
    # Place of the smallest film, x/b along and abs(y)/a across entrainment.
    minimum_at: tuple[Numbers, Numbers]
    errors: dict[str, Numbers]  # relative error of each number, which about 95 % of solved contacts keep
    known: Mask | bool = True  # whether the atlas has the contact


@lru_cache(maxsize=1)
def reference_groups() -> OilGroups:
    """Groups of the oil with which the atlas is computed."""
    return OilGroups.of(*reference_laws())


def in_atlas(groups: Groups) -> Mask:
    """Whether contacts with groups of shape (...) lie in the atlas, between nodes that have a film."""
    return _films(groups).has(*_coordinates(groups)) & _is_solvable(groups)


def _films(groups: Groups) -> Table:
    """Table of the atlas with the kind of the contacts."""
    return table("lines" if groups.ratio is None else "points")


def _coordinates(groups: Groups) -> tuple[Numbers, ...]:
    """Coordinates of contacts in the atlas: N or M, Y, and k of points."""
    further = () if groups.ratio is None else (groups.ratio,)
    return groups.load_group, lubricant_coordinate(groups), *further


def _is_solvable(groups: Groups) -> Mask | bool:
    """Whether Hertz pressures are in the range in which films of point contacts were solved."""
    return groups.ratio is None or groups.hertz_number <= MOST_HERTZ


def check_in_atlas(groups: Groups) -> None:
    """Raise an InputError for a single contact that the atlas does not have."""
    films, at = _films(groups), [float(coordinate) for coordinate in _coordinates(groups)]
    films.check_range(*at)
    if not _is_solvable(groups):
        raise InputError(
            "atlas",
            got=f"alpha p_h = {groups.hertz_number:.4g}",
            takes=f"at most {MOST_HERTZ:g}, the range of the atlas of points",
        )
    films.check(*at)


def _continued_at(groups: Groups) -> tuple[Numbers, ...]:
    """Coordinates at which films outside the atlas are continued: the lightest ones at the same group L."""
    load, _, *ratio = _coordinates(groups)
    held = np.maximum(load, _films(groups).axes[0][0])
    return load, lubricant_coordinate(Groups(held, groups.moes_l)), *ratio


def _nearest(groups: Groups, *, known: Mask | bool) -> Groups:
    """Groups of contacts; for contacts outside the atlas, the nearest groups in its range."""
    nearest, lubricant, *others = _films(groups).nearest(*_continued_at(groups))
    load = np.where(known, np.asarray(groups.load_group), np.asarray(nearest))
    moes_l = np.where(known, groups.moes_l, lubricant / load**SKEW)
    if groups.ratio is None:
        return Groups(load, moes_l)
    ratio: Array = np.asarray(others[0])
    ellipse = groups.ellipse
    inside = np.equal(ellipse.ratio, ratio)
    if not np.all(inside):
        pairs = zip(vars(ellipse).values(), vars(Ellipse.of(ratio)).values(), strict=True)
        ellipse = Ellipse(*(np.where(inside, value, limit) for value, limit in pairs))
    return Groups(load * (ratio**0.75 / ellipse.q**0.25), moes_l, ratio, ellipse)


def atlas_film(
    groups: Groups, laws: Laws | None = None, oil: OilGroups | None = None, *, beyond: bool = False
) -> AtlasFilm:
    """Film of smooth contacts from their groups.

    ``groups``, numbers of one contact, or arrays of many that broadcast to a shape (...), the points of an
    oil of many points last; ``laws``, ln(eta/eta0) and rho/rho0 over pressure [Pa]; without them the laws of
    the reference oil, with the spread between oils as an error; ``oil``, groups of the oil, where they are
    known already; ``beyond``, whether the films of many contacts outside the atlas continue the films at its
    edge. The formula has their own groups, and the ratio of the film to the formula is the ratio at the edge.
    Returns numbers of the film with their errors. Raises InputError if a single contact is outside the range
    of the atlas; of many contacts, those that are outside have no numbers, unless they are ``beyond``.
    """
    given = laws is not None
    laws = reference_laws() if laws is None else laws
    oil = OilGroups.of(*laws) if oil is None else oil
    at, films = _coordinates(groups), _films(groups)
    if all(np.ndim(value) == 0 for value in at):
        check_in_atlas(groups)
        known: Mask | bool = True
    else:
        known = in_atlas(groups)
        if not beyond:
            at = tuple(np.where(known, value, middle) for value, middle in zip(at, films.middle, strict=True))
    stored, errors, growth = films.continued(*_continued_at(groups)) if beyond else (*films(*at), 0.0)
    near = _nearest(groups, known=known) if beyond and not np.all(known) else groups
    logs = dict(zip(NAMES, stored, strict=True))
    pressure, number, formula = np.exp(logs["pressure"]), groups.hertz_number, groups.formula
    reference, change = reference_groups(), OilChange(near, oil)
    of_reference = formula * np.exp(logs["central"])
    mass_of_reference = of_reference * _ratio(reference_laws()[1], pressure * number / reference.alpha)
    mass = mass_of_reference * change.factor("central")
    central = mass / _ratio(laws[1], pressure * number / oil.alpha)
    # The mean changes from oil to oil as the central film does.
    mean = formula * np.exp(logs["mean"]) * central / of_reference
    numbers: dict[str, Any] = {
        "central": central,
        "minimum": formula * np.exp(logs["minimum"]) * change.factor("minimum"),
        "mean": mean * change.factor("mean"),
        "mass": mass,
        "central_pressure": pressure,
        "zone": np.exp(logs["zone"]) * mass_of_reference / formula * change.of_stiff("zone"),
        "inlet": np.exp(logs["inlet"]) * change.factor("inlet"),
        "outlet": np.exp(logs["outlet"]) * change.factor("outlet"),
    }
    of_films = _errors(near, errors, _SPREAD if given else _WHOLE, oil, known=known | np.asarray(beyond))
    if known is not True and not beyond:
        numbers = {name: np.where(known, value, math.nan) for name, value in numbers.items()}
    # A single contact has floats.
    numbers = {name: as_float(value) for name, value in numbers.items()}
    place = as_float(logs["minimum_x"]), as_float(logs["minimum_y"])
    of_films = {name: as_float(error + growth) for name, error in of_films.items()}
    return AtlasFilm(**numbers, minimum_at=place, errors=of_films, known=known)


def _errors(
    groups: Groups, errors: Array, spread: dict[str, float], oil: OilGroups, *, known: Mask | bool
) -> dict[str, Numbers]:
    """Relative errors by name: of the table, and the spread between oils."""
    light = groups.line_load < _LIGHT
    more = np.where(light, 2.0, 1.0)
    total: dict[str, Numbers] = {
        name: more * (error + spread.get(name, _OTHER)) for name, error in zip(NAMES, errors, strict=True)
    }
    central, pressure = (errors[NAMES.index(name)] for name in ("central", "pressure"))
    # The kink of the central film where the spike passes the centre, and the density there.
    total["central"] = total["central"] + np.where(light, more * central, 0.0)
    total["zone"] = total["zone"] + np.where(light, _DENSITY * np.minimum(pressure, 1.0), 0.0)
    stiff = _stiffness(oil)
    for name, error in _STIFF_ERROR.items():
        total[name] = total[name] + error * stiff
    for name, error in _STIFF_LIGHT.items():
        total[name] = total[name] + np.where(groups.line_load < _LIGHTEST, error * stiff, 0.0)
    total["central"] = total["central"] + np.where(groups.moes_l < 1.0, _ISOVISCOUS, 0.0)
    if groups.ratio is not None:
        total["central"] = total["central"] + np.where(groups.ratio < 1.0, _WIDE, 0.0)
        total["mean"] = total["mean"] + np.where(groups.load_group > _HEAVY, _HEAVY_ERROR, 0.0)
        lost = _domain_error(groups, np.asarray(light & known))
        for name in ("central", "minimum", "mean"):
            total[name] = total[name] + lost
    # The mean of 1/(rho h) is stored without the central film.
    total["zone"] = total["zone"] + np.where(light, 2.0 * more, 1.0) * central
    return total


def _stiffness(oil: OilGroups) -> Numbers:
    """Part by which an oil is compressed less than the reference oil, 0 to 1."""
    return as_float(np.maximum(0.0, 1.0 - oil.compressibility / reference_groups().compressibility))


def _domain_error(groups: Groups, where: Mask) -> Numbers:
    """Share of the films of light point contacts that is missing, as the atlas ends its domain; else 0."""
    where = np.asarray(where)
    lost = np.zeros(where.shape)
    if np.any(where):
        ellipse = groups.ellipse.among(where.shape, where)
        load_group, lubricant_group = (
            np.broadcast_to(values, where.shape)[where] for values in (groups.moes_m, groups.moes_l)
        )
        light = Groups(load_group, lubricant_group, ellipse.ratio, ellipse)
        load = 2.0 * np.pi * ellipse.ratio / 3.0
        missing = missing_load(1.0 / light.radius_ratio, light.domain, light.velocity_parameter) / load
        lost[where] = lost_by_load(left_of_load(missing), light.load_exponent)
    return lost


class OilChange:
    """Change of numbers of the film from the reference oil to another one, at the same groups."""

    def __init__(self, groups: Groups, oil: OilGroups) -> None:
        reference = reference_groups()
        fitted = np.maximum(groups.moes_l, _LEAST_FITTED)
        self._lubricant, self._load = np.log(fitted / 10.0), np.log(groups.line_load / 50.0)
        self._part = groups.moes_l / fitted
        self._shape = oil.shape - reference.shape
        self._compressibility = oil.compressibility - reference.compressibility
        self._stiff = 0.0 if groups.ratio is None else _stiffness(oil) ** 2
        self._ratio = groups.ratio

    def factor(self, name: str) -> Numbers:
        """Factor of a number for the oil over that for the reference oil."""
        return self.of_lines(name) * self.of_stiff(name) * self.of_points(name)

    def of_lines(self, name: str) -> Numbers:
        """Part of the factor that is fitted to line contacts; points have it as well."""
        offset, lubricant, load, square, both = (
            shape * self._shape + compressibility * self._compressibility
            for shape, compressibility in zip(*_OIL[name], strict=True)
        )
        constant, slope = offset + lubricant * self._lubricant, load + both * self._lubricant
        change = self._part * (constant + self._load * (slope + square * self._load))
        return np.exp(change)

    def of_points(self, name: str) -> Numbers:
        """Part of the factor of only point contacts; 1 for numbers that change as in line contacts."""
        if self._ratio is None or name not in _POINTS:
            return 1.0
        terms = self.point_terms(self._ratio)
        return np.exp(sum(term * number for term, number in zip(terms, _POINTS[name], strict=True)))

    def point_terms(self, ratio: Numbers) -> tuple[Numbers, ...]:
        """Shape of the oil's law times (1, l, m, ln k), with the ratio k of the semi-axes."""
        shape = self._part * self._shape
        return shape, shape * self._lubricant, shape * self._load, shape * np.log(ratio)

    def of_stiff(self, name: str) -> Numbers:
        """Part of the factor for an oil that is compressed little, in a point contact."""
        offset, lubricant, load = _STIFF[name]
        return np.exp(self._part * self._stiff * (offset + lubricant * self._lubricant + load * self._load))


def _ratio(density: Callable[..., Any], pressure: Numbers) -> Numbers:
    """Density ratio at a pressure [Pa]."""
    return np.asarray(density(pressure)[0])


@dataclass(frozen=True)
class ContactFilm:
    """Film of a contact from the atlas, or of many contacts, in SI units."""

    # central_thickness, minimum_thickness and mean_thickness: film thickness at x = y = 0, smallest film
    # thickness, and mean over the Hertz zone [m].
    central_thickness: Numbers
    minimum_thickness: Numbers
    mean_thickness: Numbers
    groups: Groups  # M, L and k, with L made with the coefficient of the atlas
    film: AtlasFilm

    @property
    def errors(self) -> dict[str, Numbers]:
        """Relative errors of the films by "central", "minimum" and "mean", and of the other numbers."""
        return self.film.errors


def contact_film(
    contact: LineContact | PointContact,
    oil: Oil,
    ellipse: Ellipse | None = None,
    *,
    beyond: bool = False,
) -> ContactFilm:
    """Film of smooth, fully flooded, isothermal contacts, interpolated in the atlas.

    ``contact``, numbers of one contact, or arrays that broadcast to a shape (...), the points of an oil of
    many points last; ``ellipse``, shape of the dry contact of points, where it is known; ``beyond``, as in
    ``atlas_film``. Returns films [m], with the relative error of each; contacts outside the atlas have NaN,
    unless they are ``beyond``. Raises InputError if a single contact is outside the atlas.

    Examples
    --------
    >>> from ehlectric.cases.case_oil import Lubricant
    >>> oil = Lubricant.from_dict({"base": "paper"}).at(None)
    >>> ball = PointContact(
    ...     radius_x=10e-3, radius_y=10e-3, reduced_modulus=226e9, load=20.0, entrainment_speed=2.0,
    ...     viscosity=oil.viscosity, pressure_viscosity_coefficient=0.0,
    ... )
    >>> film = contact_film(ball, oil)
    >>> round(film.central_thickness * 1e6, 2)
    0.42
    """
    laws = (oil.log_viscosity, oil.density_ratio)
    groups = groups_of(contact, oil, ellipse)
    film = atlas_film(groups, laws, _groups_of(oil), beyond=beyond)
    radius = contact.reduced_radius if isinstance(contact, LineContact) else contact.radius_x
    unit = radius * as_float(np.sqrt(2.0 * contact._u))
    return ContactFilm(unit * film.central, unit * film.minimum, unit * film.mean, groups, film)


def groups_of(contact: LineContact | PointContact, oil: Oil, ellipse: Ellipse | None = None) -> Groups:
    """Groups of contacts with an oil, L with the coefficient of the atlas; arguments of ``contact_film``."""
    moved = replace(contact, pressure_viscosity_coefficient=_groups_of(oil).alpha)
    if isinstance(moved, LineContact):
        return Groups(moved.moes_m, moved.moes_l, None)
    if ellipse is None:
        return Groups(moved.moes_m, moved.moes_l, axis_ratio(moved.radius_x, moved.radius_y))
    return Groups(moved.moes_m, moved.moes_l, ellipse.ratio, ellipse)


@lru_cache(maxsize=64)
def _groups_of(oil: Oil) -> OilGroups:
    """Groups of an oil, kept because a bearing asks for the same oil many times."""
    return OilGroups.of(oil.log_viscosity, oil.density_ratio, oil.alpha_star)
