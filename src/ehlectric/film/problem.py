"""The film of a contact as it is asked for: dimensionless, with its scales."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ehlectric.arrays import Array
from ehlectric.film.deflection import LINE, Geometry
from ehlectric.film.flow import Fluid
from ehlectric.film.mesh import Width


@dataclass(frozen=True)
class Scales:
    """What makes the film dimensionless: x = X length, p = P pressure, h = H thickness, all SI.

    ``ambient_pressure`` is that of the fluid in Pa, where P times ``pressure`` would miss it by rounding.
    """

    length: float = 1.0
    pressure: float = 1.0
    thickness: float = 1.0
    ambient_pressure: float = 0.0


@dataclass(frozen=True)
class FilmProblem:
    """A contact in dimensionless form, X = x/b, Y = y/b, P = p/p_h, H = h R/b^2.

    Of a point contact b is the semi-axis along entrainment and R the reduced radius along it.

    Parameters
    ----------
    fluid : Fluid
        Laws over P, the velocity parameter lambda = 6 eta0 u_s R^2/(b^3 p_h) with u_s = u1 + u2, and the
        ambient pressure over p_h.
    nodes : int
        Nodes along x, at least 65.
    inlet, outlet : float
        Ends of the domain in half-widths, inlet < -1 and outlet > 1.
    thickness_guess : float
        Central H to start from; that of a film-thickness formula is near enough.
    second_order : bool
        Upstream wedge term of second order, else of first.
    tolerance : float
        Largest scaled residual of a solution.
    max_iterations : int
        Newton steps allowed on each grid.
    scales : Scales
        Length b [m], pressure p_h [Pa] and thickness b^2/R [m] of the result, and its ambient pressure [Pa].
    geometry : Geometry
        Kernel, dry gap and load of the contact.
    width : Width, optional
        The domain across entrainment, of point contacts.
    added_gap : callable, optional
        Gap that roughness adds, X (nx,), Y (ny,) -> G (nx, ny); a peak adds a negative one.
    source : callable, optional
        Right side of the Reynolds equation in place of zero, X (nx,), Y (ny,) -> (nx, ny): what a
        manufactured solution, or a surface that takes oil up or gives it off, adds to it.
    """

    fluid: Fluid
    nodes: int
    inlet: float
    outlet: float
    thickness_guess: float
    second_order: bool = True
    tolerance: float = 1e-9
    max_iterations: int = 30
    scales: Scales = Scales()
    geometry: Geometry = LINE
    width: Width | None = None
    added_gap: Callable[[Array, Array], Array] | None = None
    source: Callable[[Array, Array], Array] | None = None

    @property
    def order(self) -> int:
        """Order of the discretisation."""
        return 2 if self.second_order else 1
