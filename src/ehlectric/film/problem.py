"""Dimensionless problem of the film of one contact, with the scales of its result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ehlectric.arrays import Array
from ehlectric.film.deflection import LINE, Geometry
from ehlectric.film.flow import Fluid
from ehlectric.film.mesh import Width


@dataclass(frozen=True)
class Scales:
    """Scales between dimensionless and SI quantities: x = X length, p = P pressure, h = H thickness.

    Attributes
    ----------
    length : float
        Half-width b, or semi-axis along entrainment [m].
    pressure : float
        Hertz pressure p_h [Pa].
    thickness : float
        b^2/R [m].
    ambient_pressure : float
        Ambient pressure [Pa], exact: the dimensionless one times ``pressure`` would differ by rounding.
    """

    length: float = 1.0
    pressure: float = 1.0
    thickness: float = 1.0
    ambient_pressure: float = 0.0


@dataclass(frozen=True)
class FilmProblem:
    """Film problem of a contact in dimensionless form: X = x/b, Y = y/b, P = p/p_h, H = h R/b^2.

    For a point contact b is the semi-axis and R the reduced radius along entrainment.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over P, with the velocity parameter lambda = 6 eta0 u_s R^2/(b^3 p_h), u_s = u1 + u2, and
        the ambient pressure over p_h.
    nodes : int
        Nodes along x, at least 65.
    inlet, outlet : float
        Ends of the domain in half-widths, inlet < -1 and outlet > 1.
    thickness_guess : float
        Central H of the initial guess; a film-thickness formula is accurate enough.
    second_order : bool
        Whether the upstream wedge term is of second order, else of first.
    tolerance : float
        Largest scaled residual of a solution, a pressure over p_h.
    max_iterations : int
        Largest number of Newton steps on each grid.
    scales : Scales
        Length b [m], pressure p_h [Pa] and thickness b^2/R [m] of the result, and its ambient pressure [Pa].
    geometry : Geometry
        Deflection kernel, dry gap and load of the contact.
    width : Width, optional
        Domain across entrainment, for a point contact.
    added_gap : callable, optional
        Gap that roughness adds, X (nx,), Y (ny,) -> H (nx, ny); a peak adds a negative one.
    source : callable, optional
        Right side of the Reynolds equation, zero by default: X (nx,), Y (ny,) -> (nx, ny). For manufactured
        solutions, or a surface that absorbs or releases oil.
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
