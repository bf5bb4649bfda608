"""Lengths along the surfaces of a contact in figures: their unit, what is shown, and which way up."""

from __future__ import annotations

from dataclasses import dataclass

from ehlectric.contact.results import PointResult, Result
from ehlectric.figures.contact.profiles import film_scale, touches
from ehlectric.quantities.units import unit_for

# Range of x/b that figures show at first, as in the figures of the command.
BEFORE, BEHIND = -2.0, 1.5

# Ratio of the semi-axes above which the long axis lies along the page, as in the figures of the command.
_TURNED = 1.2


@dataclass(frozen=True)
class Lengths:
    """Unit of lengths along the surfaces of a contact.

    Attributes
    ----------
    factor, unit : float and str
        Factor from metres, and unit.
    """

    factor: float
    unit: str

    @classmethod
    def of(cls, result: Result | PointResult) -> Lengths:
        """Unit that suits the half-width of a contact, or its semi-axis along entrainment."""
        return cls(*unit_for(result.conditions.half_width, "m", least=1.0))


def is_turned(result: PointResult) -> bool:
    """Whether maps have y to the right and entrainment downwards."""
    return result.conditions.ratio > _TURNED


def main_numbers(result: Result | PointResult) -> str:
    """Sentence with minimum film, maximum pressure and maximum field of a solved contact."""
    film = result.film
    least = "The surfaces touch: minimum film" if touches(result) else "Minimum film"
    to_h, length = unit_for(film_scale(result), "m")
    to_p, pressure = unit_for(film.max_pressure, "Pa")
    to_e, strength = unit_for(result.field.max_strength, "V/m")
    return (
        f"{least} {to_h * film.minimum_thickness:.4g} {length}, maximum pressure "
        f"{to_p * film.max_pressure:.4g} {pressure}, maximum field "
        f"{to_e * result.field.max_strength:.4g} {strength}."
    )
