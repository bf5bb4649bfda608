"""The commands run and plot."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.motion import tell_where_it_stops
from ehlectric.commands.options import CaseFile, Json, Quiet
from ehlectric.commands.terminal import (
    echo_files,
    progress_bar,
    progress_line,
    report,
    user_errors,
    warn,
)

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.contact.results import PointResult, Result
    from ehlectric.runtime.outcome import RunOutcome


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
        from ehlectric.commands import runs

        case = runs.read_case(case_file)
        if case.motion is None:
            with progress_line(shown=not quiet) as progress:
                outcome = runs.run_and_draw("contact", case, output, progress, draw=plots, solver=solver)
        else:
            with progress_bar(shown=not quiet) as bar, tell_where_it_stops(output, bar) as progress:
                outcome = runs.run_and_draw("motion", case, output, progress, draw=plots, solver=solver)
    tables = _tables if case.motion is None else _transient_tables
    report(outcome, tables, quiet=quiet, as_json=as_json)


def _tables(outcome: RunOutcome[Result | PointResult]) -> Iterator[Table]:
    """Tables of a stationary contact: its rough surfaces and its key figures."""
    from ehlectric.commands.tables.contact import result_rows
    from ehlectric.commands.tables.layout import table_of
    from ehlectric.commands.tables.surface import surface_table

    for rough in outcome.result.rough:
        if rough["steps"]:
            yield surface_table(rough)
    yield table_of(result_rows(outcome.result), outcome.result.case.title)


def _transient_tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Table of a transient contact."""
    from ehlectric.commands.tables.layout import table_of
    from ehlectric.commands.tables.motion import run_rows

    yield table_of(run_rows(outcome.summary), outcome.summary["title"])


def plot(
    result_file: Annotated[
        Path, typer.Argument(help="A result.nc, bearing.nc or motion.nc.", show_default=False)
    ],
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", metavar="DIR", help="Folder, default that of the file."),
    ] = None,
    quiet: Quiet = False,
) -> None:
    """Draw the figures of a result again."""
    with user_errors():
        from ehlectric.commands.runs import load_and_draw

        files, warnings = load_and_draw(result_file, result_file.parent if output is None else output)
    if not quiet:
        echo_files(files)
        warn(warnings)
