"""Preview of a file before it is solved: dry contact, films and voltages from formulas, size of a sweep.

Nothing here solves a film, so that the answer is there at once. Films from formulas, and what follows from
them, may be far from the solution; every row and every table with them states it.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.rows import Row
from ehlectric.runtime.display import headline

if TYPE_CHECKING:
    from ehlectric.cases.axle_case import AxleCase
    from ehlectric.cases.bearing_case import BearingCase
    from ehlectric.cases.case import Case
    from ehlectric.cases.drive_case import DriveCase
    from ehlectric.cases.gear_case import GearCase
    from ehlectric.quantities.verdict import Verdict
    from ehlectric.sweep import Sweep


@dataclass(frozen=True, repr=False)
class Preview:
    """Preview of a file before it is solved."""

    title: str
    rows: tuple[Row, ...]  # rows of a table: dry contact, films from formulas and what follows from them
    summary: dict[str, Any]  # the same numbers as nested tables, SI units
    warnings: tuple[ResultWarning, ...]  # warnings about the case and its surfaces
    # Whether the film of a bearing breaks down, from formulas; None for other files and without a strength.
    verdict: Verdict | None = None

    def __repr__(self) -> str:
        counts = f"{len(self.rows)} rows", f"{len(self.warnings)} warnings"
        return f"<Preview {headline(self.title, *counts, verdict=self.verdict)}>"


# Modules with the function ``preview`` of each class: the preview of a contact loads no bearing.
_MODULES = {
    "Case": "contact_preview",
    "BearingCase": "bearing_preview",
    "DriveCase": "drive_preview",
    "GearCase": "gear_preview",
    "AxleCase": "axle_preview",
    "Sweep": "sweep_preview",
}


def preview_of(case: Case | BearingCase | DriveCase | GearCase | AxleCase | Sweep) -> Preview:
    """Preview of a case or of a sweep, at once: dry contact, groups, and what film formulas predict. Returns
    rows of a table, the same numbers as nested tables, and warnings. Raises InputError if the values
    contradict each other, a surface cannot be used, the grid fits into no memory or no point of a sweep is a
    valid case.

    Examples
    --------
    >>> from ehlectric import Case
    >>> contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": "20 N"}
    >>> contact |= {"reduced_modulus": "226 GPa", "entrainment_speed": 2.0}
    >>> preview = preview_of(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}}))
    >>> round(preview.summary["hertz"]["max_pressure"] / 1e9, 3)
    0.791
    """
    if getattr(case, "measured", None) is not None:
        from ehlectric.calibration import check_measured

        check_measured(case)
    for base in type(case).__mro__:
        if base.__name__ in _MODULES:
            preview: Preview = import_module(f"ehlectric.runs.{_MODULES[base.__name__]}").preview(case)
            return preview
    raise TypeError(f"{type(case).__name__} is no case")
