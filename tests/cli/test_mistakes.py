"""Mistakes that users made, each with the message or the result that helps; numbered as they were found."""

import io
import json
import sys
import types
import zipfile

import pytest
import typer
from typer.testing import CliRunner

from ehlectric.commands.maps import draw_maps
from tests.cli.conftest import CASE
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
    "E1": (
        {'"3000 rpm"': "3000"},
        (
            "bearing.inner_speed: got 3000; expected a string with its unit: '3000 rpm' or "
            "'3000 rad/s' (= 28648 rpm)"
        ),
    ),
    "E3": (
        {'base = "6208"': 'base = "6308-2Z"'},
        ("bearing.base: got '6308-2Z'; expected a name of the library, as a string, such as '6308', "),
    ),
    "E4": (
        {'base = "6208"\n': ""},
        (
            "bearing.kind: missing; expected one of 'deep-groove ball', "
            "'angular-contact ball', 'cylindrical roller'; also missing: elements"
        ),
    ),
    "E4-profile": (
        {'base = "6208"': 'base = "nu-215"'},
        (
            "bearing.profile: missing; a bearing of kind "
            "'cylindrical roller' needs it: 'none' or 'logarithmic'"
        ),
    ),
    "E5": ({'"10 um"': '"0,08 mm"'}, "got '0,08 mm' (decimal comma: write 0.08 mm)"),
    "E6": (
        {'"1800 N"': "1800 N"},
        ("line 6 is 'radial_load = 1800 N': write a number with a unit in quotes, \"1800 N\""),
    ),
    "E6-comma": ({'"10 um"': "0,08"}, "line 5 is 'radial_clearance = 0,08': decimal comma, write 0.08"),
    "E12": (
        {'base = "paper"\n': 'base = "paper"\niso_vg = 46\n'},
        ("lubricant.iso_vg: unknown key; it belongs to the table [lubricant.temperature]"),
    ),
    "E12-index": (
        {VISCOSITIES: "iso_vg = 46\n"},
        (
            "kinematic_viscosity_100: missing; expected either "
            "kinematic_viscosity_100 or viscosity_index; an index of 95 to 100 is usual for mineral oils"
        ),
    ),
    "E13": (
        {"radial_clearance": "clearance"},
        ("bearing.clearance: unknown key; give radial_clearance, or clearance_class such as 'C3' with bore"),
    ),
    "E16": (
        {'"70 degC"': "70"},
        (
            "bearing.temperature: got 70; expected a temperature with its unit, as '70 °C': a "
            "bare number would be in kelvin"
        ),
    ),
}


@pytest.mark.parametrize(("changes", "message"), REFUSED.values(), ids=REFUSED)
def test_refused_bearings(ehlectric, tmp_path, changes, message):
    (tmp_path / "bearing.toml").write_text(spoiled(BEARING, changes), encoding="utf-8")
    done = ehlectric("bearing", "bearing.toml", "-o", "out", "--no-plots")
    assert done.returncode == 2
    assert message in done.stderr
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


@pytest.fixture(scope="module")
def inputs():
    """Inputs of the summary of the same bearing with units that were always understood."""
    return {"inner_speed": 314.159265358979, "temperature": 343.15}


# Every spelling is read in the same way: one at the command line is enough for each run of the tests.
@pytest.mark.parametrize(
    "changes",
    [
        pytest.param(changes, id=name, marks=() if name in ("E2-min^-1", "E16") else pytest.mark.slow)
        for name, changes in ACCEPTED.items()
    ],
)
def test_units_that_people_print(ehlectric, tmp_path, inputs, changes):
    (tmp_path / "bearing.toml").write_text(spoiled(BEARING, changes), encoding="utf-8")
    done = ehlectric("bearing", "bearing.toml", "-o", "out", "--no-plots")
    assert done.returncode == 0, done.stderr
    found = json.loads((tmp_path / "out" / "summary.json").read_text())["inputs"]["bearing"]
    assert {key: found[key] for key in inputs} == inputs


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
            "clearance class C3 is 15 to 33 µm before mounting",
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


