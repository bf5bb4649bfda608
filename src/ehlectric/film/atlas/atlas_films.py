"""Films of smooth contacts from the atlas, dimensionless and in SI units, with the error of each number."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_groups import Groups, film_problem, lubricant_coordinate
from ehlectric.film.atlas.atlas_table import NAMES, table
from ehlectric.film.film_error import lost_by_load, point_load_deficit
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
    """Coefficient and weak groups of an oil, from its laws of viscosity and density over pressure."""

    alpha: float  # pressure-viscosity coefficient of the atlas [1/Pa]
    shape: float  # ln(alpha/alpha*), which grows with the curvature of the viscosity law, dimensionless
    compressibility: float  # slope of the density ratio at zero pressure over alpha, dimensionless

    @classmethod
    def of(cls, viscosity: PressureLaw, density: PressureLaw) -> OilGroups:
        """Groups of an oil from ln(eta/eta0) and rho/rho0 over pressure [Pa]."""
        alpha = film_coefficient(viscosity, density)
        slope = float(np.ravel(density(np.zeros(1))[1])[0])
        return cls(alpha, math.log(alpha / reciprocal_asymptotic_alpha(viscosity)), slope / alpha)


def film_coefficient(viscosity: PressureLaw, density: PressureLaw) -> float:
    """Pressure-viscosity coefficient of the atlas: Bair's film coefficient of eta rho^2, in 1/Pa.

    alpha_m = (1 - e^-3)/Int_0^(3/alpha*) (eta(0)/eta(p)) (rho(0)/rho(p))^2 dp

    ``viscosity``, ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa];
    ``density``, rho/rho0 and its derivative by pressure [1/Pa], as a function of the pressure [Pa]. Returns
    coefficient [1/Pa]; alpha for an incompressible oil of Barus' law.

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
    ends = _ENDS / reciprocal_asymptotic_alpha(viscosity)
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends)
    pressure = (middle[:, np.newaxis] + half[:, np.newaxis] * _NODES).ravel()
    integrand = np.exp(-np.asarray(viscosity(pressure)[0])) / np.asarray(density(pressure)[0]) ** 2
    integral = float(half @ (np.reshape(integrand, (half.size, -1)) @ _WEIGHTS))
    return -math.expm1(-_END) / integral


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
# from those of the reference oil, times (1, l, m, m^2, l m) with l = ln(L/10) and m = ln(M/50), times these
# numbers. They are fitted to 585 line contacts of 38 oils with M from 0.3 to 500; M of a point contact is
# that of the line contact with the same velocity parameter.
_OIL = {
    "central": ((0.116, -0.195, -0.024, 0.009, 0.010), (-0.089, 0.155, 0.001, 0.005, -0.053)),
    "minimum": ((0.078, -0.192, -0.048, 0.002, -0.005), (-1.153, -0.274, 0.004, 0.033, -0.045)),
    "mean": ((-0.256, -0.163, -0.102, -0.010, -0.040), (0.683, 0.318, 0.150, -0.002, 0.083)),
    "inlet": ((0.126, 0.114, 0.091, 0.014, 0.041), (-0.562, -0.187, -0.154, -0.004, -0.063)),
    "outlet": ((0.246, 0.176, 0.108, 0.011, 0.050), (-0.782, -0.315, -0.160, 0.005, -0.089)),
}

# Spread between oils that 95 % of the fitted contacts keep: after the correction, and without it, for
# contacts whose oil is not known. Below ``_LIGHT``, by M of a line, the spread and the error of the table are
# twice as large, and that of the central film four times: the spike of the pressure passes the centre there.
_SPREAD = {"central": 0.006, "minimum": 0.015, "mean": 0.016, "zone": 0.003, "inlet": 0.025, "outlet": 0.028}
_WHOLE = {"central": 0.020, "minimum": 0.032, "mean": 0.021, "zone": 0.004, "inlet": 0.030, "outlet": 0.031}
_OTHER = 0.01
_LIGHT = 5.0

# More of the errors for oils that are compressed less than those of the fit, times what they are compressed
# less, and for films of nearly constant viscosity. Solved contacts with incompressible oils had a mean film
# up to 6.1 % thicker than that of the atlas and a minimum up to 2.7 % thinner; with L of 0.66 to 0.86 the
# film was 1.8 % off, where 1.5 % were stated.
_STIFF_MINIMUM, _STIFF_MEAN, _ISOVISCOUS = 0.016, 0.03, 0.008

