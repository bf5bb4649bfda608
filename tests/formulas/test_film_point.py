"""Film formulas of point contacts against hand calculation, each other and their limits."""

import dataclasses

import numpy as np
import pytest

from ehlectric.formulas import film_line as film_formulas
from ehlectric.formulas import film_point as point_formulas
from ehlectric.formulas.film_line import LineContact
from ehlectric.formulas.film_point import FORMULAS, PointContact
from ehlectric.formulas.hertz import dry_contact
from tests.formulas.rigid_point import rigid_load
from tests.helpers.each import each

BALL = PointContact(
    radius_x=10e-3,
    radius_y=10e-3,
    reduced_modulus=226e9,
    load=20.0,
    entrainment_speed=2.0,
    viscosity=0.04,
    pressure_viscosity_coefficient=22e-9,
)

# U = 1e-11, G = 1e4, W = 1e-6: powers of ten, so that the formulas can be done by hand.
ROUND = PointContact(
    radius_x=1.0,
    radius_y=1.0,
    reduced_modulus=1e11,
    load=1e5,
    entrainment_speed=1.0,
    viscosity=1.0,
    pressure_viscosity_coefficient=1e-7,
)


def contact_of(moes_m, moes_l, d=1.0):
    """A contact with E' = Rx = 1 and the groups asked for."""
    u_s = 1e-12
    return PointContact(
        radius_x=1.0,
        radius_y=1.0 / d,
        reduced_modulus=1.0,
        load=moes_m * u_s**0.75,
        entrainment_speed=0.5 * u_s,
        viscosity=1.0,
        pressure_viscosity_coefficient=moes_l / u_s**0.25,
    )


def dimensionless(film, contact):
    """H = (h/Rx) (eta0 u_s/(E' Rx))^(-1/2)."""
    u_s = 2.0 * contact.viscosity * contact.entrainment_speed
    return film / (contact.radius_x * (u_s / (contact.reduced_modulus * contact.radius_x)) ** 0.5)


def nvm(contact):
    return dimensionless(point_formulas.nijenbanning_venner_moes(contact).central_thickness, contact)


def test_groups_by_hand():
    """eta0 u_s/(E' Rx) = 0.04 4/(226e9 0.01) = 7.08e-11; W = 20/(226e9 1e-4) = 8.85e-7; G = 4972."""
    assert BALL.moes_m == pytest.approx(8.850e-7 * 7.080e-11**-0.75, rel=1e-3, abs=0.0)
    assert BALL.moes_l == pytest.approx(4972 * 7.080e-11**0.25, rel=1e-3, abs=0.0)
    again = contact_of(36.0, 14.0)
    assert (again.moes_m, again.moes_l) == pytest.approx((36.0, 14.0))


@pytest.mark.parametrize(
    ("name", "minimum", "central"),
    [
        # -7.480 + 1.960 + 0.438 and -7.370 + 2.120 + 0.402; 1 - e^-0.68 and 1 - 0.61 e^-0.73.
        ("hamrock_dowson", 3.63 * 10**-5.082 * 0.49338, 2.69 * 10**-4.848 * 0.70603),
        # 1 - e^-0.67 and 1 - e^-1.23.
        ("chittenden", 3.68 * 10**-5.082 * 0.48829, 4.31 * 10**-5.082 * 0.70771),
    ],
)
def test_power_laws_by_hand(name, minimum, central):
    film = FORMULAS[name](ROUND)
    assert film.minimum_thickness == pytest.approx(minimum, rel=2e-5, abs=0.0)
    assert film.central_thickness == pytest.approx(central, rel=2e-5, abs=0.0)


def test_ball_on_plane():
    """Hamrock and Dowson's films of this contact as calculated for the solved one it is compared with."""
    film = point_formulas.hamrock_dowson(BALL)
    assert film.minimum_thickness == pytest.approx(0.251e-6, abs=5e-10)
    assert film.central_thickness == pytest.approx(0.438e-6, abs=5e-10)


