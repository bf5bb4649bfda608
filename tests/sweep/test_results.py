"""Values of sweeps by key, and their summary."""

import numpy as np
import pytest

from ehlectric import BearingCase, InputError, Sweep, run_sweep
from tests.helpers.bearings import BALLS
from tests.helpers.each import each
from tests.helpers.sweep_models import LOAD, SPEED, grid

VOLTAGE = "discharge.breakdown_voltage"


def failing(inputs):
    return "failed" if inputs[SPEED] == 1.0 else "solved"


@pytest.fixture
def results():
    return grid({SPEED: (1.0, 2.0), LOAD: (1e6, 2e6)}, status=failing)


@each(
    ("key", "nearest"),
    [
        ("film.min", "film.minimum_thickness"),
        ("discharge.breakdown_volt", VOLTAGE),
        ("minimum_thickness", "film.minimum_thickness"),
        ("field", "field.voltage"),
    ],
)
def test_an_unknown_key_is_refused(results, key, nearest):
    """It gave an array of NaN, as a point that is not solved does."""
    with pytest.raises(InputError) as caught:
        results.values(key)
    assert caught.value.key == key
    assert nearest in str(caught.value)


def test_values_of_known_keys(results):
    voltage = results.values(VOLTAGE)
    assert np.isnan(voltage).tolist() == [True, True, False, False]
    assert voltage[2] == pytest.approx(10.0 * 0.5**0.7)
    # Documented, though these points have none.
    assert np.isnan(results.values("field.max_strength")).all()


def test_values_of_varied_keys(results):
    assert results.values(SPEED).tolist() == [1.0, 1.0, 2.0, 2.0]


def test_a_key_is_known_before_any_point_is_solved():
    results = grid({SPEED: (1.0, 2.0)}, status=lambda _: "open")
    assert np.isnan(results.values(VOLTAGE)).all()
    with pytest.raises(InputError, match="unknown key"):
        results.values("film.min")


def test_summary_counts_the_points(results):
    summary = results.summary()
    assert (summary["points"], summary["solved"], summary["failed"], summary["open"]) == (4, 2, 2, 0)
    assert summary["varied"] == [SPEED, LOAD]
    assert "2 solved, 2 failed" in repr(results)


def test_frame_is_the_sweep(results):
    frame = results.to_dataframe()
    assert frame[SPEED].tolist() == [1.0, 1.0, 2.0, 2.0]
    assert frame["status"].tolist() == ["failed", "failed", "solved", "solved"]
    assert frame.attrs["units"][LOAD] == "N/m"


def test_results_are_compared_by_their_points(results):
    assert results == grid({SPEED: (1.0, 2.0), LOAD: (1e6, 2e6)}, status=failing)
    assert results != grid({SPEED: (1.0, 2.0), LOAD: (1e6, 2e6)})


@pytest.mark.slow
@pytest.mark.gate
def test_a_sweep_is_read_back_from_its_file(results, tmp_path):
    """Also a rotational speed, which a file takes with its unit alone."""
    speeds = {"bearing.inner_speed": ["1000 rpm", "2000 rpm"]}
    bearing = BearingCase.from_dict({**BALLS, "contacts": "formula"})
    turning = run_sweep(Sweep.from_dict({"case": bearing, "vary": speeds}), tmp_path / "sweep", workers=1)
    for sweep in (results, turning):
        file = tmp_path / "again.toml"
        file.write_text(sweep.to_toml(), encoding="utf-8")
        again = Sweep.from_toml(file)
        assert again.case == sweep.case
        assert list(again.points()) == [pytest.approx(point.inputs) for point in sweep.points]
