"""Files that a user names: special files are refused at once, and sizes are known before anything is read."""

import os
import socket
import time
from pathlib import Path

import pytest

from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.drive.waveform.waveform_file import read_waveform
from ehlectric.errors import InputError
from ehlectric.runs.file_kinds import expect
from ehlectric.runs.solve import case_of
from ehlectric.runtime.reading import MOST_TEXT, blocks, read_bytes, read_text, refuse_unreadable
from ehlectric.surfaces.surface_files import read_surface
from ehlectric.sweep.engine import plan
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.each import each

CASE = """\
[contact]
reduced_radius = "14.1 mm"
reduced_modulus = "226 GPa"
max_hertz_pressure = "1 GPa"
entrainment_speed = "2 m/s"
[lubricant]
base = "paper"
"""

# Every function that reads a file of the user.
READERS = {
    "case": Case.from_toml,
    "any case": case_of,
    "bearing": BearingCase.from_toml,
    "sweep": Sweep.from_toml,
    "base case": lambda path: Sweep.from_dict({"case": path, "vary": {"grid.nodes": [401, 801]}}),
    "kind": expect,
    "surface": read_surface,
    "result": refuse_unreadable,
    "waveform": read_waveform,
}


def pipe(path):
    os.mkfifo(path)


def unix_socket(path):
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(path))


def link_to(target):
    def make(path):
        if not Path(target).exists():
            pytest.skip(f"this machine has no {target}")
        path.symlink_to(target)

    return make


SPECIAL = {
    "pipe": (pipe, "a pipe"),
    "socket": (unix_socket, "a socket"),
    "zero": (link_to("/dev/zero"), "a device"),
    "null": (link_to("/dev/null"), "a device"),
    "kmsg": (link_to("/proc/kmsg"), "a file of the kernel"),
    "version": (link_to("/proc/version"), "a file of the kernel"),
    "sys": (link_to("/sys/kernel/mm/transparent_hugepage/enabled"), "a file of the kernel"),
    "folder": (Path.mkdir, "is a directory"),
}


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such files")
@each("reader", [pytest.param(reader, id=name) for name, reader in READERS.items()])
@each("make, words", [pytest.param(*made, id=name) for name, made in SPECIAL.items()])
def test_special_files_are_refused_at_once(tmp_path_factory, monkeypatch, make, words, reader):
    monkeypatch.chdir(tmp_path_factory.mktemp("special"))
    path = Path("special.toml")
    make(path)
    # On the processor: some hundredths of a second. A reader that waits for a pipe would do so for ever.
    began = time.process_time()
    with pytest.raises(InputError) as refused:
        reader(path)
    assert time.process_time() - began < 5.0
    assert words in str(refused.value) or (words == "is a directory" and "is a folder" in str(refused.value))
    assert str(refused.value).startswith("special.toml: ")
    assert "\n" not in str(refused.value)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such file")
def test_an_open_pipe_by_its_name_in_dev_is_refused():
    ends = os.pipe()
    try:
        with pytest.raises(InputError, match="it is a pipe"):
            read_text(f"/dev/fd/{ends[0]}")
    finally:
        for end in ends:
            os.close(end)


def test_a_pipe_as_roughness_of_a_sweep_is_no_valid_point(tmp_path):
    if os.name == "nt":
        pytest.skip("Windows has no pipes in folders")
    pipe(tmp_path / "rough.csv")
    rough = '[[roughness]]\nsurface = 1\nfile = "rough.csv"\n'
    (tmp_path / "case.toml").write_text(CASE + rough)
    case = Case.from_toml(tmp_path / "case.toml")
    sweep = Sweep.from_dict({"case": case, "vary": {"grid.nodes": [401, 801]}})
    assert all("it is a pipe" in point.refused for point in plan(sweep))


@each("name", ["case", "bearing", "sweep", "base case", "surface", "waveform"])
def test_a_sparse_file_of_20_gb_is_refused_unread(tmp_path, name):
    path = tmp_path / "sparse.toml"
    with path.open("wb") as file:
        try:
            file.truncate(20 * 10**9)
        except OSError as error:
            pytest.skip(f"the file system of the tests makes no sparse file, {error}")
    with pytest.raises(InputError, match=r"sparse\.toml: has 20 GB; expected at most [12] [MG]B"):
        READERS[name](path)


def test_sizes_at_the_limit(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE + "#" * (MOST_TEXT - len(CASE)))
    assert Case.from_toml(path).contact.reduced_radius == 0.0141
    path.write_text(CASE + "#" * (MOST_TEXT - len(CASE) + 1))
    with pytest.raises(InputError, match=r"has 1000001 bytes; expected at most 1000000 bytes"):
        Case.from_toml(path)


def test_bytes_come_back_as_they_are(tmp_path):
    (tmp_path / "any").write_bytes(b"\xff\x00\r\n")
    assert read_bytes(tmp_path / "any", most=4) == b"\xff\x00\r\n"
    with pytest.raises(InputError, match="any: has 4 B; expected at most 3 B"):
        read_bytes(tmp_path / "any", most=3)
    (tmp_path / "empty").write_bytes(b"")
    assert read_bytes(tmp_path / "empty", most=0) == b""


def test_blocks_of_a_file_are_the_file(tmp_path):
    path = tmp_path / "any"
    path.write_bytes(bytes(range(250)))
    assert [len(block) for block in blocks(path, most=250, size=100)] == [100, 100, 50]
    assert b"".join(blocks(path, most=250, size=7)) == bytes(range(250))
    with pytest.raises(InputError, match="any: has 250 B; expected at most 249 B"):
        next(blocks(path, most=249))
    (tmp_path / "empty").write_bytes(b"")
    assert list(blocks(tmp_path / "empty", most=0)) == []


def test_a_file_that_grows_between_blocks_is_refused(tmp_path):
    path = tmp_path / "log"
    path.write_bytes(b"1" * 100)
    read = blocks(path, most=1000, size=60)
    assert len(next(read)) == 60
    with path.open("ab") as file:
        file.write(b"2" * 100)
    with pytest.raises(InputError, match="log: grows while it is read"):
        list(read)


def test_text_has_line_feeds_and_no_mark_of_its_byte_order(tmp_path):
    (tmp_path / "text").write_bytes(b"\xef\xbb\xbfa\r\nb\rc\n\xc2\xb5")
    assert read_text(tmp_path / "text") == "a\nb\nc\nµ"


def test_what_is_no_path_is_one_line():
    with pytest.raises(InputError, match=r"'a\\x00b': is not a path"):
        read_text("a\0b")


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such names")
def test_a_name_that_is_no_text_in_utf_8_is_escaped():
    with pytest.raises(InputError) as refused:
        read_text(os.fsdecode(b"n\xff.toml"))
    assert str(refused.value) == r"n\udcff.toml: cannot be read, no such file or directory"
