"""The paper's eight contacts: capacitance over that of plates, and what spike and constriction matter."""

import math

import numpy as np
import pytest
from scipy.constants import epsilon_0
from scipy.integrate import quad

from ehlectric import solve
from tests.field.exact_fields import near

pytestmark = pytest.mark.published

LOADS = {"1 GPa": 3.925e5, "2 GPa": 1.57e6}
SPEEDS = (8.0, 4.0, 2.0, 1.0)
# Ratio to eps0 eps_r 2b/h(0) over X in [-4, 2] at 8 and at 1 m/s, reckoned independently of this code, as
# handed over with the project's specification; to two decimals.
RATIOS = {"1 GPa": (1.65, 1.38), "2 GPa": (1.43, 1.30)}


@pytest.fixture(scope="module")
def solved(paper_case):
    """Solutions by Hertz pressure and speed, each computed once."""
    case = paper_case.replace({"discharge.dielectric_strength": "15 V/um"})
    return {
        (load, u_s): solve(
            case.replace({"contact.load_per_length": w, "contact.entrainment_speed": 0.5 * u_s})
        )
        for load, w in LOADS.items()
        for u_s in SPEEDS
    }


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("load", LOADS)
def test_ratio_to_plates(solved, load):
    ratios = [solved[load, u_s].discharge.capacitance_ratio for u_s in SPEEDS]
    assert [ratios[0], ratios[-1]] == pytest.approx(RATIOS[load], rel=0.0, abs=0.005)
    assert ratios == sorted(ratios, reverse=True)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("u_s", SPEEDS)
def test_dry_contact_with_a_film_is_nearly_it(solved, load, u_s):
    """By quadrature: the gap of the dry contact, b^2/(2R) (X sqrt(X^2 - 1) - ln(X + sqrt(X^2 - 1))), lifted
    by h(0), with the permittivity at the Hertz pressure. It has no spike, no constriction and no inlet sweep,
    and is right to 3 %.
    """
    result = solved[load, u_s]
    b, radius = result.conditions.half_width, result.conditions.reduced_radius
    least, pressure = result.film.central_thickness, result.conditions.max_pressure
    oil = result.case.oil

    def dense(at):
        at = abs(at)
        outside = math.sqrt(max(0.0, at**2 - 1.0))
        gap = 0.5 * b**2 / radius * (at * outside - math.log(at + outside)) if at > 1.0 else 0.0
        of_hertz = np.array([max(1e5, pressure * math.sqrt(max(0.0, 1.0 - at**2)))])
        density = oil.density_ratio(of_hertz)[0]
        return float(oil.permittivity(of_hertz, density)[0]) / (least + gap)

    exact = epsilon_0 * b * quad(dense, -4.0, 2.0, points=[-1.0, 1.0], epsabs=0.0, epsrel=1e-6, limit=200)[0]
    assert result.discharge.capacitance == near(exact, 0.03)


def hertz_zone(result):
    """X over abs(X) <= 1, the film h there and h(0), the permittivity and that at the Hertz pressure."""
    film, oil = result.film, result.case.oil
    b, pressure = result.conditions.half_width, result.conditions.max_pressure
    x = np.linspace(-1.0, 1.0, 20_001)
    thickness = np.interp(b * x, film.x, film.thickness)
    solved = oil.permittivity(np.interp(b * x, film.x, film.pressure), np.interp(b * x, film.x, film.density))
    of_hertz = np.maximum(1e5, pressure * np.sqrt(np.maximum(0.0, 1.0 - x**2)))
    dry = oil.permittivity(of_hertz, oil.density_ratio(of_hertz)[0])
    return x, thickness, film.central_thickness, solved, dry


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("u_s", SPEEDS)
def test_spike_and_constriction_hardly_matter(solved, load, u_s):
    """Claimed by Schneider et al., as the paper quotes them. A film 15 % thinner over a tenth of the zone is
    1.5 % / 2 of its capacitance, and a spike over a hundredth of it, where the permittivity may be a tenth
    more, a thousandth. Parallel plates at h(0) with the permittivity of the Hertz pressure have 1 to 2 % more
    than the zone, as its film widens at both ends. The pressure itself does matter, by 15 to 19 %.
    """
    result = solved[load, u_s]
    x, film, central, solved_eps, dry = hertz_zone(result)

    def integral(density):
        return float(np.trapezoid(density, x))

    whole = integral(solved_eps / film)
    hertz = epsilon_0 * result.conditions.half_width * whole
    assert result.discharge.capacitance_hertz == near(hertz, 1e-4)
    constriction = (x > 0.0) & (film < central)
    assert np.any(constriction)
    without = integral(solved_eps / np.where(constriction, central, film))
    assert 0.0 < 1.0 - without / whole < 0.01
    no_spike = integral(np.minimum(solved_eps, dry) / film)
    assert 0.0 < 1.0 - no_spike / whole < 0.003
    assert 0.005 < integral(solved_eps) / central / whole - 1.0 < 0.02
    assert 0.0 < integral(dry / film) / whole - 1.0 < 0.01
    assert 0.01 < integral(dry) / central / whole - 1.0 < 0.02
    ambient = result.case.oil.relative_permittivity
    assert 0.8 < integral(ambient / film) / whole < 0.86


@pytest.mark.parametrize("load", LOADS)
def test_breakdown_voltage_is_strength_times_least_film(solved, load):
    """The largest field is voltage/h_min to 1e-3 (DESIGN); 15 V/um."""
    for u_s in SPEEDS:
        result = solved[load, u_s]
        expected = 15e6 * result.film.minimum_thickness
        assert result.discharge.breakdown_voltage == near(expected, 1e-3)
        assert result.discharge.margin == near(0.5 * expected, 1e-3)
