"""What the run command does with a case whose roughness moves, and the command that draws it as a film."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ehlectric.terminal import print_table, progress_bar, user_errors, warn

if TYPE_CHECKING:
    import xarray as xr
    from rich.table import Table

    from ehlectric.case import Case

SUMMARY = "summary.json"


def run_moving(case: Case, output: Path, *, solver: str, plots: bool, quiet: bool, as_json: bool) -> None:
    """Solve in time, write motion.nc as it goes, then summary.json and figures.

    Where a step is not solved, what was found before is summed up and drawn all the same, exit status 3.
    """
    from ehlectric.errors import ConvergenceError, InputError, shown
    from ehlectric.motion_run import run_motion
    from ehlectric.motion_store import MOTION, read_motion
    from ehlectric.store import ALL_FIGURES, FILES, MOTION_FIGURE_FILES, clear, prepare

    if solver != "ehlectric":
        raise InputError(f"--solver: got {shown(solver)} for a case with motion, takes 'ehlectric'")
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
            from ehlectric.motion_store import MOTION, saved_steps

            # Of the file, as the last instant may not have been told yet.
            saved = saved_steps(folder / MOTION)
            rest = "goes on with the others" if saved < steps else "sums them up"
            told = f"{saved} of {steps} steps are saved in {folder}, the same command {rest}"
            typer.echo(f"stopped; {told}", err=True)
        raise


def _written(dataset: xr.Dataset, folder: Path, *, plots: bool) -> tuple[dict[str, Any], list[Path]]:
    """summary.json and the figures of a run."""
    from ehlectric.motion_result import summary_of
    from ehlectric.motion_store import MOTION
    from ehlectric.store import whole

    summary = summary_of(dataset)
    with whole(folder / SUMMARY) as path:
        path.write_text(json.dumps(summary, indent=2, allow_nan=False) + "\n", encoding="utf-8")
    files = [folder / SUMMARY, folder / MOTION]
    if plots:
        from ehlectric.motion_plot import save_motion_figures

        files += save_motion_figures(dataset, folder)
    return summary, files


def plot_moving(file: Path, output: Path, *, quiet: bool) -> None:
    """Draw the figures of a run again."""
    from ehlectric.motion_plot import save_motion_figures
    from ehlectric.motion_store import read_motion
    from ehlectric.store import MOTION_FIGURE_FILES, prepare

    dataset = read_motion(file)
    files = save_motion_figures(dataset, prepare(output, MOTION_FIGURE_FILES))
    if not quiet:
        typer.echo("written: " + ", ".join(str(path) for path in files))
        warn(json.loads(dataset.attrs["warnings"]))


def motion_table(summary: dict[str, Any]) -> Table:
    """The key figures of a run."""
    from ehlectric.report import plain_table

    table = plain_table(summary["title"])
    course, film, field = summary["motion"], summary["film"], summary["field"]
    still, beside = summary["stationary"] or {}, summary["beside_stationary"] or {}
    breaks = summary["discharge"] or {}
    quantiles = field["local_maxima_quantiles"] or (None, None, None)
    rows: tuple[tuple[str, float | None, float, str], ...] = (
        ("time", course["duration"], 1e3, f"ms in {course['steps']} steps"),
        ("smallest film", film["minimum_thickness"], 1e6, "µm"),
        ("  at", film["minimum_time"], 1e3, "ms"),
        ("  before the motion", film["before"], 1e6, "µm"),
        ("  held still", still.get("minimum_thickness"), 1e6, "µm"),
        ("largest pressure", film["max_pressure"], 1e-9, "GPa"),
        ("  held still", still.get("max_pressure"), 1e-9, "GPa"),
        ("voltage", field["voltage"], 1.0, "V"),
        ("largest field", field["max_strength"], 1e-6, "V/µm"),
        ("  at", field["max_strength_time"], 1e3, "ms"),
        ("  before the motion", field["before"], 1e-6, "V/µm"),
        ("  held still", still.get("max_strength"), 1e-6, "V/µm"),
        ("  above 90 % of it", field["share_above_90"], 100.0, "% of the time"),
        ("local maxima, median", quantiles[1], 1e-6, f"V/µm of {field['local_maxima']}"),
        ("  95 %", quantiles[2], 1e-6, "V/µm"),
        ("breakdown voltage", breaks.get("breakdown_voltage"), 1.0, "V, least over time"),
        ("where both lie alike, at", beside.get("time"), 1e3, "ms"),
        ("  smallest film, moving", beside.get("minimum_thickness"), 1e6, "µm"),
        ("  held still", beside.get("minimum_thickness_stationary"), 1e6, "µm"),
        ("  largest field, moving", beside.get("maximum_strength"), 1e-6, "V/µm"),
        ("  held still", beside.get("maximum_strength_stationary"), 1e-6, "V/µm"),
        ("time steps halved", course["halvings"] or None, 1.0, "times, where one was not found"),
        ("Newton steps a time step", course["newton_per_step"], 1.0, ""),
        ("took", summary["seconds"], 1.0, "s"),
    )
    for name, value, scale, unit in rows:
        if value is not None:
            table.add_row(name, f"{value * scale:.4g}", unit)
    return table


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
        from ehlectric.motion_animation import save_animation
        from ehlectric.motion_store import read_motion

        dataset = read_motion(folder)
        with progress_bar(shown=not quiet) as progress:
            save_animation(dataset, output, fps=fps, progress=lambda done, of: progress(done, of, "drawing"))
    if not quiet:
        typer.echo(f"written: {output}")
