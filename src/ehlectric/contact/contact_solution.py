"""Solution of a contact: film and field, how they were computed, and the statistics of its roughness."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.capacitance_meter import Metered, MeterReading, meter_reading
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.setup import Setup
from ehlectric.contact.touching import (
    Asperities,
    Coarser,
    asperities,
    hertz_weights,
    spots_verdict,
    weighted_rms,
)
from ehlectric.discharge.assessment import Assessment, assess
from ehlectric.discharge.film_verdict import contact_verdict
from ehlectric.field import Field, PointField, contact_zones
from ehlectric.film import Film, PointFilm
from ehlectric.quantities.field_metadata import stored
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.verdict import Verdict
from ehlectric.runtime.display import ResultKind, Shown, Values, read_only_property
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.maps import statistics as of_map
from ehlectric.surfaces.profiles import FLAT, Profile
from ehlectric.surfaces.profiles import statistics as of_profile

ConditionsT = TypeVar("ConditionsT", bound=Conditions | PointConditions)
FilmT = TypeVar("FilmT", bound=Film | PointFilm)
FieldT = TypeVar("FieldT", bound=Field | PointField)


@dataclass(frozen=True, eq=False, repr=False)
class Smooth(Values):
    """Film and field of a rough contact that is solved with smooth surfaces, for comparison."""

    # pressure and thickness: pressure [Pa] and film thickness [m] at the film's nodes, shape (nx,) or
    # (nx, ny).
    pressure: Array = dataclasses.field(
        metadata=stored("nodes", "Pa", "not negative", "pressure of smooth surfaces")
    )
    thickness: Array = dataclasses.field(
        metadata=stored("nodes", "m", "positive", "film thickness of smooth surfaces")
    )
    middle_strength: Array = dataclasses.field(
        metadata=stored(
            "columns", "V/m", "not negative", "electric field strength at mid-film of smooth surfaces"
        )
    )  # field strength at mid-film, at the columns of the field [V/m], shape (mx,) or (mx, my)

    @property
    def minimum_thickness(self) -> float:
        """Minimum film thickness at the nodes [m]."""
        return float(np.min(self.thickness))


@dataclass(frozen=True, eq=False, repr=False)
class Solution(Shown, Generic[ConditionsT, FilmT, FieldT]):
    """Film and field of one contact."""

    result_kind: ClassVar[ResultKind] = "contact"

    case: Case | Setup  # case that was solved, or setup if the contact was solved without a case
    conditions: ConditionsT  # operating conditions, SI units
    # film and field: film and electric field, SI units.
    film: FilmT
    # Roughness heights of both surfaces at the film's nodes, positive out of the body [m], shape (2, nx) or
    # (2, nx, ny).
    roughness: Array
    # Source of each rough surface, and its statistics after each processing step, SI units.
    rough: tuple[dict[str, Any], ...]
    # Same contact with smooth surfaces; None if the surfaces are smooth, or if it was not solved.
    smooth: Smooth | None
    # Asperities of the same contact on a grid with half the nodes; None if its surfaces do not touch, or if
    # it was not solved.
    coarser: Coarser | None
    field: FieldT
    warnings: tuple[ResultWarning, ...]  # warnings about unreliable results, each with a code and a severity
    # film_solver and field_solver: solver of the film and of the field: "ehlectric", or "paper" for the
    # methods of the paper.
    film_solver: str
    field_solver: str
    # film_seconds and field_seconds: time taken by the solvers of the film and of the field [s].
    film_seconds: float = dataclasses.field(compare=False)
    field_seconds: float = dataclasses.field(compare=False)
    version: str
    date: str = dataclasses.field(compare=False)

    @property
    def converged(self) -> bool:
        """Whether the film converged; if it did not, no number of this result may be used."""
        return self.film.converged

    @property
    def film_error(self) -> float | None:
        """Estimated relative error of minimum and central film thickness.

        None if there is no estimate, and where the surfaces touch: the minimum is then the boundary film.
        """
        return self.film.discretisation_error if self.film.contact_pressure is None else None

    @property
    def strength_scale(self) -> float:
        """Factor h_min/voltage that makes a field strength dimensionless, eq. (18) of the paper [m/V]."""
        return self.film.minimum_thickness / self.field.voltage

    @property
    def max_dimensionless(self) -> float:
        """Largest field strength times h_min/voltage, dimensionless."""
        return self.field.max_strength * self.strength_scale

    @property
    def thin_gap_error(self) -> float | None:
        """Relative error of the thin-gap field strength: (max_strength - voltage/h_min)/max_strength.

        None if the minimum film thickness is outside the field range.
        """
        if not self.in_field_range(self.film.minimum_position):
            return None
        return 1.0 - self.field.voltage / self.film.minimum_thickness / self.field.max_strength

    def in_field_range(self, position: float | tuple[float, ...]) -> bool:
        """Whether a position x or (x, y) [m] is inside the field range."""
        places = np.atleast_1d(position)
        return all(bool(axis[0] <= at <= axis[-1]) for at, axis in zip(places, self.field.axes, strict=True))

    @read_only_property
    def asperities(self) -> Asperities | None:
        """Asperities of a converged contact that is rough or whose surfaces touch; None of any other."""
        if not self.film.converged or not (self.rough or np.any(self.film.contact)):
            return None
        weights = hertz_weights(self.film, self.conditions.semi_axes)
        return asperities(
            self.case,
            self.conditions,
            self.film,
            rq=weighted_rms(self.roughness.sum(axis=0), weights),
            smooth=None if self.smooth is None else self.smooth.thickness,
            coarser=self.coarser,
        )

    @property
    def spots(self) -> Asperities | None:
        """Asperities of a converged contact whose surfaces touch; None where they do not."""
        asperities = self.asperities
        return asperities if asperities is not None and asperities.spots.number else None

    @read_only_property
    def discharge(self) -> Assessment | None:
        """Assessment of the discharge; None if the case has no table ``discharge``."""
        if self.case.discharge is None:
            return None
        return assess(self.case.discharge, self.case.oil, self.conditions.semi_axes, self.film, self.field)

    @read_only_property
    def meter(self) -> MeterReading | None:
        """Capacitance that a meter at the two bodies reads; None if the case has no table ``meter``."""
        if not isinstance(self.case, Case) or self.case.meter is None:
            return None
        alone = None if self.discharge is None else self.discharge.breakdown.breakdown_voltage
        return meter_reading(Metered(self.case, self.conditions, self.film, self.field), alone)

    @property
    def verdict(self) -> Verdict | None:
        """Verdict: whether breakdown is expected; None if the case has no table ``discharge``."""
        inputs, discharge = self.case.discharge, self.discharge
        if inputs is None or discharge is None:
            return None
        if self.spots is not None:
            return spots_verdict(self.spots, self.field.voltage, self.warnings)
        return contact_verdict(
            inputs,
            discharge.breakdown,
            self.field.voltage,
            warnings=self.warnings,
            error=self.film_error,
            field_error=self.field.strength_error,
            flooded=self.conditions.film_factor == 1.0 and self.film.starvation is None,
            isothermal=self.film.temperature is None,
            default_voltage=self.case.electric.default,
        )

    @read_only_property
    def capacitance_by_zone(self) -> dict[str, float]:
        """Capacitance of each zone of the field range [F]; for a line contact per length [F/m]."""
        return self.field.capacitance_by_zone(*self.conditions.semi_axes)


LineSolution = Solution[Conditions, Film, Field]
PointSolution = Solution[PointConditions, PointFilm, PointField]


@dataclass(frozen=True)
class RoughnessStatistics:
    """Statistics of the roughness over the Hertz zone, and ratios of film thickness to roughness."""

    # rq_1, rq_2 and rq_combined: root-mean-square heights of surface 1, of surface 2, and of the sum of both
    # surfaces [m].
    rq_1: float
    rq_2: float
    rq_combined: float
    combined: Mapping[str, float]  # all statistics of the sum of both surfaces, SI units
    # Minimum film thickness divided by ``rq_combined``, dimensionless; None if the Hertz zone is smooth.
    lambda_ratio: float | None
    # ``smooth_minimum_thickness`` divided by ``rq_combined``, dimensionless; None if the Hertz zone is smooth
    # or the smooth contact was not solved.
    lambda_ratio_smooth: float | None
    # Minimum film thickness of the same contact with smooth surfaces [m]; None if it was not solved.
    smooth_minimum_thickness: float | None


def line_roughness(solution: LineSolution) -> RoughnessStatistics:
    """Statistics of the roughness of a line contact within its half-width."""
    x = solution.film.x
    heights = solution.roughness[:, np.abs(x) <= solution.conditions.half_width]
    rq_1, rq_2 = (float(rq) for rq in np.std(heights, axis=1))
    # The film depends on the sum of the heights. The surfaces may be correlated, so rq_combined does not
    # follow from rq_1 and rq_2.
    combined = of_profile(Profile(float(x[1] - x[0]), heights.sum(axis=0)))
    return _statistics(solution, (rq_1, rq_2, combined.rq), vars(combined))


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
    return _statistics(solution, (rq_1, rq_2, rq), vars(combined))


def _statistics(
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
