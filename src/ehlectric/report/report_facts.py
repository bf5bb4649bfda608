"""Tables and figures of a report from the rows and figures of the commands, with captions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from matplotlib.figure import Figure

from ehlectric.bearing import BearingResult
from ehlectric.discharge.discharge_laws import CURRENT_DENSITY_LIMITS
from ehlectric.errors import InputError, printable
from ehlectric.figures.figure_names import with_units_kept
from ehlectric.figures.result_figures import default_figure, figure, figure_names
from ehlectric.quantities.quantity import unbroken
from ehlectric.quantities.result_warnings import CODES, ResultWarning, Severity
from ehlectric.quantities.rows import Row, value_at
from ehlectric.readable import capital, file_text, readable
from ehlectric.report.appendix import worded
from ehlectric.report.report_content import DOI, Link, Part, Picture, Table, Text, WarningLine, Warnings
from ehlectric.report.report_texts import SENTENCES, TEXTS
from ehlectric.runtime.display import is_number
from ehlectric.runtime.undrawn import drawing

if TYPE_CHECKING:
    from rich.table import Table as RichTable


_HEADS, _SHARES = ("quantity", "value", "unit", "note"), (0.42, 0.17, 0.1, 0.31)

# Order of warnings in a report, the most important first.
_SEVERITIES = ("severe", "warning", "note")


# Figures that decide, where a result has them; of other results the most informative figure.
_DECIDING = ("bearing_duty", "drive_duty", "breakdown_over_speed", "drive_remedies")


def part_of(result: Any, summary: Mapping[str, Any], *, date: str = "", **fields: Any) -> Part:
    """Part of a report of a result that is no sweep. ``date`` is the date of the result, empty where it is
    not known; ``fields`` are the fields that depend on the kind of the result.
    """
    names, default = figure_names(result), default_figure(result)[0].removesuffix(".png")
    first = next((name for name in (*_DECIDING, default) if name in names), "")
    shared: dict[str, Any] = {
        "lead": lead_of(result),
        "failure": "" if getattr(result, "converged", True) else SENTENCES["unsolved"],
        "verdict": getattr(result, "verdict", None),
        "warnings": result.all_warnings if isinstance(result, BearingResult) else result.warnings,
        "figures": tuple(sorted(names, key=lambda name: name != first)),
        "details": _details(summary, date),
        "toml": without_folders(result.case.described_toml()),
    }
    return Part(**shared | fields)


# Absolute path in a text in TOML.
_ABSOLUTE = re.compile(r'"((?:/|[A-Za-z]:\\\\)[^"\n]+\.\w+)"')


def without_folders(toml: str) -> str:
    """Text of a case whose files are named without the folders of a machine."""
    return _ABSOLUTE.sub(lambda match: f'"{file_text(match[1].replace(2 * chr(92), chr(92)))}"', toml)


def _details(summary: Mapping[str, Any], date: str) -> dict[str, str]:
    """Version, date and state of a computation, by name."""
    seconds = summary.get("seconds", "")
    # The time of a contact is the sum of its parts.
    total = sum(seconds.values()) if isinstance(seconds, Mapping) else seconds
    seed = value_at(summary, "drive.seed")
    return {
        "result computed by": f"ehlectric {summary['version']}",
        "date of the result": date,
        # Gear pairs that are not converged have no result.
        "converged": "no" if summary.get("converged") is False else "yes",
        "computing time": f"{readable(total)} s" if is_number(total) else "",
        "seed of the random numbers": "" if seed is None else str(seed),
    }


def lead_of(result: Any) -> str:
    """Main numbers of a result as a sentence."""
    line = ", ".join(filter(None, result.key_numbers()))
    if isinstance(result, BearingResult) and result.case.bearing.base:
        # The name of a bearing keeps its letters.
        line = f"Bearing {line}"
    return unbroken(f"{capital(line)}.")


def row_tables(rows: Iterable[Row], title: str) -> Iterator[Table | Text]:
    """Tables of rows, one for each heading, and a sentence about the bounds in them."""
    groups: list[tuple[str, list[Row]]] = [(title, [])]
    for row in rows:
        if row.heading:
            groups.append((printable(row.name), []))
        else:
            groups[-1][1].append(row)
    bounds: set[str] = set()
    for caption, group in groups:
        if not group:
            continue
        cells = tuple(tuple(_cells(row)) for row in group)
        bounds |= {row.bound for row in group}
        alarms = tuple(number for number, row in enumerate(group) if row.alarm)
        yield Table(caption, _HEADS, cells, numeric=(1,), alarms=alarms, shares=_SHARES)
    meanings = [text for bound, text in TEXTS["bounds"].items() if bound in bounds]
    if meanings:
        yield Text(" ".join(meanings))


def _cells(row: Row) -> Iterator[str]:
    name = printable(row.name)
    indent = "\u2003" * ((len(name) - len(name.lstrip(" "))) // 2)
    yield indent + name.strip()
    yield unbroken(row.bounded)
    yield printable(row.unit).replace(" ", "\xa0")
    yield printable(row.note.lstrip(",; ").strip())


def cell_table(table: RichTable, caption: str, first: str = "element") -> Table:
    """Table of a report from one of the terminal; columns that are aligned to the right stay so."""
    from rich.text import Text as RichText

    columns = table.columns
    heads = tuple(_plain(column.header, RichText).replace("\n", " ").strip() or first for column in columns)
    rows = zip(*([_plain(cell, RichText) for cell in column.cells] for column in columns), strict=True)
    numeric = tuple(number for number, column in enumerate(columns) if column.justify == "right")
    return Table(caption, heads, tuple(tuple(row) for row in rows), numeric=numeric)


def _plain(cell: object, text: type) -> str:
    """Cell of a table of the terminal as plain text."""
    return cell.plain if isinstance(cell, text) else str(text.from_markup(str(cell)).plain)  # type: ignore[attr-defined]


def density_tables(densities: Mapping[str, float | None]) -> Iterator[Table]:
    """Table of the published limits next to current densities over Hertz areas [A/m²], by the name of the
    bearing; none without a current.
    """
    known = {place: density for place, density in densities.items() if density}
    if not known:
        return
    limits = zip(CURRENT_DENSITY_LIMITS, TEXTS["density_limits"], strict=True)
    rows = tuple(
        (
            f"{1e-6 * limit:g} A/mm²",
            *("above" if density > limit else "below" for density in known.values()),
            about["text"],
            Link(f"{about['citation']}, ", DOI + about["doi"]),
        )
        for limit, about in limits
    )
    places = (f"{place}, {readable(1e-6 * density)} A/mm²" for place, density in known.items())
    heads = ("published limit", *places, "what is published", "source")
    shares = (0.11, *(0.3 / len(known) for _ in known), 0.3, 0.29)
    yield Table("Current density next to its published limits", heads, rows, shares=shares)


def warning_block(warnings: Sequence[ResultWarning]) -> Warnings | Text:
    """Warnings by kind with their meaning, the severe ones first; a sentence where there are none."""
    if not warnings:
        return Text("The result has no warnings.")
    ordered = sorted(warnings, key=lambda warning: _SEVERITIES.index(warning.severity))
    kinds: dict[tuple[Severity, str], list[str]] = {}
    for warning in ordered:
        kinds.setdefault((warning.severity, warning.code), []).append(worded(printable(warning.text)))
    return Warnings(
        tuple(
            WarningLine(severity, code, CODES[code].meaning, tuple(texts))
            for (severity, code), texts in kinds.items()
        )
    )


def alarms_of(warnings: Iterable[ResultWarning], failure: str) -> Iterator[Text]:
    """Sentences that stand at the top of a report: why its numbers must not be used. ``failure``, what is not
    solved; empty where all is.
    """
    if failure:
        yield Text(failure, "alarm")
    severe = dict.fromkeys(warning.code for warning in warnings if warning.severity == "severe")
    for code in severe:
        yield Text(f"Do not use the numbers: {CODES[code].meaning}", "alarm")


def caption_of(name: str, *, converged: bool) -> str:
    """Caption of a figure; it states if the result is not converged.

    Examples
    --------
    >>> caption_of("film_map", converged=True)
    'Film thickness, with contours and the position of the minimum.'
    """
    of_sweeps = TEXTS["swept_captions"].items()
    swept = next((caption for start, caption in of_sweeps if name.startswith(start)), "")
    text = with_units_kept(TEXTS["captions"].get(name, swept))
    return " ".join(filter(None, ["" if converged else SENTENCES["unconverged_figure"], text]))


# Sentences instead of figures that have nothing to show.
_EMPTY: Mapping[str, str] = MappingProxyType(
    {"breakdown_over_speed": "There is no figure of the breakdown voltage over the speed: no speed has one."}
)

# Marks of formulas in titles, which matplotlib draws.
_FORMULA = re.compile(r"(?<!\\)\$|\\mathrm|[{}]")


def pictures_of(
    result: Any, *, converged: bool, names: Iterable[str] | None = None
) -> Iterator[Picture | Text]:
    """Figures of a result; a sentence instead of a figure that has nothing to show. ``converged``, whether
    the result is converged; captions state if it is not.
    """
    for name in figure_names(result) if names is None else names:
        block: Picture | Text = Text(f"The figure {name} could not be drawn.", "alarm")
        with drawing(f"figure {name}"):
            try:
                drawn = figure(result, name, style="screen")
            except InputError as error:
                yield Text(_EMPTY.get(name) or f"The figure {name} is not drawn: {error.text}.")
                continue
            title = title_of(drawn)
            if title and converged:
                _drop_finding(drawn)
            # What fails in drawing fails here, and not in the middle of a file.
            drawn.draw_without_rendering()
            block = Picture(name, title or name, caption_of(name, converged=converged), drawn)
        yield block


def swept_names(result: Any, values: Iterable[str]) -> list[str]:
    """Names of the figures of a sweep that a report has, for these keys of the summary."""
    names = figure_names(result)
    of_values = [f"{way}{value}" for value in dict.fromkeys(values) for way in ("map_", "lines_")]
    return [name for name in ("sensitivity", *of_values) if name in names]


def title_of(drawn: Figure) -> str:
    """Title of a figure as plain text on one line."""
    lines = (line.strip() for line in drawn.get_suptitle().split("\n"))
    text = _FORMULA.sub("", " ".join(filter(None, lines)))
    return printable(text.replace(r"\$", "$").replace("\xa0", " "))


def _drop_finding(drawn: Figure) -> None:
    """Take the finding out of the title of a figure, as the caption has it; lines below it stay."""
    lines = drawn.get_suptitle().split("\n")
    below = "\n".join(line for line in lines if not line.strip())
    drawn.suptitle(below, x=0.01, ha="left")
