"""Calibration of bearings, gear pairs and drives: simulated measurements with known inputs."""

from __future__ import annotations

import sys
from functools import partial
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from tests.helpers.places import EXAMPLES
from tests.helpers.share import share_of

import ehlectric
from ehlectric import BearingCase, DriveCase, GearCase, InputError
from ehlectric.calibration import given_points
from ehlectric.calibration.causes import CauseSearch
from ehlectric.calibration.models import model_of
from ehlectric.calibration.range_update import _Compared, _quantiles, given_values
from ehlectric.cases.measured_inputs import Measured, measured_points
from ehlectric.cases.measurements import BEARING_POINTS, CALIBRATED
from ehlectric.runs.preview import preview_of

POINTS = pd.DataFrame(
    {
        "speed [rpm]": [1500, 3000],
        "capacitance [pF]": [351.0, 258.5],
        "uncertainty of capacitance [%]": [3, 3],
        "shaft voltage [V]": [4.04, ""],
        "uncertainty of shaft voltage [V]": [0.2, ""],
        "remark": ["a", "b"],
    }
)


@pytest.fixture(scope="module")
def bearing():
    return BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "atlas"})


def test_empty_cells_are_not_measured():
    given = measured_points(None, BEARING_POINTS, POINTS)
    assert [(value.quantity, value.point) for value in given.values] == [
        ("capacitance", 0),
        ("shaft_voltage", 0),
        ("capacitance", 1),
    ]
    assert given_values(given) == pytest.approx([351e-12, 4.04, 258.5e-12])
    assert [value.uncertainty for value in given.values] == pytest.approx([10.53e-12, 0.2, 7.755e-12])
    assert given.points[0]["bearing.inner_speed"] == pytest.approx(50.0 * np.pi)


def test_values_of_a_table_and_of_its_file_belong_to_their_points(tmp_path):
    POINTS.to_csv(tmp_path / "points.csv", index=False)
    table = Measured.from_dict({"file": str(tmp_path / "points.csv"), "film": "200 nm +- 10 %"})
    given = measured_points(table, BEARING_POINTS)
    assert given.points[0] == {}
    assert [value.point for value in given.values] == [0, 1, 1, 2]
    assert given.values[0].uncertainty == pytest.approx(20e-9)


def test_a_given_file_replaces_the_file_of_the_table_and_keeps_its_values(bearing):
    case = bearing.replace({"measured.film": "200 nm +- 10 %", "measured.file": "missing.csv"})
    given = given_points(case, POINTS)
    assert [(value.quantity, value.point) for value in given.values] == [
        ("film", 0),
        ("capacitance", 1),
        ("shaft_voltage", 1),
        ("capacitance", 2),
    ]


def test_a_value_without_an_uncertainty_in_its_row_is_refused():
    table = POINTS.assign(**{"uncertainty of shaft voltage [V]": ["", ""]})
    with pytest.raises(InputError, match="uncertainty of shaft voltage"):
        measured_points(None, BEARING_POINTS, table)


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("capacitance", "meter_capacitance"),
        ("first_breakdown_voltage", "shaft_first_break"),
        ("breakdown_voltage", "shaft_ring_to_ring_breakdown"),
        ("shaft_voltage", "shaft_voltage"),
        ("bearing_voltage_ratio", "bearing_voltage_ratio"),
        ("margin", "margin"),
    ],
)
def test_numbers_of_the_model_are_numbers_of_the_bearing(bearing, name, key):
    """In the middle of all ranges, and at an operating point, numbers equal the numbers of the solved bearing
    within 1e-3, the stated error of bearings with few loads.
    """
    model = model_of(bearing)
    middle = np.full((1, len(model.names())), 0.5)
    point = {"bearing.inner_speed": 200.0, "bearing.radial_load": 1500.0}
    numbers = model.numbers(middle, [{}, point], (name,))[name][0]
    for value, case in zip(numbers, (bearing, bearing.replace(point)), strict=True):
        expected = ehlectric.solve_bearing(case).summary(probable=False)["bearing"][key]
        assert value == pytest.approx(expected, rel=1e-3)


