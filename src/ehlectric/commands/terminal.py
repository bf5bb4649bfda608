"""Output of all commands on the terminal: errors as one line, progress, tables, files and warnings."""

from __future__ import annotations

import json
import re
import sys
import textwrap
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from ehlectric.errors import ConvergenceError, InputError, LostError, printable
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable
from ehlectric.runtime.memory import is_out_of_memory, out_of_memory
from ehlectric.runtime.progress import Progress, Remaining, silent
from ehlectric.runtime.undrawn import lines_of

if TYPE_CHECKING:
    from rich.padding import Padding
    from rich.progress import Progress as RichProgress
    from rich.table import Table
    from rich.text import Text

    from ehlectric.quantities.rows import Row
    from ehlectric.quantities.verdict import Verdict
    from ehlectric.runtime.progress import RunOutcome
    from ehlectric.runtime.undrawn import Undrawn


# Exit status.
WRONG_INPUT = 2
NOT_CONVERGED = 3
UNDRAWN = 4

# Width of lists of names, and least width of tables: a narrower terminal breaks their lines [characters].
_WIDTH, _NARROWEST = 90, 20


def say(line: str, *, err: bool = False) -> None:
    """Print one line on stdout or stderr; characters that a terminal obeys are escaped in it.

    Titles and paths in the line may hold any character. A stderr that cannot be written to, as on a full
    disk, changes neither the output nor the exit status.
    """
    try:
        typer.echo(printable(line), err=err)
    except BrokenPipeError:
        raise
    except OSError:
        if not err:
            raise


@contextmanager
def user_errors() -> Iterator[None]:
    """Context in which errors of the user become one line on stderr.

    The exit status is 2 where the input is wrong, or memory ran out before anything was solved. It is 3 where
    something is not converged, or processes or memory were lost in a solution.
    """
    status = WRONG_INPUT
    try:
        yield
    except InputError as error:
        text = str(error)
    except ConvergenceError as error:
        text, status = f"not converged: {error}", NOT_CONVERGED
    except LostError as error:
        text, status = str(error), NOT_CONVERGED
    except (BrokenPipeError, typer.Exit):
        raise
    except Exception as error:
        if is_out_of_memory(error):
            text = out_of_memory(error)
        elif isinstance(error, OSError):
            reason = f"cannot be used, {(error.strerror or str(error)).lower()}"
            text = f"a file {reason}" if error.filename is None else str(InputError(error.filename, reason))
        else:
            raise
    else:
        return
    say(f"error: {text}", err=True)
    raise typer.Exit(status)


@contextmanager
def solving() -> Iterator[None]:
    """Context in which something is solved: where memory runs out, a LostError reports it. Raises LostError
    where memory runs out; a grid that is known not to fit is an InputError as ever.
    """
    try:
        yield
    except (InputError, ConvergenceError, LostError, typer.Exit):
        raise
    except Exception as error:
        if not is_out_of_memory(error):
            raise
        raise LostError(out_of_memory(error)) from None


@contextmanager
def progress_bar(*, shown: bool) -> Iterator[Progress]:
    """Context with a progress bar on stderr; nothing is shown where stderr is not a terminal."""
    if not (shown and sys.stderr.isatty()):
        with solving():
            yield silent
        return
    from rich import progress
    from rich.console import Console

    columns = (
        progress.TextColumn("{task.description}"),
        progress.BarColumn(),
        progress.TaskProgressColumn(),
        progress.TimeElapsedColumn(),
        progress.TextColumn("{task.fields[left]}"),
    )
    with solving(), progress.Progress(*columns, console=Console(stderr=True)) as bar:
        yield parted(bar)


class Left:
    """Time that is left of a part of a job, as a text that is made anew whenever it is shown."""

    def __init__(self) -> None:
        self.remaining = Remaining()

    def __str__(self) -> str:
        seconds = self.remaining.seconds(now=time.monotonic())
        return "" if seconds is None else f"{duration(seconds)} left"

    def __format__(self, _: str) -> str:
        return str(self)


def duration(seconds: float) -> str:
    """Time as hours, minutes and seconds."""
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{rest:02}"


def parted(bar: RichProgress) -> Progress:
    """Progress that shows each part of a job as a new task of a bar, with its own rate and time."""
    left = Left()
    task = bar.add_task("starting", total=None, left=left, rate="")

    def show(done: int, of: int, text: str) -> None:
        nonlocal task
        if left.remaining.is_other(done, of):
            # A task of rich keeps its number of steps and its rate.
            bar.remove_task(task)
            task = bar.add_task(text, total=of or None, completed=done, left=left, rate="")
        left.remaining.step(done, of, now=time.monotonic())
        speed = bar.tasks[0].speed
        rate = "" if speed is None else f"{readable(speed)}/s"
        bar.update(task, completed=done, description=text, rate=rate)

    return show


@contextmanager
def progress_line(*, shown: bool) -> Iterator[Progress]:
    """Context with a line on stderr that says what is being done; only where stderr is a terminal."""
    if not (shown and sys.stderr.isatty()):
        with solving():
            yield silent
        return
    from rich.console import Console

    with solving(), Console(stderr=True).status("starting") as status:
        yield lambda _done, _of, text: status.update(text)


