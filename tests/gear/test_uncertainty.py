"""Probability that a gear mesh breaks down, within the ranges of its inputs."""

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.bearing import SEED
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_ranges import InputRange
from ehlectric.formulas.sobol import sobol_points
from ehlectric.gear import solve_gear
from ehlectric.gear.solving import capacitances_over_films, solve_gear_pair
from ehlectric.gear.uncertainty import MeshDesign, changes_of, uncertainty_of
from ehlectric.tables.gear_tables import gear_rows
from tests.gear.pairs import case_of
from tests.helpers.each import each
from tests.helpers.gears import spur_case
from tests.helpers.places import EXAMPLES

STRENGTH = "discharge.dielectric_strength"
BULK = "gear.operation.bulk_temperature"


def narrow(case, *wide):
    """Case in which all inputs have a range of almost no width, but the given ones."""
    spans = {
        change.key: [(1.0 - 1e-9) * change.value, (1.0 + 1e-9) * change.value]
        for change in changes_of(case)
        if change.key not in wide
    }
    return case.replace({"ranges": spans})


def at_margin(case, margin):
    """Case with the voltage between both gears at which the margin has a value."""
    breakdown = float(np.min(solve_gear_pair(case).breakdown_voltage))
    return case.replace({"gear.contact.voltage": breakdown / margin})


SMOOTH = case_of(
    summit_height=0.0, contact__conduction="never", flank_ra="0.02 um", contact__reference_area="1 mm^2"
)


@pytest.mark.slow
@pytest.mark.gate
def test_the_probability_of_an_uncertain_strength_in_closed_form():
    """Margin 0.9 s f with s evenly distributed over 0.8 to 1.2, and f over the error of the films: the mean
    over f of the share of s below 1/(0.9 f), by 10 000 values of f.
    """
    case = narrow(at_margin(SMOOTH, 0.9), STRENGTH)
    solution = solve_gear_pair(case)
    found = uncertainty_of(solution)
    film = 1.0 + solution.film_error * np.linspace(-1.0, 1.0, 10_000)
    expected = np.mean(np.clip((1.0 / (0.9 * film) - 0.8) / 0.4, 0.0, 1.0))
    assert found.probability == pytest.approx(expected, abs=0.01)
    assert found.samples >= 512
    assert found.inputs[0].key == STRENGTH
    low, high = found.interval
    assert low == pytest.approx(0.9 * 0.82, rel=0.03)
    assert high == pytest.approx(0.9 * 1.18, rel=0.03)
    assert float(np.median(found.voltages)) == pytest.approx(0.9 * case.gear.contact.voltage, rel=0.01)


@pytest.mark.slow
def test_points_of_the_design_are_gear_pairs_with_these_inputs():
    """Lambda ratio and breakdown voltage by the solution of each changed case, and the factor on its film."""
    case = at_margin(case_of(flank_ra="0.03 um", contact__reference_area="1 mm^2"), 1.0)
    solution = solve_gear_pair(case)
    design = MeshDesign.of(solution)
    found = uncertainty_of(solution, samples=32)
    at = sobol_points(design.width, 32, SEED)
    strength = np.exp(design.log_factors(at)[:, 0])
    for k, (changes, factor) in enumerate(design.changed(at)):
        if k % 8 == 0:
            alone = solve_gear_pair(case.replace(changes))
            film = factor * float(np.nanmin(alone.films.minimum))
            height = alone.case.gear.summit_height * alone.rq
            assert found.lambda_ratios[k] == pytest.approx(film / alone.rq)
            (capacitance,) = capacitances_over_films(alone, np.array([factor]))
            assert found.capacitances[k] == pytest.approx(capacitance, rel=1e-3)
            assert found.voltages[k] == pytest.approx(strength[k] * 15e6 * max(film - height, 0.0))
    assert found.margins == pytest.approx(found.voltages / case.gear.contact.voltage)


@pytest.mark.slow
def test_a_mesh_that_conducts_does_not_break_down():
    """Ground flanks at a high load: no point of the design insulates, and the table is null."""
    case = case_of(contact__voltage="5 V", flank_ra="0.8 um", operation__pinion_speed="300 rpm")
    result = solve_gear(case)
    assert result.uncertainty is None
    assert "uncertainty" not in result.summary()
    assert result.verdict.code == "mesh-conducts"


@pytest.mark.slow
def test_summits_that_touch_count_as_breakdown():
    """Summits three times as high as the film can be touch at each point."""
    case = case_of(contact__voltage="5 V", contact__conduction="never", flank_ra="0.1 um", summit_height=5.9)
    found = uncertainty_of(solve_gear_pair(narrow(case)), samples=32)
    assert found.touching == 1.0
    assert found.probability == 1.0
    assert found.summary()["breakdown_voltage_high"] == 0.0


