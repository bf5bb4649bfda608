"""Results of line and of point contacts: film and field, with summary, dataset and film formulas."""

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
    """Film and field of one contact, with the summary and the dataset that files and figures use."""

    def summary(self) -> dict[str, Any]:
        """Key figures in SI units, as nested tables with the keys of summary.json.

        Returns
        -------
        dict
            Numbers, texts and lists; None if a value has no meaning, never NaN.
        """
        return summary_of(self)

    def to_xarray(self) -> xr.Dataset:
        """Dataset of all arrays with their units; case, summary and solver history are attributes."""
        return dataset_of(self, KINDS[self.conditions.geometry].layout, summary_of(self))

    def formulas(self) -> Mapping[str, Thickness]:
        """Film thickness from each published formula [m], keyed by the name of the formula."""
        return formulas_of(self.conditions)

    @cached_property
    def roughness_statistics(self) -> RoughnessStatistics:
        """Statistics of the roughness over the Hertz zone, SI units."""
        statistics: RoughnessStatistics = KINDS[self.conditions.geometry].roughness(self)
        return statistics


@dataclass(frozen=True)
class Result(ContactResult[Conditions, Film, Field]):
    """Film and field of one line contact; its attributes are listed under ``Solution``."""


@dataclass(frozen=True)
class PointResult(ContactResult[PointConditions, PointFilm, PointField]):
    """Film and field of one point contact; its attributes are listed under ``Solution``."""

    @property
    def zones(self) -> dict[str, Zone]:
        """Hertz zone, inlet, outlet and sides, whose capacitances add up; see ``contact_zones``."""
        return contact_zones(self.conditions.semi_axis_x, self.conditions.semi_axis_y)


# Class of the result by the geometry of the contact.
RESULTS: Mapping[str, type[Result] | type[PointResult]] = {"line": Result, "point": PointResult}
