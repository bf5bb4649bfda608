"""Flow of the lubricant through the faces between neighbouring grid nodes, with its derivatives.

The Reynolds equation balances the pressure-driven mass flux through the faces around a node with the wedge
term. For a Newtonian fluid, dimensionless,

    F = eps dP/dX,   eps = rho H^3/(eta lambda)

along entrainment; across entrainment dP/dY replaces dP/dX. F is the mass flux towards smaller X or Y, as oil
flows from high to low pressure. A face lies half-way between two nodes. Quantities that are known at nodes
enter as the mean of the two nodes, and this mean is taken in this module only.

Another relation between flux and pressure gradient, for example that of a shear-thinning fluid, is one more
function in ``FLOWS``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.mesh import Mesh

# Law of the lubricant: dimensionless pressure -> (value, derivative by pressure).
FluidLaw: TypeAlias = Callable[[Array], tuple[Array, Array]]


@dataclass(frozen=True)
class Fluid:
    """Lubricant in the Reynolds equation, over dimensionless pressure P = p/p_h.

    Attributes
    ----------
    density : callable
        Density law: P -> (rho/rho_0, its derivative by P).
    log_viscosity : callable
        Viscosity law: P -> (ln(eta/eta_0), its derivative by P).
    velocity_parameter : float
        Velocity parameter lambda = 6 eta_0 u_s R^2/(b^3 p_h) with u_s = u_1 + u_2.
    ambient_pressure : float
        Ambient pressure over p_h. Below it density and viscosity keep their values at ambient pressure, as
        the pressure of an iterate may be lower than a liquid can have.
    flow : str
        Name of the relation between flux, pressure and film thickness, a key of ``FLOWS``.
    """

    density: FluidLaw
    log_viscosity: FluidLaw
    velocity_parameter: float
    ambient_pressure: float
    flow: str = "newtonian"


@dataclass(frozen=True)
class Coefficients:
    """Density ratio and mobility at the nodes with their derivatives, each of shape (nx, ny).

    Attributes
    ----------
    density, density_p : ndarray
        rho/rho_0 and its derivative by P.
    eps, eps_p, eps_h : ndarray
        Mobility eps = rho H^3/(eta lambda) and its derivatives by P and by H.
    """

    density: Array
    density_p: Array
    eps: Array
    eps_p: Array
    eps_h: Array


@dataclass(frozen=True)
class Dependence:
    """Derivatives of a flux that depends on a quantity q(P, H) through its mean over the nodes of a face.

    Attributes
    ----------
    by_value : ndarray, shape (n - 1, m)
        Derivative of the flux by q at one of the two nodes of a face; it is equal for both.
    by_pressure, by_thickness : ndarray, shape (n, m)
        Derivatives of q by P and by H at the nodes.
    """

    by_value: Array
    by_pressure: Array
    by_thickness: Array

    def outflow(self, of_node: Array) -> tuple[Array, Array, Array]:
        """Derivatives of -dF/dX at the inner nodes by an unknown of the neighbours and of the node itself.

        ``of_node`` (n, m) is the derivative of q at a node by the unknown of this node. The results, each of
        shape (n - 2, m), are the derivatives by the unknown of the node before, of the node itself and of the
        node after.
        """
        before, after = self.by_value[:-1], self.by_value[1:]
        return of_node[:-2] * before, -of_node[1:-1] * (after - before), -of_node[2:] * after


@dataclass(frozen=True)
class FaceFlow:
    """Pressure-driven flow through the n - 1 faces between n nodes along one axis.

    The first axis of the arrays is the direction of the flow. All fluxes are divided by the grid spacing, so
    that the difference of the fluxes of two neighbouring faces approximates the derivative of F.

    Attributes
    ----------
    flux : ndarray, shape (n - 1, m)
        F over the grid spacing, positive where the pressure rises with X or Y.
    conductance : ndarray, shape (n - 1, m)
        Derivative of the flux by the pressure difference of the two nodes, at fixed nodal quantities.
    dependences : tuple of Dependence
        Derivatives by the nodal quantities that the flux depends on, besides the pressure difference.
    """

    flux: Array
    conductance: Array
    dependences: tuple[Dependence, ...]

    def divergence(self) -> Array:
        """Divergence dF/dX at the inner nodes: difference of the fluxes on both sides, shape (n - 2, m)."""
        return np.diff(self.flux, axis=0)

    def weight(self) -> Array:
        """Sum of the conductances of the two faces of the inner nodes, shape (n - 2, m)."""
        weight: Array = self.conductance[1:] + self.conductance[:-1]
        return weight

    def by_pressure(self) -> tuple[Array, Array, Array]:
        """Derivatives of -dF/dX at the inner nodes by P, each of shape (n - 2, m).

        They are the derivatives by P of the node before, of the node itself and of the node after.
        """
        faces = self.conductance
        before, at, after = -faces[:-1], faces[:-1] + faces[1:], -faces[1:]
        for quantity in self.dependences:
            parts = quantity.outflow(quantity.by_pressure)
            before, at, after = before + parts[0], at + parts[1], after + parts[2]
        return before, at, after

    def by_thickness(self) -> tuple[Array, Array, Array]:
        """Derivatives of -dF/dX at the inner nodes by H, each of shape (n - 2, m).

        They are the derivatives by H of the node before, of the node itself and of the node after.
        """
        first, *others = (quantity.outflow(quantity.by_thickness) for quantity in self.dependences)
        before, at, after = first
        for parts in others:
            before, at, after = before + parts[0], at + parts[1], after + parts[2]
        return before, at, after


@dataclass(frozen=True)
class Flow:
    """Flow of the lubricant at one state of the film.

    Attributes
    ----------
    coefficients : Coefficients
        Density and mobility at the nodes.
    along : FaceFlow
        Pressure-driven flow along entrainment, with arrays (nx - 1, ny).
    across : FaceFlow or None
        Pressure-driven flow across entrainment, with arrays (lines - 1, nx); None for a line contact. For a
        symmetric mesh the lines include the mirror image beyond the line of symmetry.
    """

    coefficients: Coefficients
    along: FaceFlow
    across: FaceFlow | None


FlowLaw: TypeAlias = Callable[[Fluid, Array, Array, Mesh], Flow]


def flow(fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Flow:
    """Flow of the lubricant through all faces of a grid, after the law that the fluid names.

    Parameters
    ----------
    fluid : Fluid
        Lubricant; ``fluid.flow`` is the name of the law.
    pressure, thickness : ndarray, shape (nx, ny)
        Pressure P and film thickness H, dimensionless, H > 0.
    mesh : Mesh
        Grid.

    Returns
    -------
    Flow
        Fluxes, conductances and derivatives.

    Raises
    ------
    KeyError
        If ``FLOWS`` has no law of this name.

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
    return FLOWS[fluid.flow](fluid, pressure, thickness, mesh)


