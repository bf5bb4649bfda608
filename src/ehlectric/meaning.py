"""What a case means before it is solved, line or point: as a table, as JSON, and what is doubtful."""

from __future__ import annotations

from typing import Any

from rich.table import Table

from ehlectric.case import Case
from ehlectric.conditions import remarks, resolve
from ehlectric.errors import InputError
from ehlectric.memory import check_memory
from ehlectric.point_conditions import point_remarks, resolve_point
from ehlectric.point_report import point_summary, point_table
from ehlectric.report import conditions_summary, conditions_table
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
    if case.contact.geometry == "point":
        return _of_point(case)
    conditions = resolve(case)
    rough = rough_surfaces(case, conditions)
    check_memory(case)
    texts = [*remarks(case, conditions), *rough_remarks(case, conditions, rough)]
    return conditions_table(case, conditions), conditions_summary(case, conditions), texts


def _of_point(case: Case) -> tuple[Table, dict[str, Any], list[str]]:
    if case.roughness:
        raise InputError("roughness: got it in a point contact, takes a line contact so far")
    conditions = resolve_point(case)
    check_memory(case)
    return point_table(case, conditions), point_summary(case, conditions), [*point_remarks(case, conditions)]
