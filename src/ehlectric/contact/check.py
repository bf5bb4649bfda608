"""Preparation of a case: operating conditions, rough surfaces, and checks before the contact is solved."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.heat.physics import physics_of
from ehlectric.contact.kinds import KINDS, AnyKind
from ehlectric.contact.memory import check_memory
from ehlectric.contact.problems import check_tolerance, heights_of
from ehlectric.contact.reach import Reach, reach_of
from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError, ResultWarning
from ehlectric.film.problem import FilmProblem
from ehlectric.film.thermal.physics import Physics
from ehlectric.lubricant.own import OF_STRENGTH, Laws
from ehlectric.surfaces.domain import Domain
from ehlectric.surfaces.rough_maps import RoughMap
from ehlectric.surfaces.rough_profiles import RoughSurface

# Places along each axis of a line and a point contact at which the heights in the Hertz zone are taken.
_ZONE_NODES = {1: 4001, 2: 401}


@dataclass(frozen=True)
class PreparedContact:
    """Contact that is ready to be solved, with its rough surfaces read from files or generated.

    Attributes
    ----------
    case : Case or Setup
        Case of the contact, or setup if there is no case.
    conditions : Conditions or PointConditions
        Operating conditions, SI units.
    domain : Domain
        Domain in which the film is solved [m].
    rough : sequence of RoughSurface or RoughMap
        Rough surfaces, one for each table ``roughness`` of the case.
    """

    case: Case | Setup
    conditions: Conditions | PointConditions
    domain: Domain
    rough: Sequence[RoughSurface] | Sequence[RoughMap]

    @property
    def kind(self) -> AnyKind:
        """Functions of the kind of this contact, line or point."""
        return KINDS[self.conditions.geometry]

    @cached_property
    def physics(self) -> Physics | None:
        """Heat and shear of the film; None of an isothermal Newtonian film."""
        return physics_of(self.case, self.conditions)

    def film_problem(self, setup: Setup, *, rough: bool = True) -> FilmProblem:
        """Film problem of the contact on the grid of a setup, with its roughness or with smooth surfaces."""
        surfaces = self.rough if rough else ()
        problem = self.kind.film_problem(setup, self.conditions, surfaces)
        return problem if self.physics is None else replace(problem, physics=self.physics)

    @cached_property
    def reach(self) -> Reach | None:
        """Expected errors and times of the grids of a refinement; None of a grid that is not refined."""
        setup = Setup.of(self.case)
        if setup.grid.target is None:
            return None
        return reach_of(setup, self.conditions.geometry, self.film_problem(setup))

    def composite_roughness(self) -> float | None:
        """Rq of the sum of both surfaces in the Hertz zone, undeformed [m]; None for smooth surfaces."""
        if not self.rough:
            return None
        semi_axes = self.conditions.semi_axes
        unit = np.linspace(-1.0, 1.0, _ZONE_NODES[len(semi_axes)])
        heights = heights_of(self.rough, *(axis * unit for axis in semi_axes)).sum(axis=0)
        distance = sum(part**2 for part in np.meshgrid(*[unit] * len(semi_axes)))
        return float(np.std(heights[distance <= 1.0]))

    def warnings(self) -> Iterator[ResultWarning]:
        """Warnings before the solution: about the operating conditions, rough surfaces and the refinement."""
        yield from self.kind.case_warnings(self.case, self.conditions)
        yield from self.surface_warnings(self.case)
        if self.reach is not None:
            yield from self.reach.warnings()

    def surface_warnings(self, setup: Case | Setup) -> Iterator[ResultWarning]:
        """Warnings about the rough surfaces on the grid of a setup."""
        spacings = self.kind.spacings(setup, self.conditions)
        yield from self.kind.surface_warnings(self.case.roughness, self.rough, self.domain, *spacings)


def check_case(case: Case) -> PreparedContact:
    """Check a case and prepare its contact, before any folder is made for its results.

    Parameters
    ----------
    case : Case
        A valid case.

    Returns
    -------
    PreparedContact
        Contact to pass to ``solve``, which then does not read the surfaces again.

    Raises
    ------
    InputError
        If the values contradict each other, the tolerance is too large, a surface cannot be used, or the
        case needs more than the available memory.
    """
    kind = KINDS[case.contact.geometry]
    conditions = kind.resolve(case)
    check_tolerance(case.solver)
    check_memory(case)
    domain = kind.domain(case, conditions)
    # Its film is refused here where it cannot be heated.
    physics_of(case, conditions)
    return PreparedContact(case, conditions, domain, kind.rough(case.roughness, domain))


def with_laws(case: Case, laws: Laws) -> Case:
    """Case of a contact with laws of the user's own in place of those of its tables.

    A dielectric strength becomes the strength table of the case.

    Parameters
    ----------
    case : Case
        Case whose contact has a temperature.
    laws : Laws
        Functions of pressure and temperature.

    Returns
    -------
    Case
        Case whose ``oil`` has these laws at the temperature of the contact.

    Raises
    ------
    InputError
        If the contact has no temperature, or a law has no valid values at its pressures.
    """
    if case.film is not None and case.film.thermal:
        raise InputError.worded(
            "film.thermal",
            "is not used with laws of your own, which are those at one temperature",
        )
    conditions = KINDS[case.contact.geometry].resolve(case)
    sampled = laws.sampled(case.contact.temperature, conditions.max_pressure)
    strength = sampled.samples.get("strength")
    if strength is not None:
        places = slice(None, None, OF_STRENGTH)
        table = {"pressure": strength.pressure[places].tolist(), "strength": strength.values[places].tolist()}
        case = case.replace({"discharge.strength_table": table})
    return case.with_laws(sampled)
