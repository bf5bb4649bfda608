"""Figures of a gear pair: along its path of contact, on its flank, and over a phase of its mesh."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.arrays import Array
from ehlectric.cases.defaults import HOW
from ehlectric.figures.data import Along, Panel, with_unit
from ehlectric.figures.draw import draw_panel
from ehlectric.figures.duty_panels import cycle_lines, gear_duty_panels, time_axis
from ehlectric.figures.figure_names import GEAR_DUTY_FIGURE, GEAR_FIGURE_FILES, in_formats
from ehlectric.figures.gear_panels import (
    ENDS_OF_FLANK,
    PHASE_AXIS,
    case_lines,
    continued_films,
    film_finding,
    film_panels,
    flank_finding,
    flank_lines,
    flank_map,
    last_colour,
    mesh_finding,
    mesh_panels,
    named_points,
    path_axis,
    path_finding,
    path_panels,
    summit_text,
)
from ehlectric.figures.style import (
    COLOURS,
    LENGTH_AXIS,
    colour_bar,
    drawing_of,
    legend_above,
    levels_of,
    new_panels,
    norm_of,
    outlined,
    share_below,
    style,
    titled,
)
from ehlectric.gear import GearResult, discharge_places, weakest
from ehlectric.quantities.palette import BLACK, MAP_EDGE, ON_MAP, ORANGE, OUT_OF_RANGE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable


def flank(result: GearResult, ax: Axes) -> None:
    """Draw the minimum film on the flank of gear 1, the height of the highest summits, and lines of contact
    at one phase.
    """
    solution = result.solution
    g, y, continued, inside = continued_films(result)
    films = np.where(inside < 0.0, np.nan, continued)
    known, most = films[~np.isnan(films)], last_colour(films)
    factor, unit = unit_for(most, "m", least=1.0)
    levels = levels_of(factor * np.minimum(known, most), log=False)
    norm = norm_of(levels, log=False)
    ends = (0.0, 1e3 * solution.pair.face_width, 1e3 * solution.path.start, 1e3 * solution.path.end)
    _image(ax, factor * continued, ends, COLOURS, norm)
    handles: list[Line2D | Patch] = []
    level = factor * solution.summits
    if np.min(factor * known) < level < np.max(factor * known):
        look: dict[str, Any] = {"linestyles": "--", "linewidths": 1.2, "colors": MAP_EDGE}
        lines = ax.contour(1e3 * y, 1e3 * g, factor * films, [level], **look)
        lines.set_path_effects(outlined(2.6, ON_MAP))
        handles.append(Line2D([], [], color=BLACK, ls="--", lw=1.2, label=f"film of {summit_text(result)}"))
    handles += _draw_discharges(result, ax, (1e3 * y, 1e3 * g, films))
    if np.any(inside < 0.0):
        # The edge of the load is a line between the places of the map, up to both ends of the face.
        across = 1e3 * np.array([0.0, *y[1:-1], solution.pair.face_width])
        ax.contourf(across, 1e3 * g, inside, [float(np.min(inside)), 0.0], colors=[OUT_OF_RANGE])
        handles.append(Patch(color=OUT_OF_RANGE, label="no load"))
    ax.set(xlim=ends[:2], ylim=ends[2:])
    ax.set_xlabel("place $y$ on the face width [mm]")
    ax.set_ylabel("place $g$ on the path of contact [mm]")
    handles = [*_draw_lines(result, ax), *handles]
    _name_points(result, ax)
    legend_above(ax, handles, columns=3)
    thicker = bool(factor * np.max(known) > levels[-1])
    colour_bar(ax, norm, with_unit("minimum film", unit), levels, extend="max" if thicker else "neither")


def _draw_discharges(result: GearResult, ax: Axes, map_: tuple[Array, Array, Array]) -> Iterator[Line2D]:
    """Draw the line around the places of 90 % of the breakdowns; yields its entry of the legend, none where
    ``without_discharges`` is a reason.
    """
    where = discharge_places(result.solution)
    if where is None or without_discharges(result) is not None:
        return
    lines = ax.contour(*map_, [where.film_around(_MOST)], linestyles="-", linewidths=1.6, colors=ORANGE)
    lines.set_path_effects(outlined(2.8, ON_MAP))
    yield Line2D([], [], color=ORANGE, lw=1.6, label=f"around {100.0 * _MOST:g} % of the breakdowns")


def without_discharges(result: GearResult) -> str | None:
    """Why the map of a flank has no line around the places of 90 % of the breakdowns; None if it has it."""
    where, films = discharge_places(result.solution), flank_map(result)[2]
    if where is None:
        return "no places of breakdowns: the highest summits touch"
    if result.solution.strength is None:
        return "no places of breakdowns: no dielectric strength is given"
    film, share = where.film_around(_MOST), f"{100.0 * _MOST:g} % of the breakdowns"
    if film <= np.nanmin(films):
        return f"{share} are at the minimum film"
    return f"{share} are on the whole flank with load" if film >= np.nanmax(films) else None


# Share of the breakdowns within the line on the map of a flank.
_MOST = 0.9


def _image(
    ax: Axes,
    values: Array,
    ends: tuple[float, float, float, float],
    colours: Colormap,
    norm: Normalize | None,
) -> None:
    ax.imshow(
        values, origin="lower", extent=ends, aspect="auto", cmap=colours, norm=norm, interpolation="nearest"
    )


def _draw_lines(result: GearResult, ax: Axes) -> Iterator[Line2D]:
    """Draw the lines of contact at the phase with the minimum film, where they carry load, and a cross at its
    place; yields entries of the legend.
    """
    place, across = weakest(result.solution)
    look: dict[str, Any] = {"color": ON_MAP, "lw": 1.4, "path_effects": outlined(2.6, MAP_EDGE)}
    for y, g in flank_lines(result):
        ax.plot(1e3 * y, 1e3 * g, **look)
    yield Line2D([], [], label="lines of contact at one phase", **look)
    cross: dict[str, Any] = {"ls": "none", "marker": "X", "ms": 8.0, "mfc": ORANGE, "mec": ON_MAP, "mew": 1.0}
    (mark,) = ax.plot(1e3 * across, 1e3 * place, label="minimum film", zorder=6.0, clip_on=False, **cross)
    yield mark


def _name_points(result: GearResult, ax: Axes) -> None:
    """Write the names of the points A to E at the left edge of the map of a flank, with lines at B to D."""
    path = result.solution.path
    for place in (path.points[name] for name in "BCD"):
        ax.axhline(1e3 * place, color=ON_MAP, lw=0.8, ls=":", path_effects=outlined(1.6, MAP_EDGE))
    low, high = 1e3 * path.start, 1e3 * path.end
    for place, name in named_points(result):
        inside = min(max(place, low + 0.035 * (high - low)), high - 0.035 * (high - low))
        text = f"{name}, {ENDS_OF_FLANK[name]}" if name in ENDS_OF_FLANK else name
        ax.text(
            0.012, inside, text, transform=ax.get_yaxis_transform(), va="center", color=ON_MAP, size="small",
            weight="bold", path_effects=outlined(2.0, MAP_EDGE),
        )  # fmt: skip


def _letters_above(result: GearResult, ax: Axes) -> None:
    """Write the names of the points A to E above the axes."""
    places, names = zip(*named_points(result), strict=True)
    top = ax.secondary_xaxis("top")
    top.set_xticks(list(places), labels=list(names))
    top.tick_params(length=0.0, pad=1.0)


def _stacked(
    result: GearResult,
    panels: Sequence[Panel],
    along: Along,
    height: float,
    columns: int = 2,
    *,
    on_path: bool = False,
) -> Axes:
    """Axes of panels below each other, the highest one with the legend; returns it."""
    axes = new_panels(len(panels), 1, (6.3, height))
    for panel, ax in zip(panels, axes, strict=True):
        draw_panel(panel, ax, along)
    if on_path:
        _letters_above(result, axes[0])
    handles: dict[str, object] = {}
    for ax in axes:
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True):
            if not label.startswith("_"):
                handles.setdefault(label, handle)
    if handles:
        # Lines are named before areas.
        entries = sorted(handles.values(), key=lambda handle: not isinstance(handle, Line2D))
        legend_above(axes[0], entries, columns, lift=LENGTH_AXIS if on_path else 0.0)
    share_below(axes)
    return axes[0]


def _draw_path(result: GearResult) -> Axes:
    return _stacked(result, path_panels(result), path_axis(result), 6.6, 3, on_path=True)


def _draw_film(result: GearResult) -> Axes:
    return _stacked(result, film_panels(result), path_axis(result), 5.0, on_path=True)


def _draw_mesh(result: GearResult) -> Axes:
    panels = mesh_panels(result)
    return _stacked(result, panels, PHASE_AXIS, 1.3 + 1.45 * len(panels))


def _draw_duty(result: GearResult) -> Axes:
    assert result.duty is not None
    panels = list(gear_duty_panels(result.duty, result.case.gear.summit_height))
    return _stacked(result, panels, time_axis(result.duty.rows), 1.3 + 1.45 * len(panels), 3)


def duty_finding(result: GearResult) -> str:
    """Return a sentence with the time shares of the states of the mesh in a duty cycle."""
    assert result.duty is not None
    summary = result.duty.summary()
    keys = {"insulates": "insulating", "conducts at times": "conducting_at_times", "conducts": "conducting"}
    shares = [f"{name} {readable(100.0 * summary[f'{key}_share'])} %" for name, key in keys.items()]
    return f"The mesh {', '.join(shares)} of the time"


def _lines_below(result: GearResult, name: str) -> Sequence[str]:
    """Lines below a figure: the case, or the file of the cycle with the number of its operating points."""
    if name != GEAR_DUTY_FIGURE:
        return [*case_lines(result), *(_NOTES[name](result) if name in _NOTES else ())]
    duty = result.duty
    assert duty is not None
    text = f"{duty.points} operating points, contacts {HOW[duty.contacts]}"
    return cycle_lines(result.case.title, duty.source, text)


def _notes_of_flank(result: GearResult) -> list[str]:
    return list(filter(None, [without_discharges(result)]))


def _notes_of_film(result: GearResult) -> list[str]:
    unloaded = bool(np.any(np.isnan(result.solution.films.minimum)))
    return ["films end at the last computed place with load"] if unloaded else []


# Lines below figures that explain what a figure lacks.
_NOTES: Mapping[str, Callable[[GearResult], list[str]]] = {
    GEAR_FIGURE_FILES[1]: _notes_of_film,
    GEAR_FIGURE_FILES[2]: _notes_of_flank,
}


def _draw_flank(result: GearResult) -> Axes:
    (ax,) = new_panels(1, 1, (6.3, 4.2))
    flank(result, ax)
    return ax


# Functions that draw each figure, and sentences with its finding, by the names of the files.
FIGURES: Mapping[str, tuple[Callable[[GearResult], Axes], Callable[[GearResult], str]]] = dict(
    zip(
        GEAR_FIGURE_FILES,
        (
            (_draw_path, path_finding),
            (_draw_film, film_finding),
            (_draw_flank, flank_finding),
            (_draw_mesh, mesh_finding),
            (_draw_duty, duty_finding),
        ),
        strict=True,
    )
)


def gear_figures_of(result: GearResult) -> tuple[str, ...]:
    """Names of the figure files: a pair without a duty cycle has no figure of a cycle."""
    return tuple(name for name in FIGURES if name != GEAR_DUTY_FIGURE or result.duty is not None)


def lacking(result: GearResult, file: str) -> str | None:  # noqa: ARG001
    """Why a gear pair lacks a figure that other gear pairs have; None if no gear pair has it."""
    if file == GEAR_DUTY_FIGURE:
        return "the figure of a duty cycle needs [duty], which the case does not have"
    return None


def figure(result: GearResult, name: str) -> Figure:
    """Figure of a gear pair. Raises InputError where there is no figure of this name."""
    draw, finding = drawing_of({file: FIGURES[file] for file in gear_figures_of(result)}, name)
    (file,) = in_formats([name])
    with style():
        ax = draw(result)
        return titled(ax, "\n".join([finding(result), *_lines_below(result, file)]), converged=True)
