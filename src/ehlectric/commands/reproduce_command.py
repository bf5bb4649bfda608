"""The reproduce command."""

from __future__ import annotations

from pathlib import Path

import typer

from ehlectric.commands.options import command, figure_options
from ehlectric.commands.terminal import (
    NOT_CONVERGED,
    echo_files,
    in_natural_order,
    print_table,
    progress_bar,
    refuse_undrawn,
    say,
    user_errors,
)
from ehlectric.errors import InputError, shown
from ehlectric.runtime.undrawn import collected


@command("reproduce")
def reproduce(
    words: list[str] | None = None,
    output: Path = Path("reproduced"),
    figure: str | None = None,
    table: str | None = None,
    formats: list[str] | None = None,
    style: str = "screen",
    quiet: bool = False,
) -> None:
    """Reproduce the paper: its contacts, tables and figures, with a report.

    The paper is Morris, Leighton and Morris, Lubricants 10 (2022) 87. The report is reproduced/report.html.
    """
    with user_errors():
        if words:
            raise InputError(words[0], "is no option", takes=_meant(words))
        from ehlectric.paper.reproduce import reproduce as reproduced

        look = figure_options(formats, style)
        with progress_bar(shown=not quiet) as progress, collected() as undrawn:
            made = reproduced(
                output,
                figure=_number("figure", figure),
                table=_number("table", table),
                progress=progress,
                **look,
            )
    if not quiet:
        for name, text in made.verdicts.items():
            typer.echo(f"{name.replace('_', ' ').capitalize()}: {text}")
        if not made.verdicts and "table_3" in made.tables:
            from ehlectric.paper.paper_tables import films_tables

            for films in films_tables(made.tables["table_3"]):
                print_table(films)
        echo_files(in_natural_order(made.files))
    try:
        refuse_undrawn(undrawn)
    finally:
        if not made.converged:
            say("error: not converged: some films of the study", err=True)
            raise typer.Exit(NOT_CONVERGED)


def _meant(words: list[str]) -> str:
    """Option that words on the command line mean, such as "table3" or "figure 5"."""
    text = "".join(words).lower()
    number = "".join(letter for letter in text if letter.isdigit())
    name = "--table" if text.startswith("tab") else "--figure"
    if number and text.startswith(("tab", "fig")):
        return f"{name} {number}"
    return "--figure NUMBER, --table NUMBER, or no word for the whole paper"


def _number(name: str, text: str | None) -> int | None:
    """Number of the option of a name; None where it is not given."""
    try:
        return None if text is None else int(text)
    except ValueError:
        raise InputError(f"--{name}", got=shown(text), takes="a number") from None
