"""Verdict on a gear mesh: whether its film breaks down, and what the answer rests on."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Protocol

import numpy as np

from ehlectric.cases.gear_inputs import Conduction
from ehlectric.discharge.breakdown_rule import (
    TOUCHING_AT_TIMES,
    Chance,
    code_of,
    level_of,
    strength_interval,
    touching_rule,
)
from ehlectric.discharge.film_verdict import no_verdict, strength_clause, strength_doubt
from ehlectric.gear.solution import GearSolution
from ehlectric.quantities.lubrication_states import AT_TIMES, CONDUCTS, INSULATES
from ehlectric.quantities.statement import Fact, Statement
from ehlectric.quantities.verdict import Verdict

# Shares of time up to which a mesh is called insulating, and from which it is called conducting.
_INSULATING, _CONDUCTING = 0.01, 0.99

# Share of time from which a network with the mesh as a conductor has a part in the voltages (engineering
# judgement).
_MOSTLY_CONDUCTING = 0.95


def state_of(solution: GearSolution) -> str:
    """State of the mesh: what its conduction is set to, or by the share of time in which it conducts."""
    return state_at(solution.mean_contact_share, solution.case.gear.contact.conduction)


def state_at(share: float, conduction: Conduction) -> str:
    """State of a mesh at a share of time with metallic contact.

    Examples
    --------
    >>> state_at(0.5, "by-film"), state_at(0.5, "never")
    ('conducts at times', 'insulates')
    """
    if conduction != "by-film":
        return CONDUCTS if conduction == "always" else INSULATES
    return CONDUCTS if share >= _CONDUCTING else INSULATES if share <= _INSULATING else AT_TIMES


def insulating_part(share: float, conduction: Conduction) -> float:
    """Weight of the network in which a mesh insulates, at a share of time with metallic contact.

    The network in which the mesh conducts has the rest of the weight, so that no voltage jumps as the mesh
    becomes a conductor.

    Examples
    --------
    >>> [round(insulating_part(share, "by-film"), 6) for share in (0.5, 0.95, 0.97, 0.99)]
    [1.0, 1.0, 0.5, 0.0]
    >>> insulating_part(0.5, "always"), insulating_part(0.5, "never")
    (0.0, 1.0)
    """
    if conduction != "by-film":
        return float(conduction == "never")
    part = (_CONDUCTING - share) / (_CONDUCTING - _MOSTLY_CONDUCTING)
    return min(max(part, 0.0), 1.0)


def breakdown_margin(solution: GearSolution) -> float | None:
    """Smallest breakdown voltage over the voltage between both gears; None without one of them, where summits
    touch, and for a mesh that conducts.
    """
    voltage, breakdown = solution.case.gear.contact.voltage, solution.breakdown_voltage
    if voltage is None or breakdown is None or not np.min(breakdown) or state_of(solution) == CONDUCTS:
        return None
    return float(np.min(breakdown)) / voltage


class _Probable(Protocol):
    """Distribution of the margin of a mesh."""

    @property
    def chance(self) -> Chance:
        """Probability and interval as a verdict says them."""

    @property
    def conduction_probability(self) -> float:
        """Probability that the mesh conducts."""


def gear_verdict(
    solution: GearSolution, uncertainty: _Probable | None = None, *, pending: bool = False
) -> Verdict:
    """Verdict on a solved gear pair, whose level follows the probability of breakdown if it is known.

    ``pending``, whether the mesh has a probability that is not computed; the verdict then states this.
    Grey without a strength or a voltage between both gears. A mesh that conducts has no voltage to break
    down, and no strength gives a voltage to summits that touch: both come before a missing strength. Without
    a range of the strength, a margin that a change by 20 % or the error of the film takes across 1 is yellow.
    A mesh that conducts at times is not green, because contacts discharge as they open.
    """
    at = _operating_point(solution)
    state = state_of(solution)
    breakdown = solution.breakdown_voltage
    share = solution.mean_contact_share
    ratio = solution.minimum_film / solution.rq
    assumed = tuple(_assumptions(solution))
    given = solution.case.gear.contact.conduction != "by-film"
    of_state = Statement.of(
        "mesh-state-given" if given else "mesh-state", state=state, share=share, lambda_ratio=ratio
    )
    probable = tuple(_probability(uncertainty))
    without = (Statement.of("mesh-without-probability"),) if pending else ()
    if state == CONDUCTS:
        values = {} if given else {"share": share, "lambda_ratio": ratio}
        answer = Statement.of("mesh-conducts-given" if given else "mesh-conducts", **values)
        of_share = (Fact("mesh.contact_time_share", share),)
        conducting = replace(no_verdict(answer, code="mesh-conducts"), reasons=probable, facts=of_share)
        return replace(conducting, at=at, assumptions=assumed)
    if np.nanmin(solution.gap) <= 0.0:
        chance = None if uncertainty is None else uncertainty.chance
        return _touching(solution, (of_state, *probable, *without), assumed, chance)
    if breakdown is None:
        return replace(
            no_verdict(Statement.of("no-strength")), at=at, reasons=(of_state,), assumptions=assumed
        )
    first = float(np.min(breakdown))
    margin, voltage = breakdown_margin(solution), solution.case.gear.contact.voltage
    if margin is None or voltage is None:
        answer = Statement.of("mesh-breakdown", breakdown=first)
        return replace(no_verdict(answer), at=at, reasons=(of_state,), assumptions=assumed)
    error = solution.film_error
    weakest, strongest = strength_interval(margin)
    interval = min(weakest, margin * (1.0 - error)), max(strongest, margin * (1.0 + error))
    level = level_of(*interval)
    code, doubts = code_of(level, likely=margin < 1.0), strength_doubt(solution.case.discharge, margin)
    facts: tuple[Fact, ...] = (Fact("mesh.breakdown_voltage", first), Fact("mesh.margin", margin, interval))
    if uncertainty is not None:
        chance = uncertainty.chance
        level, code, doubts = chance.level, chance.code, (*chance.statements(), *probable)
        known = None if chance.failed or math.isinf(chance.high) else (chance.low, chance.high)
        facts = (
            Fact("mesh.breakdown_voltage", first),
            Fact("mesh.margin", margin, known),
            Fact("uncertainty.breakdown_probability", chance.probability, chance.bounds),
        )
    if level == "green" and state == AT_TIMES:
        level, code = "yellow", TOUCHING_AT_TIMES
    return Verdict(
        level,
        code,
        Statement.of("mesh-voltages", voltage=voltage, breakdown=first, margin=margin),
        at,
        facts=facts,
        reasons=(of_state, *doubts, *without),
        assumptions=assumed,
        bound="best",
    )


def _probability(uncertainty: _Probable | None) -> Iterator[Statement]:
    """Statement on the probability that the mesh conducts; none where it does so at no point."""
    if uncertainty is not None and uncertainty.conduction_probability > 0.0:
        yield Statement.of("mesh-conducts-in-cases", probability=uncertainty.conduction_probability)


def _touching(
    solution: GearSolution,
    reasons: tuple[Statement, ...],
    assumed: tuple[Statement, ...],
    chance: Chance | None,
) -> Verdict:
    """Verdict on a mesh whose summits touch, for which no voltage is computed."""
    if chance is not None:
        reasons += (Statement.of("probability-of-touching", probability=chance.stated),)
    level, code = touching_rule(chance, driven=solution.case.gear.contact.voltage is not None)
    voltage, smooth = solution.case.gear.contact.voltage, solution.smooth_breakdown_voltage
    answer = Statement.of(
        "mesh-touching",
        height=solution.case.gear.summit_height,
        driven=None if voltage is None else Statement.of("mesh-driven", voltage=voltage),
        smooth=None if smooth is None else Statement.of("mesh-smooth", breakdown=smooth),
    )
    return Verdict(level, code, answer, _operating_point(solution), reasons=reasons, assumptions=assumed)


def _operating_point(solution: GearSolution) -> Statement:
    """Torque, speed and temperature of the flanks."""
    operation = solution.case.gear.operation
    return Statement.of(
        "at-mesh",
        torque=operation.pinion_torque,
        speed=operation.pinion_speed,
        temperature=solution.bulk_temperature,
    )


# Keys of the roughness.
_ROUGHNESS = ("gear.flank_ra", "gear.composite_rq")


def _assumptions(solution: GearSolution) -> Iterator[Statement]:
    """Clauses on what is assumed."""
    operation = solution.case.gear.operation
    yield Statement.of("mesh-film", law=operation.load_sharing, factor=operation.load_factor)
    touching = np.nanmin(solution.gap) <= 0.0
    stated = {entry.key: (entry.low, entry.high) for entry in solution.case.ranges or ()}
    has_strength = solution.case.discharge.has_strength
    if has_strength and not touching and state_of(solution) != CONDUCTS:
        yield strength_clause(solution.case.discharge, stated.get("discharge.dielectric_strength"))
    if (has_strength or touching) and not any(key.startswith(_ROUGHNESS) for key in stated):
        yield Statement.of("exact-roughness", rq=solution.rq)
    if isinstance(operation.bulk_temperature, str):
        yield Statement.of("mesh-bulk", temperature=solution.bulk_temperature)
