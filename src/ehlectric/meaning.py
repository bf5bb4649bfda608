"""What a case of any contact means, as a table, as JSON and with its doubts; and its solution as a table."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rich.table import Table

from ehlectric.case import Case
from ehlectric.conditions import remarks, resolve
from ehlectric.map_remarks import remarks as map_remarks
from ehlectric.memory import check_memory
from ehlectric.motion import Motion
from ehlectric.point_conditions import point_remarks, resolve_point
from ehlectric.point_problems import domain_of, spacings
from ehlectric.point_report import point_result_table, point_summary, point_table
from ehlectric.point_result import PointResult
from ehlectric.problems import line_domain_of, spacing
from ehlectric.report import conditions_summary, conditions_table, line_result_table
from ehlectric.result import Result
from ehlectric.rough_maps import rough_maps
from ehlectric.walls import remarks as rough_remarks
from ehlectric.walls import rough_surfaces


def meaning(case: Case) -> tuple[Table, dict[str, Any], list[str]]:
    """Hertz contact, groups, regime and film formulas of a case.

    Parameters
    ----------
    case : Case
        A valid case.

    Returns
    -------
    tuple
        A table for the terminal, the same as nested tables in SI units, and remarks on what is doubtful.

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
    table, summary, texts = _of_point(case) if case.contact.geometry == "point" else _of_line(case)
    if case.motion is not None:
        motion = Motion(case)
        summary["motion"] = motion.described()
        for name, value, unit in _course_rows(motion):
            table.add_row(name, value, unit)
    return table, summary, texts


def _of_line(case: Case) -> tuple[Table, dict[str, Any], list[str]]:
    conditions = resolve(case)
    domain = line_domain_of(case, conditions)
    rough = rough_surfaces(case.roughness, domain)
    check_memory(case)
    texts = [
        *remarks(case, conditions),
        *rough_remarks(case.roughness, rough, domain, spacing(case, conditions)),
    ]
    return conditions_table(case, conditions), conditions_summary(case, conditions), texts


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


def check_case(case: Case) -> None:
    """Refuse, before a folder is made for its results, a case that cannot be solved.

    Raises
    ------
    InputError
        As ``meaning`` does.
    """
    if case.contact.geometry == "point":
        rough_maps(case.roughness, domain_of(case, resolve_point(case)))
    else:
        rough_surfaces(case.roughness, line_domain_of(case, resolve(case)))
    check_memory(case)


def check_motion(case: Case) -> None:
    """Refuse steps that are too long, and roughness on surfaces at rest alone, where the case has motion.

    Raises
    ------
    InputError
        As ``Motion`` does.
    """
    if case.motion is not None:
        Motion(case)


def result_table(result: Result | PointResult) -> Table:
    """The key figures of a solution of any contact."""
    return point_result_table(result) if isinstance(result, PointResult) else line_result_table(result)


def _of_point(case: Case) -> tuple[Table, dict[str, Any], list[str]]:
    conditions = resolve_point(case)
    check_memory(case)
    domain = domain_of(case, conditions)
    rough = rough_maps(case.roughness, domain)
    texts = [
        *point_remarks(case, conditions),
        *map_remarks(case.roughness, rough, domain, *spacings(case, conditions)),
    ]
    return point_table(case, conditions), point_summary(case, conditions), texts
