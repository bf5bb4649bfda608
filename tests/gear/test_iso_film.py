"""Specific film of ISO/TS 6336-22: printed exponents, and the flash temperature of a Hertzian heat source."""

from types import SimpleNamespace

import numpy as np
import pytest

from ehlectric.gear.iso_film import flash_temperature, iso_thickness
from tests.helpers.each import each

FILMS = {"reduced_radius": 0.01, "mean_speed": 5.0, "max_pressure": 1e9}
OIL = {"viscosity": 0.02, "alpha": 2e-8, "modulus": 220e9, "local": 0.9}


def thickness(**changes):
    films = {name: changes.get(name, value) for name, value in FILMS.items()}
    return iso_thickness(SimpleNamespace(**films), **{name: changes.get(name, OIL[name]) for name in OIL})


@each(
    "name, exponent",
    [
        ("reduced_radius", 0.3),  # rho_n U^0.7
        ("mean_speed", 0.7),
        ("max_pressure", -0.26),  # W^-0.13 with the square of the pressure
        ("viscosity", 0.7),
        ("alpha", 0.6),
        ("modulus", 0.16),  # 0.6 - 0.7 + 0.26
        ("local", 0.22),
    ],
)
def test_exponents_of_the_printed_formula(name, exponent):
    value = (FILMS | OIL)[name]
    assert np.log2(thickness(**{name: 2.0 * value}) / thickness()) == pytest.approx(exponent, rel=1e-9)


def test_a_number_of_the_printed_formula():
    """By hand: G = 4400, U = 0.1/2.2e9, W = 2 pi/220^2, S_GF = 1."""
    expected = 0.016 * 4400.0**0.6 * (0.1 / 2.2e9) ** 0.7 * (2.0 * np.pi / 48400.0) ** -0.13
    assert thickness(local=1.0) == pytest.approx(expected, rel=1e-12)


@each("sliding", [-2.0, 2.0])
def test_the_flash_temperature_is_the_peak_below_a_fast_source(sliding):
    """Largest rise of a half-space by a Hertzian flux q, the largest integral of q/(B sqrt(pi v (x - s))).

    Both bodies have this rise if they take heat in proportion to the root of their speeds.
    """
    half_width, load, mean, friction, product = 2e-4, 2e5, 5.0, 0.05, 46.0 * 7830.0 * 470.0
    solution = SimpleNamespace(
        films=SimpleNamespace(mean_speed=mean, sliding_speed=sliding, load=load, half_width=half_width),
        case=SimpleNamespace(gear=SimpleNamespace(material="steel")),
    )
    # s = x - t^2 removes the singularity of the integrand.
    x, share = np.linspace(-1.0, 1.0, 401)[1:, np.newaxis], (np.arange(400) + 0.5) / 400
    root = np.sqrt(x + 1.0)
    integral = np.max(
        np.mean(np.sqrt(np.maximum(1.0 - (x - (share * root) ** 2) ** 2, 0.0)), axis=1) * 2.0 * root[:, 0]
    )
    heat = friction * load * abs(sliding) * 2.0 / (np.pi * half_width)
    speeds = np.sqrt(mean + 0.5 * sliding) + np.sqrt(mean - 0.5 * sliding)
    expected = heat * np.sqrt(half_width) * integral / (np.sqrt(np.pi * product) * speeds)
    assert flash_temperature(solution, friction) == pytest.approx(expected, rel=0.01)
