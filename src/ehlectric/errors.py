"""Errors that end a request."""

from __future__ import annotations

import reprlib
import unicodedata
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Self, TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")

# Largest number of wrong keys of a table that an error names.
MOST_NAMED = 100
# Largest length of a value in a message, and of an error's key, which may be a path, and text [characters].
_MOST_SHOWN, _LONGEST_LINE = 80, 2000

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = 60
_SHORT.maxlevel = 3

# Unicode categories of characters that are not seen, or that change how the text around them is seen: control
# and format characters (bidirectional controls, characters of no width), line separators, parts of pairs.
_UNSEEN = frozenset({"Cc", "Cf", "Zl", "Zp", "Cs"})


def unseen(letter: str) -> bool:
    """Whether a character is a control or format character, or a line separator.

    A terminal obeys such characters, and readers do not see them. Spaces of any width are none of them.
    """
    return unicodedata.category(letter) in _UNSEEN


def printable(text: str) -> str:
    r"""Text on one line, with the characters that a terminal obeys or that are not seen as escapes. Returns
    text without control characters, format characters and line separators; a text without them is unchanged,
    and so is a text that is already printable.

    Examples
    --------
    >>> print(printable("6208\x1b[31m\nfilm"))
    6208\x1b[31m\nfilm
    """
    if text.isprintable():
        return text
    return "".join(repr(letter)[1:-1] if unseen(letter) else letter for letter in text)


