"""Stored form of a transient run, motion.nc: its variables, how they grow, and the checks of its content."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.motion.moving_contact import KINDS, Kind
from ehlectric.quantities.field_metadata import Stored, stored
from ehlectric.runtime.file_rules import (
    Rule,
    UnfitError,
    case_of,
    check_variables,
    is_list,
    is_number,
    is_number_or_null,
    is_table,
    json_of,
    number_of,
    text_of,
)
from ehlectric.runtime.stored import Part, check_parts, warnings_in

if TYPE_CHECKING:
    import xarray as xr

# Format of the file, which tells its kind and its version.
SCHEMA = "ehlectric.motion.run/1"

# Variables over the time steps that a file has from the first recorded instant on at whose steps surfaces
# touch, in the order of ``TimeStep``.
LOAD_SHARE, AREA_SHARE, SPOTS = "asperity_load_share", "contact_area_share", "spots"
COARSE_SHARE = "coarse_asperity_load_share"
TOUCHING = (LOAD_SHARE, AREA_SHARE, SPOTS, COARSE_SHARE)

# Steps or instants in a chunk of the file.
_CHUNK = 1024

_SINCE = "time since the roughness began to enter"
_LEAST, _STRONGEST = "position of the minimum film thickness", "position of the maximum field strength"
_ALONG, _ACROSS = "along entrainment", "across entrainment"
_OF_COMPANION, _IN_COMPANION = (f"{word} the companion, NaN between its steps" for word in ("of", "in"))
_BETWEEN = "minimum film thickness between the nodes"
_CENTRAL = "film thickness at the centre"
_CARRIED = "part of the load that asperities carry"
_TOUCHED = "part of the Hertz zone in which the surfaces touch"
_SPOTS = "number of spots in which the surfaces touch"
_MENISCUS = "position on the centre line from which oil fills the gap, NaN if flooded"
_FILLED = "part of the gap that oil fills"
_WARM = "largest temperature at mid-film above that of the oil in the inlet"
_ERROR = "estimated relative error of the maximum field strength, NaN if unknown"
_HEIGHTS = "roughness of surface {}, out of the body"


@dataclass(frozen=True)
class TimeStep:
    """Values of a time step, SI units; None where the contact or the run has none."""

    time: float = field(metadata=stored("", "s", "increasing", _SINCE))
    minimum_thickness: float = field(metadata=stored("", "m", "positive", "minimum film thickness"))
    minimum_x: float = field(metadata=stored("", "m", "finite", f"{_LEAST}, {_ALONG}"))
    minimum_y: float | None = field(metadata=stored("", "m", "finite", f"{_LEAST}, {_ACROSS}"))
    lowest_thickness: float = field(metadata=stored("", "m", "finite", _BETWEEN))
    central_thickness: float = field(metadata=stored("", "m", "positive", f"{_CENTRAL} of the contact"))
    coarse_lowest_thickness: float = field(
        metadata=stored("", "m", "finite or NaN", f"{_BETWEEN} {_OF_COMPANION}")
    )
    coarse_central_thickness: float = field(
        metadata=stored("", "m", "not negative or NaN", f"{_CENTRAL} {_OF_COMPANION}")
    )
    max_pressure: float = field(metadata=stored("", "Pa", "not negative", "maximum pressure"))
    thin_gap_strength: float = field(
        metadata=stored("", "V/m", "positive", "voltage / minimum film thickness")
    )
    newton_iterations: int = field(metadata=stored("", "1", "whole", "Newton steps of a time step"))
    krylov_iterations: int = field(metadata=stored("", "1", "whole", "GMRES iterations of a time step"))
    halvings: int = field(metadata=stored("", "1", "whole", "number of halvings of a time step"))
    asperity_load_share: float = field(metadata=stored("", "1", "not negative", _CARRIED, needed=False))
    contact_area_share: float = field(metadata=stored("", "1", "not negative", _TOUCHED, needed=False))
    spots: int = field(metadata=stored("", "1", "whole", _SPOTS, needed=False))
    coarse_asperity_load_share: float = field(
        metadata=stored("", "1", "not negative or NaN", f"{_CARRIED} {_IN_COMPANION}", needed=False)
    )
    meniscus: float | None = field(metadata=stored("", "m", "finite or NaN", _MENISCUS, needed=False))
    temperature_rise: float | None = field(metadata=stored("", "K", "finite", _WARM, needed=False))


@dataclass(frozen=True)
class Maps:
    """Film and field over the nodes of the film, SI units; NaN is the strength beyond the field range."""

    pressure: Array = field(metadata=stored("nodes", "Pa", "not negative", "pressure"))
    thickness: Array = field(metadata=stored("nodes", "m", "positive", "film thickness"))
    strength: Array = field(
        metadata=stored("nodes", "V/m", "not negative or NaN", "maximum field strength across the film")
    )


@dataclass(frozen=True)
class Frame(Maps):
    """Values of a recorded instant, SI units; None where the contact or the film has none."""

    roughness_1: Array = field(metadata=stored("nodes", "m", "finite", _HEIGHTS.format(1)))
    roughness_2: Array = field(metadata=stored("nodes", "m", "finite", _HEIGHTS.format(2)))
    cavitated: Mask = field(metadata=stored("nodes", "1", "0 or 1", "cavitated: pressure at ambient"))
    film_fraction: Array | None = field(metadata=stored("nodes", "1", "0 to 1", _FILLED, needed=False))
    temperature: Array | None = field(
        metadata=stored("nodes", "K", "positive", "temperature at mid-film", needed=False)
    )
    frame_time: float = field(metadata=stored("", "s", "increasing", _SINCE))
    frame_step: int = field(metadata=stored("", "1", "increasing", "number of the time step"))
    max_strength: float = field(metadata=stored("", "V/m", "positive", "maximum field strength"))
    max_strength_x: float = field(metadata=stored("", "m", "finite", f"{_STRONGEST}, {_ALONG}"))
    max_strength_y: float | None = field(metadata=stored("", "m", "finite", f"{_STRONGEST}, {_ACROSS}"))
    capacitance: float = field(metadata=stored("", None, "positive", "capacitance within the field range"))
    max_strength_error: float = field(metadata=stored("", "1", "not negative or NaN", _ERROR))


# Variables of which a line contact has none.
_ACROSS_ONLY = ("minimum_y", "max_strength_y")


@dataclass(frozen=True)
class Parts:
    """Parts of the file of a line or of a point contact, and its nodes along each axis."""

    axes: Mapping[str, Stored]
    steps: Part
    frames: Part
    stationary: Part

    @classmethod
    def of(cls, kind: Kind) -> Self:
        """Parts for one kind of contact."""
        axes = {"nodes": kind.axes}
        lacking = {} if len(kind.axes) > 1 else {name: {"needed": False} for name in _ACROSS_ONLY}
        maps = Part(Maps).fields
        return cls(
            axes={
                name: Stored((name,), "m", "increasing", f"position {where}", name)
                for name, where in zip(kind.axes, (_ALONG, _ACROSS), strict=False)
            },
            steps=Part(TimeStep, ("step",), changed=lacking),
            frames=Part(
                Frame, ("frame",), "", axes, lacking | {"capacitance": {"unit": kind.capacitance_unit}}
            ),
            stationary=Part(
                Maps,
                (),
                "stationary_",
                axes,
                {name: {"text": f"{entry.text}, stationary roughness"} for name, entry in maps.items()},
            ),
        )


def lay_out(
    file: Any,
    positions: Mapping[str, Array],
    stationary: Maps | None,
    first: tuple[TimeStep, Frame],
    kind: Kind,
) -> None:
    """Create dimensions and variables in a new ``h5netcdf.File``; write the nodes and the stationary maps.

    Variables that the first step and instant lack are left out, as are those of asperities.
    """
    parts = Parts.of(kind)
    file.dimensions = {"step": None, "frame": None} | {name: at.size for name, at in positions.items()}
    for name, nodes in positions.items():
        _add(file, parts.axes[name], nodes)
    for part, values in zip((parts.steps, parts.frames), first, strict=True):
        for name, entry in part.fields.items():
            if name not in TOUCHING and getattr(values, name) is not None:
                _add(file, entry)
    for name, entry in parts.stationary.fields.items() if stationary is not None else ():
        _add(file, entry, getattr(stationary, name))


def _add(file: Any, entry: Stored, values: Array | None = None) -> None:
    """Create a variable; maps of recorded instants have single precision."""
    storage: dict[str, Any] = {}
    kind = "f8"
    if entry.dims[0] == "frame" and len(entry.dims) > 1:
        kind = "i1" if entry.rule == "0 or 1" else "f4"
        shape = tuple(file.dimensions[d].size for d in entry.dims[1:])
        storage = {"chunks": (1, *shape), "compression": "gzip", "compression_opts": 1, "shuffle": True}
    elif entry.dims[0] in ("step", "frame"):
        storage = {"chunks": (_CHUNK,)}
    variable = file.create_variable(entry.name, entry.dims, kind, data=values, **storage)
    for name, text in entry.attributes.items():
        variable.attrs[name] = text


def add_touches(file: Any, before: int) -> None:
    """Create the variables of asperities in an ``h5netcdf.File`` that has none.

    The steps ``before`` have no spots.
    """
    if SPOTS in file.variables:
        return
    entries = Part(TimeStep, ("step",)).fields
    for name in TOUCHING:
        _add(file, entries[name])
        file.variables[name][:before] = 0.0
    # The companion had no spots either where it had a film.
    missing = np.isnan(file.variables["coarse_lowest_thickness"][:before])
    file.variables[COARSE_SHARE][:before] = np.where(missing, np.nan, 0.0)


def resized(file: Any, steps: int, frames: int) -> tuple[dict[str, Any], dict[str, Any]]:
    """Make room in an ``h5py.File`` for numbers of time steps and of recorded instants.

    The variables over the time steps, and those over the recorded instants, by their names.
    """
    over_steps: dict[str, Any] = {}
    over_frames: dict[str, Any] = {}
    for name, variable in file.items():
        # Dimensions are stored as variables; groups have no shape.
        if getattr(variable, "maxshape", (0,))[0] is None:
            is_step = name in TimeStep.__dataclass_fields__
            variable.resize(steps if is_step or name == "step" else frames, axis=0)
            if is_step:
                over_steps[name] = variable
            elif name in Frame.__dataclass_fields__:
                over_frames[name] = variable
    return over_steps, over_frames


_is_positive = partial(is_number, values="positive")
_STATIONARY: Mapping[str, Callable[[Any], bool]] = {
    "minimum_thickness": _is_positive,
    "minimum_position": lambda value: is_number(value) or is_list(value, is_number),
    "max_pressure": _is_positive,
    "max_strength": _is_positive,
    "capacitance": _is_positive,
}


def solved_part(dataset: xr.Dataset) -> xr.Dataset:
    """Part of the dataset of a file with the solved steps and the recorded instants, after it is checked.
    Raises UnfitError where a variable or an attribute is missing, or is not as a run writes it.
    """
    attributes = dataset.attrs
    kind = KINDS[case_of(attributes, Case.from_dict).contact.geometry]
    check_variables(dataset, {"frame_step": Rule(("frame",), "finite or NaN", "1")})
    frames = number_of(attributes, "frames", "whole")
    recorded = dataset["frame_step"].values[: int(frames)]
    if not 1 <= frames == recorded.size:
        raise UnfitError(f"it has {dataset.sizes['frame']} of {frames:.0f} recorded instants")
    steps = dataset.sizes.get("step", 0)
    if not (recorded[0] == 0.0 and recorded[-1] < steps and np.all(recorded == np.floor(recorded))):
        raise UnfitError("frame_step is not the numbers of time steps")
    part = dataset.isel(frame=slice(0, int(frames)), step=slice(0, int(recorded[-1]) + 1))
    parts = Parts.of(kind)
    rules = {name: Rule(entry.dims, entry.rule, entry.unit) for name, entry in parts.axes.items()}
    stationary = [parts.stationary] if "stationary_thickness" in dataset else []
    check_parts(part, [parts.steps, parts.frames, *stationary], rules, dict.fromkeys(kind.axes, 2))
    maps = part["strength"].values.reshape(int(frames), -1)
    if not np.all(np.any(np.isfinite(maps), axis=1)):
        raise UnfitError("strength has no value at an instant")
    _check_attributes(attributes)
    return part


def _check_attributes(attributes: Mapping[Any, Any]) -> None:
    for name in ("version", "date", "title"):
        text_of(attributes, name)
    number_of(attributes, "seconds")
    number_of(attributes, "complete", "0 or 1")
    for name in ("covered_from", "coincident"):
        if name in attributes:
            number_of(attributes, name, "finite or NaN")
    others = {"discretisation_error": is_number_or_null}
    json_of(
        attributes,
        "stationary",
        lambda value: value is None or is_table(value, columns=_STATIONARY, others=others),
    )
    json_of(attributes, "rough", partial(is_list, right=lambda item: isinstance(item, dict)))
    warnings_in(attributes)
