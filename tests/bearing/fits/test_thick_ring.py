"""Growth of thick rings and pressure of fits: closed forms, limits, and a boundary-value solver."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_bvp

from ehlectric.bearing.fits import ThickRing, fit_pressure

STEEL = 208e9, 0.3, 12.5e-6
ALUMINIUM = 70e9, 0.33, 22e-6


def test_a_solid_shaft_in_a_ring_of_its_material_widens_it_by_the_ratio_of_the_diameters():
    """p = E delta (1 - d^2/D^2)/(2 d) and 2 p d^2 D/(E (D^2 - d^2)): the outside grows by delta d/D."""
    shaft, ring = ThickRing(0.0, 40e-3, *STEEL), ThickRing(40e-3, 48e-3, *STEEL)
    pressure = fit_pressure(shaft, ring, 10e-6)
    assert pressure == pytest.approx(208e9 * 10e-6 * (1.0 - (40.0 / 48.0) ** 2) / 80e-3, rel=1e-12, abs=0.0)
    assert ring.growth(48e-3, bore_pressure=pressure) == pytest.approx(10e-6 * 40 / 48, rel=1e-12, abs=0.0)


def test_a_rigid_housing_narrows_the_ring_in_it():
    """A housing that does not yield takes the whole interference from the outside of the ring."""
    ring = ThickRing(72e-3, 80e-3, *STEEL)
    rigid = ThickRing(80e-3, math.inf, 1e30, 0.3, 0.0)
    pressure = fit_pressure(ring, rigid, 10e-6)
    assert ring.growth(80e-3, outside_pressure=pressure) == pytest.approx(-10e-6, rel=1e-12, abs=0.0)
    # By hand: the bore moves by 2 d D/(D^2 + d^2 - nu (D^2 - d^2)) times as much, 2 72 80/11219.2.
    bore = ring.growth(72e-3, outside_pressure=pressure)
    assert bore == pytest.approx(-10e-6 * 11520.0 / 11219.2, rel=1e-9, abs=0.0)


def test_a_housing_without_an_end_is_the_limit_of_thick_ones():
    """Lame's wall with a bore in infinite material grows by (1 + nu) p d/E."""
    endless = ThickRing(80e-3, math.inf, *ALUMINIUM)
    assert endless.growth(80e-3, bore_pressure=1e7) == pytest.approx(1.33 * 1e7 * 80e-3 / 70e9, rel=1e-12)
    thick = ThickRing(80e-3, 80.0, *ALUMINIUM)
    assert thick.growth(80e-3, bore_pressure=1e7) == pytest.approx(
        endless.growth(80e-3, bore_pressure=1e7), rel=1e-5
    )


@given(part=st.floats(1e-6, 1e-3))
def test_a_thin_ring_is_a_hoop(part):
    """p d^2/(2 t E) for a wall thickness t that is a small part of the diameter."""
    thin = ThickRing(1.0, 1.0 + 2.0 * part, *STEEL)
    hoop = 1e6 / (2.0 * part * 208e9)
    assert thin.growth(1.0, bore_pressure=1e6) == pytest.approx(hoop, rel=5.0 * part)
    assert thin.growth(1.0 + 2.0 * part, bore_pressure=1e6) == pytest.approx(hoop, rel=5.0 * part)


def test_equal_pressures_squeeze_a_ring_as_a_solid():
    """Under one pressure inside and outside every diameter shrinks by (1 - nu) p/E."""
    ring = ThickRing(40e-3, 48e-3, *STEEL)
    for diameter in (40e-3, 44e-3, 48e-3):
        growth = ring.growth(diameter, bore_pressure=1e8, outside_pressure=1e8)
        assert growth == pytest.approx(-0.7 * 1e8 * diameter / 208e9, rel=1e-10)


@given(
    bore=st.floats(0.0, 0.9),
    outer=st.floats(1.05, 3.0),
    moduli=st.tuples(st.floats(5e10, 4e11), st.floats(5e10, 4e11)),
    ratios=st.tuples(st.floats(0.1, 0.45), st.floats(0.1, 0.45)),
    interference=st.floats(-1e-4, 1e-3),
)
def test_the_fit_closes_exactly(bore, outer, moduli, ratios, interference):
    """Bore and shaft give way by the interference together; a loose fit has no pressure."""
    shaft = ThickRing(bore, 1.0, moduli[0], ratios[0], 0.0)
    ring = ThickRing(1.0, outer, moduli[1], ratios[1], 0.0)
    pressure = fit_pressure(shaft, ring, interference)
    way = ring.growth(1.0, bore_pressure=pressure) - shaft.growth(1.0, outside_pressure=pressure)
    assert way == pytest.approx(max(interference, 0.0), rel=1e-9, abs=0.0)
    if bore > 0.0:
        # A hollow shaft gives way, so that it presses and widens less than a solid one.
        solid = fit_pressure(ThickRing(0.0, 1.0, moduli[0], ratios[0], 0.0), ring, interference)
        assert pressure <= solid * (1.0 + 1e-12)


def test_shaft_and_ring_are_those_of_the_equations_of_elasticity():
    """Displacement u(r) of a hollow aluminium shaft in a steel ring, both warm, by a numerical solver.

    Unknown are u and the radial stress s of both parts over x from 0 to 1: with e = u/r, plane stress gives
    u' = (1 - nu^2) s/E - nu (e - a T) + a T and s' = (E (e - a T) + nu s - s)/r.
    """
    ends = (10e-3, 20e-3), (20e-3, 24e-3)
    materials, rises = (ALUMINIUM, STEEL), (60.0, 45.0)
    interference = 8e-6

    def slopes(x, y):
        found = []
        for k, ((start, stop), (modulus, nu, expansion), rise) in enumerate(
            zip(ends, materials, rises, strict=True)
        ):
            radius, u, stress = start + x * (stop - start), y[2 * k], y[2 * k + 1] * 1e8
            strain, free = u * 1e-6 / radius, expansion * rise
            hoop = modulus * (strain - free) + nu * stress
            found.append(((stress - nu * hoop) / modulus + free) * (stop - start) * 1e6)
            found.append((hoop - stress) / radius * (stop - start) / 1e8)
        return np.array(found)

    def boundary(start, stop):
        # Free bore and outside; one stress and, but for the radial interference, one place in the fit.
        gap = start[2] - stop[0] - 0.5 * interference * 1e6
        return np.array([start[1], stop[3], stop[1] - start[3], gap])

    x = np.linspace(0.0, 1.0, 60)
    found = solve_bvp(slopes, boundary, x, np.zeros((4, x.size)), tol=1e-10, max_nodes=20000)
    assert found.success
    shaft, ring = ThickRing(20e-3, 40e-3, *ALUMINIUM), ThickRing(40e-3, 48e-3, *STEEL)
    warm = interference + shaft.warmed(40e-3, rises[0]) - ring.warmed(40e-3, rises[1])
    pressure = fit_pressure(shaft, ring, warm)
    assert pressure == pytest.approx(-found.y[3][0] * 1e8, rel=1e-6, abs=0.0)
    outside = ring.growth(48e-3, bore_pressure=pressure) + ring.warmed(48e-3, rises[1])
    assert outside == pytest.approx(2e-6 * found.y[2][-1], rel=1e-6, abs=0.0)
    inside = shaft.growth(20e-3, outside_pressure=pressure) + shaft.warmed(20e-3, rises[0])
    assert inside == pytest.approx(2e-6 * found.y[0][0], rel=1e-6, abs=0.0)
