"""The bearing command."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.terminal import progress_bar, report, user_errors

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.runtime.outcome import RunOutcome


def bearing(
    bearing_file: Annotated[Path, typer.Argument(help="Bearing file, TOML.", show_default=False)],
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="DIR", help="Folder for the results.")
    ] = Path("bearing"),
    contacts: Annotated[
        str,
        typer.Option(metavar="HOW", help="solved or formula, else as the file says.", show_default=False),
    ] = "",
    plots: Annotated[bool, typer.Option("--plots/--no-plots", help="Draw the figures.")] = True,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No table, progress or warnings.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON instead of a table.")] = False,
) -> None:
    """Solve a whole rolling bearing; write summary.json, tables as CSV and figures.

    Exit status 0: solved. 2: the input is wrong. 3: a contact is not converged, everything is written all the
    same.
    """
    with user_errors():
        from ehlectric.commands import runs

        case = runs.read_bearing(bearing_file)
        with progress_bar(shown=not quiet) as progress:
            outcome = runs.run_and_draw("bearing", case, output, progress, draw=plots, contacts=contacts)
    report(outcome, _tables, quiet=quiet, as_json=as_json)


def _tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Tables of a bearing: loads, films and totals."""
    from ehlectric.commands.tables.bearing import films_table, loads_table, total_rows
    from ehlectric.commands.tables.layout import table_of

    summary = outcome.summary
    yield loads_table(summary)
    yield films_table(summary)
    yield table_of(total_rows(summary), summary["title"])
