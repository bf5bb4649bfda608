"""Animation of a transient contact over its recorded instants, and its frames for line and point contacts."""

from __future__ import annotations

import math
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, cast

import numpy as np
from matplotlib import colormaps
from matplotlib.animation import FFMpegWriter
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from PIL import Image

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.contact import PointConditions
from ehlectric.errors import InputError, shown
from ehlectric.figures.contact_maps import (
    Range,
    draw_map,
    entrainment,
    hertz_ellipse,
    map_panels,
    mark,
    round_levels,
)
from ehlectric.figures.contact_profiles import is_turned, shown_range
from ehlectric.figures.motion_figures import roughness_at
from ehlectric.figures.motion_panels import (
    Unit,
    field_unit,
    film_unit,
    fitted,
    height_unit,
    in_contact,
    name_run,
    time_unit,
)
from ehlectric.figures.style import figure_of, new_panels, share_below, style, text_colour
from ehlectric.motion.stored_run import MotionRun
from ehlectric.quantities.palette import BLUE, BODY, OIL, ON_MAP, ORANGE
from ehlectric.quantities.units import unit_for
from ehlectric.runtime.files import refuse_full, whole
from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
from ehlectric.runtime.progress import Progress, silent

if TYPE_CHECKING:
    import xarray as xr


# Size of a frame [inches].
_SIZE = (5.2, 6.6)


@dataclass(frozen=True)
class Frames:
    """Figure of a transient run that can show any of its recorded instants."""

    figure: Figure  # figure, which first shows the first recorded instant
    # Function of the number of a recorded instant, which makes the figure show this instant.
    show: Callable[[int], None]
    colours: tuple[str, ...] = ()  # names of the colour maps in the figure


def time_text(run: MotionRun, frame: int) -> str:
    """Text: time of a recorded instant, with enough digits to distinguish it from the next one."""
    factor, unit = time_unit(run)
    times = factor * run.frame_time
    apart = float(np.min(np.diff(times))) if run.frames > 1 else float(times[0])
    places = max(0, math.ceil(-math.log10(apart))) if apart > 0.0 else 0
    return f"$t$ = {times[frame]:.{places}f} {unit}"


def line_frames(run: MotionRun) -> Frames:
    """Draw film, pressure, field and roughness over x; dotted lines show the values before the motion.
    Returns frames that show the first recorded instant.
    """
    axes = new_panels(4, 1, _SIZE)
    parts = [_film(run, axes[0]), _pressure(run, axes[1]), _field(run, axes[2]), _roughness(run, axes[3])]
    for ax in axes:
        ax.set_xlim(*shown_range(run.x))
    share_below(axes)
    name_run(axes[0], run)
    handles = [
        Patch(facecolor=OIL, label="oil"),
        Patch(facecolor=BODY, label="steel"),
        Line2D([], [], color="black", lw=0.9, ls=":", label="before the motion"),
        Line2D([], [], color=ORANGE, ls="none", marker="o", ms=4.0, label="maximum"),
    ]
    figure_of(axes[0]).legend(handles=handles, loc="outside lower left", ncols=4, frameon=False)

    def show(frame: int) -> None:
        for part in parts:
            part(frame)
        axes[0].set_title(time_text(run, frame), loc="right")

    show(0)
    return Frames(figure_of(axes[0]), show)


def _film(run: MotionRun, ax: Axes) -> Callable[[int], None]:
    """Draw the gap filled with oil; a dotted line shows the film before the motion."""
    factor, unit = film_unit(run)
    thickness = factor * run.along("thickness")
    low, high = fitted(in_contact(run, thickness))
    ax.set(ylabel=f"film $h$ [{unit}]", ylim=(low, high), facecolor=BODY)
    ax.plot(run.x, thickness[0], color="black", lw=0.9, ls=":")
    (line,) = ax.plot(run.x, thickness[0], color="black")
    filled = [ax.fill_between(run.x, low, thickness[0], color=OIL, lw=0.0, zorder=0.5)]

    def show(frame: int) -> None:
        line.set_ydata(thickness[frame])
        filled.pop().remove()
        filled.append(ax.fill_between(run.x, low, thickness[frame], color=OIL, lw=0.0, zorder=0.5))

    return show


