"""Panels of a gear pair: along its path of contact, on its flank, and over a phase of its mesh."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.cases.defaults import HOW
from ehlectric.figures import contact_findings
from ehlectric.figures.data import Along, Area, Curve, Panel, Upright
from ehlectric.formulas.monotone_cubic import MonotoneCubic
from ehlectric.gear import GearResult, name_of_place, state_of, weakest
from ehlectric.quantities.formats import amount, operating_point, time_share_text
from ehlectric.quantities.lubrication_states import CONDUCTS
from ehlectric.quantities.palette import BLACK, BLUE, GREEN, MIDDLE_GREY, ORANGE, STRENGTH
from ehlectric.quantities.units import unit_for
from ehlectric.readable import ratio_text, readable

_prefixed = partial(contact_findings.with_unit, least=1.0)

# Part of the largest mean by which values at a place differ at least where their range is drawn.
_VARIES = 0.05

# Ratio of the height of the summits to the minimum film above which the axis of the film is logarithmic.
_FAR = 4.0

# Ratio of the voltage between both gears to the breakdown voltage up to which it is drawn.
_NEAR = 4.0

# Room around the curves of a panel, in parts of its largest value, and multiple of the thinnest film up to
# which films are drawn: where the load ends, they are as thick as gaps.
_ROOM, _CUT = 1.08, 4.0


# Rows and columns of the map of a flank, and overlap ratio up to which lines are taken as straight along it.
_ROWS, _COLUMNS = 360, 240

# Number of nodes of a line from which on a curve through them is smoother than straight lines.
_FEW = 3

_STRAIGHT = 0.1


def over_flank(result: GearResult, values: Array) -> tuple[Array, Array, Array]:
    """Map values at nodes of lines of contact, shape (nodes,), on the flank. Returns places g, shape
    (m,), places y on the face, shape (n,), and values there, shape (m, n); NaN outside of all values.
    """
    g, y, between, inside = _extended(result, values)
    return g, y, np.where(inside < 0.0, np.nan, between)


def _extended(result: GearResult, values: Array) -> tuple[Array, Array, Array, Array]:
    """Values on the flank as ``over_flank``, continued beyond their ends; and distances [m] from the edge of
    the places with values, shape (m, n), negative outside of them.

    A line of contact passes each place of the flank at one phase, so that the value there is one number. It
    is interpolated along the two nearest lines, and between them, and so are the ends of the values.
    """
    path, width, loads = result.solution.path, result.solution.pair.face_width, result.solution.loads
    g = np.linspace(path.start, path.end, _ROWS)
    y = (np.arange(_COLUMNS) + 0.5) / _COLUMNS * width
    straight = result.solution.plane.overlap_ratio < _STRAIGHT
    along, nodes = (y, loads.across) if straight else (g, loads.places)
    slope = math.tan(path.base_helix_angle)
    begins, rows, gaps, ends = [], [], [], []
    for line in loads.lines():
        begins.append(float(loads.places[line][0] - slope * loads.across[line][0]))
        rows.append(_smooth(along, nodes[line], values[line]))
        gaps.append(np.isnan(np.interp(along, nodes[line], values[line])))
        known = nodes[line][~np.isnan(values[line])]
        ends.append([nodes[line][0], known[0], known[-1], nodes[line][-1]] if known.size else [np.nan] * 4)
    order = np.argsort(begins)
    begin, of_lines, without = np.array(begins)[order], np.array(rows)[order], np.array(gaps)[order]
    target = g[:, np.newaxis] - slope * y
    after = np.clip(np.searchsorted(begin, target), 1, begin.size - 1)
    part = np.clip((target - begin[after - 1]) / (begin[after] - begin[after - 1]), 0.0, 1.0)
    k = np.arange(_COLUMNS) if straight else np.arange(_ROWS)[:, np.newaxis]
    before, behind = of_lines[after - 1, k], of_lines[after, k]
    # Outside of all lines, and next to a single one, the nearest line has the value.
    between = np.where(
        (part == 0.0) | np.isnan(behind),
        before,
        np.where((part == 1.0) | np.isnan(before), behind, before + part * (behind - before)),
    )

    first, low, high, last = np.array(ends)[order].T
    begun = 0.0 if straight else np.maximum(path.start, target)
    ended = width if straight else np.minimum(path.end, target + slope * width)
    at = along if straight else g[:, np.newaxis]
    inside = np.minimum(
        at - _edge(low, low - first, after, part, begun),
        _edge(high, high - last, after, part, ended) - at,
    )
    some = np.flatnonzero(~np.isnan(low))
    if some[0] > 0:
        inside = np.fmin(inside, target - begin[some[0]])
    if some[-1] < begin.size - 1:
        inside = np.fmin(inside, begin[some[-1]] - target)
    inside = np.where(np.abs(inside) < _ROUNDING, 0.0, inside)
    lacking = np.isnan(inside) | (without[after - 1, k] & without[after, k])
    return g, y, between, np.where(lacking, np.fmin(-np.abs(inside), -_ROUNDING), inside)


# Distance [m] from an edge of values that is due to rounding.
_ROUNDING = 1e-9


def _edge(ends: Array, inset: Array, after: IntArray, part: Array, whole: Array | float) -> Array:
    """Ends of the values between two lines, from the ends on each line and their distances ``inset`` from the
    end of the line; ``whole``, ends of the lines at each place.
    """

    def mean(at_lines: Array) -> Array:
        return np.asarray((1.0 - part) * at_lines[after - 1] + part * at_lines[after])

    both = (inset[after - 1] != 0.0) & (inset[after] != 0.0)
    return np.where(both, mean(ends), whole + mean(inset))


def _smooth(along: Array, nodes: Array, values: Array) -> Array:
    """Values of a line at places along it, from values at its nodes by a monotone cubic curve, and constant
    beyond the first and the last one; NaN without any value.
    """
    known = ~np.isnan(values)
    places, first = np.unique(nodes[known], return_index=True)
    if places.size == 0:
        return np.full(along.size, np.nan)
    if places.size < _FEW:
        return np.interp(along, places, values[known][first])
    curve = MonotoneCubic(places, values[known][first][np.newaxis])
    return np.asarray(curve(np.clip(along, places[0], places[-1]))[0])


@dataclass(frozen=True)
class OverPath:
    """Values over the places g of the path of contact: mean, least and greatest over phases and face."""

    places: Array  # [m]
    mean: Array
    low: Array
    high: Array

    @classmethod
    def of(cls, result: GearResult, values: Array) -> OverPath:
        """Values of all lines of contact, shape (nodes,), by their places; NaN is no value."""
        places, _, on_flank = over_flank(result, values)
        some = ~np.all(np.isnan(on_flank), axis=1)
        places, on_flank = places[some], on_flank[some]
        return cls(places, *(part(on_flank, axis=1) for part in (np.nanmean, np.nanmin, np.nanmax)))

    @property
    def varies(self) -> bool:
        """Whether values at a place differ between the phases or over the face."""
        return bool(np.any(self.high - self.low > _VARIES * np.max(np.abs(self.mean), initial=0.0)))

    def drawn(
        self, name: str, factor: float, colour: str, dash: str = "solid"
    ) -> tuple[Curve, tuple[Area, ...]]:
        """Curve of the mean, and the area between the least and the greatest value where they differ."""
        x = 1e3 * self.places
        curve = Curve(name, x, factor * self.mean, colour, dash)
        if not self.varies:
            return curve, ()
        ends = factor * self.low, factor * self.high
        within = np.ones(x.size, dtype=bool)
        return curve, (Area(_BAND, x, within, colour, 0.2, ends),)


# Name of an area around a mean.
_BAND = "range over phases and face"


def path_axis(result: GearResult) -> Along:
    """Axis along the path of contact."""
    path = result.solution.path
    room = 0.01 * path.length
    ends = (1e3 * (path.start - room), 1e3 * (path.end + room))
    return Along("place $g$ on the path of contact", "mm", ends)


def _points(result: GearResult) -> list[Upright]:
    """Upright lines at the points A to E."""
    return [Upright("", 1e3 * place, MIDDLE_GREY, "dot") for place in result.solution.path.points.values()]


def path_panels(result: GearResult) -> list[Panel]:
    """Radii of curvature, speeds, line load and Hertzian pressure over the path of contact."""
    solution = result.solution
    path, films = solution.path, solution.films
    g = np.linspace(path.start, path.end, 201)
    first, second = (np.asarray(radius) for radius in path.transverse_radii(g))
    speeds = path.speeds(g, solution.flanks.pinion_speed, solution.pair.ratio)
    colours, names = (BLUE, ORANGE), ("gear 1", "ring, concave" if solution.pair.internal else "gear 2")
    radii = [(names[0], first, BLUE), (names[1], np.abs(second), ORANGE)]
    radii += [("reduced radius", np.asarray(path.reduced_radius(g)), BLACK)]
    return [
        _along_path(
            result,
            "radius of\ncurvature $ρ$",
            "mm",
            [Curve(name, 1e3 * g, 1e3 * radius, colour) for name, radius, colour in radii],
        ),
        _along_path(
            result,
            "speed of the\nflank $v$",
            "m/s",
            [Curve("", 1e3 * g, np.asarray(v), c) for v, c in zip(speeds, colours, strict=True)],
        ),
        _of_lines(result, "line load $w$", "N/m", solution.loads.load),
        _of_lines(
            result,
            "Hertzian\npressure $p_H$",
            "Pa",
            np.where(solution.loads.load > 0.0, films.max_pressure, 0.0),
        ),
    ]


def _along_path(
    result: GearResult,
    title: str,
    unit: str,
    curves: Sequence[Curve],
    areas: Sequence[Area] = (),
    *,
    cut: float = math.inf,
    log: bool = False,
) -> Panel:
    """Panel of curves, from zero on a linear axis, with lines at the points A to E.

    A linear axis ends at ``cut`` times the smallest value of the first curve, and contains constant curves.
    """
    values = np.concatenate([curve.y for curve in curves])
    highest = [float(np.max(area.ends[1])) for area in areas if area.ends is not None]
    most = max(float(np.max(values)), max(highest, default=0.0))
    if math.isfinite(cut) and not log:
        constant = [float(curve.y[0]) for curve in curves if np.ptp(curve.y) == 0.0]
        most = min(most, max(cut * float(np.min(curves[0].y)), *constant, 0.0))
    top = (1.25 if log else _ROOM) * most
    bottom = 0.8 * float(np.min(values)) if log else 0.0
    return Panel(title, unit, curves, top, bottom, areas, _points(result), log=log)


def _of_lines(result: GearResult, title: str, unit: str, values: Array) -> Panel:
    """Panel of a quantity of the lines of contact."""
    over = OverPath.of(result, values)
    factor, shown = unit_for(float(np.max(over.high)), unit, least=1.0)
    if unit == "N/m":
        factor, shown = 1e-3, "N/mm"
    curve, areas = over.drawn("mean of all lines of contact", factor, GREEN)
    return _along_path(result, title, shown, [curve], areas)


def film_panels(result: GearResult) -> list[Panel]:
    """Film thickness, with the height of the highest summits, and lambda ratio over the path of contact."""
    solution = result.solution
    films, ends = solution.films, np.array(path_axis(result).window)
    central, minimum = (OverPath.of(result, values) for values in (films.central, films.minimum))
    isothermal = OverPath.of(result, films.minimum / films.heat_factor)
    factor, unit = unit_for(max(float(np.max(central.high)), solution.summits), "m", least=1.0)
    upper, upper_areas = central.drawn("central film", factor, BLUE)
    lower, lower_areas = minimum.drawn("minimum film", factor, ORANGE)
    curves = [upper, lower]
    if np.any(films.heat_factor[~np.isnan(films.minimum)] < 0.999):
        curves.append(isothermal.drawn("minimum film, isothermal", factor, ORANGE, "dot")[0])
    level = np.full(2, factor * solution.summits)
    curves.append(Curve(f"highest summits, {summit_text(result)}", ends, level, BLACK, "dash"))
    ratio = OverPath.of(result, films.minimum / solution.rq)
    line, areas = ratio.drawn("", 1.0, ORANGE)
    height = Curve("", ends, np.full(2, solution.case.gear.summit_height), BLACK, "dash")
    log = solution.summits > _FAR * float(np.nanmin(films.minimum))
    of_films = (*upper_areas, *lower_areas)
    return [
        _along_path(result, "film thickness $h$", unit, curves, of_films, cut=_CUT, log=log),
        _along_path(result, "lambda ratio\n$λ = h_{min}/Rq$", "", [line, height], areas, cut=_CUT, log=log),
    ]


def summit_text(result: GearResult) -> str:
    """Height of the highest summits as a multiple of Rq."""
    return f"{readable(result.case.gear.summit_height)} Rq = {_prefixed(result.solution.summits, 'm')}"


# Part of the mean that the axis of a nearly constant capacitance or voltage reaches to either side.
_LEAST_SPAN = 0.05


def mesh_panels(result: GearResult) -> list[Panel]:
    """Capacitance, breakdown voltage where there is one, and time share of contact over a phase."""
    phase, over_phase = result.over_phase(), result.solution.breakdown_voltage_over_phase
    capacitance = phase["capacitance"]
    factor, unit = unit_for(float(np.max(capacitance)), "F", least=1.0)
    panels = [_over_phase("capacitance $C$", unit, [_phase_curve(result, "", factor * capacitance, BLUE)])]
    if over_phase is not None and has_voltage(result):
        voltage = over_phase[1]
        most, applied = float(np.max(voltage)), result.case.gear.contact.voltage
        near = applied is not None and applied <= _NEAR * most
        scale, volts = unit_for(max(most, applied) if applied is not None and near else most, "V", least=1.0)
        name = "breakdown voltage" if near else ""
        curves = [_phase_curve(result, name, scale * voltage, STRENGTH)]
        if applied is not None and near:
            level = np.full(2, scale * applied)
            curves.append(Curve("voltage between both gears", np.array([0.0, 1.0]), level, BLACK, "dash"))
        panels.append(_over_phase("breakdown\nvoltage $V_b$", volts, curves))
    share = 100.0 * phase["contact_time_share"]
    curve = _phase_curve(result, "", share, ORANGE)
    top = 100.0 if np.max(share) > 20.0 else max(float(np.max(share)), 1.0)
    # The curve is seen at both ends of the axis.
    return [*panels, Panel("time with\nmetallic contact", "%", [curve], 1.04 * top, -0.04 * top)]


def has_voltage(result: GearResult) -> bool:
    """Whether the mesh has a breakdown voltage at any phase: it has a strength, and summits do not touch."""
    voltage = result.solution.breakdown_voltage
    return voltage is not None and bool(np.max(voltage) > 0.0)


def _phase_curve(result: GearResult, name: str, values: Array, colour: str) -> Curve:
    """Values at the phases of the table, which return to the first one after a pitch; of a spur pair in a
    step.
    """
    phases = result.over_phase()["phase"]
    if result.solution.pair.helix_angle == 0.0:
        x, ends = np.concatenate([[0.0], phases, [1.0]]), (values[:1], values[-1:])
    else:
        x, ends = np.concatenate([[phases[-1] - 1.0], phases, [1.0 + phases[0]]]), (values[-1:], values[:1])
    return Curve(name, x, np.concatenate([ends[0], values, ends[1]]), colour)


def _over_phase(title: str, unit: str, curves: Sequence[Curve]) -> Panel:
    """Panel whose axis extends beyond the values on both sides."""
    values = np.concatenate([curve.y for curve in curves])
    low, high = float(np.min(values)), float(np.max(values))
    room = max(0.15 * (high - low), _LEAST_SPAN * 0.5 * (low + high))
    return Panel(title, unit, curves, high + room, max(0.0, low - room))


PHASE_AXIS = Along("phase of the mesh, 1 for each tooth", "", (0.0, 1.0))


# Part of the places with a film whose films differ in colour, and ratio of the thickest film to their
# thickest one up to which all films differ: where the load begins, films are as thick as in a gap, and would
# take all colours.
_IN_COLOUR, _SLIGHTLY = 0.95, 1.1


def last_colour(films: Array) -> float:
    """Film [m] from which on all films of a map have the last colour; the thickest film, where it differs
    little from almost all others.

    Examples
    --------
    >>> last_colour(np.array([2e-7, np.nan, 3e-7]))
    3e-07
    """
    most = float(np.nanmax(films))
    limit = float(np.nanquantile(films, _IN_COLOUR))
    return limit if most > _SLIGHTLY * limit else most


def flank_map(result: GearResult) -> tuple[Array, Array, Array]:
    """Minimum film on the flank: places g on the path of contact, shape (m,), places y on the face, shape
    (n,), and films [m], shape (m, n); NaN where the flanks carry no load.
    """
    return over_flank(result, result.solution.films.minimum)


def continued_films(result: GearResult) -> tuple[Array, Array, Array, Array]:
    """Places g and y as ``flank_map``, films [m] continued beyond the loaded places, and distances [m] from
    the edge of the loaded places, shape (m, n), negative where the flanks carry no load.
    """
    return _extended(result, result.solution.films.minimum)


def flank_lines(result: GearResult) -> Iterator[tuple[Array, Array]]:
    """Lines of contact at the phase with the minimum film: places y on the face and g on the path [m], each
    of shape (n,); g is NaN where a line has no film.
    """
    solution = result.solution
    loads = solution.loads
    phase = loads.phase[solution.thinnest]
    y = np.linspace(0.0, solution.pair.face_width, _COLUMNS)
    slope = math.tan(solution.path.base_helix_angle)
    for line in loads.lines():
        if loads.phase[line][0] == phase:
            places, nodes = loads.places[line], loads.across[line]
            without = np.isnan(np.interp(y, nodes, solution.films.minimum[line]))
            yield y, np.where(without, np.nan, places[0] + slope * (y - nodes[0]))


# Parts of the flank of gear 1 at both ends of the path of contact.
ENDS_OF_FLANK = {"A": "root of gear 1", "E": "tip of gear 1"}

# Part of the path of contact within which names of points share a place.
_CLOSE = 0.05


def named_points(result: GearResult) -> list[tuple[float, str]]:
    """Places g of the points A to E [mm] with their names; close ones share a name."""
    path = result.solution.path
    groups: list[list[tuple[float, str]]] = []
    for name, place in sorted(path.points.items(), key=lambda item: item[1]):
        if groups and place - groups[-1][-1][0] < _CLOSE * path.length:
            groups[-1].append((place, name))
        else:
            groups.append([(place, name)])
    return [
        (1e3 * float(np.mean([place for place, _ in group])), ", ".join(name for _, name in group))
        for group in groups
    ]


def path_finding(result: GearResult) -> str:
    """Sentence: the largest Hertzian pressure and where it is, and the range of the sliding."""
    films, solution = result.solution.films, result.solution
    at = np.unravel_index(int(np.nanargmax(films.max_pressure)), films.max_pressure.shape)
    pressure = _prefixed(float(films.max_pressure[at]), "Pa")
    where = _short(name_of_place(solution, float(films.places[at])))
    points = {row["point"]: row["slide_to_roll_ratio"] for row in result.points()}
    ends = [f"{readable(points[name])} at {name}".replace("-", "−") for name in ("A", "E")]
    return f"Largest Hertzian pressure {pressure} {where}; slide-to-roll ratio {' to '.join(ends)}"


def _short(place: str) -> str:
    """Place of the path of contact in a sentence, from its name."""
    return place if place.startswith("between") else f"at {place.partition(',')[0]}"


def _thinnest(result: GearResult) -> str:
    """Clause: the minimum film, and where on the path of contact it is."""
    place = name_of_place(result.solution, weakest(result.solution)[0])
    return f"Minimum film {_prefixed(float(np.nanmin(result.solution.films.minimum)), 'm')} {_short(place)}"


def film_finding(result: GearResult) -> str:
    """Sentence: the minimum film with its place, its lambda, and whether summits touch there."""
    solution = result.solution
    thinnest = float(np.nanmin(solution.films.minimum))
    against = "below" if thinnest <= solution.summits else "above"
    height = f"{readable(solution.case.gear.summit_height)} Rq"
    ratio = readable(thinnest / solution.rq)
    return f"{_thinnest(result)}: λ {ratio}, {against} the highest summits of {height}"


def flank_finding(result: GearResult) -> str:
    """Sentence: the minimum film with its place, and the part of the flank on which summits touch."""
    _, _, films = flank_map(result)
    known = films[~np.isnan(films)] <= result.solution.summits
    if np.all(known):
        touching = "the highest summits touch on the whole flank"
    elif np.any(known):
        touching = f"the highest summits touch on {_part_text(float(np.mean(known)))} of the flank"
    else:
        touching = "no summits touch"
    place = name_of_place(result.solution, weakest(result.solution)[0]).partition(",")[0]
    where = f", the {ENDS_OF_FLANK[place]}" if place in ENDS_OF_FLANK else ""
    return f"{_thinnest(result)}{where}; {touching}"


def mesh_finding(result: GearResult) -> str:
    """Sentence: breakdown voltage and capacitance over a phase, or why there is no voltage."""
    phase, state = result.over_phase(), state_of(result.solution)
    capacitance = f"capacitance {_range(phase['capacitance'], 'F')}"
    share = f"metallic contact {time_share_text(float(phase['contact_time_share'] @ phase['phase_weight']))}"
    if state == CONDUCTS:
        return f"The mesh conducts: {share}; {capacitance}"
    touching = result.solution.loads.least(result.solution.gap) == 0.0
    if result.solution.strength is None and not np.any(touching):
        return f"The mesh {state}: {share}; {capacitance}; no dielectric strength is given"
    over_phase, applied = result.solution.breakdown_voltage_over_phase, result.case.gear.contact.voltage
    voltage = None if over_phase is None else over_phase[1]
    lead = f"The mesh {state}"
    if applied is not None:
        lead = f"{result.verdict.lead} at {_prefixed(applied, 'V')}"
    if np.all(touching):
        return f"{lead}: the highest summits touch at all phases, no breakdown voltage; {capacitance}"
    if np.any(touching):
        at = f"{_part_text(result.solution.loads.mean(touching))} of the phases"
        if voltage is None:
            return f"{lead}: the highest summits touch at {at}; {capacitance}"
        most = _prefixed(float(np.max(voltage)), "V")
        return f"{lead}: the highest summits touch at {at}; breakdown voltage elsewhere up to {most}"
    assert voltage is not None
    breakdown = f"breakdown voltage {_range(voltage, 'V')}"
    if result.margin is None:
        return f"{lead}: {breakdown}, {capacitance}"
    return f"{lead}: margin {ratio_text(result.margin)}; {breakdown}"


def _part_text(part: float) -> str:
    """Part of phases or places, between 0 and 1, which is not rounded to 0 or 100 %.

    Examples
    --------
    >>> _part_text(0.334), _part_text(0.9996), _part_text(2e-4)
    ('33 %', 'more than 99 %', 'less than 1 %')
    """
    if part > 0.99:
        return "more than 99 %"
    return "less than 1 %" if part < 0.01 else f"{readable(100.0 * part, 2)} %"


def last_colour_text(result: GearResult) -> str:
    """Sentence for films of the map of a flank that have the last colour; empty if all films differ."""
    films = flank_map(result)[2]
    last = last_colour(films)
    return f" Films above {_prefixed(last, 'm')} have one colour." if np.nanmax(films) > last else ""


def _range(values: Array, unit: str) -> str:
    """Least and greatest value, or the one number that both are in three digits."""
    factor, shown = unit_for(float(np.max(values)), unit, least=1.0)
    low, high = (readable(factor * float(end)) for end in (np.min(values), np.max(values)))
    return f"{high} {shown}" if low == high else f"{low} to {high} {shown}"


def case_lines(result: GearResult) -> list[str]:
    """Lines: title, torque, speed and temperature of the flanks; and how films and loads are computed."""
    case, solution = result.case, result.solution
    operation = case.gear.operation
    speed, temperature = operating_point(operation.pinion_speed, solution.bulk_temperature)
    parts = [
        textwrap.shorten(case.title, 60, placeholder=" ..."),
        f"{amount(operation.pinion_torque, 'N m')} on gear 1".replace("-", "−"),
        speed,
        f"flanks at {temperature}",
    ]
    films = f"films {HOW[case.contacts]}, load factor {readable(operation.load_factor)}"
    return [", ".join(filter(None, parts)), f"load sharing by {_SHARING[operation.load_sharing]}; {films}"]


_SHARING = {
    "stiffness": "the stiffness of the teeth",
    "rigid": "the length of rigid lines",
    "iso": "ISO/TS 6336-22",
    "tip-relief": "a relief equal to the deflection",
}
