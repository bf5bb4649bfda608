"""The calibrate command: uncertain inputs of a case, updated by measured values."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from ehlectric.commands.options import command
from ehlectric.commands.solve_commands import solve_file
from ehlectric.commands.terminal import progress_line

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.calibration import Calibration
    from ehlectric.runtime.progress import RunOutcome


@command("calibrate")
def calibrate(
    case_file: Path,
    measured: Path | None = None,
    background: str | None = None,
    uncertainty: str | None = None,
    output: Path = Path("calibration"),
    plots: bool = True,
    formats: list[str] | None = None,
    style: str = "screen",
    quiet: bool = False,
    as_json: bool = False,
) -> None:
    """Update the ranges of uncertain inputs by measured values; write calibrated.toml and a figure.

    The measured values are in the table [measured] of the file, and in a file of operating points, which
    --measured replaces. The files are summary.json, compared.csv with measured next to computed values, and
    calibrated.toml, the case with the updated [ranges], which all commands take.

    If nothing within the ranges explains the measurement, the output names the nearest prediction and the
    causes that explain it, such as a parallel capacitance, and there is no calibrated.toml.

    Exit status 0: calibrated. 2: the input is wrong. 3: nothing within the ranges explains the measurement.
    """
    from ehlectric.runs import by_kind

    solve_file(
        case_file,
        dict.fromkeys(by_kind.CALIBRATED_KINDS, _tables),
        output,
        progress=progress_line,
        run=lambda _, case, folder, progress: by_kind.run_calibration(
            case,
            folder,
            progress,
            measured=measured,
            background=background,
            uncertainty=uncertainty,
            file=case_file,
        ),
        plots=plots,
        formats=formats,
        style=style,
        quiet=quiet,
        as_json=as_json,
    )


def _tables(outcome: RunOutcome[Calibration]) -> Iterator[Table]:
    """Tables of a calibration: inputs, and measured next to computed values."""
    from ehlectric.tables.calibration_tables import compared_table, inputs_table

    if outcome.result.explained:
        yield inputs_table(outcome.result)
    yield compared_table(outcome.result)
