"""The commands run and plot."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.motion import tell_where_it_stops
from ehlectric.commands.options import (
    CaseFile,
    Formats,
    Json,
    Measured,
    Output,
    Plots,
    Quiet,
    ResultFile,
    Style,
    Uncertainty,
    figure_options,
    one_of,
)
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
    output: Output = Path("results"),
    plots: Plots = True,
    formats: Formats = None,
    style: Style = "screen",
    solver: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Solve with ehlectric, or with paper, the multigrid and over-relaxation of the paper.",
            autocompletion=one_of("ehlectric", "paper"),
        ),
    ] = "ehlectric",
    measured: Measured = None,
    uncertainty: Uncertainty = None,
    quiet: Quiet = False,
    as_json: Json = False,
) -> None:
    """Solve a contact; write summary.json, result.nc, film.csv and figures.

    With --measured, film thicknesses over the entrainment speed give the film factor that explains them: in
    measured.json, measured.csv and a figure.

    A case with [motion] writes summary.json, motion.nc and figures. If it is interrupted, run the same
    command to resume it.

    The folder then holds this result alone: files of an earlier result are removed, other files stay. A
    folder with a sweep, or with moving roughness of another case, is refused.

    Exit status 0: solved. 2: the input is wrong. 3: not converged, all files are still written; or memory
    ran out.
    """
    with user_errors():
        look = figure_options(formats, style)

        from ehlectric.runs import by_kind
        from ehlectric.runs.film_factors import MeasuredFile
        from ehlectric.runs.kinds import expect

        kind = expect(case_file, "contact", "motion")
        case = by_kind.read_case(case_file)
        data = MeasuredFile.of(measured, None, uncertainty)
        solve = partial(
            by_kind.run_and_draw, kind, case, output, draw=plots, solver=solver, measured=data, **look
        )
        if kind == "contact":
            if not quiet:
                warn(by_kind.expected_warnings(case))
            with progress_line(shown=not quiet) as progress:
                outcome = solve(progress)
        else:
            with progress_bar(shown=not quiet) as bar, tell_where_it_stops(output, bar) as progress:
                outcome = solve(progress)
    tables = _tables if kind == "contact" else _transient_tables
    report(outcome, tables, quiet=quiet, as_json=as_json)


def _tables(outcome: RunOutcome[Result | PointResult]) -> Iterator[Table]:
    """Tables of a stationary contact: its rough surfaces and its key figures."""
    from ehlectric.tables.contact import result_rows
    from ehlectric.tables.layout import table_of
    from ehlectric.tables.measured import measured_tables
    from ehlectric.tables.surface import surface_table

    for rough in outcome.result.rough:
        if rough["steps"]:
            yield surface_table(rough)
    yield table_of(result_rows(outcome.result), outcome.result.case.title)
    yield from measured_tables(outcome)


def _transient_tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Table of a transient contact."""
    from ehlectric.tables.layout import table_of
    from ehlectric.tables.motion import run_rows

    yield table_of(run_rows(outcome.summary), outcome.summary["title"])


def plot(
    result: ResultFile,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="DIR", help="Write the figures into this folder, not beside the result."
        ),
    ] = None,
    formats: Formats = None,
    style: Style = "screen",
    quiet: Quiet = False,
) -> None:
    """Draw the figures of a result again.

    The result of a contact, of moving roughness, of a bearing, of a drive or of a sweep. A sweep over one or
    two keys is drawn as a map and lines, and a Sobol design as its sensitivity; for other sweeps use
    ehlectric map.
    """
    with user_errors():
        look = figure_options(formats, style)

        from ehlectric.commands.drawing import load_and_draw
        from ehlectric.runs.folders import stored_result
        from ehlectric.runs.kinds import refuse_input

        refuse_input(result)
        file = stored_result(result)
        files, warnings = load_and_draw(file, file.parent if output is None else output, **look)
    if not quiet:
        echo_files(files)
        warn(warnings)
