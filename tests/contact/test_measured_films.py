"""Films of a ball on a glass disc, measured by interferometry. Tolerances are those of the data files."""

import numpy as np
import pytest

from tests.helpers.ball_on_disc import OILS, ball_on_disc, central_films
from tests.helpers.measurements import exponent, film_log, load, zero_checks
from tests.motion.microdent import contact
from tests.motion.microdent import measured as profiles

pytestmark = pytest.mark.measured


def ratios(name, oil, nodes, rows):
    """Measured over computed film at some rows of a data file, and both films."""
    reference = load(name)
    speed, film = reference.column("speed")[rows], reference.column("film")[rows]
    computed = central_films(ball_on_disc(OILS[oil], nodes=nodes), speed)
    return film / computed, speed, film, computed


ALL = slice(None)
THREE = [2, 5, 8]


@pytest.mark.parametrize(("nodes", "rows"), [(129, THREE), pytest.param(257, ALL, marks=pytest.mark.slow)])
def test_films_of_fva_3(nodes, rows):
    """10 % from the inputs, and measured films up to 5 % too thick: ratio 0.90 to 1.12, exponent to 0.03."""
    ratio, speed, film, computed = ratios("ball_on_glass_fva3", "fva3", nodes, rows)
    assert np.all((ratio > 0.90) & (ratio < 1.12))
    assert exponent(speed, computed) == pytest.approx(exponent(speed, film), abs=0.03)


@pytest.mark.slow
@pytest.mark.gate
def test_films_of_fva_3_of_the_library():
    """The oil of the library, with no number of this rig, gives the same films at 25.1 degC."""
    reference = load("ball_on_glass_fva3")
    case = ball_on_disc(OILS["fva3_library"], nodes=129, temperature="25.1 degC")
    ratio = reference.column("film")[[5, 8]] / central_films(case, reference.column("speed")[[5, 8]])
    assert np.all((ratio > 0.90) & (ratio < 1.15))


@pytest.mark.slow
def test_shape_of_thin_films():
    """One viscosity fits the film at 1 m/s; with the rig's own zero the others follow within 3 %.

    The zero was checked twice; it is known to half of the difference, which counts beside the 3 %.
    """
    speed, logged = film_log("40C")
    chosen = [0, 4, 8, 10]
    zeros = np.array(zero_checks("40C"))
    film = logged[chosen] - np.mean(zeros)
    computed = central_films(ball_on_disc(OILS["unnamed"], nodes=513), speed[chosen])
    assert np.min(speed[chosen]) > 0.2
    np.testing.assert_allclose(computed, film, rtol=0.03, atol=0.5 * np.ptp(zeros))


@pytest.mark.parametrize(("nodes", "rows"), [(129, [2, 5]), pytest.param(257, ALL, marks=pytest.mark.slow)])
def test_thick_films_of_shc_320_are_not_reproduced(nodes, rows):
    """The computed film is too thick by 8 % at 0.12 m/s and by half at 1.06 m/s, as it was when recorded.

    Inlet shear heating explains 6 % of the 33 %, and starvation and shear thinning are not part of the case.
    """
    ratio, speed, film, computed = ratios("ball_on_glass_shc320", "shc320", nodes, rows)
    recorded = load("ball_on_glass_shc320").column("recorded")[rows]
    np.testing.assert_allclose(computed, recorded, rtol=0.03)
    assert np.all(np.diff(ratio) < 0.0)
    assert exponent(speed, computed) - exponent(speed, film) > 0.1


def test_smooth_film_of_the_dented_ball():
    """Before the dent comes, the film is that of a smooth ball: 10 nm, without a fitted value."""
    x, film, _ = profiles("rolling")[0]
    flat = np.abs(x) < 90.0
    solved = central_films(contact(nodes=129), [0.09])
    assert solved[0] == pytest.approx(np.mean(film[flat]), abs=10.0)
