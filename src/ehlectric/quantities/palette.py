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

# Curve that stands for a whole bearing, whatever the colours of its parts.
BLACK = "#000000"

# Dielectric strength and breakdown; ring-to-ring breakdown, whose wide line lies behind the first breakdown.
STRENGTH, OCHRE = "#a50026", "#b57700"

# Bodies and oil of a section, and values beyond the ends of a colour scale, a grey that no scale has.
BODY, OIL, OUT_OF_RANGE = "#c9ced6", "#fff1cc", "#a3a8ad"

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
