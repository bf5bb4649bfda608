"""Names, dimensions and units of the arrays of each kind of contact in a dataset."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

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
    "mass_residual",
    "load_deficit",
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

HISTORY = {
    "step_nodes": ("nodes", "nodes of the grid of a Newton step"),
    "step_residual": ("residual", "scaled residual before a Newton step"),
    "step_krylov_iterations": ("krylov_iterations", "GMRES iterations of a Newton step"),
}
SMOOTH = {
    "pressure": ("film_grid", "pressure", "Pa"),
    "thickness": ("film_grid", "film thickness", "m"),
    "middle_strength": ("field_grid", "electric field strength at mid-film", "V/m"),
}
