"""Verdict on a result as data: whether the film breaks down, the numbers that decide, and the reasons.

``ehlectric.quantities.verdict_texts`` has the words. No module reads rendered text.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ehlectric.quantities.statement import Bound, Fact, Level, Statement
from ehlectric.quantities.verdict_texts import (
    assumed_text,
    bound_words,
    first_words,
    heading,
    is_code,
    lines_of,
    statement_text,
)
from ehlectric.readable import capital

# Width of the labels of the lines [characters].
WIDTH_OF_LABEL = 13


@dataclass(frozen=True)
class Verdict:
    """Answer to the question whether films break down. ``print`` shows its lines, as commands do.

    Attributes
    ----------
    level : str
        "green": no breakdown expected; "yellow": breakdown is possible within the uncertainty; "red":
        breakdown expected, or surfaces that touch under a voltage; "grey": there is no voltage or no
        strength to judge by.
    code : str
        Code of the first words, such as "breakdown-likely".
    answer : Statement or None
        The numbers that decide; None where there are none.
    at : Statement or None
        Operating point; None of a contact and of a sweep.
    facts : tuple of Fact
        Quantities that decide.
    reasons : tuple of Statement
        Why the answer is as it is, and what it does not contain.
    assumptions : tuple of Statement
        Clauses on what is assumed.
    bound : str
        "upper" where the breakdown voltage is an upper bound, "best" for a best estimate, empty otherwise.

    Examples
    --------
    >>> verdict = Verdict("green", "breakdown-excluded", facts=(Fact("bearing.margin", 1.44),))
    >>> verdict.margin, verdict.lead, verdict.text
    (1.44, 'No breakdown expected', 'No breakdown expected.')
    """

    level: Level
    code: str
    answer: Statement | None = None
    at: Statement | None = None
    facts: tuple[Fact, ...] = ()
    reasons: tuple[Statement, ...] = ()
    assumptions: tuple[Statement, ...] = ()
    bound: Bound = ""

    def __post_init__(self) -> None:
        if not is_code(self.code):
            text = "Verdict(level, text) is deprecated; use Verdict(level, code)"
            warnings.warn(text, DeprecationWarning, stacklevel=3)

    @property
    def margin(self) -> float | None:
        """Breakdown voltage / applied voltage, dimensionless; None where there is none."""
        return next((fact.value for fact in self._margins()), None)

    @property
    def interval(self) -> tuple[float, float] | None:
        """Smallest and largest margin that are possible, dimensionless; None where none is stated."""
        return next((fact.interval for fact in self._margins()), None)

    def _margins(self) -> Iterator[Fact]:
        return (fact for fact in self.facts if fact.key.endswith("margin"))

    @property
    def lead(self) -> str:
        """First words of the answer, as "Breakdown likely"."""
        return first_words(self.code, self.answer)

    @property
    def heading(self) -> str:
        """Heading, which says where the film is an ideal one.

        Examples
        --------
        >>> Verdict("green", "breakdown-excluded", bound="upper").heading
        'No breakdown expected in an ideal film'
        """
        return heading(self.code, self.answer, self.level, self.bound)

    @property
    def bound_note(self) -> str:
        """Words after the heading of a verdict on an upper bound; empty otherwise."""
        return bound_words(self.bound)

    @property
    def numbers(self) -> str:
        """Sentence with the numbers that decide, without the first words; empty where there are none."""
        return "" if self.answer is None else capital(statement_text(self.answer, self.where))

    @property
    def where(self) -> str:
        """Operating point as text; empty without one."""
        return "" if self.at is None else statement_text(self.at)

    @property
    def assumed(self) -> str:
        """Sentence about what is assumed; empty where nothing is."""
        return assumed_text(self.assumptions, self.bound, self.where)

    def sentences(self, without: tuple[str, ...] = ()) -> tuple[str, ...]:
        """Return the sentences of the reasons, without some codes."""
        kept = (statement for statement in self.reasons if statement.code not in without)
        return tuple(capital(statement_text(statement, self.where)) for statement in kept)

    def rest(self, reasons: int | None = None) -> str:
        """Return the sentences after the first words; ``reasons``, number of reasons, or all of them."""
        return " ".join(filter(None, (self.numbers, *self.sentences()[:reasons], self.assumed)))

    @property
    def text(self) -> str:
        """The whole answer in sentences."""
        answer = "." if self.answer is None else f": {statement_text(self.answer, self.where)}"
        return " ".join(filter(None, (f"{self.lead}{answer}", *self.sentences(), self.assumed)))

    def lines(self) -> Iterator[tuple[str, str]]:
        """Return the lines: heading and operating point without a label, then labels with their texts.

        Examples
        --------
        >>> reason = Statement.of("warning", code="tunnelling")
        >>> [label for label, _ in Verdict("yellow", "breakdown-unknown", reasons=(reason,)).lines()]
        ['', 'caution']
        """
        yield "", " ".join(filter(None, (self.heading, self.where)))
        stated = [statement for statement in (self.answer, *self.reasons) if statement is not None]
        yield from lines_of(stated, self.where)
        if self.assumptions:
            yield "model", assumed_text(self.assumptions, self.bound, self.where, form="brief")

    def as_data(self) -> dict[str, Any]:
        """Return the entries of ``summary.json``: text, level, and codes and values of all statements."""
        stated = (self.answer, *self.reasons, *self.assumptions)
        reasons = [statement.as_data() for statement in stated if statement is not None]
        return {"verdict": self.text, "verdict_level": self.level, "verdict_reasons": reasons}

    def printed_lines(self) -> Iterator[tuple[str, str]]:
        """Return the lines without a label that repeats the label of the line before."""
        last = ""
        for label, text in self.lines():
            yield "" if label == last else label, text
            last = label

    def __str__(self) -> str:
        (_, heading), *labelled = self.printed_lines()
        return "\n".join([heading, *(f"  {label:{WIDTH_OF_LABEL}}{text}" for label, text in labelled)])
