"""Bearing at several shaft speeds, and curves of its quantities over the speed."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing.bearing_discharges import with_films_scaled
from ehlectric.bearing.bearing_touching import CAPACITIVE, duty_of
from ehlectric.bearing.curve_nodes import where_it_bends
from ehlectric.bearing.film_factor import solved_scales
from ehlectric.bearing.many_points import single_tables
from ehlectric.bearing.perturbed_bearings import (
    AT_CASE,
    LEAST,
    MOST,
    PARTS,
    Sampled,
    Several,
    at_speeds,
    log_of,
    over_parts,
)
from ehlectric.bearing.quick_contacts import quick_case
from ehlectric.bearing.solution import (
    BearingSolution,
    contact_limit,
    lambda_ratio,
)
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.units import rpm
from ehlectric.runtime.files import plain

# Largest relative error of a curve between two of its speeds, and least distance of the logarithms of two
# speeds.
_BEND, _CLOSEST = 3e-3, 5e-4


def over_speed(
    case: BearingCase, count: int | None = None, *, ratio_of_case: float | None = None
) -> tuple[list[Speed], list[ResultWarning]]:
    """Compute the numbers of a bearing at speeds around the speed of its case, with contacts from the atlas.

    A case with formulas for its contacts keeps the formulas. Contacts have fewer loads than in
    ``solve_bearing``: numbers differ by less than 1e-3.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing.
    count : int, optional
        Number of speeds in a geometric series. By default, the speeds of ``PARTS`` are computed, and further
        speeds between them, until every curve is within 0.3 % of straight lines between its logarithms.
    ratio_of_case : float, optional
        Lambda ratio of the bearing at the speed of the case, dimensionless, to which the films are scaled.

    Returns
    -------
    points : list of tuple
        Speeds of the inner ring [rad/s] with summaries of numbers and inputs, in increasing order.
    left_out : list of ResultWarning
        What could not be computed, and why: single speeds, breakdown voltages, or everything.

    Examples
    --------
    The capacitance falls with the speed, because the films become thicker:

    >>> case = BearingCase.from_dict(
    ...     {
    ...         "bearing": {
    ...             "base": "6208", "radial_clearance": "10 um", "element_material": "steel",
    ...             "ring_material": "steel", "radial_load": "1 kN", "inner_speed": "1000 rpm",
    ...             "temperature": "70 degC", "composite_rq": "0.03 um", "fill": "oil", "film_factor": "none",
    ...         },
    ...         "lubricant": {"base": "paper", "viscosity": "20 mPa s"},
    ...     }
    ... )
    >>> points, left_out = over_speed(case, count=2)
    >>> slow, fast = points[0][1]["bearing"], points[-1][1]["bearing"]
    >>> slow["capacitance"] > fast["capacitance"], left_out
    (True, [])
    """
    changed, refused = quick_case(case)
    left_out = []
    if refused is not None:
        left_out.append(ResultWarning.of("speed-left-out", "incomplete", reason=refused))
    if changed is None:
        return [], left_out
    scaled = changed if ratio_of_case is None else _with_ratio(changed, ratio_of_case)
    if count is None:
        speeds, several = over_parts(scaled)
    else:
        speeds = case.bearing.inner_speed * np.geomspace(LEAST, MOST, count)
        several = at_speeds(scaled, speeds)
    for place, reason in sorted(several.reasons.items()):
        warning = ResultWarning.of("speed-left-out", "one_speed", speed=rpm(speeds[place]), reason=reason)
        left_out.append(warning)
    points = dict(_points(changed, several))
    if count is None and len(points) > 1:
        limit = float(contact_limit(scaled.bearing.summit_height))
        _add_bends(points, lambda speeds: _points(changed, at_speeds(scaled, speeds)), limit)
    return sorted(points.items()), left_out


def _with_ratio(case: BearingCase, ratio_of_case: float) -> BearingCase:
    """Case with a given lambda ratio at its own speed; unchanged without a result at this speed."""
    _, several = over_parts(case)
    ratio = several.columns(lambda at: (lambda_ratio(at),), 1)[0, AT_CASE]
    return with_films_scaled(case, ratio_of_case / ratio) if ratio > 0.0 else case


def _points(case: BearingCase, several: Several) -> list[Speed]:
    """Speeds [rad/s] with the numbers, texts and inputs of a bearing, as in its summary."""
    inputs, points = plain(case.all_inputs()), []
    for part in several.parts:
        speeds = np.asarray(part.solution.case.bearing.inner_speed).tolist()
        for speed, tables in zip(speeds, single_tables(part), strict=True):
            bearing = {**inputs["bearing"], "inner_speed": speed}
            known = {"converged": True, "inputs": {**inputs, "bearing": bearing}}
            points.append((speed, known | tables))
    return points


def _add_bends(
    points: dict[float, dict[str, Any]], solved: Callable[[Array], list[Speed]], limit: float
) -> None:
    """Add speeds where a curve bends, and where it begins or ends, to points by their speeds [rad/s].

    ``limit``, lambda ratio at which the surfaces part.
    """

    def logs(log: Array) -> Array:
        """Logarithms of the values at logarithms of speeds, shape (n,) -> (k, n)."""
        computed = dict(solved(np.exp(log)))
        points.update(computed)
        return log_of(_columns([computed.get(speed) for speed in np.exp(log).tolist()]))

    log = np.log(sorted(points))
    known = log_of(_columns([points[speed] for speed in sorted(points)]))
    further = _foreseen(log, known[_KEYS.index("lambda_ratio")], limit)
    values = np.concatenate([known, logs(further)], axis=1)
    log = np.concatenate([log, further])
    order = np.argsort(log)
    where_it_bends(logs, log[order], values[:, order], tolerance=_BEND, closest=_CLOSEST, always=0)


# Number of parts of each interval of ``PARTS``. Distances of two adjacent speeds from the speed at
# which the surfaces part have this ratio; straight lines are then within ``_BEND`` of the logarithm of a
# distance.
_EVEN, _GRADED = 4, 1.07

# Least distance of two speeds next to the speed at which the surfaces part, over ``_CLOSEST``.
_STEP = 0.6


def _foreseen(log: Array, log_ratio: Array, limit: float) -> Array:
    """Return logarithms of further speeds where curves are expected to bend, shape (m,).

    At the speed at which the surfaces part, the first breakdown is 0 and its logarithm has a pole.

    ``log_ratio``, logarithms of the lambda ratio at logarithms of speeds, shape (n,); ``limit``, lambda ratio
    at which the surfaces part.
    """
    parts = np.interp(np.arange(_EVEN * (log.size - 1) + 1) / _EVEN, np.arange(log.size), log)
    added = [np.delete(parts, np.s_[::_EVEN])]
    # Distances in steps: one more for each speed, and then in a geometric series.
    step, near = _STEP * _CLOSEST, 1.0 / (_GRADED - 1.0)
    far = near * float(np.max(np.diff(log))) / (_EVEN * step)
    away = near * _GRADED ** np.arange(math.log(far / near) / math.log(_GRADED))
    away = step * np.concatenate([[-0.5], np.arange(0.5, near), away])
    for at in Sampled(lambda _: log_ratio, log, (log_ratio - math.log(limit))[np.newaxis]).crossings(0):
        added.append(at + away)
    every = np.unique(np.concatenate(added))
    apart = np.min(np.abs(every[:, np.newaxis] - log), axis=1) > 0.5 * _CLOSEST
    return np.asarray(every[apart & (every > log[0]) & (every < log[-1])])


def _columns(summaries: Sequence[Mapping[str, Any] | None]) -> Array:
    """Values of the curves in summaries, shape (k, n); NaN for None."""
    values = [[summary and value_of(summary, key) for summary in summaries] for key in _KEYS]
    return np.array(values, dtype=float)


# Speed of the inner ring [rad/s] with the summary of the bearing at this speed.
Speed = tuple[float, dict[str, Any]]
Speeds = Sequence[Speed]

# Keys that are drawn instead of others, where a summary has them: voltages on the shaft, with a coating.
ON_SHAFT = {"first_break": "shaft_first_break", "ring_to_ring_breakdown": "shaft_ring_to_ring_breakdown"}

# Number of nodes of a whole curve, at least, between which straight lines are drawn.
_NODES = 400

# Number of speeds from which on a curve is computed everywhere: ``over_speed`` halves each of its intervals.
_FEW = 2 * len(PARTS) - 1

_KEYS = (
    "capacitance",
    "capacitance_oil",
    "capacitance_air",
    "first_break",
    "ring_to_ring_breakdown",
    "shaft_voltage",
    "lambda_ratio",
)


@dataclass(frozen=True)
class Curves:
    """Values of a bearing over its speed."""

    speed: Array  # speeds of the inner ring in ascending order [rad/s], shape (n,)
    # Values at the speeds by their keys of the table "bearing", SI units, shape (n,); NaN where there is
    # none.
    values: Mapping[str, Array]
    # Factors by which the values were multiplied to agree with the bearing itself; 1 where none is known.
    scaled: Mapping[str, float]
    # Speed of the summary of the bearing itself below which the margin is below 1 [rad/s].
    critical: float | None = None
    touching: float | None = None  # speed of this summary below which the surfaces touch [rad/s]
    summit_height: float = 0.0  # of the highest summits, in units of the composite Rq

    def __getitem__(self, key: str) -> Array:
        return self.values[key]

    @property
    def few(self) -> bool:
        """Whether a figure marks each speed, because the curve between the speeds is not computed."""
        return self.speed.size < _FEW

    def at(self, key: str, speed: float | Array) -> Any:
        """Value at a speed [rad/s]: a power of the speed between two speeds; NaN next to a missing value."""
        return np.exp(np.interp(np.log(speed), np.log(self.speed), np.log(self.values[key])))

    def between(self, key: str) -> tuple[Array, Array]:
        """Speeds [rad/s] and values at nodes between them; NaN between two speeds that lack one value."""
        log, parts = np.log(self.speed), -(-_NODES // self.speed.size)
        cells = [np.linspace(a, b, parts, endpoint=False) for a, b in pairwise(log)]
        nodes = np.exp(np.append(np.concatenate([np.empty(0), *cells]), log[-1]))
        nodes[::parts] = self.speed
        return nodes, np.asarray(self.at(key, nodes))


def curves_of(points: Speeds, at_case: Speed | None = None) -> Curves:
    """Curves through the values at several speeds, scaled to the values of the bearing itself.

    Films that are not solved may be several per cent off. Their change with speed is more accurate, so each
    curve is multiplied by the ratio of the value of the bearing itself to the curve at its speed.

    ``points``, speeds of the inner ring [rad/s] with their summaries. Returns curves of capacitances and
    voltages.
    """
    ordered = sorted(points, key=lambda point: point[0])
    speed = np.array([at for at, _ in ordered])
    height = ordered[0][1]["inputs"]["bearing"].get("summit_height", 0.0) if ordered else 0.0
    columns = dict(zip(_KEYS, _columns([summary for _, summary in ordered]), strict=True))
    plain = Curves(speed, columns, dict.fromkeys(_KEYS, 1.0), summit_height=height)
    if at_case is None:
        return plain
    factors = {key: _factor(plain, key, at_case) for key in _KEYS}
    analysis = at_case[1].get("margin") or {}
    critical, touching = (analysis.get(key) for key in ("critical_speed", "asperity_contact_speed"))
    values = {key: factors[key] * plain[key] for key in _KEYS}
    return Curves(speed, values, factors, critical, touching, height)


def scaled_curves(case: BearingCase, summary: Mapping[str, Any]) -> Curves | None:
    """Curves of a bearing over its speed, scaled to its ``summary``; None if no other speed has a result."""
    points, _ = over_speed(case, ratio_of_case=summary["bearing"]["lambda_ratio"])
    return curves_of(points, (case.bearing.inner_speed, dict(summary))) if len(points) > 1 else None


def listed(points: Speeds, middle: float) -> list[Speed]:
    """Points for a table: all of a few, else the points at ``PARTS`` times the own speed [rad/s]."""
    if len(points) < _FEW:
        return list(points)
    parts = np.log(PARTS)
    return [point for point in points if np.min(np.abs(np.log(point[0] / middle) - parts)) < _CLOSEST / 4.0]


def value_of(summary: Mapping[str, Any], key: str) -> Any:
    """Value of a key of the table "bearing"; of a breakdown that on the shaft, with its coating."""
    totals = summary["bearing"]
    return totals.get(ON_SHAFT.get(key, key), totals.get(key))


def is_coated(points: Speeds) -> bool:
    """Whether a bearing has a coating on a ring."""
    return any(summary["bearing"].get("coating_capacitance") is not None for _, summary in points)


def _factor(curves: Curves, key: str, at_case: Speed) -> float:
    """Ratio of a value of the bearing itself to the curve at its speed; 1 where one of them is missing."""
    value = value_of(at_case[1], key)
    inside = curves.speed[0] <= at_case[0] <= curves.speed[-1]
    ratio = value / float(curves.at(key, at_case[0])) if value is not None and inside else 1.0
    return ratio if np.isfinite(ratio) else 1.0


def critical_speed_of(curves: Curves) -> float | None:
    """Speed below which the shaft voltage is above the first breakdown [rad/s].

    It is taken from the summary of the bearing itself or, where this has none, the highest speed at which the
    curves cross, by interpolation of their logarithms over the logarithm of the speed.

    Returns None where the first breakdown is on one side of the shaft voltage at all speeds.

    Examples
    --------
    A margin of 0.5 at 10 rad/s and of 2 at 40 rad/s, which grows with the speed to the power of 1:

    >>> shaft, first = np.array([1.0, 1.0]), np.array([0.5, 2.0])
    >>> values = {"first_break": first, "shaft_voltage": shaft}
    >>> round(critical_speed_of(Curves(np.array([10.0, 40.0]), values, {})), 6)
    20.0
    """
    if curves.critical is not None:
        return curves.critical
    return _last_rise(curves.speed, np.log(curves["first_break"] / curves["shaft_voltage"]))


def _last_rise(speed: Array, value: Array) -> float | None:
    """Highest speed at which a value rises through 0, interpolated over the logarithm of the speed."""
    below = np.flatnonzero((value[:-1] < 0.0) & (value[1:] >= 0.0))
    if not below.size:
        return None
    k = below[-1]
    part = -value[k] / (value[k + 1] - value[k])
    low, high = np.log(speed[k : k + 2])
    return float(np.exp(low + part * (high - low)))


def opening_speed_of(curves: Curves) -> float | None:
    """Speed below which contacts open and close, as the highest summits touch [rad/s], or None.

    It is taken from the summary of the bearing itself or, where this has none, from the curves.

    Examples
    --------
    A lambda ratio of 0.5 at 10 rad/s and of 2 at 40 rad/s:

    >>> values = {"lambda_ratio": np.array([0.5, 2.0])}
    >>> round(opening_speed_of(Curves(np.array([10.0, 40.0]), values, {})), 6)
    20.0
    """
    if curves.touching is not None:
        return curves.touching
    ratio = np.log(curves["lambda_ratio"] / contact_limit(curves.summit_height))
    return float(curves.speed[-1]) if ratio[-1] < 0.0 else _last_rise(curves.speed, ratio)


def nearly_equal(values: Array, others: Array) -> bool:
    """Whether two curves differ by less than a per cent wherever both are known."""
    known = np.isfinite(values) & np.isfinite(others)
    return bool(np.all(np.abs(others[known] - values[known]) < 0.01 * values[known]))


def breaks_anywhere(points: Speeds) -> bool:
    """Whether there is a breakdown voltage at any speed."""
    return any(summary["bearing"]["first_break"] is not None for _, summary in points)


# Farthest speeds at which a bearing may become capacitive, divided by the speed of its case, and number of
# speeds beyond ``PARTS`` that are looked at before.
_FARTHEST, _BEYOND = 27.0, 3

# Least share of time whose logarithm is taken.
_SHARE = 1e-15


def capacitive_speed(solution: BearingSolution) -> float | None:
    """Speed of the inner ring from which a bearing is capacitive at its temperature.

    Returns speed [rad/s] at which the bearing becomes capacitive, to 0.2 %: it conducts ``CAPACITIVE`` of the
    time, or its surfaces part and voltages are computed, if that speed is higher; of a bearing that is
    capacitive it is the next lower one, of another the next higher one. None where there is none from a 27th
    to 27 times the speed of the case; for ceramic elements and coatings, which insulate at any speed; for an
    oil that no estimated contact describes; and where a film of the solution is not converged.

    Films at other speeds are from the atlas, or from formulas where the contacts of the case are, and are
    scaled to the least lambda ratio of the solution at its own speed, and their central films to the films
    that were solved with heat and supply. The temperature is the temperature of the case at all speeds.
    """
    case = solution.case
    if solution.conditions.ceramic or case.bearing.coating is not None or not solution.converged:
        return None
    quick, _ = quick_case(case, constant=True)
    if quick is None:
        return None
    speeds, several = over_parts(quick)
    if AT_CASE in several.reasons:
        return None
    scale = lambda_ratio(solution) / several.columns(lambda at: (lambda_ratio(at),), 1)[0, AT_CASE]
    scales = solved_scales(solution)

    def excess(at: BearingSolution) -> tuple[Numbers]:
        """How far a bearing is beyond both limits; negative where it is not capacitive.

        The logarithm of a share of time is nearly a power of the speed.
        """
        duty = duty_of(at, film_scale=scale, ring_scales=scales)
        share = np.clip(duty.contact_time_share, _SHARE, 1.0 - _SHARE)
        room = np.log(scale * lambda_ratio(at) / contact_limit(at.case.bearing.summit_height))
        return (np.minimum(np.log(np.log(share) / math.log(CAPACITIVE)), room),)

    def beyond(log: Array) -> Array:
        """``excess`` at logarithms of speeds, shape (n,) -> (1, n); NaN where the bearing has no solution."""
        return at_speeds(quick, np.exp(log), "films").columns(excess, 1)

    values = several.columns(excess, 1)[0]
    # From the speed of the case towards higher speeds, or from a capacitive bearing towards lower ones.
    way = 1 if values[AT_CASE] < 0.0 else -1
    log, values = np.log(speeds)[AT_CASE::way], values[AT_CASE::way]
    last = _first_change(values)
    if last is None and np.all(np.isfinite(values)):
        further = np.linspace(log[-1], log[0] + way * math.log(_FARTHEST), _BEYOND + 1)[1:]
        log = np.concatenate([log, further])
        values = np.concatenate([values, beyond(further)[0]])
        last = _first_change(values)
    if last is None:
        return None
    log, values = log[: last + 1][::way], values[: last + 1][::way]
    sampled = Sampled(beyond, log, values[np.newaxis])
    sampled.refine()
    return math.exp(sampled.crossings(0)[::way][0])


def _first_change(values: Array) -> int | None:
    """Place of the first value of another sign than those before it; None without one, or after a NaN.

    Examples
    --------
    >>> _first_change(np.array([-2.0, -1.0, 1.0])), _first_change(np.array([-1.0, np.nan, 1.0]))
    (2, None)
    """
    changed = np.flatnonzero(~np.isfinite(values) | ((values < 0.0) != (values[0] < 0.0)))
    return int(changed[0]) if changed.size and np.isfinite(values[changed[0]]) else None
