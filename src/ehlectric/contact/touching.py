"""Spots in which the surfaces of a solved contact touch: load, area, oil balance, resistance and breakdown.

A film that forms again behind a cavity carries its content of oil through the cavity
(``ehlectric.film.starved_solver``). If no such film converged, a cavitated gap counts as full in the wedge
term (``ehlectric.film.cavitation``), so that oil appears where the gap fills again. The residual of the
Reynolds equation at these nodes is that oil.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, Literal, TypeAlias

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.grid_inputs import Electric
from ehlectric.constants import EPSILON_0
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.problems import SCHEMES, fluid_of
from ehlectric.contact.setup import Setup
from ehlectric.discharge.breakdown_rule import POSSIBLE, TOUCHING_EXPECTED
from ehlectric.discharge.discharge_laws import WeakestLink
from ehlectric.discharge.film_breakdown import dielectric_strength
from ehlectric.discharge.film_verdict import unusable
from ehlectric.field import areas, areas_by_zone
from ehlectric.film import Film, Mesh, PointFilm, flow, residual, wedge_stencil
from ehlectric.formulas.asperities import (
    cluster_resistance,
    film_resistance,
    greenwood_cluster,
    sharvin_resistance,
    wexler_factor,
)
from ehlectric.formulas.film_line import CentralThickness, moes
from ehlectric.formulas.film_point import nijenbanning_venner_moes
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.field_metadata import number
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.statement import Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import formatted, readable
from ehlectric.surfaces.profiles import FLAT


@dataclass(frozen=True)
class Spots:
    """Spots of a contact, in the order of the nodes.

    Two nodes are in one spot if they are neighbours along an axis of the grid. Nodes that are neighbours
    along a diagonal only are two spots, as the film between them is connected. In a line contact a spot is a
    strip that is as long as the contact.
    """

    areas: Array  # area of each spot [m^2]; of a line contact its width [m], shape (n,)
    positions: Array  # centre of the area of each spot (x,) or (x, y) [m], shape (n, d)
    nodes: NDArray[np.int_]  # number of nodes of each spot, shape (n,)
    loads: Array  # load that each spot carries [N]; of a line contact per length [N/m], shape (n,)
    # Largest error of the total area because edges of spots lie somewhere between two nodes [m^2] or [m].
    edge: float

    @classmethod
    def of(cls, axes: tuple[Array, ...], contact: Mask, pressure: Array) -> Spots:
        """Spots of a contact from its nodes along each axis [m], the mask of the nodes where the surfaces
        touch, and their contact pressure [Pa], both of shape (nx,) or (nx, ny).

        Examples
        --------
        Three nodes in a row and one at a corner of them are two spots:

        >>> touching = np.array([[1, 1, 1, 0], [0, 0, 0, 1], [0, 0, 0, 0]], dtype=bool)
        >>> spots = Spots.of((np.arange(3.0), np.arange(4.0)), touching, 2.0 * touching)
        >>> spots.nodes.tolist(), spots.areas.tolist(), spots.edge
        ([3, 1], [1.25, 0.5], 2.5)
        """
        weights = areas(axes)
        labels, count = scipy.ndimage.label(contact)
        each = np.arange(1, count + 1)
        area = _sum(weights, labels, each)
        places = np.meshgrid(*axes, indexing="ij")
        centres = [_sum(weights * place, labels, each) / area for place in places]
        return cls(
            areas=area,
            positions=np.stack(centres, axis=-1),
            nodes=_sum(contact.astype(float), labels, each).astype(int),
            loads=_sum(weights * pressure, labels, each),
            edge=_edge(axes, contact),
        )

    @property
    def number(self) -> int:
        """Number of spots."""
        return int(self.areas.size)

    @property
    def area(self) -> float:
        """Area of all spots [m^2]; of a line contact their width [m]."""
        return float(np.sum(self.areas))

    @property
    def relative_edge(self) -> float | None:
        """Largest relative error of ``area``; None without spots."""
        return self.edge / self.area if self.number else None

    @property
    def radii(self) -> Array:
        """Radii of circles with the areas of the spots of a point contact [m], shape (n,)."""
        radii: Array = np.sqrt(self.areas / np.pi)
        return radii


def _sum(values: Array, labels: NDArray[Any], each: NDArray[Any]) -> Array:
    return np.asarray(scipy.ndimage.sum_labels(values, labels, each), dtype=float).reshape(each.size)


def _edge(axes: tuple[Array, ...], contact: Mask) -> float:
    """Half the area of the cells between touching nodes and neighbours that do not touch [m^2] or [m]."""
    total = 0.0
    for k, axis in enumerate(axes):
        inside = np.moveaxis(contact, k, 0)
        crossed = (inside[1:] != inside[:-1]) * np.diff(axis).reshape(-1, *[1] * (contact.ndim - 1))
        others = [other for j, other in enumerate(axes) if j != k]
        weights = areas(tuple(others)) if others else np.float64(1.0)
        total += 0.5 * float(np.sum(crossed * weights))
    return total


def weighted_percentiles(values: Array, weights: Array, shares: ArrayLike) -> Array:
    """Smallest values up to which at least the given shares of the weight lie, shape (n,).

    ``values`` and their ``weights``, not negative, have one shape; ``shares`` (n,) are from 0 to 1.

    Examples
    --------
    >>> weighted_percentiles(np.array([3.0, 1.0, 2.0]), np.array([1.0, 1.0, 2.0]), [0.1, 0.5, 1.0]).tolist()
    [1.0, 2.0, 3.0]
    """
    order = np.argsort(values, axis=None)
    up_to = np.cumsum(weights.ravel()[order])
    places = np.searchsorted(up_to, np.asarray(shares) * up_to[-1] * (1.0 - 1e-12))
    percentiles: Array = values.ravel()[order][np.minimum(places, order.size - 1)]
    return percentiles


# Shares of the area around the spots at which film thicknesses and breakdown voltages are given, by the
# number in the name of the value [%].
_THIN_SHARES = {1: 0.01, 5: 0.05, 50: 0.5}


def _percentiles(name: str, values: Array, weights: Array) -> dict[str, float | None]:
    """Values at the thin shares of the weight, with the keys ``name_1`` and so on; None without values."""
    keys = [f"{name}_{percent}" for percent in _THIN_SHARES]
    if not values.size:
        return dict.fromkeys(keys)
    percentiles = weighted_percentiles(values, weights, list(_THIN_SHARES.values()))
    return dict(zip(keys, percentiles.tolist(), strict=True))


@dataclass(frozen=True)
class Coarser:
    """Asperities of the same contact on a grid with half the nodes along each axis."""

    load_share: float = field(metadata=number("not negative"))  # part of the load that asperities carry
    # Part of the area of the dry smooth contact in which the surfaces touch.
    contact_area_share: float = field(metadata=number("not negative"))
    # Mean film thickness in the Hertz zone outside of the spots [m]; None if they cover it.
    mean_film: float | None = field(default=None, metadata=number("positive or null"))

    @classmethod
    def of(cls, conditions: Conditions | PointConditions, film: Film | PointFilm) -> Coarser:
        """Asperities of the film on the coarser grid."""
        zone = hertz_weights(film, conditions.semi_axes)
        return cls(
            load_share_of(conditions, spots_of(film)),
            touched_share(film, zone),
            _mean(*_around(film, zone)),
        )


@dataclass(frozen=True)
class Touching:
    """Load and area of the spots of a solved contact, and the film around them, SI units.

    Areas of a point contact [m^2] are widths of a line contact [m].
    """

    boundary_film: float  # gap at which the surfaces touch [m]
    load_share: float  # part of the load that the contact pressure of the asperities carries, from 0 to 1
    contact_area: float  # real area of contact: area of the nodes that touch
    # Part of the area of the dry smooth contact in which the surfaces touch, from 0 to 1
    contact_area_share: float
    # Relative error of ``contact_area``, the larger of two: the edges of spots lie between nodes, and the
    # area of the Hertz zone in contact changed from a grid with half the nodes. From 1 on, a fine grid may
    # have no spots at all. None without spots.
    contact_area_error: float | None
    # spots and spots_of_one_node: number of spots, and of those that are a single node and so are not
    # resolved.
    spots: int
    spots_of_one_node: int
    # mean_spot and largest_spot: mean and largest area of a spot; None without spots.
    mean_spot: float | None
    largest_spot: float | None
    # mean_film and least_film: mean and least film thickness in the Hertz zone outside of the spots [m]; None
    # if they cover it.
    mean_film: float | None
    least_film: float | None
    # film_1, film_5 and film_50: film thickness below which 1, 5 and 50 % of the area of the Hertz zone
    # outside of the spots lie [m].
    film_1: float | None
    film_5: float | None
    film_50: float | None
    # Root mean square of the film thickness less the film thickness of smooth surfaces, about its mean over
    # the Hertz zone [m]; None if the contact was not solved with smooth surfaces.
    rq_deformed: float | None
    # lambda_undeformed and lambda_deformed: mean film thickness in the Hertz zone, spots included, over the
    # combined Rq of the surfaces as they are, and over ``rq_deformed``; None without such an Rq.
    lambda_undeformed: float | None
    lambda_deformed: float | None
    # Share of asperities in the friction coefficient of sliding, ``load_share`` times the coefficient of the
    # case; None if the case gives none.
    boundary_friction: float | None


def spots_of(film: Film | PointFilm) -> Spots:
    """Spots of a film, none where its surfaces do not touch."""
    pressure = np.zeros_like(film.thickness) if film.contact_pressure is None else film.contact_pressure
    return Spots.of(film.axes, film.contact, pressure)


def hertz_weights(film: Film | PointFilm, semi_axes: tuple[float, ...]) -> Array:
    """Return each node's area [m^2] within the Hertz ellipse, or width [m] within the Hertz zone."""
    return areas_by_zone(film.axes, semi_axes)["hertz"]


