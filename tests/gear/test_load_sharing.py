"""Loads on the lines of contact: shares of published laws, equilibrium, relief and limits."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric.errors import InputError
from ehlectric.gear.load_sharing import Modification, line_loads, single_stiffness
from tests.gear.pairs import FIRST_STAGE, FZG_A, FZG_C, SECOND_STAGE, plane_of

FORCE = 5000.0
STIFF = 17e9
PLAIN = Modification()
HELICAL = [FIRST_STAGE, SECOND_STAGE]


def loads_of(drawing, law="stiffness", *, stiffness=STIFF, modification=PLAIN, **numbers):
    plane = plane_of(drawing)
    return plane, line_loads(plane, FORCE, law, stiffness=stiffness, modification=modification, **numbers)


def shares(drawing, law="stiffness", **options):
    """Places g of a spur pair in increasing order, and the share of the force that a pair carries there."""
    plane, loads = loads_of(drawing, law, **options)
    order = np.argsort(loads.places)
    return plane, loads.places[order], loads.load[order] * plane.face_width / FORCE


def energy_share(ratio, xi):
    """Share of least elastic energy of a pair at xi base pitches behind A, by hand.

    The stiffness of a pair is cos(b0 (xi - eps/2)); a second pair is a base pitch before or behind.
    """
    b0 = 1.0 / math.sqrt((1.0 + 0.5 * ratio) ** 2 / 2.0 - 1.0)
    stiffness = [math.cos(b0 * (x - 0.5 * ratio)) for x in (xi - 1.0, xi, xi + 1.0) if 0.0 <= x <= ratio]
    return math.cos(b0 * (xi - 0.5 * ratio)) / sum(stiffness)


def test_springs_share_by_the_least_energy():
    """FZG C has the shares 0.35513 at A and 0.64487 at B in double contact."""
    ratio = plane_of(FZG_C).path.contact_ratio
    at_b = ratio - 1.0 - 1e-12
    assert energy_share(ratio, 0.0) == pytest.approx(0.35513, abs=1e-5)
    assert energy_share(ratio, at_b) == pytest.approx(0.64487, abs=1e-5)
    plane, places, share = shares(FZG_C)
    expected = [energy_share(ratio, xi) for xi in (places - plane.path.start) / plane.path.base_pitch]
    assert share == pytest.approx(expected, rel=1e-10)
    assert share[0] == pytest.approx(0.35513, abs=1e-5)
    assert share[-1] == pytest.approx(0.35513, abs=1e-5)


@pytest.mark.parametrize("law", ["stiffness", "rigid", "iso"])
@pytest.mark.parametrize("drawing", [FZG_A, FZG_C, *HELICAL])
def test_loads_add_up_to_the_force_at_each_phase(drawing, law):
    _, loads = loads_of(drawing, law)
    assert loads.normal_force == pytest.approx(FORCE, rel=1e-12)


@pytest.mark.parametrize("drawing", [FZG_A, FZG_C])
@pytest.mark.parametrize("law", ["iso", "tip-relief"])
def test_shares_of_a_spur_pair_add_up_to_the_force(drawing, law):
    _, loads = loads_of(drawing, law)
    assert loads.normal_force == pytest.approx(FORCE, rel=1e-12)


MODIFICATIONS = st.builds(
    Modification, *[st.floats(0.0, 60e-6)] * 2, st.floats(1e-4, 6e-3), st.floats(0.0, 60e-6)
)


@settings(max_examples=60, deadline=None)
@given(st.sampled_from([FZG_A, FZG_C, *HELICAL]), st.floats(1e8, 1e12), MODIFICATIONS)
def test_slices_have_one_approach_and_carry_the_force(drawing, stiffness, modification):
    """Loaded slices have w/c + f in common, and unloaded ones a larger opening f."""
    plane, loads = loads_of(drawing, stiffness=stiffness, modification=modification)
    assert loads.normal_force == pytest.approx(FORCE, rel=1e-9)
    opening = modification.opening(plane, loads.places, loads.across)
    ratio = plane.path.contact_ratio
    xi = (loads.places - plane.path.start) / plane.path.base_pitch
    b0 = 1.0 / math.sqrt((1.0 + 0.5 * ratio) ** 2 / 2.0 - 1.0)
    shape = np.cos(b0 * (xi - 0.5 * ratio))
    stiffness_of = stiffness * b0 / (2.0 * math.sin(0.5 * b0 * ratio)) * shape
    for phase in range(loads.phases.size):
        load, gap, c = (values[loads.phase == phase] for values in (loads.load, opening, stiffness_of))
        pressed = load > 1e-6 * np.max(load)
        delta = (load / c + gap)[pressed]
        assert delta == pytest.approx(delta[0], rel=1e-6)
        assert np.all(gap[load == 0.0] >= delta[0] * (1.0 - 1e-6))


def test_the_mean_stiffness_over_a_phase_is_that_of_the_mesh():
    """The force over the approach, averaged over a phase, is c_gamma b for equal slices."""
    plane, loads = loads_of(FZG_C)
    ratio = plane.path.contact_ratio
    b0 = 1.0 / math.sqrt((1.0 + 0.5 * ratio) ** 2 / 2.0 - 1.0)
    xi = (loads.places - plane.path.start) / plane.path.base_pitch
    shape = np.bincount(loads.phase, np.cos(b0 * (xi - 0.5 * ratio)))
    assert loads.weights @ shape * b0 / (2.0 * math.sin(0.5 * b0 * ratio)) == pytest.approx(1.0, rel=1e-7)


@pytest.mark.parametrize("drawing", [FZG_C, *HELICAL])
def test_no_relief_and_no_crowning_is_the_plain_pair(drawing):
    plain = loads_of(drawing)[1].load
    none = Modification(0.0, 0.0, 1e-3, 0.0)
    assert loads_of(drawing, modification=none)[1].load == pytest.approx(plain, rel=1e-12)


@pytest.mark.parametrize("drawing", [FZG_C, *HELICAL])
def test_soft_teeth_do_not_feel_relief(drawing):
    """A deflection far above the relief closes all openings."""
    modification = Modification(5e-6, 5e-6, 1e-3, 5e-6)
    plane, soft = loads_of(drawing, stiffness=1e3, modification=modification)
    stiffness = single_stiffness(plane, soft.places, 1e3)
    approach = FORCE / np.bincount(soft.phase, stiffness * soft.length)
    assert soft.load == pytest.approx(stiffness * approach[soft.phase], rel=1e-3)


def test_stiff_teeth_do_not_touch_where_they_are_relieved():
    """Relief over the double contact leaves the whole force to the pair without relief."""
    modification = Modification(10e-6, 10e-6, 2e-3, 0.0)
    plane, places, share = shares(FZG_C, stiffness=1e16, modification=modification)
    path = plane.path
    relieved = (places < path.start + 1.99e-3) | (places > path.end - 1.99e-3)
    assert np.all(share[relieved] == 0.0)
    # Its partner, a base pitch away, carries everything.
    lone = (places > path.start + path.base_pitch) & (places < path.start + path.base_pitch + 1.99e-3)
    assert share[lone] == pytest.approx(1.0, rel=1e-12)


def test_tip_relief_thickens_films_at_both_ends():
    """The load at A and E is smaller with relief, and it is carried by the middle."""
    plain = shares(FZG_C)[2]
    relieved = shares(FZG_C, modification=Modification(20e-6, 20e-6, 2e-3, 0.0))[2]
    assert relieved[0] < 0.5 * plain[0]
    assert relieved[-1] < 0.5 * plain[-1]
    assert np.max(relieved) == pytest.approx(1.0)


def test_crowning_moves_load_to_the_middle_of_the_face():
    _, loads = loads_of(FZG_C, modification=Modification(crowning=5e-6))
    line = loads.load[next(loads.lines())]
    assert np.all(np.diff(line[: line.size // 2 + 1]) > 0.0)
    assert line == pytest.approx(line[::-1], rel=1e-9)


@pytest.mark.parametrize("drawing", [FZG_C, *HELICAL])
def test_loads_end_where_the_flanks_open(drawing):
    """A pair that relief and crowning open in part: the load is zero from the place on at which f = delta."""
    modification = Modification(30e-6, 30e-6, 2e-3, 20e-6)
    plane, loads = loads_of(drawing, modification=modification)
    opening = modification.opening(plane, loads.places, loads.across)
    spring = loads.load / single_stiffness(plane, loads.places, STIFF)
    approach = -loads.least(np.where(loads.load > 0.0, -spring - opening, np.inf))
    unloaded = loads.load == 0.0
    assert np.any(unloaded)
    assert np.all((opening >= (1.0 - 1e-4) * approach[loads.phase])[unloaded])
    # Lengths of pieces with and without a load add up to the length of the lines.
    lengths = [plane.length(phase) for phase in loads.phases]
    assert loads.along(np.ones_like(loads.length)) == pytest.approx(lengths, rel=1e-12)


@pytest.mark.parametrize(
    "modification", [PLAIN, Modification(20e-6, 20e-6, 2e-3), Modification(crowning=20e-6)]
)
@pytest.mark.parametrize("drawing", [FZG_C, *HELICAL])
def test_sums_of_powers_of_the_load_converge(drawing, modification):
    """Capacitance and area change with powers of the load near 0.4 and 0.5. Twice as many nodes change their
    means over a phase by less than 0.1 %.
    """
    for power in (0.4, 0.5, 1.0, 2.0):
        coarse, fine = (
            loads.mean(loads.along(loads.load**power))
            for loads in (
                loads_of(drawing, modification=modification, accuracy=number)[1] for number in (1, 2)
            )
        )
        assert coarse == pytest.approx(fine, rel=1e-3)


def test_shares_of_the_standard():
    """A third at A and E, two thirds at B and D in double contact, everything in single contact."""
    plane, places, share = shares(FZG_C, "iso")
    points = plane.path.points
    assert share[0] == pytest.approx(1.0 / 3.0, abs=1e-4)
    assert share[-1] == pytest.approx(1.0 / 3.0, abs=1e-4)
    assert share[places < points["B"]][-1] == pytest.approx(2.0 / 3.0, abs=1e-4)
    assert share[places > points["D"]][0] == pytest.approx(2.0 / 3.0, abs=1e-4)
    single = (places > points["B"]) & (places < points["D"])
    assert np.all(share[single] == 1.0)


def test_shares_with_as_much_relief_as_deflection():
    """No load at A and E, all load at B and D, linear between."""
    plane, places, share = shares(FZG_C, "tip-relief")
    points = plane.path.points
    entering = places < points["B"]
    expected = (places[entering] - points["A"]) / (points["B"] - points["A"])
    assert share[entering] == pytest.approx(expected, rel=1e-10)
    assert np.all(share[(places > points["B"]) & (places < points["D"])] == 1.0)
    with pytest.raises(InputError, match="for helical gears"):
        loads_of(FIRST_STAGE, "tip-relief")


def iso_share(path, beta, places):
    """Share of the standard at places g of a helical pair with the overlap ratio beta, by hand: the spur
    share and the helical share 1/eps_alpha with its buttressing, interpolated below an overlap of 1.
    """
    beta = min(beta, 1.0)
    from_a, from_e = places - path.start, path.end - places
    double = path.length - path.base_pitch
    spur = np.where(
        np.minimum(from_a, from_e) >= double, 1.0, (1.0 + np.minimum(from_a, from_e) / double) / 3.0
    )
    over = 0.2e-3 * math.sin(path.base_helix_angle)
    ends = 1.0 + 0.3 * beta * np.maximum(0.0, 1.0 - np.minimum(from_a, from_e) / over)
    return (1.0 - beta) * spur + beta * ends / path.contact_ratio


@settings(max_examples=40, deadline=None)
@given(st.floats(0.5, 60.0), st.floats(0.1, 35.0))
def test_helical_shares_of_the_standard_are_in_equilibrium(face_width, helix_angle):
    """At each phase the loads are shares in one proportion, and their integral over all lines is the force.

    The integral is a sum over 200 places on each of the lines, between the places where shares bend or jump.
    """
    drawing = replace(
        FIRST_STAGE,
        face_width=1e-3 * face_width,
        helix_angle=math.radians(helix_angle),
        centre_distance=None,
        profile_shift=(0.2, 0.1),
        tip_diameter=(None, None),
    )
    plane, loads = loads_of(drawing, "iso")
    path = plane.path
    scale = loads.load / iso_share(path, plane.overlap_ratio, loads.places)
    slope, over = math.tan(path.base_helix_angle), 0.2e-3 * math.sin(path.base_helix_angle)
    bends = [path.start, path.start + over, *path.points.values(), path.end - over, path.end]
    for number in range(0, loads.phases.size, 3):
        total = 0.0
        for line in range(-math.ceil(plane.overlap_ratio) - 1, 3):
            begin = path.start + (loads.phases[number] + line) * path.base_pitch
            ends = np.clip([(bend - begin) / slope for bend in sorted(bends)], 0.0, plane.face_width)
            for first, last in pairwise(ends):
                # The share is linear in each part: the mean of many places is exact.
                across = first + (last - first) * (np.arange(200) + 0.5) / 200.0
                share = iso_share(path, plane.overlap_ratio, begin + slope * across)
                total += (last - first) * float(np.mean(share)) / math.cos(path.base_helix_angle)
        assert scale[loads.phase == number] == pytest.approx(FORCE / total, rel=1e-5)
    assert loads.normal_force == pytest.approx(FORCE, rel=1e-9)


def test_a_small_helix_angle_has_the_shares_of_the_spur_pair():
    plane, loads = loads_of(replace(FZG_C, helix_angle=math.radians(1e-3)), "iso")
    _, places, share = shares(FZG_C, "iso")
    points = plane.path.points
    # Away from B and D, where the shares jump.
    away = np.min([np.abs(loads.places - points[name]) for name in "BD"], axis=0) > 0.05e-3
    expected = np.interp(loads.places, places, share)
    assert loads.load[away] * plane.face_width / FORCE == pytest.approx(expected[away], rel=2e-3)


def test_helical_shares_of_the_standard_are_equal_but_at_the_ends():
    plane, loads = loads_of(FIRST_STAGE, "iso")
    inside = (loads.places > plane.path.start + 0.2e-3) & (loads.places < plane.path.end - 0.2e-3)
    for number in range(loads.phases.size):
        here = loads.phase == number
        level = loads.load[here & inside]
        assert level == pytest.approx(level[0], rel=1e-9)
        assert np.max(loads.load[here]) <= 1.3 * level[0] * (1.0 + 1e-9)
    # A line always passes A and E. Lines differ in length by 3 % over the phase.
    assert np.max(loads.load) == pytest.approx(1.3 * FORCE / plane.mean_length, rel=0.03)


@pytest.mark.parametrize("drawing", HELICAL)
def test_rigid_lines_have_one_load(drawing):
    plane, loads = loads_of(drawing, "rigid")
    lengths = np.array([plane.length(phase) for phase in loads.phases])
    assert loads.load == pytest.approx((FORCE / lengths)[loads.phase], rel=1e-12)
