"""Probability of breakdown over a duty cycle: touching rows count, and unknown rows leave bounds."""

from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric import BearingCase, evaluate, load, save, solve_bearing
from ehlectric.bearing import duty_cycle
from ehlectric.bearing.cycle_rows import LEFT_OUT, STANDSTILL, TOUCHING
from ehlectric.bearing.duty_cycle import run_duty
from ehlectric.bearing.margin import film_factors
from ehlectric.bearing.solution import conducts, film_error
from ehlectric.bearing.uncertain_inputs import changes_of, proportional_to_strength
from tests.helpers.places import EXAMPLES

RQ, SPEED, TEMPERATURE = "bearing.composite_rq", "bearing.inner_speed", "bearing.temperature"
WLTC = EXAMPLES / "measurements" / "wltc_class_3b_motor.csv"


def example(**changes):
    return BearingCase.from_toml(EXAMPLES / "duty_wltc.toml").replace(changes)


def with_cycle(folder, text, **changes):
    (folder / "cycle.csv").write_text(text)
    return example(**{"duty.file": str(folder / "cycle.csv"), **changes})


@pytest.fixture
def tenth(tmp_path):
    """Cycle of every tenth row of the WLTC."""
    lines = [line for line in WLTC.read_text().splitlines() if not line.startswith("#")]
    return with_cycle(tmp_path, "\n".join([lines[0], *lines[1::10]]))


@pytest.mark.slow
def test_the_probability_rises_with_the_roughness(tenth):
    """0.80 of the turning time and 0.70 of the cycle at 0.04 um: random points of each row of the whole WLTC,
    drawn by another program. At 0.1 um nearly all of the turning time, 0.87 of the cycle.
    """
    found = [run_duty(tenth.replace({RQ: f"{rq} um"})).summary() for rq in (0.03, 0.04, 0.06, 0.1)]
    for key in ("turning_breakdown_probability", "breakdown_probability", "breakdown_share"):
        values = [one[key] for one in found]
        assert values == sorted(values)
        assert values[0] < values[-1]
    assert found[1]["turning_breakdown_probability"] == pytest.approx(0.80, abs=0.03)
    assert found[1]["breakdown_probability"] == pytest.approx(0.70, abs=0.03)
    assert found[3]["breakdown_probability"] == pytest.approx(0.87, abs=0.03)
    for one in found:
        still = one["standstill_share"]
        assert one["breakdown_probability"] == pytest.approx(
            (1.0 - still) * one["turning_breakdown_probability"]
        )
        assert one["breakdown_share"] == pytest.approx(
            one["low_margin_share"] + one["asperity_contact_share"]
        )


@pytest.mark.slow
def test_the_verdict_has_one_sentence_on_the_cycle(tenth, tmp_path):
    """The numbers of the sentence are those of the table, and a loaded result has the same verdict."""
    result = solve_bearing(tenth, workers=1)
    duty = result.summary()["duty"]
    probability, share = (100.0 * duty[key] for key in ("breakdown_probability", "breakdown_share"))
    assert " at the operating point of " in result.verdict.text
    *_, sentence = result.verdict.sentences()
    assert sentence == (
        f"Over the duty cycle the mean probability of breakdown is {probability:.2g} %; "
        f"the margin is below 1, or asperity contact is frequent, {share:.2g} % of the time."
    )
    save(result, tmp_path / "saved")
    assert load(tmp_path / "saved").verdict == result.verdict


@pytest.mark.slow
def test_a_bearing_whose_surfaces_touch_has_the_probability_of_random_points():
    """Plain random inputs, each asked as a bearing of its own: a margin below 1, or surfaces that conduct."""
    voltage, rq = "motor.common_mode_voltage", "0.05 um"
    case = example(**{RQ: rq, SPEED: "2500 rpm", TEMPERATURE: "60 degC", voltage: "30 V", "duty": None})
    result = solve_bearing(case, workers=1)
    assert conducts(result.solution)
    rng, count = np.random.default_rng(11), 3000
    inputs, factor = {}, np.ones(count)
    for change in changes_of(case):
        drawn = rng.uniform(*change.ends, count)
        if proportional_to_strength(change.key):
            factor *= drawn / change.value
        else:
            inputs |= change.changes(drawn)
    films = rng.uniform(*film_factors(case, float(film_error(result.solution))), count)
    inputs[RQ] = np.full(count, 0.05e-6) / films
    columns = evaluate(case, inputs)
    margins = np.asarray(columns["bearing.margin"], dtype=float) * factor * films
    breaks = ~(margins >= 1.0)
    assert 0.1 < np.mean(breaks) < 0.95
    assert result.uncertainty.probability == pytest.approx(np.mean(breaks), abs=0.02)
    table = result.summary()["uncertainty"]
    assert table["breakdown_probability"] == result.uncertainty.probability
    touching = np.mean(np.isnan(margins))
    assert table["asperity_contact_probability"] == pytest.approx(touching, abs=0.04)