@each("ratio", [1.0, 3.0, 10.0, 30.0])
def test_fits_to_the_same_theory_agree(ratio):
    """Three groups of authors, solving the same equations: within 15 % from circle to long ellipse."""
    contact = dataclasses.replace(BALL, radius_y=10e-3 * ratio)
    hd, chittenden = point_formulas.hamrock_dowson(contact), point_formulas.chittenden(contact)
    assert chittenden.minimum_thickness == pytest.approx(hd.minimum_thickness, rel=0.05, abs=0.0)
    assert chittenden.central_thickness == pytest.approx(hd.central_thickness, rel=0.05, abs=0.0)
    film = point_formulas.nijenbanning_venner_moes(contact).central_thickness
    assert film == pytest.approx(hd.central_thickness, rel=0.15, abs=0.0)


@pytest.mark.parametrize("ratio", [1e3, 1e4, 1e6])
def test_long_ellipses_have_the_limits_of_the_line(ratio):
    """Each elastic limit is that of Moes' line formula at the middle, with 3 F/(4 a) per length, within 1 %.

    This confirms 3.18, 1.48 and their dependence on the ratio: neither formula is made from the other.
    """
    contact = dataclasses.replace(BALL, radius_y=10e-3 * ratio)
    c = contact
    a = dry_contact(c.load, c.radius_x, c.radius_y, c.reduced_modulus).semi_axis_y
    line = LineContact(
        reduced_radius=c.radius_x, reduced_modulus=c.reduced_modulus, load_per_length=0.75 * c.load / a,
        entrainment_speed=c.entrainment_speed, viscosity=c.viscosity,
        pressure_viscosity_coefficient=c.pressure_viscosity_coefficient,
    )  # fmt: skip
    of_line, of_point = film_formulas._moes_asymptotes(line), point_formulas._asymptotes(contact)
    for limit in ("isoviscous-elastic", "piezoviscous-elastic", "piezoviscous-rigid"):
        assert of_point[limit] == pytest.approx(of_line[limit], rel=0.01, abs=0.0)


@pytest.mark.parametrize("d", [1.0, 0.3, 0.1])
def test_rigid_limit_is_the_solved_paraboloid(d):
    """Where the pressure gradient vanishes the film is 3/2.447 of the central one, as in Martin's."""
    centre = 288.0 * rigid_load(d) ** 2
    limit = point_formulas._asymptotes(contact_of(1.0, 0.0, d))["isoviscous-rigid"]
    assert limit == pytest.approx(3.0 / 2.447 * centre, rel=0.025, abs=0.0)


def test_rigid_limit_of_long_ellipses_by_hand():
    """Kapitza's half-Sommerfeld film 8 pi^2/D, by slices with Martin's load, 2.447 for 2, and film, 3."""
    limit = point_formulas._asymptotes(contact_of(1.0, 0.0, 1e-5))["isoviscous-rigid"]
    assert limit * 1e-5 == pytest.approx(8.0 * np.pi**2 * (2.447 / 2.0) ** 2 * 3.0 / 2.447, rel=2e-3, abs=0.0)


def test_rigid_solution_lies_above_kapitzas():
    """Without cavitation behind, p = -x/((3 + 2 d) h^2) and its half carries I = pi/(3 + 2 d)/2/sqrt(d)."""
    for d in (1.0, 0.1):
        kapitza = 0.5 * np.pi / ((3.0 + 2.0 * d) * np.sqrt(d))
        assert kapitza < rigid_load(d) < 2.447 / 2.0 * kapitza


@each(
    "moes_m, moes_l, regime",
    [
        (1.0, 0.0, "isoviscous-rigid"),
        (1e5, 0.0, "isoviscous-elastic"),
        (50.0, 1e4, "piezoviscous-rigid"),
        (1e8, 1e3, "piezoviscous-elastic"),
    ],
)
def test_limits_of_the_formula_of_all_regimes(moes_m, moes_l, regime):
    """Far in a regime the film is that of its limit."""
    contact = contact_of(moes_m, moes_l)
    limit = point_formulas._asymptotes(contact)[regime]
    assert nvm(contact) == pytest.approx(limit, rel=0.05, abs=0.0)
    assert point_formulas.regime(contact) == regime


def test_regime_of_a_ball_bearing():
    assert point_formulas.regime(contact_of(3000.0, 14.0, d=1 / 32)) == "piezoviscous-elastic"


def test_isoviscous_contact_has_only_the_formula_of_all_regimes():
    contact = dataclasses.replace(BALL, pressure_viscosity_coefficient=0.0)
    given = {name for name, f in FORMULAS.items() if any(vars(f(contact)).values())}
    assert given == {"nijenbanning_venner_moes"}
