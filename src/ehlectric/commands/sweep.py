"""The sweep command."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.options import Formats, Look, Output, Style, figure_options, file_argument
from ehlectric.commands.terminal import (
    NOT_CONVERGED,
    echo_files,
    print_rows,
    print_verdict,
    refuse_failure,
    say,
    user_errors,
    warn,
)
from ehlectric.errors import InputError, LostError, ResultWarning, WriteError, shown
from ehlectric.runtime.memory import is_out_of_memory, out_of_memory
from ehlectric.runtime.progress import Progress, silent

if TYPE_CHECKING:
    from ehlectric.sweep.inputs import Sweep
    from ehlectric.sweep.results import SweepResults


# Time between two lines of progress where stderr is not a terminal [s].
_EVERY = 15.0

# Largest number of processes.
_MOST_WORKERS = 1024


def sweep(
    sweep_file: Annotated[Path, file_argument("FILE", "Sweep file, in TOML.", ".toml")],
    output: Output = Path("sweep"),
    workers: Annotated[
        str | None,
        typer.Option(
            metavar="N",
            help="Solve in this number of processes; without it, in as many as there are cores.",
            show_default=False,
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS",
            help='Solve on the Dask cluster with this address, such as "tcp://10.0.0.1:8786".',
            show_default=False,
        ),
    ] = None,
    formats: Formats = None,
    style: Style = "screen",
    plots: Annotated[
        bool,
        typer.Option(
            "--plots",
            help="Draw maps and lines over one or two varied keys, or the sensitivity. --format implies it.",
        ),
    ] = False,
    quiet: Annotated[
        bool,
        typer.Option("--quiet", "-q", help="Print no table and no progress, only one line on what failed."),
    ] = False,
) -> None:
    """Solve a case over varied inputs; write sweep.sqlite, sweep.csv and sweep.nc.

    With pyarrow installed, sweep.parquet is written too. Each point is saved as it finishes: if the sweep is
    interrupted, run the same command to resume it. Figures come from ehlectric map and ehlectric
    sensitivity, or from --plots.

    Exit status 0: done; points that failed are counted. 2: the input is wrong. 3: no point was solved, or
    memory or workers were lost.
    """
    with user_errors():
        options = {"workers": _workers(workers, scheduler), "scheduler": scheduler}
        look = figure_options(formats, style)

        from ehlectric.runs import by_kind
        from ehlectric.runs.kinds import expect

        expect(sweep_file, "sweep")
        asked = by_kind.read_sweep_file(sweep_file)
        if not quiet:
            _tell_what_lacks(asked)
        with _tell_where_it_stops(output) as begun, _shown(begun, quiet=quiet) as progress:
            outcome = by_kind.RUNS["sweep"].run(asked, output, progress, **options)
        wanted = (plots or bool(formats)) and outcome.converged
        drawn, told = _drawn(output, look) if wanted else ((), ())
    if not quiet:
        from ehlectric.sweep.verdict import sweep_verdict
        from ehlectric.tables.sweep import sweep_rows

        print_rows(sweep_rows(outcome.result))
        echo_files((*outcome.files, *drawn))
        warn((*outcome.warnings, *told))
        print_verdict(sweep_verdict(outcome.result))
    elif outcome.converged:
        warn(_in_short(outcome.result))
    refuse_failure(outcome)


def _tell_what_lacks(sweep: Sweep) -> None:
    """Warn, before points are solved, of a point of a sweep of drives that cannot be computed."""
    from ehlectric.cases.drives.case import DriveCase
    from ehlectric.sweep.preview import lacking_point
    from ehlectric.sweep.run import planned_points

    drives = isinstance(sweep.case, DriveCase)
    lacking = lacking_point(sweep, planned_points(sweep)) if drives else None
    if lacking is not None:
        warn([f"{lacking}; points like it will fail"])


def _drawn(folder: Path, look: Look) -> tuple[tuple[Path, ...], tuple[ResultWarning | str, ...]]:
    """Figures of a sweep and their warnings; without figures, the reason as a warning."""
    from ehlectric.commands.drawing import load_and_draw

    try:
        return load_and_draw(folder, folder, **look)
    except WriteError:
        raise
    except InputError as error:
        return (), (f"no figures: {error}",)


def _workers(text: str | None, scheduler: str | None) -> int | None:
    """Number of processes of the option --workers; None where it is not given."""
    if text is None:
        return None
    if scheduler is not None:
        raise InputError.worded("--workers", "cannot be combined with --scheduler")
    digits = len(str(_MOST_WORKERS))
    if not text.isdecimal() or len(text) > digits or not 1 <= int(text) <= _MOST_WORKERS:
        raise InputError("--workers", got=shown(text), takes=f"a whole number from 1 to {_MOST_WORKERS}")
    return int(text)


class _Begun:
    """State of a sweep: ``yet`` is true when points are being solved."""

    yet = False


@contextmanager
def _tell_where_it_stops(output: Path) -> Iterator[_Begun]:
    """Context of a sweep; if it is interrupted or loses its workers, one line tells how much is saved."""
    begun = _Begun()

    def tell(why: str) -> None:
        from ehlectric.sweep.store import saved_points

        # Read from the file: the progress may not have been called for the last points yet.
        saved, points = saved_points(output)
        text = f"{saved} of {points} points are saved in {output}; the same command resumes the sweep"
        say(f"{why}; {text}", err=True)

    try:
        yield begun
    except LostError as error:
        tell(f"error: the workers were lost: {error}")
        raise typer.Exit(NOT_CONVERGED) from None
    except InputError:
        raise
    except Exception as error:
        if not (begun.yet and is_out_of_memory(error)):
            raise
        tell(f"error: {out_of_memory(error)}")
        raise typer.Exit(NOT_CONVERGED) from None
    except (KeyboardInterrupt, SystemExit):
        if begun.yet:
            tell("interrupted")
        raise


@contextmanager
def _shown(begun: _Begun, *, quiet: bool) -> Iterator[Progress]:
    """Context with progress on stderr: a bar on a terminal, else a line now and then."""
    with nullcontext(silent) if quiet else _bar() if sys.stderr.isatty() else _lines() as show:

        def progress(done: int, of: int, text: str) -> None:
            begun.yet = True
            show(done, of, text)

        yield progress


@contextmanager
def _lines() -> Iterator[Progress]:
    """Context with progress as plain lines, for a log file."""
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
def _bar() -> Iterator[Progress]:
    """Context with a bar that shows the rate of this run and the time left."""
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
    """Time as hours, minutes and seconds."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}"


def _in_short(results: SweepResults) -> Iterator[str]:
    """One line with the numbers of points that are not usable, where there are any."""
    counts = Counter(point.status for point in results.points)
    parts = [f"{counts[status]} {status}" for status in ("failed", "not converged") if counts[status]]
    if doubtful := sum(results.doubtful):
        parts.append(f'{doubtful} solved but "do not use"')
    if parts:
        yield f"of {len(results.points)} points {', '.join(parts)}; sweep.csv says why"
