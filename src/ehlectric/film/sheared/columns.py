"""Stress, shear rate and speed of the oil across the film, in the columns over the nodes of a grid."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.sheared.column import middle_stress
from ehlectric.film.sheared.even import EvenStress
from ehlectric.film.sheared.laws import Rheology
from ehlectric.film.sheared.plane import middle_stresses
from ehlectric.film.sheared.profile import Across, Quadrature, integrals, over_columns, to_points


@dataclass(frozen=True)
class Columns:
    """Stress, shear rate and speed across the film at the nodes of a grid.

    Attributes
    ----------
    across : Across
        Nodes zeta across the film, nz of them.
    stress : ndarray, shape (2, nz, nx, ny)
        Shear stress along x and y over the stress scale p_h b/R.
    rate : ndarray, shape (2, nz, nx, ny)
        Derivative of ``speed`` by zeta; the shear rate is rate u_m/h.
    speed : ndarray, shape (2, nz, nx, ny)
        Speed of the oil along x and y over the entrainment speed u_m.
    softening : ndarray, shape (nz, nx, ny)
        d ln(tau)/d ln(eta) at a fixed shear rate; one for a Newtonian fluid.
    viscosity, density : ndarray, shape (nz, nx, ny)
        eta/eta_0 and rho/rho_0.
    gradient : ndarray, shape (2, nx, ny)
        dP/dX and dP/dY.
    middle : ndarray, shape (2, nx, ny)
        Stress at zeta = 1/2 over the stress scale.
    """

    across: Across
    stress: Array
    rate: Array
    speed: Array
    softening: Array
    viscosity: Array
    density: Array
    gradient: Array
    middle: Array

    @property
    def heating(self) -> Array:
        """Heat of shear tau gamma_dot h/u_m over the stress scale, shape (nz, nx, ny)."""
        return np.asarray(np.sum(self.stress * self.rate, axis=0))


def columns_of(
    rheology: Rheology,
    across: Across,
    properties: tuple[Array, Array],
    *,
    gradient: Array,
    thickness: Array,
    scale: Array,
    slip: float,
    speed_unit: float,
) -> Columns:
    """Stress, shear rate and speed at the nodes across the film.

    Parameters
    ----------
    rheology : Rheology
        Shear-thinning law.
    across : Across
        Nodes across the film.
    properties : tuple of ndarray, each of shape (nz, nx, ny) or (1, nx, ny)
        eta/eta_0 and rho/rho_0 across the film.
    gradient : ndarray, shape (2, nx, ny)
        dP/dX and dP/dY.
    thickness : ndarray, shape (nx, ny)
        Film thickness H.
    scale : ndarray, shape (nx, ny)
        Characteristic stress of the law over p_h b/R.
    slip : float
        Slip of the surfaces (u_2 - u_1)/u_m times lambda/12.
    speed_unit : float
        Unit of the slip over u_m, 12/lambda.

    Returns
    -------
    Columns
        State of the columns. The speed is the integral of the rate over the Gauss points of the flow, so that
        it is that of the surface at zeta = 1.
    """
    viscosity, density = (np.broadcast_to(v, (across.zeta.size, *thickness.shape)) for v in properties)
    values, _ = to_points(across.zeta.size - 1)
    fluidity = np.exp(-np.tensordot(values, np.log(viscosity), axes=1))
    quadrature = Quadrature.gauss()
    reduced = thickness * gradient / scale
    sliding = slip / (thickness * scale)
    slips = np.stack([sliding, np.zeros_like(sliding)])
    even = None
    if rheology.law.even:
        even = EvenStress.of(rheology, fluidity, reduced, slips, quadrature)
        middle = even.middle
    elif reduced[1].any():
        middle = middle_stresses(rheology, fluidity, reduced, slips, quadrature)
    else:
        along = middle_stress(rheology, fluidity, reduced[0], sliding, quadrature)
        middle = np.stack([along, np.zeros_like(along)])

    def rates(offset: Array, fluidity: Array) -> tuple[Array, Array, Array]:
        stress = middle[:, np.newaxis] + over_columns(offset, thickness) * reduced[:, np.newaxis]
        size = speed_unit * thickness * scale * fluidity
        if even is not None:
            return stress, size * even.factor * stress, np.broadcast_to(even.softening, size.shape)
        squared = np.sum(stress**2, axis=0)
        factor, slope = rheology.law.factor(squared, rheology.constants)
        return stress, size * factor * stress, factor / (factor + 2.0 * slope * squared)

    stress, rate, softening = rates(across.zeta - 0.5, 1.0 / viscosity)
    at_points = rates(quadrature.offset, fluidity)[1]
    moved = np.moveaxis(np.tensordot(_up_to(across.zeta.size - 1), at_points, axes=(1, 1)), 0, 1)
    start = np.zeros((2, 1, 1, 1))
    start[0] = 1.0 - 0.5 * slip * speed_unit
    return Columns(
        across=across,
        stress=scale * stress,
        rate=rate,
        speed=start + moved,
        softening=softening,
        viscosity=viscosity,
        density=density,
        gradient=gradient,
        middle=scale * middle,
    )


@cache
def _up_to(degree: int) -> Array:
    """Integrals from 0 to each node of ``Across.of(degree)`` from values at the Gauss points, (nz, nq)."""
    return integrals(Quadrature.gauss().offset + 0.5, Across.of(degree).zeta)
