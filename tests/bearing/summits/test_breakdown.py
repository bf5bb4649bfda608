"""Breakdown under the highest summits: numbers by hand, limits, and points that are computed together."""

import dataclasses

import numpy as np
import pytest

from ehlectric import BearingCase, InputError, evaluate, solve_bearing
from ehlectric.bearing.bearing_discharges import breakdown_of, margin_with_films, shaft_voltage
from ehlectric.bearing.impedance import film_share
from ehlectric.bearing.solution import bearing_state, conducts, insulating, lambda_ratio
from ehlectric.bearing.stored import dataset_of, solution_of
from ehlectric.bearing.summary import contact_rows
from ehlectric.quantities.result_bounds import breakdown_words
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, numbers_of
from tests.helpers.each import each

HEIGHT, RQ = "bearing.summit_height", "bearing.composite_rq"


def solved(tables=BALLS, **changes):
    case = bearing_case(tables, contacts="formula", **changes)
    return solve_bearing(case, workers=1).solution


@pytest.fixture(scope="module")
def smooth():
    return solved()


def with_summits(solution, height, rq=0.03e-6):
    """Same films with summits of a height in units of a roughness [m]."""
    changes = {HEIGHT: height, RQ: rq}
    return dataclasses.replace(solution, case=solution.case.replace(changes))


def first_break(solution):
    return breakdown_of(solution).first_break


@each("tables", [BALLS, ROLLERS], ids=lambda tables: tables["bearing"]["kind"])
def test_each_contact_breaks_down_at_its_gap_under_the_summits(tables):
    """By hand: the strength of 15 V/um times h_min - k Rq of each contact, also of those without load."""
    rows = contact_rows(with_summits(solved(tables), 1.5))
    gaps = np.array([row["minimum_thickness"] for row in rows]) - 1.5 * 0.03e-6
    assert [row["breakdown_voltage"] for row in rows] == pytest.approx(15e6 * gaps, rel=1e-12)
    fields = [row["voltage_share"] / gap for row, gap in zip(rows, gaps, strict=True)]
    assert [row["strength_per_volt"] for row in rows] == pytest.approx(fields, rel=1e-12)


def test_without_height_the_films_are_smooth_to_the_last_digit(smooth):
    assert breakdown_of(with_summits(smooth, 0.0)) == breakdown_of(smooth)
    rows = contact_rows(with_summits(smooth, 0.0))
    values = smooth.positions[0].inner.values.breakdown_voltage
    assert [row["breakdown_voltage"] for row in rows if row["ring"] == "inner"] == values.tolist()


def test_thick_films_lose_the_height_over_lambda(smooth):
    """The same contact breaks down first, and its film is the thinnest one."""
    rough = with_summits(smooth, 2.0, rq=1e-12)
    part = 2.0 / lambda_ratio(rough)
    assert part < 1e-4
    assert 1.0 - first_break(rough) / first_break(smooth) == pytest.approx(part, rel=1e-6)
    assert breakdown_of(rough).first_break_at == breakdown_of(smooth).first_break_at


def test_the_voltage_ends_at_zero(smooth):
    """Just above the height of the summits it is tiny, and at the height and below there is none."""
    at = smooth.least_film / 2.0
    above = with_summits(smooth, 2.0, rq=at * (1.0 - 1e-6))
    assert first_break(above) / first_break(smooth) == pytest.approx(1e-6, rel=1e-3)
    for rq in (at * (1.0 + 1e-9), 1.5 * at):
        below = with_summits(smooth, 2.0, rq=rq)
        assert (breakdown_of(below), shaft_voltage(below), film_share(below)) == (None, None, None)
        assert conducts(below)
        assert bearing_state(below) == "frequent asperity contact"
        assert {row["breakdown_voltage"] for row in contact_rows(below)} == {None}
        # The contacts are on the scale of the bearing; the words of the former key are coarser.
        states = {row["lubrication_state"] for row in contact_rows(below)}
        assert "frequent asperity contact" in states
        assert "boundary lubrication" not in states
        assert {row["regime"] for row in contact_rows(below)} <= {"partial film", "full film", "gap"}
    assert not insulating(with_summits(smooth, 2.0, rq=2.0 * at))


