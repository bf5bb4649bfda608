"""Films and fields of point contacts with rough surfaces."""

import numpy as np
import pytest

from ehlectric import solve
from tests.cases.test_point_case import point

# The 20 N circle at a speed at which 65 nodes give its film to some per cent.
FAST = {"entrainment_speed": "4 m/s"}
GRID = {"nodes": 65, "side": 3.0, "field_nodes": 33, "field_nodes_y": 33}
# An ellipse of ratio 3.4.
WIDE = {"radius_y": "60 mm", "load": "50 N"} | FAST


def rough(*tables, contact=FAST, **grid):
    return solve(point(contact, roughness=list(tables), grid=GRID | grid))


PIT = {"surface": 1, "generator": "pit", "depth": "0.2 um", "width": "60 um", "rim": "20 nm"}
PIT |= {"position": "20 um"}


@pytest.mark.slow
@pytest.mark.gate
def test_a_pit_and_its_mirror_image():
    """Off the middle no half of the contact is like the other; everything is turned over with the pit."""
    left = rough(PIT | {"position_y": "-40 um"})
    right = solve(left.case.replace(roughness=(PIT | {"position_y": "40 um"},)), beside_smooth=False)
    assert left.converged
    assert right.converged
    film, mirrored = left.film, right.film
    assert np.max(np.abs(film.thickness - film.thickness[:, ::-1])) > 1e-8
    np.testing.assert_allclose(mirrored.thickness[:, ::-1], film.thickness, rtol=1e-7)
    np.testing.assert_allclose(mirrored.pressure[:, ::-1], film.pressure, atol=1.0)
    np.testing.assert_array_equal(right.roughness[:, :, ::-1], left.roughness)
    x, y = film.minimum_position
    assert mirrored.minimum_position == pytest.approx((x, -y), abs=1e-12)
    # Solvers of fields stop at a relative 1e-10 or so of their charge.
    np.testing.assert_allclose(right.field.middle_strength[:, ::-1], left.field.middle_strength, rtol=1e-6)
    assert right.field.capacitance == pytest.approx(left.field.capacitance, rel=1e-8, abs=0.0)
    # Its gap is that of bodies with a pit in one: parabolas, deflection, heights and a rigid distance.
    conditions = left.conditions
    parabolas = 0.5 * film.x[:, np.newaxis] ** 2 / conditions.radius_x + 0.5 * film.y**2 / conditions.radius_y
    rigid = film.thickness - parabolas - film.deflection + left.roughness.sum(axis=0)
    assert np.ptp(rigid) < 1e-15
    assert left.roughness.min() < -0.15e-6
    # The smooth contact beside it is symmetric.
    assert np.array_equal(left.smooth.thickness, left.smooth.thickness[:, ::-1])


@pytest.mark.slow
def test_a_pit_in_the_middle_is_solved_by_half():
    """With the same film as one a nanometre off, which is not."""
    middle, beside = rough(PIT | {"position_y": 0.0}), rough(PIT | {"position_y": "1 nm"})
    film = middle.film
    assert film.converged
    assert beside.converged
    assert np.array_equal(film.thickness, film.thickness[:, ::-1])
    assert not np.array_equal(beside.film.thickness, beside.film.thickness[:, ::-1])
    np.testing.assert_allclose(beside.film.thickness, film.thickness, rtol=1e-4)
    # A pit is deeper than the film around it, and its oil stands under less pressure than without it.
    depth = film.thickness - middle.smooth.thickness
    assert 0.02e-6 < np.max(depth) < 0.2e-6


@pytest.mark.slow
def test_film_does_not_tell_which_surface_is_rough():
    first, second = (rough(PIT | {"surface": surface, "position_y": "40 um"}) for surface in (1, 2))
    np.testing.assert_allclose(second.film.thickness, first.film.thickness, rtol=1e-9)
    # Equal bodies: the field is turned upside down.
    strength = second.field.strength[:, :, ::-1]
    np.testing.assert_allclose(strength, first.field.strength, rtol=1e-6)
    assert second.field.capacitance == pytest.approx(first.field.capacitance, rel=1e-8, abs=0.0)


