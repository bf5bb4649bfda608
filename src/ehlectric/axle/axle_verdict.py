"""Verdict on an axle: which element breaks down first, and in which case another element is first."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Protocol

from ehlectric.axle.solution import AxleSolution
from ehlectric.discharge.breakdown_rule import (
    TOUCHING_AT_TIMES,
    Chance,
    code_of,
    level_of,
    strength_interval,
)
from ehlectric.discharge.film_verdict import no_verdict, strength_clause, strength_doubt
from ehlectric.quantities.lubrication_states import CONDUCTS
from ehlectric.quantities.statement import Fact, Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import readable

# Assumptions about all meshes, in words.
_IF = {"always": "all meshes conduct", "never": "no mesh conducts"}


class _Chance(Protocol):
    """Probabilities of an element."""

    @property
    def element(self) -> str:
        """Name of the element."""

    @property
    def first(self) -> float:
        """Probability that the element is the first."""


class _Deciding(Protocol):
    """Inputs that decide which of two elements is first."""

    @property
    def elements(self) -> tuple[str, str]:
        """Names of both elements."""

    @property
    def shares(self) -> tuple[tuple[str, str, float], ...]:
        """Key and label of the inputs, with their shares, the largest first."""


class _Probable(Protocol):
    """Distribution of the margin of an axle."""

    @property
    def chance(self) -> Chance:
        """Probability and interval as a verdict says them."""

    @property
    def ranks_inputs(self) -> bool:
        """Whether the shares of the inputs are good enough to recommend a measurement."""

    @property
    def elements(self) -> Sequence[_Chance]:
        """Probabilities of all elements."""

    @property
    def deciding(self) -> _Deciding | None:
        """Inputs that decide which element is first."""


def axle_verdict(
    solution: AxleSolution, uncertainty: _Probable | None = None, *, pending: bool = False
) -> Verdict:
    """Verdict on a solved axle, whose level follows the probability of breakdown if it is known.

    Its margin is the breakdown voltage divided by the voltage of the first element.

    ``pending``, whether the axle has probabilities that are not computed; the verdict then states this.
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
    code, doubts = code_of(level, likely=margin < 1.0), tuple(strength_doubt(solution.case.discharge, margin))
    facts: tuple[Fact, ...] = (
        Fact("first.breakdown_voltage", limits[first]),
        Fact("first.margin", margin, interval),
    )
    if uncertainty is not None:
        chance = uncertainty.chance
        level, code = chance.level, chance.code
        ranked = uncertainty.ranks_inputs
        stated = (each for each in chance.statements() if ranked or not each.code.startswith("measure"))
        doubts = (*stated, *_firsts(uncertainty))
        known = None if chance.failed or math.isinf(chance.high) else (chance.low, chance.high)
        facts = (
            Fact("first.breakdown_voltage", limits[first]),
            Fact("first.margin", margin, known),
            Fact("uncertainty.breakdown_probability", chance.probability, chance.bounds),
        )
    without = (Statement.of("axle-without-probability"),) if pending else ()
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
        facts=facts,
        reasons=(*_reasons(solution, first), *doubts, *without),
        assumptions=(Statement.of("axle-model"), strength_clause(solution.case.discharge)),
        bound="best",
    )


# Least probability of an element that is listed as the first.
_LEAST_FIRST = 0.01


def _firsts(uncertainty: _Probable) -> Iterator[Statement]:
    """Statements on the elements that are first at some points, and on the input that decides."""
    chances = sorted(uncertainty.elements, key=lambda each: -each.first)
    listed = tuple(
        f"{each.element} {readable(100.0 * each.first, 2)} %"
        for each in chances
        if each.first >= _LEAST_FIRST
    )
    if listed:
        yield Statement.of("axle-first-chances", elements=listed)
    deciding = uncertainty.deciding
    if deciding is not None and deciding.shares:
        _, label, share = deciding.shares[0]
        first, second = deciding.elements
        yield Statement.of("axle-deciding", first=first, second=second, input=label, share=share)


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
