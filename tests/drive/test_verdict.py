"""Verdict on a drive: when discharges are expected, and what it rests on."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ehlectric import load, save, solve_drive
from ehlectric.drive.drive_record import event_rate
from ehlectric.drive.result import DriveResult
from ehlectric.drive.verdict_rule import SELDOM, drive_verdict, most_by_law
from ehlectric.quantities.result_warnings import ResultWarning
from tests.helpers.drives import drive_with_remedy
from tests.helpers.each import each
from tests.helpers.readable import grouped

NOTE = ResultWarning("isothermal-film", "smooth films")


@pytest.fixture(scope="module")
def drive():
    return solve_drive(drive_with_remedy(), workers=1)


def quiet(drive, **values):
    """Summary of the drive without discharges, with other values at both ends."""
    none = event_rate(np.zeros(40), 0.2)
    own = {
        "events": 0, "events_per_second": 0.0, "events_per_second_low": 0.0,
        "events_per_second_high": none.high, "burning_time_share": 0.0, "current_density": None,
        "breakdown_voltage": 5.0, "weibull_shape": 5.0, "renewal_time": 1e-4, "peak_voltage": 0.05,
    }  # fmt: skip
    summary = drive.summary()
    return summary | {end: summary[end] | own | values for end in ("drive_end", "non_drive_end")}


def test_a_voltage_far_above_a_narrow_threshold_breaks_each_film_down():
    """Every renewed film breaks down, whatever the shape: the rate is that of new films."""
    end = {"peak_voltage": 40.0, "breakdown_voltage": 1.0, "weibull_shape": 200.0, "renewal_time": 1e-4}
    assert most_by_law(end) == 1e4
    assert most_by_law(end | {"peak_voltage": 0.0}) == 0.0
    assert most_by_law(end | {"peak_voltage": 1.0}) == pytest.approx(1e4 * (1.0 - math.exp(-1.0)))


def test_a_simulation_is_saved_before_its_summary_fails(drive, tmp_path, monkeypatch):
    def fails(_):
        raise OverflowError("a number is too large")

    monkeypatch.setattr(DriveResult, "summary", fails)
    with pytest.raises(OverflowError):
        save(drive, tmp_path / "out")
    monkeypatch.undo()
    assert load(tmp_path / "out").summary()["drive_end"] == drive.summary()["drive_end"]


def judged(drive, summary, *warnings):
    return drive_verdict(drive.case, summary, (NOTE, *warnings))


def test_a_drive_that_discharges(drive):
    verdict = drive_verdict(drive.case, drive.summary(), drive.warnings)
    found = drive.summary()["drive_end"]
    assert verdict.level == "red"
    rate = grouped(found["events_per_second"])
    assert verdict.text.startswith(f"Discharges expected: {rate} a second")
    assert "at 95 %" in verdict.text
    assert " 10 Ω" in verdict.text


def test_the_same_drive_with_a_ring(drive):
    """The films are by formula, and may be 30 % thinner: the voltage is still far below theirs."""
    ring = DriveResult(drive.remedies[0][2])
    summary = ring.summary()
    verdict = drive_verdict(ring.case, summary, ring.warnings)
    high = summary["drive_end"]["events_per_second_high"]
    assert f"at most {high:.3g} a second" in verdict.text
    assert "95 %" in verdict.text
    assert verdict.level == ("green" if most_by_law(summary["drive_end"], 0.8 / 1.3) <= SELDOM else "yellow")


def test_law_at_the_largest_voltage_is_the_rate_of_films_drawn_at_random():
    end = {"peak_voltage": 3.0, "breakdown_voltage": 5.0, "weibull_shape": 5.0, "renewal_time": 1e-4}
    draws = 5.0 * np.random.default_rng(1).weibull(5.0, 400_000)
    assert most_by_law(end) == pytest.approx(np.mean(draws < 3.0) / 1e-4, rel=0.02)
    assert most_by_law(end | {"peak_voltage": 1e9}) == pytest.approx(1e4)
    fixed = end | {"weibull_shape": None}
    assert [most_by_law(fixed, part) for part in (1.0, 0.5)] == [0.0, math.inf]
    assert most_by_law(end | {"breakdown_voltage": None}) == 0.0


@each(
    "values, level, words",
    [
        ({}, "green", "No discharge expected"),
        # In 0.2 s nothing happened, but the law lets films break down 0.3 times in a second.
        ({"peak_voltage": 0.5}, "yellow", "Weibull"),
        ({"peak_voltage": 4.5, "weibull_shape": None}, "yellow", "Discharges possible"),
        ({"peak_voltage": 3.9, "weibull_shape": None}, "green", "No discharge expected"),
        ({"contact_time_share": 0.01}, "yellow", " 1 % of the time"),
        ({"breakdown_voltage": None, "weibull_shape": None, "renewal_time": None}, "green", "ceramic"),
    ],
)
def test_a_drive_that_did_not_discharge(drive, values, level, words):
    verdict = judged(drive, quiet(drive, **values))
    assert verdict.level == level
    assert words in verdict.text
    assert "at most 18.4 a second" in verdict.text
    assert "95 %" in verdict.text


def test_few_discharges_and_thresholds_without_scatter(drive):
    summary = drive.summary()
    some = {"events": 5}
    few = summary | {end: summary[end] | some for end in ("drive_end", "non_drive_end")}
    assert judged(drive, few).text.startswith("Discharges possible: ")
    reach = max(
        summary["drive_end"]["peak_voltage"],
        summary["drive_end"]["voltage_ratio"] * summary["source"]["peak"],
    )
    for shape, part, level in (
        (None, 0.9, "yellow"),
        (None, 0.7, "red"),
        (200.0, 0.9, "yellow"),
        (5.0, 0.9, "red"),
    ):
        fixed = {"weibull_shape": shape, "breakdown_voltage": part * reach}
        verdict = judged(
            drive, summary | {end: summary[end] | fixed for end in ("drive_end", "non_drive_end")}
        )
        assert verdict.level == level
    burning = quiet(drive, burning_time_share=0.9)
    assert judged(drive, burning).level == "red"
    assert " 90 % of the time" in judged(drive, burning).text


def test_no_verdict_on_numbers_that_must_not_be_used(drive):
    summary = quiet(drive)
    assert judged(drive, summary | {"converged": False}).level == "grey"
    assert judged(drive, summary, ResultWarning("not-converged", "film")).level == "grey"
    assert judged(drive, summary, ResultWarning("partial-film", "lambda")).level == "yellow"


def test_the_verdict_of_a_result_follows_its_solution(drive):
    """Without the discharges of its record, and with the voltages that these kept low, none is sure."""
    record = drive.solution.record
    silent = replace(record, counts=0 * record.counts, events=record.events[:0], sums=0.0 * record.sums,
                     largest=0.0 * record.largest, burning=0.0 * record.burning)  # fmt: skip
    found = DriveResult(replace(drive.solution, record=silent))
    assert drive_verdict(found.case, found.summary(), found.warnings).level == "yellow"
