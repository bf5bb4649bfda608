"""Search for jumps of the numbers of a bearing along one of its inputs.

A change between neighbours is a jump if it does not become smaller as they approach each other. The intervals
with the largest changes, compared with the changes of their neighbours, are divided again and again.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ehlectric import evaluate
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError

# Numbers that must not jump.
NUMBERS = (
    "bearing.capacitance",
    "bearing.capacitance_air",
    "bearing.capacitance_plate",
    "bearing.capacitance_rough",
    "bearing.shaft_capacitance",
    "bearing.meter_capacitance",
    "bearing.lambda_ratio",
    "bearing.inner_lambda_ratio",
    "bearing.outer_lambda_ratio",
    "bearing.film_factor",
    "bearing.first_break",
    "bearing.first_break_mean",
    "bearing.ring_to_ring_breakdown",
    "bearing.shaft_first_break",
    "bearing.margin",
    "bearing.max_strength",
    "bearing.film_voltage",
    "bearing.discharge_energy",
    "mechanics.max_load",
)

# Factors by which inputs with a wide range are divided and multiplied along a search, and all others.
_WIDE = {
    "bearing.radial_load": (20.0, 3.0),
    "bearing.axial_load": (20.0, 3.0),
    "bearing.inner_speed": (10.0, 2.0),
    "bearing.radial_clearance": (10.0, 3.0),
    "bearing.pair.preload": (20.0, 3.0),
    "bearing.pair.axial_clearance": (20.0, 3.0),
    "bearing.composite_rq": (3.0, 1.5),
}
_OTHERS = (1.25, 1.25)

# Parts of a range below and above the value of the file: on both sides, or on one.
_SIDES = ((1.0, 1.0), (1.0, 0.0), (0.0, 1.0))

# Half of the range of temperatures [K], and how often a range is halved until all of its values are allowed.
_WARMER, _HALVED = 45.0, 6

# Parts of an interval, and how often it is divided: down to 1e-7 of its length.
_PARTS, _TIMES = 10, 7

# Intervals of each number that are divided, and part of the least jump from which on they are suspicious.
_CHOSEN, _SUSPICIOUS = 2, 0.25


@dataclass(frozen=True)
class Jump:
    """Relative change of a number within a tiny interval of an input."""

    number: str
    place: float
    width: float  # of the interval, over its place
    change: float


def search(case: BearingCase, key: str, value: float, points: int = 400) -> tuple[float, list[Jump]]:
    """Jumps along an input around its value, and the width of the search as a factor of the widest one.

    The width is smaller than 1 if an input has bounds within the range, and 0 if there is no range. If the
    value of the file is at a bound, the range is on one side of the value.
    """
    for below, above in _SIDES:
        for halved in range(_HALVED + 1):
            part = 0.5**halved
            try:
                return part, jumps_along(case, key, _range(key, value, (part * below, part * above), points))
            except InputError:
                continue
    return 0.0, []


def _range(key: str, value: float, parts: tuple[float, float], points: int) -> np.ndarray:
    """Values of an input around its own value; ``parts`` of the widest range below and above the value."""
    below, above = parts
    if key.endswith("temperature"):
        return value + _WARMER * np.linspace(-below, above, points)
    low, high = _WIDE.get(key, _OTHERS)
    if value < 0.0:
        return -np.geomspace(-value * high**above, -value / low**below, points)
    return np.geomspace(value / low**below, value * high**above, points)


def numbers_at(case: BearingCase, key: str, values: np.ndarray) -> dict[str, np.ndarray]:
    """Numbers of a bearing at values of an input, those that it has, and NaN at points without a result."""
    found = evaluate(case, {key: values})
    return {name: np.asarray(found[name].values, dtype=float) for name in NUMBERS if name in found}


def _changes(values: np.ndarray) -> np.ndarray:
    """Relative changes between neighbours; 0 if one of them has no value."""
    low, high = np.minimum(values[..., :-1], values[..., 1:]), np.maximum(values[..., :-1], values[..., 1:])
    known = np.isfinite(low) & np.isfinite(high) & (low > 0.0)
    return np.where(known, np.log(np.where(known, high, 1.0) / np.where(known, low, 1.0)), 0.0)


def _suspects(changes: np.ndarray, least: float) -> list[int]:
    """Intervals whose changes are the furthest above the changes of both neighbours."""
    padded = np.pad(changes, 1, mode="edge")
    excess = changes - np.maximum(padded[:-2], padded[2:])
    return [int(k) for k in np.argsort(excess)[-_CHOSEN:] if excess[k] > _SUSPICIOUS * least]


def jumps_along(case: BearingCase, key: str, values: Sequence[float], least: float = 1e-3) -> list[Jump]:
    """Jumps of more than ``least`` of the numbers of a bearing along an input, at increasing values of it."""
    x = np.asarray(values, dtype=float)
    numbers = numbers_at(case, key, x)
    chosen = [(name, k) for name, y in numbers.items() for k in _suspects(_changes(y), least)]
    if not chosen:
        return []
    low = np.array([x[k] for _, k in chosen])
    high = np.array([x[k + 1] for _, k in chosen])
    rows = np.arange(len(chosen))
    for _ in range(_TIMES):
        at = low[:, np.newaxis] + (high - low)[:, np.newaxis] * np.linspace(0.0, 1.0, _PARTS + 1)
        places, back = np.unique(at, return_inverse=True)
        found = numbers_at(case, key, places)
        y = np.array([found[name][back.reshape(at.shape)[row]] for row, (name, _) in enumerate(chosen)])
        changes = _changes(y)
        most = np.argmax(changes, axis=1)
        low, high, change = at[rows, most], at[rows, most + 1], changes[rows, most]
        going = change > least
        rows = np.arange(np.count_nonzero(going))
        chosen = [one for one, goes in zip(chosen, going, strict=True) if goes]
        low, high, change = low[going], high[going], change[going]
        if not chosen:
            return []
    rows_left = zip(chosen, low.tolist(), high.tolist(), change.tolist(), strict=True)
    found_jumps = {
        Jump(name, place, (end - place) / abs(end), size) for (name, _), place, end, size in rows_left
    }
    return sorted(found_jumps, key=lambda jump: -jump.change)
