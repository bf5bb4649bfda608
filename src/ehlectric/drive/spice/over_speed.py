"""Equivalent circuits over the speed: their solutions, and their interpolation in a netlist."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solution import lubrication
from ehlectric.bearing.solver import solve_bearing
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.drive.spice.equivalent import Equivalent
from ehlectric.drive.spice.text import Parameter
from ehlectric.errors import InputError, shown
from ehlectric.quantities.units import rpm, rpm_text
from ehlectric.runtime.progress import Progress, silent

# Largest number of speeds in a range, and the smallest ratio of two speeds: the logarithm of their ratio, to
# nine digits, is divided by.
_MOST, _APART = 99, 1.001

_RANGE = re.compile(r"\s*(?P<low>[^:]+):(?P<high>[^:]+):\s*(?P<count>\d{1,4})\s*")
_TAKES = "speeds with units, as '500 rpm, 1000 rpm', or a range with its number, as '500 rpm : 3000 rpm : 7'"

# Number of factors on a line of an expression.
_FACTORS = 4


def speeds_of(case: BearingCase, text: str) -> tuple[float, ...]:
    """Speeds of the inner ring from the text of an option.

    Parameters
    ----------
    case : BearingCase
        Case whose speed they replace.
    text : str
        Speeds with units, separated by commas, or a range "LOW : HIGH : NUMBER" in a geometric series.

    Returns
    -------
    tuple of float
        Speeds [rad/s].

    Raises
    ------
    InputError
        If a part is no speed that the case takes, or the range is none.
    """
    found = _RANGE.fullmatch(text)
    if found is None:
        return tuple(_speed(case, part) for part in text.split(","))
    low, high, count = _speed(case, found["low"]), _speed(case, found["high"]), int(found["count"])
    if not (2 <= count <= _MOST and 0.0 < low < high):
        raise InputError(
            "--speeds",
            got=shown(text),
            takes=f"a range from a lower to a higher speed in 2 to {_MOST} speeds",
        )
    return tuple(float(speed) for speed in np.geomspace(low, high, count))


def _speed(case: BearingCase, text: str) -> float:
    try:
        return case.replace({"bearing.inner_speed": text.strip()}).bearing.inner_speed
    except InputError as error:
        if error.key != "bearing.inner_speed":
            raise
        raise InputError("--speeds", got=error.got or shown(text.strip()), takes=_TAKES) from None


def solve_at_speeds(
    case: BearingCase, speeds: Sequence[float], progress: Progress = silent, *, workers: int | None = None
) -> list[BearingResult]:
    """Solve a bearing at its own speed and at others, all at the same temperature.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing; its ``contacts`` says how it is solved.
    speeds : sequence of float
        Other speeds of the inner ring [rad/s].
    progress : callable, optional
        Called with the numbers of solved and of all contacts of one speed, and a text.
    workers : int, optional
        Number of processes.

    Returns
    -------
    list of BearingResult
        Results at different speeds; the first one is at the speed of the case.

    Raises
    ------
    InputError, LostError, ConvergenceError
        As ``solve_bearing`` raises them.
    """
    own = case.bearing.inner_speed
    others = [speed for speed in dict.fromkeys(speeds) if not _same(speed, own)]
    results = []
    for speed in (own, *others):

        def tell(done: int, of: int, text: str, at: str = rpm_text(speed)) -> None:
            progress(done, of, f"{text}, {at} rpm")

        changed = case if speed == own else case.replace({"bearing.inner_speed": speed})
        results.append(solve_bearing(changed, progress=tell, workers=workers))
    return results


def _same(first: float, second: float) -> bool:
    return bool(np.isclose(first, second, rtol=1e-9, atol=0.0))


def check_table(results: Sequence[BearingResult]) -> None:
    """Refuse several results that are no table over the speed.

    Raises
    ------
    InputError
        If they differ in more than the speed, two have nearly the same speed, or surfaces touch at some.
    """
    if len(results) == 1:
        return
    own = results[0].case.bearing.inner_speed
    inputs = [result.case.replace({"bearing.inner_speed": own}).to_dict() for result in results]
    if any(one != inputs[0] for one in inputs):
        raise InputError("result", got="bearings that differ in other inputs", takes="one bearing, at speeds")
    for low, high in pairwise(sorted(result.case.bearing.inner_speed for result in results)):
        if high < low * _APART:
            told = f"{rpm(low):.6g} rpm and {rpm(high):.6g} rpm"
            raise InputError("bearing.inner_speed", got=told, takes="speeds that differ by 0.1 % or more")
    touching = [
        result.case.bearing.inner_speed for result in results if lubrication(result.solution) == "conducting"
    ]
    if touching:
        told = ", ".join(f"{rpm_text(speed)} rpm" for speed in sorted(touching))
        raise InputError(
            "bearing.inner_speed",
            got=f"{told}, where surfaces touch (lambda ratio below 1),",
            takes="in a table over the speed, speeds at which films part the surfaces",
        )


def nodes(found: Sequence[Equivalent], *, leaks: bool, breaks: bool) -> Iterator[Parameter]:
    """Parameters of a table: speeds [rpm], and the quantities at them, by increasing speed."""
    for k, one in enumerate(found, 1):
        at = f"at n_{k}"
        yield Parameter(f"n_{k}", rpm(one.speed), "rpm", f"speed {k} of the table")
        yield Parameter(f"C_{k}", one.capacitance, "F", f"capacitance of the films {at}")
        if leaks and one.resistance is not None:
            yield Parameter(f"R_{k}", one.resistance, "Ohm", f"leak of the films {at}")
        if breaks and one.threshold is not None:
            yield Parameter(f"V_{k}", one.threshold, "V", f"breakdown voltage of the films {at}")


def parts(count: int) -> Iterator[str]:
    """Expressions of the logarithms by which the speed has passed through each interval, over its length.

    They use functions that ngspice and LTspice both have: 0 below the interval and 1 above it.
    """
    for k in range(1, count):
        low, high = f"n_{k}", f"n_{k + 1}"
        yield f"x_{k}={{ln(min(max(speed,{low}),{high})/{low})/ln({high}/{low})}}"


def interpolated(name: str, letter: str, count: int) -> Iterator[str]:
    """Lines of a quantity that is a power of the speed between two nodes, and constant outside of all.

    Examples
    --------
    >>> list(interpolated("C_films", "C", 3))
    ['C_films={C_1', '+ *pow(C_2/C_1,x_1)*pow(C_3/C_2,x_2)}']
    """
    factors = [f"*pow({letter}_{k + 1}/{letter}_{k},x_{k})" for k in range(1, count)]
    lines = ["".join(factors[at : at + _FACTORS]) for at in range(0, len(factors), _FACTORS)]
    yield f"{name}={{{letter}_1" + "}" * (not lines)
    for at, line in enumerate(lines, 1):
        yield f"+ {line}" + "}" * (at == len(lines))
