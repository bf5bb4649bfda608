"""Part of the run command for moving roughness, and the command that draws an animation of a run."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.tables.motion import motion_table
from ehlectric.commands.terminal import print_table, progress_bar, user_errors, warn

if TYPE_CHECKING:
    from ehlectric.cases.case import Case


def run_moving(case: Case, output: Path, *, solver: str, plots: bool, quiet: bool, as_json: bool) -> None:
    """Run a case with moving roughness; write motion.nc, summary.json and figures.

    Where a time step is not solved, the steps before it are summed up and drawn, and the exit status is 3.
    """
    from ehlectric.contact.files import FILES
    from ehlectric.errors import InputError, shown
    from ehlectric.figures.names import ALL_FIGURES, MOTION_FIGURE_FILES
    from ehlectric.motion.record import MOTION
    from ehlectric.motion.run import run
    from ehlectric.runtime.files import clear, prepare

    if solver != "ehlectric":
        raise InputError("--solver", got=f"{shown(solver)} for a case with motion", takes="'ehlectric'")
    figures = (*ALL_FIGURES, *MOTION_FIGURE_FILES)
    folder = prepare(output, (MOTION, *FILES, *figures))
    clear(folder, figures)
    with progress_bar(shown=not quiet) as bar, _told_where_it_stops(folder, bar) as progress:
        outcome = run(case, folder, progress)
        files = [*outcome.files]
        if plots:
            from ehlectric.figures.motion.save import save_motion_figures

            files += save_motion_figures(outcome.dataset, folder)
    if as_json:
        typer.echo(json.dumps(outcome.summary, indent=2))
    elif not quiet:
        print_table(motion_table(outcome.summary))
        typer.echo("written: " + ", ".join(str(path) for path in files))
    if not quiet:
        warn(outcome.summary["warnings"])
    if outcome.failure is not None:
        raise outcome.failure


@contextmanager
def _told_where_it_stops(
    folder: Path, show: Callable[[int, int, str], None]
) -> Iterator[Callable[[int, int, str], None]]:
    """Progress to call; where the run is stopped, one line tells how many steps are saved."""
    steps = 0

    def progress(done: int, of: int, text: str) -> None:
        nonlocal steps
        steps = of
        show(done, of, text)

    try:
        yield progress
    except (KeyboardInterrupt, SystemExit):
        if steps:
            from ehlectric.motion.record import MOTION, saved_steps

            # Read from the file: the progress may not have been called for the last instant yet.
            saved = saved_steps(folder / MOTION)
            rest = "goes on with the others" if saved < steps else "sums them up"
            told = f"{saved} of {steps} steps are saved in {folder}, the same command {rest}"
            typer.echo(f"stopped; {told}", err=True)
        raise


def plot_moving(file: Path, output: Path, *, quiet: bool) -> None:
    """Draw the figures of a run again."""
    from ehlectric.figures.motion.save import save_motion_figures
    from ehlectric.figures.names import MOTION_FIGURE_FILES
    from ehlectric.motion.record import read_motion
    from ehlectric.runtime.files import prepare

    dataset = read_motion(file)
    files = save_motion_figures(dataset, prepare(output, MOTION_FIGURE_FILES))
    if not quiet:
        typer.echo("written: " + ", ".join(str(path) for path in files))
        warn(json.loads(dataset.attrs["warnings"]))


def animate(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a run.", show_default=False)],
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="FILE", help="GIF or MP4, by its suffix.")
    ] = Path("motion.gif"),
    fps: Annotated[int, typer.Option(metavar="N", help="Pictures a second.", min=1, max=50)] = 25,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Draw the recorded instants of a contact whose roughness moves as an animation."""
    with user_errors():
        from ehlectric.figures.motion.animation import save_animation
        from ehlectric.motion.record import read_motion

        dataset = read_motion(folder)
        with progress_bar(shown=not quiet) as progress:
            save_animation(dataset, output, fps=fps, progress=lambda done, of: progress(done, of, "drawing"))
    if not quiet:
        typer.echo(f"written: {output}")
