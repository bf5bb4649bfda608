"""Letters of a PDF that its fonts lack: fonts of the system, else boxes, whose text can still be found."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping
from functools import cache, lru_cache
from itertools import groupby
from pathlib import Path
from xml.sax.saxutils import escape

import matplotlib as mpl
from reportlab.pdfbase.pdfmetrics import registerFont
from reportlab.pdfbase.ttfonts import TTFError, TTFont

from ehlectric.errors import shown
from ehlectric.figures.fallback_fonts import characters_of, families_for, fonts_for
from ehlectric.runtime.progress import MACHINE

# Folder of the fonts that Matplotlib carries, and the font whose letters all texts have.
FOLDER = Path(mpl.get_data_path()) / "fonts" / "ttf"
_BUNDLED = str(FOLDER / "DejaVuSans.ttf")

# Letter whose shape is a box.
_BOX = 0x25A1

# Directions of letters that are written from right to left.
_LEFTWARD = frozenset({"R", "AL"})


def marked(text: str) -> str:
    """Text in the markup of reportlab, with its own characters escaped, and with fonts for all letters."""
    if text.isascii():
        return escape(text)
    return "".join(
        f'<font name="{font}">{escape(run)}</font>' if font else escape(run) for font, run in runs_of(text)
    )


def runs_of(text: str) -> Iterator[tuple[str, str]]:
    """Parts of a text with the names of their fonts; an empty name is the font of the text itself."""
    _tell_direction(text)
    families_for(text, _BUNDLED)  # a note names letters that no font has
    faces = _faces(frozenset(text) - characters_of(_BUNDLED))
    for font, letters in groupby(text, key=lambda letter: faces.get(letter, "")):
        yield font, "".join(letters)


@lru_cache(maxsize=1024)
def _faces(lacking: frozenset[str]) -> Mapping[str, str]:
    """Registered fonts by the letters that they have, for those that the fonts of the package lack."""
    faces: dict[str, str] = {}
    for entry in fonts_for(lacking)[0]:
        if name := _registered(entry.name, entry.fname, getattr(entry, "index", 0)):
            faces = dict.fromkeys(lacking & characters_of(entry.fname), name) | faces
    boxes = _boxes()
    for letter in lacking - faces.keys():
        # The text of the file keeps the letter, so that it can be found and copied.
        boxes.face.charToGlyph[ord(letter)] = boxes.face.charToGlyph[_BOX]
    return dict.fromkeys(lacking, boxes.fontName) | faces


@cache
def _boxes() -> TTFont:
    """Font of boxes for letters that no other font has."""
    font = TTFont("Boxes", _BUNDLED)
    registerFont(font)
    return font


@cache
def _registered(name: str, file: str, index: int) -> str:
    """Name of a font by its file; empty if reportlab cannot embed its kind."""
    try:
        registerFont(TTFont(name, file, subfontIndex=index))
    except (TTFError, OSError):
        return ""
    return name


_noted: set[str] = set()


def _tell_direction(text: str) -> None:
    """Write one note about letters that a PDF shows in the wrong order, because reportlab knows none."""
    if not _noted and any(unicodedata.bidirectional(letter) in _LEFTWARD for letter in text):
        _noted.add(text)
        MACHINE.warning(
            "the texts of the PDF show %s from left to right with unjoined letters: its figures and the HTML "
            "report show it correctly",
            shown(text.partition("\n")[0]),
        )
