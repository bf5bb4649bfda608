"""Figures of a rough surface without a contact: a profile or a map, as read and after its last step."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from ehlectric.figures.style import (
    axes_or_new,
    figure_of,
    fitted_label,
    new_panels,
    save_figure,
    style,
)
from ehlectric.quantities.palette import BLUE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import Profile, rms, statistics

# Part of the heights of a map [%] that lies beyond either end of its colours. Without it, a grain of dust
# would stretch the colours so far that the rest of the surface has only one.
_BEYOND = 0.1


def profile(drawn: Profile, ax: Axes | None = None, name: str = "") -> Axes:
    """Draw the heights of a profile about their mean, with its name, Rq, Ra, Rsk and Rku in the title."""
    ax = axes_or_new(ax)
    heights = drawn.heights - np.mean(drawn.heights)
    factor, unit = unit_for(float(np.max(np.abs(heights))), "m", least=1.0)
    along, length = unit_for(drawn.length, "m")
    ax.plot(along * drawn.x, factor * heights, color=BLUE, lw=0.7)
    s = statistics(drawn)
    scale, prefixed = unit_for(s.rq, "m", least=1.0)
    sizes = [f"Rq {readable(scale * s.rq)} {prefixed}", f"Ra {readable(scale * s.ra)} {prefixed}"]
    shape = [f"Rsk {s.rsk:.2f}".replace("-", "−"), f"Rku {s.rku:.1f}"]
    values = ", ".join(value.replace(" ", "\u00a0") for value in (*sizes, *shape))
    ax.set_title(fitted_label(ax, f"{name}: {values}" if name else values, along=True), loc="left")
    ax.set(xlabel=f"$x$ [{length}]", ylabel=f"height [{unit}]")
    ax.set_xlim(along * drawn.x[0], along * drawn.x[-1])
    return ax


def height_map(drawn: Map, ax: Axes | None = None) -> Axes:
    """Draw the heights of a map about their mean as colours, with Sq next to the colour bar. Returns axes
    with the map, x and y to the same scale, and a colour bar; the lowest and the highest 0.1 % of the heights
    lie beyond the ends of the colours.
    """
    ax = axes_or_new(ax)
    heights = drawn.heights - np.mean(drawn.heights)
    low, high = np.percentile(heights, [_BEYOND, 100.0 - _BEYOND])
    size, unit = unit_for(max(drawn.length_x, drawn.length_y), "m", least=1.0)
    factor, height_unit = unit_for(max(-low, high, 1e-12), "m", least=1.0)
    half_x = 0.5 * size * (drawn.length_x + drawn.spacing_x)
    half_y = 0.5 * size * (drawn.length_y + drawn.spacing_y)
    image = ax.imshow(
        factor * heights.T,
        origin="lower",
        extent=(-half_x, half_x, -half_y, half_y),
        vmin=factor * low,
        vmax=factor * high,
        cmap="viridis",
        aspect="equal",
        interpolation="antialiased",
    )
    bar = figure_of(ax).colorbar(image, ax=ax, extend="both", pad=0.03)
    label = f"height [{height_unit}], Sq = {readable(factor * rms(heights))} {height_unit}"
    bar.set_label(fitted_label(ax, label, along=False))
    ax.set_xlabel(f"$x$ [{unit}]")
    ax.set_ylabel(f"$y$ [{unit}]")
    return ax


def save_surface(
    steps: Sequence[tuple[str, Profile | Map]], path: Path, formats: Sequence[str] = ("png",)
) -> list[Path]:
    """Write files of a profile or map, as read and after its last step, one file of each format."""
    with style():
        first_and_last = [steps[0], steps[-1]] if len(steps) > 1 else [steps[0]]
        of_map = isinstance(steps[0][1], Map)
        # Maps stand side by side, profiles one above the other.
        rows, columns = (1, len(first_and_last)) if of_map else (len(first_and_last), 1)
        panels = new_panels(rows, columns, (3.6 * columns, 3.4) if of_map else (6.3, 4.2))
        if of_map:
            # Axes of equal scale shrink; this layout makes the colour bars as high as the shrunk axes.
            figure_of(panels[0]).set_layout_engine("compressed")
        for ax, (name, step) in zip(panels, first_and_last, strict=True):
            title = name if step is steps[0][1] else "after the last step"
            if isinstance(step, Map):
                height_map(step, ax).set_title(title, loc="left")
            else:
                profile(step, ax, title)
        return save_figure(figure_of(panels[0]), path, formats)
