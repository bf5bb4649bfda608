"""Colours of the pages: contrast of text and signs, in light and dark, as WCAG 2.2 asks."""

import re

import pytest

from tests.helpers.places import ROOT

SHEET = (ROOT / "src/ehlectric/app/static/ehlectric.css").read_text(encoding="utf-8")

# Pairs of colours: text on its ground.
TEXTS = [
    *(
        ("ink", ground)
        for ground in ("page", "card", "soft", "green-soft", "yellow-soft", "red-soft", "grey-soft")
    ),
    *(("muted", ground) for ground in ("page", "card", "soft")),
    *(("accent", ground) for ground in ("page", "card", "soft")),
    ("on-accent", "accent"),
    *((level, f"{level}-soft") for level in ("green", "yellow", "red", "grey")),
    *((level, ground) for level in ("green", "yellow", "red", "grey") for ground in ("page", "card")),
    *(("card", level) for level in ("green", "yellow", "red", "grey")),
]


def colours(selector):
    """Colours of a theme by name, as red, green and blue from 0 to 1."""
    block = SHEET[SHEET.index(selector + " {") :].split("}")[0]
    found = re.findall(r"--([a-z-]+): #([0-9a-f]{6});", block)
    return {name: [int(text[i : i + 2], 16) / 255 for i in (0, 2, 4)] for name, text in found}


def luminance(colour):
    """Relative luminance of WCAG 2.2."""
    red, green, blue = (
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in colour
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one, other):
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("theme", [":root", "body.body--dark"])
def test_contrast(theme):
    """WCAG 2.2, 1.4.3 and 1.4.11: 4.5 for text, 3 for the edge of a field."""
    known = colours(theme)
    low = {pair for pair in TEXTS if contrast(known[pair[0]], known[pair[1]]) < 4.5}
    assert not low
    assert contrast(known["edge"], known["field"]) >= 3.0
    assert contrast(known["edge"], known["card"]) >= 3.0


def test_sheets_load_nothing():
    for sheet in (ROOT / "src/ehlectric/app/static").iterdir():
        text = sheet.read_text(encoding="utf-8")
        assert "url(" not in text
        assert "@import" not in text
        assert "http" not in text
