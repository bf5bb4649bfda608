"""The reference of dry rough contacts against closed forms, the film's kernels, theories and tamaas."""

import numpy as np
import pytest
from scipy import fft
from scipy.integrate import quad
from scipy.special import elliprd, elliprf, erf

from ehlectric.film.deflection import Deflection, line_influence, point_influence
from ehlectric.surfaces import generated_maps
from tests.film import dry_contact as dry
from tests.formulas.hertz_point import radii_ratio
from tests.helpers.each import each

pytestmark = pytest.mark.reference


def waves(x, *, count=25, height=0.05, seed=1):
    """Added gap of a rough profile: waves of random phases with a falling spectrum."""
    phases = np.random.default_rng(seed).uniform(0.0, 2.0 * np.pi, count)
    k = np.arange(1, count + 1)
    return np.cos(6.0 * np.multiply.outer(x, k) + phases) @ (height / k**0.8)


def waves_over(x, y):
    """Added gap of a rough map without symmetry."""
    x = x[:, np.newaxis]
    return -0.1 * np.cos(9.0 * x + 1.0) * np.cos(8.0 * y) - 0.02 * np.cos(19.0 * x + 10.0 * y + 1.0)


def rough_map(nodes, *, rolloff=0.25, shortest=1.0 / 16.0, seed=1):
    """Periodic self-affine map over the unit square, and its root mean square gradient.

    Each edge of a larger map is blended into the opposite one with weights whose squares add to one, which
    keeps the variance. The map is refined by its Fourier series, which ends at its shortest wave.
    """
    far = 0.5 * (1.0 + rolloff)
    made = generated_maps.self_affine(
        rq=1.0, hurst=0.8, rolloff_wavelength=rolloff, reach_x=far, reach_y=far, seed=seed, shortest=shortest
    )
    coarse, strip = round(1.0 / made.spacing_x), round(rolloff / made.spacing_x)
    weight = np.sin(0.5 * np.pi * (np.arange(strip) + 0.5) / strip)[:, np.newaxis]
    heights = made.heights
    for _ in range(2):
        kept = heights[:coarse].copy()
        kept[:strip] = weight * kept[:strip] + weight[::-1] * heights[coarse : coarse + strip]
        heights = kept.T
    spectrum, low = np.zeros((nodes, nodes), complex), (nodes - coarse) // 2
    inside = slice(low, low + coarse)
    spectrum[inside, inside] = fft.fftshift(fft.fft2(heights)) / coarse**2
    spectrum = fft.ifftshift(spectrum)
    heights = fft.ifft2(spectrum).real * nodes**2
    q = 2.0 * np.pi * fft.fftfreq(nodes, 1.0 / nodes)
    spectrum = fft.fft2(heights) / nodes**2
    return heights, float(np.sqrt(np.sum((q[:, np.newaxis] ** 2 + q**2) * np.abs(spectrum) ** 2)))


def orders(errors):
    """Order of convergence from each grid to the next with half the spacing."""
    return np.log2(np.abs(errors[:-1]) / np.abs(errors[1:]))


def test_kernels_are_those_of_the_film():
    np.testing.assert_allclose(dry.line_kernel(200, 0.013), line_influence(200, 0.013)[:, 0], rtol=1e-10)
    ours = dry.point_kernel((60, 50), 0.04, 0.03)
    np.testing.assert_allclose(ours, point_influence((60, 50), 0.04, 0.03), rtol=1e-9)


@pytest.mark.parametrize("k", [0, 1, 7])
def test_kernel_of_a_linear_pressure_is_the_integral_over_a_hat(k):
    dx = 0.05

    def hat(s):
        return (1.0 - abs(s) / dx) * np.log(abs(k * dx - s)) / np.pi

    parts = [quad(hat, a, b, epsabs=1e-13)[0] for a, b in ((-dx, 0.0), (0.0, dx))]
    assert dry.line_kernel(9, dx, linear=True)[k] == pytest.approx(-sum(parts), rel=1e-9, abs=0.0)


