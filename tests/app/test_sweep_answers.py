"""Sweeps of the page: the database of the command, its map, and links that reproduce its points."""

import asyncio
import json
import shutil
import sqlite3
from contextlib import closing
from urllib.parse import parse_qsl

import pytest

from ehlectric.app.calls import SWEEP_SOLVED
from ehlectric.app.compute import sweep_answers
from ehlectric.app.page_inputs import Inputs, Range, sweep_file, with_ranges, with_shown
from ehlectric.app.pages.frame import AXLE, SWEEP, example_inputs
from ehlectric.app.work import Limits, Work
from ehlectric.cases.drive_case import case_of_dict
from ehlectric.cases.input_keys import kind_of, unit_of
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import CODES
from ehlectric.runs.by_kind import run_sweep
from ehlectric.sweep.engine import case_key, solve_point
from ehlectric.sweep.store import read_sweep
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.each import each

CASE = SWEEP.value("case")

# One of the four points is solved. Thirty balls do not fit on the pitch circle, which is found when they are
# placed; with a bore of 90 mm the case is refused before.
VARY = {
    "bearing": {
        "bore": {"from": "40 mm", "to": "90 mm", "count": 2},
        "elements": {"from": 9, "to": 30, "count": 2},
    }
}
BORE = {"from": "40 mm", "to": "80 mm", "count": 2}
TABLE = {"case": CASE, "vary": VARY}


def silent(_done, _of, _text):
    pass


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "sweep"
    sweep_answers.solved(TABLE, str(path), 1, silent)
    return path


def stored(path):
    """Outcome of every point of a database, without its time and date."""
    with closing(sqlite3.connect(path / "sweep.sqlite")) as file:
        points = file.execute("SELECT number, inputs, key, refused FROM points").fetchall()
        results = file.execute("SELECT key, status, reason, summary FROM results ORDER BY key").fetchall()
    return points, [(*row, without_time(json.loads(text or "{}"))) for *row, text in results]


def without_time(summary):
    return {key: value for key, value in summary.items() if key not in ("seconds", "title", "verdict")}


@pytest.mark.slow
def test_the_downloaded_file_gives_the_command_the_same_database(folder, tmp_path):
    file = tmp_path / "sweep.toml"
    file.write_text(Inputs(TABLE).toml(), encoding="utf-8")
    run_sweep(Sweep.from_toml(file), tmp_path / "command", workers=1)
    assert stored(tmp_path / "command") == stored(folder)
    assert {p.name for p in (tmp_path / "command").iterdir()} == {p.name for p in folder.iterdir()}


@pytest.mark.slow
def test_resume_solves_only_the_missing_point(folder, tmp_path):
    again = tmp_path / "sweep"
    shutil.copytree(folder, again)
    with closing(sqlite3.connect(again / "sweep.sqlite")) as file, file:
        (key,) = file.execute("SELECT key FROM results WHERE status = 'solved'").fetchone()
        file.execute("DELETE FROM results WHERE key = ?", [key])
        file.execute("DELETE FROM seals WHERE key = ?", [key])

    def dates(path):
        with closing(sqlite3.connect(path / "sweep.sqlite")) as file:
            return dict(file.execute("SELECT key, date FROM results"))

    kept, told = dates(again), []
    sweep_answers.solved(TABLE, str(again), 1, lambda done, of, _: told.append((done, of)))
    # Points that are refused or failed are done.
    assert told[0] == (3, 4)
    assert told[-1] == (4, 4)
    assert {one: date for one, date in dates(again).items() if one != key} == kept
    assert stored(again) == stored(folder)


@pytest.mark.slow
def test_a_stopped_job_resumes_without_solving_a_point_twice(tmp_path):
    table = {"case": CASE, "vary": {"bearing": {"radial_load": {"from": "1 kN", "to": "4 kN", "count": 24}}}}
    place = str(tmp_path / "sweep")

    async def stop_and_resume():
        work = Work(Limits(jobs=1))
        try:
            first = work.share().start(SWEEP_SOLVED, table, place, 1)
            while not first.over and first.done < 2:
                await asyncio.sleep(0.005)
            first.cancel()
            assert first.state == "cancelled"
            kept = {point.number: point.seconds for point in read_sweep(place).points if point.solved}
            second = work.share().start(SWEEP_SOLVED, table, place, 1)
            await second.wait()
            return kept, second
        finally:
            work.close()

    kept, second = asyncio.run(stop_and_resume())
    assert second.error is None
    assert len(kept) >= 2
    assert second.result == {"solved": 24}
    points = read_sweep(place).points
    assert {number: points[number].seconds for number in kept} == kept


