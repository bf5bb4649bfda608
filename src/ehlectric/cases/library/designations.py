"""Designations of makers, such as "NU 208 ECP" or "6208-2RS1/C3": the bearing and its class of clearance.

The bearings are in the library or in the usual series, whose geometry is estimated. ``suffixes.csv`` lists
the suffixes that do not change the elements, such as suffixes of seals, cages and tolerances, and the kinds
of bearings for which this is known. Other suffixes are refused: they may change geometry or insulation.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cache

from ehlectric.cases import library
from ehlectric.cases.library.bearing_catalogue import CLASSES, ClearanceClass
from ehlectric.cases.library.estimated_bearings import series
from ehlectric.errors import InputError, shown

# Letters of a bearing type before the number, the number, and what stands behind it.
_DESIGNATION = re.compile(r"([A-Z]{0,3})\s*-?\s*(\d{2,3}/\d{2,3}|\d{3,6})\s*-?\s*(.*)")

# Types with the same rollers and raceways as another one: they differ in the flanges. Of NSK's "HR" tapered
# roller bearings the letters stand for their load ratings.
_SAME_ROLLERS = {"NJ": "NU", "NUP": "NU", "N": "NU", "NF": "NU", "HR": ""}

# Thin deep-groove ball bearings, in whose number ISO has a digit more than NSK.
_THIN = re.compile(r"61([89]\d\d)")
_SEPARATORS = re.compile(r"[\s/.,+-]+")

# Suffixes of insulation, which a bearing file has in other keys.
_INSULATED = {
    "VL0241": "coating", "VL2071": "coating", "J20A": "coating", "J20AA": "coating", "J20B": "coating",
    "J20C": "coating", "HC5": "element_material", "HC4": "element_material", "HC": "element_material",
}  # fmt: skip


@dataclass(frozen=True)
class Designation:
    """Name of a bearing, and its class of clearance before mounting, where the text has one."""

    name: str
    clearance_class: ClearanceClass | None


@cache
def known_bearings() -> Mapping[str, None]:
    """Names of the bearings of the library and of the usual series, those of the library first."""
    return dict.fromkeys((*library.bearing_names(), *series()))


# Kinds of bearings that a word in ``suffixes.csv`` stands for.
_BALL_KINDS = ("deep-groove ball", "angular-contact ball", "four-point contact ball")
_ANY = "any"


@dataclass(frozen=True)
class Suffix:
    """Suffix of designations, with the kinds of bearings whose elements it does not change."""

    text: str
    meaning: str  # meaning for these kinds
    kinds: tuple[str, ...]
    not_series: tuple[str, ...]  # series of these kinds whose elements it changes
    elsewhere: str  # meaning for other kinds; empty if it is unknown

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
    """Suffixes whose meaning is known, by their text."""
    found = {}
    for row in library.rows("suffixes.csv"):
        kinds = [kind for kind in row["kinds"].split("|") if kind]
        found[row["suffix"]] = Suffix(
            text=row["suffix"],
            meaning=row["meaning"],
            kinds=tuple(one for kind in kinds for one in (_BALL_KINDS if kind == "ball" else (kind,))),
            not_series=tuple(part for part in row["not_series"].split("|") if part),
            elsewhere=row["elsewhere"],
        )
    return found


def read_designation(text: str, names: Collection[str]) -> Designation | None:
    """Bearing with a maker's designation; None where there is no such bearing.

    ``names``, names of bearings, as "nu-208" or "7208-b". Raises InputError for a suffix that is not known or
    may change the elements of the bearing, and for a suffix of an insulated ring or of ceramic elements.

    Examples
    --------
    >>> read_designation("NJ 208 ECP/C3", ["nu-208"])
    Designation(name='nu-208', clearance_class='C3')
    """
    found = _DESIGNATION.fullmatch(text.strip().upper())
    if found is None:
        return None
    letters, number, rest = found.groups()
    letters, number = _SAME_ROLLERS.get(letters, letters), _THIN.sub(r"6\1", number)
    stem = "-".join(part for part in (letters, number) if part).lower()
    parts = [part for part in _SEPARATORS.split(rest) if part]
    name = stem if stem in names else None
    if name is None and parts:
        name, parts = _with_angle(stem, parts, names)
    if name is None:
        return None
    classes = [own for part in parts for own in CLASSES if own == part]
    for part in parts:
        _check_suffix(text, part, name)
    if len(classes) > 1:
        raise InputError("base", got=shown(text), takes="one class of clearance, C2, CN, C3, C4 or C5")
    return Designation(name, classes[0] if classes else None)


def _with_angle(stem: str, parts: list[str], names: Collection[str]) -> tuple[str | None, list[str]]:
    """Name of an angular-contact bearing, whose suffixes begin with the letter of its contact angle, as in
    7208 BEP or 7908 A5, and the suffixes without it; None where there is no such bearing.
    """
    whole, letter = f"{stem}-{parts[0].lower()}", f"{stem}-{parts[0][0].lower()}"
    if whole in names:
        return whole, parts[1:]
    more = parts[0][1:]
    return (letter, [*([more] if more else []), *parts[1:]]) if letter in names else (None, parts)


def _check_suffix(text: str, part: str, name: str) -> None:
    """Refuse a suffix that may change the geometry or the insulation of a bearing."""
    if part in _INSULATED:
        given = {"element_material": "'silicon-nitride'", "coating": "that of the ring, such as 'alumina'"}
        takes = f"the designation without {part}, and bearing.{_INSULATED[part]}: {given[_INSULATED[part]]}"
        raise InputError("base", got=shown(text), takes=takes)
    if part in CLASSES:
        return
    known = suffixes().get(part)
    if known is None:
        reason = "which is no suffix that is known: it may change the geometry"
        raise InputError("base", got=shown(text), takes=f"a designation without {part!r}, {reason}")
    kind, of_series = _kind_and_series(name)
    if not known.harmless(kind, of_series):
        if of_series in known.not_series:
            meaning = f"the load ratings of the series {of_series.upper()} here belong to another design"
        else:
            meaning = known.meaning_for(kind)
        takes = f"a designation without {part!r}: on this {kind} bearing {meaning}"
        raise InputError(
            "base", got=shown(text), takes=f"{takes}; or the elements of the bearing without base"
        )


def _kind_and_series(name: str) -> tuple[str, str]:
    """Kind and series of a bearing by its name; the series of a bearing of the library may be unknown."""
    if name in series():
        return series()[name].kind, series()[name].series
    return str(library.bearing(name)["kind"]), ""
