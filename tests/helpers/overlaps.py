"""What lies over each other in a drawn figure: texts, legends, frames of panels, and the edge of the page."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.projections.polar import PolarAxes
from matplotlib.text import Text
from matplotlib.transforms import Bbox

# Dots per inch at which figures are measured: those of their files on the screen.
_DPI = 300
_POINT = 72.0 / _DPI

# Room that a reader needs between numbers of an axis beside each other, between other texts, and between
# lines [pt].
_APART, _BESIDE, _BELOW = 2.0, 1.0, 0.3

# Distance by which a thing may lie over an edge [pt], which no reader sees.
_SLIGHT = 0.5

# Least width and height of a panel and of an inset, as part of the figure's width.
_SLIVER, _SMALL = 0.14, 0.07


@dataclass(frozen=True)
class Box:
    """Rectangle in points with what lies in it."""

    name: str
    of: Any  # artist that it belongs to
    x0: float
    y0: float
    x1: float
    y1: float
    outline: tuple[Any, ...] = ()  # path effects of a text

    @property
    def ends(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Ends along x and along y [pt]."""
        return (self.x0, self.x1), (self.y0, self.y1)

    def near(self, other: Box, x: float, y: float) -> bool:
        """Whether the boxes are less than ``x`` and ``y`` apart; negative ones allow an overlap [pt]."""
        beside = self.x1 + x <= other.x0 or other.x1 + x <= self.x0
        return not beside and not (self.y1 + y <= other.y0 or other.y1 + y <= self.y0)

    def leaves(self, other: Box) -> bool:
        """Whether a part of the box lies outside of another one."""
        low, high = min(self.x0 - other.x0, self.y0 - other.y0), max(self.x1 - other.x1, self.y1 - other.y1)
        return low < -_SLIGHT or high > _SLIGHT


def overlaps(figure: Figure, texts: list[Box] | None = None) -> list[str]:
    """Pairs of things that lie over each other in a figure, by name, things out of it, and texts that only
    Matplotlib reads, such as "_nolegend_".

    Measured are titles, labels of axes, their numbers, notes, legends, and the frames of panels; texts must
    be as far apart as a reader needs, and panels must not be slivers. ``texts`` that are measured already.
    """
    texts = text_boxes(figure) if texts is None else texts
    drawn = list(_shown(figure))
    legends = [_box("legend", of, of.get_window_extent()) for of in drawn if isinstance(of, Legend)]
    frames = [_box("frame", of, of.get_window_extent()) for of in drawn if _framed(of)]
    page = _box("page", figure, figure.bbox)
    near_frame = ((box, frame) for box in texts for frame in frames if box.near(frame, -_SLIGHT, -_SLIGHT))
    found = [
        *(f"{box.name} is no name for a reader" for box in texts if box.name.startswith("'_")),
        *(f"{box.name} is out of the figure" for box in (*texts, *legends) if box.leaves(page)),
        *_touching(texts),
        *(
            f"two legends at {box.of.get_texts()}"
            for box, other in combinations(legends, 2)
            if box.near(other, 0, 0)
        ),
        *_over_legends(texts, legends),
        *(f"{box.name} lies on a frame" for box, frame in near_frame if box.leaves(frame)),
        *(f"panel {frame.of.get_ylabel()!r} is a sliver" for frame in frames if _thin(frame, page)),
    ]
    return list(dict.fromkeys(found))


def _touching(texts: Sequence[Box]) -> Iterator[str]:
    """Pairs of texts that touch."""
    axis_of = {
        id(label): axis
        for ax in {box.of.axes for box in texts} - {None}
        for axis in ax._axis_map.values()
        for label in (*axis.get_majorticklabels(), *axis.get_minorticklabels())
    }
    for box, other in combinations(texts, 2):
        axis = axis_of.get(id(box.of))
        beside = _APART if axis is not None and axis is axis_of.get(id(other.of)) else _BESIDE
        if box.of is not other.of and box.near(other, beside, _BELOW):
            yield f"{box.name} touches {other.name}"


