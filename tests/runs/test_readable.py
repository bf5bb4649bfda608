"""Every save checks that load accepts the file: an error names what is wrong, and all values are written."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric import Case, load, save, solve
from ehlectric.bearing.result import BearingResult
from ehlectric.errors import UnreadableError
from ehlectric.film.mesh import Mesh, Width
from ehlectric.film.patch import Joined
from ehlectric.motion.run import run_motion
from ehlectric.motion.storage import MotionJournal
from ehlectric.runtime.netcdf import read_dataset
from ehlectric.sweep.engine import Outcome
from ehlectric.sweep.store import Store
from tests.helpers.drives import drive_with_remedy
from tests.helpers.moving_cases import moving

LINE = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "max_hertz_pressure": "1 GPa"}
BEARING = {
    "base": "6208",
    "radial_load": "1 kN",
    "inner_speed": "3000 rpm",
    "temperature": "70 degC",
    "radial_clearance": "10 um",
    "composite_rq": "0.03 um",
}


def refused(result, folder, says, name):
    """The result is refused for a reason, and its file has all variables."""
    with pytest.raises(UnreadableError, match=says):
        save(result, folder)
    assert (folder / "summary.json").is_file()
    assert len(read_dataset(folder / name).variables) > 5


def test_a_contact_that_load_would_refuse(tmp_path):
    result = solve(Case.line(**LINE, entrainment_speed="4 m/s", lubricant="paper", grid={"nodes": 401}))
    save(result, tmp_path)
    assert load(tmp_path) == result
    pressure = result.film.pressure.copy()
    pressure[3] = -4e-16
    wrong = replace(result, film=replace(result.film, pressure=pressure))
    refused(wrong, tmp_path, r"result\.nc: is written.* pressure is negative, -4e-16; no number", "result.nc")
    assert (tmp_path / "film.csv").is_file()


def test_a_bearing_that_load_would_refuse(tmp_path):
    oil = {"base": "paper", "viscosity": "20 mPa s"}
    result = solve({"contacts": "formula", "bearing": BEARING, "lubricant": oil})
    first, *others = result.solution.positions
    load_ = first.inner.load.copy()
    load_[0] = -1e-13
    first = replace(first, inner=replace(first.inner, load=load_))
    wrong = BearingResult(replace(result.solution, positions=(first, *others)))
    refused(wrong, tmp_path, r"bearing\.nc: is written.* load is negative, -1e-13", "bearing.nc")


@pytest.mark.slow
def test_a_drive_that_load_would_refuse(tmp_path):
    result = solve(drive_with_remedy())
    record = replace(result.solution.record, rms=-result.solution.record.rms)
    wrong = replace(result, solution=replace(result.solution, record=record))
    refused(wrong, tmp_path, r"drive\.nc: is written.* rms_voltage is negative, -", "drive.nc")


@pytest.mark.slow
@pytest.mark.gate
def test_an_instant_that_load_would_refuse_is_not_written(tmp_path, monkeypatch):
    """The instants before it can be loaded."""
    right = MotionJournal._frame

    def frame(self, record):
        found = right(self, record)
        return replace(found, pressure=found.pressure - 1e12) if record.step else found

    monkeypatch.setattr(MotionJournal, "_frame", frame)
    with pytest.raises(
        UnreadableError, match=r"motion\.nc: does not get the instant at step \d+.* pressure is neg"
    ):
        run_motion(moving(), tmp_path)
    assert load(tmp_path).dataset.sizes["frame"] == 1


def test_a_point_of_a_sweep_that_no_file_can_contain(tmp_path):
    """The sweep stays readable; the point keeps its other numbers, and says what is missing."""
    from ehlectric import Sweep, read_sweep
    from ehlectric.sweep.engine import planned_point

    table = {"contact": LINE | {"entrainment_speed": "4 m/s"}, "lubricant": {"base": "paper"}}
    sweep = Sweep.from_dict({"case": table, "vary": {"contact.entrainment_speed": ["1 m/s", "2 m/s"]}})
    planned = [planned_point(sweep, k, inputs) for k, inputs in enumerate(sweep.points())]
    summary = {"film": {"minimum_thickness": 1e-7, "residual": 2e40}, "warnings": [], "warning_codes": []}
    with Store(tmp_path) as store:
        store.begin(sweep, planned)
        store.write([(point.key, Outcome("solved", summary=summary)) for point in planned])
    for point in read_sweep(tmp_path).points:
        assert point.summary["film"] == {"minimum_thickness": 1e-7, "residual": None}
        assert [warning.code for warning in point.warnings] == ["number-not-stored"]
        assert "film.residual is 2e+40" in point.warnings[0].text
        assert point.doubtful


def test_values_around_a_patch_stay_within_their_bounds():
    """Monotone cubics leave the bounds of a share by their rounding: 1e-16 below 0 and above 1."""
    coarse = Mesh.over(33, -3.0, 2.0, Width(33, 2.0))
    fine = Mesh.over(41, coarse.x[8], coarse.x[28], Width(41, float(coarse.y[8])))
    beside = coarse.whole_y[coarse.whole_y >= fine.y[-1] - 1e-9]
    joined = Joined(
        coarse,
        fine,
        np.concatenate([coarse.x[:9], fine.x[1:-1], coarse.x[28:]]),
        np.concatenate([-beside[::-1], fine.whole_y[1:-1], beside]),
        (9, beside.size),
    )
    random = np.random.default_rng(3)
    for _ in range(20):
        values = np.clip(random.normal(0.5, 1.0, coarse.shape), 0.0, 1.0)
        found = joined(values, np.full(fine.shape, 0.5))
        assert found.min() >= 0.0
        assert found.max() <= 1.0
