"""Films whose surfaces touch at some nodes: the residual and its Jacobian.

The surfaces touch where the gap is as thin as the boundary film that adheres to them, H = H_s. There the
contact pressure P_c of the asperities adds to the pressure P of the oil. Every node fulfils

    H >= H_s,   P_c >= 0,   (H - H_s) P_c = 0.

With a hardness P_y, the pressure Q = P + P_c of nodes in contact is at most P_y: where the elastic gap would
be less than H_s under this pressure, the asperities are flattened, elastic and perfectly plastic, and the gap
is H_s.

Gap and load follow from Q. The oil in the boundary film keeps its Reynolds equation, so that no mass is lost
where surfaces touch: P is what drives the oil through a gap of the thickness H_s. A node has three
states: cavitated, full film and contact. The first two are states of the oil, and either may hold at a node
in contact (``ehlectric.film.cavitation``).

The unknowns of a Newton step are the sum Q of the pressures of oil and asperities at all nodes, the pressure
P of the oil where the surfaces touch, and H00. The rows of the nodes in contact ask for H = H_s. The pressure
of the oil there follows from its own Reynolds equation by a sparse factorisation and is eliminated, so that
the unknowns are the unknowns of a film without contact. If oil is carried through cavities, its mass in them
is eliminated with the pressure of the oil.

The difference of the rows of two neighbours in contact is the wedge term of an incompressible film through
which no pressure drives oil, dH/dX = 0. Written in this form, the rows of a spot are like the rows of the
Hertz zone of a heavy contact, and the V-cycles of the film (``ehlectric.film.multigrid``) serve as they are.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.film.cavitation import full_film_nodes, with_refilled_nodes
from ehlectric.film.face_flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import DIPOLE, Level
from ehlectric.film.multigrid import Linearised, cycled
from ehlectric.film.newton import (
    LOAD_WEIGHT,
    Asperities,
    Residual,
    State,
)
from ehlectric.film.oil_content import (
    Carried,
    behind_cavities,
    filled_anew,
    of_filled,
    with_row_before,
)
from ehlectric.film.reynolds import (
    ALONG,
    Stencil,
    linearise,
    poiseuille_weight,
    residual,
    stencil_matrix,
    without_columns,
)

if TYPE_CHECKING:
    from ehlectric.film.stiff_nodes import StiffSolver


@dataclass(frozen=True)
class Touching(Residual):
    """Residual of a film whose surfaces touch at some nodes, at one state.

    Its flow is the flow in a gap of at least H_s. Its norm contains all rows except the rows of the oil
    where the surfaces touch.
    """

    thickness: Array  # gap of the flow, the larger of H and H_s, shape (nx, ny)
    # contact and plastic: nodes where the surfaces touch, and those among them where they are flattened,
    # shape (nx, ny).
    contact: Mask
    plastic: Mask
    missing: Array  # H_s - H where the surfaces touch and are not flattened, zero elsewhere, shape (nx, ny)
    to_hardness: Array  # P_y - Q where they are flattened, zero elsewhere, shape (nx, ny)
    oil_norm: float  # largest scaled residual of the oil where the surfaces touch, a pressure over p_h
    # Oil that is carried through cavities; None where a cavitated gap counts as full.
    carried: Carried | None = None
    settled: bool = True  # whether the nodes that oil fills equal the nodes at which its mass was carried

    @property
    def oil(self) -> Mask:
        """Nodes in contact that oil fills, shape (nx, ny)."""
        return self.contact & self.full_film

    @property
    def hollow(self) -> Mask:
        """Cavitated nodes whose mass is carried to filled ones, shape (nx, ny)."""
        return np.zeros_like(self.full_film) if self.carried is None else self.carried.hollow

    def rows_of_oil(self, level: Level, by_p: Stencil, damping: float) -> tuple[Stencil, Stencil, Mask]:
        """Rows of the oil, from the derivatives by P of all rows.

        Returns these rows by P, the rows by the unknowns of the nodes ``oil`` and ``hollow``, and the mask of
        these nodes (nx, ny). The unknowns are P and, in cavities, the mass that is passed on.
        """
        hollow = self.hollow
        by_p = by_p.on_rows(self.full_film | hollow)
        return by_p, _by_mass(level, by_p, hollow, damping), self.oil | hollow


def node_compliance(level: Level) -> float:
    """Deflection at a node by a unit pressure there and the opposite pressure at its neighbour along x."""
    influence = level.deflection.influence
    return float(influence[0, 0] - influence[1, 0])


def contact_nodes(level: Level, state: State, boundary_film: float) -> Mask:
    """Mask of the nodes where the surfaces touch, shape (nx, ny).

    They are those where P_c - (H - H_s)/c > 0, with the compliance c of a node, as in a primal-dual active
    set method; the edges of the domain are never among them.
    """
    if not boundary_film:
        return np.zeros(state.thickness.shape, dtype=bool)
    excess = state.contact_pressure - (state.thickness - boundary_film) / node_compliance(level)
    return (excess > 0.0) & level.mesh.inner


def plastic_nodes(level: Level, state: State, asperities: Asperities, contact: Mask) -> Mask:
    """Mask of the nodes in contact whose asperities are flattened, shape (nx, ny)."""
    if np.isinf(asperities.hardness):
        return np.zeros(contact.shape, dtype=bool)
    sunk = (asperities.boundary_film - state.thickness) / node_compliance(level)
    return contact & (state.pressure - asperities.hardness + sunk > 0.0)


def assess_touching(
    fluid: Fluid, level: Level, state: State, asperities: Asperities, carried: Carried | None = None
) -> Touching:
    """Residual of the film equations at a state whose surfaces may touch.

    ``carried`` has the nodes that oil fills, and the supply, where the oil in cavities is carried.
    """
    mesh, boundary_film = level.mesh, asperities.boundary_film
    contact = contact_nodes(level, state, boundary_film)
    plastic = plastic_nodes(level, state, asperities, contact)
    oil, thickness = state.oil_pressure, np.maximum(state.thickness, boundary_film)
    at_faces = flow(fluid, oil, thickness, mesh)
    k = at_faces.coefficients
    poiseuille = poiseuille_weight(at_faces, mesh)
    excess = oil - fluid.ambient_pressure - level.edge_excess
    settled = True
    if carried is None:
        r = residual(at_faces, level.wedge, thickness, mesh) - level.source
        full_film = full_film_nodes(
            excess, r, poiseuille=poiseuille, rate=level.rate, thickness=thickness, inner=mesh.inner
        )
        if level.distribution is DIPOLE:
            # A surplus of oil at the edge of a spot is carried through the whole spot at once.
            full_film |= with_refilled_nodes(full_film, r) & contact
    else:
        before = carried.filled
        full = k.density * thickness
        if boundary_film:
            carried = replace(carried, supply=carried.supply.at_gap(full))
        carried = replace(carried, supply=carried.supply.at_state(excess, full, poiseuille, level.rate))
        carried, r = filled_anew(level, at_faces, thickness, poiseuille, excess, carried)
        full_film, settled = carried.filled & mesh.inner, bool(np.array_equal(carried.filled, before))
    compliance = node_compliance(level)
    moving = np.where(contact, k.density_p * thickness, k.density * compliance)
    diagonal = poiseuille + moving * level.rate
    scaled = np.where(full_film, r / np.where(diagonal > 0.0, diagonal, 1.0), excess)
    missing = np.where(contact & ~plastic, boundary_film - state.thickness, 0.0)
    to_hardness = np.where(plastic, asperities.hardness - state.pressure, 0.0)
    load = level.load - Gap(level, thickness).load(state.pressure)
    rows = np.where(contact, missing / compliance + to_hardness, scaled)
    norm = max(float(np.max(np.abs(rows))), LOAD_WEIGHT * abs(load) / level.load)
    oil_norm = float(np.max(np.abs(np.where(contact, scaled, 0.0))))
    return Touching(
        flow=at_faces,
        thickness=thickness,
        reynolds=r,
        diagonal=diagonal,
        full_film=full_film,
        contact=contact,
        plastic=plastic,
        missing=missing,
        to_hardness=to_hardness,
        load=load,
        norm=norm,
        oil_norm=oil_norm,
        carried=carried,
        settled=settled,
    )


def projected(fluid: Fluid, state: State, contact: Mask) -> State:
    """State whose contact pressure is nowhere negative, and zero where the surfaces do not touch.

    The sum of both pressures, on which the gap depends, remains. If the surfaces touch, the pressure of
    the oil lies between ambient pressure and this sum.
    """
    ambient = fluid.ambient_pressure
    oil = np.where(contact, np.clip(state.oil_pressure, ambient, state.pressure), state.pressure)
    return State(state.pressure, state.h00, state.thickness, state.pressure - oil)


@dataclass(frozen=True)
class TouchingJacobian:
    """Jacobian on the finest grid, with the Jacobians of all grids that precondition it."""

    # Jacobians for Q and H00 on all grids, without the change of the oil where the surfaces touch. Rows
    # behind cavities contain the last row of the cavity. None where the stiff nodes are solved directly.
    levels: list[Linearised]
    finest: Linearised  # Jacobian for Q and H00 on the finest grid, without the last rows of cavities
    # oil_by_p and oil_by_h: derivatives of the Reynolds residual by P and by H, of all nodes that oil fills.
    oil_by_p: Stencil
    oil_by_h: Stencil
    # contact and oil: nodes in contact, and those among them that oil fills, shape (nx, ny).
    contact: Mask
    oil: Mask
    rest: Mask  # nodes of ``oil``, and cavitated nodes whose mass is carried to filled ones, shape (nx, ny)
    # Derivative of the Reynolds residual of all these and of the filled nodes by P of the first and by the
    # mass of the second.
    by_rest: Stencil
    # Factorisation of ``by_rest`` between the nodes of ``rest``; None where there are none.
    factors: scipy.sparse.linalg.SuperLU | None
    open_nodes: Mask  # nodes apart from contact where the Poiseuille term dominates, shape (nx, ny)
    # Factorisation of the derivative of the Reynolds residual of ``open_nodes`` by their P at fixed gap.
    open_factors: scipy.sparse.linalg.SuperLU | None
    stiff: StiffSolver | None  # direct solver of the nodes that are not open; None where they are too many

    @classmethod
    def of(
        cls, fluid: Fluid, levels: list[Level], oil_pressure: Array, now: Touching, damping: float
    ) -> TouchingJacobian:
        """Jacobian at a state with the residual ``now``; the coarser grids take its injection.

        Raises numpy.linalg.LinAlgError where the oil of some nodes has no flow, as in gaps that are far from
        a solution.
        """
        level, contact, full_film, carried = levels[0], now.contact, now.full_film, now.carried
        plastic = now.plastic
        by_p, by_h = _damped(level, now.flow, now.thickness, damping, carried)
        oil_by_p, by_rest, rest = now.rows_of_oil(level, by_p, damping)
        oil_by_h = without_columns(by_h.on_rows(full_film | now.hollow), plastic)
        factors = _factored(by_rest, rest) if rest.any() else None
        masks: tuple[Mask, ...] = (full_film, contact, plastic)
        finest = _linearised(level, (by_p, by_h), now.flow, now.thickness, masks, None)
        opened = full_film & ~contact & (finest.poiseuille > level.rate)
        helps = contact.any() or (carried is not None and level.mesh.dy is not None)
        opened_factors = _factored(oil_by_p, opened) if opened.any() and helps else None
        stiff_nodes, stiff, jacobians = finest.full_film & ~opened, None, []
        if opened_factors is not None and level.mesh.dy is not None:
            # late: line contacts do not need it
            from ehlectric.film.stiff_nodes import StiffSolver, few_enough

            if few_enough(stiff_nodes):
                stiff = StiffSolver.of(finest.gap, finest.by_p, finest.by_h, stiff_nodes)
        if stiff is None:
            jacobians = _on_levels(fluid, levels, oil_pressure, now, (by_p, by_h), finest, damping)
        return cls(
            levels=jacobians,
            finest=finest,
            oil_by_p=oil_by_p,
            oil_by_h=oil_by_h,
            contact=contact,
            oil=now.oil,
            rest=rest,
            by_rest=by_rest,
            factors=factors,
            open_nodes=opened,
            open_factors=opened_factors,
            stiff=stiff,
        )

    def right_side(self, now: Touching, to_ambient: Array, given: Array) -> tuple[Array, Array]:
        """Return the right sides of the Q rows (nx, ny) and the oil rows (nx, ny).

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

        ``oil`` is the right side of the rows of the oil, ``dq`` the change of Q, which is the change of P
        where the surfaces do not touch, and ``dh`` the change of H, each (nx, ny).
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
        """Approximate change of Q and H00 from a scaled residual and load.

        The open nodes are solved at fixed gap. The stiff nodes follow directly if there are few of them.
        Otherwise one V-cycle comes first: next to spots the mobility changes by orders of magnitude from node
        to node, which coarser grids do not see.
        """
        if self.stiff is not None:
            change = np.zeros_like(image)
            self._add_open(change, image)
            left = image - self.image(change)
            dq, dh00 = self.stiff(self._unscaled(left), float(left[-1]))
            change[:-1] += dq.ravel()
            change[-1] = dh00
            return change
        change = cycled(self.levels, image)
        if self.open_factors is not None:
            self._add_open(change, image - self.image(change))
        return change

    def _add_open(self, change: Array, left: Array) -> None:
        """Add what solves the rows of the open nodes at fixed gap to a change, as vectors of Q and H00."""
        assert self.open_factors is not None
        dp = self.open_factors.solve(self._unscaled(left)[self.open_nodes])
        change[:-1].reshape(self.contact.shape)[self.open_nodes] += dp

    def _unscaled(self, image: Array) -> Array:
        """Residual (nx, ny) of a vector of scaled residual and load."""
        residual: Array = self.finest.unscale * image[:-1].reshape(self.contact.shape)
        return residual


