"""Elastic deflection of two half-spaces under a pressure on a uniform grid.

Dimensionless: X = x/b, P = p/p_h, H = h R/b^2. The deflection is the discrete convolution of the
pressure with influence coefficients, evaluated by zero-padded real FFTs in O(N log N).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy import fft

from ehlectric.typing import Array, ComplexArray


def line_influence(nodes: int, dx: float) -> Array:
    """Gap opened at distance k dX by a unit pressure on one cell of a line contact.

    Parameters
    ----------
    nodes : int
        Number of nodes along x.
    dx : float
        Grid spacing dX, dimensionless.

    Returns
    -------
    ndarray, shape (nodes, 1)
        -K_k/pi for k = 0 ... nodes - 1, dimensionless. The undetermined rigid displacement of a line
        contact is part of H00.

    Notes
    -----
    Eqs. (1) and (5) of Morris et al. (2022), doi:10.3390/lubricants10050087: the integral of ln|X| over
    the cell. H follows with the reduced modulus of 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Examples
    --------
    >>> import numpy as np
    >>> bool(np.isclose(line_influence(8, 0.5)[0, 0], -0.5 * (np.log(0.25) - 1.0) / np.pi))
    True
    """
    distance = (np.arange(nodes + 1) - 0.5) * dx
    antiderivative = distance * (np.log(np.abs(distance)) - 1.0)
    influence: Array = (-np.diff(antiderivative) / np.pi)[:, np.newaxis]
    return influence


def rigid_influence(nodes: int, _dx: float) -> Array:
    """Influence coefficients of bodies that do not deflect: zeros, shape (nodes, 1)."""
    return np.zeros((nodes, 1))


@dataclass(frozen=True)
class Geometry:
    """What tells one kind of contact from another in the film equations.

    Attributes
    ----------
    influence : callable
        Influence coefficients of the deflection: (nodes, dX) -> (nx, ny).
    dry_gap : callable
        Gap of the undeformed bodies that just touch: X (nx,) -> H (nx, ny).
    load : float
        Integral of P over the contact.
    """

    influence: Callable[[int, float], Array]
    dry_gap: Callable[[Array], Array]
    load: float


LINE = Geometry(line_influence, lambda x: 0.5 * x[:, np.newaxis] ** 2, 0.5 * np.pi)
RIGID_LINE = replace(LINE, influence=rigid_influence)


@dataclass(frozen=True)
class Deflection:
    """The deflection operator of one grid: call it with a pressure (nx, ny).

    Examples
    --------
    A Hertz pressure opens the gap of a line contact by (1/2)(ln 2 + 1/2) - X^2/2 inside the contact:

    >>> import numpy as np
    >>> x = np.linspace(-2.0, 2.0, 1601)
    >>> hertz = np.sqrt(np.maximum(0.0, 1.0 - x**2))[:, np.newaxis]
    >>> opened = Deflection.from_influence(line_influence(1601, x[1] - x[0]))(hertz)
    >>> round(float(opened[800, 0]), 3), round(0.5 * float(np.log(2.0) + 0.5), 3)
    (0.597, 0.597)
    """

    influence: Array
    spectrum: ComplexArray
    padded: tuple[int, int]

    @classmethod
    def from_influence(cls, influence: Array) -> Deflection:
        """Operator of influence coefficients given for non-negative distances, shape (nx, ny)."""
        nx, ny = influence.shape
        mx = fft.next_fast_len(2 * nx - 1, real=True)
        my = fft.next_fast_len(2 * ny - 1)
        wrapped = np.zeros((mx, my))
        wrapped[:nx, :ny] = influence
        wrapped[mx - nx + 1 :, :ny] = influence[:0:-1]
        wrapped[:, my - ny + 1 :] = wrapped[:, ny - 1 : 0 : -1]
        return cls(influence, _transform(wrapped, (mx, my)), (mx, my))

    def matrix(self) -> Array:
        """The dense operator on the nodes in order, shape (nx ny, nx ny)."""
        nx, ny = self.influence.shape
        x, y = np.divmod(np.arange(nx * ny), ny)
        matrix: Array = self.influence[np.abs(x[:, np.newaxis] - x), np.abs(y[:, np.newaxis] - y)]
        return matrix

    def __call__(self, pressure: Array) -> Array:
        """Gap opened by ``pressure``, dimensionless, shape (nx, ny)."""
        nx, ny = self.influence.shape
        mx, my = self.padded
        product = _transform(pressure, self.padded)
        product *= self.spectrum
        if my > 1:
            product = fft.ifft(product, my, axis=1, overwrite_x=True)
        opened: Array = fft.irfft(product, mx, axis=0)[:nx, :ny]
        return opened


def _transform(values: Array, padded: tuple[int, int]) -> ComplexArray:
    """Zero-padded transform, real along x; along y only where there is a y."""
    mx, my = padded
    transform: ComplexArray = fft.rfft(values, mx, axis=0)
    return fft.fft(transform, my, axis=1, overwrite_x=True) if my > 1 else transform
