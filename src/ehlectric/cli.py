"""The command line: what each command takes, and what it hands on to."""

from __future__ import annotations

import json
import os
import signal
import sys
from importlib import resources
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.bearing_commands import bearing
from ehlectric.errors import InputError, shown
from ehlectric.map_commands import draw_maps, sensitivity
from ehlectric.motion_commands import animate, plot_moving, run_moving
from ehlectric.sweep_commands import sweep
from ehlectric.terminal import (
    NOT_CONVERGED,
    WRONG_INPUT,
    print_table,
    progress_bar,
    progress_line,
    user_errors,
    warn,
)
from ehlectric.version import __version__

_TEMPLATES = {"line": "template.toml", "point": "template_point.toml"}
SIGNALLED = 128  # plus the number of the signal, as shells count

app = typer.Typer(
    help="Film and electric field of lubricated contacts.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

CaseFile = Annotated[Path, typer.Argument(help="Case file, TOML.", show_default=False)]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No table, progress or warnings.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")]


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


def run(
    case_file: CaseFile,
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="DIR", help="Folder for the results.")
    ] = Path("results"),
    plots: Annotated[bool, typer.Option("--plots/--no-plots", help="Draw the figures.")] = True,
    solver: Annotated[
        str, typer.Option(metavar="NAME", help="ehlectric, or paper: its multigrid and over-relaxation.")
    ] = "ehlectric",
    quiet: Quiet = False,
    as_json: Json = False,
) -> None:
    """Solve a case; write summary.json, result.nc, film.csv and figures.

    With [motion]: summary.json, motion.nc as it goes, and figures. Stopped, the same command goes on.

    Exit status 0: solved. 2: the input is wrong. 3: not converged, everything is written all the same.
    """
    with user_errors():
        from ehlectric.case import Case

        # Before all that solving takes: what is wrong with a case is said at once.
        case = Case.from_toml(case_file)

        from ehlectric.meaning import check_case, check_motion
        from ehlectric.motion_store import MOTION
        from ehlectric.paper.solvers import SOLVERS
        from ehlectric.solver import solve
        from ehlectric.store import ALL_FIGURES, FILES, MOTION_FIGURE_FILES, clear, prepare, save

        if solver not in SOLVERS:
            raise InputError(f"--solver: got {shown(solver)}, takes one of {', '.join(SOLVERS)}")
        check_case(case)
        check_motion(case)
        SOLVERS[solver].check(case)
        if case.motion is not None:
            run_moving(case, output, solver=solver, plots=plots, quiet=quiet, as_json=as_json)
            return
        names = (*FILES, *ALL_FIGURES)
        folder = prepare(output, names)
        with progress_line(shown=not quiet) as stage:
            result = solve(
                case,
                progress=lambda nodes, step, residual: stage(
                    f"film: {nodes} nodes, step {step + 1}, residual {residual:.1e}"
                ),
                solvers=SOLVERS[solver],
            )
            stage("writing results")
            clear(folder, (*names, MOTION, *MOTION_FIGURE_FILES))
            files = save(result, folder)
            if plots:
                from ehlectric.figures import save_figures

                stage("drawing figures")
                files += save_figures(result, folder)
    if as_json:
        typer.echo(json.dumps(result.summary(), indent=2))
    elif not quiet:
        from ehlectric.meaning import result_table
        from ehlectric.report import surface_table

        for rough in result.rough:
            if rough["steps"]:
                print_table(surface_table(rough))
        print_table(result_table(result))
        typer.echo("written: " + ", ".join(str(path) for path in files))
    if not quiet:
        warn(result.warnings)
    if not result.converged:
        typer.echo(f"error: not converged: {result.film.status}", err=True)
        raise typer.Exit(NOT_CONVERGED)


def check(case_file: CaseFile, quiet: Quiet = False, as_json: Json = False) -> None:
    """Validate a case and say what it means: Hertz contact, groups, regime, film formulas."""
    with user_errors():
        from ehlectric.case import Case

        case = Case.from_toml(case_file)

        from ehlectric.meaning import meaning

        table, summary, texts = meaning(case)
    if as_json:
        typer.echo(json.dumps(summary, indent=2))
    elif not quiet:
        print_table(table)
    if not quiet:
        warn(texts)


