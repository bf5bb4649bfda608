"""Panels of sweeps: a value of the summaries as a map over two varied keys, or as lines over one."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

import numpy as np
import scipy

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.bearing import CAPACITIVE, RESISTIVE
from ehlectric.figures.data import (
    WIDTH,
    Along,
    Area,
    Curve,
    Limit,
    MapPanel,
    Mesh,
    Panel,
    by_logarithm,
    is_wide,
)
from ehlectric.quantities.formats import Scale
from ehlectric.quantities.palette import AMBER, BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, SKY
from ehlectric.quantities.result_warnings import CODES
from ehlectric.readable import readable
from ehlectric.sweep import (
    Label,
    Slice,
    Surface,
    SweepResults,
    applied_at,
    computed_line,
    curve_of,
    label_of,
    spaced_log,
    surface_of,
)


@dataclass(frozen=True)
class TimeShare:
    """Words for a share of time in which a bearing or a mesh conducts."""

    subject: str  # first words of the sentence that ends with the share
    # Names of the areas of a map below the first line of equal share, between lines, and above the last one.
    areas: tuple[str, str, str]


_OF_BEARING = TimeShare(
    "Contacts short the bearing",
    (
        "capacitive: contacts short it at most 1 % of the time",
        "intermittent",
        "resistive: more than 99 %",
    ),
)

# Shares of time by their keys in summaries, and lines of equal share on their maps.
TIME_SHARES: Mapping[str, TimeShare] = MappingProxyType(
    {
        "bearing.contact_time_share": _OF_BEARING,
        "bearing.touching_time_share": _OF_BEARING,
        "bearing.clarke_time_share": _OF_BEARING,
        "mesh.contact_time_share": TimeShare(
            "The mesh conducts",
            (
                "insulates: metallic contact at most 1 % of the time",
                "conducts at times",
                "conducts: more than 99 %",
            ),
        ),
    }
)
SHARE_LEVELS = (CAPACITIVE, 0.1, 0.5, RESISTIVE)

# Ends of the shares that are drawn: beyond them their quantiles have no finite value.
_LEAST, _MOST = 1e-300, 1.0 - 1e-16


def quantile_of(share: Array) -> Array:
    """Quantile of the normal distribution at a share of time, about linear in lambda; nan stays nan.

    A share falls as exp(-lambda^2): neither it nor its logarithm is linear between the points of a sweep.

    Examples
    --------
    >>> quantile_of(np.array([0.5, 0.99, np.nan])).round(2).tolist()
    [0.0, 2.33, nan]
    """
    quantiles: Array = scipy.special.ndtri(np.clip(share, _LEAST, _MOST))
    return quantiles


def share_of(quantile: Array) -> Array:
    """Share of time at a quantile of the normal distribution; the inverse of ``quantile_of``."""
    share: Array = scipy.special.ndtr(quantile)
    return share


def labelled(results: SweepResults, key: str, values: Array) -> tuple[Label, Scale]:
    """Name, symbol and SI unit of a key, and the unit that suits the values; °C for temperatures."""
    label = label_of(key, results.case)
    return label, label.scaled(values)


def voltage_text(selection: Slice) -> str:
    """Applied voltage of the solved points with its unit, or its range if it differs between them."""
    return range_text(selection.voltage[np.isfinite(selection.voltage)], "V")


def range_text(values: Array, unit: str) -> str:
    """Text of the range of values: one value with the unit, or the smallest "to" the largest.

    Examples
    --------
    >>> range_text(np.array([2.0, 2.0]), "V"), range_text(np.array([2.214, 30.0]), "V")
    ('2 V', '2.2 to 30 V')
    """
    low, high = float(values.min()), float(values.max())
    texts = [readable(value, 2) if value < 10.0 else readable(value) for value in (low, high)]
    return f"{readable(low, 4)} {unit}" if high - low <= 1e-9 * high else f"{' to '.join(texts)} {unit}"


# Marker, colour and name in legends of the points of each kind.
_KINDS = {
    "solved": ("dots", BLACK, "points"),
    "intermittent": ("wide cross", ORANGE, "frequent asperity contact: no voltage computed"),
    "conducting": ("square", AMBER, "the mesh conducts: no voltage to break down"),
    "without this value": ("square", GREY, "without this value"),
    "do not use": ("diamond", ORANGE, "must not be used"),
    "not converged": ("plus", BLACK, "not converged"),
    "failed": ("cross", ORANGE, "failed"),
    "not tried yet": ("circle", GREY, "not tried yet"),
}

# Number of points above which dots are smaller.
_FEW = 400

# Codes of warnings that say that the numbers of a point are less accurate than the numbers of other points.
# Other warnings, such as the warning of an expected breakdown, say something about a contact whose numbers
# are good.
LESS_ACCURATE = frozenset(code for code, cause in CODES.items() if cause.less_accurate)


def kinds(selection: Slice) -> dict[str, Mask]:
    """Mask of the points of each kind of mark, shape (points,); kinds without points are omitted."""
    known, intermittent = np.isfinite(selection.values), selection.intermittent
    without, conducting = selection.of("solved") & ~known & ~selection.doubtful, selection.conducting
    masks = {
        "solved": selection.of("solved") & known,
        "intermittent": without & intermittent,
        "conducting": without & conducting,
        "without this value": without & ~intermittent & ~conducting,
        "do not use": selection.doubtful,
        "not converged": selection.of("not converged"),
        "failed": selection.of("failed"),
        "not tried yet": selection.of("open"),
    }
    return {kind: mask for kind, mask in masks.items() if np.any(mask)}


# Points of a line of a sweep, or of all of a map: their numbers, their colour if it is not the colour of
# their kind, and the relative size of their dots.
_Group = tuple[IntArray, str, float]


def _marks(selection: Slice, x: Array, y: Array, groups: Sequence[_Group], also: str = "") -> list[Curve]:
    """Marks of the points of each kind, whose first has their number, and rings around less accurate points;
    ``also`` follows the name of the points with a value.
    """
    size = min(1.0, max(0.3, math.sqrt(_FEW / len(selection.points))))
    marks = []
    for kind, mask in kinds(selection).items():
        solved, (marker, of_kind, name) = kind == "solved", _KINDS[kind]
        name = f"{np.sum(mask)} {name}{also if solved else ''}"
        for numbers, of_group, larger in groups:
            here = numbers[mask[numbers]]
            if here.size:
                colour = of_group if of_group and (solved or selection.y is not None) else of_kind
                part = size * larger if solved else size
                marks.append(Curve(name, x[here], y[here], colour, marker=marker, size=part))
                name = ""
    if np.any(rings := _warned(selection)):
        name = f"{np.sum(rings)} less accurate"
        marks.append(Curve(name, x[rings], y[rings], ORANGE, marker="wide circle"))
    return marks


def _warned(selection: Slice) -> Mask:
    """Mask of the points with a value whose numbers are less accurate than the numbers of others, shape
    (points,).

    They have a warning of ``LESS_ACCURATE`` that not all points have: a warning of all points distinguishes
    no point from another.
    """
    # Of a share of time with contact, that surfaces touch is no doubt but what it says.
    doubts = LESS_ACCURATE - {"touching", "partial-film"} if selection.value in TIME_SHARES else LESS_ACCURATE
    codes = [
        {warning.code for warning in point.warnings if warning.code in doubts} for point in selection.points
    ]
    drawn = selection.of("solved") & np.isfinite(selection.values)
    known = [codes_of_point for codes_of_point, on in zip(codes, drawn, strict=True) if on]
    of_all = set.intersection(*known) if known else set()
    return np.asarray(drawn & np.array([bool(point_codes - of_all) for point_codes in codes]))


def _axis(results: SweepResults, key: str, values: Array) -> tuple[Along, Scale]:
    """Axis of a varied key, and the scale of its unit."""
    label, scale = labelled(results, key, values)
    return Along(label.with_symbol, scale.unit, log=spaced_log(results, key, values)), scale


def map_panel(results: SweepResults, selection: Slice, *, limited: bool = False) -> MapPanel:
    """Map of a value over two varied keys, with the margin where the value is of a discharge, or ``limited``.

    Between points the value, or the logarithm of positive values if an axis is logarithmic, is linear in the
    axes as they are drawn. Raises InputError if values of the second key are not numbers.
    """
    selection.check_numeric()
    along, across = selection.along, np.array(selection.across, dtype=float)
    (x, scale_x), (y, scale_y) = _axis(results, selection.x, along), _axis(results, str(selection.y), across)
    label, scale = labelled(results, selection.value, selection.values)
    places, values = np.array([scale_x.of(along), scale_y.of(across)]), scale.of(selection.values)
    surface = None if selection.categories else surface_of(selection, log_x=x.log, log_y=y.log)
    between, parts = None, dict[str, Any](alone=np.isfinite(values))
    if surface is not None:
        between = _Between(results, selection, surface, x.log or y.log, (scale_x, scale_y))
        nodes, whole = between.values()
        opening = np.any((selection.intermittent & np.isnan(values))[surface.corners], axis=1)
        parts = {
            "between": between.mesh(scale.of(nodes), whole),
            # Without these cells the map would be white there, as if nothing could happen.
            "opening": between.mesh(np.ones_like(nodes), opening & ~whole),
            "alone": surface.alone(values),
        }
    share = TIME_SHARES.get(selection.value)
    marks = _marks(selection, places[0], places[1], [(np.arange(values.size), "", 1.0)])
    if selection.categories:
        # A name has an area, and the verdict counts the warnings of its points.
        marks = [mark for mark in marks if mark.marker not in ("dots", "wide circle")]
    return MapPanel(
        axes=(x, y),
        title=label.with_symbol,
        unit=scale.unit,
        places=places,
        values=values,
        marks=marks,
        log=not selection.categories and _is_log(selection),
        limit=_limit(selection, between) if selection.of_discharge or limited else None,
        levels=SHARE_LEVELS if share is not None else (),
        areas=() if share is None else share.areas,
        categories=selection.categories,
        **parts,
    )


def _limit(selection: Slice, between: _Between | None) -> Limit | None:
    """Margins of the points of a map; None where no point has one."""
    if not np.any(np.isfinite(selection.margin)):
        return None
    about = selection.breakdown
    mesh = None if between is None else between.mesh(*between.margins())
    return Limit(selection.margin, mesh, about.name, about.voltage_name, voltage_text(selection))


@dataclass(frozen=True)
class _Between:
    """Interpolation between the points of a slice over two keys."""

    results: SweepResults
    selection: Slice
    surface: Surface  # nodes and triangles between its points
    log_axis: bool  # whether one of the axes is logarithmic
    scales: tuple[Scale, Scale]  # units of the horizontal and the vertical axis

    def values(self) -> tuple[Array, Mask]:
        """Drawn values at the nodes, in SI units, and mask of the triangles with values throughout."""
        if self.selection.value in TIME_SHARES:
            quantiles, whole = self.surface.at_nodes(quantile_of(self.selection.values))
            return share_of(quantiles), whole
        if self.selection.value == self.selection.breakdown.margin:
            return self.margins()
        return self._at_nodes(self.selection.values)

    def margins(self) -> tuple[Array, Mask]:
        """Margin of the breakdown voltage at the nodes, and mask of the triangles with values throughout.

        The margin is breakdown voltage divided by applied voltage. The voltages are interpolated before the
        division.
        """
        selection = self.selection
        breaks = np.where(selection.margin > 0.0, selection.margin * selection.voltage, np.nan)
        nodes, whole = self._at_nodes(breaks)
        applied = applied_at(self.results, selection, self.surface.x, self.surface.y)
        return nodes / (self._at_nodes(selection.voltage)[0] if applied is None else applied), whole

    def _at_nodes(self, values: Array) -> tuple[Array, Mask]:
        return self.surface.at_nodes(values, log=by_logarithm(values, log_axis=self.log_axis))

    def mesh(self, values: Array, whole: Mask) -> Mesh | None:
        """Values at the nodes of some triangles, in the units of the axes; None without a triangle."""
        x, y = self.scales[0].of(self.surface.x), self.scales[1].of(self.surface.y)
        return Mesh(x, y, values, self.surface.triangles[whole]) if np.any(whole) else None


_TEXTS = (BLUE, ORANGE, GREEN, PURPLE, AMBER, SKY, BLACK, GREY)

# Largest number of lines named in a legend; more lines have a colour bar instead.
NAMED = 8

# Colours at places from 0 to 1, shape (n,).
Colours = Callable[[Array], Sequence[str]]


@dataclass(frozen=True)
class SeriesLine:
    """One line: a value of the second key, the numbers of its points by increasing x, and its colour."""

    value: Any
    numbers: IntArray
    colour: str


@dataclass(frozen=True)
class LinePath:
    """Values between the points of the lines of a slice: computed if a bearing takes a millisecond, and
    otherwise interpolated as in a map over the same axes.
    """

    results: SweepResults
    selection: Slice
    log_x: bool
    log_y: bool

    def values(self, line: SeriesLine) -> tuple[Array, Array]:
        """Values of x along a line and the drawn values there, both in SI units."""
        computed = self._computed(line)
        if computed is not None:
            return computed
        if self.selection.value != self.selection.breakdown.margin:
            return self._curve(self.selection.values, line)
        places, breaks = self._curve(self.selection.margin * self.selection.voltage, line)
        return places, breaks / self.voltages(line)[1]

    def voltages(self, line: SeriesLine) -> tuple[Array, Array]:
        """Values of x along a line, in SI units, and the applied voltage there [V]."""
        places, voltage = self._curve(self.selection.voltage, line)
        applied = applied_at(self.results, self.selection, places, line.value)
        return places, voltage if applied is None else np.where(np.isfinite(voltage), applied, np.nan)

    def _computed(self, line: SeriesLine) -> tuple[Array, Array] | None:
        """Computed line; None if it is interpolated."""
        if self.selection.value in TIME_SHARES or len(self.selection.series()) > NAMED:
            return None
        log = by_logarithm(self.selection.values, log_axis=self.log_x or self.log_y)
        return computed_line(self.results, self.selection, line.numbers, log_x=self.log_x, log=log)

    def _curve(self, values: Array, line: SeriesLine) -> tuple[Array, Array]:
        along, heights = self.selection.along[line.numbers], values[line.numbers]
        if line.numbers.size < 2:
            return along, heights
        if self.selection.value in TIME_SHARES:
            places, quantiles = curve_of(along, quantile_of(heights), log_x=self.log_x, log=False)
            return places, share_of(quantiles)
        log = by_logarithm(values, log_axis=self.log_x or self.log_y)
        return curve_of(along, heights, log_x=self.log_x, log=log)


def lines_of(
    results: SweepResults, selection: Slice, colours: Colours | None = None
) -> tuple[list[SeriesLine], bool]:
    """Lines of a slice, and whether the values of the second key are spaced by their logarithm.

    Colours follow the values of the second key; for texts they come from a list of distinct ones.
    """
    series = selection.series()
    log = selection.numeric and spaced_log(results, str(selection.y), np.array(selection.across))
    if not selection.numeric or colours is None:
        shades: Sequence[str] = [_TEXTS[k % len(_TEXTS)] for k in range(len(series))]
    elif len(series) <= NAMED:
        shades = colours(np.linspace(0.0, 1.0, len(series)))
    else:
        values = np.array([value for value, _ in series])
        places = np.log(values) if log else values
        shades = colours((places - places.min()) / np.ptp(places))
    return [SeriesLine(value, n, shade) for (value, n), shade in zip(series, shades, strict=True)], log


def joined(selection: Slice, lines: Sequence[SeriesLine]) -> bool:
    """Whether points are joined by lines: points of a line differ only in x, and a line has two of them."""
    return not selection.free and max(line.numbers.size for line in lines) > 1


# A line with at most so many points is drawn thin [pt], and its dots are larger.
_SPARSE, _THIN, _LARGE = 6, 0.7, 1.3

# Room at the ends of both axes, as parts of their lengths. The vertical axis of positive values begins at
# zero if the smallest is below a part of the largest.
_SIDES, _ABOVE, _FROM_ZERO = 0.03, 0.06, 0.5


def lines_panel(
    results: SweepResults, selection: Slice, colours: Colours | None = None
) -> tuple[Along, Panel]:
    """Value over one varied key, with a line for each value of a second key, and the applied voltage.

    Lines are interpolated between points as in a map. Points without a value are ``missing``, in the colours
    of their lines where there is a second key.
    """
    x, scale_x = _axis(results, selection.x, selection.along)
    needed = needed_values(selection)
    label, scale = labelled(results, selection.value, needed)
    lines, log_y = lines_of(results, selection, colours)
    path = LinePath(results, selection, x.log, log_y)
    along, heights = scale_x.of(selection.along), scale.of(selection.values)
    log = _is_log(selection)
    window, (bottom, top) = (
        _ends(along, _SIDES, log=x.log),
        _ends(scale.of(needed), _ABOVE, log=log, zero=True),
    )
    curves = []
    if joined(selection, lines):
        for line in lines:
            at, between = path.values(line)
            # Between few points the line is an assumption: thin, with the points standing out.
            width = _THIN if line.numbers.size <= _SPARSE else WIDTH
            curves.append(Curve("", scale_x.of(at), scale.of(between), line.colour, width=width))
    applied, areas = _applied(path, (scale_x, scale), lines, (window, bottom))
    about, also = selection.breakdown, ""
    if selection.of_discharge and selection.value not in about.keys:
        also = f" at the {about.voltage_name} {voltage_text(selection)}"
    groups = [(n.numbers, n.colour, _LARGE if n.numbers.size <= _SPARSE else 1.0) for n in lines]
    marks = _marks(selection, along, heights, groups, also)
    known = [bool(np.any(np.isfinite(mark.y))) for mark in marks]
    curves += [*applied, *(mark for mark, on in zip(marks, known, strict=True) if on)]
    missing = [mark for mark, on in zip(marks, known, strict=True) if not on]
    panel = Panel(label.with_symbol, scale.unit, curves, top, bottom, areas, log=log, missing=missing)
    return replace(x, window=window), panel


def _is_log(selection: Slice) -> bool:
    """Whether the values are shown by their logarithm; shares of time, whose ends both matter, are not."""
    return selection.value not in TIME_SHARES and is_wide(selection.values)


def needed_values(selection: Slice) -> Array:
    """Values that the vertical axis must include: the drawn ones, and those for the applied voltage."""
    if selection.value == selection.breakdown.value:
        return np.concatenate([selection.values, selection.voltage])
    if selection.value == selection.breakdown.margin:
        return np.append(selection.values, 1.0)
    return selection.values


def _ends(values: Array, part: float, *, log: bool, zero: bool = False) -> tuple[float, float]:
    """Ends of an axis around the finite values, with room on both sides, or from ``zero``."""
    finite = values[np.isfinite(values)]
    if not finite.size:
        return 0.0, 1.0
    low, high = float(finite.min()), float(finite.max())
    if log:
        room = (high / low) ** part if high > low else 1.0 + part
        return low / room, high * room
    room = part * (high - low) or 0.01 * abs(high) or 1.0
    return 0.0 if zero and 0.0 <= low < _FROM_ZERO * high else low - room, high + room


def _applied(
    path: LinePath,
    scales: tuple[Scale, Scale],
    lines: list[SeriesLine],
    ends: tuple[tuple[float, float], float],
) -> tuple[list[Curve], list[Area]]:
    """Value that corresponds to the applied voltage, and the values below it. ``ends`` are the ends of the
    horizontal axis, and the lower one of the vertical axis.
    """
    selection, (scale_x, scale), (window, floor) = path.selection, scales, ends
    volts = selection.voltage[np.isfinite(selection.voltage)]
    if not (selection.of_discharge and volts.size) or selection.value not in selection.breakdown.keys:
        return [], []
    about, applied = selection.breakdown, voltage_text(selection)
    text, sides, whole = f"{about.voltage_name} {applied}", np.array(window), np.ones(2, dtype=bool)

    def shaded(name: str, low: float, high: float) -> Area:
        return Area(name, sides, whole, GREY, 0.15, (np.full(2, low), np.full(2, high)))

    if selection.value == selection.breakdown.margin:
        # A margin of 1 is where breakdown voltage and applied voltage are equal.
        level, text = 1.0, f"margin 1 at {applied}"
    elif np.ptp(volts) <= 1e-9 * volts[0]:
        level = float(scale.of(volts[0]))
    elif not joined(selection, lines):
        return [], [shaded(text, *scale.of(np.array([volts.min(), volts.max()])))]
    else:
        # The applied voltage differs from point to point: it is drawn along each line, in its colour, and no
        # range below it is shaded.
        paths = [(*path.voltages(line), line.colour) for line in lines]
        return [
            Curve("" if k else text, scale_x.of(at), scale.of(there), colour, "dash", 0.9)
            for k, (at, there, colour) in enumerate(paths)
        ], []
    return [Curve(text, sides, np.full(2, level), BLACK, "dash")], [
        shaded(f"below {about.voltage_name}", floor, level)
    ]
