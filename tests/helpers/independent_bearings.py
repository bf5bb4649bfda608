"""Whole bearings computed another way: loads as the least of an energy, capacitances as sums over patches.

Nothing of ``ehlectric.bearing`` is used. All displacements, those of the ring and those of each element, are
the unknowns of one convex energy, which Newton's method makes least. Contact stiffnesses and the
speed of the cage follow the contact angles from round to round. Capacitances are sums over small patches of
the raceway around each contact. SI units.

Tables have the keys of a bearing file, with numbers in SI units. Vectors in the plane of an element are
(axial, radial); axial ones point the way in which its own row carries loads.
"""

from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0
from scipy.optimize import brentq

from ehlectric.formulas.hertz import dry_contact, line_gap, point_deflection

# Steel of rings and elements.
YOUNG, POISSON, DENSITY = 208e9, 0.3, 7830.0
MODULUS = YOUNG / (1.0 - POISSON**2)

# Stiffness of a roller between both raceways for the steel of the standard [N/m^(10/9) per m^(8/9)].
LINE_LAW = 35948.0 * 1e6 * MODULUS / (206e9 / (1.0 - 0.3**2))
SLICES = 41


@dataclass(frozen=True)
class Loads:
    """Bearing in equilibrium; arrays have a value per contact with each ring, by row or by diagonal."""

    ring: np.ndarray  # displacement of the inner ring: radial, lateral and axial [m]
    load: np.ndarray  # of the inner and the outer contacts [N], shape (2, n)
    angle: np.ndarray  # of the inner and the outer contacts, negative in a second row [rad], shape (2, n)
    gap: np.ndarray  # distance of element and ring where they do not touch [m], shape (2, n)
    balls: int  # elements of all rows; a ball of a four-point contact bearing has two contacts per ring


def lowest(energy, start, small):
    """Place of the least energy, by Newton steps of limited length.

    ``energy`` returns energy, gradient and matrix of second derivatives of a convex function; ``small`` is
    the force that counts as none.
    """
    place, reach = start.copy(), 1e-5
    value, slope, matrix = energy(place)
    for _ in range(2000):
        if np.max(np.abs(slope)) <= small or reach < 1e-18:
            break
        stiff = np.max(np.diag(matrix)) + 1e3
        step = -np.linalg.solve(matrix + 1e-13 * stiff * np.eye(place.size), slope)
        length = np.max(np.abs(step))
        step *= min(1.0, reach / length)
        new = energy(place + step)
        if new[0] < value or np.linalg.norm(new[1]) < 0.9 * np.linalg.norm(slope):
            place, (value, slope, matrix), reach = place + step, new, min(1e-4, 4.0 * reach)
        else:
            reach = 0.3 * min(reach, length)
    if np.max(np.abs(slope)) > 1e3 * small:
        raise ArithmeticError(f"forces of {np.max(np.abs(slope)):.2g} N are left")
    return place


def positions(table, turned):
    """Angles of the elements of all rows from the load line [rad].

    ``turned`` is the distance of the first element of each row from that line in pitches.
    """
    angles = 2.0 * np.pi * (np.arange(table["elements"]) + turned) / table["elements"]
    return np.tile(angles, 2 if "pair" in table else 1)


def is_symmetric(turned):
    """Whether the ring stays on the load line: a single element may not hold it there."""
    return turned in (0.0, 0.5)


def row_signs(table):
    """1 of each element in the first row, and -1 in the second row of a pair."""
    return np.repeat([1.0, -1.0] if "pair" in table else [1.0], table["elements"])


def radii(table, angle, inner):
    """Reduced radii along and across rolling of a ball with a groove [m]."""
    ball, pitch = table["element_diameter"], table["pitch_diameter"]
    groove = table["inner_groove" if inner else "outer_groove"] * ball
    side = 1.0 if inner else -1.0
    across_axis = 2.0 * side * np.cos(angle) / (pitch - side * ball * np.cos(angle))
    return 1.0 / (2.0 / ball + across_axis), 1.0 / (2.0 / ball - 1.0 / groove)


