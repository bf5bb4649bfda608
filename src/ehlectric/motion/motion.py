"""Roughness that moves with its surface through a contact: where it is at a time, and how long it moves.

At first all of what moves lies outside the domain, so that the film is that of the surfaces at rest. What of
a surface lies at x in the case is at x - D + u t, with the length D of the domain and the speed u of the
surface: after the time D/u it lies as the case has it. What is ahead of that, on the far side of the contact
in the case, never was: the roughness begins with a front, which rises over one half-width.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.bodies import surface_ratios
from ehlectric.contact.conditions import Conditions, PointConditions, resolve, resolve_point
from ehlectric.contact.problems import domain_of, film_problem, line_domain_of, point_film_problem
from ehlectric.errors import InputError
from ehlectric.film.problem import FilmProblem
from ehlectric.film.unsteady import MOST_COURANT
from ehlectric.surfaces.rough_maps import RoughMap, rough_maps
from ehlectric.surfaces.rough_profiles import RoughSurface, rough_surfaces

# Speed of a surface, over the mean speed, below which it counts as at rest.
_AT_REST = 1e-9


@dataclass(frozen=True)
class Course:
    """How long and in which steps surfaces move.

    Attributes
    ----------
    end : float
        T at the end, of T = t u/b with the mean speed u and the half-width b.
    steps : int
        Equal time steps.
    courant : float
        Grid spacings that the mean speed travels in one of them.
    recorded : ndarray of int
        Steps whose instants are kept, from 0 to ``steps``.
    time : float
        b/u [s], the time of T = 1.
    """

    end: float
    steps: int
    courant: float
    recorded: Array
    time: float

    @property
    def step(self) -> float:
        """Time step, of T."""
        return self.end / self.steps


class Motion:
    """A contact whose roughness moves, ready to be solved in time.

    Parameters
    ----------
    case : Case
        With ``motion`` and roughness, a line or a point contact.

    Raises
    ------
    InputError
        Where a surface cannot be made, nothing rough moves, or the steps are too long.
    """

    def __init__(self, case: Case) -> None:
        if case.motion is None:
            raise InputError.worded("motion", "missing, a case whose roughness moves takes it")
        self.case = case
        point = case.contact.geometry == "point"
        self.conditions: Conditions | PointConditions = resolve_point(case) if point else resolve(case)
        self.course = _course(case, self.conditions)
        self.rough = self._surfaces()
        if np.isfinite(self.coincident):
            alike = round(self.coincident / self.course.step)
            self.course = replace(self.course, recorded=np.union1d(self.course.recorded, [alike]))
        if not self._speeds:
            raise InputError(
                "motion",
                got="roughness on surfaces at rest alone;",
                takes="it on one that moves, or a case without motion",
            )

    @property
    def half_width(self) -> float:
        """b, of a point contact the semi-axis along entrainment [m]."""
        return self.conditions.half_width

    @property
    def domain(self) -> float:
        """Length D of the domain, of X."""
        return self.case.grid.outlet - self.case.grid.inlet

    def speed_of(self, surface: int) -> float:
        """Speed of a surface over the mean speed; 0 where it is at rest."""
        speed = surface_ratios(self.conditions.slide_to_roll_ratio)[surface - 1]
        return speed if abs(speed) > _AT_REST else 0.0

    @property
    def _speeds(self) -> list[float]:
        """Speeds of the rough surfaces that move, over the mean speed."""
        speeds = [self.speed_of(surface.surface) for surface in self.rough]
        return [speed for speed in speeds if speed]

    @property
    def covered(self) -> float:
        """T from which the roughness that moves fills the Hertz zone; infinite where it does not in time."""
        grid = self.case.grid
        # The front has risen over one half-width.
        ways = [2.0 - grid.inlet if speed > 0.0 else grid.outlet + 2.0 for speed in self._speeds]
        latest = max(
            (way / abs(speed) for way, speed in zip(ways, self._speeds, strict=True)), default=np.inf
        )
        return latest if latest <= self.course.end else np.inf

    @property
    def coincident(self) -> float:
        """T at which all that moves lies as the case has it; infinite where it does not, or not together."""
        speeds = sorted(map(abs, self._speeds))
        if not speeds or speeds[-1] - speeds[0] > _AT_REST * speeds[-1]:
            return np.inf
        time = self.domain / speeds[0]
        return time if time <= self.course.end * (1.0 + _AT_REST) else np.inf

    @cached_property
    def reached(self) -> Case:
        """The case with a domain as long as its surfaces travel."""
        grid = self.case.grid
        ends = [grid.inlet, grid.outlet]
        for speed in {self.speed_of(table.surface) for table in self.case.roughness}:
            beyond = max(0.0, abs(speed) * self.course.end - self.domain)
            if speed > 0.0:
                ends[0] = min(ends[0], grid.inlet - beyond)
            else:
                ends[1] = max(ends[1], grid.outlet + beyond)
        # As fine as the grid of the case, and no finer across.
        nodes = 1 + int(np.ceil((grid.nodes - 1) * (ends[1] - ends[0]) / self.domain - _AT_REST))
        longer = grid.model_copy(update={"inlet": ends[0], "outlet": ends[1], "nodes": nodes})
        if self.case.contact.geometry == "point":
            longer = longer.model_copy(update={"nodes_y": grid.nodes_across})
        return self.case.model_copy(update={"grid": longer})

    def _surfaces(self) -> Sequence[RoughSurface] | Sequence[RoughMap]:
        """The rough surfaces, made as far as they travel."""
        case = self.reached
        if isinstance(self.conditions, PointConditions):
            return rough_maps(case.roughness, domain_of(case, self.conditions))
        return rough_surfaces(case.roughness, line_domain_of(case, self.conditions))

    def described(self) -> dict[str, Any]:
        """How long and in which steps it moves, SI units; None where a time never comes."""
        course = self.course
        moments = {"covered_from": self.covered, "coincident": self.coincident}
        return {
            "duration": course.end * course.time,
            "steps": course.steps,
            "courant": course.courant,
            "frames": int(course.recorded.size),
            "speed_ratio_1": self.speed_of(1),
            "speed_ratio_2": self.speed_of(2),
        } | {name: time * course.time if math.isfinite(time) else None for name, time in moments.items()}

    @cached_property
    def problem(self) -> FilmProblem:
        """The film equations with the roughness of surfaces at rest alone."""
        if isinstance(self.conditions, PointConditions):
            maps = [surface for surface in self.rough if isinstance(surface, RoughMap)]
            resting = [surface for surface in maps if not self.speed_of(surface.surface)]
            problem = point_film_problem(self.case, self.conditions, resting)
            whole = point_film_problem(self.reached, self.conditions, maps)
            return replace(problem, width=whole.width)
        lines = [surface for surface in self.rough if isinstance(surface, RoughSurface)]
        resting_lines = [surface for surface in lines if not self.speed_of(surface.surface)]
        return film_problem(self.case, self.conditions, resting_lines)

    def heights(self, time: float, *axes: Array) -> Array:
        """Roughness of both surfaces at a time.

        Parameters
        ----------
        time : float
            T.
        *axes : ndarray
            X, and of a point contact Y, in half-widths along entrainment.

        Returns
        -------
        ndarray, shape (2, nx) or (2, nx, ny)
            Positive out of the body [m].
        """
        heights = np.zeros((2, *(axis.size for axis in axes)))
        for surface in self.rough:
            heights[surface.surface - 1] += self._height(surface, time, *axes)
        return heights

    def moving_gap(self, time: float, x: Array, y: Array) -> Array:
        """What the surfaces that move add to the dimensionless gap, X (nx,), Y (ny,) -> (nx, ny)."""
        moved = [surface for surface in self.rough if self.speed_of(surface.surface)]
        axes = (x, y) if isinstance(self.conditions, PointConditions) else (x,)
        heights = np.sum([self._height(surface, time, *axes) for surface in moved], axis=0)
        gap: Array = -heights.reshape(x.size, y.size) / self.conditions.thickness_scale
        return gap

    def _height(self, surface: RoughSurface | RoughMap, time: float, x: Array, *others: Array) -> Array:
        speed, b = self.speed_of(surface.surface), self.half_width
        if not speed:
            return surface.height(b * x, *(b * other for other in others))
        travelled = speed * time - np.sign(speed) * self.domain
        front = (self.case.grid.outlet if speed > 0.0 else self.case.grid.inlet) + travelled
        behind = np.clip((front - x) * np.sign(speed), 0.0, 1.0)
        here = np.flatnonzero(behind > 0.0)
        height = np.zeros((x.size, *(other.size for other in others)))
        if here.size:
            rise = np.sin(0.5 * np.pi * behind[here]) ** 2
            there = surface.height(b * (x[here] - travelled), *(b * other for other in others))
            height[here] = there * rise.reshape(-1, *(1 for _ in others))
        return height


def _fastest(case: Case, conditions: Conditions | PointConditions) -> float:
    """Speed of the fastest rough surface over the mean speed."""
    ratios = surface_ratios(conditions.slide_to_roll_ratio)
    return max(abs(ratios[table.surface - 1]) for table in case.roughness)


def _course(case: Case, conditions: Conditions | PointConditions) -> Course:
    assert case.motion is not None
    motion, grid = case.motion, case.grid
    time = conditions.half_width / conditions.entrainment_speed
    length = grid.outlet - grid.inlet
    end = motion.passes * length if motion.passes is not None else (motion.duration or 0.0) / time
    spacing = length / (grid.nodes - 1)
    steps = motion.steps or round(end / spacing)
    if not steps:
        raise InputError(
            f"motion.{'duration' if motion.passes is None else 'passes'}",
            got=f"{end * time:.3g} s, in which oil travels less than a grid spacing;",
            takes=f"at least {spacing * time:.3g} s",
        )
    if motion.steps is None:
        # As long as the grid spacing: then the feet of the lines on which oil travels are nodes. Of surfaces
        # that move some times as fast a whole part of it, for them to travel about a spacing too.
        end = steps * spacing
        steps *= max(1, math.ceil(_fastest(case, conditions) - 0.5))
    courant = end / steps / spacing
    if courant > MOST_COURANT * (1.0 + 1e-9):
        least = int(np.ceil(end / spacing / MOST_COURANT))
        raise InputError(
            "motion.steps",
            got=f"{steps}, in each of which oil would travel {courant:.3g} grid spacings;",
            takes=f"at least {least}, and {round(end / spacing)} for one spacing a step",
        )
    recorded = np.unique(np.round(np.linspace(0, steps, min(motion.record, steps + 1))).astype(int))
    return Course(end, steps, courant, recorded, time)