def test_uncertain_inputs_of_a_point_deviate_from_its_values(bearing):
    """At the ends of their ranges, a temperature deviates by 10 K, and a load by 20 %, as in the file."""
    model = model_of(bearing)
    names = [name.key for name in model.names()]
    at = np.full((1, len(names)), 0.5)
    at[0, names.index("bearing.temperature")] = at[0, names.index("bearing.radial_load")] = 1.0
    point = {"bearing.temperature": 330.0, "bearing.radial_load": 1000.0, "bearing.axial_load": 200.0}
    numbers = model.numbers(at, [point], ("capacitance",))["capacitance"]
    changes = {"bearing.temperature": 340.0, "bearing.radial_load": 1200.0, "bearing.axial_load": 240.0}
    expected = ehlectric.solve_bearing(bearing.replace(changes)).summary(probable=False)["bearing"]
    assert numbers[0, 0] == pytest.approx(expected["meter_capacitance"], rel=1e-3)


@pytest.mark.slow
@pytest.mark.gate
def test_a_calibrated_case_is_nearer_to_the_true_bearing(bearing):
    """The temperature that a ring thermometer measures is the updated one, and the file has its range."""
    case = bearing.replace({"measured.outer_ring_temperature": "76 degC +- 1 K"})
    calibration = ehlectric.calibrate(case)
    (temperature,) = (entry for entry in calibration.inputs if entry.key == "bearing.temperature")
    low, median, high = temperature.posterior
    assert median == pytest.approx(349.15, abs=0.2)
    assert high - low == pytest.approx(2.0 * 1.645, rel=0.15)
    assert calibration.case.bearing.temperature == pytest.approx(median)
    assert calibration.case.measured is None
    ranges = {entry.key: (entry.low, entry.high) for entry in calibration.case.ranges}
    assert ranges["bearing.temperature"] == pytest.approx((low, high))
    assert BearingCase.from_dict(calibration.case.to_dict()) == calibration.case
    assert calibration.rows[0].decided == "bearing.temperature"
    # Films are thinner at a higher temperature.
    assert calibration.after.probability > calibration.before.probability


@pytest.mark.slow
@pytest.mark.parametrize(
    ("measured", "key", "contradicting"),
    [
        ({"outer_ring_temperature": "110 degC +- 1 K"}, "bearing.temperature", []),
        ({"shaft_voltage": "4 V +- 2 %", "bearing_voltage_ratio": "0.02 +- 0.0002"}, "", [0, 1]),
    ],
)
def test_what_nothing_explains_is_reported(bearing, measured, key, contradicting):
    """A temperature of 110 °C is beyond 80 °C, and 4 V of 300 V are no ratio of 0.02."""
    case = bearing.replace({f"measured.{name}": value for name, value in measured.items()})
    calibration = ehlectric.calibrate(case)
    assert not calibration.explained
    assert calibration.case is None
    assert calibration.verdict.level == "grey"
    causes = {cause.key: cause for cause in calibration.unexplained.causes}
    assert (key in causes) == bool(key)
    assert list(calibration.unexplained.contradicting) == contradicting
    if key:
        # The ring has the temperature of the oil.
        assert causes[key].needed == pytest.approx(383.15, abs=0.5)
        assert causes[key].residual < 0.1
        assert calibration.rows[0].nearest == pytest.approx(353.15, abs=0.5)


def _log(case, speeds, factor=1.0, parallel=0.0):
    """Simulated log of an LCR meter: computed capacitances times a factor, in addition to others [F]."""
    model = model_of(case)
    middle = np.full((1, len(model.names())), 0.5)
    points = [{"bearing.inner_speed": speed} for speed in speeds]
    computed = model.numbers(middle, points, ("capacitance",))["capacitance"][0]
    return pd.DataFrame(
        {
            "speed [rad/s]": speeds,
            "capacitance [pF]": [f"{1e12 * (factor * c + parallel):.2f}" for c in computed],
            "uncertainty of capacitance [%]": [2.0] * len(speeds),
        }
    )


