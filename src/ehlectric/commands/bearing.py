"""The command that solves a bearing, and the one that lists those of the library."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.options import (
    Background,
    Formats,
    Json,
    Measured,
    Output,
    Plots,
    Quiet,
    Style,
    Uncertainty,
    figure_options,
    file_argument,
    one_of,
)
from ehlectric.commands.terminal import print_table, progress_bar, report, say, user_errors

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.runtime.outcome import RunOutcome


def bearings(as_json: Json = False) -> None:
    """List the bearings of the library, which a bearing file uses as base = "NAME".

    The elements are their number, diameter and length. They are "published", or follow "by rule" from both
    load ratings, or are "assumed". C and C0 are the load ratings that a maker prints.
    """
    with user_errors():
        from ehlectric.cases.library.bearing_catalogue import bearing_catalogue
        from ehlectric.tables.catalogue import catalogue_tables, described

        found = bearing_catalogue()
        if as_json:
            typer.echo(json.dumps([described(bearing) for bearing in found], indent=2))
            return
        for table in catalogue_tables(found):
            print_table(table)
            say("")
        say('in a bearing file: base = "6208"; the sources of all values are in the guide')


def bearing(
    bearing_file: Annotated[Path, file_argument("FILE", "Bearing file, in TOML.", ".toml")],
    output: Output = Path("bearing"),
    contacts: Annotated[
        str,
        typer.Option(
            metavar="HOW",
            help="Solve the contacts (solved), or take films at once from the atlas (atlas) or a formula "
            "(formula). Without this option the file decides.",
            show_default=False,
            autocompletion=one_of("solved", "atlas", "formula"),
        ),
    ] = "",
    measured: Measured = None,
    background: Background = None,
    uncertainty: Uncertainty = None,
    plots: Plots = True,
    formats: Formats = None,
    style: Style = "screen",
    quiet: Quiet = False,
    as_json: Json = False,
) -> None:
    """Solve a whole rolling bearing; write summary.json, bearing.nc, tables as CSV and figures.

    With --measured, capacitances over the speed give the film factor that explains them: in measured.json,
    measured.csv and a figure.

    The folder then holds this result alone: files of an earlier result are removed, other files stay. A
    folder with a sweep or with moving roughness is refused.

    Exit status 0: solved. 2: the input is wrong. 3: a contact is not converged, all files are still
    written; or memory ran out, or the process of a contact was killed four times.
    """
    with user_errors():
        look = figure_options(formats, style)

        from ehlectric.runs import by_kind
        from ehlectric.runs.film_factors import MeasuredFile
        from ehlectric.runs.kinds import expect

        expect(bearing_file, "bearing")
        case = by_kind.read_bearing(bearing_file)
        data = MeasuredFile.of(measured, background, uncertainty)
        with progress_bar(shown=not quiet) as progress:
            outcome = by_kind.run_and_draw(
                "bearing", case, output, progress, draw=plots, contacts=contacts, measured=data, **look
            )
    report(outcome, _tables, quiet=quiet, as_json=as_json)


def _tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Tables of a bearing: loads, films and totals."""
    from ehlectric.tables.bearing import films_table, loads_table, total_rows
    from ehlectric.tables.layout import table_of
    from ehlectric.tables.measured import measured_tables

    summary = outcome.summary
    yield loads_table(summary)
    yield films_table(summary)
    yield table_of(total_rows(summary), summary["title"])
    yield from measured_tables(outcome)
