"""Network of capacitances of shafts, housing and winding: voltages after an edge, and what a breakdown does.

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

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.cases.axle_inputs import HOUSING as HOUSING
from ehlectric.drive import FRAME, StateSpace, state_space
from ehlectric.drive import WINDING as WINDING
from ehlectric.drive import Element as CircuitElement
from ehlectric.errors import InputError


@dataclass(frozen=True)
class Film:
    """Element between two nodes that insulates or conducts: a bearing, a gear mesh or a link."""

    name: str
    first: str
    second: str
    capacitance: float  # [F]
    conducts: bool = False
    conductance: float = 0.0  # [S]


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
    """Shafts between a winding and a housing, with the elements that connect them."""

    shafts: tuple[str, ...]
    elements: tuple[Film, ...]

    def potentials(self, edge: float, rise_time: float = 0.0) -> dict[str, float]:
        """Potentials of the shafts right after an edge of the source [V], which were 0 before.

        ``rise_time`` of the edge [s], in which conductances discharge the shafts; without it they do not.
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
        """Nodes of the circuit by the names of shafts, housing and winding.

        Shafts that conducting elements connect are one node.
        """
        nodes = {shaft: f"shaft {shaft}" for shaft in self.shafts} | {HOUSING: FRAME}
        for element in self.elements:
            if element.conducts:
                kept, gone = sorted((nodes[element.first], nodes[element.second]), key=lambda n: n != FRAME)
                nodes = {name: kept if node == gone else node for name, node in nodes.items()}
        return nodes | {WINDING: WINDING}

    def circuit(self) -> Iterator[CircuitElement]:
        """Capacitors and conductors of all elements that do not conduct, between their nodes."""
        for element in self.elements:
            first, second = self.nodes[element.first], self.nodes[element.second]
            if first != second:
                yield CircuitElement("capacitor", first, second, element.capacitance)
                if element.conductance:
                    yield CircuitElement("conductor", first, second, element.conductance)

    @cached_property
    def system(self) -> StateSpace:
        """State equations of the network; the winding is driven."""
        elements = [*self.circuit()]
        connected = {node for each in elements for node in (each.first, each.second)} | {FRAME}
        try:
            if connected.issuperset(self.nodes[shaft] for shaft in self.shafts):
                return state_space(elements, (WINDING, FRAME))
        except ValueError:
            pass
        raise InputError.worded("shaft", "a shaft has no path of capacitances to the housing")

    def _named(self, values: Array) -> dict[str, float]:
        """Values of the free nodes of the circuit by the shafts; 0 for the housing."""
        by_node = dict(zip(self.system.nodes, values.tolist(), strict=True))
        return {shaft: by_node.get(self.nodes[shaft], 0.0) for shaft in self.shafts}


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
