"""Accuracy of the films of a bearing, by the way in which its contacts were obtained."""

from __future__ import annotations

from dataclasses import replace

from ehlectric.bearing.contacts import ContactCurve, ContactSolution
from ehlectric.bearing.quick.errors import formula_factor
from ehlectric.bearing.solution import BearingSolution
from ehlectric.errors import ResultWarning


def film_error(solution: BearingSolution) -> float:
    """Estimated error of the films of a bearing, relative, at most 1.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    float
        For solved contacts, the largest estimated error of the films and of their interpolation over the
        load. For contacts from the atlas, the same with the errors that the atlas states, of contacts with
        at least 2 % of the largest load. For contacts by formula, the error of the formula.
    """
    if solution.case.contacts == "formula":
        return formula_factor(solution.case.bearing.kind) - 1.0
    curves = solution.curves
    if solution.case.contacts == "atlas":
        curves = curves[0].counted, curves[1].counted
    errors = [contact.error or 0.0 for curve in curves for contact in curve.solutions]
    return min(1.0, max(errors) + max(curve.interpolation_error for curve in curves))


def error_text(solution: BearingSolution) -> str:
    """Text of ``film_error``, such as "30 %" or "5.9 %"."""
    return percent(film_error(solution))


def percent(error: float) -> str:
    """Text of a relative error, with two digits.

    Examples
    --------
    >>> percent(0.3), percent(0.0237)
    ('30 %', '2.4 %')
    """
    return f"{100.0 * error:.2g} %"


def with_light(curve: ContactCurve) -> tuple[ContactSolution, ...]:
    """Contacts of a ring; a light one that the atlas does not have has a note in place of its warning."""
    heavy = {contact.load for contact in curve.counted.solutions}

    def eased(warning: ResultWarning) -> ResultWarning:
        if warning.code != "atlas-left":
            return warning
        return ResultWarning("atlas-left-light", f"{warning}; loads this light hardly change the bearing")

    return tuple(
        contact if contact.load in heavy else replace(contact, warnings=tuple(map(eased, contact.warnings)))
        for contact in curve.solutions
    )
