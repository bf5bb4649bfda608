"""The solution of a point contact: what its summary and its files hold beside what all solutions share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ehlectric.case import Case
from ehlectric.dataset import POINT_LAYOUT, Layout
from ehlectric.domain import contact_zones
from ehlectric.film_formulas import Thickness
from ehlectric.point_conditions import PointConditions
from ehlectric.point_field import PointField
from ehlectric.point_film import PointFilm
from ehlectric.point_formulas import FORMULAS
from ehlectric.roughness import FLAT
from ehlectric.solution import Solution
from ehlectric.topography import Map, statistics
from ehlectric.zones import Zone


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


def point_inputs(case: Case, conditions: PointConditions) -> dict[str, Any]:
    """The case as nested tables, its alternatives resolved."""
    inputs = case.to_dict()
    names = ("radius_x", "radius_y", "reduced_modulus", "load", "entrainment_speed", "slide_to_roll_ratio")
    inputs["contact"] = {"geometry": case.contact.geometry} | {
        name: getattr(conditions, name) for name in names
    }
    inputs["grid"] |= {"side": conditions.side}
    return inputs


def point_hertz(conditions: PointConditions) -> dict[str, float]:
    """The dry contact, with the keys of summary.json."""
    return {
        "semi_axis_x": conditions.semi_axis_x,
        "semi_axis_y": conditions.semi_axis_y,
        "max_pressure": conditions.max_pressure,
    }
