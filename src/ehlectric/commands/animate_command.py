"""The command that draws an animation of a transient run, and what is told where a run is stopped."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ehlectric.commands.options import command
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


@command("animate")
def animate(folder: Path, output: Path | None = None, fps: int = 25, quiet: bool = False) -> None:
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
