"""Journeys: each command once with its example, in the order in which a user types them."""

import json
import re

import pytest
from typer.main import get_command

from ehlectric import load, read_sweep
from ehlectric.commands.command_line import app
from tests.helpers.readable import verdict_line

pytestmark = [pytest.mark.slow, pytest.mark.gate]

# Lines that a user types in a folder, with the names of the files that each promises; examples are shortened.
JOURNEYS = {
    "contact": {
        "examples discharge": "discharge.toml",
        "check discharge.toml": "",
        "run discharge.toml -o out": "out/film.csv out/result.nc out/summary.json out/film.png",
        "plot out --format svg": "out/film.svg",
        "report out": "out/report.html out/report.pdf",
        "export out -o film.mat": "film.mat",
    },
    "bearing": {
        "init bearing.toml --kind bearing": "bearing.toml",
        "schema bearing -o bearing.json": "bearing.json",
        "check bearing.toml": "",
        "bearing bearing.toml --contacts atlas --no-plots": "bearing/contacts.csv bearing/summary.json",
        "spice bearing.toml --contacts atlas -o bearing.lib": "bearing.lib",
    },
    "drive": {
        "examples drive": "drive.toml",
        "drive drive.toml --no-plots": "drive/events.csv drive/spectrum.csv drive/summary.json",
    },
    "gear": {
        "examples gear_pair": "gear_pair.toml",
        "gear gear_pair.toml --no-plots": "gear/mesh.csv gear/path.csv gear/summary.json",
    },
    "calibration": {
        "examples bearing_measured": "bearing_measured.toml measurements/bearing_6208_points.csv",
        "calibrate bearing_measured.toml --no-plots": "calibration/calibrated.toml calibration/compared.csv",
    },
    "oils": {
        "oils": "",
        "oil fva-3 -o oil": "oil/oil.csv",
        "bearings": "",
        "film --m 200 --l 10 --k 1": "",
    },
    "surface": {
        "examples rough_contact": "rough_contact.toml surfaces/dektak-1.csv",
        "surface surfaces/dektak-1.csv --form line -o surface": "surface/profile.png",
    },
    "sweep": {
        "examples sweep": "sweep.toml discharge.toml",
        "sweep sweep.toml --workers 1": "sweep/sweep.csv sweep/sweep.nc sweep/sweep.sqlite",
        "map sweep --x contact.entrainment_speed --y contact.load_per_length": (
            "sweep/map_discharge.breakdown_voltage.png"
        ),
    },
    "sensitivity": {
        "examples uncertainty": "uncertainty.toml discharge.toml",
        "sweep uncertainty.toml -o out --workers 1": "out/sweep.csv",
        "sensitivity out": "out/sensitivity.json out/sensitivity.png",
    },
    "motion": {
        "examples moving_roughness": "moving_roughness.toml",
        "run moving_roughness.toml -o out --no-plots": "out/summary.json",
        "animate out": "out/motion.gif",
    },
    "paper": {"reproduce --figure 3": "reproduced/figure_3.png"},
}

# Texts of examples, and others that shorten them.
SHORTER = {
    "discharge.toml": {'error = "0.1 %"': "nodes = 401"},
    "drive.toml": {'duration = "0.2 s"': 'duration = "2 ms"'},
    "sweep.toml": {"count = 6": "count = 2"},
    "uncertainty.toml": {"samples = 256": "samples = 16"},
    "moving_roughness.toml": {"nodes = 1601": "nodes = 401", "passes = 1.5": "passes = 0.1"},
}


def shorten(folder):
    """Shorten the examples in a folder."""
    for name, texts in SHORTER.items():
        path = folder / name
        if path.exists():
            text = path.read_text("utf-8")
            for long, short in texts.items():
                assert long in text, name
                text = text.replace(long, short)
            path.write_text(text, "utf-8")


def written(printed):
    """Names of the files that a command printed as written."""
    names = re.findall(r"^written: (.+)$", printed, re.M)
    for folder, listed in re.findall(r"^written to (.+):\n((?:  .+\n)+)", printed, re.M):
        names += [f"{folder}/{name}" for name in re.split(r",\s+|\s*\n\s*", listed.strip())]
    return names


# Commands whose output ends with a verdict, unless surfaces move.
JUDGED = ("run", "bearing", "drive", "gear", "sweep")


@pytest.mark.parametrize("name", JOURNEYS)
def test_each_line_does_what_it_promises(typed, tmp_path, name):
    for line, files in JOURNEYS[name].items():
        done = typed(*line.split())
        assert done.returncode == 0, (line, done.stderr)
        assert done.stdout.strip(), line
        assert not re.search(r"\b(nan|inf)\b", done.stdout + done.stderr, re.IGNORECASE), line
        promised = [*files.split(), *written(done.stdout)]
        assert [file for file in promised if not (tmp_path / file).is_file()] == [], line
        if line.startswith("examples"):
            shorten(tmp_path)
        if line.split()[0] in JUDGED and name != "motion":
            assert_verdict(done.stdout, (tmp_path / promised[0]).parent)


def assert_verdict(printed, folder):
    """The first line of the verdict is the stored one, and its words begin the text of the summary."""
    stored = read_sweep(folder) if (folder / "sweep.sqlite").exists() else load(folder)
    line = verdict_line(printed)
    assert line == next(stored.verdict.lines())[1]
    if (folder / "summary.json").exists():
        text = json.loads((folder / "summary.json").read_text("utf-8"))["verdict"]
        assert line.startswith(re.split("[:.]", text)[0])


def test_every_command_has_a_journey():
    """Tests of the app start it by its command."""
    typed = {line.split()[0] for lines in JOURNEYS.values() for line in lines}
    assert typed | {"app"} == {*get_command(app).commands}
