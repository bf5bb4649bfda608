"""Stored form of a solved contact, result.nc: its dataset, the checks of such a dataset, and its parts."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.cases.contact_inputs import Contact
from ehlectric.cases.dry_contacts import hertz_pressure
from ehlectric.contact.contact_solution import Smooth, Solution
from ehlectric.contact.touching import Coarser
from ehlectric.errors import InputError
from ehlectric.field import Field, PointField
from ehlectric.film import Film, HeatedFilm, NewtonStep, PointFilm, Scales, Starvation
from ehlectric.lubricant.python_laws import SampledLaws, is_laws
from ehlectric.runtime.file_rules import Rule, UnfitError, case_of, is_list, is_number, json_of, text_of
from ehlectric.runtime.files import plain
from ehlectric.runtime.netcdf import Layout
from ehlectric.runtime.stored import (
    Part,
    check_parts,
    numbers_of,
    read_numbers,
    values_of,
    warnings_as_attributes,
    warnings_in,
)

if TYPE_CHECKING:
    import xarray as xr

# Format of the file: its kind and its version.
SCHEMA = "ehlectric.contact.result/1"

# Relative difference of values that are stored twice.
_ROUNDING = 1e-6

_STEPS = Part(NewtonStep, ("step",), "step_")
_ROUGHNESS = ("roughness_1", "roughness_2")


@dataclass(frozen=True)
class _Form:
    """Parts of the file of a line or of a point contact.

    ``nodes`` are the dimensions of the film, and ``heights`` is the coordinate across the gap.
    """

    title: str
    film: Part
    field: Part
    heated: Part
    smooth: Part
    nodes: tuple[str, ...]
    heights: str

    def parts(self, dataset: xr.Dataset) -> list[Part]:
        """Parts of a file, which has films of smooth surfaces or not."""
        smooth = [self.smooth] if "smooth_pressure" in dataset else []
        return [self.film, self.field, _STEPS, self.heated, *smooth]


def _form(kind: str, film: type[Film | PointFilm], field: type[Field | PointField], *nodes: str) -> _Form:
    axes = {"nodes": nodes, "columns": tuple(f"{axis}_field" for axis in nodes)}
    return _Form(
        title=f"Film and electric field of a {kind} contact",
        film=Part(film, axes=axes),
        field=Part(field, axes=axes),
        heated=Part(HeatedFilm, axes=axes),
        smooth=Part(Smooth, prefix="smooth_", axes=axes),
        nodes=nodes,
        heights="xyz"[len(nodes)],
    )


_FORMS: Mapping[str, _Form] = {
    "line": _form("line", Film, Field, "x"),
    "point": _form("point", PointFilm, PointField, "x", "y"),
}


def dataset_of(solution: Solution[Any, Any, Any], summary: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of a solved contact; case, summary and solver history are attributes.

    A contact that was solved without a case has no attribute ``case``, and its file cannot be loaded.
    """
    return layout_of(solution, summary).dataset()


def layout_of(solution: Solution[Any, Any, Any], summary: Mapping[str, Any]) -> Layout:
    """Variables and attributes of the dataset of a solved contact."""
    film, case, made_by = solution.film, solution.case, f"ehlectric {solution.version}"
    form = _FORMS[solution.conditions.geometry]
    variables = form.film.written(film) | form.field.written(solution.field)
    variables |= _STEPS.written(film.steps)
    variables |= {} if film.heated is None else form.heated.written(film.heated)
    for k, heights in enumerate(solution.roughness, 1):
        about = {"long_name": f"roughness of surface {k}, out of the body", "units": "m"}
        variables[f"roughness_{k}"] = (form.nodes, heights, about)
    variables |= {} if solution.smooth is None else form.smooth.written(solution.smooth)
    attributes = {
        "schema": SCHEMA,
        "Conventions": "CF-1.11",
        "title": case.title or form.title,
        "source": made_by,
        "history": f"{solution.date} solved by {made_by}",
        "version": solution.version,
        "date": solution.date,
        "converged": int(solution.converged),
        "summary": json.dumps(summary),
        **warnings_as_attributes(solution.warnings),
        "rough": json.dumps(plain(solution.rough)),
        "film_solver": solution.film_solver,
        "field_solver": solution.field_solver,
        "seconds": json.dumps([solution.film_seconds, solution.field_seconds]),
        "film": numbers_of(film),
        "field": numbers_of(solution.field),
    }
    if isinstance(case, Case):
        attributes["case"] = case.toml_text()
        if case.law_values is not None:
            attributes["laws"] = json.dumps(case.law_values.stored())
    others = {"coarser": solution.coarser, "starvation": film.starvation, "heated": film.heated}
    attributes |= {name: numbers_of(thing) for name, thing in others.items() if thing is not None}
    return Layout(variables, attributes, (form.heights,))