def _on_levels(
    fluid: Fluid,
    levels: list[Level],
    oil_pressure: Array,
    now: Touching,
    stencils: tuple[Stencil, Stencil],
    finest: Linearised,
    damping: float,
) -> list[Linearised]:
    """Jacobians on all grids, from the stencils by P and by H and the Jacobian on the finest grid."""
    level, carried = levels[0], now.carried
    pressure, thickness = oil_pressure, now.thickness
    masks: tuple[Mask, ...] = (now.full_film, now.contact, now.plastic)
    jacobians = [finest]
    if carried is not None:
        jacobians = [_linearised(level, stencils, now.flow, thickness, masks, carried)]
    for coarse in levels[1:]:
        pressure, thickness = coarse.inject(pressure), coarse.inject(thickness)
        masks = tuple(coarse.inside(mask) for mask in masks)
        carried = None if carried is None else carried.on(coarse)
        at_faces = flow(fluid, pressure, thickness, coarse.mesh)
        on_coarse = _damped(coarse, at_faces, thickness, damping * level.rate / coarse.rate, carried)
        jacobians.append(_linearised(coarse, on_coarse, at_faces, thickness, masks, carried))
    return jacobians


def _damped(
    level: Level, at_faces: Flow, thickness: Array, damping: float, carried: Carried | None
) -> tuple[Stencil, Stencil]:
    """Derivatives of the Reynolds residual by P and by H, as in a time step of length 1/(damping rate).

    The mass that a node gains in the step adds to the residual; at the state itself it adds nothing.
    """
    wedge = level.wedge
    if carried is not None:
        at_faces = of_filled(at_faces, carried.filled)
        full = at_faces.coefficients.density * thickness
        wedge = carried.supply.wedge(level.mesh, carried.filled, full)
    by_p, by_h = linearise(at_faces, wedge, thickness, level.mesh)
    k, inner = at_faces.coefficients, level.mesh.inner
    if carried is not None:
        by_fullness = carried.supply.by_fullness(level.mesh, carried.filled, full)
        if by_fullness is not None:
            by_p.coefficients[:ALONG] += by_fullness.coefficients
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
    if carried is not None:
        behind = behind_cavities(carried.filled) & free
        stencils = with_row_before(stencils[0], behind), with_row_before(stencils[1], behind)
    by_p = without_columns(stencils[0].on_rows(free), contact)
    by_h = without_columns(stencils[1].on_rows(free), plastic)
    by_h = _with_contact_rows(level, by_h, contact & ~plastic)
    unknown = free | (contact & ~plastic)
    return Linearised.of_stencils(Gap(level, thickness), (by_p, by_h), at_faces, unknown, contact)


