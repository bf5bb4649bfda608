"""Solver of a transient contact: films at all time steps, and electric fields at single instants."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.errors import ConvergenceError
from ehlectric.field import Field, PointField
from ehlectric.film import (
    Film,
    FilmSolution,
    Gap,
    History,
    Instant,
    MovingFilm,
    PointFilm,
    meniscus_of,
    pressure_of,
)
from ehlectric.motion.coarse_run import KeyFilms
from ehlectric.motion.motion_touching import Touch, Toucher
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.runtime.threads import quiet_solution


@dataclass(frozen=True)
class Snapshot:
    """Film, roughness and field of a contact at one instant, SI units."""

    time: float  # time since the roughness began to enter [s]
    film: Film | PointFilm  # film at this instant, without an error estimate
    # Heights of both surfaces at the film's nodes, positive out of the body [m], shape (2, nx) or
    # (2, nx, ny).
    roughness: Array
    # Electric field, computed for the gap at this instant as in a stationary contact.
    field: Field | PointField
    temperature: Array | None = None  # temperature at mid-film [K], at the nodes; None without heat


@dataclass(frozen=True)
class Extremes:
    """Minimum film thickness with its position, and largest pressure, at one instant."""

    minimum_thickness: float  # minimum film thickness [m]
    minimum_position: tuple[float, ...]  # position along each axis of the node where the film is thinnest [m]
    max_pressure: float  # largest pressure [Pa]


class TransientSolver:
    """Solver of a contact with moving roughness."""

    def __init__(self, contact: TransientContact) -> None:
        self.contact = contact
        self._moving = MovingFilm(contact.problem, contact.moving_gap)

    def start(self) -> History:
        """Stationary film before any moving roughness has entered: the initial condition of the run."""
        return self._moving.start(self.contact.schedule.step)

    def run(self, history: History, done: int = 0) -> Iterator[tuple[int, History]]:
        """Solve the time steps after step ``done``: the number of each step, and the last two films after it.

        Raises a ConvergenceError if a time step does not converge, even after it was halved several times.
        """
        schedule = self.contact.schedule
        for step in range(done + 1, schedule.steps + 1):
            with quiet_solution():
                try:
                    history = self._moving.film.advance(history, schedule.step)
                except ConvergenceError as error:
                    raise ConvergenceError(f"step {step} of {schedule.steps}: {error}") from None
            yield step, history

    def snapshot(self, instant: Instant) -> Snapshot:
        """Film, roughness and field at an instant, SI units."""
        contact, kind = self.contact, self.contact.kind.contact
        film = self.film(instant)
        axes = [position / contact.half_width for position in film.axes]
        roughness = contact.roughness.heights(instant.time, *axes)
        field = kind.solve_field(kind.field_problem(contact.case, contact.conditions, film, roughness))
        warmth = instant.warmth
        mesh = self._moving.film.level.mesh
        temperature = None if warmth is None else contact.kind.shaped(mesh, warmth.middle)
        return Snapshot(instant.time * contact.schedule.time, film, roughness, field, temperature)

    def extremes(self, instant: Instant) -> Extremes:
        """Minimum film thickness and largest pressure; unlike ``film``, no deflection is computed."""
        mesh, scales = self._moving.film.level.mesh, self.contact.problem.scales
        thickness = self.contact.kind.shaped(mesh, scales.thickness * instant.state.thickness)
        place = np.unravel_index(int(np.argmin(thickness)), thickness.shape)
        axes = (scales.length * mesh.x, scales.length * mesh.whole_y)[: thickness.ndim]
        return Extremes(
            minimum_thickness=float(np.min(thickness)),
            minimum_position=tuple(float(axis[k]) for axis, k in zip(axes, place, strict=True)),
            max_pressure=float(np.max(pressure_of(scales, instant.state, instant.full_film))),
        )

    def key_films(self, instant: Instant) -> KeyFilms:
        """Film thicknesses of an instant that are compared with the coarse run."""
        mesh, scale = self._moving.film.level.mesh, self.contact.problem.scales.thickness
        return KeyFilms.of(mesh, instant, scale)

    def touch(self, instant: Instant) -> Touch:
        """Asperities at an instant."""
        return self._toucher.at(instant.state)

    @cached_property
    def _toucher(self) -> Toucher:
        return Toucher(self.contact, self._moving.film.level.mesh)

    def film(self, instant: Instant) -> Film | PointFilm:
        """Film at an instant, SI units."""
        moving = self._moving
        whole = moving.whole(instant)
        fraction = None if moving.layer is None else instant.oil_fraction
        level, contact = moving.steady.level, self.contact
        scales, state, mesh = contact.problem.scales, whole.state, level.mesh

        def shaped(values: NDArray[Any]) -> NDArray[Any]:
            return contact.kind.shaped(mesh, values)

        load = Gap(level, state.thickness).load(state.pressure)
        solution = FilmSolution(
            x=scales.length * mesh.x,
            pressure=shaped(pressure_of(scales, state, whole.full_film)),
            thickness=shaped(scales.thickness * state.thickness),
            deflection=shaped(scales.thickness * level.deflection(state.pressure)),
            density=shaped(whole.density),
            cavitated=shaped(~whole.full_film & ~state.touching),
            contact_pressure=(
                shaped(scales.pressure * np.asarray(state.contact_pressure)) if state.touching.any() else None
            ),
            scales=scales,
            status="converged",
            load_residual=abs(load / level.load - 1.0),
            film_fraction=None if fraction is None else shaped(fraction),
        )
        film: Film | PointFilm = contact.kind.film(solution, contact.problem, mesh)
        return film

    def temperature_rise(self, instant: Instant) -> float | None:
        """Largest temperature at mid-film above the temperature of the oil in the inlet [K]; None without
        heat.
        """
        physics, warmth = self.contact.problem.physics, instant.warmth
        if warmth is None or physics is None or physics.thermal is None:
            return None
        return float(np.max(warmth.middle)) - physics.thermal.inlet_temperature

    def meniscus(self, instant: Instant) -> float:
        """Position on the line y = 0 from which oil fills the gap [m]; NaN if the inlet is flooded."""
        if self._moving.layer is None:
            return math.nan
        meniscus = meniscus_of(self._moving.film.level.mesh, instant.full_film)
        return math.nan if meniscus is None else self.contact.problem.scales.length * meniscus
