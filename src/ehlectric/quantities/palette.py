"""Colours of all figures, pages and reports, as texts that Matplotlib, Plotly and CSS read."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

# Colours that stay apart in print and for colour-blind readers (Okabe and Ito).
BLUE, ORANGE, GREEN, AMBER = "#0072b2", "#d55e00", "#009e73", "#e69f00"
PURPLE, SKY = "#cc79a7", "#56b4e9"

# Greys: of texts and lines on paper, of lines that are seen on a light and on a dark page, and of smooth
# surfaces behind rough ones.
GREY, MIDDLE_GREY, LIGHT_GREY = "#555555", "#777777", "#bfbfbf"

# Curve that stands for a whole bearing, whatever the colours of its parts; a page; and an alarm.
BLACK, WHITE, RED = "#000000", "#ffffff", "#d00000"

# Ink on the colours of a map and the edge around it, in every style: maps are the same on every page.
ON_MAP, MAP_EDGE = "#fcfcfc", "#222222"

# Dielectric strength and breakdown; ring-to-ring breakdown, whose wide line lies behind the first breakdown.
STRENGTH, OCHRE = "#a50026", "#b57700"

# Bodies, oil and cavitated oil, and values beyond the ends of a colour scale, a grey that no scale has.
BODY, OIL, CAVITATED, OUT_OF_RANGE = "#c9ced6", "#fff1cc", "#e3e6ea", "#a3a8ad"

# Line of a surface that lies behind another one.
PALE_BLUE = "#9ccbe8"

# Colours of a dark page by the colours of paper; the others are the same on both. Lines have a contrast of at
# least 3 to the page. No colour of the dark page is one of paper, so that none is exchanged twice.
DARK: Mapping[str, str] = MappingProxyType(
    {
        WHITE: "#16191e",
        BLACK: "#e6e9ee",
        RED: "#ff7070",
        BLUE: "#5ab0f0",
        ORANGE: "#ff8a3d",
        GREEN: "#2ecc9a",
        AMBER: "#f7c95c",
        PURPLE: "#e29bc6",
        SKY: "#b5e0ff",
        GREY: "#b3b9c2",
        MIDDLE_GREY: "#979da6",
        LIGHT_GREY: "#666c75",
        STRENGTH: "#ff6b7f",
        OCHRE: "#d09a3a",
        BODY: "#3b414a",
        CAVITATED: "#4a515b",
        OIL: "#4a4121",
        PALE_BLUE: "#3d6f93",
    }
)

# Light of a verdict by its level.
LIGHTS: Mapping[str, str] = MappingProxyType(
    {"green": GREEN, "yellow": AMBER, "red": ORANGE, "grey": MIDDLE_GREY}
)


def faint(colour: str, opacity: float) -> str:
    """Colour of a palette with an opacity from 0 to 1, as CSS writes it.

    >>> faint(BLUE, 0.15)
    'rgba(0,114,178,0.15)'
    """
    red, green, blue = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
    return f"rgba({red},{green},{blue},{opacity:g})"


def contrast(colour: str, other: str) -> float:
    """Contrast of two colours by WCAG 2, from 1 to 21; texts need 4.5, lines 3.

    >>> contrast(BLACK, WHITE)
    21.0
    """
    low, high = sorted(map(_luminance, (colour, other)))
    return (high + 0.05) / (low + 0.05)


def _luminance(colour: str) -> float:
    """Relative luminance of a colour, from 0 to 1."""
    parts = (int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5))
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


# Contrast of texts with a page, with some room for shadings behind them.
_FOR_TEXT = 6.0


def legible(colour: str, page: str) -> str:
    """Shade of a colour in which texts can be read on a page: the colour itself where its contrast is enough,
    or else the first darker or lighter one. On faint shadings, too, the contrast is 4.5 then.

    >>> legible(GREY, WHITE), legible(ORANGE, WHITE)
    ('#555555', '#a24700')
    """
    end = 0 if _luminance(page) > 0.2 else 255
    for step in range(101):
        parts = (int(colour[k : k + 2], 16) for k in (1, 3, 5))
        shade = "#" + "".join(f"{round(part + 0.01 * step * (end - part)):02x}" for part in parts)
        if contrast(shade, page) >= _FOR_TEXT:
            break
    return shade
