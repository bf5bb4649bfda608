"""A result as an xarray dataset and back: names, units and what goes where in the NetCDF file."""

from __future__ import annotations

import json
import tomllib
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.case import Case
from ehlectric.conditions import resolve
from ehlectric.errors import InputError
from ehlectric.field import Field
from ehlectric.film import Film, Scales
from ehlectric.newton import NewtonStep
from ehlectric.typing import Array

if TYPE_CHECKING:
    import xarray as xr

    from ehlectric.result import Result

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
    "residual",
    "load_residual",
    "newton_iterations",
    "discretisation_error",
    "inlet_deficit",
)
_FIELD_NUMBERS = ("voltage", "capacitance", "capacitance_by_charge", "thin_gap_capacitance")


def to_dataset(result: Result) -> xr.Dataset:
    """All arrays of a result with long names and units; the rest as attributes.

    Attributes that are no plain text or number are TOML (``case``) or JSON (``summary``, ``film``,
    ``field``).
    """
    import xarray as xr

    variables: dict[str, Any] = {}
    for part, table in ((result.film, _FILM), (result.field, _FIELD)):
        for name, (attribute, dimensions, long_name, unit) in table.items():
            values = np.asarray(getattr(part, attribute))
            values = values.astype(np.int8) if values.dtype == bool else values
            variables[name] = (dimensions, values, {"long_name": long_name, "units": unit})
    for name, (attribute, long_name) in _HISTORY.items():
        values = np.array([getattr(step, attribute) for step in result.film.steps])
        variables[name] = ("step", values, {"long_name": long_name, "units": "1"})
    summary = result.summary()
    film = {"status": result.film.status} | _numbers(result.film, _FILM_NUMBERS)
    return xr.Dataset(
        variables,
        attrs={
            "Conventions": "CF-1.11",
            "title": result.case.title or "Film and electric field of a line contact",
            "source": f"ehlectric {result.version}",
            "history": f"{result.date} solved by ehlectric {result.version}",
            "version": result.version,
            "date": result.date,
            "converged": int(result.converged),
            "case": result.case.to_toml(),
            "summary": json.dumps(summary),
            "film": json.dumps(film),
            "field": json.dumps(_numbers(result.field, _FIELD_NUMBERS)),
            "warnings": json.dumps(result.warnings),
            "seconds": json.dumps([result.film_seconds, result.field_seconds]),
        },
    ).set_coords(["x", "x_field", "s", "y"])


def _numbers(part: Film | Field, names: tuple[str, ...]) -> dict[str, Any]:
    return {name: getattr(part, name) for name in names}


def from_dataset(dataset: xr.Dataset) -> Result:
    """The result a dataset was made of.

    Raises
    ------
    InputError
        Where the dataset is not one of these.
    """
    from ehlectric.result import Result

    try:
        case = Case.from_dict(tomllib.loads(dataset.attrs["case"]))
        conditions = resolve(case)
        film = Film(
            **_arrays(dataset, _FILM),
            **json.loads(dataset.attrs["film"]),
            scales=Scales(
                conditions.half_width, conditions.max_pressure, conditions.thickness_scale
            ),
            steps=tuple(
                NewtonStep(int(nodes), float(residual), int(krylov))
                for nodes, residual, krylov in zip(
                    *(dataset[name].values for name in _HISTORY), strict=True
                )
            ),
        )
        field = Field(**_arrays(dataset, _FIELD), **json.loads(dataset.attrs["field"]))
        film_seconds, field_seconds = json.loads(dataset.attrs["seconds"])
        return Result(
            case=case,
            conditions=conditions,
            film=film,
            field=field,
            warnings=tuple(json.loads(dataset.attrs["warnings"])),
            film_seconds=film_seconds,
            field_seconds=field_seconds,
            version=str(dataset.attrs["version"]),
            date=str(dataset.attrs["date"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"it is not a result of ehlectric, {error}") from None


def _arrays(dataset: xr.Dataset, table: dict[str, Any]) -> dict[str, Array]:
    arrays = {entry[0]: dataset[name].values for name, entry in table.items()}
    if "cavitated" in arrays:
        arrays["cavitated"] = arrays["cavitated"].astype(bool)
    return arrays
