"""Duty cycles on the page of a bearing: numbers of the command, figure over time, and wrong files."""

import json
import tomllib
import zipfile

import numpy as np
import pytest

from ehlectric.app.charts.duty_charts import MOST_DUTY_ROWS, duty_figure, duty_rows
from ehlectric.app.charts.plotly_panels import thinned
from ehlectric.app.compute.answer_parts import lines_of
from ehlectric.app.compute.bearing_answers import (
    answer_of,
    bearing_case,
    duty_answer,
    quick_answer,
    whole_quick_answer,
)
from ehlectric.app.compute.duty_answers import look
from ehlectric.app.compute.page_files import packed, write
from ehlectric.app.session import SURFACES
from ehlectric.bearing.duty_cycle import run_duty
from ehlectric.bearing.result import solve_bearing
from ehlectric.errors import InputError
from ehlectric.quantities.units import RPM
from ehlectric.runs.by_kind import run
from ehlectric.runs.example_files import example_text
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.cycles import HEADS, ROWS
from tests.helpers.each import each


def silent(_done, _of, _text):
    pass


def stored(folder, text, name="surface-1.csv"):
    """Name of a file of a session with a text."""
    (folder / SURFACES).mkdir(exist_ok=True)
    (folder / SURFACES / name).write_text(text, encoding="utf-8")
    return f"{SURFACES}/{name}"


def inputs(file):
    """Tables of the example with a duty cycle."""
    return tomllib.loads(example_text("bearing_6208")) | {"contacts": "formula", "duty": {"file": file}}


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    """Folder of a session with a duty cycle."""
    folder = tmp_path_factory.mktemp("session")
    stored(folder, f"{HEADS}\n{ROWS}")
    return folder


@pytest.fixture(scope="module")
def table():
    return inputs(f"{SURFACES}/surface-1.csv")


@pytest.fixture(scope="module")
def answer(session, table):
    return duty_answer(table, session)


@pytest.fixture(scope="module")
def duty(session, table):
    return run_duty(bearing_case(table, session=session))


@pytest.fixture(scope="module")
def summary(session, tmp_path_factory):
    """Summary that ``ehlectric bearing FILE`` writes, with the file of the cycle beside the case."""
    folder = tmp_path_factory.mktemp("command")
    cycle = (session / SURFACES / "surface-1.csv").read_bytes()
    (folder / "cycle.csv").write_bytes(cycle)
    text = 'contacts = "formula"\n' + example_text("bearing_6208") + '\n[duty]\nfile = "cycle.csv"\n'
    (folder / "case.toml").write_text(text, encoding="utf-8")
    run(folder / "case.toml", folder / "result")
    return json.loads((folder / "result" / "summary.json").read_text(encoding="utf-8"))


@pytest.mark.slow
def test_the_page_has_the_numbers_of_the_command(answer, summary):
    rows = [row for row in total_rows(summary) if row.key.startswith("duty.")]
    assert answer.lines == lines_of(row for row in rows if not row.key.startswith("duty.stretches"))
    assert {
        "share of the duty cycle at a standstill",
        "duty cycle, breakdown while turning",
    } <= {line.name for line in answer.lines}
    stretches = summary["duty"]["stretches"]
    assert stretches
    assert [(float(row[0]), float(row[1])) for row in answer.stretches.rows] == [
        (one["start"], one["end"]) for one in stretches
    ]
    assert [row[-1] for row in answer.stretches.rows] == [
        one["why"] or "no single input" for one in stretches
    ]
    head = answer.stretches.heads.index("speed [rpm]")
    for row, one in zip(answer.stretches.rows, stretches, strict=True):
        assert float(row[head]) == pytest.approx(one["speed"] / RPM, rel=1e-3)
    assert [one.code for one in answer.warnings] == ["columns-ignored"]


@pytest.mark.slow
def test_the_answer_about_the_bearing_does_not_wait_for_its_cycle(session, table):
    """It reads no file: one that is not there does not matter, and its rows stand with the cycle."""
    lost = table | {"duty": {"file": f"{SURFACES}/lost.csv"}}
    for answers in (quick_answer, whole_quick_answer):
        found = answers(lost, session)
        assert found.lines == answers({k: v for k, v in table.items() if k != "duty"}, session).lines
        assert found.duty is None
    with pytest.raises(InputError, match=r"duty\.file: .*uploaded in this tab"):
        duty_answer(lost, session)


@pytest.mark.slow
def test_a_solved_answer_has_the_cycle_of_its_run(session, table, answer):
    found = answer_of(solve_bearing(bearing_case(table, session=session), workers=1))
    assert found.duty.lines == answer.lines
    assert not any("cycle" in line.name for line in found.lines)


@pytest.mark.slow
def test_the_figure_has_the_rows_of_the_cycle(answer, duty):
    plot = answer.figure.plot
    lines = {trace["name"]: trace for trace in plot["data"] if "fill" not in trace and trace.get("name")}
    assert set(lines) == {"speed", "lambda ratio", "margin"}
    assert lines["speed"]["x"] == [0.0, 10.0, 20.0, 30.0, 40.0, 100.0]
    assert lines["speed"]["y"] == pytest.approx([0.0, 15.0, 900.0, 1000.0, -3000.0, 6000.0])
    assert lines["lambda ratio"]["y"][0] is None, "there is no film at a standstill"
    assert lines["margin"]["y"][1] is None, "there is no voltage where surfaces touch"
    legend = [trace["name"] for trace in plot["data"] if trace["showlegend"]]
    assert len(legend) == len(set(legend)) == 3, "the bands stand in the legend once"
    # A band ends halfway to the next row.
    standstill = next(trace for trace in plot["data"] if trace["name"] == "standstill")
    assert (min(standstill["x"]), max(standstill["x"])) == (0.0, 5.0)
    assert plot["layout"]["yaxis2"]["title"]["text"] == "lambda ratio", "no brackets without a unit"
    states = [row[-1] for row in answer.figure.table.rows]
    assert states[:3] == ["standstill", "boundary lubrication", "mixed lubrication"]
    assert len(states) == duty.rows.time.size


