"""Circuit of a motor with both of its bearings. SI units."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import product

import numpy as np

from ehlectric.cases.drives.breakdown import Breakdown
from ehlectric.cases.drives.case import ENDS
from ehlectric.cases.drives.circuit import Circuit
from ehlectric.drive.bearings import BearingElement
from ehlectric.drive.circuit.state_space import FRAME, Element, StateSpace, state_space

# Nodes. The frame is the node of reference; earth is another one where the frame has an inductance to it.
SOURCE, WINDING, ROTOR, EARTH = "source", "winding", "rotor", "earth"


# Nodes of the capacitances of the machine, by their keys.
_PLATES = {
    "winding_rotor_capacitance": (WINDING, ROTOR),
    "rotor_frame_capacitance": (ROTOR, FRAME),
    "winding_frame_capacitance": (WINDING, FRAME),
}


def film_nodes(elements: Sequence[BearingElement]) -> list[tuple[str, str]]:
    """Nodes between which the films of each bearing lie: a coating lies between them and the frame."""
    return [
        (ROTOR, f"ring_{end}" if one.path.coated else FRAME) for end, one in zip(ENDS, elements, strict=True)
    ]


def voltage_nodes(elements: Sequence[BearingElement]) -> list[tuple[str, str]]:
    """Nodes of the voltages that are measured: across the films of each bearing, and of the shaft."""
    return [*film_nodes(elements), (ROTOR, FRAME)]


def source_nodes(circuit: Circuit) -> tuple[str, str]:
    """Positive and negative node of the inverter's common-mode voltage."""
    return SOURCE if _reactor(circuit) else WINDING, EARTH if _parted(circuit) else FRAME


def _parted(circuit: Circuit) -> bool:
    """Whether earth and frame are two nodes: something is parallel to the inductance between them."""
    beside = circuit.cable_capacitance or circuit.frame_earth_capacitance
    return circuit.ground_inductance is not None and beside is not None


def _reactor(circuit: Circuit) -> bool:
    """Whether an inductance lies between inverter and winding; that to earth is in series without cable."""
    alone = circuit.ground_inductance is not None and not _parted(circuit)
    return circuit.common_mode_inductance is not None or alone


def motor_elements(circuit: Circuit) -> Iterator[Element]:
    """Elements of the motor and of its connection to the inverter, without bearings."""
    for key, value in circuit.capacitances.items():
        yield Element("capacitor", *_PLATES[key], value)
    if circuit.grounding_ring_resistance is not None:
        yield Element("conductor", ROTOR, FRAME, 1.0 / circuit.grounding_ring_resistance)
    own, ground = circuit.common_mode_inductance or 0.0, circuit.ground_inductance or 0.0
    if _parted(circuit):
        if own:
            yield Element("inductor", SOURCE, WINDING, own, circuit.common_mode_resistance)
        yield Element("inductor", FRAME, EARTH, ground, circuit.ground_resistance)
        if circuit.cable_capacitance is not None:
            yield Element("capacitor", WINDING, EARTH, circuit.cable_capacitance)
        if circuit.frame_earth_capacitance is not None:
            yield Element("capacitor", FRAME, EARTH, circuit.frame_earth_capacitance)
        return
    if own or ground:
        resistance = circuit.common_mode_resistance + circuit.ground_resistance
        yield Element("inductor", SOURCE, WINDING, own + ground, resistance)
    if circuit.cable_capacitance is not None:
        yield Element("capacitor", WINDING, FRAME, circuit.cable_capacitance)


def bearing_elements(
    one: BearingElement, nodes: tuple[str, str], place: int, conductance: float
) -> Iterator[Element]:
    """Elements of a bearing with its elements at a place, and a conductance of its films beside that of oil.

    Parameters
    ----------
    one : BearingElement
        Bearing.
    nodes : tuple of str
        Nodes between which its films lie.
    place : int
        Number of the position of its elements.
    conductance : float
        Conductance of an arc or of touching asperities [S].
    """
    yield Element("capacitor", *nodes, float(one.capacitance[place]))
    if one.conductance + conductance > 0.0:
        yield Element("conductor", *nodes, one.conductance + conductance)
    if one.path.coated:
        yield Element("capacitor", nodes[1], FRAME, one.path.coating)
        if math.isfinite(one.path.resistance):
            yield Element("conductor", nodes[1], FRAME, 1.0 / one.path.resistance)
    if one.path.parallel:
        yield Element("capacitor", ROTOR, FRAME, one.path.parallel)


def oscillations(circuit: Circuit, bearings: Sequence[BearingElement]) -> list[tuple[float, float]]:
    """Frequency [Hz] and quality factor of each oscillation of the circuit with films that insulate.

    Parameters
    ----------
    circuit : Circuit
        Table ``circuit`` of the drive.
    bearings : sequence of BearingElement
        Bearings at both ends; their elements are at their first position.

    Returns
    -------
    list of tuple of float
        The least damped oscillation first; none in a circuit without inductances. With a rate s of the
        circuit the frequency is Im s/(2 pi), and the quality factor is abs(s)/(-2 Re s), infinite without
        damping.
    """
    if circuit.common_mode_inductance is None and circuit.ground_inductance is None:
        return []
    elements = list(motor_elements(circuit))
    for one, nodes in zip(bearings, film_nodes(bearings), strict=True):
        elements += bearing_elements(one, nodes, 0, 0.0)
    rates = np.linalg.eigvals(state_space(elements, source_nodes(circuit)).rates)
    found = [
        (float(rate.imag) / (2.0 * math.pi), abs(rate) / max(-2.0 * float(rate.real), 1e-300))
        for rate in rates
        if rate.imag > 0.0
    ]
    return sorted(found, key=lambda one: -one[1])


def states_of(
    circuit: Circuit, bearings: Sequence[BearingElement], breakdown: Breakdown, *, touches: bool
) -> list[StateSpace]:
    """State equations of the circuit in all of its states, in the order in which a march numbers them.

    Parameters
    ----------
    circuit : Circuit
        Table ``circuit`` of the drive.
    bearings : sequence of BearingElement
        Bearings at both ends.
    breakdown : Breakdown
        Table ``breakdown`` of the drive.
    touches : bool
        Whether films of a bearing touch, which is a third state of each.

    Returns
    -------
    list of StateSpace
        For each state of the first and the second film, and each position of the first and the second
        bearing's elements.
    """
    arc = 1.0 / breakdown.arc_resistance
    doing = [[0.0, arc, 1.0 / one.touch_resistance][: 3 if touches else 2] for one in bearings]
    places = [range(one.capacitance.size) for one in bearings]
    motor, nodes = list(motor_elements(circuit)), film_nodes(bearings)
    return [
        state_space(
            [
                *motor,
                *bearing_elements(bearings[0], nodes[0], first, one),
                *bearing_elements(bearings[1], nodes[1], second, other),
            ],
            source_nodes(circuit),
        )
        for one, other, first, second in product(doing[0], doing[1], places[0], places[1])
    ]
