"""Verdict on an axle: which element breaks down first, and in which case another element is first."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.axle.solution import AxleSolution
from ehlectric.discharge.breakdown_rule import (
    TOUCHING_AT_TIMES,
    code_of,
    level_of,
    strength_interval,
)
from ehlectric.discharge.film_verdict import no_verdict, strength_clause, strength_doubt
from ehlectric.quantities.lubrication_states import CONDUCTS
from ehlectric.quantities.statement import Fact, Statement
from ehlectric.quantities.verdict import Verdict

# Assumptions about all meshes, in words.
_IF = {"always": "all meshes conduct", "never": "no mesh conducts"}


def axle_verdict(solution: AxleSolution) -> Verdict:
    """Verdict on a solved axle; its margin is the breakdown voltage over the voltage of the first element.

    Grey without a strength, and if no element with a breakdown voltage has a voltage. A margin that a change
    of the strength by 20 % takes across 1 is yellow. An element whose summits touch keeps a verdict from
    being green, because its contacts discharge as they open.
    """
    if not solution.case.discharge.has_strength:
        return no_verdict(Statement.of("no-strength"))
    ranking = [(name, ratio) for name, ratio in solution.ranking() if ratio > 0.0]
    if not ranking:
        return no_verdict(Statement.of("axle-none"))
    (first, ratio), limits = ranking[0], solution.breakdown_voltages
    margin = 1.0 / ratio
    interval = strength_interval(margin)
    level = level_of(*interval)
    code = code_of(level, likely=margin < 1.0)
    if level == "green" and _touching(solution):
        level, code = "yellow", TOUCHING_AT_TIMES
    drive = solution.case.drive
    return Verdict(
        level,
        code,
        Statement.of(
            "axle-first",
            element=first,
            voltage=ratio * limits[first],
            edge=solution.case.edge,
            breakdown=limits[first],
            margin=margin,
        ),
        Statement.of("at-axle", torque=drive.torque, speed=drive.speed, temperature=drive.temperature),
        facts=(Fact("first.breakdown_voltage", limits[first]), Fact("first.margin", margin, interval)),
        reasons=(*_reasons(solution, first), *strength_doubt(solution.case.discharge, margin)),
        assumptions=(Statement.of("axle-model"), strength_clause(solution.case.discharge)),
        bound="best",
    )


def _touching(solution: AxleSolution) -> tuple[str, ...]:
    """Names of elements without a breakdown voltage because summits touch, and that do not conduct."""
    return tuple(each.name for each in solution.elements if each.touching and each.state != CONDUCTS)


def _reasons(solution: AxleSolution, first: str) -> Iterator[Statement]:
    """Statements on the other assumptions about meshes, and on elements without a breakdown voltage."""
    others = list(_others(solution, first)) if solution.case.mesh else []
    if solution.case.mesh and not others:
        yield Statement.of("axle-first-in-all")
    yield from others
    if solution.changed_ranks:
        yield Statement.of("axle-ranks", elements=solution.changed_ranks)
    if touching := _touching(solution):
        yield Statement.of("axle-touching", elements=touching)
    for each in solution.elements:
        if each.state == CONDUCTS:
            yield Statement.of("axle-conducting", elements=(each.name,))


def _others(solution: AxleSolution, first: str) -> Iterator[Statement]:
    """Statements on assumptions about meshes with which another element is first."""
    for conduction in ("always", "never"):
        ranking = [row for row in solution.ranking(conduction) if row[1] > 0.0]
        if not ranking:
            yield Statement.of("axle-none-if", case=_IF[conduction])
        elif ranking[0][0] != first:
            name, ratio = ranking[0]
            yield Statement.of("axle-first-if", case=_IF[conduction], element=name, margin=1.0 / ratio)
