"""Capacitances of an electric machine from its geometry, and of conductors with a thin gap between them.
SI units.

The rotor is a smooth conducting cylinder: a closed or bar-filled surface. The stator is a row of slots with
parallel walls at the potential of the frame; the copper of the winding fills them from a depth below the
bore on. The electric field of one slot, unrolled, is solved by its modes in the slot and in the air gap,
matched at the opening. If the copper lies deep, the capacitance of the gap follows Carter
(J. Inst. Electr. Eng. 29 (1901) 925): the capacitance of the smooth gap divided by his coefficient.

The two-dimensional field neglects the end windings and the leads, which add to all of them. Their share of
the capacitance from winding to rotor is not small in short machines (Stockbruegger and Ponick, Energies 14
(2021) 174, doi:10.3390/en14010174).

On a plane below a conductor at the voltage V and the gap h(x, y), the charge density is (eps0 eps V)/h to
leading order. For the gap of a ball, h = rho^2/(2 r), the next order is constant over the whole tail. It adds
some percent to the capacitance of a ball and is therefore included. Expanding the potential in powers of the
slope, V(z)/V = z/h + z (h^2 - z^2) lap(1/h)/6 + ..., gives (1 + abs(grad h)^2/3 - h lap h/6)/h on the plane.
Let delta be the distance along the normal of the far surface, beta the angle between both normals there, and
k_far and k_near the sums of the principal curvatures of both surfaces. On the near surface the charge density
over eps0 eps V is then

    (sin(beta)/beta)/delta - k_far/6 - k_near/3.

A curvature is positive where its centre lies beyond the far surface. Concentric spheres extend the formula
from a plane to a curved near surface. The formula is exact for a wedge, and exact to this order for
concentric spheres and cylinders. For a sphere or a cylinder over a plane, tests compare it with the exact
charge.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Numbers
from ehlectric.constants import EPSILON_0
from ehlectric.formulas.polynomials import gauss_legendre

# Modes of the slot, and waves of the gap for each of them and for each ratio of slot pitch to opening. The
# field at the edges of the teeth is singular: capacitances are exact to 1e-3.
_MODES, _WAVES = 40, 10


@dataclass(frozen=True)
class Machine:
    """Geometry of the active part of a machine."""

    length: float  # length of the stack of laminations [m]
    bore: float  # diameter of the bore of the stator [m]
    gap: float  # air gap between the stator's teeth and the rotor [m]
    slots: int
    opening: float  # width of a slot at the bore [m]
    depth: float  # depth below the bore at which the copper begins [m]
    permittivity: float  # relative permittivity of what fills the slot up to the copper
    # Length of the line along which copper and iron face each other in the section of a slot [m].
    liner_width: float
    liner: float  # thickness of the insulation between them [m]
    liner_permittivity: float

    @property
    def pitch(self) -> float:
        """Distance between two slots along the bore [m]."""
        return math.pi * self.bore / self.slots


@dataclass(frozen=True)
class MachineCapacitances:
    """Capacitances of a machine [F]."""

    winding_rotor: float  # from the winding to the rotor, through the openings of the slots
    rotor_frame: float  # from the rotor to the frame, through the air gap
    winding_frame: float  # from the winding to the frame, through the insulation of the slots


def machine_capacitances(machine: Machine) -> MachineCapacitances:
    """Capacitances of a machine without its end windings. Returns capacitances [F].

    The cylinder of the gap has the capacitance ``2 pi EPSILON_0 length / log(bore / (bore - 2 gap))``; its
    parts to winding and frame follow from the unrolled gap. The insulation of the slots is a plate, as in
    Muetze and Binder, IEEE Trans. Ind. Appl. 43 (2007) 665, doi:10.1109/TIA.2007.895734.

    Examples
    --------
    >>> machine = Machine(0.1, 0.1, 0.5e-3, 36, 2.5e-3, 1.5e-3, 1.0, 40e-3, 0.3e-3, 3.5)
    >>> found = machine_capacitances(machine)
    >>> [round(1e12 * value) for value in (found.winding_rotor, found.rotor_frame, found.winding_frame)]
    [14, 460, 14875]
    """
    smooth = 2.0 * math.pi * machine.length / math.log(machine.bore / (machine.bore - 2.0 * machine.gap))
    winding, rotor = gap_shares(
        machine.opening, machine.pitch, machine.gap, machine.depth, machine.permittivity
    )
    slots = machine.slots * machine.length * machine.liner_width / machine.liner
    return MachineCapacitances(
        EPSILON_0 * smooth * winding,
        EPSILON_0 * smooth * (rotor - winding),
        EPSILON_0 * machine.liner_permittivity * slots,
    )


def gap_shares(
    opening: float, pitch: float, gap: float, depth: float, permittivity: float
) -> tuple[float, float]:
    """Capacitances of a slotted air gap, as parts of the capacitance of a smooth gap.

    ``opening`` and ``pitch``, width of the slots and distance between them [m]; ``gap`` [m]; ``depth``, depth
    of the copper below the teeth [m]. Returns ``winding``, capacitance between rotor and winding; ``rotor``,
    capacitance between the rotor and all that it faces; one over Carter's coefficient for deep slots.

    Examples
    --------
    Slots that are half as wide as their pitch, next to a narrow gap: little more than the teeth count.

    >>> winding, rotor = gap_shares(1.0, 2.0, 0.01, 5.0, 1.0)
    >>> round(winding, 4), round(rotor, 2)
    (0.0, 0.53)
    """
    modes = (2.0 * np.arange(_MODES) + 1.0) * (math.pi / opening)
    count = math.ceil(_WAVES * _MODES * pitch / opening)
    waves = np.arange(count + 1) * (2.0 * math.pi / pitch)
    common = _overlaps(waves, modes, opening)
    # Charge on the opening for each wave of its potential; the mean is a plate's.
    stiff = np.empty(count + 1)
    stiff[0], stiff[1:] = 1.0 / gap, 2.0 * waves[1:] / np.tanh(np.minimum(waves[1:] * gap, 300.0))
    below = (common.T * (stiff / pitch)) @ common
    deep = np.minimum(modes * depth, 300.0)
    above = np.diag(0.5 * opening * permittivity * modes / np.tanh(deep))
    copper = (4.0 / opening) * np.where(np.arange(_MODES) % 2, -1.0, 1.0) / np.sinh(deep)
    charges = np.stack([0.5 * opening * permittivity * copper, common[0] / gap], axis=1)
    by_copper, by_rotor = np.linalg.solve(below + above, charges).T
    return float(by_copper @ common[0]) / pitch, 1.0 - float(by_rotor @ common[0]) / pitch


def _overlaps(waves: np.ndarray, modes: np.ndarray, opening: float) -> np.ndarray:
    """Integrals of each wave times each mode over the opening, shape (waves, modes)."""
    half = 0.5 * opening
    plus, minus = waves[:, None] + modes, waves[:, None] - modes
    # numpy's sinc(x) is sin(pi x)/(pi x).
    overlaps: np.ndarray = half * (np.sinc(plus * half / math.pi) + np.sinc(minus * half / math.pi))
    return overlaps


# Change of the offset of a gap over the smallest film thickness at which it fits.
_SETTLED = 1e-12


def charge_density(gap: ArrayLike, tilt: ArrayLike, far: ArrayLike, near: ArrayLike) -> Array:
    """Charge density on the near one of two conducting surfaces, divided by eps0 eps V.

    ``gap``, distance delta from a point of the near surface along the normal of the far surface [m],
    shape (...); ``tilt``, angle beta between this normal and the normal of the near surface at the point,
    from 0 to below pi [rad], shape (...); ``far`` and ``near``, sum of the two principal curvatures of the
    far and of the near surface [1/m], shape (...). Returns charge density over eps0 eps V [1/m], shape (...).

    Examples
    --------
    For concentric spheres of 10 and 10.1 mm, the exact value on the outer one is (r/(r + h))/h. The formula
    agrees with it up to terms of (h/r)^2:

    >>> exact = 10e-3 / 10.1e-3 / 0.1e-3
    >>> abs(float(charge_density(1e-4, 0.0, 2 / 10e-3, 2 / 10.1e-3)) / exact - 1.0) < 1e-4
    True
    """
    delta, beta, outer, inner = (np.asarray(values, dtype=float) for values in (gap, tilt, far, near))
    density: Array = np.sinc(beta / np.pi) / delta - outer / 6.0 - inner / 3.0
    return density


def stretched(start: ArrayLike, end: ArrayLike, scale: ArrayLike, nodes: int) -> tuple[Array, Array]:
    """Quadrature nodes and weights from ``start`` to ``end`` for a function similar to 1/(scale^2 + x^2).

    Gauss-Legendre quadrature in t, with x = scale sinh(t). The poles at x = +- i scale are then at a distance
    of pi/2 from the path of integration, however small the scale is. The length of the path grows only with
    the logarithm of the end over the scale.

    ``start``, ``end`` and ``scale``, ends of the integral, and distance over which the function changes, in
    the unit of x. Returns nodes and weights, in the unit of x, shape (..., nodes).

    Examples
    --------
    A narrow peak with wide tails, whose integral is atan(1e6):

    >>> x, weights = stretched(0.0, 1.0, 1e-6, 40)
    >>> bool(np.isclose(1e-6 * np.sum(weights / (1e-12 + x**2)), np.arctan(1e6), rtol=1e-10))
    True
    """
    points, weights = gauss_legendre(nodes)
    scale = np.asarray(scale, dtype=float)[..., np.newaxis]
    first, last = (np.arcsinh(np.asarray(at, dtype=float)[..., np.newaxis] / scale) for at in (start, end))
    length = last - first
    # scale sinh and cosh by one exponential. If sinh cancels, x is small next to the scale.
    rises = np.exp(first + length * (0.5 * (points + 1.0)))
    rises *= 0.5 * scale
    falls = np.divide(0.25 * np.square(scale), rises)
    x = rises - falls
    rises += falls
    rises *= length * (0.5 * weights)
    return x, rises


def matched_offset(
    missing: Callable[[Array], Array], thickness: Array, *, start: Numbers = 0.0
) -> tuple[Array, Array]:
    """Offset of a gap with which it continues a film along the edge of the film's domain.

    With this offset the error of 1/h adds up to zero over the edge. The gap need not fit at every point.
    Several films are matched at once.

    ``missing``, function that gives, for offsets of shape (..., 1) [m], the film thickness less the gap at
    each point of the edge, shape (..., n) [m]; ``thickness``, film thickness at the points [m],
    shape (..., n); ``start``, first guess of the offset [m], shape (...). Returns ``offset``, offset [m],
    shape (...); ``mismatch``, largest difference between film thickness and gap over the film thickness,
    dimensionless, shape (...).

    Examples
    --------
    A gap that is 1 um too small at one point and 3 um too small at another of the same film thickness:

    >>> film, gap = np.array([5e-6, 5e-6]), np.array([4e-6, 2e-6])
    >>> offset, mismatch = matched_offset(lambda offset: film - gap - offset, film)
    >>> round(float(offset) * 1e6, 3), round(float(mismatch), 3)
    (2.0, 0.2)
    """
    weights = thickness**-2.0 / np.sum(thickness**-2.0, axis=-1, keepdims=True)
    enough = _SETTLED * np.min(thickness, axis=-1)
    step = before = np.zeros(thickness.shape[:-1])
    offset = step + start
    for _ in range(12):
        left = missing(offset[..., np.newaxis])
        error = np.sum(weights * left, axis=-1)
        settled = np.abs(error) <= enough
        if np.all(settled):
            break
        # Secant method. The gap changes with the offset by the cosine of an angle that is small over the
        # film's domain, so that the first step is nearly right.
        slope = np.divide(error - before, step, out=np.full(step.shape, -1.0), where=step != 0.0)
        before, step = error, np.where(settled, 0.0, -error / slope)
        offset = offset + step
    return offset, np.max(np.abs(left) / thickness, axis=-1)
