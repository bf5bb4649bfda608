"""The reproduce command."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.options import Quiet
from ehlectric.commands.terminal import NOT_CONVERGED, progress_bar, user_errors
from ehlectric.errors import InputError, shown


def reproduce(
    output: Annotated[
        Path, typer.Option("--output", "-o", metavar="DIR", help="Folder for the results.")
    ] = Path("reproduced"),
    figure: Annotated[str | None, typer.Option(metavar="NUMBER", help="Only this figure, 2 to 11.")] = None,
    table: Annotated[str | None, typer.Option(metavar="NUMBER", help="Only this table, 3.")] = None,
    quiet: Quiet = False,
) -> None:
    """Solve the contacts of Morris, Leighton and Morris (2022); write tables, figures and a report."""
    with user_errors():
        from ehlectric.paper.reproduce import reproduce as reproduced

        with progress_bar(shown=not quiet) as progress:
            made = reproduced(
                output, figure=_number("figure", figure), table=_number("table", table), progress=progress
            )
    if not quiet:
        for name, text in made.verdicts.items():
            typer.echo(f"{name.replace('_', ' ').capitalize()}: {text}")
        for path in made.files:
            typer.echo(f"written: {path}")
    if not made.converged:
        typer.echo("error: not converged: some films of the study", err=True)
        raise typer.Exit(NOT_CONVERGED)


def _number(name: str, text: str | None) -> int | None:
    """Number of the option of a name; None where it is not given."""
    try:
        return None if text is None else int(text)
    except ValueError:
        raise InputError(f"--{name}", got=shown(text), takes="a number") from None
