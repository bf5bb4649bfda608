"""Capacitances of the elements of an axle over the error of their films.

The ratio C(f)/C(1) with films f times as thick is computed at the inputs of the case, and interpolated over
ln f.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.axle.solution import Element, SolvedFilms
from ehlectric.bearing import gathered, many_of, shaft_capacitance, solved_parts
from ehlectric.gear import capacitances_over_films

# Factors on the films at which capacitances are computed.
_FACTORS = 5


@dataclass(frozen=True)
class FilmCapacitances:
    """Capacitances of elements over the factor on their films, divided by the ones without a factor."""

    log_factors: tuple[Array, Array]  # of bearings and of meshes, shape (f,) each
    log_ratios: tuple[Array, ...]  # of each element, shape (f,)

    @classmethod
    def of(cls, films: SolvedFilms, errors: tuple[float, float]) -> FilmCapacitances:
        """Capacitances around solved films with the relative errors of bearings and of meshes."""
        factors = [1.0 + error * np.linspace(-1.0, 1.0, _FACTORS) for error in errors]
        rows = []
        for bearing in films.bearings:
            case, ends = bearing.solution.case, np.append(factors[0], 1.0)
            speeds = np.full(ends.size, case.bearing.inner_speed)
            many = many_of(case, {"bearing.inner_speed": speeds}, ends.size)
            parts = solved_parts(many, detail="coarse", films=ends)
            rows.append(gathered(parts, lambda each: [shaft_capacitance(each)], (1, ends.size))[0])
        rows += [capacitances_over_films(mesh, np.append(factors[1], 1.0)) for mesh in films.meshes]
        ratios = tuple(np.log(row[:-1] / row[-1]) for row in rows)
        return cls((np.log(factors[0]), np.log(factors[1])), ratios)

    def scaled(self, elements: Sequence[Element], factors: Array) -> Iterator[Element]:
        """Elements with the capacitances of films that are ``factors`` times as thick, of bearings and of
        meshes.
        """
        for element, ratios in zip(elements, self.log_ratios, strict=True):
            kind = 0 if element.kind == "bearing" else 1
            log = float(np.interp(math.log(factors[kind]), self.log_factors[kind], ratios))
            yield replace(element, capacitance=element.capacitance * math.exp(log))
