"""The ways a request can fail."""

from __future__ import annotations

import reprlib
from typing import Self

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = 60


def _line(text: str) -> str:
    """The text without line breaks."""
    return " ".join(text.splitlines())


class InputError(ValueError):
    """The input is wrong: one line that names the key, the value it got and what it takes.

    The line is ``key: got VALUE, takes TAKES``, or ``key: missing, takes TAKES`` where there is no value. The
    comma is left out after a value, or words in its place, that end in a semicolon. A single argument is the
    whole line of an error without a key.

    Parameters
    ----------
    key : object, optional
        What is wrong: the dotted key of an input, an option or a file.
    says : str, optional
        Words in place of "got VALUE".
    got : object, optional
        The value, as it is to be shown.
    takes : str, optional
        What is allowed.

    Attributes
    ----------
    key : str or None
        What is wrong; None where the error is about no single input.
    text : str
        The line without the key.
    got : object
        The value, or the words in its place; None where the value is missing or not told.
    takes : str or None
        What is allowed, None where the line does not say.

    Examples
    --------
    >>> error = InputError("contact.radius_x", got="-1 m", takes="above 0 m")
    >>> str(error)
    'contact.radius_x: got -1 m, takes above 0 m'
    >>> error.key, error.got, error.takes
    ('contact.radius_x', '-1 m', 'above 0 m')
    >>> str(InputError("rough.csv", "has 3 points", takes="at least 16"))
    'rough.csv: has 3 points, takes at least 16'
    """

    key: str | None
    text: str
    got: object
    takes: str | None

    def __init__(
        self,
        key: object = None,
        says: str | None = None,
        /,
        *,
        got: object = None,
        takes: str | None = None,
    ) -> None:
        if says is None and got is None and takes is None:
            key, found = None, "" if key is None else str(key)
        else:
            found = says if says is not None else "missing" if got is None else f"got {got}"
            got = says if got is None else got
        comma = "" if found.endswith(";") else ","
        self.text = _line(found if takes is None else f"{found}{comma} takes {takes}")
        self.key = None if key is None else _line(str(key))
        self.got = got.removesuffix(";") if isinstance(got, str) else got
        self.takes = takes
        super().__init__(self.text if self.key is None else f"{self.key}: {self.text}")

    @classmethod
    def missing(cls, key: str, takes: str) -> Self:
        """Error of a key that is not given.

        Examples
        --------
        >>> str(InputError.missing("contact.load", "a value"))
        'contact.load: missing, takes a value'
        """
        return cls(key, takes=takes)

    @classmethod
    def unknown(cls, key: str, nearest: str) -> Self:
        """Error of a key that does not exist; ``nearest`` is the known one most like it.

        Examples
        --------
        >>> str(InputError.unknown("contact.lod", "contact.load"))
        'contact.lod: unknown key; the nearest known one is contact.load'
        """
        return cls.worded(key, f"unknown key; the nearest known one is {nearest}", takes=nearest)

    @classmethod
    def worded(cls, key: object, text: str, *, got: object = None, takes: str | None = None) -> Self:
        """Error whose line is the key and a text of its own, with the value and what is allowed beside it."""
        error = cls(key, text)
        error.got, error.takes = got, takes
        return error

    def retold(self, key: str | None, text: str) -> Self:
        """Copy of the error with another key and text; the value and what is allowed stay."""
        return self.worded(key, text, got=self.got, takes=self.takes)

    def under(self, table: str) -> Self:
        """Copy of the error whose key lies in a table; an error without a key gets the table as its key.

        Examples
        --------
        >>> str(InputError("width", got="2 m", takes="less").under("roughness"))
        'roughness.width: got 2 m, takes less'
        """
        return self.retold(".".join(filter(None, [table, self.key])) or None, self.text)


class MemoryLimitError(InputError):
    """What was asked for does not fit into the memory of this machine; it may fit into that of another."""


class LostError(RuntimeError):
    """What solves the points of a sweep is gone, cluster or processes; what is solved is saved."""


class ConvergenceError(RuntimeError):
    """The equations were not solved; raised where the caller asks for a solution or nothing."""


def shown(value: object) -> str:
    """What was given, short enough for a one-line message."""
    return _SHORT.repr(value)
