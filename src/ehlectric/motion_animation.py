"""A film that roughness moves through, as an animation: film, pressure and field, an instant after the other."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.animation import AbstractMovieWriter, FFMpegWriter, PillowWriter

from ehlectric.drawing import style
from ehlectric.errors import InputError, shown
from ehlectric.motion_frames import Frames, line_frames
from ehlectric.motion_map_frames import map_frames
from ehlectric.motion_run import MotionRun
from ehlectric.store import refuse_special, whole

if TYPE_CHECKING:
    import xarray as xr

# Instants a second: a GIF holds hundredths of a second, and viewers slow down what is faster than this.
_SLOWEST, _FASTEST = 0.1, 50.0

# Called with the number of frames that are done and of all.
Progress = Callable[[int, int], None]


def save_animation(
    dataset: xr.Dataset,
    path: str | Path,
    *,
    fps: float = 25.0,
    dpi: int = 110,
    progress: Progress | None = None,
) -> None:
    """Draw the recorded instants of roughness that moves as an animation.

    Parameters
    ----------
    dataset : xarray.Dataset
        As a run was stored, whether it is complete or not.
    path : str or Path
        A .gif, or an .mp4, which takes ffmpeg.
    fps : float
        Instants a second, from 0.1 to 50.
    dpi : int
        Pixels of an inch: a line contact is 6.3 by 7.2 of them.
    progress : callable, optional
        Called with the number of frames that are drawn and of all.

    Raises
    ------
    InputError
        Where the file has another suffix, ffmpeg is needed and not there or fails, the dataset is no such
        run, or the instants a second are out of range.
    """
    path = Path(path)
    if not _SLOWEST <= fps <= _FASTEST:
        raise InputError(f"fps: got {fps:g}, takes {_SLOWEST:g} to {_FASTEST:g} instants a second")
    writer = _writer(path, fps)
    refuse_special(path)
    run = MotionRun.of(dataset)
    with style():
        drawn = map_frames(run) if run.point else line_frames(run)
        # Numbers on the axes that come and go must not shift the panels.
        drawn.figure.draw_without_rendering()
        drawn.figure.set_layout_engine("none")
        with whole(path) as beside:
            try:
                _write(writer, drawn, run.frames, beside, dpi, progress)
            except (BrokenPipeError, subprocess.CalledProcessError):
                raise InputError(f"{path}: cannot be written, ffmpeg failed; takes a .gif too") from None


def _write(
    writer: AbstractMovieWriter, drawn: Frames, frames: int, path: Path, dpi: int, progress: Progress | None
) -> None:
    with writer.saving(drawn.figure, str(path), dpi):
        for frame in range(frames):
            drawn.show(frame)
            writer.grab_frame()
            if progress is not None:
                progress(frame + 1, frames)


def _writer(path: Path, fps: float) -> AbstractMovieWriter:
    suffix = path.suffix.lower()
    if suffix == ".gif":
        return PillowWriter(fps=fps)  # type: ignore[arg-type]
    if suffix != ".mp4":
        raise InputError(f"animation: got {shown(path.name)}, takes a name that ends in .gif or .mp4")
    if not FFMpegWriter.isAvailable():
        raise InputError(
            f"animation: got {shown(path.name)}, which takes ffmpeg, and that is not there; .gif"
        )
    return FFMpegWriter(fps=fps)  # type: ignore[arg-type]
