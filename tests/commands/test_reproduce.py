"""The reproduce command as a user types it."""

import csv
import os
import re
import signal
import subprocess
import time
from pathlib import Path

import pytest
from docs import pages

from ehlectric.paper.paper_contacts import table_3
from tests.helpers.commands import COMMAND
from tests.helpers.places import ROOT
from tests.helpers.processes import PATIENCE, alive, wait_until, workers_of

PNG = b"\x89PNG"


def rows_of(path):
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.slow
def test_schematics_need_no_solution(ehlectric, tmp_path):
    for number in (2, 3):
        done = ehlectric("reproduce", "-o", "out", "--figure", number)
        assert done.returncode == 0, done.stderr
        assert (tmp_path / "out" / f"figure_{number}.png").read_bytes().startswith(PNG)


@pytest.mark.slow
def test_figures_have_a_format_and_a_style(ehlectric, tmp_path):
    words = ["--figure", "3", "--format", "pdf", "--style", "journal"]
    done = ehlectric("reproduce", "-o", "out", *words)
    assert done.returncode == 0, done.stderr
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["figure_3.pdf"]
    assert (tmp_path / "out" / "figure_3.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.slow
def test_table_3_alone(ehlectric, tmp_path):
    done = ehlectric("reproduce", "-o", "out", "--table", "3")
    assert done.returncode == 0, done.stderr
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["table_3.csv"]
    # First contact: minimum films as Venner & Napel and the paper print them, and as computed.
    assert re.search(r"^ +8 +0\.65 +0\.64 +0\.642 +0\.638 +yes", done.stdout, flags=re.M)
    assert re.search(r"^ +1 +0\.17 +0\.16 +0\.163 +0\.159 +yes", done.stdout, flags=re.M)
    rows = rows_of(tmp_path / "out" / "table_3.csv")
    assert all(len(row["M"].replace(".", "")) <= 6 for row in rows)
    assert [float(row["u_s [m/s]"]) for row in rows] == [row["u_s"] for row in table_3()]
    for row, printed in zip(rows, table_3(), strict=True):
        assert row["within 4 %"] == "yes"
        assert float(row["M"]) == pytest.approx(printed["moes_m"], rel=2e-3, abs=0.0)
        assert float(row["paper, h_av [µm]"]) == printed["paper_h_av"]
        computed = float(row["second order, h_min [µm]"])
        assert abs(computed - printed["venner_h_min"]) < 0.04 * printed["venner_h_min"] + 0.005


@pytest.mark.slow
@pytest.mark.gate
def test_one_figure_alone(ehlectric, tmp_path):
    done = ehlectric("reproduce", "-o", "out", "--figure", "7", "--quiet")
    assert done.returncode == 0, done.stderr
    assert done.stdout == done.stderr == ""
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["figure_7.png"]


@pytest.mark.slow
def test_whole_study(ehlectric, tmp_path):
    """All figures and tables, and a report that refers to nothing outside itself."""
    done = ehlectric("reproduce", "-o", "out")
    assert done.returncode == 0, done.stderr
    names = {path.name for path in (tmp_path / "out").iterdir()}
    figures = {f"figure_{number}.png" for number in range(2, 12)}
    tables = {"table_3.csv", "conclusion_1.csv", "conclusion_2.csv", "conclusion_3.csv", "methods.csv"}
    assert names == figures | tables | {"report.html"}
    report = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert not re.search(r"""(?:src|href)=["'](?!data:|#)""", report)
    assert report.count("data:image/png;base64,") == 10
    assert "does not hold" not in report
    assert "Not every film converged" not in report
    assert done.stdout.startswith("Table 3: 4 of 4 rows within 4 %")

    for row in rows_of(tmp_path / "out" / "conclusion_1.csv"):
        assert 1.0 < float(row["E_max h_min/V12"]) < 1.04
        assert float(row["on half of the nodes"]) == pytest.approx(float(row["E_max h_min/V12"]), abs=0.01)
        assert float(row["shifted, maximum"]) < 1.05
        assert float(row["film over roughness, rms"]) < 0.8
    for row in rows_of(tmp_path / "out" / "conclusion_2.csv"):
        assert float(row["grid error [µm]"]) < 0.01 * float(row["width [µm]"])
    for row in rows_of(tmp_path / "out" / "conclusion_3.csv"):
        # Clausius and Mossotti's values as printed in the specification of the eight contacts.
        expected = {"1": 2.888, "2": 3.014}[row["contact"][0]]
        assert float(row["eps at p_h"]) == pytest.approx(expected, abs=1e-3)
        assert abs(float(row["change of E_max [1e-6]"])) < 1.0
    for row in rows_of(tmp_path / "out" / "methods.csv"):
        assert float(row["film, largest difference"]) < 1e-5
        assert int(row["V-cycles to 1e-6"]) <= 8


def started(tmp_path, *, group=False):
    process = subprocess.Popen(
        [COMMAND, "reproduce", "-o", "out"],
        cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=group,
    )  # fmt: skip
    assert wait_until(lambda: workers_of(process.pid))
    return process


def children(pid):
    """Processes below one, from /proc."""
    found = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        if fields[0] != "Z" and int(fields[1]) == pid:
            found.append(int(path.parent.name))
    return found


def gone(pids):
    """Whether processes come to be gone."""
    return wait_until(lambda: not any(map(alive, pids)))


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_study_that_is_stopped_stops(tmp_path, number):
    """Ctrl-C goes to the whole group, twice where the hand is impatient; nothing runs on, nothing is left."""
    process = started(tmp_path, group=True)
    workers = children(process.pid)
    assert workers
    for _ in range(2):
        os.killpg(process.pid, number) if number == signal.SIGINT else process.send_signal(number)
        time.sleep(0.2)
    _, errors = process.communicate(timeout=PATIENCE)
    # The second may meet an interpreter that is leaving and handles nothing any more; a shell says the same.
    assert process.returncode in (128 + number, -number)
    assert "Traceback" not in errors
    assert gone(workers)
    assert not list((tmp_path / "out").glob("*"))  # nor a folder, if the run has made it


@pytest.mark.slow
def test_workers_do_not_outlive_a_study_that_is_killed(tmp_path):
    process = started(tmp_path)
    workers = children(process.pid)
    process.kill()
    process.communicate(timeout=PATIENCE)
    assert gone(workers)


def test_the_page_states_no_time_that_was_typed():
    """The build of the documentation measures its own run: the time cannot be of another version."""
    before, _, _ = pages.page("paper.md").partition("\n## ")
    assert "_generated/paper_time.md" in before
    assert not re.search(r"\b(seconds?|minutes?)\b", before)
    assert "paper_time.md" in (ROOT / "docs" / "_ext" / "paper_tables.py").read_text(encoding="utf-8")
