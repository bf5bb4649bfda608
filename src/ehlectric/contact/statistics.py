"""Statistics of the roughness of a solved contact over its Hertz zone, and the lambda ratio."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.solution import Solution
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.zones import contact_zones
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.maps import statistics as of_map
from ehlectric.surfaces.profiles import FLAT, Profile
from ehlectric.surfaces.profiles import statistics as of_profile

LineSolution = Solution[Conditions, Film, Field]
PointSolution = Solution[PointConditions, PointFilm, PointField]


@dataclass(frozen=True)
class RoughnessStatistics:
    """Statistics of the roughness over the Hertz zone, and ratios of film thickness to roughness.

    Attributes
    ----------
    rq_1, rq_2, rq_combined : float
        Root-mean-square heights of surface 1, of surface 2, and of the sum of both surfaces [m].
    combined : mapping
        All statistics of the sum of both surfaces, SI units.
    lambda_ratio : float or None
        Minimum film thickness divided by ``rq_combined``, dimensionless; None if the Hertz zone is smooth.
    lambda_ratio_smooth : float or None
        ``smooth_minimum_thickness`` divided by ``rq_combined``, dimensionless; None if the Hertz zone is
        smooth or the smooth contact was not solved.
    smooth_minimum_thickness : float or None
        Minimum film thickness of the same contact with smooth surfaces [m]; None if it was not solved.
    """

    rq_1: float
    rq_2: float
    rq_combined: float
    combined: Mapping[str, float]
    lambda_ratio: float | None
    lambda_ratio_smooth: float | None
    smooth_minimum_thickness: float | None


def line_roughness(solution: LineSolution) -> RoughnessStatistics:
    """Statistics of the roughness of a line contact within its half-width."""
    x = solution.film.x
    heights = solution.roughness[:, np.abs(x) <= solution.conditions.half_width]
    rq_1, rq_2 = (float(rq) for rq in np.std(heights, axis=1))
    # The film depends on the sum of the heights. The surfaces may be correlated, so rq_combined does not
    # follow from rq_1 and rq_2.
    combined = of_profile(Profile(float(x[1] - x[0]), heights.sum(axis=0)))
    return _beside_film(solution, (rq_1, rq_2, combined.rq), vars(combined))


def point_roughness(solution: PointSolution) -> RoughnessStatistics:
    """Statistics of the roughness of a point contact over its Hertz ellipse."""
    film, conditions = solution.film, solution.conditions
    inside = contact_zones(*conditions.semi_axes)["hertz"](film.x[:, np.newaxis], film.y)
    together = solution.roughness.sum(axis=0)
    rq_1, rq_2, rq = (float(np.std(heights[inside])) for heights in (*solution.roughness, together))
    along = np.abs(film.x) <= conditions.semi_axis_x
    across = np.abs(film.y) <= conditions.semi_axis_y
    spacing = float(film.x[1] - film.x[0]), float(film.y[1] - film.y[0])
    combined = of_map(Map(*spacing, together[along][:, across]))
    return _beside_film(solution, (rq_1, rq_2, rq), vars(combined))


def _beside_film(
    solution: LineSolution | PointSolution, rq: tuple[float, float, float], combined: Mapping[str, float]
) -> RoughnessStatistics:
    smooth = None if solution.smooth is None else solution.smooth.minimum_thickness
    rough = rq[2] >= FLAT
    return RoughnessStatistics(
        *rq,
        combined=combined,
        lambda_ratio=solution.film.minimum_thickness / rq[2] if rough else None,
        lambda_ratio_smooth=smooth / rq[2] if rough and smooth is not None else None,
        smooth_minimum_thickness=smooth,
    )
