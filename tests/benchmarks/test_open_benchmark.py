"""The open benchmark: its files are those of the manifest, its inputs those of the design, and films agree.

Its films were solved to 0.01 % (lines) and 0.1 % on far finer grids than those of these tests.
"""

import csv
import hashlib
import json
import subprocess
import sys

import pytest
from benchmarks.open_benchmark import CLASSES, TARGET, case_of, class_of, contacts

from ehlectric import solve

pytestmark = pytest.mark.reference


def rows(name):
    """Rows of a table by the names of their contacts."""
    with (TARGET / name).open(newline="", encoding="utf-8") as file:
        return {row["name"]: row for row in csv.DictReader(file)}


def compared(path, *options):
    """Run of the script that compares a table."""
    command = [sys.executable, str(TARGET / "compare.py"), str(path), *options]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def test_files_are_those_of_the_manifest():
    manifest = json.loads((TARGET / "manifest.json").read_text("utf-8"))
    for name, digest in manifest["sha256"].items():
        assert hashlib.sha256((TARGET / name).read_bytes()).hexdigest() == digest, name
    assert manifest["contacts"] == sum(each.number for each in CLASSES.values()) == 240
    assert sum(path.stat().st_size for path in TARGET.iterdir() if path.is_file()) < 20e6


@pytest.mark.slow
@pytest.mark.gate
def test_inputs_are_those_of_the_design():
    drawn, written = dict(contacts()), rows("contacts.csv")
    assert len(written) == 240
    for name, row in written.items():
        for key in ("entrainment_speed", "reduced_modulus", "moes_m", "moes_l"):
            assert float(row[key]) == pytest.approx(drawn[name][key], rel=1e-6), (name, key)


def test_every_film_is_within_its_error():
    for name, row in rows("results.csv").items():
        limit = CLASSES[class_of(name)].error
        assert float(row["film_error"]) <= limit, name
        assert float(row["domain_error"]) <= limit, name
        assert float(row["minimum_film"]) < float(row["central_film"])


def test_profiles_pass_through_the_central_film():
    """The positions are 0.0175 half-widths apart, and the film between them is nearly flat."""
    results, at_centre = rows("results.csv"), {}
    with (TARGET / "profiles.csv").open(newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            position = abs(float(row["position"]))
            if row["axis"] == "x" and position < at_centre.get(row["name"], (0.02,))[0]:
                at_centre[row["name"]] = position, float(row["film"])
    assert len(at_centre) == 240
    smooth = {name: film for name, (_, film) in at_centre.items() if class_of(name) != "rough"}
    for name, film in smooth.items():
        assert film == pytest.approx(float(results[name]["central_film"]), rel=0.02), name


@pytest.mark.slow
@pytest.mark.parametrize("name", ["line-002", "line-050", "rough-003", "hot-002"])
def test_lines_agree_on_a_coarser_grid(name):
    exact = rows("results.csv")[name]
    result = solve(case_of(dict(contacts())[name], 5e-3))
    assert result.film.central_thickness == pytest.approx(float(exact["central_film"]), rel=5e-3)
    assert result.film.minimum_thickness == pytest.approx(float(exact["minimum_film"]), rel=5e-3)
    field = result.summary()["field"]
    assert field["capacitance_per_length"] == pytest.approx(float(exact["capacitance"]), rel=5e-3)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["point-003", "point-004", "point-023"])
def test_points_agree_on_a_coarser_grid(name):
    exact = rows("results.csv")[name]
    result = solve(case_of(dict(contacts())[name], 1e-2))
    assert result.film.central_thickness == pytest.approx(float(exact["central_film"]), rel=0.01)
    assert result.film.minimum_thickness == pytest.approx(float(exact["minimum_film"]), rel=0.01)
    assert result.summary()["field"]["capacitance"] == pytest.approx(float(exact["capacitance"]), rel=0.015)


def test_comparison_finds_what_is_wrong(tmp_path):
    """A table whose central films are 1 % too thick, one of them by 5 %."""
    results = rows("results.csv")
    table = tmp_path / "mine.csv"
    with table.open("w", newline="", encoding="utf-8") as file:
        file.write("name,central_film\n")
        for name, row in results.items():
            file.write(f"{name},{float(row['central_film']) * (1.05 if name == 'line-007' else 1.01)!r}\n")
    done = compared(table)
    assert done.returncode == 0, done.stderr
    lines = {line.split()[0]: line.split() for line in done.stdout.splitlines()[1:]}
    assert lines["line"][1:] == ["central_film", "100", "1.00%", "+5.00%", "line-007"]
    assert lines["rough"][2:5] == ["20", "1.00%", "+1.00%"]


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("contact,central_film\nline-001,1e-7\n", "expected a column name"),
        ("name,central_film\nline-999,1e-7\n", "line-999 is no contact"),
        ("name,central_film\nline-002,thick\n", "line-002, central_film: got 'thick'"),
        ("name,height\nline-002,1e-7\n", "no quantity to compare"),
        ("name,central_film\nline-002,nan\n", "expected a finite number"),
        ("name,central_film\nline-002,1e-7\nline-002,2e-7\n", "line-002 stands there twice"),
    ],
)
def test_comparison_refuses_a_wrong_table(tmp_path, text, message):
    table = tmp_path / "mine.csv"
    table.write_text(text, "utf-8")
    done = compared(table)
    assert done.returncode == 2
    assert message in done.stderr
    assert "Traceback" not in done.stderr
