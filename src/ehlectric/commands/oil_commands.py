"""The commands oils and oil: the list of the library's oils, and all that is known of one oil."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from ehlectric.commands.options import (
    Look,
    command,
    figure_options,
    files_ending,
)
from ehlectric.commands.terminal import echo_files, print_table, refuse_undrawn, say, user_errors, warn
from ehlectric.runtime.undrawn import Undrawn, kept_going

if TYPE_CHECKING:
    from ehlectric.cases.oil_report import OilReport


@command("oils")
def oils(as_json: bool = False) -> None:
    """List the oils of the library, with viscosity, coefficient, density and permittivity.

    Each name is a value of lubricant.base. A letter after a number marks the origin of the value. The last
    table names the keys that a case must give, because no source of them was found.
    """
    with user_errors():
        from ehlectric.runs.lookups import oils as library_oils
        from ehlectric.tables.oil_tables import LETTERS, listed_tables

        listed = library_oils()
    if as_json:
        typer.echo(json.dumps(listed, indent=2))
        return
    numbers, about = listed_tables(listed)
    print_table(numbers)
    say("kind of the weakest value behind a number:")
    # No value of an oil has the kind "by rule", which is one of bearings.
    kinds = (f"{letter} {kind}" for kind, letter in LETTERS.items() if kind != "by rule")
    say(", ".join(kinds))
    say("")
    print_table(about)
    say("all values of an oil with their sources: ehlectric oil NAME")


def _complete(incomplete: str) -> list[str]:
    """Names of oils and TOML files that begin with some letters."""
    from ehlectric.cases.library import lubricant_names

    names = [name for name in lubricant_names() if name.startswith(incomplete)]
    return names + files_ending(".toml")(incomplete)


@command("oil", name=_complete)
def oil(
    name: str,
    temperature: list[str] | None = None,
    pressure: list[str] | None = None,
    output: Path | None = None,
    plots: bool = True,
    formats: list[str] | None = None,
    style: str = "screen",
    quiet: bool = False,
    as_json: bool = False,
) -> None:
    """Show every property of an oil at temperature and pressure, with its law, its kind and its sources.

    What no source has is shown as missing, and nothing takes its place. A star marks a value beyond the range
    of its law. Without --output the tables are only printed.
    """
    with user_errors():
        look = figure_options(formats, style)

        from ehlectric.cases.oil_report import oil_report

        report = oil_report(name, temperature or (), pressure or ())
        files, undrawn = ([], []) if output is None else _write(report, output, look, draw=plots)
    if as_json:
        typer.echo(json.dumps(report.summary(), indent=2))
    elif not quiet:
        _print(report)
        if files:
            echo_files(files)
    if not quiet:
        warn(report.warnings)
    refuse_undrawn(undrawn)


def _print(report: OilReport) -> None:
    """Print the tables of an oil: values, laws with kinds, sources."""
    from ehlectric.tables.oil_tables import behind_table, heading, sources_table, values_table

    say(heading(report))
    for table in (values_table(report), behind_table(report), sources_table(report)):
        print_table(table)
        say("")
    if any(report.beyond(line, oil) for line in report.lines for oil in report.oils):
        say("* beyond the range of the law")
    for line in report.missing:
        say(line)


def _write(
    report: OilReport, folder: Path, look: Look, *, draw: bool
) -> tuple[Sequence[Path], Sequence[Undrawn]]:
    """Write the table of an oil as CSV, and its figures. Returns files, and figures that failed."""
    from ehlectric.figures.figure_names import OIL_FIGURE_FILES, in_formats
    from ehlectric.runtime.files import write
    from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
    from ehlectric.tables.oil_tables import CSV_FILE, csv_content

    names = [CSV_FILE, *(in_formats(OIL_FIGURE_FILES, look["formats"]) if draw else ())]
    with alone_in(folder, names, locks=[FIGURE_LOCK]):
        files = [folder / CSV_FILE]
        write(files[0], csv_content(report))
        with kept_going() as undrawn:
            if draw:
                from ehlectric.figures.oil_figures import save_oil
                from ehlectric.figures.style import style as styled

                with styled(look["style"]):
                    files += save_oil(report, folder, look["formats"])
    return files, undrawn
