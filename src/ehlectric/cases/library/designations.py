"""Designations of makers, such as "NU 208 ECP" or "6208-2RS1/C3": the bearing and its class of clearance.

Bearings are those of the library, and those of the usual series, whose geometry is estimated. Suffixes of
seals, shields, cages, tolerances and fillings say nothing of the internal geometry, and are read over;
``suffixes.csv`` has them. Others are refused, as they may change the geometry or the insulation.
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


@cache
def suffixes() -> dict[str, str]:
    """Suffixes that say nothing of the internal geometry, with their meaning."""
    return {row["suffix"]: row["meaning"] for row in library.rows("suffixes.csv")}


def read_designation(text: str, names: Collection[str]) -> Designation | None:
    """Bearing with a maker's designation; None where there is no such bearing.

    ``names``, names of bearings, as "nu-208" or "7208-b". Raises InputError for a suffix that is not known,
    and for one of an insulated ring or ceramic elements.

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
        _check_suffix(text, part)
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


def _check_suffix(text: str, part: str) -> None:
    """Refuse a suffix that may change the geometry or the insulation."""
    if part in _INSULATED:
        given = {"element_material": "'silicon-nitride'", "coating": "that of the ring, such as 'alumina'"}
        takes = f"the designation without {part}, and bearing.{_INSULATED[part]}: {given[_INSULATED[part]]}"
        raise InputError("base", got=shown(text), takes=takes)
    if part not in suffixes() and part not in CLASSES:
        takes = (
            f"a designation without {part!r}, which is no suffix that is known: it may change the geometry"
        )
        raise InputError("base", got=shown(text), takes=takes)