def stored_case(attributes: Mapping[Any, Any]) -> Case:
    """Case in the attributes of a file, with the laws of the oil that a user defined."""
    stored = json_of(attributes, "laws", is_laws) if "laws" in attributes else None
    return case_of(attributes, partial(case_with_stored_laws, stored=stored))


def case_with_stored_laws(table: Mapping[str, Any], stored: Mapping[str, Any] | None) -> Case:
    """Case of tables, with the values of laws that a file keeps; None without such laws."""
    if stored is None:
        return Case.from_dict(table)
    contact = Contact.from_dict(table["contact"])
    if contact.temperature is None:
        raise InputError.missing("contact.temperature", "the temperature of the stored laws")
    laws = SampledLaws.restored(stored, contact.temperature, hertz_pressure(contact))
    return Case.from_dict({**table, "laws": laws})


def parts_of(dataset: xr.Dataset, geometry: str, scales: Scales) -> dict[str, Any]:
    """Arguments of the result of a contact without its case, from its dataset, which is checked before.
    Raises UnfitError where a variable or an attribute is missing, or is not as ``dataset_of`` makes it.
    """
    form, attributes = _FORMS[geometry], dataset.attrs
    least = dict.fromkeys((*form.nodes, *(f"{axis}_field" for axis in form.nodes), "s"), 2)
    roughness = dict.fromkeys(_ROUGHNESS, Rule(form.nodes, unit="m"))
    check_parts(dataset, form.parts(dataset), roughness, least | {"step": 0})
    values = values_of(dataset)

    def optional(kind: type[Any], name: str, part: Part | None = None) -> Any:
        if name not in attributes:
            return None
        return kind(**read_numbers(kind, attributes, name), **(part.read(values) if part else {}))

    film_numbers = read_numbers(form.film.kind, attributes, "film")
    field = form.field.kind(**form.field.read(values), **read_numbers(form.field.kind, attributes, "field"))
    _check_field(field, values[form.heights])
    film = form.film.kind(
        **form.film.read(values),
        **film_numbers,
        scales=scales,
        steps=tuple(NewtonStep(**_STEPS.read(values, k)) for k in range(dataset.sizes["step"])),
        starvation=optional(Starvation, "starvation"),
        heated=optional(HeatedFilm, "heated", form.heated),
    )
    are_times = partial(is_list, right=partial(is_number, values="not negative"))
    are_tables = partial(is_list, right=lambda value: isinstance(value, dict))
    film_seconds, field_seconds = json_of(attributes, "seconds", are_times)
    return {
        "film": film,
        "field": field,
        "roughness": np.stack([values[name] for name in _ROUGHNESS]),
        "rough": tuple(json_of(attributes, "rough", are_tables)),
        "smooth": Smooth(**form.smooth.read(values)) if "smooth_pressure" in values else None,
        "coarser": optional(Coarser, "coarser"),
        "warnings": warnings_in(attributes),
        "film_seconds": film_seconds,
        "field_seconds": field_seconds,
        **{name: text_of(attributes, name) for name in ("version", "date", "film_solver", "field_solver")},
    }


def _check_field(field: Field | PointField, heights: Array) -> None:
    """Check that the field follows from its voltage and gap, and its strength from its components."""
    parts = [field.field_x, field.field_y, *([field.field_z] if isinstance(field, PointField) else [])]
    across = field.thin_gap_strength * (heights[..., -1] - heights[..., 0])
    for name, values, expected in (
        ("thin_gap_strength", across, field.voltage),
        ("strength", field.strength, np.sqrt(sum(part**2 for part in parts))),
    ):
        if not np.allclose(values, expected, rtol=_ROUNDING, atol=0.0):
            raise UnfitError(f"{name} does not belong to the field")
