"""Files of pages: what is opened is checked as by the command, and what is downloaded is what it writes."""

import json
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

from ehlectric.app.compute.answer_parts import drive_of
from ehlectric.app.compute.gear_answers import quick_answer
from ehlectric.app.compute.page_files import drawn, packed, uploaded, write
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.session import MOST_TOGETHER
from ehlectric.app.view_models import MOST_CASE, MOST_FILES, file_title
from ehlectric.errors import InputError
from ehlectric.readable import readable
from tests.helpers.each import each
from tests.helpers.places import DEKTAK, EXAMPLES


def example(name):
    return (EXAMPLES / f"{name}.toml").read_bytes()


def silent(_done, _of, _text):
    pass


@each(
    "name, kind",
    [
        ("bearing_6208", "bearing"),
        ("line_contact", "contact"),
        ("oil_contact", "contact"),
        ("moving_roughness", "motion"),
        ("drive", "drive"),
    ],
)
def test_an_example_is_opened_as_it_is(tmp_path_factory, name, kind):
    found = uploaded({f"{name}.toml": example(name)}, tmp_path_factory.mktemp("session"))
    assert (found.name, found.kind, found.missing) == (f"{name}.toml", kind, ())
    assert found.table == tomllib.loads(example(name).decode())


def test_a_case_asks_for_its_surface(tmp_path):
    case = {"rough.toml": example("rough_contact")}
    assert uploaded(case, tmp_path).missing == ("dektak-1.csv",)
    assert list(tmp_path.iterdir()) == []
    found = uploaded({**case, "dektak-1.csv": DEKTAK.read_bytes()}, tmp_path)
    assert found.missing == ()
    assert found.table["roughness"][0]["file"] == "surfaces/dektak-1.csv"
    assert (tmp_path / "surfaces" / "dektak-1.csv").read_bytes() == DEKTAK.read_bytes()
    assert uploaded(case, tmp_path).missing == (), "it is there from before"


DRIVE = """
[source]
{source}
[circuit]
winding_rotor_capacitance = "50 pF"
rotor_frame_capacitance = "500 pF"
[breakdown]
arc_resistance = "10 ohm"
extinction_current = "10 mA"
recovery_time = "100 ns"
[drive_end]
file = "../bearings/bearing_6208.toml"
bearing.radial_load = "900 N"
"""
DESCRIBED = """
dc_link = "560 V"
modulation = "six-step"
fundamental_frequency = "100 Hz"
rise_time = "100 ns"
"""


def test_a_drive_takes_the_tables_of_its_bearing_file(tmp_path):
    drive = {"drive.toml": DRIVE.format(source=DESCRIBED).encode()}
    assert uploaded(drive, tmp_path).missing == ("bearing_6208.toml",)
    found = uploaded({"bearing_6208.toml": example("bearing_6208"), **drive}, tmp_path)
    assert (found.name, found.kind, found.missing) == ("drive.toml", "drive", ())
    expected = tomllib.loads(example("bearing_6208").decode())
    expected["bearing"]["radial_load"] = "900 N"
    assert found.table["drive_end"] == expected
    assert drive_of(found.table, tmp_path).drive_end.bearing.radial_load == 900.0


def test_a_drive_takes_its_waveform_along(tmp_path):
    drive = DRIVE.format(source='file = "C:/data/scope.csv"').encode()
    bearing = {"bearing_6208.toml": example("bearing_6208")}
    assert uploaded({"drive.toml": drive, **bearing}, tmp_path).missing == ("scope.csv",)
    wave = b"time [s],voltage [V]\n" + b"".join(b"%e,%d\n" % (1e-8 * k, 100 * (k % 2)) for k in range(100))
    found = uploaded({"drive.toml": drive, **bearing, "scope.csv": wave}, tmp_path)
    assert found.table["source"]["file"] == "surfaces/scope.csv"
    assert (tmp_path / "surfaces" / "scope.csv").read_bytes() == wave
    assert drive_of(found.table, tmp_path).source.file == str(tmp_path / "surfaces" / "scope.csv")