SPEEDS = [100.0, 200.0, 300.0, 400.0, 600.0]


@pytest.mark.slow
def test_several_values_at_one_operating_point_are_named(bearing):
    """The capacitance in the case, and two rows of the table at its speed of 3000 rpm."""
    table = pd.DataFrame(
        {
            "speed [rpm]": [3000, 1500, 3000],
            "capacitance [pF]": [258.0, 351.0, 259.0],
            "uncertainty of capacitance [%]": [3, 3, 3],
        }
    )
    calibration = ehlectric.calibrate(bearing.replace({"measured.capacitance": "258 pF +- 3 %"}), table)
    (note,) = (each for each in calibration.warnings if each.code == "measured-twice")
    assert "capacitance and capacitance in line 1 and capacitance in line 3" in note.text


@pytest.mark.parametrize(
    ("written", "named"),
    [
        ("8 +- 0.3", "8 has no unit.*8 V"),
        (8, "got 8;.*8 V"),
        ("8 +- 4 % V", "8 has no unit"),
        ("8 V +- 4 % V", "in %"),
        ("8 V", "8 V \\+- "),
    ],
)
def test_a_message_about_a_measured_value_contains_its_correct_spelling(bearing, written, named):
    with pytest.raises(InputError, match=f"measured.shaft_voltage: .*{named}"):
        BearingCase.from_dict(bearing.to_dict() | {"measured": {"shaft_voltage": written}})


@pytest.mark.slow
def test_a_measurement_that_decides_nothing_changes_no_range(bearing):
    """A temperature that is known to 60 K. For n even points, the reduction of a variance v = 1/12 has the
    standard deviation 12 sqrt((1/80 - v^2)/n).
    """
    case = bearing.replace({"measured.outer_ring_temperature": "70 degC +- 60 K"})
    calibration = ehlectric.calibrate(case)
    assert not any(entry.updated for entry in calibration.inputs)
    expected = 12.0 * np.sqrt((1.0 / 80.0 - 1.0 / 144.0) / calibration.samples)
    for entry in calibration.inputs:
        assert entry.reduction_error == pytest.approx(expected, rel=0.05)
    assert calibration.case.ranges == bearing.ranges
    assert calibration.of_file.probability == pytest.approx(calibration.before.probability)


@pytest.mark.slow
def test_the_probability_of_the_file_is_the_probability_of_its_bearing(bearing):
    """A ratio of two capacitances is decided, which a file with independent ranges does not contain."""
    case = bearing.replace({"measured.shaft_voltage": "4.4 V +- 3 %"})
    calibration = ehlectric.calibrate(case)
    solved = ehlectric.solve_bearing(calibration.case).summary()["uncertainty"]
    expected, error = (solved[f"breakdown_probability{end}"] for end in ("", "_error"))
    assert calibration.of_file.probability == pytest.approx(expected, abs=2.0 * error)
    assert 0.05 < expected < 0.95
    codes = [reason.code for reason in calibration.verdict.reasons]
    differ = calibration.after.probability - calibration.of_file.probability
    both = calibration.after.error + calibration.of_file.error
    assert ("without-correlation" in codes) == (abs(differ) > both)


