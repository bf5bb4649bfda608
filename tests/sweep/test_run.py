"""run_sweep: what is solved and saved, in which order, and what goes on where a run has stopped."""

import math
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext

import pytest

from ehlectric import InputError, read_sweep, run_sweep, solve
from ehlectric.errors import LostError
from ehlectric.runtime.worker_processes import Crew, crew_of
from ehlectric.sweep.engine import solve_point
from ehlectric.sweep.run import solve_to_folder
from tests.helpers.sweeps import CASE, LOAD, NODES, PRESSURE, SPEED, speeds, sweep_over


class Solving(ThreadPoolExecutor):
    """One thread that notes which cases it is given, and is gone after so many."""

    def __init__(self, most=10**9):
        super().__init__(1)
        self.cases, self.most = [], most

    def submit(self, call, *values):
        if len(self.cases) == self.most:
            raise RuntimeError("gone")
        self.cases.append(values[0])
        return super().submit(call, *values)


def solved_by(sweep, folder, most=10**9):
    """Results of a sweep, and the speeds of the points that were solved for it."""
    with Solving(most) as executor:
        try:
            return run_sweep(sweep, folder, executor), [
                c["contact"]["entrainment_speed"] for c in executor.cases
            ]
        except LostError:
            return None, [case["contact"]["entrainment_speed"] for case in executor.cases]


@pytest.mark.slow
@pytest.mark.gate
def test_points_are_the_solutions_of_their_cases(tmp_path):
    told = []
    sweep = sweep_over({SPEED: [1.0, 2.0], PRESSURE: ["0.5 GPa", "1 GPa"]})
    with ThreadPoolExecutor(1) as executor:
        results = run_sweep(sweep, tmp_path / "new" / "folder", executor, lambda *values: told.append(values))
    assert [point.inputs for point in results.points] == list(sweep.points())
    for point in results.points:
        alone = solve(CASE.replace(point.inputs)).summary()
        assert {**point.summary, "seconds": None} == {**alone, "seconds": None}
        assert (point.status, point.reason) == ("solved", "")
    assert [done for done, _, _ in told] == sorted(done for done, _, _ in told)
    assert (told[0], told[-1]) == ((0, 4, ""), (4, 4, ""))
    names = sorted(path.name for path in (tmp_path / "new" / "folder").iterdir())
    assert names == ["sweep.csv", "sweep.nc", "sweep.parquet", "sweep.sqlite"]
    assert read_sweep(tmp_path / "new" / "folder") == results


@pytest.mark.slow
@pytest.mark.gate
def test_a_sweep_that_was_stopped_goes_on(tmp_path):
    first, begun = solved_by(speeds(6), tmp_path, most=4)
    assert (first, begun) == (None, [1.0, 2.0, 3.0, 4.0])
    saved = [point.inputs[SPEED] for point in read_sweep(tmp_path).points if point.solved]
    assert set(saved) < {1.0, 2.0, 3.0, 4.0}
    # No tables of a sweep that has not come to its end.
    assert sorted(path.name for path in tmp_path.iterdir()) == ["sweep.sqlite"]
    results, rest = solved_by(speeds(6), tmp_path)
    assert rest == [speed for speed in (1.0, 2.0, 3.0, 4.0, 5.0, 6.0) if speed not in saved]
    assert all(point.solved for point in results.points)
    again, nothing = solved_by(speeds(6), tmp_path)
    assert (again, nothing) == (results, [])


@pytest.mark.slow
@pytest.mark.gate
def test_a_changed_sweep_solves_what_it_does_not_share(tmp_path):
    solved_by(speeds(3), tmp_path)
    results, rest = solved_by(speeds(5), tmp_path)
    assert rest == [4.0, 5.0]
    assert len(results.points) == 5
    # The title is no part of a case's solution.
    renamed = speeds(5).model_copy(update={"case": CASE.replace(title="Renamed")})
    results, rest = solved_by(renamed, tmp_path)
    assert rest == []
    assert {point.summary["title"] for point in results.points} == {"Renamed"}


@pytest.mark.slow
def test_points_that_fail_are_rows_and_the_others_are_solved(tmp_path):
    vary = {NODES: [129, 400], "grid.outlet": [2.0, 20.0], "solver.max_iterations": [1, 30]}
    results, rest = solved_by(sweep_over(vary), tmp_path)
    assert [point.status for point in results.points] == [
        *("not converged", "solved"),
        *("failed", "failed"),
        *("not converged", "solved"),
        *("not converged", "solved"),
    ]
    assert len(rest) == 6
    assert results.points[2].reason.startswith("grid.nodes: got 129 over 24 half-widths")
    assert results.points[0].summary["converged"] is False
    # None of them is tried again.
    assert solved_by(sweep_over(vary), tmp_path) == (results, [])


