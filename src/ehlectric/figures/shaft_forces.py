"""Forces on the shafts of an axle, for both signs of the torque, and on the rotor of a drive."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ehlectric.axle import AxleResult, forces_on_shafts, loads_on_shafts
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.drive_case import DriveCase
from ehlectric.errors import printable
from ehlectric.figures.style import legend_above, new_panels, note, text_colour
from ehlectric.formulas.shaft_statics import BearingLoads, ForceAt
from ehlectric.quantities.formats import amount
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.palette import BLACK, BLUE, GREY, ORANGE
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.readable import readable

# Colours of the torque of the case, and of the torque with the other sign.
_COLOURS = (BLUE, ORANGE)

# Height of the panels of a shaft, and of titles, legend and labels below them [inches]; width of the figure.
_HEIGHT, _AROUND, _WIDTH = 2.2, 0.9, 9.0

# Distance of both arrows from their place, and part of the axis beyond the shaft, in lengths of the shaft.
_ASIDE, _ROOM = 0.008, 0.16

# Width of a letter of a name in lengths of the shaft: a panel has room for about 80 letters.
_LETTER = (1.0 + 2.0 * _ROOM) / 80.0

# Part of the height of a panel below which an arrow is short, and distance of its number from the shaft [pt].
_SHORT, _AWAY = 0.08, 5.0

# Part of the largest force that is the half height of a panel, part of this height from which a force has an
# arrow, 2 % of the largest force, and size of the head of a long arrow.
_HIGH = 1.7
_DRAWN, _HEAD = 0.02 / _HIGH, 10.0


@dataclass(frozen=True)
class PlacedForce:
    """Force on a shaft at a place, for each of ``torques_of``."""

    name: str
    kind: str  # "bearing", or the kind of the cause of ``forces_on_shafts``
    place: float  # along z [m]
    forces: tuple[tuple[float, float, float], ...]  # in x, y and z [N]

    @property
    def label(self) -> tuple[str, str]:
        """Name with the force across the axis, and with the force along the axis."""
        across, along = (
            " | ".join(readable(value, 3) for value in values)
            for values in (
                [float(np.hypot(x, y)) for x, y, _ in self.forces],
                [0.0 if abs(z) < _NO_FORCE else z for *_, z in self.forces],
            )
        )
        name = f"{self.name}\nat {readable(1e3 * self.place, 4)} mm"
        return f"{name}\n{across} N", f"{name}\n{along} N"


# Markers of the places of forces by their kinds.
_MARKERS = {"bearing": "^", "mesh": "s", "weight": "D", "force": "D"}

# Names of forces by the kind of their cause.
_WORDS = {"mesh": "mesh with {}", "weight": "weight", "force": "force {}"}

# Axial force that is rounding [N].
_NO_FORCE = 1e-6


def torques_of(case: AxleCase) -> tuple[float, ...]:
    """Torques of the figure [N m]: of the case, and the other sign if gears have forces."""
    torque = case.drive.torque
    return (torque, -torque) if case.mesh and torque else (torque,)


def placed_forces(case: AxleCase) -> dict[str, list[PlacedForce]]:
    """Forces on all shafts whose loads follow from statics: of the meshes, weight, further forces, and
    reactions of the bearings.

    Each place has a force for each of ``torques_of``.
    """
    both = [case.replace({"drive.torque": torque}) for torque in torques_of(case)]
    forces, loads = [forces_on_shafts(each) for each in both], [loads_on_shafts(each) for each in both]
    placed: dict[str, list[PlacedForce]] = {}
    for shaft, of_shaft in forces[0].items():
        rows = [
            _placed(kind, name, [of_sign[shaft][number][1] for of_sign in forces])
            for number, ((kind, name), _) in enumerate(of_shaft)
        ]
        for place, number in enumerate(case.bearings_of(shaft)):
            bearing = case.bearing[number]
            reactions = [_reaction(of_sign[shaft], place, locating=bearing.locating) for of_sign in loads]
            rows.append(PlacedForce(f"bearing {place + 1}", "bearing", bearing.at, tuple(reactions)))
        placed[shaft] = sorted(rows, key=lambda row: row.place)
    return placed


def forces_on_rotor(case: DriveCase) -> list[PlacedForce]:
    """Weight, forces and reactions of both bearings of a drive; none without a rotor."""
    rotor, given = case.rotor, (case.force, case.drive.gravity_direction)
    if rotor is None:
        return []
    rows = [_placed(kind, name, [force]) for (kind, name), force in rotor.forces_on(*given)]
    loads = rotor.carried(*given)
    for place, (end, at) in enumerate(zip(ENDS, rotor.places, strict=True)):
        reaction = _reaction(loads, place, locating=rotor.locating == end)
        rows.append(PlacedForce(NAMES_OF_ENDS[end], "bearing", at, (reaction,)))
    return sorted(rows, key=lambda row: row.place)


def _placed(kind: str, name: str, forces: Sequence[ForceAt]) -> PlacedForce:
    """Force of a kind with a name, for each of some torques."""
    vectors = tuple(_vector(each.force) for each in forces)
    return PlacedForce(_WORDS[kind].format(name), kind, float(forces[0].point[2]), vectors)


def _vector(force: Iterable[float]) -> tuple[float, float, float]:
    x, y, z = (float(part) for part in force)
    return x, y, z


def _reaction(loads: BearingLoads, place: int, *, locating: bool) -> tuple[float, float, float]:
    """Force of a bearing on its shaft [N]."""
    across = loads.second if place else loads.first
    alone = loads.axial if locating else 0.0
    along = alone if loads.shares is None else loads.shares[place]
    return _vector((-across[0], -across[1], -along))


def shaft_forces(result: AxleResult) -> Axes:
    """Draw the forces on each shaft with gears along x and along y, on axes along z."""
    placed = placed_forces(result.case)
    panels = new_panels(len(placed), 2, (_WIDTH, _AROUND + _HEIGHT * len(placed)), exact=True)
    for row, (shaft, forces) in enumerate(placed.items()):
        for way, ax in enumerate(panels[2 * row : 2 * row + 2]):
            draw_forces(ax, shaft, forces, way)
    handles = [
        *(
            Line2D([], [], color=colour, lw=2.0, label=f"{amount(value, 'N m')} of the rotor")
            for colour, value in zip(_COLOURS, torques_of(result.case), strict=False)
        ),
        Line2D([], [], color=BLACK, ls="none", marker=_MARKERS["bearing"], label="bearing"),
        Line2D([], [], color=BLACK, ls="none", marker=_MARKERS["mesh"], label="gear"),
    ]
    if any(each.kind in ("weight", "force") for of_shaft in placed.values() for each in of_shaft):
        label = "weight or force"
        handles.append(Line2D([], [], color=BLACK, ls="none", marker=_MARKERS["force"], label=label))
    legend_above(panels[0], handles, columns=4)
    return panels[0]


def legend_of_rotor(axes: Sequence[Axes]) -> None:
    """Legend of the forces on a rotor."""
    handles = [
        Line2D([], [], color=BLACK, ls="none", marker=_MARKERS[kind], label=label)
        for kind, label in (("bearing", "bearing"), ("force", "weight or force"))
    ]
    legend_above(axes[0], handles, columns=2)


def draw_forces(ax: Axes, shaft: str, forces: Sequence[PlacedForce], way: int) -> None:
    """Draw forces along x (0) or y (1) as arrows from the shaft, with numbers at their ends."""
    high = _HIGH * max(abs(part) for each in forces for force in each.forces for part in force[:2])
    what = "radial forces below" if way == 0 else "axial forces on the shaft below"
    note(ax, 0.01, 0.98, f"{printable(shaft)}, along {'xy'[way]}; {what}", va="top", color=GREY)
    places = 1e3 * np.array([each.place for each in forces])
    length = float(np.ptp(places))
    ax.axhline(0.0, color=BLACK, lw=1.5, zorder=1.0)
    for each, place in zip(forces, places, strict=True):
        marker = _MARKERS[each.kind]
        ax.plot(place, 0.0, ls="none", marker=marker, ms=8.0, color=BLACK, zorder=3.0)
        for number, (colour, force) in enumerate(zip(_COLOURS, each.forces, strict=False)):
            side = 2 * number - 1
            at, value = place + side * _ASIDE * length, force[way]
            if abs(value) >= _DRAWN * high:
                _draw_arrow(ax, at, value, colour, min(1.0, abs(value) / (_SHORT * high)))
            elif abs(value) < _NO_FORCE:
                continue
            ax.annotate(
                f"{readable(abs(value), 3)} N",
                (at, value),
                (3.0 * side, math.copysign(_AWAY if abs(value) < _SHORT * high else 0.0, value)),
                textcoords="offset points",
                ha="right" if number == 0 else "left",
                va="bottom" if value > 0.0 else "top",
                fontsize="x-small",
                color=text_colour(colour),
            )
    ax.set(ylim=(-high, high), xlim=(places[0] - _ROOM * length, places[-1] + _ROOM * length))
    ax.set_yticks([])
    ax.set_xticks(places, list(_lowered(places / length, [each.label[way] for each in forces])))
    ax.tick_params(axis="x", labelsize="x-small")
    for edge in ("left", "right", "top"):
        ax.spines[edge].set_visible(False)


def _draw_arrow(ax: Axes, at: float, value: float, colour: str, part: float) -> None:
    """Draw a force from the shaft; ``part``, size of the head of its arrow as a part of the full size."""
    look = {"arrowstyle": "-|>", "color": colour, "lw": 1.6, "shrinkA": 0.0, "shrinkB": 0.0}
    ax.annotate("", (at, value), (at, 0.0), arrowprops=look | {"mutation_scale": _HEAD * part})


def _lowered(places: Iterable[float], labels: Sequence[str]) -> Iterator[str]:
    """Labels of places, a line of labels lower where the label before is near."""
    free = [-math.inf] * len(labels)
    for place, label in zip(places, labels, strict=True):
        half = 0.5 * _LETTER * max(map(len, label.split("\n")))
        line = next(number for number, last in enumerate(free) if place - half >= last)
        free[line] = place + half
        yield "\n" * (3 * line) + printable_lines(label)


def printable_lines(text: str) -> str:
    """Text of several lines, each of which can be printed."""
    return "\n".join(printable(line) for line in text.split("\n"))
