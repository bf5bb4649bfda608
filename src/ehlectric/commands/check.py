"""The check command."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from ehlectric.commands.options import Json, Quiet, file_argument
from ehlectric.commands.terminal import print_rows, print_verdict, user_errors, warn


def check(
    file: Annotated[
        Path,
        file_argument(
            "FILE", "Case, bearing, drive or sweep file, in TOML; also one with [motion].", ".toml"
        ),
    ],
    quiet: Quiet = False,
    as_json: Json = False,
) -> None:
    """Check a file of any kind without solving it, and print what it means.

    Hertz contact, groups, regime and film formulas of a contact; with [discharge], an estimate of its
    breakdown voltage. Loads, speeds, oil, films, capacitance and margin of a bearing, unsolved. Source and
    bearings of a drive, not simulated. Number of points of a sweep, and its first point.

    Exit status 0: the file can be solved. 2: the input is wrong.
    """
    with user_errors():
        from ehlectric.runs import by_kind
        from ehlectric.runs.kinds import expect
        from ehlectric.runs.meaning import check as check_meaning

        kind = expect(file, "contact", "motion", "bearing", "drive", "sweep")
        meaning = check_meaning(by_kind.RUNS[kind].read(file))
    if as_json:
        typer.echo(json.dumps(meaning.summary, indent=2))
    elif not quiet:
        print_rows(meaning.rows, meaning.title)
        print_verdict(meaning.verdict)
    if not quiet:
        warn(meaning.warnings)
