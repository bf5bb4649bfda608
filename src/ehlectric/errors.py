"""Errors that end a request, and warnings that a result carries."""

from __future__ import annotations

import reprlib
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Self

from ehlectric.causes import CODES, Severity

# Largest length of a value in a message [characters].
_MOST_SHOWN = 80

# Largest length of the key of an error, which may be a path, and of its text [characters].
_LONGEST_LINE = 2000

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = 60
_SHORT.maxlevel = 3

# Unicode categories of characters that are not seen, or that change how the text around them is seen: control
# and format characters (bidirectional controls, characters of no width), line separators, parts of pairs.
_UNSEEN = frozenset({"Cc", "Cf", "Zl", "Zp", "Cs"})

# First words of a warning by its severity, as a page or a report shows it.
SEVERITY_WORDS: Mapping[str, str] = MappingProxyType(
    {"note": "Note", "warning": "Warning", "severe": "Do not use"}
)


def unseen(letter: str) -> bool:
    """Whether a character is a control or format character, or a line separator.

    A terminal obeys such characters, and readers do not see them. Spaces of any width are none of them.
    """
    return unicodedata.category(letter) in _UNSEEN


def printable(text: str) -> str:
    r"""Text on one line, with the characters that a terminal obeys or that are not seen as escapes.

    Parameters
    ----------
    text : str
        Text of a user, such as a title or the path of a file.

    Returns
    -------
    str
        Text without control characters, format characters and line separators. A text without them is
        unchanged, and so is a text that is already printable.

    Examples
    --------
    >>> print(printable("6208\x1b[31m\nfilm"))
    6208\x1b[31m\nfilm
    """
    if text.isprintable():
        return text
    return "".join(repr(letter)[1:-1] if unseen(letter) else letter for letter in text)


def short(text: str, most: int = _MOST_SHOWN) -> str:
    """Text of at most ``most`` characters: the middle of a longer one is left out.

    Examples
    --------
    >>> short("1" * 500, 10)
    '1111...111'
    """
    if len(text) <= most:
        return text
    tail = (most - 3) // 2
    return f"{text[: most - 3 - tail]}...{text[len(text) - tail :]}"


def _line(text: str) -> str:
    """Text on one line: line breaks become spaces, other control characters are escaped.

    The middle of a text that would fill a screen is left out.
    """
    return short(printable(" ".join(text.splitlines())), _LONGEST_LINE)