@pytest.mark.parametrize("linear", [False, True])
def test_smooth_line_is_hertz(linear):
    displacement, pressure = [], []
    for nodes in (101, 201, 401, 801):
        x = np.linspace(-2.0, 2.0, nodes)
        found = dry.line_contact(x, linear=linear)
        hertz = np.sqrt(np.maximum(0.0, 1.0 - x**2))
        displacement.append(found.h00 + 0.5 * np.log(2.0) + 0.25)
        pressure.append(np.sum(np.abs(found.pressure - hertz)) * (x[1] - x[0]))
        assert abs(found.contact.sum() * (x[1] - x[0]) - 2.0) < 1.01 * (x[1] - x[0])
        assert found.error < 1e-10
    assert (orders(np.array(displacement)) > 1.9).all()
    # The slope of the pressure is infinite at both edges, so that its error over the line is of order 3/2.
    assert (orders(np.array(pressure)) > 1.45).all()
    assert abs(displacement[-1]) < 3e-7
    assert pressure[-1] < 3e-4


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("k", [1.0, 3.0])
def test_smooth_point_is_hertz(k):
    ratio, compliance = dry.ellipse(k)
    assert ratio == pytest.approx(1.0 / radii_ratio(k), rel=1e-12)
    assert compliance == pytest.approx(1.5 / (np.pi * k * elliprd(0.0, k**2, 1.0)), rel=1e-12)
    displacement, pressure = [], []
    for nodes in (27, 53, 105):
        # The ends of the semi-axes lie half-way between nodes on every grid.
        x = np.linspace(-1.0, 1.0, nodes) * (nodes - 1) / (nodes - 7) * 1.3
        found = dry.point_contact(x, k * x, ellipse_ratio=k)
        hertz = np.sqrt(np.maximum(0.0, 1.0 - x[:, np.newaxis] ** 2 - x**2))
        displacement.append(found.h00 + np.pi * k * compliance * elliprf(0.0, 1.0, k**2))
        pressure.append(np.sum(np.abs(found.pressure - hertz)) * (x[1] - x[0]) ** 2)
    share = np.pi / (x[-1] - x[0] + x[1] - x[0]) ** 2
    assert (orders(np.array(displacement)) > 1.5).all()
    assert abs(displacement[-1]) < 1e-4
    assert pressure[-1] < 3e-3
    assert found.area == pytest.approx(share, rel=1e-2)
    assert found.corrected_area == pytest.approx(share, rel=4e-3)


def test_partial_contact_of_a_sinusoid_is_westergaards():
    # H. M. Westergaard, J. Appl. Mech. 6 (1939) A49-A53; Johnson (1985), section 13.2. At half of the
    # pressure of complete contact half of the surface touches.
    complete, load, errors = np.pi, 0.5, []
    for nodes in (64, 128, 256, 512):
        x = (np.arange(nodes) + 0.5) / nodes - 0.5
        found = dry.periodic_contact(1.0 - np.cos(2.0 * np.pi * x), (1.0,), load * complete)
        inside = np.sqrt(np.maximum(0.0, load - np.sin(np.pi * x) ** 2))
        pressure = 2.0 * complete * np.cos(np.pi * x) * inside
        errors.append(np.mean(np.abs(found.pressure - pressure)) / complete)
        assert found.area == 0.5
    assert (orders(np.array(errors)) > 1.45).all()
    assert errors[-1] < 1e-4


@pytest.mark.parametrize("load", [0.1, 0.3, 0.9])
def test_width_of_the_contact_of_a_sinusoid(load):
    x = (np.arange(2048) + 0.5) / 2048 - 0.5
    found = dry.periodic_contact(1.0 - np.cos(2.0 * np.pi * x), (1.0,), load * np.pi)
    assert found.area == pytest.approx(2.0 / np.pi * np.arcsin(np.sqrt(load)), abs=2.0 / x.size)