def touched_share(film: Film | PointFilm, zone: Array) -> float:
    """Part of the Hertz zone in which the surfaces touch, from the weights of its nodes."""
    return float(np.sum(zone[film.contact]) / np.sum(zone))


def load_share_of(conditions: Conditions | PointConditions, spots: Spots) -> float:
    """Part of the load that the spots of a contact carry, at most 1."""
    return min(1.0, float(np.sum(spots.loads) / conditions.carried_load))


def touching(
    conditions: Conditions | PointConditions,
    film: Film | PointFilm,
    spots: Spots,
    *,
    rq: float,
    smooth: Array | None,
    friction: float | None,
    coarser: Coarser | None = None,
) -> Touching:
    """Load, area and film of a contact whose surfaces touch in spots.

    ``rq`` is the combined Rq of the undeformed surfaces over the Hertz zone [m]. ``smooth`` is the film
    thickness with smooth surfaces at the nodes of the film [m], or None if it was not solved. ``friction`` is
    the friction coefficient of asperities.
    """
    zone = hertz_weights(film, conditions.semi_axes)
    thickness, weights = _around(film, zone)
    deformed = None if smooth is None else weighted_rms(film.thickness - smooth, zone)
    mean = float(np.vdot(zone, film.thickness) / np.sum(zone))
    share, load_share = touched_share(film, zone), load_share_of(conditions, spots)
    return Touching(
        boundary_film=conditions.boundary_film,
        load_share=load_share,
        contact_area=spots.area,
        contact_area_share=share,
        contact_area_error=_area_error(spots, share, coarser),
        spots=spots.number,
        spots_of_one_node=int(np.count_nonzero(spots.nodes == 1)),
        mean_spot=spots.area / spots.number if spots.number else None,
        largest_spot=float(np.max(spots.areas)) if spots.number else None,
        mean_film=_mean(thickness, weights),
        least_film=float(np.min(thickness)) if thickness.size else None,
        **_percentiles("film", thickness, weights),
        rq_deformed=deformed,
        lambda_undeformed=mean / rq if rq >= FLAT else None,
        lambda_deformed=mean / deformed if deformed is not None and deformed >= FLAT else None,
        boundary_friction=None if friction is None else friction * load_share,
    )


