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

# Flow of mass over the largest one of its column that is zero but for rounding.
_ROUNDING = 1e-12


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
    compression_p : ndarray
        Derivative of ``compression`` by the pressure at its own node [1/(s K)].
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
    compression_p: Array


@dataclass(frozen=True, eq=False)
class HeatColumns:
    """Linear systems A_i T_i = r_i + b_i T_(i-1) + bb_i T_(i-2) + f_i T_(i+1) of the columns of a film.

    Attributes
    ----------
    matrix : ndarray, shape (nx, ny, nz, nz)
        Matrix A without the heat that flows into the bodies [W/(m^2 K)].
    right : ndarray, shape (nx, ny, nz)
        Sources [W/m^2].
    right_p : ndarray, shape (nx, ny, nz)
        Derivative of the sources by the pressure at the node of the column [W/(m^2 Pa)].
    before, second, after : ndarray, shape (nx, ny, nz)
        Factors b, bb and f of the columns upstream and downstream.
    from_left, from_right : ndarray, shape (nx, ny, nz)
        Factors of the columns at smaller and at larger y.
    """

    matrix: Array
    right: Array
    right_p: Array
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
        specific = stream.heat_capacity / stream.density
        flow = _Convection.of(stream)
        carried = across.weights[:, np.newaxis, np.newaxis] * specific
        cooling = np.minimum(stream.compression, 0.0)
        warming = np.maximum(stream.compression, 0.0)
        neighbours = [carried * part for part in flow.neighbours]
        diagonal = sum(neighbours) - volume * (stream.heating_slope + cooling)
        source = volume * (stream.heating - stream.heating_slope * temperature + warming * temperature)
        upward = specific * np.tensordot(across.cumulative, flow.divergence, axes=1)
        # In the wide gap far upstream the nodes do not resolve the layers between forward and reverse flow.
        # Conduction that brings the Peclet number of a cell down to two keeps the temperature there bounded.
        # The flow in it is the larger one of the sums from both surfaces.
        cell = np.gradient(across.zeta)[:, np.newaxis, np.newaxis]
        conducted = stream.filling / stream.thickness * stream.conductivity
        larger = np.maximum(np.abs(upward), np.abs(upward - upward[-1]))
        matrix = conduction(across, np.maximum(conducted, 0.5 * larger * cell))
        # No oil passes surface b; the discrete balance of mass at a node is another one than here.
        upward -= across.zeta[:, np.newaxis, np.newaxis] * upward[-1]
        upward *= across.weights[:, np.newaxis, np.newaxis]
        matrix -= _last(upward)[..., np.newaxis] * derivative(across.zeta.size - 1)
        index = np.arange(across.zeta.size)
        matrix[..., index, index] += _last(diagonal)
        source_p = volume * stream.compression_p * temperature
        return cls(matrix, *(_last(part) for part in (source, source_p, *neighbours)))


@dataclass(frozen=True, eq=False)
class _Convection:
    """Mass that flows to each node from its neighbours, over the spacing, (nz, nx, ny) [kg/(m^2 s)].

    D(m T) - T D(m) with the upstream difference D of the mass flow m: the factors of the neighbours, whose
    sum is that of the node itself, and the divergence D(m). The heat of the whole film is thereby in balance.
    """

    neighbours: tuple[Array, ...]  # of the columns i - 1, i - 2, i + 1 and of the lines j - 1 and j + 1
    divergence: Array

    @classmethod
    def of(cls, stream: Stream) -> _Convection:
        """Convection of a stream."""
        mass = stream.filling * stream.thickness * stream.density
        forward, back = _parts(mass * stream.u / stream.dx)
        # The columns upstream of the first one have the inlet temperature, and the flow of the first column.
        one = np.concatenate([forward[:, :1], forward[:, :-1]], axis=1)
        two = np.concatenate([one[:, :1], one[:, :-1]], axis=1)
        ahead = np.concatenate([back[:, 1:], np.zeros_like(back[:, :1])], axis=1)
        divergence = 1.5 * forward - 2.0 * one + 0.5 * two + back - ahead
        divergence[:, -1] = (1.5 * forward - 2.0 * one + 0.5 * two)[:, -1]
        left = right = np.zeros_like(forward)
        if stream.dy:
            upward, down = _parts(mass * stream.v / stream.dy)
            first = down[..., 1:2] if stream.symmetric else upward[..., :1]
            left = np.concatenate([first, upward[..., :-1]], axis=2)
            right = np.concatenate([down[..., 1:], down[..., -1:]], axis=2)
            divergence += upward - left + down - right
        return cls((2.0 * one, -0.5 * two, ahead, left, right), divergence)


def _parts(flow: Array) -> tuple[Array, Array]:
    """Parts of a flow towards larger and towards smaller positions, both not negative."""
    # At a surface at rest the flow is zero but for rounding, and rounding is no reverse flow.
    flow = np.where(np.abs(flow) > _ROUNDING * np.max(np.abs(flow), axis=0), flow, 0.0)
    return np.maximum(flow, 0.0), np.maximum(-flow, 0.0)


def _last(values: Array) -> Array:
    """Values (nz, nx, ny) with the axis across the film last."""
    return np.ascontiguousarray(np.moveaxis(values, 0, -1))
