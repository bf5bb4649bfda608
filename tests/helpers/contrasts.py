"""Texts of a drawn figure that are hard to read on what lies behind them."""

from __future__ import annotations

import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.colors import to_hex, to_rgba
from matplotlib.figure import Figure

from tests.helpers.overlaps import Box, overlaps, text_boxes

# Least contrast of a text (WCAG 2), part of its box that must have it, as lines may cross a text, and dots
# per inch at which what lies behind is drawn.
LEAST, _MOST_OF_IT, _DPI = 4.5, 0.75, 72

# Parts of red, green and blue in the luminance of a colour.
_WEIGHTS = np.array([0.2126, 0.7152, 0.0722])


def luminance(colours: np.ndarray) -> np.ndarray:
    """Relative luminance of sRGB colours from 0 to 1, shape (..., 3), by WCAG 2."""
    linear = np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    return linear @ _WEIGHTS


def contrast(colours: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Contrast of colours with another one, from 1 to 21."""
    one, two = luminance(colours), luminance(other)
    return (np.maximum(one, two) + 0.05) / (np.minimum(one, two) + 0.05)


def flaws(figure: Figure) -> list[str]:
    """Texts that are hard to read, and things that lie over each other. Texts lose their outlines as they are
    measured.
    """
    boxes = text_boxes(figure)
    return [*overlaps(figure, boxes), *_faint_texts(figure, boxes)]


def _faint_texts(figure: Figure, boxes: list[Box]) -> list[str]:
    """Texts whose contrast with their outline or with what is drawn behind them is below 4.5, by name."""
    figure.set_dpi(_DPI)
    without_texts = RendererAgg(*figure.bbox.size, _DPI)
    without_texts.draw_text = lambda *_, **__: None
    figure.draw(without_texts)
    behind = np.asarray(without_texts.buffer_rgba())[::-1, :, :3] / 255.0
    found = []
    for box in boxes:
        ink = np.array(to_rgba(box.of.get_color())[:3])
        x, y = (slice(max(int(low), 0), max(int(np.ceil(high)), 1)) for low, high in box.ends)
        outline = [to_rgba(edge.colour)[:3] for edge in box.outline]
        against = outline or behind[y, x].reshape(-1, 3)
        seen = contrast(np.asarray(against), ink)
        if seen.size and np.mean(seen >= LEAST) < _MOST_OF_IT:
            found.append(f"{box.name} in {to_hex(ink)} has a contrast of {np.median(seen):.1f}")
    return found
