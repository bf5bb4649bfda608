"""Progress of a run, as it is told to a caller."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

# Called with the number of parts done, the number of all parts, and a text that says what is being done.
# The number of all parts is 0 where it is not known, as for the iterations of a film.
Progress: TypeAlias = Callable[[int, int, str], None]


def silent(_done: int, _of: int, _text: str) -> None:
    """Progress that is told to nobody.

    Examples
    --------
    >>> silent(1, 12, "contacts")
    """
