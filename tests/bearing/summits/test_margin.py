"""Margins of bearings with summits: their range, films that are uncertain, speeds, and drives."""

import dataclasses

import numpy as np
import pytest

from ehlectric import solve_bearing
from ehlectric.bearing import duty_points
from ehlectric.bearing.bearing_discharges import first_margin
from ehlectric.bearing.margin import QuickMargins, speed_range
from ehlectric.bearing.solution import conducts, lambda_ratio
from ehlectric.bearing.solving import solution_of
from ehlectric.bearing.speed_curves import Curves, curves_of, opening_speed_of, over_speed
from ehlectric.bearing.uncertain_inputs import changes_of
from ehlectric.bearing.uncertainty import FILMS, Design, quick_chance, uncertainty_of
from ehlectric.drive.drive_bearings import bearing_element
from ehlectric.drive.preparation import prepare
from tests.helpers.bearings import BALLS, bearing_case, with_values
from tests.helpers.drives import small_drive

HEIGHT, RQ, SPEED = "bearing.summit_height", "bearing.composite_rq", "bearing.inner_speed"


def case(**changes):
    return bearing_case(BALLS, contacts="atlas", bearing__summit_height=2.0).replace(changes)


@pytest.fixture(scope="module")
def rough():
    solution = solution_of(case())
    return solution, QuickMargins.of(solution)


def test_the_usual_range_is_one_either_way_with_its_reason():
    (change,) = (one for one in changes_of(case()) if one.key == HEIGHT)
    assert change.ends == (1.0, 3.0)
    assert "1 to 3" in change.reason
    assert "measured at 2" in change.reason
    ends = {one.key: one.ends for one in changes_of(case(**{HEIGHT: 0.4}))}[HEIGHT]
    assert ends == pytest.approx((0.2, 0.6))
    assert {one.key: one.ends for one in changes_of(case(**{HEIGHT: 5.5}))}[HEIGHT] == (4.5, 6.0)
    assert HEIGHT not in {one.key for one in changes_of(case(**{HEIGHT: 0.0}))}


def test_margins_at_other_heights_and_roughnesses_are_those_of_solved_bearings(rough):
    solution, margins = rough
    changes = [{HEIGHT: 1.0}, {HEIGHT: 3.0}, {RQ: 4e-8}, {RQ: 4e-8, HEIGHT: 0.0}, {HEIGHT: 6.0, RQ: 6e-8}]
    for change in changes:
        own = dataclasses.replace(solution, case=solution.case.replace(change))
        expected = first_margin(own) or 0.0
        assert margins.at(change).margin == pytest.approx(expected, rel=1e-4)
        assert margins.at(change).lambda_ratio == pytest.approx(lambda_ratio(own), rel=1e-9)


def thicker(solution, factor):
    """Solution whose films are some times as thick, with capacitances as they are."""

    def ring(one):
        least, voltage = one.values.minimum_thickness, one.values.breakdown_voltage
        return with_values(one, minimum_thickness=factor * least, breakdown_voltage=factor * voltage)

    positions = tuple(
        dataclasses.replace(one, inner=ring(one.inner), outer=ring(one.outer)) for one in solution.positions
    )
    return dataclasses.replace(solution, positions=positions)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("changes", [{SPEED: 120.0}, {SPEED: 80.0}, {HEIGHT: 4.0}, {RQ: 6e-8}])
def test_quick_films_are_scaled_to_the_lambda_ratio_of_the_solution(rough, changes):
    """A solution whose films are 4 % thicker than those of the atlas, at inputs at which summits matter."""
    solution, _ = rough
    margins = QuickMargins.of(thicker(solution, 1.04))
    assert margins.lambda_factor == pytest.approx(1.04, rel=1e-3)
    expected = thicker(solution_of(case(**changes)), 1.04)
    found = margins.at(changes)
    assert found.lambda_ratio == pytest.approx(lambda_ratio(expected), rel=1e-3)
    assert found.margin == pytest.approx(first_margin(expected), rel=5e-3)


@pytest.mark.slow
@pytest.mark.gate
def test_the_error_of_the_films_acts_on_the_gap_that_summits_leave(rough):
    """By plain points: the margin at films of a random thickness, each by hand from least film and height."""
    solution, margins = rough
    design = Design.of(solution)
    number = len(design.computed)
    at = np.full((5, design.width), 0.5)
    at[:, number] = [0.0, 0.25, 0.5, 0.75, 1.0]
    scale = design.film_scale(at)
    low, high = design.films
    assert scale == pytest.approx(np.linspace(low, high, 5))
    arrays = design.arrays(at)
    assert arrays[RQ] == pytest.approx(0.03e-6 / scale)
    plain = solution.case.with_values({RQ: arrays[RQ]})
    found = scale * first_margin(dataclasses.replace(solution, case=plain))
    part = 2.0 / lambda_ratio(solution)
    assert found == pytest.approx(first_margin(solution) * (scale - part) / (1.0 - part), rel=1e-9)
    keys = [one.key for one in uncertainty_of(solution, margins, samples=256).inputs]
    assert {FILMS, HEIGHT} < set(keys)


