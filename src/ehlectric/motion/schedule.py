"""Schedule of a transient contact: time steps, speeds of the surfaces, and when roughness fills the contact.

The schedule follows from the case and its conditions alone; it does not need the heights of the surfaces.

Time is dimensionless, T = t u/b, and positions are in half-widths, X = x/b. Here u is the entrainment speed,
the mean speed of the surfaces, and b is the half-width. At T = 0 all moving roughness lies outside the
domain. A point at x in the case is at x - D + u_k t at the time t. Here D is the length of the domain, and
u_k is the speed of its surface. At the time D/u_k the point is at its position in the case.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.bodies import surface_ratios
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.errors import InputError
from ehlectric.film.unsteady import MOST_COURANT

# A surface is at rest below this speed divided by the entrainment speed. It is also the relative tolerance of
# comparisons of times and speeds.
_AT_REST = 1e-9


@dataclass(frozen=True)
class Schedule:
    """Time steps of a transient contact and the speeds of its surfaces.

    Attributes
    ----------
    end : float
        Duration T, dimensionless.
    steps : int
        Number of time steps, all of the same length.
    courant : float
        Distance travelled at the entrainment speed in one time step [grid spacings].
    recorded : ndarray of int, shape (n,)
        Numbers of the time steps that are recorded, from 0 to ``steps``.
    time : float
        Unit of time b/u, which corresponds to T = 1 [s].
    domain : tuple of float
        Inlet and outlet of the film's domain [half-widths].
    speeds : tuple of float
        Speeds of surfaces 1 and 2 divided by the entrainment speed; exactly 0 if a surface is at rest.
    rough : tuple of int
        Numbers of the rough surfaces, 1 or 2, in ascending order.

    Examples
    --------
    A bump on surface 1 in pure rolling. The domain, -4 to 2 half-widths, has 64 grid intervals:

    >>> from ehlectric.contact.resolve import resolve
    >>> contact = {"reduced_radius": "14 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "0.5 GPa", "entrainment_speed": "4 m/s"}
    >>> bump = {"surface": 1, "generator": "asperity", "height": "50 nm", "width": "60 um"}
    >>> tables = {"contact": contact, "lubricant": {"base": "paper"}, "roughness": [bump]}
    >>> case = Case.from_dict(tables | {"grid": {"nodes": 65}, "motion": {"passes": 2.0}})
    >>> schedule = schedule_of(case, resolve(case))
    >>> schedule.steps, schedule.end, schedule.coincident
    (128, 12.0, 6.0)
    """

    end: float
    steps: int
    courant: float
    recorded: Array
    time: float
    domain: tuple[float, float]
    speeds: tuple[float, float]
    rough: tuple[int, ...]

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
    """Schedule of a case with moving roughness.

    Parameters
    ----------
    case : Case
        A case with ``motion`` and roughness.
    conditions : Conditions or PointConditions
        Operating conditions of the case, from ``resolve`` or ``resolve_point``.

    Returns
    -------
    Schedule
        Time steps and speeds. The recorded instants include the one at which all moving roughness is at its
        position in the case, if the run reaches it.

    Raises
    ------
    InputError
        If the case has no ``motion``, or all rough surfaces are at rest. Also if the run is shorter than one
        grid spacing, or the time steps are too long.
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
    """Speed divided by the entrainment speed, with 0 in place of rounding errors."""
    return speed if abs(speed) > _AT_REST else 0.0