@pytest.mark.slow
def test_a_drive_is_written_as_by_the_command(tmp_path):
    table = tomllib.loads(example("drive").decode())
    table = {**table, "drive": {**table["drive"], "duration": "1 ms"}, "remedies": []}
    found = write(table, "", tmp_path, silent)
    assert set(found.names) == {"summary.json", "events.csv", "spectrum.csv", "drive.nc"}
    path = packed(Path(found.folder), "all", table, "drive", tmp_path)
    with zipfile.ZipFile(path) as archive:
        assert {"drive.toml", *found.names} <= set(archive.namelist())
    figures = drawn(Path(found.folder), "figures", table, "drive", tmp_path, silent)
    with zipfile.ZipFile(figures) as archive:
        assert "drive_voltages.svg" in archive.namelist()


def test_surfaces_of_a_case_that_is_refused_do_not_stay(tmp_path):
    bad = example("rough_contact").replace(b'load_per_length = "', b'load_per_length = "-')
    with pytest.raises(InputError, match="load"):
        uploaded({"rough.toml": bad, "dektak-1.csv": DEKTAK.read_bytes()}, tmp_path)
    assert not list((tmp_path / "surfaces").iterdir())


def test_files_are_few_and_a_tab_holds_so_much(tmp_path):
    many = {f"{k}.csv": b"1 2" for k in range(MOST_FILES + 1)}
    with pytest.raises(InputError, match=f"at most {MOST_FILES}"):
        uploaded(many, tmp_path)
    (tmp_path / "surfaces").mkdir()
    with (tmp_path / "surfaces" / "there.csv").open("wb") as there:
        there.truncate(MOST_TOGETHER)
    with pytest.raises(InputError, match="240 MB"):
        uploaded({"case.toml": example("line_contact")}, tmp_path)


def test_a_sweep_asks_for_its_case(tmp_path):
    sweep = {"sweep.toml": example("sweep")}
    assert uploaded(sweep, tmp_path).missing == ("discharge.toml",)
    found = uploaded({"discharge.toml": example("discharge"), **sweep}, tmp_path)
    assert (found.name, found.kind, found.missing) == ("sweep.toml", "sweep", ())
    assert found.table["case"] == tomllib.loads(example("discharge").decode())


@each("path", ["/etc/passwd", "../../passwd", "C:\\me\\passwd", "\\\\host\\a\\passwd"])
def test_a_path_of_another_machine_is_asked_for_by_its_name(tmp_path_factory, path):
    table = tomllib.loads(example("rough_contact").decode())
    table["roughness"][0]["file"] = path
    folder = tmp_path_factory.mktemp("session")
    assert uploaded({"a.toml": Inputs(table).toml().encode()}, folder).missing == ("passwd",)


@each("path", ["..", ".", "", "a/..", ".bashrc", "a\0b", "con: x", "x" * 200, "a\nb"])
def test_a_name_that_no_file_may_have_is_refused(tmp_path_factory, path):
    table = tomllib.loads(example("rough_contact").decode())
    table["roughness"][0]["file"] = path
    folder = tmp_path_factory.mktemp("session")
    with pytest.raises(InputError, match=r"roughness\.1\.file"):
        uploaded({"a.toml": Inputs(table).toml().encode()}, folder)
    assert list(folder.iterdir()) == []


@each(
    "contents, says",
    [
        ({"a.toml": b"a = " + b"1" * MOST_CASE}, "200000"),
        ({"a.toml": b"\xff\xfe"}, "UTF-8"),
        ({"a.toml": b"a = 1,5"}, "decimal comma"),
        ({"a.toml": b"[bearing]\nbase = '6208'\nradial_laod = '1 N'"}, "bearing.radial_laod"),
        ({"a.csv": b"1 2"}, ".toml"),
        ({"a.toml": b"a." * 20 + b"b = 1"}, "16"),
    ],
)
def test_a_bad_file_is_refused_in_words(tmp_path_factory, contents, says):
    with pytest.raises(InputError) as refused:
        uploaded(contents, tmp_path_factory.mktemp("session"))
    assert says in str(refused.value)
    assert "Traceback" not in str(refused.value)


def numbers(summary):
    """Summary without what differs between two runs: their computing time."""
    return {key: value for key, value in summary.items() if key != "seconds"}


