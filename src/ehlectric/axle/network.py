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

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.cases.axle_inputs import HOUSING as HOUSING
from ehlectric.errors import InputError

Floats = NDArray[np.floating[Any]]

# Name of the node that the source drives.
WINDING = "winding"


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
        matrix, charge = self._matrix(), self._charge() * edge
        if rise_time == 0.0 or not matrix.size:
            return self._named(self._spread(np.linalg.solve(matrix, charge)))
        rates, modes = scipy.linalg.eigh(self._assembled(lambda each: each.conductance), matrix)
        # (1 - exp(-x))/x, which is 1 for x = 0.
        decay = np.maximum(rates, 0.0) * rise_time
        remaining = np.where(decay > 0.0, -np.expm1(-decay) / np.where(decay > 0.0, decay, 1.0), 1.0)
        return self._named(self._spread(modes @ (remaining * (modes.T @ charge))))

    def voltage(self, element: Film, potentials: Mapping[str, float]) -> float:
        """Voltage of an element at potentials of the shafts [V]."""
        return float(potentials.get(element.first, 0.0) - potentials.get(element.second, 0.0))

    def breakdown(self, element: Film, potentials: Mapping[str, float], rest: float = 0.0) -> Breakdown:
        """Breakdown of an element at potentials of the shafts [V], down to a rest voltage [V]."""
        incidence = self._merge.T @ self._incidence(element)
        response = np.linalg.solve(self._matrix(), incidence)
        voltage = self.voltage(element, potentials)
        capacitance = 1.0 / float(incidence @ response)
        charge = capacitance * (voltage - rest)
        before = np.array([potentials[shaft] for shaft in self.shafts])
        return Breakdown(
            voltage,
            charge,
            capacitance,
            0.5 * capacitance * (voltage**2 - rest**2),
            self._named(before - self._spread(response * charge)),
        )

    @property
    def _merge(self) -> Array:
        """Matrix T from the potentials of groups of shafts to all shafts, shape (shafts, groups).

        Shafts that conducting elements connect are a group; a group with the housing has the potential 0.
        """
        group = {node: node for node in (*self.shafts, HOUSING)}
        for element in self.elements:
            if element.conducts:
                kept, gone = sorted((group[element.first], group[element.second]), key=lambda n: n != HOUSING)
                group = {node: kept if name == gone else name for node, name in group.items()}
        names = sorted({group[shaft] for shaft in self.shafts} - {HOUSING}, key=self.shafts.index)
        return np.array([[float(group[shaft] == name) for name in names] for shaft in self.shafts])

    def _incidence(self, element: Film) -> Array:
        """Incidence of an element at the shafts, shape (shafts,)."""
        return np.array([float(shaft == element.first) - (shaft == element.second) for shaft in self.shafts])

    def _matrix(self) -> Array:
        """Capacitances of the groups of shafts [F], shape (groups, groups)."""
        matrix = self._assembled(lambda each: each.capacitance)
        if matrix.size and np.linalg.matrix_rank(matrix, tol=1e-12 * np.max(np.abs(matrix))) < len(matrix):
            raise InputError.worded("shaft", "a shaft has no path of capacitances to the housing")
        return matrix

    def _assembled(self, value: Callable[[Film], float]) -> Array:
        """Matrix of a value of all elements between the groups of shafts, shape (groups, groups)."""
        rows = [(self._incidence(each), value(each)) for each in self.elements if not each.conducts]
        whole = np.sum([number * np.outer(row, row) for row, number in rows], axis=0)
        merge = self._merge
        matrix: Array = merge.T @ whole @ merge
        return matrix

    def _charge(self) -> Array:
        """Capacitances of the winding to the groups of shafts [F], shape (groups,)."""
        total = np.zeros(len(self.shafts))
        for element in self.elements:
            if WINDING in (element.first, element.second):
                total += element.capacitance * np.abs(self._incidence(element))
        return self._merge.T @ total

    def _spread(self, of_groups: Floats) -> Array:
        """Values of groups at all shafts, shape (shafts,)."""
        return np.asarray(self._merge @ of_groups)

    def _named(self, values: Array) -> dict[str, float]:
        return dict(zip(self.shafts, values.tolist(), strict=True))


def rank(
    network: Network, breakdown_voltages: Mapping[str, float], edge: float, rise_time: float = 0.0
) -> list[tuple[str, float]]:
    """Names of elements with the ratio of their voltage after an edge to their breakdown voltage, the largest
    first. ``breakdown_voltages`` by the name of the element [V]; ``edge`` of the source [V] and its
    ``rise_time`` [s].
    """
    potentials = network.potentials(edge, rise_time)
    ratios = [
        (each.name, abs(network.voltage(each, potentials)) / breakdown_voltages[each.name])
        for each in network.elements
        if each.name in breakdown_voltages and not each.conducts
    ]
    return sorted(ratios, key=lambda row: -row[1])
