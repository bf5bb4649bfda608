"""The bearing command."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.tables.bearing import bearing_table, films_table, loads_table
from ehlectric.commands.terminal import NOT_CONVERGED, print_table, progress_bar, user_errors, warn

if TYPE_CHECKING:
    from ehlectric.errors import ResultWarning


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
        from ehlectric.cases.bearing_case import BearingCase

        case = BearingCase.from_toml(bearing_file)
        if contacts:
            case = case.replace({"contacts": contacts})

        from ehlectric.bearing.files import FILES, save
        from ehlectric.bearing.solver import check_bearing, solve_bearing
        from ehlectric.figures.names import BEARING_FIGURE_FILES, SPEED_FIGURE_FILES
        from ehlectric.runtime.files import clear, prepare

        check_bearing(case)
        names = (*FILES, *BEARING_FIGURE_FILES, *SPEED_FIGURE_FILES)
        folder = prepare(output, names)
        with progress_bar(shown=not quiet) as progress:
            result = solve_bearing(case, progress=progress)
        summary = result.summary()
        clear(folder, names)
        files = save(result, folder)
        left_out: list[ResultWarning] = []
        if plots:
            from ehlectric.bearing.speeds import over_speed
            from ehlectric.figures.bearing.save import save_bearing_figures, save_speed_figures

            files += save_bearing_figures(result, folder)
            speeds, left_out = over_speed(case)
            own = case.bearing.inner_speed, summary
            files += save_speed_figures(speeds, folder, case.title, own=own) if speeds else []
    if as_json:
        typer.echo(json.dumps(summary, indent=2))
    elif not quiet:
        print_table(loads_table(summary))
        print_table(films_table(summary))
        print_table(bearing_table(summary))
        typer.echo("written: " + ", ".join(str(path) for path in files))
    if not quiet:
        warn([*summary["warnings"], *left_out])
    if not result.converged:
        typer.echo("error: not converged: a contact of the bearing", err=True)
        raise typer.Exit(NOT_CONVERGED)
