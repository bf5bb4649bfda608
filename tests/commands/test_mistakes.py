"""Mistakes that users made, each with the message or the result that helps; numbered as they were found."""

import io
import json
import zipfile

import pytest
import typer
from typer.testing import CliRunner

from ehlectric.commands.sweep_commands import draw_maps
from tests.commands.conftest import CASE
from tests.helpers.each import each
from tests.helpers.sweep_models import LOAD, SPEED, breakdown, grid

BEARING = """\
title = "6208"
contacts = "formula"
[bearing]
base = "6208"
radial_clearance = "10 um"
radial_load = "1800 N"
inner_speed = "3000 rpm"
temperature = "70 degC"
composite_rq = "0.03 um"
[lubricant]
base = "paper"
[lubricant.temperature]
kinematic_viscosity_40 = "46 mm^2/s"
kinematic_viscosity_100 = "6.8 mm^2/s"
density_15 = "870 kg/m^3"
[discharge]
dielectric_strength = "15 V/um"
"""
VISCOSITIES = 'kinematic_viscosity_40 = "46 mm^2/s"\nkinematic_viscosity_100 = "6.8 mm^2/s"\n'


def spoiled(text, changes):
    """Text with each of its parts replaced, which must be in it."""
    for old, new in changes.items():
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return text


REFUSED = {
    "E1": ({'"3000 rpm"': "3000"}, ["bearing.inner_speed: ", "3000 rpm", "3000 rad/s", "28648 rpm"]),
    "E3": ({'base = "6208"': 'base = "6398-2Z"'}, ["bearing.base: ", "'6398-2Z'", "'63"]),
    "E4": (
        {'base = "6208"\n': ""},
        [
            "bearing.kind: missing",
            "'deep-groove ball'",
            "'angular-contact ball'",
            "'cylindrical roller'",
            "elements",
        ],
    ),
    "E4-profile": (
        {'base = "6208"': 'base = "nu-215"'},
        ["bearing.profile: missing", "'cylindrical roller'", "'none'", "'logarithmic'"],
    ),
    "E5": ({'"10 um"': '"0,08 mm"'}, ["'0,08 mm'", "0.08 mm"]),
    "E6": ({'"1800 N"': "1800 N"}, ["line 6", "radial_load = 1800 N", '"1800 N"']),
    "E6-comma": ({'"10 um"': "0,08"}, ["line 5", "radial_clearance = 0,08", "0.08"]),
    "E12": (
        {'base = "paper"\n': 'base = "paper"\niso_vg = 46\n'},
        ["lubricant.iso_vg: ", "[lubricant.temperature]"],
    ),
    "E12-index": (
        {VISCOSITIES: "iso_vg = 46\n"},
        ["kinematic_viscosity_100: missing", "viscosity_index", "95 to 100"],
    ),
    "E13": (
        {"radial_clearance": "clearance"},
        ["bearing.clearance: ", "radial_clearance", "clearance_class", "'C3'", "bore"],
    ),
    "E16": ({'"70 degC"': "70"}, ["bearing.temperature: ", "got 70", "70 °C"]),
}


@pytest.mark.slow
@pytest.mark.gate
@each("changes, names", [pytest.param(*case, id=name) for name, case in REFUSED.items()])
def test_refused_bearings(typed, tmp_path, changes, names):
    (tmp_path / "bearing.toml").write_text(spoiled(BEARING, changes), encoding="utf-8")
    done = typed("bearing", "bearing.toml", "-o", "out", "--no-plots")
    assert done.returncode == 2
    assert [name for name in names if name not in done.stderr] == []
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "out").exists()


ACCEPTED = {
    "E2-min^-1": {"3000 rpm": "3000 min^-1"},
    "E2-min⁻¹": {"3000 rpm": "3000 min⁻¹"},
    "E2-1/min": {"3000 rpm": "3000 1/min"},
    "E2-r/min": {"3000 rpm": "3000 r/min"},
    "E2-RPM": {"3000 rpm": "3000 RPM"},
    "E2-U/min": {"3000 rpm": "3000 U/min"},
    "E16": {"70 degC": "70 C"},
}


