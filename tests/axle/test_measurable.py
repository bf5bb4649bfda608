"""Calibration of an axle: numbers of the model, ranges by hand, and refused measurements."""

import numpy as np
import pandas as pd
import pytest

import ehlectric
from ehlectric import AxleCase, InputError
from ehlectric.axle.measurable import AxleModel
from ehlectric.axle.solution import solve_elements
from ehlectric.bearing import SEED
from ehlectric.calibration.models import points_of
from ehlectric.cases.measured_inputs import measured_points
from ehlectric.formulas.sobol import sobol_points
from tests.axle.axles import ALONE, two_stages
from tests.helpers.each import each

VOLTAGE = "shafts.rotor.voltage"
WINDING = "circuit.winding_rotor_capacitance"


@pytest.fixture(scope="module")
def case():
    return AxleCase.from_dict(ALONE)


@pytest.fixture(scope="module")
def model(case):
    return AxleModel.of(case)


def test_the_voltage_of_a_shaft_is_the_divider_of_its_capacitances(case, model):
    """U = E C_wr/(C_wr + C_rf + C_1 + C_2) with the capacitances of the solved bearings, in the middle."""
    elements = [each.capacitance for each in solve_elements(case).elements]
    expected = case.edge * 100e-12 / (100e-12 + 1e-9 + sum(elements))
    names = (VOLTAGE, *(f"elements.rotor_{number}.capacitance" for number in (1, 2)))
    numbers = model.numbers(np.full((1, model.design.width), 0.5), [{}], names)
    assert numbers[VOLTAGE][0, 0] == pytest.approx(expected, rel=2e-3)
    assert [numbers[name][0, 0] for name in names[1:]] == pytest.approx(elements, rel=5e-3)


def test_capacitances_follow_the_error_of_the_films(model):
    """Thinner films have a larger capacitance, at most in proportion to 1/h."""
    column = [name.key for name in model.names()].index("films.bearings")
    at = np.full((3, model.design.width), 0.5)
    at[:, column] = 0.0, 0.5, 1.0
    (low, middle, high) = model.numbers(at, [{}], ("elements.rotor_1.capacitance",)).popitem()[1][:, 0]
    thin, thick = model.names()[column].low, model.names()[column].high
    assert 1.0 < low / middle < 1.0 / thin
    assert 1.0 / thick < high / middle < 1.0


def test_a_point_of_operation_scales_the_torque_and_shifts_the_temperature():
    model = AxleModel.of(two_stages(remedies=[]))
    row = np.ones(model.design.width)
    changed, _ = model.design.changed(row, {"drive.torque": 60.0, "drive.temperature": 350.0})
    assert (changed.drive.torque, changed.drive.temperature) == (pytest.approx(72.0), pytest.approx(360.0))


@pytest.mark.slow
@pytest.mark.gate
def test_ranges_are_those_of_points_that_are_weighted_by_hand(case, model):
    """Bayes' rule at the points of the Sobol design: weights exp(-(U - y)^2/(2 s^2)) and their quantiles."""
    samples, value, error = 128, 18.0, 5.0
    at = sobol_points(model.design.width, samples, SEED)
    voltages = model.numbers(at, [{}], (VOLTAGE,))[VOLTAGE][:, 0]
    weights = np.exp(-0.5 * np.square((voltages - value) / error))
    column = [name.key for name in model.names()].index(WINDING)
    values = 50e-12 + 100e-12 * at[:, column]
    order = np.argsort(values)
    parts = np.cumsum(weights[order]) / np.sum(weights)
    median = values[order][np.searchsorted(parts, 0.5)]
    measured = case.replace({f"measured.{VOLTAGE}": f"{value} V +- {error} V"})
    calibration = ehlectric.calibrate(measured, samples=samples)
    (entry,) = (each for each in calibration.inputs if each.key == WINDING)
    assert not calibration.chain
    assert entry.posterior[1] == pytest.approx(median, rel=0.02)
    assert calibration.effective == pytest.approx(np.sum(weights) ** 2 / np.sum(weights**2))
    assert calibration.rows[0].decided == WINDING


@pytest.mark.slow
def test_values_that_contradict_each_other_are_reported(case):
    """One shaft has one capacitance to the housing: equal bearings cannot differ by a factor of 2."""
    changes = {f"measured.elements.rotor_{number}.capacitance": text for number, text in CONTRARY.items()}
    calibration = ehlectric.calibrate(case.replace(changes), samples=64)
    assert not calibration.explained
    assert calibration.case is None
    assert calibration.verdict.code == "measurement-unexplained"


CONTRARY = {1: "400 pF +- 2 %", 2: "200 pF +- 2 %"}


def test_updated_inputs_are_those_of_a_file_that_can_be_read_again():
    model = AxleModel.of(two_stages(remedies=[]))
    values = {
        "drive.torque": 28.0,
        "bearing.rotor.radial_clearance": 12e-6,
        "bearings.summit_height": 1.8,
        "mesh.gear.summit_height": 2.2,
        "films.bearings": 0.9,
    }
    ranges = {key: (0.9 * value, 1.1 * value) for key, value in values.items()}
    case = model.updated(values, ranges)
    assert [span.key for span in case.ranges] == [key for key in values if key != "films.bearings"]
    assert [table.summit_height for table in case.tables_of_bearings] == [1.8] * 6
    assert [table.radial_clearance for table in case.tables_of_bearings[:2]] == [12e-6, 12e-6]
    assert [mesh.pair.gear.summit_height for mesh in case.mesh] == [2.2, 2.2]
    assert AxleCase.from_dict(case.to_dict()) == case


def test_a_file_of_operating_points_has_columns_of_elements_and_shafts():
    """Torque and voltage at two points: an empty cell was not measured."""
    table = pd.DataFrame(
        {
            "torque [N m]": [20, 40],
            "voltage of rotor [V]": [5.0, 6.0],
            "uncertainty of voltage of rotor [%]": [10, 10],
            "capacitance of output_1 [pF]": ["", 300],
            "uncertainty of capacitance of output_1 [pF]": ["", 15],
        }
    )
    given = measured_points(None, points_of(two_stages(remedies=[])), table)
    assert [(value.quantity, value.point) for value in given.values] == [
        ("shafts.rotor.voltage", 0),
        ("elements.output_1.capacitance", 1),
        ("shafts.rotor.voltage", 1),
    ]
    assert [point["drive.torque"] for point in given.points] == [20.0, 40.0]
    assert given.values[1].uncertainty == pytest.approx(15e-12)


@each(
    ("measured", "text"),
    [
        ({"elements": {"rotor_3": {"capacitance": "1 pF +- 5 %"}}}, "rotor_1, rotor_2"),
        ({"shafts": {"wheel": {"voltage": "1 V +- 5 %"}}}, "measured.shafts.wheel.*rotor"),
        ({"elements": {"rotor_1": {"voltage": "1 V +- 5 %"}}}, "measured.elements.rotor_1.voltage"),
        ({"shafts": {"rotor": {"voltage": "1 V"}}}, "measured.shafts.rotor.voltage.*[+]-"),
        ({}, "measured.file"),
    ],
)
def test_wrong_measurements_are_refused(measured, text):
    with pytest.raises(InputError, match=text):
        AxleCase.from_dict({**ALONE, "measured": measured})
