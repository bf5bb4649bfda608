"""Progress and outcome of a run, and the log of the package.

Log of the package by the standard library: the logger ``ehlectric``.
Progress of the solvers has the level INFO for each contact and DEBUG for each step; warnings of results have
the level WARNING. Nothing is printed unless a program asks for it, as with ``logging.basicConfig``. The
logger ``ehlectric.machine`` tells what the machine lacks; the command line prints it.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeAlias, TypeVar

from ehlectric.errors import InputError, ResultWarning, printable, shown
from ehlectric.runtime.undrawn import Undrawn

# Called with the number of parts done, the number of all parts, and a text that says what is being done.
# The number of all parts is 0 where it is not known, as for the iterations of a film.
Progress: TypeAlias = Callable[[int, int, str], None]


def silent(_done: int, _of: int, _text: str) -> None:
    """Progress that is told to nobody.

    Examples
    --------
    >>> silent(1, 12, "contacts")
    """


def told_to(given: Progress | None) -> Progress:
    """Progress that a caller gave, or one that is told to nobody in place of None. Raises InputError if it
    cannot be called, such as True.

    Examples
    --------
    >>> told_to(True)
    Traceback (most recent call last):
    ehlectric.errors.InputError: progress: got True; expected a function of done, of and text, such as print
    """
    if given is None:
        return silent
    if not callable(given):
        raise InputError("progress", got=shown(given), takes="a function of done, of and text, such as print")
    return given


R = TypeVar("R", covariant=True)


@dataclass(frozen=True)
class RunOutcome(Generic[R]):
    """Outcome of the run of a contact, transient contact, bearing or sweep.

    Examples
    --------
    >>> outcome = RunOutcome(None, {}, (Path("summary.json"),), failure="not converged: film collapsed")
    >>> outcome.converged
    False
    """

    result: R
    # Key figures, nested, in SI units: those of summary.json where the run writes one.
    summary: Mapping[str, Any]
    files: tuple[Path, ...]
    warnings: tuple[ResultWarning, ...] = ()  # warnings that tell where the result is unreliable
    failure: str | None = None  # one line that says what was not solved; None where the run succeeded
    # Further results with figures of their own, such as the film factors of a measurement.
    beside: tuple[object, ...] = ()
    undrawn: tuple[Undrawn, ...] = ()  # figures that could not be drawn

    @property
    def converged(self) -> bool:
        """Whether the run succeeded."""
        return self.failure is None


LOGGER = logging.getLogger("ehlectric")
LOGGER.addHandler(logging.NullHandler())

MACHINE = LOGGER.getChild("machine")

_LEVELS = {"note": logging.INFO, "warning": logging.WARNING, "severe": logging.WARNING}


def log_warnings(title: str, warnings: Iterable[ResultWarning]) -> None:
    """Log the warnings of a result: notes at the level INFO, the others at WARNING."""
    of = f"{title}: " if title else ""
    for warning in warnings:
        LOGGER.log(_LEVELS[warning.severity], "%s [%s]", printable(f"{of}{warning}"), warning.code)