# Number of nodes of a problem of which only the domain counts.
_ANY = 65

# Largest change of the density for a change of the pressure by a factor of e, at pressures of light contacts.
_DENSITY = 0.15


@dataclass(frozen=True)
class AtlasFilm:
    """Film of a smooth, fully flooded, isothermal contact, interpolated in the atlas.

    Films are in Moes' unit, R (eta0 u_s/(E' R))^(1/2), with the radius R along entrainment.
    """

    # central, minimum and mean: film thickness at x = y = 0, smallest film thickness, and mean over the Hertz
    # zone.
    central: float
    minimum: float
    mean: float
    mass: float  # density ratio times film thickness at x = y = 0, which depends least on the oil
    central_pressure: float  # pressure at x = y = 0 over the Hertz pressure
    # zone, inlet and outlet: mean of rho(0) h(0)/(rho h) over the Hertz zone; integral of dA/h before and
    # behind the middle of the contact, outside the Hertz zone, over that of the dry gap plus the central
    # film.
    zone: float
    inlet: float
    outlet: float
    minimum_at: tuple[float, float]  # place of the smallest film, x/b along and abs(y)/a across entrainment
    errors: dict[str, float]  # relative error of each number, which about 95 % of solved contacts keep


@lru_cache(maxsize=1)
def reference_groups() -> OilGroups:
    """Groups of the oil with which the atlas is computed."""
    return OilGroups.of(*reference_laws())


def atlas_film(groups: Groups, laws: Laws | None = None, oil: OilGroups | None = None) -> AtlasFilm:
    """Film of a smooth contact from its groups.

    ``laws``, ln(eta/eta0) and rho/rho0 over pressure [Pa]; without them those of the reference oil, with the
    spread between oils as an error; ``oil``, groups of the oil, where they are known already. Returns numbers
    of the film with their errors. Raises InputError: outside the range of the atlas.
    """
    known = laws is not None
    laws = reference_laws() if laws is None else laws
    oil = OilGroups.of(*laws) if oil is None else oil
    line = groups.ratio is None
    films = table("lines" if line else "points")
    at = (groups.load_group, lubricant_coordinate(groups), *(() if groups.ratio is None else (groups.ratio,)))
    films.check_range(*at)
    if not line and groups.hertz_number > MOST_HERTZ:
        raise InputError(
            "atlas",
            got=f"alpha p_h = {groups.hertz_number:.4g}",
            takes=f"at most {MOST_HERTZ:g}, the range of the atlas of points",
        )
    stored, errors = films(*at)
    logs = dict(zip(NAMES, stored.tolist(), strict=True))
    pressure, number = math.exp(logs["pressure"]), groups.hertz_number
    reference = reference_groups()
    of_reference = groups.formula * math.exp(logs["central"])
    mass_of_reference = of_reference * _ratio(reference_laws()[1], pressure * number / reference.alpha)
    mass = mass_of_reference * _factor("central", groups, oil)
    central = mass / _ratio(laws[1], pressure * number / oil.alpha)
    # The mean changes from oil to oil as the central film does.
    mean = groups.formula * math.exp(logs["mean"]) * central / of_reference
    return AtlasFilm(
        central=central,
        minimum=groups.formula * math.exp(logs["minimum"]) * _factor("minimum", groups, oil),
        mean=mean * _factor("mean", groups, oil),
        mass=mass,
        central_pressure=pressure,
        zone=math.exp(logs["zone"]) * mass_of_reference / groups.formula,
        inlet=math.exp(logs["inlet"]) * _factor("inlet", groups, oil),
        outlet=math.exp(logs["outlet"]) * _factor("outlet", groups, oil),
        minimum_at=(logs["minimum_x"], logs["minimum_y"]),
        errors=_errors(groups, errors, _SPREAD if known else _WHOLE, oil),
    )


def _line_load(groups: Groups) -> float:
    """M of the line contact with the same velocity parameter."""
    load = groups.load_group
    return load if groups.ratio is None else math.sqrt(3.0 * math.pi / 32.0) * load ** (2.0 / 3.0)


