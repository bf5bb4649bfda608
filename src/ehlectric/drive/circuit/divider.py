"""Capacitive divider of a motor: the part of the source's voltage that its bearings take."""

from __future__ import annotations

from collections.abc import Sequence

from ehlectric.cases.drives.circuit import Circuit
from ehlectric.drive.bearings import BearingElement
from ehlectric.drive.circuit.modes import modes_of
from ehlectric.drive.circuit.motor import bearing_elements, film_nodes, motor_elements, source_nodes
from ehlectric.drive.circuit.state_space import state_space


def capacitive_divider(circuit: Circuit, bearings: Sequence[BearingElement]) -> tuple[float, float]:
    """Voltage across the films of each bearing per volt of the source, right after an edge.

    Inductances are left out: they have the whole edge at first, and the capacitances share it later. The
    rolling elements are at their first position.

    Parameters
    ----------
    circuit : Circuit
        Table ``circuit`` of the drive.
    bearings : sequence of BearingElement
        Bearings at both ends.

    Returns
    -------
    tuple of float
        Share of each bearing, dimensionless, from 0 to 1.
    """
    plain = circuit.model_copy(update={"common_mode_inductance": None, "ground_inductance": None})
    nodes = film_nodes(bearings)
    elements = list(motor_elements(plain))
    for one, ends in zip(bearings, nodes, strict=True):
        elements += bearing_elements(one, ends, 0, 0.0)
    first, second = modes_of([state_space(elements, source_nodes(plain))], nodes, None).films_source[0]
    return abs(float(first)), abs(float(second))
