"""Four-point contact bearings: laws by hand, a search in all coordinates, and bearings with one diagonal."""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import brentq, least_squares, minimize, root

from ehlectric import InputError
from ehlectric.bearing.loads.ball_contacts import contact_stiffness
from ehlectric.bearing.loads.ball_loads import BallEquilibrium, ball_equilibrium
from ehlectric.bearing.loads.four_point_loads import _tangent, four_point_equilibrium
from ehlectric.bearing.loads.geometry import BallBearing, FourPointBearing
from ehlectric.bearing.loads.ring import Operation
from ehlectric.formulas.hertz import dry_contact
from tests.helpers.each import each
from tests.helpers.operations import operation_in_order

E, DENSITY = 226e9, 7800.0
A35 = math.radians(35.0)
QJ = FourPointBearing(12, 12.7e-3, 60e-3, 0.515, 0.525, 30e-6, A35)
TIGHT = dataclasses.replace(QJ, radial_clearance=0.0)
PRELOADED = dataclasses.replace(QJ, radial_clearance=-4e-6)


def solve(bearing, *duty, modulus=E):
    return four_point_equilibrium(bearing, operation_in_order(*duty), modulus, DENSITY)


def halves(values):
    """Values of both diagonals."""
    return np.split(values, 2, axis=-1)


def test_geometry():
    """Half the play moves the ring along or across until a diagonal has the length A."""
    a, s, r = QJ.groove_distance, QJ.separation, QJ.radial_distance
    assert math.hypot(s + QJ.endplay / 2.0, r) == pytest.approx(a, rel=1e-14)
    assert math.hypot(s, r + QJ.clearance / 2.0) == pytest.approx(a, rel=1e-14)
    assert math.atan2(s + QJ.endplay / 2.0, r) == pytest.approx(A35, rel=1e-14)
    assert sum(QJ.separations) == pytest.approx(s, rel=1e-14)
    assert QJ.separations[0] / QJ.separations[1] == pytest.approx(15.0 / 25.0, rel=1e-12)
    assert TIGHT.endplay == 0.0
    assert PRELOADED.endplay < 0.0
    assert QJ.free_angle == A35
    assert QJ.inner_centre_radius - r == pytest.approx(30e-3 - 0.025 * 12.7e-3 * math.cos(A35), rel=1e-14)


@each("clearance", [190e-6, math.inf, -1e-3])
def test_clearance_that_leaves_no_arches_is_refused(clearance):
    assert 2.0 * QJ.groove_distance * (1.0 - math.cos(A35)) == pytest.approx(183.8e-6, rel=1e-3)
    with pytest.raises(InputError, match="radial_clearance"):
        dataclasses.replace(QJ, radial_clearance=clearance)


@each("load", [1.0, 100.0, 5000.0, -300.0])
def test_pure_axial_load_is_carried_by_one_diagonal(load):
    """F_a/Z = sin a' K (A (cos a/cos a' - 1))^(3/2) at rest, solved for a'; K of that very angle."""
    state = solve(QJ, 0.0, load)
    a = QJ.groove_distance

    def missing(angle):
        k = [contact_stiffness(QJ, E, angle, inner=inner) for inner in (True, False)]
        both = (k[0] ** (-2 / 3) + k[1] ** (-2 / 3)) ** -1.5
        depth = a * (math.cos(A35) / math.cos(angle) - 1.0)
        return math.sin(angle) * both * depth**1.5 - abs(load) / QJ.elements

    angle = brentq(missing, A35, 1.3, xtol=1e-14)
    loaded, other = (0, 1) if load > 0.0 else (1, 0)
    for side in ("inner", "outer"):
        angles, loads = halves(getattr(state, f"{side}_angle")), halves(getattr(state, f"{side}_load"))
        np.testing.assert_allclose(angles[loaded], math.copysign(angle, load), rtol=1e-9)
        np.testing.assert_allclose(loads[loaded], abs(load) / QJ.elements / math.sin(angle), rtol=1e-9)
        assert np.all(loads[other] == 0.0)
        assert np.all(halves(getattr(state, f"{side}_gap"))[other] > 0.0)
        assert np.all(halves(getattr(state, f"{side}_gap"))[loaded] == 0.0)
    along = a * math.cos(A35) * math.tan(angle) - QJ.separation
    assert state.axial_displacement == pytest.approx(math.copysign(along, load), rel=1e-9)
    assert abs(state.moment) < 1e-9 * abs(load) * 30e-3


