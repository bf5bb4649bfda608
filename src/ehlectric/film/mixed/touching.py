"""Nodes where the surfaces touch, and the residual of a film with such nodes.

The surfaces touch where the gap is as thin as the boundary film that adheres to them, H = H_s. There the
contact pressure P_c of the asperities adds to the pressure P of the oil. Every node fulfils

    H >= H_s,   P_c >= 0,   (H - H_s) P_c = 0.

With a hardness P_y, the pressure Q = P + P_c of nodes in contact is at most P_y: where the elastic gap would
be less than H_s under this pressure, the asperities are flattened, elastic and perfectly plastic, and the gap
is H_s.

Gap and load follow from Q. The oil in the boundary film keeps its Reynolds equation, so that no mass is lost
where surfaces touch: P is what drives the oil through a gap of the thickness H_s. Of the three states of a
node, cavitated, full film and contact, the first two are those of the oil, and either may hold at a node in
contact (``ehlectric.film.cavitation``).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.cavitation import full_film_nodes, with_refilled_nodes
from ehlectric.film.flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import DIPOLE, Level
from ehlectric.film.newton import LOAD_WEIGHT
from ehlectric.film.reynolds import poiseuille_weight, residual
from ehlectric.film.starved.content import Runs, Supply, content, unreduced
from ehlectric.film.starved.newton import OVERFLOW, TENSION
from ehlectric.film.state import State


@dataclass(frozen=True)
class Touching:
    """Residual of a film whose surfaces touch at some nodes, at one state.

    Attributes
    ----------
    flow : Flow
        Flow of the oil through the faces, with a gap of at least H_s.
    thickness : ndarray, shape (nx, ny)
        Gap of the flow, the larger of H and H_s.
    reynolds : ndarray, shape (nx, ny)
        Residual r of the Reynolds equation.
    poiseuille : ndarray, shape (nx, ny)
        Diagonal of the Poiseuille term.
    diagonal : ndarray, shape (nx, ny)
        Approximate derivative of r by the pressure of the oil at its own node.
    full_film : ndarray of bool, shape (nx, ny)
        Nodes that oil fills; at all others the oil is at ambient pressure.
    contact, plastic : ndarray of bool, shape (nx, ny)
        Nodes where the surfaces touch, and those among them where they are flattened.
    missing : ndarray, shape (nx, ny)
        H_s - H where the surfaces touch and are not flattened, zero elsewhere.
    to_hardness : ndarray, shape (nx, ny)
        P_y - Q where they are flattened, zero elsewhere.
    load : float
        Dimensionless load of the contact minus the load that the pressure carries.
    norm : float
        Largest scaled residual of all equations but those of the oil where the surfaces touch.
    oil_norm : float
        Largest scaled residual of the oil where the surfaces touch. Both are pressures over p_h.
    carried : Carried or None
        Oil that is carried through cavities; None where a cavitated gap counts as full.
    settled : bool
        Whether the nodes that oil fills are those at which its mass was carried.
    """

    flow: Flow
    thickness: Array
    reynolds: Array
    poiseuille: Array
    diagonal: Array
    full_film: Mask
    contact: Mask
    plastic: Mask
    missing: Array
    to_hardness: Array
    load: float
    norm: float
    oil_norm: float
    carried: Carried | None = None
    settled: bool = True

    @property
    def fraction(self) -> Array | None:
        """Part of the gap that oil fills, shape (nx, ny); None where it is not carried."""
        if self.carried is None:
            return None
        full = self.flow.coefficients.density * self.thickness
        return np.where(self.carried.filled, 1.0, np.clip(self.carried.mass / full, 0.0, 1.0))


@dataclass(frozen=True)
class Carried:
    """Oil that is carried through cavities of a stationary film.

    Attributes
    ----------
    supply : Supply
        Oil at the inlet edge and order of the wedge term.
    filled : ndarray of bool, shape (nx, ny)
        Nodes that oil fills, those of the inlet edge among them.
    mass : ndarray, shape (nx, ny), or float
        Mass of oil at the nodes.
    """

    supply: Supply
    filled: Mask
    mass: Array | float = 0.0

    @property
    def hollow(self) -> Mask:
        """Cavitated nodes (nx, ny) from which oil flows to a filled node on their line."""
        ahead = np.logical_or.accumulate(self.filled[::-1], axis=0)[::-1]
        hollow: Mask = ~self.filled & ahead
        return hollow

    def on(self, level: Level) -> Carried:
        """Filled nodes and supply on the next coarser grid, for its equations only."""
        filled = level.inject(self.filled.astype(float)) > 1.0 - 1e-9
        return Carried(self.supply.injected(level), filled)


def own_compliance(level: Level) -> float:
    """Deflection at a node by a unit pressure there and the opposite one at its neighbour along x."""
    influence = level.deflection.influence
    return float(influence[0, 0] - influence[1, 0])


@dataclass(frozen=True)
class Asperities:
    """Boundary film and hardness of asperities that touch.

    Attributes
    ----------
    boundary_film : float
        Thickness H_s of the boundary film, dimensionless, > 0.
    hardness : float
        Largest pressure P_y of nodes in contact, over p_h.
    """

    boundary_film: float
    hardness: float = np.inf


def contact_nodes(level: Level, state: State, boundary_film: float) -> Mask:
    """Mask of the nodes where the surfaces touch, shape (nx, ny).

    They are those where P_c - (H - H_s)/c > 0, with the compliance c of a node, as in a primal-dual active
    set method; the edges of the domain are never among them.
    """
    excess = state.contact_pressure - (state.thickness - boundary_film) / own_compliance(level)
    contact: Mask = (excess > 0.0) & level.mesh.inner
    return contact


def plastic_nodes(level: Level, state: State, asperities: Asperities, contact: Mask) -> Mask:
    """Mask of the nodes in contact whose asperities are flattened, shape (nx, ny)."""
    if np.isinf(asperities.hardness):
        return np.zeros(contact.shape, dtype=bool)
    sunk = (asperities.boundary_film - state.thickness) / own_compliance(level)
    plastic: Mask = contact & (state.pressure - asperities.hardness + sunk > 0.0)
    return plastic


def assess_touching(
    fluid: Fluid, level: Level, state: State, asperities: Asperities, carried: Carried | None = None
) -> Touching:
    """Residual of the film equations at a state whose surfaces may touch.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    level : Level
        Grid.
    state : State
        Pressure, contact pressure, H00 and film thickness.
    asperities : Asperities
        Boundary film and hardness.
    carried : Carried, optional
        Nodes that oil fills, and its supply, where the oil in cavities is carried.

    Returns
    -------
    Touching
        Residual of every equation, and their norms.
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
        carried, r = _filled_anew(level, at_faces, thickness, poiseuille, excess, carried)
        full_film, settled = carried.filled & mesh.inner, bool(np.array_equal(carried.filled, before))
    compliance = own_compliance(level)
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
        poiseuille=poiseuille,
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


