"""Types of bearings by their designations: why there is no bearing with a designation, and similar ones."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache

from ehlectric.cases import library
from ehlectric.cases.bearing_kinds import KINDS_OF_BEARINGS
from ehlectric.cases.library.designations import Parts, known_bearings, parts_of, refused
from ehlectric.cases.library.estimated_bearings import series
from ehlectric.errors import InputError, shown

# Designations of some kinds, for a text that is like none.
_EXAMPLES = ("6208", "NU 210 ECP", "7210 BEP")


# Least two digits at the end of a number that are the bore divided by 5 mm.
_LEAST_OF_FIVES = 4


@dataclass(frozen=True)
class DesignationType:
    """Type of bearings whose designations begin in the same way."""

    pattern: re.Pattern[str]
    kind: str
    hint: str

    @property
    def modelled(self) -> bool:
        """Whether its bearings are of a kind of the model."""
        return self.kind in KINDS_OF_BEARINGS


@cache
def _types() -> tuple[DesignationType, ...]:
    return tuple(
        DesignationType(re.compile(row["pattern"]), row["kind"], row["hint"])
        for row in library.rows("designation_types.csv")
    )


def type_of(head: str) -> DesignationType | None:
    """Type of a designation without words of makers; None if it is not known.

    Examples
    --------
    >>> type_of("22210 E").kind, type_of("NU299").modelled, type_of("own")
    ('spherical roller', True, None)
    """
    return next((kind for kind in _types() if kind.pattern.match(head)), None)


def no_such_bearing(text: object) -> InputError:
    """Error of a designation that is none of the library or of the usual series: what is unknown about it.

    The error names the kind of bearings that are not modelled. Examples in it are of the kind of the text.
    """
    parts = parts_of(text) if isinstance(text, str) else Parts((), "", (), (), "")
    known = type_of(parts.head)
    for word, prefix in parts.prefixes:
        if not prefix.kinds:
            return refused(text, word, prefix.meaning, prefix.instead)
    angles = _angles(parts)
    if known is None:
        why, takes = _unknown(parts), _usual(_alike(str(text)) or _EXAMPLES)
    elif not known.modelled:
        why = f", a designation of {known.kind} bearings, a kind that is not modelled"
        takes = f"a bearing of one of the kinds {', '.join(KINDS_OF_BEARINGS)}"
    elif angles:
        where = f", and {shown(parts.rest[0])} begins with none" if parts.rest else ""
        why = f", a number of angular-contact ball bearings that needs the letter of its contact angle{where}"
        takes = angles
    else:
        hint = f": {known.hint}" if known.hint else ""
        why = (
            f", a designation of {known.kind} bearings that is not in the library or in a usual series{hint}"
        )
        takes = _usual(_of_kind(known.kind, parts))
    got = shown(text)
    return InputError.worded("base", f"got {got}{why}; expected {takes}", got=got, takes=takes)


def _usual(examples: Sequence[str]) -> str:
    named = ", ".join(map(repr, examples))
    return (
        f"a bearing of the library or a designation of the usual series, as a string, such as {named} "
        "(list: ehlectric bearings); or omit base and give kind, elements, element_diameter, "
        "pitch_diameter and the other keys of the bearing"
    )


def _number(head: str) -> str:
    """Letters and digits at the beginning of a designation."""
    match = re.match(r"[A-Z]*\d*[A-Z]?\d+(?:[/-]\d+)?|\S+", head)
    return match[0] if match else head


def _unknown(parts: Parts) -> str:
    """What is unknown about a designation whose type is not known."""
    letters = re.match(r"[^\W\d_]+", parts.head)
    if letters is not None and any(sign.isdigit() for sign in parts.head):
        return f", of which the type or the prefix {shown(letters[0])} is not known"
    return f", of which {shown(_number(parts.head))} is no number of a known type" if parts.head else ""


def _angles(parts: Parts) -> str:
    """Designations of angular-contact bearings with the number of a text without a known contact angle."""
    variants = (row for stem in parts.stems for name, row in series().items() if name.startswith(f"{stem}-"))
    return " or ".join(
        f"'{row.name.upper().replace('-', ' ')}' ({math.degrees(row.contact_angle or 0.0):.0f} deg)"
        for row in variants
    )


def _alike(text: str) -> list[str]:
    """Names of bearings that are spelled almost in the same way."""
    return get_close_matches(text.strip().lower().replace(" ", "-"), tuple(known_bearings()), n=3, cutoff=0.8)


def _of_kind(kind: str, parts: Parts) -> list[str]:
    """Bearings of a kind with the bore and the name that are nearest to a designation, nearest first."""
    stem = parts.stems[0] if parts.stems else parts.head.lower()
    names = [name for name, entry in series().items() if entry.kind == kind]

    # The number of a needle bearing is its two dimensions.
    number = None if "needle" in kind else re.search(r"\d(\d\d)(?!\d)", parts.head)
    bore = 5e-3 * int(number[1]) if number is not None and int(number[1]) >= _LEAST_OF_FIVES else None

    def far(name: str) -> tuple[float, int, int]:
        pairs = enumerate(zip(stem, name, strict=False))
        alike = next((place for place, (a, b) in pairs if a != b), min(len(stem), len(name)))
        away = 0.0 if bore is None else round(abs(series()[name].bore - bore), 6)
        return (
            away,
            -alike,
            abs(_digits(name.partition("-")[0] if name[0].isdigit() else name) - _digits(stem)),
        )

    return sorted(names, key=far)[:3]


def _digits(name: str) -> int:
    return int(re.sub(r"\D", "", name) or 0)