def ball_stiffness(table, angle, inner):
    """Stiffness K of Q = K d^1.5 of a ball with a ring at a contact angle [N/m^1.5]."""
    return dry_contact(1.0, *radii(table, np.asarray(angle), inner), MODULUS).approach ** -1.5


@dataclass(frozen=True)
class Arcs:
    """Centres of the arcs that hold the balls of a bearing, with the ring where it is not displaced."""

    offsets: tuple[float, float]  # distances of the centres of ball and arc at first touch [m]
    radial: float  # radial distance of inner from outer centres [m]
    inner: tuple[float, ...]  # axial positions of the inner centres from the middle of their ring [m]
    outer: tuple[float, ...]  # the same of the outer centres
    apart: float = 0.0  # axial distance of inner from outer ring in a row of a pair [m]


def arcs_of(table):
    """Arcs of a ball bearing."""
    ball = table["element_diameter"]
    offsets = (table["inner_groove"] - 0.5) * ball, (table["outer_groove"] - 0.5) * ball
    touch = sum(offsets)
    play, angle = table.get("radial_clearance"), table.get("contact_angle")
    if table["kind"] == "thrust ball":
        return Arcs(offsets, 0.0, (0.0,), (0.0,))
    if table["kind"] == "four-point contact ball":
        radial = touch * np.cos(angle)
        aside = np.sqrt(touch**2 - (radial + 0.5 * play) ** 2)
        inner, outer = (aside * offset / touch for offset in offsets)
        return Arcs(offsets, radial, (inner, -inner), (-outer, outer))
    radial = touch - 0.5 * play if angle is None else touch * np.cos(angle)
    apart = _apart(table, offsets, radial) if "pair" in table else 0.0
    return Arcs(offsets, radial, (0.0,), (0.0,), apart)


def _apart(table, offsets, radial):
    """Axial distance of the groove centres in each row of a pair without loads, at rest [m]."""
    pair, angle = table["pair"], table["contact_angle"]
    if "axial_clearance" in pair:
        return radial * np.tan(angle) - 0.5 * pair["axial_clearance"]
    force = pair["preload"] / table["elements"]

    def missing(at):
        load = force / np.sin(at)
        depths = [(load / ball_stiffness(table, at, inner)) ** (2.0 / 3.0) for inner in (True, False)]
        return radial / np.cos(at) - sum(offsets) - sum(depths)

    return radial * np.tan(brentq(missing, angle, 1.5, xtol=1e-15, rtol=1e-14))


def _ball_lines(table, arcs, turned):
    """Matrix and constant part of the vectors of all contacts over the displacements.

    Displacements are radial, lateral and axial ones of the ring, and axial and radial ones of each ball.
    Contacts are ordered by ring, diagonal and ball. Shapes (contacts, 2, unknowns) and (contacts, 2).
    """
    sign, psi = row_signs(table), positions(table, turned)
    balls, each = len(sign), np.arange(len(sign))
    axial, radial = 3 + 2 * each, 4 + 2 * each
    lines, constants = [], []
    for inner, centres in ((True, arcs.inner), (False, arcs.outer)):
        for centre in centres:
            line, constant = np.zeros((balls, 2, 3 + 2 * balls)), np.zeros((balls, 2))
            way = -1.0 if inner else 1.0
            line[each, 0, axial] = line[each, 1, radial] = way
            constant[:, 0] = -way * (centre + (arcs.apart if inner else 0.0))
            if inner:
                line[:, 0, 2] = sign
                line[:, 1, 0], line[:, 1, 1] = np.cos(psi), np.sin(psi) * (not is_symmetric(turned))
                constant[:, 1] = arcs.radial
            lines.append(line)
            constants.append(constant)
    return np.concatenate(lines), np.concatenate(constants)


def cage_speed(table, cosine):
    """Speed of the cage in pure rolling, with the outer ring at rest [rad/s]."""
    share = table["element_diameter"] * cosine / table["pitch_diameter"]
    return 0.5 * table["inner_speed"] * (1.0 - share)


