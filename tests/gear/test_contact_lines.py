"""Lengths of the lines of contact: closed forms against sums over lines, and their limits."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.gear.contact_lines import PlaneOfAction, line_nodes, line_parts, nodes_within, with_unloaded
from ehlectric.gear.contact_path import ContactPath
from tests.gear.pairs import FIRST_STAGE, FZG_C, SECOND_STAGE
from tests.gear.pairs import plane_of as pair_plane

PITCH, WIDTH = 5e-3, 25e-3


def plane_of(alpha, beta):
    """Plane of action with a transverse contact ratio alpha and an overlap ratio beta."""
    start = 4e-3
    end = start + alpha * PITCH
    path = ContactPath(start, 0.5 * (start + end), end, PITCH, 40e-3, math.atan(beta * PITCH / WIDTH))
    return PlaneOfAction(path, WIDTH)


def kinks(plane):
    """Phases at which a line passes a corner of the plane; between them the length is linear."""
    alpha, beta = plane.path.contact_ratio, plane.overlap_ratio
    return sorted(phase % 1.0 for phase in (0.0, alpha, -beta, alpha - beta))


RATIOS = st.floats(1.0, 3.5), st.floats(0.05, 4.5)


@given(*RATIOS)
def test_extreme_lengths_are_those_of_the_sum_over_lines(alpha, beta):
    plane = plane_of(alpha, beta)
    lengths = [plane.length(phase) for phase in kinks(plane)]
    least, most = plane.extreme_lengths
    assert min(lengths) == pytest.approx(least, rel=1e-10)
    assert max(lengths) == pytest.approx(most, rel=1e-10)


@given(*RATIOS)
def test_the_mean_length_is_the_area_over_the_distance_of_lines(alpha, beta):
    plane = plane_of(alpha, beta)
    phases = np.array([*kinks(plane), 1.0 + kinks(plane)[0]])
    lengths = np.array([plane.length(phase) for phase in phases])
    # The length is linear between the kinks, so that the trapezoidal rule is exact.
    mean = np.sum(0.5 * (lengths[1:] + lengths[:-1]) * np.diff(phases))
    assert mean == pytest.approx(plane.mean_length, rel=1e-10)


@pytest.mark.parametrize(
    ("drawing", "lengths"),
    [
        (FIRST_STAGE, (38.85959, 38.22367, 39.33262)),
        (SECOND_STAGE, (59.33838, 52.83866, 65.96621)),
    ],
)
def test_lengths_of_two_stages_of_an_e_axle(drawing, lengths):
    """Mean, minimum and maximum, which a separate program computed as sums over lines."""
    plane = pair_plane(drawing)
    assert [1e3 * length for length in (plane.mean_length, *plane.extreme_lengths)] == pytest.approx(
        lengths, abs=1e-5
    )


def test_a_spur_pair_has_one_and_two_lines():
    plane = pair_plane(FZG_C)
    assert plane.extreme_lengths == (14e-3, 28e-3)
    assert {plane.length(phase) for phase in np.linspace(0.01, 0.99, 99)} == {14e-3, 28e-3}
    # The mean holds 1.43754 lines of the face width.
    assert plane.mean_length == pytest.approx(1.43754 * 14e-3, rel=1e-5)


@pytest.mark.parametrize("alpha", [1.2, 1.5, 1.9, 2.3])
def test_a_small_helix_has_the_lengths_of_a_spur_pair(alpha):
    spur, helical = plane_of(alpha, 0.0), plane_of(alpha, 1e-7)
    assert helical.extreme_lengths == pytest.approx(spur.extreme_lengths, rel=1e-6)


def test_whole_overlap_ratios_make_the_length_constant():
    """With a whole number of axial pitches on the face, one line enters where another one leaves."""
    least, most = plane_of(1.43, 2.0).extreme_lengths
    assert least == pytest.approx(most, rel=1e-12)


def nodes_of(plane, number=5, loaded=(0.0, 1.0)):
    """Nodes on the lines with a piece of each part that carries load."""
    parts = line_parts(plane, plane.path.points.values())
    pieces = tuple(np.full(parts.width.size, end) for end in loaded)
    return parts, line_nodes(parts, *with_unloaded(*nodes_within(number, pieces), pieces))


@pytest.mark.parametrize("drawing", [FZG_C, FIRST_STAGE, SECOND_STAGE])
@pytest.mark.parametrize("loaded", [(0.0, 1.0), (0.2, 0.7), (1.0, 1.0)])
def test_nodes_add_up_to_the_length_at_each_phase(drawing, loaded):
    """Also if pieces of the lines carry no load."""
    plane = pair_plane(drawing)
    parts, nodes = nodes_of(plane, loaded=loaded)
    lengths = [plane.length(phase) for phase in parts.phases]
    assert np.bincount(nodes.phase, nodes.length) == pytest.approx(lengths, rel=1e-12)
    assert np.sum(parts.weights) == pytest.approx(1.0, rel=1e-14)
    assert parts.weights @ lengths == pytest.approx(plane.mean_length, rel=1e-5)


@given(st.floats(0.0, 1e3), st.floats(0.0, 1e3))
def test_nodes_move_without_a_step_as_a_load_begins_outside_of_a_part(before, behind):
    """x = L sin^2 theta - e for zeros of the load at -e and 1 + e', as 1e-9 further outside."""
    whole = np.zeros(1), np.ones(1)
    at, share = nodes_within(5, whole, (np.array([-before]), np.array([1.0 + behind])))
    moved, _ = nodes_within(5, whole, (np.array([-before - 1e-9]), np.array([1.0 + behind])))
    assert moved == pytest.approx(at, abs=1e-4)
    assert np.sum(share) == pytest.approx(1.0, rel=1e-12)
    # A load near a zero grows with the distance x + e, and the width of its contact with the root of it.
    exact = ((1.0 + before) ** 1.5 - before**1.5) / 1.5
    assert np.sum(share * np.sqrt(at + before)) == pytest.approx(exact, rel=2e-3)


@given(*RATIOS)
def test_nodes_integrate_over_the_plane_of_action(alpha, beta):
    """The integral of x^2 y over all lines and phases is the integral over the plane over the distance p_bt
    of the lines, for each length over cos beta_b.
    """
    plane = plane_of(alpha, beta)
    parts, nodes = nodes_of(plane)
    x = nodes.places - plane.path.start
    sums = np.bincount(nodes.phase, x**2 * nodes.across * nodes.length)
    exact = plane.path.length**3 / 3.0 * WIDTH**2 / 2.0 / PITCH / math.cos(plane.path.base_helix_angle)
    assert parts.weights @ sums == pytest.approx(exact, rel=2e-5)


@given(*RATIOS)
def test_lines_have_nodes_at_their_ends(alpha, beta):
    """At each phase the ends of all lines are on the edges of the plane of action."""
    plane = plane_of(alpha, beta)
    _, nodes = nodes_of(plane)
    x, y = (nodes.places - plane.path.start) / plane.path.length, nodes.across / WIDTH
    for phase, line in {*zip(nodes.phase.tolist(), nodes.line.tolist(), strict=True)}:
        at = np.flatnonzero((nodes.phase == phase) & (nodes.line == line))
        first, last = at[0], at[-1]
        assert min(x[first], y[first]) == pytest.approx(0.0, abs=1e-7)
        assert max(x[last], y[last]) == pytest.approx(1.0, abs=1e-7)
