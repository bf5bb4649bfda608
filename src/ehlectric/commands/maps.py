"""The commands that look at a sweep: map and sensitivity."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.terminal import echo_files, print_rows, print_table, user_errors, warn
from ehlectric.errors import InputError, shown

SENSITIVITY = "sensitivity.json"

SweepFolder = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of a sweep.", show_default=False)]
Value = Annotated[str, typer.Option(metavar="KEY", help="Key of summary.json, default a breakdown voltage.")]
Output = Annotated[
    Path | None, typer.Option("--output", "-o", metavar="DIR", help="Folder, default that of the sweep.")
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No table or warnings.")]


def draw_maps(
    folder: SweepFolder,
    x: Annotated[str, typer.Option(metavar="KEY", help="Varied key along the horizontal axis.")],
    y: Annotated[
        str | None,
        typer.Option(metavar="KEY", help="Varied key along the vertical one; lines alone without."),
    ] = None,
    value: Value = "",
    at: Annotated[
        list[str] | None, typer.Option(metavar="KEY=VALUE", help="What is held where more vary; repeat it.")
    ] = None,
    output: Output = None,
    quiet: Quiet = False,
) -> None:
    """Draw a value of a sweep as a map and as lines over varied keys, with the applied voltage drawn in.

    Of bearings over their speed alone, capacitance and breakdown voltages too.
    """
    with user_errors():
        held = _held(at or [])

        from ehlectric.figures.names import SPEED_FIGURE_FILES, map_files
        from ehlectric.figures.sweep.save import save_maps, save_speeds
        from ehlectric.runtime.files import prepare
        from ehlectric.sweep.breakdown_keys import breakdown_of
        from ehlectric.sweep.slices import take
        from ehlectric.sweep.store import read_sweep

        results = read_sweep(folder)
        value = value or breakdown_of(results.case).value
        taken = take(results, x, y, value, held)
        target = prepare(output or folder, (*map_files(value), *SPEED_FIGURE_FILES))
        files = save_maps(results, x, y, value, target, at=held) + save_speeds(results, taken, target)
    if not quiet:
        from ehlectric.figures.sweep.points import held_text

        if taken.at or taken.free:
            typer.echo("at " + held_text(results, taken).removeprefix("at "))
        echo_files(files)


def sensitivity(folder: SweepFolder, value: Value = "", output: Output = None, quiet: Quiet = False) -> None:
    """Spread of a value over the ranges of a Sobol design, and the part of each input in it."""
    with user_errors():
        from ehlectric.figures.names import SENSITIVITY_FIGURE
        from ehlectric.figures.sweep.sensitivity import save_sensitivity
        from ehlectric.runtime.files import prepare, write_json
        from ehlectric.sweep.breakdown_keys import breakdown_of
        from ehlectric.sweep.sensitivity import sensitivity as sensitivity_of
        from ehlectric.sweep.store import read_sweep

        results = read_sweep(folder)
        indices = sensitivity_of(results, value or breakdown_of(results.case).value)
        target = prepare(output or folder, (SENSITIVITY, SENSITIVITY_FIGURE))
        files = [target / SENSITIVITY, target / SENSITIVITY_FIGURE]
        write_json(files[0], indices.to_dict())
        save_sensitivity(results, indices, files[1])
    if not quiet:
        from ehlectric.commands.tables.sensitivity import indices_table, spread_rows
        from ehlectric.sweep.warnings import sensitivity_warnings

        print_rows(spread_rows(results, indices), results.title)
        print_table(indices_table(results, indices))
        echo_files(files)
        warn(sensitivity_warnings(indices))


def _held(options: Sequence[str]) -> dict[str, str]:
    """Keys and values of the option --at."""
    held: dict[str, str] = {}
    for text in options:
        key, sign, value = (part.strip() for part in text.partition("="))
        if not (sign and key and value):
            raise InputError("at", got=shown(text), takes="KEY=VALUE")
        if key in held:
            raise InputError("at", got=f"{key} twice", takes="each key once")
        held[key] = value
    return held