def _around(film: Film | PointFilm, zone: Array) -> tuple[Array, Array]:
    """Film thickness [m] and weights of the nodes of the Hertz zone outside of the spots."""
    around = ~film.contact & (zone > 0.0)
    return film.thickness[around], zone[around]


def _mean(values: Array, weights: Array) -> float | None:
    """Weighted mean; None without values."""
    return float(np.average(values, weights=weights)) if values.size else None


def _area_error(spots: Spots, share: float, coarser: Coarser | None) -> float | None:
    """Relative error of the real area of contact, by the edges of spots or by its change with the grid."""
    edge = spots.relative_edge
    if edge is None or coarser is None or share == 0.0:
        return edge
    return max(edge, abs(coarser.contact_area_share / share - 1.0))


def weighted_rms(values: Array, weights: Array) -> float:
    """Root mean square of values about their mean, both weighted."""
    mean = float(np.vdot(weights, values) / np.sum(weights))
    return float(np.sqrt(np.vdot(weights, (values - mean) ** 2) / np.sum(weights)))


# Largest excess of the pressure of the oil over ambient by rounding, over p_h.
_ROUNDING = 1e-9

# Relative difference of the spacings of a uniform grid.
_UNIFORM = 1e-6


@dataclass(frozen=True)
class OilBalance:
    """Oil that a stationary film loses and makes, divided by the mean flow through its contact.

    The mean flow is the mean mass of the oil in the Hertz zone times the entrainment speed, over the
    width of the zone.
    """

    mass_error: float  # sum of both parts
    oil_lost: float  # oil that enters nodes where the surfaces touch and does not leave them
    # Oil that leaves cavitated nodes in the Hertz zone or in a spot in excess of what enters them, where oil
    # fills the gap again further downstream within the zone.
    oil_made: float


