"""The solution of a line contact: what its summary and its files hold beside what all solutions share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.case import Case
from ehlectric.conditions import Conditions
from ehlectric.dataset import LINE_LAYOUT, Layout
from ehlectric.field import Field
from ehlectric.film import Film
from ehlectric.film_formulas import FORMULAS, Thickness
from ehlectric.roughness import FLAT, Profile, statistics
from ehlectric.solution import Solution


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
        return {name: formula(self.conditions.formulas) for name, formula in FORMULAS.items()}

    def _own_roughness(self) -> dict[str, Any]:
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
            "rq_1": rq_1,
            "rq_2": rq_2,
            "rq_combined": combined.rq,
            "combined": vars(combined),
            "lambda_ratio": film.minimum_thickness / combined.rq if rough else None,
            "lambda_ratio_smooth": smooth / combined.rq if rough and smooth is not None else None,
            "smooth_minimum_thickness": smooth,
        }


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