def centrifugal(table, mass, cosine):
    """Centrifugal force on an element [N]."""
    return 0.5 * mass * table["pitch_diameter"] * cage_speed(table, cosine) ** 2


def _mean_cosine(vectors, load):
    """Cosine of the mean of both contact angles, weighted with the load on the inner ring."""
    units = vectors / np.linalg.norm(vectors, axis=1)[:, np.newaxis]
    half = len(units) // 2
    both = units[:half] + units[half:]
    cosine = both[:, 1] / np.linalg.norm(both, axis=1)
    return np.average(cosine, weights=load[:half])


def ball_loads(table, turned):
    """Equilibrium of a ball bearing."""
    arcs = arcs_of(table)
    lines, constants = _ball_lines(table, arcs, turned)
    sign, half = row_signs(table), len(lines) // 2
    offset = np.repeat(arcs.offsets, half)
    mass = DENSITY * np.pi * table["element_diameter"] ** 3 / 6.0
    radial, axial = table.get("radial_load", 0.0), table.get("axial_load", 0.0)
    pull = np.zeros(lines.shape[2])
    pull[0], pull[2] = radial, axial
    angles = np.full(2 * half, table.get("contact_angle", 0.2))
    if table["kind"] == "thrust ball":
        angles[:] = 0.5 * np.pi
    outward = centrifugal(table, mass, np.cos(angles[0]))
    place = _ball_start(table, arcs, len(sign))
    for _ in range(60):
        both = [ball_stiffness(table, angles[:half], True), ball_stiffness(table, angles[half:], False)]
        stiffness = np.concatenate(both)
        pull[4::2] = outward

        def energy(at, stiffness=stiffness):
            return _ball_energy(at, lines, constants, offset, stiffness, pull)

        place = lowest(energy, place, 1e-10 * (np.hypot(radial, axial) + outward))
        vectors = constants + lines @ place
        length = np.linalg.norm(vectors, axis=1)
        load = stiffness * np.maximum(0.0, length - offset) ** 1.5
        last, angles = (angles, outward), np.arctan2(vectors[:, 0], vectors[:, 1])
        outward = centrifugal(table, mass, _mean_cosine(vectors, load))
        if np.max(np.abs(angles - last[0])) < 1e-11 and abs(outward / last[1] - 1.0) < 1e-12:
            break
    shape = 2, half
    return Loads(
        place[:3],
        load.reshape(shape),
        angles.reshape(shape) * np.resize(sign, half),
        np.maximum(0.0, offset - length).reshape(shape),
        len(sign),
    )


def _ball_start(table, arcs, balls):
    """Displacements near which the balls may touch both rings."""
    touch = sum(arcs.offsets)
    place = np.zeros(3 + 2 * balls)
    if table["kind"] != "four-point contact ball" and "pair" not in table:
        place[2] = np.sign(table.get("axial_load", 0.0)) * np.sqrt(max(0.0, touch**2 - arcs.radial**2))
    share = arcs.offsets[1] / touch
    place[3::2] = share * (place[2] * row_signs(table) + arcs.apart)
    place[4::2] = share * arcs.radial
    if table["kind"] == "thrust ball":
        place[4::2] = 1e-9
    return place


def _ball_energy(place, lines, constants, offset, stiffness, pull):
    """Energy of all contacts less the work of the loads, its gradient and second derivatives."""
    vectors = constants + lines @ place
    length = np.linalg.norm(vectors, axis=1)
    unit, depth = vectors / length[:, np.newaxis], np.maximum(0.0, length - offset)
    load = stiffness * depth**1.5
    along, across = 1.5 * stiffness * np.sqrt(depth), load / length
    outer = unit[:, :, np.newaxis] * unit[:, np.newaxis]
    each = across[:, np.newaxis, np.newaxis] * np.eye(2) + (along - across)[:, np.newaxis, np.newaxis] * outer
    force = np.einsum("c,ci,ciu->u", load, unit, lines)
    flat = lines.reshape(-1, lines.shape[2])
    matrix = flat.T @ (each @ lines).reshape(flat.shape)
    return 0.4 * np.sum(load * depth) - pull @ place, force - pull, matrix


