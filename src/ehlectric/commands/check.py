"""The check command."""

from __future__ import annotations

import json

import typer

from ehlectric.commands.options import CaseFile, Json, Quiet
from ehlectric.commands.terminal import print_rows, user_errors, warn


def check(case_file: CaseFile, quiet: Quiet = False, as_json: Json = False) -> None:
    """Validate a case and say what it means: Hertz contact, groups, regime, film formulas."""
    with user_errors():
        from ehlectric.commands import runs

        meaning = runs.check(runs.read_case(case_file))
    if as_json:
        typer.echo(json.dumps(meaning.summary, indent=2))
    elif not quiet:
        print_rows(meaning.rows, meaning.title)
    if not quiet:
        warn(meaning.warnings)