def _errors(groups: Groups, errors: Array, spread: dict[str, float], oil: OilGroups) -> dict[str, float]:
    """Relative errors by name: of the table, and the spread between oils."""
    more = 2.0 if _line_load(groups) < _LIGHT else 1.0
    total = {
        name: more * (float(error) + spread.get(name, _OTHER))
        for name, error in zip(NAMES, errors, strict=True)
    }
    central, pressure = (float(errors[NAMES.index(name)]) for name in ("central", "pressure"))
    if more > 1.0:
        # The kink of the central film where the spike passes the centre, and the density there.
        total["central"] += more * central
        total["zone"] += _DENSITY * min(pressure, 1.0)
    stiff = max(0.0, 1.0 - oil.compressibility / reference_groups().compressibility)
    total["minimum"] += _STIFF_MINIMUM * stiff
    total["mean"] += _STIFF_MEAN * stiff
    if groups.moes_l < 1.0:
        total["central"] += _ISOVISCOUS
    if groups.ratio is not None and more > 1.0:
        lost = _domain_error(groups)
        for name in ("central", "minimum", "mean"):
            total[name] += lost
    # The mean of 1/(rho h) is stored without the central film.
    total["zone"] += 2.0 * more * central if more > 1.0 else central
    return total


def _domain_error(groups: Groups) -> float:
    """Share of the film of a light point contact that is missing, as the atlas ends its domain."""
    problem = film_problem(groups, reference_laws(), reference_groups().alpha, _ANY)
    return lost_by_load(problem.thickness_guess) * point_load_deficit(problem)


def _factor(name: str, groups: Groups, oil: OilGroups) -> float:
    """Factor of a number for an oil over that for the reference oil, at the same groups."""
    reference = reference_groups()
    lubricant, load = math.log(groups.moes_l / 10.0), math.log(_line_load(groups) / 50.0)
    basis = np.array([1.0, lubricant, load, load**2, lubricant * load])
    shape, compressibility = np.array(_OIL[name]) @ basis
    change = shape * (oil.shape - reference.shape)
    return math.exp(change + compressibility * (oil.compressibility - reference.compressibility))


def _ratio(density: Callable[..., Any], pressure: float) -> float:
    """Density ratio at a pressure [Pa]."""
    ratio: Array = np.ravel(density(np.array([pressure]))[0])
    return float(ratio[0])


@dataclass(frozen=True)
class ContactFilm:
    """Film of a contact from the atlas, in SI units."""

    # central_thickness, minimum_thickness and mean_thickness: film thickness at x = y = 0, smallest film
    # thickness, and mean over the Hertz zone [m].
    central_thickness: float
    minimum_thickness: float
    mean_thickness: float
    groups: Groups  # M, L and k, with L made with the coefficient of the atlas
    film: AtlasFilm

    @property
    def errors(self) -> dict[str, float]:
        """Relative errors of the films by "central", "minimum" and "mean", and of the other numbers."""
        return self.film.errors


def contact_film(contact: LineContact | PointContact, oil: Oil) -> ContactFilm:
    """Film of a smooth, fully flooded, isothermal contact, interpolated in the atlas. Returns films [m], with
    the relative error of each. Raises InputError if the contact is outside the atlas.

    Examples
    --------
    >>> from ehlectric.cases.case_oil import Lubricant
    >>> oil = Lubricant.from_dict({"base": "paper"}).at(None)
    >>> ball = PointContact(10e-3, 10e-3, 226e9, 20.0, 2.0, oil.viscosity, 0.0)
    >>> film = contact_film(ball, oil)
    >>> round(film.central_thickness * 1e6, 2)
    0.42
    """
    laws = (oil.log_viscosity, oil.density_ratio)
    groups_of_oil = _groups_of(oil)
    moved = replace(contact, pressure_viscosity_coefficient=groups_of_oil.alpha)
    if isinstance(moved, LineContact):
        radius, ratio = moved.reduced_radius, None
    else:
        radius, ratio = moved.radius_x, axis_ratio(moved.radius_x, moved.radius_y)
    groups = Groups(moved.moes_m, moved.moes_l, ratio)
    film = atlas_film(groups, laws, groups_of_oil)
    unit = radius * float(np.sqrt(2.0 * moved._u))
    return ContactFilm(unit * film.central, unit * film.minimum, unit * film.mean, groups, film)


@lru_cache(maxsize=64)
def _groups_of(oil: Oil) -> OilGroups:
    """Groups of an oil, kept because a bearing asks for the same oil many times."""
    return OilGroups.of(oil.log_viscosity, oil.density_ratio)