@pytest.mark.slow
@pytest.mark.gate
def test_a_capacitance_in_parallel_is_the_cause_of_too_large_capacitances(bearing):
    """Simulated capacitances with 150 pF in parallel, which no input and no factor explains at all speeds;
    without these 150 pF, and with them as an input, the measurement is explained.
    """
    log = _log(bearing, SPEEDS, parallel=150e-12)
    calibration = ehlectric.calibrate(bearing, log)
    (cause,) = calibration.unexplained.causes
    assert (cause.kind, cause.key) == ("parallel", "capacitance")
    low, high = cause.range
    assert low < 150e-12 < high
    assert cause.needed == pytest.approx(150e-12, rel=0.1)
    assert cause.residual < 1.0
    assert ehlectric.calibrate(bearing, log, background="150 pF").explained
    stated = bearing.to_dict() | {"ranges": {"bearing.parallel_capacitance": ["100 pF", "200 pF"]}}
    stated["bearing"]["parallel_capacitance"] = "150 pF"
    updated = ehlectric.calibrate(BearingCase.from_dict(stated), log)
    (entry,) = (each for each in updated.inputs if each.key.endswith("parallel_capacitance"))
    assert entry.posterior[0] < 150e-12 < entry.posterior[2]
    assert entry.reduction > 0.3


@pytest.mark.slow
@pytest.mark.parametrize(
    ("factor", "meaning"),
    [(2.0, "factor-two-bearings"), (10.0, "factor-decimal-point"), (1e-3, "factor-wrong-prefix")],
)
def test_a_factor_on_all_capacitances_is_a_cause(bearing, factor, meaning):
    """Simulated capacitances of two equal bearings in parallel, or in a wrong unit."""
    unexplained = ehlectric.calibrate(bearing, _log(bearing, SPEEDS, factor)).unexplained
    cause = unexplained.causes[0]
    assert (cause.kind, cause.needed, cause.meaning) == ("factor", factor, meaning)
    assert cause.residual < 1.0


@pytest.mark.slow
def test_without_a_cause_the_verdict_reports_that_none_was_found(bearing):
    """Capacitances that grow with the speed, as no film does."""
    log = _log(bearing, SPEEDS)
    log["capacitance [pF]"] = log["capacitance [pF]"].to_numpy()[::-1]
    calibration = ehlectric.calibrate(bearing, log)
    assert calibration.unexplained.causes == ()
    assert [reason.code for reason in calibration.verdict.reasons] == ["cause-unknown"]


def test_every_cause_has_its_text():
    from ehlectric.calibration.causes import FACTORS
    from ehlectric.quantities.statement import Statement
    from ehlectric.quantities.verdict_texts import statement_text

    assert set(FACTORS) >= {name for name, column in CALIBRATED.items() if column.unit != "K"}
    for quantity, factors in FACTORS.items():
        assert len({factor for factor, _ in factors}) == len(factors), quantity
        for _, meaning in factors:
            assert statement_text(Statement.of(meaning))


def test_a_background_is_taken_off_all_capacitances(bearing):
    case = bearing.replace({"measured.capacitance": "300 pF +- 9 pF", "measured.shaft_voltage": "4 V +- 1 V"})
    given = given_points(case, POINTS, background="100 pF")
    assert given_values(given) == pytest.approx([200e-12, 4.0, 251e-12, 4.04, 158.5e-12])
    assert given.values[0].uncertainty == pytest.approx(9e-12)
    with pytest.raises(InputError, match=r"line 2.*above the background"):
        given_points(bearing, POINTS, background="300 pF")
    with pytest.raises(InputError, match="parallel_capacitance"):
        given_points(bearing.replace({"bearing.parallel_capacitance": "9 pF"}), POINTS, background="9 pF")


def test_an_uncertainty_belongs_to_columns_without_a_column_of_it(bearing):
    table = POINTS.drop(columns="uncertainty of capacitance [%]")
    given = given_points(bearing, table, uncertainty="2 %")
    errors = [value.uncertainty for value in given.values]
    assert errors == pytest.approx([0.02 * 351e-12, 0.2, 0.02 * 258.5e-12])


