"""Jacobian of a film whose surfaces touch at some nodes, and its preconditioner.

The unknowns are the sum Q of the pressures of oil and asperities at all nodes, the pressure P of the oil
where the surfaces touch, and H00. The rows of the nodes in contact ask for H = H_s. The pressure of the oil
there follows from its own Reynolds equation by a sparse factorisation and is eliminated, so that the unknowns
are those of a film without contact. Where oil is carried through cavities, its mass in them is eliminated
with the pressure of the oil.

The difference of the rows of two neighbours in contact is the wedge term of an incompressible film through
which no pressure drives oil, dH/dX = 0. Written in this form, the rows of a spot are like those of the Hertz
zone of a heavy contact, and the V-cycles of the film (``ehlectric.film.multigrid``) serve as they are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import SuperLU, splu

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import DIPOLE, Level
from ehlectric.film.mixed.touching import Carried, Touching
from ehlectric.film.multigrid import Linearised, cycled, resolved_nodes
from ehlectric.film.reynolds import Stencil, linearise, poiseuille_weight, stencil_matrix, without_columns
from ehlectric.film.starved.content import of_filled
from ehlectric.film.starved.jacobian import behind_cavities, with_row_before


@dataclass(frozen=True)
class TouchingJacobian:
    """Jacobian on the finest grid, with those of all grids that precondition it.

    Attributes
    ----------
    levels : list of Linearised
        Jacobians for Q and H00 on all grids, without the change of the oil where the surfaces touch. Rows
        behind cavities contain the last row of the cavity.
    finest : Linearised
        Jacobian for Q and H00 on the finest grid without this.
    oil_by_p, oil_by_h : Stencil
        Derivatives of the Reynolds residual by P and by H, of all nodes that oil fills.
    contact, oil : ndarray of bool, shape (nx, ny)
        Nodes in contact, and those among them that oil fills.
    rest : ndarray of bool, shape (nx, ny)
        Nodes of ``oil``, and cavitated nodes whose mass is carried to filled ones.
    by_rest : Stencil
        Derivative of the Reynolds residual of all these and of the filled nodes by P of the first and by the
        mass of the second.
    factors : SuperLU or None
        Factorisation of ``by_rest`` between the nodes of ``rest``; None where there are none.
    open_nodes : ndarray of bool, shape (nx, ny)
        Nodes apart from contact where the Poiseuille term dominates.
    open_factors : SuperLU or None
        Factorisation of the derivative of their Reynolds residual by their P at fixed gap.
    """

    levels: list[Linearised]
    finest: Linearised
    oil_by_p: Stencil
    oil_by_h: Stencil
    contact: Mask
    oil: Mask
    rest: Mask
    by_rest: Stencil
    factors: SuperLU | None
    open_nodes: Mask
    open_factors: SuperLU | None

    @classmethod
    def of(
        cls, fluid: Fluid, levels: list[Level], oil_pressure: Array, now: Touching, damping: float
    ) -> TouchingJacobian:
        """Jacobian at a state with the residual ``now``; the coarser grids take its injection.

        Raises
        ------
        numpy.linalg.LinAlgError
            Where the oil of some nodes has no flow, as in gaps that are far from a solution.
        """
        level, contact, full_film, carried = levels[0], now.contact, now.full_film, now.carried
        plastic = now.plastic
        by_p, by_h = _damped(level, now.flow, now.thickness, damping, carried)
        oil = contact & full_film
        hollow = np.zeros_like(oil) if carried is None else carried.hollow
        rows = full_film | hollow
        oil_by_p, oil_by_h = by_p.on_rows(rows), without_columns(by_h.on_rows(rows), plastic)
        rest, by_rest = oil | hollow, _by_mass(level, oil_by_p, hollow, damping)
        factors = _factored(by_rest, rest) if rest.any() else None
        masks: tuple[Mask, ...] = (full_film, contact, plastic)
        jacobians = [_linearised(level, (by_p, by_h), now.flow, now.thickness, masks, carried)]
        finest = jacobians[0]
        if carried is not None:
            finest = _linearised(level, (by_p, by_h), now.flow, now.thickness, masks, None)
        pressure, thickness = oil_pressure, now.thickness
        for coarse in levels[1:]:
            pressure, thickness = coarse.inject(pressure), coarse.inject(thickness)
            masks = tuple(coarse.inject(mask.astype(float)) > 1.0 - 1e-9 for mask in masks)
            carried = None if carried is None else carried.on(coarse)
            at_faces = flow(fluid, pressure, thickness, coarse.mesh)
            stencils = _damped(coarse, at_faces, thickness, damping * level.rate / coarse.rate, carried)
            jacobians.append(_linearised(coarse, stencils, at_faces, thickness, masks, carried))
        opened = full_film & ~contact & (jacobians[0].poiseuille > level.rate)
        opened_factors = _factored(oil_by_p, opened) if opened.any() and contact.any() else None
        return cls(
            levels=jacobians,
            finest=finest,
            oil_by_p=oil_by_p,
            oil_by_h=oil_by_h,
            contact=contact,
            oil=oil,
            rest=rest,
            by_rest=by_rest,
            factors=factors,
            open_nodes=opened,
            open_factors=opened_factors,
        )

    def right_side(self, now: Touching, to_ambient: Array, given: Array) -> tuple[Array, Array]:
        """Right sides of the rows of Q (nx, ny), and of the rows of the oil (nx, ny).

        ``to_ambient`` (nx, ny) is the change of P at the nodes that oil does not fill, and ``given`` (nx, ny)
        the change of Q at the nodes where it is known.
        """
        dh = self.finest.level.deflection(given)
        oil = -now.reynolds - self.oil_by_p(to_ambient)
        rest = oil - self.oil_by_h(dh) - self.by_rest(self.rest_of(oil, np.zeros_like(dh), dh))
        contact = self.finest.by_h(np.where(now.contact & ~now.plastic, now.missing - dh, 0.0))
        free = now.full_film & ~now.contact
        return np.where(now.plastic, 0.0, np.where(now.contact, contact, np.where(free, rest, 0.0))), oil

    def oil_of(self, oil: Array, dq: Array, dh: Array) -> Array:
        """Change of P of the oil where the surfaces touch, zero elsewhere, (nx, ny); see ``rest_of``."""
        return np.where(self.oil, self.rest_of(oil, dq, dh), 0.0)

    def rest_of(self, oil: Array, dq: Array, dh: Array) -> Array:
        """Change of P of the oil where the surfaces touch, and of the mass in cavities, shape (nx, ny).

        Parameters
        ----------
        oil : ndarray, shape (nx, ny)
            Right side of the rows of the oil.
        dq, dh : ndarray, shape (nx, ny)
            Change of Q, which is that of P where the surfaces do not touch, and change of H.
        """
        change = np.zeros_like(dq)
        if self.factors is not None:
            elsewhere = np.where(self.contact, 0.0, dq)
            right = oil - self.oil_by_p(elsewhere) - self.oil_by_h(dh)
            change[self.rest] = self.factors.solve(right[self.rest])
        return change

    def image(self, change: Array) -> Array:
        """Change of scaled residual and load, as one vector, for a change of Q and H00, as one vector."""
        finest = self.finest
        dq = change[:-1].reshape(finest.full_film.shape)
        dh, load = finest.gap.change(dq, float(change[-1]))
        r = finest.by_p(dq) + finest.by_h(dh)
        if self.factors is not None:
            by_rest = self.by_rest(self.rest_of(np.zeros_like(dq), dq, dh))
            r += np.where(finest.full_film & ~self.contact, by_rest, 0.0)
        return np.append(finest.scale * r, load)

    def precondition(self, image: Array) -> Array:
        """Approximate change of Q and H00 from a scaled residual and load, by one V-cycle.

        Beside spots the mobility changes by orders of magnitude from node to node, which coarser grids do not
        see. What the cycle leaves where the Poiseuille term dominates is solved at fixed gap.
        """
        change = cycled(self.levels, image)
        if self.open_factors is not None:
            left = (image - self.image(change))[:-1].reshape(self.contact.shape)
            dp = self.open_factors.solve((self.finest.unscale * left)[self.open_nodes])
            change[:-1].reshape(self.contact.shape)[self.open_nodes] += dp
        return change


def _damped(
    level: Level, at_faces: Flow, thickness: Array, damping: float, carried: Carried | None
) -> tuple[Stencil, Stencil]:
    """Derivatives of the Reynolds residual by P and by H, as in a time step of length 1/(damping rate).

    The mass that a node gains in the step adds to the residual; at the state itself it adds nothing.
    """
    wedge = level.wedge
    if carried is not None:
        at_faces = of_filled(at_faces, carried.filled)
        wedge = carried.supply.wedge(level.mesh, carried.filled)
    by_p, by_h = linearise(at_faces, wedge, thickness, level.mesh)
    k, inner = at_faces.coefficients, level.mesh.inner
    by_p.coefficients[2][inner] += damping * level.rate * (k.density_p * thickness)[inner]
    by_h.coefficients[2][inner] += damping * level.rate * k.density[inner]
    return by_p, by_h


def _by_mass(level: Level, by_p: Stencil, hollow: Mask, damping: float) -> Stencil:
    """Stencil by P whose columns of cavitated nodes are by the mass that they pass to the node behind."""
    if not hollow.any():
        return by_p
    c = without_columns(by_p, hollow).coefficients
    c[2][hollow] = (1.0 + damping) * level.rate
    c[1][1:][hollow[:-1]] = -level.rate
    return Stencil(c)


def _linearised(
    level: Level,
    stencils: tuple[Stencil, Stencil],
    at_faces: Flow,
    thickness: Array,
    masks: tuple[Mask, ...],
    carried: Carried | None,
) -> Linearised:
    """Jacobian for Q and H00 on one grid; P where the surfaces touch does not change.

    ``masks`` are the nodes with a full film, those in contact and those that are flattened.
    """
    full_film, contact, plastic = masks
    free = full_film & ~contact
    gap = Gap(level, thickness)
    if carried is not None:
        behind = behind_cavities(carried.filled) & free
        stencils = with_row_before(stencils[0], behind), with_row_before(stencils[1], behind)
    by_p = without_columns(stencils[0].on_rows(free), contact)
    by_h = without_columns(stencils[1].on_rows(free), plastic)
    by_h = _with_contact_rows(level, by_h, contact & ~plastic)
    poiseuille = np.where(contact, 0.0, poiseuille_weight(at_faces, level.mesh))
    density = np.where(contact, 1.0, at_faces.coefficients.density)
    diagonal = poiseuille + gap.elastic_weight(density)
    unknown = free | (contact & ~plastic)
    return Linearised(
        gap=gap,
        by_p=by_p,
        by_h=by_h,
        full_film=unknown,
        poiseuille=poiseuille,
        scale=np.divide(1.0, diagonal, out=np.zeros(unknown.shape), where=unknown),
        unscale=np.where(unknown, diagonal, 0.0),
        resolved=resolved_nodes(level, at_faces.coefficients.eps, unknown),
        log_viscosity=at_faces.coefficients.log_viscosity,
    )


def _with_contact_rows(level: Level, by_h: Stencil, contact: Mask) -> Stencil:
    """Stencil by H whose rows in contact are a multiple of the change of H.

    In a stationary film it is the difference to the node before where that is in contact, too.
    """
    rows = by_h.coefficients.copy()
    rows[2][contact] = level.rate
    if level.distribution is DIPOLE:
        after = contact.copy()
        after[1:] &= contact[:-1]
        after[0] = False
        rows[1][after] = -level.rate
    return Stencil(rows)


def _factored(stencil: Stencil, nodes: Mask) -> SuperLU:
    """Factorisation of a stencil between nodes; an error where its matrix is singular."""
    try:
        return splu(stencil_matrix(stencil, nodes))
    except RuntimeError as error:
        raise np.linalg.LinAlgError("the flow of the oil has a singular matrix") from error
