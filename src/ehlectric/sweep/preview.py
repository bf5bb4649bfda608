"""Point of a sweep of drives with the thinnest films, tried without a simulation before the sweep begins."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ehlectric.cases.drives.case import DriveCase
from ehlectric.drive.quick import quick_drive
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import end_and_key
from ehlectric.sweep.inputs import Sweep
from ehlectric.sweep.plan import Planned

_SPEEDS = ("drive.speed", "bearing.inner_speed")
_TEMPERATURES = ("drive.temperature", "bearing.temperature")


@dataclass(frozen=True)
class Lacking:
    """Point of a sweep that cannot be computed.

    Attributes
    ----------
    point : Planned
        Point of the sweep.
    reason : str
        Key that it lacks, and why, as one line.
    """

    point: Planned
    reason: str

    def __str__(self) -> str:
        return f"point {self.point.number}, the slowest and hottest, cannot be computed: {self.reason}"


def lacking_point(sweep: Sweep, planned: Sequence[Planned]) -> Lacking | None:
    """Slowest and, of these, hottest point of a sweep of drives, if it cannot be computed.

    Its films are the thinnest, so that asperities may close them as at no other point. The bearings
    of the point are solved with films of the atlas or by formula, in about a second.

    Parameters
    ----------
    sweep : Sweep
        Sweep.
    planned : sequence of Planned
        Its points.

    Returns
    -------
    Lacking or None
        Point and reason; None where it can be computed, and for sweeps of contacts and bearings, whose
        results do not need the resistance of closed contacts.
    """
    valid = [point for point in planned if point.key is not None]
    if not isinstance(sweep.case, DriveCase) or not valid:
        return None
    # Loads the compiler of the simulation, which other sweeps do not need.
    from ehlectric.drive.solver import prepare

    point = min(valid, key=_films)
    case: Any = sweep.case.replace(point.inputs)
    try:
        quick, _ = quick_drive(case)
        if quick is not None:
            prepare(quick, workers=1)
    except InputError as error:
        return Lacking(point, str(error))
    return None


def _films(point: Planned) -> tuple[float, float]:
    """Order of points by their films: speed and negative temperature, the thinnest films first."""
    found = [0.0, 0.0]
    for key, value in point.inputs.items():
        own = end_and_key(key)[1]
        if own in _SPEEDS:
            found[0] = float(value)
        elif own in _TEMPERATURES:
            found[1] = -float(value)
    return found[0], found[1]
