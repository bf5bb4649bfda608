"""The surface command."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import typer

from ehlectric.commands.options import (
    command,
    figure_options,
)
from ehlectric.commands.terminal import echo_files, print_table, refuse_undrawn, user_errors, warn
from ehlectric.errors import InputError, shown
from ehlectric.runtime.undrawn import Undrawn, kept_going


@command("surface")
def surface(
    file: Path,
    x_unit: str | None = None,
    z_unit: str | None = None,
    spacing: str | None = None,
    spacing_y: str | None = None,
    line: int | None = None,
    along: str = "row",
    whole: bool = False,
    form: str = "none",
    cutoff_long: str | None = None,
    cutoff_short: str | None = None,
    trim: str | None = None,
    rescale_rq: str | None = None,
    truncate: str | None = None,
    output: Path | None = None,
    formats: list[str] | None = None,
    style: str = "screen",
    as_json: bool = False,
) -> None:
    """Show the content of a surface file and the effect of each processing step, without solving.

    The options are the keys of a table [[roughness]] of a case. A length has its unit, as in --cutoff-long
    "80 um".
    """
    table = {
        "x_unit": x_unit, "z_unit": z_unit, "spacing": spacing, "spacing_y": spacing_y,
        "line": line, "along": along, "form": form,
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
        undrawn: Sequence[Undrawn] = ()
        if files:
            names, endings = [file.name for file in files], [file.suffix[1:] for file in files]
            with alone_in(files[0].parent, names, locks=[FIGURE_LOCK]), kept_going(names[0]) as undrawn:
                file, files = files[0], []
                from ehlectric.figures.style import style as styled
                from ehlectric.figures.surface_figures import save_surface

                with styled(look["style"]):
                    files = save_surface(rough.steps, file, endings)
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
    refuse_undrawn(undrawn)


def _files(output: Path, name: str, formats: Sequence[str] | None) -> list[Path]:
    """Files of a figure, one of each format: ``output``, or without an ending, files in this folder. Raises
    InputError if the ending belongs to no format, or to a format that was not requested.
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
