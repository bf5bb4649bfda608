"""The command that writes a result for ParaView, MATLAB or a spreadsheet."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.options import Quiet, ResultFile, files_ending
from ehlectric.commands.terminal import echo_files, user_errors


def export(
    result: ResultFile,
    output: Annotated[
        Path,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="Write this file. Its name ends in .mat (MATLAB, Octave), .xlsx (spreadsheets) or .vtkhdf "
            "(ParaView).",
            show_default=False,
            autocompletion=files_ending(".mat", ".xlsx", ".vtkhdf"),
        ),
    ],
    quiet: Quiet = False,
) -> None:
    """Write a result for other programs: MATLAB and Octave, spreadsheets, or ParaView.

    A .mat file has all arrays and the summary, a workbook the summary, the inputs and the table of the
    result, and a .vtkhdf file the film and the field of a contact. All are in SI units.

    Exit status 0: written. 2: the result has no such form, or the file cannot be written.
    """
    with user_errors():
        from ehlectric.runs.exports.files import export as write
        from ehlectric.runs.kinds import refuse_input

        refuse_input(result)
        file = write(result, output)
    if not quiet:
        echo_files([file])
