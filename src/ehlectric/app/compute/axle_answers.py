"""Answers about an axle: loads, films and voltages of all of its bearings and meshes, and its remedies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ehlectric.app.charts.axle_charts import ratios_figure, simulated_figures
from ehlectric.app.compute.answer_parts import (
    at_operating_point,
    axle_of,
    gauge_text,
    lines_of,
    page_warnings_of,
    percent_of,
    usable,
)
from ehlectric.app.view_models import (
    AXLE_WITHOUT_PROBABILITY,
    PENDING,
    AxleAnswer,
    Deciding,
    Gauge,
    NetworkNode,
    NetworkPart,
    Number,
    Table,
)
from ehlectric.axle import AxleResult, ratio_word, solve_axle, worst_ratio
from ehlectric.cases.axle_case import AxleCase
from ehlectric.drive import HOUSING, SIMULATING
from ehlectric.errors import InputError, printable
from ehlectric.figures.network_elements import elements_of_network
from ehlectric.quantities.formats import amount_text
from ehlectric.quantities.lubrication_states import CONDUCTS, NO_LIMIT, TOUCHES
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.rows import Summary
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import ratio_text, readable
from ehlectric.runs.by_kind import run_axle
from ehlectric.runtime.progress import Progress
from ehlectric.tables.axle_tables import (
    axle_rows,
    chance_cells,
    element_cells,
    remedy_cells,
    shaft_cells,
    simulation_cells,
)

_TEXTS = data_file("ehlectric.app", "page_texts.toml")["axle"]

# Statements of the verdict that say no more than the margin with its facts.
_SAID = (AXLE_WITHOUT_PROBABILITY,)

# Smallest change of a number that is a change [%], and signs of changes.
_CHANGE, _SIGNS = 1.0, {-1: " ▼", 0: "", 1: " ▲"}


def quick_answer(table: Mapping[str, Any], session: Path | None = None) -> AxleAnswer:
    """Answer about an axle without its remedies and without probabilities. Raises InputError if the tables
    are no valid axle, a bearing cannot carry its load, or gears cannot run together.
    """
    return answer_of(solve_axle(axle_after_an_edge(table, session), remedies=False, probable=False))


def remedied_answer(table: Mapping[str, Any], session: Path | None = None) -> AxleAnswer:
    """Answer about an axle and its remedies, without probabilities; see ``quick_answer``."""
    return answer_of(solve_axle(axle_after_an_edge(table, session), probable=False))


def whole_answer(table: Mapping[str, Any], session: Path | None = None) -> AxleAnswer:
    """Answer about an axle and its remedies, with probabilities; see ``quick_answer``."""
    return answer_of(solve_axle(axle_after_an_edge(table, session)))


def axle_after_an_edge(table: Mapping[str, Any], session: Path | None) -> AxleCase:
    """Axle right after an edge, without a duty cycle and a simulated time."""
    case = axle_of(at_operating_point(table), session)
    return case.model_copy(update={"drive": case.drive.model_copy(update={"duration": None})})


def simulate(table: Mapping[str, Any], session: Path, folder: Path, progress: Progress) -> AxleAnswer:
    """Answer about an axle and its discharges over time, by the run that the command uses. Raises InputError
    if the tables are no valid axle, or it cannot be simulated.
    """
    case = axle_of(table, session)
    if case.drive.duration is None:
        raise InputError.missing("drive.duration", "the simulated time")
    progress(0, 0, SIMULATING)
    return answer_of(run_axle(case, folder, percent_of(progress)).result)


def answer_of(result: AxleResult) -> AxleAnswer:
    """Answer of a solved axle."""
    summary, verdict = result.summary(), result.verdict
    simulated = result.discharges is not None
    remedied = len(result.remedies) == len(result.case.numbered_remedies)
    return AxleAnswer(
        title=result.case.title,
        verdict=verdict,
        meaning=_meaning_of(verdict),
        how=_simulated_text(summary) if simulated else _TEXTS["how"],
        shown=tuple(usable(_numbers(summary), converged=summary["converged"])),
        deciding=_deciding(summary, verdict, probable=result.probable),
        lines=lines_of(axle_rows(summary)),
        warnings=page_warnings_of(result.warnings),
        figures={"ratios": ratios_figure(result), **simulated_figures(result, summary)},
        seconds=summary["seconds"],
        whole=remedied and result.probable,
        simulated=simulated,
        simulation=_table(_TEXTS["simulation"], simulation_cells(summary)) if simulated else None,
        network=tuple(_network(result)),
        # U/V_b and its voltages first: a narrow screen shows the first columns.
        elements=_table(_TEXTS["elements"], ((row[0], *row[:0:-1]) for row in element_cells(summary))),
        chances=_table(_TEXTS["chances"], chance_cells(summary)) if "uncertainty" in summary else None,
        shafts=_table(_TEXTS["shafts"], shaft_cells(summary)),
        remedies=_remedies(summary) if summary["remedies"] else None,
        remedied=remedied,
        effects=tuple(_effects(result, summary)),
    )


def _simulated_text(summary: Summary) -> str:
    """How a simulated answer was computed."""
    duration = amount_text(summary["simulation"]["duration"], "s")
    return str(_TEXTS["simulated"]).format(duration=duration, seconds=readable(summary["seconds"]))


def _network(result: AxleResult) -> Iterator[NetworkNode]:
    """Shafts with their parts; a part between two shafts belongs to the shaft that is nearer to the rotor."""
    solution, case = result.solution, result.case
    shown = sorted(elements_of_network(solution), key=lambda each: not each.voltage)
    shafts, potentials = list(solution.turning), solution.potentials()
    bases = dict(zip(case.names_of_bearings(), case.bearing, strict=True))
    for number, shaft in enumerate(shafts):
        further = {HOUSING, *shafts[number + 1 :]}
        parts: dict[bool, list[NetworkPart]] = {True: [], False: []}
        for each in shown:
            others = each.ends - {shaft}
            if len(others) == 1 and others <= further:
                words = [each.name]
                if (mounted := bases.get(each.film.name)) is not None:
                    words.append(str(mounted.keys.get("designation") or mounted.keys.get("base") or ""))
                elif HOUSING not in each.ends:
                    words.append(f"to {next(iter(others))}")
                parts[HOUSING in each.ends].append(
                    NetworkPart(
                        " ".join(filter(None, words)),
                        each.value,
                        each.voltage,
                        None if each.ratio is None else each.bar,
                        first=each.first,
                        conducts=each.film.conducts,
                    )
                )
        yield NetworkNode(
            shaft, f"{readable(potentials[shaft], 3)} V", tuple(parts[True]), tuple(parts[False])
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
    first = summary["first"]
    if first["element"] is not None:
        yield Number("first.margin", labels["margin"], ratio_text(first["margin"]))
        yield Number("first.voltage", labels["voltage"], readable(first["voltage"]), "V")
    if first["breakdown_voltage"] is not None:
        yield Number(
            "first.breakdown_voltage", labels["breakdown"], readable(first["breakdown_voltage"]), "V"
        )
    if "simulation" in summary:
        yield from _simulated_numbers(summary["simulation"])
    yield Number("edge.voltage", labels["edge"], readable(summary["edge"]["voltage"]), "V")


def _simulated_numbers(simulation: Summary) -> Iterator[Number]:
    """Rate and energy of the element with the most discharges, and the highest voltage of a shaft."""
    labels = _TEXTS["numbers"]
    most = max(simulation["elements"], key=lambda row: float(row["events_per_second"]), default=None)
    if most is not None and most["events"]:
        name = printable(most["element"])
        yield Number("simulated.rate", labels["rate"], readable(most["events_per_second"], 3), "1/s", name)
        energy, unit = f"{amount_text(most['energy_mean'], 'J')} ".split(" ")[:2]
        yield Number("simulated.energy", labels["energy"], energy, unit, name)
    elif most is not None:
        yield Number("simulated.rate", labels["rate"], "none", known=False)
    shaft = max(simulation["shafts"], key=lambda row: float(row["peak_voltage"]), default=None)
    if shaft is not None:
        rms = f"{printable(shaft['shaft'])}, rms {readable(shaft['rms_voltage'], 3)} V"
        yield Number("simulated.peak", labels["peak"], readable(shaft["peak_voltage"], 3), "V", rms)


def _deciding(summary: Summary, verdict: Verdict, *, probable: bool) -> Deciding:
    """Margin of the first element, with its name and its interval, which follows unless ``probable``."""
    first = summary["first"]["element"]
    margin, interval = verdict.margin, verdict.interval
    if first is None or margin is None:
        return Deciding("edge.voltage", figure="ratios")
    labels = _TEXTS["facts"]
    facts = [(labels["first"], first)]
    if not probable:
        interval = None
        facts.append((labels["interval"], PENDING))
    elif interval is not None:
        facts.append((labels["interval"], " to ".join(map(ratio_text, interval))))
    gauge = Gauge(gauge_text(margin, facts), margin, interval)
    return Deciding("first.margin", tuple(facts), gauge, "ratios", _SAID)


def _effects(result: AxleResult, summary: Summary) -> Iterator[str]:
    """Sentence on the effect of each remedy on all elements."""
    for remedy in summary["remedies"]:
        parts = _changed(result, _ratios(summary), remedy) or [_TEXTS["effects"]["none"]]
        sentences = [f"{'; '.join(parts)}.", *_then(remedy)]
        yield f"{remedy['title']}: {' '.join(sentences)}"


def _changed(result: AxleResult, now: dict[str, float], remedy: Summary) -> list[str]:
    """Parts of the sentence on a remedy: elements whose ratio changes, and elements without a ratio."""
    texts, then = _TEXTS["effects"], _ratios(remedy)
    words = {row["element"]: ratio_word(row) for row in remedy["elements"]}
    changes = {name: _change(now[name], then[name]) for name in now if name in then}
    groups = {
        "lower": [name for name, sign in changes.items() if sign < 0],
        "higher": [name for name, sign in changes.items() if sign > 0],
        "conduct": [name for name in now if words[name] == CONDUCTS],
        "gone": [name for name in now if words[name] == NO_LIMIT],
        "new": [name for name in then if name not in now],
        "touch": [name for name, word in words.items() if word == TOUCHES],
    }
    if len(changes) == len(now) and {*changes.values()} == {-1}:
        lowered = texts["all_with_ratio_lower" if groups["touch"] else "all_lower"]
        groups = {"touch": groups["touch"]}
    else:
        lowered = ""
    parts = [
        texts[word].format(elements=", ".join(_grouped(result, names)))
        for word, names in groups.items()
        if names
    ]
    return [lowered, *parts] if lowered else parts


def _then(remedy: Summary) -> Iterator[str]:
    """Sentences on the first element with a remedy, and on its dependence on the state of the meshes."""
    texts, first = _TEXTS["effects"], remedy["first"]
    if first["element"] is None:
        return
    if first["voltage_ratio"] is None:
        yield texts["first_touches"].format(element=first["element"])
        return
    word = "first_above" if first["voltage_ratio"] > 1.0 else "first_below"
    yield texts[word].format(element=first["element"], ratio=readable(first["voltage_ratio"]))
    worst = {row["element"]: worst_ratio(row) or 0.0 for row in remedy["elements"]}
    name = max(worst, key=lambda each: worst[each])
    if word == "first_below" and worst[name] > 1.0:
        yield texts["meshes_above"].format(element=name, ratio=readable(worst[name]))


def _change(before: float, after: float) -> int:
    """Sign of a change; 0 of one that is within 1 %."""
    if abs(after - before) <= 0.01 * _CHANGE * before:
        return 0
    return 1 if after > before else -1


def _grouped(result: AxleResult, names: list[str]) -> Iterator[str]:
    """Names of elements, with one name for both bearings of a shaft."""
    bearings = result.case.names_of_bearings()
    done: set[str] = set()
    for name in names:
        shaft = result.case.bearing[bearings.index(name)].shaft if name in bearings else None
        pair = [] if shaft is None else [bearings[number] for number in result.case.bearings_of(shaft)]
        if len(pair) == 2 and {*pair} <= {*names}:
            done.update(pair[1:] if name == pair[0] else ())
            if name == pair[0]:
                yield f"both bearings of {shaft}"
        elif name not in done:
            yield name


def _remedies(summary: Summary) -> Table:
    """Table of the remedies, with a sign at each change of more than 1 %."""
    heads, *rows = remedy_cells(summary)
    now, *others = (_by_row(each) for each in (summary, *summary["remedies"]))
    marked = [
        (
            name,
            first,
            *(
                f"{cell}{_sign(now.get(name), other.get(name))}"
                for cell, other in zip(cells, others, strict=True)
            ),
        )
        for name, first, *cells in rows
    ]
    return Table(_TEXTS["remedies"], heads, tuple(marked))


def _by_row(summary: Summary) -> dict[str, float]:
    """Numbers of the table of the remedies by the names of its rows."""
    return {
        **{printable(name): ratio for name, ratio in _ratios(summary).items()},
        **{f"U of {printable(row['shaft'])} [V]": row["voltage"] for row in summary["shafts"]},
    }


def _sign(before: float | None, after: float | None) -> str:
    return "" if before is None or after is None else _SIGNS[_change(before, after)]


def _ratios(summary: Summary) -> dict[str, float]:
    """Voltages over breakdown voltages by the names of elements that have one."""
    return {
        row["element"]: row["voltage_ratio"]
        for row in summary["elements"]
        if row["voltage_ratio"] is not None
    }
