"""The commands that write a result for other programs, its report or animation, and the schema of a file."""

from __future__ import annotations

import json
from pathlib import Path

import typer

from ehlectric.commands.options import chosen, command
from ehlectric.commands.terminal import (
    echo_files,
    progress_bar,
    progress_line,
    refuse_undrawn,
    say,
    user_errors,
)
from ehlectric.errors import InputError
from ehlectric.runtime.undrawn import collected, kept_going


@command("export")
def export(result: Path, output: Path, quiet: bool = False) -> None:
    """Write a result for other programs: MATLAB and Octave, spreadsheets, or ParaView.

    A .mat file contains all arrays and the summary, and a .vtkhdf file the film and the field of a contact,
    both in SI units. A workbook contains the summary, the inputs, the table of the result and curves over
    the speed, in rpm, degC, MPa and other usual units; it needs the extra: pip install "ehlectric[excel]".

    Exit status 0: written. 2: the result has no such form, or the file cannot be written.
    """
    with user_errors():
        from ehlectric.runs.exports import export as write
        from ehlectric.runs.file_kinds import refuse_input

        refuse_input(result)
        file = write(result, output)
    if not quiet:
        echo_files([file])


@command("animate")
def animate(folder: Path, output: Path | None = None, fps: int = 25, quiet: bool = False) -> None:
    """Animate a moving-roughness run, as a GIF or MP4."""
    with user_errors():
        from ehlectric.runtime.display import import_matplotlib

        import_matplotlib()
        from ehlectric.figures.animation import save_animation
        from ehlectric.motion.stored_run import read_motion

        dataset = read_motion(folder)
        output = (folder if folder.is_dir() else folder.parent) / "motion.gif" if output is None else output
        with progress_bar(shown=not quiet) as progress, kept_going(output.name) as undrawn:
            save_animation(dataset, output, fps=fps, progress=progress)
    refuse_undrawn(undrawn)
    if not quiet:
        say(f"written: {output}")


_FORMATS = ("html", "pdf")


@command("report", formats=_FORMATS)
def report(
    result: Path,
    output: Path | None = None,
    formats: list[str] | None = None,
    summary: bool = False,
    quiet: bool = False,
) -> None:
    """Write the report of a result: report.html, which needs no other file, and report.pdf.

    Its first page shows the machine, the verdict, the numbers and the figure that decide, the inputs that
    decide a margin or the remedies of a drive, and what to measure first. The following pages contain all
    numbers and figures, warnings, every input with its source, what the model neglects, versions, and the
    input file. The result of a contact, of moving roughness, of a bearing, of a drive or of a sweep.
    """
    with user_errors():
        endings = _report_formats(output, formats)

        from ehlectric.runtime.display import import_matplotlib

        import_matplotlib()
        from ehlectric.report.written_report import write_report
        from ehlectric.runs.file_kinds import refuse_input
        from ehlectric.runs.result_folders import stored_result
        from ehlectric.runtime.folders import FIGURE_LOCK, alone_in

        refuse_input(result)
        with progress_line(shown=not quiet) as progress, collected() as undrawn:
            progress(0, 0, "drawing figures")
            if output is not None:
                files = write_report(result, output, summary=summary)
            else:
                file = stored_result(result)
                names = [f"{'summary_page' if summary else 'report'}.{name}" for name in endings]
                with alone_in(file.parent, names, locks=[FIGURE_LOCK]) as folder:
                    files = write_report(file, *(folder / name for name in names), summary=summary)
    if not quiet:
        echo_files(files)
    refuse_undrawn(undrawn)


def _report_formats(output: Path | None, formats: list[str] | None) -> tuple[str, ...]:
    """Formats that are wanted. Raises InputError if there is no such format, or a file is named too, whose
    ending decides.
    """
    endings = tuple(chosen("--format", name, _FORMATS) for name in dict.fromkeys(formats or _FORMATS))
    if output is not None and formats:
        raise InputError(
            "--format",
            "cannot be combined with --output",
            takes="one of them: the file ends in .html or .pdf",
        )
    return endings


KINDS = ("contact", "bearing", "drive", "axle", "gear", "sweep")


@command("schema", kind=KINDS)
def schema(kind: str, output: Path | None = None) -> None:
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
    """Text of the JSON Schema of a kind of file, made from the tables by which files are checked. Raises
    InputError if there is no such kind.
    """
    chosen("KIND", kind, KINDS)
    from ehlectric.runs.json_schema import schema_of

    return json.dumps(schema_of(kind), indent=1, ensure_ascii=False) + "\n"