@pytest.mark.slow
def test_a_gear_pair_is_calibrated_by_its_capacitance():
    """The simulated capacitance of flanks that are 8 K colder."""
    case = GearCase.from_toml(EXAMPLES / "gear_pair.toml")
    bulk = case.gear.operation.bulk_temperature
    cold = case.replace({"gear.operation.bulk_temperature": bulk - 8.0})
    capacitance = ehlectric.solve_gear(cold, probable=False).summary()["mesh"]["capacitance"]
    calibration = ehlectric.calibrate(case.replace({"measured.capacitance": f"{capacitance} F +- 3 %"}))
    (temperature,) = (entry for entry in calibration.inputs if entry.key.endswith("bulk_temperature"))
    low, median, high = temperature.posterior
    assert low < bulk - 8.0 < high
    assert median < bulk - 4.0
    assert GearCase.from_dict(calibration.case.to_dict()) == calibration.case


@pytest.mark.slow
def test_a_drive_is_calibrated_by_its_shaft_voltage():
    """The simulated voltage of a rotor with a larger capacitance to the winding."""
    case = DriveCase.from_toml(EXAMPLES / "drive.toml").replace({"remedies": []})
    coupled = case.replace({"circuit.winding_rotor_capacitance": 65e-12})
    voltage = ehlectric.check(coupled).summary["drive_end"]["voltage_at_peak"]
    calibration = ehlectric.calibrate(case.replace({"measured.shaft_voltage": f"{voltage} V +- 3 %"}))
    inputs = {entry.key: entry for entry in calibration.inputs}
    low, median, high = inputs["circuit.winding_rotor_capacitance"].posterior
    assert low < 65e-12 < high
    assert median > 50e-12
    assert calibration.case.circuit.winding_rotor_capacitance == pytest.approx(median)
    assert DriveCase.from_dict(calibration.case.to_dict()) == calibration.case


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"measured.shaft_voltage_rms": "4 V +- 1 V"}, "shaft_voltage_rms"),
        ({"bearing.element_material": "silicon-nitride", "measured.capacitance": "9 pF +- 1 pF"}, "measured"),
    ],
)
def test_a_quantity_that_the_model_lacks_is_refused(bearing, changes, named):
    with pytest.raises(InputError, match=named):
        ehlectric.calibrate(bearing.replace(changes))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "quantities", "keys"),
    [
        (
            lambda: BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "atlas"}),
            ("capacitance", "shaft_voltage", "first_breakdown_voltage"),
            ("bearing.temperature", "motor.winding_rotor_capacitance"),
        ),
    ],
    ids=["bearing"],
)
def test_true_inputs_lie_in_the_interval_of_90_per_cent(case, quantities, keys):
    """Of simulated measurements with known inputs, four fifths or more have a true input in its interval, and
    some do not have both.
    """
    from ehlectric.calibration.posterior import infer

    model, random = model_of(case()), np.random.default_rng(11)
    names = [name.key for name in model.names()]
    columns = [names.index(key) for key in keys]

    def predict(at):
        numbers = model.numbers(at, [{}], quantities)
        return np.concatenate([numbers[name] for name in quantities], axis=-1)

    inside = np.zeros(len(names), dtype=int)
    count = share_of(50, 2)
    for _ in range(count):
        true = random.random(len(names))
        values = predict(true[np.newaxis])[0]
        errors = np.array([0.03, 0.05, 0.1]) * values
        measured = values + errors * random.standard_normal(3)
        posterior = infer(predict, len(names), measured, errors, samples=256)
        low, _, high = posterior.quantiles((0.05, 0.5, 0.95)).T
        inside += (low <= true) & (true <= high)
    assert all(inside[place] >= 0.8 * count for place in columns), inside
    assert sum(inside[place] for place in columns) < len(columns) * count


