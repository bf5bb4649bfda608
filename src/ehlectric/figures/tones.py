"""Figures on a dark page: the colours of everything in them are exchanged just before they are drawn."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.artist import Artist
from matplotlib.cm import ScalarMappable
from matplotlib.collections import Collection
from matplotlib.colors import ListedColormap, to_hex, to_rgba, to_rgba_array
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.text import Annotation, Text

# Colours that an artist may have, by the names in Matplotlib's functions.
_NAMES = ("color", "facecolor", "edgecolor", "markerfacecolor", "markeredgecolor")

# Colours of a colour map up to which they are names of things, not a scale.
_FEW = 8

# Ratio of the opacity of a shading on a dark page to that on paper, and opacity up to which it holds: a faint
# shading is seen less well on a dark page.
_MORE, _FAINT = 1.6, 0.5


def exchange_colours(figure: Figure, tones: Mapping[str, str]) -> None:
    """Exchange the colours of all artists of a figure for the colours of another palette.

    Functions that draw name the colours of paper, and need not know the page. ``tones`` are the colours of
    the page by the colours of paper; colours that are not in it stay, such as colours of maps. A second
    exchange changes nothing.
    """
    for artist in figure.findobj():
        _exchange(artist, tones)


class Outline(withStroke):
    """Edge of a line or text, of a width [pt] and a colour."""

    def __init__(self, width: float, colour: str, alpha: float = 1.0) -> None:
        super().__init__(linewidth=width, foreground=colour, alpha=alpha)
        self.width, self.colour, self.alpha = width, to_hex(colour), alpha

    def toned(self, tones: Mapping[str, str]) -> Outline:
        """Outline in the colour of another palette."""
        return Outline(self.width, tones.get(self.colour, self.colour), self.alpha)


def _exchange(artist: Artist, tones: Mapping[str, str]) -> None:
    """Give an artist, its outline, and the box and the arrow of a text the colours of another palette."""
    named = {}
    for name in _NAMES:
        read = getattr(artist, f"get_{name}", None)
        if read is not None and not _is_mapped(artist, name):
            named[name] = _exchanged(to_rgba_array(read()), tones)
    opacity = artist.get_alpha()
    if any(new is not None for new in named.values()) and isinstance(opacity, float) and opacity < _FAINT:
        artist.set_alpha(_MORE * opacity)
    for name, new in named.items():
        if new is not None:
            getattr(artist, f"set_{name}")(new if len(new) > 1 else tuple(new[0]))
    if isinstance(artist, ScalarMappable):
        _exchange_scale(artist, tones)
    outlines = [effect for effect in artist.get_path_effects() or () if isinstance(effect, Outline)]
    if any(outline.colour in tones for outline in outlines):
        # Outlines are shared between artists, also of other figures.
        artist.set_path_effects([outline.toned(tones) for outline in outlines])
    for part in (
        artist.get_bbox_patch() if isinstance(artist, Text) else None,
        artist.arrow_patch if isinstance(artist, Annotation) else None,
    ):
        if part is not None:
            _exchange(part, tones)


def _exchange_scale(artist: ScalarMappable, tones: Mapping[str, str]) -> None:
    """Give areas and lines that have a few colours by their values the colours of another palette."""
    scale = artist.get_cmap()
    if isinstance(scale, ListedColormap):
        colours = to_rgba_array(scale.colors)
        few = len(np.unique(colours, axis=0)) <= _FEW
        if few and (new := _exchanged(colours, tones)) is not None:
            artist.set_cmap(ListedColormap(new))


def _is_mapped(artist: Artist, name: str) -> bool:
    """Whether a colour of an artist follows from its values by a colour map."""
    if not isinstance(artist, Collection) or artist.get_array() is None:
        return False
    artist.update_scalarmappable()
    return name != "edgecolor" or bool(artist._edge_is_mapped)  # type: ignore[attr-defined]


def _exchanged(colours: np.ndarray, tones: Mapping[str, str]) -> np.ndarray | None:
    """Colours of another palette for colours of shape (n, 4); None where none of them is in it."""
    exchanged = colours.copy()
    for k, colour in enumerate(colours):
        opacity, name = colour[3], to_hex(colour)
        if opacity > 0.0 and name in tones:
            exchanged[k] = to_rgba(tones[name], opacity * (_MORE if opacity < _FAINT else 1.0))
    return None if np.array_equal(exchanged, colours) else exchanged
