"""Curves of a contact along a line as data: pressure and film, field, temperature and shear stress."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask
from ehlectric.cases.case import Case
from ehlectric.contact import PointConditions, PointResult, Result
from ehlectric.field import PointField
from ehlectric.figures.contact_findings import AnyContact, strength_limit
from ehlectric.figures.data import WIDTH, Curve, Panel
from ehlectric.formulas.hertz import line_pressure, point_pressure
from ehlectric.quantities.formats import CELSIUS
from ehlectric.quantities.palette import BLACK, BLUE, GREEN, LIGHT_GREY, MIDDLE_GREY, ORANGE, STRENGTH
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# Name of the pressure between asperities, and of the nodes at which surfaces touch, in legends.
ASPERITIES, SPOTS = "pressure of asperities", "contact spots"

# Range of x/b that figures of the film show, before and behind the middle of the dry contact.
BEFORE, BEHIND = -2.0, 1.5

# Ratio a/b of the semi-axes, a across and b along entrainment, above which a contact is drawn turned: its
# long axis lies along the page, and entrainment points down.
_TURNED = 1.2

# Look of smooth surfaces, wide and behind the rough curves, so that neither hides the other.
_SMOOTH = (LIGHT_GREY, "solid", 2.6)

# Part of the Hertz zone [%] whose field lies within the scale of a film with spots.
_WITHIN = 90.0

# Smallest range of an axis of temperatures [K].
_LEAST_RANGE = 0.1


def shown_range(x: Array) -> tuple[float, float]:
    """Range of positions x/b that figures of the film show, within the domain with the nodes ``x``."""
    return max(float(x[0]), BEFORE), min(float(x[-1]), BEHIND)


def is_turned(conditions: PointConditions) -> bool:
    """Whether a contact is drawn turned, with entrainment pointing down and y to the right."""
    return bool(conditions.ratio > _TURNED)


def touches(result: Result | PointResult) -> bool:
    """Whether the surfaces of a result touch."""
    return bool(np.any(result.film.contact))


def film_scale(result: Result | PointResult) -> float:
    """Film thickness [m] that determines the unit and the reach of figures.

    It is the central film, or the mean film where the surfaces touch: a spot may lie in the middle.
    """
    film = result.film
    return max(film.central_thickness, film.mean_thickness) if touches(result) else film.central_thickness


def field_scale(result: Result | PointResult) -> float:
    """Field strength [V/m] that determines the unit and the reach of figures.

    It is the largest field. If the surfaces touch, that is the voltage divided by the boundary film, compared
    with which the field of the film could not be seen; most of the Hertz zone has less than the field given
    here.
    """
    field = result.field
    if not touches(result):
        return field.max_strength
    most = np.max(field.strength, axis=-1)
    inside = _hertz_columns(result)
    scale = float(np.percentile(most[inside], _WITHIN)) if inside.any() else 0.0
    return min(field.max_strength, 1.5 * scale) or field.max_strength


def _hertz_columns(result: Result | PointResult) -> Mask:
    """Columns of the field in the dry contact that do not lie on spots."""
    field, film = result.field, result.film
    if isinstance(result, PointResult):
        inside: Mask = np.asarray(result.zones["hertz"](field.x[:, np.newaxis], field.y))
    else:
        inside = np.abs(field.x) <= result.conditions.half_width
    gap = heights(result)
    return inside & (gap > 1.5 * film.minimum_thickness)


def heights(result: Result | PointResult) -> Array:
    """Thickness [m] of the film at the columns of the field."""
    walls = result.field.z if isinstance(result, PointResult) else result.field.y
    return np.asarray(walls[..., -1] - walls[..., 0])


@dataclass(frozen=True)
class Cut:
    """Straight cut through a map along "x" or "y", on the line of nodes at a position [m] of the other."""

    along: str
    index: int
    position: float

    @classmethod
    def near(cls, along: str, at: tuple[float, float], x: Array, y: Array) -> Cut:
        """Cut along an axis of the nodes x, y [m] that passes nearest to the point ``at``, (x, y) [m]."""
        axis, position = (y, at[1]) if along == "x" else (x, at[0])
        index = int(np.argmin(np.abs(axis - position)))
        return cls(along, index, float(axis[index]))

    def of(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values on the cut, (nx, ...) or (ny, ...), of an array of shape (nx, ny, ...)."""
        return values[:, self.index] if self.along == "x" else values[self.index]

    def away(self, field: PointField) -> Mask:
        """Mask of the columns of the cut far enough from the side faces of the field domain.

        If the cut itself lies near a side face, so that at most two columns are left, the mask is True for
        all of them.
        """
        inner: Mask = self.of(field.inner)
        return inner if np.count_nonzero(inner) > 2 else np.ones_like(inner)

    def name(self, result: PointResult) -> str:
        """Position of the cut as text for a label, such as "$y/b$ = 0.5"."""
        axis = "y" if self.along == "x" else "x"
        # At the centre this gives 0, not 1e-17 or -0.
        at = round(self.position / result.conditions.semi_axis_x, 6) + 0.0
        return f"${axis}/b$ = {readable(at)}".replace("-", "−")


