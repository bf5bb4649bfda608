"""A disk that becomes full while a command writes: one line that names the file, and nothing half-written."""

import os
import subprocess
import sys

import pytest

from tests.commands.conftest import CASE
from tests.helpers.commands import run_command
from tests.helpers.moving_cases import moving
from tests.helpers.places import EXAMPLES
from tests.helpers.share import share_of

LIMITED = """
import resource, sys
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv.pop(1)),) * 2)
from ehlectric.__main__ import main
main()
"""
SWEEP = """\
case = "case.toml"
[vary]
"contact.entrainment_speed" = { from = "1 m/s", to = "2 m/s", count = 5 }
"contact.max_hertz_pressure" = ["0.5 GPa", "0.6 GPa", "0.7 GPa", "0.8 GPa"]
"""
SOBOL = """\
case = "case.toml"
design = "sobol"
samples = 16
[vary]
"contact.entrainment_speed" = { from = "1 m/s", to = "2 m/s" }
"contact.max_hertz_pressure" = { from = "0.5 GPa", to = "1 GPa" }
"""
BEARING = (EXAMPLES / "bearing_6208.toml").read_text("utf-8")
MOVING = moving(motion={"passes": 0.375, "steps": 12, "record": 4}).to_toml()
# Largest number of files of a command at which the disk is full.
_MOST = share_of(4, 2)
SPEED, PRESSURE, VALUE = "contact.entrainment_speed", "contact.max_hertz_pressure", "film.minimum_thickness"


def is_one_line(errors):
    """Whether the file that does not fit is told in one line, with what to do."""
    return errors.count("\n") == 1 and errors.startswith("error: ") and "cannot be written to, " in errors


@pytest.mark.slow
@pytest.mark.parametrize(("limit", "file"), [(1000, "out"), (30_000, "out/result.nc")])
def test_files_that_do_not_fit(tmp_path, case_file, limit, file):
    """A limit on the size of a file stands in for the disk: the library of NetCDF meets the same error."""
    case_file.write_text(CASE.replace("801", "401"))
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "summary.json").write_text("earlier")
    command = [sys.executable, "-c", LIMITED, str(limit), "run", case_file, "-o", "out", "--no-plots"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    advice = "free some space, or choose another folder"
    assert done.stderr == f"error: {file}: cannot be written to, file too large; {advice}\n"
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["summary.json"]
    assert (tmp_path / "out" / "summary.json").read_text() == "earlier"


@pytest.fixture
def disk(tmp_path):
    """A disk of 8 MB, and a function that leaves free space on it [bytes]."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", folder]
    try:
        told = subprocess.run(mount, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        pytest.skip("there is no mount")
    if told.returncode:
        pytest.skip(f"no disk can be mounted: {told.stderr.strip()}")

    def leave(free):
        (folder / "ballast").unlink(missing_ok=True)
        space = os.statvfs(folder)
        (folder / "ballast").write_bytes(bytes(max(0, space.f_bavail * space.f_frsize - free)))
        return folder / "out"

    yield leave
    subprocess.run(["umount", folder], check=True)


def typed(folder, *words):
    done = run_command(*words, cwd=folder)
    return done.returncode, done.stderr


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """Folder with the input files, and with results to draw."""
    folder = tmp_path_factory.mktemp("stored")
    texts = {"case": CASE.replace("801", "257"), "sweep": SWEEP, "sobol": SOBOL, "bearing": BEARING}
    for name, text in (texts | {"moving": MOVING}).items():
        (folder / f"{name}.toml").write_text(text, "utf-8")
    for words in ("run case", "sweep sweep", "sweep sobol", "run moving"):
        command, name = words.split()
        status, errors = typed(folder, command, f"{name}.toml", "-o", f"of_{name}", "-q")
        assert status == 0, errors
    return folder


COMMANDS = {
    "run": "run case.toml -o OUT",
    "moving": "run moving.toml -o OUT",
    "bearing": "bearing bearing.toml --contacts formula -o OUT",
    "sweep": "sweep sweep.toml --workers 1 -o OUT",
    "plot": "plot of_case --format svg -o OUT",
    "plot of moving": "plot of_moving -o OUT",
    "map": f"map of_sweep --x {SPEED} --y {PRESSURE} --value {VALUE} -o OUT",
    "sensitivity": f"sensitivity of_sobol --value {VALUE} -o OUT",
    "surface": f"surface {EXAMPLES / 'surfaces' / 'dektak-1.csv'} --format png --format svg -o OUT/",
    "animate": "animate of_moving -o OUT/moving.gif",
    "figure": "reproduce --figure 2 --format png --format svg -o OUT",
    "table": "reproduce --table 3 -o OUT",
}


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_a_disk_that_is_full_at_every_file(disk, stored, command):
    """What fits is complete; of what does not fit, nothing is left."""
    out = disk(8_000_000)
    words = [*COMMANDS[command].replace("OUT", str(out)).split(), "-q"]
    words = words[:-1] if command == "surface" else words
    status, errors = typed(stored, *words)
    assert status == 0, errors
    made = sorted(out.iterdir(), key=lambda path: path.stat().st_mtime_ns)
    sizes = {path.name: path.stat().st_size for path in made}
    pages = [-(-size // 4096) * 4096 for size in sizes.values()]
    drawn = {path.name: path.read_bytes() for path in made if path.suffix in (".png", ".csv")}
    for path in made:
        path.unlink()
    for k in range(0, len(pages), -(-len(pages) // _MOST)):
        full = disk(sum(pages[:k]) + pages[k] // 2)
        status, errors = typed(stored, *words)
        assert status == 2, (k, errors)
        assert is_one_line(errors), errors
        assert str(full.parent) in errors
        left = list(out.iterdir()) if out.exists() else []
        assert {path.name for path in left} <= sizes.keys()
        for path in left:
            assert path.name not in drawn or path.read_bytes() == drawn[path.name]
            path.unlink()


@pytest.mark.slow
def test_a_sweep_is_resumed_when_there_is_space_again(disk, stored):
    out = disk(60_000)
    words = ["sweep", "sweep.toml", "--workers", "1", "-q", "-o", str(out)]
    status, errors = typed(stored, *words)
    assert status == 2
    assert errors.startswith(f"error: {out / 'sweep.sqlite'}: cannot be written to, ")
    assert [path.name for path in out.iterdir()] == ["sweep.sqlite"]
    disk(7_000_000)
    status, errors = typed(stored, *words)
    assert status == 0, errors
