"""The command report: results of every kind as HTML and PDF, and what it refuses."""

import json
import os
import shutil
import subprocess
import sys
import tomllib

import pytest
import tomli_w

from tests.commands.conftest import CASE
from tests.helpers.moving_cases import LINE
from tests.helpers.places import EXAMPLES
from tests.helpers.reports import HOSTILE, Page, text_of_pdf

SWEEP = f"""\
title = "Speeds"
[vary]
"contact.entrainment_speed" = ["2 m/s", "3 m/s"]
{CASE.replace('title = "Test"', "").replace("[", "[case.").replace("801", "401")}
"""


def solved(ehlectric, folder, command, text, *options):
    """Folder of the result of a file."""
    (folder / "in.toml").write_text(text, encoding="utf-8")
    done = ehlectric(command, "in.toml", "-o", "out", *options)
    assert done.returncode == 0, done.stderr
    return folder / "out"


def reported(ehlectric, folder):
    """Text of both reports of a folder, each on one line."""
    done = ehlectric("report", folder.name)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "written to out:\n  report.html, report.pdf\n"
    page = Page((folder / "report.html").read_text(encoding="utf-8"))
    paper = text_of_pdf((folder / "report.pdf").read_bytes()) if shutil.which("pdftotext") else page.text
    return page, paper


@pytest.mark.slow
def test_of_a_service_whose_home_is_no_folder(ehlectric, tmp_path):
    """Its home is /dev/null, in which reportlab looks for settings."""
    folder = solved(ehlectric, tmp_path, "run", CASE, "--no-plots")
    home = os.environ | {"HOME": "/dev/null", "MPLCONFIGDIR": str(tmp_path / "matplotlib")}
    done = subprocess.run(
        [sys.executable, "-m", "ehlectric", "report", str(folder)],
        env=home, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.slow
@pytest.mark.gate
def test_of_a_line_contact(ehlectric, tmp_path):
    """Numbers are those of summary.json; the next run removes the report."""
    text = CASE.replace('"Test"', f"'{HOSTILE}'".replace("\u202e", ""))
    folder = solved(ehlectric, tmp_path, "run", text, "--no-plots")
    page, paper = reported(ehlectric, folder)
    summary = json.loads((folder / "summary.json").read_text())
    for number in (
        f"{summary['film']['minimum_thickness'] * 1e6:.4g} µm",
        f"{summary['field']['max_strength'] / 1e6:.4g} V/µm",
        f"{summary['hertz']['half_width'] * 1e6:.4g} µm",
    ):
        assert number in page.text
        assert number in paper
    assert not page.of("script")
    assert "<script>alert(1)</script>" in page.text
    assert "<script>alert(1)</script>" in paper
    assert ehlectric("run", "in.toml", "-o", "out", "--no-plots", "-q").returncode == 0
    assert not list(folder.glob("report.*"))


@pytest.mark.slow
def test_of_a_bearing_by_formula(ehlectric, tmp_path):
    # Isothermal films, whose voltages are bounds.
    text = (
        (EXAMPLES / "bearing_6208.toml").read_text(encoding="utf-8").replace("# film_factor", "film_factor")
    )
    folder = solved(ehlectric, tmp_path, "bearing", text, "--no-plots", "--contacts", "formula")
    page, paper = reported(ehlectric, folder)
    summary = json.loads((folder / "summary.json").read_text())
    totals = summary["bearing"]
    for text in (
        summary["verdict"],
        f"capacitance of the bearing {totals['capacitance'] * 1e12:.4g} pF",
        f"first breakdown voltage ≤ {totals['first_break']:.4g} V",
        "Breakdown possible even in an ideal film",
        "library 6208: assumed [3]",
    ):
        assert text in page.text, text
        assert text in paper, text
    lights = [attributes["class"] for attributes in page.of("div") if "light" in attributes.get("class", "")]
    assert lights == ["light yellow"]
    # The input file of the report is solved again to the same summary.
    again = page.texts[next(n for n, text in enumerate(page.texts) if text.startswith('title = "'))]
    (tmp_path / "again.toml").write_text(again, encoding="utf-8")
    assert ehlectric("bearing", "again.toml", "-o", "again", "--no-plots", "-q").returncode == 0
    other = json.loads((tmp_path / "again/summary.json").read_text())
    assert {**other, "seconds": 0} == {**summary, "seconds": 0}


@pytest.mark.slow
def test_of_a_sweep(ehlectric, tmp_path):
    folder = solved(ehlectric, tmp_path, "sweep", SWEEP, "--workers", "1")
    page, paper = reported(ehlectric, folder)
    for text in ("points solved 2", "entrainment speed [m/s] 2, 3"):
        assert text in page.text
        assert text in paper
    again = page.texts[next(n for n, text in enumerate(page.texts) if text.startswith('title = "'))]
    assert tomllib.loads(again)["vary"] == {"contact.entrainment_speed": [2.0, 3.0]}
    (tmp_path / "again.toml").write_text(again, encoding="utf-8")
    done = ehlectric("check", "again.toml")
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.slow
def test_of_moving_roughness(ehlectric, tmp_path):
    folder = solved(ehlectric, tmp_path, "run", tomli_w.dumps(LINE), "--no-plots")
    page, paper = reported(ehlectric, folder)
    summary = json.loads((folder / "summary.json").read_text())
    number = f"minimum film, moving roughness {summary['film']['minimum_thickness'] * 1e6:.4g} µm"
    assert number in page.text
    assert number in paper
    assert len(page.of("img")) == 3


@pytest.mark.slow
def test_one_format_elsewhere(ehlectric, tmp_path):
    folder = solved(ehlectric, tmp_path, "run", CASE.replace("801", "401"), "--no-plots")
    done = ehlectric("report", "out", "--format", "html", "-q")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    assert [path.name for path in folder.glob("report.*")] == ["report.html"]
    done = ehlectric("report", "out/result.nc", "-o", "film.pdf")
    assert (done.returncode, done.stdout) == (0, "written: film.pdf\n")
    assert (tmp_path / "film.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.slow
def test_the_first_page_of_a_contact_stands_alone(ehlectric, tmp_path):
    """The whole report stays beside it; the next run removes both."""
    folder = solved(ehlectric, tmp_path, "run", CASE.replace("801", "401"), "--no-plots")
    assert ehlectric("report", "out", "--format", "html", "-q").returncode == 0
    done = ehlectric("report", "out", "--summary")
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "written to out:\n  summary_page.html, summary_page.pdf\n"
    page = Page((folder / "summary_page.html").read_text(encoding="utf-8"))
    summary = json.loads((folder / "summary.json").read_text())
    assert f"{summary['film']['minimum_thickness'] * 1e6:.3g} µm" in page.text
    assert len(page.of("img")) == 1
    assert (folder / "report.html").exists()
    done = ehlectric("report", "out", "--summary", "-o", "page.txt")
    assert (done.returncode, "file that ends in .html or .pdf" in done.stderr) == (2, True)
    assert ehlectric("run", "in.toml", "-o", "out", "--no-plots", "-q").returncode == 0
    assert not list(folder.glob("report.*"))
    assert not list(folder.glob("summary_page.*"))