@pytest.mark.slow
def test_the_downloaded_case_run_by_the_command_gives_the_downloaded_files(tmp_path):
    """Both come from the same text: the expected numbers are those that the command writes."""
    inputs = Inputs(tomllib.loads(example("bearing_6208").decode()))
    inputs = inputs.changed({"bearing.inner_speed": "2345.6 rpm", "title": 'Größe "6208" & co'})
    session = tmp_path / "session"
    session.mkdir()
    written = write(inputs.table, "formula", session, silent)
    assert Path(written.folder).parent == session
    archive = drawn(Path(written.folder), "all", inputs.table, "bearing", session, silent)
    with zipfile.ZipFile(archive) as opened:
        opened.extractall(tmp_path / "unpacked")
        names = set(opened.namelist())
    assert names > {*written.names, "bearing.toml"}
    assert {"summary.json", "contacts.csv", "impedance.csv", "bearing.nc"} <= names
    assert {Path(name).suffix for name in names} == {".json", ".csv", ".nc", ".svg", ".png", ".toml"}

    case, folder = tmp_path / "unpacked" / "bearing.toml", tmp_path / "command"
    command = [sys.executable, "-m", "ehlectric", "bearing", str(case), "--contacts", "formula"]
    subprocess.run([*command, "--no-plots", "-q", "-o", str(folder)], check=True, capture_output=True)
    ours = json.loads((tmp_path / "unpacked" / "summary.json").read_text())
    theirs = json.loads((folder / "summary.json").read_text())
    assert numbers(ours) == numbers(theirs)
    for name in ("contacts.csv", "impedance.csv"):
        assert (tmp_path / "unpacked" / name).read_text() == (folder / name).read_text()


@pytest.mark.slow
def test_files_of_a_gear_pair_have_the_films_of_its_page(tmp_path):
    """The page takes films of the atlas until it solves them, whatever the file says."""
    table = tomllib.loads(example("gear_pair").decode()) | {"contacts": "solved"}
    written = write(table, "atlas", tmp_path, silent)
    margin = json.loads((Path(written.folder) / "summary.json").read_text("utf-8"))["mesh"]["margin"]
    assert readable(margin) == quick_answer(table).number("mesh.margin").text


def test_single_files_and_archives(tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    for name in ("summary.json", "film.csv", "result.nc", "film.png", "film.svg", ".hidden.csv"):
        (out / name).write_text(name)
    (out / "link.csv").symlink_to(DEKTAK)
    table = tomllib.loads(example("line_contact").decode())
    for what, name in (("csv", "film.csv"), ("netcdf", "result.nc"), ("summary", "summary.json")):
        assert packed(out, what, table, "a", tmp_path) == str(out / name)
    with zipfile.ZipFile(packed(out, "figures", table, "a", tmp_path)) as archive:
        assert archive.namelist() == ["film.png", "film.svg"]
    (out / "result.nc").unlink()
    with pytest.raises(InputError, match="not among the files"):
        packed(out, "netcdf", table, "a", tmp_path)


@pytest.mark.slow
def test_an_archive_has_the_surfaces_and_runs_as_it_is(tmp_path):
    session = tmp_path / "session"
    session.mkdir()
    found = uploaded({"rough.toml": example("rough_contact"), "dektak-1.csv": DEKTAK.read_bytes()}, session)
    inputs = Inputs(found.table).changed({"grid.nodes": 801})
    written = write(inputs.table, "", session, silent)
    with zipfile.ZipFile(packed(Path(written.folder), "all", inputs.table, "rough", session)) as archive:
        archive.extractall(tmp_path / "unpacked")
    case = tmp_path / "unpacked" / "rough.toml"
    folder = tmp_path / "command"
    command = [sys.executable, "-m", "ehlectric", "run", str(case), "--no-plots", "-q", "-o", str(folder)]
    subprocess.run(command, check=True, capture_output=True)
    # Only the place of the surface differs.
    ours = (tmp_path / "unpacked" / "summary.json").read_text().replace(str(session), "")
    theirs = (folder / "summary.json").read_text().replace(str(case.parent), "")
    assert numbers(json.loads(ours)) == numbers(json.loads(theirs))


def test_names_of_files_from_titles():
    assert file_title("../../etc/passwd\0") == "etc-passwd"
    assert file_title("x" * 200) == "x" * 60
    assert file_title(5) == "5"
