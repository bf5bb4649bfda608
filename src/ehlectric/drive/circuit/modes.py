"""Modes of a circuit in each of its states, as the compiled loop over time reads them. SI units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.drive.circuit.state_space import StateSpace

Complex = NDArray[np.complex128]

# Condition number of the modes above which two of them are taken as one that has no diagonal form.
_ALIKE = 1e9

# Relative change of the rates that parts two modes of the same rate, with an effect of its own size.
_APART = 1e-10


@dataclass(frozen=True, eq=False)
class Modes:
    """Diagonal form of the state equations of several states of a circuit, one after the other.

    Attributes
    ----------
    rates : ndarray of complex, shape (states, n)
        Eigenvalues [1/s]; no real part is above zero.
    shapes, inverse : ndarray of complex, shape (states, n, n)
        Eigenvectors and their inverse.
    force : ndarray of complex, shape (states, n)
        Force of each mode per volt of the source.
    films : ndarray of complex, shape (states, films, n)
        Voltage across each film, and any other voltage that is asked for, per amplitude of each mode [V].
    films_source : ndarray, shape (states, films)
        Voltage across each film per volt of the source with all modes at zero.
    ring_state : ndarray of complex, shape (states, n)
        States per volt of a source exp(mu t).
    ring_films : ndarray of complex, shape (states, films)
        Voltage across each film per volt of a source exp(mu t).
    jump : ndarray, shape (states, n)
        Vector k of ``StateSpace``.
    charge, uncharge : ndarray, shape (states, n, n)
        Matrix C of ``StateSpace`` and its inverse.
    """

    rates: Complex
    shapes: Complex
    inverse: Complex
    force: Complex
    films: Complex
    films_source: Array
    ring_state: Complex
    ring_films: Complex
    jump: Array
    charge: Array
    uncharge: Array


def modes_of(
    systems: Sequence[StateSpace], films: Sequence[tuple[str, str]], ring: complex | None = None
) -> Modes:
    """Diagonal form of a circuit in all of its states.

    Parameters
    ----------
    systems : sequence of StateSpace
        State equations, all with the same nodes.
    films : sequence of tuple of str
        Upper and lower node of each film.
    ring : complex, optional
        Rate mu of the source's ringing [1/s]; without it the source does not ring.

    Returns
    -------
    Modes
        Rates, shapes and what follows from them.
    """
    first = systems[0]
    rates = np.array([one.rates for one in systems])
    charge = np.array([one.capacitance for one in systems])
    own, shapes, inverse = _diagonal(rates, charge)
    force = np.array([one.force for one in systems])
    jump = np.array([one.jump for one in systems])
    across = np.array([first.potential(upper) - first.potential(lower) for upper, lower in films])
    ring_state = np.zeros(force.shape, dtype=complex)
    if ring is not None:
        identity = np.eye(rates.shape[1])
        ring_state = np.linalg.solve(ring * identity - rates, force.astype(complex)[..., None])[..., 0]
    return Modes(
        rates=np.minimum(own.real, 0.0) + 1j * own.imag,
        shapes=np.ascontiguousarray(shapes),
        inverse=np.ascontiguousarray(inverse),
        force=np.einsum("cij,cj->ci", inverse, force),
        films=np.einsum("fi,cij->cfj", across, shapes),
        films_source=-jump @ across.T,
        ring_state=ring_state,
        ring_films=(ring_state - jump) @ across.T,
        jump=jump,
        charge=charge,
        uncharge=np.linalg.inv(charge),
    )


def _diagonal(rates: Array, charge: Array) -> tuple[Complex, Complex, Complex]:
    """Eigenvalues, eigenvectors and their inverse; equal rates without a diagonal form are parted.

    In states that are scaled by the root of their energy, losses make the matrices symmetric, and exchange
    between capacitors and inductors makes them antisymmetric, so that the eigenvectors are well conditioned.
    """
    energy = np.sqrt(np.diagonal(charge, axis1=1, axis2=2))
    scaled = energy[:, :, None] * rates / energy[:, None, :]
    own, shapes = (part.astype(complex) for part in np.linalg.eig(scaled))
    alike = np.linalg.cond(shapes) > _ALIKE
    if np.any(alike):
        order = np.arange(1, rates.shape[1] + 1)
        own[alike], shapes[alike] = np.linalg.eig(scaled[alike] * (1.0 + _APART * order[:, None]))
    return own, shapes / energy[:, :, None], np.linalg.inv(shapes) * energy[:, None, :]
