"""Warnings about where the result of a gear pair is unreliable."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ehlectric.cases.film_inputs import shear_unused
from ehlectric.gear.flank_films import without_heat
from ehlectric.gear.flank_oil import by_lubricant
from ehlectric.gear.solution import GearSolution
from ehlectric.quantities.formats import amount
from ehlectric.quantities.result_warnings import ResultWarning

# Share of the capacitance above which films outside the atlas are worth a warning.
_OUTSIDE = 0.1

# Part of the backlash above which the film behind the teeth makes this film 10 % thinner.
_FILLED = 0.1


def gear_warnings(solution: GearSolution, *, in_axle: bool = False) -> Iterator[ResultWarning]:
    """Warnings about a gear pair, each once."""
    yield from _of_pair(solution, in_axle=in_axle)
    oil = solution.case.lubricant.at(solution.bulk_temperature, _KEY)
    yield from oil.warnings(float(np.nanmax(solution.films.max_pressure)))


def warning_codes(solutions: Sequence[GearSolution]) -> list[list[str]]:
    """Codes of the warnings about each of many gear pairs, in any order; each lubricant is bound once."""
    codes = [[warning.code for warning in _of_pair(solution)] for solution in solutions]
    for lubricant, places in by_lubricant(solution.case.lubricant for solution in solutions):
        temperatures = np.array([solutions[k].bulk_temperature for k in places])
        pressures = np.array([float(np.nanmax(solutions[k].films.max_pressure)) for k in places])
        for code, mask in lubricant.at(temperatures, _KEY).codes(pressures):
            for k in np.flatnonzero(np.broadcast_to(mask, pressures.shape)).tolist():
                codes[places[k]].append(code)
    return codes


_KEY = "gear.operation.bulk_temperature"


def _of_pair(solution: GearSolution, *, in_axle: bool = False) -> Iterator[ResultWarning]:
    """Warnings that do not depend on the laws of the oil."""
    gear, operation = solution.case.gear, solution.case.gear.operation
    ratio, filled = solution.minimum_film / solution.rq, solution.minimum_film / solution.backlash
    if isinstance(operation.bulk_temperature, str):
        yield ResultWarning.of("flank-temperature-estimated", celsius=solution.bulk_temperature - 273.15)
    if operation.load_factor == 1.0:
        yield ResultWarning.of("load-factors-1")
    if gear.tip_relief is None and operation.load_sharing == "stiffness":
        yield ResultWarning.of("relief-unknown")
    if solution.case.contacts == "solved" and solution.film_loss is None:
        missing = without_heat(solution.case, solution.flanks.temperature)
        yield ResultWarning.of("flank-films-without-heat", missing=str(missing))
    if constants := shear_unused(solution.case.lubricant):
        are = "are" if len(constants) > 1 else "is"
        yield ResultWarning.of("shear-constant-unused", "machine", names=" and ".join(constants), are=are)
    if gear.contact.contact_resistance is not None and not in_axle:
        yield ResultWarning.of("key-unused", "mesh")
    if ratio <= gear.summit_height:
        yield ResultWarning.of("flanks-touch", ratio=ratio, height=gear.summit_height)
    if solution.pair.normal_backlash is None:
        yield ResultWarning.of("backlash-unknown")
    if filled > _FILLED:
        assumed = ", which is assumed" if solution.pair.normal_backlash is None else ""
        yield ResultWarning.of(
            "film-fills-backlash",
            percent=100.0 * filled,
            backlash=f"{amount(solution.backlash, 'm')}{assumed}",
            less=100.0 * _thinner(filled),
        )
    yield from _in_fillets(solution)
    yield from _outside_atlas(solution)


def _thinner(filled: float) -> float:
    """Relative decrease of a film by the film behind the teeth; ``filled``, film over the backlash.

    Films of rigid flanks carry w ~ 1/h, so that the film x j between both flanks has 1/f = 1/x - 1/(1 - x).

    Examples
    --------
    The tooth is nearly in the middle of the backlash under a small load:

    >>> round(100.0 * (1.0 - _thinner(100.0)), 3)
    0.499
    """
    return 1.0 - 0.5 * (1.0 + 2.0 * filled - math.sqrt(1.0 + 4.0 * filled**2)) / filled


def _in_fillets(solution: GearSolution) -> Iterator[ResultWarning]:
    """Warnings about contact below the involutes of both gears, in the fillets of their teeth."""
    path = solution.path
    least = path.start, path.tangent_length - path.end
    for gear, (curvature, limit) in enumerate(zip(least, solution.pair.form_curvature, strict=True), start=1):
        if curvature < limit:
            other, at, begin = 3 - gear, 1e3 * curvature, 1e3 * limit
            yield ResultWarning.of("contact-in-fillet", gear=gear, other=other, curvature=at, limit=begin)


def _outside_atlas(solution: GearSolution) -> Iterator[ResultWarning]:
    """Warning about films outside the atlas that matter: the smallest one, or lines with much of the
    capacitance. Lines that relief nearly unloads have thick films outside the atlas.
    """
    outside = solution.outside_atlas
    loads, capacitance = solution.loads, solution.capacitance_of_lines
    share = loads.mean(loads.along(outside * capacitance)) / loads.mean(loads.along(capacitance))
    if outside[solution.thinnest] or share > _OUTSIDE:
        error = 100.0 * min(1.0, float(np.max(solution.films.error[outside])))
        yield ResultWarning.of("flank-outside-atlas", percent=error)
