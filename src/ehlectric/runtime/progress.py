"""Progress of a run, as it is told to a caller."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from ehlectric.errors import InputError, shown

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
    """Progress that a caller gave, or one that is told to nobody in place of None.

    Raises
    ------
    InputError
        If it cannot be called, such as True.

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
