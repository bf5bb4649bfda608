"""Background of a report: inputs with their origin, limits, sources, versions and the input file."""

from __future__ import annotations

import os
import platform
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from datetime import UTC, datetime
from importlib.metadata import version
from itertools import groupby

from ehlectric.cases.drives.case import BOTH, ENDS
from ehlectric.cases.drives.swept import SweptCase
from ehlectric.cases.input_keys import describe, of_both_ends
from ehlectric.cases.library.sources import Source
from ehlectric.errors import InputError, printable, shown
from ehlectric.quantities.drive_results import NAMES_OF_ENDS
from ehlectric.quantities.inputs import end_and_key
from ehlectric.report.content import Block, Cell, Link, Section, Table, Text
from ehlectric.report.limits import Limit, Reference
from ehlectric.report.origins import WORDS, Input, input_text, inputs_of, material_sources, replaced_by
from ehlectric.version import __version__

# Heads of the tables of inputs, and shares of their columns.
_HEADS, _SHARES = ("input", "value", "origin", "meaning"), (0.25, 0.19, 0.21, 0.35)
_DOI = "https://doi.org/"
_UNITS = (
    "Values stand in units that suit them; the input file at the end of the report has them in SI units. "
    "“default” is the value that the program takes on its own, whether the input file has it or not; “given” "
    "is any other value of the input file. A value of the library has the number of its source and the kind "
    "of it: measured, read off a diagram, fitted, published, by rule, estimated or assumed."
)
_VARIED = (
    "These are the inputs of the base case. The values of the varied inputs, and of their alternatives such "
    "as a load for a Hertz pressure, differ from point to point."
)
# Keys of the dielectric strength, which no measurement of films gives, and sentences below the inputs.
_STRENGTHS = tuple(f"discharge.{name}" for name in ("dielectric_strength", "weibull", "strength_table"))
_NO_STRENGTH = "No measurement of a film stands behind it, whatever its value."

# Names of the bearings of a drive by the first word of their keys.
_PLACES = {BOTH: "both bearings", **{end: f"bearing at the {name}" for end, name in NAMES_OF_ENDS.items()}}
_GIVEN = "Given values count as known: only the author of the input file can say how they were found."


def input_section(case: SweptCase, varied: Iterable[str] = ()) -> Section:
    """Section of all inputs with their origin, and of those that are assumptions.

    Parameters
    ----------
    case : Case, BearingCase or DriveCase
        Case of the result, or base case of a sweep.
    varied : iterable of str
        Dotted keys that a sweep varies.
    """
    varied = tuple(varied)
    either = {*varied, *(key for each in varied for key in of_both_ends(each))}
    apart = any(end_and_key(key)[0] in ENDS for key in varied)
    inputs = [
        replace(one, origin="varied", source=None) if one.key in either else one
        for one in inputs_of(case, apart=apart)
    ]
    numbers = {source: number for number, source in enumerate(_sources(inputs), 1)}
    blocks: list[Block] = [Text(_UNITS), *([Text(_VARIED)] if varied else [])]
    for name, group in groupby(inputs, key=lambda one: one.key.partition(".")[0]):
        rows = tuple(_input_cells(case, one, numbers) for one in group)
        blocks.append(Table(f"Inputs: {_PLACES.get(name, name)}", _HEADS, rows, shares=_SHARES))
    return Section("Inputs", (*blocks, *_assumptions(case, inputs)))


def _sources(inputs: Iterable[Input]) -> list[Source]:
    """Sources of inputs, each once."""
    return list(dict.fromkeys(one.source for one in inputs if one.source is not None))


def _input_cells(case: SweptCase, one: Input, numbers: Mapping[Source, int]) -> tuple[str, ...]:
    origin = one.origin if one.origin in WORDS else f"library {one.origin}"
    if one.source is not None:
        origin = f"{origin}: {one.source.kind} [{numbers[one.source]}]"
    meaning, other = _meaning(one.key), replaced_by(case, one.key)
    if other:
        meaning = f"not used: {other} takes its place"
    return one.key.partition(".")[2] or one.key, input_text(case, one.key, one.value), origin, meaning


