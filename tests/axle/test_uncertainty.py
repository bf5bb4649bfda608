"""Probabilities of the elements of an axle: by hand, against single solutions, and with ranges of a file."""

import numpy as np
import pytest

from ehlectric import AxleCase, InputError, solve_axle
from ehlectric.axle.many_axles import FilmScales, solve_axles
from ehlectric.axle.solution import solve_elements
from ehlectric.axle.uncertainty import (
    AxleDesign,
    _chances,
    _deciding,
    has_chance,
    uncertainty_of,
)
from ehlectric.drive.network import firsts
from tests.axle.axles import ALONE, two_stages
from tests.helpers.each import each

INF = np.inf


@pytest.fixture(scope="module")
def solution():
    return solve_elements(two_stages(remedies=[]))


@pytest.fixture(scope="module")
def uncertainty(solution):
    return uncertainty_of(solution, stages=(128,))


def test_the_first_element_by_hand():
    """Summits that touch under the largest voltage, else the largest U/V_b; never what conducts."""
    voltages = np.array([[2.0, 3.0, 0.0], [2.0, 3.0, 9.0], [2.0, 3.0, 1.0], [0.0, 0.0, 0.0]])
    limits = np.array([[1.0, 3.0, 1.0], [0.0, 0.0, 1.0], [INF, 6.0, 0.0], [1.0, 0.0, 1.0]])
    numbers = firsts(voltages, limits)
    assert numbers.tolist() == [0, 1, 2, -1]
    first, second, third = _chances(
        ("a", "b", "c"), voltages, limits, (np.isinf(limits), limits == 0.0), numbers
    )
    assert (first.first, second.first, third.first) == (0.25, 0.25, 0.25)
    assert (first.breakdown, second.breakdown, third.breakdown) == (0.5, 0.5, 0.5)
    assert (first.conduction, first.touching, third.touching) == (0.25, 0.25, 0.25)


def test_what_decides_is_what_only_one_of_two_elements_has(solution):
    """U_A/V_A = exp(x) and U_B/V_B = 1: D = tanh(x/2), whose variance belongs to x only."""
    design = AxleDesign.of(solution)
    at = np.random.default_rng(1).random((512, design.width))
    ratio = np.exp(2.0 * at[:, 1] - 1.0)
    voltages, limits = np.stack([ratio, np.ones(512)], axis=1), np.ones((512, 2))
    elements = tuple(
        _chances(("a", "b"), voltages, limits, (np.isinf(limits), limits == 0.0), firsts(voltages, limits))
    )
    deciding = _deciding(design, at, voltages, limits, elements)
    assert deciding is not None
    assert set(deciding.elements) == {"a", "b"}
    ((key, _, share),) = deciding.shares
    assert key == "drive.torque"
    assert share == pytest.approx(1.0, abs=0.01)


@pytest.mark.slow
@pytest.mark.gate
def test_points_are_solutions_of_changed_axles(solution):
    """At the middle of all ranges, voltages and breakdown voltages are the values of the axle. Films that are
    0.8 times as thick are films on surfaces that are 1.25 times as rough, with 0.8 times the voltage.
    """
    design, factor = AxleDesign.of(solution), 0.8
    case, scales = design.changed(np.full(design.width, 0.5))
    rough = {"bearing.rotor.composite_rq": 3e-8 / factor}
    (middle,), (thin,) = (
        solve_axles([case], scales=[scales]),
        solve_axles([case], scales=[FilmScales(factor)]),
    )
    for element, known in zip(middle.elements, solution.elements, strict=True):
        if element.breakdown_voltage is not None:
            assert element.breakdown_voltage == pytest.approx(known.breakdown_voltage, rel=2e-3)
        assert element.capacitance == pytest.approx(known.capacitance, rel=5e-3)
        assert (element.state, element.touching) == (known.state, known.touching)
    on_rough = solve_elements(solution.case.replace(rough)).elements[:2]
    for element, known in zip(thin.elements, on_rough, strict=False):
        assert element.breakdown_voltage == pytest.approx(factor * known.breakdown_voltage, rel=2e-3)


