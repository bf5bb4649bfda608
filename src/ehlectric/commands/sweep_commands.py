"""The commands that solve a sweep, and that look at one: sweep, map and sensitivity."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from ehlectric.commands.options import (
    Look,
    command,
    figure_options,
)
from ehlectric.commands.terminal import (
    NOT_CONVERGED,
    duration,
    echo_files,
    parted,
    print_rows,
    print_table,
    print_verdict,
    refuse_failure,
    refuse_undrawn,
    say,
    user_errors,
    warn,
)
from ehlectric.errors import InputError, LostError, WriteError, shown
from ehlectric.readable import readable
from ehlectric.runtime.memory import is_out_of_memory, out_of_memory
from ehlectric.runtime.progress import Progress, silent
from ehlectric.runtime.undrawn import Drawn, Undrawn, kept_going

if TYPE_CHECKING:
    from ehlectric.runtime.progress import RunOutcome
    from ehlectric.sweep import Sweep, SweepResults


# Time between two lines of progress where stderr is not a terminal [s].
_EVERY = 15.0

# Largest number of processes.
_MOST_WORKERS = 1024


@command("sweep")
def sweep(
    sweep_file: Path,
    output: Path = Path("sweep"),
    workers: str | None = None,
    scheduler: str | None = None,
    formats: list[str] | None = None,
    style: str = "screen",
    plots: bool = False,
    quiet: bool = False,
) -> None:
    """Solve a case over varied inputs; write sweep.sqlite, sweep.csv and sweep.nc.

    With pyarrow installed, sweep.parquet is also written. Each point is saved as it finishes: if the sweep is
    interrupted, run the same command to resume it. Figures come from ehlectric map and ehlectric
    sensitivity, or from --plots.

    Exit status 0: done; points that failed are counted. 2: the input is wrong. 3: no point was solved, or
    memory or workers were lost.
    """
    with user_errors():
        options = {"workers": _workers(workers, scheduler), "scheduler": scheduler}
        look = figure_options(formats, style)

        from ehlectric.runs import by_kind
        from ehlectric.runs.file_kinds import expect

        requested = by_kind.read_sweep(expect(sweep_file, "sweep"))
        if not quiet:
            _tell_what_lacks(requested)
        with _tell_where_it_stops(output) as begun, _shown(begun, quiet=quiet) as progress:
            outcome = by_kind.RUNS["sweep"].run(requested, output, progress, **options)
    if not quiet:
        _print_answer(outcome)
    elif outcome.converged:
        warn(_in_short(outcome.result))
    draws = (plots or bool(formats)) and outcome.converged
    with user_errors():
        drawn, why = _drawn(outcome.result, output, look) if draws else (Drawn(()), "")
    if not quiet:
        if drawn.files:
            echo_files(drawn.files)
        warn((*drawn.warnings, *filter(None, [why])))
    refuse_failure(outcome, drawn.undrawn)


def _print_answer(outcome: RunOutcome[SweepResults]) -> None:
    """Print the rows, files, warnings and verdict of a sweep."""
    from ehlectric.sweep import sweep_verdict
    from ehlectric.tables.sweep_summary import sweep_rows

    print_rows(sweep_rows(outcome.result))
    echo_files(outcome.files)
    warn(outcome.warnings)
    print_verdict(sweep_verdict(outcome.result))


def _tell_what_lacks(sweep: Sweep) -> None:
    """Warn, before points are solved, of a point of a sweep of drives that cannot be computed."""
    from ehlectric.cases.drive_case import DriveCase
    from ehlectric.sweep import lacking_point, planned_points

    drives = isinstance(sweep.case, DriveCase)
    lacking = lacking_point(sweep, planned_points(sweep)) if drives else None
    if lacking is not None:
        warn([f"{lacking}; points like it will fail"])


def _drawn(results: SweepResults, folder: Path, look: Look) -> tuple[Drawn, str]:
    """Figures of a sweep and their warnings; if the sweep has no figures, the reason as a warning."""
    from ehlectric.commands.draw_commands import draw_sweep

    try:
        return draw_sweep(results, folder, **look), ""
    except WriteError as error:
        return Drawn((), undrawn=(Undrawn("figures", error),)), ""
    except InputError as error:
        return Drawn(()), f"no figures: {error}"


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
    """Context of a sweep; if it is interrupted or loses its workers, one line states how much is saved."""
    begun = _Begun()

    def tell(why: str) -> None:
        from ehlectric.sweep import saved_points

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
        left = f", {readable(rate)} a second, {duration((of - done) / rate)} left" if rate else ""
        say(f"{done} of {of} points{left}" + (f", {text}" if text else ""), err=True)

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
        progress.TextColumn("{task.fields[left]}"),
        progress.TextColumn("{task.description}"),
    )
    with progress.Progress(*columns, console=Console(stderr=True)) as bar:
        yield parted(bar)


def _in_short(results: SweepResults) -> Iterator[str]:
    """One line with the numbers of points that are not usable, where there are any."""
    counts = Counter(point.status for point in results.points)
    parts = [f"{counts[status]} {status}" for status in ("failed", "not converged") if counts[status]]
    if doubtful := sum(results.doubtful):
        parts.append(f'{doubtful} solved but "do not use"')
    if parts:
        yield f"of {len(results.points)} points {', '.join(parts)}; sweep.csv says why"


def _varied_keys(ctx: typer.Context, incomplete: str) -> list[str]:
    """Varied keys of the sweep in the folder that is typed already, for the completion of a shell."""
    from ehlectric.sweep import read_sweep

    try:
        results = read_sweep(ctx.params["folder"])
    except (InputError, KeyError, TypeError):
        return []
    return [key for key in (*results.axes, *results.ranges) if key.startswith(incomplete)]


@command("map", x=_varied_keys, y=_varied_keys)
def draw_maps(
    folder: Path,
    x: str,
    y: str | None = None,
    value: str = "",
    at: list[str] | None = None,
    output: Path | None = None,
    formats: list[str] | None = None,
    style: str = "screen",
    quiet: bool = False,
) -> None:
    """Draw a value of a sweep as a map and as lines over one or two varied keys.

    The applied voltage is marked. For a bearing that is swept over its speed only, the capacitance and the
    breakdown voltage over the speed are also drawn.
    """
    with user_errors():
        held, look = _held(at or []), figure_options(formats, style)

        from ehlectric.figures.figure_names import SPEED_FIGURE_FILES, in_formats, map_files, of_cut
        from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
        from ehlectric.sweep import main_value, read_sweep, select_slice

        results, forms = read_sweep(folder), look["formats"]
        value = value or main_value(results.case)
        taken = select_slice(results, x, y, value, held)
        names = in_formats(
            (*map_files(value, held), *(of_cut(name, held) for name in SPEED_FIGURE_FILES)), forms
        )
        files: list[Path] = []
        with alone_in(output or folder, names, locks=[FIGURE_LOCK]) as target, kept_going() as undrawn:
            from ehlectric.figures.style import style as styled
            from ehlectric.figures.sweep_figures import save_maps, save_speeds

            with styled(style):
                files += save_maps(results, x, y, value, target, at=held, formats=forms)
                files += save_speeds(results, taken, target, forms, at=held)
    if not quiet:
        from ehlectric.figures.sweep_points import held_text

        if taken.at or taken.free:
            say("at " + held_text(results, taken).removeprefix("at "))
        echo_files(files)
    refuse_undrawn(undrawn)


@command("sensitivity")
def sensitivity(
    folder: Path,
    value: str = "",
    output: Path | None = None,
    formats: list[str] | None = None,
    style: str = "screen",
    quiet: bool = False,
) -> None:
    """Show which inputs of a Sobol design contribute most to the spread of a value.

    Writes sensitivity.json with the spread and the Sobol indices, and a figure of both. By default the value
    is the breakdown voltage of a contact, the margin of a bearing with a motor, or the rate of a drive.
    """
    with user_errors():
        look = figure_options(formats, style)

        from ehlectric.figures.figure_names import SENSITIVITY_FIGURE, in_formats
        from ehlectric.runs.result_folders import SENSITIVITY
        from ehlectric.runtime.files import write_json
        from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
        from ehlectric.sweep import ranked_value, read_sweep
        from ehlectric.sweep import sensitivity as sensitivity_of

        results = read_sweep(folder)
        indices = sensitivity_of(results, value or ranked_value(results.case))
        names = in_formats([SENSITIVITY_FIGURE], look["formats"])
        with alone_in(output or folder, (SENSITIVITY, *names), locks=[FIGURE_LOCK]) as target:
            files = [target / SENSITIVITY]
            write_json(files[0], indices.to_dict())
            with kept_going(SENSITIVITY_FIGURE) as undrawn:
                from ehlectric.figures.style import style as styled
                from ehlectric.figures.sweep_figures import save_sensitivity

                with styled(style):
                    files += save_sensitivity(results, indices, target / SENSITIVITY_FIGURE, look["formats"])
    if not quiet:
        from ehlectric.sweep import sensitivity_warnings
        from ehlectric.tables.sweep_summary import indices_table, spread_rows

        print_rows(spread_rows(results, indices), results.title)
        print_table(indices_table(results, indices))
        echo_files(files)
        warn(sensitivity_warnings(indices))
    refuse_undrawn(undrawn)


def _held(options: Sequence[str]) -> dict[str, str]:
    """Keys and values of the option --at."""
    held: dict[str, str] = {}
    for text in options:
        key, sign, value = (part.strip() for part in text.partition("="))
        if not (sign and key and value):
            raise InputError("at", got=shown(text), takes="KEY=VALUE")
        if key in held:
            raise InputError("at", got=f"{key} twice", takes="each key once")
        held[key] = value
    return held