@pytest.mark.slow
@pytest.mark.gate
def test_a_mesh_without_margins_has_no_rows_about_them():
    """Ground flanks: each point conducts or touches, so that both probabilities add up to 1."""
    result = solve_gear(
        case_of(contact__voltage="5 V", flank_ra="0.3 um", operation__pinion_torque="100 N m")
    )
    table = result.summary()["uncertainty"]
    assert 0.0 < table["conduction_probability"] < 1.0
    assert table["conduction_probability"] + table["asperity_contact_probability"] == pytest.approx(1.0)
    assert (table["indices"], table["predicted"]) == ([], None)
    rows = {row.key: row for row in gear_rows(result.summary()) if row.key.startswith("uncertainty.")}
    assert [key for key in rows if "indices" in key or "breakdown_probability" in key] == []
    voltages = [row.value for key, row in rows.items() if "voltage" in key]
    assert len(voltages) == 1
    assert isinstance(voltages[0], str)
    assert "mesh-conducts-in-cases" in {reason.code for reason in result.verdict.reasons}


def test_a_result_without_voltage_or_strength_has_no_probability():
    assert solve_gear(case_of()).uncertainty is None
    assert "uncertainty" not in solve_gear(case_of(), probable=False).summary()


def test_usual_ranges_and_ranges_of_the_file():
    case = case_of(flank_ra="0.05 um +- 40 %").replace({"ranges": {BULK: ["80 degC", "95 degC"]}})
    ends = {change.key: change.ends for change in changes_of(case)}
    assert ends[BULK] == pytest.approx((353.15, 368.15))
    assert ends[STRENGTH] == pytest.approx((12e6, 18e6))
    assert ends["gear.summit_height"] == (1.0, 3.0)
    assert ends["gear.contact.reference_area"] == pytest.approx((1e-6 / 3.0, 3e-6))
    stated = case_of(flank_ra="0.05 um +- 40 %")
    assert stated.ranges == (InputRange("gear.flank_ra", pytest.approx(3e-8), pytest.approx(7e-8)),)
    assert stated.replace({"gear.flank_ra": "0.1 um"}).ranges is None
    assert GearCase.from_dict(stated.to_dict()) == stated


@each(
    ("ranges", "text"),
    [
        ({"gear.flank_ra": ["0.4 um", "0.5 um"]}, "contains the value"),
        ({"gear.face_widht": ["1 mm", "2 mm"]}, "face_width"),
        ({"gear.tip_diameter": [0.08, 0.09]}, "list of two values"),
        ({"gear.flank_ra": ["0.5 um", "0.1 um"]}, "smaller one first"),
    ],
)
def test_wrong_ranges_are_refused(ranges, text):
    with pytest.raises(InputError, match=text):
        case_of().replace({"ranges": ranges})


@pytest.mark.parametrize("changes", [{}, {"gear.lead_crowning": "20 um", "gear.tip_relief": None}])
def test_unchanged_films_give_the_capacitance_of_the_solution(changes):
    """Also if relief or crowning keeps parts of the flanks apart."""
    case = GearCase.from_toml(EXAMPLES / "gear_pair.toml")
    if changes:
        case = case.replace({**changes, "gear.tip_relief_length": None})
    solution = solve_gear_pair(case)
    (same,) = capacitances_over_films(solution, np.array([1.0]))
    assert same == pytest.approx(solution.loads.mean(solution.capacitance), rel=1e-9)


def test_the_range_of_the_capacitance_contains_the_error_of_the_films():
    """A higher speed makes all films thicker at equal loads, and the capacitance follows."""
    case = spur_case()
    solution = solve_gear_pair(case)
    faster = solve_gear_pair(case.replace({"gear.operation.pinion_speed": "2340 rpm"}))
    factor = float(np.nanmin(faster.films.central) / np.nanmin(solution.films.central))
    assert 1.02 < factor < 1.04
    same, thicker = capacitances_over_films(solution, np.array([1.0, factor]))
    assert same == pytest.approx(solution.loads.mean(solution.capacitance), rel=1e-6)
    assert thicker == pytest.approx(faster.loads.mean(faster.capacitance), rel=5e-4)
    # Without the wedges next to the zone, the capacitance is inversely proportional to the film.
    assert same / factor < thicker < same
    uncertainty = uncertainty_of(solution, samples=64)
    error = solution.film_error
    ends = capacitances_over_films(solution, np.array([1.0 - error, 1.0 + error])) / same - 1.0
    assert uncertainty.capacitance_film_error == pytest.approx(float(np.max(np.abs(ends))), rel=1e-6)
