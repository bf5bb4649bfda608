"""Rating life over a duty cycle: the rule of Palmgren and Miner by hand, and one number in every output."""

import math

import numpy as np
import pytest

from ehlectric import load, save, solve_bearing, write_report
from ehlectric.bearing import duty_points
from ehlectric.bearing.cycle_life import LIVES
from ehlectric.bearing.duty_cycle import run_duty
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.runs.preview import preview_of
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.bearings import BALLS, ROLLERS

PRINTED = {"contamination_factor": 0.5, "dynamic_rating": "29.1 kN", "static_rating": "17.9 kN"}
HEADS = "time [s],speed [rpm],radial load [N]"

# The rows stand for 5, 10 and 5 s.
ROWS = """\
0,1000,1000
10,3000,3000
20,3000,500
"""


def case_of(folder, rows=ROWS, heads=HEADS, tables=BALLS, **bearing):
    (folder / "cycle.csv").write_text(f"{heads}\n{rows}")
    bearing = tables["bearing"] | {"axial_load": "0 N", "life": PRINTED} | bearing
    return BearingCase.from_dict(
        {
            **tables,
            "bearing": bearing,
            "contacts": "formula",
            "duty": {"file": str(folder / "cycle.csv")},
        }
    )


def hours_of_cycle(rows, rating, power):
    """Basic life [h] of rows of duration [s], speed [rpm] and load [N]."""
    total = sum(duration for duration, _, _ in rows)
    spent = sum(duration * speed / 60.0 / 1e6 * (load / rating) ** power for duration, speed, load in rows)
    return total / spent / 3600.0


@pytest.mark.slow
@pytest.mark.gate
def test_basic_life_by_hand(tmp_path):
    """The mean load is (sum n t F^3/sum n t)^(1/3) = 2537 N at 2500 rpm, and its basic life 10 060 h."""
    found = run_duty(case_of(tmp_path)).summary()
    rows = [(5.0, 1000.0, 1000.0), (10.0, 3000.0, 3000.0), (5.0, 3000.0, 500.0)]
    assert found["basic_life"] / 3600.0 == pytest.approx(hours_of_cycle(rows, 29_100.0, 3.0), rel=1e-9)
    assert found["equivalent_load"] == pytest.approx(2537.4, rel=1e-4)
    assert found["mean_speed"] == pytest.approx(2500.0 * math.pi / 30.0, rel=1e-9)
    hours = (29_100.0 / found["equivalent_load"]) ** 3 * 1e6 / (2500.0 * 60.0)
    assert found["basic_life"] / 3600.0 == pytest.approx(hours, rel=1e-9)


@pytest.mark.slow
def test_rollers_have_their_exponent(tmp_path):
    life = {"contamination_factor": 0.5, "dynamic_rating": "50 kN"}
    found = run_duty(case_of(tmp_path, tables=ROLLERS, life=life)).summary()
    rows = [(5.0, 1000.0, 1000.0), (10.0, 3000.0, 3000.0), (5.0, 3000.0, 500.0)]
    assert found["basic_life"] / 3600.0 == pytest.approx(hours_of_cycle(rows, 50_000.0, 10 / 3), rel=1e-9)


@pytest.mark.slow
def test_every_life_adds_the_parts_of_its_rows(tmp_path):
    """Each row is the bearing at its inputs; the temperatures differ, and with them viscosity and film."""
    heads = "time [s],speed [rpm],radial load [N],axial load [N],temperature [degC]"
    rows = "0,1000,1500,200,50\n10,-3000,3000,0,70\n30,5000,2500,600,80\n"
    case = case_of(tmp_path, rows, heads, life=PRINTED | {"roughened_rq": "0.2 um"})
    durations, spent = (5.0, 15.0, 10.0), dict.fromkeys(LIVES, 0.0)
    for duration, row in zip(durations, rows.splitlines(), strict=True):
        _, speed, radial, axial, temperature = (float(text) for text in row.split(","))
        point = case.replace(
            {
                "duty": None,
                "bearing.inner_speed": f"{abs(speed)} rpm",
                "bearing.radial_load": radial,
                "bearing.axial_load": axial,
                "bearing.temperature": f"{temperature} degC",
            }
        )
        life = solve_bearing(point).summary(probable=False)["life"]
        for name in LIVES:
            spent[name] += duration / life[name]
    found = run_duty(case).summary()
    for name in LIVES:
        assert found[name] == pytest.approx(30.0 / spent[name], rel=1e-7), name


