"""Capacitance of a bearing over its film factor, at one speed and temperature, with quick contacts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ehlectric.bearing.accuracy import film_error
from ehlectric.bearing.meter.reading import meter_capacitance
from ehlectric.bearing.preparation import PreparedBearing, prepare_bearing, with_film_factor
from ehlectric.bearing.quick.ways import quick_case
from ehlectric.bearing.solution import BearingSolution, lambda_ratio
from ehlectric.bearing.solving.contacts_and_circuit import POSITIONS, solution_of_prepared
from ehlectric.cases import library
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.discharge.roughness_factor import LEAST_RATIO
from ehlectric.errors import InputError


@dataclass(frozen=True)
class FilmState:
    """Bearing at one film factor.

    Attributes
    ----------
    capacitance : float
        Capacitance that a meter reads, with rough films and a coating, but without what is in parallel [F].
    lambda_ratio : float
        Smallest film thickness over the composite roughness, dimensionless.
    """

    capacitance: float
    lambda_ratio: float

    @classmethod
    def of(cls, solution: BearingSolution) -> FilmState:
        """State of a solved bearing.

        Raises
        ------
        InputError
            Where its films are so thin that the roughness leaves their capacitance open.
        """
        capacitance, ratio = meter_capacitance(solution), lambda_ratio(solution)
        if capacitance is None:
            raise InputError.worded(
                "bearing.composite_rq",
                f"is more than 1/{LEAST_RATIO:g} of a central film (lambda ratio {ratio:.2g}), at which "
                "asperities touch",
            )
        return cls(capacitance, ratio)


@dataclass(frozen=True, eq=False)
class OperatingPoint:
    """Bearing at one speed and temperature, whose film factor is free.

    Loads and speeds of the elements do not depend on the film factor, so they are computed once.

    Attributes
    ----------
    case : BearingCase
        Case at this speed and temperature, with contacts from the atlas or by formula.
    prepared : PreparedBearing
        Equilibria and contacts, with the film factor of the case.
    """

    case: BearingCase
    prepared: PreparedBearing
    _known: dict[float, FilmState] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, case: BearingCase, changes: Mapping[str, Any]) -> OperatingPoint:
        """Operating point of a case with changed inputs, such as ``bearing.inner_speed`` [rad/s].

        Raises
        ------
        InputError
            Where the changed case is not valid, or its oil is neither in the atlas nor described by formulas.
        """
        # What is in parallel is taken off the measured values, and the measured factor contains the supply.
        alone: dict[str, Any] = {}
        if case.bearing.parallel_capacitance is not None:
            alone["bearing.parallel_capacitance"] = None
        if case.bearing.supply != "flooded":
            alone["bearing.supply"] = "flooded"
        changed, refused = quick_case(case.replace({**changes, **alone}), constant=True)
        if changed is None:
            assert refused is not None
            raise refused
        return cls(changed, prepare_bearing(changed, POSITIONS))

    def at(self, factor: float) -> FilmState:
        """Bearing at a film factor.

        Raises
        ------
        InputError
            Where the films are too thick for the bearing, or too thin to be computed.
        """
        if factor not in self._known:
            self._known[factor] = FilmState.of(self._solution(factor))
        return self._known[factor]

    def film_error(self, factor: float) -> float:
        """Relative error of the films at a film factor."""
        return film_error(self._solution(factor))

    def _solution(self, factor: float) -> BearingSolution:
        return solution_of_prepared(self.case, with_film_factor(self.prepared, factor))


def check_films_measured(case: BearingCase) -> None:
    """Refuse a bearing whose capacitance does not depend on its films.

    Raises
    ------
    InputError
        For ceramic elements: they have nearly all of the voltage.
    """
    material = case.bearing.element_material
    if not library.solid(material)["conducting"]:
        raise InputError(
            "bearing.element_material",
            got=f"{material!r}, whose capacitance hides that of the films;",
            takes="elements that conduct, for a film factor from a measured capacitance",
        )