def test_a_lambda_ratio_below_one_has_no_voltage_with_any_height(smooth):
    thin = smooth.least_film / 0.999
    for height in (0.0, 0.5):
        assert breakdown_of(with_summits(smooth, height, rq=thin)) is None
    thick = smooth.least_film / 1.001
    assert breakdown_of(with_summits(smooth, 0.5, rq=thick)) is not None


def test_higher_summits_break_down_earlier(smooth):
    heights = np.linspace(0.0, 5.0, 11)
    voltages = [breakdown_of(with_summits(smooth, height)) for height in heights]
    for name in ("first_break", "first_break_mean", "ring_to_ring_breakdown", "shaft_first_break"):
        assert np.all(np.diff([getattr(one, name) for one in voltages]) < 0.0)


def test_a_coating_takes_its_share_of_the_shaft_voltage_as_before():
    coating = {"ring": "outer", "thickness": "100 um", "relative_permittivity": 9.0, "area": "4000 mm^2"}
    smooth = solved(bearing__coating=coating)
    rough = with_summits(smooth, 2.0)
    for one in (smooth, rough):
        found = breakdown_of(one)
        shares = [one.case.bearing.coating_capacitance() for _ in range(1)]
        films = np.array([circuit.capacitance for circuit in one.circuits()])
        share = 1.0 / (1.0 + films / shares[0])
        first = np.array([circuit.first_break for circuit in one.circuits()])
        assert found.shaft_first_break == pytest.approx(np.min(first / share), rel=1e-12)
    # Each contact keeps its part 1 - k/lambda, which is least where the film is.
    part = 1.0 - 2.0 / lambda_ratio(rough)
    ratio = breakdown_of(rough).shaft_first_break / breakdown_of(smooth).shaft_first_break
    assert ratio == pytest.approx(part, rel=1e-9)


def test_ceramic_elements_have_no_voltage_and_no_other_state():
    ceramic = solved(bearing__element_material="silicon-nitride")
    for height, state in ((0.0, "full film"), (2.0, "full film")):
        assert bearing_state(with_summits(ceramic, height)) == state
    thin = ceramic.least_film / 1.5
    rough = with_summits(ceramic, 2.0, rq=thin)
    assert bearing_state(rough) == "frequent asperity contact"
    assert not conducts(rough)
    assert breakdown_of(with_summits(ceramic, 2.0)) is None


def test_thinner_films_by_hand(smooth):
    """All films f times as thick: f - k/lambda in place of 1 - k/lambda, and 0 where they touch."""
    rough = with_summits(smooth, 2.0)
    part, own = 2.0 / lambda_ratio(rough), first_break(rough) / shaft_voltage(rough)
    scale = np.array([1.0, 0.8, 1.3, 0.5 * part])
    expected = [own * (f - part) / (1.0 - part) for f in scale[:3]]
    assert margin_with_films(rough, scale) == pytest.approx([*expected, 0.0], rel=1e-9)


@pytest.mark.slow
@pytest.mark.gate
def test_points_together_have_the_numbers_of_single_ones():
    case = bearing_case(BALLS, contacts="atlas", bearing__film_factor="inlet-shear",
                        lubricant__thermal_conductivity="0.14 W/m/K")  # fmt: skip
    speeds, heights, rqs = [314.0, 40.0, 150.0, 314.0], [2.0, 2.0, 0.0, 3.0], [3e-8, 3e-8, 5e-8, 3e-8]
    found = evaluate(case, {"bearing.inner_speed": speeds, HEIGHT: heights, RQ: rqs})
    for k, changes in enumerate(zip(speeds, heights, rqs, strict=True)):
        one = case.replace(dict(zip(("bearing.inner_speed", HEIGHT, RQ), changes, strict=True)))
        own = numbers_of(solve_bearing(one, workers=1))["bearing"]
        assert found["bearing.lubrication_state"].values[k] == own["lubrication_state"]
        for key in ("first_break", "margin", "ring_to_ring_breakdown", "max_strength", "shaft_voltage"):
            value = np.nan if own[key] is None else own[key]
            assert found[f"bearing.{key}"].values[k] == pytest.approx(value, rel=1e-9, nan_ok=True)
    assert found["bearing.lubrication"].values[1] == "conducting"
    assert np.isnan(found["bearing.first_break"].values[1])