def test_complete_contact_of_a_sinusoid():
    # Amplitude pi E* Delta/lambda, here with the modulus 2, the amplitude 3 and the wavelength 5.
    x = np.arange(64) / 64 * 5.0
    wave = np.cos(2.0 * np.pi * x / 5.0)
    found = dry.periodic_contact(-3.0 * wave, (5.0,), 4.0, modulus=2.0)
    np.testing.assert_allclose(found.pressure, 4.0 + np.pi * 2.0 * 3.0 / 5.0 * wave, rtol=1e-9)


@pytest.mark.slow
@pytest.mark.gate
def test_complete_contact_of_a_map():
    # The pressure of a wave z is E* q z/2, so that its mean square is that of the gradient times E*^2/4.
    heights, gradient = rough_map(128)
    found = dry.periodic_contact(-heights, (1.0, 1.0), 4.0 * gradient)
    assert found.area == 1.0
    assert np.std(found.pressure) == pytest.approx(0.5 * gradient, rel=1e-8)


@each("hardness", [np.inf, 1.5, 0.9])
@each("shift", [0.0, 0.01])
def test_rough_line_obeys_complementarity_in_the_films_equations(hardness, shift):
    x = np.linspace(-2.4, 1.6, 401)
    dx, added = x[1] - x[0], waves(x)
    found = dry.line_contact(x, added, hardness=hardness, shift=shift)
    deflection = Deflection.from_influence(line_influence(x.size, dx)).matrix @ found.pressure
    gap = found.h00 + 0.5 * x**2 + added + deflection
    np.testing.assert_allclose(gap + found.flattening, found.gap, atol=1e-12)
    check_complementarity(found, gap - shift, hardness)
    assert np.sum(found.pressure) * dx == pytest.approx(0.5 * np.pi, rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("hardness", [np.inf, 1.5, 0.75])
def test_rough_point_obeys_complementarity_in_the_films_equations(hardness):
    x, y = np.linspace(-1.5, 1.4, 41), np.linspace(-1.6, 1.6, 33)
    dx, dy = x[1] - x[0], y[1] - y[0]
    found = dry.point_contact(x, y, waves_over(x, y), hardness=hardness)
    influence = 2.0 / np.pi**2 * point_influence((x.size, y.size), dx, dy)
    deflection = (Deflection.from_influence(influence).matrix @ found.pressure.ravel()).reshape(41, 33)
    gap = found.h00 + 0.5 * (x[:, np.newaxis] ** 2 + y**2) + waves_over(x, y) + deflection
    check_complementarity(found, gap, hardness)
    assert np.sum(found.pressure) * dx * dy == pytest.approx(2.0 * np.pi / 3.0, rel=1e-12)


def check_complementarity(found, gap, hardness):
    """It is necessary and sufficient for the one solution, as the elastic energy is convex."""
    tolerance = 1.1e-10 * np.ptp(found.deflection)
    capped = found.pressure == hardness
    assert found.pressure.min() == 0.0
    assert found.pressure.max() <= hardness
    assert capped.any() == (hardness < np.inf)
    assert gap.min(where=~capped, initial=0.0) > -tolerance
    assert np.abs(gap)[found.contact & ~capped].max() < tolerance
    assert gap.max(where=capped, initial=0.0) < tolerance
    assert (found.flattening[~capped] == 0.0).all()


def test_boundary_film_only_lifts_the_bodies():
    x = np.linspace(-2.0, 2.0, 301)
    bare, lifted = dry.line_contact(x, waves(x)), dry.line_contact(x, waves(x), shift=0.02)
    assert lifted.h00 - bare.h00 == pytest.approx(0.02, abs=1e-10)
    np.testing.assert_allclose(lifted.pressure, bare.pressure, atol=1e-8)


def test_domain_and_constant_of_the_deflection_do_not_matter():
    x = np.linspace(-2.0, 2.0, 401)
    small = dry.line_contact(x[80:-60], waves(x)[80:-60])
    large = dry.line_contact(x, waves(x))
    np.testing.assert_allclose(small.pressure, large.pressure[80:-60], atol=1e-7)
    assert small.h00 == pytest.approx(large.h00, abs=1e-9)
    dx = x[1] - x[0]
    raised = dry.convolution(dry.line_kernel(x.size, dx) + 3.0 * dx)
    other = dry.solve(raised, 0.5 * x**2 + waves(x), 0.5 * np.pi / dx)
    np.testing.assert_allclose(other.pressure, large.pressure, atol=1e-7)
    assert other.h00 == pytest.approx(large.h00 - 1.5 * np.pi, abs=1e-9)


def test_cap_above_the_greatest_pressure_changes_nothing():
    x = np.linspace(-2.0, 2.0, 301)
    free = dry.line_contact(x, waves(x))
    capped = dry.line_contact(x, waves(x), hardness=1.01 * free.pressure.max())
    np.testing.assert_allclose(capped.pressure, free.pressure, atol=1e-8)
    assert capped.flattening.max() == 0.0


def test_soft_surface_touches_over_the_load_by_its_hardness():
    # The hardness is far below the pressures of an elastic contact, E* g, so that nearly all is flattened.
    heights, gradient = rough_map(128)
    hardness = 0.03 * gradient
    found = dry.periodic_contact(-heights, (1.0, 1.0), 0.2 * hardness, hardness=hardness)
    assert np.mean(found.pressure) == pytest.approx(0.2 * hardness, rel=1e-12)
    assert 0.2 < found.area < 1.01 * 0.2
    # The highest fifth of the surface is flattened.
    lowest = np.quantile(heights, 0.8)
    assert heights[found.contact].min() == pytest.approx(lowest, abs=0.05 * np.std(heights))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_area_of_a_self_affine_map_is_proportional_to_a_small_load(seed):
    heights, gradient = rough_map(256, rolloff=1.0 / 8.0, shortest=1.0 / 32.0, seed=seed)
    loads = np.array([0.02, 0.04, 0.06])
    found = [dry.periodic_contact(-heights, (1.0, 1.0), load * gradient) for load in loads]
    factors = np.array([solution.corrected_area for solution in found]) / loads
    # Persson has sqrt(8/pi) = 1.6, Bush, Gibson and Thomas sqrt(2 pi) = 2.5.
    assert (factors > 1.6).all()
    assert (factors < 2.5).all()
    assert np.ptp(factors) < 0.1 * factors.mean()
    assert (np.array([solution.area for solution in found]) > loads * factors).all()


@pytest.mark.slow
@pytest.mark.gate
def test_area_at_larger_loads_is_above_perssons():
    # A/A0 = erf(sqrt(2) p/(E* g)), B. N. J. Persson, J. Chem. Phys. 115 (2001) 3840. Here the area is larger
    # by about 30 % at a tenth of E* g, 20 % at two tenths and 8 % at five; it is exact in complete contact.
    heights, gradient = rough_map(256)
    for load, most in ((0.1, 1.35), (0.2, 1.25), (0.5, 1.1), (1.0, 1.03)):
        area = dry.periodic_contact(-heights, (1.0, 1.0), load * gradient).corrected_area
        assert 1.0 < area / erf(np.sqrt(2.0) * load) < most


@pytest.mark.slow
def test_corrected_area_converges_with_the_grid():
    for load in (0.02, 0.1, 0.5):
        areas, corrected = [], []
        for nodes in (128, 256, 512):
            heights, gradient = rough_map(nodes)
            found = dry.periodic_contact(-heights, (1.0, 1.0), load * gradient)
            areas.append(found.area)
            corrected.append(found.corrected_area)
        assert areas[0] > areas[1] > areas[2]
        # Eight nodes to the shortest wave: 2 % with the correction, up to 15 % without.
        assert corrected[0] == pytest.approx(corrected[2], rel=0.025)
        assert corrected[1] == pytest.approx(corrected[2], rel=0.01)
        assert abs(corrected[1] - corrected[2]) < abs(areas[1] - areas[2])


@pytest.mark.parametrize("load", [0.02, 0.1, 0.5])
def test_periodic_map_agrees_with_tamaas(load):
    tamaas = pytest.importorskip("tamaas")
    heights, gradient = rough_map(64)
    found = dry.periodic_contact(-heights, (1.0, 1.0), load * gradient)
    other = tamaas_pressure(tamaas, heights, 1.0, load * gradient)
    np.testing.assert_allclose(found.pressure, other, atol=1e-7 * other.max())
    assert np.count_nonzero(found.contact != (other > 0.0)) <= 2


def test_rough_point_agrees_with_tamaas():
    tamaas = pytest.importorskip("tamaas")
    x = np.linspace(-1.5, 1.5, 64)
    found = dry.point_contact(x, x, waves_over(x, x))
    length, heights = x.size * (x[1] - x[0]), -waves_over(x, x) - 0.5 * (x[:, np.newaxis] ** 2 + x**2)
    # With E* = 1 the deflection is (1/pi) int p/r, ours (2/pi^2) int P/r.
    mean = 2.0 / np.pi * 2.0 * np.pi / 3.0 / length**2
    other = 0.5 * np.pi * tamaas_pressure(tamaas, heights, length, mean, periodic=False)
    np.testing.assert_allclose(found.pressure, other, atol=1e-6 * other.max())
    assert np.count_nonzero(found.contact != (other > 0.0)) <= 2


def tamaas_pressure(tamaas, heights, length, mean, *, periodic=True):
    """Pressure of tamaas under heights over a square, with E* = 1 (doi:10.21105/joss.02121)."""
    tamaas.set_log_level(tamaas.LogLevel.error)
    model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [length] * 2, list(heights.shape))
    model.E, model.nu = 1.0, 0.0
    solver = tamaas.PolonskyKeerRey(model, heights, 1e-12)
    if not periodic:
        tamaas.ModelFactory.registerNonPeriodic(model, "dcfft")
        solver.setIntegralOperator("dcfft")
    solver.max_iter = 3000
    assert solver.solve(mean) < 1e-12
    return np.array(model.traction)


