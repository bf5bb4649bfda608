"""Progress and outcome of a run, and the log of the package.

Log of the package by the standard library: the logger ``ehlectric``.
Progress of the solvers has the level INFO for each contact and DEBUG for each step; warnings of results have
the level WARNING. Nothing is printed unless a program asks for it, as with ``logging.basicConfig``. The
logger ``ehlectric.machine`` reports what the machine lacks; the command line prints it.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeAlias, TypeVar

from ehlectric.errors import InputError, printable, shown
from ehlectric.quantities.result_warnings import ResultWarning

# Called with the number of parts done, the number of all parts, and a text that says what is being done.
# The number of all parts is 0 where it is not known, as for the iterations of a film.
Progress: TypeAlias = Callable[[int, int, str], None]


def silent(_done: int, _of: int, _text: str) -> None:
    """Progress that is not reported.

    Examples
    --------
    >>> silent(1, 12, "contacts")
    """


def progress_or_silent(given: Progress | None) -> Progress:
    """Progress that a caller gave, or progress that is not reported instead of None. Raises InputError if it
    cannot be called, such as True.

    Examples
    --------
    >>> progress_or_silent(True)
    Traceback (most recent call last):
    ehlectric.errors.InputError: progress: got True; expected a function of done, of and text, such as print
    """
    if given is None:
        return silent
    if not callable(given):
        raise InputError("progress", got=shown(given), takes="a function of done, of and text, such as print")
    return given


# Time after which the rate of a part is known well enough to be shown [s].
_SOON = 3.0


@dataclass
class Remaining:
    """Remaining time for a part of a job, estimated from its finished steps.

    Parts are distinguished by the number of their steps. The time counts down between two steps. It is
    not known where the present step takes longer than all steps that are left were to take: the last contact
    of a bearing may take longer than all others.

    Examples
    --------
    >>> left = Remaining()
    >>> left.step(0, 12, now=0.0)
    >>> left.step(11, 12, now=22.0)
    >>> left.seconds(now=22.0), left.seconds(now=23.0), left.seconds(now=90.0)
    (2.0, 1.0, None)
    """

    of: int = 0  # steps of the part; 0 where their number is not known
    done: int = 0  # steps that are done
    _first: int = 0  # steps that were done when the part was first seen, as of a job that is resumed
    _since: float = 0.0  # time at which the part was first seen [s]
    _at: float = 0.0  # time of the last step [s]

    def step(self, done: int, of: int, *, now: float) -> None:
        """Take the number of steps that are done at a time [s]."""
        if self.is_other(done, of):
            self.of, self.done, self._first = of, done, done
            self._since = self._at = now
        elif done > self.done:
            self.done, self._at = done, now

    def is_other(self, done: int, of: int) -> bool:
        """Whether these steps belong to another part."""
        return of != self.of or done < self.done

    def seconds(self, *, now: float) -> float | None:
        """Time that is left [s]; None where it is not known."""
        steps, gone = self.done - self._first, self._at - self._since
        if not self.of or not steps or now - self._since < _SOON:
            return None
        left = gone / steps * (self.of - self.done) - (now - self._at)
        return left if left > 0.0 else None


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
    # Key figures, nested, in SI units: the figures of summary.json where the run writes one.
    summary: Mapping[str, Any]
    files: tuple[Path, ...]
    warnings: tuple[ResultWarning, ...] = ()  # warnings about where the result is unreliable
    failure: str | None = None  # one line that says what was not solved; None where the run succeeded
    # Further results with figures of their own, such as the film factors of a measurement.
    further_results: tuple[object, ...] = ()

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
