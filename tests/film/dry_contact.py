"""Dry frictionless contact of rough elastic half-spaces, by a method that shares nothing with the film's.

The surfaces are pressed together until p >= 0, h >= s and p (h - s) = 0 everywhere, with the gap
h = h00 + (gap of the undeformed bodies) + (deflection), the total load given. s is zero, or the thickness of
a boundary film that holds the bodies apart. Conjugate gradients with a changing set of contact nodes:
I. A. Polonsky and L. M. Keer, Wear 231 (1999) 206-219, doi:10.1016/S0043-1648(99)00113-1. Convolutions are
zero-padded FFTs. The kernels are computed here from their closed forms.

Dimensionless as in ehlectric.film.deflection: X = x/b, P = p/p_h, H = h R/b^2, G = (added gap) R/b^2. An
asperity of height z adds G = -z R/b^2.

A pressure may be capped (elastic and perfectly plastic): 0 <= p <= hardness. Where the pressure is at the cap
the bodies overlap elastically; the overlap is the depth of the flattening, and the gap is that of the
flattened bodies. Material that flows is not piled up elsewhere.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import fft

Operator = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class DryContact:
    """Solution on the nodes, arrays of the shape of the gap that was given."""

    pressure: np.ndarray
    gap: np.ndarray  # of the flattened bodies: nowhere below the shift but for the error
    deflection: np.ndarray
    flattening: np.ndarray  # depth of the plastic flattening
    h00: float
    error: float  # largest violation of complementarity, over the range of the deflection
    iterations: int

    @property
    def contact(self):
        return self.pressure > 0.0

    @property
    def area(self):
        """Share of the nodes in contact."""
        return float(np.mean(self.contact))

    @property
    def corrected_area(self):
        """Share of a map in contact, less the grid's error by the edges of the spots.

        V. A. Yastrebov, G. Anciaux and J.-F. Molinari, Tribol. Int. 114 (2017) 161-171, arXiv:1701.02727:
        the contact's edges on the grid, of the length S, make the area (pi - 1 + ln 2)/24 S dX too large.
        """
        edges = sum(np.count_nonzero(np.diff(self.contact, axis=axis)) for axis in (0, 1))
        return self.area - (np.pi - 1.0 + np.log(2.0)) / 24.0 * edges / self.contact.size


def line_contact(x, added=0.0, *, load=0.5 * np.pi, linear=False, **options):
    """Line contact over even X (n,), with an added gap G (n,): H = H00 + X^2/2 + G - (1/pi) int ln|X-X'| P.

    The pressure is constant over each cell, or linear between the nodes if ``linear``.
    """
    dx = x[1] - x[0]
    operator = convolution(line_kernel(x.size, dx, linear=linear))
    return solve(operator, 0.5 * x**2 + added, load / dx, **options)


def point_contact(x, y, added=0.0, *, ellipse_ratio=1.0, load=None, **options):
    """Point contact over even X (nx,) and Y (ny,) with an added gap G (nx, ny).

    H = H00 + X^2/2 + (Rx/Ry) Y^2/2 + G + C int P/r, lengths in the semi-axis of the smooth contact along x,
    and the other semi-axis ``ellipse_ratio`` of them. The load defaults to that of the smooth contact.
    """
    dx, dy = x[1] - x[0], y[1] - y[0]
    ratio, compliance = ellipse(ellipse_ratio)
    operator = convolution(compliance * point_kernel((x.size, y.size), dx, dy))
    paraboloid = 0.5 * (x[:, np.newaxis] ** 2 + ratio * y**2)
    total = 2.0 * np.pi * ellipse_ratio / 3.0 if load is None else load
    return solve(operator, paraboloid + added, total / (dx * dy), **options)


def periodic_contact(gap, lengths, mean_pressure, *, modulus=1.0, **options):
    """Periodic contact of a gap (n,) or (nx, ny) with the periods ``lengths``; modulus E* = E'/2.

    Any consistent units. A wave of the wavenumber q is deflected by 2 p/(E* q).
    """
    nodes = gap.shape
    waves = [fft.fftfreq(n, length / n) for n, length in zip(nodes[:-1], lengths[:-1], strict=True)]
    waves.append(fft.rfftfreq(nodes[-1], lengths[-1] / nodes[-1]))
    q = 2.0 * np.pi * np.sqrt(sum(w**2 for w in np.meshgrid(*waves, indexing="ij")))
    with np.errstate(divide="ignore"):
        spectrum = np.where(q > 0.0, 2.0 / (modulus * q), 0.0)

    def operator(pressure):
        return fft.irfftn(fft.rfftn(pressure) * spectrum, nodes)

    return solve(operator, gap, mean_pressure * gap.size, **options)


def line_kernel(nodes, dx, *, linear=False):
    """Deflection at the distances k dX under unit pressure of one node: constant on its cell, or a hat."""
    if linear:
        s = np.arange(-1, nodes + 1) * dx
        second = 0.5 * s**2 * (np.log(np.abs(s), where=s != 0.0, out=np.zeros_like(s)) - 1.5)
        return -np.diff(second, 2) / (np.pi * dx)
    upper, lower = (np.arange(nodes) + 0.5) * dx, (np.arange(nodes) - 0.5) * dx
    return -(upper * np.log(upper) - lower * np.log(np.abs(lower)) - dx) / np.pi


def point_kernel(nodes, dx, dy):
    """Integral of 1/r over a cell at the distances (k dX, l dY): Love (1929), its form with logarithms."""
    x = (np.arange(nodes[0] + 1)[:, np.newaxis] - 0.5) * dx
    y = (np.arange(nodes[1] + 1) - 0.5) * dy
    r = np.hypot(x, y)
    corners = x * np.log(y + r) + y * np.log(x + r)
    return corners[1:, 1:] - corners[:-1, 1:] - corners[1:, :-1] + corners[:-1, :-1]


def ellipse(k):
    """Ratio Rx/Ry and the factor C of the deflection for a smooth contact with the semi-axes 1 and k.

    The potential of the Hertz pressure is (pi k/2) int (1 - X^2/(1+w) - Y^2/(k^2+w))/sqrt(w (1+w) (k^2+w)) dw
    (Johnson 1985, section 3.5), and C times its curvatures are those of the gap. With w = tan(t)^2.
    """
    t, weights = np.polynomial.legendre.leggauss(400)
    t, weights = 0.25 * np.pi * (t + 1.0), 0.25 * np.pi * weights
    # dw/sqrt(w (1 + w)) = 2 dt/cos(t).
    both = 2.0 * weights * np.cos(t) / np.sqrt(1.0 + (k**2 - 1.0) * np.cos(t) ** 2) / np.cos(t)
    along = float(np.sum(both * np.cos(t) ** 2))
    across = float(np.sum(both * np.cos(t) ** 2 / (1.0 + (k**2 - 1.0) * np.cos(t) ** 2)))
    return across / along, 1.0 / (np.pi * k * along)


def convolution(kernel):
    """Operator of the convolution with an even kernel, given at the distances k >= 0 on each axis."""
    nodes = kernel.shape
    padded = [fft.next_fast_len(2 * n - 1, real=True) for n in nodes]
    whole = np.zeros(padded)
    whole[np.ix_(*(np.arange(1 - n, n) for n in nodes))] = kernel[
        np.ix_(*(np.abs(np.arange(1 - n, n)) for n in nodes))
    ]
    spectrum, inside = fft.rfftn(whole), tuple(slice(n) for n in nodes)

    def operator(pressure):
        return fft.irfftn(fft.rfftn(pressure, padded) * spectrum, padded)[inside]

    return operator


def solve(
    operator, gap, total, *, hardness=np.inf, shift=0.0, tolerance=1e-10, most=20_000, start=None
) -> DryContact:
    """Pressure under which the gap plus its deflection is nowhere below ``shift``.

    ``total`` is the sum of the nodal pressures. The error counts the free nodes' distance from the shift,
    the depth by which nodes without pressure are below it, and the height of capped nodes above it.
    """
    if not 0.0 < total < hardness * gap.size:
        raise ValueError("the load must be above zero and below the hardness times the area")
    pressure = np.full(gap.shape, total / gap.size) if start is None else np.clip(start, 0.0, hardness)
    pressure = _balanced(pressure, total, hardness)
    deflection = operator(pressure)
    direction, before, conjugate = np.zeros(gap.shape), 1.0, False
    for iteration in range(most):
        free = (pressure > 0.0) & (pressure < hardness)
        residual = gap + deflection
        h00 = shift - _level(residual, pressure, free)
        residual += h00 - shift
        enters = ((pressure == 0.0) & (residual < 0.0)) | ((pressure == hardness) & (residual > 0.0))
        violation = float(np.max(np.abs(residual), where=free | enters, initial=0.0))
        if violation <= tolerance * np.ptp(deflection):
            overlap = np.where(pressure == hardness, np.maximum(-residual, 0.0), 0.0)
            error = violation / max(float(np.ptp(deflection)), np.finfo(float).tiny)
            gap = residual + shift + overlap
            return DryContact(pressure, gap, deflection, overlap, h00, error, iteration)
        if not np.any(residual[free]):
            free |= enters
        square = float(np.sum(residual[free] ** 2))
        direction = np.where(free, residual + (square / before if conjugate else 0.0) * direction, 0.0)
        # The load is kept, also where nodes have left the set: a constant of the kernel has no part in it.
        direction[free] -= np.mean(direction[free])
        step = float(np.vdot(residual, direction) / np.vdot(operator(direction), direction))
        trial = pressure - step * np.where(enters & ~free, residual, direction)
        trial = _balanced(np.clip(trial, 0.0, hardness), total, hardness)
        opened = operator(trial)
        before, conjugate = square, not enters.any()
        if _energy(trial, opened, gap) > _energy(pressure, deflection, gap) + 1e-12 * np.vdot(trial, opened):
            trial, opened = _descent(operator, gap, pressure, deflection, (residual, free | enters), hardness)
            conjugate = False
        pressure, deflection = trial, opened
    raise RuntimeError(f"the dry contact does not converge: {violation / np.ptp(deflection):.1e}")


def _level(opened, pressure, free):
    """Mean level of the free nodes, or a level between those at the hardness and those without pressure."""
    if free.any():
        return float(np.mean(opened[free]))
    return 0.5 * float(np.max(opened[pressure > 0.0]) + np.min(opened[pressure == 0.0]))


def _energy(pressure, deflection, gap):
    """Energy that the solution minimises under its load."""
    return float(np.vdot(pressure, gap + 0.5 * deflection))


def _descent(operator, gap, pressure, deflection, moving, hardness):
    """Projected step along the gradient that lowers the energy, and its deflection.

    It takes the place of a step of conjugate gradients that would raise the energy, as it may where most of
    the contact is at the hardness.
    """
    residual, free = moving
    along = np.where(free, residual, 0.0)
    along[free] -= np.mean(along[free])
    step = float(np.vdot(along, along) / np.vdot(operator(along), along))
    least, total = _energy(pressure, deflection, gap), float(np.sum(pressure))
    for _ in range(60):
        trial = _projected(pressure - step * residual, total, hardness)
        opened = operator(trial)
        if _energy(trial, opened, gap) < least:
            return trial, opened
        step *= 0.5
    return pressure, deflection


def _balanced(pressure, total, hardness):
    """Pressures below the hardness scaled to the load."""
    for _ in range(100):
        below = pressure < hardness
        wanted = total - (hardness * np.count_nonzero(~below) if not below.all() else 0.0)
        present = float(np.sum(pressure[below]))
        if wanted > 2.0 * present or wanted <= 0.0:
            break
        scaled = np.where(below, pressure * (wanted / present), pressure)
        pressure = np.minimum(scaled, hardness)
        if not np.any(scaled > hardness):
            return pressure
    return _projected(pressure, total, hardness)


def _projected(pressure, total, hardness):
    """Nearest pressures between zero and the hardness with the load: one shift of all, by bisection."""
    low, high = -np.max(pressure), min(hardness, total) - np.min(pressure)
    for _ in range(100):
        middle = 0.5 * (low + high)
        shifted = np.clip(pressure + middle, 0.0, hardness)
        low, high = (middle, high) if np.sum(shifted) < total else (low, middle)
    return shifted
