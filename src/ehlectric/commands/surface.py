"""The commands surface and init."""

from __future__ import annotations

import json
from importlib import resources
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.options import Json, Quiet
from ehlectric.commands.terminal import print_table, user_errors, warn
from ehlectric.errors import InputError, shown

_TEMPLATES = {"line": "template.toml", "point": "template_point.toml"}


def surface(
    file: Annotated[Path, typer.Argument(help="File of an instrument.", show_default=False)],
    x_unit: Annotated[str | None, typer.Option(help="Where the file does not say.")] = None,
    z_unit: Annotated[str | None, typer.Option(help="Where the file does not say.")] = None,
    line: Annotated[int | None, typer.Option(help="Line of a map, from 0; 0 if not given.")] = None,
    along: Annotated[str, typer.Option(help="row or column.")] = "row",
    whole: Annotated[
        bool, typer.Option("--map", help="The whole map, as point contacts use it, not one line of it.")
    ] = False,
    form: Annotated[str, typer.Option(help="none, mean, line or parabola.")] = "none",
    cutoff_long: Annotated[str | None, typer.Option(help="Removes longer waves.")] = None,
    cutoff_short: Annotated[str | None, typer.Option(help="Removes shorter waves.")] = None,
    trim: Annotated[str | None, typer.Option(help="Taken off each end.")] = None,
    rescale_rq: Annotated[str | None, typer.Option(help="Rq to scale to.")] = None,
    truncate: Annotated[str | None, typer.Option(help="Height to cut at.")] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="PNG", help="Draw the profile or map.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Show what a file holds and what each step does to it: the keys of a case's roughness as options.

    Lengths carry their unit, as in --cutoff-long "80 um".
    """
    table = {
        "x_unit": x_unit, "z_unit": z_unit, "line": line, "along": along, "form": form,
        "cutoff_long": cutoff_long, "cutoff_short": cutoff_short, "trim": trim,
        "rescale_rq": rescale_rq, "truncate": truncate,
    }  # fmt: skip
    with user_errors():
        from ehlectric.cases.roughness import Roughness
        from ehlectric.commands.tables.surface import surface_table
        from ehlectric.runtime.files import prepare
        from ehlectric.surfaces.rough_maps import whole_map
        from ehlectric.surfaces.rough_profiles import measured

        keys = {key: value for key, value in table.items() if value is not None}
        roughness = Roughness.from_dict({"surface": 1, "file": str(file)} | keys)
        rough = whole_map(roughness) if whole else measured(roughness)
        if output is not None:
            prepare(output.parent, [output.name])
            from ehlectric.figures.surface import save_surface

            save_surface(rough.steps, output)
    described = rough.describe()
    if as_json:
        typer.echo(json.dumps(described, indent=2))
    else:
        print_table(surface_table(described))
        warn(rough.warnings)
        if output is not None:
            typer.echo(f"written: {output}")


def init(
    path: Annotated[Path, typer.Argument(help="File to write.")] = Path("case.toml"),
    geometry: Annotated[str, typer.Option(metavar="NAME", help="Of the contact: line or point.")] = "line",
    force: Annotated[bool, typer.Option("--force", help="Overwrite a file.")] = False,
    quiet: Quiet = False,
) -> None:
    """Write a commented case to start from."""
    with user_errors():
        from ehlectric.runtime.files import prepare, refuse_special, whole

        if geometry not in _TEMPLATES:
            raise InputError("--geometry", got=shown(geometry), takes=f"one of {', '.join(_TEMPLATES)}")
        refuse_special(path)
        if path.exists() and not force:
            raise InputError(path, "is there already", takes="a new file or --force")
        prepare(path.parent)
        template = resources.files("ehlectric.cases.library") / _TEMPLATES[geometry]
        with whole(path) as beside:
            beside.write_text(template.read_text(encoding="utf-8"), encoding="utf-8")
    if not quiet:
        typer.echo(f"written: {path}; solve it with: ehlectric run {path}")
