"""Verdicts on sweeps, from made-up points whose margins are known."""

import math

import numpy as np
import pytest

from ehlectric import Case
from ehlectric.sweep.points import Point, Range
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.verdict_rule import crossing, sweep_verdict, value_text
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each

SPEED, TEMPERATURE = "bearing.inner_speed", "bearing.temperature"
CONTACT = Case.from_dict(
    {
        "contact": {
            "reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "max_hertz_pressure": "1 GPa",
            "entrainment_speed": "4 m/s",
        },
        "lubricant": {"base": "paper"},
    }
)  # fmt: skip


def rpm(value):
    return value * math.pi / 30.0


def point(number, inputs, margin, *, status="solved", codes=(), lubrication="full film", **bearing):
    table = {"margin": margin, "lubrication": lubrication, "contacts": "solved", **bearing}
    summary = {"bearing": table, "discharge": table, "warnings": list(codes), "warning_codes": list(codes)}
    return Point(number, inputs, status, summary=summary)


def sweep(axes, margins, *, case=None, **points):
    """Sweep over one axis with these margins; keywords change single points by their number."""
    (key,) = axes
    rows = [
        point(k, {key: value}, margin, **points.get(f"at_{k}", {}))
        for k, (value, margin) in enumerate(zip(axes[key], margins, strict=True))
    ]
    return SweepResults(case or bearing_case(BALLS), "grid", axes, {}, 0, tuple(rows))


def test_where_the_margin_falls_below_one():
    """A margin of (n/1380)^0.6 crosses 1 at 1380 rpm, whichever way the values run."""
    speeds = [300.0, 900.0, 2500.0, 6000.0]
    for order in (speeds, speeds[::-1]):
        margins = [(n / 1380.0) ** 0.6 for n in order]
        verdict = sweep_verdict(sweep({SPEED: tuple(map(rpm, order))}, margins))
        assert verdict.level == "yellow"
        for part in ("at 2 of 4 points", "0.40 to 2.42", "Below about 1380 rpm", "15 V/µm"):
            assert part in verdict.text
        assert verdict.margin == pytest.approx(min(margins))


def test_a_margin_that_falls_with_the_input():
    kelvin = (333.15, 343.15, 353.15)
    verdict = sweep_verdict(sweep({TEMPERATURE: kelvin}, [1.44, 1.2, 1 / 1.2]))
    # Half of the logarithms: sqrt(343.15*353.15) K = 348.11 K.
    # A strength that differs by 20 % takes 1.2 across 1.
    assert verdict.text.startswith("Breakdown is likely at 1 of 3 points: ")
    assert "Above about 75 °C the margin is below 1." in verdict.text


@each(
    ("margins", "level"),
    [
        ([1.3, 2.0], "green"),
        ([0.5, 0.8], "red"),
        ([0.5, 0.9], "yellow"),
        ([1.1, 2.0], "yellow"),
        ([0.7, 1.5], "yellow"),
    ],
)
def test_levels(margins, level):
    assert sweep_verdict(sweep({SPEED: (100.0, 200.0)}, margins)).level == level


def test_a_margin_that_may_be_below_one_leaves_no_green_verdict():
    axes, safe = {SPEED: (100.0, 200.0)}, [1.28, 2.0]
    formula = sweep_verdict(sweep(axes, safe, at_0={"contacts": "formula"}, at_1={"contacts": "formula"}))
    assert formula.level == "yellow"
    assert "At 1 of the points the margin is within the 30 %" in formula.text
    warned = sweep_verdict(sweep(axes, safe, at_1={"codes": ["partial-film"]}))
    assert warned.level == "yellow"
    assert "At 1 of the points warnings say" in warned.text
    assert sweep_verdict(sweep(axes, safe, at_1={"codes": ["isothermal-film"]})).level == "green"


@each(("error", "level"), [(0.06, "green"), (0.3, "yellow")])
def test_films_of_the_atlas_are_as_sure_as_their_results_state(error, level):
    stated = {"contacts": "atlas", "film_error": error}
    found = sweep_verdict(sweep({SPEED: (100.0, 200.0)}, [1.28, 2.0], at_0=stated, at_1=stated))
    assert found.level == level
    assert ("At 1 of the points the margin is within the 30 %" in found.text) == (level == "yellow")


def test_contacts_have_their_own_margin():
    verdict = sweep_verdict(sweep({"contact.entrainment_speed": (1.0, 4.0)}, [0.5, 2.0], case=CONTACT))
    assert verdict.text.endswith("Below about 2 m/s the margin is below 1.")


