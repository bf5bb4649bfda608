"""Energy equation of the film with both surfaces: one march along x for all columns across it.

The march solves the columns from the inlet to the outlet. The fluxes into the bodies at the column itself are
implicit, those of the columns before it enter by the history of the moving surfaces. In the reverse flow of
the inlet the columns depend on those behind them; there one banded system of all columns is exact. Three
parts are taken from the last iterate: the history of the surfaces in the reverse flow, the heat that a slow
body conducts upstream, and the convection across the contact. The march is repeated for the last two.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import lapack

from ehlectric.arrays import Array, IntArray
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
    by_pressure : ndarray, shape (nz, nx, ny)
        Derivative of the temperature by the pressure at its own node, by heat of compression [K/Pa]; zero in
        the columns with reverse flow and before them.
    """

    temperature: Array
    flux: Array
    by_pressure: Array


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
        temperature, flux = mixed[:size].reshape(now.temperature.shape), mixed[size:].reshape(now.flux.shape)
        now = replace(now, temperature=temperature, flux=flux)
    return replace(new, by_pressure=march.by_pressure)


@dataclass(frozen=True, eq=False)
class _March:
    """Factorised columns: a banded system up to the end of the reverse flow, and inverses behind it.

    Behind the reverse flow the temperatures of a column and its fluxes into the bodies are a known part plus
    ``chain`` times the temperatures of the two columns before it and the rise of both surfaces by the fluxes
    before it.
    """

    columns: HeatColumns
    surfaces: tuple[Surface, Surface]
    entry: _Entry | None
    inverse: Array  # of the n columns behind the entry, (n, ny, nz, nz)
    chain: Array  # (n, ny, nz + 2, 2 nz + 2)

    @classmethod
    def of(cls, columns: HeatColumns, surfaces: tuple[Surface, Surface]) -> _March:
        matrix, own = columns.matrix.copy(), _own(surfaces)
        nz = len(matrix[0, 0])
        for row, resistance in zip((0, -1), own, strict=True):
            matrix[..., row, row] += 1.0 / resistance
        back = np.flatnonzero(np.any(columns.after[:-1], axis=(1, 2)))
        entry = _Entry.of(matrix, columns, int(back[-1]) + 2) if back.size else None
        behind = slice(entry.count if entry else 0, None)
        inverse: Array = np.asarray(np.linalg.inv(matrix[behind]), dtype=np.float64)
        chain = np.empty((*inverse.shape[:2], nz + 2, 2 * nz + 2))
        chain[..., :nz, :nz] = inverse * columns.second[behind, :, np.newaxis]
        chain[..., :nz, nz:-2] = inverse * columns.before[behind, :, np.newaxis]
        chain[..., :nz, -2:] = inverse[..., :: nz - 1] / own
        chain[..., nz:, :] = chain[..., : nz : nz - 1, :] / own[:, np.newaxis]
        chain[..., nz:, -2:] -= np.diag(1.0 / own)
        return cls(columns, surfaces, entry, inverse, chain)

    def __call__(self, last: Heat, inlet_temperature: float, *, symmetric: bool) -> Heat:
        columns, surfaces, own = self.columns, self.surfaces, _own(self.surfaces)
        nx, ny, nz = columns.right.shape
        old = np.moveaxis(last.temperature, 0, -1)
        right = columns.right + self._from_sides(old, inlet_temperature, symmetric=symmetric)
        # Surface temperatures (nx, ny, 2) without the fluxes at the column itself and, so far, before it.
        rest = np.stack([s.bulk + s.rise_ahead(q) for s, q in zip(surfaces, last.flux, strict=True)], axis=-1)
        # Temperatures along each line, with two columns of the inlet temperature before the first one.
        new = np.full((ny, (nx + 2) * nz + 2), inlet_temperature)
        columns_of = new[:, 2 * nz : -2].reshape(ny, nx, nz)
        flux = np.ascontiguousarray(last.flux.swapaxes(1, 2))
        start = 0
        if self.entry is not None:
            start = self.entry.count
            before = [s.rise_behind(q[:start]) for s, q in zip(surfaces, last.flux, strict=True)]
            rest[:start] += np.stack(before, axis=-1)
            right[:start, :, :: nz - 1] += rest[:start] / own
            found = self.entry(right[:start], inlet_temperature)
            columns_of[:, :start] = found.swapaxes(0, 1)
            flux[..., :start] = ((found[..., :: nz - 1] - rest[:start]) / own).transpose(2, 1, 0)
        right[start:, :, :: nz - 1] += rest[start:] / own
        known = (self.inverse @ right[start:, ..., np.newaxis])[..., 0]
        known = np.concatenate([known, (known[..., :: nz - 1] - rest[start:]) / own], axis=-1)
        tails = np.stack([surface.downstream[::-1, np.newaxis] for surface in surfaces])
        for i, chain, part in zip(range(start, nx), self.chain, known, strict=True):
            place = (i + 2) * nz
            # Until the column is known, its place holds the rise of both surfaces.
            new[:, place : place + 2] = (flux[..., :i] @ tails[:, nx - 1 - i : nx - 1])[..., 0].T
            column = (chain @ new[:, place - 2 * nz : place + 2, np.newaxis])[..., 0] + part
            new[:, place : place + nz], flux[..., i] = column[:, :nz], column[:, nz:].T
        temperature = np.ascontiguousarray(columns_of.transpose(2, 1, 0))
        return replace(last, temperature=temperature, flux=np.ascontiguousarray(flux.swapaxes(1, 2)))

    @property
    def by_pressure(self) -> Array:
        """Derivative of the temperature (nz, nx, ny) by the pressure at its own node [K/Pa]."""
        found = np.zeros_like(self.columns.right_p)
        start = len(found) - len(self.inverse)
        found[start:] = (self.inverse @ self.columns.right_p[start:, ..., np.newaxis])[..., 0]
        return np.ascontiguousarray(np.moveaxis(found, -1, 0))

    def _from_sides(self, old: Array, inlet_temperature: float, *, symmetric: bool) -> Array | float:
        """Heat that the flow across the contact carries from the neighbouring lines of the last iterate."""
        if not self.columns.from_left.any() and not self.columns.from_right.any():
            return 0.0
        padded = np.pad(old, ((0, 0), (1, 1), (0, 0)), constant_values=inlet_temperature)
        if symmetric:
            padded[:, 0] = old[:, 1]
        return np.asarray(self.columns.from_left * padded[:, :-2] + self.columns.from_right * padded[:, 2:])


