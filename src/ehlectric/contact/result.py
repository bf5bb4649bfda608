"""Results of line and of point contacts: film and field, with summary, dataset and film formulas."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.contact_solution import ConditionsT, FieldT, FilmT, RoughnessStatistics, Solution
from ehlectric.contact.stored import dataset_of
from ehlectric.contact.summary import formulas_of, summary_of
from ehlectric.field import Field, PointField, Zone, contact_zones
from ehlectric.film import Film, PointFilm, pressure_error_text
from ehlectric.formulas.film_line import Thickness
from ehlectric.quantities.formats import amount
from ehlectric.quantities.former_keys import warning_tables
from ehlectric.quantities.results import CONTACT_BOOK, CONTACT_KEYS
from ehlectric.runtime.display import headline, read_only_property

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def film_columns(film: Film | PointFilm) -> dict[str, tuple[Array, str]]:
    """Film node by node: columns of a table by name, each with its unit, empty for a dimensionless one."""
    positions = np.meshgrid(*film.axes, indexing="ij")
    columns = {name: (values.ravel(), "m") for name, values in zip("xy", positions, strict=False)}
    columns |= {"pressure": (film.pressure.ravel(), "Pa"), "thickness": (film.thickness.ravel(), "m")}
    return columns | {"density": (film.density.ravel(), "")}


@dataclass(frozen=True, eq=False, repr=False)
class ContactResult(Solution[ConditionsT, FilmT, FieldT]):
    """Film and field of one contact, with the summary and the dataset that files and figures use."""

    def summary(self) -> dict[str, Any]:
        """Key figures in SI units, as nested tables with the keys of summary.json. Returns numbers, texts and
        lists; None if a value has no meaning, never NaN.
        """
        return warning_tables(summary_of(self), CONTACT_KEYS["line"])

    def to_xarray(self) -> xr.Dataset:
        """Dataset of all arrays with their units; case, summary and solver history are attributes."""
        return dataset_of(self, summary_of(self))

    def to_dataframe(self) -> pd.DataFrame:
        """Film node by node as a table of pandas, the same as film.csv. Returns positions ``x`` (and ``y``),
        ``pressure``, ``thickness`` and ``density`` of every node in SI units; ``attrs["units"]`` has the unit
        of each column.
        """
        import pandas as pd

        columns = film_columns(self.film)
        frame = pd.DataFrame({name: values for name, (values, _) in columns.items()})
        frame.attrs["units"] = {name: unit for name, (_, unit) in columns.items()}
        return frame

    def key_numbers(self) -> tuple[str | None, ...]:
        """Geometry, films, pressure, field and state, as texts."""
        film, touching = self.film, self.spots
        error = pressure_error_text(film.max_pressure_error)
        doubt = f" ({error})" if error else ""
        least = f"minimum film {amount(film.minimum_thickness, 'm')}"
        field = CONTACT_BOOK[self.conditions.geometry]["field.max_strength"]
        strongest: str | None = f"maximum field {field.with_sign(amount(self.field.max_strength, 'V/m'))}"
        if touching is not None:
            # Minimum film and maximum field belong to the boundary film.
            least = f"{touching.spots.number} contact spots, {touching.electrical.behaviour}"
            strongest = f"mean film {amount(film.mean_thickness, 'm')}"
        return (
            f"{self.conditions.geometry} contact",
            least,
            f"maximum pressure {amount(film.max_pressure, 'Pa')}{doubt}",
            strongest,
            "converged" if self.converged else f"NOT CONVERGED ({film.status})",
        )

    def _headline(self) -> str:
        return headline(self.case.title, *self.key_numbers(), verdict=self.verdict)

    def formulas(self) -> Mapping[str, Thickness]:
        """Film thickness from each published formula [m], keyed by the name of the formula."""
        return formulas_of(self.conditions)

    @read_only_property
    def roughness_statistics(self) -> RoughnessStatistics:
        """Statistics of the roughness over the Hertz zone, SI units."""
        statistics: RoughnessStatistics = KINDS[self.conditions.geometry].roughness(self)
        return statistics


@dataclass(frozen=True, eq=False, repr=False)
class Result(ContactResult[Conditions, Film, Field]):
    """Film and field of one line contact, as ``solve`` returns it.

    Attributes
    ----------
    case : Case
        Case that was solved.
    conditions : Conditions
        Operating conditions: Hertz pressure, half-width and groups, SI units.
    film : Film
        Film over ``film.x``: pressure, thickness, density, status and error estimate, SI units.
    field : Field
        Electric field over ``field.x`` and across the film: potential, strength and capacitance, SI units.
    warnings : tuple of ResultWarning
        Warnings about unreliable results, each with a code and a severity.
    roughness : ndarray, shape (2, nx)
        Roughness heights of both surfaces at the film's nodes, positive out of the body [m].
    smooth : Smooth or None
        Same contact with smooth surfaces; None if the surfaces are smooth.
    film_seconds, field_seconds : float
        Time taken by the solvers of the film and of the field [s].
    version, date : str
        Version of the program, and date of the solution (ISO 8601).

    Examples
    --------
    >>> from ehlectric import Case, solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> result = solve(case)
    >>> result.converged, result.film.pressure.shape
    (True, (401,))
    """


@dataclass(frozen=True, eq=False, repr=False)
class PointResult(ContactResult[PointConditions, PointFilm, PointField]):
    """Film and field of one point contact, as ``solve`` returns it.

    Attributes
    ----------
    case : Case
        Case that was solved.
    conditions : PointConditions
        Operating conditions: Hertz pressure, semi-axes and groups, SI units.
    film : PointFilm
        Film over ``film.x`` and ``film.y``: pressure, thickness, density, status and error estimate, SI
        units; ``film.thickness[i, j]`` is the thickness at ``film.x[i]``, ``film.y[j]``.
    field : PointField
        Electric field over ``field.x``, ``field.y`` and across the film: potential, strength and capacitance,
        SI units.
    warnings : tuple of ResultWarning
        Warnings about unreliable results, each with a code and a severity.
    roughness : ndarray, shape (2, nx, ny)
        Roughness heights of both surfaces at the film's nodes, positive out of the body [m].
    smooth : Smooth or None
        Same contact with smooth surfaces; None if the surfaces are smooth.
    film_seconds, field_seconds : float
        Time taken by the solvers of the film and of the field [s].
    version, date : str
        Version of the program, and date of the solution (ISO 8601).

    Examples
    --------
    >>> from ehlectric import Case, solve
    >>> ball = {"radius_x": "10 mm", "radius_y": "10 mm", "reduced_modulus": "226 GPa", "load": "20 N"}
    >>> case = Case.point(**ball, entrainment_speed="1 m/s", lubricant="paper")
    >>> result = solve(case.replace({"grid.nodes": 65}))
    >>> result.converged, result.film.pressure.ndim
    (True, 2)
    """

    @property
    def zones(self) -> dict[str, Zone]:
        """Hertz zone, inlet, outlet and sides, whose capacitances add up; see ``contact_zones``."""
        return contact_zones(self.conditions.semi_axis_x, self.conditions.semi_axis_y)


# Class of the result by the geometry of the contact.
RESULTS: Mapping[str, type[Result] | type[PointResult]] = {"line": Result, "point": PointResult}