@pytest.mark.slow
@each("changes", [pytest.param(changes, id=name) for name, changes in ACCEPTED.items()])
def test_units_that_people_print(typed, tmp_path, changes):
    """The speed and the temperature are those of the units that were always understood."""
    (tmp_path / "bearing.toml").write_text(spoiled(BEARING, changes), encoding="utf-8")
    done = typed("check", "bearing.toml", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)["inputs"]["bearing"]
    assert (found["inner_speed"], found["temperature"]) == (314.159265358979, 343.15)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "viscosity", "clearance", "warning"),
    [
        # 46 mm²/s and the 6.64 mm²/s of index 95: 14.62 mm²/s at 70 °C by hand, times 838.9 kg/m³.
        pytest.param(
            {VISCOSITIES: 'iso_vg = "ISO VG 46"\nviscosity_index = 95\n'},
            0.01226,
            10e-6,
            "ISO VG 46 is 41.4 to 50.6 mm²/s at 40 °C",
            id="E12",
        ),
        # C3 of a bore of 40 mm is 15 to 33 µm.
        pytest.param(
            {'"10 um"': '"C3"'},
            0.01246,
            24e-6,
            "the initial clearance of class C3 is 15 to 33 µm",
            id="E13",
        ),
    ],
)
def test_what_catalogues_say(ehlectric, tmp_path, changes, viscosity, clearance, warning):
    (tmp_path / "bearing.toml").write_text(spoiled(BEARING, changes), encoding="utf-8")
    done = ehlectric("bearing", "bearing.toml", "-o", "out", "--no-plots")
    assert done.returncode == 0, done.stderr
    assert warning in " ".join(done.stderr.split())
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["lubricant"]["viscosity"] == pytest.approx(viscosity, rel=2e-3)
    assert summary["inputs"]["bearing"]["radial_clearance"] == pytest.approx(clearance, rel=1e-12)


@each(
    "changes, names",
    [
        pytest.param({'"14.1 mm"': '"14,1 mm"'}, ["14.1 mm"], id="E5"),
        pytest.param({'"226 GPa"': "226 GPa"}, ['"226 GPa"'], id="E6"),
        pytest.param({'"14.1 mm"': "14,1 mm"}, ['"14.1 mm"'], id="E6-comma"),
        pytest.param(
            {'base = "paper"': 'base = "paper"\ntemperature = "70 °C"'},
            ["lubricant.temperature: ", "'70 °C'", "table"],
            id="E11",
        ),
        pytest.param(
            {'base = "paper"': 'base = "paper"\niso_vg = 46'},
            ["lubricant.iso_vg: ", "[lubricant.temperature]"],
            id="E12",
        ),
    ],
)
def test_refused_contacts(typed, tmp_path, changes, names):
    (tmp_path / "case.toml").write_text(spoiled(CASE, changes), encoding="utf-8")
    done = typed("check", "case.toml")
    assert done.returncode == 2
    assert [name for name in names if name not in done.stderr] == []
    assert done.stderr.count("\n") == 1


@pytest.mark.slow
@pytest.mark.gate
def test_radii_and_speeds_that_no_machine_has_are_doubted(typed, tmp_path):
    """E20: a radius meant in millimetres, and 3000 rad/s as a string, are accepted with a warning."""
    for text, kind, names in (
        (spoiled(CASE, {'"14.1 mm"': "14.1"}), "case", ["reduced_radius", "14.1 m"]),
        (
            spoiled(BEARING, {"3000 rpm": "3000 rad/s"}),
            "bearing",
            ["28 650 rpm", "60 mm", "1.72 million mm/min"],
        ),
    ):
        (tmp_path / f"{kind}.toml").write_text(text)
        done = typed("check", f"{kind}.toml")
        assert done.returncode == 0, done.stderr
        warned = " ".join(done.stderr.split())
        assert [name for name in names if name not in warned] == []


def workbook():
    """Content of an Excel workbook as far as its kind is told by it."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr("xl/workbook.xml", "<workbook/>")
    return content.getvalue()


def test_a_workbook_is_no_profile(typed, tmp_path):
    """E14."""
    (tmp_path / "prof.xlsx").write_bytes(workbook())
    done = typed("surface", "prof.xlsx")
    assert done.returncode == 2
    for part in ("prof.xlsx: ", "workbook", "CSV"):
        assert part in done.stderr


@pytest.mark.slow
@each(
    "at, status, name",
    [
        pytest.param("bearing.temperature=70 C", 0, "70 °C", id="E16"),
        pytest.param("bearing.temperature=70 °C", 0, "70 °C", id="E21-unit"),
        pytest.param("bearing.temperature=70", 2, "bearing.temperature: got 70", id="E21"),
    ],
)
def test_temperatures_of_a_cut(monkeypatch, tmp_path, at, status, name):
    axes = {SPEED: (1.0, 2.0), LOAD: (5e5, 1e6), "bearing.temperature": (313.15, 343.15)}
    monkeypatch.setattr("ehlectric.sweep.read_sweep", lambda _: grid(axes, breakdown))
    monkeypatch.chdir(tmp_path)
    app = typer.Typer()
    app.command("map")(draw_maps)
    words = ["grid", "--x", SPEED, "--y", LOAD, "--value", "discharge.breakdown_voltage", "--at", at]
    done = CliRunner().invoke(app, words, env={"COLUMNS": "200"})
    assert done.exit_code == status, done.output
    assert name in done.output
