"""Network of shafts, housing and machine: voltages after an edge, and what a breakdown does.

Nodes are the shafts; the housing has the potential 0, and the winding is driven by the source. C is the
matrix of capacitances of the shafts: C_ii the sum of all capacitances at shaft i, -C_ij the capacitance
between shafts i and j. With the capacitances b of the winding to the shafts, an edge dV of the source gives

    v+ = v- + C^-1 b dV.

An element breaks down between two nodes, with the incidence u (+1 and -1), the voltage U = u'v and the rest
voltage U_r, while the potential of the winding stays:

    C_th = 1/(u' C^-1 u)        Q = C_th (U - U_r)        v+ = v - C^-1 u Q        W = C_th (U^2 - U_r^2)/2

An element that conducts merges its nodes: with T from merged nodes to all nodes, C becomes T'C T.

A link with a resistance adds its conductance to the matrix G. While the voltage of the source rises by V in
the time t_r,

    C v' + G v = b V/t_r,        v(t_r) = sum over k of phi_k (phi_k'b V/t_r) (1 - exp(-s_k t_r))/s_k

with the modes G phi_k = s_k C phi_k and phi_k'C phi_k = 1. Without conductances this is C^-1 b V.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.cases.axle_keys import HOUSING as HOUSING
from ehlectric.cases.drive_case import Connection, NetworkCase
from ehlectric.cases.drive_inputs import Circuit
from ehlectric.drive.circuit_equations import FRAME, Element, StateSpace, state_space
from ehlectric.errors import InputError

# Nodes of the machine in addition to its shafts and its housing, which is the frame. Earth is a node of its
# own where the frame has an inductance to it, and the inverter where it has one to the winding.
# Their names are different from the names of shafts.
_OF_MACHINE = "machine: "
SOURCE, WINDING, EARTH = (f"{_OF_MACHINE}{name}" for name in ("source", "winding", "earth"))


@dataclass(frozen=True)
class Film(Connection):
    """Element between two nodes that insulates or conducts: a bearing, a gear mesh, a link, or an element of
    the machine.
    """

    inductance: float = 0.0  # [H]
    resistance: float = 0.0  # in series with the inductance [Ohm]

    def circuit(self, first: str, second: str) -> Iterator[Element]:
        """Capacitor, conductor or inductor between two nodes of a circuit, for an element that insulates."""
        if self.inductance:
            yield Element("inductor", first, second, self.inductance, self.resistance)
        elif self.capacitance or not self.conductance:
            yield Element("capacitor", first, second, self.capacitance)
        if self.conductance:
            yield Element("conductor", first, second, self.conductance)


@dataclass(frozen=True)
class Breakdown:
    """Breakdown of an element."""

    voltage: float  # U before the breakdown [V]
    charge: float  # Q that passes [C]
    capacitance: float  # C_th that is discharged [F]
    energy: float  # W [J]
    potentials: Mapping[str, float]  # of all shafts after it [V]


@dataclass(frozen=True)
class Network:
    """Shafts between a source and a housing, with the elements that connect them."""

    shafts: tuple[str, ...]
    elements: tuple[Film, ...]
    # Positive and negative node of the voltage of the inverter.
    source: tuple[str, str] = (WINDING, HOUSING)

    def potentials(self, edge: float, rise_time: float = 0.0) -> dict[str, float]:
        """Potentials of the shafts and of rings under a coating right after an edge of the source [V]; they
        were 0 before.

        ``rise_time`` of the edge [s], in which conductances discharge the shafts; without it they do not.
        Inductances are neglected: they have the whole edge at first, and the capacitances share it later.
        Raises InputError if a shaft has no path of capacitances to the housing.

        Examples
        --------
        The divider of one shaft:

        >>> shaft = (Film("winding", WINDING, "rotor", 0.1e-9), Film("bearings", "rotor", HOUSING, 1.5e-9))
        >>> round(Network(("rotor",), shaft).potentials(300.0)["rotor"], 9)
        18.75
        """
        system = self.system
        share = -system.jump
        if rise_time == 0.0 or not share.size:
            return self._named(share * edge)
        conductance = -system.capacitance @ system.rates
        rates, modes = scipy.linalg.eigh(0.5 * (conductance + conductance.T), system.capacitance)
        # (1 - exp(-x))/x, which is 1 for x = 0.
        decay = np.maximum(rates, 0.0) * rise_time
        remaining = np.where(decay > 0.0, -np.expm1(-decay) / np.where(decay > 0.0, decay, 1.0), 1.0)
        given = modes.T @ (system.capacitance @ share * edge)
        return self._named(np.asarray(modes @ (remaining * given)))

    def voltage(self, element: Film, potentials: Mapping[str, float]) -> float:
        """Voltage of an element at potentials of the shafts [V]."""
        return float(potentials.get(element.first, 0.0) - potentials.get(element.second, 0.0))

    def breakdown(self, element: Film, potentials: Mapping[str, float], rest: float = 0.0) -> Breakdown:
        """Breakdown of an element at potentials of the shafts [V], down to a rest voltage [V]."""
        system = self.system
        across = system.potential(self.nodes[element.first]) - system.potential(self.nodes[element.second])
        response = np.linalg.solve(system.capacitance, across)
        voltage = self.voltage(element, potentials)
        capacitance = 1.0 / float(across @ response)
        charge = capacitance * (voltage - rest)
        change = self._named(np.asarray(response * charge))
        return Breakdown(
            voltage,
            charge,
            capacitance,
            0.5 * capacitance * (voltage**2 - rest**2),
            {shaft: potentials[shaft] - change[shaft] for shaft in self.shafts},
        )

    @cached_property
    def nodes(self) -> dict[str, str]:
        """Nodes of the circuit by the names of shafts, housing, machine and rings.

        Shafts that conducting elements connect are one node.
        """
        others = dict.fromkeys(name for each in self.elements for name in (each.first, each.second))
        nodes = {name: name.removeprefix(_OF_MACHINE) for name in (*self.source, *others)}
        nodes |= {shaft: f"shaft {shaft}" for shaft in self.shafts} | {HOUSING: FRAME}
        for element in self.elements:
            if element.conducts:
                kept, gone = sorted((nodes[element.first], nodes[element.second]), key=lambda n: n != FRAME)
                nodes = {name: kept if node == gone else node for name, node in nodes.items()}
        return nodes

    @property
    def ends(self) -> tuple[str, str]:
        """Positive and negative node of the source in the circuit."""
        return self.nodes[self.source[0]], self.nodes[self.source[1]]

    def circuit(self) -> Iterator[Element]:
        """Capacitors, conductors and inductors of all elements that do not conduct, between their nodes."""
        for element in self.elements:
            first, second = self.nodes[element.first], self.nodes[element.second]
            if first != second:
                yield from element.circuit(first, second)

    @property
    def equations(self) -> StateSpace:
        """State equations of the network with its inductances."""
        return state_space([*self.circuit()], self.ends)

    def oscillations(self) -> list[tuple[float, float]]:
        """Frequency [Hz] and quality factor of each oscillation, the least damped one first.

        There are none without inductances.
        """
        if self._without_inductances is self:
            return []
        damped = [
            (float(rate.imag) / (2.0 * math.pi), abs(rate) / max(-2.0 * float(rate.real), 1e-300))
            for rate in np.linalg.eigvals(self.equations.rates)
            if rate.imag > 0.0
        ]
        return sorted(damped, key=lambda oscillation: -oscillation[1])

    @cached_property
    def _without_inductances(self) -> Network:
        """Network in which inductances conduct."""
        shorted = tuple(replace(each, conducts=True) if each.inductance else each for each in self.elements)
        return self if shorted == self.elements else replace(self, elements=shorted)

    @cached_property
    def system(self) -> StateSpace:
        """State equations of the network without inductances; the source is driven."""
        if self._without_inductances is not self:
            return self._without_inductances.system
        connected = {node for each in self.circuit() for node in (each.first, each.second)} | {FRAME}
        try:
            if connected.issuperset(self.nodes[shaft] for shaft in self.shafts):
                return self.equations
        except ValueError:
            pass
        raise InputError.worded("shaft", "a shaft has no path of capacitances to the housing")

    def _named(self, values: Array) -> dict[str, float]:
        """Values of the free nodes of the circuit by the shafts and rings; 0 for the housing."""
        by_node = dict(zip(self.system.nodes, values.tolist(), strict=True))
        return {
            name: by_node.get(node, 0.0)
            for name, node in self._without_inductances.nodes.items()
            if name in self.shafts or node in by_node
        }


def machine(circuit: Circuit, rotor: str) -> Network:
    """Network of a machine and of its connection to the inverter, without bearings; ``rotor`` is the name of
    its shaft.
    """
    nodes = {
        "winding_rotor_capacitance": ("winding", WINDING, rotor),
        "rotor_frame_capacitance": ("rotor and frame", rotor, HOUSING),
        "winding_frame_capacitance": ("winding and frame", WINDING, HOUSING),
    }
    elements = [Film(*nodes[key], value) for key, value in circuit.capacitances.items()]
    if circuit.grounding_ring_resistance is not None:
        conductance = 1.0 / circuit.grounding_ring_resistance
        elements.append(Film("grounding ring", rotor, HOUSING, conductance=conductance))
    series, ground = circuit.common_mode_inductance or 0.0, circuit.ground_inductance or 0.0
    resistance = circuit.common_mode_resistance
    cable, earthed = circuit.cable_capacitance, circuit.frame_earth_capacitance
    # Frame and earth are two nodes if something is parallel to the inductance between them. Otherwise it is
    # in series with the one between inverter and winding.
    parted = bool(ground and (cable or earthed))
    if not parted:
        series, resistance = series + ground, resistance + circuit.ground_resistance
    if series:
        elements.append(Film("common mode", SOURCE, WINDING, inductance=series, resistance=resistance))
    if parted:
        damping = circuit.ground_resistance
        elements.append(Film("ground", HOUSING, EARTH, inductance=ground, resistance=damping))
    negative = EARTH if parted else HOUSING
    if cable is not None:
        elements.append(Film("cable", WINDING, negative, cable))
    if parted and earthed is not None:
        elements.append(Film("frame and earth", HOUSING, EARTH, earthed))
    return Network((rotor,), tuple(elements), (SOURCE if series else WINDING, negative))


def network_of(case: NetworkCase) -> Network:
    """Network of a drive or an axle without its films: its machine, and the connections of its shafts."""
    of_machine, rotor = machine(case.running_circuit, case.rotor_name), case.rotor_name
    # Without inductances, the inverter's voltage lies across all elements that are not at the rotor.
    kept = [
        each for each in of_machine.elements if case.circuit.inductive or rotor in (each.first, each.second)
    ]
    connections = (Film(**vars(each)) for each in case.connections())
    return Network(case.shaft_names, (*kept, *connections), of_machine.source)


def rank(voltages: Mapping[str, float], limits: Mapping[str, float]) -> list[tuple[str, float]]:
    """Names of elements with the ratio of their voltage to their breakdown voltage, in the order of
    ``firsts``. Both have the names of the elements [V], and limits as in ``voltage_ratios``.

    Examples
    --------
    >>> rank({"bearing": 3.0, "mesh": 2.0}, {"bearing": 2.0, "mesh": 0.0})
    [('mesh', inf), ('bearing', 1.5)]
    """
    names = [name for name in voltages if name in limits]
    of_names = np.array([voltages[name] for name in names])
    ratios = voltage_ratios(of_names, np.array([limits[name] for name in names]))
    rows = zip(names, ratios.tolist(), of_names.tolist(), strict=True)
    return [(name, ratio) for name, ratio, _ in sorted(rows, key=lambda row: (-row[1], -row[2]))]


def voltage_ratios(voltages: Array, limits: Array) -> Array:
    """Voltages divided by breakdown voltages [V], of one shape.

    ``limits``, breakdown voltages: infinite for an element that conducts or does not break down. Touching
    summits have no breakdown voltage, but minus their margin: 0, or below 0 for an element that almost
    conducts. The ratio is the reciprocal of the margin: infinite where summits touch under a voltage, and 0
    without a voltage.

    Examples
    --------
    >>> voltage_ratios(np.array([3.0, 3.0, 0.0, 3.0]), np.array([2.0, 0.0, 0.0, -4.0])).tolist()
    [1.5, inf, 0.0, 0.25]
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        ratios = np.where(limits > 0.0, voltages / limits, 1.0 / np.abs(limits))
        return np.where(voltages == 0.0, 0.0, ratios)


