"""Tables of an axle: its bearings and gear meshes, and its shafts."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ehlectric.errors import printable
from ehlectric.quantities.formats import time_share_text
from ehlectric.quantities.rows import Row, Summary
from ehlectric.readable import readable
from ehlectric.tables.measured_tables import columns_table

if TYPE_CHECKING:
    from rich.table import Table

# Letters on a line of a head.
_HEAD = 12

# Factor from rad/s to rpm.
_RPM = 9.549296585513721


def _cell(value: float | None, factor: float = 1.0) -> str:
    """Number of a table; a dash for none."""
    return "–" if value is None else readable(factor * value)


def element_cells(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the table of bearings and meshes, then a row for each, the first to break down
    first.
    """
    yield "", "F_r [N]", "F_a [N]", "lambda", "C [nF]", "V_b [V]", "U [V]", "U/V_b"
    for row in _in_order(summary):
        yield (
            printable(row["element"]),
            _cell(row["radial_load"]),
            _cell(row["axial_load"]),
            _cell(row["lambda_ratio"]),
            _cell(row["capacitance"], 1e9),
            _cell(row["breakdown_voltage"]),
            _cell(row["voltage"]),
            _cell(row["voltage_ratio"]),
        )


def _in_order(summary: Summary) -> list[Mapping[str, Any]]:
    """Rows of all elements by their rank; elements without a rank are last."""
    rows = summary["elements"]
    return sorted(rows, key=lambda row: len(rows) + 1 if row["rank"] is None else row["rank"])


def elements_table(summary: Summary) -> Table:
    """Table of all bearings and meshes of an axle, for the terminal."""
    heads, *rows = element_cells(summary)
    return columns_table((printable(summary["title"]), *heads[1:]), rows, wrapped=(0,))


def shaft_cells(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the table of shafts, then a row for each."""
    yield "shaft", "speed [rpm]", "torque [N m]", "U [V]", "all meshes conduct", "none conducts"
    for row in summary["shafts"]:
        yield (
            printable(row["shaft"]),
            _cell(row["speed"], _RPM),
            _cell(row["torque"]),
            _cell(row["voltage"]),
            _cell(row["voltage_always"]),
            _cell(row["voltage_never"]),
        )


def shafts_table(summary: Summary) -> Table:
    """Table of all shafts of an axle, for the terminal."""
    heads, *rows = shaft_cells(summary)
    return columns_table(heads, rows)


def remedy_cells(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the table of remedies, then U/V_b of each bearing and mesh, then the voltages. A
    dash is an element that conducts or has no breakdown voltage.
    """
    cases = [("as it is", summary), *((each["title"], each) for each in summary["remedies"])]
    yield "U/V_b", *(printable(title) for title, _ in cases)
    ratios = [{row["element"]: row["voltage_ratio"] for row in table["elements"]} for _, table in cases]
    for row in _in_order(summary):
        yield printable(row["element"]), *(_cell(table.get(row["element"])) for table in ratios)
    for number, shaft in enumerate(summary["shafts"]):
        voltages = (_cell(table["shafts"][number]["voltage"]) for _, table in cases)
        yield f"U of {printable(shaft['shaft'])} [V]", *voltages


def remedies_table(summary: Summary) -> Table:
    """Table of U/V_b of all bearings and meshes with each remedy, for the terminal."""
    heads, *rows = remedy_cells(summary)
    return columns_table(["\n".join(textwrap.wrap(head, _HEAD)) for head in heads], rows, wrapped=(0,))


def axle_rows(summary: Summary) -> Iterator[Row]:
    """Rows of an axle: each bearing and each mesh under a heading, and the voltages of the shafts."""
    edge = summary["edge"]["voltage"]
    yield Row("edge of the common-mode voltage", edge, "V")
    yield Row("voltages of the shafts after an edge")
    for row in summary["shafts"]:
        yield Row(printable(row["shaft"]), row["voltage"], "V")
    for row in _in_order(summary):
        yield Row(printable(row["element"]))
        yield Row(
            "electrical state",
            row["state"],
            note=f", metallic contact {time_share_text(row['contact_time_share'])}",
        )
        if row["radial_load"] is not None:
            yield Row("radial load", row["radial_load"], "N")
            yield Row("axial force along z", row["axial_load"], "N")
        yield Row("lambda ratio", row["lambda_ratio"])
        yield Row("capacitance", row["capacitance"], "pF")
        if row["breakdown_voltage"] is not None:
            yield Row("breakdown voltage", row["breakdown_voltage"], "V")
        yield Row("voltage after an edge", row["voltage"], "V")
        if row["voltage_ratio"] is not None:
            yield Row("voltage / breakdown voltage", row["voltage_ratio"])
