"""Export of results of every kind for ParaView, MATLAB and Octave, and spreadsheets."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from ehlectric.errors import InputError, shown
from ehlectric.runs.exports.excel import workbook
from ehlectric.runs.exports.exported import Exported
from ehlectric.runs.exports.matlab import mat_file
from ehlectric.runs.exports.paraview import vtkhdf_file
from ehlectric.runs.folders import stored_result
from ehlectric.runs.results import load
from ehlectric.runtime.files import refuse_special, write
from ehlectric.sweep.store import NAME as SWEEP
from ehlectric.sweep.store import read_sweep

# Contents of a file by the ending of its name.
WRITERS: Mapping[str, Callable[[Exported], bytes]] = MappingProxyType(
    {".mat": mat_file, ".vtkhdf": vtkhdf_file, ".xlsx": workbook}
)


def export(result: Exported | str | Path, path: str | Path) -> Path:
    """Write a result into a file of another program; the ending of its name says which one.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, DriveResult, MotionResult, SweepResults, str or Path
        Result; or the folder of a result of any kind, or its result.nc, bearing.nc, drive.nc or motion.nc.
    path : str or Path
        File to write; an existing one is replaced. ``.mat`` for MATLAB and Octave has all arrays and the
        summary, ``.xlsx`` for spreadsheets the summary, the inputs and the table of the result, and
        ``.vtkhdf`` for ParaView the film and the field of a contact, or its film over time. Numbers are in
        SI units.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        If the name ends otherwise, the result cannot be read or has no such form, its table is too long for a
        spreadsheet, a package is missing, or the file cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from scipy.io import loadmat
    >>> from ehlectric import solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> result = solve({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> with TemporaryDirectory() as folder:
    ...     file = export(result, Path(folder) / "contact.mat")
    ...     values = loadmat(file, squeeze_me=True)
    >>> bool((values["thickness"] == result.film.thickness).all()), str(values["units"]["thickness"])
    (True, 'm')
    """
    path = check_target(path)
    found = stored(result) if isinstance(result, str | Path) else result
    write(path, WRITERS[path.suffix.lower()](found))
    return path


def check_target(path: str | Path) -> Path:
    """Path of a file that can be exported to.

    Raises
    ------
    InputError
        If the ending of its name is none of the formats, or its folder does not exist.
    """
    path = Path(path)
    if path.suffix.lower() not in WRITERS:
        takes = f"a name that ends in {', '.join(WRITERS)}"
        raise InputError(path, got=shown(path.suffix or "no ending"), takes=takes)
    if not path.parent.is_dir():
        raise InputError(path, "cannot be written to, its folder does not exist")
    refuse_special(path)
    return path


def stored(path: str | Path) -> Exported:
    """Result of a file or a folder, also of a sweep.

    Raises
    ------
    InputError
        If there is no result, or it cannot be read.
    """
    file = stored_result(path)
    return read_sweep(file.parent) if file.name == SWEEP else load(file)