def relief(table):
    """Relief of each slice of a roller [m]."""
    if table["profile"] == "none":
        return np.zeros(SLICES)
    length, size = table["roller_length"], table["element_diameter"]
    x = length * np.abs((np.arange(SLICES) + 0.5) / SLICES - 0.5)
    if length <= 2.5 * size:
        return -0.00035 * size * np.log(1.0 - (2.0 * x / length) ** 2)
    end = np.maximum(0.0, 1.0 - (0.5 * length - x) / (1.25 * size))
    return -0.0005 * size * np.log(1.0 - end**2)


def roller_loads(table, turned):
    """Equilibrium of a roller bearing."""
    sign, psi = row_signs(table), positions(table, turned)
    thrust = table["kind"] == "thrust needle roller"
    angle = 0.5 * np.pi if thrust else table.get("contact_angle", 0.0)
    sine, cosine = (1.0, 0.0) if thrust else (np.sin(angle), np.cos(angle))
    own = relief(table)
    # Of two equal contacts in series, each one has 2^(10/9) times the stiffness of both.
    stiffness = 2.0 ** (10.0 / 9.0) * LINE_LAW * table["roller_length"] ** (8.0 / 9.0) / SLICES
    mass = DENSITY * np.pi / 4.0 * table["element_diameter"] ** 2 * table["roller_length"]
    outward = cosine * centrifugal(table, mass, cosine)
    aside = np.sin(psi) * (not is_symmetric(turned))
    normal = np.stack([cosine * np.cos(psi), cosine * aside, sine * sign], axis=1)
    closed = _closed(table, stiffness, own, sine) - 0.5 * table.get("radial_clearance", 0.0) * cosine
    pull = np.concatenate([[table.get("radial_load", 0.0), 0.0, table.get("axial_load", 0.0)], 0.0 * psi])
    pull[3:] = outward
    number, each = len(psi), np.arange(len(psi))
    lines = np.zeros((2, number, 3 + number))
    lines[0, :, :3], lines[0, each, 3 + each], lines[1, each, 3 + each] = normal, -1.0, 1.0
    constants = np.stack([np.full(number, closed), np.zeros(number)])

    def depths(place):
        return constants + lines @ place

    def energy(place):
        pressed = np.maximum(0.0, depths(place)[..., np.newaxis] - own)
        load = stiffness * pressed ** (10.0 / 9.0)
        tangent = (10.0 / 9.0) * stiffness * np.sum(pressed ** (1.0 / 9.0), axis=-1)
        total = np.sum(load, axis=-1)
        value = 9.0 / 19.0 * np.sum(load * pressed) - pull @ place
        gradient = np.einsum("rk,rku->u", total, lines) - pull
        return value, gradient, np.einsum("rk,rku,rkv->uv", tangent, lines, lines)

    small = 1e-10 * (np.hypot(pull[0], pull[2]) + outward)
    place = lowest(energy, np.zeros(3 + number), small)
    depth = depths(place)
    load = stiffness * np.sum(np.maximum(0.0, depth[..., np.newaxis] - own) ** (10.0 / 9.0), axis=-1)
    return Loads(place[:3], load, np.full((2, number), angle) * sign, np.maximum(0.0, -depth), number)


def _closed(table, stiffness, own, sine):
    """Sum of the depths of both contacts of a roller in a pair without loads [m]."""
    if "pair" not in table:
        return 0.0
    pair = table["pair"]
    if "axial_clearance" in pair:
        return -0.5 * pair["axial_clearance"] * sine
    load = pair["preload"] / table["elements"] / sine

    def missing(depth):
        return stiffness * np.sum(np.maximum(0.0, depth - own) ** (10.0 / 9.0)) - load

    return 2.0 * brentq(missing, 0.0, 1e-3, xtol=1e-18, rtol=1e-14)


