"""Every curve of a bearing that is drawn between computed points, against values at 200 random abscissae."""

import numpy as np
import pytest

from ehlectric.bearing import duty_points
from ehlectric.bearing.curve_nodes import where_it_bends
from ehlectric.bearing.impedance import impedance_of
from ehlectric.bearing.many_points import columns_of
from ehlectric.bearing.margin import QuickMargins, speed_range
from ehlectric.bearing.quick_contacts import quick_case
from ehlectric.bearing.solution import lambda_ratio
from ehlectric.bearing.solving import solution_of
from ehlectric.bearing.speed_curves import critical_speed_of, curves_of, listed, opening_speed_of, over_speed
from ehlectric.bearing.uncertainty import margin_band
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.figures.bearing_figures import magnitude_at
from ehlectric.quantities.units import RPM
from tests.helpers.bearings import BALLS, bearing_case

SPEED = "bearing.inner_speed"

# Greased rollers. One of the first speeds of their curve is just above the speed at which the summits part. A
# curve through few speeds reached 8.5 V at 991 rpm.
ROLLERS = {
    "bearing": {
        "base": "NU 214 ECP",
        "clearance_class": "CN",
        "radial_load": "8 kN",
        "temperature": "75 degC",
        "inner_speed": "1780 rpm",
        "supply": "grease",
        "fill": "oil",
        "composite_rq": "0.1 um",
    },
    "lubricant": {"base": "fva-3"},
    "discharge": {"dielectric_strength": "15 V/um", "conductivity": "1 pS/m"},
    "motor": {
        "common_mode_voltage": "300 V",
        "winding_rotor_capacitance": "20 pF",
        "rotor_frame_capacitance": "1 nF",
    },
}
DRAWN = ("capacitance", "first_break", "ring_to_ring_breakdown", "shaft_voltage", "lambda_ratio")


def rollers():
    return BearingCase.from_dict(ROLLERS).replace({"contacts": "atlas"})


def balls():
    return bearing_case(BALLS, contacts="atlas", bearing__summit_height=2.0)


def random_between(low, high, count=200, seed=56):
    """Increasing random positions, evenly distributed in their logarithms."""
    parts = np.sort(np.random.default_rng(seed).random(count))
    return low * (high / low) ** parts


def test_a_curve_has_nodes_where_it_bends_and_where_it_begins():
    """A square root that begins at 0.3, and has a corner at 0.7: exact values everywhere."""

    def values(x):
        begun = np.sqrt(np.where(x < 0.3, np.nan, x - 0.3)) + 0.5
        return np.stack([begun, np.maximum(x, 0.7)])

    start = np.linspace(0.0, 1.0, 4)
    x, found = where_it_bends(values, start, values(start), tolerance=0.01, closest=1e-3)
    np.testing.assert_array_equal(found, values(x))
    begins = x[np.isfinite(found[0])][0]
    assert 0.3 <= begins < 0.301
    at = np.random.default_rng(1).random(200)
    at = at[(at < 0.3) | (at > begins)]
    between = np.array([np.interp(at, x, row) for row in found])
    np.testing.assert_allclose(between, values(at), atol=0.01)
    assert x.size < 60


@pytest.mark.parametrize(
    "case", [rollers(), pytest.param(balls(), marks=pytest.mark.slow)], ids=["rollers", "balls"]
)
def test_curves_over_the_speed_are_the_bearing_at_every_speed(case):
    """Direct values are those of the bearing itself, as a sweep has them."""
    points, left_out = over_speed(case)
    assert not left_out
    curves = curves_of(points)
    speeds = random_between(curves.speed[0], curves.speed[-1])
    direct = columns_of(case.with_arrays({SPEED: speeds})).values
    for key in DRAWN:
        expected, drawn = direct[f"bearing.{key}"], curves.at(key, speeds)
        known = np.isfinite(expected)
        # The end of a curve is known to 0.05 % of the speed, and contacts with few loads move it by 0.1 %.
        assert np.count_nonzero(known != np.isfinite(drawn)) <= 1, key
        known &= np.isfinite(drawn)
        error = np.abs(drawn - expected)[known]
        assert np.all(error < 0.01 * expected[known] + 2e-3 * np.max(expected[known])), key


@pytest.mark.parametrize("case", [rollers(), balls()], ids=["rollers", "balls"])
def test_curves_are_within_their_stated_error_of_a_fine_series(case):
    """The bearing with as few loads as the curves at 500 speeds: 0.3 %, except up to 0.1 % above the speed at
    which the surfaces part, where the first breakdown is 0.
    """
    curves = curves_of(over_speed(case)[0])
    fine = curves_of(over_speed(case, count=500)[0])
    for key in DRAWN:
        off = np.abs(np.log(curves.at(key, fine.speed) / fine[key]))
        known = np.isfinite(off)
        assert np.count_nonzero(known != np.isfinite(fine[key])) <= 1, key
        beyond = known & (fine.speed > 1.001 * fine.speed[known][0])
        assert np.count_nonzero(beyond) > 100, key
        assert np.all(off[beyond] < 3e-3), key