@pytest.mark.slow
@pytest.mark.gate
def test_probabilities_of_all_elements(uncertainty, solution):
    table = uncertainty.summary()
    assert [row["element"] for row in table["elements"]] == [each.name for each in solution.elements]
    assert sum(row["first_probability"] for row in table["elements"]) == pytest.approx(1.0)
    assert (
        max(table["elements"], key=lambda row: row["first_probability"])["element"]
        == solution.ranking()[0][0]
    )
    conducting = table["elements"][-1]
    assert conducting["conduction_probability"] + conducting["asperity_contact_probability"] == pytest.approx(
        1.0
    )
    assert table["breakdown_probability"] >= max(row["breakdown_probability"] for row in table["elements"])
    assert table["deciding_elements"][0] == solution.ranking()[0][0]
    assert table["deciding"][0]["total"] > table["deciding"][-1]["total"]


@pytest.mark.slow
def test_the_verdict_names_the_first_elements_and_the_input_to_measure(solution):
    result = solve_axle(solution.case, remedies=False)
    codes = [reason.code for reason in result.verdict.reasons]
    # Few points state the margin with its sampling error, and no margin where the error exceeds it.
    assert {"probability", "probability-rough", "probability-only"} & set(codes)
    assert {"axle-first-chances", "axle-deciding"} <= set(codes)
    assert "uncertainty" in result.summary()
    pending = solve_axle(solution.case, remedies=False, probable=False)
    assert "axle-without-probability" in [reason.code for reason in pending.verdict.reasons]
    assert "uncertainty" not in pending.summary()


def test_a_range_of_the_file_replaces_the_usual_one():
    ranges = {
        "bearing.rotor.radial_clearance": ["8 um", "12 um"],
        "drive.torque": ["29 N m", "31 N m"],
        "source.dc_link": ["700 V", "900 V"],
    }
    case = two_stages(remedies=[], ranges=ranges)
    names = {names.key: names for names in AxleDesign.of(solve_elements(case)).names()}
    assert (names["bearing.rotor.radial_clearance"].low, names["drive.torque"].high) == (8e-6, 31.0)
    assert not names["source.dc_link"].assumed
    assert names["bearing.output.radial_clearance"].assumed
    again = AxleCase.from_dict(case.to_dict())
    assert again == case
    assert [span.key for span in case.replace({"drive.torque": 25.0}).ranges] == [
        "bearing.rotor.radial_clearance",
        "source.dc_link",
    ]


def test_an_uncertain_value_is_written_into_the_file():
    table = two_stages(remedies=[]).to_dict()
    table["drive"]["torque"] = "30 N m +- 10 %"
    (span,) = AxleCase.from_dict(table).ranges
    assert (span.key, span.low, span.high) == ("drive.torque", pytest.approx(27.0), pytest.approx(33.0))


@each(
    ("ranges", "text"),
    [
        ({"bearing.rotor.radial_clearance": ["15 um", "25 um"]}, "contains the value"),
        ({"bearing.axle.radial_clearance": ["5 um", "15 um"]}, "SHAFT"),
        ({"drive.sped": ["5 rpm", "6 rpm"]}, "drive.speed"),
        ({"mesh.1.gear.flank_ra": ["0.01 um", "1 um"]}, "number"),
    ],
)
def test_wrong_ranges_are_refused(ranges, text):
    with pytest.raises(InputError, match=text):
        two_stages(remedies=[], ranges=ranges)


def test_without_a_strength_there_is_no_probability():
    table = {key: value for key, value in ALONE.items() if key != "discharge"}
    case = AxleCase.from_dict(table)
    assert not has_chance(case)
    assert solve_axle(case).uncertainty is None


def test_films_within_their_error_change_capacitances_and_voltages():
    """Thinner films have a larger capacitance, at most in proportion to 1/h, and the divider less voltage."""
    case = AxleCase.from_dict(ALONE)
    design = AxleDesign.of(solve_elements(case))
    column = [name.key for name in design.names()].index("films.bearings")
    at = np.full((3, design.width), 0.5)
    at[:, column] = 0.0, 0.5, 1.0
    thin, middle, thick = design.solutions(at)
    error = design.films[0]
    for first, second, third in zip(thin.elements, middle.elements, thick.elements, strict=True):
        assert 1.0 < first.capacitance / second.capacitance < 1.0 / (1.0 - error)
        assert 1.0 / (1.0 + error) < third.capacitance / second.capacitance < 1.0
    for solution in (thin, middle, thick):
        capacitance = sum(element.capacitance for element in solution.elements)
        expected = case.edge * 100e-12 / (1.1e-9 + capacitance)
        assert solution.potentials()["rotor"] == pytest.approx(expected, rel=1e-12)
