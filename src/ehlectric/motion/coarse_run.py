"""Coarse run: the same motion on every second node with steps twice as long, for an estimate of the
error.

It is solved step by step with the run. It takes about a fifth of the time of the run: it has half the steps,
each with half the nodes of a line contact or a quarter of the nodes of a point contact.
``ehlectric.motion.summary`` compares the two films.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from ehlectric.errors import ConvergenceError
from ehlectric.film import History, Instant, Mesh, MovingFilm, at_centre, lowest
from ehlectric.motion.motion_touching import Toucher
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.runtime.threads import quiet_solution

# Number of steps of the run in a step of the coarse run.
STRIDE = 2


@dataclass(frozen=True)
class KeyFilms:
    """Film thicknesses and load share of asperities by which a run is compared with its coarse run."""

    # Minimum film thickness between the nodes [m]; NaN where the coarse run has no film.
    lowest: float = math.nan
    # Film thickness at the centre of the contact [m]; NaN where the coarse run has no film.
    central: float = math.nan
    # Part of the load that asperities carry; NaN where the coarse run has no film.
    load_share: float = math.nan

    @classmethod
    def of(cls, mesh: Mesh, instant: Instant, scale: float, load_share: float = math.nan) -> KeyFilms:
        """Key film thicknesses of an instant on its mesh, from the scale of the film thickness [m]."""
        thickness = instant.state.thickness
        return cls(scale * lowest(mesh, thickness), scale * at_centre(mesh, thickness), load_share)


class CoarseRun:
    """Run on every second node with steps twice as long, advanced together with its run.

    Its steps end with every second step of the run. A run whose coarse run does not converge goes on without
    it, and its error is unknown.
    """

    def __init__(self, contact: TransientContact) -> None:
        self._step = STRIDE * contact.schedule.step
        self._scale = contact.problem.scales.thickness
        self._contact = contact
        self._moving = MovingFilm(contact.problem.halved(), contact.moving_gap)

    def start(self) -> History | None:
        """Stationary film before the motion; None where it does not converge."""
        try:
            return self._moving.start(self._step)
        except ConvergenceError:
            # The run itself goes on; the summary says that its error is unknown.
            return None

    def resumed(self, history: History | None, done: int) -> History | None:
        """Films from which the coarse run goes on after step ``done`` of the run.

        None where the stored films belong to an earlier step: the coarse run had not converged since.
        """
        if history is None:
            return None
        steps = history.now.time / self._step
        return history if round(steps) == done // STRIDE else None

    def after(self, step: int, history: History | None) -> History | None:
        """Films of the coarse run after a step of the run, from its ``history`` before.

        Between two steps of the coarse run its films are returned unchanged. None if the coarse run does not
        converge, now or before.
        """
        if history is None or step % STRIDE:
            return history
        with quiet_solution():
            try:
                return self._moving.film.advance(history, self._step)
            except ConvergenceError:
                # The run itself goes on; the summary says that its error is unknown.
                return None

    def films(self, step: int, history: History | None) -> KeyFilms:
        """Key film thicknesses after a step of the run; NaN between two steps and without a film."""
        if history is None or step % STRIDE:
            return KeyFilms()
        share = self._toucher.at(history.now.state).load_share
        return KeyFilms.of(self._moving.film.level.mesh, history.now, self._scale, share)

    @cached_property
    def _toucher(self) -> Toucher:
        return Toucher(self._contact, self._moving.film.level.mesh)
