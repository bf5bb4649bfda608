"""Transient contact: conditions, schedule, rough surfaces and film equations of a case with motion."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import zip_longest
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.film.problem import FilmProblem
from ehlectric.motion.kinds import KINDS, AnyKind
from ehlectric.motion.roughness import MovingRoughness
from ehlectric.motion.schedule import Schedule, schedule_of
from ehlectric.surfaces.rough_maps import RoughMap
from ehlectric.surfaces.rough_profiles import RoughSurface

# Tolerance for a whole number of grid intervals in the extended domain [grid intervals].
_ROUNDING = 1e-9


@dataclass(frozen=True)
class TransientContact:
    """Contact with moving roughness, ready to be solved in time steps.

    Attributes
    ----------
    case : Case
        Case of a line or a point contact.
    conditions : Conditions or PointConditions
        Operating conditions of the case.
    schedule : Schedule
        Time steps and speeds of the surfaces.
    travelled : Case
        Case whose domain is extended to the length of the surfaces that pass through the contact.
    roughness : MovingRoughness
        Rough surfaces, generated or read for the extended domain.
    """

    case: Case
    conditions: Conditions | PointConditions
    schedule: Schedule
    travelled: Case
    roughness: MovingRoughness

    @classmethod
    def of(cls, case: Case, rough: Sequence[RoughSurface | RoughMap] = ()) -> TransientContact:
        """Contact of a case, with its surfaces generated or read.

        Parameters
        ----------
        case : Case
            A case with ``motion`` and roughness.
        rough : sequence of RoughSurface or RoughMap, optional
            Surfaces of the same case at rest. Those from files do not depend on the domain and are taken as
            they are, so that no file is read twice.

        Returns
        -------
        TransientContact
            Contact that is ready to be solved in time steps.

        Raises
        ------
        InputError
            If the schedule is refused (see ``schedule_of``), or a surface cannot be generated or read.
        """
        kind = KINDS[case.contact.geometry]
        conditions = kind.contact.resolve(case)
        schedule = schedule_of(case, conditions)
        travelled = travelled_case(case, schedule)
        domain = kind.contact.domain(travelled, conditions)
        surfaces: list[Any] = [
            kind.contact.rough([table], domain)[0] if surface is None or table.file is None else surface
            for table, surface in zip_longest(travelled.roughness, rough)
        ]
        roughness = MovingRoughness(surfaces, schedule, conditions.half_width)
        return cls(case, conditions, schedule, travelled, roughness)

    @property
    def kind(self) -> AnyKind:
        """Functions for this kind of contact, line or point."""
        return KINDS[self.case.contact.geometry]

    @property
    def half_width(self) -> float:
        """Half-width b [m]; for a point contact, the semi-axis along entrainment."""
        return self.conditions.half_width

    @cached_property
    def problem(self) -> FilmProblem:
        """Film problem without moving roughness; the roughness of surfaces at rest is part of the gap."""
        problem = self.kind.film_problem(self.case, self.travelled, self.conditions, self.roughness)
        # The scheme in time is of second order, and the film that it starts from must agree with it.
        return replace(problem, wedge_order=2)

    def moving_gap(self, time: float, x: Array, y: Array) -> Array:
        """Contribution of moving roughness to the dimensionless gap; peaks reduce the gap.

        Parameters
        ----------
        time : float
            Time T, dimensionless.
        x : ndarray, shape (nx,)
            Positions X along entrainment [half-widths].
        y : ndarray, shape (ny,)
            Positions Y across entrainment [half-widths]; not used by a line contact.

        Returns
        -------
        ndarray, shape (nx, ny)
            Change of the gap divided by the scale of the film thickness, dimensionless.
        """
        heights = self.roughness.moving_height(time, *(x, y)[: len(self.kind.axes)])
        gap: Array = -heights.reshape(x.size, y.size) / self.conditions.thickness_scale
        return gap


def travelled_case(case: Case, schedule: Schedule) -> Case:
    """Case whose domain is extended to the length of the surfaces that pass through the contact.

    Parameters
    ----------
    case : Case
        A case with roughness.
    schedule : Schedule
        Time steps and speeds of the surfaces of this case.

    Returns
    -------
    Case
        Case with the same grid spacing. The domain is extended along entrainment only, so the number of nodes
        across is the same.
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
    changes |= KINDS[case.contact.geometry].nodes_across(grid)
    return case.model_copy(update={"grid": grid.model_copy(update=changes)})
