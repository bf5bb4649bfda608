"""The command that writes the report of a result."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.options import Quiet, ResultFile, files_ending, one_of
from ehlectric.commands.terminal import echo_files, progress_line, user_errors
from ehlectric.errors import InputError, shown

_FORMATS = ("html", "pdf")


def report(
    result: ResultFile,
    output: Annotated[
        Path | None,
        typer.Option(
            "--output",
            "-o",
            metavar="FILE",
            help="Write the report into this file, which ends in .html or .pdf, and not beside the result.",
            autocompletion=files_ending(".html", ".pdf"),
        ),
    ] = None,
    formats: Annotated[
        list[str] | None,
        typer.Option(
            "--format",
            metavar="FORMAT",
            help="Write the report as html or as pdf. Without this option, both are written.",
            show_default=False,
            autocompletion=one_of(*_FORMATS),
        ),
    ] = None,
    quiet: Quiet = False,
) -> None:
    """Write the report of a result: report.html, which needs no other file, and report.pdf.

    It holds the verdict, the warnings, the key numbers, all figures, every input with its source, what the
    model leaves out, versions, and the input file. The result of a contact, of moving roughness, of a
    bearing, of a drive or of a sweep.
    """
    with user_errors():
        wanted = _wanted(output, formats)

        from ehlectric.report.files import write_report
        from ehlectric.runs.folders import stored_result
        from ehlectric.runs.kinds import refuse_input
        from ehlectric.runtime.folders import FIGURE_LOCK, alone_in

        refuse_input(result)
        with progress_line(shown=not quiet) as progress:
            progress(0, 0, "drawing figures")
            if output is not None:
                files = write_report(result, output)
            else:
                file = stored_result(result)
                names = [f"report.{name}" for name in wanted]
                with alone_in(file.parent, names, locks=[FIGURE_LOCK]) as folder:
                    files = write_report(file, *(folder / name for name in names))
    if not quiet:
        echo_files(files)


def _wanted(output: Path | None, formats: list[str] | None) -> tuple[str, ...]:
    """Formats that are wanted.

    Raises
    ------
    InputError
        If there is no such format, or a file is named too, whose ending decides.
    """
    for name in formats or ():
        if name not in _FORMATS:
            raise InputError("--format", got=shown(name), takes=f"one of {', '.join(_FORMATS)}")
    if output is not None and formats:
        raise InputError(
            "--format",
            "cannot be combined with --output",
            takes="one of them: the file ends in .html or .pdf",
        )
    return tuple(dict.fromkeys(formats or _FORMATS))
