"""Keys that a sweep may vary, of contacts, bearings and drives."""

from __future__ import annotations

from collections.abc import Collection

from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.drives.case import BOTH, ENDS, DriveCase
from ehlectric.cases.drives.swept import SweptCase
from ehlectric.cases.input_keys import input_field, is_of_drive
from ehlectric.cases.table import Table, nearest_key
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import end_and_key

# Keys of a bearing file that a key of a drive replaces at both ends.
_REPLACED = {
    "bearing.inner_speed": "drive.speed",
    "bearing.temperature": "drive.temperature",
    "contacts": "drive.contacts",
}

# Keys of a bearing file that no sweep varies: they are not a part of the bearing.
_NOT_VARIED = ("title", "ranges")


def check_varied(key: str, case: SweptCase, varied: Collection[str] = ()) -> None:
    """Check that a key is one of a case, and that varying it changes the case.

    Parameters
    ----------
    key : str
        Dotted key.
    case : Case, BearingCase or DriveCase
        Base case of a sweep.
    varied : collection of str
        All keys that the sweep varies.

    Raises
    ------
    InputError
        If the case has no such key; the message names the nearest one. Of a drive also if another key of the
        drive stands in its place.
    """
    if isinstance(case, DriveCase):
        _check_drive(key, case, varied)
        return
    model: type[Table] = BearingCase if isinstance(case, BearingCase) else Case
    if is_of_drive(key):
        raise InputError.unknown(key, nearest_key(key, model))
    try:
        input_field(key)
    except InputError as error:
        if model is BearingCase and "unknown key" in error.text:
            raise InputError.unknown(key, nearest_key(key, model)) from None
        raise


def _check_drive(key: str, case: DriveCase, varied: Collection[str]) -> None:
    """Check a key of a drive."""
    end, own = end_and_key(key)
    if not is_of_drive(key) and key != "title":
        raise InputError.unknown(key, _nearest(key))
    if key == BOTH:
        raise InputError(key, "is a table", takes=f"one of its keys, as {BOTH}.bearing.radial_load")
    input_field(key)
    if end and own.partition(".")[0] in _NOT_VARIED:
        raise InputError.worded(key, "cannot vary", takes="a key of the bearing")
    above = _REPLACED.get(own) if end else None
    if above is not None and (above in varied or getattr(case.drive, above.partition(".")[2]) is not None):
        raise InputError.worded(key, f"has no effect, as {above} is given for both bearings", takes=above)
    both = f"{BOTH}.{own}"
    if end in ENDS and both in varied:
        raise InputError.worded(key, f"varies beside {both}; vary one of them, or both ends", takes=both)


def _nearest(key: str) -> str:
    """Key of a drive that is nearest to a key of another kind of file; one of a bearing is that of both."""
    if key.partition(".")[0] not in BearingCase.known_keys():
        return nearest_key(key, DriveCase)
    of_bearing = nearest_key(key, BearingCase)
    return _REPLACED.get(of_bearing, f"{BOTH}.{of_bearing}")
