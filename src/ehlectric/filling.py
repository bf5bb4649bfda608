"""Oil and gas in the gap behind the contact: how much oil there is, and the permittivity of both together."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ehlectric.typing import Array, Mask


def oil_fraction(thickness: Array, density: Array, cavitated: Mask) -> Array:
    """Part of the gap that oil fills behind the exit of the film.

    (rho H)_exit/(rho H): behind the exit no pressure gradient drives the oil, and what left it is carried on
    between surfaces that part.

    Parameters
    ----------
    thickness, density : ndarray, shape (nx,) or (nx, ny)
        Film thickness and density, in any unit; x along entrainment.
    cavitated : ndarray of bool, of the same shape
        Where the pressure is held at ambient.

    Returns
    -------
    ndarray, of the same shape
        From 0 to 1. 1 before the exit, which is the first cavitated node behind the last full one of each
        line along x, and on lines without a full film.

    Examples
    --------
    >>> h = np.array([4.0, 1.0, 1.0, 2.0, 4.0])
    >>> oil_fraction(h, np.ones(5), np.array([True, False, True, True, True])).tolist()
    [1.0, 1.0, 1.0, 0.5, 0.25]
    """
    nodes = thickness.shape[0]
    from_last = np.argmax(~cavitated[::-1], axis=0)
    full = np.any(~cavitated, axis=0)
    exits = np.where(full, np.minimum(nodes - from_last, nodes - 1), nodes - 1)
    mass = thickness * density
    at_exit = np.take_along_axis(mass, exits[np.newaxis], axis=0)
    places = np.arange(nodes).reshape(nodes, *(1,) * (thickness.ndim - 1))
    behind = (places > exits) & (mass > at_exit)
    return np.divide(at_exit, mass, out=np.ones_like(mass), where=behind)


def _full(permittivity: Array, _fraction: Array) -> Array:
    return permittivity


def _fingers(permittivity: Array, fraction: Array) -> Array:
    return fraction * permittivity + (1.0 - fraction)


def _layers(permittivity: Array, fraction: Array) -> Array:
    return 1.0 / (fraction / permittivity + (1.0 - fraction))


# Relative permittivity of a gap over that of the oil and its fraction, by what ``outlet`` says: oil alone;
# fingers of oil from wall to wall with gas beside them, in parallel; layers of oil on the walls with gas
# between them, in series.
OUTLETS: dict[str, Callable[[Array, Array], Array]] = {
    "full": _full,
    "fingers": _fingers,
    "layers": _layers,
}


def filled_permittivity(permittivity: Array, fraction: Array, outlet: str) -> Array:
    """Relative permittivity of a gap that oil fills in part, the rest being gas.

    Parameters
    ----------
    permittivity : ndarray, shape (...)
        Of the oil.
    fraction : ndarray, shape (...)
        Part that oil fills, from 0 to 1.
    outlet : str
        "full", "fingers" (eps = f eps_oil + 1 - f) or "layers" (1/eps = f/eps_oil + 1 - f). The last two
        bound every arrangement (O. Wiener, Abh. Math.-Phys. Kl. Saechs. Ges. Wiss. 32 (1912) 509).

    Returns
    -------
    ndarray, shape (...)
        Dimensionless.

    Examples
    --------
    >>> eps, half = np.array([3.0]), np.array([0.5])
    >>> [float(filled_permittivity(eps, half, outlet)[0]) for outlet in OUTLETS]
    [3.0, 2.0, 1.5]
    """
    return OUTLETS[outlet](permittivity, fraction)
