"""Sweeps of drives: the numbers of single drives, their keys, their maps, and what is refused."""

from concurrent.futures import ThreadPoolExecutor

import matplotlib as mpl
import numpy as np
import pytest
from typer.testing import CliRunner

from ehlectric import DriveCase, InputError, Sweep, read_sweep, run_sweep
from ehlectric.commands.command_line import app
from ehlectric.drive.result import solve_drive
from ehlectric.figures.sweep_lines import value_lines
from ehlectric.figures.sweep_maps import value_map
from ehlectric.report.drive_report import swept_values
from ehlectric.report.report_facts import swept_names
from ehlectric.runs.preview import preview_of
from ehlectric.sweep.engine import case_key, solve_point
from ehlectric.sweep.points import flat
from ehlectric.sweep.result import unit_of_column
from ehlectric.sweep.sweep_inputs import main_value
from tests.helpers.drives import small_drive
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES
from tests.helpers.sweep_models import case as contact
from tests.helpers.sweep_models import grid

mpl.use("Agg")

SPEED, TEMPERATURE, LOAD = "drive.speed", "drive.temperature", "bearings.bearing.radial_load"
SMOOTH = {"bearings.bearing.summit_height": 0.0}
RATE, ABOVE = "drive.events_per_second", "drive_end.time_above.5"
RPM = np.pi / 30.0


class NoneLeft(ThreadPoolExecutor):
    """Executor that is given nothing to do."""

    def submit(self, *values):
        raise AssertionError(values)


