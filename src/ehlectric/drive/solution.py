"""Solution of a drive: its bearings as elements of a circuit, and what happens over time. SI units."""

from __future__ import annotations

from dataclasses import dataclass, field

from ehlectric.bearing.result import BearingResult
from ehlectric.cases.drives.case import DriveCase
from ehlectric.drive.bearings import BearingElement
from ehlectric.drive.discharges.record import PEAK, Record
from ehlectric.errors import ResultWarning
from ehlectric.runtime.stored import stored


@dataclass(frozen=True, eq=False)
class DriveSolution:
    """Solved drive.

    Attributes
    ----------
    case : DriveCase
        Case that was solved.
    elements : tuple of BearingElement
        Bearings at the drive end and at the other end, as elements of the circuit.
    record : Record
        What happened over time.
    divider : tuple of float
        Voltage across the films of each bearing per volt of the source, right after an edge.
    highest_source : float
        Largest absolute voltage of the source [V].
    converged : bool
        Whether the films of both bearings are converged.
    told : tuple of ResultWarning
        Warnings about the file of a measured source, and of the bearings.
    bearings : tuple of BearingResult
        Solved bearings at both ends; none in a loaded result, whose file does not hold them.
    """

    case: DriveCase
    elements: tuple[BearingElement, BearingElement]
    record: Record
    divider: tuple[float, float] = field(metadata=stored("bearing", "", "not negative"))
    highest_source: float = field(metadata=stored("", "V", "not negative"))
    converged: bool = field(default=True, metadata=stored("", None, "0 or 1", dtype="i1"))
    told: tuple[ResultWarning, ...] = ()
    bearings: tuple[BearingResult, ...] = field(default=(), compare=False)

    def contact_current(self, b: int) -> float:
        """Largest current through asperities of a bearing that touch [A]."""
        return float(self.record.touching[b]) / self.elements[b].touch_resistance

    def largest_current(self, b: int) -> float:
        """Largest current through the films of a bearing, by an arc or through asperities [A]."""
        return max(float(self.record.largest[b, PEAK]), self.contact_current(b))
