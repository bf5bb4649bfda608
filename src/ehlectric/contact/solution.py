"""Solution of a contact: film and field, how they were obtained, and numbers that follow from both."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Generic, TypeVar

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.setup import Setup
from ehlectric.discharge.assessment import Assessment, assess
from ehlectric.errors import ResultWarning
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm

ConditionsT = TypeVar("ConditionsT", bound=Conditions | PointConditions)
FilmT = TypeVar("FilmT", bound=Film | PointFilm)
FieldT = TypeVar("FieldT", bound=Field | PointField)


@dataclass(frozen=True)
class Smooth:
    """The same contact with smooth surfaces, to set a rough one beside.

    ``pressure`` [Pa] and ``thickness`` [m] at the film's nodes, ``middle_strength`` [V/m] at the columns of
    the field.
    """

    pressure: Array
    thickness: Array
    middle_strength: Array

    @property
    def minimum_thickness(self) -> float:
        """Film thickness of the lowest node [m]."""
        return float(np.min(self.thickness))


@dataclass(frozen=True)
class Solution(Generic[ConditionsT, FilmT, FieldT]):
    """Film and field of one contact.

    Attributes
    ----------
    case : Case or Setup
        The case that was solved; the setup where a contact was solved without a case.
    conditions : Conditions or PointConditions
        Operating conditions, SI units.
    film, field : Film and Field, or PointFilm and PointField
        The solution, SI units.
    roughness : ndarray, shape (2, nx) or (2, nx, ny)
        Heights of both surfaces' roughness at the film's nodes, positive out of the body [m].
    rough : tuple of dict
        Where each rough surface came from and its statistics after every step, SI units.
    smooth : Smooth or None
        The contact without its roughness; None where it has none, or was not solved without.
    warnings : tuple of ResultWarning
        What is unreliable about it, each with a code and a severity.
    film_solver, field_solver : str
        "ehlectric", or "paper" where the paper's own methods solved it.
    film_seconds, field_seconds : float
        Time it took [s].
    version, date : str
        Of the program that made it, and when (ISO 8601).
    """

    case: Case | Setup
    conditions: ConditionsT
    film: FilmT
    roughness: Array
    rough: tuple[dict[str, Any], ...]
    smooth: Smooth | None
    field: FieldT
    warnings: tuple[ResultWarning, ...]
    film_solver: str
    field_solver: str
    film_seconds: float
    field_seconds: float
    version: str
    date: str

    @property
    def converged(self) -> bool:
        """Whether the film is a solution; without it nothing here is one."""
        return self.film.converged

    @property
    def strength_scale(self) -> float:
        """h_min/voltage, which makes a field strength dimensionless, eq. (18) of the paper [m/V]."""
        return self.film.minimum_thickness / self.field.voltage

    @property
    def max_dimensionless(self) -> float:
        """Largest field strength times h_min over the voltage."""
        return self.field.max_strength * self.strength_scale

    @property
    def thin_gap_error(self) -> float | None:
        """(max_strength - voltage/h_min)/max_strength, None where the field range leaves h_min out."""
        if not self.in_field_range(self.film.minimum_position):
            return None
        return 1.0 - self.field.voltage / self.film.minimum_thickness / self.field.max_strength

    def in_field_range(self, position: float | tuple[float, ...]) -> bool:
        """Whether the field was solved at a position x or (x, y) [m]."""
        places = np.atleast_1d(position)
        return all(bool(axis[0] <= at <= axis[-1]) for at, axis in zip(places, self.field.axes, strict=True))

    @cached_property
    def discharge(self) -> Assessment | None:
        """Breakdown voltage, capacitance by zone, energy; None where the case has no ``[discharge]``."""
        if self.case.discharge is None:
            return None
        return assess(
            self.case.discharge, self.case.lubricant, self.conditions.semi_axes, self.film, self.field
        )

    @cached_property
    def capacitance_by_zone(self) -> dict[str, float]:
        """Capacitance of each zone of the field range [F]; of a line contact per length [F/m]."""
        return self.field.capacitance_by_zone(*self.conditions.semi_axes)
