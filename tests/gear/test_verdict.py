"""Verdicts on gear meshes: level, code, state and text."""

import pytest

import ehlectric
from tests.helpers.places import EXAMPLES

EXAMPLE = ehlectric.GearCase.from_toml(EXAMPLES / "gear_pair.toml")
GROUND = {"gear.flank_ra": "0.3 um"}
LOADED = {**GROUND, "gear.operation.pinion_torque": "150 N m"}
VOLTAGE, CONDUCTION = "gear.contact.voltage", "gear.contact.conduction"


def verdict_of(changes):
    result = ehlectric.solve_gear(EXAMPLE.replace(changes), probable=False)
    return result, result.verdict


@pytest.mark.parametrize(
    ("margin", "level", "code"),
    [
        (1.5, "green", "breakdown-excluded"),
        (1.1, "yellow", "breakdown-possible"),
        (0.9, "yellow", "breakdown-likely"),
        (0.5, "red", "breakdown-expected"),
    ],
)
def test_the_level_follows_the_margin(margin, level, code):
    """A strength that is 20 % off either way takes margins from 0.83 to 1.25 across 1."""
    breakdown = ehlectric.solve_gear(EXAMPLE, probable=False).summary()["mesh"]["breakdown_voltage"]
    result, verdict = verdict_of({VOLTAGE: breakdown / margin})
    assert result.margin == pytest.approx(margin)
    assert (verdict.level, verdict.code) == (level, code)


@pytest.mark.parametrize(
    ("changes", "level", "code", "state"),
    [
        (LOADED, "grey", "mesh-conducts", "conducts"),
        (GROUND, "red", "discharges-likely", "conducts at times"),
        ({CONDUCTION: "always"}, "grey", "mesh-conducts", "conducts"),
        ({**GROUND, CONDUCTION: "never"}, "red", "discharges-likely", "insulates"),
        ({VOLTAGE: None}, "grey", "none", "insulates"),
        ({"discharge.dielectric_strength": None}, "grey", "none", "insulates"),
        # Small patches conduct so often that the mesh does not insulate all the time.
        (
            {"gear.contact.reference_area": "0.001 mm^2", VOLTAGE: "0.1 V"},
            "yellow",
            "discharges-possible",
            "conducts at times",
        ),
    ],
)
def test_states_of_the_mesh(changes, level, code, state):
    result, verdict = verdict_of(changes)
    assert (verdict.level, verdict.code) == (level, code)
    assert result.summary()["mesh"]["state"] == state


def test_a_mesh_that_is_set_to_conduct_does_not_state_a_share_of_time():
    text = verdict_of({CONDUCTION: "always"})[1].text
    assert 'gear.contact.conduction is "always"' in text
    assert "%" not in text.partition("the mesh connects both shafts")[0]
    _, verdict = verdict_of({CONDUCTION: "never"})
    assert "mesh-state-given" in {reason.code for reason in verdict.reasons}


def test_ground_flanks_touch_and_the_warning_says_so():
    result, _ = verdict_of(LOADED)
    mesh = result.summary()["mesh"]
    assert "flanks-touch" in [warning.code for warning in result.warnings]
    assert mesh["breakdown_voltage"] is None
    assert mesh["margin"] is None
    assert mesh["smooth_breakdown_voltage"] == pytest.approx(15e6 * mesh["minimum_thickness"])
    low, share, high = (mesh[f"contact_time_share{end}"] for end in ("_low", "", "_high"))
    assert low <= share <= high
    assert share > 0.99


def test_warnings_state_what_is_assumed():
    changes = {
        "gear.operation.bulk_temperature": "iso",
        "gear.operation.application_factor": 1.0,
        "gear.tip_relief": None,
        "gear.tip_relief_length": None,
        "gear.normal_backlash": None,
    }
    codes = {warning.code for warning in verdict_of(changes)[0].warnings}
    assert codes == {
        "flank-temperature-estimated",
        "load-factors-1",
        "relief-unknown",
        "backlash-unknown",
        "estimated-alpha",
    }


@pytest.mark.parametrize("strength", [None, "15 V/um"])
def test_touching_summits_come_before_a_missing_strength(strength):
    """No strength gives a voltage to summits that touch."""
    changes = {**GROUND, "discharge.dielectric_strength": strength}
    result, verdict = verdict_of(changes)
    assert result.summary()["mesh"]["lambda_ratio"] < EXAMPLE.gear.summit_height
    assert (verdict.level, verdict.code, verdict.answer.code) == ("red", "discharges-likely", "mesh-touching")
    assumed = {statement.code for statement in verdict.assumptions}
    assert ("strength" in assumed, "exact-roughness" in assumed) == (False, True)


def test_conduction_comes_before_a_missing_strength():
    _, verdict = verdict_of({**LOADED, "discharge.dielectric_strength": None})
    assert verdict.code == "mesh-conducts"


def test_touching_flanks_state_the_voltage_that_smooth_flanks_would_hold():
    """The strength times the minimum film, and the voltage between both gears, stand next to each other."""
    result, verdict = verdict_of(GROUND)
    mesh = result.summary()["mesh"]
    smooth = EXAMPLE.discharge.dielectric_strength * mesh["minimum_thickness"]
    assert verdict.answer.values["smooth"].values["breakdown"] == pytest.approx(smooth, rel=1e-12)
    assert verdict.answer.values["driven"].values["voltage"] == mesh["voltage"] == 5.0
