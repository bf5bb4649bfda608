"""Places where a coarse solution may hide the largest field, and windows that find it."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.field import field_accuracy
from ehlectric.field.field_accuracy import first_order_strength, places
from ehlectric.field.line_field import solve_field
from ehlectric.field.point_field import solve_point_field
from ehlectric.field.poisson import FieldProblem
from ehlectric.field.poisson_3d import PointFieldProblem

GAP = 2.7e-6


def patch_beside_constriction(wavelength, share, **changes):
    """20 nm waves near x = 0, and a smooth constriction at 40 um; it has a share of the rise of the waves."""
    amplitude, k = 20e-9, 2.0 * np.pi / wavelength
    x = np.arange(-25e-6, 65e-6, wavelength / 10.0)
    depth = 1.0 - 1.0 / (1.0 + share * amplitude * k)
    upper = GAP * (1.0 - depth * np.exp(-(((x - 40e-6) / 12e-6) ** 2)))
    lower = amplitude * np.cos(k * x) * np.exp(-((x / 12e-6) ** 8))
    return FieldProblem(x, lower, upper, 1.0 + 0.0 * x, 0.0, 1.0, **changes)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("wavelength", "share", "least"), [(0.7e-6, 0.75, 0.035), (0.5e-6, 0.6, 0.07), (0.4e-6, 0.6, 0.085)]
)
def test_waves_hidden_by_a_higher_constriction_are_found(wavelength, share, least):
    """At degree 6 the constriction reads higher than the waves; at degree 32 the waves are higher."""
    problem = patch_beside_constriction(wavelength, share)
    exact = solve_field(replace(problem, degree=32)).max_strength
    coarse = solve_field(problem)
    assert coarse.max_strength_position > 30e-6
    true = exact / coarse.max_strength - 1.0
    assert least < true <= 1.05 * coarse.strength_error < 1.3 * true
    raised = solve_field(replace(problem, most_degree=40))
    assert raised.s.size - 1 == coarse.sufficient_degree > 12
    assert abs(exact / raised.max_strength - 1.0) <= raised.strength_error < 0.005


def test_waves_that_stay_lower_do_not_raise_the_degree():
    """A constriction with 1.2 times the rise of the waves is the maximum at any degree."""
    problem = patch_beside_constriction(0.7e-6, 1.2, most_degree=40)
    field = solve_field(problem)
    exact = solve_field(replace(problem, degree=32)).max_strength
    assert field.s.size == 7
    assert abs(exact / field.max_strength - 1.0) < 1e-5
    assert field.strength_error < 1e-3


def counted(monkeypatch):
    columns = []
    around = field_accuracy._Window.around.__func__

    def count(cls, problem, column):
        columns.append(column)
        return around(cls, problem, column)

    monkeypatch.setattr(field_accuracy._Window, "around", classmethod(count))
    return columns


def test_a_smooth_gap_needs_one_window_and_equal_waves_too(monkeypatch):
    x = np.linspace(-1e-4, 1e-4, 401)
    columns = counted(monkeypatch)
    smooth = FieldProblem(x, 0.0 * x, 5e-7 + 10.0 * x**2, 1.0 + 0.0 * x, 0.0, 1.0, most_degree=40)
    assert solve_field(smooth).s.size == 7
    assert len(columns) == 1
    waves = replace(smooth, lower=1e-8 * np.cos(2.0 * np.pi * x / 4e-6), upper=0.0 * x + 5e-7)
    solve_field(waves)
    assert len(columns) <= 3


def test_what_windows_did_not_try_counts_as_error(monkeypatch):
    """With one window only, on the constriction, the promise of the waves is the estimate."""
    problem = patch_beside_constriction(0.5e-6, 0.6)
    exact = solve_field(replace(problem, degree=32)).max_strength
    monkeypatch.setattr(field_accuracy, "_MOST_WINDOWS", {1: 1})
    columns = counted(monkeypatch)
    field = solve_field(problem)
    assert len(columns) == 1
    true = exact / field.max_strength - 1.0
    assert true <= field.strength_error < 1.6 * true


def test_the_first_order_is_that_of_waves_on_either_wall():
    """By hand: (1 + a k coth kh - b k / sinh kh) on the lower wall, and its mirror image on the upper."""
    gap, k, small = 1e-6, 2.0 * np.pi / 1.6e-6, 1e-12
    x = np.arange(-160, 161) * 0.05e-6
    wave = np.cos(k * x)
    own, other = k / np.tanh(k * gap), k / np.sinh(k * gap)
    for a, b, rise in ((1.0, 0.0, own), (0.0, -1.0, own), (1.0, -1.0, own + other), (1.0, 1.0, own - other)):
        walls = a * small * wave, gap + b * small * wave
        problem = FieldProblem(x, *walls, 1.0 + 0.0 * x, 3.0, 1.0)
        crest = first_order_strength(problem, 2.0 / gap + 0.0 * x)[160]
        assert (crest * gap / 2.0 - 1.0) / small == pytest.approx(rise, rel=0.02)


def test_places_are_local_maxima_and_the_first_is_the_largest_field():
    problem = patch_beside_constriction(0.5e-6, 0.6)
    first, *others = places(problem, solve_field(problem).column_strength)
    assert problem.x[first.column] == pytest.approx(40e-6, abs=1e-6)
    assert first.missing < 1e-3
    crests = [one for one in others if abs(problem.x[one.column]) < 8e-6]
    assert len(crests) > 5
    for one in crests:
        assert one.missing > 0.1
        assert problem.lower[one.column] > 15e-9
    broad = [one for one in others if 30e-6 < problem.x[one.column] < 50e-6]
    assert not broad


@pytest.mark.slow
@pytest.mark.gate
def test_a_point_contact_finds_hidden_waves():
    gap, wavelength, amplitude = 1.4e-6, 0.7e-6, 20e-9
    x, y = np.arange(-24, 97) * wavelength / 8.0, np.linspace(-1e-6, 1e-6, 5)
    lower = amplitude * np.cos(2.0 * np.pi * x / wavelength) * (x < 3.25 * wavelength)
    upper = gap * (1.0 - 0.1 * np.exp(-(((x - 6.5e-6) / 2e-6) ** 2)))
    maps = [np.repeat(wall[:, np.newaxis], y.size, axis=1) for wall in (lower, upper, 1.0 + 0.0 * x)]
    line = FieldProblem(x, lower, upper, 1.0 + 0.0 * x, 0.0, 1.0, degree=4)
    flat = solve_field(line)
    solid = solve_point_field(PointFieldProblem(x, y, *maps, potential_1=0.0, potential_2=1.0, degree=4))
    true = solve_field(replace(line, degree=24)).max_strength / flat.max_strength - 1.0
    assert flat.max_strength_position > 4e-6
    assert 0.03 < true <= 1.05 * flat.strength_error
    assert solid.strength_error == pytest.approx(flat.strength_error, rel=0.05)


def test_mirrored_walls_have_mirrored_fields_to_first_order():
    """Few columns, so that the integrals have the columns at both ends."""
    x = np.array([0.0, 1.0, 2.5, 3.0, 4.2])
    lower, upper = 0.1 * np.array([1.0, 0.0, 3.0, 1.0, 2.0]), 2.0 + 0.1 * np.array([2.0, 1.0, 0.0, 5.0, 1.0])
    both = [
        FieldProblem(places, *(wall[turn] for wall in (lower, upper, 1.0 + 0.0 * x)), 0.0, 1.0)
        for places, turn in ((x, slice(None)), (-x[::-1], slice(None, None, -1)))
    ]
    found, mirrored = (first_order_strength(problem, 0.0 * x) for problem in both)
    np.testing.assert_allclose(mirrored[::-1], found, rtol=1e-12)
