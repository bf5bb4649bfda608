"""Conversion of a solved contact to an xarray dataset and back: names, dimensions and units of variables."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields
from functools import partial
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.heat import files as heat
from ehlectric.contact.solution import Solution
from ehlectric.contact.spots.mechanics import Coarser
from ehlectric.contact.starved.stored import check_starvation, starvation_attribute, starvation_of
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.film.state import NewtonStep, Status
from ehlectric.lubricant.own import is_laws
from ehlectric.runtime.checks.schema import (
    Rule,
    UnfitError,
    check_variables,
    check_warnings,
    is_list,
    is_number,
    is_number_or_null,
    is_table,
    json_of,
    text_of,
)
from ehlectric.runtime.files import plain
from ehlectric.runtime.stored_warnings import as_attributes

if TYPE_CHECKING:
    import xarray as xr


# Name in the file: (attribute of the film or field, dimensions, long name, unit).
Variables = Mapping[str, tuple[str, tuple[str, ...], str, str]]


@dataclass(frozen=True)
class Layout:
    """Names and dimensions of the arrays of one kind of contact in a file.

    Attributes
    ----------
    title : str
        Title of a dataset whose case has none.
    film, field : mapping
        Variables of the film and of the field, as in ``Variables``.
    film_grid, field_grid : tuple of str
        Dimensions of values at the film's nodes, and at the columns of the field.
    film_numbers, field_numbers : tuple of str
        Attributes of the film and of the field that are not arrays.
    coordinates : tuple of str
        Variables that are coordinates.
    """

    title: str
    film: Variables
    field: Variables
    film_grid: tuple[str, ...]
    field_grid: tuple[str, ...]
    film_numbers: tuple[str, ...]
    field_numbers: tuple[str, ...]
    coordinates: tuple[str, ...]


def on_nodes(*grid: str) -> Variables:
    """Variables that every film has at its nodes; ``grid`` names their dimensions."""
    return {
        "pressure": ("pressure", grid, "pressure", "Pa"),
        "thickness": ("thickness", grid, "film thickness", "m"),
        "density": ("density", grid, "density / density at zero pressure", "1"),
        "deflection": ("deflection", grid, "gap opened by the pressure, up to a rigid displacement", "m"),
        "reynolds_residual": (
            "reynolds_residual",
            grid,
            "residual of the Reynolds equation in units of p/p_h",
            "1",
        ),
        "cavitated": ("cavitated", grid, "pressure held at ambient", "1"),
        "contact_pressure": ("contact_pressure", grid, "part of the pressure that asperities carry", "Pa"),
        "film_fraction": ("film_fraction", grid, "part of the gap that oil fills", "1"),
    }


def on_columns(*grid: str) -> Variables:
    """Variables that every field has at its columns; ``grid`` names the dimensions of the columns."""
    return {
        "permittivity": ("permittivity", (*grid, "s"), "relative permittivity", "1"),
        "potential": ("potential", (*grid, "s"), "electric potential", "V"),
        "field_x": ("field_x", (*grid, "s"), "electric field along x", "V/m"),
        "field_y": ("field_y", (*grid, "s"), "electric field along y", "V/m"),
        "strength": ("strength", (*grid, "s"), "electric field strength", "V/m"),
        "middle_strength": ("middle_strength", grid, "electric field strength at mid-film", "V/m"),
        "thin_gap_strength": ("thin_gap_strength", grid, "voltage / film thickness", "V/m"),
    }


X = {"x": ("x", ("x",), "position along entrainment", "m")}
X_FIELD = {"x_field": ("x", ("x_field",), "position along entrainment, columns of the field", "m")}
_DENSITY = "capacitance_density"
S = {"s": ("s", ("s",), "fraction of the gap, from surface 1 to surface 2", "1")}
FILM_NUMBERS = (
    "status",
    "residual",
    "load_residual",
    "newton_iterations",
    "discretisation_error",
    "inlet_deficit",
    "max_pressure_error",
)
FIELD_NUMBERS = (
    "voltage",
    "capacitance",
    "capacitance_by_charge",
    "thin_gap_capacitance",
    "strength_error",
    "sufficient_degree",
)
LINE_LAYOUT = Layout(
    title="Film and electric field of a line contact",
    film={**X, **on_nodes("x")},
    field={
        **X_FIELD,
        **S,
        "y": ("y", ("x_field", "s"), "height", "m"),
        **on_columns("x_field"),
        _DENSITY: (_DENSITY, ("x_field",), "capacitance per length and width", "F/m^2"),
    },
    film_grid=("x",),
    field_grid=("x_field",),
    film_numbers=FILM_NUMBERS,
    field_numbers=FIELD_NUMBERS,
    coordinates=("x", "x_field", "s", "y"),
)
POINT_LAYOUT = Layout(
    title="Film and electric field of a point contact",
    film={**X, "y": ("y", ("y",), "position across entrainment", "m"), **on_nodes("x", "y")},
    field={
        **X_FIELD,
        "y_field": ("y", ("y_field",), "position across entrainment, columns of the field", "m"),
        **S,
        "z": ("z", ("x_field", "y_field", "s"), "height", "m"),
        **on_columns("x_field", "y_field"),
        "field_z": ("field_z", ("x_field", "y_field", "s"), "electric field along z", "V/m"),
        _DENSITY: (_DENSITY, ("x_field", "y_field"), "capacitance per area", "F/m^2"),
    },
    film_grid=("x", "y"),
    field_grid=("x_field", "y_field"),
    film_numbers=(*FILM_NUMBERS, "semi_axis_y", "side_deficit"),
    field_numbers=(*FIELD_NUMBERS, "iterations"),
    coordinates=("x", "y", "x_field", "y_field", "s", "z"),
)
_HISTORY = {
    "step_nodes": ("nodes", "nodes of the grid of a Newton step"),
    "step_residual": ("residual", "scaled residual before a Newton step"),
    "step_krylov_iterations": ("krylov_iterations", "GMRES iterations of a Newton step"),
}
_SMOOTH = {
    "pressure": ("film_grid", "pressure", "Pa"),
    "thickness": ("film_grid", "film thickness", "m"),
    "middle_strength": ("field_grid", "electric field strength at mid-film", "V/m"),
}

# What values of variables are, and numbers of the film and the field. Others are finite, numbers also null.
_VALUES = {
    "pressure": "not negative",
    "thickness": "positive",
    "density": "positive",
    "film_fraction": "not negative",
    "permittivity": "positive",
    "cavitated": "0 or 1",
    "strength": "not negative",
    "middle_strength": "not negative",
    "thin_gap_strength": "positive",
}
# Relative difference of values that are stored twice.
_ROUNDING = 1e-6

_is_time = partial(is_number, values="not negative")
_is_positive = partial(is_number, values="positive")
_NUMBERS: Mapping[str, Callable[[Any], bool]] = {
    "status": lambda value: value in get_args(Status),
    "residual": partial(is_number, values="not negative"),
    "load_residual": is_number,
    "newton_iterations": partial(is_number, values="whole"),
    "voltage": _is_positive,
    "capacitance": _is_positive,
    "capacitance_by_charge": is_number,
    "thin_gap_capacitance": _is_positive,
}

# Variables that only some solutions have.
_NOT_ALWAYS = ("contact_pressure", "film_fraction")


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
    for name, (attribute, long_name) in _HISTORY.items():
        values = np.array([getattr(step, attribute) for step in film.steps])
        named[name] = ("step", values, {"long_name": long_name, "units": "1"})
    for k, heights in enumerate(roughness, 1):
        about = {"long_name": f"roughness of surface {k}, out of the body", "units": "m"}
        named[f"roughness_{k}"] = (layout.film_grid, heights, about)
    for name, values in (smooth or {}).items():
        grid, what, unit = _SMOOTH[name]
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
    return {name: dataset[f"smooth_{name}"].values for name in _SMOOTH}


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


def rules(layout: Layout, *, smooth: bool) -> dict[str, Rule]:
    """Rules for the variables of a dataset, which has the films of smooth surfaces too or not."""
    found = {
        name: Rule(
            dims,
            "increasing" if name in layout.coordinates else _VALUES.get(name, "finite"),
            unit,
            needed=name not in _NOT_ALWAYS,
        )
        for table in (layout.film, layout.field)
        for name, (_, dims, _, unit) in table.items()
    }
    found |= {name: Rule(("step",), "not negative", "1") for name in _HISTORY}
    found |= heat.heated_rules(layout.film_grid)
    found |= {f"roughness_{k}": Rule(layout.film_grid, unit="m") for k in (1, 2)}
    for name, (grid, _, unit) in _SMOOTH.items() if smooth else ():
        found[f"smooth_{name}"] = Rule(getattr(layout, grid), _VALUES.get(name, "finite"), unit)
    return found


def check(layout: Layout, dataset: xr.Dataset) -> None:
    """Check the content of a file before any of it is used.

    Raises
    ------
    UnfitError
        Where a variable or an attribute is missing, or is not as ``dataset_of`` makes it.
    """
    grids = dict.fromkeys((*layout.film_grid, *layout.field_grid, "s"), 2)
    check_variables(dataset, rules(layout, smooth="smooth_pressure" in dataset), grids | {"step": 0})
    for name, numbers in (("film", layout.film_numbers), ("field", layout.field_numbers)):
        columns = {key: _NUMBERS[key] for key in numbers if key in _NUMBERS}
        others = dict.fromkeys(numbers, is_number_or_null)
        json_of(dataset.attrs, name, partial(is_table, columns=columns, others=others))
    _check_field(layout, dataset)
    heat.check_heated(dataset)
    json_of(dataset.attrs, "seconds", partial(is_list, right=_is_time))
    json_of(dataset.attrs, "rough", partial(is_list, right=lambda item: isinstance(item, dict)))
    if "coarser" in dataset.attrs:
        shares = {each.name: partial(is_number, values="not negative") for each in fields(Coarser)}
        json_of(dataset.attrs, "coarser", partial(is_table, columns=shares))
    check_starvation(dataset.attrs)
    check_warnings(dataset.attrs)
    if "laws" in dataset.attrs:
        json_of(dataset.attrs, "laws", is_laws)
    for name in ("version", "date", "film_solver", "field_solver"):
        text_of(dataset.attrs, name)


def _check_field(layout: Layout, dataset: xr.Dataset) -> None:
    """Check that the field is that of its voltage and its gap, and its strength that of its components."""
    heights = dataset[layout.coordinates[-1]].values
    components = [dataset[name].values for name in ("field_x", "field_y", "field_z") if name in layout.field]
    voltage = json.loads(dataset.attrs["field"])["voltage"]
    across = dataset["thin_gap_strength"].values * (heights[..., -1] - heights[..., 0])
    for name, found, expected in (
        ("thin_gap_strength", across, voltage),
        ("strength", dataset["strength"].values, np.sqrt(sum(part**2 for part in components))),
    ):
        if not np.allclose(found, expected, rtol=_ROUNDING, atol=0.0):
            raise UnfitError(f"{name} does not belong to the field")


def film_parts(layout: Layout, dataset: xr.Dataset) -> dict[str, Any]:
    """Arguments of the class of the film, read from a dataset, without the scales of the film."""
    arrays: dict[str, Any] = dict(_arrays(dataset, layout.film))
    arrays["cavitated"] = arrays["cavitated"].astype(bool)
    arrays |= {"starvation": starvation_of(dataset.attrs), "heated": heat.heated_of(dataset)}
    history = zip(*(dataset[name].values for name in _HISTORY), strict=True)
    steps = tuple(NewtonStep(int(n), float(residual), int(krylov)) for n, residual, krylov in history)
    return {**arrays, **json.loads(dataset.attrs["film"]), "steps": steps}


def field_parts(layout: Layout, dataset: xr.Dataset) -> dict[str, Any]:
    """Arguments of the class of the field, read from a dataset."""
    return {**dict(_arrays(dataset, layout.field)), **json.loads(dataset.attrs["field"])}


def _arrays(dataset: xr.Dataset, table: Variables) -> Iterator[tuple[str, Any]]:
    for name, (attribute, *_) in table.items():
        if name in dataset:
            yield attribute, dataset[name].values
