"""Quick solutions of bearings that several analyses of one bearing need, kept for the next one."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

from ehlectric.bearing.solution import BearingSolution
from ehlectric.bearing.solving.contacts_and_circuit import solution_of
from ehlectric.cases.bearings.case import BearingCase

# Positions of the cage: fewer than in a solution, because only ratios to a quick solution are used.
POSITIONS = 2

# Solutions that are kept: those of the analyses of three or four bearings. Each takes some 0.1 MB.
_KEPT = 100


@dataclass(frozen=True)
class _Key:
    """Case that is found again by all of its values."""

    text: str
    case: BearingCase = field(compare=False)


def quick_solution(case: BearingCase) -> BearingSolution:
    """Solution of a bearing with contacts that are not solved, at two positions of the cage.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing, with ``contacts`` "atlas" or "formula".

    Returns
    -------
    BearingSolution
        Solution, which is computed once for equal cases.

    Raises
    ------
    InputError
        As ``solution_of`` does.
    """
    return _once(_Key(repr(case.to_dict()), case))


@lru_cache(maxsize=_KEPT)
def _once(key: _Key) -> BearingSolution:
    """Solution of the case of a key."""
    return solution_of(key.case, positions=POSITIONS)
