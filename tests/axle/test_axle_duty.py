"""Duty cycle of an axle: rows against single axles, shares of time by hand, files, and what is refused."""

import json
from dataclasses import replace

import numpy as np
import pytest

from ehlectric import AxleCase, InputError, figure, load, save, solve_axle
from ehlectric.axle import AxleDuty
from ehlectric.axle.axle_duty import run_axle_duty
from tests.axle.axles import two_stages
from tests.helpers.each import each

CYCLE = """time [s],speed [rpm],torque [N m],note
0,0,0,start
1,4000,30,
3,14000,30,
4,14000,0,
5,-14000,-30,
9,14000,30,
"""


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    path = tmp_path_factory.mktemp("duty") / "cycle.csv"
    path.write_text(CYCLE, encoding="utf-8")
    return two_stages(remedies=[], duty={"file": str(path)})


@pytest.fixture(scope="module")
def result(case):
    return solve_axle(case, probable=False)


def by_hand():
    """Two elements over four seconds: the first one touches at the second row, and conducts at the third."""
    return AxleDuty(
        source="cycle.csv",
        names=("a", "b"),
        keys=("a", "b"),
        time=np.array([0.0, 1.0, 2.0, 3.0, 4.0]),
        speed=np.array([100.0, 100.0, 100.0, 0.0, 100.0]),
        torque=np.ones(5),
        temperature=np.full(5, 350.0),
        voltages=np.array([[4.0, 1.0], [4.0, 1.0], [0.0, 1.0], [np.nan, np.nan], [np.nan, np.nan]]),
        limits=np.array([[2.0, 2.0], [0.0, 2.0], [np.inf, 0.5], [np.nan, np.nan], [np.nan, np.nan]]),
        states=np.array([[3, 3], [2, 3], [1, 3], [0, 0], [0, 0]]),
        points=3,
    )


def test_shares_of_time_by_hand():
    """Rows count 0.5, 1, 1, 1 and 0.5 of four seconds."""
    table = by_hand().summary()
    assert (table["duration"], table["standstill_share"], table["left_out_share"]) == (4.0, 0.25, 0.125)
    first, second = table["elements"]
    assert (first["first_share"], second["first_share"]) == (0.375, 0.25)
    assert (first["breakdown_share"], second["breakdown_share"]) == (0.375, 0.25)
    assert (first["touching_share"], first["conducting_share"], second["insulating_share"]) == (
        0.25,
        0.25,
        0.625,
    )
    assert (first["largest_ratio"], first["largest_time"]) == (2.0, 0.0)
    assert (second["largest_ratio"], second["largest_time"]) == (2.0, 2.0)
    assert by_hand().statement.values["elements"][0] == "a 38 %"


@each("times", [0.01, 100.0])
def test_shares_depend_on_ratios_of_voltages_only(times):
    duty = by_hand()
    other = replace(duty, voltages=times * duty.voltages, limits=times * duty.limits)
    assert other.summary()["elements"] == duty.summary()["elements"]


@pytest.mark.slow
@pytest.mark.gate
def test_rows_are_single_axles(result, case):
    """Equal operating points are solved once; a standstill has no result, and a torque of 0 is left out."""
    duty = result.duty
    assert duty.points == 4
    assert duty.known.tolist() == [False, True, True, False, True, True]
    assert duty.standing.tolist() == [True, False, False, False, False, False]
    assert any("drive.torque" in str(warning) for warning in duty.warnings)
    for row, changes in (
        (1, {"drive.speed": "4000 rpm"}),
        (4, {"drive.speed": "-14000 rpm", "drive.torque": -30.0}),
    ):
        alone = solve_axle(case.replace(changes | {"duty": None}), probable=False)
        for number, element in enumerate(alone.summary()["elements"]):
            assert duty.voltages[row, number] == pytest.approx(element["voltage"], rel=1e-7)
            ratio = element["voltage_ratio"]
            if ratio:
                assert duty.ratios[row, number] == pytest.approx(ratio, rel=1e-7)


@pytest.mark.slow
def test_files_of_a_cycle(result, tmp_path):
    files = {path.name for path in save(result, tmp_path)}
    assert {"axle.nc", "duty.csv", "summary.json"} <= files
    heads, *rows = (tmp_path / "duty.csv").read_text("utf-8").splitlines()
    assert "mesh_1.voltage [V]" in heads.split(",")
    assert len(rows) == 6
    loaded = load(tmp_path)
    table = json.loads((tmp_path / "summary.json").read_text("utf-8"))["duty"]
    assert loaded.duty.summary() == result.duty.summary()
    assert table["elements"] == result.duty.summary()["elements"]
    assert "axle-duty" in [reason.code for reason in loaded.verdict.reasons]
    assert len(figure(loaded, "axle_duty").axes) == 3


def test_file_names_are_relative_to_the_file(tmp_path):
    (tmp_path / "cycle.csv").write_text(CYCLE, encoding="utf-8")
    path = tmp_path / "axle.toml"
    path.write_text(two_stages(remedies=[]).to_toml() + '\n[duty]\nfile = "cycle.csv"\n', encoding="utf-8")
    assert AxleCase.from_toml(path).duty.file == str(tmp_path / "cycle.csv")
    assert run_axle_duty(two_stages(remedies=[])) is None


@each(
    ("text", "message"),
    [
        ("time [s],speed [rpm]\n0,1\n0,2\n", "increases"),
        ("time [s],speed [m]\n0,1\n1,2\n", "speed"),
        ("speed [rpm]\n1\n2\n", "time"),
        ("time [s],torque [N m]\n0,1e9\n1,2\n", "torque"),
    ],
)
def test_wrong_cycles_are_refused(text, message, tmp_path):
    (tmp_path / "cycle.csv").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=message):
        solve_axle(two_stages(remedies=[], duty={"file": str(tmp_path / "cycle.csv")}))
