"""Bearings at many points of operation, against each point alone."""

import numpy as np
import pytest

import ehlectric
from ehlectric import BearingCase, DriveCase, InputError, evaluate, solve_bearing
from tests.helpers.bearings import OIL as SHEET_OIL
from tests.helpers.bearings import OTHERS
from tests.helpers.each import each
from tests.helpers.kinds_of_bearings import differences
from tests.helpers.places import EXAMPLES

MOTOR = OTHERS["motor"]
OIL = {**SHEET_OIL, "temperature": {**SHEET_OIL["temperature"], "thermal_conductivity": "0.14 W/m/K"}}
KINDS = {
    "6208": {"radial_clearance": "10 um", "film_factor": "none"},
    "7208-c": {"axial_load": "1 kN", "film_factor": "inlet-shear"},
    "nu-208": {"profile": "logarithmic", "radial_clearance": "20 um", "coating": {"base": "alumina"}},
}
POINTS = 60


def bearing(base="6208", **further):
    table = {
        "base": base,
        "radial_load": "2 kN",
        "inner_speed": "3000 rpm",
        "temperature": "70 degC",
        "composite_rq": "0.05 um",
    }
    return BearingCase.from_dict(
        {
            "contacts": "atlas",
            "bearing": table | KINDS[base] | further,
            "lubricant": OIL,
            "discharge": {"dielectric_strength": "15 V/um"},
            "motor": MOTOR,
        }
    )


def inputs(number, seed):
    rng = np.random.default_rng(seed)
    return {
        "bearing.inner_speed": 10.0 ** rng.uniform(1.2, 3.0, number),
        "bearing.radial_load": 10.0 ** rng.uniform(2.8, 3.7, number),
        "bearing.temperature": rng.uniform(300.0, 380.0, number),
        "motor.rotor_frame_capacitance": rng.uniform(5e-10, 2e-9, number),
    }


@pytest.mark.slow
@pytest.mark.parametrize("base", list(KINDS))
def test_points_are_those_of_each_bearing_alone(base):
    case, given = bearing(base), inputs(POINTS, 1)
    found = evaluate(case, given)
    solved = np.flatnonzero(found["converged"].values)
    assert solved.size > 0.8 * POINTS
    assert differences(case, given, points=solved[:: max(1, solved.size // 5)].tolist()) == []


def test_points_beyond_the_model_have_the_reason_of_the_bearing_alone():
    case = bearing("7208-c")
    given = {"bearing.inner_speed": [100.0] * 4, "bearing.axial_load": ["1 kN", "0 N", "90 kN", "2 kN"]}
    found = evaluate(case, given)
    assert found["converged"].values.tolist() == [True, False, False, True]
    assert np.isnan(found["bearing.capacitance"].values).tolist() == [False, True, True, False]
    for k in (1, 2):
        changes = {key: values[k] for key, values in given.items()}
        with pytest.raises(InputError) as caught:
            solve_bearing(case.replace(changes), workers=1)
        assert found["reason"].values[k] == str(caught.value)


def test_names_are_computed_in_groups():
    given = {"bearing.base": ["6208", "6205", "6208"], "bearing.inner_speed": ["1000 rpm"] * 3}
    given["bearing.fill"] = ["oil", "oil", "air"]
    found = evaluate(bearing(), given)
    alone = [
        solve_bearing(bearing().replace({key: values[k] for key, values in given.items()}), workers=1)
        for k in range(3)
    ]
    expected = [one.capacitance() for one in alone]
    np.testing.assert_allclose(found["bearing.capacitance"], expected, rtol=1e-9)
    assert found["bearing.base"].values.tolist() == given["bearing.base"]
    assert found["bearing.inner_speed"].attrs["units"] == "rad/s"


def test_ceramic_elements_have_no_breakdown():
    found = evaluate(bearing(element_material="silicon-nitride"), {"bearing.radial_load": [1e3, 2e3]})
    assert np.all(np.isnan(found["bearing.margin"]))
    assert np.all(found["bearing.capacitance"] > 0.0)


@each(
    ("given", "text"),
    [
        ({}, "at least one key"),
        ({"bearing.radial_load": [1e3], "bearing.inner_speed": [1.0, 2.0]}, "as many as bearing.radial_load"),
        ({"bearing.radial_load": 1e3}, "a value for each point"),
        ({"bearing.radial_lod": [1e3]}, "unknown"),
        ({"bearing.radial_load": ["1 kN", "-3 N"]}, "at index 1"),
    ],
)
def test_wrong_arrays_are_refused(given, text):
    with pytest.raises(InputError, match=text):
        evaluate(bearing(), given)


def test_both_bearings_of_a_drive_are_evaluated():
    """Each is the bearing of the drive alone, at the speed and the temperature of the drive."""
    drive = DriveCase.from_toml(ehlectric.example("drive"))
    given = {
        "drive.speed": ["1000 rpm", "2000 rpm"],
        "non_drive_end.bearing.radial_load": ["300 N", "600 N"],
        "bearings.bearing.composite_rq": ["0.05 um", "0.04 um"],
    }
    found = evaluate(drive, given)
    for k in range(2):
        own = drive.replace({key: values[k] for key, values in given.items()})
        for end, case in zip(("drive_end", "non_drive_end"), own.bearings, strict=True):
            alone = solve_bearing(case.replace({"contacts": "atlas"}), workers=1).capacitance()
            assert found[f"{end}.bearing.capacitance"].values[k] == pytest.approx(alone, rel=1e-8)
            assert found[f"{end}.converged"].values[k]
    for key in ("source.dc_link_voltage", "drive.contacts"):
        with pytest.raises(InputError, match=f"{key}: got a key of the drive itself"):
            evaluate(drive, {key: ["500 V"]})


@pytest.mark.slow
@pytest.mark.parametrize(
    "inputs",
    [
        {"bearing.temperature": [300.0, 330.0]},
        {"motor.common_mode_voltage": [100.0, 300.0]},
        {"discharge.dielectric_strength": [1e7, 2e7]},
    ],
)
def test_inputs_that_change_no_load_are_evaluated_alone(inputs):
    """Elements without load lie outside the load zone of this bearing, with loads of their own."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "atlas"})
    found = evaluate(case, inputs)
    for place, margin in enumerate(found["bearing.margin"].values):
        single = case.replace({key: values[place] for key, values in inputs.items()})
        assert margin == pytest.approx(solve_bearing(single).margin, rel=1e-8)
