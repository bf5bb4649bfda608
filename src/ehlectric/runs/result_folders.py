"""Folders of results: the files that ehlectric writes there, and results that no other run replaces.

A folder holds one result. A run removes the files of an earlier result of any kind, by the names that
ehlectric writes, and does not touch other files. A sweep and a run of moving roughness may have taken
hours, so another run does not replace them: it is refused.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from ehlectric.errors import InputError
from ehlectric.figures.figure_names import (
    ALL_FIGURES,
    AXLE_FIGURE_FILES,
    BEARING_FIGURE_FILES,
    CALIBRATION_FIGURE,
    DRIVE_FIGURE_FILES,
    FORMATS,
    GEAR_FIGURE_FILES,
    MEASURED_FIGURE,
    MOTION_FIGURE_FILES,
    SENSITIVITY_FIGURE,
    SPEED_FIGURE_FILES,
    in_formats,
)
from ehlectric.runtime.journal import begun
from ehlectric.runtime.reading import refuse_unreadable
from ehlectric.runtime.result_names import (
    AXLE_NETCDF,
    BEARING_NETCDF,
    CONTACT_NETCDF,
    DRIVE_NETCDF,
    GEAR_NETCDF,
    MOTION,
    MOTION_JOURNAL,
    OF_AXLES,
    OF_BEARINGS,
    OF_CALIBRATIONS,
    OF_CONTACTS,
    OF_DRIVES,
    OF_GEARS,
    OF_MEASUREMENTS,
    OF_MOTION,
    OF_SWEEPS,
    SWEEP,
)

if TYPE_CHECKING:
    from ehlectric.cases.case import Case

SENSITIVITY = "sensitivity.json"
REPORTS = ("report.html", "report.pdf", "summary_page.html", "summary_page.pdf")

# Figures with names of their own; maps and lines of a sweep are named by the value that they show.
_FIGURES = (
    *ALL_FIGURES,
    *MOTION_FIGURE_FILES,
    *BEARING_FIGURE_FILES,
    *DRIVE_FIGURE_FILES,
    *GEAR_FIGURE_FILES,
    *AXLE_FIGURE_FILES,
    *SPEED_FIGURE_FILES,
    SENSITIVITY_FIGURE,
    MEASURED_FIGURE,
    CALIBRATION_FIGURE,
)

# Name of a map or of lines: the key of the value, and the values of the keys that are held. Name of a figure
# over speed with values of keys that are held.
_FORMAT = rf"\.(?:{'|'.join(FORMATS)})"
_MAP = re.compile(rf"(?:map|lines)_(?P<key>.+?)(?:_at_.*=.*)?{_FORMAT}")
_SPEED = re.compile(rf"(?:capacitance|breakdown)_over_speed_at_.*=.*{_FORMAT}")


def files_of_results(folder: str | Path, *, keep: tuple[str, ...] = ()) -> tuple[str, ...]:
    """Names of all files that a result of any kind may have in a folder. Returns names of files and figures,
    whether they exist or not, and of the maps of sweeps that exist; the database of a sweep is not among
    them.
    """
    names = (
        *OF_CONTACTS,
        *OF_MOTION,
        *OF_BEARINGS,
        *OF_DRIVES,
        *OF_GEARS,
        *OF_AXLES,
        *OF_SWEEPS,
        *OF_MEASUREMENTS,
        *OF_CALIBRATIONS,
        SENSITIVITY,
        *REPORTS,
        *in_formats(_FIGURES, FORMATS),
    )
    return tuple(name for name in dict.fromkeys((*names, *_maps(Path(folder)))) if name not in keep)


def _maps(folder: Path) -> Iterator[str]:
    """Names of the maps and lines of sweeps in a folder: files named by a key of a summary."""
    from ehlectric.quantities.quantity import key_of
    from ehlectric.quantities.results import BEARING_KEYS, CONTACT_KEYS, DRIVE_KEYS

    known = (*CONTACT_KEYS.values(), BEARING_KEYS, DRIVE_KEYS)
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        match = _MAP.fullmatch(path.name)
        of_map = match and any(key_of(keys, match["key"]) for keys in known)
        if of_map or _SPEED.fullmatch(path.name):
            yield path.name


def protect(folder: str | Path, case: Case | None = None, *, sweep: bool = False) -> None:
    """Refuse a folder with a result that may have taken hours and that a run would replace. Raises InputError
    if the folder has a sweep, or recorded steps of another case with moving roughness.
    """
    folder = Path(folder)
    if not sweep and (points := _points(folder / SWEEP)) is not None:
        raise InputError(
            folder,
            f"has a sweep of {points[1]} points, of which {points[0]} are saved",
            takes=f"another folder, as with -o; or remove {SWEEP} from this one",
        )
    if any((folder / name).is_file() for name in (MOTION, MOTION_JOURNAL)):
        from ehlectric.motion.stored_run import refuse_other_case

        refuse_other_case(folder, case)


def _points(path: Path) -> tuple[int, int] | None:
    """Number of saved points and of all points of a sweep; None if the file is missing or is no sweep."""
    if not path.is_file():
        return None

    from ehlectric.sweep import saved_points

    try:
        return saved_points(path.parent)
    except InputError:
        # A database of somebody else, which no run touches.
        return None


def stored_result(path: str | Path) -> Path:
    """Return the file from which a result's figures are drawn, for a file or folder of any kind. Returns a
    NetCDF file, which need not exist where moving roughness has only a journal yet, or the database of a
    sweep. Raises InputError if the file cannot be read, or if the folder has no result or several.
    """
    path, names = (
        Path(path),
        (CONTACT_NETCDF, BEARING_NETCDF, DRIVE_NETCDF, GEAR_NETCDF, AXLE_NETCDF, MOTION, SWEEP),
    )
    if not path.is_dir():
        if not _is_result(path):
            refuse_unreadable(path)
        belongs = path.name in files_of_results(path.parent) and path.name not in names
        if not belongs:
            return path
        path = path.parent
    files = [path / name for name in names if _is_result(path / name)]
    if not files:
        raise InputError(path, "has no result", takes=f"a folder with one of {', '.join(names)}")
    if len(files) > 1:
        results = " and ".join(file.name for file in files)
        raise InputError(path, f"has {results}", takes="one result; name the file to draw")
    return files[0]


def _is_result(path: Path) -> bool:
    """Whether a file exists, or moving roughness has a journal from which it can be read."""
    return path.is_file() or (path.name == MOTION and begun(path.with_name(MOTION_JOURNAL)))
