"""Answers about a drive, as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from ehlectric.app.answers.bearing import Figure, Judged, Table
from ehlectric.app.answers.line import Line
from ehlectric.app.answers.number import Number
from ehlectric.app.answers.told import Told


@dataclass(frozen=True)
class DriveAnswer:
    """Answer about a drive.

    Attributes
    ----------
    title : str
        Title of the drive.
    simulated : bool
        Whether the drive was simulated; otherwise the answer is that of the capacitive divider.
    judged : Judged
        Verdict taken apart.
    how : str
        How the answer was computed, and what it leaves out.
    shown : tuple of Number
        Numbers at the top: before a simulation of its circuit and its films, after it of its discharges, too.
    ends : Table
        Numbers of both bearings side by side.
    lines : tuple of Line
        All rows that the command prints.
    warnings : tuple of Told
        Warnings, with the numbers of ``shown`` that they concern.
    remedies : Table or None
        The drive and its remedies side by side; None before a simulation, and without remedies.
    figures : mapping of str to Figure
        "voltages", "histogram", "spectrum", "discharge-voltage" and others, and "remedies"; empty before a
        simulation.
    seconds : float
        Computing time of a simulation [s].
    """

    title: str
    simulated: bool
    judged: Judged
    how: str
    shown: tuple[Number, ...]
    ends: Table
    lines: tuple[Line, ...]
    warnings: tuple[Told, ...]
    remedies: Table | None = None
    figures: Mapping[str, Figure] = field(default_factory=dict)
    seconds: float = 0.0

    def number(self, key: str) -> Number | None:
        """Number of a key; None where the answer has none."""
        return next((one for one in self.shown if one.key == key), None)