@each("axial", [0.0, 300.0, -300.0])
def test_stiff_diagonals_share_the_centrifugal_force_equally(axial):
    """With angles that do not change, Q_o - Q_i is F_c/(2 cos a) on both diagonals of a loaded ball."""
    state = solve(TIGHT, 3000.0, axial, 2000.0, modulus=1e6 * E)
    inner, outer = halves(state.inner_load), halves(state.outer_load)
    both = (inner[0] > 0.0) & (inner[1] > 0.0)
    assert np.sum(both) >= 3
    for diagonal in (0, 1):
        share = (outer[diagonal] - inner[diagonal])[both]
        np.testing.assert_allclose(share, state.centrifugal_force / (2.0 * math.cos(A35)), rtol=1e-4)


@each("elements", [8, 12, 15])
def test_pure_radial_load(elements):
    """Without clearance loads of hard balls go with cos^(3/2), equal on both diagonals, as with Stribeck."""
    bearing = FourPointBearing(elements, 9e-3, 60e-3, 0.52, 0.53, 0.0, A35)
    state = solve(bearing, 1000.0, modulus=1e6 * E)
    first, second = halves(state.inner_load)
    np.testing.assert_allclose(first, second, rtol=1e-12, atol=1e-9)
    np.testing.assert_array_equal(*halves(state.position))
    cosines = np.maximum(0.0, np.cos(state.position[:elements]))
    cosines[cosines < 1e-12] = 0.0
    exact = 1000.0 / (2.0 * math.cos(A35) * np.sum(cosines**2.5))
    np.testing.assert_allclose(first, exact * cosines**1.5, rtol=1e-4, atol=1e-4)
    assert first[0] == pytest.approx(4.37 * 1000.0 / (2.0 * elements * math.cos(A35)), rel=0.01)
    assert abs(state.axial_displacement) < 1e-15
    assert abs(state.moment) < 1e-12
    np.testing.assert_allclose(state.inner_angle, -np.roll(state.inner_angle, elements), rtol=1e-12)


class Whole:
    """Bearing with the coordinates of ring and balls in micrometres, written out contact by contact."""

    def __init__(self, bearing, operation):
        self.bearing, self.duty, z = bearing, operation, bearing.elements
        d, fi, fo = bearing.ball_diameter, bearing.inner_groove, bearing.outer_groove
        a = (fi + fo - 1.0) * d
        s = math.sqrt(a**2 - (a * math.cos(bearing.contact_angle) + bearing.radial_clearance / 2.0) ** 2)
        self.radius = a * math.cos(bearing.contact_angle)
        self.offset = np.array([fi - 0.5, fo - 0.5]) * d
        self.apart = self.offset * s / a
        self.psi = operation.cage_angle + 2.0 * math.pi * np.arange(z) / z
        self.mass = DENSITY * math.pi * d**3 / 6.0

    def vectors(self, x):
        """From ball to inner and from outer centres, (ring, diagonal, ball), axial and radial [m]."""
        (u, rx, ry), (p, q) = x[:3] * 1e-6, x[3:].reshape(2, -1) * 1e-6
        q = q + self.offset[1]
        radial = self.radius + rx * np.cos(self.psi) + ry * np.sin(self.psi)
        axial = [[u + s * self.apart[0] - p, p + s * self.apart[1]] for s in (1.0, -1.0)]
        upward = [[radial - q, q]] * 2
        return np.swapaxes(np.array(axial), 0, 1), np.swapaxes(np.array(upward), 0, 1)

    def outward(self, cosine):
        bearing, duty = self.bearing, self.duty
        ratio = bearing.ball_diameter * cosine / bearing.pitch_diameter
        cage = 0.5 * (duty.inner_speed * (1.0 - ratio) + duty.outer_speed * (1.0 + ratio))
        return self.mass * 0.5 * bearing.pitch_diameter * cage**2

    def stiffness(self, cosine):
        bearing, found = self.bearing, []
        d, pitch = bearing.ball_diameter, bearing.pitch_diameter
        for sign, groove, c in zip(
            (1.0, -1.0), (bearing.inner_groove, bearing.outer_groove), cosine, strict=True
        ):
            across = 1.0 / (2.0 / d - 1.0 / (groove * d))
            along = 1.0 / (2.0 / d + sign * 2.0 * c / (pitch - sign * d * c))
            found.append(dry_contact(1.0, along, np.full_like(along, across), E).approach ** -1.5)
        return np.array(found)

    def contacts(self, x, stiffness=None):
        axial, radial = self.vectors(x)
        length = np.hypot(axial, radial)
        depth = np.maximum(0.0, length - self.offset[:, None, None])
        k = self.stiffness(radial / length) if stiffness is None else stiffness
        return k * depth**1.5, depth, axial / length, radial / length

    def imbalance(self, x, stiffness=None, outward=None):
        load, _, sine, cosine = self.contacts(x, stiffness)
        if outward is None:
            mean = np.cos(0.5 * (np.arctan2(sine, cosine)[0] + np.arctan2(sine, cosine)[1]))
            outward = self.outward(np.average(mean, weights=load[0]) if load[0].any() else np.mean(mean))
        axial, radial = (load * sine).sum(axis=1), (load * cosine).sum(axis=1)
        ring = [
            self.duty.axial_load - axial[0].sum(),
            self.duty.radial_load - (radial[0] * np.cos(self.psi)).sum(),
            -(radial[0] * np.sin(self.psi)).sum(),
        ]
        return np.concatenate([ring, axial[0] - axial[1], radial[0] - radial[1] + outward])

    def solved(self):
        """Loads by a search for the least energy with hard numbers, then for the root with the true ones."""
        start = self.bearing.contact_angle
        k, outward = (
            self.stiffness(np.full((2, 2, len(self.psi)), math.cos(start))),
            self.outward(math.cos(start)),
        )

        def energy(x):
            depth = self.contacts(x, k)[1]
            (u, r, _), q = x[:3] * 1e-6, x[3 + len(self.psi) :] * 1e-6
            work = self.duty.axial_load * u + self.duty.radial_load * r + outward * q.sum()
            return 1e6 * (0.4 * np.sum(k * depth**2.5) - work)

        begin = np.zeros(3 + 2 * len(self.psi))
        rough = minimize(energy, begin, jac=lambda x: -self.imbalance(x, k, outward), method="BFGS")
        size = math.hypot(self.duty.axial_load, self.duty.radial_load) + outward
        tight = {"xtol": 1e-15, "ftol": 1e-15}
        near = root(
            lambda x: self.imbalance(x) / size, rough.x, method="lm", options=tight | {"maxiter": 20000}
        )
        # Central differences come closer to the root than the one-sided ones of the search before.
        found = least_squares(lambda x: self.imbalance(x) / size, near.x, jac="3-point", gtol=1e-15, **tight)
        assert np.max(np.abs(found.fun)) < 1e-7
        return found.x, self.contacts(found.x)[0]


