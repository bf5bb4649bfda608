"""Newton's method of the ring on forces whose balance is known."""

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.bearing.loads.ring import Operation, balance
from tests.helpers.each import each


def balanced(reaction, load, start, *others):
    """Displacement, residual and steps of a single ring."""
    return [values[0] for values in balance(reaction, load[None], start[None], *others)]


def springs(directions, clearance, power):
    """Springs that push back along their directions beyond a clearance."""

    def reaction(x, _points):
        depth = np.maximum(0.0, x @ directions.T - clearance)
        force = 1e9 * depth**power
        stiffness = 1e9 * power * np.where(depth > 0.0, depth, np.inf) ** (power - 1.0)
        stiffness[depth == 0.0] = 0.0
        return force @ directions, np.einsum("ni,mn,nj->mij", directions, stiffness, directions)

    return reaction


@each("power", [1.0, 10.0 / 9.0, 1.5])
@each("load", [1e-4, 1.0, 1e6])
@each("reach", [1e-9, 1e-5, 1.0])
def test_one_spring_beyond_a_clearance(power, load, reach):
    """x = clearance + (F/k)^(1/n), whatever the first step; the second direction is free and stays at 0."""
    reaction = springs(np.array([[1.0, 0.0]]), 1e-5, power)
    x, residual, _ = balanced(reaction, np.array([load, 0.0]), np.zeros(2), reach, load)
    assert residual < 1e-9
    assert x[0] == pytest.approx(1e-5 + (load / 1e9) ** (1.0 / power), rel=1e-9, abs=0.0)
    assert x[1] == 0.0


def test_a_ring_that_rolls_off_one_spring_onto_the_next():
    """The force splits along two directions 40 degrees apart; the first alone could not carry it."""
    angles = np.radians([10.0, -30.0])
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    x, residual, _ = balanced(
        springs(directions, 5e-5, 1.5), np.array([100.0, 0.0]), np.zeros(2), 1e-6, 100.0
    )
    assert residual < 1e-9
    loads = 1e9 * (directions @ x - 5e-5) ** 1.5
    np.testing.assert_allclose(loads, np.linalg.solve(directions.T, [100.0, 0.0]), rtol=1e-8)


def test_no_balance_is_said():
    """A spring along x cannot carry a load along y."""
    reaction = springs(np.array([[1.0, 0.0]]), 0.0, 1.5)
    _, residual, _ = balanced(reaction, np.array([0.0, 1.0]), np.zeros(2), 1e-3, 1.0)
    assert residual == 1.0


def test_duties():
    positions = Operation(radial_load=1.0, cage_angle=0.1).positions(4)
    np.testing.assert_allclose(positions, 0.1 + np.array([0.0, 0.5, 1.0, 1.5]) * np.pi, rtol=1e-15)
    with pytest.raises(InputError, match=r"^radial_load, axial_load: "):
        Operation(radial_load=0.0)
    with pytest.raises(InputError, match=r"^radial_load: .* -1 N"):
        Operation(radial_load=-1.0)
