"""The solutions of line and of point contacts: what each has beside what they share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ehlectric.contact.conditions import (
    Conditions,
    PointConditions,
    point_hertz,
    point_inputs,
    resolved_inputs,
)
from ehlectric.contact.dataset import LINE_LAYOUT, POINT_LAYOUT, Layout
from ehlectric.contact.solution import Solution
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.zones import Zone, contact_zones
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.formulas.film_line import FORMULAS as FILM_LINE_FORMULAS
from ehlectric.formulas.film_line import Thickness
from ehlectric.formulas.film_point import FORMULAS
from ehlectric.surfaces.maps import Map, statistics
from ehlectric.surfaces.profiles import FLAT, Profile
from ehlectric.surfaces.profiles import statistics as profiles_statistics


@dataclass(frozen=True)
class PointResult(Solution[PointConditions, PointFilm, PointField]):
    """Film and field of one point contact; its attributes are those of ``Solution``."""

    @property
    def layout(self) -> Layout:
        """How its arrays lie in a file."""
        return POINT_LAYOUT

    @property
    def zones(self) -> dict[str, Zone]:
        """Parts of the contact whose capacitances add up to the whole: ``contact_zones``."""
        return contact_zones(self.conditions.semi_axis_x, self.conditions.semi_axis_y)

    @cached_property
    def capacitance_by_zone(self) -> dict[str, float]:
        """Capacitance of each of the ``zones`` [F]; kept, as summary, dataset and table all ask for it."""
        return {name: self.field.capacitance_of(zone) for name, zone in self.zones.items()}

    def _holds(self, position: tuple[float, float]) -> bool:
        axes = (self.field.x, self.field.y)
        return all(bool(axis[0] <= at <= axis[-1]) for at, axis in zip(position, axes, strict=True))

    def _inputs(self) -> dict[str, Any]:
        return point_inputs(self.case, self.conditions)

    def _hertz(self) -> dict[str, float]:
        return point_hertz(self.conditions)

    def _own_film(self) -> dict[str, Any]:
        film = self.film
        return {
            "nodes": list(film.thickness.shape),
            "inlet_deficit": film.inlet_deficit,
            "side_deficit": film.side_deficit,
        }

    def _own_field(self) -> dict[str, Any]:
        field, central = self.field, None
        if self._holds((0.0, 0.0)):
            along = [np.interp(0.0, field.y, row) for row in field.middle_strength]
            central = float(np.interp(0.0, field.x, along)) * self.strength_scale
        return {
            "central_dimensionless": central,
            "high_field_area": field.high_field_area,
            "capacitance": field.capacitance,
            "capacitance_by_charge": field.capacitance_by_charge,
            "capacitance_by_zone": self.capacitance_by_zone,
            "columns": list(field.middle_strength.shape),
        }

    def formulas(self) -> Mapping[str, Thickness]:
        """Films of the published formulas."""
        return {name: formula(self.conditions.formulas) for name, formula in FORMULAS.items()}

    def _own_roughness(self) -> dict[str, Any]:
        """Statistics over the Hertz ellipse; no lambda ratio where that is smooth."""
        film, conditions = self.film, self.conditions
        inside = self.zones["hertz"](film.x[:, np.newaxis], film.y)
        rq_1, rq_2, rq = (
            float(np.std(heights[inside])) for heights in (*self.roughness, self.roughness.sum(axis=0))
        )
        smooth = None if self.smooth is None else self.smooth.minimum_thickness
        rough = rq >= FLAT
        along = np.abs(film.x) <= conditions.semi_axis_x
        across = np.abs(film.y) <= conditions.semi_axis_y
        around = self.roughness.sum(axis=0)[along][:, across]
        spacing = float(film.x[1] - film.x[0]), float(film.y[1] - film.y[0])
        return {
            "rq_1": rq_1,
            "rq_2": rq_2,
            "rq_combined": rq,
            "combined": vars(statistics(Map(*spacing, around))),
            "lambda_ratio": film.minimum_thickness / rq if rough else None,
            "lambda_ratio_smooth": smooth / rq if rough and smooth is not None else None,
            "smooth_minimum_thickness": smooth,
        }


@dataclass(frozen=True)
class Result(Solution[Conditions, Film, Field]):
    """Film and field of one line contact; its attributes are those of ``Solution``."""

    @property
    def layout(self) -> Layout:
        """How its arrays lie in a file."""
        return LINE_LAYOUT

    def _holds(self, position: float) -> bool:
        return bool(self.field.x[0] <= position <= self.field.x[-1])

    def _inputs(self) -> dict[str, Any]:
        return resolved_inputs(self.case, self.conditions)

    def _hertz(self) -> dict[str, float]:
        return {"half_width": self.conditions.half_width, "max_pressure": self.conditions.max_pressure}

    def _own_film(self) -> dict[str, Any]:
        return {"nodes": self.film.x.size}

    def _own_field(self) -> dict[str, Any]:
        field, central = self.field, None
        if self._holds(0.0):
            central = float(np.interp(0.0, field.x, field.middle_strength)) * self.strength_scale
        return {
            "central_dimensionless": central,
            "high_field_width": field.high_field_width,
            "capacitance_per_length": field.capacitance,
            "columns": field.x.size,
        }

    def formulas(self) -> Mapping[str, Thickness]:
        """Films of the published formulas."""
        return {name: formula(self.conditions.formulas) for name, formula in FILM_LINE_FORMULAS.items()}

    def _own_roughness(self) -> dict[str, Any]:
        """Statistics over the Hertz zone; no lambda ratio where that is smooth."""
        film = self.film
        inside = np.abs(film.x) <= self.conditions.half_width
        heights = self.roughness[:, inside]
        rq_1, rq_2 = (float(rq) for rq in np.std(heights, axis=1))
        # Of the sum, which alone the film feels: surfaces may be alike, or fill each other's valleys.
        combined = profiles_statistics(Profile(float(film.x[1] - film.x[0]), heights.sum(axis=0)))
        smooth = None if self.smooth is None else self.smooth.minimum_thickness
        rough = combined.rq >= FLAT
        return {
            "rq_1": rq_1,
            "rq_2": rq_2,
            "rq_combined": combined.rq,
            "combined": vars(combined),
            "lambda_ratio": film.minimum_thickness / combined.rq if rough else None,
            "lambda_ratio_smooth": smooth / combined.rq if rough and smooth is not None else None,
            "smooth_minimum_thickness": smooth,
        }
