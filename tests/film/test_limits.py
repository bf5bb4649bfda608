"""Limits the solutions tend to, and how fast."""

import numpy as np
import pytest
from scipy.constants import epsilon_0

from ehlectric import Case, solve
from ehlectric.field.line_field import solve_field
from ehlectric.field.poisson import FieldProblem
from ehlectric.formulas.hertz import line_gap, line_pressure
from tests.film.martin import film_coefficient

pytestmark = pytest.mark.convergence


def test_slow_contacts_tend_to_the_dry_one(paper_case, slope):
    """Pressure and gap of Hertz; beside the contact the gap differs by about the film itself."""
    films, insides, everywhere, gaps = [], [], [], []
    for speed in (4.0, 1.0, 0.25, 0.0625):
        changes = {"contact.max_hertz_pressure": "1 GPa", "contact.entrainment_speed": speed}
        result = solve(paper_case.replace(changes))
        film, conditions = result.film, result.conditions
        x = film.x / conditions.half_width
        pressure = np.abs(film.pressure / conditions.max_pressure - line_pressure(x))
        gap = film.thickness / conditions.thickness_scale - line_gap(x)
        films.append(film.central_thickness / conditions.thickness_scale)
        insides.append(np.max(pressure[np.abs(x) < 0.7]))
        everywhere.append(np.trapezoid(pressure, x))
        gaps.append(np.max(np.abs(gap[(x > -3.0) & (x < -1.5)])))
    assert np.all(np.diff([films, insides, everywhere, gaps]) < 0.0)
    assert slope(films, gaps) == pytest.approx(1.0, abs=0.05)
    assert slope(films, insides) > 0.7
    assert insides[-1] < 0.005
    assert everywhere[-1] < 0.02


def test_light_isoviscous_contacts_tend_to_the_rigid_one(slope):
    """Deflection w/E' over film eta0 u R/w is M^2: that far Martin's constant is off."""
    radius, modulus, viscosity, speed_parameter = 0.01, 2e11, 0.1, 1e-11
    groups, differences = [0.6, 0.4, 0.3, 0.2], []
    for moes_m in groups:
        load = moes_m * np.sqrt(speed_parameter) * modulus * radius
        speed = 0.5 * speed_parameter * modulus * radius / viscosity
        case = Case.from_dict(
            {
                "contact": {
                    "reduced_radius": radius,
                    "reduced_modulus": modulus,
                    "load_per_length": load,
                    "entrainment_speed": speed,
                },
                "lubricant": {
                    "viscosity": viscosity,
                    "viscosity_law": "constant",
                    "density_law": "incompressible",
                    "relative_permittivity": 2.4,
                    "ambient_pressure": 0.0,
                },
                "grid": {"nodes": 3201, "inlet": -14.0 / moes_m, "outlet": 5.0 / moes_m},
            }
        )
        result = solve(case)
        minimum = result.film.minimum_thickness
        rigid = film_coefficient(result.film.x[0] / np.sqrt(2.0 * radius * minimum))
        differences.append(minimum * load / (viscosity * speed * radius) / rigid - 1.0)
    assert 0.0 < differences[-1] < 0.02
    assert slope(groups, differences) == pytest.approx(2.0, abs=0.15)


@pytest.mark.slow
@pytest.mark.parametrize("bend", [0.0, 0.7])
def test_long_gaps_tend_to_the_thin_one(slope, bend):
    """Walls and permittivity of one shape, ever longer against the gap.

    The energy of V = s, eps/h times 1 + l'^2 + l' h' + h'^2/3 with the lower wall l, is that of the field
    but for the fourth power of the slope, as V is right but for the second; and so is V/h.
    """
    t = np.linspace(0.0, 1.0, 12_801)
    gap = 1.0 + 0.5 * np.cos(2 * np.pi * t)
    lower = bend * np.cos(np.pi * t)
    permittivity = 2.4 + np.cos(np.pi * t)
    lengths = np.array([16.0, 32.0, 64.0])
    capacitances, strengths = [], []
    for length in lengths:
        field = solve_field(FieldProblem(length * t, lower, lower + gap, permittivity, 0.0, 1.0))
        down, open_ = (np.gradient(h, length * t, edge_order=2) for h in (lower, gap))
        square = 1.0 + down**2 + down * open_ + open_**2 / 3.0
        linear = epsilon_0 * np.trapezoid(permittivity / gap * square, length * t)
        capacitances.append(abs(field.capacitance / linear - 1.0))
        strengths.append(np.max(np.abs(field.middle_strength * gap - 1.0)))
    assert slope(1.0 / lengths, capacitances) == pytest.approx(4.0, abs=0.2)
    assert slope(1.0 / lengths, strengths) == pytest.approx(2.0, abs=0.1)