@pytest.mark.slow
def test_waves_along_the_lay_stay_so(tmp_path):
    """A profile that lies across entrainment is the same at all y: as the sinusoid it was measured from."""
    length, points = 1.2e-3, 1201
    x = np.linspace(-0.5 * length, 0.5 * length, points)
    z = 20e-9 * np.sin(2.0 * np.pi * x / 100e-6)
    lines = [f"{1e6 * a:.9g};{1e9 * b:.9g}" for a, b in zip(x, z, strict=True)]
    (tmp_path / "wave.csv").write_text("\n".join(["x [um];z [nm]", *lines]))
    from_file = rough({"surface": 1, "file": str(tmp_path / "wave.csv")}, contact=WIDE)
    made = {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm", "wavelength": "100 um"}
    exact = rough(made, contact=WIDE)
    assert exact.converged
    assert np.ptp(exact.roughness, axis=2).max() == 0.0
    np.testing.assert_allclose(from_file.roughness, exact.roughness, atol=2e-11)
    np.testing.assert_allclose(from_file.film.thickness, exact.film.thickness, rtol=2e-3)
    # Uniform across: both halves are alike, and the film is.
    assert np.array_equal(exact.film.thickness, exact.film.thickness[:, ::-1])
    ripple = exact.film.thickness - exact.smooth.thickness
    middle = ripple[:, exact.film.y.size // 2]
    inside = np.abs(exact.film.x) < 0.6 * exact.conditions.semi_axis_x
    # Waves are squeezed flat where the oil is stiff, and less than their height is left.
    assert 0.5e-9 < np.std(middle[inside]) < 20e-9 / np.sqrt(2.0)


@pytest.mark.slow
def test_waves_across_are_not_uniform():
    wave = {"surface": 2, "generator": "sinusoid", "amplitude": "10 nm", "wavelength": "60 um"}
    result = rough(wave | {"orientation": "90 deg", "phase": 0.4})
    assert result.converged
    expected = 10e-9 * np.sin(2.0 * np.pi * result.film.y / 60e-6 + 0.4)
    np.testing.assert_allclose(result.roughness[1], np.broadcast_to(expected, (65, 65)), atol=1e-20)
    assert np.max(np.abs(result.film.thickness - result.film.thickness[:, ::-1])) > 1e-9


@pytest.mark.slow
def test_rough_summary_and_smooth_companion():
    bump = {"surface": 2, "generator": "asperity", "height": "50 nm", "width": "80 um"}
    result = rough(bump)
    alone = solve(result.case.replace(roughness=()))
    np.testing.assert_array_equal(result.smooth.thickness, alone.film.thickness)
    assert alone.smooth is None
    assert solve(result.case, beside_smooth=False).smooth is None
    roughness = result.summary()["roughness"]
    assert roughness["smooth_minimum_thickness"] == alone.film.minimum_thickness
    film, conditions = result.film, result.conditions
    a = conditions.semi_axis_x
    inside = np.hypot(film.x[:, np.newaxis], film.y) <= a
    rq = np.std(result.roughness[1][inside])
    assert roughness["rq_1"] == 0.0
    assert roughness["rq_2"] == roughness["rq_combined"] == pytest.approx(rq, rel=1e-12, abs=0.0)
    assert roughness["lambda_ratio"] == pytest.approx(film.minimum_thickness / rq, rel=1e-12, abs=0.0)


@pytest.mark.slow
def test_roughness_higher_than_the_film_touches():
    table = {"surface": 1, "generator": "gaussian", "rq": "0.3 um", "correlation_length": "20 um", "seed": 1}
    result = rough(table, contact={"entrainment_speed": "0.2 m/s"})
    assert result.converged
    assert result.film.minimum_thickness == pytest.approx(1e-9, rel=1e-6)
    assert "asperities-touch" in [warning.code for warning in result.warnings]
    assert np.all(np.isfinite(result.field.strength))
