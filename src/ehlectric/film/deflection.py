"""Elastic deflection of two half-spaces under a pressure on a uniform grid.

Dimensionless: X = x/b, Y = y/b, P = p/p_h, H = h R/b^2. The deflection is the discrete convolution of the
pressure with influence coefficients, evaluated by zero-padded real FFTs in O(N log N).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from ehlectric.arrays import Array, ComplexArray
from ehlectric.film.mesh import Mesh
from ehlectric.formulas.hertz import line_pressure, point_pressure


def line_influence(nodes: int, dx: float) -> Array:
    """Influence coefficients of a line contact: deflection at distances k dX under unit pressure on one cell.
    ``dx``, grid spacing dX, dimensionless. Returns -K_k/pi for k = 0 ... nodes - 1, dimensionless,
    shape (nodes, 1).

    K_k of eqs. (1) and (5) of Morris et al. (2022), doi:10.3390/lubricants10050087, is the integral of ln|X|
    over the cell. The reduced modulus is defined by 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

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


def point_influence(nodes: tuple[int, int], dx: float, dy: float) -> Array:
    """Influence coefficients of a point contact: integral of 1/r over one cell, at distances (k dX, l dY).
    ``dx`` and ``dy``, grid spacings, dimensionless. Returns integral of 1/sqrt(X^2 + Y^2) over the cell,
    shape (nodes[0], nodes[1]).

    A. E. H. Love, Phil. Trans. R. Soc. Lond. A 228 (1929) 377-420, doi:10.1098/rsta.1929.0009, at the
    surface. The deflection is the integral times 2 p_h Rx/(pi E' b), with
    2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. This factor is 2/pi^2 for a circular contact.

    Examples
    --------
    Far away the pressure on the cell acts like a point load:

    >>> float(round(point_influence((101, 1), 0.5, 0.5)[100, 0] * 50.0 / 0.25, 4))
    1.0
    """
    x, y = ((np.arange(n + 1) - 0.5) * d for n, d in zip(nodes, (dx, dy), strict=True))
    x = x[:, np.newaxis]
    antiderivative = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    return np.diff(np.diff(antiderivative, axis=0), axis=1)


@dataclass(frozen=True)
class Geometry:
    """Kind of contact in the film equations: deflection kernel, dry gap and load."""

    # Influence coefficients of the deflection: function of (nx, ny), dX and dY -> (nx, ny).
    influence: Callable[[tuple[int, int], float, float], Array]
    # Gap of the undeformed bodies that just touch: function of X (nx,) and Y (ny,) -> H (nx, ny).
    dry_gap: Callable[[Array, Array], Array]
    # Hertz pressure: function of X (nx,) and Y (ny,) -> P (nx, ny).
    dry_pressure: Callable[[Array, Array], Array]
    load: float  # dimensionless load, the integral of P over the contact
    # Reduced radius along entrainment over the reduced radius across it, Rx/Ry; zero for a line contact.
    radius_ratio: float


LINE = Geometry(
    influence=lambda nodes, dx, _dy: line_influence(nodes[0], dx),
    dry_gap=lambda x, _y: 0.5 * x[:, np.newaxis] ** 2,
    dry_pressure=lambda x, _y: line_pressure(x)[:, np.newaxis],
    load=0.5 * np.pi,
    radius_ratio=0.0,
)


def point_geometry(*, radius_ratio: float, ellipse_ratio: float, compliance: float) -> Geometry:
    """Geometry of an elliptical contact, lengths in semi-axes b along entrainment. ``compliance``, factor of
    the deflection 2 p_h Rx/(pi E' b), dimensionless; zero for rigid bodies. Returns geometry with H = H00 +
    X^2/2 + (Rx/Ry) Y^2/2 + deflection, and the load 2 pi ellipse_ratio/3.

    Examples
    --------
    >>> circle = point_geometry(radius_ratio=1.0, ellipse_ratio=1.0, compliance=2.0 / np.pi**2)
    >>> circle.dry_gap(np.array([1.0]), np.array([0.0, 1.0]))
    array([[0.5, 1. ]])
    """
    return Geometry(
        influence=lambda nodes, dx, dy: compliance * point_influence(nodes, dx, dy),
        dry_gap=lambda x, y: 0.5 * (x[:, np.newaxis] ** 2 + radius_ratio * y**2),
        dry_pressure=lambda x, y: point_pressure(x[:, np.newaxis], y, ellipse_ratio),
        load=2.0 * np.pi * ellipse_ratio / 3.0,
        radius_ratio=radius_ratio,
    )


