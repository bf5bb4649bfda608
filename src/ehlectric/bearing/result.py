"""BearingResult: what ``solve_bearing`` returns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ehlectric.bearing.shaft_voltage import shaft_voltage
from ehlectric.bearing.solution import BearingSolution, capacitance
from ehlectric.bearing.summary import breaks, contact_rows, summary_of
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import ResultWarning


@dataclass(frozen=True)
class BearingResult:
    """A solved bearing with the numbers that follow from it.

    Attributes
    ----------
    solution : BearingSolution
        Loads, films, fields and circuits.

    Examples
    --------
    >>> from ehlectric import BearingCase, solve_bearing
    >>> case = BearingCase.from_dict(
    ...     {
    ...         "contacts": "formula",
    ...         "bearing": {
    ...             "base": "6208", "radial_clearance": "10 um", "radial_load": "1 kN",
    ...             "inner_speed": "3000 rpm", "temperature": "70 degC", "composite_rq": "0.03 um",
    ...         },
    ...         "lubricant": {"base": "paper", "viscosity": "20 mPa s"},
    ...         "discharge": {"dielectric_strength": "15 V/um"},
    ...     }
    ... )
    >>> result = solve_bearing(case, workers=1)
    >>> result.converged, result.breaks()["first_break_at"]
    (True, 'inner contact of element 0')
    """

    solution: BearingSolution

    @property
    def case(self) -> BearingCase:
        """Bearing file that was solved."""
        return self.solution.case

    @property
    def converged(self) -> bool:
        """Whether all contacts are converged."""
        return self.solution.converged

    @property
    def shaft_voltage(self) -> float | None:
        """Voltage of the shaft by the capacitive divider [V]; None where there is none."""
        return shaft_voltage(self.solution)

    def capacitance(self, fill: str) -> float:
        """Capacitance of the bearing [F], mean over the positions, with "oil" or "air" around the films."""
        return capacitance(self.solution, fill)

    def breaks(self) -> dict[str, Any]:
        """Voltages of breakdown over the positions [V] and their margins, None where there are none."""
        return breaks(self.solution)

    def warnings(self) -> list[ResultWarning]:
        """Warnings that tell where the result is unreliable, each once."""
        return bearing_warnings(self.solution)

    def contacts(self) -> list[dict[str, Any]]:
        """A row for every element and ring, cage at its first position, SI units."""
        return contact_rows(self.solution)

    def summary(self) -> dict[str, Any]:
        """Totals, SI units, nested as summary.json; never NaN."""
        return summary_of(self.solution)
