"""Verdict on an axle: which element discharges first, and in which case another element is first."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Protocol

from ehlectric.axle.solution import AxleSolution
from ehlectric.discharge.breakdown_rule import (
    TOUCHING_AT_TIMES,
    Chance,
    code_of,
    doubted,
    level_of,
    strength_interval,
    touching_rule,
)
from ehlectric.discharge.film_verdict import no_verdict, strength_clause, strength_doubt, unusable
from ehlectric.quantities.formats import time_share_text
from ehlectric.quantities.lubrication_states import AT_TIMES, CONDUCTS
from ehlectric.quantities.statement import Fact, Level, Statement
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

    The first element has the largest voltage divided by its breakdown voltage. An element whose summits
    touch under a voltage precedes all others, because its contacts discharge at any voltage as they open. The
    margin is the breakdown voltage divided by the voltage of the first element, 0 if its summits touch.

    ``pending``, whether the axle has probabilities that are not computed; the verdict then states this.
    Grey without a strength, if no element with a voltage breaks down, if the films must not be used, and if
    the level depends on a capacitance of ceramic elements that is not known. A margin that a change of the
    strength by 20 % takes across 1 is yellow.
    """
    if (refused := unusable(solution.warnings)) is not None:
        return refused
    if not solution.case.has_strength:
        return no_verdict(Statement.of("no-strength"))
    ranking = solution.discharging()
    if not ranking:
        return no_verdict(Statement.of("axle-none"))
    (first, ratio), limits = ranking[0], solution.breakdown_voltages
    lowest, largest = solution.first_ratios
    if solution.bounded and _level_of(lowest) != _level_of(largest):
        return no_verdict(
            Statement.of("axle-ceramic", low=_ratio(lowest), high=_ratio(largest), elements=solution.bounded)
        )
    margin, touching, discharge = 1.0 / ratio, first not in limits, solution.case.strength_in(first)
    interval = None if touching else strength_interval(margin)
    chance = None if uncertainty is None else uncertainty.chance
    level, code = _level(solution, margin, chance, touching=touching)
    # The probability holds for capacitances that are upper bounds, with which the voltages are lower, and
    # without the oscillations of inductances.
    level, code = doubted(
        level,
        code,
        doubts=(bool(solution.bounded) and _level_of(largest) != "green")
        or (solution.rings and margin < solution.overshoot),
        touching=any(name not in limits for name, _ in ranking),
    )
    # The margin of touching summits does not depend on the strength.
    doubts: tuple[Statement, ...] = () if touching else tuple(strength_doubt(discharge, margin))
    facts: tuple[Fact, ...] = () if touching else (Fact("first.breakdown_voltage", limits[first]),)
    if uncertainty is not None and chance is not None:
        # A margin that is 0 at almost all points has no spread that a measurement would reduce.
        ranked = uncertainty.ranks_inputs and chance.high > 0.0
        stated = (each for each in chance.statements() if ranked or not each.code.startswith("measure"))
        doubts = (*stated, *_firsts(uncertainty))
        interval = None if chance.failed or math.isinf(chance.high) else (chance.low, chance.high)
        facts += (
            Fact("first.margin", margin, interval),
            Fact("uncertainty.breakdown_probability", chance.probability, chance.bounds),
        )
    else:
        facts += (Fact("first.margin", margin, interval),)
    uncomputed = (Statement.of("axle-without-probability"),) if pending else ()
    drive = solution.case.drive
    return Verdict(
        level,
        code,
        Statement.of(
            "axle-first-touches",
            element=first,
            voltage=solution.voltage_of(first),
            edge=solution.edge.voltage,
        )
        if touching
        else _first_film(solution, first, "axle-first"),
        Statement.of("at-axle", torque=drive.torque, speed=drive.speed, temperature=drive.temperature),
        facts=facts,
        reasons=(*_reasons(solution, first), *doubts, *uncomputed),
        assumptions=(Statement.of("axle-model"), strength_clause(discharge)),
        bound="best",
    )


