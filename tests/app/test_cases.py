"""Cases of pages: no address and no uploaded case makes the server read a file of its machine."""

import sys
import tomllib
from contextlib import suppress
from pathlib import Path

import pytest

from ehlectric.app.compute.answer_parts import (
    case_of,
    drive_of,
    kind_of,
    names_in,
    sweep_of,
    with_session_files,
)
from ehlectric.app.page_inputs import Inputs
from ehlectric.errors import InputError
from tests.helpers.each import each
from tests.helpers.places import DEKTAK, EXAMPLES

ROUGH = tomllib.loads((EXAMPLES / "rough_contact.toml").read_text(encoding="utf-8"))
BEARING = tomllib.loads((EXAMPLES / "bearing_6208.toml").read_text(encoding="utf-8"))
DRIVE = tomllib.loads((EXAMPLES / "drive.toml").read_text(encoding="utf-8"))


def rough(name):
    return {**ROUGH, "roughness": [{**ROUGH["roughness"][0], "file": name}]}


@pytest.fixture
def folder(tmp_path):
    """Folder of a session with one surface, a link out of it, and a folder."""
    folder = tmp_path / "session"
    (folder / "surfaces").mkdir(parents=True)
    (folder / "surfaces" / "dektak-1.csv").write_bytes(DEKTAK.read_bytes())
    (folder / "link.csv").symlink_to(DEKTAK)
    (folder / "out").symlink_to(DEKTAK.parent, target_is_directory=True)
    (tmp_path / "session-2.csv").write_bytes(DEKTAK.read_bytes())
    return folder


def test_a_file_of_the_session_is_read(folder):
    for name in ("surfaces/dektak-1.csv", str(folder / "surfaces" / "dektak-1.csv")):
        case = case_of(rough(name), folder)
        assert Path(case.roughness[0].file) == folder / "surfaces" / "dektak-1.csv"


@each(
    "name",
    [
        str(DEKTAK),
        "/etc/passwd",
        "../session-2.csv",
        "../../../../../../etc/passwd",
        "surfaces/../../session-2.csv",
        "link.csv",
        "out/dektak-1.csv",
        "surfaces",
        "missing.csv",
        "file:///etc/passwd",
        "~/.bashrc",
        "C:\\Windows\\win.ini",
        "\\\\server\\share\\surface.csv",
        "surfaces/dektak-1.csv\0",
        "/dev/zero",
        "",
    ],
)
def test_other_files_are_refused(folder, name):
    for inside in (folder, None):
        with pytest.raises(InputError, match="uploaded") as refused:
            case_of(rough(name), inside)
        assert refused.value.key == "roughness.1.file"


def test_a_sweep_names_no_file_of_the_server(folder):
    base = EXAMPLES / "discharge.toml"
    speeds = {"contact.entrainment_speed": ["1 m/s", "2 m/s"]}
    with pytest.raises(InputError, match=r"case: got .*expected its tables"):
        sweep_of({"case": str(base), "vary": speeds}, folder)
    case = tomllib.loads(base.read_text(encoding="utf-8"))
    assert sweep_of({"case": case, "vary": speeds}, folder).size == 2
    for vary in ({"roughness.1.file": [str(DEKTAK)]}, {"roughness": {"1": {"file": [str(DEKTAK)]}}}):
        with pytest.raises(InputError, match="uploaded"):
            sweep_of({"case": rough("surfaces/dektak-1.csv"), "vary": vary}, folder)
    with pytest.raises(InputError, match=r"case\.roughness\.1\.file.*uploaded"):
        sweep_of({"case": rough(str(DEKTAK)), "vary": speeds}, folder)


def test_names_of_files_are_found_with_their_keys():
    assert list(names_in(ROUGH)) == [("roughness.1.file", "surfaces/dektak-1.csv")]
    assert list(names_in({"case": "a.toml", "vary": {"roughness.1.file": ["b", "c"]}})) == [
        ("case", "a.toml"),
        ("vary.roughness.1.file", "b"),
        ("vary.roughness.1.file", "c"),
    ]
    assert list(names_in(BEARING)) == []


OPENED: list[str] = []
sys.addaudithook(lambda event, values: OPENED.append(str(values[0])) if event == "open" else None)


def texts(table, key=""):
    """Keys of all values that may be texts."""
    for name, value in table.items():
        if isinstance(value, dict):
            yield from texts(value, f"{key}{name}.")
        else:
            yield f"{key}{name}"


@pytest.mark.parametrize("name", ["../../../secret", "/tmp/secret", "secret.toml"])
def test_no_other_text_of_a_case_opens_a_file(name):
    """Every key that a form or an address may set is given the name of a file; none is opened."""
    for start in (BEARING, {**ROUGH, "roughness": []}):
        further = {
            "bearing.coating.base",
            "bearing.element_material",
            "lubricant.base",
            "bearing.fits.shaft_material",
        }
        for key in sorted({*texts(start), *further}):
            OPENED.clear()
            with suppress(InputError):
                case_of(Inputs(start).changed({key: name}).table)
            assert not [path for path in OPENED if "secret" in path], key


def test_refusal_reads_nothing(folder):
    OPENED.clear()
    with pytest.raises(InputError):
        with_session_files(rough("/etc/passwd"), folder)
    assert "/etc/passwd" not in OPENED


def test_a_drive_is_no_case_of_another_page():
    table = {"source": {"dc_link": "560 V"}}
    assert kind_of(table) == "drive"
    with pytest.raises(InputError, match="is a drive file"):
        case_of(table)


@each(
    "key, told",
    [("drive_end.file", "its tables"), ("non_drive_end.file", "its tables"), ("source.file", "uploaded")],
)
@each("name", ["/etc/passwd", "../secret.toml", "bearing_6208.toml"])
def test_a_drive_opens_no_file_that_was_not_uploaded(folder, key, told, name):
    OPENED.clear()
    table = Inputs(DRIVE).changed({key: name}).table
    with pytest.raises(InputError, match=told):
        drive_of(table, folder)
    assert not [path for path in OPENED if name.rpartition("/")[2] in path]
