"""Runs with a layer of oil at the inlet: their file and summary, how they resume, what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.contact.conditions import resolve
from ehlectric.errors import ConvergenceError
from ehlectric.film.moving_patch import MovingFilm
from ehlectric.film.unsteady import UnsteadyFilm
from ehlectric.motion.run import solve_to_folder
from ehlectric.motion.stored_run import read_motion
from ehlectric.quantities.results import MOTION_KEYS
from ehlectric.tables.motion_tables import run_rows
from tests.helpers.moving_cases import LINE, POINT, moving
from tests.helpers.starved_motion import line, motion, smooth

LAYER = 200e-9
SHORT = {"passes": 0.5, "record": 3}
CASE = moving(LINE, inlet={"oil_layer": LAYER}, motion=SHORT)


@pytest.fixture(scope="module")
def outcome(tmp_path_factory):
    return solve_to_folder(CASE, tmp_path_factory.mktemp("starved"))


@pytest.mark.slow
def test_the_summary_has_the_layer_and_the_meniscus(outcome):
    film = outcome.summary["film"]
    assert film["oil_layer"] == pytest.approx(LAYER, rel=1e-12)
    inlet = CASE.grid.ends[0] * resolve(CASE).half_width
    assert inlet < film["meniscus_least"] <= film["meniscus_before"] <= film["meniscus_largest"] < 0.0
    keys = MOTION_KEYS["line"]
    assert all(f"film.{name}" in keys for name in film)


@pytest.mark.slow
def test_the_table_has_the_layer_and_the_meniscus(outcome):
    rows = {row.key: str(row.value) for row in run_rows(outcome.summary)}
    assert float(rows["film.oil_layer"]) == pytest.approx(LAYER, rel=1e-12)
    place = outcome.summary["film"]["meniscus_before"] / resolve(CASE).half_width
    assert f"x/b = {place:.3g} before the motion" in rows["film.meniscus_before"]


@pytest.mark.slow
def test_the_flow_through_the_hertz_zone_is_that_of_the_layer(outcome):
    """rho H = H_oil in the middle, and oil is up to a quarter denser there, so that the film is thinner."""
    dataset = outcome.result
    film = dataset["central_thickness"].values
    assert np.all((film < LAYER) & (film > 0.8 * LAYER))


@pytest.mark.slow
def test_the_file_has_the_part_that_oil_fills(outcome):
    """At the inlet edge it is the layer over the gap, and 1 where there is pressure."""
    dataset = outcome.result
    fraction, film = dataset["film_fraction"].values, dataset["thickness"].values
    assert fraction.shape == film.shape
    np.testing.assert_allclose(fraction[:, 0] * film[:, 0], LAYER, rtol=1e-3)
    middle = np.argmin(np.abs(dataset["x"].values))
    np.testing.assert_array_equal(fraction[:, middle], 1.0)
    assert np.all(dataset["meniscus"].values < 0.0)


@pytest.mark.slow
def test_a_stopped_run_goes_on_as_if_it_had_not_been_stopped(outcome, monkeypatch, tmp_path):
    advance, calls = UnsteadyFilm.advance, []

    def failing(self, history, length):
        calls.append(length)
        if len(calls) == 40:
            raise ConvergenceError("stopped")
        return advance(self, history, length)

    monkeypatch.setattr(UnsteadyFilm, "advance", failing)
    assert solve_to_folder(CASE, tmp_path).failure is not None
    monkeypatch.setattr(UnsteadyFilm, "advance", advance)
    assert solve_to_folder(CASE, tmp_path).failure is None
    resumed = read_motion(tmp_path)
    for name in ("central_thickness", "meniscus", "max_pressure"):
        np.testing.assert_array_equal(resumed[name].values, outcome.result[name].values)


@pytest.mark.slow
def test_a_layer_that_floods_the_inlet_is_told(tmp_path):
    case = moving(LINE, inlet={"oil_layer": "20 um"}, motion={"passes": 0.1, "record": 2})
    found = solve_to_folder(case, tmp_path)
    assert found.summary["film"]["meniscus_before"] is None
    assert found.summary["film"]["meniscus_least"] is None
    assert "film_fraction" not in found.result
    assert "oil-layer-thick" in found.summary["warning_codes"]


@pytest.mark.slow
def test_a_point_contact_runs_with_a_layer_over_y(tmp_path):
    """More oil on one side: the film is thicker there, and the contact is solved without symmetry."""
    table = {"y": [-50e-6, 50e-6], "thickness": [80e-9, 160e-9]}
    case = moving(POINT, inlet={"layer_table": table}, motion={"passes": 0.2, "record": 2})
    found = solve_to_folder(case, tmp_path)
    assert found.failure is None
    assert found.summary["film"]["oil_layer"] == pytest.approx(120e-9, rel=1e-9)
    y = found.result["y"].values
    film = found.result.sel(x=0.0, method="nearest")["thickness"].values[-1]
    lower, upper = (film[np.argmin(np.abs(y - at))] for at in (-40e-6, 40e-6))
    assert upper > 1.3 * lower


@pytest.mark.slow
def test_a_layer_thinner_than_the_boundary_film_leaves_the_load_to_asperities(tmp_path):
    found = solve_to_folder(moving(LINE, inlet={"oil_layer": 1e-9}, motion=SHORT), tmp_path)
    assert found.failure is None
    assert found.result["asperity_load_share"].values[-1] > 0.9


@pytest.mark.slow
def test_a_starved_film_touches_where_waves_grow():
    """Waves that grow in a film just above the boundary film: it is the least gap, and oil is conserved."""
    problem = line(0.2, nodes=101)
    least = 0.999 * float(MovingFilm(problem, smooth).steady.state.thickness.min())

    def waves(time, x, _y):
        return least * time * np.sin(6.0 * (x - time))[:, np.newaxis]

    _, history = list(motion(replace(problem, boundary_film=least), waves, steps=20))[-1]
    assert history.now.state.touching.any()
    assert float(history.now.state.thickness.min()) == pytest.approx(least, rel=1e-5)


def test_a_ratio_of_films_is_refused_beside_motion():
    with pytest.raises(InputError, match=r"inlet\.film_ratio") as error:
        moving(LINE, inlet={"film_ratio": 0.5})
    assert "inlet.oil_layer" in str(error.value)
