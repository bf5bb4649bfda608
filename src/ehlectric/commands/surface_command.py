"""The surface command."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.options import Formats, Json, Style, figure_options, file_argument, one_of, option
from ehlectric.commands.terminal import echo_files, print_table, user_errors, warn
from ehlectric.errors import InputError, shown

_UNITS = "such as um or nm, for a file that does not state it"


def surface(
    file: Annotated[
        Path,
        file_argument(
            "FILE",
            "Heights of a surface: text, X3P, AL3D or another instrument's file.",
            ".csv",
            ".txt",
            ".dat",
            ".x3p",
            ".al3d",
        ),
    ],
    x_unit: Annotated[str | None, option("UNIT", f"Take positions in this unit, {_UNITS}.")] = None,
    z_unit: Annotated[str | None, option("UNIT", f"Take heights in this unit, {_UNITS}.")] = None,
    line: Annotated[
        int | None, option("NUMBER", "Take this line of a map, counted from 0; without it, the first.")
    ] = None,
    along: Annotated[
        str, option("HOW", "Take a row or a column of a map.", complete=one_of("row", "column"))
    ] = "row",
    whole: Annotated[
        bool, typer.Option("--map", help="Take the whole map, as point contacts do, not one line of it.")
    ] = False,
    form: Annotated[
        str,
        option(
            "FORM",
            "Remove this form: none, mean, line or parabola.",
            complete=one_of("none", "mean", "line", "parabola"),
        ),
    ] = "none",
    cutoff_long: Annotated[str | None, option("LENGTH", "Remove waves that are longer than this.")] = None,
    cutoff_short: Annotated[str | None, option("LENGTH", "Remove waves that are shorter than this.")] = None,
    trim: Annotated[str | None, option("LENGTH", "Cut this length off each end.")] = None,
    rescale_rq: Annotated[str | None, option("LENGTH", "Scale the heights to this Rq.")] = None,
    truncate: Annotated[str | None, option("LENGTH", "Limit heights to plus and minus this.")] = None,
    output: Annotated[
        Path | None,
        option(
            "FILE",
            "Draw the profile or map into this .png, .svg or .pdf file, or into this folder.",
            "--output",
            "-o",
        ),
    ] = None,
    formats: Formats = None,
    style: Style = "screen",
    as_json: Json = False,
) -> None:
    """Show the content of a surface file and the effect of each processing step, without solving.

    The options are the keys of a table [[roughness]] of a case. A length has its unit, as in --cutoff-long
    "80 um".
    """
    table = {
        "x_unit": x_unit, "z_unit": z_unit, "line": line, "along": along, "form": form,
        "cutoff_long": cutoff_long, "cutoff_short": cutoff_short, "trim": trim,
        "rescale_rq": rescale_rq, "truncate": truncate,
    }  # fmt: skip
    with user_errors():
        from ehlectric.cases.roughness_inputs import Roughness
        from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
        from ehlectric.surfaces.rough_surfaces import measured, whole_map
        from ehlectric.surfaces.surface_warnings import summit_statistics
        from ehlectric.tables.surface_tables import SUMMITS_NOTE, summits_table, surface_table

        keys = {key: value for key, value in table.items() if value is not None}
        look = figure_options(formats, style)
        files = [] if output is None else _files(output, "map" if whole else "profile", formats)
        roughness = Roughness.from_dict({"surface": 1, "file": str(file)} | keys)
        rough = whole_map(roughness) if whole else measured(roughness)
        if files:
            from ehlectric.figures.style import style as styled
            from ehlectric.figures.surface_figures import save_surface

            names = [file.name for file in files]
            with alone_in(files[0].parent, names, locks=[FIGURE_LOCK]), styled(look["style"]):
                files = save_surface(rough.steps, files[0], [file.suffix[1:] for file in files])
    described = rough.describe()
    summits = summit_statistics(rough.steps[-1][1])
    if as_json:
        typer.echo(json.dumps(described | {"summits": summits}, indent=2))
    else:
        print_table(surface_table(described))
        typer.echo()
        print_table(summits_table(summits))
        typer.echo(SUMMITS_NOTE)
        warn(rough.warnings)
        if files:
            echo_files(files)


def _files(output: Path, name: str, formats: Sequence[str] | None) -> list[Path]:
    """Files of a figure, one of each format: ``output``, or without an ending, files in this folder. Raises
    InputError if the ending is that of no format, or of another one than those asked for.
    """
    from ehlectric.figures.figure_names import FORMATS

    ending = output.suffix[1:]
    if not ending:
        return [output / f"{name}.{kind}" for kind in dict.fromkeys(formats or ("png",))]
    allowed = [kind for kind in FORMATS if kind in (formats or FORMATS)]
    if ending not in allowed:
        endings = " or ".join(f".{kind}" for kind in allowed)
        raise InputError("--output", got=shown(str(output)), takes=f"a file ending in {endings}, or a folder")
    return [output.with_suffix(f".{kind}") for kind in dict.fromkeys(formats or (ending,))]
