"""A solved film and the groove around it: the whole is the same wherever one ends and the other begins."""

import numpy as np
import pytest
from scipy.constants import epsilon_0

import ehlectric
from ehlectric.bearing.gaps import Raceway, match_film, outside_capacitance
from ehlectric.formulas.hertz import dry_contact
from tests.helpers.places import EXAMPLES

pytestmark = pytest.mark.convergence

EXAMPLE = EXAMPLES / "ball_bearing.toml"


@pytest.mark.slow
def test_the_whole_at_any_edge():
    """Smaller parts of the same film, each continued by the deformed groove."""
    film, dry_case = solved()
    race = Raceway.of(11.906e-3, 59.906e-3, 6.191 / 11.906, 0.2, outer=False)
    dry = dry_contact(600.0, dry_case.radius_x, dry_case.radius_y, dry_case.reduced_modulus)
    wholes, shares = [], []
    for inlet, outlet, side in ((-4.5, 1.5, 1.75), (-4.25, 1.3, 1.55), (-4.0, 1.2, 1.4), (-3.0, 1.2, 1.3)):
        along = np.flatnonzero(
            (film.x >= inlet * dry.semi_axis_x - 1e-9) & (film.x <= outlet * dry.semi_axis_x + 1e-9)
        )
        across = np.flatnonzero(np.abs(film.y) <= side * dry.semi_axis_y + 1e-9)
        x, y = film.x[along], film.y[across]
        thickness = film.thickness[np.ix_(along, across)]
        rim = np.ones_like(thickness, dtype=bool)
        rim[1:-1, 1:-1] = False
        xy = np.meshgrid(x, y, indexing="ij")
        contact = match_film(
            race, dry, dry_case.reduced_modulus, x=xy[0][rim], y=xy[1][rim], thickness=thickness[rim]
        )
        assert contact.mismatch < 0.05
        assert contact.offset == pytest.approx(-dry.approach, rel=0.05)
        outside = outside_capacitance(race, contact, (x[0], x[-1], y[-1]))
        wholes.append(outside + epsilon_0 * float(np.trapezoid(np.trapezoid(1.0 / thickness, y), x)))
        shares.append(outside / wholes[-1])
    assert shares[-1] > 1.3 * shares[0]
    assert wholes == pytest.approx([wholes[0]] * 4, rel=3e-3)


def solved():
    case = ehlectric.Case.from_toml(EXAMPLE).replace(grid={"nodes": 129})
    result = ehlectric.solve(case)
    assert result.film.converged
    return result.film, result.conditions
