"""Film and field as variables of a dataset and back: names, dimensions, long names and units."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.field import Field
from ehlectric.film import Film
from ehlectric.nested import Scales
from ehlectric.newton import NewtonStep
from ehlectric.typing import Array

if TYPE_CHECKING:
    import xarray as xr

# Name in the file: (attribute of the film or field, dimensions, long name, unit).
_FILM = {
    "x": ("x", ("x",), "position along entrainment", "m"),
    "pressure": ("pressure", ("x",), "pressure", "Pa"),
    "thickness": ("thickness", ("x",), "film thickness", "m"),
    "density": ("density", ("x",), "density over that at zero pressure", "1"),
    "deflection": (
        "deflection",
        ("x",),
        "gap opened by the pressure, up to a rigid displacement",
        "m",
    ),
    "reynolds_residual": (
        "reynolds_residual",
        ("x",),
        "residual of the Reynolds equation in units of p/p_h",
        "1",
    ),
    "cavitated": ("cavitated", ("x",), "pressure held at ambient", "1"),
}
_FIELD = {
    "x_field": ("x", ("x_field",), "position along entrainment, columns of the field", "m"),
    "s": ("s", ("s",), "fraction of the gap, from surface 1 to surface 2", "1"),
    "y": ("y", ("x_field", "s"), "height", "m"),
    "permittivity": ("permittivity", ("x_field", "s"), "relative permittivity", "1"),
    "potential": ("potential", ("x_field", "s"), "electric potential", "V"),
    "field_x": ("field_x", ("x_field", "s"), "electric field along x", "V/m"),
    "field_y": ("field_y", ("x_field", "s"), "electric field along y", "V/m"),
    "strength": ("strength", ("x_field", "s"), "electric field strength", "V/m"),
    "middle_strength": (
        "middle_strength",
        ("x_field",),
        "electric field strength at mid-film",
        "V/m",
    ),
    "thin_gap_strength": (
        "thin_gap_strength",
        ("x_field",),
        "voltage over film thickness",
        "V/m",
    ),
}
_HISTORY = {
    "step_nodes": ("nodes", "nodes of the grid of a Newton step"),
    "step_residual": ("residual", "scaled residual before a Newton step"),
    "step_krylov_iterations": ("krylov_iterations", "GMRES iterations of a Newton step"),
}
_FILM_NUMBERS = (
    "status",
    "residual",
    "load_residual",
    "newton_iterations",
    "discretisation_error",
    "inlet_deficit",
)
_FIELD_NUMBERS = ("voltage", "capacitance", "capacitance_by_charge", "thin_gap_capacitance")


def variables(film: Film, field: Field) -> dict[str, Any]:
    """All arrays, as xarray takes them: dimensions, values, and long name and unit."""
    named: dict[str, Any] = {}
    for part, table in ((film, _FILM), (field, _FIELD)):
        for name, (attribute, dimensions, long_name, unit) in table.items():
            values = np.asarray(getattr(part, attribute))
            values = values.astype(np.int8) if values.dtype == bool else values
            named[name] = (dimensions, values, {"long_name": long_name, "units": unit})
    for name, (attribute, long_name) in _HISTORY.items():
        values = np.array([getattr(step, attribute) for step in film.steps])
        named[name] = ("step", values, {"long_name": long_name, "units": "1"})
    return named


def roughness_variables(roughness: Array) -> dict[str, Any]:
    """Heights of both surfaces over x."""
    return {
        f"roughness_{k}": (
            "x",
            heights,
            {"long_name": f"roughness of surface {k}, out of the body", "units": "m"},
        )
        for k, heights in enumerate(roughness, 1)
    }


def smooth_variables(*, pressure: Array, thickness: Array, middle_strength: Array) -> dict[str, Any]:
    """The same contact with smooth surfaces."""
    what = "of smooth surfaces"
    return {
        "smooth_pressure": ("x", pressure, {"long_name": f"pressure {what}", "units": "Pa"}),
        "smooth_thickness": ("x", thickness, {"long_name": f"film thickness {what}", "units": "m"}),
        "smooth_middle_strength": (
            "x_field",
            middle_strength,
            {"long_name": f"electric field strength at mid-film {what}", "units": "V/m"},
        ),
    }


def smooth_of(dataset: xr.Dataset) -> dict[str, Array] | None:
    """Arrays of the smooth contact, where there is one."""
    if "smooth_pressure" not in dataset:
        return None
    return {name: dataset[f"smooth_{name}"].values for name in ("pressure", "thickness", "middle_strength")}


def roughness_of(dataset: xr.Dataset) -> Array:
    """The roughness a dataset was made of."""
    return np.stack([dataset["roughness_1"].values, dataset["roughness_2"].values])


COORDINATES = ("x", "x_field", "s", "y")


def attributes(film: Film, field: Field) -> dict[str, str]:
    """What is no array, as JSON."""
    return {
        "film": json.dumps({name: getattr(film, name) for name in _FILM_NUMBERS}),
        "field": json.dumps({name: getattr(field, name) for name in _FIELD_NUMBERS}),
    }


def film_of(dataset: xr.Dataset, scales: Scales) -> Film:
    """The film a dataset was made of."""
    arrays: dict[str, Any] = dict(_arrays(dataset, _FILM))
    arrays["cavitated"] = arrays["cavitated"].astype(bool)
    history = zip(*(dataset[name].values for name in _HISTORY), strict=True)
    steps = tuple(NewtonStep(int(n), float(residual), int(krylov)) for n, residual, krylov in history)
    return Film(**arrays, **json.loads(dataset.attrs["film"]), scales=scales, steps=steps)


def field_of(dataset: xr.Dataset) -> Field:
    """The field a dataset was made of."""
    arrays: dict[str, Any] = dict(_arrays(dataset, _FIELD))
    return Field(**arrays, **json.loads(dataset.attrs["field"]))


def _arrays(dataset: xr.Dataset, table: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    for name, (attribute, *_) in table.items():
        yield attribute, dataset[name].values