@pytest.mark.slow
def test_a_bearing_that_is_too_fast(ehlectric, tmp_path):
    """E1 and E20: 3000 rad/s as a string is accepted, and doubted."""
    (tmp_path / "bearing.toml").write_text(spoiled(BEARING, {"3000 rpm": "3000 rad/s"}))
    done = ehlectric("bearing", "bearing.toml", "-o", "out", "--no-plots")
    assert done.returncode == 0, done.stderr
    assert "2.865e+04 rpm and a pitch diameter of 60 mm: n d_m is 1.72e+06 mm/min" in " ".join(
        done.stderr.split()
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("changes", "message"),
    [
        pytest.param({'"14.1 mm"': '"14,1 mm"'}, "(decimal comma: write 14.1 mm)", id="E5"),
        pytest.param({'"226 GPa"': "226 GPa"}, 'in quotes, "226 GPa"', id="E6"),
        pytest.param({'"14.1 mm"': "14,1 mm"}, 'decimal comma, write "14.1 mm"', id="E6-comma"),
        pytest.param(
            {'base = "paper"': 'base = "paper"\ntemperature = "70 °C"'},
            "lubricant.temperature: got '70 °C'; expected a table, the data sheet of the oil",
            id="E11",
        ),
        pytest.param(
            {'base = "paper"': 'base = "paper"\niso_vg = 46'},
            "lubricant.iso_vg: unknown key; it belongs to the table [lubricant.temperature]",
            id="E12",
        ),
    ],
)
def test_refused_contacts(ehlectric, tmp_path, changes, message):
    (tmp_path / "case.toml").write_text(spoiled(CASE, changes), encoding="utf-8")
    done = ehlectric("check", "case.toml")
    assert done.returncode == 2
    assert message in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.slow
def test_a_radius_in_metres(ehlectric, tmp_path):
    """E20: a radius meant in millimetres."""
    (tmp_path / "case.toml").write_text(spoiled(CASE, {'"14.1 mm"': "14.1"}))
    done = ehlectric("check", "case.toml")
    assert done.returncode == 0, done.stderr
    assert "reduced_radius is 14.1 m, more than machine parts have" in " ".join(done.stderr.split())


def workbook():
    """Content of an Excel workbook as far as its kind is told by it."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
        archive.writestr("xl/workbook.xml", "<workbook/>")
    return content.getvalue()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        pytest.param(
            "prof.xlsx",
            workbook(),
            "prof.xlsx: is a workbook of a spreadsheet program; save the sheet as CSV",
            id="E14",
        ),
        pytest.param(
            "heights.csv",
            b"height um\n" + b"".join(b"%d.5\n" % k for k in range(50)),
            "heights.csv: contains one column of numbers; expected two, position and height",
            id="E15",
        ),
    ],
)
def test_files_that_are_no_profile(ehlectric, tmp_path, name, content, message):
    (tmp_path / name).write_bytes(content)
    done = ehlectric("surface", name)
    assert done.returncode == 2
    assert message in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("at", "message"),
    [
        pytest.param("bearing.temperature=70 C", None, id="E16"),
        pytest.param("bearing.temperature=70 °C", None, id="E21-unit"),
        pytest.param(
            "bearing.temperature=70",
            "at: bearing.temperature: got 70; expected a temperature with its unit, as '70 °C'",
            id="E21",
        ),
    ],
)
def test_temperatures_of_a_cut(monkeypatch, tmp_path, at, message):
    axes = {SPEED: (1.0, 2.0), LOAD: (5e5, 1e6), "bearing.temperature": (313.15, 343.15)}
    store = types.ModuleType("ehlectric.sweep.store")
    store.read_sweep = lambda _: grid(axes, breakdown)
    monkeypatch.setitem(sys.modules, "ehlectric.sweep.store", store)
    monkeypatch.chdir(tmp_path)
    app = typer.Typer()
    app.command("map")(draw_maps)
    words = ["grid", "--x", SPEED, "--y", LOAD, "--value", "discharge.breakdown_voltage", "--at", at]
    done = CliRunner().invoke(app, words, env={"COLUMNS": "200"})
    assert done.exit_code == (2 if message else 0), done.output
    assert (message or "temperature = 70 °C") in done.output