@pytest.mark.slow
def test_a_refused_point_has_its_reason_and_no_number(folder):
    view = sweep_answers.seen(str(folder), "bearing.first_break", TABLE)
    assert view.counts == {"solved": 1, "failed": 3}
    refused = [point for point in view.chart.points if point.state == "failed"]
    assert [point.value for point in refused] == [None, None, None]
    assert ["elements" in refused[0].texts[-1], "bore" in refused[1].texts[-1]] == [True, True]
    assert [point.number for point in refused] == [1, 2, 3]
    (marked,) = (trace for trace in view.figure["data"] if trace.get("name") == "3 failed")
    places = list(zip(marked["x"], marked["y"], strict=True))
    assert places == [point.place for point in refused]
    told = " ".join(one.text for one in view.warnings if "no result" in one.text)
    assert ["elements" in told, "bore" in told] == [True, True]
    (coloured,) = (trace for trace in view.figure["data"] if trace.get("colorscale") == "Viridis")
    assert sum(value is None for row in coloured["z"] for value in row) == 3


@pytest.mark.slow
@pytest.mark.parametrize(
    "other",
    [
        {"case": CASE, "vary": {"bearing": dict(reversed(VARY["bearing"].items()))}},
        {"case": CASE, "vary": {"bearing": VARY["bearing"] | {"bore": BORE}}},
        {"case": {**CASE, "bearing": CASE["bearing"] | {"radial_load": "1801 N"}}, "vary": VARY},
    ],
    ids=["order", "range", "case"],
)
def test_a_folder_with_another_sweep_is_not_shown_as_the_one_that_is_asked_for(folder, other):
    assert sweep_answers.seen(str(folder), "bearing.first_break", TABLE) is not None
    assert sweep_answers.seen(str(folder), "bearing.first_break", other) is None
    with pytest.raises(InputError, match="replaced by another"):
        sweep_answers.point(str(folder), other, 0)


@pytest.mark.slow
def test_warnings_of_a_map_have_no_codes(folder):
    told = sweep_answers.seen(str(folder), "bearing.first_break", TABLE).warnings
    assert [one.text for one in told if one.text.startswith("At 1 of 1 solved points: ")]
    assert not any(code in one.text for one in told for code in CODES if "-" in code)


@pytest.mark.slow
@pytest.mark.gate
def test_the_map_has_the_numbers_of_the_summaries(folder):
    view, results = sweep_answers.seen(str(folder), "bearing.capacitance", TABLE), read_sweep(folder)
    factor = {"Capacitance of the bearing [pF]": 1e12, "Capacitance of the bearing [nF]": 1e9}[
        view.chart.title
    ]
    for drawn, point in zip(view.chart.points, results.points, strict=True):
        if point.solved:
            capacitance = point.summary["bearing"]["capacitance"]
            assert drawn.value == pytest.approx(capacitance * factor, rel=1e-12)
            assert drawn.margin == point.summary["bearing"]["margin"]
    errors = [point.summary["bearing"]["film_error"] for point in results.points if point.solved]
    assert f"{100.0 * max(errors):.2g} %" in view.accuracy
    json.dumps(view.figure, allow_nan=False)


@pytest.mark.slow
def test_links_reproduce_the_results_of_the_points_exactly(folder):
    results = read_sweep(folder)
    for point in results.points:
        if point.number > 1:
            with pytest.raises(InputError, match=r"bearing\.bore"):
                sweep_answers.point(str(folder), TABLE, point.number)
            continue
        link = sweep_answers.point(str(folder), TABLE, point.number)
        table = Inputs.of_query(parse_qsl(link.query)).table
        assert link.path == "/"
        assert table["bearing"]["temperature"] == "70 degC"
        case = case_of_dict(table, written=True)
        assert case_key(case) == case_key(results.case.replace(point.inputs))
        outcome = solve_point(case.to_dict())
        assert (outcome.status, outcome.reason) == (point.status, point.reason)
        assert without_time(outcome.summary or {}) == without_time(point.summary or {})


@each(
    "key, ends, count, most",
    [
        ("bearing.inner_speed", ("300 rpm", "6000 rpm"), 5, 24),
        ("bearing.radial_load", ("1 kN", "3 kN"), 5, 7),
        ("bearing.temperature", ("40 degC", "80 degC"), 5, 7),
        ("bearing.composite_rq", ("0.02 um", "0.06 um"), 3, 7),
    ],
)
def test_a_point_has_the_unit_of_its_range_where_that_has_the_same_number(key, ends, count, most):
    """Exact: a text that reads back as another float would be another case."""
    _, name = key.split(".")
    vary = {"bearing": {name: {"from": ends[0], "to": ends[1], "count": count}}}
    asked, unit = sweep_answers.sweep_of({"case": CASE, "vary": vary}), ends[0].partition(" ")[2]
    texts = [sweep_answers._text(key, value, unit) for value in asked.axes[key]]
    assert [kind_of(key).parse(text, written=True) for text in texts] == list(asked.axes[key])
    assert texts[0] == ends[0]
    assert texts[-1] == ends[1]
    assert all(text.endswith((unit, unit_of(key))) for text in texts)
    assert max(map(len, texts)) <= most


def test_a_link_has_the_varied_load_and_not_the_pressure_that_it_replaces():
    contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "entrainment_speed": "4 m/s"}
    table = {"contact": contact | {"max_hertz_pressure": "1 GPa"}, "lubricant": {"base": "paper"}}
    case, inputs = case_of_dict(table, written=True), {"contact.load_per_length": 1.234567890123e6}
    found = Inputs.of_query(parse_qsl(Inputs(sweep_answers.point_table(case, table, inputs)).address())).table
    assert "max_hertz_pressure" not in found["contact"]
    assert case_key(case_of_dict(found, written=True)) == case_key(case.replace(inputs))