@pytest.mark.slow
def test_a_drive_is_calibrated_by_its_discharges():
    """The simulated discharges and rms voltage of a drive that is 4 K colder, with 44 pF instead of 50 pF."""
    case = DriveCase.from_toml(EXAMPLES / "drive.toml").replace({"remedies": [], "source.dc_link": 150.0})
    true = {"drive.temperature": 349.15, "circuit.winding_rotor_capacitance": 44e-12, "drive.duration": 0.05}
    summary = ehlectric.solve_drive(case.replace(true)).summary()
    rate, rms = summary["drive"]["events_per_second"], summary["shaft"]["rms_voltage"]
    measured = {"discharge_rate": f"{rate} 1/s +- 5 %", "shaft_voltage_rms": f"{rms} V +- 3 %"}
    calibration = ehlectric.calibrate(
        case.replace({f"measured.{key}": text for key, text in measured.items()})
    )
    inputs = {entry.key: entry for entry in calibration.inputs}
    assert calibration.explained
    for key in ("drive.temperature", "circuit.winding_rotor_capacitance"):
        low, _, high = inputs[key].posterior
        assert low < true[key] < high
    assert inputs["circuit.winding_rotor_capacitance"].reduction > 0.3


@pytest.mark.slow
def test_measured_discharges_that_need_a_larger_strength_are_reported():
    """A shaft voltage of 12 V is several times the breakdown voltage at 15 V/um: each of the 6 edges per
    period of 10 kHz discharges, and 30 discharges per millisecond need a larger strength, above 30 V/um.
    """
    measured = {"shaft_voltage": "12 V +- 5 %", "discharge_rate": "30 1/ms +- 10 %"}
    case = DriveCase.from_toml(EXAMPLES / "drive.toml").replace({"remedies": []})
    calibration = ehlectric.calibrate(
        case.replace({f"measured.{key}": text for key, text in measured.items()})
    )
    assert not calibration.explained
    causes = calibration.unexplained.causes
    (strength,) = (cause for cause in causes if cause.key.endswith("dielectric_strength"))
    assert strength.needed > 30e6


@pytest.mark.slow
def test_a_wide_range_of_the_strength_explains_measured_discharges():
    """In the example, the strength is above 30 V/um, as at smaller strengths each edge discharges."""
    calibration = ehlectric.calibrate(DriveCase.from_toml(EXAMPLES / "drive_measured.toml"))
    (strength,) = (each for each in calibration.inputs if each.key.endswith("dielectric_strength"))
    assert calibration.explained
    assert strength.posterior[0] > 30e6
    assert strength.reduction > 0.3
    assert all(abs(row.residual) < 1.5 for row in calibration.rows)


def test_without_the_library_of_the_chain_its_extra_is_named(bearing, monkeypatch):
    """A capacitance that is known to 0.1 % needs a Markov chain."""
    monkeypatch.setitem(sys.modules, "emcee", None)
    with pytest.raises(InputError, match=r"ehlectric\[calibration\]"):
        ehlectric.calibrate(bearing.replace({"measured.capacitance": "240 pF +- 0.1 %"}))


@pytest.mark.parametrize(("table", "needed"), [("motor", r"\[motor\]"), ("discharge", "dielectric_strength")])
def test_a_case_without_a_measured_quantity_is_refused(bearing, table, needed):
    tables = bearing.to_dict() | {"measured": {"shaft_voltage": "4 V +- 1 V"}}
    if table == "discharge":
        tables["measured"] = {"breakdown_voltage": "4 V +- 1 V"}
    del tables[table]
    with pytest.raises(InputError, match=needed):
        ehlectric.calibrate(BearingCase.from_dict(tables))


@pytest.mark.slow
@pytest.mark.parametrize("text", ["72 degC +- 2 K", "120 degC +- 2 K"], ids=["explained", "unexplained"])
def test_a_calibration_is_shown_as_table_and_figure(bearing, text):
    """In a notebook, with the rows of the command, and as a figure as wide as a column of a journal."""
    case = bearing.replace({"measured.outer_ring_temperature": text})
    calibration = ehlectric.calibrate(case, samples=64)
    assert "measured outer ring temperature" in calibration._repr_html_()
    assert len(calibration.to_dataframe()) == 1
    assert ehlectric.figure_names(calibration) == ["calibration"]
    figure = calibration.plot(style="journal")
    assert 25.4 * figure.get_figwidth() == pytest.approx(84.0)
    assert len(figure.axes) == 2


