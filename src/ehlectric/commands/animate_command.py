"""The command that draws an animation of a transient run, and what is told where a run is stopped."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.options import Quiet, files_ending, option
from ehlectric.commands.terminal import progress_bar, say, user_errors
from ehlectric.runtime.progress import Progress


@contextmanager
def tell_where_it_stops(folder: Path, show: Progress) -> Iterator[Progress]:
    """Context of a transient run; where it is stopped, one line tells how many steps are saved.

    Yields the progress for the run, which calls ``show``.
    """
    steps = 0

    def progress(done: int, of: int, text: str) -> None:
        nonlocal steps
        steps = of or steps
        show(done, of, text)

    try:
        yield progress
    except (KeyboardInterrupt, SystemExit):
        if steps:
            from ehlectric.motion.stored_run import MOTION, saved_steps

            # Read from the file: the progress may not have been called for the last instant yet.
            saved = saved_steps(folder / MOTION)
            rest = "resumes the run" if saved < steps else "sums them up"
            text = f"{saved} of {steps} steps are saved in {folder}; the same command {rest}"
            say(f"interrupted; {text}", err=True)
        raise


def animate(
    folder: Annotated[
        Path,
        typer.Argument(
            metavar="DIR",
            help="Folder of a run with moving roughness.",
            show_default=False,
            autocompletion=files_ending(),
        ),
    ],
    output: Annotated[
        Path | None,
        option(
            "FILE",
            "Write this file, a GIF or an MP4 by its suffix; by default motion.gif in DIR.",
            "--output",
            "-o",
        ),
    ] = None,
    fps: Annotated[
        int, typer.Option(metavar="N", help="Show this number of pictures per second.", min=1, max=50)
    ] = 25,
    quiet: Quiet = False,
) -> None:
    """Animate a moving-roughness run, as a GIF or MP4."""
    with user_errors():
        from ehlectric.figures.animation import save_animation
        from ehlectric.motion.stored_run import read_motion

        dataset = read_motion(folder)
        output = (folder if folder.is_dir() else folder.parent) / "motion.gif" if output is None else output
        with progress_bar(shown=not quiet) as progress:
            save_animation(dataset, output, fps=fps, progress=progress)
    if not quiet:
        say(f"written: {output}")