def _pressure(run: MotionRun, ax: Axes) -> Callable[[int], None]:
    pressure = run.along("pressure")
    factor, unit = unit_for(float(np.max(pressure)), "Pa")
    ax.set(ylabel=f"pressure $p$ [{unit}]", ylim=(0.0, 1.06 * factor * float(np.max(pressure))))
    return _curve(run, ax, factor * pressure)


def _field(run: MotionRun, ax: Axes) -> Callable[[int], None]:
    """Draw the field strength and mark its maximum."""
    factor, unit = field_unit(run)
    strength, largest = factor * run.along("strength"), factor * run.values("max_strength")
    ax.set(ylabel=f"field $|E|$ [{unit}]", ylim=fitted(in_contact(run, strength), largest))
    curve = _curve(run, ax, strength)
    at = run.values("max_strength_x") / run.conditions.half_width
    (dot,) = ax.plot(at[:1], largest[:1], ls="none", marker="o", ms=4.0, color=ORANGE, clip_on=False)

    def show(frame: int) -> None:
        curve(frame)
        dot.set_data([at[frame]], [largest[frame]])
        ax.set_title(f"maximum {largest[frame]:#.3g} {unit}", loc="right", color=text_colour(ORANGE))

    return show


def _curve(run: MotionRun, ax: Axes, values: Array) -> Callable[[int], None]:
    """Draw values, shape (frames, nx), at an instant; a dotted line shows them before the motion."""
    ax.plot(run.x, values[0], color="black", lw=0.9, ls=":")
    (line,) = ax.plot(run.x, values[0], color=BLUE)
    return lambda frame: line.set_ydata(values[frame])


def _roughness(run: MotionRun, ax: Axes) -> Callable[[int], None]:
    """Draw the heights of the rough surfaces."""
    heights = np.stack([run.along(f"roughness_{k}") for k in run.speeds])
    factor, _ = height_unit(heights)
    roughness_at(run, 0, ax, unit=height_unit(heights))
    ax.set_ylim(*fitted(factor * heights))
    lines = ax.get_lines()

    def show(frame: int) -> None:
        for line, values in zip(lines, heights, strict=True):
            line.set_ydata(factor * values[frame])

    return show


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
    """Draw maps of film thickness and field strength, at the nodes at which the field was solved. Returns
    frames that show the first recorded instant.
    """
    known = np.isfinite(run.dataset["strength"].isel(frame=0).values)
    nodes = np.flatnonzero(known.any(axis=1)), np.flatnonzero(known.any(axis=0))
    contact = _Contact(run, cast("PointConditions", run.conditions), nodes)
    # ``map_panels`` leaves room for the rows of a legend below the panels, which the colour bars use.
    film, field = map_panels(contact, 2, contact.window, rows=4)
    parts = [_point_film(contact, film), _point_field(contact, field)]
    field.label_outer()
    name_run(film, run)

    def show(frame: int) -> None:
        for part in parts:
            part(frame)
        film.set_title(time_text(run, frame), loc="left")

    show(0)
    return Frames(figure_of(film), show, (_FILM_COLOURS, _FIELD_COLOURS))


def _point_film(contact: _Contact, ax: Axes) -> Callable[[int], None]:
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


def _point_field(contact: _Contact, ax: Axes) -> Callable[[int], None]:
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
    hertz_ellipse(contact, ax, ON_MAP)
    at = np.column_stack([run.values("max_strength_x"), run.values("max_strength_y")])
    cross = mark(contact, ax, at[:1], "largest")

    def show(frame: int) -> None:
        show_map(frame)
        place = at[frame] / contact.conditions.half_width
        x, y = place[::-1] if is_turned(contact.conditions) else place
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


# Bounds of the number of frames per second. A GIF stores durations in hundredths of a second, and viewers
# slow down animations with more than 50 frames per second.
_SLOWEST, _FASTEST = 0.1, 50.0

# Number of colours of a GIF's palette that are reserved for lines and letters next to maps.
_GREYS = 24

# Functions that draw the frames of a run, by its kind of contact.
_FRAMES = {"line": line_frames, "point": map_frames}


