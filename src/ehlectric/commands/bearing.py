"""The bearing command."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.options import (
    Formats,
    Json,
    Output,
    Plots,
    Quiet,
    Style,
    figure_options,
    file_argument,
    one_of,
)
from ehlectric.commands.terminal import progress_bar, report, user_errors

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.runtime.outcome import RunOutcome


def bearing(
    bearing_file: Annotated[Path, file_argument("FILE", "Bearing file, in TOML.", ".toml")],
    output: Output = Path("bearing"),
    contacts: Annotated[
        str,
        typer.Option(
            metavar="HOW",
            help="Solve the contacts (solved), or take films from a formula at once (formula). Without this "
            "option the file decides.",
            show_default=False,
            autocompletion=one_of("solved", "formula"),
        ),
    ] = "",
    plots: Plots = True,
    formats: Formats = None,
    style: Style = "screen",
    quiet: Quiet = False,
    as_json: Json = False,
) -> None:
    """Solve a whole rolling bearing; write summary.json, bearing.nc, tables as CSV and figures.

    The folder then holds this result alone: files of an earlier result are removed, other files stay. A
    folder with a sweep or with moving roughness is refused.

    Exit status 0: solved. 2: the input is wrong. 3: a contact is not converged, all files are still
    written; or memory ran out, or the process of a contact was killed twice.
    """
    with user_errors():
        look = figure_options(formats, style)

        from ehlectric.commands import runs
        from ehlectric.commands.kinds import expect

        expect(bearing_file, "bearing")
        case = runs.read_bearing(bearing_file)
        with progress_bar(shown=not quiet) as progress:
            outcome = runs.run_and_draw(
                "bearing", case, output, progress, draw=plots, contacts=contacts, **look
            )
    report(outcome, _tables, quiet=quiet, as_json=as_json)


def _tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Tables of a bearing: loads, films and totals."""
    from ehlectric.commands.tables.bearing import films_table, loads_table, total_rows
    from ehlectric.commands.tables.layout import table_of

    summary = outcome.summary
    yield loads_table(summary)
    yield films_table(summary)
    yield table_of(total_rows(summary), summary["title"])
