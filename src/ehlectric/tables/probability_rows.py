"""Rows of the probability that a bearing or a gear mesh breaks down, and of its uncertain inputs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from ehlectric.bearing import FILMS, is_factor
from ehlectric.cases.input_keys import unit_of
from ehlectric.quantities.formats import UNITS, scale_for, scale_of
from ehlectric.quantities.rows import Row, Summary, value_at
from ehlectric.readable import SAME_NUMBER, at_an_end, chance_text, readable

# Units that are printed whatever the size of a value, by their SI units.
_SCALES = {UNITS[unit][0]: scale_of(unit) for unit in ("°C", "deg", "V/µm", "N", "mm²/s")}

# Least share of the spread of an input that has a row.
_LEAST_SHARE = 0.005

# Sum of shares that has a row: smaller sums are within the error of the shares (engineering judgement).
_ABOVE_ALL = 1.05


def probability_value(key: str) -> Callable[[Summary], Any]:
    """Probability of breakdown; its bounds if points or rows without a result leave it open."""

    def value(summary: Summary) -> Any:
        probability = value_at(summary, key)
        low, high = (value_at(summary, f"{key}_{end}") for end in ("low", "high"))
        # Results of earlier versions have no bounds.
        if low is None or high is None or high - low < SAME_NUMBER:
            error = value_at(summary, f"{key}_error")
            if probability is None or error is None or not at_an_end(probability, error):
                return probability
            return chance_text(probability, error).removesuffix(" %"), "%"
        return " to ".join(dict.fromkeys(readable(100.0 * end, 2) for end in (low, high))), "%"

    return value


def probability_note(summary: Summary) -> str:
    """Note next to the probability: its sampling error, or how many points have no result."""
    uncertainty = summary["uncertainty"]
    if uncertainty.get("failed"):
        return f", {uncertainty['failed']} of {uncertainty['samples']} points have no result"
    if at_an_end(uncertainty["breakdown_probability"], uncertainty["breakdown_probability_error"]):
        return ""
    return f", sampling error {readable(100.0 * uncertainty['breakdown_probability_error'], 2)} %"


def shares_of_spread(summary: Summary) -> Iterator[Row]:
    """Rows of the shares of the uncertain inputs in the spread of the margin, the largest first."""
    indices = (summary.get("uncertainty") or {}).get("indices", ())
    for index in indices:
        if index["total"] >= _LEAST_SHARE:
            name, _, remark = index["label"].partition(" (")
            within = "" if index["low"] is None else f", {input_range(index)}"
            assumed = (
                ", a usual range" if index["assumed"] and index["key"].partition(".")[0] != FILMS else ""
            )
            note = f"{', ' + remark.removesuffix(')') if remark else ''}{assumed}"
            share = f"{readable(100.0 * index['total'], 2)} % of the spread"
            yield Row(f"{name}{within}", share, note=note, key=f"uncertainty.indices.{index['key']}")
    yield from shares_above_all([index["total"] for index in indices])


def shares_above_all(shares: Sequence[float]) -> Iterator[Row]:
    """Row with the sum of the shares of all inputs, and why it exceeds 100 %; no row if it does not."""
    if sum(shares) >= _ABOVE_ALL:
        note = ", joint effects count for each input"
        yield Row("sum of these shares", f"{readable(100.0 * sum(shares), 3)} %", note=note)


def left_out_of_probability(summary: Summary) -> Iterator[Row]:
    """Rows of ranges that are not in the probability, and why."""
    for text in (summary.get("uncertainty") or {}).get("left_out", ()):
        yield Row("not in the probability", note=text, key="uncertainty.left_out")


def input_range(effect: Mapping[str, Any]) -> str:
    """Range of the input of an effect as text, in the unit that is printed.

    Examples
    --------
    >>> input_range({"key": "bearing.temperature", "low_input": 333.15, "high_input": 353.15})
    '60 to 80 °C'
    >>> input_range({"key": "discharge.dielectric_strength", "low_input": 12e6, "high_input": 18e6})
    '12 to 18 V/µm'
    """
    low, high = (effect.get(f"{end}_input", effect.get(end)) for end in ("low", "high"))
    return interval_text(low, high, "" if is_factor(effect["key"]) else unit_of(effect["key"]))


def interval_text(low: float, high: float, unit: str, digits: int = 4) -> str:
    """Range in an SI unit as text, in the unit that is printed.

    Examples
    --------
    >>> interval_text(2.4e-10, 2.613e-10, "F")
    '0.24 to 0.2613 nF'
    """
    ends = low, high
    scale = _SCALES.get(unit) or scale_for(max(map(abs, ends)), unit)
    texts = (readable(scale.of(end), digits) for end in ends)
    return f"{' to '.join(texts)} {scale.unit}".rstrip()