def has_rollers(table):
    """Whether the elements are rollers."""
    return "roller_length" in table


def loads_of(table, turned=0.0):
    """Equilibrium of a bearing, with one element on the load line or ``turned`` from it, in pitches."""
    return roller_loads(table, turned) if has_rollers(table) else ball_loads(table, turned)


@dataclass(frozen=True)
class Oil:
    """Oil with Barus' viscosity, Dowson and Higginson's density, and Clausius and Mossotti's permittivity."""

    viscosity: float  # [Pa s]
    alpha: float  # [1/Pa]
    permittivity: float  # at ambient pressure
    strength: float  # [V/m]

    def permittivity_at(self, pressure):
        """Relative permittivity under a pressure [Pa]."""
        density = (0.59e9 + 1.34 * pressure) / (0.59e9 + pressure)
        polar = (self.permittivity - 1.0) / (self.permittivity + 2.0) * density
        return (1.0 + 2.0 * polar) / (1.0 - polar)


def ball_films(oil, load, along, across, speed):
    """Minimum and central film of a ball's contact by Chittenden, Dowson, Dunn and Taylor [m]."""
    u, w = oil.viscosity * speed / (MODULUS * along), load / (MODULUS * along**2)
    factor = along * u**0.68 * (oil.alpha * MODULUS) ** 0.49 * w**-0.073
    shape = (across / along) ** (2.0 / 3.0)
    return 3.68 * factor * (1.0 - np.exp(-0.67 * shape)), 4.31 * factor * (1.0 - np.exp(-1.23 * shape))


def roller_films(oil, line_load, radius, speed):
    """Minimum and central film of a roller's contact by Pan and Hamrock [m]."""
    u, w, g = oil.viscosity * speed / (MODULUS * radius), line_load / (MODULUS * radius), oil.alpha * MODULUS
    return (
        1.714 * radius * u**0.694 * g**0.568 * w**-0.128,
        2.922 * radius * u**0.692 * g**0.470 * w**-0.166,
    )


def rolling_speed(table, angle):
    """Entrainment speed of pure rolling at a contact angle [m/s]."""
    share = table["element_diameter"] * np.cos(angle) / table["pitch_diameter"]
    return 0.25 * table["pitch_diameter"] * table["inner_speed"] * (1.0 - share**2)


def charge(gap, tilt, race_curvature, element_curvature):
    """Charge over permittivity and voltage, per area of a raceway [1/m].

    Field lines are arcs between surfaces inclined by ``tilt``. Along a line, the curvature of the surfaces of
    equal potential changes from that of the raceway to that of the element: sums of principal curvatures,
    positive where the raceway is concave.
    """
    wedge = np.where(tilt > 1e-6, np.sin(tilt) / np.maximum(tilt, 1e-6), 1.0)
    return wedge / gap - race_curvature / 3.0 - element_curvature / 6.0


# Numbers of patches around a contact and away from it, and the distance from the edge of the Hertz area over
# which they grow.
AROUND, AWAY, NEAR = 72, 180, 0.02


def _away(furthest):
    """Middles and widths of patches from 1 to ``furthest``, narrow at 1."""
    edges = 1.0 + NEAR * np.expm1(np.linspace(0.0, np.log1p((furthest - 1.0) / NEAR), AWAY + 1))
    return 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)


def _groove(table, inner):
    """Radius of a groove [m], and the angles across it at which it begins and ends [rad]."""
    ratio = table["inner_groove" if inner else "outer_groove"]
    end = np.arccos(1.0 - table["shoulder_height"] / ratio)
    begin, bottom = -end, 0.0
    if table["kind"] == "thrust ball":
        bottom = 0.5 * np.pi
    if table["kind"] == "four-point contact ball":
        arcs = arcs_of(table)
        aside = abs((arcs.inner if inner else arcs.outer)[0])
        begin = np.arcsin(aside / (ratio * table["element_diameter"]))
    return ratio * table["element_diameter"], bottom + begin, bottom + end


