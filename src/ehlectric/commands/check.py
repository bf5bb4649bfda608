"""The check command."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import typer
from rich.table import Table

from ehlectric.cases.case import Case
from ehlectric.commands.options import CaseFile, Json, Quiet
from ehlectric.commands.tables.contact import case_table
from ehlectric.commands.terminal import print_table, user_errors, warn
from ehlectric.contact.check import check_case
from ehlectric.contact.summary import case_summary
from ehlectric.errors import ResultWarning
from ehlectric.motion.contact import TransientContact
from ehlectric.motion.schedule import Schedule


def check(case_file: CaseFile, quiet: Quiet = False, as_json: Json = False) -> None:
    """Validate a case and say what it means: Hertz contact, groups, regime, film formulas."""
    with user_errors():
        from ehlectric.cases.case import Case

        case = Case.from_toml(case_file)

        from ehlectric.commands.check import meaning

        table, summary, warnings = meaning(case)
    if as_json:
        typer.echo(json.dumps(summary, indent=2))
    elif not quiet:
        print_table(table)
    if not quiet:
        warn(warnings)


def meaning(case: Case) -> tuple[Table, dict[str, Any], list[ResultWarning]]:
    """Hertz contact, groups, regime and film formulas of a case.

    Parameters
    ----------
    case : Case
        A valid case.

    Returns
    -------
    tuple
        A table for the terminal, the same as nested tables in SI units, and the warnings.

    Raises
    ------
    InputError
        Where the values contradict each other, a surface cannot be used or the grid fits into no memory.

    Examples
    --------
    >>> contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": "20 N"}
    >>> contact |= {"reduced_modulus": "226 GPa", "entrainment_speed": 2.0}
    >>> _, summary, _ = meaning(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}}))
    >>> round(summary["hertz"]["max_pressure"] / 1e9, 3)
    0.791
    """
    contact = check_case(case)
    table = case_table(case, contact.conditions)
    summary, warnings = case_summary(case, contact.conditions), list(contact.warnings())
    if case.motion is not None:
        moving = TransientContact.of(case)
        summary["motion"] = moving.schedule.described()
        for name, value, unit in _schedule_rows(moving.schedule, moving.conditions.entrainment_speed):
            table.add_row(name, value, unit)
    return table, summary, warnings


def _schedule_rows(schedule: Schedule, mean: float) -> Iterator[tuple[str, str, str]]:
    moments = schedule.moments()
    yield "motion", f"{schedule.end * schedule.time * 1e3:.4g}", f"ms in {schedule.steps} steps"
    yield "  of oil in a step", f"{schedule.courant:.3g}", "grid spacings"
    for surface in schedule.rough:
        yield f"  surface {surface}, rough", f"{schedule.speed_of(surface) * mean:.4g}", "m/s"
    for name, key in (("covers the contact from", "covered_from"), ("lies as in the case at", "coincident")):
        if key in moments:
            yield f"  {name}", f"{moments[key] * 1e3:.4g}", "ms"


def check_motion(case: Case) -> None:
    """Refuse a case with motion whose schedule or surfaces cannot be used.

    Raises
    ------
    InputError
        As ``TransientContact.of`` does.
    """
    if case.motion is not None:
        TransientContact.of(case)
