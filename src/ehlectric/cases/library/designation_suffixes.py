"""Suffixes of designations, such as "2RS1" or "C3WT": meaning, and kinds for which they are harmless."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from typing import Any

from ehlectric.cases import library
from ehlectric.cases.library.bearing_catalogue import ClearanceClass

# Kinds of bearings that a word in ``suffixes.csv`` stands for.
_BALL_KINDS = ("deep-groove ball", "angular-contact ball", "four-point contact ball")
_ANY = "any"

# Letters of a suffix at most.
_LONGEST = 12


@dataclass(frozen=True)
class Suffix:
    """Suffix of designations, with the kinds of bearings whose elements it does not change."""

    text: str  # as it is written; in ``suffixes``, "#" stands for a digit
    group: str  # what the suffix is about; of a group, one suffix is written
    kinds: tuple[str, ...]
    not_series: tuple[str, ...]  # series of these kinds whose elements it changes
    meaning: str  # meaning for these kinds
    elsewhere: str  # meaning for other kinds; empty if it is unknown
    instead: str  # advice if the suffix is refused; empty for the usual one
    clearance: ClearanceClass | None  # class of clearance that the suffix stands for
    bore_below: float | None  # the suffix exists only on smaller bores [mm]

    def harmless(self, kind: str, of_series: str) -> bool:
        """Whether the suffix does not change the elements of a bearing of a kind and a series."""
        return (_ANY in self.kinds or kind in self.kinds) and of_series not in self.not_series

    def meaning_for(self, kind: str) -> str:
        """Meaning for a bearing whose elements the suffix may change."""
        if not self.kinds or (self.elsewhere and kind.endswith("ball")):
            return f"it means {self.elsewhere or self.meaning}"
        of = "any other kind" if _ANY in self.kinds else f"bearings of kind {' or '.join(self.kinds)}"
        return f"it means {self.meaning} on {of}, and may change the elements here"


@cache
def suffixes() -> dict[str, Suffix]:
    """Suffixes whose meaning is known, by their text, in which "#" stands for a digit."""
    known = {}
    for row in library.rows("suffixes.csv"):
        kinds = [kind for kind in row["kinds"].split("|") if kind]
        clearance: Any = row["clearance"] or None
        known[row["suffix"]] = Suffix(
            text=row["suffix"],
            group=row["group"],
            kinds=tuple(name for kind in kinds for name in (_BALL_KINDS if kind == "ball" else (kind,))),
            not_series=tuple(part for part in row["not_series"].split("|") if part),
            meaning=row["meaning"],
            elsewhere=row["elsewhere"],
            instead=row["instead"],
            clearance=clearance,
            bore_below=float(row["bore_below"]) if row["bore_below"] else None,
        )
    return known


@lru_cache(maxsize=4096)
def known_suffix(text: str, bore: float | None = None) -> Suffix | None:
    """Suffix of a bearing with a bore [mm]; None if it is not known.

    Examples
    --------
    >>> known_suffix("VT143").group, known_suffix("C3WT")
    ('grease', None)
    """
    suffix = suffixes().get(text) or suffixes().get(re.sub(r"\d", "#", text))
    if suffix is None:
        shapes = (known for known in suffixes().values() if "#" in known.text)
        suffix = next((known for known in shapes if re.fullmatch(known.text.replace("#", r"\d"), text)), None)
    if suffix is None or (suffix.bore_below is not None and (bore is None or bore >= suffix.bore_below)):
        return None
    return replace(suffix, text=text)


@lru_cache(maxsize=1024)
def parted(text: str, bore: float | None = None) -> tuple[tuple[Suffix, ...], str]:
    """Suffixes that are written together, and what is unknown of them.

    ``bore``, bore of the bearing [mm]. The fewest suffixes count. They are of different groups, and at most
    one of them is a single letter, because any letters could be divided into single ones.

    Examples
    --------
    >>> [one.text for one in parted("2RS1C3WT")[0]], parted("C3XYZ")[1]
    (['2RS1', 'C3', 'WT'], 'XYZ')
    """
    whole = min(_divided(text, bore), key=lambda way: (len(way), _singles(way)), default=None)
    if whole is not None:
        return whole, ""
    # Single letters in front of what is unknown may belong to it.
    ends = range(min(len(text) - 1, 5 * _LONGEST), 1, -1)
    certain = (end for end in ends for way in _divided(text[:end], bore) if len(way[-1].text) > 1)
    return (), text[next(certain, 0) :]


def _singles(suffixes: Sequence[Suffix]) -> int:
    """Number of single letters."""
    return sum(len(last.text) == 1 for last in suffixes)


def _divided(text: str, bore: float | None, before: tuple[Suffix, ...] = ()) -> Iterator[tuple[Suffix, ...]]:
    """Ways to divide a text into suffixes."""
    if not text:
        yield before
    for end in range(min(len(text), _LONGEST), 0, -1):
        last = known_suffix(text[:end], bore)
        if (
            last is None
            or last.group in {suffix.group for suffix in before}
            or (end == 1 and _singles(before))
        ):
            continue
        yield from _divided(text[end:], bore, (*before, last))
