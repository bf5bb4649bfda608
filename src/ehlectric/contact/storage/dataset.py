"""Conversion of a solved contact to an xarray dataset and back."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.heat import files as heat
from ehlectric.contact.solution import Solution
from ehlectric.contact.spots.mechanics import Coarser
from ehlectric.contact.starved.stored import starvation_attribute, starvation_of
from ehlectric.contact.storage.layouts import HISTORY, SMOOTH, Layout, Variables
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.film.state import NewtonStep
from ehlectric.runtime.files import plain
from ehlectric.runtime.stored_warnings import as_attributes

if TYPE_CHECKING:
    import xarray as xr


# Format of the file, which tells its kind and its version.
SCHEMA = "ehlectric.contact.result/1"


def variables(
    layout: Layout, film: Any, field: Any, roughness: Array, smooth: Mapping[str, Array] | None
) -> dict[str, Any]:
    """All arrays of a solution in the form that xarray expects.

    Each variable is a tuple of its dimensions, its values, and a dict with its long name and unit.
    """
    named: dict[str, Any] = {}
    for part, table in ((film, layout.film), (field, layout.field)):
        for name, (attribute, dimensions, long_name, unit) in table.items():
            if getattr(part, attribute) is None:
                continue
            values = np.asarray(getattr(part, attribute))
            values = values.astype(np.int8) if values.dtype == bool else values
            named[name] = (dimensions, values, {"long_name": long_name, "units": unit})
    named |= heat.heated_variables(film.heated, layout.film_grid)
    for name, (attribute, long_name) in HISTORY.items():
        values = np.array([getattr(step, attribute) for step in film.steps])
        named[name] = ("step", values, {"long_name": long_name, "units": "1"})
    for k, heights in enumerate(roughness, 1):
        about = {"long_name": f"roughness of surface {k}, out of the body", "units": "m"}
        named[f"roughness_{k}"] = (layout.film_grid, heights, about)
    for name, values in (smooth or {}).items():
        grid, what, unit = SMOOTH[name]
        about = {"long_name": f"{what} of smooth surfaces", "units": unit}
        named[f"smooth_{name}"] = (getattr(layout, grid), values, about)
    return named


def dataset_of(solution: Solution[Any, Any, Any], layout: Layout, summary: Mapping[str, Any]) -> xr.Dataset:
    """Make the dataset of a solved contact.

    Parameters
    ----------
    solution : Solution
        Film and field of the contact.
    layout : Layout
        Names and dimensions of the arrays of this kind of contact.
    summary : mapping
        Key figures of the contact.

    Returns
    -------
    xarray.Dataset
        All arrays with their units; case, summary and solver history are attributes. A contact that was
        solved without a case has no attribute ``case``, and ``load`` refuses its file.
    """
    import xarray as xr

    smooth = None if solution.smooth is None else vars(solution.smooth)
    case, made_by = solution.case, f"ehlectric {solution.version}"
    own = case.own_laws if isinstance(case, Case) else None
    return (
        xr.Dataset(
            variables(layout, solution.film, solution.field, solution.roughness, smooth),
            attrs={
                "schema": SCHEMA,
                "Conventions": "CF-1.11",
                "title": case.title or layout.title,
                "source": made_by,
                "history": f"{solution.date} solved by {made_by}",
                "version": solution.version,
                "date": solution.date,
                "converged": int(solution.converged),
                **({"case": case.to_toml()} if isinstance(case, Case) else {}),
                **({} if own is None else {"laws": json.dumps(own.stored())}),
                "summary": json.dumps(summary),
                **as_attributes(solution.warnings),
                "rough": json.dumps(plain(solution.rough)),
                **({} if solution.coarser is None else {"coarser": json.dumps(vars(solution.coarser))}),
                "film_solver": solution.film_solver,
                "field_solver": solution.field_solver,
                "seconds": json.dumps([solution.film_seconds, solution.field_seconds]),
                **starvation_attribute(solution.film.starvation),
                **attributes(layout, solution.film, solution.field),
                **heat.heated_attributes(solution.film.heated),
            },
        )
        .set_coords(layout.coordinates)
        .copy(deep=True)
    )


def film_columns(film: Film | PointFilm) -> dict[str, tuple[Array, str]]:
    """Film node by node: columns of a table by name, each with its unit, empty for a dimensionless one."""
    positions = np.meshgrid(*film.axes, indexing="ij")
    columns = {name: (values.ravel(), "m") for name, values in zip("xy", positions, strict=False)}
    columns |= {"pressure": (film.pressure.ravel(), "Pa"), "thickness": (film.thickness.ravel(), "m")}
    return columns | {"density": (film.density.ravel(), "")}


def smooth_of(dataset: xr.Dataset) -> dict[str, Array] | None:
    """Arrays of the same contact with smooth surfaces; None if the dataset has none."""
    if "smooth_pressure" not in dataset:
        return None
    return {name: dataset[f"smooth_{name}"].values for name in SMOOTH}


def coarser_of(dataset: xr.Dataset) -> Coarser | None:
    """Asperities on a coarser grid; None if the dataset has none."""
    return Coarser(**json.loads(dataset.attrs["coarser"])) if "coarser" in dataset.attrs else None


def roughness_of(dataset: xr.Dataset) -> Array:
    """Roughness heights of both surfaces in a dataset [m], shape (2, nx) or (2, nx, ny)."""
    return np.stack([dataset["roughness_1"].values, dataset["roughness_2"].values])


def attributes(layout: Layout, film: Any, field: Any) -> dict[str, str]:
    """Attributes of the film and of the field that are not arrays, as one JSON text each."""
    return {
        "film": json.dumps({name: getattr(film, name) for name in layout.film_numbers}),
        "field": json.dumps({name: getattr(field, name) for name in layout.field_numbers}),
    }


def film_parts(layout: Layout, dataset: xr.Dataset) -> dict[str, Any]:
    """Arguments of the class of the film, read from a dataset, without the scales of the film."""
    arrays: dict[str, Any] = dict(_arrays(dataset, layout.film))
    arrays["cavitated"] = arrays["cavitated"].astype(bool)
    arrays |= {"starvation": starvation_of(dataset.attrs), "heated": heat.heated_of(dataset)}
    history = zip(*(dataset[name].values for name in HISTORY), strict=True)
    steps = tuple(NewtonStep(int(n), float(residual), int(krylov)) for n, residual, krylov in history)
    return {**arrays, **json.loads(dataset.attrs["film"]), "steps": steps}


def field_parts(layout: Layout, dataset: xr.Dataset) -> dict[str, Any]:
    """Arguments of the class of the field, read from a dataset."""
    return {**dict(_arrays(dataset, layout.field)), **json.loads(dataset.attrs["field"])}


def _arrays(dataset: xr.Dataset, table: Variables) -> Iterator[tuple[str, Any]]:
    for name, (attribute, *_) in table.items():
        if name in dataset:
            yield attribute, dataset[name].values
