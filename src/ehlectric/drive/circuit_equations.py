"""Elements of a circuit, its state equations, and its modes.

All quantities are in SI units.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array

# The node whose potential is zero.
FRAME = "frame"


@dataclass(frozen=True)
class Element:
    """Element of a circuit between two nodes."""

    kind: Literal["capacitor", "conductor", "inductor"]
    # first and second: names of its nodes; the potential of "frame" is zero.
    first: str
    second: str
    value: float  # capacitance [F], conductance [S] or inductance [H]
    resistance: float = 0.0  # resistance in series with an inductor [Ohm]


@dataclass(frozen=True, eq=False)
class StateSpace:
    r"""Equations x' = A x + B u of a circuit with the source voltage u.

    The states are those that are continuous where u has a jump: for each free node the potential p + k u, and
    the currents of the inductors.
    """

    nodes: tuple[str, ...]  # free nodes, whose potentials p the first states give
    rates: Array  # matrix A [1/s], shape (n, n)
    force: Array  # vector B, shape (n,)
    jump: Array  # vector k; 0 for the currents of inductors, shape (n,)
    # Matrix C of the free nodes, so that C p and the part of the source are the charges of the nodes [F]; the
    # inductances for the currents of inductors [H], shape (n, n).
    capacitance: Array

    def potential(self, node: str) -> Array:
        """Row that takes the potential of a node out of p, shape (n,); zeros for the frame."""
        row = np.zeros(len(self.force))
        if node != FRAME:
            row[self.nodes.index(node)] = 1.0
        return row


def state_space(elements: Sequence[Element], source: tuple[str, str]) -> StateSpace:
    """State equations of a circuit. ``elements``, elements; ``source``, positive and negative node of the
    voltage source. Raises ValueError if a free node has no path of capacitors.

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
    nodes = sorted({node for element in elements for node in (element.first, element.second)} - {FRAME})
    positive, negative = source
    free = tuple(node for node in nodes if node != positive)
    into = _free_into_all(nodes, free, positive, negative)
    drive = np.array([float(node == positive) for node in nodes])
    c, g, n = _matrices(elements, nodes)
    inductors = [element for element in elements if element.kind == "inductor"]
    inductance = np.array([element.value for element in inductors])
    resistance = np.array([element.resistance for element in inductors])
    matrix, charge = into.T @ c @ into, into.T @ c @ drive
    if free and np.linalg.matrix_rank(matrix, tol=1e-12 * np.max(np.abs(matrix))) < len(free):
        raise ValueError("a node has no path of capacitors to the frame or the source")
    leak, through = into.T @ g @ into, into.T @ n
    k = np.linalg.solve(matrix, charge)
    states, potentials = len(free) + len(inductors), slice(len(free))
    currents = slice(len(free), states)
    rates, capacitance = np.zeros((states, states)), np.zeros((states, states))
    rates[potentials, potentials] = -np.linalg.solve(matrix, leak)
    rates[potentials, currents] = -np.linalg.solve(matrix, through)
    rates[currents, potentials] = through.T / inductance[:, None]
    rates[currents, currents] = -np.diag(resistance / inductance)
    capacitance[potentials, potentials] = matrix
    capacitance[currents, currents] = np.diag(inductance)
    force = np.concatenate(
        [
            np.linalg.solve(matrix, leak @ k - into.T @ g @ drive),
            (n.T @ drive - through.T @ k) / inductance,
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
    """Matrix T from the potentials of the free nodes to the potentials of all nodes except the frame."""
    into = np.zeros((len(nodes), len(free)))
    for column, node in enumerate(free):
        into[nodes.index(node), column] = 1.0
        if node == negative:
            into[nodes.index(positive), column] = 1.0
    return into


def _matrices(elements: Sequence[Element], nodes: Sequence[str]) -> tuple[Array, Array, Array]:
    """Capacitances and conductances of all nodes except the frame, and the nodes of the inductors."""
    count = len(nodes)
    inductors = [element for element in elements if element.kind == "inductor"]
    matrices = {"capacitor": np.zeros((count, count)), "conductor": np.zeros((count, count))}
    for element in elements:
        if element.kind != "inductor":
            across = _ends(element, nodes)
            matrices[element.kind] += element.value * np.outer(across, across)
    currents = np.array([_ends(element, nodes) for element in inductors]).reshape(len(inductors), count).T
    return matrices["capacitor"], matrices["conductor"], currents


def _ends(element: Element, nodes: Sequence[str]) -> Array:
    """Ends of an element, 1 at its first and -1 at its second node, shape (nodes,)."""
    ends = np.zeros(len(nodes))
    for node, sign in ((element.first, 1.0), (element.second, -1.0)):
        if node != FRAME:
            ends[nodes.index(node)] += sign
    return ends


Complex = NDArray[np.complex128]
Integers = NDArray[np.int64]

# Condition number of the modes above which two of them are taken as one that has no diagonal form.
_ALIKE = 1e9

# Relative difference of two conductances that is rounding.
_SYMMETRIC = 1e-9

# Relative change of the rates that parts two modes of the same rate, with an effect of its own size.
_APART = 1e-10


# Rows of the modes of a state: rates, forces, states per volt of the ringing, and the vector k of
# ``StateSpace``; from VOLTAGE_ROWS on, each voltage, and then what a discharge of each voltage does.
RATE_ROW, FORCE_ROW, RING_ROW, JUMP_ROW, VOLTAGE_ROWS = range(5)

# Square matrices of a state: eigenvectors and their inverse, and C of ``StateSpace`` and its inverse.
SHAPES, INVERSE, CHARGE, UNCHARGE = range(4)

# Columns after the modes: the source without its ringing, and the ringing.
_FURTHER = 2


class Modes(NamedTuple):
    """Diagonal form of the state equations of a circuit with n states and v voltages.

    The columns of ``rows``, shape (5 + 2 v, n + 2), are the modes, the source and its ringing:

    - eigenvalues [1/s], of which no real part is above zero, and rate mu of the ringing;
    - force of each mode per volt of the source;
    - states per volt of a source exp(mu t), and the vector k, in the first n columns;
    - each voltage per amplitude of each mode, per volt of the source, and per volt of its ringing;
    - for each voltage U with U = a'p, what a discharge of U by 1 V takes from each state, C_th C^-1 a, and
      the capacitance C_th = 1/(a'C^-1 a) that is discharged [F].

    ``squares`` has the four matrices of a state, shape (4, n, n).
    """

    rows: Complex
    squares: Complex

    @property
    def source_share(self) -> Array:
        """Each voltage per volt of the source with all modes at zero, shape (v,)."""
        count = (self.rows.shape[0] - VOLTAGE_ROWS) // 2
        share: Array = self.rows[VOLTAGE_ROWS : VOLTAGE_ROWS + count, -2].real
        return share


def modes_of(system: StateSpace, voltages: Sequence[tuple[str, str]], ring: complex | None = None) -> Modes:
    """Diagonal form of a circuit. ``voltages``, nodes between which each voltage lies.

    ``ring`` is the rate mu of the source's ringing [1/s]; without it the source does not ring.
    """
    states, count = system.force.size, len(voltages)
    eigenvalues, shapes, inverse = _diagonal(system.rates, system.capacitance)
    across = np.array([system.potential(upper) - system.potential(lower) for upper, lower in voltages])
    ring_state = np.zeros(states, dtype=complex)
    if ring is not None:
        identity = np.eye(states)
        ring_state = np.linalg.solve(ring * identity - system.rates, system.force.astype(complex))
    uncharge = np.linalg.inv(system.capacitance)
    spread = across @ uncharge
    discharged = 1.0 / np.sum(spread * across, axis=1)
    rows = np.zeros((VOLTAGE_ROWS + 2 * count, states + _FURTHER), dtype=complex)
    modes, of_voltages = slice(states), slice(VOLTAGE_ROWS, VOLTAGE_ROWS + count)
    rows[RATE_ROW, modes] = np.minimum(eigenvalues.real, 0.0) + 1j * eigenvalues.imag
    rows[RATE_ROW, -1] = -1.0 if ring is None else ring
    rows[FORCE_ROW, modes] = np.einsum("ij,j->i", inverse, system.force)
    rows[RING_ROW, modes], rows[JUMP_ROW, modes] = ring_state, system.jump
    rows[of_voltages, modes] = across @ shapes
    rows[of_voltages, -2] = -system.jump @ across.T
    rows[of_voltages, -1] = (ring_state - system.jump) @ across.T
    rows[VOLTAGE_ROWS + count :, modes] = discharged[:, None] * spread
    rows[VOLTAGE_ROWS + count :, -2] = discharged
    return Modes(rows, np.array([shapes, inverse, system.capacitance, uncharge]))


def _diagonal(rates: Array, charge: Array) -> tuple[Complex, Complex, Complex]:
    """Eigenvalues, eigenvectors and their inverse; equal rates without a diagonal form are parted.

    Without inductances -C A is the symmetric matrix of conductances, so that a diagonal form exists: with the
    Cholesky factor C = L L', L^-1 C A L^-T is symmetric. It is used if eigenvectors of equal rates are nearly
    parallel, such as for several shafts that nothing discharges.

    Otherwise, in states that are scaled by the root of their energy, losses make the matrices symmetric, and
    exchange between capacitors and inductors makes them antisymmetric, so that the eigenvectors are well
    conditioned.
    """
    energy = np.sqrt(np.diagonal(charge))
    scaled = energy[:, None] * rates / energy[None, :]
    eigenvalues, shapes = (part.astype(complex) for part in np.linalg.eig(scaled))
    if np.linalg.cond(shapes) > _ALIKE:
        leak = charge @ rates
        if np.max(np.abs(leak - leak.T)) <= _SYMMETRIC * np.max(np.abs(leak)):
            return _diagonal_without_inductances(leak, charge)
        order = np.arange(1, energy.size + 1)
        eigenvalues, shapes = (
            part.astype(complex) for part in np.linalg.eig(scaled * (1.0 + _APART * order[:, None]))
        )
    return eigenvalues, shapes / energy[:, None], np.linalg.inv(shapes) * energy[None, :]


def _diagonal_without_inductances(leak: Array, charge: Array) -> tuple[Complex, Complex, Complex]:
    """Eigenvalues, eigenvectors and their inverse from C A and C, both symmetric."""
    factor = np.linalg.cholesky(charge)
    unit = np.linalg.inv(factor)
    eigenvalues, vectors = np.linalg.eigh(0.5 * unit @ (leak + leak.T) @ unit.T)
    values, shapes, inverse = (
        part.astype(complex) for part in (eigenvalues, unit.T @ vectors, vectors.T @ factor.T)
    )
    return values, shapes, inverse