@each(
    ("given", "height"),
    [
        ({"bearing__film_factor": None}, 2.0),
        ({"bearing__film_factor": "none"}, 0.0),
        ({"bearing__film_factor": 1.0}, 0.0),
        ({"bearing__film_factor": 0.7}, 2.0),
        ({"bearing__film_factor": None, "lubricant": {"base": "fva-3"}}, 2.0),
        ({"bearing__film_factor": "none", "bearing__summit_height": 1.2}, 1.2),
        ({"bearing__film_factor": None, "bearing__summit_height": 0}, 0.0),
    ],
)
def test_the_height_follows_from_the_film_factor_unless_it_is_given(given, height):
    assert bearing_case(BALLS, **given).bearing.summit_height == height


def test_a_height_that_is_not_given_follows_the_film_factor_of_a_changed_case():
    case = bearing_case(BALLS, bearing__film_factor=None)
    bound = case.replace({"bearing.film_factor": "none"})
    assert (
        bound.bearing.summit_height,
        bound.replace({"bearing.film_factor": 0.9}).bearing.summit_height,
    ) == (
        0.0,
        2.0,
    )
    given = case.replace({HEIGHT: 1.0}).replace({"bearing.film_factor": "none"})
    assert given.bearing.summit_height == 1.0
    assert BearingCase.from_dict(bound.to_dict()).bearing.summit_height == 0.0


@each("value", [-0.1, 6.1, "high", "2 um"])
def test_a_height_out_of_bounds_is_refused_with_its_key(value):
    with pytest.raises(InputError) as error:
        bearing_case(BALLS, bearing__summit_height=value)
    assert error.value.key == HEIGHT
    assert all(word in str(error.value) for word in ("0", "6"))


@pytest.mark.slow
@each(
    ("factor", "height", "words"),
    [
        (None, None, "best estimate: rough film"),
        (None, 0.0, "upper bound: smooth film"),
        ("none", None, "upper bound: isothermal, fully flooded, smooth film"),
        ("none", 2.0, "upper bound: isothermal, fully flooded, rough film"),
    ],
)
def test_words_say_whether_voltages_are_bounds(factor, height, words):
    result = solve_bearing(
        bearing_case(BALLS, contacts="formula", bearing__film_factor=factor, bearing__summit_height=height),
        workers=1,
    )
    summary = result.summary()
    assert breakdown_words(summary) == words
    kind, _, films = words.partition(": ")
    assert f"{kind[0].upper()}{kind[1:]}: " in result.verdict.text
    for word in films.split(", "):
        assert word.split(" ")[0] in result.verdict.text
    assert ("≤" in repr(result)) == (kind == "upper bound")


def test_a_stored_result_that_knows_no_summits_keeps_the_voltages_of_smooth_films():
    solution = solved(bearing__film_factor=0.9)
    dataset = dataset_of(solution)
    assert first_break(solution_of(dataset)) == first_break(solution)
    lines = dataset.attrs["case"].splitlines()
    without = [line for line in lines if not line.startswith("summit_height")]
    assert len(without) == len(lines) - 1
    dataset.attrs["case"] = "\n".join(without)
    loaded = solution_of(dataset)
    assert loaded.case.bearing.summit_height == 0.0
    assert first_break(loaded) == first_break(with_summits(solution, 0.0))
    assert first_break(loaded) > 1.3 * first_break(solution)
