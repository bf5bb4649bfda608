"""Asperities that touch in a transient contact: at one instant of the solution, and over a stored run."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.contact import Spots, load_share_of
from ehlectric.field import areas_by_zone
from ehlectric.film import Mesh, State
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.stored import AREA_SHARE, COARSE_SHARE, LOAD_SHARE, SPOTS
from ehlectric.motion.stored_run import MotionRun


@dataclass(frozen=True)
class Touch:
    """Asperities at one instant."""

    load_share: float = 0.0
    # Part of the area of the dry smooth contact in which the surfaces touch, from 0 to 1
    area_share: float = 0.0
    spots: int = 0


class Toucher:
    """Asperities of the instants of a transient contact on one mesh."""

    def __init__(self, contact: TransientContact, mesh: Mesh) -> None:
        self._contact, self._mesh = contact, mesh

    @cached_property
    def _axes(self) -> tuple[Array, ...]:
        length, mesh = self._contact.problem.scales.length, self._mesh
        return (length * mesh.x, length * mesh.whole_y)[: len(self._contact.kind.axes)]

    @cached_property
    def _zone(self) -> Array:
        """Part of each node in the area of the Hertz zone, in sum one."""
        zone = areas_by_zone(self._axes, self._contact.conditions.semi_axes)["hertz"]
        return zone / np.sum(zone)

    def at(self, state: State) -> Touch:
        """Asperities of a film."""
        if not state.touching.any():
            return Touch()
        whole = np.broadcast_to(state.contact_pressure, state.pressure.shape)
        pressure = self._contact.kind.shaped(self._mesh, self._contact.problem.scales.pressure * whole)
        touching = pressure > 0.0
        spots = Spots.of(self._axes, touching, pressure)
        return Touch(
            load_share=load_share_of(self._contact.conditions, spots),
            area_share=float(np.sum(self._zone[touching])),
            spots=spots.number,
        )


@dataclass(frozen=True)
class TouchHistory:
    """Asperities over the time steps of a run."""

    time: Array  # [s], shape (steps,)
    # load_share, area_share and spots: values of ``Touch``, shape (steps,).
    load_share: Array
    area_share: Array
    spots: Array
    # Load share in the coarse run; NaN between its steps, where it has no film, and where a file
    # has no such variable, as nothing touched, shape (steps,).
    coarse_share: Array
    # Steps that count for statistics: those from which on the roughness fills the contact, shape (steps,).
    counted: Mask
    filled: bool = True  # whether it fills the contact at all; in a shorter run all steps count

    @classmethod
    def of(cls, run: MotionRun) -> TouchHistory | None:
        """Asperities of a run; None where its surfaces touch at no time step."""
        history = cls.whole(run)
        return history if np.any(history.spots) else None

    @classmethod
    def whole(cls, run: MotionRun) -> TouchHistory:
        """Asperities of a run, with shares of zero where its surfaces touch at no time step."""
        time, stored = run.values("time"), SPOTS in run.dataset
        none = np.zeros(time.shape)
        late = time >= run.field_history.settled_from
        return cls(
            time=time,
            load_share=run.values(LOAD_SHARE) if stored else none,
            area_share=run.values(AREA_SHARE) if stored else none,
            spots=run.values(SPOTS) if stored else none,
            coarse_share=run.values(COARSE_SHARE) if stored else np.full_like(none, math.nan),
            counted=late if np.any(late) else np.ones_like(late),
            filled=bool(np.any(late)),
        )

    @property
    def steps(self) -> int:
        """Number of time steps that count."""
        return int(np.count_nonzero(self.counted))

    @property
    def mean_share(self) -> float:
        """Mean load share of the steps that count."""
        return float(np.mean(self.load_share[self.counted]))

    @property
    def time_share(self) -> float:
        """Share of the steps that count with at least one spot, from 0 to 1."""
        return float(np.mean(self.spots[self.counted] > 0.0))

    @property
    def coarser(self) -> float | None:
        """Mean load share of the coarse run at its steps that count; None if it lacks one of them."""
        steps = self._coarser_steps
        return None if steps is None else float(np.mean(self.coarse_share[steps]))

    @property
    def share_change(self) -> float:
        """Change of the mean load share from the coarse run, at the same steps; NaN if unknown."""
        steps = self._coarser_steps
        if steps is None:
            return math.nan
        return float(np.mean(self.load_share[steps]) - np.mean(self.coarse_share[steps]))

    @property
    def _coarser_steps(self) -> Mask | None:
        steps: Mask = self.counted & (np.arange(self.time.size) % 2 == 0)
        return steps if np.any(steps) and np.all(np.isfinite(self.coarse_share[steps])) else None
