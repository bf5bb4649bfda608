"""Probability of breakdown of a bearing, against plain random points and closed forms."""

import dataclasses
import math

import numpy as np
import pytest

from ehlectric import BearingCase, InputError, solve_bearing
from ehlectric.bearing import result as bearing_result
from ehlectric.bearing.margin import QuickMargins
from ehlectric.bearing.solving import solution_of
from ehlectric.bearing.uncertainty import (
    FILMS,
    SCATTER,
    Design,
    _computed,
    margin_band,
    quick_chance,
    uncertainty_of,
)
from ehlectric.discharge.breakdown_rule import Chance, sampling_error
from ehlectric.tables.bearing_tables import total_rows

STRENGTH, ROTOR = "discharge.dielectric_strength", "motor.winding_rotor_capacitance"


def bearing(**changes):
    case = BearingCase.from_dict(
        {
            "contacts": "atlas",
            "bearing": {
                "base": "6208",
                "radial_clearance": "10 um",
                "radial_load": "1800 N",
                "inner_speed": "3000 rpm",
                "temperature": "70 degC",
                "composite_rq": "0.03 um",
                "film_factor": "none",
            },
            "lubricant": {
                "base": "paper",
                "temperature": {
                    "kinematic_viscosity_40": "46 mm^2/s",
                    "kinematic_viscosity_100": "6.8 mm^2/s",
                    "density_15": "870 kg/m^3",
                },
            },
            "discharge": {"dielectric_strength": "15 V/um"},
            "motor": {
                "common_mode_voltage": "300 V",
                "winding_rotor_capacitance": "20 pF",
                "rotor_frame_capacitance": "1 nF",
            },
        }
    )
    return case.replace(changes) if changes else case


def analysed(case):
    solution = solution_of(case)
    return solution, QuickMargins.of(solution)


@pytest.fixture(scope="module")
def usual():
    return analysed(bearing())


@pytest.mark.slow
def test_the_probability_is_that_of_plain_random_points(usual):
    """4000 points of an independent generator, whose own sampling error counts too."""
    solution, margins = usual
    found = uncertainty_of(solution, margins)
    design = Design.of(solution)
    at = np.random.default_rng(11).random((4000, design.width))
    computed = _computed(design, margins, at)
    assert np.isfinite(computed).all()
    below = float(np.mean(computed * np.exp(np.sum(design.log_factors(at), axis=-1)) < 1.0))
    assert 0.05 < found.probability < 0.5
    assert abs(found.probability - below) < found.probability_error + sampling_error(below, 4000)
    assert found.failed == 0
    assert found.predicted > 0.99


@pytest.mark.slow
@pytest.mark.gate
def test_the_strength_alone_has_an_even_distribution(usual):
    """Ranges that close in on all other inputs leave the even distribution of the strength."""
    solution, margins = usual
    design = Design.of(solution)
    narrow = {
        change.key: [change.value * (1.0 - 1e-6), change.value * (1.0 + 1e-6)] for change in design.computed
    }
    low, high = 12e6, 30e6
    solution, margins = analysed(bearing(ranges=narrow | {STRENGTH: [low, high]}))
    found = uncertainty_of(solution, margins)
    own = margins.solved.margin / 15e6
    # The films have a stated error of some per cent beside it.
    assert found.median == pytest.approx(own * 0.5 * (low + high), rel=0.02)
    ends = own * (low + 0.05 * (high - low)), own * (low + 0.95 * (high - low))
    assert found.interval == pytest.approx(ends, rel=0.03)
    assert found.inputs[0].key == STRENGTH
    assert found.inputs[0].first_order > 0.95
    assert not found.inputs[0].assumed


@pytest.mark.slow
@pytest.mark.gate
def test_shares_add_up_and_name_the_input_to_measure_first(usual):
    found = uncertainty_of(*usual)
    assert found.inputs[0].key == ROTOR
    assert sum(one.first_order for one in found.inputs) == pytest.approx(1.0, abs=0.02)
    assert {one.key for one in found.inputs} >= {STRENGTH, FILMS, "bearing.temperature"}
    assert all(one.reason for one in found.inputs)
    # The margin follows the capacitance nearly in proportion, which is even from half to 1.5 times its value.
    logs = np.log(np.linspace(0.5, 1.5, 10001))
    whole = np.var(np.log(found.margins))
    assert found.inputs[0].first_order == pytest.approx(np.var(logs) / whole, rel=0.1)


@pytest.mark.slow
def test_a_weibull_law_scatters(usual):
    """The logarithm of a strength by a Weibull law of shape m has the variance pi^2/(6 m^2)."""
    weibull = {"scale": "15 V/um", "shape": 4.0, "reference_area": "1 mm^2"}
    _, margins = usual
    changed = bearing(**{"discharge.weibull": weibull})
    solution = dataclasses.replace(usual[0], case=changed)
    found = uncertainty_of(solution, margins)
    (scatter,) = (one for one in found.inputs if one.key == SCATTER)
    whole = np.var(np.log(found.margins))
    assert scatter.first_order == pytest.approx(math.pi**2 / 96.0 / whole, rel=0.05)
    assert found.probability > uncertainty_of(*usual).probability


@pytest.mark.slow
@pytest.mark.gate
def test_surfaces_that_touch_count_as_breakdown(usual):
    """Films that are 5 % thicker than the roughness: a warmer bearing touches."""
    rough = float(usual[0].least_film / 1.05)
    solution, margins = analysed(bearing(**{"bearing.composite_rq": rough}))
    found = uncertainty_of(solution, margins, samples=256)
    assert 0.0 < found.touching < 1.0
    assert found.probability >= found.touching
    assert found.interval[0] == 0.0


