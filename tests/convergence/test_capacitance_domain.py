"""Capacitance of a contact over the size of its domain: a line's tends to a limit, a ball's does not."""

import numpy as np
import pytest
from scipy.constants import epsilon_0

from ehlectric import Case, solve

LUBRICANT = {"base": "paper"}


def ball(doublings):
    """The ball of the example on a domain doubled so often, nodes equally far apart."""
    size = 2**doublings
    contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "reduced_modulus": 226e9}
    contact |= {"load": 20.0, "entrainment_speed": 2.0}
    grid = {"inlet": -4.0 * size, "outlet": 2.0 * size, "side": 3.0 * size, "nodes": 64 * size + 1}
    lubricant = LUBRICANT | {"ambient_pressure": 0.0}
    case = {"contact": contact, "lubricant": lubricant, "discharge": {}, "grid": grid}
    return solve(Case.from_dict(case)).discharge


def test_capacitance_of_a_ball_grows_with_the_logarithm_of_its_domain():
    """Far out h = r^2/2R, so that doubling the domain adds 4 pi eps0 eps R ln 2, whatever its shape."""
    found = [ball(doublings).capacitance for doublings in range(3)]
    added = np.diff(found) / (4.0 * np.pi * epsilon_0 * 2.4 * 0.01 * np.log(2.0))
    assert added[1] == pytest.approx(1.0, abs=0.015)
    # The approach of the bodies narrows the gap by b^2/R, a part of it that falls fourfold a doubling.
    assert added[1] - 1.0 == pytest.approx(0.25 * (added[0] - 1.0), abs=2e-3)


def test_capacitance_of_a_line_contact_tends_to_a_limit():
    """Far out h = x^2/2R: what is beyond x goes with 1/x."""
    contact = {"reduced_radius": 14.1e-3, "reduced_modulus": 226e9, "load_per_length": 1.57e6}
    found = []
    for size in (1, 2, 4):
        grid = {"inlet": -4.0 * size, "outlet": 2.0 * size, "nodes": 1600 * size + 1}
        table = {"contact": contact | {"entrainment_speed": 4.0}, "lubricant": LUBRICANT, "grid": grid}
        found.append(solve(Case.from_dict(table | {"discharge": {}})).discharge.capacitance)
    first, second = np.diff(found)
    b = 499.4e-6  # sqrt(8 w R/(pi E'))
    # Between 2 and 4 domains: eps0 eps 2R (1/x1 - 1/x2) on either side, the deflection far below x^2/2R there.
    outside = epsilon_0 * 2.4 * 2.0 * 14.1e-3 * (1 / 8 - 1 / 16 + 1 / 4 - 1 / 8) / b
    assert second == pytest.approx(outside, rel=0.2, abs=0.0)
    assert second / first == pytest.approx(0.5, abs=0.1)
