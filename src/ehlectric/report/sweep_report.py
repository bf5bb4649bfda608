"""Part of a report about a sweep: its points, its sensitivity, and its input file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from ehlectric.cases.drive_case import DriveCase
from ehlectric.errors import InputError, printable
from ehlectric.quantities.formats import Scale, scale_of
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.quantity import BOUNDS
from ehlectric.quantities.rows import value_at
from ehlectric.quantities.sheets import SWEEPS
from ehlectric.readable import file_texts, readable
from ehlectric.report.appendix import named
from ehlectric.report.drive_report import deciding_blocks, listed_values, swept_values
from ehlectric.report.report_content import Block, Cell, Named, Part, Section, Table, Text
from ehlectric.report.report_facts import cell_table, lead_of, row_tables, swept_names, without_folders
from ehlectric.report.report_texts import SENTENCES
from ehlectric.runtime.display import is_number
from ehlectric.sweep import (
    Point,
    SweepResults,
    breakdown_of,
    label_of,
    main_value,
    ranked_value,
    sensitivity,
    sweep_warnings,
    swept_verdict,
)
from ehlectric.tables.sweep_summary import indices_table, spread_rows, sweep_rows

# Largest number of points that a report lists.
_LISTED = 100

# Largest number of values of a varied input that are listed.
_SHOWN = 12

# Units of columns, whatever their values: engineers' units, and volts, whose values may span decades.
_SCALES: Mapping[str, Scale] = MappingProxyType({"rad/s": scale_of("rpm"), "V": Scale(1.0, "V")})


def sweep_part(results: SweepResults) -> Part:
    """Part of a report about a sweep."""
    count, case = results.summary(), results.case
    of_drive = isinstance(case, DriveCase)
    return Part(
        kind=f"sweep of {count['points']} points over {', '.join(named(key).text for key in results.varied)}",
        command="sweep",
        lead=lead_of(results),
        failure=_failure(results, count),
        verdict=swept_verdict(results) if of_drive else results.verdict,
        warnings=tuple(sweep_warnings(results)),
        first=(Table("Varied inputs", ("input", "values"), tuple(_varied(results))),),
        numbers=tuple(row_tables(sweep_rows(results), "Overview")),
        figures=_figures(results),
        figure_note=SENTENCES["further_maps"],
        further=tuple(_sections(results)),
        rests=deciding_blocks(case, varied=results.varied) if isinstance(case, DriveCase) else (),
        details=_details(results),
        toml=without_folders(results.described_toml()),
        varied=tuple(results.varied),
    )


def _failure(results: SweepResults, count: Mapping[str, Any]) -> str:
    """Sentences about points that are not solved or must not be used; empty where there are none."""
    states = ("not converged", "failed", "open")
    missing = [
        f"{count[state]} {'not computed yet' if state == 'open' else state}"
        for state in states
        if count[state]
    ]
    doubtful = sum(point.solved and point.doubtful for point in results.points)
    sentences = []
    if missing:
        solved = f"of {count['points']} points, {count['solved']} are solved, {', '.join(missing)}"
        sentences.append(f"NOT COMPLETE: {solved}.")
    if doubtful:
        sentences.append(f"{doubtful} of {count['solved']} solved points must not be used; they are omitted.")
    return " ".join(sentences)


def _figures(results: SweepResults) -> tuple[str, ...]:
    shown = swept_values(results) if isinstance(results.case, DriveCase) else SWEEPS["drawn"]
    return tuple(swept_names(results, (main_value(results.case), *shown)))


def _details(results: SweepResults) -> dict[str, str]:
    versions = dict.fromkeys(point.version for point in results.points if point.version)
    return {
        "result computed by": ", ".join(f"ehlectric {version}" for version in versions),
        "design": f"{results.design}, {len(results.points)} points",
        "computing time of all points": f"{readable(results.summary()['seconds'])} s",
    }


def _sections(results: SweepResults) -> Iterator[Section]:
    if results.design == "sobol":
        yield Section("Sensitivity", tuple(_sensitivity(results)))
    yield Section("Points", tuple(_points(results)))


def _sensitivity(results: SweepResults) -> Iterator[Block]:
    try:
        indices = sensitivity(results, ranked_value(results.case))
    except InputError as error:
        yield Text(f"There are no sensitivity indices: {error.text}.")
        return
    yield from row_tables(spread_rows(results, indices), "Spread over the samples")
    yield cell_table(indices_table(results, indices), "Sensitivity indices of the varied inputs", "input")


def _points(results: SweepResults) -> Iterator[Block]:
    """Table of the points with their varied inputs, their status, and some results."""
    breakdown = breakdown_of(results.case)
    further = listed_values(results) if isinstance(results.case, DriveCase) else SWEEPS["listed"]
    shown = dict.fromkeys((main_value(results.case), breakdown.value, breakdown.margin, *further))
    values = [key for key in shown if any(is_number(value_at(point.usable, key)) for point in results.points)]
    inputs = [
        _column(results, key, [point.inputs.get(key) for point in results.points]) for key in results.varied
    ]
    # Real films are thinner than the films of a sweep, and break down earlier.
    bounded = (breakdown.value, breakdown.margin, *(f"{end}.breakdown_voltage" for end in ENDS))
    columns = []
    for key in values:
        head, cells = _column(results, key, [value_at(point.usable, key) for point in results.points])
        sign = label_of(key, results.case).bound if key in bounded else ""
        columns.append((f"{head}, {BOUNDS[sign]} ({sign})" if sign else head, cells))
    heads = ("point", *(head for head, _ in inputs), "status", *(head for head, _ in columns))
    listed = results.points[:_LISTED]
    rows = tuple(
        (
            str(point.number),
            *(cells[n] for _, cells in inputs),
            _status(point),
            *(cells[n] for _, cells in columns),
        )
        for n, point in enumerate(listed)
    )
    numeric = tuple(n for n in range(len(heads)) if heads[n] != "status")
    alarms = tuple(n for n, point in enumerate(listed) if not point.solved or point.doubtful)
    if len(results.points) > _LISTED:
        yield Text(f"The first {_LISTED} of {len(results.points)} points; sweep.csv has all of them.")
    yield Table("Points of the sweep", heads, rows, numeric, alarms)


def _varied(results: SweepResults) -> Iterator[tuple[Cell, ...]]:
    """Varied inputs with their values, or with their ranges."""
    for key, values in results.axes.items():
        head, cells = _column(results, key, values)
        more = f", ... ({len(cells)} values)" if len(cells) > _SHOWN else ""
        yield Named(head, key), ", ".join(cells[:_SHOWN]) + more
    for key, ends in results.ranges.items():
        head, cells = _column(results, key, (ends.start, ends.stop))
        yield Named(head, key), f"{' to '.join(cells)}, {ends.spacing}"


def _status(point: Point) -> str:
    if point.status == "open":
        return "not computed yet"
    return "do not use" if point.solved and point.doubtful else point.status


def _column(results: SweepResults, key: str, values: Iterable[Any]) -> tuple[str, list[str]]:
    """Head with the unit, and cells of a column."""
    listed = file_texts(values) if key.endswith(".file") else list(values)
    label = label_of(key, results.case)
    numbers = np.array([float(value) for value in listed if is_number(value)])
    if not numbers.size:
        return printable(label.name), ["" if value is None else printable(str(value)) for value in listed]
    scale = _SCALES.get(label.unit) or label.scaled(np.median(np.abs(numbers), keepdims=True))
    unit = f" [{scale.unit}]" if scale.unit else ""
    return f"{label.name}{unit}", [_number(scale.of(value)) if is_number(value) else "" for value in listed]


def _number(value: float) -> str:
    """Number with four digits, without a power of ten up to a million."""
    return readable(value, 4)