def test_spans_of_a_band_are_one_trace_with_gaps(session):
    rows = "".join(f"{10 * k},{3000 * (k % 2)},1800,70\n" for k in range(7))
    file = stored(session, f"{HEADS.removesuffix(',gear')}\n{rows}", "surface-2.csv")
    found = duty_figure(run_duty(bearing_case(inputs(file), session=session)))
    band = next(trace for trace in found["data"] if trace["name"] == "standstill")
    gaps = [k for k, x in enumerate(band["x"]) if x is None]
    assert len(gaps) == 3, "four standstills"
    assert [y is None for y in band["y"]] == [x is None for x in band["x"]]
    first, second = band["x"][: gaps[0]], band["x"][gaps[0] + 1 : gaps[1]]
    assert (min(first), max(first), min(second), max(second)) == (0.0, 5.0, 15.0, 25.0)


def test_a_long_curve_keeps_its_extremes_beside_its_gaps():
    values = np.cos(np.linspace(0.0, 50.0, 20_001))
    values[7000:7400] = np.nan
    values[7401], values[7399:7401] = -3.0, np.nan
    kept = thinned([values], 100)
    assert kept.size < 350
    assert np.nanmin(values[kept]) == -3.0
    assert np.nanmax(values[kept]) == np.nanmax(values)
    assert np.any(np.isnan(values[kept])), "the curve has its gap"


@pytest.mark.slow
def test_the_table_of_a_long_cycle_is_short(session):
    rows = "".join(f"{k},3000,1800,70\n" for k in range(1001))
    file = stored(session, f"{HEADS.removesuffix(',gear')}\n{rows}", "surface-3.csv")
    found = duty_answer(inputs(file), session)
    cells = found.figure.table.rows
    assert len(cells) == MOST_DUTY_ROWS
    assert (cells[0][0], cells[-1][0]) == ("0", "1000")
    assert "1001 rows" in found.figure.table.caption
    assert found.stretches is None or found.stretches.rows
    assert duty_rows(run_duty(bearing_case(inputs(file), session=session)))[0] == cells[0]


def test_a_file_is_looked_at_before_it_is_used(session):
    found = look(f"{SURFACES}/surface-1.csv", session)
    assert found.text == "6 rows over 100 s: speed, radial load, temperature. Ignored: gear."
    assert not found.of_vehicle


@pytest.mark.parametrize("kind", ["bearing", "drive", "gear"])
def test_a_file_with_the_speed_of_a_vehicle_needs_its_wheels(tmp_path, kind):
    file = stored(tmp_path, "time [s],vehicle speed [km/h]\n0,0\n1,36\n")
    found = look(file, tmp_path, kind)
    assert found.of_vehicle
    assert found.text.startswith("2 rows over 1 s: vehicle speed.")


@each(
    "text, told",
    [
        ("time [s],speed [rpm]\n0,1\n1,fast\n", "line 3.*fast.*number"),
        ("time [s],speed [kg]\n0,1\n1,2\n", r"speed.*kg"),
        ("time [s],speed [rpm]\n0,1\n0,2\n", "line 3.*time increases"),
        ("speed [rpm]\n1\n2\n", "time"),
        ("time [s],speed [rpm]\n0,1\n", "at least two"),
    ],
)
def test_a_wrong_file_says_where_and_what_is_allowed(tmp_path, text, told):
    file = stored(tmp_path, text)
    with pytest.raises(InputError, match=f"surface-1.csv.*{told}"):
        look(file, tmp_path)


def test_other_files_are_not_looked_at(tmp_path):
    (tmp_path.parent / "secret.csv").write_text("time [s],speed [rpm]\n0,1\n1,2\n", encoding="utf-8")
    for file in ("../secret.csv", str(tmp_path.parent / "secret.csv"), "/etc/passwd"):
        with pytest.raises(InputError, match="uploaded in this tab"):
            look(file, tmp_path)


def test_a_cycle_that_does_not_suit_the_bearing_is_refused(tmp_path):
    file = stored(tmp_path, "time [s],common-mode voltage [V]\n0,100\n1,200\n")
    table = {key: value for key, value in inputs(file).items() if key != "motor"}
    assert quick_answer(table, tmp_path).lines
    with pytest.raises(InputError, match=r"no \[motor\]"):
        duty_answer(table, tmp_path)


@pytest.mark.slow
def test_downloads_have_the_cycle_and_its_rows(session, table):
    written = write(table, "formula", session, silent)
    assert "duty.csv" in written.names
    archive = packed(session / "out", "all", table, "case", session)
    with zipfile.ZipFile(archive) as files:
        assert {"duty.csv", "case.toml", f"{SURFACES}/surface-1.csv"} <= set(files.namelist())
        assert tomllib.loads(files.read("case.toml").decode())["duty"] == table["duty"]
