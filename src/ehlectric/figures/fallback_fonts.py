"""Fonts of the system for characters that the font of the figures lacks, as in a Chinese title."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache, lru_cache
from typing import Any

from matplotlib.figure import Figure
from matplotlib.font_manager import FontEntry, findfont, fontManager, get_font
from matplotlib.text import Text

from ehlectric.errors import shown
from ehlectric.quantities.quantity import data_file
from ehlectric.runtime.progress import MACHINE

SCRIPTS: Mapping[str, Any] = data_file("ehlectric.figures", "fallback_fonts.toml")

# Font of boxes that Matplotlib carries for characters that no other font has.
_BOXES = "Last Resort"


def give_fonts(figure: Figure) -> None:
    """Add fonts of the system to the texts of a figure whose characters their own font lacks."""
    for text in figure.findobj(Text):
        assert isinstance(text, Text)
        if not text.get_text().isascii():
            font_file = findfont(text.get_fontproperties())
            families = families_for(text.get_text(), font_file)
            text.set_fontfamily([*dict.fromkeys((*text.get_fontfamily(), *families))])


def families_for(text: str, font_file: str) -> tuple[str, ...]:
    """Families of fonts of the system for the characters of a text that ``font_file`` lacks. A note in
    the log names a text with characters that no font has.
    """
    lacking = frozenset(letter for letter in text if letter.isprintable() and not letter.isspace())
    lacking -= characters_of(str(font_file))
    if not lacking:
        return ()
    entries, missing = fonts_for(lacking)
    if missing:
        _note_missing(text, missing)
    return tuple(entry.name for entry in entries)


@lru_cache(maxsize=256)
def fonts_for(lacking: frozenset[str]) -> tuple[tuple[FontEntry, ...], frozenset[str]]:
    """Fonts of the system that together have some characters, and the characters that no font has."""
    chosen: list[FontEntry] = []
    missing = lacking
    for entry in _in_order(lacking):
        if not missing:
            break
        if covered := missing & characters_of(entry.fname):
            chosen.append(entry)
            missing -= covered
    return tuple(chosen), missing


@cache
def characters_of(file: str) -> frozenset[str]:
    """Characters of a font; none if its file cannot be read."""
    try:
        return frozenset(map(chr, get_font(file).get_charmap()))
    except (OSError, RuntimeError):
        return frozenset()


def _in_order(letters: Iterable[str]) -> Iterator[FontEntry]:
    """Fonts of the system, those that are usual for the scripts of some characters first."""
    usual = [name for script in scripts_of(letters) for name in SCRIPTS[script]["fonts"]]
    places = {name: place for place, name in reversed([*enumerate(usual)])}

    def place(entry: FontEntry) -> tuple[int, bool, bool, str]:
        slanted, heavy = entry.style != "normal", entry.weight not in (400, "normal", "regular")
        return places.get(entry.name, len(usual)), slanted, heavy, entry.name

    yield from sorted((font for font in fontManager.ttflist if not font.name.startswith(_BOXES)), key=place)


def scripts_of(letters: Iterable[str]) -> Sequence[str]:
    """Scripts of some characters. Han follows kana and Hangul: its characters have other shapes in Japanese
    and Korean.

    Examples
    --------
    >>> scripts_of("軸受ベアリング"), scripts_of("轴承"), scripts_of("6208")
    (['kana', 'han'], ['han'], [])
    """
    codes = [*map(ord, letters)]
    return [
        name
        for name, script in SCRIPTS.items()
        if any(low <= code <= high for low, high in script["ranges"] for code in codes)
    ]


_noted_letters: set[str] = set()


def _note_missing(text: str, missing: frozenset[str]) -> None:
    """Write one note about a text with characters that no font has."""
    if missing <= _noted_letters:
        return
    _noted_letters.update(missing)
    line = next(line for line in text.replace("\xa0", " ").split("\n") if missing & set(line))
    letters = "".join(letter for letter in dict.fromkeys(line) if letter in missing)
    MACHINE.warning(
        "no font of this machine has %s of %s: figures and PDF show boxes; install a font such as %s",
        letters,
        shown(line),
        next((SCRIPTS[name]["fonts"][0] for name in scripts_of(missing)), "Noto Sans"),
    )
