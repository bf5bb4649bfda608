"""The solution of one case: film, field, how they were obtained, and their summary."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.case import Case
from ehlectric.conditions import Conditions
from ehlectric.dataset import COORDINATES, attributes, roughness_variables, smooth_variables, variables
from ehlectric.field import Field
from ehlectric.film import Film
from ehlectric.film_formulas import FORMULAS
from ehlectric.nested import Scales
from ehlectric.roughness import FLAT, Profile, statistics
from ehlectric.typing import Array

if TYPE_CHECKING:
    import xarray as xr

SCHEMA = "ehlectric.summary/1"


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
class Result:
    """Film and field of one case.

    Attributes
    ----------
    case, conditions : Case, Conditions
        What was solved, and what it means.
    film, field : Film, Field
        The solution, SI units.
    roughness : ndarray, shape (2, nx)
        Heights of both surfaces' roughness at the film's nodes, positive out of the body [m].
    rough : tuple of dict
        Where each rough surface came from and its statistics after every step, SI units.
    smooth : Smooth or None
        The contact without its roughness; None where it has none, or was not solved without.
    warnings : tuple of str
        What a user should know before using it.
    film_solver, field_solver : str
        "ehlectric", or "paper" where the paper's own methods solved it.
    film_seconds, field_seconds : float
        Time it took [s].
    version, date : str
        Of the program that made it, and when (ISO 8601).
    """

    case: Case
    conditions: Conditions
    film: Film
    roughness: Array
    rough: tuple[dict[str, Any], ...]
    smooth: Smooth | None
    field: Field
    warnings: tuple[str, ...]
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
        field, film = self.field, self.film
        if not field.x[0] <= film.minimum_position <= field.x[-1]:
            return None
        return 1.0 - field.voltage / film.minimum_thickness / field.max_strength

    def summary(self) -> dict[str, Any]:
        """Key figures in SI units, nested as summary.json.

        Returns
        -------
        dict
            Values are numbers, texts, lists, or None where a value has no meaning; never NaN.
        """
        film, conditions = self.film, self.conditions
        summary: dict[str, Any] = {
            "schema": SCHEMA,
            "version": self.version,
            "title": self.case.title,
            "converged": self.converged,
            "status": film.status,
            "warnings": list(self.warnings),
            "inputs": resolved_inputs(self.case, conditions),
            "groups": {
                "moes_m": conditions.formulas.moes_m,
                "moes_l": conditions.formulas.moes_l,
            },
            "hertz": {
                "half_width": conditions.half_width,
                "max_pressure": conditions.max_pressure,
            },
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
            },
            "field": self._field_summary(),
            "film_formulas": {name: vars(formula(conditions.formulas)) for name, formula in FORMULAS.items()},
            "seconds": {"film": self.film_seconds, "field": self.field_seconds},
        }
        if self.rough:
            summary["roughness"] = self._roughness_summary()
        return {key: _plain(value) for key, value in summary.items()}

    def _roughness_summary(self) -> dict[str, Any]:
        """Statistics over the Hertz zone; no lambda ratio where that is smooth."""
        film = self.film
        inside = np.abs(film.x) <= self.conditions.half_width
        heights = self.roughness[:, inside]
        rq_1, rq_2 = (float(rq) for rq in np.std(heights, axis=1))
        # Of the sum, which alone the film feels: surfaces may be alike, or fill each other's valleys.
        combined = statistics(Profile(float(film.x[1] - film.x[0]), heights.sum(axis=0)))
        smooth = None if self.smooth is None else self.smooth.minimum_thickness
        rough = combined.rq >= FLAT
        return {
            "surfaces": list(self.rough),
            "rq_1": rq_1,
            "rq_2": rq_2,
            "rq_combined": combined.rq,
            "combined": vars(combined),
            "lambda_ratio": film.minimum_thickness / combined.rq if rough else None,
            "lambda_ratio_smooth": smooth / combined.rq if rough and smooth is not None else None,
            "smooth_minimum_thickness": smooth,
        }

    def _field_summary(self) -> dict[str, float | str | None]:
        field, scale = self.field, self.strength_scale
        central = None
        if field.x[0] <= 0.0 <= field.x[-1]:
            central = float(np.interp(0.0, field.x, field.middle_strength)) * scale
        return {
            "voltage": field.voltage,
            "max_strength": field.max_strength,
            "max_strength_position": field.max_strength_position,
            "max_dimensionless": self.max_dimensionless,
            "central_dimensionless": central,
            "high_field_width": field.high_field_width,
            "capacitance_per_length": field.capacitance,
            "thin_gap_error": self.thin_gap_error,
            "columns": field.x.size,
            "max_strength_wall": field.max_strength_wall,
            "solver": self.field_solver,
        }

    def to_xarray(self) -> xr.Dataset:
        """All arrays with their units, and the case, summary and solver history as attributes."""
        import xarray as xr

        return (
            xr.Dataset(
                variables(self.film, self.field)
                | roughness_variables(self.roughness)
                | (smooth_variables(**vars(self.smooth)) if self.smooth else {}),
                attrs={
                    "Conventions": "CF-1.11",
                    "title": self.case.title or "Film and electric field of a line contact",
                    "source": f"ehlectric {self.version}",
                    "history": f"{self.date} solved by ehlectric {self.version}",
                    "version": self.version,
                    "date": self.date,
                    "converged": int(self.converged),
                    "case": self.case.to_toml(),
                    "summary": json.dumps(self.summary()),
                    "warnings": json.dumps(self.warnings),
                    "rough": json.dumps(_plain(self.rough)),
                    "film_solver": self.film_solver,
                    "field_solver": self.field_solver,
                    "seconds": json.dumps([self.film_seconds, self.field_seconds]),
                    **attributes(self.film, self.field),
                },
            )
            .set_coords(COORDINATES)
            .copy(deep=True)
        )


def scales_of(case: Case, conditions: Conditions) -> Scales:
    """What turns the dimensionless film of a case into SI units."""
    return Scales(
        length=conditions.half_width,
        pressure=conditions.max_pressure,
        thickness=conditions.thickness_scale,
        ambient_pressure=case.lubricant.ambient_pressure,
    )


def resolved_inputs(case: Case, conditions: Conditions) -> dict[str, Any]:
    """The case as nested tables, its alternatives resolved."""
    inputs = case.to_dict()
    inputs["contact"] = {
        "geometry": case.contact.geometry,
        "reduced_radius": conditions.reduced_radius,
        "reduced_modulus": conditions.reduced_modulus,
        "load_per_length": conditions.load_per_length,
        "entrainment_speed": conditions.entrainment_speed,
        "slide_to_roll_ratio": conditions.slide_to_roll_ratio,
    }
    return inputs


def _plain(value: Any) -> Any:
    """JSON value: no NumPy scalars, and None for what is not finite."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
