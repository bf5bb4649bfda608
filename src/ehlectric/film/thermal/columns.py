"""Heat balance of the columns of the film as small linear systems, one for each node of the grid.

In mapped coordinates zeta = z/h, with the filling theta of a cavitated gap,

    theta h rho c (u T_x + v T_y) - c (q_x,x + q_y,y) T_zeta = theta/h (k T_zeta)_zeta + theta h S,
    q(zeta) = theta h Int_0^zeta rho u,      S = tau_x u_z + tau_y v_z - (T/rho) (d rho/dT) (u p_x + v p_y)

The convection conserves mass, and needs no velocity across the film. Across the film the balance is a weak
form on Gauss-Lobatto nodes, so that the sum of a column is its balance of heat with both surfaces. Along x
the convection is an upstream difference of second order where the oil flows forward and of first order where
it flows back; across the contact it is of first order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.sheared.profile import Across
from ehlectric.film.thermal.across import conduction, derivative


@dataclass(frozen=True, eq=False)
class Stream:
    """Flow and properties of the oil in all columns, SI units.

    Arrays have the shape (nz, nx, ny), or (nx, ny) for quantities of a node. A symmetric contact has its
    line of symmetry at the first line.

    Attributes
    ----------
    across : Across
        Nodes across the film.
    dx, dy : float
        Spacings of the grid [m]; ``dy`` is zero for a line contact.
    symmetric : bool
        Whether the grid covers only the half y >= 0.
    thickness, filling : ndarray, shape (nx, ny)
        Film thickness h [m], and the share theta of it that oil fills.
    u, v : ndarray
        Velocities along and across entrainment [m/s].
    density, heat_capacity, conductivity : ndarray
        Density [kg/m^3], volumetric heat capacity rho c [J/(m^3 K)] and thermal conductivity [W/(m K)].
    heating, heating_slope : ndarray
        Shear heating [W/m^3], and its derivative by temperature at a fixed shear rate [W/(m^3 K)].
    compression : ndarray
        -(1/rho) (d rho/dT) (u p_x + v p_y) [W/(m^3 K)]; times T it is the heating by compression.
    """

    across: Across
    dx: float
    dy: float
    symmetric: bool
    thickness: Array
    filling: Array
    u: Array
    v: Array
    density: Array
    heat_capacity: Array
    conductivity: Array
    heating: Array
    heating_slope: Array
    compression: Array

    @property
    def mass_divergence(self) -> Array:
        """Divergence of the mass flow between surface a and each node, (nz, nx, ny) [kg/(m^2 s)]."""
        carried = self.filling * self.thickness * self.density
        total = np.gradient(np.tensordot(self.across.cumulative, carried * self.u, axes=1), self.dx, axis=1)
        if self.dy:
            flow = np.tensordot(self.across.cumulative, carried * self.v, axes=1)
            if self.symmetric:
                mirrored = np.concatenate([-flow[..., 1:2], flow], axis=2)
                total += np.gradient(mirrored, self.dy, axis=2)[..., 1:]
            else:
                total += np.gradient(flow, self.dy, axis=2)
        # No oil passes surface b; the discrete balance of mass at a node is another one than here.
        fraction = self.across.zeta[:, np.newaxis, np.newaxis]
        return np.asarray(total - fraction * total[-1])


@dataclass(frozen=True, eq=False)
class HeatColumns:
    """Linear systems A_i T_i = r_i + b_i T_(i-1) + bb_i T_(i-2) + f_i T_(i+1) of the columns of a film.

    Attributes
    ----------
    matrix : ndarray, shape (nx, ny, nz, nz)
        Matrix A without the heat that flows into the bodies [W/(m^2 K)].
    right : ndarray, shape (nx, ny, nz)
        Sources [W/m^2].
    before, second, after : ndarray, shape (nx, ny, nz)
        Factors b, bb and f of the columns upstream and downstream.
    from_left, from_right : ndarray, shape (nx, ny, nz)
        Factors of the columns at smaller and at larger y.
    """

    matrix: Array
    right: Array
    before: Array
    second: Array
    after: Array
    from_left: Array
    from_right: Array

    @classmethod
    def of(cls, stream: Stream, temperature: Array) -> HeatColumns:
        """Columns for a flow, linearised about a temperature (nz, nx, ny) [K].

        Shear heating is linearised at a fixed shear rate. Cooling by expansion is implicit; heating by
        compression is explicit.
        """
        across, filled = stream.across, stream.filling * stream.thickness
        volume = across.weights[:, np.newaxis, np.newaxis] * filled
        carried = volume * stream.heat_capacity
        forward = carried * np.maximum(stream.u, 0.0) / stream.dx
        back = carried * np.maximum(-stream.u, 0.0) / stream.dx
        cooling = np.minimum(stream.compression, 0.0)
        warming = np.maximum(stream.compression, 0.0)
        diagonal = 1.5 * forward + back - volume * (stream.heating_slope + cooling)
        # The first two columns have the inlet before them, so that the sum over all columns is a balance.
        before, second = 2.0 * forward, -0.5 * forward
        left = right = np.zeros_like(forward)
        if stream.dy:
            left = carried * np.maximum(stream.v, 0.0) / stream.dy
            right = carried * np.maximum(-stream.v, 0.0) / stream.dy
            diagonal += left + right
        source = volume * (stream.heating - stream.heating_slope * temperature + warming * temperature)
        upward = stream.mass_divergence * stream.heat_capacity / stream.density
        # In the wide gap far upstream the nodes do not resolve the layers between forward and reverse flow.
        # Conduction that brings the Peclet number of a cell down to two keeps the temperature there bounded.
        cell = np.gradient(across.zeta)[:, np.newaxis, np.newaxis]
        conducted = stream.filling / stream.thickness * stream.conductivity
        matrix = conduction(across, np.maximum(conducted, 0.5 * np.abs(upward) * cell))
        upward *= across.weights[:, np.newaxis, np.newaxis]
        matrix -= _last(upward)[..., np.newaxis] * derivative(across.zeta.size - 1)
        index = np.arange(across.zeta.size)
        matrix[..., index, index] += _last(diagonal)
        parts = (source, before, second, back, left, right)
        return cls(matrix, *(_last(part) for part in parts))


def _last(values: Array) -> Array:
    """Values (nz, nx, ny) with the axis across the film last."""
    return np.ascontiguousarray(np.moveaxis(values, 0, -1))
