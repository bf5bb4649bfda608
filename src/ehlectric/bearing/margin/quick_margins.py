"""Margins of a bearing at changed inputs, by quick contacts scaled to the margin of its solution."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from ehlectric.bearing.breakdown import breakdown_of
from ehlectric.bearing.quick.ways import quick_case
from ehlectric.bearing.shaft_voltage import margin, shaft_voltage
from ehlectric.bearing.solution import BearingSolution, insulating, lambda_ratio
from ehlectric.bearing.solving.remembered import quick_solution
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.errors import InputError

# Tables and keys on which neither films nor breakdown voltages of contacts depend.
_BESIDE_FILMS = (
    "motor.",
    "discharge.conductivity",
    "bearing.composite_rq",
    "bearing.summits",
    "bearing.contact_resistance",
    "bearing.fill",
    "bearing.parallel_capacitance",
    "bearing.coating",
)

# Tables and keys that no solution uses.
_UNUSED = ("title", "ranges")

# Inputs of strength laws that contacts without a solved field replace by a constant strength.
_NOT_QUICK = ("discharge.weibull.shape", "discharge.weibull.reference_area")


@dataclass(frozen=True)
class MarginPoint:
    """Margin and lambda ratio of a bearing.

    Attributes
    ----------
    margin : float
        First breakdown / shaft voltage, dimensionless; 0 where the surfaces touch and conduct.
    lambda_ratio : float
        Minimum film thickness / composite roughness, dimensionless.
    """

    margin: float
    lambda_ratio: float


@dataclass(frozen=True)
class QuickMargins:
    """Margins of one bearing at changed inputs.

    Attributes
    ----------
    case : BearingCase
        Case of the bearing.
    own : MarginPoint
        Margin and lambda ratio of the solution.
    margin_factor, lambda_factor : float
        Margin and lambda ratio of the solution divided by those of quick contacts, dimensionless.
    quick : BearingSolution
        Solution with quick contacts at the inputs of the case.

    Notes
    -----
    A Weibull law and a strength table over pressure need the field in the whole film, which formulas do not
    have. A constant strength replaces them here: it cancels in the ratio of two margins of the same strength.
    """

    case: BearingCase
    own: MarginPoint
    margin_factor: float
    lambda_factor: float
    quick: BearingSolution = field(repr=False)

    @classmethod
    def of(cls, solution: BearingSolution) -> QuickMargins:
        """Margins by quick contacts, scaled to those of a solution.

        Raises
        ------
        InputError
            Where the solution has no margin, or the formulas have none for the same inputs.
        """
        breakdown = breakdown_of(solution)
        solved = None if breakdown is None else margin(breakdown.shaft_first_break, shaft_voltage(solution))
        if solved is None:
            raise InputError.worded(None, "the bearing has no margin")
        own, quick = MarginPoint(solved, lambda_ratio(solution)), _solved(solution.case)
        point = _point(quick)
        if point.margin == 0.0:
            text = "without solved contacts the surfaces touch already in the case itself"
            raise InputError.worded(None, text)
        ratios = own.margin / point.margin, own.lambda_ratio / point.lambda_ratio
        return cls(solution.case, own, *ratios, quick)

    def at(self, changes: Mapping[str, Any]) -> MarginPoint:
        """Margin and lambda ratio with changed inputs, scaled to the solution.

        Parameters
        ----------
        changes : mapping
            New values by dotted key of the case, SI units.

        Returns
        -------
        MarginPoint
            Scaled values; the margin is 0 where the surfaces touch.

        Raises
        ------
        InputError
            Where the changed inputs make no valid case, or one that needs solved contacts.
        """
        for key in changes:
            if key in _NOT_QUICK:
                raise InputError.worded(key, "has an effect that only solved contacts have")
        case = self.case.replace(changes)
        beside = all(key.startswith(_BESIDE_FILMS) for key in changes)
        point = _point(replace(self.quick, case=case) if beside else _solved(case))
        ratio = self.lambda_factor * point.lambda_ratio
        return MarginPoint(self.margin_factor * point.margin, ratio)


def _solved(case: BearingCase) -> BearingSolution:
    """Solution of a case with quick contacts, with a constant strength where they need one."""
    quick, refused = quick_case(case, constant=True)
    if quick is None:
        assert refused is not None
        raise refused
    return quick_solution(quick, beside=(*_BESIDE_FILMS, *_UNUSED))


def _point(solution: BearingSolution) -> MarginPoint:
    """Margin and lambda ratio of a solution with quick contacts."""
    ratio, breakdown = lambda_ratio(solution), breakdown_of(solution)
    if not insulating(solution):
        return MarginPoint(0.0, ratio)
    value = None if breakdown is None else margin(breakdown.shaft_first_break, shaft_voltage(solution))
    if value is None:
        raise InputError.worded(None, "the bearing has no margin")
    return MarginPoint(value, ratio)
