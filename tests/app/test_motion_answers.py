"""Movies of the app: their values are those of motion.nc, which the command writes for the same case."""

import json

import numpy as np
import pytest

from ehlectric.app.charts.motion_charts import history, instants, nodes_shown
from ehlectric.app.compute import motion_answers
from ehlectric.cases.case import Case
from ehlectric.errors import InputError
from ehlectric.motion.result import MotionResult
from ehlectric.motion.stored_run import read_motion
from ehlectric.motion.summary import breakdown_voltages, summary_of
from ehlectric.runtime.progress import silent
from tests.helpers.gate import gated
from tests.helpers.moving_cases import LINE, POINT

DISCHARGE = {"discharge": {"dielectric_strength": "20 V/um"}}
SMALL = {"motion": {"passes": 1.0, "steps": 16, "record": 8}}
TABLES = {"line": LINE | DISCHARGE | SMALL, "point": POINT | DISCHARGE | SMALL}


class StoppedError(Exception):
    """End of a run before its last step, as by a user."""


@pytest.fixture(scope="module", params=TABLES)
def solved(request, tmp_path_factory):
    """Answer of a run, and the run that was stored."""
    folder = tmp_path_factory.mktemp(request.param)
    table = TABLES[request.param]
    answer = motion_answers.run(table, str(folder), silent)
    (place,) = folder.glob("motion-*")
    return answer, MotionResult.of(read_motion(place)), table, folder


@pytest.mark.slow
@pytest.mark.parametrize("solved", gated(TABLES, "line"), indirect=True)
def test_frames_are_those_of_the_file(solved):
    answer, run, _, _ = solved
    chosen, frames = instants(run), answer.movie["frames"]
    nodes = nodes_shown(run, chosen.size)
    assert len(frames) == len(answer.times) == len(answer.texts) == run.frames
    for number in (0, 4, run.frames - 1):
        film = run.values("thickness")[chosen[number]][np.ix_(*nodes)]
        drawn = frames[number]["data"][0]
        values = np.array(drawn["y"] if len(nodes) == 1 else np.transpose(drawn["z"]), dtype=float)
        # The unit is a power of ten, and maps have three digits.
        power = np.round(np.log10(values.ravel()[0] / film.ravel()[0]))
        assert values == pytest.approx(film * 10.0**power, rel=6e-3 if len(nodes) == 2 else 6e-4)


@pytest.mark.slow
def test_line_movie_has_pressure_and_field(solved):
    answer, run, _, _ = solved
    if run.kind.name != "line":
        pytest.skip("a point contact shows its film")
    (nodes,) = nodes_shown(run, run.frames)
    drawn = answer.movie["frames"][5]["data"]
    assert np.array(drawn[1]["y"]) * 1e9 == pytest.approx(run.values("pressure")[5][nodes], rel=1e-3, abs=1.0)
    strength = run.values("strength")[5][nodes]
    assert [value is None for value in drawn[2]["y"]] == np.isnan(strength).tolist()


@pytest.mark.slow
def test_marks_are_at_the_extremes(solved):
    answer, run, _, _ = solved
    summary = summary_of(run.dataset)
    films = run.values("minimum_thickness")[run.values("frame_step").astype(int)]
    assert answer.at_least_film == int(np.argmin(films))
    least = summary["discharge"]["breakdown_voltage"]
    assert f"breakdown voltage {least:.4g} V" in answer.texts[answer.at_largest_field]
    assert breakdown_voltages(run).min() == least


@pytest.mark.slow
def test_answers_are_json_of_a_bounded_size(solved):
    answer, _, _, _ = solved
    assert len(json.dumps(answer.movie, allow_nan=False)) < 2_000_000
    assert len(json.dumps(answer.history, allow_nan=False)) < 300_000
    assert answer.complete
    assert not answer.failure


@pytest.mark.slow
def test_history_meets_the_recorded_instants(solved):
    _, run, _, _ = solved
    drawn = {trace["name"]: trace for trace in history(run)["data"]}
    line, dots = drawn["breakdown voltage"], drawn["breakdown voltage, recorded"]
    assert np.interp(dots["x"], line["x"], line["y"]) == pytest.approx(dots["y"], rel=1e-3)


@pytest.mark.slow
def test_stored_motion_is_read_again(solved):
    answer, _, table, folder = solved
    assert motion_answers.stored(table, str(folder)) == answer
    assert motion_answers.stored(table | {"title": "other"}, str(folder)) is None


@pytest.mark.slow
def test_a_stopped_run_is_shown_as_incomplete_and_resumed(tmp_path):
    table = TABLES["line"]

    def stop(done, _of, _text):
        if done >= 6:
            raise StoppedError

    with pytest.raises(StoppedError):
        motion_answers.run(table, str(tmp_path), stop)
    part = motion_answers.stored(table, str(tmp_path))
    assert not part.complete
    assert 1 < len(part.times) < 9
    done = []
    whole = motion_answers.run(table, str(tmp_path), lambda done_, _of, text: done.append((done_, text)))
    assert whole.complete
    assert min(number for number, text in done if text == "time steps") >= 6


@pytest.mark.slow
def test_runs_of_other_inputs_are_removed(tmp_path):
    for height in ("20 nm", "30 nm"):
        rough = [LINE["roughness"][0] | {"height": height}]
        table = TABLES["line"] | {"roughness": rough, "motion": {"passes": 0.1, "steps": 2, "record": 2}}
        motion_answers.run(table, str(tmp_path), silent)
    assert len(list(tmp_path.glob("motion-*"))) == 1


@pytest.mark.slow
def test_halved_steps_are_marked(solved):
    _, run, _, _ = solved
    dataset = run.dataset.copy(deep=True)
    dataset["halvings"].values[7] = 2
    drawn = history(MotionResult.of(dataset))
    (marks,) = [trace for trace in drawn["data"] if "halved" in trace["name"]]
    assert len(marks["x"]) == 1
    assert drawn["layout"]["showlegend"]


@pytest.mark.slow
def test_many_instants_are_thinned_with_the_extremes(solved, monkeypatch):
    _, run, _, _ = solved
    monkeypatch.setattr("ehlectric.app.charts.motion_charts.MOST_INSTANTS", 5)
    monkeypatch.setattr("ehlectric.app.charts.motion_charts.MOST_INSTANTS_OF_MAPS", 5)
    chosen = instants(run)
    assert chosen.size <= 5
    assert int(np.argmax(run.values("max_strength"))) in chosen


def test_a_case_without_motion_is_refused(tmp_path):
    table = {key: value for key, value in LINE.items() if key != "motion"}
    with pytest.raises(InputError, match="motion: missing"):
        motion_answers.run(table, str(tmp_path), silent)
    assert Case.from_dict(table).motion is None