def test_a_sweep_of_no_cases_is_wrong_input(tmp_path):
    with pytest.raises(InputError, match=r"^vary: no point is a case; of the first, contact\.radius_2: mis"):
        run_sweep(sweep_over({"contact.radius_1": [0.01, 0.02]}), tmp_path / "new")
    with pytest.raises(InputError, match=r"of the first, contact\.load_per_length: got .* together"):
        run_sweep(sweep_over({PRESSURE: [1e9], LOAD: [1e6]}), tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_a_folder_that_cannot_be_made(tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match=r"file: cannot be written to, it is no folder$"):
        run_sweep(speeds(1), tmp_path / "file")


def test_two_sweeps_in_one_folder(tmp_path):
    """The second is refused while the first solves; it changes nothing."""
    refused = []

    def submit(call, *values):
        if not refused:
            with pytest.raises(InputError, match="is being written to by another ehlectric") as told:
                run_sweep(speeds(9), tmp_path)
            refused.append(told)
        return threads.submit(call, *values)

    with ThreadPoolExecutor(1) as threads:
        results = solve_to_folder(speeds(2), tmp_path, solvers=nullcontext(Crew(submit, lambda: 2))).result
    assert refused
    assert [point.status for point in results.points] == ["solved", "solved"]


def test_what_holds_the_crew_up_is_told(tmp_path):
    told = []
    with ThreadPoolExecutor(1) as threads:
        crew = Crew(crew_of(threads).submit, lambda: 2, waiting=lambda: "no workers yet")
        vary = {"solver.max_iterations": [1, 30]}
        solve_to_folder(
            sweep_over(vary), tmp_path, lambda *values: told.append(values), solvers=nullcontext(crew)
        )
    assert told[0] == (0, 2, "no workers yet")
    assert told[-1] == (2, 2, "1 not converged, no workers yet")


def test_progress_while_nothing_finishes(tmp_path, monkeypatch):
    """Somebody who waits for a cluster is told so again and again."""
    monkeypatch.setattr("ehlectric.runtime.tasks._PULSE", 0.01)
    told = []

    def submit(call, *values):
        return threads.submit(slowly, call, *values)

    def slowly(call, *values):
        while len(told) < 5:
            time.sleep(0.001)
        return call(*values)

    with ThreadPoolExecutor(1) as threads:
        progress = lambda *values: told.append(values)  # noqa: E731
        solve_to_folder(speeds(1), tmp_path, progress, solvers=nullcontext(Crew(submit, lambda: 2)))
    assert told[:5] == [(0, 1, "")] * 5
    assert told[-1] == (1, 1, "")


@pytest.mark.slow
def test_rough_surfaces_vary(tmp_path):
    """A film over a higher ridge is thinner, and the file of a surface enters by what it holds."""
    heights = [1e-8 * math.sin(2.0 * math.pi * k / 50.0) for k in range(500)]
    lines = "\n".join(f"{k * 4e-6:.6f} {height:.6e}" for k, height in enumerate(heights))
    (tmp_path / "surface.txt").write_text(lines)
    rough = {"surface": 1, "file": str(tmp_path / "surface.txt"), "x_unit": "m", "z_unit": "m"}
    case = CASE.replace({"roughness": [rough], "grid.nodes": 257})
    sweep = sweep_over({"roughness.1.rescale_rq": ["5 nm", "20 nm"]}).model_copy(update={"case": case})
    results, rest = solved_by(sweep, tmp_path / "out")
    assert len(rest) == 2
    low, high = (point.summary["film"]["minimum_thickness"] for point in results.points)
    assert high < low
    (tmp_path / "surface.txt").write_text(lines + "\n")
    _, rest = solved_by(sweep, tmp_path / "out")
    assert len(rest) == 2


def test_solve_point_is_what_is_submitted(tmp_path):
    """Importable, with plain data: what any executor, on any machine, can be handed."""
    calls = []

    def submit(call, *values):
        calls.append((call, *values))
        return threads.submit(call, *values)

    with ThreadPoolExecutor(1) as threads:
        solve_to_folder(speeds(1), tmp_path, solvers=nullcontext(Crew(submit, lambda: 1)))
    assert calls == [(solve_point, CASE.replace({SPEED: 1.0}).to_dict())]


@pytest.mark.slow
def test_a_sweep_may_be_tables_or_a_file_and_nothing_else(tmp_path):
    tables = {"case": CASE, "vary": {SPEED: [1.0, 2.0]}, "design": "grid"}
    results = run_sweep(tables, tmp_path / "tables", workers=1)
    assert [point.inputs for point in results.points] == [{SPEED: 1.0}, {SPEED: 2.0}]
    file = tmp_path / "sweep.toml"
    (tmp_path / "case.toml").write_text(CASE.to_toml(), encoding="utf-8")
    file.write_text(f'case = "case.toml"\n[vary]\n"{SPEED}" = [1.0, 2.0]\n', encoding="utf-8")
    again = run_sweep(str(file), tmp_path / "tables", workers=1)
    assert [point.summary for point in again.points] == [point.summary for point in results.points]
    with pytest.raises(InputError, match=r"^sweep: got 'Case'; expected a Sweep, a dict, or the path of "):
        run_sweep(CASE, tmp_path)
    with pytest.raises(InputError, match=r"^progress: got True; expected a function of done, of and text"):
        run_sweep(tables, tmp_path / "none", progress=True)
    assert not (tmp_path / "none").exists()
