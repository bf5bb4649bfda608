"""Contact of a case made ready to be solved: its conditions, its rough surfaces, and whether it can be."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.kinds import KINDS, AnyKind
from ehlectric.contact.memory import check_memory
from ehlectric.contact.setup import Setup
from ehlectric.errors import ResultWarning
from ehlectric.surfaces.domain import Domain
from ehlectric.surfaces.rough_maps import RoughMap
from ehlectric.surfaces.rough_profiles import RoughSurface


@dataclass(frozen=True)
class PreparedContact:
    """One contact ready to be solved, its surfaces read or made.

    Attributes
    ----------
    case : Case or Setup
        The case that it is of, or the setup where there is none.
    conditions : Conditions or PointConditions
        Operating conditions, SI units.
    domain : Domain
        Where the film is solved [m].
    rough : sequence of RoughSurface or RoughMap
        Rough surfaces, as many as there are tables of roughness.
    """

    case: Case | Setup
    conditions: Conditions | PointConditions
    domain: Domain
    rough: Sequence[RoughSurface] | Sequence[RoughMap]

    @property
    def kind(self) -> AnyKind:
        """Functions for each step that its kind of contact takes in a way of its own."""
        return KINDS[self.conditions.geometry]

    def warnings(self) -> Iterator[ResultWarning]:
        """Warnings before it is solved: about its conditions and its rough surfaces."""
        yield from self.kind.case_warnings(self.case, self.conditions)
        yield from self.surface_warnings(self.case)

    def surface_warnings(self, setup: Case | Setup) -> Iterator[ResultWarning]:
        """Warnings about its rough surfaces on the grid of a setup."""
        spacings = self.kind.spacings(setup, self.conditions)
        yield from self.kind.surface_warnings(self.case.roughness, self.rough, self.domain, *spacings)


def check_case(case: Case) -> PreparedContact:
    """Contact of a case, refused before a folder is made for its results if it cannot be solved.

    Parameters
    ----------
    case : Case
        A valid case.

    Returns
    -------
    PreparedContact
        For ``solve``, which then reads no surface again.

    Raises
    ------
    InputError
        Where the values contradict each other, a surface cannot be used or the grid fits into no memory.
    """
    kind = KINDS[case.contact.geometry]
    conditions = kind.resolve(case)
    check_memory(case)
    domain = kind.domain(case, conditions)
    return PreparedContact(case, conditions, domain, kind.rough(case.roughness, domain))
