"""Sampling errors of the rule of breakdown, against intervals of SciPy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binomtest

from ehlectric.discharge.breakdown_rule import Chance, share_interval, touching_rule
from ehlectric.quantities.verdict_texts import statement_text
from ehlectric.readable import chance_text


@pytest.mark.parametrize(("hits", "number"), [(0, 512), (3, 512), (26, 512), (1024, 2048), (2048, 2048)])
def test_the_interval_of_a_share_is_wilsons(hits, number):
    expected = binomtest(hits, number).proportion_ci(method="wilson")
    assert share_interval(hits / number, number) == pytest.approx((expected.low, expected.high), abs=1e-12)


@pytest.mark.parametrize("number", [32, 512, 2048])
def test_the_text_of_no_breakdown_contains_the_interval(number):
    most = binomtest(0, number).proportion_ci(method="wilson").high
    text = chance_text(0.0, Chance.of(np.full(number, 2.0)).error)
    stated = float(text.removeprefix("below ").removesuffix(" %"))
    assert 100.0 * most <= stated < 110.0 * most


def test_the_error_of_the_margins_is_the_error_of_random_points():
    """Quantiles of an even distribution are within the stated error in 95 % of 400 samples, but for two
    standard deviations of this number.
    """
    generator, exact, within = np.random.default_rng(5), np.array([1.05, 1.5, 1.95]), 0
    for _ in range(400):
        chance = Chance.of(generator.uniform(1.0, 2.0, 512))
        errors = np.array([chance.low, chance.median, chance.high]) / exact - 1.0
        within += bool(np.max(np.abs(errors)) < chance.margin_error)
    assert within >= 0.95 * 400 - 2.0 * math.sqrt(0.05 * 0.95 * 400)


@pytest.mark.parametrize(
    ("margins", "failed", "touching", "settled"),
    [
        # No breakdown of 512 points: at most 0.75 %.
        ({1.5: 512}, 0, False, True),
        # 4.9 % of 512 points, and 6.8 % of 1024 points.
        ({0.5: 25, 1.5: 487}, 0, False, False),
        ({0.5: 70, 1.5: 954}, 0, False, True),
        # Half of the points: yellow for certain, also where surfaces touch, and 95.5 % may be red or yellow.
        ({0.5: 256, 1.5: 256}, 0, False, True),
        ({0.0: 256, 1.5: 256}, 0, True, True),
        ({0.0: 489, 1.5: 23}, 0, True, False),
        # Points without a result leave both bounds far from their limits, or not.
        ({0.5: 100, 1.5: 100}, 312, False, True),
        ({1.5: 487}, 25, False, False),
    ],
)
def test_a_level_is_settled_beyond_the_sampling_error(margins, failed, touching, settled):
    chance = Chance.of(np.repeat(list(margins), list(margins.values())), failed)
    assert chance.is_settled(touching=touching) is settled


def test_no_interval_is_stated_of_surfaces_that_touch():
    chance = replace(Chance.of(np.zeros(512)), first="temperature", share=0.5)
    assert [one.code for one in chance.statements()] == ["probability-of-touching", "measure-first"]


@pytest.mark.parametrize(
    ("low", "median", "high", "off", "code"),
    [
        (0.8, 1.2, 2.0, 0.1, "probability"),
        (0.8, 1.2, 2.0, 0.3, "probability-rough"),
        (0.1, 1.2, 2.0, 1.0, "probability-only"),
        (1.3, 4.0, math.inf, 0.1, "probability-above"),
        (math.inf, math.inf, math.inf, 0.0, "probability-only"),
        (0.0, 1.0, math.inf, 0.0, "probability-only"),
        (0.0, 0.0, 0.0, 0.0, "probability-of-touching"),
    ],
)
def test_no_statement_has_an_infinite_or_a_meaningless_margin(low, median, high, off, code):
    chance = Chance(0.2, 0.01, low, median, high, off, "rotor capacitance", 0.5, samples=512)
    statement, _ = chance.statements()
    assert statement.code == code
    for form in ("text", "brief"):
        assert "inf" not in statement_text(statement, "at 3000 rpm", form)


@pytest.mark.parametrize("probability", [0.3, 0.75, 0.97])
def test_the_level_follows_the_probability_also_where_surfaces_touch(probability):
    margins = np.repeat([0.0, 1.5], [round(1000 * probability), round(1000 * (1.0 - probability))])
    chance = Chance.of(margins)
    assert touching_rule(chance, driven=True)[0] == chance.level