def print_answer(
    outcome: RunOutcome[Any],
    tables: Callable[[RunOutcome[Any]], Iterable[Table]],
    *,
    quiet: bool,
    as_json: bool,
) -> None:
    """Print the tables and files of a run, its warnings and its verdict."""
    if as_json:
        typer.echo(json.dumps(outcome.summary, indent=2))
    elif not quiet:
        for table in tables(outcome):
            print_table(table)
        echo_files(outcome.files)
    if not quiet:
        warn(outcome.warnings)
        if not as_json:
            print_verdict(getattr(outcome.result, "verdict", None))


def refuse_failure(outcome: RunOutcome[Any], undrawn: Sequence[Undrawn]) -> None:
    """Print why a run failed, and which figures are missing; nothing where it succeeded. Raises Exit: with
    status 3 where the run failed, else with the status of ``refuse_undrawn``.
    """
    try:
        refuse_undrawn(undrawn)
    finally:
        if outcome.failure is not None:
            say(f"error: {outcome.failure}", err=True)
            raise typer.Exit(NOT_CONVERGED)


def refuse_undrawn(undrawn: Sequence[Undrawn]) -> None:
    """Print which figures could not be drawn, and why; nothing where all were drawn. Raises Exit: with status
    2 where files cannot be written, else with status 4.
    """
    for line in lines_of(undrawn):
        say(f"error: {line}", err=True)
    if undrawn:
        refused = all(isinstance(figure.error, InputError) for figure in undrawn)
        raise typer.Exit(WRONG_INPUT if refused else UNDRAWN)


def print_rows(rows: Iterable[Row], title: str = "") -> None:
    """Print rows of data as a table on stdout."""
    from ehlectric.tables.measured_tables import table_of

    print_table(table_of(rows, title))


def print_table(table: Table | Text | Padding) -> None:
    """Print a table or a text on stdout; without colours where stdout is not a terminal."""
    from rich.console import Console
    from rich.table import Table

    from ehlectric.tables.narrow_tables import fitted

    console = Console(highlight=False)
    if console.width < _NARROWEST:
        console = Console(highlight=False, width=_NARROWEST)
    with console.capture() as captured:
        console.print(fitted(table, console.width) if isinstance(table, Table) else table)
    typer.echo(captured.get(), nl=False)


# Styles of the levels of a verdict, as rich names them.
_STYLES = {"green": "bold green", "yellow": "bold yellow", "red": "bold red", "grey": "bold"}


def print_verdict(verdict: Verdict | None) -> None:
    """Print a verdict on stdout in lines, its heading in the colour of its level; without colours, and
    without line breaks within a line, where stdout is no terminal.
    """
    if verdict is None:
        return
    from rich.console import Console
    from rich.padding import Padding
    from rich.table import Table
    from rich.text import Text

    from ehlectric.quantities.verdict import WIDTH_OF_LABEL

    if not Console().is_terminal:
        for line in str(verdict).splitlines():
            say(line)
        return
    (_, heading), *lines = verdict.printed_lines()
    print_table(Text(printable(heading), style=_STYLES[verdict.level]))
    grid = Table.grid(padding=(0, 0, 0, 0))
    grid.add_column(width=WIDTH_OF_LABEL, style="dim")
    grid.add_column()
    for label, text in lines:
        grid.add_row(label, Text(printable(text)))
    print_table(Padding(grid, (0, 0, 0, 2)))


def echo_files(files: Iterable[Path]) -> None:
    """Print the files that were written: a single path on one line, else the names below their folder.

    Numbers in names are sorted by their value, within the order of their folders.
    """
    folders: dict[Path, list[str]] = {}
    for path in files:
        folders.setdefault(path.parent, []).append(printable(path.name))
    if sum(map(len, folders.values())) == 1:
        ((folder, (name,)),) = folders.items()
        say(f"written: {folder / name}")
        return
    for folder, names in folders.items():
        say(f"written to {folder}:")
        for line in textwrap.wrap(", ".join(names), _WIDTH, break_long_words=False, break_on_hyphens=False):
            typer.echo(f"  {line}")


def in_natural_order(files: Iterable[Path]) -> list[Path]:
    """Files by name, with numbers in names by their value.

    Examples
    --------
    >>> [path.name for path in in_natural_order([Path("figure_10.png"), Path("figure_2.png")])]
    ['figure_2.png', 'figure_10.png']
    """

    def parts(path: Path) -> list[tuple[int, str]]:
        pieces = re.findall(r"(\d+)|(\D+)", path.name)
        return [(int(number), "") if number else (-1, text) for number, text in pieces]

    return sorted(files, key=parts)


def warn(texts: Iterable[str | ResultWarning]) -> None:
    """Print warnings and notes on stderr, one on each line."""
    for text in texts:
        note = isinstance(text, ResultWarning) and text.severity == "note"
        say(f"{'note' if note else 'warning'}: {text}", err=True)
