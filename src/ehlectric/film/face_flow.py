"""Flow of the lubricant through the faces between neighbouring grid nodes, with its derivatives.

The Reynolds equation balances the pressure-driven mass flux through the faces around a node with the wedge
term. For a Newtonian fluid, dimensionless,

    F = eps dP/dX,   eps = rho H^3/(eta lambda)

along entrainment; across entrainment dP/dY replaces dP/dX. F is the mass flux towards smaller X or Y, as oil
flows from high to low pressure. A face lies half-way between two nodes. Quantities that are known at nodes
enter as a mean of the two nodes, and this mean is taken in this module only.

Another relation between flux and pressure gradient is one more function in ``FLOWS``, or the value of
``Fluid.flow``, as for a shear-thinning fluid (``film.shear_flow``).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.mesh import Mesh, on_mesh

# Difference of ln eta below which two nodes count as alike: the series of the mean is then exact to rounding.
_ALIKE = 1e-4

# Law of the lubricant: dimensionless pressure -> (value, derivative by pressure).
FluidLaw: TypeAlias = Callable[[Array], tuple[Array, Array]]


@dataclass(frozen=True)
class Fluid:
    """Lubricant in the Reynolds equation, over dimensionless pressure P = p/p_h."""

    density: FluidLaw  # density law: P -> (rho/rho_0, its derivative by P)
    log_viscosity: FluidLaw  # viscosity law: P -> (ln(eta/eta_0), its derivative by P)
    velocity_parameter: float  # velocity parameter lambda = 6 eta_0 u_s R^2/(b^3 p_h) with u_s = u_1 + u_2
    ambient_pressure: float  # ambient pressure over p_h
    # Relation between flux, pressure and film thickness: a key of ``FLOWS``, or the law itself, a function of
    # fluid, P (nx, ny), H (nx, ny) and mesh that returns a ``Flow``
    flow: str | FlowLaw = "newtonian"

    @property
    def ambient_density(self) -> float:
        """Density ratio of the oil that is supplied, at ambient pressure and inlet temperature."""
        return float(self.density(np.full(1, self.ambient_pressure))[0][0])


@dataclass(frozen=True)
class Coefficients:
    """Density ratio and mobility at the nodes with their derivatives, each of shape (nx, ny)."""

    density: Array
    density_p: Array
    # log_viscosity and log_viscosity_p: ln(eta/eta_0) and its derivative by P.
    log_viscosity: Array
    log_viscosity_p: Array
    fluidity: Array
    # eps, eps_p and eps_h: mobility eps = rho H^3/(eta lambda) and its derivatives by P and by H.
    eps: Array
    eps_p: Array
    eps_h: Array


@dataclass(frozen=True)
class Sides:
    """Derivatives of the flux through each face by a quantity at its two nodes, each of shape (n - 1, m)."""

    # before and after: derivative by the quantity at the node before the face, and at the node after it.
    before: Array
    after: Array

    def outflow(self) -> tuple[Array, Array, Array]:
        """Derivatives of -dF/dX at the inner nodes, each of shape (n - 2, m).

        They are the derivatives by the quantity at the node before, at the node itself and at the node after.
        """
        return self.before[:-1], self.after[:-1] - self.before[1:], -self.after[1:]


@dataclass(frozen=True)
class FaceFlow:
    """Pressure-driven flow through the n - 1 faces between n nodes along one axis.

    The first axis of the arrays is the direction of the flow. All fluxes are divided by the grid spacing, so
    that the difference of the fluxes of two neighbouring faces approximates the derivative of F.
    """

    flux: Array  # F over the grid spacing, positive where the pressure rises with X or Y, shape (n - 1, m)
    # Derivative of the flux by the pressure difference of the two nodes, with the properties of the lubricant
    # and the film thickness fixed, shape (n - 1, m).
    conductance: Array
    # Derivatives of the flux by P of the two nodes through the properties of the lubricant, with the pressure
    # difference fixed.
    by_properties: Sides
    by_gap: Sides  # derivatives of the flux by H of the two nodes
    # Derivative of the flux by the gradient of P along the other axis, the mean of the two nodes,
    # shape (n - 1, m); None where the flux does not depend on it.
    by_lateral: Array | None = None
    # Part of the flux that the slip of the surfaces drives without any gradient of P, as hot oil on one side
    # lets the rest move with the other side: minus this mass flow over the spacing. Its derivative by H of
    # each of the two nodes. Both have the shape (n - 1, m).
    drift: Array | float = 0.0
    drift_by_gap: Array | float = 0.0

    def without_drift(self, where: Mask) -> FaceFlow:
        """Flow without the drift through the faces of a mask (n - 1, m)."""
        if isinstance(self.drift, float):
            return self
        drift, of_gap = np.where(where, self.drift, 0.0), np.where(where, self.drift_by_gap, 0.0)
        return replace(
            self,
            flux=self.flux - drift,
            by_gap=Sides(self.by_gap.before - of_gap, self.by_gap.after - of_gap),
            drift=self.drift - drift,
            drift_by_gap=self.drift_by_gap - of_gap,
        )

    def divergence(self) -> Array:
        """Divergence dF/dX at the inner nodes: difference of the fluxes on both sides, shape (n - 2, m)."""
        return np.diff(self.flux, axis=0)

    def weight(self) -> Array:
        """Sum of the conductances of the two faces of the inner nodes, shape (n - 2, m)."""
        return self.conductance[1:] + self.conductance[:-1]

    def by_pressure(self) -> tuple[Array, Array, Array]:
        """Derivatives of -dF/dX at the inner nodes by P, each of shape (n - 2, m).

        They are the derivatives by P of the node before, of the node itself and of the node after.
        """
        faces = self.conductance
        return Sides(self.by_properties.before - faces, self.by_properties.after + faces).outflow()


@dataclass(frozen=True)
class Flow:
    """Flow of the lubricant at one state of the film."""

    coefficients: Coefficients  # density and mobility at the nodes
    along: FaceFlow  # pressure-driven flow along entrainment, with arrays (nx - 1, ny)
    # pressure-driven flow across entrainment, with arrays (lines - 1, nx); None for a line contact.
    across: FaceFlow | None

    def undrifted(self, cavitated: Mask) -> Flow:
        """Flow without the drift through the faces behind cavitated nodes, a mask (nx, ny).

        The drift at a face is the drift in a gap that oil fills. Oil that fills a part of the gap drifts
        less: the mass of a cavitated node counts as what flows through the face behind it, with the drift in
        it.
        """
        return replace(self, along=self.along.without_drift(cavitated[:-1]))

    def carried(self, thickness: Array, dx: float) -> Array:
        """Mass that the surfaces carry out of each node of a full gap H (nx, ny), rho H and its drift."""
        full: Array = self.coefficients.density * thickness
        drift = self.along.drift
        if isinstance(drift, float):
            return full
        return full - dx * np.concatenate([drift, drift[-1:]])


FlowLaw: TypeAlias = Callable[[Fluid, Array, Array, Mesh], Flow]


@dataclass(frozen=True, eq=False)
class Undrifted:
    """Flow law without the drift behind nodes that are cavitated; see ``Flow.undrifted``."""

    law: FlowLaw
    mesh: Mesh
    cavitated: Mask  # nodes of ``mesh``, shape (nx, ny)

    def __call__(self, fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Flow:
        """Flow on any mesh of the same contact."""
        part = on_mesh(self.cavitated.astype(float), self.mesh, mesh)
        return self.law(fluid, pressure, thickness, mesh).undrifted(part > 0.5)


# Flow along the first axis, from quantities at the nodes (n, m) and the spacing.
FaceLaw: TypeAlias = Callable[..., FaceFlow]


def flow(fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Flow:
    """Flow of the lubricant through all faces of a grid, after the law that the fluid names. ``pressure`` and
    ``thickness``, pressure P and film thickness H, dimensionless, H > 0, shape (nx, ny). Returns fluxes,
    conductances and derivatives. Raises KeyError if ``FLOWS`` has no law of this name.

    Examples
    --------
    Between parallel surfaces a pressure that rises by 1 over dX = 0.5 drives the flux eps dP/dX^2:

    >>> constant = lambda p: (np.ones_like(p), np.zeros_like(p))
    >>> isoviscous = lambda p: (np.zeros_like(p), np.zeros_like(p))
    >>> fluid = Fluid(constant, isoviscous, velocity_parameter=0.1, ambient_pressure=0.0)
    >>> pressure = np.array([[0.0], [1.0], [2.0]])
    >>> flow(fluid, pressure, np.ones((3, 1)), Mesh.over(3, 0.0, 1.0)).along.flux[:, 0]
    array([40., 40.])
    """
    law = FLOWS[fluid.flow] if isinstance(fluid.flow, str) else fluid.flow
    return law(fluid, pressure, thickness, mesh)


def evaluate(fluid: Fluid, pressure: Array, thickness: Array) -> Coefficients:
    """Density and Newtonian mobility eps = rho H^3/(eta lambda) at the nodes, with their derivatives.
    ``pressure`` and ``thickness``, pressure P and film thickness H, dimensionless, H > 0, shape (nx, ny).
    Returns density ratio, mobility and derivatives, dimensionless, each of shape (nx, ny).
    """
    clipped = np.maximum(pressure, fluid.ambient_pressure)
    density, density_p = fluid.density(clipped)
    log_viscosity, log_viscosity_p = fluid.log_viscosity(clipped)
    fluidity = np.exp(-log_viscosity)
    eps = density * thickness**3 * fluidity / fluid.velocity_parameter
    return Coefficients(
        density=density,
        density_p=density_p,
        log_viscosity=log_viscosity,
        log_viscosity_p=log_viscosity_p,
        fluidity=fluidity,
        eps=eps,
        eps_p=eps * (density_p / density - log_viscosity_p),
        eps_h=3.0 * eps / thickness,
    )


def mean_mobility(fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Flow:
    """Poiseuille flow of a Newtonian fluid, F = eps dP/dX with the mean eps of the two nodes.

    It is the discretisation of Morris et al. (2022), doi:10.3390/lubricants10050087. Parameters and result
    agree with ``mean_fluidity``; the fluxes are also accurate to second order.
    """
    k = evaluate(fluid, pressure, thickness)
    nodes = (k.eps, k.eps_p, k.eps_h, pressure)
    return _along_and_across(k, nodes, mesh, _mean_mobility, partial(_mean_mobility, across=True))


def _mean_mobility(
    eps: Array, eps_p: Array, eps_h: Array, pressure: Array, *, spacing: float, across: bool = False
) -> FaceFlow:
    """Poiseuille flow along the first axis, from mobility, its derivatives and pressure at nodes (n, m)."""
    mean = 0.5 * (eps[1:] + eps[:-1])
    difference, square = np.diff(pressure, axis=0), spacing**2
    half = 0.5 * difference / square
    return FaceFlow(
        # The order of operations differs between the axes, to keep results reproducible to the last digit.
        flux=mean * (difference / square) if across else mean * difference / square,
        conductance=mean / square,
        by_properties=Sides(half * eps_p[:-1], half * eps_p[1:]),
        by_gap=Sides(half * eps_h[:-1], half * eps_h[1:]),
    )


def mean_fluidity(fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Flow:
    """Poiseuille flow of a Newtonian fluid whose viscosity varies exponentially between two nodes.

    F = (rho H^3 / lambda) f dP/dX with the means of rho and H of the two nodes, and the mean f of eta_0/eta
    over the pressure between them. For ln eta linear in P, f is the logarithmic mean.

    ``pressure`` and ``thickness``, pressure P and film thickness H, dimensionless, H > 0, shape (nx, ny).
    Returns fluxes, conductances and derivatives; the fluxes are accurate to second order.

    This is the mean of D. L. Scharfetter and H. K. Gummel, IEEE Trans. Electron Devices 16 (1969) 64,
    doi:10.1109/T-ED.1969.16566, for semiconductors. In the inlet of a thin film the viscosity changes by a
    large factor between nodes; the mean of the mobilities then lets too much oil flow back.

    Examples
    --------
    Barus' law, ln eta = 4 P, between plates: the flow equals the flow of the reduced pressure (1 - exp(-4
    P))/4.

    >>> constant = lambda p: (np.ones_like(p), np.zeros_like(p))
    >>> law = lambda p: (4.0 * p, 4.0 + 0.0 * p)
    >>> fluid = Fluid(constant, law, velocity_parameter=1.0, ambient_pressure=0.0)
    >>> pressure = np.array([[0.0], [1.0], [1.5]])
    >>> found = mean_fluidity(fluid, pressure, np.ones((3, 1)), Mesh.over(3, 0.0, 2.0)).along.flux
    >>> bool(np.allclose(found, np.diff((1.0 - np.exp(-4.0 * pressure)) / 4.0, axis=0)))
    True
    """
    k = evaluate(fluid, pressure, thickness)
    density = k.density / fluid.velocity_parameter
    density_p = k.density_p / fluid.velocity_parameter
    nodes = (k.log_viscosity, k.log_viscosity_p, k.fluidity, density, density_p, thickness, pressure)
    return _along_and_across(k, nodes, mesh, _mean_fluidity, _mean_fluidity)


def _mean_fluidity(
    log_viscosity: Array,
    log_viscosity_p: Array,
    fluidity: Array,
    density: Array,
    density_p: Array,
    thickness: Array,
    pressure: Array,
    *,
    spacing: float,
) -> FaceFlow:
    """Flow along the first axis from nodal values (n, m); ``density`` and its slope are over lambda."""
    mean, by_before, by_after = logarithmic_mean(log_viscosity, fluidity)
    gap = 0.5 * (thickness[1:] + thickness[:-1])
    cube = gap**3
    volume = mean * cube / spacing**2
    mass = 0.5 * (density[1:] + density[:-1])
    conductance = mass * volume
    difference = np.diff(pressure, axis=0)
    driven = mass * cube / spacing**2 * difference
    of_mass = 0.5 * volume * difference
    flux = conductance * difference
    of_gap = 1.5 * flux / gap
    return FaceFlow(
        flux=flux,
        conductance=conductance,
        by_properties=Sides(
            driven * by_before * log_viscosity_p[:-1] + of_mass * density_p[:-1],
            driven * by_after * log_viscosity_p[1:] + of_mass * density_p[1:],
        ),
        by_gap=Sides(of_gap, of_gap),
    )


def logarithmic_mean(log_viscosity: Array, fluidity: Array) -> tuple[Array, Array, Array]:
    """Logarithmic mean of the fluidities of two nodes, and its derivatives by ln eta of both.

    Where the two are nearly equal, the differences are replaced by the first terms of their series.
    """
    before, after = fluidity[:-1], fluidity[1:]
    change = log_viscosity[:-1] - log_viscosity[1:]
    alike = np.abs(change) < _ALIKE
    over = 1.0 / np.where(alike, 1.0, change)
    mean = np.where(alike, before * (1.0 + change * (0.5 + change / 6.0)), (after - before) * over)
    by_before = np.where(alike, -before * (0.5 + change / 6.0), (before - mean) * over)
    by_after = np.where(alike, -before * (0.5 + change / 3.0), (mean - after) * over)
    return mean, by_before, by_after


def _along_and_across(
    k: Coefficients, nodes: Sequence[Array], mesh: Mesh, along: FaceLaw, across: FaceLaw
) -> Flow:
    """Flow by laws of the flow along an axis, from quantities at the nodes (nx, ny)."""
    flow_along = along(*nodes, spacing=mesh.dx)
    if mesh.dy is None:
        return Flow(k, flow_along, None)
    lines = (with_mirror(values, mesh).T for values in nodes)
    return Flow(k, flow_along, across(*lines, spacing=mesh.dy))


def with_mirror(values: Array, mesh: Mesh) -> Array:
    """Nodal values (nx, ny); for a symmetric mesh with one line of the mirror image before the first line."""
    return np.concatenate([values[:, 1:2], values], axis=1) if mesh.symmetric else values


def face_mean(values: Array) -> Array:
    """Means of neighbours along the second last axis."""
    return np.asarray(0.5 * (values[..., 1:, :] + values[..., :-1, :]))


def node_mean(faces: Array) -> Array:
    """Mean of both faces of each node, along the axis before the last; the nodes at the ends have one face.

    Examples
    --------
    >>> node_mean(np.array([[1.0], [3.0]]))[:, 0].tolist()
    [1.0, 2.0, 3.0]
    """
    before = np.concatenate([faces[..., :1, :], faces], axis=-2)
    after = np.concatenate([faces, faces[..., -1:, :]], axis=-2)
    return np.asarray(0.5 * (before + after))


def gradients(pressure: Array, mesh: Mesh) -> tuple[Array, Array]:
    """Central differences dP/dX and dP/dY at the nodes, one-sided on the edges, each of shape (nx, ny)."""
    by_x = np.asarray(np.gradient(pressure, mesh.dx, axis=0))
    if mesh.dy is None:
        return by_x, np.zeros_like(pressure)
    by_y = np.asarray(np.gradient(with_mirror(pressure, mesh), mesh.dy, axis=1))
    return by_x, by_y[:, 1:] if mesh.symmetric else by_y


# Name of the law with the flow through a face of the paper.
MEAN_MOBILITY = "newtonian, mean mobility"
# Laws of the flow through a face, by name.
FLOWS: Mapping[str, FlowLaw] = {"newtonian": mean_fluidity, MEAN_MOBILITY: mean_mobility}
