"""Warnings as the pages show them: next to the numbers that they concern."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Told:
    """Warning of a result."""

    # code, severity and text: as of ``ehlectric.errors.ResultWarning``
    code: str
    severity: str
    text: str
    # Keys of the quantities that it concerns, next to which a page shows it; empty for a
    # warning that concerns the whole result.
    beside: tuple[str, ...] = ()
    meaning: str = ""  # meaning of the code in one sentence, without numbers


# Severities in the order in which they are counted.
SEVERITIES = ("severe", "warning", "note")


def beside(told: Iterable[Told], number: str) -> tuple[Told, ...]:
    """Warnings that concern a number."""
    return tuple(one for one in told if number in one.beside)


def within(told: Iterable[Told], keys: Collection[str]) -> tuple[Told, ...]:
    """Warnings of which each names those quantities alone that a page shows; the others stand in a list."""
    return tuple(replace(one, beside=tuple(key for key in one.beside if key in keys)) for one in told)


def elsewhere(told: Iterable[Told]) -> tuple[Told, ...]:
    """Warnings that concern no single number, which stand in a list below the numbers."""
    return tuple(one for one in told if not one.beside)


def counts(told: Iterable[Told]) -> str:
    """Numbers of warnings by their severity.

    Examples
    --------
    >>> counts([Told("partial-film", "warning", "thin"), Told("speed-high", "warning", "fast")])
    '2 warnings'
    >>> counts([])
    'no warnings'
    """
    severities = [one.severity for one in told]
    names = {"severe": "severe warning", "warning": "warning", "note": "note"}
    found = [(severities.count(one), names[one]) for one in SEVERITIES if one in severities]
    return ", ".join(f"{n} {name}{'' if n == 1 else 's'}" for n, name in found) or "no warnings"