def oil_balance(
    case: Case | Setup, conditions: Conditions | PointConditions, film: Film | PointFilm
) -> OilBalance | None:
    """Balance of the oil of a converged stationary film, from its pressure and thickness.

    None where the nodes are not equidistant, as the nodes of a film with a patch.
    """
    if film.mass_residual is not None:
        return OilBalance(film.mass_residual, oil_lost=0.0, oil_made=film.mass_residual)
    if any(float(np.ptp(np.diff(axis))) > _UNIFORM * float(axis[1] - axis[0]) for axis in film.axes):
        return None
    order, law = SCHEMES[case.grid.wedge]
    fluid = fluid_of(case.oil, conditions.max_pressure, conditions.velocity_parameter)
    x, *across = (axis / conditions.half_width for axis in film.axes)
    mesh = Mesh(x, across[0] if across else np.zeros(1))
    # Width of the Hertz zone across entrainment, in half-widths; of a line contact one.
    width = 2.0 * conditions.semi_axes[1] / conditions.half_width if across else 1.0
    zone = mesh.x[:, np.newaxis] ** 2 + (mesh.y / width * 2.0) ** 2 < 1.0
    contact = film.contact.reshape(mesh.shape)
    touching = 0.0 if film.contact_pressure is None else film.contact_pressure
    oil = ((film.pressure - touching) / conditions.max_pressure).reshape(mesh.shape)
    gap = np.where(film.contact, np.maximum(film.thickness, conditions.boundary_film), film.thickness)
    thickness = (gap / conditions.thickness_scale).reshape(mesh.shape)
    at_faces = flow(replace(fluid, flow=law), oil, thickness, mesh)
    r = residual(at_faces, wedge_stencil(mesh.shape, mesh.dx, order=order), thickness, mesh)
    full = oil - fluid.ambient_pressure > _ROUNDING
    # Nodes on whose line oil fills the gap of a node further downstream, or their own.
    refilled = np.logical_or.accumulate((full & zone)[::-1], axis=0)[::-1]
    made = refilled & (zone | contact) & (r > 0.0)
    if film.heated is not None:
        # The viscosity of a hot or sheared film differs from the viscosity of the oil at rest; a cavity has
        # no such flow.
        made &= ~full
    lost = contact & (r < 0.0)
    carried = float(np.mean((film.density.reshape(mesh.shape) * thickness)[zone])) * width
    parts = [abs(float(np.vdot(mesh.weights, np.where(part, r, 0.0)))) / carried for part in (lost, made)]
    return OilBalance(mass_error=sum(parts), oil_lost=parts[0], oil_made=parts[1])


def makes_oil(case: Case | Setup, conditions: Conditions | PointConditions, film: Film | PointFilm) -> bool:
    """Whether a converged rough film makes or loses so much oil that it counts as not converged."""
    if not (film.converged and case.roughness):
        return False
    balance = oil_balance(case, conditions, film)
    return balance is not None and balance.mass_error > _MOST_MASS_ERROR


# Answer of a contact in one word.
Behaviour: TypeAlias = Literal["resistive", "intermittent", "capacitive"]

# Frequency at which spots and film are compared [Hz]: the switching frequency of a usual inverter.
PWM_FREQUENCY = 1e4

# Ratio of the impedances of film and spots above which the spots short the film, and the reciprocal of that
# below which they do not matter: one carries ten times the current of the other.
SHORTED = 10.0

# Share of the time with at least one spot from which a contact conducts always. Three small spots at one
# instant give it, by the Poisson law.
ALWAYS = 0.95

# Number of spots above which all have currents in proportion to their radii, an upper bound of the
# resistance.
_MOST_SOLVED = 2000


@dataclass(frozen=True)
class Electrical:
    """Resistance of the spots of a contact; capacitance and breakdown of the film around them, SI units."""

    behaviour: Behaviour  # "resistive", "intermittent" or "capacitive"; see ``behaviour_of``
    # Share of the time with at least one spot, if spots of moving surfaces come and go independently of each
    # other; see ``time_share``
    time_share: float
    # Resistance of all spots with their tribofilm [ohm]; of a line contact an upper bound for ridges along
    # the whole length. None without spots, or without the resistivity of the case or the length of a line
    # contact.
    resistance: float | None
    # constriction_resistance and tribofilm_resistance: its two parts, in series [ohm].
    constriction_resistance: float | None
    tribofilm_resistance: float | None
    # Capacitance of the film outside of the spots, over the whole domain, by a thin gap [F]; of a line
    # contact per length [F/m].
    capacitance_outside: float
    # Impedance of this capacitance at 10 kHz over ``resistance``; None if that is unknown.
    impedance_ratio: float | None
    corner_frequency: float | None  # frequency above which more current takes the film than the spots [Hz]
    # breakdown_1, breakdown_5 and breakdown_50: voltage at which 1, 5 and 50 % of the Hertz zone outside of
    # the spots reach the dielectric strength [V]; None if the case gives no strength.
    breakdown_1: float | None
    breakdown_5: float | None
    breakdown_50: float | None
    # Voltage at which a film without its spots breaks down with a probability of 63.2 % by the Weibull law of
    # the case [V]; None without this law.
    breakdown_voltage: float | None
    # Probability that the film outside of the spots breaks down at the voltage of the case.
    breakdown_probability: float | None