def save_animation(
    dataset: xr.Dataset,
    path: str | Path,
    *,
    fps: float = 25.0,
    dpi: int = 130,
    progress: Progress = silent,
) -> None:
    """Draw the recorded instants of a transient run as an animation. ``fps``, frames per second, from 0.1 to
    50; each frame shows one recorded instant. Raises InputError if the suffix of the file differs, ffmpeg is
    missing or fails, the dataset is not a transient run, or ``fps`` is out of range.
    """
    path = Path(path)
    if not _SLOWEST <= fps <= _FASTEST:
        raise InputError("fps", got=f"{fps:g}", takes=f"{_SLOWEST:g} to {_FASTEST:g} instants a second")
    write = _writer(path)
    run = MotionRun.of(dataset)
    with style():
        drawn = _FRAMES[run.kind.name](run)
        drawn.figure.set_dpi(dpi)
        # Without a fixed layout, tick labels that appear and disappear would shift the panels.
        drawn.figure.draw_without_rendering()
        drawn.figure.set_layout_engine("none")
        with alone_in(path.parent, [path.name], locks=[FIGURE_LOCK]), whole(path) as draft:
            try:
                write(draft, _instants(drawn, run.frames, progress), fps)
            except (BrokenPipeError, subprocess.CalledProcessError):
                refuse_full(path)
                raise InputError.worded(
                    path, "cannot be written, ffmpeg failed; a .gif needs no ffmpeg"
                ) from None


def _instants(drawn: Frames, frames: int, progress: Progress) -> Iterator[Frames]:
    """Yield the drawn frames once for every recorded instant, showing this instant."""
    for frame in range(frames):
        drawn.show(frame)
        yield drawn
        progress(frame + 1, frames, "drawing")


def _writer(path: Path) -> Callable[[Path, Iterator[Frames], float], None]:
    suffix = path.suffix.lower()
    if suffix == ".gif":
        return _write_gif
    if suffix != ".mp4":
        raise InputError("animation", got=shown(path.name), takes="a name that ends in .gif or .mp4")
    if not FFMpegWriter.isAvailable():
        raise InputError(
            "animation", got=f"{shown(path.name)} and no ffmpeg is found", takes="a name in .gif"
        )
    return _write_mp4


@dataclass(frozen=True)
class _Plain:
    """File without a descriptor: Pillow would write to a descriptor itself, and hide why it cannot write."""

    write: Callable[[bytes], int]


def _write_gif(path: Path, instants: Iterator[Frames], fps: float) -> None:
    # Each image is reduced to 256 colours at once: matplotlib's own writer keeps all images in memory in full
    # colour.
    images = (_image(drawn) for drawn in instants)
    duration = round(1000.0 / fps)
    # A file that Pillow opens itself would stay open if drawing an image fails.
    with path.open("wb") as file:
        options: dict[str, Any] = {"save_all": True, "append_images": images, "duration": duration, "loop": 0}
        next(images).save(cast("BinaryIO", _Plain(file.write)), "GIF", **options)


def _image(drawn: Frames) -> Image.Image:
    canvas = drawn.figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    canvas.draw()  # type: ignore[no-untyped-call]
    pixels = np.asarray(canvas.buffer_rgba())  # type: ignore[no-untyped-call]
    image = Image.fromarray(pixels).convert("RGB")
    if not drawn.colours:
        return image.quantize(256)
    # A palette of its own would give each image few colours for the maps, and different ones at each instant.
    return image.quantize(palette=_palette(drawn.colours), dither=Image.Dither.NONE)


def _palette(colours: tuple[str, ...]) -> Image.Image:
    """Image with a palette of 256 colours: colours of the colour maps, and greys for lines and letters."""
    each = (256 - _GREYS) // len(colours)
    parts = [colormaps[name](np.linspace(0.0, 1.0, each)) for name in colours]
    parts.append(colormaps["gray"](np.linspace(0.0, 1.0, 256 - each * len(colours))))
    image = Image.new("P", (1, 1))
    image.putpalette(np.round(255.0 * np.concatenate(parts)[:, :3]).astype(np.uint8).tobytes())
    return image


def _write_mp4(path: Path, instants: Iterator[Frames], fps: float) -> None:
    writer = FFMpegWriter(fps=fps)  # type: ignore[arg-type]
    figure = next(instants).figure
    with writer.saving(figure, str(path), figure.dpi):
        writer.grab_frame()
        for _ in instants:
            writer.grab_frame()
