"""Oil over temperature against the equations of the standards, done by hand or by another way."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import InputError
from ehlectric.lubricant.properties_over_temperature import density
from ehlectric.lubricant.viscosity import roelands, roelands_alpha
from ehlectric.lubricant.viscosity_over_temperature import COLD, HOT, Walther
from tests.helpers.each import each

VG46 = Walther.of(46e-6, 6.8e-6)
oils = st.tuples(st.floats(5e-6, 1e-3), st.floats(0.1, 0.9)).map(
    lambda pair: (pair[0], max(2.1e-6, pair[0] * pair[1]))
)


@given(oil=oils)
def test_through_both_points(oil):
    at_40, at_100 = oil
    walther = Walther.of(at_40, at_100)
    assert walther.viscosity(COLD) == pytest.approx(at_40, rel=1e-9, abs=0.0)
    assert walther.viscosity(HOT) == pytest.approx(at_100, rel=1e-9, abs=0.0)


@each("celsius", [-10.0, 20.0, 55.0, 70.0, 120.0])
def test_a_straight_line_on_the_paper_of_the_standard(celsius):
    """log10 log10(nu + 0.7) over log10 T by linear interpolation between the two points, or beyond them."""
    double = [math.log10(math.log10(nu + 0.7)) for nu in (46.0, 6.8)]
    line = np.polynomial.Polynomial.fit(np.log10([313.15, 373.15]), double, 1)
    nu = 10.0**10.0 ** line(math.log10(celsius + 273.15)) - 0.7
    assert VG46.viscosity(celsius + 273.15) == pytest.approx(1e-6 * nu, rel=1e-9, abs=0.0)


def test_at_70_degrees_by_hand():
    """0.22254 and -0.05796 at 40 and 100 degC, 0.52188 of the way: 10^10^0.07615 - 0.7 = 14.85 mm^2/s."""
    assert VG46.viscosity(343.15) * 1e6 == pytest.approx(10.0**10.0**0.07615 - 0.7, rel=2e-4, abs=0.0)


@pytest.mark.parametrize(
    ("at_40", "at_100", "text"),
    [
        (46e-6, 46e-6, "falls with temperature"),
        (46e-6, 60e-6, "falls with temperature"),
        (5e-6, 0.2e-6, r"2\.1e-07 m\^2/s"),
    ],
)
def test_oils_that_are_none(at_40, at_100, text):
    with pytest.raises(InputError, match=rf"^temperature\.kinematic_viscosity_100: .*{text}"):
        Walther.of(at_40, at_100)


@pytest.mark.parametrize(("temperature", "text"), [(973.15, r"0\.21 mm"), (60.0, "solid")])
def test_temperatures_that_are_none(temperature, text):
    with pytest.raises(InputError, match=f"^temperature: .* {temperature:g} K.*{text}"):
        VG46.viscosity(temperature)


def test_density():
    """rho_15 at 15 degC; 55 K above 3.575 % less with the default of 6.5e-4 1/K."""
    assert density(870.0, 6.5e-4, 288.15) == 870.0
    assert density(870.0, 6.5e-4, 343.15) == pytest.approx(870.0 * (1.0 - 0.03575), rel=1e-12, abs=0.0)


@given(
    viscosity=st.floats(1e-3, 10.0),
    z=st.floats(0.3, 0.9),
    p0=st.floats(0.1e9, 0.3e9),
)
def test_alpha_is_the_slope_of_roelands_law_at_ambient_pressure(viscosity, z, p0):
    """d ln eta/dp of (ln eta0 + 9.67)(-1 + (1 + p/p0)^z) by a difference over 1 kPa."""
    alpha = roelands_alpha(viscosity, z, p0)
    grown = (math.log(viscosity) + 9.67) * math.expm1(z * math.log1p(1e3 / p0))
    assert alpha == pytest.approx(grown / 1e3, rel=1e-5, abs=0.0)


@each("viscosity", [0.004, 0.0125, 0.04, 0.4])
def test_lines_of_all_temperatures_meet_in_the_pole_of_roelands(viscosity):
    """Towards p = -p0 every oil at every temperature has e^-9.67 = 6.3e-5 Pa s: the law that films take."""
    alpha = roelands_alpha(viscosity, 0.67, 0.198e9)
    exponent, _ = roelands(
        -0.198e9 * (1.0 - 1e-15),
        pressure_viscosity_coefficient=alpha,
        roelands_z=0.67,
        roelands_pressure=0.198e9,
    )
    assert viscosity * math.exp(float(exponent)) == pytest.approx(math.exp(-9.67), rel=1e-6, abs=0.0)