def time_share(spots: int, area_share: float) -> float:
    """Share of the time with at least one spot, if spots of moving surfaces come and go independently.

    The Hertz zone has N/f sites of the mean size of N spots that cover its part f. Each is touched with the
    probability f, so that the time share is 1 - (1 - f)^(N/f). For small spots it is Poisson's 1 - exp(-N).

    Examples
    --------
    >>> [round(time_share(spots, share), 2) for spots, share in ((0, 0.0), (1, 1e-6), (3, 0.01), (1, 0.99))]
    [0.0, 0.63, 0.95, 0.99]
    """
    if spots == 0 or area_share == 0.0:
        return 0.0
    if area_share >= 1.0:
        return 1.0
    return float(-np.expm1(spots / area_share * np.log1p(-area_share)))


def behaviour_of(
    spots: int, always: float, impedance_ratio: float | None, area_error: float | None = None
) -> Behaviour:
    """Electrical behaviour of a contact in one word.

    "capacitive": the contact has no spot, or the film takes ten times the current of its spots. "resistive":
    the spots take ten times the current of the film, and at least one is there for 95 % of the time.
    "intermittent": all between, as a contact that conducts and insulates in turn, and one whose spots a finer
    grid may not have.

    ``always`` is the share of the time with at least one spot. ``impedance_ratio`` is the impedance of the
    film divided by the impedance of the spots at 10 kHz. If it is None, the resistance of the spots is
    unknown, and they count as metal, which shorts any film at this frequency.

    Examples
    --------
    >>> spots = ((0, 0.0, None), (1, 0.63, None), (5, 0.99, 1e5), (5, 0.99, 0.01), (5, 0.99, 1e5, 1.2))
    >>> tuple(behaviour_of(*each) for each in spots)
    ('capacitive', 'intermittent', 'resistive', 'capacitive', 'intermittent')
    """
    ratio = np.inf if impedance_ratio is None else impedance_ratio
    if spots == 0 or ratio < 1.0 / SHORTED:
        return "capacitive"
    if ratio > SHORTED and always >= ALWAYS and (area_error or 0.0) < 1.0:
        return "resistive"
    return "intermittent"


def strip_resistance(
    *, width: float, length: float, resistivity: float, mean_free_path: float = 0.0
) -> float:
    """Constriction resistance of a strip between two half-spaces, as of an ellipse with its axes.

    R = gamma(l/b) rho K(1 - b^2/a^2)/(pi a) + 4 rho l/(3 pi a b) with the semi-axes a and b, the complete
    elliptic integral K of a parameter, and the mean free path l of the electrons. A circle gives the
    resistance of ``spot_resistance``, with its factor gamma.

    The axes ``width`` and ``length`` and the mean free path are in m, the resistivity rho of the bodies in
    ohm m, the result in ohm.

    R. Holm, Electric Contacts, 4th ed., Springer 1967; the first term is the capacitance of an elliptical
    disc. The second term is Sharvin's resistance of an area. For an ellipse, the argument of gamma is an
    assumption, which changes the conductance by at most 11 %.

    Examples
    --------
    >>> round(strip_resistance(width=2e-6, length=2e-6, resistivity=2.2e-7), 6)
    0.11
    """
    minor, major = sorted((0.5 * width, 0.5 * length))
    holm = resistivity * scipy.special.ellipk(1.0 - (minor / major) ** 2) / (np.pi * major)
    sharvin = sharvin_resistance(np.sqrt(minor * major), resistivity, mean_free_path)
    return float(sharvin + wexler_factor(mean_free_path / minor) * holm)


def constriction(spots: Spots, electric: Electric, length: float | None) -> float | None:
    """Constriction resistance of the spots [ohm]; None if there are none, or an input is missing.

    Spots of a point contact are circles of their areas, with their effect on each other. In a line contact
    only the widest strip counts, which is an upper bound of all of them.
    """
    rho, path = electric.resistivity, electric.mean_free_path or 0.0
    if rho is None or not spots.number:
        return None
    if spots.positions.shape[1] == 1:
        width = float(np.max(spots.areas))
        return (
            None
            if length is None
            else strip_resistance(width=width, length=length, resistivity=rho, mean_free_path=path)
        )
    if spots.number > _MOST_SOLVED:
        return greenwood_cluster(spots.positions, spots.radii, rho, path)
    return cluster_resistance(spots.positions, spots.radii, rho, path)


