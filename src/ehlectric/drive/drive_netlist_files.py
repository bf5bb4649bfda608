"""Netlist of a whole drive: subcircuits of both bearings, and the machine with its inverter around them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import BearingResult, solve_bearing
from ehlectric.cases.drive_case import DriveCase, NetworkCase
from ehlectric.cases.drive_inputs import Source
from ehlectric.drive.circuit_equations import FRAME, Element
from ehlectric.drive.inverter import steps_of
from ehlectric.drive.measured_source import measured_waveform
from ehlectric.drive.netlist import (
    SIGNATURE,
    TEXTS,
    Arc,
    Parameter,
    Subcircuit,
    check_strength,
    comment,
    filled,
    number,
    subcircuit_of,
)
from ehlectric.drive.netlist_files import check_targets, write_files
from ehlectric.drive.network import machine
from ehlectric.drive.source_pieces import edges
from ehlectric.drive.waveform.waveform import Waveform
from ehlectric.errors import InputError
from ehlectric.quantities.formats import speed_text
from ehlectric.quantities.inputs import ENDS
from ehlectric.runtime.progress import Progress, silent
from ehlectric.version import __version__

# Periods of the carrier, or of the fundamental in six-step operation, and samples of a measured voltage that
# the bench simulates.
_PERIODS, _SAMPLES = 4.0, 4000

# Rise time instead of a jump [s], and steps in an edge and in the whole time.
_JUMP, _IN_EDGE, _IN_ALL = 1e-9, 20.0, 80_000.0

# Points of the source on a line.
_POINTS = 6

_ROTOR = "rotor"
_NODES = {FRAME: "0", _ROTOR: "shaft", "source": "inverter", "winding": "winding", "earth": "earth"}
_KINDS = {"capacitor": ("C", "F"), "conductor": ("R", "Ohm"), "inductor": ("L", "H")}


@dataclass(frozen=True, eq=False)
class DriveNetlist:
    """Both bearings of a drive as subcircuits."""

    case: DriveCase
    # Subcircuits at the drive end and at the other end; the same one where the bearings are.
    bearings: tuple[Subcircuit, Subcircuit]
    waveform: Waveform | None  # voltage of a measured source

    @property
    def subcircuits(self) -> tuple[Subcircuit, ...]:
        """Different subcircuits."""
        first, second = self.bearings
        return (first,) if first is second else (first, second)

    def lines(self) -> Iterator[str]:
        """Lines of the file of the subcircuits."""
        for subcircuit in self.subcircuits:
            yield from subcircuit.lines()

    def bench(self, library: str) -> Iterator[str]:
        """Lines of the test bench, which includes the file of the subcircuits."""
        case, bench = self.case, TEXTS["drive_bench"]
        network = machine(case.running_circuit, _ROTOR)
        elements = tuple(_named(network.circuit()))
        ring = [] if case.circuit.grounding_ring_table is None else [_about_ring(case)]
        yield from bench_lines(
            case,
            "drive",
            bench["lines"],
            self.waveform,
            (*ring, bench["left_out"]),
            ends=tuple(_NODES[node] for node in network.ends),
            library=library,
            parameters=[line for name, each in elements for line in _parameters(name, each)],
            elements=[line for name, each in elements for line in _lines(name, each)],
            **{end: bearing.name for end, bearing in zip(ENDS, self.bearings, strict=True)},
        )


def bench_lines(
    case: NetworkCase,
    kind: Literal["drive", "axle"],
    lines: str,
    waveform: Waveform | None,
    notes: Sequence[str] = (),
    *,
    ends: Sequence[str],
    **parts: object,
) -> Iterator[str]:
    """Lines of the test bench of a drive or an axle, from a text with parts.

    The voltage of the source lies between two ``ends``; it is a ``waveform`` of a measured source.
    """
    source = case.running_source
    points, step = source_points(source, waveform)
    about = (
        f"title: {case.title or '(none)'}",
        f"common-mode voltage: {about_source(source)}, as points over time",
        *notes,
    )
    article = "an" if kind == "axle" else "a"
    text = filled(
        lines,
        signature=f"{SIGNATURE}test bench of {article} {kind}; ehlectric {__version__}",
        comments=[line for part in about for line in comment(part)],
        points=list(point_lines(points)),
        positive=ends[0],
        negative=ends[1],
        step=number(step),
        duration=f"{points[-1][0]:.12g}",
        **parts,
    )
    yield from text.split("\n")


def write_drive_netlist(
    case: DriveCase,
    path: str | Path,
    *,
    bench: str | Path | None = None,
    progress: Progress = silent,
    workers: int | None = None,
) -> list[Path]:
    """Write the netlist of a drive for ngspice and LTspice: both bearings, and a bench with the machine.

    Parameters
    ----------
    case : DriveCase
        Drive. The arc of the bearings follows its table ``breakdown``.
    path : str or Path
        File of the subcircuits, such as bearings.lib. An existing file is replaced if ehlectric wrote it.
    bench : str or Path, optional
        File of a test bench: the inverter's voltage over four periods of its carrier, or the first 4000
        samples of a measured one, the circuit of the machine, and both bearings.
    progress : callable, optional
        Called with the number of solved contacts, the number of all contacts, and a text.
    workers : int, optional
        Number of processes that solve the contacts of the bearings.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        If a bearing cannot be solved or lacks an input of its arc, the source cannot be read, or a file
        cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import ehlectric
    >>> case = ehlectric.DriveCase.from_toml(ehlectric.example("drive.toml"))
    >>> case = case.replace({"drive.duration": "1 ms"}, remedies=[])
    >>> with TemporaryDirectory() as folder:
    ...     files = ehlectric.write_drive_netlist(case, Path(folder) / "drive.lib")
    >>> [file.name for file in files]
    ['drive.lib']
    """
    path, bench = Path(path), None if bench is None else Path(bench)
    check_targets(path, bench)
    return write_files(drive_netlist(case, progress, workers=workers), path, bench)


def drive_netlist(
    case: DriveCase, progress: Progress = silent, *, workers: int | None = None
) -> DriveNetlist:
    """Solve the bearings of a drive, and make its netlist. Raises InputError as ``write_drive_netlist``
    raises it.
    """
    first, second = case.bearings
    for end, bearing in zip(ENDS, (first, second), strict=True):
        try:
            check_strength(bearing)
        except InputError as error:
            raise error.under(end) from None
    waveform, _ = measured_waveform(case.source, None)
    drive_end = solve_bearing(first, progress=progress, workers=workers)
    if second == first:
        shared = _subcircuit(case, ENDS[0], drive_end)
        return DriveNetlist(case, (shared, shared), waveform)
    other = solve_bearing(second, progress=progress, workers=workers)
    ends = zip(ENDS, (drive_end, other), strict=True)
    pair = tuple(replace(_subcircuit(case, end, result), suffix=end) for end, result in ends)
    return DriveNetlist(case, (pair[0], pair[1]), waveform)


def _subcircuit(case: DriveCase, end: str, result: BearingResult) -> Subcircuit:
    """Subcircuit of the bearing at one end, with the arc of the drive."""
    breakdown = case.breakdown
    try:
        return subcircuit_of([result], Arc(breakdown.arc_resistance, breakdown.lowest_voltage))
    except InputError as error:
        if error.key == "extinction_voltage":
            raise error.with_text(f"breakdown.{breakdown.extinction_key}", f"{error.text} of {end}") from None
        raise error.under(end) from None


def about_source(source: Source) -> str:
    """Words for the source."""
    if source.measured:
        return f"measured, {source.file}"
    assert source.dc_link is not None and source.fundamental_frequency is not None
    carrier = "" if source.switching_frequency is None else f" at {source.switching_frequency:g} Hz"
    fundamental = f"fundamental {source.fundamental_frequency:g} Hz"
    return f"{source.modulation}{carrier}, {source.dc_link:g} V, {fundamental}"


def _about_ring(case: DriveCase) -> str:
    """Words for a grounding ring whose resistance follows the speed."""
    resistance = case.running_circuit.grounding_ring_resistance
    speed = speed_text(case.running_speed)
    return f"grounding ring: {resistance:.4g} Ohm at {speed}, from its table over the speed"


def source_points(source: Source, waveform: Waveform | None) -> tuple[list[tuple[float, float]], float]:
    """Times [s] and voltages [V] of the source, and the largest step of the simulation [s]."""
    if waveform is not None:
        values = waveform.values[: _SAMPLES + 1]
        sampled = waveform.step * np.arange(values.size)
        return list(zip(sampled.tolist(), values.tolist(), strict=True)), 0.5 * waveform.step
    assert source.rise_time is not None and source.fundamental_frequency is not None
    duration, rise = _PERIODS / (source.switching_frequency or source.fundamental_frequency), source.rise_time
    start, intervals = steps_of(source, duration)
    chunks = list(edges(start, intervals, rise or _JUMP))
    lasting, level, slope = (
        np.concatenate([getattr(chunk, name) for chunk in chunks]) for name in ("duration", "level", "slope")
    )
    times: Array = np.append(0.0, np.cumsum(lasting))
    levels = np.append(level, level[-1] + slope[-1] * lasting[-1])
    kept = np.append(np.diff(times) > 0.0, True)
    points = list(zip(times[kept].tolist(), levels[kept].tolist(), strict=True))
    return points, max((rise or _JUMP) / _IN_EDGE, duration / _IN_ALL)


def point_lines(points: Sequence[tuple[float, float]]) -> Iterator[str]:
    """Lines of a source with points over time [s, V]."""
    texts = [f"{time:.12g} {number(value)}" for time, value in points]
    for k in range(0, len(texts), _POINTS):
        yield "+ " + " ".join(texts[k : k + _POINTS])


def _named(elements: Iterator[Element]) -> Iterator[tuple[str, Element]]:
    """Elements with names after their nodes; a second one of a kind between two nodes has a number."""
    seen: Counter[tuple[str, str]] = Counter()
    for element in elements:
        first, second = (node.removeprefix("shaft ") for node in (element.first, element.second))
        name = f"{first}_{second}"
        seen[element.kind, name] += 1
        number_of_name = seen[element.kind, name]
        named = replace(element, first=first, second=second)
        yield name if number_of_name == 1 else f"{name}_{number_of_name}", named


def _parameters(name: str, element: Element) -> Iterator[str]:
    between = f"{element.first} to {element.second}"
    for parameter in element_parameters(name, element, between, "in series with it"):
        yield f".param {parameter.line}"


def _lines(name: str, element: Element) -> Iterator[str]:
    return element_lines(name, element, _NODES[element.first], _NODES[element.second])


def element_parameters(name: str, element: Element, meaning: str, series: str) -> Iterator[Parameter]:
    """Parameters of an element with a name: its value, and a resistance in ``series`` with an inductance."""
    letter, unit = _KINDS[element.kind]
    value = 1.0 / element.value if letter == "R" else element.value
    yield Parameter(f"{letter}_{name}", value, unit, meaning)
    if element.resistance:
        yield Parameter(f"RL_{name}", element.resistance, "Ohm", series)


def element_lines(name: str, element: Element, first: str, second: str) -> Iterator[str]:
    """Lines of an element between two nodes; an inductor has its resistance behind it."""
    letter, _ = _KINDS[element.kind]
    inner = f"inner_L_{name}" if element.resistance else second
    yield f"{letter}_{name} {first} {inner} {{{letter}_{name}}}"
    if element.resistance:
        yield f"RL_{name} {inner} {second} {{RL_{name}}}"
