"""Energy equation of the film: temperature across the film and on both surfaces, for a film whose pressure
is given.

The heat balance of each column across the film is a small linear system. In mapped coordinates zeta = z/h,
with the filling theta of a cavitated gap, it is

    theta h rho c (u T_x + v T_y) - c (q_x,x + q_y,y) T_zeta = theta/h (k T_zeta)_zeta + theta h S,
    q(zeta) = theta h Int_0^zeta rho u,      S = tau_x u_z + tau_y v_z - (T/rho) (d rho/dT) (u p_x + v p_y)

The convection conserves mass, and needs no velocity across the film. Across the film the balance is a weak
form on Gauss-Lobatto nodes, so that the sum of a column is its balance of heat with both surfaces. The
convection is the difference of the flows through the faces between the columns. A face carries the
temperature of the columns upstream of it: along x a line through two of them where the oil flows forward, one
of them where it flows back; across the contact one of them. The flow through a face is the mean flow of its
two columns, with a parabola that brings its sum to the flow of the Reynolds equation. Only this flow
conserves the mass of each column, and only with it the heat of the film is in balance where the film changes
from node to node.

One march along x solves the columns from the inlet to the outlet. The fluxes into the bodies at the column
itself are implicit, the fluxes at the columns before it enter by the history of the moving surfaces. In the
reverse flow of the inlet the columns depend on the columns downstream; there one banded system of all columns
is exact. Three parts are taken from the last iterate: the history of the surfaces in the reverse flow, the
heat that a slow body conducts upstream, and the convection across the contact. The march is repeated for the
last two.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray
from ehlectric.film.across_film import Across, Properties
from ehlectric.film.hot_oil import Body, HotOil
from ehlectric.film.mesh import Mesh, on_mesh, trapezoidal_weights
from ehlectric.film.shear_flow import Columns


def conduction(across: Across, conductivity: Array, flow: Array | None = None) -> Array:
    """Matrix (..., nz, nz) of conduction across the film, the integral of k T' phi' over zeta, less f T'.

    ``conductivity`` (nz, ...) is the thermal conductivity k at the nodes, ``flow`` (nz, ...) the factor f.
    The rows of the matrix sum to zero. It is symmetric without a flow.

    Examples
    --------
    A linear temperature conducts the same heat through both surfaces:

    >>> nodes = Across.of(4)
    >>> heat = conduction(nodes, np.full(5, 2.0)) @ nodes.zeta
    >>> bool(np.allclose(heat, [-2.0, 0.0, 0.0, 0.0, 2.0]))
    True
    """
    nz, shape = across.zeta.size, conductivity.shape[1:]
    values, products = [conductivity.reshape(nz, -1)], [across.conduction]
    if flow is not None:
        values, products = [*values, flow.reshape(nz, -1)], [*products, -across.convection]
    return np.asarray(np.concatenate(values).T @ np.concatenate(products)).reshape(*shape, nz, nz)


# Peclet number u b/(2 kappa) above which the fast limit replaces the exact solution: they differ by less than
# 1e-3 there, and the fast limit does not act upstream.
_FAST = 1000.0

# Least Peclet number. The temperature of a body at rest under a line contact has no steady state; it rises as
# the logarithm of time.
_SLOWEST = 0.01

# Influence upstream over that downstream above which a body counts as slow.
_SLOW = 0.02


@dataclass(frozen=True, eq=False)
class Surface:
    """Surface of a moving half-space on a uniform grid along its motion."""

    # Temperature of the surface without its fluxes: the temperature of the body far from the contact [K], or,
    # in a time step, what the past has left at each node, shape (nx, ny).
    bulk: Array | float
    # Temperature rise at 0, 1, ... cells behind a cell with unit flux [K m^2/W], shape (nx,).
    downstream: Array
    # Temperature rise at 0, 1, ... cells before a cell with unit flux; the first is zero, as the cell itself
    # belongs to ``downstream``, shape (nx,).
    upstream: Array

    @property
    def is_slow(self) -> bool:
        """Whether a flux heats much of the surface upstream of itself."""
        return float(self.upstream.sum()) > _SLOW * float(self.downstream.sum())

    def rise(self, flux: Array) -> Array:
        """Temperature rise (nx, ny) [K] by a flux (nx, ny) into the body [W/m^2]."""
        return np.asarray(self.downstream[0] * flux + self.rise_behind(flux) + self.rise_ahead(flux))

    def rise_behind(self, flux: Array) -> Array:
        """Part of the temperature rise (n, ny) [K] at the first n nodes by the flux further upstream."""
        nodes = len(flux)
        column = np.concatenate([[0.0], self.downstream[1:nodes]])
        return np.asarray(scipy.linalg.matmul_toeplitz((column, np.zeros(nodes)), flux))

    def rise_ahead(self, flux: Array) -> Array:
        """Part of the temperature rise (nx, ny) [K] by the flux further downstream."""
        if not self.upstream.any():
            return np.zeros_like(flux)
        if flux.shape[1] == 1:
            zeros = np.zeros(self.upstream.size)
            return np.asarray(scipy.linalg.matmul_toeplitz((zeros, self.upstream), flux))
        return self._ahead @ flux

    @cached_property
    def _ahead(self) -> Array:
        """Matrix (nx, nx) of ``rise_ahead``, which takes less time than transforms of all lines."""
        zeros = np.zeros(self.upstream.size)
        return np.asarray(scipy.linalg.toeplitz(zeros, self.upstream), dtype=np.float64)


def moving_surface(body: Body, speed: float, *, nodes: int, spacing: float, half_width: float) -> Surface:
    """Surface of a body that moves along x under a flux that is constant in each cell of a grid.

    ``speed`` [m/s] is not negative, ``spacing`` [m] is the length of a cell, and ``half_width`` [m] of the
    contact is the length of the Peclet number.

    H. S. Carslaw and J. C. Jaeger, Conduction of Heat in Solids, 2nd ed., Oxford 1959, sections 2.9 (fast
    limit) and 10.7: a line source on a half-space gives T = Q/(pi k) exp(xi) K0(abs(xi)), xi = u x/(2 kappa).
    The integral over a cell is in closed form, as d/dxi [xi exp(xi) (K0 + K1)] = exp(xi) K0.

    Examples
    --------
    Far downstream of the front the fast limit is 2 q sqrt(x/(pi rho c k u)), exactly at the nodes:

    >>> steel = Body(300.0, 46.0, 470.0, 7850.0)
    >>> surface = moving_surface(steel, 50.0, nodes=100, spacing=1e-5, half_width=1e-3)
    >>> x = 1e-5 * (np.arange(100) + 0.5)
    >>> exact = 2.0 * 1e8 * np.sqrt(x / (np.pi * 7850.0 * 470.0 * 46.0 * 50.0))
    >>> bool(np.allclose(surface.rise(np.full((100, 1), 1e8))[:, 0], exact))
    True
    """
    edges = spacing * (np.arange(nodes + 1, dtype=np.float64) - 0.5)
    per_length = speed / (2.0 * body.diffusivity)
    if per_length * half_width > _FAST:
        scale = np.sqrt(np.pi * body.density * body.heat_capacity * body.thermal_conductivity * speed)
        downstream = np.diff(2.0 * np.sqrt(np.maximum(edges, 0.0))) / scale
        return Surface(body.temperature, downstream, np.zeros(nodes))
    per_length = max(per_length, _SLOWEST / half_width)
    scale = np.pi * body.thermal_conductivity * per_length
    downstream = np.diff(_line_source(per_length * edges)) / scale
    upstream = np.diff(-_line_source(-per_length * edges)) / scale
    upstream[0] = 0.0
    return Surface(body.temperature, downstream, upstream)


def _line_source(xi: Array) -> Array:
    """Integral of exp(t) K0(abs(t)) from 0 to xi, of any sign."""
    size = np.abs(xi)
    near = np.where(size > 0.0, size, 1.0)
    k0, k1 = scipy.special.k0e(near), scipy.special.k1e(near)
    behind = near * (k0 + k1) - 1.0
    ahead = -(near * np.exp(-2.0 * near) * (k0 - k1) + 1.0)
    return np.where(size > 0.0, np.where(xi > 0.0, behind, ahead), 0.0)


# Smallest eigenvalue of the matrix of the cosines between differences, over the largest one.
_DEPENDENT = 1e-12


class Mixing:
    """Anderson acceleration: the next iterate from the last few iterates and their images.

    The next iterate is the combination of the last images whose change is smallest in a norm of least squares
    with the given weights (n,).

    D. G. Anderson, J. ACM 12 (1965) 547, doi:10.1145/321296.321305.

    Examples
    --------
    A linear map of two unknowns is solved after three images:

    >>> mixing, x = Mixing(depth=5), np.zeros(2)
    >>> for _ in range(4):
    ...     x = mixing(x, np.array([[0.5, 0.4], [-0.3, 0.9]]) @ x + 1.0)
    >>> bool(np.allclose(x, np.linalg.solve([[0.5, -0.4], [0.3, 0.1]], np.ones(2))))
    True
    """

    def __init__(self, depth: int = 5, weights: Array | float = 1.0) -> None:
        self._depth = depth
        self._weights = weights
        self._images: list[Array] = []
        self._changes: list[Array] = []

    def __call__(self, point: Array, image: Array) -> Array:
        """Next iterate from an iterate and its image, both (n,)."""
        change = image - point
        self._images.append(image)
        self._changes.append(change)
        del self._images[: -self._depth - 1], self._changes[: -self._depth - 1]
        if len(self._changes) == 1:
            return image
        differences = np.stack([change - other for other in self._changes[:-1]])
        differences *= self._weights
        # The differences shrink from iterate to iterate: they are compared by direction.
        lengths = np.maximum(np.linalg.norm(differences, axis=1), 1e-300)
        products = differences @ differences.T / np.outer(lengths, lengths)
        target = differences @ (self._weights * change) / lengths
        # Nearly dependent differences are skipped: they would combine far iterates with large factors.
        factors = np.linalg.lstsq(products, target, rcond=_DEPENDENT)[0] / lengths
        following = np.array(image)
        for factor, other in zip(factors, self._images[:-1], strict=True):
            following -= factor * (image - other)
        return following

    def forget(self) -> None:
        """Start anew from the next iterate."""
        self._images.clear()
        self._changes.clear()


# Flow of mass divided by the largest one of its column that is zero except for rounding.
_ROUNDING = 1e-12


@dataclass(frozen=True, eq=False)
class Earlier:
    """Oil at the instant before a time step."""

    temperature: Array  # [K], shape (nz, nx, ny)
    mass: Array  # mass theta rho h at the nodes across the film [kg/m^2], shape (nz, nx, ny)
    pressure: Array  # [Pa], shape (nx, ny)
    step: float  # time since then [s]


@dataclass(frozen=True, eq=False)
class Stream:
    """Flow and properties of the oil in all columns, SI units.

    Arrays have the shape (nz, nx, ny), or (nx, ny) for quantities of a node. A symmetric contact has its
    line of symmetry at the first line.
    """

    across: Across
    # dx and dy: spacings of the grid [m]; ``dy`` is zero for a line contact.
    dx: float
    dy: float
    symmetric: bool  # whether the grid covers only the half y >= 0
    # thickness and filling: film thickness h [m], and the share theta of it that oil fills, shape (nx, ny).
    thickness: Array
    filling: Array
    # u and v: velocities along and across entrainment [m/s].
    u: Array
    v: Array
    # density, heat_capacity and conductivity: density [kg/m^3], volumetric heat capacity rho c [J/(m^3 K)]
    # and thermal conductivity [W/(m K)].
    density: Array
    heat_capacity: Array
    conductivity: Array
    # heating and heating_slope: shear heating [W/m^3], and its derivative by temperature at a fixed shear
    # rate [W/(m^3 K)].
    heating: Array
    heating_slope: Array
    # -(1/rho) (d rho/dT) (u p_x + v p_y) [W/(m^3 K)]; times T it is the heating by compression.
    compression: Array
    compression_p: Array  # derivative of ``compression`` by the pressure at the same node [1/(s K)]
    expansion: Array  # -(1/rho) (d rho/dT) [1/K], zero where oil does not fill the gap
    # Heat of asperities that rub [W/m^2], half of which arises at each surface, shape (nx, ny).
    rubbed: Array | float = 0.0
    earlier: Earlier | None = None  # oil at the instant before; None of a stationary film
    # Mass flow through the faces between the nodes along x and across it [kg/(m s)], shapes (nx - 1, ny) and
    # (nx, ny - 1), NaN where it is not known; None where the mean flow of the nodes counts.
    through: tuple[Array, Array] | None = None

    @property
    def mass(self) -> Array:
        """Mass theta rho h of the oil at the nodes across the film [kg/m^2]."""
        return self.filling * self.thickness * self.density

    def in_time(self, earlier: Earlier, pressure: Array) -> Stream:
        """Flow of a time step with a pressure (nx, ny) [Pa] at its end; compression in time also heats."""
        rate = self.expansion * (pressure - earlier.pressure) / earlier.step
        by_pressure = self.compression_p + self.expansion / earlier.step
        compression = self.compression + rate
        return replace(self, compression=compression, compression_p=by_pressure, earlier=earlier)


@dataclass(frozen=True, eq=False)
class HeatColumns:
    """Linear systems A_i T_i = r_i + b_i T_(i-1) + bb_i T_(i-2) + f_i T_(i+1) of the columns of a film."""

    matrix: Array  # matrix A without the heat that flows into the bodies [W/(m^2 K)], shape (nx, ny, nz, nz)
    right: Array  # sources [W/m^2], shape (nx, ny, nz)
    # Derivative of the sources by the pressure at the node of the column [W/(m^2 Pa)], shape (nx, ny, nz).
    right_p: Array
    # before, second and after: factors b, bb and f of the columns upstream and downstream,
    # shape (nx, ny, nz).
    before: Array
    second: Array
    after: Array
    # from_left and from_right: factors of the columns at smaller and at larger y, shape (nx, ny, nz).
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
        source[[0, -1]] += 0.5 * stream.rubbed
        gained = flow.divergence
        if stream.earlier is not None:
            held = carried * stream.mass / stream.earlier.step
            diagonal, source = diagonal + held, source + held * stream.earlier.temperature
            gained = gained + (stream.mass - stream.earlier.mass) / stream.earlier.step
        upward = specific * np.tensordot(across.cumulative, gained, axes=1)
        # In the wide gap far upstream the nodes do not resolve the layers between forward and reverse flow.
        # Conduction that brings the Peclet number of a cell down to two keeps the temperature there bounded.
        # The flow in it is the larger one of the sums from both surfaces.
        cell = np.gradient(across.zeta)[:, np.newaxis, np.newaxis]
        conducted = stream.filling / stream.thickness * stream.conductivity
        larger = np.maximum(np.abs(upward), np.abs(upward - upward[-1]))
        conducted = np.maximum(conducted, 0.5 * larger * cell)
        # No oil passes surface b; the discrete balance of mass at a node is another one than here.
        upward -= across.zeta[:, np.newaxis, np.newaxis] * upward[-1]
        upward *= across.weights[:, np.newaxis, np.newaxis]
        matrix = conduction(across, conducted, upward)
        index = np.arange(across.zeta.size)
        matrix[..., index, index] += _last(diagonal)
        source_p = volume * stream.compression_p * temperature
        return cls(matrix, *(_last(part) for part in (source, source_p, *neighbours)))


@dataclass(frozen=True, eq=False)
class _Convection:
    """Mass that flows to each node from its neighbours, over the spacing, (nz, nx, ny) [kg/(m^2 s)].

    D(m T) - T D(m) with the difference D of the mass flow m through the faces: the factors of the neighbours,
    whose sum is the factor of the node itself, and the divergence D(m). The heat of the whole film is thereby
    in balance.
    """

    neighbours: tuple[Array, ...]  # of the columns i - 1, i - 2, i + 1 and of the lines j - 1 and j + 1
    divergence: Array

    @classmethod
    def of(cls, stream: Stream) -> _Convection:
        """Convection of a stream."""
        along, across = (None, None) if stream.through is None else stream.through
        forward, back = _parts(
            _through_faces(stream.across, stream.mass * stream.u, stream.filling, along) / stream.dx
        )
        # The columns upstream of the first one have the inlet temperature. The faces at both ends have the
        # flow of the faces next to them, and no oil enters through the last one.
        before, after = _with_ends(forward)
        back_before, ahead = _with_ends(back)
        ahead = np.concatenate([ahead[:, :-1], np.zeros_like(ahead[:, :1])], axis=1)
        divergence = after - before + back_before - ahead
        divergence[:, -1] = (after - before)[:, -1]
        left = right = np.zeros_like(before)
        if stream.dy:
            flow = (stream.mass * stream.v).swapaxes(1, 2)
            turned = None if across is None else across.T
            flow = _through_faces(stream.across, flow, stream.filling.T, turned) / stream.dy
            upward, down = (part.swapaxes(1, 2) for part in _parts(flow))
            first_up, first_down = (down, upward) if stream.symmetric else (upward, down)
            left = np.concatenate([first_up[..., :1], upward], axis=2)
            right = np.concatenate([down, down[..., -1:]], axis=2)
            out = np.concatenate([upward, upward[..., -1:]], axis=2)
            back_out = np.concatenate([first_down[..., :1], down], axis=2)
            divergence += out - left + back_out - right
        return cls((1.5 * before + 0.5 * after, -0.5 * before, ahead, left, right), divergence)


def _with_ends(faces: Array) -> tuple[Array, Array]:
    """Flow through the faces before and behind each node, from the flow (nz, nx - 1, ny) between them."""
    before = np.concatenate([faces[:, :1], faces], axis=1)
    return before, np.concatenate([faces, faces[:, -1:]], axis=1)


def _through_faces(across: Across, flow: Array, filling: Array, total: Array | None) -> Array:
    """Mass flow (nz, nx - 1, ny) through the faces between the nodes along x, [kg/(m s)].

    ``flow`` (nz, nx, ny) is the mass flow at the nodes and ``filling`` (nx, ny) the part of their gap that
    oil fills.

    It is the mean flow of both nodes, or the flow of the node that is filled less: oil that fills a part of
    the gap passes the face to a full gap. A difference from the ``total`` of the film (nx - 1, ny) is the
    flow of another pressure gradient, and a parabola across the film.
    """
    share = 0.5 * (1.0 + np.sign(filling[1:] - filling[:-1]))
    flow = share * flow[:, :-1] + (1.0 - share) * flow[:, 1:]
    if total is None:
        return flow
    zeta, weights = (each[:, np.newaxis, np.newaxis] for each in (across.zeta, across.weights))
    missing = total - np.sum(weights * flow, axis=0)
    return np.asarray(flow + 6.0 * zeta * (1.0 - zeta) * np.where(np.isnan(missing), 0.0, missing))


def _parts(flow: Array) -> tuple[Array, Array]:
    """Parts of a flow towards larger and towards smaller positions, both not negative."""
    # At a surface at rest the flow is zero except for rounding, and rounding is no reverse flow.
    flow = np.where(np.abs(flow) > _ROUNDING * np.max(np.abs(flow), axis=0), flow, 0.0)
    return np.maximum(flow, 0.0), np.maximum(-flow, 0.0)


def _last(values: Array) -> Array:
    """Values (nz, nx, ny) with the axis across the film last."""
    return np.ascontiguousarray(np.moveaxis(values, 0, -1))


def stream_of(
    oil: HotOil,
    columns: Columns,
    temperature: Array,
    *,
    pressure: Array,
    thickness: Array,
    filled: Array,
    mesh: Mesh,
    length: float,
    pressure_scale: float,
    speed: float,
    stress: float,
    rubbing: tuple[Array | float, Array | float] = (1.0, 0.0),
    through: tuple[Array, Array] | None = None,
) -> Stream:
    """Flow and properties of the oil, SI units.

    ``temperature`` [K], shape (nz, nx, ny); ``pressure`` and ``thickness``, pressure [Pa] and film thickness
    [m], shape (nx, ny); ``filled``, share of the gap that oil fills, shape (nx, ny); ``length``,
    ``pressure_scale``, ``speed`` and ``stress``, half-width b [m], Hertz pressure [Pa], entrainment speed
    [m/s], and scale of the stresses [Pa]; ``rubbing``, share of the oil in the pressure of each node,
    which is sheared in this part of the node, and the heat of asperities that rub [W/m^2], both of shape
    (nx, ny); ``through``, mass flow through the faces, as in ``Stream``. Returns velocities, properties and
    sources of heat.
    """
    u, v = speed * columns.speed
    at = oil.at(temperature)
    viscosity, density = oil.log_viscosity(pressure, at), oil.density(pressure, at)
    heating = columns.heating * (stress * speed / thickness)
    heating_slope = np.minimum(0.0, heating * columns.softening * viscosity.by_temperature)
    oil_share, rubbed = rubbing
    heating, heating_slope = oil_share * heating, oil_share * heating_slope
    along = upstream_slope(pressure, u, mesh.dx * length)
    across = columns.gradient[1] * (pressure_scale / length)
    expansion = np.where(filled < 1.0, 0.0, -density.by_temperature / density.value)
    return Stream(
        across=columns.across,
        dx=mesh.dx * length,
        dy=0.0 if mesh.dy is None else mesh.dy * length,
        symmetric=mesh.symmetric,
        thickness=thickness,
        filling=filled,
        u=u,
        v=v,
        density=density.value,
        heat_capacity=oil.heat_capacity(pressure, at).value,
        conductivity=oil.thermal_conductivity(pressure, at).value,
        heating=heating,
        heating_slope=heating_slope,
        compression=expansion * (u * along + v * across),
        compression_p=expansion * np.abs(u) / (mesh.dx * length),
        expansion=expansion,
        rubbed=rubbed,
        through=through,
    )


def upstream_slope(pressure: Array, u: Array, dx: float) -> Array:
    """Slope of the pressure upstream of each node, along the path of the oil.

    Heat of compression from the node upstream to this one depends on no pressure further downstream. The
    difference is of first order: one of second order overshoots behind the pressure spike, where the oil
    cools by expansion within two nodes.

    ``pressure`` [Pa], shape (nx, ny); ``u``, velocity along x [m/s], shape (nz, nx, ny); ``dx`` [m]. Returns
    upstream difference [Pa/m], shape (nz, nx, ny).

    Examples
    --------
    >>> pressure = np.array([[0.0], [1.0], [4.0], [9.0]])
    >>> upstream_slope(pressure, np.array([1.0, -1.0]).reshape(2, 1, 1), 1.0)[:, 2, 0].tolist()
    [3.0, 5.0]
    """
    rises = np.diff(pressure, axis=0) / dx
    edge = np.zeros_like(pressure[:1])
    return np.where(u > 0.0, np.concatenate([edge, rises]), np.concatenate([rises, edge]))


# Largest number of marches, and the change of temperature [K] at which they stand.
_MARCHES, _STANDS = 25, 1e-3


@dataclass(frozen=True, eq=False)
class Heat:
    """Temperature of the film and heat flow into both bodies."""

    # Temperature [K] at the nodes across the film; the first and the last are the surfaces,
    # shape (nz, nx, ny).
    temperature: Array
    flux: Array  # heat flow into body a and body b [W/m^2], shape (2, nx, ny)
    # Derivative of the temperature by the pressure at the same node, by heat of compression [K/Pa];
    # zero in the columns with reverse flow and before them, shape (nz, nx, ny).
    by_pressure: Array

    @property
    def vector(self) -> Array:
        """Temperature and heat flow as one vector, for the acceleration of an iteration."""
        return np.concatenate([self.temperature.ravel(), self.flux.ravel()])

    def with_vector(self, vector: Array) -> Heat:
        """Heat with the temperature and the heat flow of a vector as ``vector`` returns it."""
        temperature, flux = np.split(vector, [self.temperature.size])
        return replace(
            self,
            temperature=temperature.reshape(self.temperature.shape),
            flux=flux.reshape(self.flux.shape),
        )


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
    """Temperature and heat flow into the bodies for a given flow; oil enters at ``inlet_temperature`` [K]."""
    march = _March.of(columns, surfaces)
    lagged = any(surface.is_slow for surface in surfaces) or bool(columns.from_left.any())
    now, mixing, first = last, Mixing(), 0.0
    for _ in range(marches if lagged else 1):
        new = march(now, inlet_temperature, symmetric=symmetric)
        change = float(np.max(np.abs(new.temperature - now.temperature)))
        first = max(first, change)
        if not change > max(_STANDS, enough * first):
            break
        now = now.with_vector(mixing(now.vector, new.vector))
    return replace(new, by_pressure=march.by_pressure)


def finite_heat(
    stream: Stream, surfaces: tuple[Surface, Surface], last: Heat, inlet_temperature: float
) -> Heat | None:
    """Temperature and heat flow into the bodies of a stream, from the values of the last turn between film
    and temperature; None where there is no finite solution.
    """
    try:
        new = solve_energy(
            HeatColumns.of(stream, last.temperature),
            surfaces,
            last,
            inlet_temperature=inlet_temperature,
            symmetric=stream.symmetric,
        )
    except np.linalg.LinAlgError:
        return None
    return new if np.all(np.isfinite(new.temperature)) else None


@dataclass(frozen=True, eq=False)
class _March:
    """Factorised columns: a banded system up to the end of the reverse flow, and inverses behind it.

    Behind the reverse flow the temperatures of a column follow from the two columns before it and from the
    rise of both surfaces by the fluxes before it.
    """

    columns: HeatColumns
    surfaces: tuple[Surface, Surface]
    entry: _Entry | None
    inverse: Array  # of the n columns behind the entry, (n, ny, nz, nz)

    @classmethod
    def of(cls, columns: HeatColumns, surfaces: tuple[Surface, Surface]) -> _March:
        matrix, resistances = columns.matrix.copy(), _resistances(surfaces)
        for row, resistance in zip((0, -1), resistances, strict=True):
            matrix[..., row, row] += 1.0 / resistance
        back = np.flatnonzero(np.any(columns.after[:-1], axis=(1, 2)))
        entry = _Entry.of(matrix, columns, int(back[-1]) + 2) if back.size else None
        behind = slice(entry.count if entry else 0, None)
        inverse: Array = np.asarray(np.linalg.inv(matrix[behind]), dtype=np.float64)
        return cls(columns, surfaces, entry, inverse)

    def __call__(self, last: Heat, inlet_temperature: float, *, symmetric: bool) -> Heat:
        columns, surfaces, resistances = self.columns, self.surfaces, _resistances(self.surfaces)
        nx, ny, nz = columns.right.shape
        old = np.moveaxis(last.temperature, 0, -1)
        right = columns.right + self._from_sides(old, inlet_temperature, symmetric=symmetric)
        # Surface temperatures (nx, ny, 2) without the fluxes at the column itself and, so far, before it.
        rest = np.stack([s.bulk + s.rise_ahead(q) for s, q in zip(surfaces, last.flux, strict=True)], axis=-1)
        # Temperatures of the columns, behind two columns of the inlet temperature.
        new = np.full((nx + 2, ny, nz), inlet_temperature)
        flux = last.flux.swapaxes(1, 2).copy()
        start = 0
        if self.entry is not None:
            start = self.entry.count
            before = [s.rise_behind(q[:start]) for s, q in zip(surfaces, last.flux, strict=True)]
            rest[:start] += np.stack(before, axis=-1)
            right[:start, :, :: nz - 1] += rest[:start] / resistances
            entering = self.entry(right[:start], inlet_temperature)
            new[2 : start + 2] = entering
            flux[..., :start] = ((entering[..., :: nz - 1] - rest[:start]) / resistances).transpose(2, 1, 0)
        tails = np.stack([surface.downstream[::-1, np.newaxis] for surface in surfaces])
        for i, inverse in enumerate(self.inverse, start):
            surface = rest[i] + (flux[..., :i] @ tails[:, nx - 1 - i : nx - 1])[..., 0].T
            sources = right[i] + columns.second[i] * new[i] + columns.before[i] * new[i + 1]
            sources[:, :: nz - 1] += surface / resistances
            column = np.matmul(inverse, sources[..., np.newaxis], out=new[i + 2, ..., np.newaxis])[..., 0]
            flux[..., i] = ((column[:, :: nz - 1] - surface) / resistances).T
        temperature = np.ascontiguousarray(np.moveaxis(new[2:], -1, 0))
        return replace(last, temperature=temperature, flux=np.ascontiguousarray(flux.swapaxes(1, 2)))

    @property
    def by_pressure(self) -> Array:
        """Derivative of the temperature (nz, nx, ny) by the pressure at the same node [K/Pa]."""
        response = np.zeros_like(self.columns.right_p)
        start = len(response) - len(self.inverse)
        response[start:] = (self.inverse @ self.columns.right_p[start:, ..., np.newaxis])[..., 0]
        return np.ascontiguousarray(np.moveaxis(response, -1, 0))

    def _from_sides(self, old: Array, inlet_temperature: float, *, symmetric: bool) -> Array | float:
        """Heat that the flow across the contact carries from the neighbouring lines of the last iterate."""
        if not self.columns.from_left.any() and not self.columns.from_right.any():
            return 0.0
        padded = np.pad(old, ((0, 0), (1, 1), (0, 0)), constant_values=inlet_temperature)
        if symmetric:
            padded[:, 0] = old[:, 1]
        return np.asarray(self.columns.from_left * padded[:, :-2] + self.columns.from_right * padded[:, 2:])


def _resistances(surfaces: tuple[Surface, Surface]) -> Array:
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
        factors, pivots, _ = scipy.linalg.lapack.dgbtrf(flat, lower, upper, overwrite_ab=1)
        return cls(columns, count, factors, pivots)

    def __call__(self, right: Array, inlet_temperature: float) -> Array:
        """Temperatures (count, ny, nz) for a right side with the fluxes of the columns before each."""
        right = right.copy()
        right[0] += (self.columns.before[0] + self.columns.second[0]) * inlet_temperature
        right[1] += self.columns.second[1] * inlet_temperature
        lines = right.swapaxes(0, 1)
        nz = right.shape[-1]
        temperature, _ = scipy.linalg.lapack.dgbtrs(self.factors, 2 * nz, nz, lines.reshape(-1), self.pivots)
        return np.asarray(temperature.reshape(lines.shape).swapaxes(0, 1))


@dataclass(frozen=True, eq=False)
class FrozenTemperature:
    """Temperature across the film as a ``Profile`` of its flow.

    The temperature belongs to a pressure p0. If the pressure changes, the temperature follows it by the
    heat of compression, T + T_p (p - p0). Without T_p, film and temperature converge slowly at the pressure
    spike, which heats the oil in passing. Viscosity ratio and density are linear in p - p0 as well: they are
    computed only once, and exact where film and temperature have converged.
    """

    across: Across
    mesh: Mesh
    heat: Heat  # temperature T at the pressure ``pressure``, and its derivative T_p
    pressure: Array  # pressure P0 over p_h, not below ambient, shape (nx, ny)
    oil: HotOil
    inlet_temperature: float  # temperature of the oil whose laws the fluid of the film problem has [K]
    pressure_scale: float  # Hertz pressure p_h [Pa]
    _on_meshes: dict[tuple[int, int, float], tuple[Properties, Array]] = field(
        default_factory=dict, init=False, repr=False
    )

    def at(self, pressure: Array) -> Heat:
        """Heat with the temperature at a pressure P (nx, ny) that is not below ambient."""
        change = self.pressure_scale * (pressure - self.pressure)
        return replace(self.heat, temperature=self.heat.temperature + self.heat.by_pressure * change)

    def heat_on(self, mesh: Mesh, pressure: Array) -> Heat:
        """Heat with the temperature at a pressure P (nx, ny) on another mesh, not below ambient."""
        heat = Heat(*(on_mesh(values, self.mesh, mesh) for values in vars(self.heat).values()))
        change = self.pressure_scale * (pressure - on_mesh(self.pressure, self.mesh, mesh))
        return replace(heat, temperature=heat.temperature + heat.by_pressure * change)

    @cached_property
    def properties(self) -> Properties:
        """Properties at the pressure P0, on the mesh of the temperature."""
        p = self.pressure_scale * self.pressure
        inlet = np.full((1, *p.shape), self.inlet_temperature)
        # The last row has the temperature of the oil that enters.
        at = self.oil.at(np.concatenate([self.heat.temperature, inlet]))
        viscosity, density = self.oil.log_viscosity(p, at), self.oil.density(p, at)
        cold = self.oil.density(np.zeros(1), np.full(1, self.inlet_temperature)).value[0]
        log_ratio_p = viscosity.by_pressure[:-1] - viscosity.by_pressure[-1]
        log_ratio_p += self.heat.by_pressure * viscosity.by_temperature[:-1]
        density_p = density.by_pressure[:-1] + self.heat.by_pressure * density.by_temperature[:-1]
        return Properties(
            log_ratio=viscosity.value[:-1] - viscosity.value[-1],
            log_ratio_p=self.pressure_scale * log_ratio_p,
            density=density.value[:-1] / cold,
            density_p=self.pressure_scale / cold * density_p,
        )

    def _on(self, mesh: Mesh) -> tuple[Properties, Array]:
        """Properties at P0, and P0, on another mesh of the same contact."""
        key = (*mesh.shape, float(mesh.x[0]))
        if key not in self._on_meshes:
            values = (on_mesh(each, self.mesh, mesh) for each in vars(self.properties).values())
            pressure = on_mesh(self.pressure, self.mesh, mesh)
            self._on_meshes[key] = Properties(*values), pressure
        return self._on_meshes[key]

    def __call__(self, pressure: Array, mesh: Mesh) -> Properties:
        """Properties at a pressure P (nx, ny) that is not below ambient."""
        known, of = self._on(mesh)
        change = pressure - of
        return Properties(
            log_ratio=known.log_ratio + known.log_ratio_p * change,
            log_ratio_p=known.log_ratio_p,
            density=known.density + known.density_p * change,
            density_p=known.density_p,
        )


def energy_imbalance(stream: Stream, heat: Heat, inlet_temperature: float) -> float:
    """Heat that neither the bodies nor the oil take up, over the heat that is made, or that flows from body
    to body where this is more.

    Heating and cooling by compression count with their absolute values. Oil enters at ``inlet_temperature``
    [K].

    The heat that the oil carries is the flow of c (T - T_inlet) through the edges of the grid, less what the
    change of c along the way takes up. Nothing here uses the discrete equations of the columns.
    """
    weights = stream.across.weights[:, np.newaxis, np.newaxis]
    filled = weights * stream.filling * stream.thickness
    along, lines = trapezoidal_weights(stream.u.shape[1], stream.dx), _lines(stream)
    area = along[:, np.newaxis] * lines
    compression = stream.compression * heat.temperature
    made = np.sum(filled * (stream.heating + compression), axis=0) + stream.rubbed
    size = np.sum(filled * (stream.heating + np.abs(compression)), axis=0) + stream.rubbed
    through_film = 0.5 * np.sum(np.abs(heat.flux), axis=0)
    rise = heat.temperature - inlet_temperature
    carried = filled * stream.heat_capacity
    # div(c m (T - T0)) with the mass flow m, less (T - T0) m grad c
    specific = stream.heat_capacity / stream.density
    through = np.sum(carried * stream.u * rise, axis=0)
    out = float(np.sum(lines * (through[-1] - through[0])))
    slope = np.gradient(specific, stream.dx, axis=1) * stream.u
    if stream.dy:
        slope += np.gradient(specific, stream.dy, axis=2) * stream.v
        sides = np.sum(carried * stream.v * rise, axis=0)
        left = 0.0 if stream.symmetric else float(along @ sides[:, 0])
        out += (2.0 if stream.symmetric else 1.0) * float(along @ sides[:, -1]) - left
    changed = np.sum(filled * stream.density * slope * rise, axis=0)
    into_bodies = heat.flux.sum(axis=0)
    left_over = float(np.sum(area * (made - into_bodies + changed))) - out
    return abs(left_over) / max(float(np.sum(area * size)), float(np.sum(area * through_film)), 1e-300)


def _lines(stream: Stream) -> Array:
    """Weights of the integral across the contact, with the half y < 0 of a symmetric one."""
    if not stream.dy:
        return np.ones(1)
    return trapezoidal_weights(stream.u.shape[2], (2.0 if stream.symmetric else 1.0) * stream.dy)
