"""Oil and gas behind the exit: conservation of mass, bounds of mixtures, and the capacitance of an outlet."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.constants import epsilon_0
from scipy.integrate import quad

from ehlectric.discharge.film_capacitance import OUTLETS, oil_fraction, zone_capacitances
from ehlectric.field.zones import line_zone_areas
from tests.discharge.gap_films import line_gap, line_gap_field
from tests.field.exact_fields import near

fractions = st.floats(0.0, 1.0)
permittivities = st.floats(1.0, 1e3)


def filled(outlet, permittivity, fraction):
    return float(OUTLETS[outlet](np.array([permittivity]), np.array([fraction]))[0])


@given(permittivity=permittivities, fraction=fractions)
def test_mixtures_are_between_gas_and_oil(permittivity, fraction):
    """Layers are the least of all arrangements, fingers the most (Wiener), and oil alone is more still."""
    rounding = 1.0 + 1e-12
    values = [1.0, *(filled(name, permittivity, fraction) for name in ("layers", "fingers", "full"))]
    assert all(less <= rounding * more for less, more in pairwise(values))
    assert values[-1] == permittivity


@given(permittivity=permittivities, fraction=fractions, outlet=st.sampled_from(sorted(OUTLETS)))
def test_limits_of_mixtures(permittivity, fraction, outlet):
    """Oil alone, gas alone, and oil that is no different from gas."""
    assert filled(outlet, permittivity, 1.0) == near(permittivity, 1e-14)
    assert filled(outlet, permittivity, 0.0) == (permittivity if outlet == "full" else 1.0)
    assert filled(outlet, 1.0, fraction) == near(1.0, 1e-12)


def test_plates_in_parallel_and_in_series():
    """A gap of 1 um, a quarter of it oil of 2.4. Side by side: 0.25 2.4 + 0.75. In series: oil of 0.25 um
    and gas of 0.75 um, 1/(0.25/2.4 + 0.75).
    """
    assert filled("fingers", 2.4, 0.25) == near(1.35, 1e-14)
    assert filled("layers", 2.4, 0.25) == near(1.17073, 1e-5)


# Films of which the walls part or come nearer, in any order, with an exit anywhere.
lines = st.integers(3, 12).flatmap(
    lambda nodes: st.tuples(
        st.lists(st.floats(1e-9, 1e-4), min_size=nodes, max_size=nodes),
        st.lists(st.floats(1.0, 1.3), min_size=nodes, max_size=nodes),
        st.lists(st.booleans(), min_size=nodes, max_size=nodes),
    )
)


@given(lines)
def test_mass_is_conserved_behind_the_exit(line):
    thickness, density, cavitated = (np.array(values) for values in line)
    fraction = oil_fraction(thickness, density, cavitated)
    mass = thickness * density
    carried = np.inf
    for k in range(thickness.size):
        if cavitated[k] and k and not cavitated[k - 1]:
            # What came through the ends before, or less where this one is narrower.
            carried = min(carried, mass[k])
        # A gap that is too narrow for it, or in which a film has formed, is full.
        expected = mass[k] if not cavitated[k] else min(carried, mass[k])
        assert fraction[k] * mass[k] == near(expected, 1e-14)
    assert np.all((fraction > 0.0) & (fraction <= 1.0))


def test_films_that_form_again_bring_no_oil():
    """Behind X = 1 a gap opens as X^2; four nodes far behind are full again, by some pascals."""
    x = np.linspace(-2.0, 2.0, 801)
    thickness, cavitated = np.maximum(1.0, x**2) * 1e-7, x > 1.0
    once = oil_fraction(thickness, np.ones(801), cavitated)
    again = cavitated.copy()
    again[780:784] = False
    twice = oil_fraction(thickness, np.ones(801), again)
    assert np.all(twice[780:784] == 1.0)
    assert np.array_equal(np.delete(twice, range(780, 784)), np.delete(once, range(780, 784)))
    assert once[-1] == near(0.25, 0.02)  # one node off X = 1


@pytest.mark.slow
@given(st.lists(lines, min_size=1, max_size=4).filter(lambda many: len({len(line[0]) for line in many}) == 1))
def test_every_line_of_a_point_contact_has_its_own_exit(many):
    arrays = [np.array([line[k] for line in many]).T for k in range(3)]
    together = oil_fraction(*arrays)
    for j in range(len(many)):
        np.testing.assert_array_equal(together[:, j], oil_fraction(*(values[:, j] for values in arrays)))


def test_unit_of_the_film_does_not_matter():
    h = np.array([3.0, 1.0, 2.0, 5.0])
    cavitated = np.array([True, False, True, True])
    np.testing.assert_allclose(
        oil_fraction(1e-6 * h, 870.0 + 0.0 * h, cavitated), [1.0, 1.0, 1.0, 0.4], rtol=1e-14
    )


@pytest.mark.parametrize("outlet", sorted(OUTLETS))
def test_outlet_behind_a_parabola(outlet):
    """A gap h0 + x^2/2R that oil leaves at x = b: its outlet by adaptive quadrature of eps0 eps/h, where the
    permittivity of the oil is 2.4 and its fraction h(b)/h(x) (1e-4: the slope of the walls, squared).
    """
    b, radius, least, permittivity = 0.1e-3, 14e-3, 0.5e-6, 2.4
    x = np.linspace(-4.0 * b, 3.0 * b, 2801)

    def gap(at):
        return least + at**2 / (2.0 * radius)

    film = line_gap(x, gap(x), exit_node=2000)
    assert x[2000] == near(b, 1e-12)
    field = line_gap_field(film, np.abs(x) < 1.5 * b, permittivity=permittivity)
    zones = line_zone_areas((film.x,), b), line_zone_areas((field.x,), b)
    found = zone_capacitances(film, field, zones, permittivity + 0.0 * film.density)[outlet]

    def density(at):
        fraction = gap(b) / gap(at)
        mixed = {
            "full": permittivity,
            "fingers": 1.0 + (permittivity - 1.0) * fraction,
            "layers": permittivity / (fraction + permittivity * (1.0 - fraction)),
        }
        return epsilon_0 * mixed[outlet] / gap(at)

    exact, error = quad(density, b, 3.0 * b, epsabs=0.0, epsrel=1e-10)
    assert error < 1e-9 * exact
    assert found["outlet"] == near(exact, 1e-4)
    hertz, _ = quad(lambda at: epsilon_0 * permittivity / gap(at), -b, b, epsabs=0.0, epsrel=1e-10)
    assert found["hertz"] == near(hertz, 1e-4)