@pytest.mark.slow
@pytest.mark.gate
def test_rows_without_a_voltage_do_not_break_down_and_rows_at_rest_have_no_probability(tmp_path):
    rows = "time [s],speed [rpm],common-mode voltage [V]\n0,0,300\n10,60,0\n20,60,300\n30,6000,0\n"
    duty = run_duty(with_cycle(tmp_path, rows))
    assert duty.rows.state.tolist()[:3] == [STANDSTILL, TOUCHING, TOUCHING]
    probability = duty.rows.breakdown_probability
    assert np.isnan(probability[0])
    assert probability[1] == probability[3] == 0.0
    assert probability[2] > 0.99
    # Ten of the 25 s in which the shaft turns, of 30 s.
    assert duty.turning_breakdown_probability == pytest.approx(10.0 / 25.0, abs=0.005)
    assert duty.breakdown_probability == pytest.approx(10.0 / 30.0, abs=0.005)
    assert duty.summary()["breakdown_share"] == pytest.approx(10.0 / 30.0)


@pytest.mark.slow
@pytest.mark.gate
def test_rows_that_are_not_computed_leave_bounds(tmp_path):
    """At 300 degC the oil is beyond the equation of its viscosity: a third of the time is not known."""
    rows = "time [s],speed [rpm],temperature [degC]\n0,6000,20\n10,6000,20\n20,6000,300\n30,6000,300\n"
    duty = run_duty(with_cycle(tmp_path, rows))
    found = duty.summary()
    unknown = found["left_out_share"]
    assert np.count_nonzero(duty.rows.state == LEFT_OUT) == 2
    assert unknown == pytest.approx(0.5)
    known = duty.rows.breakdown_probability[0]
    assert found["breakdown_probability"] == pytest.approx(known)
    assert found["breakdown_probability_low"] == pytest.approx((1.0 - unknown) * known)
    assert found["breakdown_probability_high"] == pytest.approx((1.0 - unknown) * known + unknown)
    assert "probability-bounded" in {warning.code for warning in duty.warnings}


def test_the_reason_of_a_stretch_says_that_surfaces_touch_at_the_mean(tmp_path):
    """A fast row among slow ones: at the mean of the speed the surfaces touch, and there is no margin."""
    rows = "time [s],speed [rpm]\n0,60\n10,60\n20,6000\n21,60\n31,60\n"
    duty = run_duty(with_cycle(tmp_path, rows, **{RQ: "0.05 um", TEMPERATURE: "60 degC"}))
    (stretch,) = duty.stretches
    assert np.isfinite(stretch.least_margin)
    assert stretch.why.startswith("at speed 6000 rpm (frequent asperity contact at the mean of ")


def test_each_driven_row_has_the_probability_of_its_margin(monkeypatch):
    """By hand: rows with margins below and above 1, one that touches, and one without a voltage."""
    rows = SimpleNamespace(
        time=np.arange(5.0),
        turns=np.ones(5, dtype=bool),
        common_mode_voltage=np.array([200.0, 200.0, 200.0, 200.0, 0.0]),
        state=np.array([TOUCHING + 1, TOUCHING + 1, TOUCHING + 1, TOUCHING, TOUCHING + 1]),
        margin=np.array([0.3, 1.5, 4.0, np.nan, np.nan]),
        lambda_ratio=np.array([1.0, 2.0, 3.0, 0.5, 2.5]),
        capacitance=np.full(5, 1e-10),
    )
    chances = np.array([0.9, 0.4, 0.1, 1.0, 0.7])
    monkeypatch.setattr(duty_cycle, "_chances", lambda *given: np.stack([chances[given[2]]] * 3, axis=1))
    found = duty_cycle._probabilities(example(), rows)
    assert found == pytest.approx(np.stack([[0.9, 0.4, 0.1, 1.0, 0.0]] * 3, axis=1), abs=1e-12)
