"""Designations of makers, such as "NU 208 ECP" or "6208-2RS1/C3": the bearing and its class of clearance.

The bearings are in the library or in the usual series, whose geometry is estimated. A designation contains
words of makers and prefixes, a number with the letters of its type, the letter of a contact angle, and
suffixes. What is unknown, or may change geometry or insulation, is refused by its name.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache

from ehlectric.cases import library
from ehlectric.cases.library.bearing_catalogue import ClearanceClass
from ehlectric.cases.library.designation_suffixes import Suffix, known_suffix, parted
from ehlectric.cases.library.estimated_bearings import series
from ehlectric.errors import InputError, shown

# Types with the same rollers and raceways as another one: they differ in the flanges.
_SAME_ROLLERS = {"NJ": "NU", "NUP": "NU", "N": "NU", "NF": "NU"}

# Thin bearings, in whose number ISO has a digit more than NSK: 61808, 71908, and 618/8 with a bore of 8 mm.
_THIN = re.compile(r"(?:(6|7)1(?=[89]\d\d)|(6)1(?=[89]/\d\b))")

# Letters of a type; its number, with a bore in millimetres after a slash; and what stands behind it.
_NUMBERED = re.compile(
    r"([A-Z]{0,3})[\s.-]*(\d{2,3}\s?/\s?\d{2,3}(?!\d)|6[1-9]\d/\d(?![\dA-Z])|\d+)(.*)", re.DOTALL
)

# Number of a type whose number is two dimensions, with any sign between them.
_SIZED = re.compile(r"(HK|NK|AXK|NA|RNA)[\s.-]*(\d{2,3})(\s?[\sX*/.-]\s?)(\d{2,3})(?![\dX])(.*)", re.DOTALL)

# Types in whose number a slash has a meaning.
_SLASHED = ("NK", "NA", "RNA")

# Series of cylindrical roller bearings that makers have with and without reinforced rollers.
_REINFORCED = ("nu-2", "nu-22", "nu-3", "nu-23")

_SEPARATORS = re.compile(r"[\s/.,;:+_()-]+")
_DASHES = dict.fromkeys(map(ord, "‐‑‒–—―−⁃﹘﹣－"), "-") | {ord("×"): "X"}
_MARKS = dict.fromkeys(map(ord, "®™©℠\"'`´“”„‘’"), " ")

# Letters of contact angles, the longest first, and their letter in the names of series: 25 degrees are A5 of
# NSK and AC of SKF and Koyo.
_ANGLES = {"A5": "a5", "AC": "a5", "A": "a", "B": "b", "C": "c"}

# Sealed on both sides, written without a sign behind the number: 62082RS.
_TWO_SEALS = re.compile(r"(RS|RZ|Z(?!Z)|NSE|NKE|RU|RD|RK|HRS|BRS)")


@dataclass(frozen=True)
class Designation:
    """Name of a bearing, and its class of clearance before mounting, where the text has one."""

    name: str
    clearance_class: ClearanceClass | None


@dataclass(frozen=True)
class Prefix:
    """Word or letters before the number of a bearing, with the kinds whose elements they do not change."""

    pattern: re.Pattern[str]
    group: str
    kinds: tuple[str, ...]
    meaning: str
    instead: str


@dataclass(frozen=True)
class Parts:
    """Designation without words of makers: letters of its type, number, and the parts behind it."""

    prefixes: tuple[tuple[str, Prefix], ...]
    head: str  # what stands behind the prefixes, without a space behind the letters of the type
    stems: tuple[str, ...]  # names that the number can mean, without a contact angle
    rest: tuple[str, ...]
    maker: str  # first word of a maker, as FAG; empty without one


@cache
def known_bearings() -> Mapping[str, None]:
    """Return the bearing names of the library, then of the usual series."""
    return dict.fromkeys((*library.bearing_names(), *series()))


@cache
def _prefixes() -> tuple[Prefix, ...]:
    """Known prefixes. After letters a sign or a digit follows, after a digit a sign."""
    prefixes = []
    for row in library.rows("designation_prefixes.csv"):
        pattern = rf"({row['prefix']})(?:[\s/.,;:+_()-]+|(?<=[A-Z])(?=\d)|$)"
        if row["group"] != "prefix":
            pattern = rf"({row['prefix']})(?:[\s/.,;:+_()-]+|(?=\d|NU|NJ|QJ|HK|NK|NA|RNA|AXK)|$)"
        kinds = tuple(kind for kind in row["kinds"].split("|") if kind)
        prefixes.append(Prefix(re.compile(pattern), row["group"], kinds, row["meaning"], row["instead"]))
    return tuple(prefixes)


def plain(text: str) -> str:
    r"""Text in capital letters with plain spaces, dashes and digits.

    Examples
    --------
    >>> plain("nu\u00a0208 – ecp"), plain("６２０８")
    ('NU 208 - ECP', '6208')
    """
    return as_typed(text).replace("X-LIFE", "XL")


def as_typed(text: str) -> str:
    r"""Text of a designation for a case, in capital letters with single spaces and plain dashes.

    Examples
    --------
    >>> as_typed(" fag  6208–2rsr c3\n")
    'FAG 6208-2RSR C3'
    """
    normal = unicodedata.normalize("NFKC", text.translate(_DASHES).translate(_MARKS))
    return " ".join(normal.translate(_DASHES).upper().split())


@lru_cache(maxsize=1024)
def parts_of(text: str) -> Parts:
    """Prefixes, number and suffixes of a designation."""
    rest, prefixes, makers = plain(text).lstrip("( #"), [], []
    while rest:
        first = next(((prefix, hit) for prefix in _prefixes() if (hit := prefix.pattern.match(rest))), None)
        if first is None:
            break
        if first[0].group == "prefix":
            prefixes.append((first[1][1], first[0]))
        makers += [first[1][1]] if first[0].group == "maker" else []
        rest = rest[first[1].end() :].lstrip()
    head = re.sub(r"^([A-Z]+)[\s.-]+(?=\d)", r"\1", rest)
    stems, behind = _stems(rest)
    words = tuple(part for part in _SEPARATORS.split(behind) if part)
    while words and (group := _group_of(words[-1])) in ("maker", "word"):
        makers += [words[-1]] if group == "maker" else []
        words = words[:-1]
    return Parts(tuple(prefixes), head, stems, words, makers[0] if makers else "")


def seals_of(text: str) -> str:
    """Seals or shields of a designation in words; empty without a suffix for them.

    Examples
    --------
    >>> seals_of("SKF 6208-2RS1/C3"), seals_of("6309-2Z"), seals_of("NU 208 ECP")
    ('two rubbing seals (SKF)', 'two shields', '')
    """
    parts = (part for word in parts_of(text).rest for part in parted(word)[0])
    return next((part.meaning for part in parts if part.group == "seal"), "")


def _group_of(word: str) -> str:
    """Group of a word of makers or for a bearing behind a number; empty for another word."""
    return next((prefix.group for prefix in _prefixes() if prefix.pattern.fullmatch(word)), "")


def _stems(text: str) -> tuple[tuple[str, ...], str]:
    """Names that letters and number can mean, and the text behind them; no names without a number."""
    sized = _SIZED.fullmatch(text)
    if sized is not None:
        letters, first, sign, second, behind = sized.groups()
        stems = f"{letters}-{first}/{second}".lower(), f"{letters}-{first}{second}".lower()
        if letters not in _SLASHED:
            return stems[1:], behind
        # NA 49/22 has a bore of 22 mm and NA 4922 one of 110 mm.
        return (stems[:1] if letters == "NK" or "/" in sign else stems), behind
    match = _NUMBERED.fullmatch(text)
    if match is None:
        return (), ""
    letters, number, behind = match[1], re.sub(r"\s", "", match[2]), match[3]
    if not letters:
        number = _THIN.sub(lambda hit: hit[1] or hit[2], number)
        number = re.sub(r"^(6[89])/(\d)$", r"\1\2", number)
    letters = _SAME_ROLLERS.get(letters, letters)
    return ("-".join(part for part in (letters, number) if part).lower(),), behind


def read_designation(text: str, names: Collection[str]) -> Designation | None:
    """Bearing with a maker's designation; None where there is no such bearing.

    ``names``, names of bearings, as "nu-208" or "7208-b". Raises InputError for a prefix or a suffix that is
    not known or may change the elements of the bearing, such as VL0241 of an insulated ring.

    Examples
    --------
    >>> read_designation("NJ 208 ECP/C3", ["nu-208"])
    Designation(name='nu-208', clearance_class='C3')
    """
    whole = "-".join(text.lower().split())
    if whole in names:
        return Designation(whole, None)
    parts = parts_of(text)
    readings = [reading for stem in parts.stems if (reading := _named(stem, parts.rest, names)) is not None]
    readings += _with_two_seals(parts, names)
    if not readings:
        return None
    if len(readings) > 1:
        takes = "a sign between number and suffix: it can be " + " or ".join(
            name.upper() for name, _ in readings
        )
        raise InputError("base", got=shown(text), takes=takes)
    name, rest = readings[0]
    for word, prefix in parts.prefixes:
        _check_prefix(text, word, prefix, name)
    _check_angle_letters(text, name, parts.rest)
    suffixes = tuple(_checked_suffixes(text, rest, name))
    _check_reinforced(text, suffixes, name)
    classes = [suffix.clearance for suffix in suffixes if suffix.clearance]
    if len(set(classes)) > 1:
        raise InputError("base", got=shown(text), takes="one class of clearance, C2, CN, C3, C4, C5 or CM")
    return Designation(name, classes[0] if classes else None)


def _named(stem: str, rest: Sequence[str], names: Collection[str]) -> tuple[str, tuple[str, ...]] | None:
    """Name of a bearing and its suffixes, or None. The suffixes of an angular-contact bearing begin with the
    letter of its contact angle, as in 7208 BEP or 7908 A5.
    """
    if stem in names:
        return stem, tuple(rest)
    if not rest:
        return None
    letter, more = _angle(rest)
    name = f"{stem}-{_ANGLES[letter]}" if letter else ""
    if name in names:
        return name, ((more,) if more else ()) + tuple(rest[1:])
    whole = f"{stem}-{rest[0].lower()}"
    return (whole, tuple(rest[1:])) if whole in names else None


def _angle(rest: Sequence[str]) -> tuple[str, str]:
    """Letters of a contact angle at the beginning of the first suffix, and what is behind them in it; empty
    letters if there are none. C with a class of clearance, as in "7208 C3", is no contact angle.
    """
    if re.match(r"C([NM\d]|T$)", rest[0]) or (rest[0] == "C" and rest[1:2] and rest[1].isdigit()):
        return "", rest[0]
    letter = next((letters for letters in _ANGLES if rest[0].startswith(letters)), "")
    more = rest[0][len(letter) :]
    if letter == "AC" and more[:1].isdigit():
        return "A", f"C{more}"
    # CD and ACD are SKF's super-precision designs with the usual balls; CDB, CDF and CDT are sets with C.
    return letter, re.sub(r"^D(?![BFT])", "", more) if letter in ("C", "AC") else more


def _with_two_seals(parts: Parts, names: Collection[str]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Reading of a number whose last digit belongs to the suffix, as in 62082RS."""
    if not parts.rest or not _TWO_SEALS.match(parts.rest[0]):
        return
    seals = f"2{parts.rest[0]}"
    for stem in parts.stems:
        if stem.endswith("2") and seals in parts.head and stem[:-1] in names:
            yield stem[:-1], (seals, *parts.rest[1:])


