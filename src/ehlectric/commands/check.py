"""The check command."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import typer
from rich.table import Table

from ehlectric.cases.case import Case
from ehlectric.commands.options import CaseFile, Json, Quiet
from ehlectric.commands.tables.contact import conditions_table, point_table
from ehlectric.commands.terminal import print_table, user_errors, warn
from ehlectric.contact.case_warnings import line_case_warnings, point_case_warnings
from ehlectric.contact.check import conditions_summary, point_summary
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.contact.memory import check_memory
from ehlectric.contact.problems import domain_of, line_domain_of, spacing, spacings
from ehlectric.errors import ResultWarning
from ehlectric.motion.motion import Motion
from ehlectric.surfaces.rough_maps import rough_maps
from ehlectric.surfaces.rough_profiles import rough_surfaces
from ehlectric.surfaces.warnings import map_surface_warnings, profile_surface_warnings


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
    table, summary, warnings = _of_point(case) if case.contact.geometry == "point" else _of_line(case)
    if case.motion is not None:
        motion = Motion(case)
        summary["motion"] = motion.described()
        for name, value, unit in _course_rows(motion):
            table.add_row(name, value, unit)
    return table, summary, warnings


def _of_line(case: Case) -> tuple[Table, dict[str, Any], list[ResultWarning]]:
    conditions = resolve(case)
    domain = line_domain_of(case, conditions)
    rough = rough_surfaces(case.roughness, domain)
    check_memory(case)
    warnings = [
        *line_case_warnings(case, conditions),
        *profile_surface_warnings(case.roughness, rough, domain, spacing(case, conditions)),
    ]
    return conditions_table(case, conditions), conditions_summary(case, conditions), warnings


def _course_rows(motion: Motion) -> Iterator[tuple[str, str, str]]:
    found = motion.described()
    yield "motion", f"{found['duration'] * 1e3:.4g}", f"ms in {found['steps']} steps"
    yield "  of oil in a step", f"{found['courant']:.3g}", "grid spacings"
    speed = motion.conditions.entrainment_speed
    for surface in sorted({rough.surface for rough in motion.rough}):
        yield f"  surface {surface}, rough", f"{motion.speed_of(surface) * speed:.4g}", "m/s"
    for name, key in (("covers the contact from", "covered_from"), ("lies as in the case at", "coincident")):
        if found[key] is not None:
            yield f"  {name}", f"{found[key] * 1e3:.4g}", "ms"


def check_motion(case: Case) -> None:
    """Refuse steps that are too long, and roughness on surfaces at rest alone, where the case has motion.

    Raises
    ------
    InputError
        As ``Motion`` does.
    """
    if case.motion is not None:
        Motion(case)


def _of_point(case: Case) -> tuple[Table, dict[str, Any], list[ResultWarning]]:
    conditions = resolve_point(case)
    check_memory(case)
    domain = domain_of(case, conditions)
    rough = rough_maps(case.roughness, domain)
    warnings = [
        *point_case_warnings(case, conditions),
        *map_surface_warnings(case.roughness, rough, domain, *spacings(case, conditions)),
    ]
    return point_table(case, conditions), point_summary(case, conditions), warnings
