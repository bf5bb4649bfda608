"""Content of drive.nc: rules for its variables and attributes, which hold before any of them is used."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.drive.discharges.record import COLUMNS, KEPT
from ehlectric.runtime.checks.schema import (
    Rule,
    UnfitError,
    check_variables,
    is_list,
    is_table,
    is_text,
    json_of,
    number_of,
    text_of,
)
from ehlectric.runtime.stored_warnings import CODES_OF_TEXTS, TEXTS

if TYPE_CHECKING:
    import xarray as xr

# The drive as it is comes first along this dimension, and its remedies follow.
VARIANT, END = "variant", "bearing"
_BOTH = (VARIANT, END)

# Columns of an event in the order of a record: name of the variable, what its values are, and unit.
EVENTS = {
    "event_begin": ("finite", "s"),
    "event_end": ("finite", "s"),
    "event_bearing": ("0 or 1", ""),
    "event_voltage": ("finite", "V"),
    "event_charge": ("finite", "C"),
    "event_energy": ("not negative", "J"),
    "event_peak_current": ("not negative", "A"),
    "event_position": ("whole", ""),
}
assert len(EVENTS) == COLUMNS

# Numbers of an element of the circuit, by the name of the field.
ELEMENTS = {
    "conductance": ("not negative", "S"),
    "shape": ("positive or infinite", ""),
    "step": ("positive", "s"),
    "touching": ("not negative", ""),
    "touch_resistance": ("positive or infinite", "ohm"),
    "hertz_area": ("not negative", "m**2"),
    "largest_area": ("not negative", "m**2"),
    "transit": ("positive", "s"),
    "real_area": ("not negative", "m**2"),
}

# Variables that files of earlier versions lack; their values are zero there, and they have no spectrum.
LATER = ("element_real_area", "touching_voltage", "line_count")

# Numbers of what lies beside the films; a breakdown voltage that a coating does not have is NaN.
PATHS = {
    "coating": ("positive or infinite", "F"),
    "parallel": ("not negative", "F"),
    "resistance": ("positive or infinite", "ohm"),
    "coating_breakdown": ("finite or NaN", "V"),
}

# Variables of the trace.
SAMPLES = ("sample_time", "sample_source", "sample_voltage")

# Events, rows of the trace and lines of the spectrum of all variants follow each other; these are their
# numbers.
COUNTS = {
    "event": "event_count",
    "sample": "sample_count",
    "line": "line_count",
    "position": "position_count",
}

RULES = {
    **{name: Rule(("event",), values, unit, needed=False) for name, (values, unit) in EVENTS.items()},
    **{
        f"element_{name}": Rule(_BOTH, values, unit, needed=f"element_{name}" not in LATER)
        for name, (values, unit) in ELEMENTS.items()
    },
    **{f"path_{name}": Rule(_BOTH, values, unit) for name, (values, unit) in PATHS.items()},
    "position_capacitance": Rule(("position",), "positive", "F"),
    "position_breakdown": Rule(("position",), "positive or infinite", "V"),
    "position_count": Rule(_BOTH, "whole"),
    "event_count": Rule((VARIANT,), "whole"),
    "sample_count": Rule((VARIANT,), "whole"),
    "sample_time": Rule(("sample",), "finite", "s", needed=False),
    "sample_source": Rule(("sample",), "finite", "V", needed=False),
    "sample_voltage": Rule(("sample", END), "finite", "V", needed=False),
    "line_count": Rule((VARIANT,), "whole", needed=False),
    "line_amplitude": Rule(("line",), "not negative", "V", needed=False),
    "duration": Rule((VARIANT,), "positive", "s"),
    "highest_source": Rule((VARIANT,), "not negative", "V"),
    "divider": Rule(_BOTH, "not negative", ""),
    "converged": Rule((VARIANT,), "0 or 1"),
    "block_events": Rule((*_BOTH, "block"), "whole"),
    "event_sum": Rule((*_BOTH, "column"), "not negative"),
    "event_largest": Rule((*_BOTH, "column"), "not negative"),
    "voltage_edge": Rule((VARIANT, "edge"), "finite", "V"),
    "time_at_voltage": Rule((*_BOTH, "bin"), "not negative", "s"),
    "limit": Rule(("limit",), "increasing", "V"),
    "time_above": Rule((*_BOTH, "limit"), "not negative", "s"),
    "peak_voltage": Rule(_BOTH, "not negative", "V"),
    "rms_voltage": Rule(_BOTH, "not negative", "V"),
    "burning_time": Rule(_BOTH, "not negative", "s"),
    "touching_voltage": Rule(_BOTH, "not negative", "V", needed=False),
}


def check(dataset: xr.Dataset, variants: int) -> None:
    """Check the content of a drive.nc before any of it is used.

    Parameters
    ----------
    dataset : xarray.Dataset
        Content of the file.
    variants : int
        Number of the drive and its remedies.

    Raises
    ------
    UnfitError
        Where a variable or an attribute is missing, or is not as it was written.
    """
    check_variables(dataset, RULES)
    sizes = dataset.sizes
    expected = {VARIANT: variants, END: 2, "column": COLUMNS, "edge": sizes["bin"] + 1}
    for name, size in expected.items():
        if sizes[name] != size:
            raise UnfitError(f"it has {sizes[name]} values along {name}, not {size}")
    if np.any(np.diff(dataset["voltage_edge"].values, axis=1) <= 0.0):
        raise UnfitError("voltage_edge is not increasing")
    for dimension, counts in COUNTS.items():
        if (int(np.sum(dataset[counts].values)) if counts in dataset else 0) != sizes.get(dimension, 0):
            raise UnfitError(f"{counts} is not the number of values along {dimension}")
    if np.any(dataset["position_count"].values < 1):
        raise UnfitError("position_count is not positive")
    for dimension, names in (("event", tuple(EVENTS)), ("sample", SAMPLES)):
        for name in names if dimension in sizes else ():
            if name not in dataset:
                raise UnfitError(f"{name} is missing")
    _check_events(dataset)
    number_of(dataset.attrs, "seconds")
    text_of(dataset.attrs, "version")
    json_of(dataset.attrs, TEXTS, partial(_are_warnings, variants=variants))


def _check_events(dataset: xr.Dataset) -> None:
    """Check that the events one by one are among those that are counted."""
    counted = np.sum(dataset["block_events"].values, axis=-1)
    kept = np.asarray(dataset["event_count"].values, dtype=int)
    films = dataset["event_bearing"].values if "event_bearing" in dataset else np.zeros(0)
    for total, own in zip(counted, np.split(films.astype(int), np.cumsum(kept)[:-1]), strict=True):
        numbers = np.bincount(own, minlength=2)
        if np.any(numbers > total) or (own.size < KEPT and np.any(numbers != total)):
            raise UnfitError("event_bearing does not belong to block_events")


def _are_warnings(value: Any, variants: int) -> bool:
    """Whether a value of JSON holds the warnings of each variant."""
    texts = partial(is_list, right=is_text)
    each = partial(is_table, columns={TEXTS: texts}, others={CODES_OF_TEXTS: texts})
    return is_list(value, each) and len(value) == variants
