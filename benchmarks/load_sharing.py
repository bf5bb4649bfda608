"""Load sharing of film and asperities: both lie in one gap and together carry the load."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.formulas.asperities import LOWEST_SEPARATION, greenwood_integral, separation_of_gap

# Largest number of steps to the share, and its relative tolerance. Ten steps are usual.
_STEPS, _TOLERANCE = 100, 1e-14


@dataclass(frozen=True)
class LoadSharing:
    """Film and asperities that carry the load together.

    Attributes
    ----------
    asperity_share : ndarray, shape (...)
        Share phi of the load that asperities carry, dimensionless, 0 to 1.
    gap : ndarray, shape (...)
        Mean gap, which is the film thickness under (1 - phi) of the load [m].
    separation : ndarray, shape (...)
        Distance of the mean planes of the undeformed roughness [m].
    """

    asperity_share: Array
    gap: Array
    separation: Array


def mean_gap(separation: ArrayLike, deviation: float) -> Array:
    """Mean gap between two rough surfaces that touch, where overlapping peaks are flattened to no gap.

    Before contact the mean gap is the separation of the mean planes. Where the peaks overlap they are pressed
    flat, and the mean gap is ``separation + deviation F_1(separation/deviation)``. A film formula gives the
    volume of oil per area, which is this gap; the statistics of contact take the separation.

    Parameters
    ----------
    separation : array_like, shape (...)
        Distance of the mean planes of the undeformed roughness [m], >= -12 ``deviation``.
    deviation : float
        Standard deviation of the gap, sqrt(Rq1^2 + Rq2^2) [m], > 0.

    Returns
    -------
    ndarray, shape (...)
        Mean gap [m].

    Notes
    -----
    K. L. Johnson, J. A. Greenwood and S. Y. Poon, A simple theory of asperity contact in
    elastohydrodynamic lubrication, Wear 19 (1972) 91-108. The flattened peaks push no material to other
    places.

    Examples
    --------
    >>> round(float(mean_gap(0.0, 100e-9)) * 1e9, 2)
    39.89
    """
    at = np.asarray(separation, dtype=float)
    gap: Array = at + deviation * greenwood_integral(1.0, at / deviation)
    return gap


def film_under_share(film: ArrayLike, exponent: float) -> Callable[[Array], Array]:
    """Film thickness under a share of the load, h (1 - phi)^(-exponent), from a formula's power of the load.

    Parameters
    ----------
    film : array_like, shape (...)
        Film thickness of smooth surfaces under the whole load [m].
    exponent : float
        Positive exponent e of the formula h proportional to W^-e, such as 0.067 for the central film of
        Hamrock and Dowson. After Johnson, Greenwood and Poon the pressure keeps its Hertzian shape, as
        the asperities press on the bodies too: the film follows from the load (1 - phi) F between bodies of
        the modulus (1 - phi) E'. For h/R proportional to U^a G^b the exponent is then a - b, 0.14
        for that formula.

    Returns
    -------
    callable
        Function of the fluid's share 1 - phi, shape (...), > 0, that returns the film thickness [m].

    Examples
    --------
    >>> round(float(film_under_share(100e-9, 0.14)(np.array(0.5))) * 1e9, 1)
    110.2
    """
    whole = np.asarray(film, dtype=float)

    def thickness(fluid_share: Array) -> Array:
        found: Array = whole * fluid_share**-exponent
        return found

    return thickness


def load_sharing(
    film: Callable[[Array], Array],
    asperity_pressure: Callable[[Array], Array],
    nominal_pressure: ArrayLike,
    *,
    roughness: float,
    displaced_plane: bool = True,
) -> LoadSharing:
    """Share of the load on the asperities, where film and asperities have the same gap.

    Solves asperity_pressure(separation(film(1 - phi))) = phi nominal_pressure for phi. The left side
    falls with phi as the relieved film grows, so that there is one solution.

    Parameters
    ----------
    film : callable
        Film thickness [m] as a function of the fluid's share of the load, array of shape (...);
        ``film_under_share`` makes it from a formula.
    asperity_pressure : callable
        Asperity load per nominal area [Pa] as a function of the separation of the mean planes of the
        surfaces [m]; it must fall with the separation. For a model in terms of the summits,
        ``summit_separation`` comes first.
    nominal_pressure : array_like, shape (...)
        Load over nominal contact area, of a Hertz contact the mean pressure [Pa], > 0.
    roughness : float
        Composite roughness sqrt(Rq1^2 + Rq2^2) [m], > 0.
    displaced_plane : bool, optional
        How the film thickness is taken. True: as the mean gap, the volume of the oil per area, with
        overlapping peaks pressed flat (displaced mean plane). False: as the separation of the undeformed
        mean planes. Both are the same above three times the roughness.

    Returns
    -------
    LoadSharing
        Share of the asperities, mean gap and separation. The share is 0 where nothing touches. It is 1 where
        the asperities carry more than the whole load at every film: then the separation is that of the film
        under a share of 1e-15.

    Notes
    -----
    K. L. Johnson, J. A. Greenwood and S. Y. Poon, Wear 19 (1972) 91-108. One film thickness and one
    pressure stand for the whole contact; the flow factors of the roughness are left out.

    Examples
    --------
    >>> from benchmarks.greenwood_tripp import greenwood_tripp
    >>> from ehlectric.formulas.asperities import Summits
    >>> rough = Summits(density=2e11, radius=2e-6, height_deviation=100e-9)
    >>> found = load_sharing(
    ...     film_under_share([50e-9, 100e-9, 200e-9], 0.14),
    ...     lambda distance: greenwood_tripp(distance, rough, 226e9).pressure,
    ...     1e9,
    ...     roughness=100e-9,
    ... )
    >>> found.asperity_share.round(4).tolist()
    [0.0827, 0.0193, 0.0011]
    """
    load = np.asarray(nominal_pressure, dtype=float)
    shape = np.broadcast_shapes(load.shape, film(np.ones_like(load)).shape)

    def state(share: Array) -> tuple[Array, Array]:
        gap = film(np.maximum(1.0 - share, 1e-15))
        if not displaced_plane:
            return gap, np.maximum(gap, LOWEST_SEPARATION * roughness)
        return gap, separation_of_gap(gap, roughness)

    def carried(share: Array) -> Array:
        least: Array = np.minimum(asperity_pressure(state(share)[1]) / load, 1.0)
        return least

    # The share that the asperities would carry in the gap of a larger share is a smaller one: both enclose
    # the solution, closely where the asperities carry little.
    high = carried(np.zeros(shape))
    share = _root(lambda at: carried(at) - at, carried(high), high)
    gap, separation = state(share)
    return LoadSharing(asperity_share=share, gap=gap, separation=separation)


def _root(function: Callable[[Array], Array], low: Array, high: Array) -> Array:
    """Roots between bounds, by the method of Chandrupatla (Adv. Eng. Softw. 28 (1997) 145-149).

    ``function`` is at least 0 at ``low`` and at most 0 at ``high``, element by element.
    """
    a, b = high, low
    value_a, value_b = function(a), function(b)
    c, value_c = a, value_a
    t = np.full(np.shape(a), 0.5)
    best = np.where(np.abs(value_a) < np.abs(value_b), a, b)
    for _ in range(_STEPS):
        x = a + t * (b - a)
        value = function(x)
        same = np.sign(value) == np.sign(value_a)
        c, value_c = np.where(same, a, b), np.where(same, value_a, value_b)
        b, value_b = np.where(same, b, a), np.where(same, value_b, value_a)
        a, value_a = x, value
        best = np.where(np.abs(value_a) < np.abs(value_b), a, b)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            least = _TOLERANCE * best / np.abs(b - c)
            if np.all(~(least < 0.5) | (value == 0.0)):
                break
            xi, phi = (a - b) / (c - b), (value_a - value_b) / (value_c - value_b)
            quadratic = value_a / (value_b - value_a) * value_c / (value_b - value_c)
            quadratic += (c - a) / (b - a) * value_a / (value_c - value_a) * value_b / (value_c - value_b)
            usable = (phi**2 < xi) & ((1.0 - phi) ** 2 < 1.0 - xi) & np.isfinite(quadratic)
            t = np.clip(
                np.where(usable, quadratic, 0.5), np.minimum(least, 0.5), np.maximum(1.0 - least, 0.5)
            )
        t = np.where(np.isfinite(t), t, 0.5)
    found: Array = best
    return found