def random_point(seed):
    draw = np.random.default_rng(seed)
    elements = int(draw.integers(7, 15))
    pitch = draw.uniform(50e-3, 90e-3)
    bearing = FourPointBearing(
        elements,
        pitch * draw.uniform(0.6, 0.95) * math.sin(math.pi / elements),
        pitch,
        draw.uniform(0.51, 0.535),
        draw.uniform(0.51, 0.535),
        draw.choice([0.0, 0.0, 10e-6, 40e-6, -3e-6]),
        math.radians(draw.uniform(25.0, 40.0)),
    )
    radial, axial = 10.0 ** draw.uniform(1.5, 4.0, 2) * [[0.0, 1.0], [1.0, 0.0], [1.0, 1.0]][draw.integers(3)]
    speed = draw.choice([0.0, 1.0, 1.0]) * 10.0 ** draw.uniform(1.5, 3.2)
    return bearing, Operation(
        radial_load=radial,
        axial_load=axial * draw.choice([-1.0, 1.0]),
        inner_speed=speed,
        outer_speed=0.0,
        cage_angle=draw.uniform(0.0, 0.5),
    )


def check_by_search(seed):
    bearing, duty = random_point(seed)
    state = four_point_equilibrium(bearing, duty, E, DENSITY)
    whole = Whole(bearing, duty)
    x, load = whole.solved()
    largest = np.max(load)
    np.testing.assert_allclose(state.inner_load, load[0].ravel(), atol=1e-6 * largest, rtol=0.0)
    np.testing.assert_allclose(state.outer_load, load[1].ravel(), atol=1e-6 * largest, rtol=0.0)
    assert state.axial_displacement * 1e6 == pytest.approx(x[0], abs=1e-2)


@each("seed", range(2))
def test_search_in_all_coordinates(seed):
    check_by_search(seed)


@pytest.mark.slow
@each("seed", range(2, 20))
def test_search_at_more_points(seed):
    check_by_search(seed)