def _check_prefix(text: str, word: str, prefix: Prefix, name: str) -> None:
    """Refuse a prefix that may change the elements of a bearing."""
    if "any" not in prefix.kinds and kind_and_series(name)[0] not in prefix.kinds:
        raise refused(text, word, prefix.meaning, prefix.instead)


def refused(text: object, part: str, meaning: str, instead: str) -> InputError:
    """Error of a part of a designation that is not read; ``instead``, what to give, or a choice with "or"."""
    also = f", {instead}" if instead.startswith("or ") else f", and {instead}"
    takes = f"the designation without {part!r}, which means {meaning}{also}"
    return InputError("base", got=shown(text), takes=takes)


def _check_angle_letters(text: str, name: str, rest: Sequence[str]) -> None:
    """Refuse letters with a contact angle that are not known: CA and AD mean other angles than C and A."""
    kind, of_series = kind_and_series(name)
    if kind != "angular-contact ball" or not rest:
        return
    more = _angle(rest)[1]
    known, unknown = parted(more) if more else ((), "")
    if unknown or any(suffix.group == "design" and not suffix.harmless(kind, of_series) for suffix in known):
        angles = "A (30 deg), A5 or AC (25 deg), B or BE (40 deg), C or CD (15 deg)"
        takes = f"letters of a contact angle that are known, {angles}: {shown(rest[0])} may mean other balls"
        raise InputError("base", got=shown(text), takes=f"{takes} or another angle")