def short(text: str, most: int = _MOST_SHOWN) -> str:
    """Text of at most ``most`` characters: the middle of a longer one is cut.

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

    The middle of a text that would fill a screen is cut.
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
        Text instead of "got VALUE".
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
        Value of the input, or the text instead; None if the line has neither.
    takes : str or None
        Values that are allowed; None if the line does not state them.
    several : tuple of InputError
        Errors that the line joins; empty for the error of one input.

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
    several: tuple[InputError, ...] = ()

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
        """Return the error of a required key that is missing."""
        return cls(key, takes=takes)

    @property
    def is_missing(self) -> bool:
        """Whether the error concerns a missing value."""
        return self.text.startswith("missing")

    @classmethod
    def unknown(cls, key: str, nearest: str) -> Self:
        """Return the error of an unknown key; ``nearest`` is the key that it may mean, or empty."""
        if not nearest:
            return cls.worded(short(key), "unknown key; no known key has a similar name")
        return cls.worded(short(key), f"unknown key; the nearest known one is {nearest}", takes=nearest)

    @classmethod
    def worded(cls, key: object, text: str, *, got: object = None, takes: str | None = None) -> Self:
        """Return an error with free text after the key; ``got`` and ``takes`` are only attributes."""
        error = cls(key, text)
        error.got, error.takes = got, takes
        return error

    def with_text(self, key: str | None, text: str) -> Self:
        """Return a copy of the error with another key and text, and with its ``got`` and ``takes``."""
        return self.worded(key, text, got=self.got, takes=self.takes)

    def retold(self, key: str | None, text: str) -> Self:
        """Return ``with_text``; deprecated."""
        warnings.warn("retold is deprecated; use with_text", DeprecationWarning, stacklevel=2)
        return self.with_text(key, text)

    @classmethod
    def together(cls, errors: Sequence[InputError]) -> InputError:
        """Return an error with the key of the first of several errors, whose line contains all texts.

        Examples
        --------
        >>> wrong = InputError("contact.load", got="'20 V'", takes="a force")
        >>> print(InputError.together([wrong, InputError.missing("lubricant", "a table")]))
        contact.load: got '20 V'; expected a force; also missing: lubricant
        """
        each = [part for error in errors for part in error.several or (error,)]
        first, *others = several = {(error.key, error.text): error for error in each}.values()
        # With the case in which the value is missing, as in "missing with the remedy 'Ring'; expected ...".
        missing = [
            f"{error.key or ''}{error.text.partition(';')[0].removeprefix('missing')}"
            for error in others
            if error.is_missing
        ]
        further = [str(error) for error in others if not error.is_missing]
        text = first.text + "".join(f"; also {line}" for line in further)
        if missing:
            text += f"; also missing: {', '.join(dict.fromkeys(missing))}"
        joined = first.with_text(first.key, text)
        joined.several = tuple(several) if others else ()
        return joined

    def under(self, table: str) -> Self:
        """Return a copy of the error with its key in a table; without a key, the table is the key.

        Examples
        --------
        >>> str(InputError("width", got="2 m", takes="less").under("roughness"))
        'roughness.width: got 2 m; expected less'
        """
        if self.several:
            joined: Any = self.together([error.under(table) for error in self.several])
            return joined  # type: ignore[no-any-return]
        return self.with_text(".".join(filter(None, [table, self.key])) or None, self.text)


@contextmanager
def within(table: str) -> Iterator[None]:
    """Context in which an InputError gets its key in a table, or the table as its key if it has none.

    Examples
    --------
    >>> with within("bearing"):
    ...     raise InputError("bore", got="2 m", takes="less")
    Traceback (most recent call last):
    ehlectric.errors.InputError: bearing.bore: got 2 m; expected less
    """
    try:
        yield
    except InputError as error:
        raise error.under(table) from None


class MemoryLimitError(InputError):
    """Error of a solution that does not fit into the available memory; with more of it, it may be solved."""


class WriteError(InputError):
    """Error of a file that cannot be written, as on a full disk."""


class DamagedError(InputError):
    """Error of a stored file that is not as it was written, or does not hold what it must."""

    what = ""  # what is wrong in the file

    @classmethod
    def of(cls, path: object, what: str) -> Self:
        """Error of a file, with what is wrong in it.

        Examples
        --------
        >>> str(DamagedError.of("result.nc", "pressure is missing"))
        'result.nc: is damaged: pressure is missing; compute it again'
        """
        error = cls(path, f"is damaged: {what}; compute it again")
        error.what = what
        return error


class UnreadableError(WriteError):
    """Error of a result that was written, and that ``load`` would refuse: a fault of this program."""

    @classmethod
    def of(cls, path: object, what: str) -> Self:
        """Error of a file, with what is wrong in it.

        Examples
        --------
        >>> str(UnreadableError.of("result.nc", "film_fraction is negative, -4e-16"))[:70]
        'result.nc: is written, but load refuses it: film_fraction is negative,'
        """
        return cls(
            path,
            f"is written, but load refuses it: {what}; no number is lost: summary.json is complete, and "
            "xarray.open_dataset reads the file; please report this fault of ehlectric",
        )


class LostError(RuntimeError):
    """Error of a solution that lost its worker processes, its cluster or its memory.

    Examples
    --------
    >>> error = LostError("the process of the case was killed")
    >>> str(error), isinstance(error, RuntimeError)
    ('the process of the case was killed', True)
    """


class ConvergenceError(RuntimeError):
    """Error of an iteration that did not converge, where only a converged solution is of use.

    Examples
    --------
    >>> error = ConvergenceError("the film did not converge")
    >>> str(error), isinstance(error, RuntimeError)
    ('the film did not converge', True)
    """


def shown(value: object) -> str:
    """Representation of a value, short enough for a one-line message."""
    try:
        text = _SHORT.repr(value)
    except ValueError:
        # Python writes no whole number of more than some thousand digits.
        text = f"a whole number of {value.bit_length()} bits" if isinstance(value, int) else "a value"
    return short(text)


def for_all(make: Callable[[Item], Result], items: Iterable[Item]) -> list[Result]:
    """Results for all items. Raises an InputError that joins the errors of up to 100 items.

    Examples
    --------
    >>> for_all(int, ["1", "2"])
    [1, 2]
    """
    results: list[Result] = []
    errors: list[InputError] = []
    for item in items:
        try:
            results.append(make(item))
        except InputError as error:
            errors.append(error)
            if len(errors) == MOST_NAMED:
                break
    if errors:
        raise InputError.together(errors)
    return results
