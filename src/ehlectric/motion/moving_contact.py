"""Transient contact: conditions, time steps, moving surfaces, film equations, and the kinds line and point.

Time is dimensionless, T = t u/b, and positions are in half-widths, X = x/b. Here u is the entrainment speed,
the mean speed of the surfaces, and b is the half-width. At T = 0 all moving roughness lies outside the
domain. A point at x in the case is at x - D + u_k t at the time t. Here D is the length of the domain, and
u_k is the speed of its surface. At the time D/u_k the point is at its position in the case. If u_k is
negative, the point is at x + D + u_k t. Roughness that lies beyond the far end of the domain in the case is
ignored. Moving roughness therefore begins with a front, behind which its height rises from zero over one
half-width.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import zip_longest
from typing import Any, Literal

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact import LINE as LINE_CONTACT
from ehlectric.contact import POINT as POINT_CONTACT
from ehlectric.contact import AnyKind, Conditions, PointConditions, domain_of, physics_of, surface_ratios
from ehlectric.errors import InputError
from ehlectric.field import Field, PointField
from ehlectric.film import MOST_COURANT, Film, FilmProblem, FilmSolution, Mesh, PointFilm, semi_axis_across
from ehlectric.surfaces.rough_surfaces import RoughMap, RoughSurface

# A surface is at rest below this speed divided by the entrainment speed. It is also the relative tolerance of
# comparisons of times and speeds.
_AT_REST = 1e-9


@dataclass(frozen=True)
class Schedule:
    """Time steps of a transient contact and the speeds of its surfaces.

    Examples
    --------
    A bump on surface 1 in pure rolling. The domain, -4 to 2 half-widths, has 64 grid intervals:

    >>> from ehlectric.contact.conditions import resolve
    >>> contact = {"reduced_radius": "14 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "0.5 GPa", "entrainment_speed": "4 m/s"}
    >>> bump = {"surface": 1, "generator": "asperity", "height": "50 nm", "width": "60 um"}
    >>> tables = {"contact": contact, "lubricant": {"base": "paper"}, "roughness": [bump]}
    >>> case = Case.from_dict(tables | {"grid": {"nodes": 65}, "motion": {"passes": 2.0}})
    >>> schedule = schedule_of(case, resolve(case))
    >>> schedule.steps, schedule.end, schedule.coincident
    (128, 12.0, 6.0)
    """

    end: float  # duration T, dimensionless
    steps: int  # number of time steps, all of the same length
    courant: float  # distance travelled at the entrainment speed in one time step [grid spacings]
    recorded: Array  # numbers of the time steps that are recorded, from 0 to ``steps``, shape (n,)
    time: float  # unit of time b/u, which corresponds to T = 1 [s]
    domain: tuple[float, float]  # inlet and outlet of the film's domain [half-widths]
    # Speeds of surfaces 1 and 2 divided by the entrainment speed; exactly 0 if a surface is at rest.
    speeds: tuple[float, float]
    rough: tuple[int, ...]  # numbers of the rough surfaces, 1 or 2, in ascending order

    @property
    def step(self) -> float:
        """Length of a time step, dimensionless."""
        return self.end / self.steps

    @property
    def length(self) -> float:
        """Length D of the domain [half-widths]."""
        inlet, outlet = self.domain
        return outlet - inlet

    def speed_of(self, surface: int) -> float:
        """Speed of surface 1 or 2 divided by the entrainment speed; exactly 0 if it is at rest."""
        return self.speeds[surface - 1]

    @property
    def moving_speeds(self) -> tuple[float, ...]:
        """Speeds of the moving rough surfaces divided by the entrainment speed."""
        return tuple(self.speed_of(surface) for surface in self.rough if self.speed_of(surface))

    @property
    def covered(self) -> float:
        """Time T from which moving roughness fills the Hertz zone; infinite if the run ends earlier."""
        inlet, outlet = self.domain
        # Distance from the end where the roughness enters to the far side of the zone, plus the half-width
        # over which the height rises behind the front.
        distances = [2.0 - inlet if speed > 0.0 else outlet + 2.0 for speed in self.moving_speeds]
        times = [way / abs(speed) for way, speed in zip(distances, self.moving_speeds, strict=True)]
        latest = max(times, default=np.inf)
        return latest if latest <= self.end else np.inf

    @property
    def coincident(self) -> float:
        """Time T at which all moving roughness is at its position in the case.

        Infinite if the run ends earlier, or if the rough surfaces move at different speeds.
        """
        speeds = sorted(map(abs, self.moving_speeds))
        if not speeds or speeds[-1] - speeds[0] > _AT_REST * speeds[-1]:
            return np.inf
        time = self.length / speeds[0]
        return time if time <= self.end * (1.0 + _AT_REST) else np.inf

    def moments(self) -> dict[str, float]:
        """Times ``covered_from`` and ``coincident``, without those that the run does not reach [s]."""
        times = {"covered_from": self.covered, "coincident": self.coincident}
        return {name: time * self.time for name, time in times.items() if math.isfinite(time)}

    def described(self) -> dict[str, Any]:
        """Duration, steps and speeds as in summary.json, SI units; None for times that are not reached."""
        moments = self.moments()
        return {
            "duration": self.end * self.time,
            "steps": self.steps,
            "courant": self.courant,
            "frames": int(self.recorded.size),
            "speed_ratio_1": self.speed_of(1),
            "speed_ratio_2": self.speed_of(2),
            "covered_from": moments.get("covered_from"),
            "coincident": moments.get("coincident"),
        }


def schedule_of(case: Case, conditions: Conditions | PointConditions) -> Schedule:
    """Time steps and speeds of a case with moving roughness.

    Raises an InputError if the case has no ``motion``, or all rough surfaces are at rest.
    """
    if case.motion is None:
        raise InputError.worded("motion", "missing; a case whose roughness moves needs it")
    schedule = _time_grid(case, conditions)
    if not schedule.moving_speeds:
        raise InputError(
            "motion",
            got="roughness only on surfaces at rest",
            takes="roughness on a surface that moves, or a case without motion",
        )
    if not np.isfinite(schedule.coincident):
        return schedule
    coincident = round(schedule.coincident / schedule.step)
    return replace(schedule, recorded=np.union1d(schedule.recorded, [coincident]))


def _time_grid(case: Case, conditions: Conditions | PointConditions) -> Schedule:
    assert case.motion is not None
    motion, grid = case.motion, case.grid
    ratios = surface_ratios(conditions.slide_to_roll_ratio)
    rough = tuple(sorted({table.surface for table in case.roughness}))
    time = conditions.half_width / conditions.entrainment_speed
    length = grid.length
    end = motion.passes * length if motion.passes is not None else (motion.duration or 0.0) / time
    spacing = length / (grid.nodes_along - 1)
    steps = motion.steps or round(end / spacing)
    if not steps:
        raise InputError(
            f"motion.{'duration' if motion.passes is None else 'passes'}",
            got=f"{end * time:.3g} s, in which oil travels less than a grid spacing;",
            takes=f"at least {spacing * time:.3g} s",
        )
    if motion.steps is None:
        # In each step the oil travels from one node to the next. A surface that is several times faster
        # should also travel about one grid spacing a step, by itself and relative to the oil, so each step is
        # divided by a whole number.
        end = steps * spacing
        speeds = [ratios[surface - 1] for surface in rough]
        fastest = max(max(abs(speed), abs(speed - 1.0)) for speed in speeds)
        steps *= max(1, math.ceil(fastest - 0.5))
    courant = end / steps / spacing
    if courant > MOST_COURANT * (1.0 + 1e-9):
        least = int(np.ceil(end / spacing / MOST_COURANT))
        raise InputError(
            "motion.steps",
            got=f"{steps}, in each of which oil would travel {courant:.3g} grid spacings;",
            takes=f"at least {least}, and {round(end / spacing)} for one spacing a step",
        )
    return Schedule(
        end=end,
        steps=steps,
        courant=courant,
        recorded=np.unique(np.round(np.linspace(0, steps, min(motion.record, steps + 1))).astype(int)),
        time=time,
        domain=grid.ends,
        speeds=(_moving(ratios[0]), _moving(ratios[1])),
        rough=rough,
    )


def _moving(speed: float) -> float:
    """Speed divided by the entrainment speed, with 0 instead of rounding errors."""
    return speed if abs(speed) > _AT_REST else 0.0


@dataclass(frozen=True)
class MovingRoughness:
    """Rough surfaces that move through a contact."""

    surfaces: Sequence[RoughSurface] | Sequence[RoughMap]  # rough surfaces, long enough for the whole run
    schedule: Schedule  # time steps and speeds of the surfaces
    half_width: float  # half-width b, in a point contact the semi-axis along entrainment [m]

    @property
    def moving(self) -> list[RoughSurface | RoughMap]:
        """Rough surfaces that move."""
        return [surface for surface in self.surfaces if self.schedule.speed_of(surface.surface)]

    @property
    def resting(self) -> list[RoughSurface | RoughMap]:
        """Rough surfaces at rest."""
        return [surface for surface in self.surfaces if not self.schedule.speed_of(surface.surface)]

    def heights(self, time: float, *axes: Array) -> Array:
        """Heights of both surfaces at the time T [m], positive out of the body, shape (2, nx) or (2, nx, ny).

        The axes are the positions X (nx,), and of a point contact also Y (ny,) [half-widths].
        """
        heights = np.zeros((2, *(axis.size for axis in axes)))
        for surface in self.surfaces:
            heights[surface.surface - 1] += self._height(surface, time, *axes)
        return heights

    def moving_height(self, time: float, *axes: Array) -> Array:
        """Sum of the heights of all moving surfaces at a time [m], shape (nx,) or (nx, ny)."""
        total: Array = np.sum([self._height(surface, time, *axes) for surface in self.moving], axis=0)
        return total

    def _height(self, surface: RoughSurface | RoughMap, time: float, x: Array, *others: Array) -> Array:
        speed, b = self.schedule.speed_of(surface.surface), self.half_width
        if not speed:
            return surface.height(b * x, *(b * other for other in others))
        inlet, outlet = self.schedule.domain
        travelled = speed * time - np.sign(speed) * self.schedule.length
        front = (outlet if speed > 0.0 else inlet) + travelled
        behind = np.clip((front - x) * np.sign(speed), 0.0, 1.0)
        here = np.flatnonzero(behind > 0.0)
        height = np.zeros((x.size, *(other.size for other in others)))
        if here.size:
            rise = np.sin(0.5 * np.pi * behind[here]) ** 2
            there = surface.height(b * (x[here] - travelled), *(b * other for other in others))
            height[here] = there * rise.reshape(-1, *(1 for _ in others))
        return height


@dataclass(frozen=True)
class Kind:
    """Functions of one kind of transient contact."""

    name: str  # geometry of the case, "line" or "point"
    # Names of the axes of a map: x along entrainment and, for a point contact, y across it.
    axes: tuple[str, ...]
    capacitance_unit: str
    contact: AnyKind  # functions of the stationary contact of the same kind
    # Values on the solver's mesh, shape (nx, ny), in the shape of the arrays of a film.
    shaped: Callable[[Mesh, NDArray[Any]], NDArray[Any]]
    # Film from its solution, the film equations and the mesh.
    film: Callable[[FilmSolution, FilmProblem, Mesh], Film | PointFilm]
    # Largest field strength across the film at its nodes [V/m]; NaN outside the field range.
    column_strength: Callable[[Any, Any], Array]


def _point_film(solution: FilmSolution, problem: FilmProblem, mesh: Mesh) -> PointFilm:
    y = problem.scales.length * mesh.whole_y
    return PointFilm.of(solution, y=y, semi_axis_y=semi_axis_across(problem))


def _line_column_strength(film: Film, field: Field) -> Array:
    return np.interp(film.x, field.x, field.column_strength, left=math.nan, right=math.nan)


def _point_column_strength(film: PointFilm, field: PointField) -> Array:
    between = scipy.interpolate.RegularGridInterpolator(
        (field.x, field.y), field.column_strength, bounds_error=False
    )
    strength: Array = between(np.stack(np.meshgrid(film.x, film.y, indexing="ij"), axis=-1))
    return strength


LINE = Kind(
    name="line",
    axes=("x",),
    capacitance_unit="F/m",
    contact=LINE_CONTACT,
    shaped=lambda _mesh, values: values[:, 0],
    film=lambda solution, _problem, _mesh: Film.of(solution),
    column_strength=_line_column_strength,
)
POINT = Kind(
    name="point",
    axes=("x", "y"),
    capacitance_unit="F",
    contact=POINT_CONTACT,
    shaped=lambda mesh, values: mesh.mirrored(values),
    film=_point_film,
    column_strength=_point_column_strength,
)
KINDS: dict[Literal["line", "point"], Kind] = {"line": LINE, "point": POINT}


# Tolerance for a whole number of grid intervals in the extended domain [grid intervals].
_ROUNDING = 1e-9


@dataclass(frozen=True)
class TransientContact:
    """Contact with moving roughness, ready to be solved in time steps."""

    case: Case
    conditions: Conditions | PointConditions
    schedule: Schedule  # time steps and speeds of the surfaces
    # Case whose domain is extended to the length of the surfaces that pass through the contact.
    travelled: Case
    roughness: MovingRoughness  # rough surfaces, generated or read for the extended domain

    @classmethod
    def of(cls, case: Case, rough: Sequence[RoughSurface | RoughMap] = ()) -> TransientContact:
        """Contact of a case, with its surfaces generated or read.

        Raises an InputError if ``schedule_of`` refuses the case, or a surface cannot be generated or read.
        """
        kind = KINDS[case.contact.geometry]
        conditions = kind.contact.resolve(case)
        schedule = schedule_of(case, conditions)
        travelled = travelled_case(case, schedule)
        domain = domain_of(travelled, conditions)
        surfaces: list[Any] = [
            kind.contact.rough([table], domain)[0] if surface is None or not table.is_measured else surface
            for table, surface in zip_longest(travelled.roughness, rough)
        ]
        roughness = MovingRoughness(surfaces, schedule, conditions.half_width)
        return cls(case, conditions, schedule, travelled, roughness)

    @property
    def kind(self) -> Kind:
        """Functions for this kind of contact, line or point."""
        return KINDS[self.case.contact.geometry]

    @property
    def half_width(self) -> float:
        """Half-width b [m]; for a point contact, the semi-axis along entrainment."""
        return float(self.conditions.half_width)

    @cached_property
    def problem(self) -> FilmProblem:
        """Film problem without moving roughness; the roughness of surfaces at rest is part of the gap."""
        film_problem = self.kind.contact.film_problem
        problem = film_problem(self.case, self.conditions, self.roughness.resting)
        # Half of a point contact suffices only if all roughness that passes is symmetric about y = 0.
        whole = film_problem(self.travelled, self.conditions, self.roughness.surfaces)
        # The scheme in time is of second order, and the film that it starts from must agree with it.
        physics = physics_of(self.case, self.conditions)
        if physics is not None and physics.plain:
            physics = None
        return replace(problem, width=whole.width, wedge_order=2, physics=physics)

    def moving_gap(self, time: float, x: Array, y: Array) -> Array:
        """Contribution of moving roughness to the dimensionless gap; peaks reduce the gap.

        It has the shape (nx, ny) at the time T and the positions X (nx,) and Y (ny,) [half-widths]. A line
        contact does not use Y.
        """
        heights = self.roughness.moving_height(time, *(x, y)[: len(self.kind.axes)])
        gap: Array = -heights.reshape(x.size, y.size) / self.conditions.thickness_scale
        return gap


def travelled_case(case: Case, schedule: Schedule) -> Case:
    """Case whose domain is extended to the length of the surfaces that pass through the contact.

    The grid spacing and the number of nodes across entrainment do not change.
    """
    grid, length = case.grid, schedule.length
    inlet, outlet = schedule.domain
    for surface in schedule.rough:
        speed = schedule.speed_of(surface)
        beyond = max(0.0, abs(speed) * schedule.end - length)
        if speed > 0.0:
            inlet = min(inlet, grid.ends[0] - beyond)
        else:
            outlet = max(outlet, grid.ends[1] + beyond)
    nodes = 1 + int(np.ceil((grid.nodes_along - 1) * (outlet - inlet) / length - _ROUNDING))
    changes = {"inlet": inlet, "outlet": outlet, "nodes": nodes}
    if case.contact.geometry == "point":
        changes["nodes_y"] = grid.nodes_across
    return case.model_copy(update={"grid": grid.model_copy(update=changes)})
