"""Oil and gas in the gap behind the contact: how much oil there is, and the permittivity of both together."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ehlectric.arrays import Array, Mask


def oil_fraction(thickness: Array, density: Array, cavitated: Mask) -> Array:
    """Part of the gap that oil fills behind the exit of the film.

    (rho H)_exit/(rho H): behind the exit no pressure gradient drives the oil, and what left it is carried on
    between surfaces that part. A rough film may end and form again; no more oil goes on than came through the
    narrowest of the ends before.

    Parameters
    ----------
    thickness, density : ndarray, shape (nx,) or (nx, ny)
        Film thickness and density, in any unit; x along entrainment.
    cavitated : ndarray of bool, of the same shape
        Where the pressure is held at ambient.

    Returns
    -------
    ndarray, of the same shape
        From 0 to 1; 1 before the first exit of each line along x, and where the film is full. An exit is the
        first cavitated node behind a full one.

    Examples
    --------
    >>> h = np.array([4.0, 1.0, 1.0, 2.0, 4.0])
    >>> oil_fraction(h, np.ones(5), np.array([True, False, True, True, True])).tolist()
    [1.0, 1.0, 1.0, 0.5, 0.25]
    """
    mass = thickness * density
    exits = np.zeros_like(cavitated)
    exits[1:] = cavitated[1:] & ~cavitated[:-1]
    carried = np.minimum.accumulate(np.where(exits, mass, np.inf), axis=0)
    return np.divide(carried, mass, out=np.ones_like(mass), where=cavitated & (mass > carried))


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
