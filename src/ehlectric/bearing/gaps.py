"""Capacitance of the gaps around the loaded contacts, from the geometry of element and raceway. SI units.

The raceway of a ball is a torus: a groove of radius r_g about a circle around the bearing axis. Along rolling
it is convex at the inner ring and concave at the outer ring. A point Q on it has the azimuth phi from the
ball, and the angle psi across the groove, from its bottom and positive towards the contact. The ball's centre
O is at the distance R_o from the axis, and the gap at the contact angle alpha is h0. With e = r_g - r - h0,
u = psi - alpha and the radius of the raceway at Q, R = R_o + s (r_g cos psi - e cos alpha), where s is 1 at
the outer ring and -1 at the inner ring,

    abs(Q - O)^2 = (r + h0)^2 + 4 r_g e sin^2(u/2) + 4 R R_o sin^2(phi/2).

A roller and its raceway are circles. R is the radius of the raceway, r the radius of the roller, and h0 the
smallest gap. The roller's centre O is at R_o = R + r + h0 from the bearing axis at the inner ring, and at
R_o = R - r - h0 at the outer ring. For a point Q on the raceway at the azimuth phi

    abs(Q - O)^2 = (r + h0)^2 + 4 R R_o sin^2(phi/2).

Both forms avoid differences of large numbers. The gap at Q is measured along the radius of the element:
abs(Q - O) - r. ``formulas.capacitances.charge_density`` gives the charge on the raceway. It is integrated
along rolling over the part that half of the element faces: to where the normal of the raceway is tangent to
the element; and across a groove from shoulder to shoulder.

The model neglects the field lines from the lands next to the groove, from the raceway between two elements,
around the ends of a roller, and to cage and shields. For a ball over an infinite plane, the neglected part
would be 30 % of the total at h0/r = 1e-3. It is less in a groove, which partly encloses the ball.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, overload

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask, Numbers
from ehlectric.constants import EPSILON_0
from ehlectric.errors import InputError, shown
from ehlectric.formulas.capacitances import charge_density, matched_offset, stretched
from ehlectric.formulas.hertz import DryContact, line_opening, reduced_radius
from ehlectric.formulas.hertz_outside import unit_deflection


@dataclass(frozen=True, eq=False)
class Raceway:
    """Groove of one ring, and the ball in it; numbers, or arrays of shape (...) for many points."""

    # ball_radius and groove_radius: radius r of the ball and r_g of the groove [m].
    ball_radius: Numbers
    groove_radius: Numbers
    pitch_radius: Numbers  # distance R_o from the axis of the bearing to the centre of the ball [m]
    # Angle psi at which the groove ends, beyond the contact [rad].
    shoulder_angle: Numbers
    contact_angle: Numbers  # angle psi of the contact, alpha [rad]
    outer: bool
    # Angle psi at which the groove begins [rad]; None where that is on the other side of its bottom, as far
    # as it ends.
    first_angle: Numbers | None = None

    @classmethod
    def of(
        cls,
        element_diameter: Numbers,
        pitch_diameter: Numbers,
        groove: Numbers,
        shoulder_height: Numbers,
        *,
        outer: bool,
        contact_angle: Numbers = 0.0,
        bottom_angle: float = 0.0,
        first_angle: Numbers | None = None,
    ) -> Raceway:
        """Raceway of a bearing from the dimensions that catalogues state.

        ``element_diameter`` and ``pitch_diameter``, diameter D of the balls, and diameter of the circle of
        their centres [m]; ``contact_angle`` and ``bottom_angle``, angles of the contact and of the bottom of
        the groove from the radial direction [rad]; ``first_angle``, angle from the bottom at which the groove
        begins [rad], None for the shoulder on the other side; all of shape (...). Raises InputError where a
        groove radius is too small, a shoulder height is out of range, or the groove of a single point ends
        before the contact. ``holds`` returns the latter for arrays.

        Examples
        --------
        A groove with a radius of 0.52 D and a depth of 0.2 D reaches 52 degrees up on either side:

        >>> race = Raceway.of(11.906e-3, 60e-3, 0.52, 0.2, outer=True)
        >>> round(float(np.degrees(race.shoulder_angle)), 1)
        52.0
        """
        _check_groove(groove, shoulder_height)
        shoulder = np.arccos(1.0 - shoulder_height / groove)
        begins = first_angle
        if bottom_angle:
            begins = bottom_angle - shoulder if first_angle is None else bottom_angle + first_angle
        race = cls(
            0.5 * element_diameter,
            groove * element_diameter,
            0.5 * pitch_diameter,
            bottom_angle + shoulder,
            contact_angle,
            outer,
            begins,
        )
        if np.ndim(race.holds) == 0 and not race.holds:
            low, high = np.degrees(race.begins), np.degrees(race.shoulder_angle)
            raise InputError(
                "contact_angle",
                f"must be between {low:.1f} and {high:.1f} degrees, where a groove of shoulder_height "
                f"{shoulder_height:g} ends; got {np.degrees(contact_angle):.1f} degrees",
            )
        return race

    @property
    def holds(self) -> Mask:
        """Whether the contact is in the groove, shape (...)."""
        angle = self.contact_angle
        if self.first_angle is None:
            angle = np.abs(angle)
        return np.asarray((angle > self.begins) & (angle < self.shoulder_angle))

    @property
    def begins(self) -> Numbers:
        """Angle psi at which the groove begins [rad]."""
        return -self.shoulder_angle if self.first_angle is None else self.first_angle

    @property
    def radius_x(self) -> Numbers:
        """Reduced radius Rx of ball and raceway along rolling [m], shape (...)."""
        cosine, sign = np.cos(self.contact_angle), 1.0 if self.outer else -1.0
        rolling = cosine / (self.pitch_radius + sign * self.ball_radius * cosine)
        return 1.0 / (1.0 / self.ball_radius - sign * rolling)

    @property
    def radius_y(self) -> Numbers:
        """Reduced radius Ry of ball and groove across rolling [m], shape (...)."""
        return 1.0 / (1.0 / self.ball_radius - 1.0 / self.groove_radius)

    def for_nodes(self, axes: int) -> Raceway:
        """Raceways of many points with further axes, for their loads or for nodes."""
        numbers = {name: value for name, value in vars(self).items() if np.ndim(value) > 0}
        spread: dict[str, Any] = {name: for_nodes(value, axes) for name, value in numbers.items()}
        return replace(self, **spread) if spread else self

    def at(self, points: IntArray | Mask | slice) -> Raceway:
        """Return the raceways of some points; ``points`` is an index into arrays of shape (...)."""
        numbers = {name: value for name, value in vars(self).items() if np.ndim(value) > 0}
        return replace(self, **{name: value[points] for name, value in numbers.items()}) if numbers else self


def _check_groove(groove: Numbers, shoulder_height: Numbers) -> None:
    """Refuse a groove without room for the ball, and shoulders that are none or higher than its radius."""
    narrow = np.ravel(groove)[np.ravel(groove <= 0.5)]
    if narrow.size:
        raise InputError(
            "groove radius over ball diameter", f"must be above 0.5; got {shown(float(narrow[0]))}"
        )
    groove, shoulder_height = np.broadcast_arrays(groove, shoulder_height)
    wrong = ~((shoulder_height > 0.0) & (shoulder_height <= groove))
    if np.any(wrong):
        raise InputError(
            "shoulder_height",
            f"must be above 0 and at most the groove radius over the ball diameter, {groove[wrong][0]:g}; "
            f"got {shown(float(shoulder_height[wrong][0]))}",
        )


@overload
def for_nodes(values: Array, axes: int = 1) -> Array: ...


@overload
def for_nodes(values: Numbers, axes: int = 1) -> Numbers: ...


def for_nodes(values: Numbers, axes: int = 1) -> Numbers:
    """Values of many points with further axes for their nodes; a number stays one."""
    return values if np.ndim(values) == 0 else np.asarray(values)[(..., *[np.newaxis] * axes)]


def groove_gap(race: Raceway, gap: Numbers, x: Array, y: Array) -> Array:
    """Gap between a rigid ball and points on its raceway, along the radius of the ball.

    ``gap``, gap h0 of the rigid bodies at the contact [m]; ``x`` and ``y``, distance from the contact along
    the arcs of the raceway: along rolling and across the groove [m]. For raceways of many points, of shape
    (...), positions have the shape (..., n) and gaps the shape (..., 1) or (..., n). Returns gap [m]; close
    to the contact it is h0 + x^2/(2 Rx) + y^2/(2 Ry), shape (...).

    Examples
    --------
    Gap at the contact and 0.1 mm along rolling, in micrometres:

    >>> race = Raceway.of(12e-3, 60e-3, 0.52, 0.2, outer=False)
    >>> x = np.array([0.0, 1e-4])
    >>> print(np.round(groove_gap(race, 1e-6, x, np.zeros(2)) * 1e6, 3))
    [1.    2.041]
    """
    race = race.for_nodes(1)
    psi = race.contact_angle + y / race.groove_radius
    return distance_at(race, gap, psi, np.sin(0.5 * x / race_radius(race, gap, psi)) ** 2)


def offset_centre(race: Raceway, gap: Numbers) -> Numbers:
    """Distance e from the centre of the ball to the centre of the groove [m]."""
    return race.groove_radius - race.ball_radius - gap


def race_radius(race: Raceway, gap: Numbers, psi: Array) -> Array:
    """Radius R of the raceway about the axis of the bearing, at the angle psi [m]."""
    inwards = race.groove_radius * np.cos(psi) - offset_centre(race, gap) * np.cos(race.contact_angle)
    radius: Array = race.pitch_radius + (inwards if race.outer else -inwards)
    return radius


def distance_at(race: Raceway, gap: Numbers, psi: Array, q: Array) -> Array:
    """Gap along the radius of the ball [m] at psi [rad] and q = sin^2(phi/2)."""
    near, u = race.ball_radius + gap, psi - race.contact_angle
    across = 4.0 * race.groove_radius * offset_centre(race, gap) * np.sin(0.5 * u) ** 2
    further = across + 4.0 * race_radius(race, gap, psi) * race.pitch_radius * q
    distance: Array = gap + further / (np.sqrt(near**2 + further) + near)
    return distance


def _sideways(race: Raceway, gap: Numbers, psi: Array) -> tuple[Array, Array, Array]:
    """Coefficients of the squared distance of O from the normal of the raceway at Q.

    It is flat + linear q - square q^2, with q = sin^2(phi/2) [m^2].
    """
    e, pitch, s = offset_centre(race, gap), race.pitch_radius, 1.0 if race.outer else -1.0
    aside = e * np.sin(psi - race.contact_angle)
    return aside**2, 4.0 * pitch * (pitch - s * np.sin(psi) * aside), (2.0 * pitch * np.cos(psi)) ** 2


def reach(race: Raceway, gap: Numbers, psi: Array, obliquity: float) -> Array:
    """Azimuth at which the raceway's normal meets the ball at an angle to the ball's normal [rad]."""
    flat, linear, square = _sideways(race, gap, psi)
    left = np.maximum(0.0, (race.ball_radius * np.sin(obliquity)) ** 2 - flat)
    q = 2.0 * left / (linear + np.sqrt(linear**2 - 4.0 * square * left))
    reach: Array = 2.0 * np.arcsin(np.sqrt(q))
    return reach


# Quadrature nodes along rolling and across the groove; tests check that the integral is accurate to 1e-8.
_ALONG, _ACROSS = 40, 64


@dataclass(frozen=True)
class Nodes:
    """Numbers of quadrature nodes around a film.

    The gap changes fastest behind a film, which ends close to the Hertz ellipse.
    """

    per_side: tuple[int, int]  # along rolling and across the groove, on either side of the film
    tails: int  # along rolling, ahead of the film and behind it
    ahead: int  # across the groove ahead of the film
    behind: int  # across the groove in each of four parts behind the film
    # Nodes of the film along and across entrainment, on the edge of whose domain the gap continues it.
    rim: tuple[int, int]

    @property
    def number(self) -> int:
        """Number of all nodes."""
        return 2 * self.per_side[0] * self.per_side[1] + self.tails * (self.ahead + 4 * self.behind)


# With fine nodes the error of each part is below 1e-9 of the whole contact, with coarse ones the error of all
# parts is below 1e-5 of them.
FINE, COARSE = Nodes((12, 8), 20, 14, 10, (97, 65)), Nodes((8, 5), 12, 9, 6, (25, 17))

# Largest distance of the foci from the middle over the side of a film, for the nodes next to it.
_INSIDE = 0.95

# Angle between the normals of ball and raceway where the half of the ball that faces the raceway ends [rad].
_HALF = 0.5 * np.pi

# Elastic deflection that widens the gap between rigid bodies [m], as a function of the squares of the
# distances from the contact along and across entrainment [m^2].
Opening = Callable[[Array, Array], Array]

# Largest relative difference of the ratios of semi-axes that count as one ratio, up to rounding.
_SAME = 1e-14


@dataclass(frozen=True)
class LoadedContact:
    """Bodies around a solved film, deflected by the Hertz pressure and otherwise rigid.

    Contacts of several loads or points are held together: values are arrays of shape (...) then.
    """

    dry: DryContact  # dry contact under the same load
    modulus: Numbers  # reduced modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2
    # Gap that the undeflected bodies would have at the contact [m]. It is about the film thickness less the
    # elastic approach, and mostly negative.
    offset: Numbers
    # Largest relative difference from the solved film thickness along the edge of the film's domain.
    mismatch: Numbers
    # Ratio of the semi-axes, where it is known with fewer different values than the ratios of the dry
    # contacts.
    ratio: Numbers | None = None

    def opening(self, x: Array, y: Array) -> Array:
        """Deflection that widens the gap at positions x and y from the contact [m], shapes (..., m, n)."""
        return _opening_of(self.dry, self.modulus, 2, self.ratio)(x * x, y * y)


def _opening_of(dry: DryContact, modulus: Numbers, axes: int, ratio: Numbers | None = None) -> Opening:
    """Deflection at points of which each contact has ``axes`` axes."""
    b, a = dry.semi_axis_x, dry.semi_axis_y
    if ratio is None:
        ratio = a / b
    if np.ndim(ratio) and np.size(ratio) and np.ptp(ratio) <= _SAME * np.max(ratio):
        ratio = float(np.ravel(ratio)[0])
    over, scale = for_nodes(b**-2.0, axes), for_nodes(dry.max_pressure * a / modulus, axes)
    ratio = for_nodes(ratio, axes)
    return lambda x2, y2: scale * unit_deflection(x2 * over, y2 * over, ratio)


def groove_capacitance(
    race: Raceway, gap: Numbers, relative_permittivity: Numbers = 1.0, *, obliquity: float = _HALF
) -> Numbers:
    """Capacitance between an unloaded, rigid ball and its raceway.

    ``gap``, gap h0 at the contact angle [m], positive; ``relative_permittivity``, relative permittivity of
    the medium in the gap, dimensionless; ``obliquity``, end of the integral along rolling: where the normal
    of the raceway meets the ball at this angle from the normal of the ball [rad]. Gap, permittivity and the
    numbers of ``race`` broadcast. Returns capacitance [F], shape (...).

    Examples
    --------
    Capacitance of a 6208 with a gap of 5 um in oil, in pF, and the share of the part beyond 45 degrees:

    >>> race = Raceway.of(11.906e-3, 60e-3, 0.52, 0.2, outer=False)
    >>> whole = groove_capacitance(race, 5e-6, 2.4)
    >>> middle = groove_capacitance(race, 5e-6, 2.4, obliquity=np.pi / 4)
    >>> round(whole * 1e12, 1), round(1.0 - middle / whole, 2)
    (15.3, 0.02)
    """
    shape = np.broadcast_shapes(np.shape(gap), *(np.shape(value) for value in vars(race).values()))

    def whole(race: Raceway, gap: Numbers) -> Array:
        steepness = np.abs(offset_centre(race, gap)) * race.groove_radius / race.ball_radius
        # Angle from the contact at which the gap is twice as large.
        scale = np.sqrt(2.0 * gap / np.maximum(steepness, 2.0 * gap))
        ends = race.begins - race.contact_angle, race.shoulder_angle - race.contact_angle
        u, weights = stretched(*ends, scale, _ACROSS)
        along = _along(race, gap, for_nodes(race.contact_angle) + u, None, obliquity, None, _ALONG)
        charge: Array = np.add.reduce(weights * along, axis=-1)
        return charge

    integral = _in_chunks(whole, shape, _ALONG * _ACROSS, race, gap)
    return 2.0 * EPSILON_0 * relative_permittivity * integral


def outside_capacitance(
    race: Raceway,
    contact: LoadedContact,
    domain: tuple[Numbers, Numbers, Numbers],
    relative_permittivity: Numbers = 1.0,
    *,
    obliquity: float = _HALF,
    shoulders: bool = True,
    nodes: Nodes = FINE,
) -> Numbers:
    """Capacitance between a loaded ball and its raceway outside the domain of the solved film.

    Contacts of several loads and points are integrated together.

    The gap is the gap of rigid bodies with the gap ``contact.offset``, widened by the deflection under the
    Hertz pressure. This deflection is exact for half-spaces. Film pressure and Hertz pressure carry the same
    load, so their difference deflects the bodies little around the ellipse; ``match_film`` compensates for it
    at the edge of the domain. In ``examples/ball_bearing.toml`` the capacitance of the whole contact changes
    by 0.1 % when the domain is cut from 1.75 to 1.4 semi-axes across. This moves 5 pF of 76 pF to the
    outside.

    ``domain``, inlet, outlet and side of the film's domain, inlet <= x <= outlet and abs(y) <= side [m],
    shape (...); ``relative_permittivity``, relative permittivity of the medium in the gap, dimensionless;
    ``obliquity``, end of the integral along rolling, as in ``groove_capacitance`` [rad]; ``shoulders``, False
    for a groove that continues beyond its shoulders up to the side of a domain that is wider than the groove,
    where the capacitance inside this domain is subtracted: an analytic function; ``nodes``, numbers of
    quadrature nodes. The numbers of ``race`` and
    of ``contact`` have the shape (...). Returns capacitance [F], shape (...).
    """
    dry = contact.dry
    ratio = dry.semi_axis_y / dry.semi_axis_x if contact.ratio is None else contact.ratio
    numbers = (dry.semi_axis_x, ratio, dry.max_pressure, contact.modulus, contact.offset, *domain)
    shape = np.broadcast_shapes(*(np.shape(value) for value in (*vars(race).values(), *numbers)))

    def outside(race: Raceway, *numbers: Numbers) -> Array:
        b, ratio, pressure, modulus, offset, *domain = numbers
        a = ratio * b
        opening = _opening_of(DryContact(b, a, pressure, 0.0), modulus, 2, ratio)
        focus = np.sqrt(np.maximum(0.0, a**2 - b**2))
        return _outside(race, offset, opening, (*domain, focus), obliquity, nodes, shoulders=shoulders)

    return EPSILON_0 * relative_permittivity * _in_chunks(outside, shape, nodes.number, race, *numbers)


def _outside(
    race: Raceway,
    offset: Numbers,
    opening: Opening,
    lengths: tuple[Numbers, ...],
    obliquity: float,
    nodes: Nodes,
    *,
    shoulders: bool,
) -> Array:
    """Integral of the charge density outside the domain of the film [m], shape (...)."""
    inlet, outlet, side, focus = lengths
    rg = race.groove_radius
    total: Array = np.zeros(())
    along, across = nodes.per_side
    for (psi, weights), begins, number, count in (
        # Inlet and outlet are alike on both sides of the film.
        (_sides(race, side / rg, focus / rg, across, shoulders=shoulders), None, 2.0, along),
        _tails(race, tuple(end / rg for end in (-inlet, outlet, side, focus)), nodes, shoulders=shoulders),
    ):
        starts = None if begins is None else begins * for_nodes(rg)
        charges = _along(race, offset, psi, starts, obliquity, opening, count)
        total = total + number * np.add.reduce(weights * charges, axis=-1)
    return total


# Nodes that are computed together: few enough for the processor's cache.
_BLOCK = 50_000


def _in_chunks(
    function: Callable[..., Array], shape: tuple[int, ...], nodes: int, race: Any, *numbers: Numbers
) -> Numbers:
    """Function of a raceway and numbers, for some points at a time; ``nodes``, nodes of a point.

    Numbers and raceway broadcast to ``shape``; numbers that do not vary stay so.
    """
    size = int(np.prod(shape, dtype=int))
    if shape == ():
        return float(function(race, *numbers))
    if size * nodes <= _BLOCK:
        return np.broadcast_to(function(race, *numbers), shape)

    def flat(value: Numbers) -> Numbers:
        return value if np.ndim(value) == 0 else np.broadcast_to(value, shape).ravel()

    race = replace(race, **{name: flat(value) for name, value in vars(race).items()})
    numbers = tuple(flat(value) for value in numbers)
    integral, step = np.empty(size), max(1, _BLOCK // nodes)
    for start in range(0, size, step):
        part = slice(start, start + step)
        integral[part] = function(
            race.at(part), *(v if np.ndim(v) == 0 else np.asarray(v)[part] for v in numbers)
        )
    return integral.reshape(shape)


def match_film(
    race: Raceway,
    dry: DryContact,
    modulus: Numbers,
    *,
    x: Array,
    y: Array,
    thickness: Array,
    opened: Array | None = None,
) -> LoadedContact:
    """Bodies around a film, with the offset at which their gap continues the film.

    With this offset the error of 1/h adds up to zero over the edge of the film's domain. The gap does not fit
    at every point, because the film has parabolas instead of circles, and another pressure than Hertz's. The
    largest difference is ``mismatch``.

    ``dry``, dry contact under the same load; arrays of shape (...) for several loads; ``modulus``, reduced
    modulus E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; ``x``, ``y`` and ``thickness``, points on
    the edge of the film's domain, with x along entrainment, and the film thickness there [m], shape (..., n);
    ``opened``, deflection at the points, where it is known [m], shape (..., n).
    """
    if opened is None:
        opened = _opening_of(dry, modulus, 1)(x * x, y * y)
    missing = missing_gap(race, thickness - opened, x, y)
    offset, mismatch = matched_offset(missing, thickness, start=-np.asarray(dry.approach))
    return LoadedContact(dry, modulus, offset, mismatch)


def missing_gap(race: Raceway, undeflected: Array, x: Array, y: Array) -> Callable[[Array], Array]:
    """Gap of undeflected bodies [m] less the gap that they have with an offset, as a function of the offset.

    ``undeflected``, gap at the points x and y from the contact [m], shape (..., n). The offset has the shape
    (..., 1) [m].
    """
    race = race.for_nodes(1)
    u = y / race.groove_radius
    psi = race.contact_angle + u
    across, cosine = 4.0 * race.groove_radius * np.sin(0.5 * u) ** 2, np.cos(psi)

    def missing(offset: Array) -> Array:
        near, e = race.ball_radius + offset, offset_centre(race, offset)
        inwards = race.groove_radius * cosine - e * np.cos(race.contact_angle)
        radius = race.pitch_radius + (inwards if race.outer else -inwards)
        further = across * e + 4.0 * race.pitch_radius * radius * np.sin(0.5 * x / radius) ** 2
        left: Array = undeflected - offset - further / (np.sqrt(near**2 + further) + near)
        return left

    return missing


def _in_groove(race: Raceway, *, shoulders: bool) -> Callable[[Numbers], Numbers]:
    """Function that moves an angle from the contact into the groove, if that has shoulders."""
    low, high = race.begins - race.contact_angle, race.shoulder_angle - race.contact_angle
    return lambda angle: np.minimum(np.maximum(angle, low), high) if shoulders else angle


def _sides(
    race: Raceway, edge: Numbers, focus: Numbers, nodes: int, *, shoulders: bool
) -> tuple[Array, Array]:
    """Nodes psi [rad] and weights from the sides of a film, at +-``edge`` [rad], to the shoulders.

    The deflection is singular at the foci of the ellipse, at +-``focus`` [rad].
    """
    angle, within = race.contact_angle, _in_groove(race, shoulders=shoulders)
    focus = np.minimum(focus, _INSIDE * edge)
    scale = 0.5 * (edge - focus)
    low = stretched(race.begins - angle + focus, within(-edge) + focus, scale, nodes)
    high = stretched(within(edge) - focus, race.shoulder_angle - angle - focus, scale, nodes)
    middle = for_nodes(angle)
    psi = middle - for_nodes(focus) + low[0], middle + for_nodes(focus) + high[0]
    return np.concatenate(psi, axis=-1), np.concatenate([low[1], high[1]], axis=-1)


def _tails(
    race: Raceway, angles: tuple[Numbers, ...], nodes: Nodes, *, shoulders: bool
) -> tuple[tuple[Array, Array], Array, float, int]:
    """Nodes psi [rad] and weights ahead of a film and behind it, and where the integrals along rolling begin.

    The deflection at a distance x along rolling has singular points across it at +-c +- ix, where c is the
    distance of the foci of the ellipse from its middle. Behind the film x is short, so that nodes are dense
    near the foci. ``angles``, inlet, outlet, side and c over the radius of the groove.
    """
    inlet, outlet, edge, focus = angles
    angle, within = race.contact_angle, _in_groove(race, shoulders=shoulders)
    focus = np.minimum(focus, edge)
    parts = [stretched(within(-edge), within(edge), edge, nodes.ahead)]
    for near, far in ((-focus, -edge), (-focus, 0.0), (focus, 0.0), (focus, edge)):
        middle = for_nodes(near)
        u, weights = stretched(within(near) - near, within(far) - near, outlet, nodes.behind)
        parts.append((middle + u, np.abs(weights)))
    begins = [
        np.broadcast_to(for_nodes(start), part[0].shape)
        for start, part in zip((inlet, outlet, outlet, outlet, outlet), parts, strict=True)
    ]
    u, weights = (np.concatenate(columns, axis=-1) for columns in zip(*parts, strict=True))
    return (for_nodes(angle) + u, weights), np.concatenate(begins, axis=-1), 1.0, nodes.tails


def _along(
    race: Raceway,
    gap: Numbers,
    psi: Array,
    begins: Array | None,
    obliquity: float,
    opening: Opening | None,
    nodes: int,
) -> Array:
    """Integral of the charge density along one side of the raceway, times r_g, for each psi [m].

    ``gap``, shape (...); ``psi``, shape (..., m); ``begins``, distance along rolling from which on the
    integral counts [m], shape (..., m), None where it is all of the side. Returns shape (..., m).
    """
    race, gap, psi = race.for_nodes(2), for_nodes(gap, 2), psi[..., np.newaxis]
    r, rg, pitch, s = race.ball_radius, race.groove_radius, race.pitch_radius, 1.0 if race.outer else -1.0
    e, near, u, cosine = offset_centre(race, gap), r + gap, psi - race.contact_angle, np.cos(psi)
    radius = race_radius(race, gap, psi)
    across, y2 = 4.0 * rg * e * np.sin(0.5 * u) ** 2, (rg * u) ** 2
    last = reach(race, gap, psi, obliquity)
    start: Numbers = 0.0
    if begins is None:
        middle = gap + across / (np.sqrt(near**2 + across) + near)
        if opening is not None:
            middle = middle + opening(np.zeros_like(y2), y2)
        # Azimuth at which the gap is twice that in the middle.
        scale = np.sqrt(2.0 * r * np.abs(middle) / (radius * pitch))
    else:
        scale = begins[..., np.newaxis] / radius
        start = np.minimum(scale, last)
    phi, weights = (values[..., 0, :] for values in stretched(start, last, scale, nodes))
    square = phi * phi
    phi *= 0.5
    q = np.sin(phi, out=phi)
    q *= q
    further = 4.0 * pitch * radius * q
    further += across
    away = further + near**2
    away = np.sqrt(away, out=away)
    # Angle between the normals by its cosine, the component of Q - O along the normal of the raceway over
    # abs(Q - O). An error of the sine cancels in the ratio of the sine to its angle.
    q *= 2.0 * s * cosine * pitch
    q += rg - e * np.cos(u)
    q /= away
    further /= np.add(away, near, out=away)
    further += gap
    if opening is not None:
        further += opening(np.multiply(square, radius**2, out=square), y2)
    sine = np.multiply(q, q, out=away)
    sine = np.sqrt(np.maximum(1.0 - sine, _FLAT), out=away)
    # charge_density, of which the constant part is integrated with only the weights.
    curvature = s * cosine / radius + 1.0 / rg
    constant = (2.0 / r / 6.0 + curvature / 3.0)[..., 0]
    total: Array = np.add.reduce(weights, axis=-1) * -constant
    further *= np.arctan2(sine, q, out=q)
    weights *= sine
    weights /= further
    total += np.add.reduce(weights, axis=-1)
    total *= (rg * radius)[..., 0]
    return total


# Square of the sine of the least angle between normals: smaller angles do not change the charge.
_FLAT = 1e-20


# Quadrature nodes on each side of a rigid roller, and around a film; the integrals are accurate to 1e-11.
_NODES, _TAIL_NODES = 24, 28


@dataclass(frozen=True)
class RollerRaceway:
    """Raceway of one ring, and the roller on it; numbers, or arrays of shape (...) for many points."""

    # roller_radius and race_radius: radius r of the roller and R of the raceway [m].
    roller_radius: Numbers
    race_radius: Numbers
    outer: bool

    @property
    def curvature(self) -> Numbers:
        """Curvature of the raceway, positive where it is concave [1/m]."""
        return (1.0 if self.outer else -1.0) / self.race_radius

    def pitch_radius(self, gap: Numbers) -> Numbers:
        """Distance R_o from the axis of the bearing to the centre of the roller, for a gap [m]."""
        return self.race_radius - (1.0 if self.outer else -1.0) * (self.roller_radius + gap)

    def at(self, points: IntArray | Mask | slice) -> RollerRaceway:
        """Raceways of some of the points; ``points``, an index of arrays of shape (...)."""
        radii = (
            r if np.ndim(r) == 0 else np.asarray(r)[points] for r in (self.roller_radius, self.race_radius)
        )
        return RollerRaceway(next(radii), next(radii), self.outer)

    def for_nodes(self, axes: int) -> RollerRaceway:
        """Raceways of many points with further axes, for their loads or for nodes."""
        return replace(
            self,
            roller_radius=for_nodes(self.roller_radius, axes),
            race_radius=for_nodes(self.race_radius, axes),
        )


def roller_capacitance(
    race: RollerRaceway, gap: Numbers, relative_permittivity: Numbers = 1.0, *, obliquity: float = _HALF
) -> Numbers:
    """Capacitance per length between an unloaded, rigid roller and its raceway.

    ``gap``, smallest gap h0 [m], positive; ``relative_permittivity``, relative permittivity of the medium in
    the gap, dimensionless; ``obliquity``, end of the integral: where the normal of the raceway meets the
    roller at this angle from the normal of the roller [rad]. Gap, permittivity and the numbers of ``race``
    broadcast. Returns capacitance per length [F/m], shape (...).

    Examples
    --------
    Ratio to eps0 pi sqrt(2 R/h0), the capacitance of a parabolic gap h0 + x^2/(2 R) without an end:

    >>> race = RollerRaceway(5.5e-3, 27.25e-3, outer=False)
    >>> reduced = 1.0 / (1.0 / 5.5e-3 + 1.0 / 27.25e-3)
    >>> parabolas = EPSILON_0 * np.pi * np.sqrt(2.0 * reduced / 1e-6)
    >>> round(float(roller_capacitance(race, 1e-6) / parabolas), 3)
    0.987
    """

    def whole(race: RollerRaceway, gap: Numbers) -> Array:
        pitch = race.pitch_radius(gap)
        # Azimuth at which the gap is twice the smallest one.
        scale = np.sqrt(2.0 * race.roller_radius * gap / (race.race_radius * pitch))
        phi, weights = stretched(0.0, _reach(race, gap, obliquity), scale, _NODES)
        distance, tilt = _distances(race.for_nodes(1), for_nodes(gap), phi)
        return _charge(race, distance, tilt, weights)

    shape = np.broadcast_shapes(np.shape(gap), np.shape(race.roller_radius), np.shape(race.race_radius))
    return 2.0 * EPSILON_0 * relative_permittivity * _in_chunks(whole, shape, _NODES, race, gap)


def roller_tails(
    race: RollerRaceway,
    half_width: Numbers,
    domain: tuple[Numbers, Numbers],
    thickness: tuple[Numbers, Numbers],
    relative_permittivity: Numbers = 1.0,
    *,
    obliquity: float = _HALF,
) -> tuple[Numbers, Numbers]:
    """Capacitance per length outside the domain of a solved line contact, at its inlet and at its outlet.

    The gap is the gap of touching circles, widened by the deflection under the Hertz pressure. At each end a
    constant is added, with which the gap continues the film.

    ``half_width``, half-width b of the dry contact [m]; ``domain``, inlet and outlet of the film's domain,
    along the arc of the raceway from the contact [m]; ``thickness``, film thickness at inlet and outlet [m];
    ``relative_permittivity``, relative permittivity of the medium in the gap, dimensionless; ``obliquity``,
    end of the integral, as in ``roller_capacitance`` [rad]. All of them and the numbers of ``race``
    broadcast. Returns capacitance per length [F/m], shape (...), each about 2 eps0 eps R/abs(x) with the
    reduced radius R; it is zero where the domain reaches beyond the end of the integral.

    Examples
    --------
    Ratio to 2 eps0 R/abs(x) for a domain of four half-widths on either side:

    >>> race = RollerRaceway(5.5e-3, 27.25e-3, outer=False)
    >>> reduced = 1.0 / (1.0 / 5.5e-3 + 1.0 / 27.25e-3)
    >>> film = 5e-7 + 4e-4**2 / (2.0 * reduced)
    >>> inlet, outlet = roller_tails(race, 1e-4, (-4e-4, 4e-4), (film, film))
    >>> inlet == outlet, round(inlet / (2.0 * EPSILON_0 * reduced / 4e-4), 2)
    (True, 0.91)
    """
    scale = EPSILON_0 * relative_permittivity
    inlet, outlet = (
        scale * roller_tail(race, half_width, start, film, obliquity=obliquity)
        for start, film in zip((-np.asarray(domain[0]), domain[1]), thickness, strict=True)
    )
    return inlet, outlet


def roller_tail(
    race: RollerRaceway, half_width: Numbers, start: Numbers, film: Numbers, *, obliquity: float = _HALF
) -> Numbers:
    """Capacitance per length over eps0 on one side of a solved line contact, as in ``roller_tails``.

    ``start``, end of the film's domain, a distance along the raceway from the contact [m]; ``film``, film
    thickness there [m]; with ``half_width`` and ``race`` they broadcast to the shape (...). Returns the
    capacitance per length over eps0, dimensionless, shape (...).
    """

    def tail(race: RollerRaceway, half_width: Numbers, start: Numbers, film: Numbers) -> Array:
        first, last, nodes = start / race.race_radius, _reach(race, 0.0, obliquity), race.for_nodes(1)
        # The integral from the end on is zero where the domain reaches beyond it.
        phi, weights = stretched(np.minimum(first, last), last, first, _TAIL_NODES)
        at = np.concatenate([phi, np.broadcast_to(for_nodes(first), (*phi.shape[:-1], 1))], axis=-1)
        distance, tilt = _distances(nodes, 0.0, np.minimum(at, for_nodes(last)))
        gap = distance + _opening(nodes, for_nodes(half_width), at * nodes.race_radius)
        # Where nothing is left, the gap that would continue the film may be negative.
        change = np.where(for_nodes(first) < for_nodes(last), for_nodes(film) - gap[..., -1:], 0.0)
        charge = _charge(race, gap[..., :-1] + change, tilt[..., :-1], weights)
        return np.where(first < last, charge, 0.0)

    numbers = half_width, start, film
    shape = np.broadcast_shapes(*map(np.shape, (race.roller_radius, race.race_radius, *numbers)))
    return _in_chunks(tail, shape, _TAIL_NODES, race, *numbers)


def _opening(race: RollerRaceway, half_width: Numbers, x: Array) -> Array:
    """Gap of the dry contact less the gap of undeflected parabolas, up to a constant [m]."""
    return line_opening(x, half_width, reduced_radius(race.roller_radius, -1.0 / race.curvature))


def _charge(race: RollerRaceway, gap: Array, tilt: Array, weights: Array) -> Array:
    """Integral of the charge density over the arc of the raceway, dimensionless, shape (...)."""
    nodes = race.for_nodes(1)
    density = charge_density(gap, tilt, 1.0 / nodes.roller_radius, nodes.curvature)
    charge: Array = race.race_radius * np.add.reduce(weights * density, axis=-1)
    return charge


def _distances(race: RollerRaceway, gap: Numbers, phi: Array) -> tuple[Array, Array]:
    """Gap along the radius of the roller [m], and angle from it to the normal of the raceway [rad]."""
    pitch, near, q = race.pitch_radius(gap), race.roller_radius + gap, np.sin(0.5 * phi) ** 2
    further = 4.0 * race.race_radius * pitch * q
    beyond = further / (np.sqrt(near**2 + further) + near)
    along = near + (2.0 * pitch * q if race.outer else -2.0 * pitch * q)
    return gap + beyond, np.arctan2(pitch * np.sin(phi), along)


def _reach(race: RollerRaceway, gap: Numbers, obliquity: float) -> Numbers:
    """Azimuth at which the raceway's normal meets the roller at an angle to the roller's normal [rad]."""
    azimuth: Numbers = np.arcsin(race.roller_radius * np.sin(obliquity) / race.pitch_radius(gap))
    return azimuth
