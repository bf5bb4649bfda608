"""The command that prints the JSON Schema of a kind of file, for editors."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.options import files_ending, one_of
from ehlectric.commands.terminal import echo_files, user_errors
from ehlectric.errors import InputError, shown

KINDS = ("contact", "bearing", "drive", "sweep")


def schema(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="KIND",
            help=f"Kind of the file: {', '.join(KINDS)}.",
            autocompletion=one_of(*KINDS),
        ),
    ],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="Write the schema into this file; by default, it is printed.",
            autocompletion=files_ending(".json"),
        ),
    ] = None,
) -> None:
    """Print the JSON Schema of a kind of file: keys with their texts, units, bounds and examples.

    An editor completes and explains the keys of a TOML file whose first line is "#:schema", and the path of
    the schema. ehlectric init writes both.
    """
    with user_errors():
        text = schema_text(kind)
        if output is not None:
            from ehlectric.runtime.files import clear_left_behind, prepare, refuse_special, write

            refuse_special(output)
            clear_left_behind(prepare(output.parent))
            write(output, text.encode())
    if output is None:
        typer.echo(text, nl=False)
    else:
        echo_files([output])


def schema_text(kind: str) -> str:
    """Text of the JSON Schema of a kind of file, made from the tables by which files are checked.

    Raises
    ------
    InputError
        If there is no such kind.
    """
    if kind not in KINDS:
        raise InputError("KIND", got=shown(kind), takes=f"one of {', '.join(KINDS)}")
    from ehlectric.runs.schema import schema_of

    return json.dumps(schema_of(kind), indent=1, ensure_ascii=False) + "\n"