def electrical(
    film: Film | PointFilm,
    spots: Spots,
    oil: Oil,
    *,
    electric: Electric,
    discharge: Discharge | None,
    semi_axes: tuple[float, ...],
    area_error: float | None = None,
) -> Electrical:
    """Resistance, capacitance, breakdown voltages and behaviour of a contact whose surfaces touch in spots.

    ``semi_axes`` are the half-width of a line contact, or the semi-axes of a point contact [m].
    """
    length = 1.0 if len(semi_axes) == 2 else None if discharge is None else discharge.length
    metal = constriction(spots, electric, length)
    layer = None
    if metal is not None and length is not None:
        layer = float(film_resistance(spots.area * length, electric.tribofilm_resistance or 0.0))
    resistance = None if metal is None or layer is None else metal + layer
    permittivity = oil.permittivity(film.pressure, film.density)
    outside = np.where(film.contact, 0.0, areas(film.axes))
    capacitance = float(np.sum(outside * EPSILON_0 * permittivity / film.thickness))
    ratio = corner = None
    if resistance is not None and length is not None:
        corner = 1.0 / (2.0 * np.pi * resistance * capacitance * length)
        ratio = corner / PWM_FREQUENCY
    zone = hertz_weights(film, semi_axes)
    always = time_share(spots.number, touched_share(film, zone))
    # Voltages at which nodes of the Hertz zone outside of the spots reach the dielectric strength [V].
    around = ~film.contact & (zone > 0.0)
    voltages = np.zeros(0)
    if discharge is not None and discharge.has_strength:
        voltages = (film.thickness * dielectric_strength(discharge, film.pressure))[around]
    weakest = _weakest(film, outside, electric.voltage, discharge)
    return Electrical(
        behaviour=behaviour_of(spots.number, always, ratio, area_error),
        time_share=always,
        resistance=resistance,
        constriction_resistance=metal,
        tribofilm_resistance=layer,
        capacitance_outside=capacitance,
        impedance_ratio=ratio,
        corner_frequency=corner,
        **_percentiles("breakdown", voltages, zone[around]),
        breakdown_voltage=None if weakest is None else weakest.characteristic_voltage,
        breakdown_probability=None if weakest is None else weakest.probability(electric.voltage),
    )


def _weakest(
    film: Film | PointFilm, outside: Array, voltage: float, discharge: Discharge | None
) -> WeakestLink | None:
    """Weibull law of the film outside of the spots; None if the case gives none, or no length."""
    if discharge is None or discharge.weibull is None:
        return None
    law, inside = discharge.weibull, outside > 0.0
    length = 1.0 if film.thickness.ndim == 2 else discharge.length
    assert length is not None
    return WeakestLink.of(
        voltage,
        voltage / film.thickness[inside],
        length * outside[inside],
        law.scale,
        law.shape,
        law.reference_area,
    )


# Change of the load share from a grid with half the nodes, of the share itself or of the whole load, above
# which the share is not resolved.
_UNRESOLVED_SHARE, _UNRESOLVED_LOAD = 0.1, 0.005


# Load share of asperities above which spots remain on finer grids, however much their area changes.
_NEARLY_ALL = 0.9


@dataclass(frozen=True)
class Asperities:
    """Asperities of a solved contact."""

    spots: Spots
    touching: Touching  # what they carry, and the film around them
    electrical: Electrical  # what they conduct, and the capacitance and breakdown around them
    balance: OilBalance | None  # oil that the film loses and makes; None where it is not known
    coarser: Coarser | None  # load share and area on a grid with half the nodes; None if it was not solved

    @property
    def share_change(self) -> float | None:
        """Change of the load share from the coarser grid; None without it."""
        return None if self.coarser is None else self.touching.load_share - self.coarser.load_share

    def summary(self) -> dict[str, Any]:
        """Values of all parts, as in ``asperities`` of summary.json."""
        coarser, electrical = _values(self.coarser, Coarser), asdict(self.electrical)
        if self.electrical.behaviour == "intermittent":
            electrical["behaviour"] = "mixed"  # the word of the former key
        return {
            **asdict(self.touching),
            **{f"{name}_coarser": value for name, value in coarser.items()},
            **_values(self.balance, OilBalance),
            "electrical_behaviour": self.electrical.behaviour,
            **electrical,
        }


def _values(part: Coarser | OilBalance | None, kind: type[Coarser | OilBalance]) -> dict[str, Any]:
    """Values of a part by name; None without the part."""
    return dict.fromkeys(each.name for each in fields(kind)) if part is None else asdict(part)


def asperities(
    case: Case | Setup,
    conditions: Conditions | PointConditions,
    film: Film | PointFilm,
    *,
    rq: float,
    smooth: Array | None,
    coarser: Coarser | None,
) -> Asperities:
    """Asperities of a converged film.

    ``rq`` is the combined Rq of the undeformed surfaces over the Hertz zone [m], and ``smooth`` the film
    thickness with smooth surfaces at the nodes of the film [m], or None if it was not solved.

    Examples
    --------
    >>> from ehlectric import solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "entrainment_speed": 1e-4}
    >>> wave = {"surface": 1, "generator": "sinusoid", "amplitude": "0.5 um", "wavelength": "60 um"}
    >>> table = {"contact": contact | {"max_hertz_pressure": "0.5 GPa"}, "lubricant": {"base": "paper"}}
    >>> result = solve(Case.from_dict(table | {"grid": {"nodes": 129}, "roughness": [wave]}))
    >>> result.asperities.touching.spots > 0, result.asperities.electrical.behaviour
    (True, 'resistive')
    """
    spots = spots_of(film)
    friction = case.contact.boundary_friction if isinstance(case, Case) else None
    carried = touching(conditions, film, spots, rq=rq, smooth=smooth, friction=friction, coarser=coarser)
    return Asperities(
        spots=spots,
        touching=carried,
        electrical=electrical(
            film,
            spots,
            case.oil,
            electric=case.electric,
            discharge=case.discharge,
            semi_axes=conditions.semi_axes,
            area_error=None if carried.load_share > _NEARLY_ALL else carried.contact_area_error,
        ),
        balance=oil_balance(case, conditions, film),
        coarser=coarser,
    )


