"""The application: all commands, and the exit status of the command line."""

from __future__ import annotations

import os
import signal
import sys
from typing import Annotated

import typer

from ehlectric.commands.bearing import bearing
from ehlectric.commands.check import check
from ehlectric.commands.contact import plot, run
from ehlectric.commands.maps import draw_maps, sensitivity
from ehlectric.commands.motion import animate
from ehlectric.commands.reproduce import reproduce
from ehlectric.commands.surface import init, surface
from ehlectric.commands.sweep import sweep
from ehlectric.commands.terminal import WRONG_INPUT
from ehlectric.version import __version__

SIGNALLED = 128  # plus the number of the signal, as in shells
app = typer.Typer(
    help="Film and electric field of lubricated contacts.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"ehlectric {__version__}")
        raise typer.Exit


@app.callback()
def _main(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    pass


app.command()(run)
app.command()(check)
app.command()(surface)
app.command()(init)
app.command()(plot)
app.command()(reproduce)
app.command()(bearing)
app.command()(sweep)
app.command("map")(draw_maps)
app.command()(animate)
app.command()(sensitivity)


def _stop(number: int, _: object) -> None:
    # SystemExit runs every finally clause, so that no half-written file is left.
    sys.exit(SIGNALLED + number)


def _status() -> int:
    """Run the command and return its exit status; wrong arguments are told in one line."""
    try:
        status = app(standalone_mode=False)
        sys.stdout.flush()
    except (KeyboardInterrupt, typer.Abort):
        return SIGNALLED + signal.SIGINT
    except OSError as error:
        # Nothing can be printed any more, also not by the interpreter at its exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            reason = (error.strerror or str(error)).lower()
            typer.echo(f"error: standard output: cannot be written to, {reason}", err=True)
        return WRONG_INPUT
    except Exception as error:
        message = getattr(error, "format_message", None)
        if message is None:
            raise
        # Without a command the help has been printed, and the error has no message.
        typer.echo(f"error: {message() or 'no command; they are listed above'}", err=True)
        return WRONG_INPUT
    return int(status or 0)


def main() -> None:
    """Entry point of the ``ehlectric`` command."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _stop)
    for stream in (sys.stdout, sys.stderr):
        # A terminal without a micro sign must not end the run.
        stream.reconfigure(errors="replace")  # type: ignore[union-attr]
    sys.exit(_status())
