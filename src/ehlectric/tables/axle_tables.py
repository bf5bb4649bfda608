"""Tables of an axle: its bearings and gear meshes, and its shafts."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ehlectric.axle import ratio_word, worst_ratio
from ehlectric.errors import printable
from ehlectric.quantities.formats import time_share_text
from ehlectric.quantities.lubrication_states import CONDUCTS
from ehlectric.quantities.rows import Row, Summary
from ehlectric.readable import readable
from ehlectric.tables.measured_tables import columns_table
from ehlectric.tables.probability_rows import left_out_of_probability, shares_above_all, shares_of_spread

if TYPE_CHECKING:
    from rich.table import Table

# Share of a spread below which the shares of the inputs in it are called rough (engineering judgement).
_PREDICTED = 0.9

# Probability from which the table contains a row for no first element.
_LEAST_NONE = 5e-5

# Letters on a line of a head.
_HEAD = 12

# Factor from rad/s to rpm.
_RPM = 9.549296585513721


def _cell(value: float | None, factor: float = 1.0) -> str:
    """Number of a table; a dash for none."""
    return "–" if value is None else readable(factor * value)


def _to_housing(summary: Summary, value: float | None) -> str:
    """Voltage of a shaft or a bearing, a lower bound where capacitances of bearings are upper bounds."""
    bound = "≥ " if value is not None and "capacitance-bound" in summary["warning_codes"] else ""
    return f"{bound}{_cell(value)}"


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
            _cell(row["voltage"]) if row["radial_load"] is None else _to_housing(summary, row["voltage"]),
            ratio_word(row) or _cell(row["voltage_ratio"]),
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
            *(_to_housing(summary, row[key]) for key in ("voltage", "voltage_always", "voltage_never")),
        )


def shafts_table(summary: Summary) -> Table:
    """Table of all shafts of an axle, for the terminal."""
    heads, *rows = shaft_cells(summary)
    return columns_table(heads, rows)


def remedy_cells(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the table of remedies, then U/V_b of each bearing and mesh, then the voltages.

    A cell contains in brackets the largest U/V_b if all meshes conduct, or none, where it exceeds U/V_b. A
    word replaces U/V_b of an element without one.
    """
    cases = [("as it is", summary), *((each["title"], each) for each in summary["remedies"])]
    yield "U/V_b", *(printable(title) for title, _ in cases)
    ratios = [{row["element"]: ratio_text(row) for row in table["elements"]} for _, table in cases]
    for row in _in_order(summary):
        yield printable(row["element"]), *(table.get(row["element"], "–") for table in ratios)
    for number, shaft in enumerate(summary["shafts"]):
        voltages = (_to_housing(table, table["shafts"][number]["voltage"]) for _, table in cases)
        yield f"U of {printable(shaft['shaft'])} [V]", *voltages


def ratio_text(row: Mapping[str, Any]) -> str:
    """U/V_b of a row of ``elements``, or a word; in brackets the largest U/V_b if all meshes conduct, or
    none.
    """
    worst = worst_ratio(row)
    return ratio_word(row) or _cell(row["voltage_ratio"]) + ("" if worst is None else f" ({readable(worst)})")


def remedies_table(summary: Summary) -> Table:
    """Table of U/V_b of all bearings and meshes with each remedy, for the terminal."""
    return _wrapped_table(remedy_cells(summary), REMEDIES)


# What the table of remedies shows.
REMEDIES = "U/V_b with each mitigation measure; in brackets the largest U/V_b if all meshes conduct, or none"


def _wrapped_table(cells: Iterator[tuple[str, ...]], title: str = "") -> Table:
    """Table for the terminal whose heads, titles of remedies, are wrapped."""
    heads, *rows = cells
    wrapped = ["\n".join(textwrap.wrap(head, _HEAD, break_long_words=False)) for head in heads]
    return columns_table(wrapped, rows, title, wrapped=(0,))