def test_the_share_that_a_further_value_removes_is_the_part_that_a_line_explains():
    """R^2 of least squares of ln(margin) by values with noise: each value once above and once below by its
    uncertainty, which is normal noise in its variance and its correlation.
    """
    logs, deviation = np.array([0.1, 0.5, 0.2, 0.9]), np.array([0.0, 0.7, 0.3, 0.6])
    columns = {
        "capacitance": 1e-10 * (1.0 + 0.1 * deviation),
        "inner_ring_temperature": 330.0 - 2.0 * deviation,
    }
    errors = {"capacitance": 0.05 * np.mean(columns["capacitance"]), "inner_ring_temperature": 1.0}
    expected = {}
    for name, column in columns.items():
        noisy = np.concatenate([column + errors[name], column - errors[name]])
        line = np.polyval(np.polyfit(noisy - np.mean(noisy), np.tile(logs, 2), 1), noisy - np.mean(noisy))
        expected[name] = np.var(line) / np.var(logs)
    found = dict(_Compared._following(None, {k: v[:, None] for k, v in columns.items()}, np.exp(logs)))
    assert found == pytest.approx(expected, rel=1e-9)


def test_quantiles_of_even_values_are_the_ends_of_nine_tenths():
    """Of 0 to 100, of which each counts alike, and without values that are unknown or have no weight."""
    values = np.concatenate([np.arange(101.0), [np.nan, 1e6]])
    weights = np.concatenate([np.ones(102), [0.0]])
    assert _quantiles(values, weights) == pytest.approx((5.0, 50.0, 95.0), abs=0.6)


CERAMIC = {"bearing.element_material": "silicon-nitride"}
REFUSED = [
    ({"capacitance": "250 pF +- 5 %"}, CERAMIC),
    ({"first_breakdown_voltage": "4 V +- 5 %"}, CERAMIC | {"bearing.element_capacitance": "5 pF"}),
    ({"shaft_voltage": "5 V +- 5 %"}, CERAMIC),
    ({"shaft_voltage_rms": "1 V +- 5 %"}, {}),
]
ACCEPTED = [
    ({"capacitance": "250 pF +- 5 %"}, {}),
    ({"conducting_share": "0.1 +- 0.05"}, CERAMIC),
    ({"shaft_voltage": "5 V +- 5 %"}, CERAMIC | {"bearing.element_capacitance": "5 pF"}),
]


@pytest.mark.parametrize(("measured", "changes"), [*REFUSED, *ACCEPTED])
def test_check_accepts_what_calibrate_accepts(measured, changes):
    """Values for which a bearing has no number are refused before a calibration, in its words."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace(changes, measured=measured)
    refused = (measured, changes) in REFUSED
    texts = []
    for answer in (preview_of, partial(ehlectric.calibrate, samples=64)):
        try:
            answer(case)
        except InputError as error:
            texts.append(str(error))
    assert len({*texts}) == refused
    assert len(texts) == 2 * refused
    assert all(text.startswith(f"measured.{next(iter(measured))}: ") for text in texts)


def test_a_line_that_is_refused_everywhere_has_no_points():
    """Predictions before the first refused point: of all points that are accepted, and none of none."""

    def predict(at):
        if np.max(at) > 0.5:
            raise InputError("bearing.radial_load", got="too much", takes="less")
        return 2.0 * at

    search = SimpleNamespace(predict=predict, values=np.zeros(2))
    at = np.array([[0.1, 0.2], [0.3, 0.4], [0.6, 0.7]])
    assert CauseSearch._before_refusal(search, at).tolist() == [[0.2, 0.4], [0.6, 0.8]]
    assert CauseSearch._before_refusal(search, at[2:]).shape == (0, 2)
