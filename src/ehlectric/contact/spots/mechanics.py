"""Load and area of the spots in which surfaces touch, and the film around the spots, of a solved contact."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ehlectric.arrays import Array
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.spots.patches import Spots, weighted_percentiles
from ehlectric.field.zones import line_zone_areas, point_zone_areas
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.runtime.stored import number
from ehlectric.surfaces.profiles import FLAT

# Shares of the area around the spots up to which the film is as thin as its percentiles.
THIN_SHARES = (0.01, 0.05, 0.5)


@dataclass(frozen=True)
class Coarser:
    """Asperities of the same contact on a grid with half the nodes along each axis.

    Attributes
    ----------
    load_share : float
        Part of the load that asperities carry.
    contact_area_share : float
        Part of the area of the dry smooth contact in which the surfaces touch.
    """

    load_share: float = field(metadata=number("not negative"))
    contact_area_share: float = field(metadata=number("not negative"))


@dataclass(frozen=True)
class Touching:
    """Load and area of the spots of a solved contact, and the film around them, SI units.

    Areas of a point contact [m^2] are widths of a line contact [m].

    Attributes
    ----------
    boundary_film : float
        Gap at which the surfaces touch [m].
    load_share : float
        Part of the load that the contact pressure of the asperities carries, from 0 to 1.
    contact_area : float
        Real area of contact: that of the nodes that touch.
    contact_area_share : float
        Part of the area of the dry smooth contact in which the surfaces touch, from 0 to 1.
    contact_area_error : float or None
        Relative error of ``contact_area``, the larger of two: the edges of spots lie between nodes, and the
        area of the Hertz zone in contact changed from a grid with half the nodes. From 1 on, a fine grid may
        have no spots at all. None without spots.
    spots, spots_of_one_node : int
        Number of spots, and of those that are a single node and so are not resolved.
    mean_spot, largest_spot : float or None
        Mean and largest area of a spot; None without spots.
    mean_film, least_film : float or None
        Mean and least film thickness in the Hertz zone outside of the spots [m]; None if they cover it.
    film_1, film_5, film_50 : float or None
        Film thickness below which 1, 5 and 50 % of the area of the Hertz zone outside of the spots lie [m].
    rq_deformed : float or None
        Root mean square of the film thickness less that of smooth surfaces, about its mean over the Hertz
        zone [m]; None if the contact was not solved with smooth surfaces.
    lambda_undeformed, lambda_deformed : float or None
        Mean film thickness in the Hertz zone, spots included, over the combined Rq of the surfaces as they
        are, and over ``rq_deformed``; None without such an Rq.
    boundary_friction : float or None
        Share of asperities in the friction coefficient of sliding, ``load_share`` times the coefficient of
        the case; None if the case gives none.
    """

    boundary_film: float
    load_share: float
    contact_area: float
    contact_area_share: float
    contact_area_error: float | None
    spots: int
    spots_of_one_node: int
    mean_spot: float | None
    largest_spot: float | None
    mean_film: float | None
    least_film: float | None
    film_1: float | None
    film_5: float | None
    film_50: float | None
    rq_deformed: float | None
    lambda_undeformed: float | None
    lambda_deformed: float | None
    boundary_friction: float | None


def spots_of(film: Film | PointFilm) -> Spots:
    """Spots of a film, none where its surfaces do not touch."""
    pressure = np.zeros_like(film.thickness) if film.contact_pressure is None else film.contact_pressure
    return Spots.of(film.axes, film.contact, pressure)


def hertz_weights(film: Film | PointFilm, semi_axes: tuple[float, ...]) -> Array:
    """Area [m^2] of each node's part of the Hertz ellipse, or width [m] of its part of the Hertz zone."""
    zones = line_zone_areas if len(semi_axes) == 1 else point_zone_areas
    return zones(film.axes, *semi_axes)["hertz"]


def load_of(conditions: Conditions | PointConditions) -> float:
    """Load of a point contact [N], or load per length of a line contact [N/m]."""
    if isinstance(conditions, PointConditions):
        return conditions.load
    return conditions.load_per_length


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

    Parameters
    ----------
    conditions : Conditions or PointConditions
        Operating conditions.
    film : Film or PointFilm
        Solved film.
    spots : Spots
        Spots of the film.
    rq : float
        Combined Rq of the surfaces over the Hertz zone before they are deformed [m].
    smooth : ndarray or None
        Film thickness with smooth surfaces at the nodes of the film [m]; None if it was not solved.
    friction : float or None
        Friction coefficient of sliding boundary films.
    coarser : Coarser, optional
        Asperities on a grid with half the nodes.

    Returns
    -------
    Touching
        Load share, areas, film around the spots, roughness and friction.
    """
    zone = hertz_weights(film, conditions.semi_axes)
    touched = film.contact
    around = ~touched & (zone > 0.0)
    thickness, weights = film.thickness[around], zone[around]
    thin = weighted_percentiles(thickness, weights, THIN_SHARES) if thickness.size else None
    deformed = None if smooth is None else weighted_rms(film.thickness - smooth, zone)
    mean = float(np.vdot(zone, film.thickness) / np.sum(zone))
    share = float(np.sum(zone[touched]) / np.sum(zone))
    load_share = float(np.sum(spots.loads)) / load_of(conditions)
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
        mean_film=float(np.average(thickness, weights=weights)) if thickness.size else None,
        least_film=float(np.min(thickness)) if thickness.size else None,
        film_1=None if thin is None else float(thin[0]),
        film_5=None if thin is None else float(thin[1]),
        film_50=None if thin is None else float(thin[2]),
        rq_deformed=deformed,
        lambda_undeformed=mean / rq if rq >= FLAT else None,
        lambda_deformed=mean / deformed if deformed is not None and deformed >= FLAT else None,
        boundary_friction=None if friction is None else friction * load_share,
    )


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