def check_balance(state, radial, axial):
    """Sums over all contacts, and over the diagonals of every ball."""
    q, psi = state.inner_load, state.position
    size = math.hypot(radial, axial) + state.centrifugal_force
    along, across = q * np.sin(state.inner_angle), q * np.cos(state.inner_angle)
    assert abs(np.sum(along) - axial) < 1e-9 * size
    assert abs(np.sum(across * np.cos(psi)) - radial) < 1e-9 * size
    assert abs(np.sum(across * np.sin(psi))) < 1e-9 * size
    out = state.outer_load
    sideways = sum(halves(out * np.sin(state.outer_angle) - along))
    outward = sum(halves(out * np.cos(state.outer_angle) - across))
    assert np.max(np.abs(sideways)) < 1e-9 * size
    pressed = sum(halves(out)) > 0.0
    np.testing.assert_allclose(outward[pressed], state.centrifugal_force, rtol=0.0, atol=1e-9 * size)
    assert pressed.all() or state.centrifugal_force == 0.0
    assert state.residual < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("bearing", [QJ, TIGHT, PRELOADED])
@pytest.mark.parametrize(("radial", "axial"), [(0.0, 500.0), (800.0, 0.0), (800.0, -200.0), (30.0, 3000.0)])
@pytest.mark.parametrize("speed", [0.0, 5.0, 3000.0])
def test_balance(bearing, radial, axial, speed):
    check_balance(solve(bearing, radial, axial, speed), radial, axial)


def test_fast_balls_touch_three_arcs():
    """Under an axial load at high speed both outer arcs carry, and one inner one."""
    state = solve(TIGHT, 0.0, 500.0, 3000.0)
    (first, second), outer = halves(state.inner_load), halves(state.outer_load)
    assert np.all(first > 0.0)
    assert np.all(second == 0.0)
    assert np.all(outer[1] > 0.0)
    assert np.all(outer[0] > outer[1])
    ratio = QJ.ball_diameter / QJ.pitch_diameter
    mean = 0.5 * (state.inner_angle[0] + state.outer_angle[0])
    assert state.cage_speed == pytest.approx(1500.0 * (1.0 - ratio * math.cos(mean)), rel=1e-12)
    # A ball that leaves the inner ring lies in the middle of the outer arch.
    far = solve(QJ, 500.0, 0.0, 3000.0)
    lost = halves(far.inner_load)[0] == 0.0
    assert lost.any()
    first, second = (half[lost] for half in halves(far.outer_load))
    np.testing.assert_allclose(first, second, rtol=1e-9)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("radial", [0.0, 400.0, 4000.0])
@pytest.mark.parametrize("speed", [0.0, 800.0])
def test_opposite_axial_loads_swap_the_diagonals(radial, speed):
    ahead, back = (solve(QJ, radial, axial, speed, 0.0, 0.2) for axial in (900.0, -900.0))
    swap = np.roll(np.arange(24), 12)
    size = np.max(ahead.outer_load)
    for side in ("inner", "outer"):
        load = getattr(ahead, f"{side}_load")
        np.testing.assert_allclose(getattr(back, f"{side}_load")[swap], load, rtol=1e-8, atol=1e-9 * size)
        angle = getattr(ahead, f"{side}_angle")
        np.testing.assert_allclose(getattr(back, f"{side}_angle")[swap], -angle, rtol=1e-7)
        gap = getattr(ahead, f"{side}_gap")
        np.testing.assert_allclose(getattr(back, f"{side}_gap")[swap], gap, rtol=0.0, atol=1e-12)
    assert back.axial_displacement == pytest.approx(-ahead.axial_displacement, rel=1e-8)
    assert back.radial_displacement == pytest.approx(ahead.radial_displacement, rel=1e-7, abs=1e-14)
    assert back.moment == pytest.approx(-ahead.moment, rel=1e-7, abs=1e-9 * size * 30e-3)


@pytest.mark.slow
@pytest.mark.gate
def test_many_points_equal_single_ones():
    points = [random_point(seed)[1] for seed in range(100, 112)]
    values = {key: np.array([vars(point)[key] for point in points]).reshape(4, 3) for key in vars(points[0])}
    clearance = np.resize([0.0, 20e-6, -2e-6], 3)
    bearing = dataclasses.replace(QJ, radial_clearance=clearance)
    many = four_point_equilibrium(bearing, operation_in_order(**values), E, DENSITY)
    assert many.inner_load.shape == many.position.shape == (4, 3, 24)
    assert np.all(many.balanced)
    for index in np.ndindex(4, 3):
        own = dataclasses.replace(QJ, radial_clearance=float(clearance[index[1]]))
        single = four_point_equilibrium(own, points[3 * index[0] + index[1]], E, DENSITY)
        at, size = many.at(index), np.max(single.outer_load)
        for name in ("inner_load", "outer_load"):
            np.testing.assert_allclose(getattr(at, name), getattr(single, name), rtol=1e-8, atol=1e-9 * size)
        for name in ("axial_displacement", "centrifugal_force", "cage_speed"):
            assert getattr(at, name) == pytest.approx(getattr(single, name), rel=1e-8, abs=1e-13)
        np.testing.assert_allclose(at.speeds.spin, single.speeds.spin, rtol=1e-6)


