"""Picture of the network of an axle: shafts as nodes, with their elements to the housing and to each other.

Lengths are in inches on the screen. Each shaft is a box with its voltage after an edge, above a ladder: the
left rail has the potential of the shaft, the right rail has the potential of the housing. Each rung is an
element between both. Elements between two shafts are in lanes between the boxes, further ones above them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import FancyBboxPatch, Patch, Rectangle

from ehlectric.axle import AxleResult, AxleSolution
from ehlectric.drive import HOUSING
from ehlectric.errors import printable
from ehlectric.figures.network_elements import NetworkElement, elements_of_network, lanes_of
from ehlectric.figures.style import broken, legend_above, new_panels, text_colour
from ehlectric.quantities.formats import amount
from ehlectric.quantities.palette import BLACK, BLUE, LIGHT_GREY, ORANGE, WHITE
from ehlectric.readable import readable

# Width of the column of a shaft, of its box, and of the rails from the left edge of the column.
_COLUMN, _BOX, _RAILS = 3.0, 1.1, (0.25, 2.35)

# Heights: of a box, of a rung, of a lane above the boxes, and of the winding above the rotor.
_BOX_HIGH, _RUNG, _LANE, _WINDING = 0.55, 0.62, 0.85, 0.85

# Height of a line of text, sizes of letters [pt], and room around the picture.
_LINE, _SMALL, _LARGE, _ROOM = 0.14, 7.0, 8.0, 0.15

# Places of the symbol of an element and of its texts, from the left end of its line.
_SYMBOL, _TEXT = 0.2, 0.36

# Size of a bar.
_BAR, _BAR_HIGH = 1.2, 0.07

# Half distance and half height of the plates of a capacitor, half length of the body of a resistor and of a
# switch.
_GAP, _PLATE, _BODY, _SWITCH = 0.03, 0.1, 0.12, 0.08


def _colour(each: NetworkElement) -> str:
    return ORANGE if each.first else BLUE if each.ratio is not None else BLACK


def network_picture(result: AxleResult) -> Axes:
    """Draw the network of an axle right after an edge of the common-mode voltage."""
    solution = result.solution
    shafts = list(solution.turning)
    # Elements with a film come before the other ones.
    shown = sorted(elements_of_network(solution), key=lambda each: not each.voltage)
    to_housing = {shaft: [each for each in shown if each.ends == {shaft, HOUSING}] for shaft in shafts}
    between = [(each, lane) for each, lane in lanes_of(shown, shafts)]
    lanes = max((lane for _, lane in between), default=0)
    rungs = max(len(each) for each in to_housing.values())
    width, below = _COLUMN * len(shafts), _RUNG * (rungs + 0.6)
    above = max(_WINDING, _LANE * lanes + (0.3 if between else 0.0))
    high = below + _BOX_HIGH + above + 2.0 * _ROOM
    (ax,) = new_panels(1, 1, (width, high + 0.7), exact=True)
    ax.set(xlim=(0.0, width), ylim=(0.0, high))
    ax.axis("off")
    potentials, level = solution.potentials(), below + _ROOM + 0.5 * _BOX_HIGH
    for number, shaft in enumerate(shafts):
        _draw_shaft(ax, _COLUMN * number, level, shaft, potentials[shaft])
        _draw_ladder(ax, _COLUMN * number, level, to_housing[shaft])
    _draw_winding(ax, _COLUMN * shafts.index(solution.case.rotor_name), level, solution)
    for each, lane in between:
        _draw_between(
            ax, each, lane, level, [shafts.index(end) for end in (each.film.first, each.film.second)]
        )
    handles: list[Artist] = [
        Line2D([], [], color=ORANGE, lw=2.0, label="first element to discharge"),
        Patch(color=BLUE, label=r"bar: $U/V_\mathrm{b}$ from 0.01 to 100"),
        Line2D([], [], color=BLACK, ls="none", marker="|", ms=8.0, label=r"$U = V_\mathrm{b}$"),
    ]
    if any(each.mostly_conducts for each in shown):
        handles.append(Line2D([], [], color=BLACK, marker="o", ms=2.5, label="conducts most of the time"))
    legend_above(ax, handles, columns=len(handles))
    return ax


def _draw_shaft(ax: Axes, left: float, level: float, name: str, potential: float) -> None:
    """Draw the box of a shaft with its voltage."""
    x = left + _RAILS[0]
    box = FancyBboxPatch(
        (x - 0.12, level - 0.5 * _BOX_HIGH + 0.06),
        _BOX,
        _BOX_HIGH - 0.12,
        boxstyle="round,pad=0.06",
        facecolor=WHITE,
        edgecolor=BLACK,
        lw=1.2,
        zorder=3.0,
    )
    ax.add_patch(box)
    lines = broken(printable(name), _LARGE, 72.0 * _BOX)
    _write(
        ax,
        (x - 0.12 + 0.5 * _BOX, level),
        "\n".join([*lines[:2], f"{readable(potential, 3)} V"]),
        size=_LARGE,
        ha="center",
        va="center",
        weight="bold",
    )


def _draw_ladder(ax: Axes, left: float, level: float, elements: list[NetworkElement]) -> None:
    """Draw the elements between a shaft and the housing below the box of the shaft."""
    start, end = (left + rail for rail in _RAILS)
    top = level - 0.5 * _BOX_HIGH
    heights = [top - _RUNG * (number + 0.6) for number in range(len(elements))]
    for each, height in zip(elements, heights, strict=True):
        _draw_element(ax, each, (start, end), height)
        _describe(ax, each, start + _TEXT, height)
    if elements:
        ax.plot([start, start], [top, heights[-1]], color=BLACK, lw=1.2)
        ground = heights[-1] - 0.3
        ax.plot([end, end], [heights[0], ground], color=BLACK, lw=1.2)
        for number, half in enumerate((0.14, 0.09, 0.04)):
            ax.plot([end - half, end + half], [ground - 0.05 * number] * 2, color=BLACK, lw=1.2)


def _draw_element(ax: Axes, each: NetworkElement, ends: tuple[float, float], height: float) -> None:
    """Draw the line of an element with its symbol: a capacitor, a resistor, or only a line if it conducts."""
    at = ends[0] + _SYMBOL
    look: dict[str, Any] = {"color": _colour(each), "lw": 2.2 if each.first else 1.2}
    if each.film.conducts:
        ax.plot(ends, [height] * 2, **look)
    elif each.film.conductance and not each.film.capacitance:
        for first, last in ((ends[0], at - _BODY), (at + _BODY, ends[1])):
            ax.plot([first, last], [height] * 2, **look)
        ax.add_patch(
            Rectangle(
                (at - _BODY, height - 0.05), 2.0 * _BODY, 0.1, fill=False, edgecolor=look["color"], lw=1.2
            )
        )
    else:
        for first, last in ((ends[0], at - _GAP), (at + _GAP, ends[1])):
            ax.plot([first, last], [height] * 2, **look)
        for x in (at - _GAP, at + _GAP):
            ax.plot([x, x], [height - _PLATE, height + _PLATE], **look)
        if each.mostly_conducts:
            _draw_contact(ax, at, height, look)


def _draw_contact(ax: Axes, at: float, height: float, look: Mapping[str, Any]) -> None:
    """Draw a closed switch in parallel with a capacitor, for metallic contact for most of the time."""
    below = height - _PLATE - 0.07
    ends = [at - _SWITCH, at + _SWITCH]
    for x in ends:
        ax.plot([x, x], [height, below], **look)
    ax.plot(ends, [below] * 2, marker="o", ms=2.5, **look)


def _describe(ax: Axes, each: NetworkElement, x: float, height: float) -> None:
    """Write name and value above the line of an element, and its voltages and their bar below."""
    weight = "bold" if each.first else "normal"
    _write(ax, (x, height + 0.05), f"{printable(each.name)}, {each.value}", va="bottom", weight=weight)
    if each.voltage:
        _write(ax, (x, height - 0.05), each.voltage, va="top", color=_colour(each), weight=weight)
    if each.ratio is not None:
        _draw_bar(ax, x, height - 0.05 - _LINE - _BAR_HIGH, each)


def _draw_bar(ax: Axes, x: float, y: float, each: NetworkElement) -> None:
    """Draw U/V_b as a bar with a logarithmic scale, and a mark at 1."""
    ax.add_patch(Rectangle((x, y), _BAR, _BAR_HIGH, facecolor=LIGHT_GREY, edgecolor="none"))
    ax.add_patch(Rectangle((x, y), each.bar * _BAR, _BAR_HIGH, facecolor=_colour(each), edgecolor="none"))
    ax.plot([x + 0.5 * _BAR] * 2, [y - 0.03, y + _BAR_HIGH + 0.03], color=BLACK, lw=1.2)


def _draw_winding(ax: Axes, left: float, level: float, solution: AxleSolution) -> None:
    """Draw the winding above the rotor, with the edge of the common-mode voltage."""
    x, bottom = left + _RAILS[0] + 0.1, level + 0.5 * _BOX_HIGH
    middle, top = bottom + 0.18, bottom + 0.36
    for first, last in ((bottom, middle - _GAP), (middle + _GAP, top)):
        ax.plot([x, x], [first, last], color=BLACK, lw=1.2)
    for y in (middle - _GAP, middle + _GAP):
        ax.plot([x - _PLATE, x + _PLATE], [y, y], color=BLACK, lw=1.2)
    capacitance = solution.case.circuit.capacitances["winding_rotor_capacitance"]
    _write(ax, (x + 0.17, middle), amount(capacitance, "F"), va="center")
    _write(ax, (x - 0.2, top + 0.03), f"winding,\n{amount(solution.edge.voltage, 'V')} edge", va="bottom")


def _draw_between(ax: Axes, each: NetworkElement, lane: int, level: float, columns: list[int]) -> None:
    """Draw an element between two shafts."""
    first, second = sorted(columns)
    start = _COLUMN * first + _RAILS[0] - 0.06 + _BOX
    end = _COLUMN * second + _RAILS[0] - 0.18
    height = level
    if lane:
        height = level + 0.5 * _BOX_HIGH + _LANE * (lane - 0.35)
        start, end = start - 0.1 * (1 + lane), end + 0.1 * (1 + lane)
        for x in (start, end):
            ax.plot([x, x], [level + 0.5 * _BOX_HIGH, height], color=_colour(each), lw=1.2)
    _draw_element(ax, each, (start, end), height)
    _describe(ax, each, start + _TEXT, height)


def _write(
    ax: Axes,
    at: tuple[float, float],
    text: str,
    *,
    size: float = _SMALL,
    color: str = BLACK,
    **look: Any,
) -> None:
    """Write a text at a place of the picture."""
    ax.text(*at, text, fontsize=size, color=text_colour(color), parse_math=False, zorder=4.0, **look)