@pytest.mark.slow
def test_rows_at_rest_use_no_life(tmp_path):
    """As much time at rest as in motion doubles the life in hours."""
    moving = run_duty(case_of(tmp_path, "0,3000,2000\n10,3000,2000\n")).summary()
    rest = run_duty(case_of(tmp_path, "0,3000,2000\n10,3000,2000\n15,0,2000\n25,0,9000\n")).summary()
    # The second row stands for 5 and 2.5 s, the rows at rest for 7.5 and 5 s: 12.5 of 25 s.
    for name in ("basic_life", "reference_modified_life"):
        assert rest[name] == pytest.approx(2.0 * moving[name], rel=1e-9)
    still = run_duty(case_of(tmp_path, "0,0,2000\n10,0,2000\n")).summary()
    assert still["basic_life"] is None
    assert still["mean_speed"] == 0.0


@pytest.mark.slow
def test_revolutions_below_the_standard_make_an_upper_bound(tmp_path):
    """At 5 rpm and 70 degC nu_1 is 45000 5^-0.83 60^-0.5 = 1528 mm^2/s, a hundred times the oil's."""
    case = case_of(tmp_path, "0,5,2000\n10,3000,2000\n")
    result = solve_bearing(case)
    found = result.duty.summary()
    assert found["low_viscosity_share"] == pytest.approx(5.0 / 3005.0, rel=1e-9)
    rows = {row.key: row for row in total_rows(result.summary(probable=False))}
    assert rows["duty.basic_life"].bound == ""
    assert rows["duty.modified_life"].bound == "≤"
    assert rows["duty.low_viscosity_share"].text.endswith("%")
    assert "life-outside" in {one.code for one in result.duty.warnings}


@pytest.mark.slow
def test_without_its_table_there_is_no_life(tmp_path):
    case = case_of(tmp_path)
    table = case.to_dict()
    del table["bearing"]["life"]
    found = run_duty(BearingCase.from_dict(table)).summary()
    assert all(found[name] is None for name in (*LIVES, "equivalent_load", "mean_speed"))


@pytest.mark.slow
def test_interpolated_cycles_have_the_life_of_solved_ones(tmp_path, monkeypatch):
    """1500 different points, interpolated between 1000 or solved; the mean load is exact in both."""
    draw = np.random.default_rng(3)
    columns = [draw.uniform(*ends, 1500) for ends in ((300, 6000), (800, 4000), (50, 90))]
    rows = "".join(f"{k},{a},{b},{c}\n" for k, (a, b, c) in enumerate(zip(*columns, strict=True)))
    case = case_of(tmp_path, rows, "time [s],speed [rpm],radial load [N],temperature [degC]", axial_load=300)
    exact = run_duty(case).lives[0]
    monkeypatch.setattr(duty_points, "MOST_SOLVED", 1000)
    interpolated = run_duty(case)
    quick = interpolated.lives[0]
    assert interpolated.interpolation_error is not None
    assert quick.basic_life == pytest.approx(exact.basic_life, rel=1e-9)
    for name in ("modified_life", "reference_life", "reference_modified_life"):
        assert getattr(quick, name) == pytest.approx(getattr(exact, name), rel=1e-2), name


@pytest.mark.slow
def test_life_of_the_cycle_is_one_number_everywhere(tmp_path):
    """Summary, stored result, table of the command and report; the point has its own life next to it."""
    result = solve_bearing(case_of(tmp_path))
    save(result, tmp_path / "out")
    stored = load(tmp_path / "out")
    assert stored.duty.lives == result.duty.lives
    summary = result.summary(probable=False)
    rows = {row.key: row for row in total_rows(summary)}
    assert rows["duty.basic_life"].text == "10\xa0100 h"
    assert summary["life"]["basic_life"] / 3600.0 == pytest.approx((29.1 / 1.8) ** 3 * 1e6 / 180e3, rel=1e-9)
    (page,) = write_report(tmp_path / "out", tmp_path / "page.html", summary=True)
    text = page.read_text(encoding="utf-8").replace("\xa0", " ")
    # C0/P0 = 17 900 N/3000 N at the largest load.
    assert "Rating life of the duty cycle: P = 2537 N; minimum s0 = 5.97; L10 = 10 100 h" in text
    assert "Rating life at the operating point: C = 29 100 N" in text
    assert "C, C0 given." in text


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("command", ["check", "bearing"])
def test_every_number_states_the_point_or_the_cycle(command, tmp_path):
    case = case_of(tmp_path)
    solved = solve_bearing(case).summary(probable=False)
    rows = preview_of(case).rows if command == "check" else total_rows(solved)
    heading = ""
    for row in rows:
        heading = row.name if row.heading else heading
        if row.key.startswith("duty."):
            assert "duty cycle" in row.name, row.name
        elif row.key and row.key != "seconds":
            assert "operating point" in heading, row.name