def groove_patches(table, angle, inner, closest, x, y):
    """Patches of a groove under a rigid ball, for ``charge``.

    ``closest``, smallest gap of the rigid bodies [m]; ``x`` and ``y``, positions along and across [m].
    Returns gap [m], angle between the normals [rad], sum of the curvatures of the raceway [1/m], and whether
    patches are on the raceway and face the ball.
    """
    ball, centre = 0.5 * table["element_diameter"], 0.5 * table["pitch_diameter"]
    groove, begin, end = _groove(table, inner)
    side = -1.0 if inner else 1.0
    aside = groove - ball - closest
    psi = angle + y / groove
    ring = centre + side * (groove * np.cos(psi) - aside * np.cos(angle))
    phi = x / ring
    height = side * (groove * np.sin(psi) - aside * np.sin(angle))
    away = np.stack([ring * np.cos(phi) - centre, ring * np.sin(phi), height])
    distance = np.sqrt(np.sum(away**2, axis=0))
    normal = side * np.stack([np.cos(psi) * np.cos(phi), np.cos(psi) * np.sin(phi), np.sin(psi)])
    cosine = np.sum(away * normal, axis=0) / distance
    tilt = np.arccos(np.clip(cosine, -1.0, 1.0))
    there = (psi > begin) & (psi < end) & _faces(tilt, distance, ball) & (np.abs(phi) < 0.5 * np.pi)
    return distance - ball, tilt, 1.0 / groove + side * np.cos(psi) / ring, there


def _faces(tilt, distance, radius):
    """Whether the normal of a raceway meets the element, whose middle is at a distance [m]."""
    return (tilt < 0.5 * np.pi) & (distance * np.sin(tilt) < radius)


def ball_capacitance(table, oil, angle, load, film, *, inner):
    """Capacitance of a loaded contact of a ball in oil [F]: Hertz area and all patches around it."""
    contact = dry_contact(load, *radii(table, angle, inner), MODULUS)
    b, a = contact.semi_axis_x, contact.semi_axis_y
    # Ellipses of equal areas: the pressure over its maximum is the root of one less the part inside.
    part = (np.arange(200) + 0.5) / 200
    inside = np.mean(oil.permittivity_at(contact.max_pressure * np.sqrt(1.0 - part))) * np.pi * a * b / film
    ball = 0.5 * table["element_diameter"]
    out, width = _away(max(2.0 * ball / b, 4.0 * ball / a))
    # Both sides along rolling are alike.
    turn = (np.arange(AROUND) + 0.5) / AROUND * np.pi - 0.5 * np.pi
    x, y = b * np.multiply.outer(out, np.cos(turn)), a * np.multiply.outer(out, np.sin(turn))
    touching, tilt, curvature, there = groove_patches(table, angle, inner, 0.0, x, y)
    gap = film + np.maximum(0.0, touching - contact.approach + point_deflection(x, y, contact, MODULUS))
    density = np.where(there, charge(gap, tilt, curvature, 2.0 / ball), 0.0)
    around = 2.0 * np.pi / AROUND * a * b * np.sum((out * width) @ density)
    return epsilon_0 * (inside + oil.permittivity * around)


def rigid_ball_capacitance(table, oil, angle, gap, *, inner):
    """Capacitance of an unloaded ball and its groove in oil, a gap apart [F]."""
    ball = 0.5 * table["element_diameter"]
    along, across = (np.sqrt(2.0 * radius * gap) for radius in radii(table, angle, inner))
    out, width = _away(1.0 + max(2.0 * ball / along, 4.0 * ball / across))
    out = out - 1.0
    turn = (np.arange(AROUND) + 0.5) / AROUND * np.pi - 0.5 * np.pi
    x, y = along * np.multiply.outer(out, np.cos(turn)), across * np.multiply.outer(out, np.sin(turn))
    distance, tilt, curvature, there = groove_patches(table, angle, inner, gap, x, y)
    density = np.where(there, charge(distance, tilt, curvature, 2.0 / ball), 0.0)
    total = 2.0 * np.pi / AROUND * along * across * np.sum((out * width) @ density)
    return epsilon_0 * oil.permittivity * total


