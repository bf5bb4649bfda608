"""The application: all commands, and the exit status of the command line."""

from __future__ import annotations

import logging
import os
import signal
import sys
from typing import Annotated

import typer

from ehlectric.commands.animate_command import animate
from ehlectric.commands.film_command import film
from ehlectric.commands.netlist_command import spice
from ehlectric.commands.oil_commands import oil, oils
from ehlectric.commands.reproduce_command import reproduce
from ehlectric.commands.serve import app as serve_app
from ehlectric.commands.solve_commands import bearing, bearings, check, drive, plot, run
from ehlectric.commands.start_commands import examples, init
from ehlectric.commands.surface_command import surface
from ehlectric.commands.sweep_commands import draw_maps, sensitivity, sweep
from ehlectric.commands.terminal import NOT_CONVERGED, WRONG_INPUT, say
from ehlectric.commands.write_commands import export, report, schema
from ehlectric.errors import InputError
from ehlectric.runtime.locks import not_ignored
from ehlectric.runtime.memory import is_out_of_memory, out_of_memory
from ehlectric.runtime.progress import MACHINE
from ehlectric.version import __version__

SIGNALLED = 128  # plus the number of the signal, as in shells

_EXAMPLES = """\b
Examples:
  ehlectric init bearing.toml --kind bearing      write a bearing to start from
  ehlectric check bearing.toml                    what it means, unsolved, at once
  ehlectric bearing bearing.toml -o results       solve it; does it spark?
  ehlectric init case.toml                        a single contact
  ehlectric run case.toml -o contact              solve it, with tables and figures
  ehlectric COMMAND --help                        options of a command
"""

# Commands in the order in which a user needs them: name, function, line in the list, and examples.
_COMMANDS = (
    ("init", init, "Write a commented file to start from.", ("init bearing.toml --kind bearing",)),
    ("examples", examples, "List or copy the examples.", ("examples", "examples bearing_6208 -o trial")),
    ("check", check, "Check a file without solving it.", ("check bearing.toml", "check sweep.toml --json")),
    (
        "schema",
        schema,
        "Print the JSON Schema of a kind of file.",
        ("schema bearing -o bearing.schema.json",),
    ),
    ("run", run, "Solve a contact.", ("run case.toml -o results", "run case.toml --format pdf --format svg")),
    ("bearing", bearing, "Solve a whole rolling bearing.", ("bearing bearing.toml --contacts atlas",)),
    (
        "drive",
        drive,
        "Simulate the discharges of both bearings of a motor.",
        ("drive drive.toml -o results", "drive drive.toml --contacts atlas --json"),
    ),
    (
        "spice",
        spice,
        "Write a bearing, or a drive, as a netlist.",
        (
            "spice bearing.toml -o bearing.lib",
            'spice bearing.toml --arc-resistance "1 ohm" --extinction-voltage "1 V" --bench bench.cir',
            'spice bearing.toml --contacts atlas --speeds "500 rpm : 3000 rpm : 7"',
            "spice drive.toml -o bearings.lib --bench bench.cir",
        ),
    ),
    ("bearings", bearings, "List the bearings of the library.", ("bearings", "bearings --json")),
    (
        "film",
        film,
        "Film of a contact, at once.",
        (
            "film --m 200 --l 10 --k 1",
            (
                'film --oil fva-3 --temperature "70 degC" --radius "8 mm" --modulus "226 GPa"'
                ' --load "100 kN/m" --speed "4 m/s"'
            ),
        ),
    ),
    ("oils", oils, "List the oils of the library.", ("oils", "oils --json")),
    (
        "oil",
        oil,
        "Show all that is known of an oil.",
        ("oil fva-3", 'oil fva-3 --temperature "90 degC" --pressure "1 GPa" -o fva-3', "oil bearing.toml"),
    ),
    ("sweep", sweep, "Solve a case over varied inputs.", ("sweep sweep.toml -o sweep --plots",)),
    (
        "map",
        draw_maps,
        "Draw a sweep as map and lines.",
        (
            "map sweep --x bearing.inner_speed",
            'map sweep --x bearing.inner_speed --at "bearing.temperature=70 degC"',
        ),
    ),
    ("sensitivity", sensitivity, "Rank the inputs of a Sobol design.", ("sensitivity uncertainty",)),
    ("plot", plot, "Draw the figures of a result again.", ("plot results --style journal --format pdf",)),
    (
        "report",
        report,
        "Write the report of a result.",
        ("report results", "report bearing -o bearing_6208.pdf"),
    ),
    (
        "export",
        export,
        "Write a result for MATLAB, spreadsheets or ParaView.",
        ("export results -o film.mat", "export bearing -o bearing.xlsx", "export results -o film.vtkhdf"),
    ),
    ("animate", animate, "Animate a moving-roughness run.", ("animate results -o moving.gif",)),
    (
        "surface",
        surface,
        "Show a measured surface.",
        ('surface profile.csv --form line --cutoff-long "80 um"',),
    ),
    ("app", serve_app, "Open the web app.", ("app", "app --port 8100 --no-browser")),
    ("reproduce", reproduce, "Reproduce the paper.", ("reproduce", "reproduce --figure 7")),
)

