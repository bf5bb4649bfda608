"""Loads of the bearings of three shafts, by statics: a separate program, equilibrium and symmetry."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.axle.shaft_loads import ForceAt, bearing_loads, forces_of_mesh
from ehlectric.errors import InputError
from ehlectric.gear import GearPair
from ehlectric.gear.geometry import gear_pair
from tests.gear.pairs import FIRST_STAGE, SECOND_STAGE

# Distances along z [m]: bearings of the three shafts, and their gears.
BEARINGS = ((0.0, 0.08), (0.0, 0.11), (0.0, 0.12))


def loads_of_axle(torque):
    """Loads of the bearings of an e-axle with two stages; centre lines at 0 and -40 degrees."""
    first, second = gear_pair(FIRST_STAGE), gear_pair(SECOND_STAGE)
    on_1, on_2 = forces_of_mesh(first, torque, "left", 0.0, (0.03, 0.03))
    further = first.ratio * torque
    # The mesh turns the intermediate shaft against the rotor: its torque has the other sign.
    on_2b, on_3 = forces_of_mesh(second, -further, "right", math.radians(-40.0), (0.075, 0.075))
    shafts = [[on_1], [on_2, on_2b], [on_3]]
    return [bearing_loads(forces, places) for forces, places in zip(shafts, BEARINGS, strict=True)]


@pytest.mark.parametrize(
    ("torque", "radial", "axial"),
    [
        (
            150.0,
            [(4945.440, 2534.413), (11443.578, 15179.439), (6822.580, 14051.224)],
            [-3149.950, -2535.397, 5685.347],
        ),
        (
            -150.0,
            [(4298.173, 3164.348), (8581.013, 15102.733), (9690.202, 10886.516)],
            [3149.950, 2535.397, -5685.347],
        ),
    ],
)
def test_loads_of_an_axle(torque, radial, axial):
    """Loads [N] that a separate program computed, driving and coasting."""
    for loads, expected, force in zip(loads_of_axle(torque), radial, axial, strict=True):
        assert loads.radial == pytest.approx(expected, rel=2e-6)
        assert loads.axial == pytest.approx(force, rel=2e-6)


@given(
    st.lists(
        st.tuples(*[st.floats(-1e4, 1e4)] * 3, *[st.floats(-0.2, 0.2)] * 3),
        min_size=1,
        max_size=4,
    ),
    st.floats(0.02, 0.3),
)
def test_the_shaft_is_in_equilibrium(rows, distance):
    """Forces and moments about both axes across the shaft add up to zero at any point."""
    forces = [ForceAt(np.array(row[:3]), np.array(row[3:])) for row in rows]
    loads = bearing_loads(forces, (0.01, 0.01 + distance))
    reactions = [
        ForceAt(np.array([*-loads.first, 0.0]), np.array([0.0, 0.0, 0.01])),
        ForceAt(np.array([*-loads.second, 0.0]), np.array([0.0, 0.0, 0.01 + distance])),
    ]
    everything = [*forces, *reactions]
    about = np.array([0.03, -0.02, 0.5])
    moment = sum(np.cross(each.point - about, each.force) for each in everything)
    # The axial force stays, on the axis of the shaft.
    moment += np.cross(np.zeros(3) - about, np.array([0.0, 0.0, -loads.axial]))
    assert sum(each.force for each in everything)[:2] == pytest.approx([0.0, 0.0], abs=1e-6)
    assert moment[:2] == pytest.approx([0.0, 0.0], abs=1e-5)


def test_the_power_of_the_forces_is_the_power_of_the_shafts():
    """The moment about each axis is the torque of its shaft: -T on gear 1, which the shaft drives with T."""
    pair: GearPair = gear_pair(FIRST_STAGE)
    on_1, on_2 = forces_of_mesh(pair, 150.0, "left", 0.7, (0.03, 0.04))
    assert np.cross(on_1.point, on_1.force)[2] == pytest.approx(-150.0, rel=1e-12)
    assert np.cross(on_2.point, on_2.force)[2] == pytest.approx(-150.0 * pair.ratio, rel=1e-12)


def test_bearings_at_one_place_are_refused():
    with pytest.raises(InputError, match="one place"):
        bearing_loads([], (0.1, 0.1))
