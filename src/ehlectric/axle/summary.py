"""Key figures of an axle, nested as in summary.json."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from ehlectric.axle.solution import CONDUCTIONS, AxleSolution
from ehlectric.cases.gear_inputs import Conduction

# Columns of elements.csv with their units: load and film, voltages after the edge, and the rank.
ELEMENT_COLUMNS: Mapping[str, str] = MappingProxyType(
    {
        "element": "",
        "state": "",
        "radial_load": "N",
        "axial_load": "N",
        "lambda_ratio": "",
        "contact_time_share": "",
        "capacitance": "F",
        "breakdown_voltage": "V",
        "voltage": "V",
        "voltage_ratio": "",
        "rank": "",
        "rank_always": "",
        "rank_never": "",
        "energy": "J",
    }
)

# Columns of shafts.csv with their units.
SHAFT_COLUMNS: Mapping[str, str] = MappingProxyType(
    {
        "shaft": "",
        "speed": "rad/s",
        "torque": "N*m",
        "voltage": "V",
        "voltage_always": "V",
        "voltage_never": "V",
        "voltage_per_100_volt": "V",
    }
)


def axle_summary(solution: AxleSolution) -> dict[str, Any]:
    """Tables ``edge``, ``elements``, ``shafts`` and ``rank`` of summary.json, SI units; None for what is not
    known. ``voltage_ratio`` is the voltage over the breakdown voltage.
    """
    case = solution.case
    return {
        "edge": {"voltage": case.edge, "rise_time": case.source.rise_time},
        "elements": _elements(solution),
        "shafts": _shafts(solution),
        "rank": {conduction: _ranked(solution, conduction) for conduction in CONDUCTIONS},
        "changed_ranks": list(solution.changed_ranks),
    }


def _ranked(solution: AxleSolution, conduction: Conduction) -> list[str]:
    return [name for name, _ in solution.ranking(conduction)]


def _elements(solution: AxleSolution) -> list[dict[str, Any]]:
    """Rows of elements.csv."""
    network, potentials = solution.network(), solution.potentials()
    ranks = {conduction: _ranked(solution, conduction) for conduction in CONDUCTIONS}
    rows = []
    for element in solution.elements:
        film = element.film("by-film")
        voltage = abs(network.voltage(film, potentials))
        limit = element.breakdown_voltage
        places = {
            conduction: names.index(element.name) + 1 if element.name in names else None
            for conduction, names in ranks.items()
        }
        rows.append(
            {
                "element": element.name,
                "state": element.state,
                "radial_load": element.radial_load,
                "axial_load": element.axial_load,
                "lambda_ratio": element.lambda_ratio,
                "contact_time_share": element.contact_time_share,
                "capacitance": element.capacitance,
                "breakdown_voltage": limit,
                "voltage": voltage,
                "voltage_ratio": None if limit is None else voltage / limit,
                "rank": places["by-film"],
                "rank_always": places["always"],
                "rank_never": places["never"],
                "energy": None
                if film.conducts or voltage == 0.0
                else network.breakdown(film, potentials).energy,
            }
        )
    return rows


def _shafts(solution: AxleSolution) -> list[dict[str, Any]]:
    """Rows of shafts.csv."""
    voltages = {conduction: solution.potentials(conduction) for conduction in CONDUCTIONS}
    per_100 = solution.potentials(edge=100.0)
    return [
        {
            "shaft": shaft.name,
            "speed": solution.turning[shaft.name].speed,
            "torque": solution.turning[shaft.name].torque,
            "voltage": voltages["by-film"][shaft.name],
            "voltage_always": voltages["always"][shaft.name],
            "voltage_never": voltages["never"][shaft.name],
            "voltage_per_100_volt": per_100[shaft.name],
        }
        for shaft in solution.case.shaft
    ]