@dataclass(frozen=True)
class Line:
    """Line along which the panels show a contact: a line contact itself, or a cut through a point contact.

    ``to_x`` is the factor from a position [m] to the unit of the figure.
    """

    result: AnyContact
    to_x: float
    film_cut: Cut | None = None
    field_cut: Cut | None = None

    @classmethod
    def through(cls, result: AnyContact, to_x: float, along: str = "x", at: float = 0.0) -> Line:
        """Line of a contact; of a point contact through the nodes nearest to ``at`` [m] on the other axis."""
        if isinstance(result, Result):
            return cls(result, to_x)
        film, field = (Cut.near(along, (at, at), part.x, part.y) for part in (result.film, result.field))
        return cls(result, to_x, film, field)

    def of(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values on the line, of an array at all nodes of the film."""
        return values if self.film_cut is None else self.film_cut.of(values)

    def of_field(self, values: NDArray[Any]) -> NDArray[Any]:
        """Values on the line, of an array at all columns of the field."""
        return values if self.field_cut is None else self.field_cut.of(values)

    @property
    def x(self) -> Array:
        """Positions of the nodes of the film."""
        return self.to_x * self._axis(self.result.film)

    @property
    def field_x(self) -> Array:
        """Positions of the columns of the field."""
        return self.to_x * self._axis(self.result.field)

    @property
    def hertz(self) -> Array:
        """Hertz pressure at the nodes of the film [Pa]."""
        conditions, cut = self.result.conditions, self.film_cut
        b, *across = conditions.semi_axes
        x = self._axis(self.result.film) / b
        if cut is None:
            return np.asarray(conditions.max_pressure * line_pressure(x))
        y = np.full_like(x, cut.position / b)
        pair = (x, y) if cut.along == "x" else (y, x)
        return np.asarray(conditions.max_pressure * point_pressure(*pair, across[0] / b))

    def curve(
        self, name: str, values: Array, colour: str, dash: str = "solid", width: float = WIDTH
    ) -> Curve:
        """Curve of an array at all nodes of the film."""
        return Curve(name, self.x, self.of(values), colour, dash, width)

    def _axis(self, part: Any) -> Array:
        axis: Array = part.y if self.film_cut is not None and self.film_cut.along == "y" else part.x
        return axis


def pressure(line: Line) -> Panel:
    """Pressure with the Hertz pressure and, where surfaces touch, the pressure of asperities."""
    film, smooth = line.result.film, line.result.smooth
    largest = max(film.max_pressure, line.result.conditions.max_pressure)
    factor, unit = unit_for(largest, "Pa")
    curves = [Curve("Hertzian pressure", line.x, factor * line.hertz, MIDDLE_GREY, "dot", 1.0)]
    if smooth is not None:
        curves.insert(0, line.curve("pressure, smooth surfaces", factor * smooth.pressure, *_SMOOTH))
    curves.append(line.curve("pressure", factor * film.pressure, BLUE))
    if film.contact_pressure is not None and touches(line.result):
        curves.append(line.curve(ASPERITIES, factor * film.contact_pressure, ORANGE, "solid", 0.7))
    return Panel("pressure", unit, curves, 1.05 * factor * largest)


def film_thickness(line: Line) -> Panel:
    """Film thickness with the minimum film of a line contact, or the nodes at which surfaces touch."""
    result, film, smooth = line.result, line.result.film, line.result.smooth
    factor, unit = unit_for(film_scale(result), "m")
    thickness = factor * film.thickness
    curves = [line.curve("film thickness", thickness, ORANGE)]
    if smooth is not None:
        curves.insert(0, line.curve("film, smooth surfaces", factor * smooth.thickness, *_SMOOTH))
    if film.film_fraction is not None:
        curves.append(line.curve("layer of oil", film.film_fraction * thickness, ORANGE, "dot", 1.0))
    if touches(result):
        on = line.of(film.contact)
        curves.append(Curve(SPOTS, line.x[on], line.of(thickness)[on], BLACK, marker="dots"))
    elif isinstance(result, Result) and result.converged:
        at, least = line.to_x * result.film.minimum_position, factor * film.minimum_thickness
        name = f"minimum film, {readable(least, 4)} {unit}"
        curves.append(Curve(name, np.array([at]), np.array([least]), ORANGE, marker="ring"))
    return Panel("film thickness", unit, curves, 3.0 * factor * film_scale(result))


def field_strength(line: Line) -> Panel:
    """Field at both surfaces and at mid-film, or the maximum across the film of a point contact."""
    result, part = line.result, line.result.field
    factor, unit = unit_for(field_scale(result), "V/m")
    # The end faces of the field's domain disturb the field next to them.
    inner = line.of_field(part.inner)
    x = line.field_x[inner]

    def curve(name: str, values: Array, *look: Any) -> Curve:
        return Curve(name, x, factor * line.of_field(values)[inner], *look)

    if isinstance(result, PointResult):
        curves = [curve("maximum field across the film", np.max(part.strength, axis=-1), GREEN)]
    else:
        curves = [
            curve("field at surface 1", part.strength[:, 0], BLUE, "solid", 1.6),
            curve("field at surface 2", part.strength[:, -1], ORANGE, "solid", 0.9),
            curve("field at mid-film", part.middle_strength, GREEN, "solid", 0.6),
        ]
        if result.smooth is not None:
            smooth = result.smooth.middle_strength
            curves.append(curve("field at mid-film, smooth surfaces", smooth, BLACK, "dash", 1.1))
    top, limit = factor * field_scale(result), strength_limit(result)
    if limit is not None:
        strength = curve("dielectric strength", limit, STRENGTH, "dashdot", 1.0)
        curves.append(strength)
        top = min(2.0 * top, max(top, float(np.min(strength.y))))
    if isinstance(result, Result) and not touches(result):
        at, most = line.to_x * result.field.max_strength_position, factor * part.max_strength
        name = f"maximum field, {readable(most, 4)} {unit}"
        curves.append(Curve(name, np.array([at]), np.array([most]), BLUE, marker="ring"))
    return Panel("field strength", unit, curves, 1.08 * top)


def heat(line: Line) -> Iterator[Panel]:
    """Panel of the temperature in a thermal film, or of the stress in an isothermal one that is sheared."""
    heated = line.result.film.heated
    if heated is not None:
        yield shear_stress(line) if heated.mid_temperature is None else temperature(line)


def temperature(line: Line) -> Panel:
    """Temperature at mid-film and of both surfaces, with the temperature of the oil in the inlet."""
    heated, case = line.result.film.heated, line.result.case
    assert heated is not None and heated.mid_temperature is not None
    assert heated.surface_temperatures is not None
    first, second = CELSIUS.of(heated.surface_temperatures)
    curves = [
        line.curve("mid-film", CELSIUS.of(heated.mid_temperature), GREEN),
        line.curve("surface 1", first, BLUE, "dash"),
        line.curve("surface 2", second, ORANGE, "longdash"),
    ]
    if isinstance(case, Case) and case.contact.temperature is not None:
        inlet = np.full(line.x.size, CELSIUS.of(case.contact.temperature))
        curves.append(Curve("oil in the inlet", line.x, inlet, MIDDLE_GREY, "dot", 1.0))
    return Panel("temperature", "°C", curves, *_ends(curves, _LEAST_RANGE))


def shear_stress(line: Line) -> Panel:
    """Shear stress at mid-film, with the pressure times the traction coefficient, which has the same mean."""
    heated, film = line.result.film.heated, line.result.film
    assert heated is not None
    factor, unit = unit_for(float(np.max(np.abs(line.of(heated.shear_stress)))) or 1.0, "Pa")
    curves = [line.curve("shear stress at mid-film", factor * heated.shear_stress, BLUE)]
    if (coefficient := heated.traction_coefficient) is not None:
        name = f"pressure × {readable(coefficient)}, the traction coefficient".replace("-", "−")
        curves.insert(0, line.curve(name, factor * coefficient * film.pressure, MIDDLE_GREY, "dot", 1.0))
    return Panel("shear stress", unit, curves, *_ends(curves, 0.0))


def _ends(curves: list[Curve], least: float) -> tuple[float, float]:
    """Upper and lower end of an axis with some room around curves."""
    low, high = (float(end([end(curve.y) for curve in curves])) for end in (np.min, np.max))
    room = 0.05 * max(high - low, least) or 1.0
    return high + room, low - room
