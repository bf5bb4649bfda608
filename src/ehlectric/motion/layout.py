"""Variables of the file of a transient run: names and units, how they are created, and how they grow."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.motion.asperities import AREA_SHARE, COARSE_SHARE, LOAD_SHARE, SPOTS
from ehlectric.motion.kinds import AnyKind

# Variables by name, each with its long name and unit: over all time steps, over the recorded instants, and
# maps at the recorded instants.
_STEPS = {
    "time": ("time since the roughness began to enter", "s"),
    "minimum_thickness": ("minimum film thickness", "m"),
    "minimum_x": ("position of the minimum film thickness, along entrainment", "m"),
    "minimum_y": ("position of the minimum film thickness, across entrainment", "m"),
    "lowest_thickness": ("minimum film thickness between the nodes", "m"),
    "central_thickness": ("film thickness at the centre of the contact", "m"),
    "coarse_lowest_thickness": (
        "minimum film thickness between the nodes of the companion, NaN between its steps",
        "m",
    ),
    "coarse_central_thickness": ("film thickness at the centre of the companion, NaN between its steps", "m"),
    "max_pressure": ("maximum pressure", "Pa"),
    "thin_gap_strength": ("voltage / minimum film thickness", "V/m"),
    "newton_iterations": ("Newton steps of a time step", "1"),
    "krylov_iterations": ("GMRES iterations of a time step", "1"),
    "halvings": ("number of halvings of a time step", "1"),
}
_FRAMES = {
    "frame_time": ("time since the roughness began to enter", "s"),
    "frame_step": ("number of the time step", "1"),
    "max_strength": ("maximum field strength", "V/m"),
    "max_strength_x": ("position of the maximum field strength, along entrainment", "m"),
    "max_strength_y": ("position of the maximum field strength, across entrainment", "m"),
    "capacitance": ("capacitance within the field range", "F/m or F"),
    "max_strength_error": ("estimated relative error of the maximum field strength, NaN if unknown", "1"),
}
_MAPS = {
    "pressure": ("pressure", "Pa"),
    "thickness": ("film thickness", "m"),
    "strength": ("maximum field strength across the film", "V/m"),
    "roughness_1": ("roughness of surface 1, out of the body", "m"),
    "roughness_2": ("roughness of surface 2, out of the body", "m"),
    "cavitated": ("cavitated: pressure at ambient", "1"),
}
# Variables over the time steps that only runs have whose surfaces touch.
_TOUCHES = {
    LOAD_SHARE: ("part of the load that asperities carry", "1"),
    AREA_SHARE: ("part of the Hertz zone in which the surfaces touch", "1"),
    SPOTS: ("number of spots in which the surfaces touch", "1"),
    COARSE_SHARE: ("part of the load that asperities carry in the companion, NaN between its steps", "1"),
}
# Variables that only runs with a supply of oil have: over the time steps, and maps where it is starved.
MENISCUS = "meniscus"
_SUPPLIED = {MENISCUS: ("position on the centre line from which oil fills the gap, NaN if flooded", "m")}
_CONTENT = {"film_fraction": ("part of the gap that oil fills", "1")}
# Variables that a line contact does not have.
_OF_POINTS = ("minimum_y", "max_strength_y")

# Steps or instants in a chunk of the file.
_CHUNK = 1024


def lay_out(
    file: Any, positions: Mapping[str, Array], stationary: Mapping[str, Array], kind: AnyKind
) -> None:
    """Create dimensions and variables; write the nodes and the maps of stationary roughness.

    Parameters
    ----------
    file : h5netcdf.File
        New file.
    positions : mapping of str to ndarray
        Nodes along each axis [m].
    stationary : mapping of str to ndarray
        Maps of film and field with stationary roughness, by names such as ``pressure``.
    kind : Kind
        Line or point contact.
    """
    axes = tuple(positions)
    file.dimensions = {"step": None, "frame": None} | {name: positions[name].size for name in axes}
    for name, values in positions.items():
        direction = "along" if name == "x" else "across"
        _add(file, name, (name,), (f"position {direction} entrainment", "m"), values)
    for table, dimension in ((_STEPS, "step"), (_FRAMES, "frame")):
        for name, (long_name, unit) in table.items():
            if len(axes) > 1 or name not in _OF_POINTS:
                unit = kind.capacitance_unit if name == "capacitance" else unit
                _add(file, name, (dimension,), (long_name, unit))
    for name, about in _MAPS.items():
        _add(file, name, ("frame", *axes), about)
    for name, values in stationary.items():
        long_name, unit = _MAPS[name]
        _add(file, f"stationary_{name}", axes, (f"{long_name}, stationary roughness", unit), values)


def lay_out_supplied(file: Any, axes: Sequence[str], *, starved: bool) -> None:
    """Create the variables of a run with a supply of oil; with the content of the gap if it is ``starved``.

    Parameters
    ----------
    file : h5netcdf.File
        File with the variables of ``lay_out``.
    axes : sequence of str
        Names of the axes.
    starved : bool
        Whether the film has parts that oil does not fill.
    """
    for name, about in _SUPPLIED.items():
        _add(file, name, ("step",), about)
    if starved:
        for name, about in _CONTENT.items():
            _add(file, name, ("frame", *axes), about)


def _add(
    file: Any,
    name: str,
    dimensions: Sequence[str],
    about: tuple[str, str],
    values: Array | None = None,
) -> None:
    """Create a variable; ``about`` has its long name and its unit."""
    storage: dict[str, Any] = {}
    kind = "f8"
    if dimensions[0] == "frame" and len(dimensions) > 1:
        kind = "i1" if name == "cavitated" else "f4"
        shape = tuple(file.dimensions[d].size for d in dimensions[1:])
        storage = {"chunks": (1, *shape), "compression": "gzip", "compression_opts": 1, "shuffle": True}
    elif dimensions[0] in ("step", "frame"):
        storage = {"chunks": (_CHUNK,)}
    variable = file.create_variable(name, tuple(dimensions), kind, data=values, **storage)
    variable.attrs["long_name"], variable.attrs["units"] = about


def add_touches(file: Any, before: int) -> None:
    """Create the variables of asperities where a file has none.

    Parameters
    ----------
    file : h5netcdf.File
        File of a run whose surfaces begin to touch.
    before : int
        Number of the steps before, which have no spots.
    """
    if SPOTS in file.variables:
        return
    for name, about in _TOUCHES.items():
        _add(file, name, ("step",), about)
        file.variables[name][:before] = 0.0
    # The companion had no spots either where it had a film.
    missing = np.isnan(file.variables["coarse_lowest_thickness"][:before])
    file.variables[COARSE_SHARE][:before] = np.where(missing, math.nan, 0.0)


def resized(file: Any, steps: int, frames: int) -> tuple[dict[str, Any], dict[str, Any]]:
    """Make room for numbers of time steps and of recorded instants.

    Parameters
    ----------
    file : h5py.File
        File of a run, open for writing.
    steps, frames : int
        Numbers of time steps and of recorded instants that the file will have.

    Returns
    -------
    over_steps, over_frames : dict of str to h5py.Dataset
        Variables over the time steps, and variables over the recorded instants, by their names.
    """
    over_steps: dict[str, Any] = {}
    over_frames: dict[str, Any] = {}
    for name, variable in file.items():
        # Dimensions are stored as variables; groups have no shape.
        if getattr(variable, "maxshape", (0,))[0] is None:
            is_step = name in _STEPS or name in _TOUCHES or name in _SUPPLIED
            variable.resize(steps if is_step or name == "step" else frames, axis=0)
            if name not in ("step", "frame"):
                (over_steps if is_step else over_frames)[name] = variable
    return over_steps, over_frames
