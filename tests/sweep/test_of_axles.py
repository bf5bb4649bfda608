"""Sweeps of e-axles: numbers of single axles, the first element, states of the meshes, maps, and refusals."""

import matplotlib as mpl
import numpy as np
import pytest
from typer.testing import CliRunner

from ehlectric import InputError, Sweep, evaluate, read_sweep, solve_axle
from ehlectric.axle import solve_axles
from ehlectric.commands.command_line import app
from ehlectric.figures.category_maps import edges_of
from ehlectric.figures.sweep_figures import of_slice
from ehlectric.figures.sweep_maps import value_map
from ehlectric.sweep import main_value, select_slice
from ehlectric.sweep.engine import solve_point
from ehlectric.sweep.points import flat
from ehlectric.sweep.verdict_rule import sweep_verdict
from tests.axle.axles import ALONE, two_stages
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

mpl.use("Agg")

TORQUE, SPEED, RQ = "drive.torque", "drive.speed", "bearing.rotor.composite_rq"


@pytest.fixture(scope="module")
def case():
    return two_stages(remedies=[])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Sweep over torque and speed, by the command, with the path of the axle and of its gear files."""
    home = tmp_path_factory.mktemp("axles")
    (home / "sweep.toml").write_text(
        f'title = "Map"\ncase = "{(EXAMPLES / "e_axle.toml").as_posix()}"\n[vary]\n'
        f'"{TORQUE}" = ["-30 N m", "3 N m", "50 N m"]\n"{SPEED}" = ["800 rpm", "4000 rpm", "14000 rpm"]\n',
        encoding="utf-8",
    )
    words = ["sweep", str(home / "sweep.toml"), "-o", str(home / "out"), "--workers", "1", "-q"]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    return home / "out"


@pytest.fixture(scope="module")
def results(folder):
    return read_sweep(folder)


def equal(found, expected):
    """Whether two values of summaries are equal but for rounding."""
    if isinstance(expected, float):
        return found == pytest.approx(expected, rel=1e-7)
    return found == expected


@pytest.mark.slow
@pytest.mark.gate
def test_points_are_the_solutions_of_single_axles(results, case):
    assert [point.status for point in results.points] == ["solved"] * 9
    for point in results.points[::4]:
        alone = solve_axle(case.replace(point.inputs)).point_summary()
        assert sorted(point.summary["warning_codes"]) == sorted(alone["warning_codes"])
        assert point.summary["verdict_level"] == alone["verdict_level"]
        for table in ("edge", "first", "elements", "shafts"):
            values = flat(alone[table])
            found = flat(point.summary[table])
            assert [key for key in values if not equal(found[key], values[key])] == []


@pytest.mark.slow
def test_the_verdict_counts_the_first_elements_and_the_states(results):
    verdict, firsts = sweep_verdict(results), results.columns["first.element"]
    (counted,) = [reason for reason in verdict.reasons if reason.code == "points-first"]
    assert f"{firsts[2]} at {firsts.count(firsts[2])}" in counted.values["elements"]
    states = [reason for reason in verdict.reasons if reason.code == "points-states-of-mesh"]
    assert [each.values["element"] for each in states] == results.case.names_of_meshes()
    assert states[0].values["insulates"] == results.columns["elements.mesh_1.state"].count("insulates")


@pytest.mark.slow
def test_a_map_of_names_has_a_legend_with_their_points(results):
    firsts = results.columns["first.element"]
    ax = value_map(results, SPEED, TORQUE, "first.element")
    names = {text.get_text() for text in ax.get_legend().get_texts()}
    for name in {*firsts} - {None}:
        assert f"{name}: {firsts.count(name)} points" in names
    assert ax.get_xlabel() == "speed of the rotor [rpm]"
    cells = ax.collections[0].get_array()
    assert np.ma.count(cells) == sum(name is not None for name in firsts)
    finding = of_slice(results, select_slice(results, SPEED, TORQUE, "elements.mesh_1.state"))
    assert finding.startswith("Electrical state, mesh of rotor and intermediate: ")


@pytest.mark.slow
def test_the_command_draws_names_and_needs_two_keys(folder):
    words = ["map", str(folder), "--x", SPEED, "--value", "first.element", "-q"]
    done = CliRunner().invoke(app, [*words, "--y", TORQUE])
    assert done.exit_code == 0
    assert [path.name for path in folder.glob("*first.element*")] == ["map_first.element.png"]
    refused = CliRunner().invoke(app, [*words, "--at", f"{TORQUE}=50 N m"])
    assert refused.exit_code == 2
    assert "y: " in refused.output


@pytest.mark.slow
def test_evaluated_axles_are_those_of_each_axle_alone(case):
    """Torques of both signs, roughness of bearings and of flanks, and names, which cannot be an array."""
    given = {
        TORQUE: [-40.0, 25.0, 25.0],
        RQ: ["0.03 um", "0.08 um", "0.03 um"],
        "mesh.2.gear.flank_ra": ["0.1 um", "0.3 um", "0.1 um"],
        "bearing.rotor.base": ["6208", "6208", "6209"],
    }
    found = evaluate(case, given)
    assert found["converged"].values.all()
    for k in range(3):
        changes = {key: values[k] for key, values in given.items()}
        alone = flat(solve_axle(case.replace(changes)).point_summary()["elements"])
        for key, value in alone.items():
            name = f"elements.{key}"
            at = found[name].values[k] if name in found else np.nan  # without a load, as meshes are
            if isinstance(value, str):
                assert at == value
            else:
                expected = np.nan if value is None else float(value)
                assert at == pytest.approx(expected, rel=1e-7, nan_ok=True), key
    assert found[RQ].attrs == {"long_name": "composite roughness Rq, bearings of rotor", "units": "m"}


def test_an_axle_that_has_no_solution_leaves_the_others():
    case = two_stages(remedies=[])
    failed, solved = solve_axles([case.replace({"bearing.output.radial_clearance": "2 mm"}), case])
    assert isinstance(failed, InputError)
    assert "of output" in str(failed)
    assert not isinstance(solved, Exception)


def test_a_wrong_axle_fails_with_its_reason(case):
    outcome = solve_point(case.replace({"bearing.output.radial_clearance": "2 mm"}).to_dict())
    assert outcome.status == "failed"
    assert "of output" in outcome.reason


def test_maps_show_the_margin_by_default(case):
    assert main_value(case) == "first.margin"


def test_keys_of_elements_are_unique():
    twice = [{"name": "a b", "rotor": True}, {"name": "a_b"}]
    bearings = [{**each, "shaft": name} for name in ("a b", "a_b") for each in ALONE["bearing"]]
    link = [{"between": ["a b", "a_b"], "kind": "spline"}]
    axle = type(two_stages()).from_dict(ALONE | {"shaft": twice, "bearing": bearings, "link": link})
    assert [*axle.keys_of_elements()] == ["bearing_1", "bearing_2", "bearing_3", "bearing_4"]
    assert [*axle.keys_of_shafts()] == ["shaft_1", "shaft_2"]


def test_cells_of_a_map_meet_halfway_on_the_axis():
    assert edges_of(np.array([1.0, 9.0]), log=True) == pytest.approx([1.0 / 3.0, 3.0, 27.0])


@each(
    ("vary", "text"),
    [
        ({"bearing.axle.composite_rq": ["1 um"]}, "SHAFT"),
        ({"mesh.3.gear.flank_ra": ["1 um"]}, "NUMBER"),
        ({"bearing.rotor.temperature": ["60 degC"]}, "drive.temperature"),
        ({"mesh.1.gear.operation.pinion_speed": ["100 rpm"]}, "drive.speed"),
        ({"mesh.1.discharge.dielectric_strength": ["10 V/um"]}, "discharge.dielectric_strength"),
        ({"mesh.1.gear.flank_rq": ["1 um"]}, "mesh.1.gear.composite_rq"),
        ({"drive.sped": ["100 rpm"]}, "drive.speed"),
        ({"link": ["a"]}, "cannot vary"),
        ({"bearings.radial_clearance": ["5 um"]}, "bearing.rotor.radial_clearance"),
        ({"motor.winding_rotor_capacitance": ["1 nF"]}, "unknown key"),
        ({"drive.torque": ["0 rpm"]}, "drive.torque"),
    ],
)
def test_wrong_axes_are_refused(vary, text):
    with pytest.raises(InputError, match=text):
        Sweep.from_dict({"case": two_stages(), "vary": vary})


def test_speeds_of_axles_have_a_sign():
    sweep = Sweep.from_dict({"case": two_stages(), "vary": {SPEED: ["-3000 rpm", "3000 rpm"]}})
    assert sweep.axes[SPEED] == pytest.approx((-100.0 * np.pi, 100.0 * np.pi))
    assert sweep.case.remedies == ()
