"""Tables of a drive: both bearings side by side, and its remedies."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ehlectric.bearing.accuracy import percent
from ehlectric.cases.bearings.ways import HOW
from ehlectric.cases.drives.case import ENDS
from ehlectric.errors import printable
from ehlectric.quantities.drive_results import DRIVE_KEYS, NAMES_OF_ENDS
from ehlectric.quantities.formats import UNITS, number_text
from ehlectric.quantities.rows import Row

if TYPE_CHECKING:
    from rich.table import Table

# Rows of the table of both ends: name, key, and unit in which it is shown.
_ROWS = (
    ("bearing capacitance", "capacitance", "pF"),
    ("breakdown voltage, weakest position", "breakdown_voltage", "V"),
    ("share of time with metallic contact", "touching_time_share", "%"),
    ("bearing voltage ratio, divider", "voltage_ratio", "%"),
    ("bearing voltage ratio, waveform", "waveform_ratio", "%"),
    ("largest bearing voltage", "peak_voltage", "V"),
    ("rms bearing voltage", "rms_voltage", "V"),
    ("share of time with conducting films", "burning_time_share", "%"),
    ("discharges per second", "events_per_second", "1/s"),
    ("  lower bound, 95 %", "events_per_second_low", "1/s"),
    ("  upper bound, 95 %", "events_per_second_high", "1/s"),
    ("discharges per edge", "events_per_edge", "%"),
    ("voltage of a discharge, mean", "voltage_mean", "V"),
    ("  95th percentile", "voltage_high", "V"),
    ("energy of a discharge, mean", "energy_mean", "nJ"),
    ("  largest", "energy_largest", "nJ"),
    ("charge of a discharge, mean", "charge_mean", "nC"),
    ("peak current of a discharge, mean", "peak_current_mean", "mA"),
    ("  largest", "peak_current_largest", "mA"),
    ("power of the discharges", "power", "µW"),
    ("peak current through asperities", "contact_current", "mA"),
    ("current density, all elements", "current_density", "A/mm²"),
    ("  one element", "element_current_density", "A/mm²"),
    ("  real area of contact", "real_current_density", "A/mm²"),
)

# Rows of a bearing before the simulation.
_PREPARED = (
    *_ROWS[:4],
    ("bearing voltage at the peak, by the divider", "voltage_at_peak", "V"),
)

# Columns of the table of remedies, of the bearing with more discharges.
_COLUMNS = (
    ("events [1/s]", "events_per_second", "1/s"),
    ("at [V]", "voltage_mean", "V"),
    ("energy [nJ]", "energy_mean", "nJ"),
    ("power [µW]", "power", "µW"),
    ("peak [V]", "peak_voltage", "V"),
)


def prepared_rows(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of a drive that is not simulated.

    Parameters
    ----------
    summary : mapping
        Tables of ``drive.summary.prepared_summary``; in those of the ends also ``films`` and ``films_error``.

    Yields
    ------
    Row
        Source, and what is known of each bearing without a simulation.
    """
    yield Row("common-mode voltage, peak", summary["source"]["peak"], "V")
    if summary["source"]["edges_per_second"] is not None:
        yield Row("edges per second", number_text(summary["source"]["edges_per_second"]), "1/s")
        yield Row("fundamental frequency", summary["source"]["fundamental_frequency"], "Hz")
    for key, value in summary["circuit"].items():
        yield Row(f"capacitance {DRIVE_KEYS[f'circuit.{key}'].label}", value, "pF")
    yield Row("simulated time", summary["drive"]["duration"], "s")
    yield Row("remedies computed beside it", str(summary["drive"]["remedies"]))
    for end, place in NAMES_OF_ENDS.items():
        about = summary[end]
        note = f"contacts {HOW[about['films']]}: films may be {percent(about['films_error'])} off"
        yield Row(f"{place}:", note=note)
        for name, key, unit in _PREPARED:
            if about[key] is not None:
                yield Row(name, about[key], unit, bound="≤" if key == "breakdown_voltage" else "")


def drive_rows(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of a drive, both bearings below each other.

    Parameters
    ----------
    summary : mapping
        Summary of a drive, as ``DriveResult.summary`` gives it.

    Yields
    ------
    Row
        Values in SI units; the first one is an alarm if a film is not converged.
    """
    if not summary["converged"]:
        yield Row("NOT CONVERGED", note="the film of a contact: do not use these numbers", alarm=True)
    yield Row("common-mode voltage, peak", summary["source"]["peak"], "V")
    yield Row("simulated time", summary["drive"]["duration"], "s")
    for end, place in NAMES_OF_ENDS.items():
        yield Row(f"{place}:")
        for name, key, unit in _ROWS:
            if summary[end][key] is not None:
                yield Row(name, summary[end][key], unit)


def ends_table(summary: Mapping[str, Any]) -> Table:
    """Table of both bearings of a drive, for the terminal.

    Parameters
    ----------
    summary : mapping
        Summary of a drive.

    Returns
    -------
    rich.table.Table
        A row for each quantity, a column for each end, and one for the unit.
    """
    head = [printable(summary["title"]), *NAMES_OF_ENDS.values(), ""]
    return _table(head, end_cells(summary))


def end_cells(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Cells of the table of both bearings: name, value at each end, and unit.

    Parameters
    ----------
    summary : mapping
        Summary of a drive, or its tables before a simulation, which have some of the rows.

    Yields
    ------
    tuple of str
        Row for each quantity that the summary has.
    """
    for name, key, unit in (*_ROWS, *_PREPARED[4:]):
        if key in summary[ENDS[0]]:
            yield name, *(_shown(summary[end][key], unit) for end in ENDS), unit


def remedies_table(summary: Mapping[str, Any]) -> Table:
    """Table of the drive and its remedies side by side, for the terminal; of the worse bearing of each.

    Parameters
    ----------
    summary : mapping
        Summary of a drive.

    Returns
    -------
    rich.table.Table
        A row for the drive as it is and for each remedy.
    """
    head, *rows = remedy_cells(summary)
    return _table(head, rows)


def remedy_cells(summary: Mapping[str, Any]) -> Iterator[tuple[str, ...]]:
    """Cells of the table of remedies: its heads, the drive as it is, and each remedy.

    Parameters
    ----------
    summary : mapping
        Summary of a drive.

    Yields
    ------
    tuple of str
        Heads, then a row for each drive, of the worse bearing of each.
    """
    yield "remedy, worse bearing", *(name for name, _, _ in _COLUMNS)
    yield from (_remedy(title, ends) for title, ends in _drives(summary))


def _drives(summary: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    yield "as it is", summary
    for one in summary["remedies"]:
        yield printable(one["title"]), one


def _remedy(title: str, ends: Mapping[str, Any]) -> tuple[str, ...]:
    worse = max((ends[end] for end in ENDS), key=lambda end: (end["power"], end["peak_voltage"]))
    return title, *(_shown(worse[key], unit) for _, key, unit in _COLUMNS)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, padding=(0, 2, 0, 0))
    for k, name in enumerate(head):
        table.add_column(Text(name), justify="left" if k == 0 or not name else "right", no_wrap=bool(k))
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))
    return table


def _shown(value: float | None, unit: str) -> str:
    """Value in its shown unit with three digits; a dash where there is none."""
    return "–" if value is None else number_text(value * UNITS[unit][1])
