"""Words of verdicts: first words, headings, sentences and lines, from ``verdict_texts.toml``."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from string import Formatter
from typing import Any

from ehlectric.quantities.formats import CELSIUS, amount, amount_text, rpm_text, speed_text, time_share_text
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import CODES
from ehlectric.quantities.statement import Bound, Level, Statement
from ehlectric.readable import bounds_text, capital, chance_text, mean_text, ratio_text, readable


@cache
def _texts() -> Mapping[str, Any]:
    return data_file("ehlectric.quantities", "verdict_texts.toml")


def _per_cent(digits: int) -> Callable[[float], str]:
    return lambda share: f"{readable(100.0 * share, digits)} %"


def _three_digits(unit: str) -> Callable[[float], str]:
    return lambda value: amount(float(f"{value:.3g}"), unit)


# Ways to write a value, by their names in the texts. A value without one is written as it is.
_WAYS: Mapping[str, Callable[[Any], str]] = {
    "number": readable,
    "number2": lambda value: readable(value, 2),
    "scaled": lambda divisor: (
        f"divided by {readable(divisor)}" if divisor >= 1.0 else f"multiplied by {readable(1.0 / divisor)}"
    ),
    ".1": lambda value: f"{value:.1f}",
    "ratio": ratio_text,
    "V": lambda value: f"{readable(value)} V",
    "V2": lambda value: f"{readable(value, 2)} V",
    "V/µm": lambda value: f"{readable(1e-6 * value)} V/µm",
    "V/µm2": lambda value: f"{readable(1e-6 * value, 2)} V/µm",
    "V/µm number": lambda value: readable(1e-6 * value),
    "A/mm²": lambda value: f"{readable(1e-6 * value)} A/mm²",
    "rpm": speed_text,
    "rpm number": rpm_text,
    "rpm4": lambda value: speed_text(value, 4),
    "°C": CELSIUS.text,
    "%": _per_cent(3),
    "%2": _per_cent(2),
    "%0": lambda share: f"{100.0 * share:.0f} %",
    "s": lambda value: amount(value, "s"),
    "Ω": lambda value: amount(value, "Ω"),
    "µm": lambda value: f"{readable(1e6 * value)} µm",
    "V4": lambda value: amount(value, "V"),
    "Nm": lambda value: amount(value, "N m"),
    "amount": lambda pair: amount_text(*pair),
    "V3": _three_digits("V"),
    "J3": _three_digits("J"),
    "time": time_share_text,
    "chance": lambda pair: chance_text(*pair),
    "bounds": lambda pair: bounds_text(*pair),
    "mean": lambda values: mean_text(*values),
    "meaning": lambda code: CODES[code].meaning,
    "spots": lambda number: "1 spot" if number == 1 else f"{number} spots",
    "points": lambda number: "1 more point" if number == 1 else f"{number} more points",
    "have": lambda number: "has" if number == 1 else "have",
    "are": lambda number: "is" if number == 1 else "are",
    "none": lambda number: str(number or "none"),
    ", ": lambda parts: ", ".join(parts),
    " and ": lambda parts: " and ".join(parts),
    "; ": lambda parts: "; ".join(parts),
    "; or ": lambda parts: "; or ".join(parts),
}


class _Ways(Formatter):
    """Formats templates, with values in the ways of ``_WAYS``."""

    def format_field(self, value: Any, format_spec: str) -> str:
        if value is None:
            return ""
        return _WAYS[format_spec](value) if format_spec else str(value)


def _rendered(value: Any, at: str, form: str) -> Any:
    """Value of a statement, whose statements are text."""
    if isinstance(value, Statement):
        return statement_text(value, at, form)
    if isinstance(value, tuple) and any(isinstance(statement, Statement) for statement in value):
        return tuple(_rendered(statement, at, form) for statement in value)
    return value


def statement_text(statement: Statement, at: str = "", form: str = "text") -> str:
    """Text of a statement. ``at``, text of the operating point; ``form``, "text" for sentences and "brief"
    for lines, which is the text for a statement without a brief form.

    Examples
    --------
    >>> statement_text(Statement.of("speeds-below", high=144.38))
    'below about 1380 rpm'
    """
    entry = _texts()["statements"][statement.code]
    template = entry.get(form, entry["text"])
    values = {name: _rendered(value, at, form) for name, value in statement.values.items()}
    return _Ways().vformat(template, (), {"at": at, **values})


def is_code(code: str) -> bool:
    """Whether a code of a verdict has first words."""
    return code in _texts()["leads"]


def first_words(code: str, answer: Statement | None) -> str:
    """First words of a verdict by its code, which may name values of its answer."""
    if not is_code(code):
        return code.removesuffix(".")
    return _Ways().vformat(_texts()["leads"][code]["text"], (), {} if answer is None else answer.values)


def heading(code: str, answer: Statement | None, level: Level, bound: Bound) -> str:
    """Heading of a verdict: its first words or other ones, and whether the film is an ideal one."""
    known = _texts()["leads"].get(code, {})
    words = str(known.get("heading") or first_words(code, answer))
    return words + _texts()["ideal"][level] if bound == "upper" else words


def bound_words(bound: Bound) -> str:
    """Words after the heading of a verdict; empty unless it is on an upper bound."""
    return str(_texts()["after_heading"].get(bound, ""))


def assumed_text(assumptions: Iterable[Statement], bound: Bound, at: str, form: str = "text") -> str:
    """Clauses on what is assumed, behind the bound: a sentence, or the text of a line; empty without any."""
    clauses = "; ".join(statement_text(statement, at, form) for statement in assumptions)
    if not clauses:
        return ""
    text = _texts()["bounds"][bound] + clauses
    return f"{capital(text)}." if form == "text" else str(text)


def lines_of(statements: Iterable[Statement], at: str) -> Iterator[tuple[str, str]]:
    """Labels and texts of lines in the order of their labels: a line that the statements of a label share, or
    one for each.
    """
    labelled = [pair for statement in statements for pair in _labelled(statement, at)]
    for label, shared in _texts()["lines"].items():
        texts = [text for name, text in labelled if name == label and text]
        if shared and texts:
            yield label, "; ".join(text.rstrip(".") for text in texts)
        else:
            yield from ((label, capital(text)) for text in texts)


def _labelled(statement: Statement, at: str) -> Iterator[tuple[str, str]]:
    """Labels and texts of a statement; one without lines is a sentence under its default label."""
    entry = _texts()["statements"][statement.code]
    if "lines" not in entry:
        yield entry.get("line", "caution"), statement_text(statement, at, "brief")
        return
    values = {name: _rendered(value, at, "brief") for name, value in statement.values.items()}
    for label, template in entry["lines"].items():
        yield label, _Ways().vformat(template, (), {"at": at, **values})