def test_margins_of_boundary_films_are_named_and_leave_no_green_verdict():
    axes, touch = {"contact.entrainment_speed": (1.0, 4.0)}, {"codes": ["asperities-touch"]}
    for margins, level in (([2.0, 3.0], "yellow"), ([0.1, 0.2], "red")):
        verdict = sweep_verdict(sweep(axes, margins, case=CONTACT, at_0=touch))
        assert verdict.level == level
        assert "At 1 of the points asperities are in contact: the contact spots conduct" in verdict.text


def test_points_without_a_margin_leave_no_green_verdict():
    speeds, margins = (1.0, 10.0, 100.0, 200.0, 400.0), [None, None, 1.5, 0.5, 2.0]
    verdict = sweep_verdict(
        sweep(
            {SPEED: speeds},
            margins,
            at_0={"lubrication": "conducting"},
            at_1={"status": "not converged"},
            at_3={"codes": ["grid-far-too-coarse"]},
        )
    )
    assert verdict.level == "yellow"
    for part in (
        "none of 2 points",
        "1.50 to 2.00",
        "3 more points",
        "1 with frequent asperity contact",
        "1 not solved",
        "1 solved",
        "15 V/µm",
    ):
        assert part in verdict.text
    one = sweep_verdict(sweep({SPEED: speeds[:3]}, [1.5, None, 2.0], at_1={"lubrication": "conducting"}))
    assert "1 more point has no margin" in one.text


def test_sweeps_without_margins_have_no_verdict():
    assert sweep_verdict(sweep({SPEED: (1.0, 2.0)}, [None, None])) is None


def test_points_of_which_all_touch_do_not_read_as_safe():
    verdict = sweep_verdict(sweep({SPEED: (1.0, 2.0)}, [None, None], at_1={"lubrication": "conducting"}))
    assert (verdict.level, verdict.margin) == ("yellow", None)
    assert verdict.text.startswith("Discharges likely: at 1 of 2 points asperity contact is frequent")


def test_a_sweep_of_which_all_points_touch_is_as_red_as_its_points():
    """Not milder than a margin below 1; yellow without a motor, and where a point is not solved."""
    axes, touch = {SPEED: (1.0, 2.0)}, {"lubrication": "conducting"}
    verdict = sweep_verdict(sweep(axes, [None, None], at_0=touch, at_1=touch))
    assert (verdict.level, verdict.margin) == ("red", None)
    assert verdict.text.startswith("Discharges likely: at 2 of 2 points asperity contact is frequent")
    alone = bearing_case(BALLS, motor=None)
    assert sweep_verdict(sweep(axes, [None, None], case=alone, at_0=touch, at_1=touch)).level == "yellow"
    failed = touch | {"status": "not converged"}
    assert sweep_verdict(sweep(axes, [None, None], at_0=touch, at_1=failed)).level == "yellow"


def test_no_crossing_where_two_inputs_vary_or_values_are_words():
    inputs = [{SPEED: a, TEMPERATURE: b} for a in (100.0, 200.0) for b in (330.0, 350.0)]
    rows = tuple(
        point(k, one, margin) for k, (one, margin) in enumerate(zip(inputs, (0.5, 2, 0.5, 2), strict=True))
    )
    axes = {SPEED: (100.0, 200.0), TEMPERATURE: (330.0, 350.0)}
    both = SweepResults(bearing_case(BALLS), "grid", axes, {}, 0, rows)
    text = sweep_verdict(both).text
    assert "at 2 of 4 points" in text
    assert "0.50 to 2.00" in text
    assert "margin is below 1" not in text
    words = sweep({"bearing.fill": ("oil", "air")}, [0.5, 2.0])
    assert "margin is below 1" not in sweep_verdict(words).text
    sobol = SweepResults(bearing_case(BALLS), "sobol", {}, {SPEED: Range(1.0, 2.0)}, 2, rows)
    assert "margin is below 1" not in sweep_verdict(sobol).text


def test_a_linear_input_below_zero_is_interpolated_as_it_is():
    assert crossing((-5e-6, 0.5), (15e-6, 2.0)) == pytest.approx(5e-6)
    assert crossing((2.0, 0.5), (8.0, 2.0)) == pytest.approx(4.0)
    assert value_text("bearing.contact_angle", np.deg2rad(25.0), bearing_case(BALLS)) == "25 deg"


def test_a_point_that_is_not_solved_leaves_no_red_verdict():
    """Its margin may be above 1; a point whose surfaces touch breaks down."""
    axes = {SPEED: (1.0, 2.0)}
    failed = sweep_verdict(sweep(axes, [0.5, None], at_1={"status": "failed"}))
    assert failed.level == "yellow"
    assert sweep_verdict(sweep(axes, [0.5, None], at_1={"lubrication": "conducting"})).level == "red"