@dataclass(frozen=True)
class Deflection:
    """Operator of the elastic deflection on one grid; it is called with a pressure (nx, ny).

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

    influence: Array  # influence coefficients for non-negative distances, shape (nx, lines)
    spectrum: Array  # discrete Fourier transform of the influence coefficients; it is real, as they are even
    padded: tuple[int, int]  # zero-padded shape of the transform
    symmetric: bool = False  # whether the grid is the half y >= 0 of a symmetric contact

    @classmethod
    def on(cls, mesh: Mesh, geometry: Geometry) -> Deflection:
        """Deflection operator of a contact on a mesh."""
        nx, ny = mesh.shape
        # On a symmetric mesh the last line is 2 ny - 2 spacings away from its own mirror image.
        lines = 2 * ny - 1 if mesh.symmetric else ny
        influence = geometry.influence((nx, lines), mesh.dx, mesh.dy or 0.0)
        return cls.from_influence(influence, symmetric=mesh.symmetric)

    @classmethod
    def from_influence(cls, influence: Array, *, symmetric: bool = False) -> Deflection:
        """Deflection operator from influence coefficients for non-negative distances, shape (nx, ny).

        For the half y >= 0 of a symmetric contact the coefficients have the shape (nx, 2 ny - 1). They then
        include the distances to the mirror image.
        """
        nx, lines = influence.shape
        # The largest distances nx - 1 and 1 - nx may fall on one another, as the coefficients are even.
        mx = scipy.fft.next_fast_len(2 * nx - 2, real=True)
        # A cosine transform needs only one half of the period of an even sequence.
        my = scipy.fft.next_fast_len(lines - 1) if symmetric else scipy.fft.next_fast_len(2 * lines - 2)
        my = 1 if lines == 1 else my
        wrapped = np.zeros((mx, my + 1 if symmetric else my))
        wrapped[:nx, :lines] = influence
        wrapped[mx - nx + 1 :] = wrapped[nx - 1 : 0 : -1]
        if lines > 1 and not symmetric:
            wrapped[:, my - lines + 1 :] = wrapped[:, lines - 1 : 0 : -1]
        # The coefficients are even along both axes, so that their transform is real.
        spectrum = _transform(wrapped, wrapped.shape, symmetric=symmetric).real.copy()
        return cls(influence, spectrum, (mx, wrapped.shape[1]), symmetric)

    @cached_property
    def matrix(self) -> Array:
        """Deflection operator as a dense matrix over the nodes, y fastest, shape (nx ny, nx ny)."""
        nx, lines = self.influence.shape
        ny = (lines + 1) // 2 if self.symmetric else lines
        x, y = np.divmod(np.arange(nx * ny), ny)
        along = np.abs(x[:, np.newaxis] - x)
        matrix: Array = self.influence[along, np.abs(y[:, np.newaxis] - y)]
        if self.symmetric:
            matrix += np.where(y > 0, self.influence[along, y[:, np.newaxis] + y], 0.0)
        return matrix

    def shifted(self, steps: tuple[int, ...]) -> Array:
        """Influence coefficients along a line of nodes next to the nodes of a pressure. Returns deflection at
        the node a step behind node i by the pressure of node j, over j - i from 1 - nx to nx - 1, shape (n
        steps, 2 nx - 1); beyond the grid it is the coefficient of its largest distance.
        """
        if steps not in self._shifted:
            nx = len(self.influence)
            apart = np.abs(np.arange(1 - nx, nx) - np.array(steps)[:, np.newaxis])
            self._shifted[steps] = self.influence[np.minimum(apart, nx - 1), 0]
        return self._shifted[steps]

    def of_lines(self, pressure: Array) -> Array:
        """Deflection of lines along x by the pressure on each line only, both of the shape (nx, n)."""
        length, spectrum = self._along
        transform = scipy.fft.rfft(pressure, length, axis=0)
        transform *= spectrum
        opened: Array = scipy.fft.irfft(transform, length, axis=0)[: len(pressure)]
        return opened

    @cached_property
    def _along(self) -> tuple[int, Array]:
        """Zero-padded length of a line, and the spectrum of the coefficients along it, shape (n, 1)."""
        of_line = Deflection.from_influence(self.influence[:, :1])
        return of_line.padded[0], of_line.spectrum

    @cached_property
    def _single(self) -> Array:
        """Spectrum of single precision."""
        return self.spectrum.astype(np.float32)

    @cached_property
    def _shifted(self) -> dict[tuple[int, ...], Array]:
        """Coefficients of ``shifted`` by their steps."""
        return {}

    def __call__(self, pressure: Array) -> Array:
        """Deflection under ``pressure`` (nx, ny), by which the gap opens; dimensionless, shape (nx, ny).

        It is of single precision if the pressure is.
        """
        nx, ny = pressure.shape
        mx, my = self.padded
        product = _transform(pressure, self.padded, symmetric=self.symmetric)
        product *= self._single if pressure.dtype == np.float32 else self.spectrum
        if my > 1 and not self.symmetric:
            product = scipy.fft.ifft(product, my, axis=1, overwrite_x=True)
        opened: Array = scipy.fft.irfft(product, mx, axis=0)[:nx]
        if self.symmetric:
            opened = scipy.fft.idct(opened, 1, my, axis=1)
        return opened[:, :ny]


def _transform(values: Array, padded: tuple[int, int], *, symmetric: bool) -> ComplexArray:
    """Zero-padded Fourier transform of nodal values.

    The transform is a real one along x. Along y it is a cosine transform for a symmetric mesh, a complex one
    for a whole point contact, and none for a line contact.
    """
    mx, my = padded
    if symmetric:
        values = scipy.fft.dct(values, 1, my, axis=1)
    transform: ComplexArray = scipy.fft.rfft(values, mx, axis=0)
    if my > 1 and not symmetric:
        transform = scipy.fft.fft(transform, my, axis=1, overwrite_x=True)
    return transform