def _with_contact_rows(level: Level, by_h: Stencil, contact: Mask) -> Stencil:
    """Stencil by H whose rows in contact are a multiple of the change of H.

    In a stationary film it is the difference to the node before if this node is also in contact.
    """
    rows = by_h.coefficients.copy()
    rows[2][contact] = level.rate
    if level.distribution is DIPOLE:
        after = contact.copy()
        after[1:] &= contact[:-1]
        after[0] = False
        rows[1][after] = -level.rate
    return Stencil(rows)


# Options of SuperLU for matrices whose pattern is nearly symmetric and whose diagonal is mostly the largest
# entry: two thirds of the fill.
_SYMMETRIC: dict[str, Any] = {
    "permc_spec": "MMD_AT_PLUS_A",
    "diag_pivot_thresh": 0.1,
    "relax": 8,
    "panel_size": 1,
    "options": {"SymmetricMode": True},
}


def _factored(stencil: Stencil, nodes: Mask) -> scipy.sparse.linalg.SuperLU:
    """Factorisation of a stencil between nodes; an error where its matrix is singular."""
    try:
        return scipy.sparse.linalg.splu(stencil_matrix(stencil, nodes), **_SYMMETRIC)
    except RuntimeError as error:
        raise np.linalg.LinAlgError("the flow of the oil has a singular matrix") from error


def with_oil_step(fluid: Fluid, level: Level, state: State, now: Touching) -> State:
    """State after one Newton step for the pressure of the oil in the spots and the mass in cavities.

    The gap and the sum of the pressures of oil and asperities do not change. The state itself where no oil is
    in a spot, or where its flow has a singular matrix.
    """
    oil = now.oil
    if now.carried is None or not oil.any():
        return state
    by_p, _ = _damped(level, now.flow, now.thickness, 0.0, now.carried)
    by_p, by_rest, rest = now.rows_of_oil(level, by_p, 0.0)
    resting = fluid.ambient_pressure + level.edge_excess
    change = np.where(now.contact & ~now.full_film, resting - state.oil_pressure, 0.0)
    right = -now.reynolds - by_p(change)
    try:
        solved = _factored(by_rest, rest).solve(right[rest])
    except np.linalg.LinAlgError:
        return state
    change[oil] = solved[oil[rest]]
    contact_pressure = state.contact_pressure - change
    return projected(fluid, replace(state, contact_pressure=contact_pressure), now.contact)