@pytest.mark.slow
def test_the_band_falls_to_no_breakdown_at_high_speed(usual):
    solution, margins = usual
    band = margin_band(solution, margins)
    assert np.all(np.diff(band.median) > 0.0)
    assert np.all((band.low < band.median) & (band.median < band.high))
    assert band.probability[0] > 0.9
    assert band.probability[-1] == 0.0
    own = uncertainty_of(solution, margins)
    at = margin_band(solution, margins, [solution.case.bearing.inner_speed])
    assert at.median[0] == pytest.approx(own.median, rel=0.05)
    assert at.probability[0] == pytest.approx(own.probability, abs=2.0 * sampling_error(own.probability, 128))


@pytest.mark.slow
@pytest.mark.gate
def test_the_chance_at_once_is_near_the_whole_one(usual):
    """Its films are those of the bearing: temperature, load and clearance have a tenth of the spread here."""
    at_once, whole = quick_chance(usual[0]), uncertainty_of(*usual).chance
    assert at_once.probability == pytest.approx(whole.probability, abs=0.06)
    assert at_once.median == pytest.approx(whole.median, rel=0.03)
    assert whole.low <= at_once.low < at_once.high <= whole.high
    assert [one.code for one in at_once.statements()] == ["probability-follows"]


@pytest.mark.slow
def test_the_same_seed_gives_the_same_numbers(usual):
    first, again, other = (uncertainty_of(*usual, samples=64, seed=seed) for seed in (1, 1, 2))
    assert first.summary() == again.summary()
    assert first.summary() != other.summary()


@pytest.fixture(scope="module")
def random_margins(usual):
    """Margins of the usual bearing at 8192 points of an independent generator."""
    solution, margins = usual
    design = Design.of(solution)
    at = np.random.default_rng(23).random((8192, design.width))
    return _computed(design, margins, at) * np.exp(np.sum(design.log_factors(at), axis=-1))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize(
    ("probability", "most"), [(0.01, 512), (0.04, 2048), (0.1, 512), (0.5, 512), (0.9, 512), (0.995, 512)]
)
def test_the_level_is_the_level_of_many_random_points(usual, random_margins, probability, most, seed):
    """A factor on the rotor's voltage divides all margins by itself."""
    factor = float(np.quantile(random_margins, probability))
    margins = dataclasses.replace(usual[1], margin_factor=usual[1].margin_factor / factor)
    exact = Chance.of(random_margins / factor)
    refined = uncertainty_of(usual[0], margins, seed=seed).chance
    assert refined.level == exact.level
    assert refined.samples <= most
    assert abs(refined.probability - probability) < refined.error + exact.error
    ends = np.array([[chance.low, chance.median, chance.high] for chance in (refined, exact)])
    assert np.all(np.abs(ends[0] / ends[1] - 1.0) < refined.margin_error + exact.margin_error)


@pytest.mark.slow
def test_more_points_contain_the_points_before(usual):
    few, many = (uncertainty_of(*usual, samples=samples) for samples in (64, 128))
    assert few.margins == pytest.approx(many.margins[:64], rel=1e-6)
    assert uncertainty_of(*usual, samples=64, seed=1).samples == 64


@pytest.mark.slow
def test_the_probability_is_that_of_two_hundred_thousand_points(usual):
    solution, margins = usual
    found = uncertainty_of(solution, margins)
    design, rng, below = Design.of(solution), np.random.default_rng(7), 0.0
    for _ in range(20):
        at = rng.random((10000, design.width))
        computed = _computed(design, margins, at)
        assert np.isfinite(computed).all()
        below += np.mean(computed * np.exp(np.sum(design.log_factors(at), axis=-1)) < 1.0) / 20.0
    assert abs(found.probability - below) < found.probability_error


@pytest.mark.slow
@pytest.mark.gate
def test_a_probability_that_is_not_computed_says_why(monkeypatch):
    def refused(_):
        raise InputError.worded(None, "no point has a result")

    monkeypatch.setattr(bearing_result, "uncertainty_of_result", refused)
    result = solve_bearing(bearing(), workers=1)
    summary = result.summary()
    assert result.uncertainty is None
    assert summary["uncertainty"] is None
    assert summary["margin"]["left_out"] == ["probability of breakdown: no point has a result"]
    assert (result.verdict.level, result.verdict.lead) == ("yellow", "Breakdown not known")
    assert "The probability of breakdown is not known: no point has a result." in result.verdict.text


@pytest.mark.slow
def test_points_without_a_result_are_told_in_the_table():
    """Near 320 degC the oil is thinner than the least viscosity of ASTM D341."""
    thin = {"kinematic_viscosity_40": "12 mm^2/s", "kinematic_viscosity_100": "1.6 mm^2/s"}
    oil = {f"lubricant.temperature.{key}": value for key, value in thin.items()}
    case = bearing(ranges={"bearing.temperature": ["60 degC", "320 degC"]}, **oil)
    summary = solve_bearing(case, workers=1).summary()
    failed, samples = (summary["uncertainty"][key] for key in ("failed", "samples"))
    assert 0 < failed < samples
    (row,) = (row for row in total_rows(summary) if row.key == "uncertainty.breakdown_probability")
    assert row.note == f", {failed} of {samples} points have no result"
    (row,) = (row for row in total_rows(summary) if row.key == "uncertainty.margin_range")
    assert row.value == "not known"