def test_load_of_whole_nodes_at_the_hardness():
    # No node is between zero and the hardness: 32 of 128 nodes are under one wave.
    x = (np.arange(128) + 0.5) / 128 - 0.5
    found = dry.periodic_contact(1.0 - np.cos(2.0 * np.pi * x), (1.0,), 0.25e-3, hardness=1e-3)
    assert (found.pressure == np.where(np.abs(x) < 0.125, 1e-3, 0.0)).all()
    assert (found.gap > -1e-12).all()


def test_initial_pressure_does_not_matter():
    x = np.linspace(-2.0, 2.0, 301)
    found = dry.line_contact(x, waves(x), hardness=5.0)
    one_node = np.where(np.arange(301) == 90, 1.0, 0.0)
    for start in (one_node, np.zeros(301), found.pressure):
        again = dry.line_contact(x, waves(x), hardness=5.0, start=start)
        np.testing.assert_allclose(again.pressure, found.pressure, atol=1e-7)
    assert again.iterations == 0
    # One node alone carries less than the hardness, and only others can move.
    light = dry.line_contact(x, waves(x), load=0.01)
    alone = dry.line_contact(x, waves(x), load=0.01, start=one_node)
    np.testing.assert_allclose(alone.pressure, light.pressure, atol=1e-7)


def test_impossible_loads_are_refused():
    x = np.linspace(-2.0, 2.0, 101)
    with pytest.raises(ValueError, match="hardness times the area"):
        dry.line_contact(x, hardness=0.3)
    with pytest.raises(ValueError, match="above zero"):
        dry.line_contact(x, load=0.0)
    with pytest.raises(RuntimeError, match="does not converge"):
        dry.line_contact(x, most=5)