def over(vary, case=None, **keys):
    return Sweep.from_dict({"case": case or small_drive(), "vary": vary} | keys)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A sweep over speed and load, by the command; its points are as small as the helper's."""
    home = tmp_path_factory.mktemp("drives")
    remedy = {"title": "Ring", "changes": {"circuit.grounding_ring_resistance": 1.0}}
    # Smooth films discharge less often than at every edge, and at each point at a rate of its own.
    drive = small_drive(remedies=[remedy], **SMOOTH)
    (home / "drive.toml").write_text(drive.to_toml(), encoding="utf-8")
    (home / "sweep.toml").write_text(
        'title = "Pump"\ncase = "drive.toml"\n[vary]\n"drive.speed" = ["1500 rpm", "4000 rpm"]\n'
        '"bearings.bearing.radial_load" = ["1 kN", "2 kN"]\n',
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
def test_points_are_the_solutions_of_single_drives(results):
    """To the last bit, with the same random numbers; the remedies of the file are left out."""
    assert [point.status for point in results.points] == ["solved"] * 4
    assert results.case.remedies == ()
    for point in results.points:
        alone = solve_drive(small_drive(**SMOOTH, **point.inputs), workers=1).summary()
        kept = {key: value for key, value in alone.items() if key not in ("seconds", "remedies")}
        assert {key: value for key, value in point.summary.items() if key != "seconds"} == kept
        inputs = [point.summary["inputs"][end]["bearing"] for end in ("drive_end", "non_drive_end")]
        assert [each["radial_load"] for each in inputs] == [point.inputs[LOAD]] * 2
    rates = results.values(RATE)
    assert len(set(rates)) == 4
    events, duration = results.values("drive.events"), results.values("drive.duration")
    np.testing.assert_allclose(rates, events / duration, rtol=1e-12)


@pytest.mark.slow
def test_points_that_the_folder_has_are_not_solved_again(folder, results):
    with NoneLeft() as executor:
        again = run_sweep(folder.parent / "sweep.toml", folder, executor)
    assert again == results


@pytest.mark.slow
def test_tables_have_the_numbers_of_both_ends_with_their_units(results):
    table = results.to_dataframe()
    assert list(table[SPEED]) == pytest.approx([1500.0 * RPM] * 2 + [4000.0 * RPM] * 2)
    for key, unit in {RATE: "1/s", ABOVE: "", "non_drive_end.energy_mean": "J", SPEED: "rad/s"}.items():
        assert unit_of_column(results, key) == unit
        assert np.all(np.isfinite(table[key]))
    assert not [key for key in table if key.startswith(("inputs.", "remedies"))]
    dataset = results.to_xarray()
    assert dataset[ABOVE].dims == (SPEED, LOAD)
    assert dataset[ABOVE].attrs["long_name"] == "share of time above 5 V, drive end"
    assert DriveCase.from_dict(results.case.to_dict()) == results.case


@pytest.mark.slow
def test_a_map_is_drawn_of_the_discharges_unless_another_value_is_named(folder, tmp_path):
    words = ["map", str(folder), "--x", SPEED, "--y", LOAD, "-o", str(tmp_path)]
    for more in ([], ["--value", "drive_end.energy_mean"]):
        done = CliRunner().invoke(app, words + more)
        assert done.exit_code == 0, done.output
    names = {f"{kind}_{key}.png" for kind in ("map", "lines") for key in (RATE, "drive_end.energy_mean")}
    assert {path.name for path in tmp_path.iterdir()} == names
    done = CliRunner().invoke(app, [*words, "--value", "discharge.margin"])
    assert "a drive has drive.events_per_second" in done.output
    done = CliRunner().invoke(app, [*words, "--value", "drive_end.time_abov.5"])
    assert "nearest is drive_end.time_above.5" in done.output


@pytest.mark.slow
def test_axes_of_figures_have_names_and_units(results):
    ax = value_map(results, SPEED, LOAD, "non_drive_end.peak_voltage")
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("rotor speed [rpm]", r"radial load $F_\mathrm{r}$ [kN]")
    name = value_lines(results, SPEED, LOAD, RATE).get_ylabel()
    # Too long for one line beside the axis.
    assert name == "discharges per second, both\nbearings [1/s]"
    assert main_value(results.case) == RATE
    assert results.verdict is None


def test_a_plateau_is_of_one_colour():
    """One discharge an edge, which is a level of the map: interpolation has it but for rounding."""
    axes = {SPEED: (157.1, 222.1, 314.2), TEMPERATURE: (313.15, 328.15, 343.15)}
    model = {343.15: 6e4, 328.15: 6e4}
    found = grid(axes, lambda inputs: {"drive": {"events_per_second": model.get(inputs[TEMPERATURE], 2e4)}})
    ax = value_map(found, SPEED, TEMPERATURE, RATE)
    parts = [len(path.to_polygons()) for drawn in ax.collections for path in drawn.get_paths()]
    assert max(parts) <= 2


@each(
    "key, name",
    [
        ("drive_end.inner_speed", "drive_end.bearing.inner_speed"),
        ("bearing.radial_load", LOAD),
        ("bearing.temperature", TEMPERATURE),
        ("source.dclink", "source.dc_link"),
        ("remedies.1.title", "unknown key"),
        ("bearings.bearing.inner_speed", SPEED),
        ("drive_end.contacts", "drive.contacts"),
        ("drive_end.ranges", "cannot vary"),
        ("bearings", "bearings.bearing.radial_load"),
        ("circuit", "circuit.winding_rotor_capacitance"),
    ],
)
def test_keys_that_cannot_vary_are_refused(key, name):
    with pytest.raises(InputError) as raised:
        over({key: [1.0, 2.0]})
    text = str(raised.value)
    assert text.startswith(f"vary.{key}: ")
    assert name in text.removeprefix(f"vary.{key}: ")
    assert "\n" not in text


@each("key", [SPEED, "source.dc_link", LOAD])
def test_keys_of_drives_are_none_of_contacts_and_bearings(key):
    with pytest.raises(InputError, match=rf"^vary\.{key}: unknown key"):
        over({key: [1.0, 2.0]}, case=contact())


def test_one_end_does_not_vary_beside_both():
    """The order of the keys would decide which of the values counts."""
    one = "drive_end.bearing.radial_load"
    with pytest.raises(InputError, match=rf"^vary\.{one}: varies together with {LOAD}"):
        over({LOAD: [1e3, 2e3], one: [1e3, 2e3]})
    assert over({one: [1e3, 2e3], "non_drive_end.bearing.radial_load": [1e3], "title": ["A"]}).size == 2


def test_values_are_read_with_their_units():
    drive = small_drive(**{"breakdown.extinction_current": "10 mA"})
    sweep = over(
        {
            SPEED: {"from": "1500 rpm", "to": "3000 rpm", "count": 2},
            "breakdown.extinction_voltage": ["0.1 V"],
            "drive.seed": [1, 2],
            "source.modulation": ["sinusoidal", "space-vector"],
        },
        case=drive,
    )
    assert sweep.size == 8
    first = drive.replace(next(iter(sweep.points())))
    assert first.drive.speed == pytest.approx(1500.0 * RPM)
    # A varied key replaces its alternative.
    assert (first.breakdown.extinction_voltage, first.breakdown.extinction_current) == (0.1, None)
    with pytest.raises(InputError, match=r"^vary\.source\.dc_link: got '-5 V'; expected "):
        over({"source.dc_link": ["-5 V"]})


def test_a_point_that_cannot_be_solved_says_why():
    """A film that breaks down below the voltage at which its arc goes out."""
    outcome = solve_point(small_drive(**{"breakdown.extinction_voltage": "100 V"}).to_dict())
    assert (outcome.status, outcome.again) == ("failed", False)
    assert outcome.reason.startswith("breakdown.extinction_voltage: got 100 V")


def test_a_measured_voltage_is_a_part_of_the_case(tmp_path):
    """Files are named relative to the sweep file; other contents make another case."""
    rows = [f"{k * 1e-6:.6e},{200.0 if k // 50 % 2 else -200.0}" for k in range(400)]
    for name, lines in (("a.csv", rows), ("b.csv", rows[:300]), ("c.csv", rows)):
        (tmp_path / name).write_text("time (s),voltage (V)\n" + "\n".join(lines) + "\n")
    (tmp_path / "bearing.toml").write_text((EXAMPLES / "bearing_6208.toml").read_text("utf-8"), "utf-8")
    (tmp_path / "sweep.toml").write_text(
        '[case]\nbreakdown = { arc_resistance = 10, extinction_voltage = "1 V", recovery_time = 0 }\n'
        'source = { file = "a.csv" }\ndrive_end = { file = "bearing.toml" }\n'
        'circuit = { winding_rotor_capacitance = "50 pF", rotor_frame_capacitance = "500 pF" }\n'
        '[vary]\nsource.file = ["a.csv", "b.csv", "c.csv"]\n',
        encoding="utf-8",
    )
    sweep = Sweep.from_toml(tmp_path / "sweep.toml")
    assert sweep.case.source.file == str(tmp_path / "a.csv")
    a, b, c = (case_key(sweep.case.replace(inputs)) for inputs in sweep.points())
    assert a == c != b
    assert case_key(sweep.case.replace({"title": "Another"})) == case_key(sweep.case)


def test_a_sweep_of_a_drive_is_checked_without_a_simulation():
    meaning = preview_of(over({SPEED: ["1500 rpm", "3000 rpm"]}))
    assert meaning.summary["sweep"]["points"] == 2
    assert meaning.summary["first_point"]["drive_end"]["breakdown_voltage"] > 0.0
    assert any("2 times one ehlectric drive" in str(row.note) for row in meaning.rows)


@pytest.mark.slow
def test_a_report_draws_maps_and_lines_of_both_bearings_once_where_they_are_the_same(results):
    names = swept_names(results, swept_values(results))
    assert names[:2] == ["map_drive.events_per_second", "lines_drive.events_per_second"]
    assert {"map_drive_end.energy_mean", "map_drive_end.peak_voltage", "map_drive.power"} <= set(names)
    assert not any("non_drive_end" in name for name in names)


def test_the_example_is_a_map_of_the_example_of_a_drive():
    sweep = Sweep.from_toml(EXAMPLES / "drive_map.toml")
    assert sweep.case == DriveCase.from_toml(EXAMPLES / "drive.toml").replace({"remedies": []})
    assert tuple(sweep.vary) == (SPEED, TEMPERATURE)
    assert flat(sweep.case.to_dict())[TEMPERATURE] == pytest.approx(353.15)