@pytest.mark.slow
def test_summits_and_films_that_touch_count_as_breakdown():
    thin = solution_of(case(**{SPEED: 75.0}))
    assert 2.0 < lambda_ratio(thin) < 3.0
    found = uncertainty_of(thin, QuickMargins.of(thin), samples=512)
    # The least film is between the least and the largest height; other inputs move it.
    assert 0.2 < found.touching < 0.8
    assert np.mean(found.margins == 0.0) == pytest.approx(found.touching)
    assert found.probability >= found.touching
    chance = quick_chance(thin)
    assert chance is not None
    assert (chance.low, chance.probability) == (0.0, 1.0)


def test_critical_and_touching_speed_are_those_of_bearings_at_them(rough):
    speeds = speed_range(rough[1])
    own = [solution_of(case(**{SPEED: speed})) for speed in (speeds.critical, speeds.touching * 1.002)]
    assert first_margin(own[0]) == pytest.approx(1.0, rel=5e-3)
    assert lambda_ratio(own[1]) == pytest.approx(2.0, rel=5e-3)
    assert first_margin(own[1]) < 0.02


def test_curves_between_few_speeds_stay_between_their_values():
    """A film that is a power of the speed, and a voltage that is 0 where the summits part."""
    speed = np.geomspace(10.0, 1000.0, 4)

    def ratio(at):
        return 3.0 * (at / 10.0) ** 0.7

    values = {"lambda_ratio": ratio(speed), "first_break": 0.5 * (ratio(speed) - 2.0)}
    curves = Curves(speed, values, {}, summit_height=2.0)
    at = np.geomspace(10.0, 1000.0, 50)
    np.testing.assert_allclose(curves.at("lambda_ratio", at), ratio(at), rtol=1e-9)
    drawn, place = curves.at("first_break", at), np.minimum(np.searchsorted(speed, at, side="right"), 3)
    ends = values["first_break"][place - 1], values["first_break"][place]
    assert np.all((drawn > (1.0 - 1e-9) * ends[0]) & (drawn < (1.0 + 1e-9) * ends[1]))
    assert opening_speed_of(curves) is None
    touching = Curves(speed, values | {"lambda_ratio": 0.5 * ratio(speed)}, {}, summit_height=2.0)
    assert opening_speed_of(touching) == pytest.approx(10.0 * (4.0 / 3.0) ** (1.0 / 0.7), rel=1e-6)


def test_curves_over_the_speed_are_near_bearings_between_their_speeds():
    points, left_out = over_speed(case())
    assert not left_out
    curves = curves_of(points)
    with_voltage = curves.speed[np.isfinite(curves["first_break"])]
    # The curve begins where the summits part.
    assert curves.at("lambda_ratio", with_voltage[0]) == pytest.approx(2.0, rel=1e-3)
    for at in (with_voltage[0] * np.array([1.01, 1.1, 1.5])).tolist():
        found = solve_bearing(case(**{SPEED: at}), workers=1).breaks()["first_break"]
        assert curves.at("first_break", at) == pytest.approx(found, rel=0.02)


@pytest.mark.slow
def test_a_duty_cycle_between_a_design_ends_at_the_summits(monkeypatch):
    """Interpolated points: no voltage up to the height, and otherwise that of the point itself."""
    speeds = np.geomspace(20.0, 400.0, 900)
    inputs = {SPEED: speeds, "bearing.radial_load": np.linspace(1500.0, 2000.0, 900)}
    exact = duty_points.values_at(case(), inputs)
    assert exact.error is None
    monkeypatch.setattr(duty_points, "MOST_SOLVED", 700)
    found = duty_points.values_at(case(), inputs)
    assert found.error is not None
    assert found.error < 0.02
    known = np.isfinite(exact.values["margin"])
    assert 0 < np.count_nonzero(~known) < 900
    np.testing.assert_array_equal(np.isfinite(found.values["margin"]), known)
    far = known & (exact.values["lambda_ratio"] > 2.1)
    np.testing.assert_allclose(found.values["margin"][far], exact.values["margin"][far], rtol=0.02)


def test_a_drive_breaks_down_at_the_voltage_under_the_summits_and_not_below_that_of_an_arc():
    drive = small_drive(**{f"bearings.{HEIGHT}": 2.0})
    ready = prepare(drive, workers=1)
    (element, _), solution = ready.elements, ready.bearings[0].solution
    through = [circuit.ring_to_ring_breakdown for circuit in solution.circuits()]
    np.testing.assert_allclose(element.breakdown, through, rtol=1e-12)
    smooth = [position.circuit("oil").ring_to_ring_breakdown for position in solution.positions]
    assert np.all(element.breakdown < 0.9 * np.array(smooth))
    lowest = drive.breakdown.lowest_voltage
    # Summits that touch in the most loaded contacts with both rings.
    changes = {RQ: solution.least_film / 1.05, "bearing.contact_resistance": "1 ohm"}
    changed = dataclasses.replace(solution, case=solution.case.replace(changes))
    assert conducts(changed)
    assert min(circuit.ring_to_ring_breakdown for circuit in changed.circuits()) < 0.5 * lowest
    touching = dataclasses.replace(ready.bearings[0], solution=changed)
    found = bearing_element(touching, drive.breakdown).breakdown
    assert lowest < np.min(found) < 1.01 * lowest
    # An arc that a smooth film would not feed is refused as before.
    high = drive.breakdown.model_copy(update={"extinction_current": None, "extinction_voltage": 50.0})
    assert np.all(bearing_element(ready.bearings[0], high).breakdown < 50.0)
