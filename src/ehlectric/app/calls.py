"""Functions of worker processes that the pages call, by name, so that the server need not load them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Generic, TypeVar, cast

from ehlectric.app.view_models import (
    AxleAnswer,
    BearingAnswer,
    CalibrationAnswer,
    ContactAnswer,
    DriveAnswer,
    DutyAnswer,
    DutyLook,
    Figure,
    GearAnswer,
    MotionAnswer,
    RemedyAnswer,
    Side,
    SurfaceAnswer,
    SweepChoices,
    SweepPlan,
    SweepPoint,
    SweepView,
    Uploaded,
    Written,
)

T = TypeVar("T")


@dataclass(frozen=True)
class Call(Generic[T]):
    """Function of a worker process that returns a ``T``.

    The server keeps outcomes of a call that is ``kept``: they depend on nothing else than its plain values. A
    function that reads files, such as a folder whose name is a text, is not kept, because files change.

    Examples
    --------
    >>> Call("duty_answers.look").function().__name__
    'look'
    """

    name: str  # module in ``ehlectric.app.compute`` and function
    kept: bool = False

    def function(self) -> Callable[..., T]:
        """The function; this loads what it needs."""
        module, _, name = self.name.rpartition(".")
        return cast("Callable[..., T]", getattr(import_module(f"ehlectric.app.compute.{module}"), name))

    def __call__(self, *values: Any) -> T:
        """Call the function."""
        return self.function()(*values)


# A bearing.
BEARING_QUICK: Call[BearingAnswer] = Call("bearing_answers.quick_answer", kept=True)
BEARING_CURVES: Call[BearingAnswer] = Call("bearing_answers.curves_answer", kept=True)
BEARING_WHOLE: Call[BearingAnswer] = Call("bearing_answers.whole_quick_answer", kept=True)
BEARING_SOLVED: Call[BearingAnswer] = Call("bearing_answers.solve_contacts")

# A bearing without and with a remedy.
REMEDY_QUICK: Call[RemedyAnswer] = Call("remedy_answers.quick_remedy", kept=True)
REMEDY_WHOLE: Call[RemedyAnswer] = Call("remedy_answers.whole_remedy", kept=True)

# A duty cycle: what its file has, and its result.
DUTY_LOOK: Call[DutyLook] = Call("duty_answers.look")
BEARING_DUTY: Call[DutyAnswer] = Call("bearing_answers.duty_answer", kept=True)

# Measured values: how many there are, and the calibration with them.
CALIBRATION_CHECKED: Call[str] = Call("calibration_answers.checked", kept=True)
CALIBRATED: Call[CalibrationAnswer] = Call("calibration_answers.calibrated")

# A drive.
DRIVE_QUICK: Call[DriveAnswer] = Call("drive_answers.quick_answer", kept=True)
DRIVE_SIMULATED: Call[DriveAnswer] = Call("drive_answers.simulate")

# A gear pair.
GEAR_QUICK: Call[GearAnswer] = Call("gear_answers.quick_answer", kept=True)
GEAR_WHOLE: Call[GearAnswer] = Call("gear_answers.whole_answer", kept=True)
GEAR_DUTY: Call[DutyAnswer] = Call("gear_answers.duty_answer", kept=True)
GEAR_SOLVED: Call[GearAnswer] = Call("gear_answers.solve_pair")

# An axle.
AXLE_QUICK: Call[AxleAnswer] = Call("axle_answers.quick_answer", kept=True)
AXLE_REMEDIED: Call[AxleAnswer] = Call("axle_answers.remedied_answer", kept=True)
AXLE_SIMULATED: Call[AxleAnswer] = Call("axle_answers.simulate")
AXLE_WHOLE: Call[AxleAnswer] = Call("axle_answers.whole_answer", kept=True)

# A contact.
CONTACT_QUICK: Call[ContactAnswer] = Call("contact_answers.quick_answer", kept=True)
CONTACT_SOLVED: Call[ContactAnswer] = Call("contact_answers.solve_contact")
CONTACT_CUTS: Call[Mapping[str, Figure]] = Call("contact_answers.cuts_of")

# Roughness and motion of a contact.
SURFACE: Call[SurfaceAnswer] = Call("surface_answers.look")
MOTION_RUN: Call[MotionAnswer] = Call("motion_answers.run")
MOTION_STORED: Call[MotionAnswer] = Call("motion_answers.stored")

# Sweeps.
SWEEP_CHOICES: Call[SweepChoices] = Call("sweep_answers.choices", kept=True)
SWEEP_PLANNED: Call[SweepPlan] = Call("sweep_answers.planned")
SWEEP_SOLVED: Call[Mapping[str, int]] = Call("sweep_answers.solved")
SWEEP_POINT: Call[SweepPoint] = Call("sweep_answers.point")
SWEEP_FILES: Call[tuple[str, ...]] = Call("sweep_answers.files")
SWEEP_SEEN: Call[SweepView | None] = Call("sweep_answers.seen")

# Two cases side by side.
COMPARE_SIDE: Call[Side] = Call("compare_answers.side", kept=True)
COMPARE_WHOLE_SIDE: Call[Side] = Call("compare_answers.whole_side", kept=True)

# Files that are uploaded and downloaded.
FILES_UPLOADED: Call[Uploaded] = Call("page_files.uploaded")
FILES_WRITTEN: Call[Written] = Call("page_files.write")
FILES_DRAWN: Call[str] = Call("page_files.drawn")
FILES_PACKED: Call[str] = Call("page_files.packed")
FILES_CONVERTED: Call[str] = Call("page_files.converted")