def test_points_without_load_are_nan():
    state = solve(QJ, np.array([0.0, 100.0]), np.array([0.0, 50.0]))
    assert np.all(np.isnan(state.inner_load[0]))
    assert np.all(np.isnan(state.residual[0]))
    check_balance(state.at(1), 100.0, 50.0)


@each("axial", [100.0, 2000.0])
def test_one_diagonal_is_an_angular_contact_bearing(axial):
    radial = 0.1 * axial
    state = solve(QJ, radial, axial)
    angular = BallBearing(12, 12.7e-3, 60e-3, 0.515, 0.525, contact_angle=A35)
    same = ball_equilibrium(angular, Operation(radial_load=radial, axial_load=axial), E, DENSITY)
    assert isinstance(state, BallEquilibrium)
    for name in ("inner_load", "outer_load", "inner_angle", "outer_angle", "gyroscopic_moment"):
        np.testing.assert_allclose(
            halves(getattr(state, name))[0], getattr(same, name), rtol=1e-8, atol=1e-15
        )
    assert not halves(state.inner_load)[1].any()
    assert state.axial_displacement + QJ.separation == pytest.approx(same.axial_displacement, rel=1e-9)
    assert state.radial_displacement == pytest.approx(same.radial_displacement, rel=1e-7)
    # One about the middle of the inner ring, the other about that of the circle of the arc's centres.
    assert state.moment == pytest.approx(same.moment - QJ.separations[0] * radial, rel=1e-8)
    assert state.cage_speed == same.cage_speed == 0.0


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("axial", [0.0, 15.0, -40.0])
@pytest.mark.parametrize("bearing", [QJ, dataclasses.replace(QJ, inner_groove=0.51, outer_groove=0.54)])
def test_balls_with_play_at_rest_have_the_largest_gaps(bearing, axial):
    """Smallest gap of the four of a free ball, against a search with constraints."""
    state = solve(bearing, 200.0, axial)
    free = np.flatnonzero(sum(halves(state.outer_load)) + sum(halves(state.inner_load)) == 0.0)
    assert free.size >= 4
    gaps = np.min([*halves(state.inner_gap), *halves(state.outer_gap)], axis=0)
    (inner, outer), (first, second) = bearing.separations, bearing.offsets
    for ball in free:
        radial = bearing.radial_distance + state.radial_displacement * np.cos(state.position[ball])
        radial += state.lateral_displacement * np.sin(state.position[ball])
        middle = state.axial_displacement
        centres = np.array([[middle + inner, radial], [middle - inner, radial], [-outer, 0.0], [outer, 0.0]])
        lengths = np.array([first, first, second, second])

        def room(x, centres=centres, lengths=lengths):
            return (lengths - np.hypot(*(1e-6 * x[:2] - centres).T)) * 1e6 - x[2]

        begin = [0.0, 0.5e6 * radial, 0.0]
        limits, options = {"type": "ineq", "fun": room}, {"ftol": 1e-13, "maxiter": 200}
        best = minimize(lambda x: -x[2], begin, method="SLSQP", constraints=limits, options=options).x[2]
        assert gaps[ball] * 1e6 == pytest.approx(best, rel=1e-6)


def test_the_determinant_of_both_diagonals_is_that_of_the_sum_of_their_stiffnesses():
    a, b, c = each_diagonal = np.array([[5.0, 2.0], [1.0, -1.5], [3.0, 4.0]])
    alone = SimpleNamespace(tangent=each_diagonal, along=a * c - b**2, across=np.ones(2))
    (axial, mixed, radial), determinant = _tangent(alone)
    matrix = np.array([[axial, mixed], [mixed, radial]])
    assert matrix == pytest.approx(np.array([[7.0, -0.5], [-0.5, 7.0]]))
    assert determinant == pytest.approx(np.linalg.det(matrix), rel=1e-12)