class InputError(ValueError):
    """Error of a wrong input: one line that names the key, its value, and the values that are allowed.

    The line is ``key: got VALUE; expected TAKES``, or ``key: missing; expected TAKES`` without a value. A
    single argument is the whole line of an error without a key.

    Parameters
    ----------
    key : object, optional
        Dotted key of the wrong input, or name of an option or a file.
    says : str, optional
        Text in place of "got VALUE".
    got : object, optional
        Value of the input, as the line shows it.
    takes : str, optional
        Values that are allowed.

    Attributes
    ----------
    key : str or None
        Name of the wrong input; None if the error is not about a single input.
    text : str
        The line without the key.
    got : object
        Value of the input, or the text in its place; None if the line has neither.
    takes : str or None
        Values that are allowed; None if the line does not state them.

    Examples
    --------
    >>> error = InputError("contact.radius_x", got="-1 m", takes="above 0 m")
    >>> str(error)
    'contact.radius_x: got -1 m; expected above 0 m'
    >>> error.key, error.got, error.takes
    ('contact.radius_x', '-1 m', 'above 0 m')
    >>> str(InputError("rough.csv", "has 3 points", takes="at least 16"))
    'rough.csv: has 3 points; expected at least 16'
    """

    key: str | None
    text: str
    got: object
    takes: str | None

    def __init__(
        self, key: object = None, says: str | None = None, /, *, got: object = None, takes: str | None = None
    ) -> None:
        if says is None and got is None and takes is None:
            key, wrong = None, "" if key is None else str(key)
        else:
            wrong = says if says is not None else "missing" if got is None else f"got {got}"
            got = says if got is None else got
        self.text = _line(wrong if takes is None else f"{wrong.removesuffix(';')}; expected {takes}")
        self.key = None if key is None else short(printable(str(key)), _LONGEST_LINE)
        self.got = got.removesuffix(";") if isinstance(got, str) else got
        self.takes = takes
        super().__init__(self.text if self.key is None else f"{self.key}: {self.text}")

    @classmethod
    def missing(cls, key: str, takes: str) -> Self:
        """Error of a required key that is missing.

        Examples
        --------
        >>> str(InputError.missing("contact.load", "a value"))
        'contact.load: missing; expected a value'
        """
        return cls(key, takes=takes)

    @classmethod
    def unknown(cls, key: str, nearest: str) -> Self:
        """Error of a key that does not exist; ``nearest`` is the existing key with the most similar name.

        Examples
        --------
        >>> str(InputError.unknown("contact.lod", "contact.load"))
        'contact.lod: unknown key; the nearest known one is contact.load'
        """
        return cls.worded(short(key), f"unknown key; the nearest known one is {nearest}", takes=nearest)

    @classmethod
    def worded(cls, key: object, text: str, *, got: object = None, takes: str | None = None) -> Self:
        """Error whose line has a free text after the key; ``got`` and ``takes`` are attributes only."""
        error = cls(key, text)
        error.got, error.takes = got, takes
        return error

    def retold(self, key: str | None, text: str) -> Self:
        """Copy of the error with another key and text, but the same ``got`` and ``takes``."""
        return self.worded(key, text, got=self.got, takes=self.takes)

    def under(self, table: str) -> Self:
        """Copy of the error with its key in a table; an error without a key gets the table as its key.

        Examples
        --------
        >>> str(InputError("width", got="2 m", takes="less").under("roughness"))
        'roughness.width: got 2 m; expected less'
        """
        return self.retold(".".join(filter(None, [table, self.key])) or None, self.text)


class MemoryLimitError(InputError):
    """Error of a solution that does not fit into the available memory; with more of it, it may be solved."""


class WriteError(InputError):
    """Error of a file that cannot be written, as on a full disk."""


class DamagedError(InputError):
    """Error of a stored file that is not as it was written, or does not hold what it must."""

    @classmethod
    def of(cls, path: object, what: str) -> Self:
        """Error of a file, with what is wrong in it.

        Examples
        --------
        >>> str(DamagedError.of("result.nc", "pressure is missing"))
        'result.nc: is damaged: pressure is missing; compute it again'
        """
        return cls(path, f"is damaged: {what}; compute it again")


class LostError(RuntimeError):
    """Error of a solution that lost its worker processes, its cluster or its memory."""


class ConvergenceError(RuntimeError):
    """Error of an iteration that did not converge, where only a converged solution is of use."""


def shown(value: object) -> str:
    """Representation of a value, short enough for a one-line message."""
    try:
        text = _SHORT.repr(value)
    except ValueError:
        # Python writes no whole number of more than some thousand digits.
        text = f"a whole number of {value.bit_length()} bits" if isinstance(value, int) else "a value"
    return short(text)


@dataclass(frozen=True)
class ResultWarning:
    """Warning of a result: a code for programs, and a text for people.

    Programs should use ``code`` and ``severity``, because the words of ``text`` may change.

    Parameters
    ----------
    code : str
        Code of the warning, one of ``CODES``, such as "grid-too-coarse".
    text : str
        One line that says what is unreliable and what to do about it.

    Raises
    ------
    ValueError
        If the code is not in ``CODES``.

    Examples
    --------
    >>> warning = ResultWarning("not-converged", "do not use this film, it is no solution")
    >>> print(warning)
    do not use this film, it is no solution
    >>> warning.severity
    'severe'
    """

    code: str
    text: str

    def __post_init__(self) -> None:
        if self.code not in CODES:
            raise ValueError(f"{self.code!r} is no code of a warning; expected one of {', '.join(CODES)}")

    def __str__(self) -> str:
        return self.text

    @property
    def severity(self) -> Severity:
        """Severity of the code: "note", "warning", or "severe" if the numbers must not be used."""
        return CODES[self.code].severity