def _level_of(ratio: float) -> Level:
    """Level of a ratio U/V_b without its probability."""
    return level_of(*strength_interval(1.0 / ratio)) if ratio else "green"


def _ratio(ratio: float) -> str:
    """Ratio U/V_b as text."""
    return readable(ratio, 2) if math.isfinite(ratio) else "touching summits"


def _level(
    solution: AxleSolution, margin: float, chance: Chance | None, *, touching: bool
) -> tuple[Level, str]:
    """Level and code of a verdict: by the probability, or by the margin.

    If the summits of the first element touch and its margin is below 1, both follow the rule of surfaces that
    touch, unless the probability, or the films that separate their surfaces, make breakdown expected.
    """
    if chance is not None and (chance.level == "red" or not touching or margin >= 1.0):
        return chance.level, chance.code
    if touching and margin >= 1.0:
        return "yellow", TOUCHING_AT_TIMES
    if not touching:
        level = level_of(*strength_interval(margin))
        return level, code_of(level, likely=margin < 1.0)
    films = max(solution.ratios().values(), default=0.0)
    if chance is None and films > 0.0 and level_of(*strength_interval(1.0 / films)) == "red":
        return "red", code_of("red", likely=True)
    return touching_rule(chance, driven=True)


def _first_film(solution: AxleSolution, name: str, code: str) -> Statement:
    """Statement on the voltages of an element whose film separates its surfaces."""
    voltage, limit = solution.voltage_of(name), solution.breakdown_voltages[name]
    return Statement.of(
        code,
        element=name,
        voltage=voltage,
        edge=solution.edge.voltage,
        breakdown=limit,
        margin=limit / voltage,
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


def _reasons(solution: AxleSolution, first: str) -> Iterator[Statement]:
    """Statements on the other assumptions about meshes, and on elements that touch or conduct."""
    ranking, limits = [name for name, _ in solution.discharging()], solution.breakdown_voltages
    if touching := tuple(name for name in ranking if name not in limits and name != first):
        yield Statement.of("axle-touching", elements=touching)
    films = [name for name in ranking if name in limits]
    if films and films[0] != first:
        yield _first_film(solution, films[0], "axle-first-film")
    if solution.rings:
        yield Statement.of("axle-rings", times=solution.overshoot)
    others = list(_others(solution, first)) if solution.case.mesh else []
    if solution.case.mesh and not others:
        yield Statement.of("axle-first-in-all")
    yield from others
    if solution.changed_ranks:
        yield Statement.of("axle-ranks", elements=solution.changed_ranks)
    parts = {each.name: each.insulating_part("by-film") for each in solution.elements}
    almost = tuple(name for name, part in parts.items() if 0.0 < part < 1.0)
    at_times = tuple(
        f"{each.name} {time_share_text(each.contact_time_share)}"
        for each in solution.elements
        if each.state == AT_TIMES and each.name not in almost
    )
    if at_times:
        yield Statement.of("axle-conducting-at-times", elements=at_times)
    if almost:
        yield Statement.of("axle-almost-conducting", elements=almost)
    for each in solution.elements:
        if each.state == CONDUCTS:
            yield Statement.of("axle-conducting", elements=(each.name,))


def _others(solution: AxleSolution, first: str) -> Iterator[Statement]:
    """Statements on assumptions about meshes with which another element is first."""
    for conduction in ("always", "never"):
        ranking = solution.discharging(conduction)
        if not ranking:
            yield Statement.of("axle-none-if", case=_IF[conduction])
        elif ranking[0][0] != first:
            name, ratio = ranking[0]
            about = {"case": _IF[conduction], "element": name}
            if name not in solution.breakdown_voltages:
                yield Statement.of("axle-touches-if", **about)
            else:
                yield Statement.of("axle-first-if", **about, margin=1.0 / ratio)