def _own(surfaces: tuple[Surface, Surface]) -> Array:
    """Rise of both surfaces by a unit flux at the same column, shape (2,)."""
    return np.array([surface.downstream[0] for surface in surfaces])


@dataclass(frozen=True, eq=False)
class _Entry:
    """Columns of the inlet up to the first one behind the reverse flow, as one factorised banded system.

    The lines along x are independent parts of it. All couplings of the columns are diagonal.
    """

    columns: HeatColumns
    count: int  # columns along x
    factors: Array
    pivots: IntArray

    @classmethod
    def of(cls, matrix: Array, columns: HeatColumns, count: int) -> _Entry:
        """Factorise ``count`` columns; ``matrix`` has the fluxes into the bodies at each column."""
        ny, nz = columns.right.shape[1:]
        lower, upper = 2 * nz, nz
        # Band storage of LAPACK, each column of the matrix in one row here, with room for the pivoting.
        band = np.zeros((ny, count, nz, 2 * lower + upper + 1))
        row, column = np.indices((nz, nz))
        node, centre = np.arange(nz), lower + upper
        lines = [values[:count].swapaxes(0, 1) for values in (columns.before, columns.second, columns.after)]
        before, second, after = lines
        band[:, :, column, centre + row - column] = matrix[:count].swapaxes(0, 1)
        band[:, :-1, node, centre + nz] = -before[:, 1:]
        band[:, :-2, node, centre + 2 * nz] = -second[:, 2:]
        band[:, 1:, node, centre - nz] = -after[:, :-1]
        flat = band.reshape(-1, band.shape[-1]).T
        factors, pivots, _ = lapack.dgbtrf(flat, lower, upper, overwrite_ab=1)
        return cls(columns, count, factors, pivots)

    def __call__(self, right: Array, inlet_temperature: float) -> Array:
        """Temperatures (count, ny, nz) for a right side with the fluxes of the columns before each."""
        right = right.copy()
        right[0] += (self.columns.before[0] + self.columns.second[0]) * inlet_temperature
        right[1] += self.columns.second[1] * inlet_temperature
        lines = right.swapaxes(0, 1)
        nz = right.shape[-1]
        found, _ = lapack.dgbtrs(self.factors, 2 * nz, nz, lines.reshape(-1), self.pivots)
        return np.asarray(found.reshape(lines.shape).swapaxes(0, 1))
