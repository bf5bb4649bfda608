"""Clearance of a mounted bearing: what fits and temperatures take of it."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.bearing.fits import Mounting, Temperatures, ThickRing, clearance_at

STEEL = 208e9, 0.3, 12.5e-6
ALUMINIUM = 70e9, 0.33, 22e-6
ZERO = 293.15


def mounting(on_shaft=0.0, in_housing=0.0, *, housing=STEEL, play=20e-6):
    """Bearing of 40 and 80 mm with elements of 12 mm."""
    return Mounting(
        shaft=ThickRing(0.0, 40e-3, *STEEL),
        inner_ring=ThickRing(40e-3, 48e-3 - 0.5 * play, *STEEL),
        outer_ring=ThickRing(72e-3 + 0.5 * play, 80e-3, *STEEL),
        housing=ThickRing(80e-3, 120e-3, *housing),
        element_diameter=12e-3,
        element_expansion=STEEL[2],
        shaft_interference=on_shaft,
        housing_interference=in_housing,
        reference_temperature=ZERO,
    )


def warm(**rises):
    parts = {part.name: ZERO for part in dataclasses.fields(Temperatures)}
    return Temperatures(**parts | {part: ZERO + rise for part, rise in rises.items()})


@given(temperature=st.floats(220.0, 500.0), play=st.floats(-1e-4, 1e-3))
def test_one_temperature_of_one_material_scales_the_clearance(temperature, play):
    """Without fits all lengths grow by 1 + a (T - T0), the clearance among them."""
    found = clearance_at(mounting(play=play), Temperatures.same(temperature))
    scale = 1.0 + STEEL[2] * (temperature - ZERO)
    assert found.clearance == pytest.approx(play * scale, rel=1e-9, abs=1e-16)
    assert abs(found.shaft_interference) < 1e-16
    assert abs(found.housing_interference) < 1e-16


def test_fits_take_what_rings_of_one_material_pass_on():
    """A solid shaft passes on d/d_i; the ring in its housing what Lame's two rings, by hand, do.

    With D/E = 80 mm/208 GPa the housing yields p D (120^2 + 80^2)/(120^2 - 80^2)/E = 2.6 p D/E plus 0.3, and
    the ring of 72.01 mm yields 9.545 p D/E less 0.3: p = delta E/(12.145 D). The raceway then shrinks by
    2 p d D^2/(D^2 - d^2)/E, 10.545 p d/E.
    """
    found = clearance_at(mounting(10e-6, -1e-6), warm())
    assert found.clearance == pytest.approx(20e-6 - 10e-6 * 40.0 / 47.99, rel=1e-12, abs=0.0)
    found = clearance_at(mounting(0.0, 10e-6), warm())
    ratio = 80.0**2 + 72.01**2, 80.0**2 - 72.01**2
    yields = 2.6 + ratio[0] / ratio[1]
    assert found.housing_pressure == pytest.approx(10e-6 * 208e9 / (yields * 80e-3), rel=1e-9, abs=0.0)
    loss = 10e-6 * 72.01 / 80.0 * 2.0 * 80.0**2 / ratio[1] / yields
    assert found.clearance == pytest.approx(20e-6 - loss, rel=1e-9, abs=0.0)
    # Both together: their losses add up.
    both = clearance_at(mounting(10e-6, 10e-6), warm())
    assert both.clearance == pytest.approx(20e-6 - 10e-6 * 40.0 / 47.99 - loss, rel=1e-9, abs=0.0)


def test_a_warm_housing_of_aluminium_lets_its_ring_go():
    """(22 - 12.5) 1e-6/K 50 K 80 mm = 38 um: an interference of 20 um is lost, and 18 um of play are left."""
    tight, housing = mounting(0.0, 20e-6, housing=ALUMINIUM), Temperatures.same(ZERO + 50.0)
    cold, hot = clearance_at(tight, warm()), clearance_at(tight, housing)
    assert cold.clearance < 20e-6 < hot.clearance
    assert hot.housing_interference == pytest.approx(-18e-6, rel=1e-9, abs=0.0)
    assert hot.housing_pressure == 0.0 < cold.housing_pressure


def test_a_warm_shaft_widens_the_inner_ring():
    """A shaft 10 K warmer than its ring adds 12.5e-6 10 40 mm = 5 um to the interference."""
    found = clearance_at(mounting(), warm(shaft=10.0))
    assert found.shaft_interference == pytest.approx(5e-6, rel=1e-9, abs=0.0)
    assert found.clearance == pytest.approx(20e-6 - 5e-6 * 40.0 / 47.99, rel=1e-9, abs=0.0)


@pytest.mark.slow
@given(
    fits=st.tuples(st.floats(-5e-5, 5e-5), st.floats(-5e-5, 5e-5)),
    more=st.floats(1e-9, 5e-5),
    rises=st.tuples(*[st.floats(-50.0, 100.0)] * 5),
    step=st.floats(0.1, 50.0),
)
def test_what_is_tighter_or_warmer_inside_takes_clearance(fits, more, rises, step):
    """More interference, warmer elements and shaft take clearance; a warmer housing gives none away."""
    names = [part.name for part in dataclasses.fields(Temperatures)]
    at = Temperatures(*(ZERO + rise for rise in rises))
    before = clearance_at(mounting(*fits), at).clearance
    least = 1e-15
    for tighter in ((fits[0] + more, fits[1]), (fits[0], fits[1] + more)):
        assert clearance_at(mounting(*tighter), at).clearance <= before + least
    for name, way in {"elements": -1.0, "shaft": -1.0, "inner_ring": -1.0, "housing": 1.0}.items():
        warmer = dataclasses.replace(at, **{name: ZERO + rises[names.index(name)] + step})
        assert way * (clearance_at(mounting(*fits), warmer).clearance - before) >= -least
