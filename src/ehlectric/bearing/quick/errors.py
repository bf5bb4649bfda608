"""Errors of film formulas of bearings."""

from __future__ import annotations

# Factors by which films from formulas, and margins with them, may be off either way. Balls have the formula
# of Chittenden, Dowson, Dunn and Taylor: solved films of bearings are within 30 % of it. Rollers have that
# of Pan and Hamrock: formulas for line contacts differ from solved films by up to 40 %.
FORMULA_OF_BALLS, FORMULA_OF_ROLLERS = 1.3, 1.4


def formula_factor(kind: str) -> float:
    """Factor by which films from formulas may be off either way, by the kind of the bearing.

    Examples
    --------
    >>> formula_factor("deep-groove ball"), formula_factor("cylindrical roller")
    (1.3, 1.4)
    """
    return FORMULA_OF_ROLLERS if kind == "cylindrical roller" else FORMULA_OF_BALLS
