"""Error estimate of the largest field, against exact fields of waves."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.errors import ConvergenceError
from ehlectric.field.field_accuracy import strength_error
from ehlectric.field.line_field import solve_field
from ehlectric.field.point_field import solve_point_field
from ehlectric.field.poisson import FieldProblem
from ehlectric.field.poisson_3d import PointFieldProblem
from tests.field.exact_fields import sinusoidal_crest, sinusoidal_wall


def waves(amplitude, wavelength, gap, per_wave, **changes):
    """Gap with waves on its lower wall, a few gaps and waves long, at 1 V."""
    reach = (int(3.0 * gap / wavelength) + 3) * per_wave
    x = np.arange(-reach, reach + 1) * wavelength / per_wave
    lower = amplitude * np.cos(2.0 * np.pi * x / wavelength)
    return FieldProblem(x, lower, 0.0 * x + gap, 1.0 + 0.0 * x, 0.0, 1.0, **changes)


def true_error(field, amplitude, wavelength, gap):
    exact = sinusoidal_crest(amplitude, 2.0 * np.pi / wavelength, gap) / gap
    return exact / field.max_strength - 1.0


def test_the_exact_crest_tends_to_the_limits_by_hand():
    """E0 (1 + a k coth(k h)) for small waves, and the formula of second order for larger ones."""
    gap, k = 2.7e-6, 2.0 * np.pi / 0.7e-6
    small = (sinusoidal_crest(1e-11, k, gap) - 1.0) / 1e-11
    assert small == pytest.approx(k / np.tanh(k * gap), rel=1e-3)
    crest, _, _ = sinusoidal_wall(2e-8, k, gap)
    assert sinusoidal_crest(2e-8, k, gap) == pytest.approx(crest, rel=2e-3)


def test_waves_far_shorter_than_the_gap_are_too_weak_at_degree_6_and_the_estimate_says_so():
    wave = 20e-9, 0.7e-6, 2.7e-6
    field = solve_field(waves(*wave, 16))
    error = true_error(field, *wave)
    assert 0.05 < error < 0.065
    assert error <= field.strength_error < 1.25 * error
    assert field.sufficient_degree == 14


def test_the_degree_is_raised_until_it_resolves_the_waves():
    wave = 20e-9, 0.7e-6, 2.7e-6
    field = solve_field(waves(*wave, 16, most_degree=40))
    assert field.s.size == 15
    assert abs(true_error(field, *wave)) <= field.strength_error < 0.005


def test_the_degree_is_not_raised_beyond_its_bound():
    wave = 20e-9, 0.7e-6, 2.7e-6
    field = solve_field(waves(*wave, 16, most_degree=9))
    assert field.s.size == 10
    error = true_error(field, *wave)
    assert 0.005 < error <= field.strength_error < 1.5 * error


@pytest.mark.slow
@pytest.mark.parametrize("per_wave", [8, 16, 32])
@pytest.mark.parametrize(
    "wave",
    [
        (20e-9, 0.7e-6, 1.0e-6),
        (20e-9, 0.7e-6, 0.5e-6),
        (50e-9, 0.7e-6, 2.7e-6),
        (200e-9, 10e-6, 0.5e-6),
        (20e-9, 5e-6, 0.1e-6),
        (20e-9, 0.7e-6, 10e-6),
    ],
)
def test_the_estimate_bounds_the_true_error_and_is_not_far_above_it(wave, per_wave):
    field = solve_field(waves(*wave, per_wave))
    error = abs(true_error(field, *wave))
    assert error <= field.strength_error < 1.3 * error + 0.02


def test_smooth_walls_have_hardly_an_error():
    x = np.linspace(-1e-4, 1e-4, 201)
    field = solve_field(FieldProblem(x, 0.0 * x, 5e-7 + 10.0 * x**2, 1.0 + 0.0 * x, 0.0, 1.0, most_degree=40))
    assert field.s.size == 7
    assert field.strength_error < 1e-3


def test_a_lower_peak_that_would_be_the_highest_counts():
    """Waves that lack 6 % matter beside a broad bump that seems to be 3 % higher, not beside one of 10 %."""
    wave = 20e-9, 0.7e-6, 2.7e-6
    problem = waves(*wave, 16)
    errors = []
    for bump in (0.0, 0.09, 0.14):
        x = problem.x
        upper = problem.upper * (1.0 - bump * np.exp(-(((x - x[0]) / 3e-6) ** 2)))
        flat = problem.lower * np.clip((x - x[0]) / 6e-6 - 0.5, 0.0, 1.0)
        errors.append(solve_field(replace(problem, lower=flat, upper=upper)).strength_error)
    assert errors[0] > 0.05
    assert 0.01 < errors[1] < 0.05
    assert errors[2] < 0.005


def test_random_roughness_against_a_far_finer_field():
    rng = np.random.default_rng(3)
    gap, spacing = 2e-6, 5e-8
    x = np.arange(-160, 161) * spacing

    def wall(at):
        return sum(
            6e-9 * np.cos(2.0 * np.pi * at / wave + phase)
            for wave, phase in zip(np.geomspace(0.6e-6, 6e-6, 9), rng_phases, strict=True)
        )

    rng_phases = rng.uniform(0.0, 2.0 * np.pi, 9)
    fine = np.linspace(x[0], x[-1], 4 * (x.size - 1) + 1)
    coarse, exact = (
        solve_field(FieldProblem(at, wall(at), 0.0 * at + gap, 1.0 + 0.0 * at, 0.0, 1.0, degree=degree))
        for at, degree in ((x, 6), (fine, 30))
    )
    error = exact.max_strength / coarse.max_strength - 1.0
    assert 0.02 < error <= coarse.strength_error < 1.5 * error


def test_a_point_contact_has_the_estimate_of_the_line_for_straight_waves():
    line = waves(20e-9, 0.7e-6, 1.4e-6, 8)
    middle = slice(line.x.size // 2 - 28, line.x.size // 2 + 29)
    x, y = line.x[middle], np.linspace(-2e-6, 2e-6, 9)
    maps = {
        name: np.repeat(getattr(line, name)[middle][:, np.newaxis], y.size, axis=1)
        for name in ("lower", "upper", "permittivity")
    }
    point = PointFieldProblem(x, y, **maps, potential_1=0.0, potential_2=1.0)
    plane = replace(line, x=x, **{name: values[:, 0] for name, values in maps.items()})
    for most in (6, 40):
        solid = solve_point_field(replace(point, most_degree=most))
        flat = solve_field(replace(plane, most_degree=most))
        assert solid.s.size == flat.s.size
        assert solid.strength_error == pytest.approx(flat.strength_error, rel=0.05)
        assert solid.sufficient_degree == flat.sufficient_degree
    assert solid.s.size > 7


def test_a_field_with_charge_or_layers_has_no_estimate():
    problem = waves(20e-9, 0.7e-6, 1e-6, 8)
    charge = np.zeros((problem.x.size, 7))
    for changes in ({"charge_density": charge}, {"permittivity": 1.0 + charge}):
        assert solve_field(replace(problem, **changes)).strength_error is None


def test_a_finer_field_that_does_not_converge_leaves_the_error_unknown():
    x = np.linspace(0.0, 1e-5, 9)
    flat = np.zeros((9, 9))
    problem = PointFieldProblem(x, x, flat, flat + 1e-6, flat + 1.0, 0.0, 1.0)
    field = solve_point_field(problem)
    assert field.strength_error < 1e-9

    def failing(_part):
        raise ConvergenceError("the electric field did not converge")

    assert strength_error(problem, field.column_strength, failing) is None
