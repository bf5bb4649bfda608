"""The film in time: observed orders, what stands still, what moves slowly, and what is carried along."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from ehlectric import ConvergenceError
from ehlectric.film import unsteady
from ehlectric.film.face_flow import evaluate
from ehlectric.film.unsteady import Effort, UnsteadyFilm
from tests.helpers.transient_films import histories, last, problem_of, ridge, steady

pytestmark = pytest.mark.convergence

HEIGHT = 0.03  # of ridges, about a third of the film


def carried_to_the_centre(problem, start, step, steps):
    """H over abs(X) < 0.6 and P after a broad ridge has been carried from the inlet to X = 0."""
    x = start.level.mesh.x
    now = last(problem, ridge(HEIGHT, 0.3, -steps * step), step, steps, start=start)
    middle = np.abs(x) < 0.6
    return x[middle], now.state.thickness[middle, 0], now.state.pressure[middle, 0]


@pytest.mark.slow
@pytest.mark.gate
def test_order_in_time(paper_case):
    """On one grid, steps of 4, 2 and 1 spacings, where nothing is interpolated: their differences.

    Away from the pressure spike, whose width no grid of this test has.
    """
    n = 400
    problem = problem_of(paper_case, n + 1)
    start, courant = steady(problem), [4, 2, 1]
    runs = [carried_to_the_centre(problem, start, 5.0 * c / n, 2 * n // (5 * c)) for c in courant]
    for quantity in (1, 2):
        values = np.array([run[quantity] for run in runs])
        differences = np.max(np.abs(np.diff(values, axis=0)), axis=1)
        assert np.log2(differences[0] / differences[1]) == pytest.approx(2.0, abs=0.25)


@pytest.mark.slow
@pytest.mark.parametrize("courant", [1.0, 0.8])
def test_order_in_space_and_time(paper_case, slope, courant):
    """Grids that double with the step: the film at the nodes of the coarsest; 0.8 spacings interpolate.

    The pressure, as that of the steady film, has the error of its spike everywhere, by the load's balance.
    """
    intervals, films = np.array([200, 400, 800]), []
    for n in intervals:
        problem, step = problem_of(paper_case, int(n) + 1), 5.0 * courant / n
        x, film, _ = carried_to_the_centre(problem, steady(problem), step, round(2.0 / step))
        films.append(film[np.searchsorted(x, np.linspace(-0.5, 0.5, 41) - 1e-9)])
    differences = np.max(np.abs(np.diff(films, axis=0)), axis=1)
    assert slope(1.0 / intervals[:-1], differences) == pytest.approx(2.0, abs=0.1)


@pytest.mark.slow
@pytest.mark.gate
def test_a_step_is_solved_far_below_its_error(paper_case, monkeypatch):
    """Solved a thousand times as closely, the film differs by less than 1e-5 of itself.

    The extrapolated film alone may meet the tolerance, and be wrong by a per cent.
    """
    problem = replace(problem_of(paper_case, 801), tolerance=1e-11)
    gap, step, start = ridge(HEIGHT, 0.3, -2.0), 5.0 / 800, steady(problem)
    loose = last(problem, gap, step, 240, start=start).state.thickness
    monkeypatch.setattr(unsteady, "STEP_TOLERANCE", 1e-3 * unsteady.STEP_TOLERANCE)
    close = last(problem, gap, step, 240, start=start).state.thickness
    assert 0.0 < np.max(np.abs(loose / close - 1.0)) < 1e-5


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("gap", [ridge(0.0, 1.0, 0.0), ridge(HEIGHT, 0.1, 0.1, speed=0.0)])
def test_a_steady_film_stays(paper_case, gap):
    """With steps of one spacing the time steps are the steady scheme: smooth and rough, P, H and the mass."""
    problem = replace(problem_of(paper_case, 401), tolerance=1e-12)
    start = steady(replace(problem, added_gap=lambda x, y: gap(0.0, x, y)))
    first, *_, history = histories(problem, gap, start.level.mesh.dx, 50, start=start)
    assert np.max(np.abs(history.now.state.thickness - start.state.thickness)) < 1e-11
    assert np.max(np.abs(history.now.state.pressure - start.state.pressure)) < 1e-10
    assert np.max(np.abs(history.now.mass - first.now.mass)) < 1e-11


@pytest.mark.slow
@pytest.mark.gate
def test_a_gap_that_rises_and_stays_gives_the_stationary_film(paper_case):
    """A ridge grows for T = 1: once the oil of before has left, its film is the steady one."""
    problem = problem_of(paper_case, 201)
    still = ridge(HEIGHT, 0.1, 0.1, speed=0.0)
    expected = steady(replace(problem, added_gap=lambda x, y: still(0.0, x, y))).state
    distances = {}
    for history in histories(problem, lambda t, x, y: min(t, 1.0) * still(0.0, x, y), 5.0 / 200, 280):
        distances[round(history.now.time, 3)] = np.max(
            np.abs(history.now.state.thickness - expected.thickness)
        )
    assert distances[1.0] > 1e-4
    assert distances[6.0] < 1e-6
    assert distances[7.0] < 0.5 * distances[6.0]


@pytest.mark.slow
def test_slow_roughness_tends_to_the_quasi_stationary_film(paper_case, slope):
    """The distance from the film of the ridge held where it is falls linearly with its speed."""
    n, speeds, time = 200, np.array([0.02, 0.01, 0.005]), 4.0
    problem = problem_of(paper_case, n + 1)
    expected = steady(replace(problem, added_gap=lambda x, y: ridge(HEIGHT, 0.3, 0.0)(0.0, x, y)))
    middle, distances = np.abs(expected.level.mesh.x) < 0.6, []
    for speed in speeds:
        gap = ridge(HEIGHT, 0.3, -speed * time, speed)
        start = steady(replace(problem, added_gap=lambda x, y, gap=gap: gap(0.0, x, y)))
        now = last(problem, gap, 5.0 / n, round(time * n / 5.0), start=start)
        distances.append(np.max(np.abs(now.state.thickness - expected.state.thickness)[middle]))
    assert distances[-1] < 1e-3 * HEIGHT
    assert slope(speeds, distances) == pytest.approx(1.0, abs=0.1)


@pytest.mark.slow
@pytest.mark.parametrize("courant", [pytest.param(1.0, marks=pytest.mark.gate), 0.7])
def test_a_shape_is_carried_through_the_flat_zone(paper_case, courant):
    """What a ridge makes of the film at X = -0.5 stands at X = 0.5 a time 1 later, within 1 %.

    At 2 GPa, where nothing flows but with the surfaces: what H and rho H have over the smooth film's, along
    0.6 half-widths, relative to its range. It is rho H that is carried; between places of one pressure,
    compression leaves half a per cent of H.
    """
    n = 500
    problem = problem_of(paper_case, n + 1, **{"contact.max_hertz_pressure": "2 GPa"})
    start = steady(problem)
    x, step = start.level.mesh.x, 5.0 * courant / n
    height = 0.3 * np.interp(0.0, x, start.state.thickness[:, 0])
    before, after = {}, {}
    for history in histories(problem, ridge(height, 0.15, -2.5), step, round(3.0 / step) + 1, start=start):
        now = history.now
        if now.time == 0.0:
            smooth = now
        for time, shapes in ((2.0, before), (3.0, after)):
            if abs(now.time - time) <= 0.5 * step + 1e-9:
                along = now.time - 2.5 + np.linspace(-0.3, 0.3, 121)
                for name, moved in (
                    ("film", now.state.thickness - smooth.state.thickness),
                    ("mass", now.mass - smooth.mass),
                ):
                    shapes[name] = PchipInterpolator(x, moved[:, 0])(along)
    assert np.ptp(before["film"]) > 0.3 * height
    for name, most in (("film", 0.01), ("mass", 1e-4 if courant == 1.0 else 3e-3)):
        assert np.max(np.abs(after[name] - before[name])) < most * np.ptp(before[name])


def flow(problem, now, dx, node):
    """Oil that flows past a node in a unit of time, rho H - eps dP/dX."""
    eps = evaluate(problem.fluid, now.state.pressure, now.state.thickness).eps[node, 0]
    gradient = (now.state.pressure[node + 1, 0] - now.state.pressure[node - 1, 0]) / (2.0 * dx)
    return now.mass[node, 0] - eps * gradient


@pytest.mark.slow
@pytest.mark.parametrize("courant", [pytest.param(1.0, marks=pytest.mark.gate), 0.7])
def test_oil_is_kept(paper_case, slope, courant):
    """What flows past X = -1.5 less what leaves the cavitated zone at 1.75 is gained, to second order.

    By the trapezoidal rule in space and time, while a ridge passes the inlet.
    """
    intervals, missing = np.array([200, 400]), []
    for n in intervals:
        problem, dx = problem_of(paper_case, int(n) + 1), 5.0 / n
        inlet, outlet = round(1.5 / dx), round(4.75 / dx)
        step, held, net = courant * dx, [], []
        for history in histories(problem, ridge(HEIGHT, 0.2, -2.5), step, round(2.1 / step)):
            now = history.now
            held.append(np.trapezoid(now.mass[inlet : outlet + 1, 0], dx=dx))
            net.append(flow(problem, now, dx, inlet) - flow(problem, now, dx, outlet))
            assert not now.full_film[outlet, 0]
        assert np.ptp(held) > 1e-3
        missing.append(abs(held[-1] - held[0] - np.trapezoid(net, dx=step)))
    assert slope(1.0 / intervals, missing) == pytest.approx(2.0, abs=0.2)


def not_found_beyond(monkeypatch, longest):
    """Time steps longer than that are not solved; those that were tried, in their order."""
    stepped, tried = UnsteadyFilm._stepped, []

    def few(self, history, step):
        tried.append(step)
        return stepped(self, history, step) if step <= longest else (None, Effort(newton=1))

    monkeypatch.setattr(UnsteadyFilm, "_stepped", few)
    return tried


@pytest.mark.parametrize("halvings", [1, 2])
def test_a_step_that_is_not_solved_is_halved(paper_case, monkeypatch, halvings):
    """As often as it takes, to the same time and to the film that the shorter steps lead to, and counted."""
    problem, gap, step = problem_of(paper_case, 201), ridge(HEIGHT, 0.3, -2.0), 5.0 / 200
    film = UnsteadyFilm(problem, gap)
    history = film.advance(film.start(steady(problem), step), step)
    parts = 2**halvings
    by_hand = history
    for _ in range(parts):
        by_hand = film.advance(by_hand, step / parts)
    tried = not_found_beyond(monkeypatch, 1.001 * step / parts)
    halved = film.advance(history, step)
    assert halved.effort.halvings == parts - 1
    assert halved.effort.newton >= parts + parts - 1
    assert len(tried) == 2 * parts - 1
    assert halved.now.time == pytest.approx(2.0 * step, rel=1e-12)
    np.testing.assert_array_equal(halved.now.state.thickness, by_hand.now.state.thickness)
    np.testing.assert_array_equal(halved.now.mass, by_hand.now.mass)


def test_a_step_that_no_halving_solves_ends_the_run(paper_case, monkeypatch):
    problem, step = problem_of(paper_case, 201), 5.0 / 200
    film = UnsteadyFilm(problem, ridge(HEIGHT, 0.3, -2.0))
    tried = not_found_beyond(monkeypatch, 0.0)
    with pytest.raises(
        ConvergenceError, match=r"^film at T = .*, although the time step was halved 6 times$"
    ):
        film.advance(film.start(steady(problem), step), step)
    assert tried == [step / 2**k for k in range(7)]
