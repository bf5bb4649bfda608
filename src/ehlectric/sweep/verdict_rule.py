"""Verdict on a sweep: at how many of its points breakdown is expected, and at which value that begins."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import equal_bearings, formula_factor
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.defaults import ISOTHERMAL, QUICK
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.discharge.breakdown_rule import TOUCHING, strength_interval
from ehlectric.discharge.film_verdict import DOUBTS, no_verdict, strength_clause
from ehlectric.quantities.formats import Scale
from ehlectric.quantities.lubrication_states import AT_TIMES, CONDUCTS, INSULATES, conducts, is_shorted
from ehlectric.quantities.rows import value_at
from ehlectric.quantities.statement import Bound, Fact, Level, Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import readable
from ehlectric.runtime.display import is_number
from ehlectric.sweep.axis_labels import label_of
from ehlectric.sweep.points import Point, SweepPoints

# Inputs of a bearing with which its films are ideal.
_IDEAL = ("film_factor", "summit_height")

# Reason for which a bearing whose surfaces touch, at times at least, has no margin.
_TOUCH = "with frequent asperity contact (discharges likely as contacts open)"

# Reason for which a mesh that conducts has no margin.
_CONDUCT = "with a mesh that conducts"


def sweep_verdict(results: SweepPoints) -> Verdict | None:
    """Verdict on a sweep from the margins of its points.

    Returns green where no margin is below 1, red where all are, else yellow; it is not green where points
    have no margin: they are not solved or must not be used, or their surfaces touch. It is not red if
    points are not solved or must not be used: their margins may lie on the other side. Nor is it green where
    the margin of a contact belongs to a boundary film, as its asperities touch. Nor is it green or red where
    the margin of a point may lie on the other side of 1, by the accuracy of films that are not solved, by its
    warnings, or at a strength that differs by 20 %. Without any margin it is red where the surfaces touch at
    all points of a bearing with a motor, yellow where they touch at some or without a motor, and None where
    they touch at none, and None for drives.
    """
    if isinstance(results.case, DriveCase):
        return None  # it is a number of discharges whose harm depends on the bearing, not on a margin
    usable, states = _margins(results), (*_first_elements(results), *_mesh_states(results))
    known = usable[np.isfinite(usable)]
    if not known.size:
        return _without_voltages(results, states)
    below, missing = int(np.sum(known < 1.0)), usable.size - known.size
    lowest, highest = float(np.min(known)), float(np.max(known))
    doubts = list(_doubts(results, usable))
    word = "likely" if doubts and below else "expected"
    reasons = list(_crossings(results, usable))
    if missing:
        reasons.append(Statement.of("points-without-margin", missing=missing, why=_why(results, usable)))
    touching = sum(
        math.isfinite(margin) and any(warning.code == "asperities-touch" for warning in point.warnings)
        for point, margin in zip(results.points, usable, strict=True)
    )
    if touching:
        reasons.append(Statement.of("points-on-spots", number=touching))
    # A point that is not solved may lie on either side, and a mesh that conducts has no film to break down.
    short = any(conducts(point.summary) for point in results.points)
    everywhere = below == known.size and not short and not _not_solved(results, usable)
    level: Level = "red" if everywhere else "yellow" if below or missing or touching else "green"
    if doubts:
        level = "yellow"
    bound, clauses = _assumptions(results)
    return Verdict(
        level,
        _code(level, below, word),
        Statement.of("points-margins", word=word, below=below, known=known.size, low=lowest, high=highest),
        facts=(Fact("sweep.margin", lowest, (lowest, highest)),),
        reasons=(*states, *reasons, *doubts),
        assumptions=clauses,
        bound=bound,
    )


def _code(level: Level, below: int, word: str) -> str:
    """Code of a verdict on points, of which some have a margin below 1."""
    if not below:
        return "points-none" if level == "green" else "points-none-possible"
    if level == "red":
        return "points-all"
    return "points-some-likely" if word == "likely" else "points-some"


def _not_solved(results: SweepPoints, margins: Array) -> int:
    """Number of the points without a margin that are not solved or must not be used."""
    return sum(
        not math.isfinite(margin) and (not point.solved or point.doubtful)
        for point, margin in zip(results.points, margins, strict=True)
    )


def _without_voltages(results: SweepPoints, of_mesh: tuple[Statement, ...]) -> Verdict | None:
    """Verdict on points without a margin: red where contacts open and close at all; where at none, states of
    the mesh of a gear pair without a verdict, else None.
    """
    states = [is_shorted(point.summary) for point in results.points]
    count = sum(states)
    if not count:
        return no_verdict(of_mesh[0]) if of_mesh else None
    sure = all(point.solved and not point.doubtful for point in results.points)
    match results.case:
        case BearingCase(motor=motor):
            # With a motor, its common-mode voltage lies on the shaft.
            driven = motor is not None
        case GearCase(gear=gear):
            driven = gear.contact.voltage is not None
        case _:
            driven = False
    everywhere = sure and count == len(states) and driven
    answer = Statement.of("points-touching-all", number=count, known=len(states))
    return Verdict("red" if everywhere else "yellow", TOUCHING, answer, reasons=of_mesh)


def _first_elements(results: SweepPoints) -> Iterator[Statement]:
    """Statement on the elements of an axle that break down first, the most frequent one first."""
    names = [value_at(point.usable, "first.element") for point in results.points]
    counts = Counter(name for name in names if name is not None)
    if counts:
        texts = tuple(f"{name} at {count}" for name, count in counts.most_common())
        yield Statement.of("points-first", elements=texts, known=len(names))


def _mesh_states(results: SweepPoints) -> Iterator[Statement]:
    """Statements on the states of each mesh at the points of a sweep."""
    case = results.case
    meshes = {"mesh": ""}
    if isinstance(case, AxleCase):
        keys = case.keys_of_elements().items()
        meshes = {f"elements.{key}": name for key, name in keys if name in case.names_of_meshes()}
    for table, name in meshes.items():
        states = [value_at(point.usable, f"{table}.state") for point in results.points]
        counts = {state: states.count(state) for state in (CONDUCTS, AT_TIMES, INSULATES)}
        known = sum(counts.values())
        if known:
            yield Statement.of(
                "points-states-of-mesh" if name else "points-mesh-states",
                conducts=counts[CONDUCTS],
                at_times=counts[AT_TIMES],
                insulates=counts[INSULATES],
                known=known,
                **({"element": name} if name else {}),
            )


def _doubts(results: SweepPoints, margins: Array) -> Iterator[Statement]:
    """Statements for which margins may lie on the other side of 1."""
    known = [
        (point, margin)
        for point, margin in zip(results.points, margins, strict=True)
        if math.isfinite(margin)
    ]
    errors = [_film_error(point, results.case) for point, _ in known]
    off = max(errors)
    near = sum(
        margin / (1.0 + part * error) < 1.0 <= margin * (1.0 + part * error)
        for error, part, (_, margin) in zip(
            errors, (_over_summits(point, results.case) for point, _ in known), known, strict=True
        )
    )
    if near:
        yield Statement.of("points-within-films", number=near, error=off)
    if not _strength_varies(results):
        weak = sum(low < 1.0 <= high for low, high in (strength_interval(margin) for _, margin in known))
        if weak:
            yield Statement.of("points-by-strength", number=weak)
    doubtful = sum(
        bool({warning.code for warning in point.warnings} & {*DOUBTS, "partial-film"})
        for point, margin in known
        if margin >= 1.0
    )
    if doubtful:
        yield Statement.of("points-with-doubts", number=doubtful)


def _film_error(point: Point, case: SolvedCase) -> float:
    """Relative film error at gear pairs and at bearings that are not solved; 0 at other points."""
    summary = point.summary or {}
    contacts = value_at(summary, "bearing.contacts")
    if isinstance(case, GearCase):
        return float(value_at(summary, "mesh.film_error") or 0.0)
    if contacts not in QUICK or not isinstance(case, BearingCase):
        return 0.0
    if contacts == "formula":
        return formula_factor(case.bearing.kind) - 1.0
    return float(value_at(summary, "bearing.film_error") or 0.0)


def _over_summits(point: Point, case: SolvedCase) -> float:
    """Relative change of a margin divided by a small change of all films: more than 1 under summits."""
    match case:
        case BearingCase():
            height, key = case.bearing.summit_height, "bearing"
            ratio = value_at(point.summary or {}, "bearing.lambda_ratio")
        case GearCase():
            height, key = case.gear.summit_height, "gear"
            ratio = value_at(point.summary or {}, "mesh.lambda_ratio")
        case _:
            return 1.0
    height = point.inputs.get(f"{key}.summit_height", height)
    return ratio / (ratio - height) if is_number(ratio) and is_number(height) and ratio > height else 1.0


def _strength_varies(results: SweepPoints) -> bool:
    """Whether the strength is among the varied inputs."""
    return any(key.startswith("discharge.") for key in results.varied)


def _strength_of(results: SweepPoints, case: SolvedCase) -> Statement:
    """Statement on the dielectric strength of the points."""
    if _strength_varies(results) or isinstance(case, DriveCase) or case.discharge is None:
        return Statement.of("strength-varied")
    return strength_clause(case.discharge)


def _assumptions(results: SweepPoints) -> tuple[Bound, tuple[Statement, ...]]:
    """Bound and clauses on the assumptions behind the margins, which drives have not."""
    case = results.case
    if isinstance(case, DriveCase) or case.discharge is None or not case.discharge.has_strength:
        return "", ()
    bound: Bound = "upper"
    if isinstance(case, BearingCase):
        factors = {value_at(point.summary or {}, "bearing.film_factor") for point in results.points}
        taken = [
            tuple(point.inputs.get(f"bearing.{key}", getattr(case.bearing, key)) for key in _IDEAL)
            for point in results.points
        ]
        smooth = any(not height for _, height in taken)
        kinds = [
            *(["isothermal", "fully flooded"] if factors & {1.0} else []),
            "smooth" if smooth else "rough",
        ]
        ideal = smooth or any(factor in ISOTHERMAL for factor, _ in taken)
        bound = "upper" if ideal else "best"
    elif isinstance(case, AxleCase):
        return "best", (Statement.of("axle-model"), _strength_of(results, case))
    elif isinstance(case, GearCase):
        bound, kinds = "best", ["fully flooded", "rough"]
    else:
        supplied = case.inlet is not None or any(key.startswith("inlet.") for key in results.varied)
        heated = case.film is not None and case.film.thermal and "film.thermal" not in results.varied
        neglected = {"isothermal": not heated, "fully flooded": not supplied}
        kinds = [kind for kind, holds in neglected.items() if holds]
    films = (Statement.of("films", words=tuple(kinds)),) if kinds else ()
    strength = _strength_of(results, case)
    equal: tuple[Statement, ...] = ()
    if isinstance(case, BearingCase) and "motor.second_bearing_capacitance" not in results.varied:
        equal = equal_bearings(case)
    return bound if kinds else "", (*films, strength, *equal)


# Tables of summaries with a margin, for cases that are no contact.
_TABLES = {BearingCase: "bearing", GearCase: "mesh", AxleCase: "first"}


def _margins(results: SweepPoints) -> Array:
    """Margin at every point; NaN where a point has none or its film must not be used."""
    table = _TABLES.get(type(results.case), "discharge")
    values = [value_at(point.usable, f"{table}.margin") for point in results.points]
    return np.array([math.nan if value is None else float(value) for value in values])


def _why(results: SweepPoints, margins: Array) -> str:
    """Reasons why points have no margin, with their numbers."""
    counts: dict[str, int] = {}
    for point, margin in zip(results.points, margins, strict=True):
        if math.isfinite(margin):
            continue
        if not point.solved:
            reason = "not solved"
        elif point.doubtful:
            reason = "solved, but not to be used"
        elif conducts(point.summary):
            reason = _CONDUCT
        else:
            reason = _TOUCH if is_shorted(point.summary) else "no breakdown voltage or no voltage"
        counts[reason] = counts.get(reason, 0) + 1
    if len(counts) == 1:
        return next(iter(counts))
    return ", ".join(f"{count} {reason}" for reason, count in counts.items())


# Margin instead of 0, where summits touch, for a logarithm; breakdown then extends to the next point.
_TOUCHING = 1e-300


def _crossings(results: SweepPoints, margins: Array) -> list[Statement]:
    """Statements on the values of a single varied input at which the margin crosses 1."""
    if len(results.varied) != 1 or results.design == "sobol":
        return []
    key = results.varied[0]
    inputs = [point.inputs[key] for point in results.points]
    if not all(map(is_number, inputs)):
        return []
    rows = sorted(
        (float(value), max(float(margin), _TOUCHING))
        for value, margin in zip(inputs, margins, strict=True)
        if math.isfinite(margin)
    )
    return [
        Statement.of(
            "margin-crosses",
            way="below" if low[1] < high[1] else "above",
            key=key,
            at=crossing(low, high),
            value=value_text(key, crossing(low, high), results.case),
        )
        for low, high in pairwise(rows)
        if (low[1] < 1.0) != (high[1] < 1.0)
    ]


def crossing(low: tuple[float, float], high: tuple[float, float]) -> float:
    """Input at which the margin is 1 between two points, interpolated in the logarithm of the margin.

    Examples
    --------
    A margin in proportion to the speed:

    >>> round(crossing((100.0, 0.5), (400.0, 2.0)), 9)
    200.0
    """
    logarithmic = low[0] > 0.0
    ends = (math.log(low[0]), math.log(high[0])) if logarithmic else (low[0], high[0])
    part = -math.log(low[1]) / (math.log(high[1]) - math.log(low[1]))
    place = ends[0] + part * (ends[1] - ends[0])
    return math.exp(place) if logarithmic else place


def value_text(key: str, value: Any, case: SolvedCase) -> str:
    """Value of an input in the unit that is printed, with three digits; temperatures in degrees Celsius."""
    label = label_of(key, case)
    scale = Scale(180.0 / math.pi, "deg") if label.unit == "rad" else label.scaled(np.array([value]))
    return f"{readable(scale.of(value))} {scale.unit}".rstrip()
