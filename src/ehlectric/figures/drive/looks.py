"""Names, colours and units that the figures of a drive share."""

from __future__ import annotations

from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.discharges.record import FILM
from ehlectric.drive.result import DriveResult
from ehlectric.quantities.drive_results import NAMES_OF_ENDS
from ehlectric.quantities.palette import BLUE, ORANGE
from ehlectric.quantities.units import unit_for

# Names of both bearings in titles and legends, and their colours.
NAMES = tuple(NAMES_OF_ENDS.values())
COLOURS = (BLUE, ORANGE)

# Line of a breakdown voltage.
THRESHOLD: dict[str, Any] = {"color": "black", "lw": 0.9, "ls": "--"}


def events_of(result: DriveResult, b: int) -> Array:
    """Events of one bearing, a row for each, as in ``Record``."""
    events = result.solution.record.events
    own: Array = events[events[:, FILM] == b]
    return own


def number_of_events(result: DriveResult, b: int) -> int:
    """Number of all events of one bearing, also of those that are not kept one by one."""
    return int(np.sum(result.solution.record.counts[b]))


def breakdown_of(result: DriveResult, b: int) -> float:
    """Voltage across the films at which the weakest position of a bearing breaks down [V], or infinity."""
    return float(np.min(result.solution.elements[b].breakdown))


def voltage_unit(largest: float) -> tuple[float, str]:
    """Factor and unit in which a voltage [V] is at least 1, and nanovolts for none at all."""
    return unit_for(max(largest, 1e-9), "V", least=1.0)