def _checked_suffixes(text: str, rest: Sequence[str], name: str) -> Iterator[Suffix]:
    """Suffixes of a bearing; raises one InputError for all that are unknown or may change its elements."""
    kind, of_series = kind_and_series(name)
    wrong, classes = list[str](), list[str]()
    bore = 1e3 * series()[name].bore if name in series() else None
    for part in _joined(rest, bore):
        known, unknown = parted(part, bore)
        if unknown:
            latin = "" if unknown.isascii() else " in Latin letters"
            takes = (
                f"a designation without {shown(unknown)}, which is no suffix that is known{latin}: it may "
                "change the geometry; omit it only if the catalogue says that all elements are the same"
            )
            wrong.append(takes)
        for suffix in known:
            try:
                _check_suffix(text, suffix, kind, of_series)
            except InputError as error:
                wrong.append(error.takes or "")
            else:
                classes += [suffix.text] if suffix.group == "clearance" else []
        yield from known
    if wrong:
        left = "/".join([name, *classes])
        raise InputError("base", got=shown(text), takes=f"{'; '.join(wrong)}; the rest is base = {left!r}")


def _joined(rest: Sequence[str], bore: float | None) -> Iterator[str]:
    """Parts of which two are joined where only both together are a suffix, as "2 RS" or "C 3"."""
    parts = list(rest)
    while parts:
        part = parts.pop(0)
        if parts and known_suffix(part + parts[0], bore) and (part.isdigit() or parts[0].isdigit()):
            part += parts.pop(0)
        yield part