# Codes of the statement and of the verdict on a contact that touches, by its electrical behaviour.
_STATEMENTS = {
    "resistive": "spots-resistive",
    "intermittent": "spots-mixed",
    "capacitive": "spots-capacitive",
}
_CODES = {"resistive": "spots-conduct", "intermittent": TOUCHING_EXPECTED, "capacitive": POSSIBLE}


def spots_verdict(asperities: Asperities, voltage: float, warnings: Iterable[ResultWarning]) -> Verdict:
    """Verdict on a contact that touches in at least one spot under a voltage [V].

    It is red, yellow where a tribofilm insulates the spots, or grey where the film must not be used.
    """
    refused = unusable(warnings)
    if refused is not None:
        return refused
    behaviour, around = asperities.electrical.behaviour, []
    if asperities.electrical.breakdown_5 is not None:
        around.append(Statement.of("around-spots", breakdown=asperities.electrical.breakdown_5))
    if asperities.electrical.breakdown_probability is not None:
        probability = asperities.electrical.breakdown_probability
        around.append(Statement.of("chance-around-spots", probability=probability))
    return Verdict(
        "yellow" if behaviour == "capacitive" else "red",
        _CODES[behaviour],
        Statement.of(_STATEMENTS[behaviour], spots=asperities.spots.number, voltage=voltage),
        reasons=tuple(around),
    )


# Oil that a film may make or lose without a warning, divided by the mean flow through its contact.
MASS_ERROR = 1e-3

# Oil above which a film counts as not converged, as a hot film does above the same part of its heat.
_MOST_MASS_ERROR = 0.1

# Residual up to which the balance of the oil is a property of the film and not of its iteration.
_SETTLED = 1e-6


# Smallest load share, and smallest part of the mean flow of the oil, that a text states as a number.
_LEAST_SHARE = 1e-4


# Part of a share by which it falls from a coarser grid, above which it is a bound.
_FALLING = 1.0 / 3.0


def rounded_up(value: float) -> float:
    """Value > 0, rounded up to two digits.

    Examples
    --------
    >>> rounded_up(5.11), rounded_up(65.6), rounded_up(20.0)
    (5.2, 66.0, 20.0)
    """
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.ceil(value / step - 1e-9) * step:.2g}")


def share_text(share: float, coarser: float | None) -> str:
    """Share in per cent, with no more digits than its change from a coarser grid leaves.

    A share that falls from the coarser grid by more than a third of itself is a bound, because it falls
    further on finer grids.

    Examples
    --------
    >>> share_text(0.2369, 0.2371), share_text(0.2369, 0.21), share_text(0.0511, 0.12), share_text(4e-7, 0.0)
    ('23.7', '24', '< 5.2', '< 0.01')
    """
    if 0.0 < share < _LEAST_SHARE:
        return f"< {100.0 * _LEAST_SHARE:g}"
    error = share if coarser is None else abs(share - coarser)
    relative = error / share if share > 0.0 else 0.0
    if coarser is not None and coarser > share and relative > _FALLING:
        return f"< {rounded_up(100.0 * share):g}"
    return f"{float(f'{100.0 * share:.{digits_within(relative)}g}'):g}"


def digits_within(change: float) -> int:
    """Digits of a number of touching surfaces that its relative change from a coarser grid leaves.

    Solutions with other asperities in contact may also differ by less than this change.

    Examples
    --------
    >>> [digits_within(change) for change in (0.005, 0.1, 0.5)]
    [3, 2, 1]
    """
    return 3 if change < 0.01 else 2 if change < 0.2 else 1


def about_share(share: float, coarser: float | None) -> str:
    """Share in per cent within a sentence, with the digits of ``share_text``.

    Examples
    --------
    >>> about_share(0.2369, 0.2371), about_share(4e-7, 0.03)
    ('about 23.7 %', 'less than 0.01 %')
    """
    text = share_text(share, coarser)
    return f"less than {text.removeprefix('< ')} %" if text.startswith("<") else f"about {text} %"


