"""The sweep command."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.tables.sweep import results_table
from ehlectric.commands.terminal import NOT_CONVERGED, print_table, user_errors, warn
from ehlectric.errors import InputError, LostError, ResultWarning, shown
from ehlectric.version import __version__

if TYPE_CHECKING:
    from ehlectric.sweep.results import SweepResults


# Between two lines of progress where nobody sees a bar [s].
_EVERY = 15.0

# More processes than any machine has cores.
_MOST_WORKERS = 1024


def sweep(
    sweep_file: Annotated[Path, typer.Argument(help="Sweep file, TOML.", show_default=False)],
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="DIR", help="Folder for the results.")
    ] = Path("sweep"),
    workers: Annotated[
        str | None,
        typer.Option(metavar="N", help="Processes on this machine; as many as cores if not given."),
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Of a Dask cluster that solves instead.")
    ] = None,
    quiet: Annotated[
        bool, typer.Option("--quiet", "-q", help="No table or progress; in one line what failed.")
    ] = False,
) -> None:
    """Solve a case over varied inputs; write sweep.sqlite, sweep.csv, sweep.nc and sweep.parquet.

    Each point is saved as it finishes: the same command again goes on where it was stopped.

    Exit status 0: done, though some points may have failed, which is said. 2: the input is wrong. 3: no point
    was solved, or the scheduler is gone.
    """
    with user_errors():
        count = _workers(workers, scheduler)

        from ehlectric.sweep.inputs import Sweep

        asked = Sweep.from_toml(sweep_file)

        from ehlectric.sweep.run import crew, run_with

        if scheduler is None:
            solvers = crew(None, count)
        else:
            from ehlectric.sweep.cluster import cluster

            solvers = cluster(scheduler)
        with _told_where_it_stops(output) as begun, _shown(begun, quiet=quiet) as progress:
            results = run_with(asked, output, solvers, progress)
    if not quiet:
        from ehlectric.sweep.tables import FILES

        print_table(results_table(results))
        typer.echo("written: " + ", ".join(str(output / name) for name in FILES if (output / name).exists()))
        warn(_warnings(results))
    elif any(point.solved for point in results.points):
        warn(_in_short(results))
    if not any(point.solved for point in results.points):
        typer.echo(f"error: none of {len(results.points)} points was solved", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _workers(text: str | None, scheduler: str | None) -> int | None:
    """The number of processes that an option gives."""
    if text is None:
        return None
    if scheduler is not None:
        raise InputError("--workers", got="it beside --scheduler", takes="one of the two")
    if not text.isdecimal() or not 1 <= int(text) <= _MOST_WORKERS:
        raise InputError("--workers", got=shown(text), takes=f"a whole number from 1 to {_MOST_WORKERS}")
    return int(text)


class _Begun:
    """Whether points are being solved."""

    yet = False


@contextmanager
def _told_where_it_stops(output: Path) -> Iterator[_Begun]:
    """One line of what is saved where a sweep is stopped or loses those who solve it."""
    begun = _Begun()

    def told(why: str) -> None:
        from ehlectric.sweep.store import saved_points

        # Of the file, as the last rows may not have been told yet.
        saved, points = saved_points(output)
        text = f"{saved} of {points} points are saved in {output}, the same command goes on with the others"
        typer.echo(f"{why}; {text}", err=True)

    try:
        yield begun
    except LostError as error:
        told(f"error: those who solve are gone: {error}")
        raise typer.Exit(NOT_CONVERGED) from None
    except (KeyboardInterrupt, SystemExit):
        if begun.yet:
            told("stopped")
        raise


@contextmanager
def _shown(begun: _Begun, *, quiet: bool) -> Iterator[Callable[[int, int, str], None]]:
    """Progress on stderr: a bar where somebody sees it, else a line now and then."""
    showing = _silent() if quiet else _bar() if sys.stderr.isatty() else _lines()
    with showing as show:

        def progress(done: int, of: int, text: str) -> None:
            begun.yet = True
            show(done, of, text)

        yield progress


@contextmanager
def _silent() -> Iterator[Callable[[int, int, str], None]]:
    yield lambda _done, _of, _text: None


@contextmanager
def _lines() -> Iterator[Callable[[int, int, str], None]]:
    """Plain lines, for a log file."""
    started, first, last = 0.0, 0, time.monotonic()

    def show(done: int, of: int, text: str) -> None:
        nonlocal started, first, last
        now = time.monotonic()
        if not started:
            started, first = now, done
        if now - last < _EVERY:
            return
        last = now
        rate = (done - first) / max(now - started, 1e-9)
        left = f", {rate:.3g} a second, {_duration((of - done) / rate)} left" if rate else ""
        typer.echo(f"{done} of {of} points{left}" + (f", {text}" if text else ""), err=True)

    yield show


@contextmanager
def _bar() -> Iterator[Callable[[int, int, str], None]]:
    """A bar with rate and time left, those of this run."""
    from rich import progress
    from rich.console import Console

    columns = (
        progress.BarColumn(),
        progress.MofNCompleteColumn(),
        progress.TextColumn("{task.fields[rate]}"),
        progress.TimeRemainingColumn(),
        progress.TextColumn("{task.description}"),
    )
    with progress.Progress(*columns, console=Console(stderr=True)) as bar:
        tasks: list[progress.TaskID] = []

        def show(done: int, of: int, text: str) -> None:
            if not tasks:
                tasks.append(bar.add_task(text, total=of, completed=done, rate=""))
            speed = bar.tasks[0].speed
            rate = "" if speed is None else f"{speed:.3g}/s"
            bar.update(tasks[0], completed=done, description=text, rate=rate)

        yield show


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}"


def _warnings(results: SweepResults) -> Iterator[ResultWarning]:
    """Warnings of the solved points, and of points that another version solved."""
    solved = [point for point in results.points if point.solved]
    warned, doubtful = sum(bool(point.warnings) for point in solved), sum(results.doubtful)
    where = "which the column warnings of sweep.csv has"
    if warned:
        text = f"{warned} of {len(solved)} solved points have warnings, {where}"
        yield ResultWarning("points-with-warnings", text)
    if doubtful:
        told = f"{doubtful} of {len(solved)} solved points have a film that is not to be used"
        text = f"{told}, as their warnings say: maps and lines leave them out"
        yield ResultWarning("points-not-usable", text)
    others = Counter(point.version for point in results.points if point.version not in ("", __version__))
    for version, count in others.items():
        kept = f"{count} points were solved by version {version} and are kept"
        text = f"{kept}; in a new folder {__version__} solves them"
        yield ResultWarning("points-of-another-version", text)


def _in_short(results: SweepResults) -> Iterator[str]:
    """In one line how many points are no use, where any is."""
    counts = Counter(point.status for point in results.points)
    told = [f"{counts[status]} {status}" for status in ("failed", "not converged") if counts[status]]
    if doubtful := sum(results.doubtful):
        told.append(f'{doubtful} solved but "do not use"')
    if told:
        yield f"of {len(results.points)} points {', '.join(told)}; sweep.csv says why"