def surface(
    file: Annotated[Path, typer.Argument(help="File of an instrument.", show_default=False)],
    x_unit: Annotated[str | None, typer.Option(help="Where the file does not say.")] = None,
    z_unit: Annotated[str | None, typer.Option(help="Where the file does not say.")] = None,
    line: Annotated[int | None, typer.Option(help="Line of a map, from 0; 0 if not given.")] = None,
    along: Annotated[str, typer.Option(help="row or column.")] = "row",
    whole: Annotated[
        bool, typer.Option("--map", help="The whole map, as point contacts use it, not one line of it.")
    ] = False,
    form: Annotated[str, typer.Option(help="none, mean, line or parabola.")] = "none",
    cutoff_long: Annotated[str | None, typer.Option(help="Removes longer waves.")] = None,
    cutoff_short: Annotated[str | None, typer.Option(help="Removes shorter waves.")] = None,
    trim: Annotated[str | None, typer.Option(help="Taken off each end.")] = None,
    rescale_rq: Annotated[str | None, typer.Option(help="Rq to scale to.")] = None,
    truncate: Annotated[str | None, typer.Option(help="Height to cut at.")] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="PNG", help="Draw the profile or map.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Show what a file holds and what each step does to it: the keys of a case's roughness as options.

    Lengths carry their unit, as in --cutoff-long "80 um".
    """
    table = {
        "x_unit": x_unit, "z_unit": z_unit, "line": line, "along": along, "form": form,
        "cutoff_long": cutoff_long, "cutoff_short": cutoff_short, "trim": trim,
        "rescale_rq": rescale_rq, "truncate": truncate,
    }  # fmt: skip
    with user_errors():
        from ehlectric.report import surface_table
        from ehlectric.rough_maps import whole_map
        from ehlectric.roughness_inputs import Roughness
        from ehlectric.store import prepare
        from ehlectric.walls import measured

        given = {key: value for key, value in table.items() if value is not None}
        asked = Roughness.from_dict({"surface": 1, "file": str(file)} | given)
        rough = whole_map(asked) if whole else measured(asked)
        if output is not None:
            prepare(output.parent, [output.name])
            from ehlectric.surface_plot import save_surface

            save_surface(rough.steps, output)
    described = rough.describe()
    if as_json:
        typer.echo(json.dumps(described, indent=2))
    else:
        print_table(surface_table(described))
        warn(rough.remarks)
        if output is not None:
            typer.echo(f"written: {output}")


def init(
    path: Annotated[Path, typer.Argument(help="File to write.")] = Path("case.toml"),
    geometry: Annotated[str, typer.Option(metavar="NAME", help="Of the contact: line or point.")] = "line",
    force: Annotated[bool, typer.Option("--force", help="Overwrite a file.")] = False,
    quiet: Quiet = False,
) -> None:
    """Write a commented case to start from."""
    with user_errors():
        from ehlectric.store import prepare, refuse_special, whole

        if geometry not in _TEMPLATES:
            raise InputError(f"--geometry: got {shown(geometry)}, takes one of {', '.join(_TEMPLATES)}")
        refuse_special(path)
        if path.exists() and not force:
            raise InputError(f"{path}: is there already, takes a new file or --force")
        prepare(path.parent)
        template = resources.files("ehlectric.library") / _TEMPLATES[geometry]
        with whole(path) as beside:
            beside.write_text(template.read_text(encoding="utf-8"), encoding="utf-8")
    if not quiet:
        typer.echo(f"written: {path}; solve it with: ehlectric run {path}")


def plot(
    result_file: Annotated[Path, typer.Argument(help="A result.nc, or a motion.nc.", show_default=False)],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="DIR", help="Folder, default that of the file."),
    ] = None,
    quiet: Quiet = False,
) -> None:
    """Draw the figures of a result again."""
    with user_errors():
        from ehlectric.motion_store import MOTION
        from ehlectric.store import ALL_FIGURES, load, prepare

        if result_file.name == MOTION:
            plot_moving(result_file, result_file.parent if output is None else output, quiet=quiet)
            return
        result = load(result_file)
        folder = prepare(result_file.parent if output is None else output, ALL_FIGURES)
        from ehlectric.figures import save_figures

        files = save_figures(result, folder)
    if not quiet:
        typer.echo("written: " + ", ".join(str(path) for path in files))
        warn(result.warnings)


def reproduce(
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="DIR", help="Folder for the results.")
    ] = Path("reproduced"),
    figure: Annotated[str | None, typer.Option(metavar="NUMBER", help="Only this figure, 2 to 11.")] = None,
    table: Annotated[str | None, typer.Option(metavar="NUMBER", help="Only this table, 3.")] = None,
    quiet: Quiet = False,
) -> None:
    """Solve the contacts of Morris, Leighton and Morris (2022); write tables, figures and a report."""
    with user_errors():
        from ehlectric.paper.reproduce import reproduce as reproduced

        with progress_bar(shown=not quiet) as progress:
            made = reproduced(
                output, figure=_number("figure", figure), table=_number("table", table), progress=progress
            )
    if not quiet:
        for name, text in made.verdicts.items():
            typer.echo(f"{name.replace('_', ' ').capitalize()}: {text}")
        for path in made.files:
            typer.echo(f"written: {path}")
    if not made.converged:
        typer.echo("error: not converged: some films of the study", err=True)
        raise typer.Exit(NOT_CONVERGED)


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


def _number(name: str, text: str | None) -> int | None:
    try:
        return None if text is None else int(text)
    except ValueError:
        raise InputError(f"--{name}: got {shown(text)}, takes a number") from None


def _stop(number: int, _: object) -> None:
    # Leaves through every finally, so that no half-written file stays behind.
    sys.exit(SIGNALLED + number)


def _status() -> int:
    """Run the command; wrong words on the command line are one line too."""
    try:
        status = app(standalone_mode=False)
        sys.stdout.flush()
    except (KeyboardInterrupt, typer.Abort):
        return SIGNALLED + signal.SIGINT
    except OSError as error:
        # Nothing can be printed any more, not even what the interpreter still holds at its exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            reason = (error.strerror or str(error)).lower()
            typer.echo(f"error: standard output: cannot be written to, {reason}", err=True)
        return WRONG_INPUT
    except Exception as error:
        message = getattr(error, "format_message", None)
        if message is None:
            raise
        # Without a command the help has been printed, and there is nothing to say.
        typer.echo(f"error: {message() or 'no command; they are listed above'}", err=True)
        return WRONG_INPUT
    return int(status or 0)


def main() -> None:
    """Entry point of the ``ehlectric`` command."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _stop)
    for stream in (sys.stdout, sys.stderr):
        # A terminal that knows no micro sign must not end the run.
        stream.reconfigure(errors="replace")  # type: ignore[union-attr]
    sys.exit(_status())
