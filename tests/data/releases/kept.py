"""Keeps files of a release, which later versions must read: python tests/data/releases/kept.py

It writes a folder by the name of the version: the files of the examples, and results of them on coarse grids.
The summary.json and sweep.csv beside a result have its numbers as the release gave them.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from ehlectric.runs.file_kinds import command_of_file
from ehlectric.version import __version__

HERE = Path(__file__).parent
EXAMPLES = HERE.parents[2] / "examples"
KEPT = ("result.nc", "bearing.nc", "drive.nc", "motion.nc", "sweep.sqlite", "summary.json", "sweep.csv")

# Example of each result by the name of its folder, with lines to replace.
RESULTS = {
    "line": ("discharge.toml", {'error = "0.1 %"': "nodes = 101"}),
    "rough": (
        "rough_contact.toml",
        {"nodes = 6401": "nodes = 201", '"80 um"': '"80 um"\ncutoff_short = "40 um"'},
    ),
    "hot": ("hot_contact.toml", {"nodes = 801": "nodes = 101"}),
    "starved": ("starved_contact.toml", {'error = "3 %"': "nodes = 65\nfield_degree = 4"}),
    "touching": ("mixed_contact.toml", {"nodes = 129": "nodes = 65\nfield_degree = 4"}),
    "bearing": ("bearing_6208.toml", {"[bearing]\n": 'contacts = "atlas"\n[bearing]\n'}),
    "drive": ("drive.toml", {'duration = "0.2 s"': 'duration = "5 ms"'}),
    "motion": (
        "moving_roughness.toml",
        {"nodes = 1601 ": "nodes = 201 ", '"50 um"': '"200 um"', "record = 200 ": "record = 10 "},
    ),
    "sweep": ("sweep.toml", {"count = 6": "count = 2"}),
    "drives": ("drive_map.toml", {"count = 5": "count = 3", "count = 4": "count = 2"}),
}


def keep(example: str, lines: dict[str, str], target: Path) -> None:
    """Solve an example with replaced lines, and keep its files."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "examples"
        shutil.copytree(EXAMPLES, folder)
        text = (folder / example).read_text(encoding="utf-8")
        for old, new in lines.items():
            assert text.count(old) == 1, (example, old)
            text = text.replace(old, new)
        (folder / example).write_text(text, encoding="utf-8")
        command = command_of_file(folder / example)
        plots = [] if command == "sweep" else ["--no-plots"]
        words = [sys.executable, "-m", "ehlectric", command, example, "-o", "out", "--quiet", *plots]
        subprocess.run(words, cwd=folder, check=True)
        target.mkdir(parents=True, exist_ok=True)
        for kept in KEPT:
            if (folder / "out" / kept).is_file():
                shutil.copy(folder / "out" / kept, target / kept)


if __name__ == "__main__":
    cases = HERE / __version__ / "cases"
    cases.mkdir(parents=True, exist_ok=True)
    for file in EXAMPLES.glob("*.toml"):
        shutil.copy(file, cases)
    for name, (example, lines) in RESULTS.items():
        keep(example, lines, HERE / __version__ / name)
