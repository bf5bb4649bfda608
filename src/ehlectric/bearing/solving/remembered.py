"""Quick solutions of bearings that several analyses of one bearing need, kept for the next one."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import lru_cache

from ehlectric.bearing.solution import BearingSolution
from ehlectric.bearing.solving.contacts_and_circuit import solution_of
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.changes import flattened

# Positions of the cage: fewer than in a solution, because only ratios to a quick solution are used.
POSITIONS = 2

# Solutions that are kept: those of the analyses of three or four bearings. Each takes some 0.1 MB.
_KEPT = 100


@dataclass(frozen=True)
class _Key:
    """Case that is found again by all of its values."""

    text: str
    case: BearingCase = field(compare=False)


def quick_solution(case: BearingCase, *, beside: tuple[str, ...] = ()) -> BearingSolution:
    """Solution of a bearing with contacts that are not solved, at two positions of the cage.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing, with ``contacts`` "atlas" or "formula".
    beside : tuple of str
        Beginnings of the dotted keys on which no contact depends. Cases that differ in them alone share their
        contacts; the conditions of the solution may have other values of these keys.

    Returns
    -------
    BearingSolution
        Solution of the case, whose contacts are computed once for equal cases.

    Raises
    ------
    InputError
        As ``solution_of`` does.
    """
    inputs = flattened(case.to_dict())
    text = repr({key: value for key, value in inputs.items() if not key.startswith(beside)})
    return replace(_once(_Key(text, case)), case=case)


@lru_cache(maxsize=_KEPT)
def _once(key: _Key) -> BearingSolution:
    """Solution of the case of a key."""
    return solution_of(key.case, positions=POSITIONS)