def touches(limits: Array) -> Mask:
    """Whether summits touch, by the limits of ``voltage_ratios``."""
    return np.asarray(limits <= 0.0)


def times_strength(limits: Array, factor: Array | float) -> Array:
    """Limits of ``voltage_ratios`` for a strength that is a factor times as large: of films only."""
    return np.where(limits > 0.0, limits * factor, limits)


def firsts(voltages: Array, limits: Array) -> IntArray:
    """Numbers of the elements that discharge first, -1 where no element does, shape (n,).

    ``voltages`` and ``limits`` as for ``voltage_ratios``, shape (n, elements). The first element has the
    largest ratio. Elements whose summits touch under a voltage discharge at any voltage, and precede all
    others; the element with the largest voltage is the first of them.

    Examples
    --------
    >>> voltages = np.array([[2.0, 3.0], [2.0, 3.0], [2.0, 3.0]])
    >>> firsts(voltages, np.array([[1.0, 3.0], [1.0, 0.0], [0.0, 0.0]])).tolist()
    [0, 1, 1]
    """
    ratios = voltage_ratios(voltages, limits)
    known = np.where(np.isnan(ratios), 0.0, ratios)
    touching = np.where(np.isinf(known), voltages, 0.0)
    first = np.where(np.any(touching > 0.0, axis=1), np.argmax(touching, axis=1), np.argmax(known, axis=1))
    return np.asarray(np.where(np.any(known > 0.0, axis=1), first, -1))