def _meaning(key: str) -> str:
    """Meaning of an input without its unit, which stands beside the value; empty for keys of tables."""
    try:
        text = describe(key)
    except InputError:
        return "how the contacts are computed" if end_and_key(key)[1] == "contacts" else ""
    return re.split(r" \[|; |: ", text)[0]


def _assumptions(case: SweptCase, inputs: Iterable[Input]) -> Iterator[Block]:
    """Table of the inputs that are assumptions, estimates or follow by a rule, grouped by their sources."""
    groups: dict[tuple[str, str], list[str]] = {}
    for one in inputs:
        text = f"{one.key} = {input_text(case, one.key, one.value)}"
        if one.assumed and one.source is not None:
            why = printable(one.source.note or one.source.citation)
            groups.setdefault((one.source.kind, why), []).append(text)
        elif end_and_key(one.key)[1].startswith(_STRENGTHS):
            groups.setdefault(("assumed", _NO_STRENGTH), []).append(text)
    rows = tuple(("; ".join(texts), kind, why) for (kind, why), texts in groups.items())
    if rows:
        yield Table("Inputs that are assumptions", ("inputs", "kind", "why"), rows, shares=(0.42, 0.12, 0.46))
    yield Text(_GIVEN)


def limit_section(limits: Iterable[Limit]) -> Section:
    """Section of what the models leave out."""
    rows = tuple((limit.topic, limit.text) for limit in limits)
    return Section(
        "What the model leaves out",
        (Table("Limits of the model", ("part", "limit"), rows, shares=(0.2, 0.8)),),
    )


def source_section(case: SweptCase, references: Iterable[Reference]) -> Section:
    """Section of the sources of library values, of materials, and of equations."""
    blocks: list[Block] = []
    numbered = enumerate(_sources(inputs_of(case)), 1)
    values = tuple(
        (f"[{number}]", source.kind, _cited(source), printable(source.note)) for number, source in numbered
    )
    if values:
        heads = ("number", "kind", "source", "note")
        blocks.append(
            Table("Sources of values of the library", heads, values, shares=(0.09, 0.13, 0.41, 0.37))
        )
    solids = tuple((name, _cited(source)) for name, source in material_sources(case))
    if solids:
        blocks.append(Table("Sources of the materials", ("material", "source"), solids))
    equations = tuple(
        (one.topic, Link(f"{one.citation}, ", _DOI + one.doi) if one.doi else one.citation)
        for one in references
    )
    blocks.append(
        Table("Literature behind the equations", ("for", "publication"), equations, shares=(0.35, 0.65))
    )
    return Section("Sources", tuple(blocks))


def _cited(source: Source) -> Cell:
    """Citation of a source, with a link to its DOI if it has one."""
    citation = printable(source.citation) or "none"
    return Link(f"{citation}, ", _DOI + source.doi) if source.doi else citation


def version_section(details: Mapping[str, str]) -> Section:
    """Section of the versions of what computed the result and made the report."""
    versions = {
        "report made by": f"ehlectric {__version__}",
        "Python": platform.python_version(),
        "NumPy": version("numpy"),
        "SciPy": version("scipy"),
        "platform of the report": platform.platform(),
    }
    rows = tuple((name, printable(text)) for name, text in {**details, **versions}.items() if text)
    return Section("How it was computed", (Table("Result and versions", ("what", "value"), rows),))


def file_section(toml: str, command: str) -> Section:
    """Section with the whole input file, from which the result can be computed again."""
    text = f"Write these lines to a file and solve it again with: ehlectric {command} FILE"
    blocks: list[Block] = [Text(text)]
    if "\nfile = " in toml:
        blocks.append(Text("The file names measured surfaces or voltages, which must lie at the same paths."))
    return Section("Input file", (*blocks, Text(toml, "code")))


def date_of_report() -> str:
    """Date and time of a report in UTC; SOURCE_DATE_EPOCH sets it, for reports that are byte for byte equal.

    Raises
    ------
    InputError
        If SOURCE_DATE_EPOCH is no number of seconds.
    """
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if given is None:
        return datetime.now(UTC).isoformat(timespec="seconds")
    try:
        return datetime.fromtimestamp(int(given), UTC).isoformat(timespec="seconds")
    except (ValueError, OverflowError, OSError):
        takes = "a number of seconds since 1970"
        raise InputError("SOURCE_DATE_EPOCH", got=shown(given), takes=takes) from None
