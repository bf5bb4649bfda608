"""State equations of a linear circuit with one voltage source. SI units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ehlectric.arrays import Array

# The node whose potential is zero.
FRAME = "frame"


@dataclass(frozen=True)
class Element:
    """Element of a circuit between two nodes.

    Attributes
    ----------
    kind : str
        "capacitor", "conductor" or "inductor".
    first, second : str
        Names of its nodes; the potential of "frame" is zero.
    value : float
        Capacitance [F], conductance [S] or inductance [H].
    resistance : float
        Resistance in series with an inductor [Ohm].
    """

    kind: Literal["capacitor", "conductor", "inductor"]
    first: str
    second: str
    value: float
    resistance: float = 0.0


@dataclass(frozen=True, eq=False)
class StateSpace:
    r"""Equations x' = A x + B u of a circuit with the source voltage u.

    The states are those that are continuous where u has a jump: for each free node the potential p + k u, and
    the currents of the inductors.

    Attributes
    ----------
    nodes : tuple of str
        Free nodes, whose potentials p the first states give.
    rates : ndarray, shape (n, n)
        Matrix A [1/s].
    force : ndarray, shape (n,)
        Vector B.
    jump : ndarray, shape (n,)
        Vector k; 0 for the currents of inductors.
    capacitance : ndarray, shape (n, n)
        Matrix C of the free nodes, so that C p and the part of the source are the charges of the nodes [F];
        the inductances for the currents of inductors [H].
    """

    nodes: tuple[str, ...]
    rates: Array
    force: Array
    jump: Array
    capacitance: Array

    def potential(self, node: str) -> Array:
        """Row that takes the potential of a node out of p, shape (n,); zeros for the frame."""
        row = np.zeros(len(self.force))
        if node != FRAME:
            row[self.nodes.index(node)] = 1.0
        return row


def state_space(elements: Sequence[Element], source: tuple[str, str]) -> StateSpace:
    """State equations of a circuit.

    Parameters
    ----------
    elements : sequence of Element
        Elements. Every node but "frame" and the positive node of the source needs a path of capacitors to
        "frame" or to the source.
    source : tuple of str
        Positive and negative node of the voltage source. The positive one is no free node: its potential is
        that of the negative one plus u.

    Returns
    -------
    StateSpace
        Equations.

    Raises
    ------
    ValueError
        If a free node has no path of capacitors.

    Notes
    -----
    With the potentials v = T p + s u of all nodes, Kirchhoff's current law at the free nodes is
    T'(C v' + G v + N i) = 0 with the inductors' currents i, and L i' = N' v - R i. With
    k = (T'C T)^-1 T'C s the states p + k u have no derivative of u in their equations.

    Examples
    --------
    A step of 1 V on 1 kOhm and 1 nF: the potential rises with the rate 1/(R C) = 1e6/s.

    >>> low_pass = [Element("conductor", "in", "out", 1e-3), Element("capacitor", "out", "frame", 1e-9)]
    >>> system = state_space(low_pass, ("in", "frame"))
    >>> round(float(system.rates[0, 0])), round(float(system.force[0]))
    (-1000000, 1000000)
    """
    nodes = sorted({node for one in elements for node in (one.first, one.second)} - {FRAME})
    positive, negative = source
    free = tuple(node for node in nodes if node != positive)
    into = _free_into_all(nodes, free, positive, negative)
    drive = np.array([float(node == positive) for node in nodes])
    c, g, n = _matrices(elements, nodes)
    inductors = [one for one in elements if one.kind == "inductor"]
    inductance = np.array([one.value for one in inductors])
    resistance = np.array([one.resistance for one in inductors])
    own, charge = into.T @ c @ into, into.T @ c @ drive
    if np.linalg.matrix_rank(own, tol=1e-12 * np.max(np.abs(own), initial=1e-300)) < len(free):
        raise ValueError("a node has no path of capacitors to the frame or the source")
    leak, through = into.T @ g @ into, into.T @ n
    k = np.linalg.solve(own, charge)
    rates = np.block(
        [
            [-np.linalg.solve(own, leak), -np.linalg.solve(own, through)],
            [through.T / inductance[:, None], -np.diag(resistance / inductance)],
        ]
    )
    force = np.concatenate(
        [
            np.linalg.solve(own, leak @ k - into.T @ g @ drive),
            (n.T @ drive - through.T @ k) / inductance,
        ]
    )
    capacitance = np.block(
        [
            [own, np.zeros((len(free), len(inductors)))],
            [np.zeros((len(inductors), len(free))), np.diag(inductance)],
        ]
    )
    return StateSpace(
        nodes=free,
        rates=rates,
        force=force,
        jump=np.concatenate([k, np.zeros(len(inductors))]),
        capacitance=capacitance,
    )


def _free_into_all(nodes: Sequence[str], free: Sequence[str], positive: str, negative: str) -> Array:
    """Matrix T from the potentials of the free nodes to those of all nodes but the frame."""
    into = np.zeros((len(nodes), len(free)))
    for column, node in enumerate(free):
        into[nodes.index(node), column] = 1.0
        if node == negative:
            into[nodes.index(positive), column] = 1.0
    return into


def _matrices(elements: Sequence[Element], nodes: Sequence[str]) -> tuple[Array, Array, Array]:
    """Capacitances and conductances of all nodes but the frame, and the nodes of the inductors."""
    count = len(nodes)
    inductors = [one for one in elements if one.kind == "inductor"]
    matrices = {"capacitor": np.zeros((count, count)), "conductor": np.zeros((count, count))}
    for one in elements:
        if one.kind != "inductor":
            across = _ends(one, nodes)
            matrices[one.kind] += one.value * np.outer(across, across)
    currents = np.array([_ends(one, nodes) for one in inductors]).reshape(len(inductors), count).T
    return matrices["capacitor"], matrices["conductor"], currents


def _ends(element: Element, nodes: Sequence[str]) -> Array:
    """Ends of an element, 1 at its first and -1 at its second node, shape (nodes,)."""
    ends = np.zeros(len(nodes))
    for node, sign in ((element.first, 1.0), (element.second, -1.0)):
        if node != FRAME:
            ends[nodes.index(node)] += sign
    return ends
