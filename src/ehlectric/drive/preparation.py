"""Drive before its simulation: its bearings, its circuit, and its source."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property

from ehlectric.bearing import BearingResult, solve_bearing
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.drive_bearings import BearingElement, bearing_element, check_extinction
from ehlectric.drive.drive_cycle import check_drive_cycle
from ehlectric.drive.films_in_time import NetworkInTime, network_of_ends
from ehlectric.drive.source_in_time import SourceInTime
from ehlectric.errors import InputError, within
from ehlectric.quantities.inputs import ENDS


@dataclass(frozen=True, eq=False)
class PreparedDrive:
    """Drive before its simulation, with solved bearings."""

    case: DriveCase
    bearings: tuple[BearingResult, BearingResult]
    elements: tuple[BearingElement, BearingElement]
    source: SourceInTime

    @cached_property
    def network(self) -> NetworkInTime:
        """Rotor with both bearings."""
        return network_of_ends(self.case, self.elements, self.source.ring_rate)

    @property
    def divider(self) -> tuple[float, float]:
        """Voltage across the films of each bearing per volt of the source, at the first position."""
        first, second = self.network.divider
        return first, second


def prepare(case: DriveCase, *, workers: int | None = None) -> PreparedDrive:
    """Solve the bearings of a drive, and read its source.

    Raises InputError where a bearing cannot be solved, or lacks a value that discharges need, and where the
    file of a duty cycle cannot be used.
    """
    check_drive_cycle(case)
    first, second = case.bearings
    with of_end(case, ENDS[0]):
        drive_end = solve_bearing(first, workers=workers)
    with of_end(case, ENDS[1]):
        other = drive_end if second == first else solve_bearing(second, workers=workers)
    results = drive_end, other
    elements = (
        _element(results[0], case, ENDS[0]),
        _element(results[1], case, ENDS[1]),
    )
    for end, element in zip(ENDS, elements, strict=True):
        check_extinction(case.breakdown, element.breakdown, end)
    source = SourceInTime.of(case, case.breakdown)
    return PreparedDrive(case, results, elements, source)


@contextmanager
def of_end(case: DriveCase, end: str) -> Iterator[None]:
    """Context in which an error about the bearing at an end has the key of the drive file."""
    try:
        yield
    except InputError as error:
        if error.key in case.replaced:
            raise error.with_text(case.key_at(end, error.key), error.text) from None
        raise error.under(end) from None


def _element(result: BearingResult, case: DriveCase, end: str) -> BearingElement:
    """Bearing at one end as an element of the circuit."""
    with within(end):
        return bearing_element(result, case.breakdown)