def raceway(table, inner):
    """Radius of a raceway of rollers in the plane of rolling, negative at the outer ring [m].

    The flat washers of thrust bearings are circles of a kilometre.
    """
    if table["kind"] == "thrust needle roller":
        return 1e3 if inner else -1e3
    side, cosine = 1.0 if inner else -1.0, np.cos(table.get("contact_angle", 0.0))
    pitch, size = table["pitch_diameter"], table["element_diameter"]
    return 0.5 * side * (pitch - side * size * cosine) / cosine


def roller_radius(table, inner):
    """Reduced radius of a roller and a raceway [m]."""
    return 1.0 / (2.0 / table["element_diameter"] + 1.0 / raceway(table, inner))


def _roller_patches(table, inner, closest, x):
    """Gap of a rigid roller at patches along a raceway, its angle, and whether they face the roller."""
    roller, race = 0.5 * table["element_diameter"], raceway(table, inner)
    phi = x / abs(race)
    centre = race + roller + closest if race > 0.0 else -race - roller - closest
    away = np.stack([abs(race) * np.cos(phi) - centre, abs(race) * np.sin(phi)])
    distance = np.hypot(*away)
    side = -1.0 if race > 0.0 else 1.0
    cosine = side * (away[0] * np.cos(phi) + away[1] * np.sin(phi)) / distance
    tilt = np.arccos(np.clip(cosine, -1.0, 1.0))
    return distance - roller, tilt, _faces(tilt, distance, roller) & (phi < 0.5 * np.pi)


def roller_capacitance(table, oil, load, film, *, inner):
    """Capacitance of a loaded contact of a roller in oil [F]."""
    radius, length = roller_radius(table, inner), table["roller_length"]
    b = np.sqrt(8.0 * load / length * radius / (np.pi * MODULUS))
    largest = 2.0 * load / length / (np.pi * b)
    place = (np.arange(400) + 0.5) / 400
    inside = 2.0 * b * np.mean(oil.permittivity_at(largest * np.sqrt(1.0 - place**2))) / film
    out, width = _away(table["element_diameter"] / b)
    x = b * out
    rigid, tilt, there = _roller_patches(table, inner, 0.0, x)
    gap = film + np.maximum(0.0, rigid - 0.5 * x**2 / radius + b**2 / radius * line_gap(out))
    density = charge(gap, tilt, -1.0 / raceway(table, inner), 2.0 / table["element_diameter"])
    around = 2.0 * b * np.sum(np.where(there, density, 0.0) * width)
    return epsilon_0 * length * (inside + oil.permittivity * around)


def rigid_roller_capacitance(table, oil, gap, *, inner):
    """Capacitance of an unloaded roller and a raceway in oil, a gap apart [F]."""
    scale = np.sqrt(2.0 * roller_radius(table, inner) * gap)
    out, width = _away(1.0 + table["element_diameter"] / scale)
    rigid, tilt, there = _roller_patches(table, inner, gap, scale * (out - 1.0))
    density = charge(rigid, tilt, -1.0 / raceway(table, inner), 2.0 / table["element_diameter"])
    half = scale * np.sum(density[there] * width[there])
    return 2.0 * epsilon_0 * oil.permittivity * table["roller_length"] * half


def _films(table, oil, load, angle, inner, speed):
    """Minimum and central film of a contact [m]: of deformed and of rigid bodies, in fourth powers."""
    if has_rollers(table):
        radius, per_length = roller_radius(table, inner), load / table["roller_length"]
        films = roller_films(oil, per_length, radius, speed)
        # Martin.
        rigid = 4.896 * oil.viscosity * speed * radius / per_length
    else:
        rx, ry = radii(table, angle, inner)
        films = ball_films(oil, load, rx, ry, speed)
        # Brewe, Hamrock and Taylor.
        flow = oil.viscosity * speed * rx / load / (1.0 + 2.0 * rx / (3.0 * ry))
        rigid = 128.0 * ry * (flow * (0.131 * np.arctan(0.5 * ry / rx) + 1.683)) ** 2
    return [(film**4 + rigid**4) ** 0.25 for film in films]


