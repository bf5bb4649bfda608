"""Content of motion.nc: rules for its variables and attributes, which hold before any of them is used."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.motion.kinds import KINDS
from ehlectric.runtime.checks.schema import (
    Rule,
    UnfitError,
    case_of,
    check_variables,
    check_warnings,
    is_list,
    is_number,
    is_number_or_null,
    is_table,
    json_of,
    number_of,
    text_of,
)

if TYPE_CHECKING:
    import xarray as xr

# Format of the file, which tells its kind and its version.
SCHEMA = "ehlectric.motion.run/1"

# Variables over time steps, over recorded instants, and maps of them: what their values are, and their units.
# Those of an axis that the contact does not have are left out.
_STEPS = {
    "time": ("increasing", "s"),
    "minimum_thickness": ("positive", "m"),
    "minimum_x": ("finite", "m"),
    "minimum_y": ("finite", "m"),
    "max_pressure": ("not negative", "Pa"),
    "thin_gap_strength": ("positive", "V/m"),
    "newton_iterations": ("whole", "1"),
    "krylov_iterations": ("whole", "1"),
    "halvings": ("whole", "1"),
}
_KEY_FILMS = {
    "lowest_thickness": "finite",
    "central_thickness": "positive",
    "coarse_lowest_thickness": "finite or NaN",
    "coarse_central_thickness": "not negative or NaN",
}
# Variables over the time steps of runs whose surfaces touch.
_TOUCHES = {
    "asperity_load_share": "not negative",
    "contact_area_share": "not negative",
    "spots": "whole",
    "coarse_asperity_load_share": "not negative or NaN",
}
# Variables of runs with a supply of oil: over the time steps, and maps.
_SUPPLIED = {"meniscus": ("finite or NaN", "m")}
_CONTENT = {"film_fraction": ("not negative", "1")}
_FRAMES = {
    "frame_time": ("increasing", "s"),
    "frame_step": ("increasing", "1"),
    "max_strength": ("positive", "V/m"),
    "max_strength_x": ("finite", "m"),
    "max_strength_y": ("finite", "m"),
    "capacitance": ("positive", None),
}
_MAPS = {
    "pressure": ("not negative", "Pa"),
    "thickness": ("positive", "m"),
    "strength": ("not negative or NaN", "V/m"),  # NaN beyond the range of the field
}
_OTHER_MAPS = {
    "roughness_1": ("finite", "m"),
    "roughness_2": ("finite", "m"),
    "cavitated": ("0 or 1", "1"),
}

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

    Raises
    ------
    UnfitError
        Where a variable or an attribute is missing, or is not as a run writes it.
    """
    attributes = dataset.attrs
    case = case_of(attributes, Case.from_dict)
    axes = KINDS[case.contact.geometry].axes
    check_variables(dataset, {"frame_step": Rule(("frame",), "finite or NaN", "1")})
    frames = number_of(attributes, "frames", "whole")
    recorded = dataset["frame_step"].values[: int(frames)]
    if not 1 <= frames == recorded.size:
        raise UnfitError(f"it has {dataset.sizes['frame']} of {frames:.0f} recorded instants")
    steps = dataset.sizes.get("step", 0)
    if not (recorded[0] == 0.0 and recorded[-1] < steps and np.all(recorded == np.floor(recorded))):
        raise UnfitError("frame_step is not the numbers of time steps")
    part = dataset.isel(frame=slice(0, int(frames)), step=slice(0, int(recorded[-1]) + 1))
    check_variables(part, _rules(axes, stationary="stationary_thickness" in dataset), dict.fromkeys(axes, 2))
    maps = part["strength"].values.reshape(int(frames), -1)
    if not np.all(np.any(np.isfinite(maps), axis=1)):
        raise UnfitError("strength has no value at an instant")
    _check_attributes(attributes)
    return part


def _rules(axes: tuple[str, ...], *, stationary: bool) -> dict[str, Rule]:
    """Rules for the variables of a contact with these axes, with stationary roughness or not."""
    lacking = () if len(axes) > 1 else ("minimum_y", "max_strength_y")
    found = {axis: Rule((axis,), "increasing", "m") for axis in axes}
    tables = ((_STEPS, ("step",)), (_FRAMES, ("frame",)), (_MAPS | _OTHER_MAPS, ("frame", *axes)))
    for table, dims in tables:
        found |= {name: Rule(dims, *what) for name, what in table.items() if name not in lacking}
    if stationary:
        found |= {f"stationary_{name}": Rule(axes, *what) for name, what in _MAPS.items()}
    # Runs of earlier versions have no estimate of errors.
    found |= {name: Rule(("step",), values, "m", needed=False) for name, values in _KEY_FILMS.items()}
    found |= {name: Rule(("step",), values, "1", needed=False) for name, values in _TOUCHES.items()}
    found |= {name: Rule(("step",), *what, needed=False) for name, what in _SUPPLIED.items()}
    found |= {name: Rule(("frame", *axes), *what, needed=False) for name, what in _CONTENT.items()}
    found["max_strength_error"] = Rule(("frame",), "not negative or NaN", "1", needed=False)
    return found


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
    check_warnings(attributes)
