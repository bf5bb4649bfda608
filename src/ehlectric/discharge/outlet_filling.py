"""Oil and gas in the gap behind the contact: fraction of oil, and relative permittivity of both together."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ehlectric.arrays import Array, Mask


def oil_fraction(thickness: Array, density: Array, cavitated: Mask) -> Array:
    """Fraction of the gap that is filled with oil behind the exit of the film: (rho H)_exit/(rho H).

    Behind the exit no pressure gradient drives the oil. The oil that leaves the full film is carried on by
    surfaces that diverge. A rough film may cavitate and reform several times. The oil mass rho H that flows
    on is then at most the smallest oil mass at the exits upstream.

    Parameters
    ----------
    thickness, density : ndarray, shape (nx,) or (nx, ny)
        Film thickness and density, in any unit; the first axis runs along entrainment.
    cavitated : ndarray of bool, of the same shape
        Whether the film is cavitated, that is at ambient pressure.

    Returns
    -------
    ndarray, of the same shape
        Oil fraction from 0 to 1, dimensionless. It is 1 in the full film, and before the first exit of each
        line along x. An exit is the first cavitated node behind a full-film node.

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


# Functions of the oil's relative permittivity and the oil fraction that give the relative permittivity of the
# gap, by the name of the filling: oil alone; fingers of oil from wall to wall with gas beside them, in
# parallel; layers of oil on the walls with gas between them, in series.
OUTLETS: dict[str, Callable[[Array, Array], Array]] = {
    "full": _full,
    "fingers": _fingers,
    "layers": _layers,
}


def filled_permittivity(permittivity: Array, fraction: Array, outlet: str) -> Array:
    """Relative permittivity of a gap that is filled with oil and gas.

    Parameters
    ----------
    permittivity : ndarray, shape (...)
        Relative permittivity of the oil, dimensionless.
    fraction : ndarray, shape (...)
        Fraction f of the gap that is filled with oil, from 0 to 1, dimensionless.
    outlet : str
        "full" (oil alone), "fingers" (eps = f eps_oil + 1 - f) or "layers" (1/eps = f/eps_oil + 1 - f). The
        permittivity of any arrangement of oil and gas is between that of fingers and of layers (O. Wiener,
        Abh. Math.-Phys. Kl. Saechs. Ges. Wiss. 32 (1912) 509).

    Returns
    -------
    ndarray, shape (...)
        Relative permittivity of the gap, dimensionless.

    Examples
    --------
    >>> eps, half = np.array([3.0]), np.array([0.5])
    >>> [float(filled_permittivity(eps, half, outlet)[0]) for outlet in OUTLETS]
    [3.0, 2.0, 1.5]
    """
    return OUTLETS[outlet](permittivity, fraction)