def spot_warnings(
    case: Case | Setup,
    conditions: Conditions | PointConditions,
    film: Film | PointFilm,
    coarser: Coarser | None,
) -> Iterator[ResultWarning]:
    """Warnings about a film that is rough or touches, and whose residual is small.

    They report that the surfaces touch, in the domain or at its edge, that oil appears or is lost, and that
    the load share depends on the grid. ``coarser`` has the asperities on a grid with half the nodes, or is
    None if it was not solved.
    """
    settled = film.residual is not None and film.residual <= _SETTLED
    if settled and (case.roughness or np.any(film.contact)):
        balance = oil_balance(case, conditions, film)
        if balance is not None and balance.mass_error > MASS_ERROR:
            yield _not_conserved(balance)
    if not film.converged:
        return
    if conditions.boundary_film > 0.0 and _edge_gap(film) <= (1.0 + _ROUNDING) * conditions.boundary_film:
        sides = " or grid.side" if film.thickness.ndim == 2 else ""
        yield ResultWarning.of("domain-too-small", "touching", sides=sides)
    if not np.any(film.contact):
        return
    spots = spots_of(film)
    share = load_share_of(conditions, spots)
    before = None if coarser is None else coarser.load_share
    carried = "spot, which carries" if spots.number == 1 else "spots, which carry"
    yield ResultWarning.of(
        "asperities-touch",
        "stationary",
        spots=spots.number,
        carried=carried,
        share=about_share(share, before),
    )
    changed = [unknown_share("the load share", "a coarser grid")]
    if before is not None:
        changed = list(changed_share("the load share", share, before, "a grid with half the nodes"))
    yield from changed
    if not case.roughness:
        yield from _smooth_spots(case, conditions, film, spots.number, known=not changed)


# Error of the mean gap of smooth surfaces that touch, above which the grid does not resolve them.
_SMOOTH_ERROR = 0.01

# Formula of the central film by the geometry of a contact, and the least film over it. At the side lobes of a
# heavily loaded point contact the film is about a quarter of the central one.
_FORMULAS: Mapping[str, tuple[Callable[[Any], CentralThickness], float]] = {
    "line": (moes, 0.7),
    "point": (nijenbanning_venner_moes, 0.25),
}


def _smooth_spots(
    case: Case | Setup,
    conditions: Conditions | PointConditions,
    film: Film | PointFilm,
    number: int,
    *,
    known: bool,
) -> Iterator[ResultWarning]:
    """Warning about smooth surfaces that touch on a grid which does not resolve their film.

    On coarse grids the gap of a thin film closes, and not on a finer one. Two coarse grids may agree that it
    does, where a formula expects a film thicker than the boundary film. ``known``, whether the spots carry as
    much as on the coarser grid.
    """
    error, (formula, least) = film.discretisation_error, _FORMULAS[conditions.geometry]
    expected = least * formula(conditions.contact).central_thickness * conditions.film_factor
    flooded = case.inlet is None
    small = error is not None and error <= max(_SMOOTH_ERROR, case.grid.target or 0.0)
    if known and small and not (flooded and expected > conditions.boundary_film):
        return
    stated = "unknown" if small or error is None else f"about {readable(100 * error, 2)} %"
    yield ResultWarning.of(
        "smooth-surfaces-touch",
        spots="1 spot" if number == 1 else f"{number} spots",
        grid=" x ".join(str(axis.size) for axis in film.axes),
        error=stated,
        expected=f"{readable(float(1e9 * expected), 2)} nm",
    )


def unknown_share(what: str, grid: str) -> ResultWarning:
    """Warning that a load share is not known on a coarser grid."""
    return ResultWarning.of("load-share-unresolved", "unknown", what=what, before=f"is not known on {grid}")


def changed_share(
    what: str, share: float, coarser: float, grid: str, *, change: float | None = None
) -> Iterator[ResultWarning]:
    """Warning that a load share differs from the load share on a coarser grid, by ``change`` if that is
    given.
    """
    change = share - coarser if change is None else change
    if abs(change) > max(_UNRESOLVED_SHARE * share, _UNRESOLVED_LOAD):
        before = f"was {about_share(coarser, share)} on {grid}"
        turn = "falls" if change < 0.0 else "rises"
        yield ResultWarning.of("load-share-unresolved", turn, what=what, before=before)


def _edge_gap(film: Film | PointFilm) -> float:
    """Least gap on the edges of the domain [m]."""
    edges = (film.thickness[[0, -1]], film.thickness[..., [0, -1]])
    return min(float(np.min(edge)) for edge in edges)


def _not_conserved(balance: OilBalance) -> ResultWarning:
    made, lost = (
        f"{formatted(100.0 * each, '.2g')} %" if each >= _LEAST_SHARE else "none"
        for each in (balance.oil_made, balance.oil_lost)
    )
    return ResultWarning.of("oil-not-conserved", made=made, lost=lost)
