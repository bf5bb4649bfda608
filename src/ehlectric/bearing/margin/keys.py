"""Keys of summary.json for the analysis of the margin of a bearing."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey

MARGIN_KEYS: Keys = {
    "level": ResultKey(
        'colour of the verdict: "green", "yellow" where the margin may lie on either side of 1 or surfaces '
        'may touch, "red" where breakdown is expected or surfaces touch under a voltage, or "grey" where '
        "there is nothing to compare"
    ),
    "critical_speed": ResultKey(
        "speed of the inner ring at which the margin is 1, and below which breakdown is expected; by film "
        "formulas that are scaled to `bearing.margin` at the speed of the file, at one temperature; null "
        "where the margin does not cross 1 between `lowest_speed` and `highest_speed`",
        "rad/s",
        "critical speed",
    ),
    "upper_critical_speed": ResultKey(
        "speed of the inner ring above which the margin is below 1 again, up to `highest_speed`; null where "
        "it is not",
        "rad/s",
        "upper critical speed",
    ),
    "touching_speed": ResultKey(
        "speed of the inner ring below which the surfaces touch; null where they do not in that range",
        "rad/s",
        "speed below which surfaces touch",
    ),
    "capacitive_speed": ResultKey(
        "speed of the inner ring from which the bearing is capacitive at its temperature: it conducts at "
        "most 1 % of the time and its lambda ratio is at least 1; by quick films that are scaled to those at "
        "the speed of the file; null where it becomes so nowhere from a 27th to 27 times that speed, and for "
        "ceramic elements and a coating",
        "rad/s",
        "speed from which the bearing is capacitive",
    ),
    "lowest_speed": ResultKey("lower end of the speeds that were searched", "rad/s"),
    "highest_speed": ResultKey("upper end of the speeds that were searched", "rad/s"),
    "low": ResultKey(
        "margin with all inputs of `[ranges]` at their unfavourable ends, 0 where the surfaces touch; null "
        "without ranges",
        "",
        "margin, inputs at their unfavourable ends",
    ),
    "high": ResultKey(
        "margin with all inputs of `[ranges]` at their favourable ends; null without ranges",
        "",
        "margin, inputs at their favourable ends",
    ),
    "effects": ResultKey("list of the effects of single inputs on the margin, the largest first"),
    "left_out": ResultKey("list of what could not be computed, and why"),
}

EFFECT_KEYS: Keys = {
    "key": ResultKey("dotted key of the input"),
    "label": ResultKey("name of the input"),
    "low_input": ResultKey("smaller value of the input, in the SI unit of its key"),
    "high_input": ResultKey("larger value of the input, in the SI unit of its key"),
    "low_margin": ResultKey("margin at `low_input`, 0 where the surfaces touch"),
    "high_margin": ResultKey("margin at `high_input`, 0 where the surfaces touch"),
}
