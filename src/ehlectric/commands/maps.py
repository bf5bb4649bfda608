"""The commands that look at a sweep: map and sensitivity."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ehlectric.commands.tables.sensitivity import sensitivity_tables
from ehlectric.commands.terminal import print_table, user_errors, warn
from ehlectric.errors import InputError, ResultWarning, shown

if TYPE_CHECKING:
    from ehlectric.sweep.results import SweepResults
    from ehlectric.sweep.sensitivity import Sensitivity


SENSITIVITY, SENSITIVITY_FIGURE = "sensitivity.json", "sensitivity.png"

# Half-width of a confidence interval above which an index says little.
_WIDE = 0.1
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

        from ehlectric.figures.names import SPEED_FIGURE_FILES
        from ehlectric.figures.sweep.save import map_files, save_maps, save_speeds
        from ehlectric.runtime.files import prepare
        from ehlectric.sweep.breakdown import breakdown_of
        from ehlectric.sweep.slices import take

        results = _read(folder)
        value = value or breakdown_of(results.case).value
        taken = take(results, x, y, value, held)
        target = prepare(output or folder, (*map_files(value), *SPEED_FIGURE_FILES))
        files = save_maps(results, x, y, value, target, at=held) + save_speeds(results, taken, target)
    if not quiet:
        from ehlectric.figures.sweep.points import held_text

        if taken.at or taken.free:
            typer.echo("at " + held_text(results, taken).removeprefix("at "))
        typer.echo("written: " + ", ".join(str(path) for path in files))


def sensitivity(folder: SweepFolder, value: Value = "", output: Output = None, quiet: Quiet = False) -> None:
    """Spread of a value over the ranges of a Sobol design, and the part of each input in it."""
    with user_errors():
        from ehlectric.figures.sweep.sensitivity import save_sensitivity
        from ehlectric.runtime.files import prepare, whole
        from ehlectric.sweep.breakdown import breakdown_of
        from ehlectric.sweep.sensitivity import sensitivity as found_in

        results = _read(folder)
        value = value or breakdown_of(results.case).value
        found = found_in(results, value)
        target = prepare(output or folder, (SENSITIVITY, SENSITIVITY_FIGURE))
        files = [target / SENSITIVITY, target / SENSITIVITY_FIGURE]
        with whole(files[0]) as path:
            text = json.dumps(found.to_dict(), indent=2, allow_nan=False)
            path.write_text(text + "\n", encoding="utf-8")
        save_sensitivity(results, found, files[1])
    if not quiet:
        for table in sensitivity_tables(results, found):
            print_table(table)
        typer.echo("written: " + ", ".join(str(path) for path in files))
        warn(_warnings(found))


def _read(folder: Path) -> SweepResults:
    from ehlectric.sweep.store import read_sweep

    return read_sweep(folder)


def _held(given: Sequence[str]) -> dict[str, str]:
    """Keys and values of --at."""
    held: dict[str, str] = {}
    for text in given:
        key, sign, value = (part.strip() for part in text.partition("="))
        if not (sign and key and value):
            raise InputError("at", got=shown(text), takes="KEY=VALUE")
        if key in held:
            raise InputError("at", got=f"{key} twice", takes="each key once")
        held[key] = value
    return held


def _warnings(found: Sensitivity) -> Iterator[ResultWarning]:
    """Warnings of the rows behind sensitivity indices, and of their intervals."""
    if found.dropped:
        yield ResultWarning(
            "rows-dropped",
            f"{found.dropped} of {found.rows} rows have a point that is not solved and are left out: the "
            "numbers are those of the rest of the ranges",
        )
    if found.doubtful:
        yield ResultWarning(
            "rows-not-usable",
            f"{found.doubtful} of {found.used} rows that are used have a point whose film is not to be used, "
            "as its warnings in sweep.csv say: spread and indices count with them",
        )
    ends = [end for i in found.indices for end in (i.first_order_interval, i.total_interval)]
    widest = max(0.5 * (high - low) for low, high in ends)
    if widest > _WIDE:
        yield ResultWarning(
            "intervals-wide",
            f"confidence intervals reach up to {widest:.1g} either way; four times the samples halve that",
        )
