"""The ways a request can fail."""

from __future__ import annotations

import reprlib

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = 60


class InputError(ValueError):
    """The input is wrong: one line that names the key, what it got and what it takes."""


class MemoryLimitError(InputError):
    """What was asked for does not fit into the memory of this machine; it may fit into that of another."""


class LostError(RuntimeError):
    """What solves the points of a sweep is gone, cluster or processes; what is solved is saved."""


class ConvergenceError(RuntimeError):
    """The equations were not solved; raised where the caller asks for a solution or nothing."""


def shown(value: object) -> str:
    """What was given, short enough for a one-line message."""
    return _SHORT.repr(value)
