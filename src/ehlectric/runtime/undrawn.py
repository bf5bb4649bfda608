"""Figures that could not be drawn: they end neither the other figures nor the output of a result."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path

from ehlectric.errors import InputError, WriteError, printable
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.memory import is_out_of_memory, out_of_memory


@dataclass(frozen=True)
class Undrawn:
    """Figure that could not be drawn or written, and why."""

    name: str  # name of its file, or a word for all figures
    error: Exception

    @property
    def line(self) -> str:
        """Reason on one line."""
        error = self.error
        if isinstance(error, InputError):
            return str(error)  # it names the file or the input
        if is_out_of_memory(error):
            reason = out_of_memory(error)
        else:
            text = str(error).partition("\n")[0]
            reason = ": ".join(filter(None, (type(error).__name__, text)))
        return f"{self.name}: could not be drawn, {printable(reason)}"


@dataclass(frozen=True)
class Drawn:
    """Figures of a result as files."""

    files: tuple[Path, ...]
    warnings: tuple[ResultWarning, ...] = ()  # warnings about what the figures omit
    undrawn: tuple[Undrawn, ...] = ()  # figures that failed


_collected: ContextVar[list[Undrawn] | None] = ContextVar("collected", default=None)


@contextmanager
def collected() -> Iterator[list[Undrawn]]:
    """Context in which a figure that fails does not end the others.

    Yields the list of figures that failed, which grows within the context.
    """
    failures: list[Undrawn] = []
    token = _collected.set(failures)
    try:
        yield failures
    finally:
        _collected.reset(token)


@contextmanager
def kept_going(name: str = "figures") -> Iterator[list[Undrawn]]:
    """Context as ``collected``, which another error than of a single figure ends, but not the program.

    The error is in the list under ``name``.
    """
    with collected() as failures, drawing(name):
        yield failures


@contextmanager
def drawing(name: str) -> Iterator[None]:
    """Context in which the figure of a file name is drawn and written.

    Within ``collected`` an error ends this figure only. Otherwise the error is raised.
    """
    try:
        yield
    except Exception as error:
        failures = _collected.get()
        if failures is None:
            raise
        logging.getLogger("ehlectric").debug("%s could not be drawn", name, exc_info=error)
        failures.append(Undrawn(name, error))


def lines_of(undrawn: Sequence[Undrawn]) -> Iterator[str]:
    """Lines about figures that could not be drawn; one line for all that do not fit on a full disk."""
    unwritten = [failure for failure in undrawn if isinstance(failure.error, WriteError)]
    yield from dict.fromkeys(failure.line for failure in undrawn if failure not in unwritten)
    if unwritten:
        others = f"; {len(unwritten) - 1} other files do not fit either" if len(unwritten) > 1 else ""
        yield f"{unwritten[0].line}{others}"
