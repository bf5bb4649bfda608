"""The commands run and plot."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.motion import plot_moving, run_moving
from ehlectric.commands.options import CaseFile, Json, Quiet
from ehlectric.commands.terminal import NOT_CONVERGED, print_table, progress_line, user_errors, warn
from ehlectric.errors import InputError, shown


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
        from ehlectric.cases.case import Case

        # Before all that solving takes: what is wrong with a case is said at once.
        case = Case.from_toml(case_file)

        from ehlectric.commands.check import check_motion
        from ehlectric.contact.check import check_case
        from ehlectric.contact.files import FILES, save
        from ehlectric.contact.solver import solve
        from ehlectric.figures.names import ALL_FIGURES, MOTION_FIGURE_FILES
        from ehlectric.motion.record import MOTION
        from ehlectric.paper.solvers import SOLVERS
        from ehlectric.runtime.files import clear, prepare

        if solver not in SOLVERS:
            raise InputError("--solver", got=shown(solver), takes=f"one of {', '.join(SOLVERS)}")
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
                from ehlectric.figures.contact.save import save_figures

                stage("drawing figures")
                files += save_figures(result, folder)
    if as_json:
        typer.echo(json.dumps(result.summary(), indent=2))
    elif not quiet:
        from ehlectric.commands.tables.contact import result_table
        from ehlectric.commands.tables.surface import surface_table

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
        from ehlectric.contact.files import load
        from ehlectric.figures.names import ALL_FIGURES
        from ehlectric.motion.record import MOTION
        from ehlectric.runtime.files import prepare

        if result_file.name == MOTION:
            plot_moving(result_file, result_file.parent if output is None else output, quiet=quiet)
            return
        result = load(result_file)
        folder = prepare(result_file.parent if output is None else output, ALL_FIGURES)
        from ehlectric.figures.contact.save import save_figures

        files = save_figures(result, folder)
    if not quiet:
        typer.echo("written: " + ", ".join(str(path) for path in files))
        warn(result.warnings)
