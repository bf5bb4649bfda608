"""Tables of oils and bearings of the library: lists, and the values, laws and sources of one oil."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from types import MappingProxyType
from typing import Any, BinaryIO

from rich.table import Table

from ehlectric.cases.case_oil import known_oil, named_oil
from ehlectric.cases.library.bearing_catalogue import CatalogueBearing
from ehlectric.cases.library.library_oils import KINDS, LibraryOil
from ehlectric.cases.oil_report import OilReport, SurveyLine, celsius, depends_on_temperature, survey
from ehlectric.quantities.sheets import OILS
from ehlectric.readable import readable
from ehlectric.runtime.files import column_head, csv_of
from ehlectric.tables.measured_tables import columns_table

CSV_FILE = "oil.csv"

# Letter of each kind of source behind a number.
LETTERS: Mapping[str, str] = MappingProxyType({kind: kind[0] for kind in KINDS})
assert len(set(LETTERS.values())) == len(LETTERS)

# Temperatures of the list [K].
_LISTED = (313.15, 373.15)


def listed_oil(oil: LibraryOil) -> dict[str, Any]:
    """Numbers of an oil of the library by name, SI units, as ``ehlectric oils --json`` prints them.

    A number is None where its value is missing or the temperature is outside the range of the oil. The
    numbers of an oil without temperature hold at one that its source does not name.
    """
    named = named_oil(oil.name)
    table = named.table
    ends = table.temperature_range
    kelvins: list[float | None] = [None]
    if depends_on_temperature(table):
        kelvins = [at for at in _LISTED if ends is None or ends[0] <= at <= ends[1]]
    lines = {line.of.name: line for line in survey(named, [known_oil(table, at) for at in kelvins], ())}
    values: dict[str, Any] = {}
    for key, name, kelvin, _ in OILS["columns"]:
        # An oil without temperature has one value, which stands in the first column.
        at = kelvin if kelvin in kelvins or kelvin != _LISTED[0] else None
        line = lines[name]
        value = line.values[kelvins.index(at)] if at in kelvins else None
        values[key] = None if value is None else {"value": value, "unit": line.of.unit, "kind": line.kind}
    return {
        "name": oil.name,
        "title": oil.title,
        "temperature_range": ends,
        **values,
        "weakest": oil.weakest,
        "needs": oil.needs,
    }


def listed_tables(listed: Sequence[Mapping[str, Any]]) -> Iterator[Table]:
    """Tables of the oils of the library: numbers with the letters of their kinds, and what each oil is."""
    heads = ("\n\nname", "\nrange\n[°C]", *(head for *_, head in OILS["columns"]))
    numbers = (
        (oil["name"], _span(oil), *(_lettered(oil[key]) for key, *_ in OILS["columns"])) for oil in listed
    )
    yield columns_table(heads, numbers)
    about = ((oil["name"], oil["title"], "\n".join(oil["needs"])) for oil in listed)
    yield columns_table(("name", "oil", "the case must give"), about, left=range(3), wrapped=(1,))


def _span(oil: Mapping[str, Any]) -> str:
    """Range of temperatures of an oil [°C]."""
    ends = oil["temperature_range"]
    return "any" if ends is None else " to ".join(celsius(end).removesuffix(" °C") for end in ends)


def _lettered(entry: Mapping[str, Any] | None) -> str:
    """Number in its shown unit with the letter of its kind; a dash without a number."""
    if entry is None:
        return "-  "
    factor, _ = OILS["units"][entry["unit"]]
    return f"{readable(factor * entry['value'], 4)} {LETTERS.get(entry['kind'], ' ')}"


def heading(report: OilReport) -> str:
    """Name of an oil, what it is, and the range of its temperatures."""
    named = report.named
    ends = named.table.temperature_range
    span = "" if ends is None else f"; {celsius(ends[0])} to {celsius(ends[1])}"
    return ": ".join(filter(None, (named.name, named.title))) + span


def values_table(report: OilReport) -> Table:
    """Table of the values of an oil: properties and pressures below each other, temperatures next to each
    other.
    """
    heads = ["", *(celsius(kelvin) or "as given" for kelvin in report.temperatures)]
    rows = []
    for line in _shown(report):
        _, unit = _unit(line)
        rows.append((f"{_name(line)} [{unit}]" if unit else _name(line), *_cells(report, line)))
    return columns_table(heads, rows)


def _shown(report: OilReport) -> Iterator[SurveyLine]:
    """Lines of a report without lines at pressure that are missing at ambient pressure already."""
    gone = {line.of.name for line in report.lines if line.pressure == 0.0 and line.missing}
    yield from (line for line in report.lines if line.pressure == 0.0 or line.of.name not in gone)


def _name(line: SurveyLine) -> str:
    """Name of a line; lines at pressure stand indented below the line at ambient pressure."""
    if line.pressure == 0.0:
        return line.of.title
    at = f"at {line.pressure / 1e9:g} GPa"
    return f"{line.of.title} {at}" if line.of.name == "density_ratio" else f"  {at}"


def _unit(line: SurveyLine) -> tuple[float, str]:
    """Factor from the SI unit to the shown unit of a line, and this unit."""
    if line.pressure > 0.0 and line.of.unit == "Pa*s":
        return 1.0, "Pa s"
    factor, unit = OILS["units"][line.of.unit]
    return factor, unit


def _cells(report: OilReport, line: SurveyLine) -> Iterator[str]:
    """Values of a line as text: why there is none, and a star beyond the range of the law."""
    factor, _ = _unit(line)
    for oil, value in zip(report.oils, line.values, strict=True):
        if value is None:
            beyond = line.pressure > 0.0 and all(key in oil.laws for key in line.of.laws)
            yield "beyond a pole" if beyond else "missing"
        else:
            yield f"{readable(factor * value, 4)}{'*' if report.beyond(line, oil) else ''}"


def behind_table(report: OilReport) -> Table:
    """Table of the law, the kind and the numbers of the sources behind each property."""
    number = {source: k for k, source in enumerate(report.sources, 1)}
    rows: dict[tuple[str, bool], tuple[str, ...]] = {}
    for line in _shown(report):
        compressed = line.pressure > 0.0
        if line.missing or (line.of.name, compressed) in rows:
            continue
        name = "  compressed" if compressed and line.of.name != "density_ratio" else line.of.title
        numbers = ", ".join(str(number[source]) for source in line.sources)
        rows[line.of.name, compressed] = (name, line.law, line.kind, numbers)
    return columns_table(("property", "law", "weakest source", "sources"), rows.values(), left=range(4))


def sources_table(report: OilReport) -> Table:
    """Table of the sources by number: kind, citation with DOI, and remark."""
    rows = []
    for number, source in enumerate(report.sources, 1):
        doi = f", doi:{source.doi}" if source.doi else ""
        rows.append((str(number), source.kind, f"{source.citation}{doi}\n{source.note}".strip()))
    return columns_table(("", "kind", "source"), rows, left=(1, 2), wrapped=(1, 2))


def csv_content(report: OilReport) -> Callable[[BinaryIO], None]:
    """Function that writes the values of an oil as CSV: a row for each property, temperature and pressure."""
    heads = (
        "property", "unit", column_head("temperature", "K"), column_head("pressure", "Pa"), "value",
        "beyond_range", "law", "kind", "sources", "remarks",
    )  # fmt: skip
    return csv_of(heads, _csv_rows(report))


def _csv_rows(report: OilReport) -> Iterator[list[Any]]:
    for line in report.lines:
        cited = "; ".join(f"{s.citation}{f' doi:{s.doi}' if s.doi else ''}" for s in line.sources)
        notes = " ".join(source.note for source in line.sources if source.note)
        for oil, value in zip(report.oils, line.values, strict=True):
            number = "missing" if value is None else value
            yield [
                line.of.name, line.of.unit or "-", oil.temperature, line.pressure, number,
                report.beyond(line, oil), line.law, line.kind, cited, notes,
            ]  # fmt: skip


# Heads of the columns after the name.
_HEADS = (
    *("bore\n[mm]", "outer\n[mm]", "width\n[mm]", "elements\n[mm]", "pitch\n[mm]", "angle\n[deg]"),
    *("C\n[kN]", "C0\n[kN]"),
)


def described(bearing: CatalogueBearing) -> dict[str, Any]:
    """Values of a bearing by name, as ``ehlectric bearings --json`` prints them: SI units, angles in rad."""
    rating = bearing.rating
    lengths = ("bore", "outer_diameter", "width", "element_diameter", "roller_length", "pitch_diameter")
    return {
        "name": bearing.name,
        "kind": bearing.kind,
        "elements": bearing.elements,
        **{key: getattr(bearing, key) for key in lengths},
        "contact_angle": bearing.contact_angle,
        "dynamic_rating": rating and rating.dynamic,
        "static_rating": rating and rating.static,
        "rating_of": rating and f"{rating.maker} {rating.designation}",
        "internal_geometry": bearing.internal_kind,
    }


def catalogue_tables(bearings: Iterable[CatalogueBearing]) -> Iterator[Table]:
    """Tables of bearings, one for each kind, with dimensions, printed ratings and kind of the sources, at
    most 80 characters wide.
    """
    ordered = sorted(bearings, key=lambda bearing: bearing.kind)
    for kind, group in groupby(ordered, key=lambda bearing: bearing.kind):
        heads = ("name", *_HEADS, "elements\nare")
        rows = ((bearing.name, *_bearing_cells(bearing), bearing.internal_kind or "") for bearing in group)
        table = columns_table(heads, rows, f"{kind} bearings", left=(0, len(heads) - 1))
        table.title_style = "bold"
        yield table


def _bearing_cells(bearing: CatalogueBearing) -> Iterator[str]:
    yield from (_millimetres(size) for size in (bearing.bore, bearing.outer_diameter, bearing.width))
    sizes = filter(None, (bearing.element_diameter, bearing.roller_length))
    yield " x ".join([str(bearing.elements), *map(_millimetres, sizes)])
    yield _millimetres(bearing.pitch_diameter)
    yield readable(math.degrees(bearing.contact_angle), 4) if bearing.contact_angle else ""
    rating = bearing.rating
    yield from (
        ("", "") if rating is None else (readable(1e-3 * f, 4) for f in (rating.dynamic, rating.static))
    )


def _millimetres(length: float) -> str:
    return readable(1e3 * length, 5)
