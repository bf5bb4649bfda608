"""State of the film on one grid, its residual, and the Newton steps that led to it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Coefficients, Flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Level
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.runtime.stored import stored

# A film that did not converge counts as collapsed where it is thinner than this fraction of its central
# thickness.
COLLAPSED = 1e-2

Status: TypeAlias = Literal["converged", "stalled", "diverged", "film collapsed"]

# Function that reports progress: (nodes along x, Newton step, residual) -> None.
Progress: TypeAlias = Callable[[int, int, float], None]


@dataclass(frozen=True)
class NewtonStep:
    """Record of one Newton step.

    Attributes
    ----------
    nodes : int
        Number of nodes of the grid along x.
    residual : float
        Residual before the step, a pressure over p_h.
    krylov_iterations : int
        Number of GMRES iterations for the linear system of the step.
    """

    nodes: int = field(metadata=stored("", "1", "not negative", "nodes of the grid of a Newton step"))
    residual: float = field(metadata=stored("", "1", "not negative", "scaled residual before a Newton step"))
    krylov_iterations: int = field(
        metadata=stored("", "1", "not negative", "GMRES iterations of a Newton step")
    )


@dataclass(frozen=True)
class State:
    """Iterate of the film on one grid, dimensionless.

    Attributes
    ----------
    pressure : ndarray, shape (nx, ny)
        Pressure P; where the surfaces touch, that of the oil and of the asperities together.
    h00 : float
        Rigid displacement H00.
    thickness : ndarray, shape (nx, ny)
        Film thickness H, which follows from P and H00.
    contact_pressure : ndarray, shape (nx, ny), or float
        Part of P that asperities carry; zero where the surfaces do not touch.
    """

    pressure: Array
    h00: float
    thickness: Array
    contact_pressure: Array | float = 0.0

    @classmethod
    def of(cls, level: Level, pressure: Array, h00: float, contact_pressure: Array | float = 0.0) -> State:
        """State with a pressure P (nx, ny) and a rigid displacement H00 on a grid."""
        return cls(pressure, h00, Gap.of(level, pressure, h00).thickness, contact_pressure)

    @property
    def touching(self) -> Mask:
        """Nodes where asperities carry a part of the pressure, shape (nx, ny)."""
        return np.broadcast_to(np.asarray(self.contact_pressure) > 0.0, self.pressure.shape)

    @property
    def oil_pressure(self) -> Array:
        """Pressure of the oil, shape (nx, ny)."""
        return self.pressure - self.contact_pressure

    def lifted(self, smallest: float) -> State:
        """State with H00 raised, if necessary, so that H is at least ``smallest`` everywhere."""
        lift = max(0.0, smallest - float(self.thickness.min()))
        return State(self.pressure, self.h00 + lift, self.thickness + lift)


@dataclass(frozen=True)
class Residual:
    """Residual of the film equations at one state.

    Attributes
    ----------
    flow : Flow
        Flow of the lubricant through the faces at the state.
    reynolds : ndarray, shape (nx, ny)
        Residual r of the Reynolds equation.
    diagonal : ndarray, shape (nx, ny)
        Approximate derivative of r by the pressure of its own node, not negative.
    full_film : ndarray of bool, shape (nx, ny)
        Nodes with a full film; the others are cavitated or on an edge, at ambient pressure.
    load : float
        Dimensionless load of the contact minus the load that the pressure carries.
    norm : float
        Largest scaled residual of all equations, a pressure over p_h.
    """

    flow: Flow
    reynolds: Array
    diagonal: Array
    full_film: Mask
    load: float
    norm: float

    @property
    def coefficients(self) -> Coefficients:
        """Density and mobility at the nodes."""
        return self.flow.coefficients

    @property
    def scaled(self) -> Array:
        """Residual of the Reynolds equation over its diagonal, a pressure over p_h, shape (nx, ny).

        It is zero where the diagonal is zero.
        """
        zeros = np.zeros_like(self.diagonal)
        return np.divide(self.reynolds, self.diagonal, out=zeros, where=self.diagonal > 0.0)


@dataclass(frozen=True)
class GridSolution:
    """Last iterate of Newton's method on one grid.

    Attributes
    ----------
    level : Level
        Grid.
    state : State
        Last iterate.
    final : Residual
        Residual of ``state``.
    steps : tuple of NewtonStep
        Newton steps that led to the last iterate.
    status : str
        "converged", "stalled" or "diverged".
    fraction : ndarray, shape (nx, ny), or None
        Part of the gap that oil fills; None where the film does not carry its content of oil.
    """

    level: Level
    state: State
    final: Residual
    steps: tuple[NewtonStep, ...]
    status: Status
    fraction: Array | None = None

    @property
    def touches(self) -> bool:
        """Whether asperities carry a part of the load at some node."""
        return bool(np.any(self.state.touching))


def film_touches(mesh: Mesh, thickness: Array) -> bool:
    """Whether a film (nx, ny) in any unit is thinner somewhere than 1 % of its central thickness."""
    return float(np.min(thickness)) < COLLAPSED * at_centre(mesh, thickness)
