"""Error that a refinement can reach: said before a film is solved, and corrected while it is."""

import re

import pytest

from ehlectric import Case
from ehlectric.contact.contact_refinement import ExpectedGrid, FilmProgress, Reach
from ehlectric.contact.preparation import prepare
from ehlectric.contact.run import solve_to_folder
from ehlectric.film.isothermal_film import solve_point_film

BALL = {"geometry": "point", "radius_x": 10e-3, "radius_y": 10e-3, "reduced_modulus": 226e9}
# M = 2.5e5 at 2.1 GPa: the film is 1.3 nm thick.
THIN = BALL | {"max_hertz_pressure": 2.1e9, "entrainment_speed": 7.586e-4, "boundary_film": 0.0}
THICK = BALL | {"max_hertz_pressure": 0.5e9, "entrainment_speed": 1.0}


def prepared(contact, **grid):
    return prepare(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": grid}))


def out_of_reach(contact):
    return [str(w) for w in contact.warnings() if w.code == "error-out-of-reach"]


def test_an_error_out_of_reach_is_said_before_the_film_is_solved():
    contact = prepared(THIN, most_nodes=1025)
    assert contact.conditions.contact.moes_m == pytest.approx(2.5e5, rel=1e-3)
    (said,) = out_of_reach(contact)
    assert said.startswith("grid.error: ")
    assert " 2 % " in said
    assert " 1025 nodes" in said
    assert "grid.most_nodes" in said
    assert contact.reach.grids[-1].error > 0.5


def test_an_error_within_reach_is_not_warned_of():
    contact = prepared(THICK)
    assert out_of_reach(contact) == []
    assert contact.reach.last() < len(contact.reach.grids)
    # A smaller error takes more grids, and few nodes do not reach it.
    assert prepared(THICK, error=1e-3).reach.last() > contact.reach.last()
    (said,) = out_of_reach(prepared(THICK, error=1e-3, most_nodes=129))
    assert " 129 nodes" in said


def test_grids_end_at_most_nodes():
    assert [grid.nodes for grid in prepared(THIN, most_nodes=600).reach.grids] == [129, 257, 513]
    assert [grid.nodes for grid in prepared(THIN, nodes=65, refine=0.02, most_nodes=65).reach.grids] == [65]
    assert prepared(THICK, nodes=129).reach is None


def reach(*errors, target=0.02):
    grids = (ExpectedGrid(2**k * 128 + 1, 8192.0 * 4**k, error) for k, error in enumerate(errors))
    return Reach("error", target, tuple(grids), 1e-4)


def test_progress_tells_grid_error_and_time_left():
    """Times of solved grids take the place of the stated law, and errors correct the number of grids."""
    now = [0.0]
    told = FilmProgress(reach(0.3, 0.08, 0.02, 0.005), lambda: now[0])
    # 8192 nodes at 0.1 ms, 0.82 s, times 1 + 4**1.1 + 16**1.1 = 26.7.
    text = told.text(129, 0, 1.0)
    assert "grid 1 of 3" in text
    assert "22 s" in text
    now[0] = 10.0
    told.on_grid(None, 0.6)
    # Twice the expected error takes one grid more: 10 s times 4**1.1 + 16**1.1 + 64**1.1 = 122.7.
    text = told.text(257, 0, 1.0)
    assert "grid 2 of 4" in text
    assert "60 %" in text
    assert "20 min" in text
    told.on_grid(None, 0.01)
    text = told.text(257, 1, 1.0)
    assert "grid" not in text
    assert "1 %" in text


def test_progress_tells_what_is_in_reach():
    told = FilmProgress(reach(0.9, 0.6), lambda: 0.0)
    assert "60 %" in told.text(129, 0, 1.0)
    told.on_grid(None, 0.45)
    assert "30 %" in told.text(257, 0, 1.0)


def test_progress_without_a_law_takes_the_order_of_the_film():
    """At an order of 1.25 an error of 10 % takes two more grids to 2 %."""
    told = FilmProgress(reach(None, None, None, None, None), lambda: 0.0)
    assert "grid 1, 401 nodes" in told.text(401, 0, 1.0)
    told.on_grid(None, 0.1)
    assert "grid 2 of 3" in told.text(801, 0, 1.0)


def test_progress_of_a_single_grid_is_its_steps():
    told = FilmProgress(None)
    assert told.text(129, 2, 1e-3).startswith("film: 129 nodes, step 3")


def test_a_run_tells_its_grids(tmp_path):
    """A line contact from 101 nodes to an error that takes some grids."""
    contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    grid = {"nodes": 101, "refine": 0.01, "most_nodes": 801}
    case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": grid})
    texts = []
    outcome = solve_to_folder(prepare(case), tmp_path, lambda _done, _of, text: texts.append(text))
    grids = [int(found[1]) for text in texts if (found := re.search(r"grid (\d+)", text))]
    assert grids == sorted(grids)
    assert grids[0] == 1
    assert grids[-1] >= 2
    assert any("so far" in text for text in texts)
    assert outcome.result.film.x.size <= 801


@pytest.mark.slow
def test_a_grid_that_does_not_see_its_film_does_not_state_a_small_error():
    """On 65 and 33 nodes the surfaces of the thin film touch, and both grids have nearly one mean gap."""
    contact = prepared(THIN, nodes=65)
    film = solve_point_film(contact.film_problem(contact.case))
    assert film.discretisation_error is None or film.discretisation_error >= 0.5