def evaluate(fluid: Fluid, pressure: Array, thickness: Array) -> Coefficients:
    """Density and Newtonian mobility eps = rho H^3/(eta lambda) at the nodes, with their derivatives.

    Parameters
    ----------
    fluid : Fluid
        Lubricant.
    pressure, thickness : ndarray, shape (nx, ny)
        Pressure P and film thickness H, dimensionless, H > 0.

    Returns
    -------
    Coefficients
        Density ratio, mobility and derivatives, dimensionless, each of shape (nx, ny).
    """
    clipped = np.maximum(pressure, fluid.ambient_pressure)
    density, density_p = fluid.density(clipped)
    log_viscosity, log_viscosity_p = fluid.log_viscosity(clipped)
    eps = density * thickness**3 * np.exp(-log_viscosity) / fluid.velocity_parameter
    return Coefficients(
        density=density,
        density_p=density_p,
        eps=eps,
        eps_p=eps * (density_p / density - log_viscosity_p),
        eps_h=3.0 * eps / thickness,
    )


def newtonian(fluid: Fluid, pressure: Array, thickness: Array, mesh: Mesh) -> Flow:
    """Poiseuille flow of a Newtonian fluid, F = eps dP/dX with the mean eps of the two nodes.

    Parameters
    ----------
    fluid : Fluid
        Lubricant.
    pressure, thickness : ndarray, shape (nx, ny)
        Pressure P and film thickness H, dimensionless, H > 0.
    mesh : Mesh
        Grid.

    Returns
    -------
    Flow
        Fluxes, conductances and derivatives; the fluxes are accurate to second order.
    """
    k = evaluate(fluid, pressure, thickness)
    nodes = (k.eps, k.eps_p, k.eps_h, pressure)
    along = _poiseuille(*nodes, spacing=mesh.dx)
    if mesh.dy is None:
        return Flow(k, along, None)
    lines = (_with_mirror(values, mesh).T for values in nodes)
    return Flow(k, along, _poiseuille(*lines, spacing=mesh.dy, across=True))


def _poiseuille(
    eps: Array, eps_p: Array, eps_h: Array, pressure: Array, *, spacing: float, across: bool = False
) -> FaceFlow:
    """Poiseuille flow along the first axis, from mobility, its derivatives and pressure at nodes (n, m)."""
    mean = 0.5 * (eps[1:] + eps[:-1])
    difference, square = np.diff(pressure, axis=0), spacing**2
    return FaceFlow(
        # The order of operations differs between the axes, to keep results reproducible to the last digit.
        flux=mean * (difference / square) if across else mean * difference / square,
        conductance=mean / square,
        dependences=(Dependence(0.5 * difference / square, eps_p, eps_h),),
    )


def _with_mirror(values: Array, mesh: Mesh) -> Array:
    """Nodal values (nx, ny); for a symmetric mesh with one line of the mirror image before the first line."""
    return np.concatenate([values[:, 1:2], values], axis=1) if mesh.symmetric else values


# Laws of the flow through a face, by name.
FLOWS: Mapping[str, FlowLaw] = {"newtonian": newtonian}
