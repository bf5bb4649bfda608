"""What the run command does with a case whose roughness moves, and the command that draws it as a film."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ehlectric.commands.tables.motion import motion_table
from ehlectric.commands.terminal import print_table, progress_bar, user_errors, warn

if TYPE_CHECKING:
    import xarray as xr

    from ehlectric.cases.case import Case


SUMMARY = "summary.json"


def run_moving(case: Case, output: Path, *, solver: str, plots: bool, quiet: bool, as_json: bool) -> None:
    """Solve in time, write motion.nc as it goes, then summary.json and figures.

    Where a step is not solved, what was found before is summed up and drawn all the same, exit status 3.
    """
    from ehlectric.contact.files import FILES
    from ehlectric.errors import ConvergenceError, InputError, shown
    from ehlectric.figures.names import ALL_FIGURES, MOTION_FIGURE_FILES
    from ehlectric.motion.record import MOTION, read_motion
    from ehlectric.motion.run import run_motion
    from ehlectric.runtime.files import clear, prepare

    if solver != "ehlectric":
        raise InputError("--solver", got=f"{shown(solver)} for a case with motion", takes="'ehlectric'")
    names = (*FILES, *ALL_FIGURES, *MOTION_FIGURE_FILES)
    folder = prepare(output, (MOTION, *names))
    failed: ConvergenceError | None = None
    # Stopped behind its last step, a run is summed up alone.
    again = (folder / SUMMARY).is_file()
    clear(folder, names)
    with progress_bar(shown=not quiet) as bar, _told_where_it_stops(folder, bar) as progress:
        try:
            run_motion(case, folder, again=again, progress=progress)
        except ConvergenceError as error:
            if not (folder / MOTION).is_file():
                raise
            failed = error
        summary, files = _written(read_motion(folder), folder, plots=plots)
    if as_json:
        typer.echo(json.dumps(summary, indent=2))
    elif not quiet:
        print_table(motion_table(summary))
        typer.echo("written: " + ", ".join(str(path) for path in files))
    if not quiet:
        warn(summary["warnings"])
    if failed is not None:
        raise failed


@contextmanager
def _told_where_it_stops(
    folder: Path, show: Callable[[int, int, str], None]
) -> Iterator[Callable[[int, int, str], None]]:
    """The progress to call; where the run is stopped, one line of what is saved."""
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

            # Of the file, as the last instant may not have been told yet.
            saved = saved_steps(folder / MOTION)
            rest = "goes on with the others" if saved < steps else "sums them up"
            told = f"{saved} of {steps} steps are saved in {folder}, the same command {rest}"
            typer.echo(f"stopped; {told}", err=True)
        raise


def _written(dataset: xr.Dataset, folder: Path, *, plots: bool) -> tuple[dict[str, Any], list[Path]]:
    """summary.json and the figures of a run."""
    from ehlectric.motion.record import MOTION
    from ehlectric.motion.summary import summary_of
    from ehlectric.runtime.files import whole

    summary = summary_of(dataset)
    with whole(folder / SUMMARY) as path:
        path.write_text(json.dumps(summary, indent=2, allow_nan=False) + "\n", encoding="utf-8")
    files = [folder / SUMMARY, folder / MOTION]
    if plots:
        from ehlectric.figures.motion.save import save_motion_figures

        files += save_motion_figures(dataset, folder)
    return summary, files


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
    """Draw the instants of a contact whose roughness moves as a moving picture."""
    with user_errors():
        from ehlectric.figures.motion.animation import save_animation
        from ehlectric.motion.record import read_motion

        dataset = read_motion(folder)
        with progress_bar(shown=not quiet) as progress:
            save_animation(dataset, output, fps=fps, progress=lambda done, of: progress(done, of, "drawing"))
    if not quiet:
        typer.echo(f"written: {output}")
