"""Sweeps of gear pairs: the numbers of single pairs, the states of the mesh, maps, and what is refused."""

from concurrent.futures import ThreadPoolExecutor

import matplotlib as mpl
import numpy as np
import pytest
from typer.testing import CliRunner

from ehlectric import InputError, Sweep, read_sweep, run_sweep
from ehlectric.commands.command_line import app
from ehlectric.figures.sweep_maps import value_map
from ehlectric.gear import solve_gear
from ehlectric.sweep import main_value, select_slice
from ehlectric.sweep.engine import solve_point
from ehlectric.sweep.points import Point, SweepPoints
from ehlectric.sweep.sweep_inputs import breakdown_of
from ehlectric.sweep.verdict_rule import sweep_verdict
from tests.gear.pairs import FZG_C_CASE, case_of
from tests.helpers.each import each

mpl.use("Agg")

TORQUE, SPEED = "gear.operation.pinion_torque", "gear.operation.pinion_speed"
RA = "gear.flank_ra"
CASE = case_of(contact__voltage="5 V", flank_ra="0.05 um")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Sweep over torque, speed and roughness, by the command."""
    home = tmp_path_factory.mktemp("gears")
    (home / "gear.toml").write_text(CASE.to_toml(), encoding="utf-8")
    (home / "sweep.toml").write_text(
        f'title = "Rig"\ncase = "gear.toml"\n[vary]\n"{SPEED}" = ["300 rpm", "12000 rpm"]\n'
        f'"{TORQUE}" = ["20 N m", "200 N m"]\n"{RA}" = ["0.03 um", "0.3 um"]\n',
        encoding="utf-8",
    )
    words = ["sweep", str(home / "sweep.toml"), "-o", str(home / "out"), "--workers", "1", "-q"]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    return home / "out"


@pytest.fixture(scope="module")
def results(folder):
    return read_sweep(folder)


@pytest.mark.slow
@pytest.mark.gate
def test_points_are_the_solutions_of_single_pairs(results):
    assert [point.status for point in results.points] == ["solved"] * 8
    for point in results.points[::3]:
        alone = solve_gear(CASE.replace(point.inputs), probable=False).summary()
        assert point.summary["warning_codes"] == alone["warning_codes"]
        assert point.summary["verdict_level"] == alone["verdict_level"]
        for table in ("gear", "mesh"):
            for key, value in alone[table].items():
                found = point.summary[table][key]
                assert found == (pytest.approx(value, rel=1e-8) if isinstance(value, float) else value), key


@pytest.mark.slow
def test_the_verdict_counts_the_states_of_the_mesh(results):
    states = results.columns["mesh.state"]
    verdict = sweep_verdict(results)
    (counted,) = [reason for reason in verdict.reasons if reason.code == "points-mesh-states"]
    assert counted.values["conducts"] == states.count("conducts") > 0
    assert counted.values["insulates"] == states.count("insulates") > 0
    assert counted.values["known"] == 8
    assert verdict.level != "green"


@pytest.mark.slow
def test_maps_name_the_states(results):
    at = {RA: "0.03 um"}
    of_share = value_map(results, SPEED, TORQUE, "mesh.contact_time_share", at=at)
    names = {text.get_text() for text in of_share.get_legend().get_texts()}
    assert {"conducts at times", "conducts: more than 99 %"} <= names
    assert of_share.get_ylabel().endswith("[N m]")
    selection = select_slice(results, SPEED, TORQUE, "mesh.breakdown_voltage", at)
    ratios = np.array([point.summary["mesh"]["lambda_ratio"] for point in selection.points])
    assert np.array_equal(selection.conducting | selection.intermittent, ratios <= 2.0)


@pytest.mark.slow
def test_the_sweep_is_resumed_from_its_folder(folder):
    done = CliRunner().invoke(app, ["sweep", str(folder.parent / "sweep.toml"), "-o", str(folder)])
    assert done.exit_code == 0
    assert "conducts at" in done.output
    listed = ["map", str(folder), "--x", SPEED, "--y", TORQUE, "--at", f"{RA}=0.03 um", "-q"]
    assert CliRunner().invoke(app, listed).exit_code == 0
    assert list(folder.glob("map_mesh.breakdown_voltage*.png"))


def test_a_drawing_that_cannot_run_fails_with_its_reason():
    outcome = solve_point(CASE.replace({"gear.centre_distance": "80 mm"}).to_dict())
    assert outcome.status == "failed"
    assert outcome.reason.startswith("gear.centre_distance")


def test_maps_show_the_breakdown_voltage_or_else_the_lambda_ratio():
    assert main_value(CASE) == "mesh.breakdown_voltage"
    assert breakdown_of(CASE).margin == "mesh.margin"
    plain = type(CASE).from_dict({key: table for key, table in FZG_C_CASE.items() if key != "discharge"})
    assert main_value(plain) == "mesh.lambda_ratio"


def points(*meshes):
    """Sweep over torque with tables ``mesh`` of its summaries."""
    return SweepPoints(
        case=CASE,
        design="grid",
        axes={TORQUE: tuple(range(1, len(meshes) + 1))},
        ranges={},
        samples=0,
        points=tuple(
            Point(number, {TORQUE: number + 1.0}, "solved", summary={"mesh": mesh})
            for number, mesh in enumerate(meshes)
        ),
    )


BROKEN = {"state": "insulates", "lambda_ratio": 4.0, "margin": 0.3, "breakdown_voltage": 1.5}
SAFE = BROKEN | {"margin": 3.0, "breakdown_voltage": 15.0}
TOUCHING = {"state": "conducts at times", "lambda_ratio": 1.5, "smooth_breakdown_voltage": 1.0}
SHORT = TOUCHING | {"state": "conducts", "lambda_ratio": 0.3}


@each(
    ("meshes", "level"),
    [
        ((BROKEN, BROKEN), "red"),
        ((SAFE, SAFE), "green"),
        ((SAFE, BROKEN), "yellow"),
        ((BROKEN, SHORT), "yellow"),  # a mesh that conducts has no voltage
        ((SAFE, TOUCHING), "yellow"),
        ((TOUCHING, TOUCHING), "red"),
        ((TOUCHING, SHORT), "yellow"),
        ((SHORT, SHORT), "grey"),
    ],
)
def test_verdicts_by_the_states(meshes, level):
    assert sweep_verdict(points(*meshes)).level == level


@pytest.mark.parametrize("key", [f"{RA}.1", "gear.profile_shift.1"])
def test_a_point_that_is_refused_leaves_the_others_over_a_key_of_one_gear(key, tmp_path):
    """In batches too: the second of the points has too little oil, or no teeth."""
    changes = [("0.05 um", "20 N m"), ("0.06 um", "1e-5 N m")] if key != "gear.profile_shift.1" else []
    values = (
        {key: [one for one, _ in changes], TORQUE: [two for _, two in changes]}
        if changes
        else {key: [CASE.gear.profile_shift[0], 3.0]}
    )
    sweep = Sweep.from_dict({"case": CASE, "design": "paired", "vary": values})
    with ThreadPoolExecutor(1) as executor:
        points = run_sweep(sweep, tmp_path, executor).points
    assert [point.solved for point in points] == [True, False]
    assert points[1].reason


@each(
    ("vary", "text"),
    [
        ({"bearing.radial_load": ["1 kN", "2 kN"]}, "bearing.radial_load: unknown key"),
        ({RA: {"from": "0.1 um", "to": "-1 um", "count": 3}}, "flank_ra"),
        ({"gear.operation.bulk_temperature": {"from": "iso", "to": "90 degC", "count": 2}}, "temperature"),
        ({RA: [["0.05 um", "0.06 um"], ["0.05 um", "0.07 um"]]}, "flank_ra.1 or gear.flank_ra.2"),
        ({"gear.teeth": {"from": 10, "to": 20, "count": 2}}, "list"),
    ],
)
def test_wrong_axes_are_refused(vary, text):
    with pytest.raises(InputError, match=text):
        Sweep.from_dict({"case": CASE, "vary": vary})


def test_axes_may_have_ranges_and_words():
    bulk = "gear.operation.bulk_temperature"
    warm = CASE.replace({"gear.operation.friction_coefficient": 0.04})
    vary = {bulk: ["iso", "80 degC"], RA: {"from": "0.1 um", "to": "0.4 um", "count": 3, "spacing": "log"}}
    sweep = Sweep.from_dict({"case": warm, "vary": vary})
    assert sweep.axes[bulk] == ("iso", 353.15)
    assert sweep.axes[RA] == pytest.approx((1e-7, 2e-7, 4e-7))


def test_no_probability_at_points():
    with pytest.raises(InputError, match="uncertainty_samples"):
        Sweep.from_dict({"case": CASE, "vary": {TORQUE: [1.0, 2.0]}, "uncertainty_samples": 64})
