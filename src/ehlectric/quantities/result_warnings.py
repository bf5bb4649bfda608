"""Warnings of results: codes with their severity, texts, and conditions at one or at many points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from types import MappingProxyType
from typing import Any, Literal, Self

from ehlectric.quantities.quantity import data_file
from ehlectric.readable import file_text, filled_in

# "severe": the numbers must not be used. "note": the numbers are valid, and the text describes how they were
# obtained.
Severity = Literal["note", "warning", "severe"]

# First words of a warning by its severity, as a page or a report shows it.
SEVERITY_WORDS: Mapping[str, str] = MappingProxyType(
    {"note": "Note", "warning": "Warning", "severe": "Do not use"}
)


@dataclass(frozen=True)
class WarningCode:
    """Meaning of a warning code in one sentence, topic, severity, and keys of quantities that it concerns.

    Outputs show a warning next to those quantities; one without any concerns the whole result. The keys of
    both bearings of a drive begin with "end". Points of a sweep whose numbers are
    ``less_accurate`` than others for this cause have a ring in its figures.
    """

    meaning: str
    topic: str
    severity: Severity = "warning"
    concerns: tuple[str, ...] = ()
    less_accurate: bool = False


@cache
def _texts() -> dict[str, Any]:
    """Texts by code and situation, with the explanation of each code."""
    return data_file("ehlectric.quantities", "warning_texts.toml")


def _codes() -> Iterator[tuple[str, WarningCode]]:
    """Causes by code, from ``warning_codes.toml``; groups of quantities may contain others."""
    read = data_file("ehlectric.quantities", "warning_codes.toml")

    def keys(names: list[str]) -> Iterator[str]:
        for name in names:
            yield from keys(read["groups"][name[1:]]) if name.startswith("@") else (name,)

    for topic, causes in read["codes"].items():
        for code, cause in causes.items():
            concerns = dict.fromkeys(keys(cause.get("concerns", [])))
            yield code, WarningCode(**(cause | {"topic": topic, "concerns": tuple(concerns)}))


CODES: Mapping[str, WarningCode] = MappingProxyType(dict(_codes()))


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

    @classmethod
    def of(cls, code: str, situation: str = "", /, **values: object) -> Self:
        """Return the warning with its text of ``warning_texts.toml``, filled with ``values`` by their names.

        A code with several texts has one for each situation in which it is given. A ``file`` is named without
        the folders of its machine.

        Examples
        --------
        >>> print(ResultWarning.of("seed-repeated", times=2, seed=5).text[:36])
        2 rough surfaces have the seed 5: th
        """
        if "file" in values:
            values["file"] = file_text(values["file"])
        return cls(code, filled_in(_texts()[code][situation or "text"], values))

    @classmethod
    def in_general(cls, code: str) -> Self:
        """Return the warning whose text is the meaning of its code, without values of a point.

        Examples
        --------
        >>> ResultWarning.in_general("load-factors-1").text
        'All load factors of the gear pair are 1.'
        """
        return cls(code, CODES[code].meaning)

    def __str__(self) -> str:
        return self.text

    @property
    def severity(self) -> Severity:
        """Severity of the code: "note", "warning", or "severe" if the numbers must not be used."""
        return CODES[self.code].severity


@dataclass(frozen=True)
class WarningCondition:
    """Condition of a warning at one or at many points of operation, and what its text says at a single one.

    Examples
    --------
    >>> condition = WarningCondition.of(True, "seed-repeated", times=2, seed=lambda: 5)
    >>> [warning.code for warning in active([condition, WarningCondition.of(False, "seed-repeated")])]
    ['seed-repeated']
    """

    where: Any  # whether a point has the warning, shape (...)
    code: str
    situation: str
    # Values of the text by their names; one that is a function is asked only where there is a text.
    values: Mapping[str, Any]

    @classmethod
    def of(cls, where: Any, code: str, situation: str = "", /, **values: Any) -> Self:
        """Condition of the warning that ``ResultWarning.of`` makes of the other arguments."""
        return cls(where, code, situation, values)


def active(conditions: Iterable[WarningCondition]) -> Iterator[ResultWarning]:
    """Warnings of a single point: those whose condition holds."""
    for condition in conditions:
        if condition.where:
            values = {name: value() if callable(value) else value for name, value in condition.values.items()}
            yield ResultWarning.of(condition.code, condition.situation, **values)


# Keys of summary.json, and attributes of files, with the texts of warnings and their codes.
TEXTS, CODES_OF_TEXTS = "warnings", "warning_codes"


def texts_and_codes(warnings: Iterable[ResultWarning]) -> dict[str, list[str]]:
    """Entries of a summary for warnings: their texts and their codes, lists of equal length.

    >>> texts_and_codes([ResultWarning("regime", "rigid-piezoviscous regime")])
    {'warnings': ['rigid-piezoviscous regime'], 'warning_codes': ['regime']}
    """
    listed = tuple(warnings)
    return {TEXTS: [str(warning) for warning in listed], CODES_OF_TEXTS: [warning.code for warning in listed]}


def warnings_of(table: Mapping[str, Any]) -> tuple[ResultWarning, ...]:
    """Warnings of a summary; raises a ValueError where there are more or fewer codes than texts.

    A later version may give codes that this one does not know: they become "not-usable" where the text says
    "do not use", else "unclassified".
    """
    return _warnings(tuple(table.get(CODES_OF_TEXTS, ())), tuple(table.get(TEXTS, ())))


# Points of a sweep have the same warnings again and again.
@lru_cache(maxsize=1000)
def _warnings(codes: tuple[str, ...], texts: tuple[str, ...]) -> tuple[ResultWarning, ...]:
    """Warnings of codes and texts, as many of each."""
    pairs = zip(codes, texts, strict=True)
    return tuple(ResultWarning(code if code in CODES else _foreign(text), text) for code, text in pairs)


def _foreign(text: str) -> str:
    return "not-usable" if "do not use" in text.lower() else "unclassified"