def _filled_anew(
    level: Level, at_faces: Flow, thickness: Array, poiseuille: Array, excess: Array, carried: Carried
) -> tuple[Carried, Array]:
    """Oil carried with the nodes that it fills at a state, and the rows (nx, ny) of the filled nodes."""
    full = at_faces.coefficients.density * thickness
    carried = replace(carried, supply=carried.supply.bounded(full))
    r, mass = carried_rows(level, at_faces, thickness, carried)
    surplus = ((1.0 + OVERFLOW) * full - mass) / level.mesh.dx
    moved = full_film_nodes(
        excess + TENSION * carried.filled,
        np.where(carried.filled, r, surplus),
        poiseuille=poiseuille,
        rate=level.rate,
        thickness=thickness,
        inner=level.mesh.inner,
    )
    moved[0] = True
    if not np.array_equal(moved, carried.filled):
        carried = replace(carried, filled=moved)
        r, mass = carried_rows(level, at_faces, thickness, carried)
    return replace(carried, mass=mass), r


def carried_rows(level: Level, at_faces: Flow, thickness: Array, carried: Carried) -> tuple[Array, Array]:
    """Rows of the filled nodes, zero elsewhere, and the mass of the carried oil, both (nx, ny)."""
    runs, filled = Runs.of(carried.filled), carried.filled
    rows = unreduced(level, at_faces, thickness, filled, carried.supply)
    full = at_faces.coefficients.density * thickness
    mass = carried.supply.at_rupture(filled, content(runs, rows, full, level.mesh.dx))
    return np.where(filled & level.mesh.inner, runs.reduced(rows), 0.0), mass


def projected(fluid: Fluid, state: State, contact: Mask) -> State:
    """State whose contact pressure is nowhere negative, and zero where the surfaces do not touch.

    The sum of both pressures, on which the gap depends, remains. Where the surfaces touch, the pressure of
    the oil lies between ambient pressure and this sum.
    """
    ambient = fluid.ambient_pressure
    oil = np.where(contact, np.clip(state.oil_pressure, ambient, state.pressure), state.pressure)
    return State(state.pressure, state.h00, state.thickness, state.pressure - oil)
