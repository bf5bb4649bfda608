"""Solve a contact whose roughness moves: its film step by step, its field at the instants that are kept."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.problems import field_problem, point_field_problem
from ehlectric.errors import ConvergenceError
from ehlectric.field.line import Field, solve_field
from ehlectric.field.point import PointField, solve_point_field
from ehlectric.film.line import Film, pressure_of, quiet_solution
from ehlectric.film.nested import nested_iteration
from ehlectric.film.point import PointFilm, semi_axis_across
from ehlectric.film.state import Progress
from ehlectric.film.unsteady import History, Instant, UnsteadyFilm
from ehlectric.motion.motion import Motion


@dataclass(frozen=True)
class Snapshot:
    """A contact at one instant, SI units.

    Attributes
    ----------
    time : float
        [s] since the roughness began to enter.
    film : Film or PointFilm
        As of a contact at rest; its error estimate is None.
    roughness : ndarray, shape (2, nx) or (2, nx, ny)
        Heights of both surfaces at the film's nodes, positive out of the body [m].
    field : Field or PointField
        Its electric field, which follows the gap at once.
    """

    time: float
    film: Film
    roughness: Array
    field: Field | PointField


class MovingContact:
    """A contact whose roughness moves, as it is solved.

    Parameters
    ----------
    motion : Motion
        What moves.
    """

    def __init__(self, motion: Motion) -> None:
        self.motion = motion
        self._film = UnsteadyFilm(motion.problem, motion.moving_gap)

    def start(self, progress: Progress | None = None) -> History:
        """The film before anything that moves has come, from which all begins.

        Raises
        ------
        ConvergenceError
            Where it is not found.
        """
        with quiet_solution():
            steady = nested_iteration(self.motion.problem, progress)[-1]
        if steady.status != "converged":
            raise ConvergenceError(f"film before the motion {steady.status}")
        return self._film.start(steady, self.motion.course.step)

    def run(self, history: History, done: int = 0) -> Iterator[tuple[int, History]]:
        """Step after step, from one that is done to the last.

        Yields
        ------
        int, History
            The number of the step, and the film then.

        Raises
        ------
        ConvergenceError
            Where a step is not solved, however often it is halved.
        """
        for step in range(done + 1, self.motion.course.steps + 1):
            with quiet_solution():
                try:
                    history = self._film.advance(history, self.motion.course.step)
                except ConvergenceError as error:
                    raise ConvergenceError(f"step {step} of {self.motion.course.steps}: {error}") from None
            yield step, history

    def snapshot(self, instant: Instant) -> Snapshot:
        """Film and field at an instant."""
        conditions = self.motion.conditions
        film = self.film(instant)
        b = self.motion.half_width
        axes = (film.x / b, film.y / b) if isinstance(film, PointFilm) else (film.x / b,)
        roughness = self.motion.heights(instant.time, *axes)
        field: Field | PointField
        if isinstance(conditions, PointConditions):
            assert isinstance(film, PointFilm)
            field = solve_point_field(point_field_problem(self.motion.case, conditions, film, roughness))
            field = field.mirrored() if field.y[0] == 0.0 else field
        else:
            assert isinstance(conditions, Conditions)
            field = solve_field(field_problem(self.motion.case, conditions, film, roughness))
        return Snapshot(instant.time * self.motion.course.time, film, roughness, field)

    def extremes(self, instant: Instant) -> tuple[float, tuple[float, ...], float]:
        """Smallest film thickness [m] with its place [m], and the largest pressure [Pa], without the rest."""
        mesh, scales = self._film.level.mesh, self.motion.problem.scales
        thickness = self._shaped(scales.thickness * instant.state.thickness)
        place = np.unravel_index(int(np.argmin(thickness)), thickness.shape)
        axes = (scales.length * mesh.x, scales.length * mesh.whole_y)[: thickness.ndim]
        highest = np.max(pressure_of(scales, instant.state, instant.full_film))
        where = tuple(float(axis[k]) for axis, k in zip(axes, place, strict=True))
        return float(np.min(thickness)), where, float(highest)

    def _shaped(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values (nx, ny) in the shape that they have in the film."""
        point = isinstance(self.motion.conditions, PointConditions)
        return self._film.level.mesh.mirrored(values) if point else values[:, 0]

    def film(self, instant: Instant) -> Film:
        """The film at an instant in SI units."""
        level, scales, state = self._film.level, self.motion.problem.scales, instant.state
        mesh, shaped = level.mesh, self._shaped
        load = float(np.vdot(level.weights, state.pressure))
        film: dict[str, Any] = {
            "x": scales.length * mesh.x,
            "pressure": shaped(pressure_of(scales, state, instant.full_film)),
            "thickness": shaped(scales.thickness * state.thickness),
            "deflection": shaped(scales.thickness * level.deflection(state.pressure)),
            "density": shaped(instant.density),
            "cavitated": shaped(~instant.full_film),
            "reynolds_residual": shaped(np.zeros(mesh.shape)),
            "scales": scales,
            "status": "converged",
            "residual": 0.0,
            "load_residual": abs(load / level.load - 1.0),
            "newton_iterations": 0,
            "steps": (),
            "discretisation_error": None,
            "inlet_deficit": 0.0,
        }
        if not isinstance(self.motion.conditions, PointConditions):
            return Film(**film)
        return PointFilm(
            **film,
            y=scales.length * mesh.whole_y,
            semi_axis_y=semi_axis_across(self.motion.problem),
            side_deficit=0.0,
        )
