"""Animation of a transient contact over its recorded instants."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, cast

import numpy as np
from matplotlib import colormaps
from matplotlib.animation import FFMpegWriter
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from ehlectric.errors import InputError, shown
from ehlectric.figures.motion.line_frames import Frames, line_frames
from ehlectric.figures.motion.point_frames import map_frames
from ehlectric.figures.style import style
from ehlectric.motion.stored_run import MotionRun
from ehlectric.runtime.files import refuse_full, whole
from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
from ehlectric.runtime.progress import Progress, silent

if TYPE_CHECKING:
    import xarray as xr


# Bounds of the number of frames per second. A GIF stores durations in hundredths of a second, and viewers
# slow down animations with more than 50 frames per second.
_SLOWEST, _FASTEST = 0.1, 50.0

# Number of colours of a GIF's palette that are reserved for lines and letters beside maps.
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
    """Draw the recorded instants of a transient run as an animation.

    Parameters
    ----------
    dataset : xarray.Dataset
        Dataset of a run, complete or not, from ``read_motion``.
    path : str or Path
        File to write, .gif or .mp4. An .mp4 needs ffmpeg.
    fps : float
        Frames per second, from 0.1 to 50; each frame shows one recorded instant.
    dpi : int
        Pixels per inch; the figure of a line contact is 5.2 by 6.6 inches.
    progress : callable, optional
        Called with the number of frames drawn, the number of all frames, and a text.

    Raises
    ------
    InputError
        If the file has another suffix, ffmpeg is missing or fails, the dataset is not a transient run, or
        ``fps`` is out of range.
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
        with alone_in(path.parent, [path.name], locks=[FIGURE_LOCK]), whole(path) as beside:
            try:
                write(beside, _instants(drawn, run.frames, progress), fps)
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
    """File without a number: Pillow writes to a number itself, and does not say why it cannot write."""

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