def _over_legends(texts: Sequence[Box], legends: Sequence[Box]) -> Iterator[str]:
    """Texts that lie over a legend that they are not in."""
    for legend in legends:
        own = {*map(id, legend.of.get_texts()), id(legend.of.get_title())}
        for box in texts:
            if id(box.of) not in own and box.near(legend, -_SLIGHT, -_SLIGHT):
                yield f"{box.name} lies over the legend of {legend.of.get_texts()[0].get_text()!r}"


def _thin(frame: Box, page: Box) -> bool:
    """Whether a panel is too narrow or too flat to read anything; colour bars are narrow."""
    if hasattr(frame.of, "_colorbar"):
        return False
    inset = frame.of.get_subplotspec() is None
    least = (_SMALL if inset else _SLIVER) * (page.x1 - page.x0)
    return min(frame.x1 - frame.x0, frame.y1 - frame.y0) < least


def _framed(artist: Artist) -> bool:
    """Whether an artist is axes with a frame of straight lines."""
    return isinstance(artist, Axes) and artist.axison and not isinstance(artist, PolarAxes)


def _shown(artist: Artist) -> Iterator[Artist]:
    """Artists that are drawn: an artist and all in it that is visible."""
    if artist.get_visible():
        yield artist
        for child in artist.get_children():
            yield from _shown(child)


class _Recorder(RendererAgg):
    """Renderer that draws nothing and keeps the box of every line of text, by the number of its artist."""

    def __init__(self, figure: Figure):
        super().__init__(*figure.bbox.size, figure.dpi)
        self.boxes: list[tuple[str, tuple[float, float, float, float], int]] = []
        self._number = -1
        for name in ("path", "markers", "path_collection", "quad_mesh", "gouraud_triangles", "image"):
            setattr(self, f"draw_{name}", lambda *_, **__: None)

    def open_group(self, s: str, gid: str | None = None) -> None:
        """Keep the number of the text that is drawn next."""
        if s == "text":
            self._number = int(gid or -1)

    def draw_text(self, gc, x, y, s, prop, angle, ismath=False, mtext=None):  # noqa: ARG002
        """Keep the box of the letters; ``x`` and ``y`` are the left end of their base line, from the top."""
        if not s.strip():
            return
        width, height, descent = self.get_text_width_height_descent(s, prop, ismath)
        turn = math.radians(angle)
        corners = [(along, up) for along in (0.0, width) for up in (-descent, height - descent)]
        at_x = [x + along * math.cos(turn) - up * math.sin(turn) for along, up in corners]
        at_y = [self.height - y + along * math.sin(turn) + up * math.cos(turn) for along, up in corners]
        clip = gc.get_clip_rectangle()
        if clip is None or clip.overlaps(Bbox.from_extents(min(at_x), min(at_y), max(at_x), max(at_y))):
            self.boxes.append((s, (min(at_x), min(at_y), max(at_x), max(at_y)), self._number))


def text_boxes(figure: Figure) -> list[Box]:
    """Boxes of the lines of all texts of a figure, as they are drawn."""
    figure.set_dpi(_DPI)
    figure.draw_without_rendering()
    # Everything has its place now, also for drawings with other dots.
    figure.set_layout_engine("none")
    artists = figure.findobj(Text)
    outlines = [tuple(text.get_path_effects() or ()) for text in artists]
    for number, text in enumerate(artists):
        # Letters with an edge are drawn as lines, not as text.
        text.set_path_effects([])
        text.set_gid(str(number))
    recorder = _Recorder(figure)
    figure.draw(recorder)
    return [
        Box(
            repr(line.replace("\xa0", " ")),
            artists[number],
            *(_POINT * end for end in ends),
            outlines[number],
        )
        for line, ends, number in recorder.boxes
    ]


def _box(name: str, of: Any, extent: Any) -> Box:
    return Box(name, of, *(_POINT * float(end) for end in extent.extents))
