"""Frames of an animation of a transient point contact: maps of film and field."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.contact.conditions import PointConditions
from ehlectric.figures.contact.maps import (
    Range,
    draw_map,
    entrainment,
    hertz_ellipse,
    map_panels,
    mark,
    round_levels,
    turned,
)
from ehlectric.figures.motion.line_frames import Frames, time_text
from ehlectric.figures.motion.panels import Unit, field_unit, film_unit, name_run
from ehlectric.figures.style import figure_of
from ehlectric.motion.stored_run import MotionRun

_FILM_COLOURS, _FIELD_COLOURS = "viridis", "inferno"

# Part of the values in the Hertz ellipse that may lie beyond the open end of the colour bar [per cent].
_BEYOND = 5.0


@dataclass(frozen=True)
class _Contact:
    """Run of a point contact, with the indices of the nodes at which the field was solved."""

    run: MotionRun
    conditions: PointConditions
    nodes: tuple[IntArray, IntArray]

    @property
    def axes(self) -> tuple[Array, Array]:
        return tuple(self.run.values(name)[at] for name, at in zip("xy", self.nodes, strict=True))  # type: ignore[return-value]

    @property
    def window(self) -> tuple[Range, Range]:
        """Ranges of x/b and y/b of the nodes at which the field was solved."""
        x, y = (axis / self.conditions.half_width for axis in self.axes)
        return (float(x[0]), float(x[-1])), (float(y[0]), float(y[-1]))

    @property
    def inside(self) -> Mask:
        """Mask of the nodes in the Hertz ellipse, shape (nx, ny)."""
        x, y = self.axes
        of = self.conditions
        inside: Mask = (x[:, np.newaxis] / of.semi_axis_x) ** 2 + (y / of.semi_axis_y) ** 2 <= 1.0
        return inside

    def values(self, name: str, frame: int) -> Array:
        """Values of a variable at a recorded instant, shape (nx, ny)."""
        values = self.run.dataset[name].isel(frame=frame).values[np.ix_(*self.nodes)]
        return np.asarray(values, dtype=float)


def map_frames(run: MotionRun) -> Frames:
    """Draw maps of film thickness and field strength, at the nodes at which the field was solved.

    Parameters
    ----------
    run : MotionRun
        Run of a point contact.

    Returns
    -------
    Frames
        Frames that show the first recorded instant.
    """
    known = np.isfinite(run.dataset["strength"].isel(frame=0).values)
    nodes = np.flatnonzero(known.any(axis=1)), np.flatnonzero(known.any(axis=0))
    contact = _Contact(run, cast("PointConditions", run.conditions), nodes)
    # ``map_panels`` leaves room for the rows of a legend below the panels, which the colour bars use.
    film, field = map_panels(contact, 2, contact.window, rows=4)
    parts = [_film(contact, film), _field(contact, field)]
    field.label_outer()
    name_run(film, run)

    def show(frame: int) -> None:
        for part in parts:
            part(frame)
        film.set_title(time_text(run, frame), loc="left")

    show(0)
    return Frames(figure_of(film), show, (_FILM_COLOURS, _FIELD_COLOURS))


def _film(contact: _Contact, ax: Axes) -> Callable[[int], None]:
    """Draw the map of the film thickness."""
    unit = film_unit(contact.run)
    ends = [
        np.percentile(contact.values("thickness", frame)[contact.inside], [0.0, 100.0 - _BEYOND])
        for frame in range(contact.run.frames)
    ]
    limits = float(np.min(ends)), float(np.max(ends))
    show = _map(contact, ax, "thickness", unit, limits=limits, colours=_FILM_COLOURS)
    figure_of(ax).axes[-1].set_xlabel(f"film thickness $h$ [{unit[1]}]")
    hertz_ellipse(contact, ax)
    entrainment(contact, ax)
    return show


def _field(contact: _Contact, ax: Axes) -> Callable[[int], None]:
    """Draw the map of the largest field strength across the film, and mark its maximum."""
    run, unit = contact.run, field_unit(contact.run)
    largest = run.values("max_strength")
    least = [
        np.percentile(contact.values("strength", frame)[contact.inside], _BEYOND)
        for frame in range(run.frames)
    ]
    limits = float(np.nanmin(least)), float(np.max(largest))
    show_map = _map(contact, ax, "strength", unit, limits=limits, colours=_FIELD_COLOURS)
    figure_of(ax).axes[-1].set_xlabel(f"field strength $|E|$ [{unit[1]}]")
    hertz_ellipse(contact, ax, "white")
    at = np.column_stack([run.values("max_strength_x"), run.values("max_strength_y")])
    cross = mark(contact, ax, at[:1], "largest")

    def show(frame: int) -> None:
        show_map(frame)
        place = at[frame] / contact.conditions.half_width
        x, y = place[::-1] if turned(contact) else place
        cross.set_data([x], [y])
        ax.set_title(f"maximum (×) {unit[0] * largest[frame]:#.3g} {unit[1]}", loc="right")

    return show


def _map(
    contact: _Contact, ax: Axes, name: str, unit: Unit, *, limits: Range, colours: str
) -> Callable[[int], None]:
    """Draw a map of a variable; its colour bar has an open end if values may lie beyond it."""
    factor = unit[0]
    ends = factor * limits[0], factor * limits[1]
    look: dict[str, Any] = {"colours": colours, "limits": ends, "window": contact.window, "number": 2}
    mesh = draw_map(contact, ax, contact.axes, factor * contact.values(name, 0), **look)
    ticks = round_levels(*ends, 5)
    ticks = ticks[(ticks >= ends[0]) & (ticks <= ends[1])]
    extend = "max" if name == "thickness" else "min"
    figure_of(ax).colorbar(mesh, ax=ax, ticks=ticks, extend=extend, location="bottom", pad=0.03)
    return lambda frame: mesh.set_array(factor * contact.values(name, frame))
