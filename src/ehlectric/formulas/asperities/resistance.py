"""Electrical resistance of metallic spots between two rough bodies, and of a film over them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array

# Rows of the matrix of distances that are held at a time.
_ROWS = 512


def holm_resistance(radius: ArrayLike, resistivity: float) -> Array:
    """Constriction resistance of a circular spot, rho/(2 a), after Holm.

    The current spreads into a half-space on both sides. Two metals count with the mean of their
    resistivities.

    Parameters
    ----------
    radius : array_like, shape (...)
        Radius a of the spot [m], > 0.
    resistivity : float
        Resistivity rho of the bodies [ohm m]; about 2.2e-7 for the steel 100Cr6 (from memory).

    Returns
    -------
    ndarray, shape (...)
        Resistance [ohm].

    Notes
    -----
    R. Holm, Electric Contacts, 4th ed., Springer 1967. It needs a spot that is much larger than the mean free
    path of the electrons; see ``spot_resistance``.

    Examples
    --------
    >>> holm_resistance([0.1e-6, 1e-6], 2.2e-7).round(3).tolist()
    [1.1, 0.11]
    """
    resistance: Array = resistivity / (2.0 * np.asarray(radius, dtype=float))
    return resistance


def sharvin_resistance(radius: ArrayLike, resistivity: float, mean_free_path: float) -> Array:
    """Resistance of a circular spot that electrons pass without a collision, 4 rho l/(3 pi a^2).

    Parameters
    ----------
    radius : array_like, shape (...)
        Radius a of the spot [m], > 0.
    resistivity : float
        Resistivity rho of the bodies [ohm m].
    mean_free_path : float
        Mean free path l of the electrons [m], a few nanometres in steel.

    Returns
    -------
    ndarray, shape (...)
        Resistance [ohm].

    Notes
    -----
    Yu. V. Sharvin, Sov. Phys. JETP 21 (1965) 655.

    Examples
    --------
    >>> round(float(sharvin_resistance(1e-9, 2.2e-7, 2e-9)), 1)
    186.7
    """
    path_area = 3.0 * np.pi * np.asarray(radius, dtype=float) ** 2
    resistance: Array = 4.0 * resistivity * mean_free_path / path_area
    return resistance


def spot_resistance(radius: ArrayLike, resistivity: float, mean_free_path: float = 0.0) -> Array:
    """Resistance of a circular spot of any size: Sharvin's, and Holm's times Wexler's factor.

    R = 4 rho l/(3 pi a^2) + gamma(l/a) rho/(2 a) with gamma(K) = (1 + 0.83 K)/(1 + 1.33 K).

    Parameters
    ----------
    radius : array_like, shape (...)
        Radius a of the spot [m], > 0.
    resistivity : float
        Resistivity rho of the bodies [ohm m].
    mean_free_path : float, optional
        Mean free path l of the electrons [m], >= 0. Zero gives Holm's resistance.

    Returns
    -------
    ndarray, shape (...)
        Resistance [ohm].

    Notes
    -----
    G. Wexler, Proc. Phys. Soc. 89 (1966) 927-941. The factor is the fit of B. Nikolic and P. B. Allen, Phys.
    Rev. B 60 (1999) 3963, arXiv:cond-mat/9811296, to their exact solution; its constants are from memory.
    The exact conductance is within 11 % of that of the plain sum of both resistances, and so is that
    of the fit to a further 2 %.

    Examples
    --------
    >>> round(float(spot_resistance(0.5e-6, 2.2e-7)), 2), round(float(spot_resistance(5e-9, 2.2e-7, 2e-9)), 1)
    (0.22, 26.6)
    """
    ratio = mean_free_path / np.asarray(radius, dtype=float)
    factor = (1.0 + 0.83 * ratio) / (1.0 + 1.33 * ratio)
    resistance: Array = sharvin_resistance(radius, resistivity, mean_free_path) + factor * holm_resistance(
        radius, resistivity
    )
    return resistance


def greenwood_cluster(positions: ArrayLike, radii: ArrayLike, resistivity: float) -> float:
    """Resistance of spots at given places, with currents in proportion to their radii, after Greenwood.

    R = rho/(2 sum a_i) + (rho/pi) sum_{i != j} (a_i a_j/s_ij)/(sum a_i)^2, with the distances s_ij of the
    spots. For equal spots the second term is rho/(pi n^2) sum_{i != j} 1/s_ij.

    Parameters
    ----------
    positions : array_like, shape (n, 2)
        Positions of the spots [m], all different.
    radii : array_like, shape (n,)
        Radii a_i of the spots [m], > 0; at least one.
    resistivity : float
        Resistivity rho of the bodies [ohm m].

    Returns
    -------
    float
        Resistance [ohm]. It is an upper bound of ``cluster_resistance``.

    Notes
    -----
    J. A. Greenwood, Constriction resistance and the real area of contact, Br. J. Appl. Phys. 17 (1966)
    1621-1632 (from memory; the formula is derived from the potential of point sources on both half-spaces).
    Time and memory: n^2 and n.

    Examples
    --------
    Spots that are far apart are resistances in parallel:

    >>> round(greenwood_cluster([[0.0, 0.0], [1.0, 0.0]], [1e-6, 1e-6], 2.2e-7), 4)
    0.055
    """
    at, a = np.asarray(positions, dtype=float), np.asarray(radii, dtype=float)
    mutual = 0.0
    for first in range(0, a.size, _ROWS):
        rows = slice(first, first + _ROWS)
        mutual += float(a[rows] @ (_inverse_distances(at[rows], at, first) @ a))
    total = float(np.sum(a))
    return resistivity / (2.0 * total) + resistivity / np.pi * mutual / total**2


def cluster_resistance(
    positions: ArrayLike, radii: ArrayLike, resistivity: float, mean_free_path: float = 0.0
) -> float:
    """Resistance of spots at given places that all have the same voltage.

    The currents I_i follow from V = R_i I_i + (rho/pi) sum_{j != i} I_j/s_ij for every spot, with its own
    resistance R_i of ``spot_resistance``, rho/(2 a_i) without a free path. Spots in the middle of a cluster
    get less current than those at its edge.

    Parameters
    ----------
    positions : array_like, shape (n, 2)
        Positions of the spots [m]; spots must not overlap.
    radii : array_like, shape (n,)
        Radii a_i of the spots [m], > 0; at least one.
    resistivity : float
        Resistivity rho of the bodies [ohm m].
    mean_free_path : float, optional
        Mean free path of the electrons [m], >= 0.

    Returns
    -------
    float
        Resistance [ohm].

    Notes
    -----
    A spot acts on the others as a point: for two spots that touch this is wrong by a few per cent. Time and
    memory: n^3 and n^2; 2000 spots take a second.

    Examples
    --------
    >>> round(cluster_resistance([[0.0, 0.0]], [1e-6], 2.2e-7), 4)
    0.11
    """
    at, a = np.asarray(positions, dtype=float), np.asarray(radii, dtype=float)
    matrix = _inverse_distances(at, at, 0) / np.pi
    matrix[np.diag_indices(a.size)] = spot_resistance(a, 1.0, mean_free_path)
    return resistivity / float(np.sum(np.linalg.solve(matrix, np.ones(a.size))))


def _inverse_distances(rows: Array, at: Array, first: int) -> Array:
    """Reciprocal distances of some spots, from number ``first`` on, to all; zero of a spot to itself."""
    distance = np.hypot(rows[:, :1] - at[:, 0], rows[:, 1:] - at[:, 1])
    own = np.arange(rows.shape[0])
    distance[own, own + first] = np.inf
    inverse: Array = 1.0 / distance
    return inverse


def film_resistance(area: ArrayLike, specific_resistance: float) -> Array:
    """Resistance of a boundary film over the real contact area, sigma_f/A_c, in series with the spots.

    Parameters
    ----------
    area : array_like, shape (...)
        Real contact area A_c [m^2], > 0.
    specific_resistance : float
        Resistance of the film times its area sigma_f [ohm m^2], thickness over conductivity. A film of
        additives of 10 to 100 nm has no generally known value: it is an input.

    Returns
    -------
    ndarray, shape (...)
        Resistance [ohm].

    Examples
    --------
    >>> round(float(film_resistance(1e-12, 1e-9)))
    1000
    """
    resistance: Array = specific_resistance / np.asarray(area, dtype=float)
    return resistance
