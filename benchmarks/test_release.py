"""What users wait for, recorded once a release: make bench-release; make bench-compare

The reference does not change with ehlectric: divide by it to compare machines.
"""

import subprocess

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from benchmarks.measure import EHLECTRIC, ROOT
from ehlectric import BearingCase, Case, DriveCase, run_sweep, solve

EXAMPLES = ROOT / "examples"


def test_reference(benchmark):
    """Dense linear system of 1500 unknowns on one core, by LAPACK."""
    matrix = np.random.default_rng(1).standard_normal((1500, 1500))
    with threadpool_limits(1):
        benchmark.pedantic(np.linalg.solve, (matrix, matrix[0]), rounds=10, warmup_rounds=1)


@pytest.mark.parametrize("words", [("--version",), ("check", "examples/bearing_6208.toml")], ids=" ".join)
def test_command(benchmark, words):
    def run():
        subprocess.run([EHLECTRIC, *words], cwd=ROOT, check=True, capture_output=True)

    benchmark.pedantic(run, rounds=5, warmup_rounds=1)


@pytest.mark.parametrize(
    ("example", "rounds"),
    [
        ("line_contact", 7),
        ("rough_contact", 5),
        ("ball_contact", 3),
        ("hot_contact", 3),
        ("starved_contact", 2),
        ("mixed_contact", 2),
    ],
    ids=["line", "rough", "ball", "hot", "starved", "mixed"],
)
def test_contact(benchmark, example, rounds):
    case = Case.from_toml(EXAMPLES / f"{example}.toml")
    assert benchmark.pedantic(solve, (case,), rounds=rounds, warmup_rounds=1).converged


@pytest.mark.parametrize(
    ("contacts", "rounds"),
    [("solved", 2), ("atlas", 5), ("formula", 5)],
    ids=["solved", "atlas", "formula"],
)
def test_bearing(benchmark, contacts, rounds):
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": contacts})
    assert benchmark.pedantic(solve, (case,), rounds=rounds, warmup_rounds=rounds > 2).converged


def test_drive(benchmark):
    case = DriveCase.from_toml(EXAMPLES / "drive.toml")
    benchmark.pedantic(solve, (case,), rounds=3, warmup_rounds=1)


def test_sweep(benchmark, tmp_path):
    """The 30 contacts of the example, on all cores."""
    folders = (tmp_path / str(k) for k in range(10))

    def run():
        return run_sweep(EXAMPLES / "sweep.toml", next(folders))

    assert len(benchmark.pedantic(run, rounds=2, warmup_rounds=1).points) == 30
