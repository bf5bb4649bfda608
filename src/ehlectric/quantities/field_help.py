"""Help for the fields of the app: meaning of an input, usual values, and effects if the input increases.

The entry of an input has its meaning, usual values and effects; ``field_help.toml`` has the words of the
effects, which a test compares with solved examples, and of the sources of usual values.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ehlectric.quantities.inputs import (
    Input,
    attributes,
    first_clause,
    input_at,
    key_of_list,
    plain_text,
)
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.units import printed, rounded
from ehlectric.readable import capital


@dataclass(frozen=True, kw_only=True)
class Help:
    """Usual values of an input and effects of a larger value.

    ``usual`` has two numbers in the unit of the field, or a phrase; it is None where no source is known, and
    empty where a range says nothing. ``rises`` and ``falls`` are names of effects.
    """

    usual: Sequence[float] | str | None = None
    source: str = ""
    more: str = ""
    rises: Sequence[str] = ()
    falls: Sequence[str] = ()


def _data() -> dict[str, dict[str, Any]]:
    return data_file("ehlectric.quantities", "field_help.toml")


def effect(name: str) -> dict[str, Any]:
    """Sentence of an effect as it rises and as it falls, and its keys in summaries.

    Examples
    --------
    >>> effect("film")["falls"]
    'the films get thinner'
    """
    texts: dict[str, Any] = _data()["effects"][name]
    return texts


def help_at(key: str) -> Help:
    """Usual values and effects of the input of a dotted key."""
    return Help(**attributes("help").get(key_of_list(key), {}))


def help_text(key: str) -> str:
    """Help of the field of a dotted key, two to four short sentences as plain text.

    Examples
    --------
    >>> help_text("motor.rise_time").partition(". ")[2]
    'Usual: 0.05 to 0.1 µs (assumed for typical inverters).'
    >>> help_text("bearing.outer_ring_temperature").rpartition(". ")[2]
    'If the value increases, the capacitance rises, the films get thinner and the breakdown voltage falls.'
    """
    entry = input_at(key)
    if entry is None:
        raise KeyError(key)
    about, meaning = help_at(key), plain_text(first_clause(entry.meaning))
    parts = [meaning, about.more.rstrip("."), _usual_text(entry, about), _effect_text(about)]
    return " ".join(f"{capital(part)}." for part in parts if part)


def _usual_text(entry: Input, about: Help) -> str:
    """Sentence on the usual values of an input, without its full stop."""
    if about.usual is None:
        return "" if entry.kind in ("choice", "text") else "No source of usual values is known"
    if isinstance(about.usual, str):
        words = about.usual
    else:
        low, high = (rounded(value) for value in about.usual)
        words = " ".join(filter(None, [f"{low} to {high}", printed(entry.shown)]))
    source = _data()["sources"].get(about.source, about.source)
    return f"usual: {words}{f' ({source})' if source else ''}" if words else ""


def _effect_text(about: Help) -> str:
    """Sentence on the results that rise or fall as an input grows, without its full stop."""
    words = [effect(name)["rises"] for name in about.rises] + [effect(name)["falls"] for name in about.falls]
    if not words:
        return ""
    return "if the value increases, " + " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))
