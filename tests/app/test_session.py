"""Sessions of tabs, and the temporary folders of servers."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from ehlectric.app.page_inputs import Inputs
from ehlectric.app.session import Session
from ehlectric.app.work import Scratch, Work, clear_left_behind
from ehlectric.errors import InputError, LostError


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """Folder for temporary files."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


@pytest.fixture
def work(temporary):
    work = Work()
    yield work
    work.close()
    assert not list(temporary.iterdir())


def test_a_session_has_a_folder_of_its_own_which_ends_with_it(work):
    one, other = (Session(work, Inputs({})) for _ in range(2))
    (one.folder / "profile.csv").write_text("1 2")
    assert one.folder == one.folder
    assert one.folder != other.folder
    assert one.folder.stat().st_mode & 0o077 == 0, "only this user reads it"
    folder = one.folder
    one.close()
    assert not folder.exists()
    assert other.folder.is_dir()


def test_a_session_that_has_ended_makes_no_folder(work, temporary):
    """A page that was closed while it loaded would leave one that nobody removes."""
    session = Session(work, Inputs({}))
    session.close()
    with pytest.raises(LostError, match="closed"):
        _ = session.folder
    assert not list(temporary.glob("*/session-*"))


def test_a_session_makes_no_folder_before_it_needs_one(work, temporary):
    Session(work, Inputs({})).close()
    assert not list(temporary.iterdir())


def test_closed_work_leaves_no_folder(temporary):
    work = Work()
    (Session(work, Inputs({})).folder / "profile.csv").write_text("1 2")
    work.close()
    assert not list(temporary.iterdir())


def test_folders_of_servers_that_were_killed_are_removed(temporary):
    code = "import os; from ehlectric.app.work import Scratch; Scratch().new(); os._exit(1)"
    subprocess.run([sys.executable, "-c", code], env=os.environ | {"TMPDIR": str(temporary)}, check=False)
    running = Scratch()
    other = temporary / "ehlectric-app-of-something-else"
    other.mkdir()
    assert len(list(temporary.iterdir())) == 3
    clear_left_behind()
    assert sorted(temporary.iterdir()) == sorted([running.folder, other])
    running.remove()


def test_a_link_to_a_folder_is_not_followed(temporary, tmp_path_factory):
    precious = tmp_path_factory.mktemp("precious")
    (precious / "lock").write_bytes(b"")
    (temporary / "ehlectric-app-link").symlink_to(precious)
    clear_left_behind()
    assert (precious / "lock").exists()


def test_errors_have_the_names_that_users_gave_to_their_files(work):
    session = Session(work, Inputs({}))
    path = session.path_of(session.add("scope.csv", b"1 2"))
    error = session.named_error(InputError(f"{path}: column", got="none", takes=f"a column of {path}"))
    assert (error.key, str(error).count("scope.csv"), str(error).count("/")) == ("scope.csv: column", 2, 0)
    assert str(session.named_error(LostError(f"{path} is lost"))) == "scope.csv is lost"
    other = ValueError("a defect")
    assert session.named_error(other) is other
    session.close()


def test_texts_have_the_names_that_users_gave_to_their_files_however_they_name_them(work):
    session = Session(work, Inputs({}))
    first, second = (session.add(name, b"1 2") for name in ("surface-2.csv", r"my \1.csv"))
    texts = [
        str(session.path_of(second)),
        second,
        Path(second).name,
        f"{first}, {second}.",
        f"x-{second} {second}2",
    ]
    assert [session.named(text) for text in texts] == [
        *[r"my \1.csv"] * 3,
        r"surface-2.csv, my \1.csv.",  # each once, as one name is another file's stored one
        f"x-{second} {second}2",
    ]
    session.close()


def test_a_file_of_the_program_is_stored_as_an_uploaded_one(work, monkeypatch):
    given = Session(work, Inputs({}))
    name = given.add("cycle.csv", b"time [s]\n")
    assert (given.folder / name).read_bytes() == b"time [s]\n"
    assert given.name_of(name) == "cycle.csv"
    assert given.add("cycle.csv", b"") != name, "inputs that were undone keep theirs"
    monkeypatch.setattr("ehlectric.app.session.MOST_TOGETHER", 10)
    with pytest.raises(InputError, match=r"cycle\.csv: has .* MB; expected at most"):
        given.add("cycle.csv", b"12")
    given.close()
