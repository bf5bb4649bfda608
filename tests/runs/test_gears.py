"""Gear pairs among all that is solved, saved and exported."""

import openpyxl
import pytest
import scipy

from ehlectric import InputError, export, save, solve, solve_gear, solve_many
from ehlectric.runs.by_kind import run_bearing
from ehlectric.runs.result_folders import files_of_results
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.gears import helical_case, spur_case


@pytest.fixture(scope="module")
def spur():
    return solve_gear(spur_case())


@pytest.mark.parametrize("workers", [1, 2])
def test_many_gear_pairs_are_solved(workers, spur):
    cases = [spur_case(), spur_case().to_dict(), spur_case(**{"gear.operation.pinion_torque": "100 N m"})]
    solved = sorted(solve_many(cases, workers=workers))
    assert [one.number for one in solved] == [0, 1, 2]
    assert [one.error for one in solved] == [None] * 3
    assert solved[0].result == solved[1].result == spur
    # A smaller load has a lower pressure: p_H grows as the root of the line load.
    pressures = [one.result.summary()["points"]["C"]["max_pressure"] for one in solved]
    assert pressures[2] / pressures[0] == pytest.approx((100.0 / 215.6) ** 0.5, rel=1e-3)


def test_an_error_of_a_pair_ends_no_other(spur):
    impossible = spur_case(**{"gear.tip_diameter": ["76 mm", "112 mm"]})
    first, second = sorted(solve_many([impossible, spur_case()], workers=1))
    assert isinstance(first.error, InputError)
    assert second.result == spur


def test_options_of_other_cases_are_refused():
    with pytest.raises(InputError, match=r"^solvers: got 'paper'; expected 'ehlectric' for a gear pair"):
        solve(spur_case(), solvers="paper")


def test_progress_and_warnings_are_reported(caplog):
    texts = []
    result = solve(helical_case(), progress=lambda *state: texts.append(state[-1]))
    assert texts == ["solving films"]
    # Notes are not logged.
    warnings = [each.text for each in result.warnings if each.severity != "note"]
    assert warnings
    for text, logged in zip(warnings, caplog.messages, strict=True):
        assert text in logged


def test_files_of_gears_belong_to_results(tmp_path):
    names = files_of_results(tmp_path)
    assert {"gear.nc", "path.csv", "mesh.csv", "gear_path.png", "gear_flank.svg"} <= {*names}


def test_a_result_of_another_kind_removes_the_files_of_a_gear_pair(spur, tmp_path):
    save(spur, tmp_path)
    run_bearing(bearing_case(BALLS, contacts="formula"), tmp_path)
    assert not (tmp_path / "gear.nc").exists()
    assert not (tmp_path / "path.csv").exists()


def test_a_gear_pair_is_exported(spur, tmp_path):
    save(spur, tmp_path)
    values = scipy.io.loadmat(export(tmp_path, tmp_path / "gear.mat"), squeeze_me=True)
    assert values["film_minimum"] == pytest.approx(spur.solution.films.minimum)
    book = openpyxl.load_workbook(export(spur, tmp_path / "gear.xlsx"))
    heads, *rows = book["table"].iter_rows(values_only=True)
    assert [row[0] for row in rows] == list("ABCDE")
    column = heads.index("max_pressure [MPa]")
    assert rows[2][column] == pytest.approx(1e-6 * spur.summary()["points"]["C"]["max_pressure"])
    inputs = {row[0]: row for row in book["inputs"].iter_rows(values_only=True)}
    assert inputs["gear.operation.pinion_speed"][2:4] == (pytest.approx(2250.0), "rpm")
    with pytest.raises(InputError):
        export(spur, tmp_path / "gear.vtkhdf")


def test_a_notebook_shows_the_table(spur):
    html = spur._repr_html_()
    assert "FZG type C" in html
    assert "capacitance of the mesh" in html
    assert "gear.normal_module" in spur.case._repr_html_()
