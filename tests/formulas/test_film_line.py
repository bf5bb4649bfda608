"""Film formulas against their limits and the paper's own groups."""

import dataclasses
import math

import pytest

from ehlectric.formulas import film_line as film_formulas
from ehlectric.formulas.film_line import LineContact
from tests.helpers.each import each

PAPER = LineContact(
    reduced_radius=14.1e-3,
    reduced_modulus=226e9,
    load_per_length=1.57e6,
    entrainment_speed=4.0,
    viscosity=0.04,
    pressure_viscosity_coefficient=22e-9,
)


def test_moes_groups_of_the_paper():
    # Table 3 of the paper, u_s = 8 m/s.
    assert PAPER.moes_m == pytest.approx(49.2, abs=0.05)
    assert PAPER.moes_l == pytest.approx(15.7, abs=0.05)


def test_figure_6_prints_68_where_the_group_is_69_5():
    assert dataclasses.replace(PAPER, entrainment_speed=2.0).moes_m == pytest.approx(69.5, abs=0.05)


def dimensionless(contact):
    """H = (h/R) (eta0 u_s/(E' R))^(-1/2) of the Moes formula."""
    u_s = 2 * contact.entrainment_speed * contact.viscosity
    scale = contact.reduced_radius * (u_s / (contact.reduced_modulus * contact.reduced_radius)) ** 0.5
    return film_formulas.moes(contact).central_thickness / scale


def contact_of(moes_m, moes_l):
    """A contact with E' = R = 1 and the groups asked for."""
    u_s = 1e-10
    alpha = moes_l / u_s**0.25
    return LineContact(
        reduced_radius=1.0,
        reduced_modulus=1.0,
        load_per_length=moes_m * u_s**0.5,
        entrainment_speed=0.5 * u_s,
        viscosity=1.0,
        pressure_viscosity_coefficient=alpha,
    )


# The four limits of the formula; 3/M is exact, the film of zero pressure gradient of Martin's contact.
@each(
    "moes_m, moes_l, expected, regime",
    [
        (1e-3, 0.0, 3e3, "isoviscous-rigid"),
        (1e4, 0.0, 2.621 * 1e4**-0.2, "isoviscous-elastic"),
        (1.0, 1e6, 1.287 * 1e4, "piezoviscous-rigid"),
        (1e6, 1e3, 1.311 * 1e6**-0.125 * 1e3**0.75, "piezoviscous-elastic"),
    ],
)
def test_moes_limits(moes_m, moes_l, expected, regime):
    contact = contact_of(moes_m, moes_l)
    assert dimensionless(contact) == pytest.approx(expected, rel=0.02, abs=0.0)
    assert film_formulas.regime(contact) == regime


def test_formulas_are_within_thirty_percent_of_the_solved_film(paper_result):
    film = paper_result.film
    for formula in film_formulas.FORMULAS.values():
        for name, value in vars(formula(PAPER)).items():
            if value is not None:
                assert value == pytest.approx(getattr(film, name), rel=0.3, abs=0.0)


# U = 1e-11, G = 1e4, W = 1e-4: powers of ten, so that the formulas can be done by hand.
ROUND = LineContact(
    reduced_radius=1.0,
    reduced_modulus=1e11,
    load_per_length=1e7,
    entrainment_speed=1.0,
    viscosity=1.0,
    pressure_viscosity_coefficient=1e-7,
)


@pytest.mark.parametrize(
    ("name", "minimum", "central"),
    [
        ("dowson_higginson", 2.65e-5 * 10**-0.02, None),  # 10^(-7.70 + 2.16 + 0.52)
        ("dowson_toyoda", None, 3.06e-5 * 10**0.05),  # 10^(-7.59 + 2.24 + 0.40)
        (
            "pan_hamrock",
            1.714e-5 * 10**0.150,
            2.922e-5 * 10**-0.068,
        ),  # -7.634+2.272+0.512, -7.612+1.880+0.664
    ],
)
def test_power_laws_by_hand(name, minimum, central):
    thickness = film_formulas.FORMULAS[name](ROUND)
    for value, expected in ((thickness.minimum_thickness, minimum), (thickness.central_thickness, central)):
        assert value == (None if expected is None else pytest.approx(expected, rel=1e-9, abs=0.0))


def test_moes_between_its_limits_by_hand():
    """M = L = 1: 3, 2.621, 1.287 and 1.311, s = (7 + 8 exp(-1.7473))/5 = 1.6788; term by term below."""
    s = (7 + 8 * math.exp(-2 * 2.621 / 3)) / 5
    assert s == pytest.approx(1.6788, abs=1e-4)
    isoviscous = (12.980 + 9.470) ** (3 * s / 7)  # 3^(7/3), 2.621^(7/3)
    piezoviscous = (0.41358 + 0.38769) ** (-2 * s / 7)  # 1.287^(-7/2), 1.311^(-7/2)
    assert dimensionless(contact_of(1.0, 1.0)) == pytest.approx(
        (isoviscous + piezoviscous) ** (1 / s), rel=1e-3, abs=0.0
    )


def test_isoviscous_contact_has_only_the_moes_film():
    contact = dataclasses.replace(PAPER, pressure_viscosity_coefficient=0.0)
    given = {name for name, f in film_formulas.FORMULAS.items() if any(vars(f(contact)).values())}
    assert given == {"moes"}
