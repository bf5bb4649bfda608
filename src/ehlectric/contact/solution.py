"""What the solutions of all contacts share: how they were obtained, their summary, their dataset."""

from __future__ import annotations

import json
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.dataset import Layout, attributes, variables
from ehlectric.discharge.assessment import Assessment, assess
from ehlectric.errors import ResultWarning
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.formulas.film_line import Thickness
from ehlectric.runtime.files import plain
from ehlectric.runtime.stored_warnings import as_attributes, texts_and_codes

if TYPE_CHECKING:
    import xarray as xr


SCHEMA = "ehlectric.summary/1"
_Conditions = TypeVar("_Conditions", Conditions, PointConditions)
_Film = TypeVar("_Film", Film, PointFilm)
_Field = TypeVar("_Field", Field, PointField)


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
class Solution(ABC, Generic[_Conditions, _Film, _Field]):
    """Film and field of one case.

    Attributes
    ----------
    case : Case
        What was solved.
    conditions : Conditions or PointConditions
        What it means.
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

    case: Case
    conditions: _Conditions
    film: _Film
    roughness: Array
    rough: tuple[dict[str, Any], ...]
    smooth: Smooth | None
    field: _Field
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
        if not self._holds(self.film.minimum_position):
            return None
        return 1.0 - self.field.voltage / self.film.minimum_thickness / self.field.max_strength

    @cached_property
    def discharge(self) -> Assessment | None:
        """Breakdown voltage, capacitance by zone, energy; None where the case has no ``[discharge]``."""
        if self.case.discharge is None:
            return None
        return assess(
            self.case.discharge, self.case.lubricant, self.conditions.semi_axes, self.film, self.field
        )

    @abstractmethod
    def _holds(self, position: Any) -> bool:
        """Whether the field was solved at a position."""

    @abstractmethod
    def _inputs(self) -> dict[str, Any]:
        """The case as nested tables, its alternatives resolved."""

    @abstractmethod
    def _hertz(self) -> dict[str, float]:
        """The dry contact."""

    @abstractmethod
    def _own_film(self) -> dict[str, Any]:
        """Key figures of the film that this kind of contact alone has."""

    @abstractmethod
    def _own_field(self) -> dict[str, Any]:
        """Those of its field."""

    @abstractmethod
    def formulas(self) -> Mapping[str, Thickness]:
        """Films of the published formulas."""

    @abstractmethod
    def _own_roughness(self) -> dict[str, Any]:
        """Statistics of the roughness over the Hertz zone."""

    def summary(self) -> dict[str, Any]:
        """Key figures in SI units, nested as summary.json.

        Returns
        -------
        dict
            Values are numbers, texts, lists, or None where a value has no meaning; never NaN.
        """
        film, field, formulas = self.film, self.field, self.conditions.formulas
        summary: dict[str, Any] = {
            "schema": SCHEMA,
            "version": self.version,
            "title": self.case.title,
            "converged": self.converged,
            "status": film.status,
            **texts_and_codes(self.warnings),
            "inputs": self._inputs(),
            "groups": {"moes_m": formulas.moes_m, "moes_l": formulas.moes_l},
            "hertz": self._hertz(),
            "film": {
                "minimum_thickness": film.minimum_thickness,
                "minimum_position": film.minimum_position,
                "central_thickness": film.central_thickness,
                "mean_thickness": film.mean_thickness,
                "max_pressure": film.max_pressure,
                "load_residual": film.load_residual,
                "residual": film.residual,
                "newton_iterations": film.newton_iterations,
                "discretisation_error": film.discretisation_error,
                "solver": self.film_solver,
            }
            | self._own_film(),
            "field": {
                "voltage": field.voltage,
                "max_strength": field.max_strength,
                "max_strength_position": field.max_strength_position,
                "max_dimensionless": self.max_dimensionless,
            }
            | self._own_field()
            | {
                "thin_gap_error": self.thin_gap_error,
                "max_strength_wall": field.max_strength_wall,
                "solver": self.field_solver,
            },
            "film_formulas": {name: vars(thickness) for name, thickness in self.formulas().items()},
            "seconds": {"film": self.film_seconds, "field": self.field_seconds},
        }
        if self.discharge is not None:
            summary["discharge"] = self.discharge.summary()
        if self.rough:
            summary["roughness"] = {"surfaces": list(self.rough)} | self._own_roughness()
        return {key: plain(value) for key, value in summary.items()}

    @property
    @abstractmethod
    def layout(self) -> Layout:
        """How its arrays lie in a file."""

    def to_xarray(self) -> xr.Dataset:
        """All arrays with their units, and the case, summary and solver history as attributes."""
        import xarray as xr

        smooth = None if self.smooth is None else vars(self.smooth)
        return (
            xr.Dataset(
                variables(self.layout, self.film, self.field, self.roughness, smooth),
                attrs={
                    "Conventions": "CF-1.11",
                    "title": self.case.title or self.layout.title,
                    "source": f"ehlectric {self.version}",
                    "history": f"{self.date} solved by ehlectric {self.version}",
                    "version": self.version,
                    "date": self.date,
                    "converged": int(self.converged),
                    "case": self.case.to_toml(),
                    "summary": json.dumps(self.summary()),
                    **as_attributes(self.warnings),
                    "rough": json.dumps(plain(self.rough)),
                    "film_solver": self.film_solver,
                    "field_solver": self.field_solver,
                    "seconds": json.dumps([self.film_seconds, self.field_seconds]),
                    **attributes(self.layout, self.film, self.field),
                },
            )
            .set_coords(self.layout.coordinates)
            .copy(deep=True)
        )
