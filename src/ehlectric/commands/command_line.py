"""The application: all commands, and the exit status of the command line."""

from __future__ import annotations

import logging
import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands import (  # noqa: F401  # each module adds its commands to COMMANDS
    calibrate_command,
    film_command,
    netlist_command,
    oil_commands,
    reproduce_command,
    solve_commands,
    start_commands,
    surface_command,
    sweep_commands,
    write_commands,
)
from ehlectric.commands.options import COMMANDS, TEXTS
from ehlectric.commands.terminal import NOT_CONVERGED, WRONG_INPUT, say
from ehlectric.errors import InputError
from ehlectric.runtime.locks import not_ignored
from ehlectric.runtime.memory import is_out_of_memory, out_of_memory
from ehlectric.runtime.progress import MACHINE
from ehlectric.version import __version__

SIGNALLED = 128  # plus the number of the signal, as in shells
READER_LEFT = SIGNALLED + 13  # as after SIGPIPE, which Windows does not have

app = typer.Typer(
    help=TEXTS["help"],
    epilog=TEXTS["epilog"],
    invoke_without_command=True,
    rich_markup_mode=None,  # it would take [motion] in a help text for a style
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)


def _version(requested: bool) -> None:
    if requested:
        typer.echo(f"ehlectric {__version__}")
        raise typer.Exit


@app.callback()
def _main(
    ctx: typer.Context,
    _: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    if ctx.invoked_subcommand is None:
        typer.echo(ctx.get_help())


for _name, _texts in TEXTS["commands"].items():
    _typed = "\n".join(f"  ehlectric {line}" for line in _texts["examples"])
    app.command(_name, short_help=_texts["short"], epilog=f"\b\nExamples:\n{_typed}")(COMMANDS[_name])


def _stop(number: int, _: object) -> None:
    # SystemExit runs every finally clause, so that no half-written file is left.
    sys.exit(SIGNALLED + number)


def exit_status() -> int:
    """Run the command and return its exit status; wrong arguments are one line on stderr."""
    try:
        status = app(prog_name="ehlectric", standalone_mode=False)
        sys.stdout.flush()
    except (KeyboardInterrupt, typer.Abort):
        return SIGNALLED + signal.SIGINT
    except SystemExit as ended:
        if not isinstance(ended.__context__, BrokenPipeError):
            raise
        # The library of the command line has its own status for a reader that leaves.
        return _failed(ended.__context__)
    except Exception as error:
        return _failed(error)
    return int(status or 0)


def _failed(error: Exception) -> int:
    """Exit status of an error that no command reports, with its line; another error is raised again."""
    if is_out_of_memory(error):
        # Commands report what ran out before anything was solved.
        say(f"error: {out_of_memory(error)}", err=True)
        return NOT_CONVERGED
    if isinstance(error, OSError):
        # Nothing can be printed any more, also not by the interpreter at its exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if isinstance(error, BrokenPipeError):
            return READER_LEFT
        reason = (error.strerror or str(error)).lower()
        say(f"error: standard output: cannot be written to, {reason}", err=True)
        return WRONG_INPUT
    message = getattr(error, "format_message", None)
    if message is None:
        raise error
    # Its text is one line, with what the user typed escaped.
    say(f"error: {InputError(message())}", err=True)
    return WRONG_INPUT


class _OneLine(logging.Handler):
    """Handler that prints what the machine lacks as one line on stderr."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print a message."""
        say(f"note: {record.getMessage()}", err=True)


def _shown_once() -> Callable[..., None]:
    """Return the function that prints a warning of Python, such as a doubt about an input, as one line on
    stderr, at the first time only.
    """
    printed: set[str] = set()

    def show(message: Warning | str, *_: object) -> None:
        if str(message) not in printed:
            printed.add(str(message))
            say(f"warning: {message}", err=True)

    return show


def _free_of_the_display() -> None:
    """Keep settings of the user for figures on a screen from this process, which only writes files.

    The kernel of a notebook hands MPLBACKEND on to all commands. Another environment may lack the backend.
    Errors in a matplotlibrc, which changes no figure, are not reported.
    """
    os.environ["MPLBACKEND"] = "agg"
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    logging.getLogger("matplotlib.font_manager").setLevel(logging.WARNING)


def _open_closed_streams() -> None:
    """Let a standard stream that is closed or missing, as for a service, lead to nothing.

    Otherwise the first file that is opened would get its number, and what libraries print would be in it.
    """
    while (number := os.open(os.devnull, os.O_RDWR)) <= _STDERR:
        os.set_inheritable(number, True)
    os.close(number)
    for name in ("stdin", "stdout", "stderr"):
        if getattr(sys, name) is None:
            stream = Path(os.devnull).open("r" if name == "stdin" else "w", encoding="utf-8")  # noqa: SIM115
            setattr(sys, name, stream)
            setattr(sys, f"__{name}__", stream)


# Number of the file of stderr, the last one of the standard streams.
_STDERR = 2


@contextmanager
def process() -> Iterator[None]:
    """Context of the process of a command: its streams, signals, warnings and notes."""
    _open_closed_streams()
    _free_of_the_display()
    for number in not_ignored():
        if number != signal.SIGINT:  # Python raises KeyboardInterrupt.
            signal.signal(number, _stop)
    for stream in (sys.stdout, sys.stderr):
        # A terminal without a micro sign must not end the run.
        stream.reconfigure(errors="replace")  # type: ignore[union-attr]
    warnings.showwarning = _shown_once()
    # Python shows warnings about deprecated names to programmers only.
    warnings.filterwarnings("default", message=r".* is deprecated; use ", category=DeprecationWarning)
    handler = _OneLine(logging.WARNING)
    MACHINE.addHandler(handler)
    yield
    MACHINE.removeHandler(handler)
    for number in not_ignored():
        # From here on Python would answer a signal, such as the signal of an impatient user, by a traceback.
        signal.signal(number, signal.SIG_DFL)
