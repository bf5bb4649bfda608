"""The command that simulates a drive."""

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


def drive(
    drive_file: Annotated[Path, file_argument("FILE", "Drive file, in TOML.", ".toml")],
    output: Output = Path("drive"),
    contacts: Annotated[
        str,
        typer.Option(
            metavar="HOW",
            help="Solve the contacts of both bearings (solved), or take films at once from the atlas (atlas) "
            "or a formula (formula). Without this option the files decide.",
            show_default=False,
            autocompletion=one_of("solved", "atlas", "formula"),
        ),
    ] = "",
    plots: Plots = True,
    formats: Formats = None,
    style: Style = "screen",
    quiet: Quiet = False,
    as_json: Json = False,
) -> None:
    """Simulate inverter, motor and both bearings over time; write tables, drive.nc and figures.

    The files are summary.json, events.csv with the discharges, spectrum.csv with the amplitudes of the shaft
    voltage over the frequency, drive.nc for ehlectric plot, and figures of the bearing voltage, its spectrum,
    the discharges of each bearing with their voltage, charge, energy and current, and the same for each
    remedy of the file.

    The folder then holds this result alone: files of an earlier result are removed, other files stay. A
    folder with a sweep or with moving roughness is refused.

    Exit status 0: solved. 2: the input is wrong. 3: a contact is not converged, all files are still
    written; or memory ran out, or the process of a contact was killed four times.
    """
    with user_errors():
        look = figure_options(formats, style)

        from ehlectric.runs import by_kind
        from ehlectric.runs.kinds import expect

        expect(drive_file, "drive")
        case = by_kind.read_drive(drive_file)
        with progress_bar(shown=not quiet) as progress:
            outcome = by_kind.run_and_draw(
                "drive", case, output, progress, draw=plots, contacts=contacts, **look
            )
    report(outcome, _tables, quiet=quiet, as_json=as_json)


def _tables(outcome: RunOutcome[object]) -> Iterator[Table]:
    """Tables of a drive: its simulation, both bearings side by side, and its remedies."""
    from ehlectric.tables.drive import ends_table, remedies_table, whole_rows
    from ehlectric.tables.layout import table_of

    yield table_of(whole_rows(outcome.summary))
    yield ends_table(outcome.summary)
    if outcome.summary["remedies"]:
        yield remedies_table(outcome.summary)
