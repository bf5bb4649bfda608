"""Results of line and of point contacts: a solution with its summary, its dataset and its formulas."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.dataset import dataset_of
from ehlectric.contact.kinds import KINDS
from ehlectric.contact.solution import ConditionsT, FieldT, FilmT, Solution
from ehlectric.contact.statistics import RoughnessStatistics
from ehlectric.contact.summary import formulas_of, summary_of
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.zones import Zone, contact_zones
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.formulas.film_line import Thickness

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class ContactResult(Solution[ConditionsT, FilmT, FieldT]):
    """Film and field of one contact, with the views that files, tables and figures take of them."""

    def summary(self) -> dict[str, Any]:
        """Key figures in SI units, nested as summary.json.

        Returns
        -------
        dict
            Values are numbers, texts, lists, or None where a value has no meaning; never NaN.
        """
        return summary_of(self)

    def to_xarray(self) -> xr.Dataset:
        """All arrays with their units, and the case, summary and solver history as attributes."""
        return dataset_of(self, KINDS[self.conditions.geometry].layout, summary_of(self))

    def formulas(self) -> Mapping[str, Thickness]:
        """Film thickness by each of the published formulas [m]."""
        return formulas_of(self.conditions)

    @cached_property
    def roughness_statistics(self) -> RoughnessStatistics:
        """Statistics of the roughness over the Hertz zone, SI units."""
        statistics: RoughnessStatistics = KINDS[self.conditions.geometry].roughness(self)
        return statistics


@dataclass(frozen=True)
class Result(ContactResult[Conditions, Film, Field]):
    """Film and field of one line contact; its attributes are those of ``Solution``."""


@dataclass(frozen=True)
class PointResult(ContactResult[PointConditions, PointFilm, PointField]):
    """Film and field of one point contact; its attributes are those of ``Solution``."""

    @property
    def zones(self) -> dict[str, Zone]:
        """Parts of the contact whose capacitances add up to the whole: ``contact_zones``."""
        return contact_zones(self.conditions.semi_axis_x, self.conditions.semi_axis_y)


# Results by the geometry of the contact.
RESULTS: Mapping[str, type[Result] | type[PointResult]] = {"line": Result, "point": PointResult}
