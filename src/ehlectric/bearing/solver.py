"""Solution of a whole rolling bearing: loads, films, fields and the circuit."""

from __future__ import annotations

from ehlectric.bearing.kinds import kind_of
from ehlectric.bearing.preparation import largest_load, prepare_bearing
from ehlectric.bearing.quick.ways import heat_by_formula
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.ring_contacts import check_contact
from ehlectric.bearing.solving.contacts_and_circuit import solution_of
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.runtime.progress import Progress


def solve_bearing(
    case: BearingCase,
    *,
    progress: Progress | None = None,
    workers: int | None = None,
) -> BearingResult:
    """Solve a whole rolling bearing: loads, films, fields and the electrical circuit.

    Contacts with each ring are solved at five loads, those of rollers at ten, and at the loads of light
    elements; the contacts of all elements are interpolated between them.

    Parameters
    ----------
    case : BearingCase
        Bearing file.
    progress : callable, optional
        Called with the number of solved contacts, the number of all contacts, and a text.
    workers : int, optional
        Number of processes; the number of cores if not given.

    Returns
    -------
    BearingResult
        Result with its summary, its tables and its warnings.

    Raises
    ------
    InputError
        Where the bearing cannot carry its load, or a contact cannot be solved.
    LostError
        Where the process of a contact was killed four times, as by a system out of memory.
    ConvergenceError
        Where the film that ``film_factor`` "solved" needs does not converge.
    """
    return BearingResult(solution_of(case, progress=progress, workers=workers))


def check_bearing(case: BearingCase) -> None:
    """Refuse a bearing that cannot be solved, before a folder is made for its results.

    Parameters
    ----------
    case : BearingCase
        Bearing file.

    Raises
    ------
    InputError
        As ``solve_bearing`` does, for the most loaded contacts at the first position of the cage. Heat that
        is to be solved is that of a formula here.
    """
    prepared = prepare_bearing(heat_by_formula(case), 1)
    for ring in prepared.rings:
        kind = kind_of(ring)
        contact = kind.contact(ring, largest_load(prepared, ring))
        check_contact(contact, kind.grid(contact))