def _room(gap, film):
    """Room for the film of an element [m], which two films of the most loaded contact widen."""
    least = 2.0 * film
    return least + gap**2 / (4.0 * least) if gap < 2.0 * least else gap


def contact_of(table, oil, load, angle, gap, room, inner, speed, thinnest):
    """Capacitance [F] and breakdown voltage [V] of a contact, loaded or a gap apart.

    ``gap``, gap of the contact, and ``room``, gaps of the element with both rings [m]; ``thinnest``, central
    film of the most loaded contact with the ring [m]. From 0.8 to 1.2 times its room, the film under a load
    turns into a gap.
    """

    def rigid(apart):
        if has_rollers(table):
            return rigid_roller_capacitance(table, oil, apart, inner=inner)
        return rigid_ball_capacitance(table, oil, angle, apart, inner=inner)

    if load <= 0.0:
        apart = _room(gap, thinnest)
        return rigid(apart), oil.strength * apart
    most = _room(room, thinnest)
    least, central = _films(table, oil, load, angle, inner, speed)
    part = np.clip((central / most - 0.8) / 0.4, 0.0, 1.0)
    free = part**2 * (3.0 - 2.0 * part)
    apart = min(central, most * (0.8 + 0.4 * part - 0.2 * part**2))
    own = 0.0
    if free < 1.0 and has_rollers(table):
        own = roller_capacitance(table, oil, load, central, inner=inner)
    elif free < 1.0:
        own = ball_capacitance(table, oil, angle, load, central, inner=inner)
    if free > 0.0:
        own = (1.0 - free) * own + free * rigid(apart)
    return own, oil.strength * apart * (free + (1.0 - free) * least / central)


def _rooms(table, loads):
    """Room of each contact [m]: its gap and the other gap of its element, if nothing holds the element."""
    other = loads.gap[::-1]
    if table["kind"] == "four-point contact ball":
        pressed = loads.load[0].reshape(2, -1).sum(axis=0)
        other = other / (1.0 + 1e3 * np.tile(pressed, 2) / np.max(loads.load[0]))
    return loads.gap + other


def electric_of(table, oil, loads, largest):
    """Capacitance of a bearing in oil [F], and the voltage at which its first contact breaks down [V].

    Both contacts of a ball with one ring are parallel, and those with both rings are in series. ``largest``,
    loads of the most loaded contacts with both rings at all positions of the cage [N].
    """
    number = loads.load.shape[1]
    capacitance, breaks = np.empty((2, number)), np.empty((2, number))
    # The halves of a groove or an arch are alike.
    angles, known = np.abs(loads.angle), {}
    speed, rooms = rolling_speed(table, np.mean(angles, axis=0)), _rooms(table, loads)
    for ring in (0, 1):
        most = np.argmax(loads.load[ring])
        thinnest = _films(table, oil, largest[ring], angles[ring, most], ring == 0, speed[most])[1]
        for k in range(number):
            values = loads.load[ring, k], angles[ring, k], loads.gap[ring, k], rooms[ring, k], speed[k]
            key = (ring, *(float(f"{value:.7e}") for value in values))
            if key not in known:
                known[key] = contact_of(table, oil, *values[:4], ring == 0, speed[k], thinnest)
            capacitance[ring, k], breaks[ring, k] = known[key]
    inner, outer = capacitance.reshape(2, -1, loads.balls).sum(axis=1)
    share = outer / (inner + outer)
    inner_breaks, outer_breaks = breaks.reshape(2, -1, loads.balls).min(axis=1)
    first = min(np.min(inner_breaks / share), np.min(outer_breaks / (1.0 - share)))
    return np.sum(inner * share), first
