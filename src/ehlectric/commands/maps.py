"""The commands that look at a sweep: map and sensitivity."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.options import Formats, Quiet, Style, figure_options, files_ending
from ehlectric.commands.terminal import echo_files, print_rows, print_table, say, user_errors, warn
from ehlectric.errors import InputError, shown


def _varied_keys(ctx: typer.Context, incomplete: str) -> list[str]:
    """Varied keys of the sweep in the folder that is typed already, for the completion of a shell."""
    from ehlectric.sweep.store import read_sweep

    try:
        results = read_sweep(ctx.params["folder"])
    except (InputError, KeyError, TypeError):
        return []
    return [key for key in (*results.axes, *results.ranges) if key.startswith(incomplete)]


SweepFolder = Annotated[
    Path,
    typer.Argument(
        metavar="DIR",
        help="Folder of a sweep, finished or not.",
        show_default=False,
        autocompletion=files_ending(),
    ),
]
Value = Annotated[
    str,
    typer.Option(
        metavar="KEY",
        help="Draw this key of summary.json, such as film.minimum_thickness. Without it, the breakdown "
        "voltage is drawn.",
        show_default=False,
    ),
]
OtherFolder = Annotated[
    Path | None,
    typer.Option("--output", "-o", metavar="DIR", help="Write into this folder, not into that of the sweep."),
]


def draw_maps(
    folder: SweepFolder,
    x: Annotated[
        str,
        typer.Option(
            metavar="KEY", help="Draw this varied key along the horizontal axis.", autocompletion=_varied_keys
        ),
    ],
    y: Annotated[
        str | None,
        typer.Option(
            metavar="KEY",
            help="Draw this varied key along the vertical axis. Without it there are lines and no map.",
            autocompletion=_varied_keys,
        ),
    ] = None,
    value: Value = "",
    at: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KEY=VALUE",
            help='Hold a further varied key at a value, as in "bearing.temperature=70 degC". Repeat the '
            "option for several keys. The cut is part of the names of the figures.",
        ),
    ] = None,
    output: OtherFolder = None,
    formats: Formats = None,
    style: Style = "screen",
    quiet: Quiet = False,
) -> None:
    """Draw a value of a sweep as a map and as lines over one or two varied keys.

    The applied voltage is marked. For a bearing that is swept over its speed only, the capacitance and the
    breakdown voltage over the speed are drawn too.
    """
    with user_errors():
        held, look = _held(at or []), figure_options(formats, style)

        from ehlectric.figures.names import SPEED_FIGURE_FILES, in_formats, map_files, of_cut
        from ehlectric.figures.style import style as styled
        from ehlectric.figures.sweep.save import save_maps, save_speeds
        from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
        from ehlectric.sweep.breakdown_keys import main_value
        from ehlectric.sweep.slices import take
        from ehlectric.sweep.store import read_sweep

        results, forms = read_sweep(folder), look["formats"]
        value = value or main_value(results.case)
        taken = take(results, x, y, value, held)
        names = in_formats(
            (*map_files(value, held), *(of_cut(name, held) for name in SPEED_FIGURE_FILES)), forms
        )
        with alone_in(output or folder, names, locks=[FIGURE_LOCK]) as target, styled(style):
            files = save_maps(results, x, y, value, target, at=held, formats=forms)
            files += save_speeds(results, taken, target, forms, at=held)
    if not quiet:
        from ehlectric.figures.sweep.points import held_text

        if taken.at or taken.free:
            say("at " + held_text(results, taken).removeprefix("at "))
        echo_files(files)


def sensitivity(
    folder: SweepFolder,
    value: Value = "",
    output: OtherFolder = None,
    formats: Formats = None,
    style: Style = "screen",
    quiet: Quiet = False,
) -> None:
    """Show which inputs of a Sobol design contribute most to the spread of a value.

    Writes sensitivity.json with the spread and the Sobol indices, and a figure of both. By default the value
    is the breakdown voltage of a contact, the margin of a bearing with a motor, or the rate of a drive.
    """
    with user_errors():
        look = figure_options(formats, style)

        from ehlectric.figures.names import SENSITIVITY_FIGURE, in_formats
        from ehlectric.figures.style import style as styled
        from ehlectric.figures.sweep.sensitivity import save_sensitivity
        from ehlectric.runs.folders import SENSITIVITY
        from ehlectric.runtime.files import write_json
        from ehlectric.runtime.folders import FIGURE_LOCK, alone_in
        from ehlectric.sweep.breakdown_keys import ranked_value
        from ehlectric.sweep.sensitivity import sensitivity as sensitivity_of
        from ehlectric.sweep.store import read_sweep

        results = read_sweep(folder)
        indices = sensitivity_of(results, value or ranked_value(results.case))
        names = in_formats([SENSITIVITY_FIGURE], look["formats"])
        with alone_in(output or folder, (SENSITIVITY, *names), locks=[FIGURE_LOCK]) as target, styled(style):
            write_json(target / SENSITIVITY, indices.to_dict())
            drawn = save_sensitivity(results, indices, target / SENSITIVITY_FIGURE, look["formats"])
        files = [target / SENSITIVITY, *drawn]
    if not quiet:
        from ehlectric.sweep.warnings import sensitivity_warnings
        from ehlectric.tables.sensitivity import indices_table, spread_rows

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
