"""Outcome of a run: its result, its summary, the files that it wrote, and whether it succeeded."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from ehlectric.errors import ResultWarning

R = TypeVar("R", covariant=True)


@dataclass(frozen=True)
class RunOutcome(Generic[R]):
    """Outcome of the run of a contact, transient contact, bearing or sweep.

    Attributes
    ----------
    result : object
        Result, from which figures are drawn.
    summary : mapping
        Key figures, nested, in SI units: those of summary.json where the run writes one.
    files : tuple of Path
        Files written.
    warnings : tuple of ResultWarning
        Warnings that tell where the result is unreliable.
    failure : str or None
        One line that says what was not solved; None where the run succeeded.
    beside : tuple of object
        Further results with figures of their own, such as the film factors of a measurement.

    Examples
    --------
    >>> outcome = RunOutcome(None, {}, (Path("summary.json"),), failure="not converged: film collapsed")
    >>> outcome.converged
    False
    """

    result: R
    summary: Mapping[str, Any]
    files: tuple[Path, ...]
    warnings: tuple[ResultWarning, ...] = ()
    failure: str | None = None
    beside: tuple[object, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether the run succeeded."""
        return self.failure is None
