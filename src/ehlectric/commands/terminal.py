"""What all commands share: errors as one line, progress, tables and warnings on the terminal."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import typer

from ehlectric.errors import ConvergenceError, InputError, ResultWarning

if TYPE_CHECKING:
    from rich.table import Table


WRONG_INPUT = 2
NOT_CONVERGED = 3


@contextmanager
def user_errors() -> Iterator[None]:
    """Wrong input as one line on stderr and exit status 2."""
    try:
        yield
    except InputError as error:
        text = str(error)
    except ConvergenceError as error:
        typer.echo(f"error: not converged: {error}", err=True)
        raise typer.Exit(NOT_CONVERGED) from None
    except BrokenPipeError:
        raise
    except OSError as error:
        text = f"{error.filename}: cannot be used, {(error.strerror or str(error)).lower()}"
    else:
        return
    typer.echo(f"error: {text}", err=True)
    raise typer.Exit(WRONG_INPUT)


@contextmanager
def progress_bar(*, shown: bool) -> Iterator[Callable[[int, int, str], None]]:
    """A progress bar on stderr, where somebody can see it."""
    if not (shown and sys.stderr.isatty()):
        yield lambda _done, _of, _text: None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True)) as bar:
        task = bar.add_task("starting", total=None)
        yield lambda done, of, text: bar.update(task, completed=done, total=of, description=text)


@contextmanager
def progress_line(*, shown: bool) -> Iterator[Callable[[str], None]]:
    """A line on stderr that says what is being done, where somebody can see it."""
    if not (shown and sys.stderr.isatty()):
        yield lambda _: None
        return
    from rich.console import Console

    with Console(stderr=True).status("starting") as status:
        yield status.update


def print_table(table: Table) -> None:
    """Print a table on stdout, plain where nobody sees it."""
    from rich.console import Console

    console = Console(highlight=False)
    with console.capture() as captured:
        console.print(table)
    typer.echo(captured.get(), nl=False)


def warn(texts: Iterable[str | ResultWarning]) -> None:
    """Warnings on stderr, a line each."""
    for text in texts:
        typer.echo(f"warning: {text}", err=True)
