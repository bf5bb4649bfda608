"""Energy equation of the film with both surfaces: one march along x for all columns across it.

The march solves the columns from the inlet to the outlet. The fluxes into the bodies at the column itself are
implicit, those of the columns before it enter by the history of the moving surfaces. In the reverse flow of
the inlet the columns depend on those behind them; there a block elimination is exact. Three parts are taken
from the last iterate: the history of the surfaces in the reverse flow, the heat that a slow body conducts
upstream, and the convection across the contact. The march is repeated for the last two.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.thermal.columns import HeatColumns
from ehlectric.film.thermal.half_space import Surface
from ehlectric.film.thermal.mixing import Mixing

# Largest number of marches, and the change of temperature [K] at which they stand.
_MARCHES, _STANDS = 25, 1e-3


@dataclass(frozen=True, eq=False)
class Heat:
    """Temperature of the film and heat flow into both bodies.

    Attributes
    ----------
    temperature : ndarray, shape (nz, nx, ny)
        Temperature [K] at the nodes across the film; the first and the last are the surfaces.
    flux : ndarray, shape (2, nx, ny)
        Heat flow into body a and body b [W/m^2].
    """

    temperature: Array
    flux: Array


def solve_energy(
    columns: HeatColumns,
    surfaces: tuple[Surface, Surface],
    last: Heat,
    *,
    inlet_temperature: float,
    symmetric: bool = False,
    marches: int = _MARCHES,
    enough: float = 0.02,
) -> Heat:
    """Temperature of the film for a given flow.

    Parameters
    ----------
    columns : HeatColumns
        Linear systems of the columns.
    surfaces : tuple of Surface
        Surfaces a and b.
    last : Heat
        Last iterate.
    inlet_temperature : float
        Temperature of the oil that enters [K].
    symmetric : bool
        Whether the first line is a line of symmetry.
    marches : int
        Largest number of marches.
    enough : float
        Change of temperature in a march, over that in the first one, at which to stop.

    Returns
    -------
    Heat
        Temperature and heat flow into the bodies.
    """
    march = _March.of(columns, surfaces)
    lagged = any(surface.is_slow for surface in surfaces) or bool(columns.from_left.any())
    now, mixing, first = last, Mixing(), 0.0
    for _ in range(marches if lagged else 1):
        new = march(now, inlet_temperature, symmetric=symmetric)
        change = float(np.max(np.abs(new.temperature - now.temperature)))
        first = max(first, change)
        if not change > max(_STANDS, enough * first):
            break
        mixed = mixing(
            np.concatenate([now.temperature.ravel(), now.flux.ravel()]),
            np.concatenate([new.temperature.ravel(), new.flux.ravel()]),
        )
        size = now.temperature.size
        now = Heat(mixed[:size].reshape(now.temperature.shape), mixed[size:].reshape(now.flux.shape))
    return new


@dataclass(frozen=True, eq=False)
class _March:
    """Factorised columns: inverses behind the reverse flow, and the block elimination in it."""

    columns: HeatColumns
    surfaces: tuple[Surface, Surface]
    reverse: int  # number of columns up to the last one with reverse flow
    inverse: Array  # (nx, ny, nz, nz)
    passed: Array  # (reverse, ny, nz, nz): dependence of a column on the next one

    @classmethod
    def of(cls, columns: HeatColumns, surfaces: tuple[Surface, Surface]) -> _March:
        matrix = columns.matrix.copy()
        for row, surface in zip((0, -1), surfaces, strict=True):
            matrix[..., row, row] += 1.0 / surface.downstream[0]
        back = np.flatnonzero(np.any(columns.after[:-1], axis=(1, 2)))
        reverse = int(back[-1]) + 1 if back.size else 0
        passed = np.zeros((reverse, *matrix.shape[1:]))
        for i in range(reverse + 2):
            if i >= len(matrix):
                break
            # Columns before i are known as their part of T_i; the columns i - 1 and i - 2 may be eliminated.
            if 0 < i <= reverse:
                known = columns.before[i][..., np.newaxis] * passed[i - 1]
                if i > 1:
                    known += columns.second[i][..., np.newaxis] * (passed[i - 2] @ passed[i - 1])
                matrix[i] -= known
            if i < reverse:
                passed[i] = np.linalg.inv(matrix[i]) * columns.after[i][..., np.newaxis, :]
        inverse: Array = np.asarray(np.linalg.inv(matrix), dtype=np.float64)
        return cls(columns, surfaces, reverse, inverse, passed)

    def __call__(self, last: Heat, inlet_temperature: float, *, symmetric: bool) -> Heat:
        columns, reverse = self.columns, self.reverse
        nx = len(columns.right)
        old = np.moveaxis(last.temperature, 0, -1)
        right = columns.right + self._from_sides(old, inlet_temperature, symmetric=symmetric)
        ahead = [surface.rise_ahead(flux) for surface, flux in zip(self.surfaces, last.flux, strict=True)]
        new = np.empty_like(old)
        flux = last.flux.copy()
        inlet = np.full(old.shape[1:], inlet_temperature)
        own = [surface.downstream[0] for surface in self.surfaces]
        tails = [np.ascontiguousarray(surface.downstream[::-1]) for surface in self.surfaces]
        resting = np.empty((2, *old.shape[1:2]))

        def solved(i: int, before: Array, second: Array) -> Array:
            r = right[i] + columns.before[i] * before + columns.second[i] * second
            for body, row in ((0, 0), (1, -1)):
                history = tails[body][nx - 1 - i : nx - 1] @ flux[body, :i] + ahead[body][i]
                resting[body] = self.surfaces[body].bulk + history
                r[:, row] += resting[body] / own[body]
            return np.asarray((self.inverse[i] @ r[..., np.newaxis])[..., 0])

        # Reverse flow: T_i = passed_i T_(i+1) + part_i, with the fluxes of the last iterate.
        parts: list[Array] = []
        held = np.empty((reverse, 2, old.shape[1]))
        for i in range(reverse):
            before = parts[i - 1] if i > 0 else inlet
            second = inlet
            if i > 1:
                second = (self.passed[i - 2] @ before[..., np.newaxis])[..., 0] + parts[i - 2]
            parts.append(solved(i, before, second))
            held[i] = resting
        for i in range(reverse, nx):
            if i == reverse and reverse > 0:
                before = parts[i - 1]
                second = inlet
                if i > 1:
                    second = (self.passed[i - 2] @ before[..., np.newaxis])[..., 0] + parts[i - 2]
                new[i] = solved(i, before, second)
                self._back(new, parts, held, flux)
            else:
                new[i] = solved(i, new[i - 1] if i > 0 else inlet, new[i - 2] if i > 1 else inlet)
            for body, row in ((0, 0), (1, -1)):
                flux[body, i] = (new[i, :, row] - resting[body]) / own[body]
        return Heat(np.ascontiguousarray(np.moveaxis(new, -1, 0)), flux)

    def _back(self, new: Array, parts: list[Array], held: Array, flux: Array) -> None:
        """Temperatures and fluxes of the columns with reverse flow, once the next column is known."""
        for i in range(self.reverse - 1, -1, -1):
            new[i] = (self.passed[i] @ new[i + 1][..., np.newaxis])[..., 0] + parts[i]
            for body, row in ((0, 0), (1, -1)):
                flux[body, i] = (new[i, :, row] - held[i, body]) / self.surfaces[body].downstream[0]

    def _from_sides(self, old: Array, inlet_temperature: float, *, symmetric: bool) -> Array | float:
        """Heat that the flow across the contact carries from the neighbouring lines of the last iterate."""
        if not self.columns.from_left.any() and not self.columns.from_right.any():
            return 0.0
        padded = np.pad(old, ((0, 0), (1, 1), (0, 0)), constant_values=inlet_temperature)
        if symmetric:
            padded[:, 0] = old[:, 1]
        return np.asarray(self.columns.from_left * padded[:, :-2] + self.columns.from_right * padded[:, 2:])