def simulation_cells(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the table of discharges over time, then a row for each bearing and mesh, and for
    each shaft. U is the median voltage, and W the mean energy with its 95th percentile.
    """
    yield "discharges", "1/s", "U [V]", "W [nJ]", "95 %", "peak [V]", "rms [V]"
    for row in summary["simulation"]["elements"]:
        yield (
            printable(row["element"]),
            _cell(row["events_per_second"]),
            _cell(row["voltage_median"]),
            _cell(row["energy_mean"], 1e9),
            _cell(row["energy_high"], 1e9),
            _cell(row["peak_voltage"]),
            _cell(row["rms_voltage"]),
        )
    for row in summary["simulation"]["shafts"]:
        voltages = _cell(row["peak_voltage"]), _cell(row["rms_voltage"])
        yield f"shaft {printable(row['shaft'])}", "", "", "", "", *voltages


def simulation_table(summary: Summary) -> Table:
    """Table of the discharges of all bearings and meshes and the voltages of all shafts over time."""
    heads, *rows = simulation_cells(summary)
    return columns_table(heads, rows, wrapped=(0,))


def remedied_simulation_cells(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the table of discharges with each remedy, then the discharges in a second of each
    bearing and mesh, and their mean energies. A dash is an element that has no discharge.
    """
    cases = [("as it is", summary), *((each["title"], each) for each in summary["remedies"])]
    yield "discharges [1/s]", *(printable(title) for title, _ in cases)
    in_time = [case.get("simulation") or {} for _, case in cases]
    tables = [{row["element"]: row for row in table.get("elements", ())} for table in in_time]
    for name, key, unit, factor in (
        ("{}", "events_per_second", "", 1.0),
        ("W of {}", "energy_mean", "nJ", 1e9),
    ):
        for row in summary["elements"]:
            if any(row["element"] in table for table in tables):
                head = name.format(printable(row["element"])) + (unit and f" [{unit}]")
                of_cases = [table and table.get(row["element"]) for table in tables]
                yield head, *(CONDUCTS if of is None else _cell(of.get(key), factor) for of in of_cases)
    yield "power of all [µW]", *(_cell(table.get("power"), 1e6) for table in in_time)


def remedied_simulation_table(summary: Summary) -> Table:
    """Table of the discharges of all bearings and meshes with each remedy, for the terminal."""
    return _wrapped_table(remedied_simulation_cells(summary))


def chance_cells(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the table of probabilities, then a row for each bearing and mesh, the most probable
    first element first. None without probabilities.
    """
    table = summary.get("uncertainty")
    if table is None:
        return
    yield "probability [%]", "first", "breaks down", "summits touch", "conducts", "U/V_b, 5 to 95 %"
    for row in sorted(table["elements"], key=lambda each: -each["first_probability"]):
        yield (
            printable(row["element"]),
            *(
                readable(100.0 * row[key], 2)
                for key in (
                    "first_probability",
                    "breakdown_probability",
                    "asperity_contact_probability",
                    "conduction_probability",
                )
            ),
            _between(row["voltage_ratio_low"], row["voltage_ratio_high"]),
        )
    # Results of earlier versions lack this probability.
    none = table.get("none_first_probability") or 0.0
    if none >= _LEAST_NONE:
        yield "none", readable(100.0 * none, 2), "", "", "", ""


def _between(low: float | None, high: float | None) -> str:
    """Text of a range; a ratio is infinite if summits touch."""
    ends = ["touching" if end is None else readable(end, 2) for end in (low, high)]
    return ends[0] if ends[0] == ends[1] else " to ".join(ends)


def chances_table(summary: Summary) -> Table:
    """Table of the probabilities of all bearings and meshes, for the terminal."""
    heads, *rows = chance_cells(summary)
    return columns_table(heads, rows, wrapped=(0,))


def duty_cells(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the table of a duty cycle, then a row for each bearing and mesh, the element that is
    the first for the longest time on top. None without a duty cycle.
    """
    table = summary.get("duty")
    if table is None:
        return
    yield "share of the cycle [%]", "first", "U ≥ V_b", "summits touch", "conducts", "largest U/V_b", "at"
    for row in sorted(table["elements"], key=lambda each: -each["first_share"]):
        shares = (row[f"{key}_share"] for key in ("first", "breakdown", "touching", "conducting"))
        time = row["largest_time"]
        yield (
            printable(row["element"]),
            *(readable(100.0 * share, 2) for share in shares),
            _cell(row["largest_ratio"]),
            "–" if time is None else f"{readable(time)} s",
        )


def duty_table(summary: Summary) -> Table:
    """Table of the duty cycle of all bearings and meshes, for the terminal."""
    heads, *rows = duty_cells(summary)
    return columns_table(heads, rows, wrapped=(0,))


def chance_rows(summary: Summary) -> Iterator[Row]:
    """Rows of the uncertain inputs, and of the inputs that decide which element is first."""
    yield from shares_of_spread(summary)
    table = summary.get("uncertainty") or {}
    yield from _rough_shares(table, "predicted")
    if table.get("deciding"):
        first, second = map(printable, table["deciding_elements"])
        yield Row(f"inputs that decide whether {first} or {second} is first")
        for each in table["deciding"]:
            share = f"{readable(100.0 * each['total'], 2)} % of the spread"
            yield Row(printable(each["label"]), share, key=f"uncertainty.deciding.{each['key']}")
        yield from shares_above_all([each["total"] for each in table["deciding"]])
        yield from _rough_shares(table, "deciding_predicted")
    yield from left_out_of_probability(summary)


def _rough_shares(table: Mapping[str, Any], key: str) -> Iterator[Row]:
    """Row of the share of a spread that a polynomial of the inputs predicts, if it is small."""
    predicted = table.get(key)
    if predicted is not None and predicted < _PREDICTED:
        text = f"{readable(100.0 * max(predicted, 0.0), 2)} % of the spread"
        yield Row("explained by the fit", text, note=", shares are approximate", key=f"uncertainty.{key}")


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
            yield Row("axial force on the bearing, along z", row["axial_load"], "N")
        yield Row("lambda ratio", row["lambda_ratio"])
        yield Row("capacitance", row["capacitance"], "pF")
        if row["breakdown_voltage"] is not None:
            yield Row("breakdown voltage", row["breakdown_voltage"], "V")
        yield Row("voltage after an edge", row["voltage"], "V")
        yield Row("voltage / breakdown voltage", ratio_word(row) or row["voltage_ratio"])
