"""Functions of worker processes that the pages call."""

from __future__ import annotations

from collections.abc import Mapping

from ehlectric.app.answers.bearing import BearingAnswer
from ehlectric.app.answers.call import Call
from ehlectric.app.answers.compare import Side
from ehlectric.app.answers.contact import ContactCheck, ContactView
from ehlectric.app.answers.drive import DriveAnswer
from ehlectric.app.answers.figure import Shown
from ehlectric.app.answers.files import Uploaded, Written
from ehlectric.app.answers.motion import MotionAnswer
from ehlectric.app.answers.surface import SurfaceAnswer
from ehlectric.app.answers.sweep import SweepChoices, SweepPlan, SweepPoint, SweepView

FIELD_HELP: Call[dict[str, str]] = Call("descriptions.field_help")

# A bearing.
BEARING_QUICK: Call[BearingAnswer] = Call("bearing.quick_answer")
BEARING_WHOLE: Call[BearingAnswer] = Call("bearing.whole_quick_answer")
BEARING_SOLVED: Call[BearingAnswer] = Call("bearing.solve_contacts")

# A drive.
DRIVE_QUICK: Call[DriveAnswer] = Call("drives.answer.quick_answer")
DRIVE_SIMULATED: Call[DriveAnswer] = Call("drives.answer.simulate")

# A contact.
CONTACT_CHECK: Call[ContactCheck] = Call("contact.check_contact")
CONTACT_SOLVED: Call[ContactView] = Call("contact.solve_contact")
CONTACT_AT_ONCE: Call[ContactView] = Call("contact.solve_at_once")
CONTACT_CUTS: Call[tuple[Shown, ...]] = Call("contact.cuts_of")

# Roughness and motion of a contact.
SURFACE: Call[SurfaceAnswer] = Call("surface.look")
MOTION_RUN: Call[MotionAnswer] = Call("motion.run")
MOTION_STORED: Call[MotionAnswer] = Call("motion.stored")

# Sweeps.
SWEEP_CHOICES: Call[SweepChoices] = Call("sweep.choices")
SWEEP_PLANNED: Call[SweepPlan] = Call("sweep.planned")
SWEEP_SOLVED: Call[Mapping[str, int]] = Call("sweep.solved")
SWEEP_POINT: Call[SweepPoint] = Call("sweep.point")
SWEEP_FILES: Call[tuple[str, ...]] = Call("sweep.files")
SWEEP_SEEN: Call[SweepView | None] = Call("sweep_view.seen")

# Two cases side by side.
COMPARE_SIDE: Call[Side] = Call("compare.side")
COMPARE_WHOLE_SIDE: Call[Side] = Call("compare.whole_side")

# Files that are uploaded and downloaded.
FILES_UPLOADED: Call[Uploaded] = Call("files.uploaded")
FILES_WRITTEN: Call[Written] = Call("files.write")
FILES_DRAWN: Call[str] = Call("files.drawn")
FILES_PACKED: Call[str] = Call("files.packed")
FILES_CONVERTED: Call[str] = Call("files.converted")
