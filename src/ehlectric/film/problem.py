"""Dimensionless film problem of a contact, with the scales that convert its result to SI units."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.deflection import LINE, Geometry
from ehlectric.film.face_flow import Fluid
from ehlectric.film.hot_oil import Physics
from ehlectric.film.mesh import Mesh, Width
from ehlectric.film.newton import Asperities

# Function that is called after each grid of a refinement: (grid, discretisation error or None) -> None.
OnGrid: TypeAlias = Callable[[Mesh, float | None], None]


@dataclass(frozen=True)
class Scales:
    """Scales between dimensionless and SI quantities: x = X length, p = P pressure, h = H thickness."""

    # half-width b of a line contact, or semi-axis b along entrainment of a point contact [m].
    length: float = 1.0
    pressure: float = 1.0  # Hertz pressure p_h [Pa]
    thickness: float = 1.0  # film thickness of H = 1, b^2/R [m]
    # Ambient pressure [Pa]. It is kept in addition to the dimensionless ambient pressure to avoid rounding
    # errors.
    ambient_pressure: float = 0.0


@dataclass(frozen=True)
class OilSupply:
    """Supply of oil to the inlet of a contact; either a layer or a ratio of films is given.

    Examples
    --------
    >>> OilSupply(film_ratio=0.5).layer is None
    True
    """

    # Thickness H of the oil on both surfaces together at the inlet edge and at ambient pressure: function of
    # Y (ny,) -> H (ny,), dimensionless.
    layer: Callable[[Array], Array] | None = None
    # Central film thickness divided by the thickness of the flooded contact, above 0 and up to 1, for which a
    # uniform layer is searched.
    film_ratio: float | None = None


@dataclass(frozen=True)
class FilmProblem:
    """Film problem of a contact in dimensionless form: X = x/b, Y = y/b, P = p/p_h, H = h R/b^2.

    For a point contact b is the semi-axis and R the reduced radius along entrainment.

    ``fluid``, lubricant over dimensionless pressure P, with the ambient pressure over p_h and the velocity
    parameter lambda = 6 eta0 u_s R^2/(b^3 p_h), u_s = u1 + u2; ``inlet`` and ``outlet``, ends of the domain
    along x, in half-widths; inlet < -1 and outlet > 1; ``scales``, length b [m], pressure p_h [Pa] and
    thickness b^2/R [m] of the result, and its ambient pressure [Pa]; ``added_gap``, gap that roughness adds:
    function of X (nx,) and Y (ny,) -> H (nx, ny); ``source``, right side of the Reynolds equation: function
    of X (nx,) and Y (ny,) -> (nx, ny); zero by default; ``edge_pressure``, pressure P on the edges of the
    domain, instead of ambient pressure: function of X (nx,) and Y (ny,) -> (nx, ny), of which only the edges
    count; ``outside_load``, load that oil outside of the domain carries, part of the load of the geometry;
    ``load_exponent``, exponent with which the expected film of a point contact falls over the load;
    ``boundary_film``, thickness H_s of the boundary film at which the surfaces touch, dimensionless;
    ``hardness``, largest pressure over p_h where the surfaces touch; above it asperities are flattened;
    ``on_grid``, function that is called after each grid of a refinement: grid, discretisation error or None
    -> None.
    """

    fluid: Fluid
    nodes: int
    inlet: float
    outlet: float
    thickness_guess: float
    wedge_order: int = 2
    tolerance: float = 1e-9
    max_iterations: int = 30
    scales: Scales = Scales()
    geometry: Geometry = LINE
    width: Width | None = None
    added_gap: Callable[[Array, Array], Array] | None = None
    source: Callable[[Array, Array], Array] | None = None
    edge_pressure: Callable[[Array, Array], Array] | None = None
    outside_load: float = 0.0
    load_exponent: float = 0.0
    target_error: float | None = None
    most_nodes: int = 10_000_001
    boundary_film: float = 0.0
    hardness: float = np.inf
    supply: OilSupply | None = None
    physics: Physics | None = None
    on_grid: OnGrid | None = None

    @property
    def asperities(self) -> Asperities:
        """Boundary film and hardness of asperities that touch."""
        return Asperities(self.boundary_film, self.hardness)

    @property
    def order(self) -> int:
        """Order of the discretisation, 1 or 2: the flow through the faces is accurate to second order."""
        return min(2, self.wedge_order)

    @property
    def area(self) -> float:
        """Area of the domain, or its length in a line contact, in half-widths."""
        return (self.outlet - self.inlet) * (1.0 if self.width is None else 2.0 * self.width.side)

    def bearing_ambient_pressure_on(self, area: float) -> FilmProblem:
        """Problem in which the ambient pressure carries no more of the load than on a domain of some area."""
        extra = self.fluid.ambient_pressure * (self.area - area)
        if extra <= 0.0:
            return self
        return replace(self, geometry=replace(self.geometry, load=self.geometry.load + extra))

    def edge_excess(self, mesh: Mesh) -> Array | float:
        """Pressure above ambient on the edges of a mesh (nx, ny), zero inside."""
        if self.edge_pressure is None:
            return 0.0
        excess = self.edge_pressure(mesh.x, mesh.y) - self.fluid.ambient_pressure
        return np.where(mesh.edge, excess, 0.0)

    def tell(self, mesh: Mesh, error: float | None) -> None:
        """Call ``on_grid``, if given, with the discretisation error of a grid of the refinement."""
        if self.on_grid is not None:
            self.on_grid(mesh, error)

    def doubled(self) -> FilmProblem:
        """Problem on the grid with twice as many intervals along both axes."""
        width = None if self.width is None else replace(self.width, nodes=2 * self.width.nodes - 1)
        return replace(self, nodes=2 * self.nodes - 1, width=width)

    def halved(self) -> FilmProblem:
        """Problem on the grid with half as many intervals along both axes."""
        width = None if self.width is None else self.width.coarser()
        return replace(self, nodes=self.nodes // 2 + 1, width=width)
