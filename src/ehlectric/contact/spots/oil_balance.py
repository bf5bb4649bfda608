"""Balance of the oil of a solved stationary contact: what its spots swallow, and what its valleys make.

A film that forms again behind a cavity carries the content of oil through the cavity
(``ehlectric.film.starved.reformed``), and its residual is what is left over. Where no such film was found, a
cavitated gap counts as full in the wedge term (``ehlectric.film.cavitation``). Where it ends at a node that
oil fills, the oil that would fill the gap goes on, although less of it has come. The residual of the Reynolds
equation of these nodes is the oil that appears.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.problems import SCHEMES, fluid_of
from ehlectric.contact.setup import Setup
from ehlectric.film.flow import Fluid, flow
from ehlectric.film.line import Film
from ehlectric.film.mesh import Mesh
from ehlectric.film.point import PointFilm
from ehlectric.film.reynolds import residual, wedge_stencil

# Largest excess of the pressure of the oil over ambient by rounding, over p_h.
_ROUNDING = 1e-9

# Relative difference of the spacings of a uniform grid.
_UNIFORM = 1e-6


@dataclass(frozen=True)
class OilBalance:
    """Oil that a stationary film loses and makes, over the mean flow through its contact.

    The mean flow is that of the mean mass of the oil in the Hertz zone at the entrainment speed, over the
    width of the zone.

    Attributes
    ----------
    mass_error : float
        Sum of both parts.
    oil_lost : float
        Oil that enters nodes where the surfaces touch and does not leave them.
    oil_made : float
        Oil that leaves cavitated nodes in the Hertz zone or in a spot in excess of what enters them, where
        oil fills the gap again further downstream within the zone. Each refilling along a streamline counts,
        so that it may be above 1.
    """

    mass_error: float
    oil_lost: float
    oil_made: float


def oil_balance(
    case: Case | Setup, conditions: Conditions | PointConditions, film: Film | PointFilm
) -> OilBalance | None:
    """Balance of the oil of a converged stationary film, from its pressure and thickness.

    Parameters
    ----------
    case : Case or Setup
        Case of the contact, for its oil and its scheme.
    conditions : Conditions or PointConditions
        Operating conditions.
    film : Film or PointFilm
        Converged film.

    Returns
    -------
    OilBalance or None
        Oil lost and made; None where the nodes are not equidistant, as those of a film with a patch.
    """
    if film.mass_residual is not None:
        return OilBalance(film.mass_residual, oil_lost=0.0, oil_made=film.mass_residual)
    if any(float(np.ptp(np.diff(axis))) > _UNIFORM * float(axis[1] - axis[0]) for axis in film.axes):
        return None
    order, law = SCHEMES[case.grid.wedge]
    fluid = fluid_of(case.oil, conditions.max_pressure, conditions.velocity_parameter)
    mesh = _mesh(conditions, film)
    touching = 0.0 if film.contact_pressure is None else film.contact_pressure
    oil = ((film.pressure - touching) / conditions.max_pressure).reshape(mesh.shape)
    gap = np.where(film.contact, np.maximum(film.thickness, conditions.boundary_film), film.thickness)
    thickness = (gap / conditions.thickness_scale).reshape(mesh.shape)
    r = _residual(fluid, law, order, mesh, oil, thickness)
    zone, contact = _in_zone(conditions, mesh), film.contact.reshape(mesh.shape)
    full = oil - fluid.ambient_pressure > _ROUNDING
    made = _refilled(full & zone) & (zone | contact) & (r > 0.0)
    if film.heated is not None:
        # The viscosity of a hot or sheared film is not that of the oil at rest; a cavity has no such flow.
        made &= ~full
    lost = contact & (r < 0.0)
    carried = float(np.mean((film.density.reshape(mesh.shape) * thickness)[zone])) * _width(conditions)
    parts = [abs(float(np.vdot(mesh.weights, np.where(part, r, 0.0)))) / carried for part in (lost, made)]
    return OilBalance(mass_error=sum(parts), oil_lost=parts[0], oil_made=parts[1])


def _residual(fluid: Fluid, law: str, order: int, mesh: Mesh, oil: Array, thickness: Array) -> Array:
    """Residual of the Reynolds equation at the nodes (nx, ny), dimensionless."""
    named = Fluid(fluid.density, fluid.log_viscosity, fluid.velocity_parameter, fluid.ambient_pressure, law)
    at_faces = flow(named, oil, thickness, mesh)
    return residual(at_faces, wedge_stencil(mesh.shape, mesh.dx, order=order), thickness, mesh)


def _mesh(conditions: Conditions | PointConditions, film: Film | PointFilm) -> Mesh:
    """Nodes of a film, in half-widths."""
    x, *y = (axis / conditions.half_width for axis in film.axes)
    return Mesh(x, y[0] if y else np.zeros(1))


def _in_zone(conditions: Conditions | PointConditions, mesh: Mesh) -> Mask:
    """Nodes (nx, ny) within the Hertz zone."""
    across = mesh.y / _width(conditions) * 2.0
    inside: Mask = mesh.x[:, np.newaxis] ** 2 + across**2 < 1.0
    return inside


def _width(conditions: Conditions | PointConditions) -> float:
    """Width of the Hertz zone across entrainment [half-widths]; of a line contact one."""
    if isinstance(conditions, PointConditions):
        return 2.0 * conditions.semi_axis_y / conditions.half_width
    return 1.0


def _refilled(full: Mask) -> Mask:
    """Nodes (nx, ny) on whose line oil fills the gap of a node further downstream, or their own."""
    refilled: Mask = np.logical_or.accumulate(full[::-1], axis=0)[::-1]
    return refilled
