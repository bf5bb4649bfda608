"""Arguments and options that several commands share, and what a shell completes them with."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, TypedDict

import typer

from ehlectric.cases.defaults import QUICK
from ehlectric.errors import InputError, shown


def files_ending(*suffixes: str) -> Callable[[str], list[str]]:
    """Function that completes the name of a file with one of some suffixes, or of a folder on the way."""

    def complete(incomplete: str) -> list[str]:
        folder, slash, begun = incomplete.rpartition("/")
        start = folder + slash
        try:
            entries = sorted(Path(start or ".").iterdir())
        except OSError:
            return []
        found = [entry for entry in entries if entry.name.startswith(begun)]
        if not begun:
            found = [entry for entry in found if not entry.name.startswith(".")]
        folders = [f"{start}{entry.name}/" for entry in found if entry.is_dir()]
        return [f"{start}{entry.name}" for entry in found if entry.suffix in suffixes] + folders

    return complete


def one_of(*names: str) -> Callable[[str], list[str]]:
    """Function that completes one of some names."""
    return lambda incomplete: [name for name in names if name.startswith(incomplete)]


def chosen(option: str, value: str, names: Sequence[str]) -> str:
    """Value of an option that takes one of some names. Raises InputError if it is none of them."""
    if value not in names:
        raise InputError(option, got=shown(value), takes=f"one of {', '.join(names)}")
    return value


def option(
    metavar: str,
    help_text: str,
    *names: str,
    complete: Callable[[str], list[str]] | Callable[[typer.Context, str], list[str]] | None = None,
) -> typer.models.OptionInfo:
    """Option with a value; without names it is named after its parameter. ``complete`` lists its values."""
    made: typer.models.OptionInfo = typer.Option(
        *names, metavar=metavar, help=help_text, autocompletion=complete
    )
    return made


def file_argument(metavar: str, help_text: str, *suffixes: str) -> typer.models.ArgumentInfo:
    """Argument for a file, whose name the shell completes."""
    argument: typer.models.ArgumentInfo = typer.Argument(
        metavar=metavar, help=help_text, show_default=False, autocompletion=files_ending(*suffixes)
    )
    return argument


CaseFile = Annotated[Path, file_argument("CASE", "Case file of a contact, in TOML.", ".toml")]
ResultFile = Annotated[
    Path,
    file_argument(
        "RESULT",
        "Folder of a result of any kind, or its result.nc, bearing.nc, drive.nc or motion.nc.",
        ".nc",
    ),
]
Quiet = Annotated[
    bool, typer.Option("--quiet", "-q", help="Print no tables, no progress and no warnings, only errors.")
]
Json = Annotated[bool, typer.Option("--json", help="Print the numbers as JSON in place of tables.")]
Output = Annotated[
    Path, option("DIR", "Write the results into this folder; it is made if missing.", "--output", "-o")
]
Plots = Annotated[bool, typer.Option("--plots/--no-plots", help="Draw the figures, or leave them out.")]
Formats = Annotated[
    list[str] | None,
    option(
        "FORMAT",
        "Write figures as png (the default), svg or pdf. Repeat the option for several formats.",
        "--format",
        complete=one_of("png", "svg", "pdf"),
    ),
]
Style = Annotated[
    str,
    option(
        "STYLE",
        "Draw figures in the style screen, or journal for a column of a journal.",
        "--style",
        complete=one_of("screen", "journal"),
    ),
]


Contacts = Annotated[
    str,
    option(
        "HOW",
        "Solve the contacts (solved), or take films at once from the atlas (atlas) or a formula "
        "(formula). Without this option the file decides.",
        complete=one_of("solved", *QUICK),
    ),
]
Measured = Annotated[
    Path | None,
    option(
        "DATA",
        "Compare with a measurement, a text file of columns with units, and give its film factor.",
        "--measured",
        complete=files_ending(".csv", ".txt", ".dat"),
    ),
]
Background = Annotated[
    str | None,
    option(
        "C",
        'Capacitance of leads and cage in parallel, as "1.3 pF", taken off the measured one.',
        "--background",
    ),
]
Uncertainty = Annotated[
    str | None,
    option(
        "PART",
        'Standard uncertainty of the measured values, as "3 %"; a column of the file wins.',
        "--uncertainty",
    ),
]


class Look(TypedDict):
    """Formats and style of figures, as functions that draw take them."""

    formats: tuple[str, ...]
    style: str


def figure_options(formats: Sequence[str] | None, style: str) -> Look:
    """Formats and style of figures, from the options of a command. Raises InputError if there is no such
    format or style.
    """
    from ehlectric.figures.figure_names import FORMATS, STYLES

    wanted = tuple(chosen("--format", name, FORMATS) for name in formats or ("png",))
    return Look(formats=wanted, style=chosen("--style", style, STYLES))