def _check_suffix(text: str, suffix: Suffix, kind: str, of_series: str) -> None:
    """Refuse a suffix that may change the geometry or the insulation of a bearing."""
    if suffix.harmless(kind, of_series):
        return
    part = suffix.text
    if suffix.instead:
        raise refused(text, part, suffix.meaning, suffix.instead)
    if of_series in suffix.not_series:
        meaning = f"the load ratings of the series {of_series.upper()} here belong to another design"
    else:
        meaning = suffix.meaning_for(kind)
    takes = f"a designation without {part!r}: on this {kind} bearing {meaning}"
    raise InputError("base", got=shown(text), takes=f"{takes}; or the elements of the bearing without base")


def _check_reinforced(text: str, suffixes: Sequence[Suffix], name: str) -> None:
    """Refuse a cage or the type NF without a reinforced design: they mean smaller rollers at some makers."""
    if kind_and_series(name)[1] not in _REINFORCED:
        return
    reinforced = any(suffix.group == "design" and suffix.text.startswith("E") for suffix in suffixes)
    old = ["NF"] if parts_of(text).head.startswith("NF") else []
    old += [suffix.text for suffix in suffixes if suffix.group == "cage"]
    if old and not reinforced:
        meaning = "smaller rollers at some makers if there is no E"
        raise refused(text, old[0], meaning, "or with E, such as 'NU 208 E' or 'NU 208 EM'")


def kind_and_series(name: str) -> tuple[str, str]:
    """Kind and series of a bearing by its name; the series of a bearing of the library may be unknown."""
    if name in series():
        return series()[name].kind, series()[name].series
    return str(library.bearing(name)["kind"]), ""
