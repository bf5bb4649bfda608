"""Parts of a verdict as data: level, facts, and statements with a code and values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

# "green": no breakdown expected; "yellow": breakdown possible within the uncertainty; "red": breakdown
# expected, or surfaces that touch under a voltage; "grey": nothing to compare the breakdown voltage with.
Level = Literal["green", "yellow", "red", "grey"]

# What the computed film is: "upper", a film without heat, starvation or roughness, whose breakdown voltage is
# an upper bound; "best", the best estimate; empty where no film is assumed.
Bound = Literal["", "upper", "best"]


@dataclass(frozen=True)
class Fact:
    """Quantity that decides a verdict.

    Attributes
    ----------
    key : str
        Dotted key of the quantity, as in summary.json.
    value : float
        Value, SI units.
    interval : tuple of float or None
        Smallest and largest possible value, SI units; None where none is known.
    """

    key: str
    value: float
    interval: tuple[float, float] | None = None


@dataclass(frozen=True)
class Statement:
    """Statement of a verdict: a code, and the values that its text names.

    Attributes
    ----------
    code : str
        Key of the text in ``verdict_texts.toml``, such as "strength-decides".
    values : dict
        Values by the names in the text, SI units. A value may be a further statement, which is a clause of
        this one, or a tuple of statements or words; None is a clause that is absent.
    """

    code: str
    values: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, code: str, /, **values: Any) -> Statement:
        """Statement with values by their names.

        Examples
        --------
        >>> Statement.of("margin-at-least", margin=1.2).values
        {'margin': 1.2}
        """
        return cls(code, values)

    def as_data(self) -> dict[str, Any]:
        """Code and values in tables and lists, as ``summary.json`` contains them.

        Examples
        --------
        >>> Statement.of("outer", inner=(Statement.of("first"),)).as_data()
        {'code': 'outer', 'values': {'inner': [{'code': 'first', 'values': {}}]}}
        """
        return {"code": self.code, "values": {name: _as_data(value) for name, value in self.values.items()}}


def _as_data(value: Any) -> Any:
    if isinstance(value, Statement):
        return value.as_data()
    return [_as_data(item) for item in value] if isinstance(value, tuple | list) else value
