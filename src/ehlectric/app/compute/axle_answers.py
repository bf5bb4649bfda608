"""Answers about an axle: loads, films and voltages of all of its bearings and meshes, and its remedies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ehlectric.app.charts.axle_charts import ratios_figure
from ehlectric.app.compute.answer_parts import axle_of, gauge_text, lines_of, page_warnings_of
from ehlectric.app.view_models import AxleAnswer, Deciding, Gauge, Number, Table
from ehlectric.axle import AxleResult, solve_axle
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.rows import Summary
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import ratio_text, readable
from ehlectric.tables.axle_tables import axle_rows, element_cells, remedy_cells, shaft_cells

_TEXTS = data_file("ehlectric.app", "page_texts.toml")["axle"]

# Smallest change of a ratio that is a change [%].
_CHANGE = 1.0


def quick_answer(table: Mapping[str, Any], session: Path | None = None) -> AxleAnswer:
    """Answer about an axle without its remedies. Raises InputError if the tables are no valid axle, a bearing
    cannot carry its load, or gears cannot run together.
    """
    return answer_of(solve_axle(axle_of(table, session), remedies=False, probable=False), whole=False)


def whole_answer(table: Mapping[str, Any], session: Path | None = None) -> AxleAnswer:
    """Answer about an axle and its remedies; see ``quick_answer``."""
    return answer_of(solve_axle(axle_of(table, session)), whole=True)


def answer_of(result: AxleResult, *, whole: bool) -> AxleAnswer:
    """Answer of a solved axle; it is ``whole`` with its remedies."""
    summary, verdict = result.summary(), result.verdict
    remedies = summary["remedies"]
    heads, *rows = remedy_cells(summary) if remedies else ((),)
    return AxleAnswer(
        title=result.case.title,
        verdict=verdict,
        meaning=_meaning_of(verdict),
        how=_TEXTS["how"],
        shown=tuple(_numbers(summary)),
        deciding=_deciding(summary, verdict),
        lines=lines_of(axle_rows(summary)),
        warnings=page_warnings_of(result.warnings),
        figures={"ratios": ratios_figure(result)},
        seconds=summary["seconds"],
        whole=whole or not result.case.remedies,
        solvable=False,
        elements=_table(_TEXTS["elements"], element_cells(summary)),
        shafts=_table(_TEXTS["shafts"], shaft_cells(summary)),
        remedies=Table(_TEXTS["remedies"], heads, tuple(rows)) if remedies else None,
        effects=tuple(_effects(summary)),
    )


def _table(caption: str, cells: Iterator[tuple[str, ...]]) -> Table:
    heads, *rows = cells
    return Table(caption, heads, tuple(rows))


def _meaning_of(verdict: Verdict) -> str:
    """What a verdict means for the axle, in plain words."""
    return str(_TEXTS["meanings"].get(verdict.code, _TEXTS["meanings"][verdict.level]))


def _numbers(summary: Summary) -> Iterator[Number]:
    """Main numbers: margin and voltages of the first element, and voltage of the edge."""
    labels = _TEXTS["numbers"]
    first = next((row for row in summary["elements"] if row["rank"] == 1 and row["voltage_ratio"]), None)
    if first is not None:
        yield Number("first.margin", labels["margin"], ratio_text(1.0 / first["voltage_ratio"]))
        yield Number("first.voltage", labels["voltage"], readable(first["voltage"]), "V")
        yield Number(
            "first.breakdown_voltage", labels["breakdown"], readable(first["breakdown_voltage"]), "V"
        )
    yield Number("edge.voltage", labels["edge"], readable(summary["edge"]["voltage"]), "V")


def _deciding(summary: Summary, verdict: Verdict) -> Deciding:
    """Margin of the first element, with its name and its voltages."""
    first = next((row for row in summary["elements"] if row["rank"] == 1), None)
    margin, interval = verdict.margin, verdict.interval
    if first is None or margin is None or interval is None:
        return Deciding("edge.voltage", figure="ratios")
    facts = (
        ("first element", first["element"]),
        ("margin, within what is uncertain", " to ".join(map(ratio_text, interval))),
    )
    gauge = Gauge(gauge_text(margin, facts), margin, interval)
    return Deciding("first.margin", facts, gauge, "ratios")


def _effects(summary: Summary) -> Iterator[str]:
    """Sentence on the effect of each remedy on all elements."""
    texts = _TEXTS["effects"]
    now = _ratios(summary)
    for remedy in summary["remedies"]:
        then, rank = _ratios(remedy), remedy["rank"]["by-film"]
        both = [name for name in now if name in then]
        change = {name: 100.0 * (then[name] / now[name] - 1.0) for name in both if now[name] > 0.0}
        parts = [
            texts[word].format(elements=", ".join(names))
            for word, names in (
                ("lower", [name for name, value in change.items() if value < -_CHANGE]),
                ("higher", [name for name, value in change.items() if value > _CHANGE]),
                ("gone", [name for name in now if name not in then]),
                ("new", [name for name in then if name not in now]),
            )
            if names
        ] or [texts["none"]]
        if change and all(value < -_CHANGE for value in change.values()) and len(change) == len(now):
            parts = [texts["all_lower"]]
        first = rank[0] if rank and then.get(rank[0], 0.0) > 0.0 else None
        if first is not None:
            word = "first_above" if then[first] > 1.0 else "first_below"
            parts.append(texts[word].format(element=first, ratio=readable(then[first])))
        yield f"{remedy['title']}: {' '.join(parts)}"


def _ratios(summary: Summary) -> dict[str, float]:
    """Voltages over breakdown voltages by the names of elements that have one."""
    return {
        row["element"]: row["voltage_ratio"]
        for row in summary["elements"]
        if row["voltage_ratio"] is not None
    }
