"""Key figures of an axle, nested as in summary.json."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ehlectric.axle.solution import CONDUCTIONS, AxleSolution
from ehlectric.cases.gear_inputs import Conduction
from ehlectric.quantities.lubrication_states import word_without_ratio


def axle_summary(solution: AxleSolution) -> dict[str, Any]:
    """Tables ``edge``, ``first``, ``elements``, ``shafts`` and ``rank`` of summary.json, SI units; None for a
    value that is not known. ``voltage_ratio`` is the voltage divided by the breakdown voltage.
    """
    rankings = {conduction: solution.ranking(conduction) for conduction in CONDUCTIONS}
    return {
        "edge": {"voltage": solution.edge.voltage, "rise_time": solution.edge.rise_time},
        "first": _first(solution, rankings["by-film"]),
        "elements": _elements(solution, rankings),
        "shafts": _shafts(solution),
        "rank": {conduction: [name for name, _ in ranking] for conduction, ranking in rankings.items()},
        "changed_ranks": list(solution.changed_ranks),
    }


def ratio_word(row: Mapping[str, Any]) -> str:
    """Word for the reason why a row of ``elements`` has no voltage divided by breakdown voltage: that the
    element conducts, that its summits touch, or that it has no breakdown voltage. Empty if it has a ratio.
    """
    return word_without_ratio(row["state"], row["breakdown_voltage"], touching=row["touching"])


def worst_ratio(row: Mapping[str, Any]) -> float | None:
    """Largest voltage divided by breakdown voltage of a row of ``elements`` if all meshes conduct, or none.

    None if the element has no ratio, or if its ratio is not exceeded by more than 1 %.
    """
    ratio = row["voltage_ratio"]
    others = [row[f"voltage_ratio_{conduction}"] or 0.0 for conduction in CONDUCTIONS[1:]]
    return None if ratio is None or max(others) <= _EXCEEDS * ratio else max(others)


# Ratio of two voltages from which a table contains both (engineering judgement).
_EXCEEDS = 1.01


def tables_of_point(solution: AxleSolution) -> dict[str, Any]:
    """Tables of a point of a sweep: ``edge`` and ``first`` as in summary.json, and the rows of ``elements``
    and ``shafts`` by their keys, without their names.
    """
    case, tables = solution.case, axle_summary(solution)
    elements = [{key: row[key] for key in row if key != "element"} for row in tables["elements"]]
    shafts = {row.pop("shaft"): row for row in tables["shafts"]}
    return {
        "edge": tables["edge"],
        "first": tables["first"],
        "elements": dict(zip(case.keys_of_elements(), elements, strict=True)),
        "shafts": {key: shafts[name] for key, name in case.keys_of_shafts().items()},
    }


# Elements with the ratio of their voltages, the first to discharge first.
_Ranking = Sequence[tuple[str, float]]


def _first(solution: AxleSolution, ranking: _Ranking) -> dict[str, Any]:
    """Table ``first``: the element that discharges first, and its voltages; None without one."""
    if not ranking or not ranking[0][1]:
        return dict.fromkeys(("element", "voltage", "breakdown_voltage", "voltage_ratio", "margin"))
    name, ratio = ranking[0]
    breakdown = solution.breakdown_voltages.get(name)
    return {
        "element": name,
        "voltage": solution.voltage_of(name),
        "breakdown_voltage": breakdown,
        "voltage_ratio": None if breakdown is None else ratio,
        "margin": 1.0 / ratio,
    }


# Ends of keys by the assumption about the meshes.
_ENDS = {conduction: "" if conduction == "by-film" else f"_{conduction}" for conduction in CONDUCTIONS}

# Keys of an element in its row.
_OF_ELEMENT = (
    *("state", "touching", "radial_load", "axial_load", "lambda_ratio", "contact_time_share", "capacitance"),
    "breakdown_voltage",
)


def _elements(solution: AxleSolution, rankings: Mapping[Conduction, _Ranking]) -> list[dict[str, Any]]:
    """Rows of elements.csv."""
    voltages, energies, known = solution.voltages(), solution.energies(), solution.breakdown_voltages
    ranks = {each: {name: n for n, (name, _) in enumerate(rows, 1)} for each, rows in rankings.items()}
    ratios = {each: {name: ratio for name, ratio in rows if name in known} for each, rows in rankings.items()}
    return [
        {
            "element": (name := element.name),
            **{key: getattr(element, key) for key in _OF_ELEMENT},
            "voltage": voltages[name],
            **{f"voltage_ratio{end}": ratios[each].get(name) for each, end in _ENDS.items()},
            **{f"rank{end}": ranks[each].get(name) for each, end in _ENDS.items()},
            "energy": energies.get(name),
        }
        for element in solution.elements
    ]


def _shafts(solution: AxleSolution) -> list[dict[str, Any]]:
    """Rows of shafts.csv."""
    voltages = {conduction: solution.potentials(conduction) for conduction in CONDUCTIONS}
    per_100 = solution.potentials(edge=100.0)
    return [
        {
            "shaft": shaft.name,
            "speed": solution.turning[shaft.name].speed,
            "torque": solution.turning[shaft.name].torque,
            **{f"voltage{end}": voltages[each][shaft.name] for each, end in _ENDS.items()},
            "voltage_per_100_volt": per_100[shaft.name],
        }
        for shaft in solution.case.shaft
    ]
