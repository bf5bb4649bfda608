"""Stated error of the temperature rise against grids four times finer along and across the film."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric import Case, solve
from ehlectric.contact import contact_heat as oil_of_case
from ehlectric.film import heated_film
from ehlectric.film.heated_film import change_between, close_enough
from tests.helpers.each import each
from tests.helpers.hot_cases import HOT_LINE
from tests.helpers.share import share

pytestmark = pytest.mark.convergence

# Degree of the polynomial across the film, and range of the oil above the inlet [K], of the fine solution.
DEGREE, ABOVE = 24, 500.0


def contact(speed, pressure, ratio, rheology, **grid):
    table = HOT_LINE["contact"] | {"max_hertz_pressure": pressure, "entrainment_speed": speed}
    table |= {"slide_to_roll_ratio": ratio}
    case = HOT_LINE | {"contact": table, "film": {"thermal": True, "rheology": rheology}, "grid": grid}
    return Case.from_dict(case)


def overrun(monkeypatch, *values):
    """True error of the rise over the stated one; None if a film does not converge.

    The spike of a Newtonian film has no fine solution in acceptable time: its grid is twice as fine.
    """
    coarse = solve(contact(*values))
    if not coarse.converged:
        return None
    posed, times = heated_film.iteration_on, 2 if values[-1] == "newtonian" else 4
    with monkeypatch.context() as patch:
        patch.setattr(
            heated_film, "iteration_on", lambda *given, **keys: replace(posed(*given, **keys), degree=DEGREE)
        )
        patch.setattr(oil_of_case, "_ABOVE", ABOVE)
        fine = solve(contact(*values, nodes=times * (coarse.film.x.size - 1) + 1))
    if not fine.converged:
        return None
    found = coarse.film.heated
    error = fine.film.heated.max_temperature_rise - found.max_temperature_rise
    return abs(error) / found.temperature_rise_error


def drawn(seed):
    """Speed [m/s], Hertz pressure [Pa], slide-to-roll ratio and law of a random line contact."""
    r = np.random.default_rng(seed)
    speed = float(np.exp(r.uniform(np.log(0.2), np.log(20.0))))
    pressure, ratio = float(r.uniform(0.5e9, 2e9)), float(np.exp(r.uniform(np.log(0.01), 0.0)))
    ratio = 0.0 if r.random() < 0.2 else ratio
    return speed, pressure, ratio, ("eyring", "eyring", "newtonian")[int(r.integers(3))]


@pytest.mark.slow
@pytest.mark.gate
def test_spike_that_becomes_the_hottest_place_is_in_the_error():
    """On 401 nodes the rise hardly differs from that on 201; on 801 it is 50 K more."""
    values = 5.0, 1e9, 0.1, "newtonian"
    found, fine = (solve(contact(*values, nodes=nodes)).film.heated for nodes in (401, 801))
    error = fine.max_temperature_rise - found.max_temperature_rise
    assert error > 10.0
    assert error <= found.temperature_rise_error


@pytest.mark.slow
def test_extrapolated_oil_is_in_the_error(monkeypatch):
    """Beyond 290 degC the properties are straight lines; 30 K are missing."""
    values = 20.0, 2e9, 1.0, "eyring"
    found = solve(contact(*values)).film.heated
    monkeypatch.setattr(oil_of_case, "_ABOVE", ABOVE)
    error = solve(contact(*values)).film.heated.max_temperature_rise - found.max_temperature_rise
    assert 10.0 < error <= found.temperature_rise_error


@pytest.mark.slow
@pytest.mark.parametrize("first", range(100, 120, 5))
def test_stated_error_of_random_contacts(monkeypatch, first):
    seeds = share(range(first, first + 5), 2)
    ratios = [ratio for s in seeds if (ratio := overrun(monkeypatch, *drawn(s))) is not None]
    assert len(ratios) >= len(seeds) - 1
    assert all(ratio <= 2.0 for ratio in ratios)
    assert sum(ratio > 1.0 for ratio in ratios) <= 1


@each("part", [0.5, 1.0, 3.0])
@each("rise", [0.0, 40.0])
def test_a_change_is_stated_in_changes_that_are_small_enough(rise, part):
    """The heaviest node counts; one with a quarter of its weight may change by four times as much."""
    thermal = SimpleNamespace(inlet_temperature=300.0)
    new = np.array([300.0 + rise, 300.0])
    before = new - part * close_enough(rise) * np.array([1.0, -3.0])
    heats = (SimpleNamespace(temperature=temperature) for temperature in (before, new))
    assert change_between(np.array([1.0, 0.25]), *heats, thermal) == pytest.approx(part, rel=1e-6)
