"""The command ehlectric gear: files, tables, and files that it refuses."""

import csv
import json
import re

import pytest
from hypothesis import given, settings

from ehlectric.cases.gear_case import GearCase
from ehlectric.errors import InputError
from ehlectric.gear import solve_gear
from ehlectric.quantities.results import PATH_POINTS, PHASE_COLUMNS
from tests.gear.drawings import LAWS, SPOILT, tables_of_drawing
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

EXAMPLE = EXAMPLES / "gear_pair.toml"


@each("name", sorted(path.name for path in EXAMPLES.glob("gear_[ps]*.toml")))
def test_examples_are_solved(typed, tmp_path, name):
    done = typed("gear", EXAMPLES / name, "-o", name, "--no-plots")
    assert done.returncode == 0
    assert {"summary.json", "path.csv", "mesh.csv"} <= {path.name for path in (tmp_path / name).iterdir()}
    summary = json.loads((tmp_path / name / "summary.json").read_text("utf-8"))
    assert summary["mesh"]["state"] in done.stdout
    with (tmp_path / name / "path.csv").open(encoding="utf-8", newline="") as file:
        heads, *rows = csv.reader(file)
    assert tuple(row[0] for row in rows) == PATH_POINTS
    place = heads.index("place [m]")
    assert float(rows[2][place]) == pytest.approx(summary["points"]["C"]["place"])
    with (tmp_path / name / "mesh.csv").open(encoding="utf-8", newline="") as file:
        heads, *rows = csv.reader(file)
    assert len(heads) == len(PHASE_COLUMNS)
    mean = sum(float(row[1]) * float(row[4]) for row in rows)
    assert mean == pytest.approx(summary["mesh"]["capacitance"])


@pytest.mark.slow
@pytest.mark.gate
def test_a_duty_cycle_is_computed(typed, tmp_path):
    done = typed("gear", EXAMPLES / "duty_gear.toml", "-o", "out")
    assert done.returncode == 0
    assert "share of the duty cycle, conducts at times" in done.stdout
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"duty.csv", "gear_duty.png"} <= names
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    # The car stops for 234 of 1800 s.
    assert summary["duty"]["standstill_share"] == pytest.approx(234.0 / 1800.0, abs=0.001)


def test_json_is_the_summary(typed, tmp_path):
    done = typed("gear", EXAMPLE, "-o", "out", "--no-plots", "--json")
    printed = json.loads(done.stdout)
    written = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))
    assert printed["mesh"] == written["mesh"]
    assert printed["verdict_level"] == "red"


def test_check_shows_the_verdict_and_writes_nothing(typed, tmp_path):
    done = typed("check", EXAMPLE)
    assert done.returncode == 0
    assert "Breakdown expected" in done.stdout
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_check_and_gear_say_the_same_of_touching_summits(typed, tmp_path):
    """Both state one probability, and begin with the same words."""
    text = EXAMPLE.read_text("utf-8").replace('"14000 rpm"', '"8000 rpm"')
    (tmp_path / "gear.toml").write_text(text, "utf-8")
    check, solved = (typed(*words) for words in (("check", "gear.toml"), ("gear", "gear.toml", "--no-plots")))
    first, other = (
        [line for line in done.stdout.splitlines() if "8000 rpm" in line or "probability  " in line]
        for done in (check, solved)
    )
    assert first == other
    assert len(first) > 1
    assert "expected" in first[0]


BAD = {
    "torque": ('pinion_torque = "30 N m"', 'pinion_torque = "30 N"'),
    "teeth": ("teeth = [23, 67]", "teeth = [23]"),
    "distance": ('centre_distance = "87 mm"', 'centre_distance = "60 mm"'),
    "pointed": ('"48.96 mm", "132.04 mm"', '"60 mm", "132.04 mm"'),
    "contact ratio": ('"48.96 mm", "132.04 mm"', '"44 mm", "126 mm"'),
    "unknown": ("face_width =", "facewidth ="),
    "oil": ('base = "e-axle-fluid"', 'base = "honey"'),
    "hot": ('bulk_temperature = "65 degC"', 'bulk_temperature = "250 degC"'),
    "overlap": ("profile_shift = [0.30]", "profile_shift = [0.30, 0.1]"),
}


@each("name", BAD)
def test_bad_files_end_in_one_line_and_write_nothing(typed, tmp_path, name):
    before, after = BAD[name]
    text = EXAMPLE.read_text("utf-8")
    assert before in text
    (tmp_path / "gear.toml").write_text(text.replace(before, after), "utf-8")
    done = typed("gear", "gear.toml", "-o", "out")
    assert done.returncode == 2
    assert done.stdout == ""
    assert re.fullmatch(r"error: [^\n]+\n", done.stderr)
    assert [path.name for path in tmp_path.iterdir()] == ["gear.toml"]


def toml_of(tables, before=""):
    """Lines of TOML with the dotted keys of tables; lists and numbers of JSON are those of TOML."""
    for name, value in tables.items():
        key = f"{before}{name}"
        if isinstance(value, dict):
            yield from toml_of(value, f"{key}.")
        else:
            yield f"{key} = {json.dumps(value)}"


def is_refused(tables):
    try:
        solve_gear(GearCase.from_dict(tables), probable=False)
    except InputError:
        return True
    return False


@pytest.mark.slow
def test_two_hundred_bad_drawings_end_in_one_line_and_write_nothing(typed, tmp_path):
    """Impossible drawings and wrong values, each of which the command refuses with the status 2."""
    refused = []

    @settings(max_examples=250, deadline=None)
    @given(SPOILT, LAWS)
    def check(drawing, law):
        tables = tables_of_drawing(drawing, law)
        if not is_refused(tables):
            return
        (tmp_path / "gear.toml").write_text("\n".join(toml_of(tables)), "utf-8")
        done = typed("gear", "gear.toml", "-o", "out")
        assert done.returncode == 2
        assert done.stdout == ""
        assert re.fullmatch(r"error: gear\.[^\n]+\n", done.stderr)
        assert [path.name for path in tmp_path.iterdir()] == ["gear.toml"]
        refused.append(done.stderr)

    check()
    assert len(refused) >= 200
