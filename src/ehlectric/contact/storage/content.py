"""Checks of the content of a contact's result file before any of it is used."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import fields
from functools import partial
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from ehlectric.contact.heat import files as heat
from ehlectric.contact.spots.mechanics import Coarser
from ehlectric.contact.starved.stored import check_starvation
from ehlectric.contact.storage.layouts import HISTORY, SMOOTH, Layout
from ehlectric.film.state import Status
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

if TYPE_CHECKING:
    import xarray as xr


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
    found |= {name: Rule(("step",), "not negative", "1") for name in HISTORY}
    found |= heat.heated_rules(layout.film_grid)
    found |= {f"roughness_{k}": Rule(layout.film_grid, unit="m") for k in (1, 2)}
    for name, (grid, _, unit) in SMOOTH.items() if smooth else ():
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
