"""Files of a netlist: the subcircuit of a bearing, and its test bench, written whole."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Protocol

from ehlectric.bearing import BearingResult
from ehlectric.cases.amounts import Amount
from ehlectric.drive.netlist import SIGNATURE, Arc, Subcircuit, file_text, subcircuit_of
from ehlectric.errors import InputError
from ehlectric.runtime.files import check_target, reading, write

# Paths that a test bench can name: other characters mean something in a netlist, or are not ASCII.
_NAMEABLE = re.compile(r"[\w ./+:-]+", re.ASCII)

_RESISTANCE = Amount("ohm", least=1e-6, most=1e9, reason="of an arc")
_VOLTAGE = Amount("V", least=1e-6, most=1e6, reason="across the films")


def write_netlist(
    result: BearingResult | Sequence[BearingResult],
    path: str | Path,
    *,
    arc_resistance: float | str | None = None,
    extinction_voltage: float | str | None = None,
    bench: str | Path | None = None,
) -> list[Path]:
    """Write the netlist of a bearing for ngspice and LTspice: its subcircuit from shaft to housing.

    Parameters
    ----------
    result : BearingResult or sequence of BearingResult
        Result of a bearing; or results that differ in the speed only, for a subcircuit with the parameter
        ``speed``, whose default is the speed of the first one.
    path : str or Path
        File of the subcircuit, such as bearing.lib. An existing file is replaced if ehlectric wrote it.
    arc_resistance : float or str, optional
        Resistance of a discharge, such as "1 ohm", or a number in ohm. With it and
        ``extinction_voltage`` the subcircuit has a switch; without both it has none.
    extinction_voltage : float or str, optional
        Voltage across the films below which a discharge ends, such as "2 V", or a number in volts.
    bench : str or Path, optional
        File of a test bench with the drive of the table ``[motor]`` of the case.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        If the surfaces touch and the case has no ``bearing.contact_resistance``, an input of the switch or of
        the test bench is missing or out of bounds, the results are no table over the speed, or a file cannot
        be written.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from ehlectric import BearingCase, solve_bearing, write_netlist
    >>> case = BearingCase.from_dict(
    ...     {
    ...         "contacts": "formula",
    ...         "bearing": {
    ...             "base": "6208", "radial_clearance": "10 um", "radial_load": "1 kN",
    ...             "inner_speed": "3000 rpm", "temperature": "70 degC", "composite_rq": "0.03 um",
    ...         },
    ...         "lubricant": {"base": "paper", "viscosity": "20 mPa s"},
    ...         "discharge": {"dielectric_strength": "15 V/um"},
    ...     }
    ... )
    >>> with TemporaryDirectory() as folder:
    ...     (file,) = write_netlist(
    ...         solve_bearing(case, workers=1), Path(folder) / "bearing.lib",
    ...         arc_resistance="1 ohm", extinction_voltage="1 V",
    ...     )
    ...     lines = file.read_text().splitlines()
    >>> [line for line in lines if line.startswith(".subckt")]
    ['.subckt bearing_6208 shaft housing']
    """
    path, bench = Path(path), None if bench is None else Path(bench)
    check_targets(path, bench)
    arc = arc_of(arc_resistance, extinction_voltage)
    results = [result] if isinstance(result, BearingResult) else list(result)
    if not results:
        raise InputError("result", "is empty", takes="a result, or results at different speeds")
    return write_files(subcircuit_of(results, arc), path, bench)


def arc_of(resistance: float | str | None, extinction: float | str | None) -> Arc | None:
    """Arc of its two inputs; None without both. Raises InputError if only one of them is given, or a value is
    out of bounds.
    """
    given = {"arc_resistance": (_RESISTANCE, resistance), "extinction_voltage": (_VOLTAGE, extinction)}
    if resistance is None and extinction is None:
        return None
    values = []
    for key, (quantity, value) in given.items():
        if value is None:
            raise InputError.missing(key, "a value: a switch needs both of its inputs")
        try:
            values.append(quantity.parse(value))
        except InputError as error:
            raise error.under(key) from None
    return Arc(*values)


def check_targets(path: Path, bench: Path | None) -> None:
    """Refuse files that cannot be written, before anything is solved. Raises InputError if both are one file,
    a folder does not exist, or ehlectric did not write the file that is there.
    """
    if bench is not None:
        if path.resolve() == bench.resolve():
            raise InputError(bench, "is the file of the subcircuit", takes="another file for the test bench")
        _relative(path, bench)
    for target in filter(None, (path, bench)):
        check_target(target)
        if target.exists():
            with reading(target), target.open("rb") as file:
                start = file.read(len(SIGNATURE))
            if start != SIGNATURE.encode():
                raise InputError(
                    target, "already exists and is no netlist of ehlectric", takes="another name"
                )


class Written(Protocol):
    """Netlist that is written."""

    def lines(self) -> Iterator[str]:
        """Lines of the file of the subcircuits."""

    def bench(self, library: str) -> Iterator[str]:
        """Lines of a test bench, which includes this file."""


class Netlist(Written, Protocol):
    """Netlist of a bearing, or of both bearings of a drive."""

    @property
    def subcircuits(self) -> tuple[Subcircuit, ...]:
        """Different subcircuits."""


def write_files(netlist: Written, path: Path, bench: Path | None) -> list[Path]:
    """Write the file of the subcircuits, and the file of the test bench if there is one. Raises InputError if
    the test bench lacks an input, or a file cannot be written.
    """
    contents = {path: file_text(netlist.lines())}
    if bench is not None:
        contents[bench] = file_text(netlist.bench(_relative(path, bench)))
    for target, content in contents.items():
        write(target, content)
    return list(contents)


def _relative(path: Path, bench: Path) -> str:
    """Path of the subcircuit as the test bench names it: relative to its folder where there is a way. Raises
    InputError if a netlist cannot hold the path.
    """
    try:
        link = Path(os.path.relpath(path.resolve(), bench.resolve().parent)).as_posix()
    except ValueError:  # on another drive of Windows
        link = path.resolve().as_posix()
    if _NAMEABLE.fullmatch(link) is None:
        takes = "a path of letters, digits, spaces and . _ + - / for --output with a test bench"
        raise InputError(path, "cannot be named in a netlist", takes=takes)
    return link