def test_the_ring_to_ring_curve_of_rollers_has_no_hump():
    """0.58 V at 1000 rpm: a curve that rises with the speed is nowhere above its value at a higher one."""
    points, _ = over_speed(rollers())
    speed, through = curves_of(points).between("ring_to_ring_breakdown")
    known = np.isfinite(through)
    at = float(np.interp(1000.0 * RPM, speed[known], through[known]))
    assert at == pytest.approx(0.58, abs=0.01)
    assert np.max(through[known & (speed < 1100.0 * RPM)]) < 0.8


@pytest.mark.slow
def test_films_at_other_speeds_are_scaled_to_the_films_of_the_bearing():
    """Films 10 % thicker than in the atlas: voltages begin at the speed at which thicker films part."""
    case = balls()
    ratio = float(lambda_ratio(solution_of(case)))
    points, _ = over_speed(case, ratio_of_case=1.1 * ratio)
    curves = curves_of(points)
    thicker = case.replace({"bearing.composite_rq": case.bearing.composite_rq / 1.1})
    expected = curves_of(over_speed(thicker)[0])
    assert opening_speed_of(curves) == pytest.approx(opening_speed_of(expected), rel=2e-3)
    at = random_between(opening_speed_of(expected) * 1.01, curves.speed[-1])
    np.testing.assert_allclose(curves.at("first_break", at), expected.at("first_break", at), rtol=0.01)
    assert points[0][1]["inputs"]["bearing"]["composite_rq"] == case.bearing.composite_rq


@pytest.mark.slow
def test_a_table_over_the_speed_has_the_speeds_of_the_series():
    case = balls()
    own = case.bearing.inner_speed
    points, _ = over_speed(case)
    rows = listed(points, own)
    assert len(rows) == 12
    assert [rows[0][0] / own, rows[-1][0] / own] == pytest.approx([0.1, 4.0])
    assert any(speed == own for speed, _ in rows)


@pytest.mark.slow
def test_critical_and_opening_speed_are_crossings_of_the_drawn_curves():
    case = balls()
    curves = curves_of(over_speed(case)[0])
    found = speed_range(QuickMargins.of(solution_of(case)))
    assert critical_speed_of(curves) == pytest.approx(found.critical, rel=3e-3)
    assert opening_speed_of(curves) == pytest.approx(found.touching, rel=3e-3)


@pytest.mark.slow
def test_the_margin_with_what_is_uncertain_is_computed_where_it_is_drawn():
    """The same 128 points of the other inputs at 40 random speeds: 10 %, or a tenth of the least margin."""
    case = balls()
    solution = solution_of(case)
    margins = QuickMargins.of(solution)
    band = margin_band(solution, margins)
    speeds = random_between(band.speed[0], band.speed[-1], 40)
    direct = margin_band(solution, margins, speeds)
    for key in ("low", "median", "high"):
        drawn = np.interp(speeds, band.speed, getattr(band, key))
        np.testing.assert_allclose(drawn, getattr(direct, key), rtol=0.1, atol=0.02, err_msg=key)


@pytest.mark.slow
def test_rows_of_a_cycle_are_within_the_stated_error(monkeypatch):
    """Random rows that were not compared: the error is that of 256 rows, and at most doubled elsewhere."""
    generator = np.random.default_rng(56)
    inputs = {
        SPEED: random_between(20.0, 400.0, 900),
        "bearing.radial_load": generator.uniform(1500.0, 2000.0, 900),
    }
    case, _ = quick_case(balls())
    exact = duty_points.values_at(case, inputs)
    monkeypatch.setattr(duty_points, "MOST_SOLVED", 700)
    found = duty_points.values_at(case, inputs)
    rows = generator.choice(900, 200, replace=False)
    for name in ("lambda_ratio", "capacitance", "margin", "first_break", "shaft_voltage"):
        expected, between = exact.values[name][rows], found.values[name][rows]
        np.testing.assert_array_equal(np.isfinite(between), np.isfinite(expected))
        known = np.isfinite(expected)
        assert np.max(np.abs(between / expected - 1.0)[known]) < 2.0 * found.error + 1e-3, name


def test_the_impedance_between_its_frequencies_is_the_impedance_there():
    """Films of one time constant: 1/Z = C (2 pi j f + 1/tau), in parallel to nothing."""
    found = impedance_of(solution_of(rollers()))
    capacitance = 1.0 / (2.0 * np.pi * found.frequency[-1] * found.magnitude[-1])
    for at in random_between(found.frequency[0], found.frequency[-1]).tolist():
        exact = 1.0 / (2.0 * np.pi * capacitance * abs(1j * at + found.corner))
        assert magnitude_at(found, at) == pytest.approx(exact, rel=5e-3)