def test_the_size_is_told_before_the_run():
    found = sweep_answers.planned(TABLE, 1)
    assert (found.points, found.refused, found.corners) == (4, 2, 4)
    assert "bearing.bore" in found.reason
    assert found.seconds > 0.0


def test_the_first_inputs_can_run():
    found = sweep_answers.choices(CASE)
    assert [one.key for one in found.variables[:2]] == ["bearing.inner_speed", "bearing.radial_load"]
    assert sweep_answers.sweep_of(dict(SWEEP.table)).size == 64


def test_a_bearing_with_a_motor_is_ranked_by_its_margin_on_its_page_too():
    """Its map shows what the capacitances of the motor change; without a motor there is no margin."""
    alone = {name: table for name, table in CASE.items() if name != "motor"}
    assert list(sweep_answers.choices(CASE).values)[:2] == ["bearing.margin", "bearing.first_break"]
    assert next(iter(sweep_answers.choices(alone).values)) == "bearing.first_break"


@pytest.mark.slow
def test_a_line_of_margins_is_compared_with_one(tmp_path):
    vary = {"motor": {"winding_rotor_capacitance": ["5 pF", "20 pF"]}}
    table = {"case": CASE, "vary": vary}
    sweep_answers.solved(table, str(tmp_path / "sweep"), 1, silent)
    view = sweep_answers.seen(str(tmp_path / "sweep"), "bearing.margin", table)
    low, high = view.chart.points
    assert low.value > 2.0 * high.value
    (level,) = (trace for trace in view.figure["data"] if trace.get("name", "").startswith("margin 1 at "))
    assert level["y"] == [1.0, 1.0]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["bearing_6208", "discharge", "oil_contact", "e_axle"])
def test_offered_ranges_are_valid(name):
    table = dict((AXLE if name == "e_axle" else example_inputs(name)).table)
    offered = sweep_answers.choices(table).variables
    assert len(offered) > 5
    for one in offered:
        asked = with_ranges(Inputs({"case": table}), [Range(one.key, one.low, one.high, 2)])
        assert sweep_answers.sweep_of(dict(asked.table)).size == 2


@pytest.mark.parametrize(
    ("vary", "says"),
    [
        ({"bearing": {"radial_load": {"from": "1 N", "to": "2 N", "count": 2501}}}, "2500"),
        (
            {"bearing": {"radial_load": {"from": "2 N", "to": "1 N", "count": 2}}},
            r"vary\.bearing\.radial_load\.to: .*'2 N'",
        ),
        ({"roughness": {"1": {"file": ["/etc/passwd", "/etc/group"]}}}, "uploaded"),
    ],
)
def test_ranges_that_are_refused(vary, says):
    with pytest.raises(InputError, match=says):
        sweep_answers.planned({"case": CASE, "vary": vary}, 1)


def test_files_of_this_machine_are_not_read():
    with pytest.raises(InputError, match=r"^case: "):
        sweep_answers.sweep_of({"case": "/etc/passwd", "vary": VARY})
    with pytest.raises(InputError, match=r"case\.roughness\.1\.file.*uploaded"):
        sweep_answers.sweep_of({"case": {**CASE, "roughness": [{"file": "/etc/passwd"}]}, "vary": VARY})


@pytest.mark.slow
def test_tables_of_an_unfinished_sweep_can_be_downloaded(folder, tmp_path):
    again = tmp_path / "sweep"
    again.mkdir()
    shutil.copy(folder / "sweep.sqlite", again)
    assert {"sweep.sqlite", "sweep.csv", "sweep.nc"} <= set(sweep_answers.files(str(again)))
    assert (again / "sweep.csv").read_bytes() == (folder / "sweep.csv").read_bytes()


@pytest.mark.slow
def test_a_probability_is_shown_of_points_that_were_asked_for_it(tmp_path):
    """A sweep without the samples is another one, whose map is not that of the probability."""
    key, place = "uncertainty.breakdown_probability", str(tmp_path / "sweep")
    base = CASE | {"contacts": "atlas"}
    assert sweep_answers.choices(base).values[key] == "Probability of breakdown"
    ranges = [Range("bearing.inner_speed", "1000 rpm", "9000 rpm", 3)]
    alone = with_ranges(Inputs({"case": base}), ranges)
    asked = sweep_file(with_shown(alone, key, None))
    sweep_answers.solved(dict(asked.table), place, 1, silent)
    assert sweep_answers.seen(place, key, dict(alone.table)) is None
    view = sweep_answers.seen(place, key, dict(asked.table))
    assert view.chart.title == "Probability of breakdown"
    drawn = [point.value for point in view.chart.points]
    assert drawn == sorted(drawn, reverse=True)
    assert drawn == read_sweep(place).values(key).tolist()
    assert key in view.values
    assert 0.0 < sweep_answers.planned(dict(asked.table), 1).seconds < 60.0