app = typer.Typer(
    help="Film and electric field of lubricated contacts, and breakdown of the film in bearings.",
    epilog=_EXAMPLES,
    invoke_without_command=True,
    rich_markup_mode=None,  # it would take [motion] in a help text for a style
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)


def _version(wanted: bool) -> None:
    if wanted:
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


for _name, _function, _short, _lines in _COMMANDS:
    _typed = "\n".join(f"  ehlectric {line}" for line in _lines)
    app.command(_name, short_help=_short, epilog=f"\b\nExamples:\n{_typed}")(_function)


def _stop(number: int, _: object) -> None:
    # SystemExit runs every finally clause, so that no half-written file is left.
    sys.exit(SIGNALLED + number)


def _status() -> int:
    """Run the command and return its exit status; wrong arguments are told in one line."""
    try:
        status = app(prog_name="ehlectric", standalone_mode=False)
        sys.stdout.flush()
    except (KeyboardInterrupt, typer.Abort):
        return SIGNALLED + signal.SIGINT
    except Exception as error:
        return _failed(error)
    return int(status or 0)


def _failed(error: Exception) -> int:
    """Exit status of an error that no command tells, with its line; another error is raised again."""
    if is_out_of_memory(error):
        # What ran out before anything was solved is told by the commands.
        typer.echo(f"error: {out_of_memory(error)}", err=True)
        return NOT_CONVERGED
    if isinstance(error, OSError):
        # Nothing can be printed any more, also not by the interpreter at its exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            reason = (error.strerror or str(error)).lower()
            typer.echo(f"error: standard output: cannot be written to, {reason}", err=True)
        return WRONG_INPUT
    message = getattr(error, "format_message", None)
    if message is None:
        raise error
    # Its text is one line, with what the user typed escaped.
    typer.echo(f"error: {InputError(message())}", err=True)
    return WRONG_INPUT


class _OneLine(logging.Handler):
    """Handler that prints what the machine lacks as one line on stderr."""

    def emit(self, record: logging.LogRecord) -> None:
        """Print a message."""
        say(f"note: {record.getMessage()}", err=True)


def main() -> None:
    """Entry point of the ``ehlectric`` command."""
    for number in not_ignored():
        if number != signal.SIGINT:  # Python raises KeyboardInterrupt.
            signal.signal(number, _stop)
    for stream in (sys.stdout, sys.stderr):
        # A terminal without a micro sign must not end the run.
        stream.reconfigure(errors="replace")  # type: ignore[union-attr]
    handler = _OneLine(logging.WARNING)
    MACHINE.addHandler(handler)
    status = _status()
    MACHINE.removeHandler(handler)
    for number in not_ignored():
        # From here on Python would answer a signal, such as that of an impatient user, by a traceback.
        signal.signal(number, signal.SIG_DFL)
    sys.exit(status)
