"""Films of a gear pair from a table of the atlas over its two groups. SI units.

Along the path of contact and with any load, contacts of one oil differ in Moes' groups M and L only:

    h/(R (2 U)^(1/2)) = H(M, L)        U = eta0 u/(E' R)
    M = w/(E' R) (2 U)^(-1/2)          L = alpha E' (2 U)^(1/4)

M varies by some powers of ten, L by a few per cent. The table contains ln H, and the numbers of the atlas
that the capacitance needs, at nodes that are equally spaced in ln M and at three Chebyshev nodes in ln L.
Between them it is a cubic spline in ln M, without knots next to its ends, and a parabola in ln L.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film import Groups, OilGroups, atlas_film
from ehlectric.lubricant.oil import Oil

# Distance of nodes in ln M, half of the distance of the nodes of the atlas. Least number of nodes.
_STEP, _LEAST = math.log(800.0 / 0.2) / 48.0, 5

# Ratio of the largest M to the smallest one of the table: a film under a smaller load is as thick as under
# the smallest one.
LOAD_RANGE = 200.0

# Least group M: a place without a load has 0.
_NONE = 1e-300

# Chebyshev nodes on -1 to 1.
_NODES = np.cos(np.pi * (np.arange(3) + 0.5) / 3.0)[::-1]

# Half the range of ln L at least, so that a pair with one L has a table.
_LEAST_HALF = 1e-6


@dataclass(frozen=True)
class FilmShape:
    """Numbers of films of shape (n,) from the atlas, in Moes' unit or dimensionless."""

    central: Array
    minimum: Array
    # Mean of rho(0) h(0)/(rho h) over the Hertz zone, divided by the density ratio rho(0).
    zone: Array
    central_pressure: Array  # pressure in the middle over the Hertz pressure
    # Integrals of dx/h before and behind the zone, divided by the integrals of the dry gap plus h(0).
    inlet: Array
    outlet: Array
    error: Array  # relative error of the central or of the minimum film, the greater one
    known: Mask  # whether the atlas contains the contact

    def some(self, which: slice) -> FilmShape:
        """Some of the films."""
        return FilmShape(**{name: values[which] for name, values in vars(self).items()})


@dataclass(frozen=True)
class FilmTable:
    """Films of one oil over M and L."""

    first: int  # number of the first node in ln M, in steps from M = 1
    middle: float  # middle of the range of ln L
    half: float  # half of it
    # Coefficients of four B-splines in ln M times three powers of the place in ln L, for each interval in
    # ln M and each number, shape (k - 1, 12, 6).
    coefficients: Array
    logs_of_errors: Array  # greatest over L at the nodes, shape (k,)
    known: Mask  # whether the atlas contains the contacts at a node, shape (k,)

    def __call__(self, groups: Groups) -> FilmShape:
        """Films of groups of shape (n,)."""
        number = self.known.size
        at = np.log(np.maximum(groups.moes_m, _NONE)) / _STEP - self.first
        at = np.minimum(np.maximum(at, 0.0), number - 1.0)
        low = np.minimum(at.astype(np.intp), number - 2)
        part = at - low
        place = (np.log(groups.moes_l) - self.middle) / self.half
        # B-splines of a uniform grid times powers of the place in ln L.
        rest = 1.0 - part
        splines = np.empty((4, part.size))
        splines[0], splines[3] = rest**3 / 6.0, part**3 / 6.0
        splines[1] = 2.0 / 3.0 - part * part * (1.0 - 0.5 * part)
        splines[2] = 1.0 - splines[0] - splines[1] - splines[3]
        powers = np.stack([np.ones_like(place), place, place * place])
        basis = (splines[:, np.newaxis] * powers).reshape(12, -1)
        logs = np.einsum("jn,njq->qn", basis, self.coefficients[low])
        error = self.logs_of_errors[low] * rest + self.logs_of_errors[low + 1] * part
        known = (
            self.known[low] & self.known[low + 1]
            if not np.all(self.known)
            else np.ones(part.size, dtype=bool)
        )
        central, minimum, zone, pressure, inlet, outlet = np.exp(logs)
        return FilmShape(central, minimum, zone, pressure, inlet, outlet, np.exp(error), known)


def _windows(coefficients: Array) -> Array:
    """Coefficients of the four splines of each interval, shape (k - 1, 12, q), of (k + 2, 3, q)."""
    number, _, q = coefficients.shape
    parts = [coefficients[k : number - 3 + k] for k in range(4)]
    return np.stack(parts, axis=1).reshape(number - 3, 12, q)


def film_tables(
    oil: Oil, groups: OilGroups, ranges: Sequence[tuple[float, float, float, float]]
) -> list[FilmTable]:
    """Tables of gear pairs. ``oil``, oil of the pairs, and ``groups``, its groups; ``ranges``, least and
    greatest M, least and greatest L of each pair.
    """
    laws = (oil.log_viscosity, oil.density_ratio)
    firsts, numbers, places = [], [], []
    for least, most, low, high in ranges:
        start = math.floor(math.log(max(least, most / LOAD_RANGE)) / _STEP)
        firsts.append(start)
        numbers.append(max(_LEAST, math.ceil(math.log(most) / _STEP) - start + 1))
        places.append((0.5 * math.log(low * high), max(0.5 * math.log(high / low), _LEAST_HALF)))
    first, (middle, half) = np.array(firsts), np.array(places).T
    steps = np.arange(max(numbers))[:, np.newaxis, np.newaxis]
    load = np.exp(_STEP * (first + steps))
    lubricant = np.exp(middle + half * _NODES[:, np.newaxis])
    film = atlas_film(Groups(load, lubricant), laws, groups, beyond=True)
    shape = steps.size, _NODES.size, first.size
    numbers_of = (
        film.central,
        film.minimum,
        film.zone * film.central / film.mass,
        film.central_pressure,
        film.inlet,
        film.outlet,
    )
    logs = np.stack([np.log(np.broadcast_to(each, shape)) for each in numbers_of], axis=-1)
    powers = np.einsum("pl,klnq->knpq", _POWERS, logs)
    errors = np.maximum(film.errors["central"], film.errors["minimum"])
    error = np.log(np.max(np.broadcast_to(errors, shape), axis=1))
    known = np.all(np.broadcast_to(film.known, shape), axis=1)
    return [
        FilmTable(
            firsts[k],
            float(middle[k]),
            float(half[k]),
            _windows(np.einsum("ij,jpq->ipq", _splines(size), powers[:size, k])),
            error[:size, k],
            known[:size, k],
        )
        for k, size in enumerate(numbers)
    ]


# Matrix from values at the nodes to coefficients of powers.
_POWERS = np.linalg.inv(np.vander(_NODES, increasing=True))


@lru_cache(maxsize=128)
def _splines(nodes: int) -> Array:
    """Matrix from values at uniform nodes to coefficients of cubic B-splines, shape (nodes + 2, nodes)."""
    matrix = np.zeros((nodes + 2, nodes + 2))
    for k in range(nodes):
        matrix[k + 1, k : k + 3] = 1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0
    # No jump of the third derivative at the nodes next to the ends.
    matrix[0, :5] = matrix[-1, -5:] = 1.0, -4.0, 6.0, -4.0, 1.0
    return np.asarray(np.linalg.inv(matrix)[:, 1:-1])
