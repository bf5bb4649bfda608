"""Figures of an oil: its properties over pressure at several temperatures, and over temperature."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.lines import Line2D

from ehlectric.arrays import Array
from ehlectric.cases.case_oil import KnownOil, known_oil
from ehlectric.cases.oil_report import (
    PROPERTIES,
    OilProperty,
    OilReport,
    celsius,
    depends_on_temperature,
    law_behind,
    origin,
)
from ehlectric.errors import InputError
from ehlectric.figures.figure_names import OIL_FIGURE_FILES
from ehlectric.figures.style import (
    figure_of,
    line_colours,
    name_over,
    new_panels,
    save_figure,
    scale_axis,
    style,
)
from ehlectric.quantities.formats import CELSIUS
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.runtime.undrawn import drawing

# Pressure up to which an oil is drawn at least [Pa]; a higher one of the user is drawn with some room.
_PRESSURE, _ROOM = 2e9, 1.1

# Ends of the temperatures of an oil without a range of its own [K]: the temperatures of a data sheet.
_ENDS = (313.15, 373.15)

# Nodes of a curve over pressure and over temperature.
_NODES, _FEWER = 201, 61


_DOT: dict[str, Any] = {"marker": "o", "ms": 4.0, "ls": "none", "zorder": 3.0}


@dataclass(frozen=True)
class _Panel:
    """Panel of a figure: properties that are drawn in it, factor to the shown unit, label and scale."""

    names: tuple[str, ...]
    factor: float
    label: str
    log: bool = False


_OVER_PRESSURE = (
    _Panel(("viscosity",), 1.0, r"viscosity $\eta$ [Pa s]", log=True),
    _Panel(("density",), 1.0, r"density $\rho$ [kg/m³]"),
    _Panel(("relative_permittivity",), 1.0, r"relative permittivity $\varepsilon_\mathrm{r}$"),
    _Panel(("thermal_conductivity",), 1.0, r"thermal conductivity $\lambda$ [W/(m K)]"),
    _Panel(("heat_capacity",), 1e-6, r"heat capacity $\rho c$ [MJ/(m³ K)]"),
)
_RATIO = _Panel(("density_ratio",), 1.0, r"density over ambient $\rho/\rho_0$")
_OVER_TEMPERATURE = (
    _Panel(("viscosity",), 1e3, r"viscosity $\eta_0$ [mPa s]", log=True),
    _Panel(("alpha_star", "pressure_viscosity_coefficient"), 1e9, r"$\alpha^*$ and $\alpha$ [1/GPa]"),
    _Panel(("density",), 1.0, r"density $\rho_0$ [kg/m³]"),
    _Panel(("relative_permittivity",), 1.0, r"relative permittivity $\varepsilon_\mathrm{r}$"),
    _Panel(("conductivity",), 1.0, r"conductivity $\sigma$ [S/m]", log=True),
    _Panel(("thermal_conductivity",), 1.0, r"thermal conductivity $\lambda$ [W/(m K)]"),
    _Panel(("heat_capacity",), 1e-6, r"heat capacity $\rho c$ [MJ/(m³ K)]"),
)

# Colour and dashes of the curves in a panel over temperature, and their names where there are two.
_LOOKS = ((BLUE, "-"), (ORANGE, "--"))
_NAMES: Mapping[str, str] = MappingProxyType(
    {
        "alpha_star": r"$\alpha^*$, of film-thickness formulas",
        "pressure_viscosity_coefficient": r"$\alpha$, at $p=0$",
    }
)


def over_pressure(report: OilReport) -> list[Axes]:
    """Draw the properties of an oil over pressure, a curve for each temperature. Returns axes of a new
    figure: viscosity, density (or its ratio to the density at ambient pressure), permittivity, and thermal
    properties that change with pressure.
    """
    highest = max(_PRESSURE, _ROOM * max(report.pressures, default=0.0))
    pressure = np.linspace(0.0, highest, _NODES)
    panels = [panel for panel in _panels_over_pressure(report) if _known(report.oils, panel, pressure[1])]
    axes = _axes_of(panels)
    if not axes:
        return axes
    for ax, panel in zip(axes, panels, strict=True):
        oil_property = PROPERTIES[panel.names[0]]
        for colour, oil in zip(_colours(len(report.oils)), report.oils, strict=True):
            values = panel.factor * np.array([_value(oil_property, oil, at) for at in pressure.tolist()])
            within = pressure <= oil_property.range_end(oil)
            ax.plot(1e-9 * pressure[within], values[within], color=colour, label=celsius(oil.temperature))
            _beyond(ax, panel, oil, (pressure, values), colour)
        for mark in report.pressures:
            ax.axvline(1e-9 * mark, color=GREY, lw=0.6, zorder=0.5)
        _finish(ax, panel, _title(report, panel.names[0], 1e9))
        ax.set(xlabel=r"pressure $p$ [GPa]", xlim=(0.0, 1e-9 * highest))
    # A density rises ever more slowly, so that the corner below it is free.
    of_density = next(k for k, panel in enumerate(panels) if panel.names[0].startswith("density"))
    ends = any(line.get_linestyle() == ":" for ax in axes for line in ax.get_lines())
    _legend(axes[of_density], report, ends=ends)
    name_over(axes[0], _heading(report, "over pressure", _PRESSURE))
    return axes


def _panels_over_pressure(report: OilReport) -> Iterator[_Panel]:
    """Panels over pressure: without a known density its ratio is drawn; constants are not drawn."""
    for panel in _OVER_PRESSURE:
        name = panel.names[0]
        if name == "density" and all(oil.density is None for oil in report.oils):
            yield _RATIO
        elif not _flat(name, report, 1e9):
            yield panel


def _flat(name: str, report: OilReport, pressure: float) -> bool:
    """Whether a property is a constant that nobody needs to see drawn; films need the others."""
    optional = ("conductivity", "thermal_conductivity", "heat_capacity")
    return name in optional and law_behind(name, report.named.table, pressure) == "constant"


def _known(oils: Sequence[KnownOil | None], panel: _Panel, pressure: float) -> bool:
    """Whether the first property of a panel is known for one of the oils at a pressure [Pa]."""
    return any(math.isfinite(_value(PROPERTIES[panel.names[0]], oil, pressure)) for oil in oils)


def _oil_at(report: OilReport, kelvin: float) -> KnownOil | None:
    """Oil at a temperature [K]; None where one of its laws has no value."""
    try:
        return known_oil(report.named.table, kelvin)
    except InputError:
        return None


def _value(oil_property: OilProperty, oil: KnownOil | None, pressure: float) -> float:
    """Value of a property; NaN where it is not known, or beyond a pole of its law."""
    if oil is None:
        return math.nan
    try:
        value = oil_property.value(oil, pressure)
    except InputError:
        return math.nan
    return math.nan if value is None else value


def _beyond(ax: Axes, panel: _Panel, oil: KnownOil, curve: tuple[Array, Array], colour: str) -> None:
    """Draw the part of a curve beyond the range of its law, and the end of the range."""
    pressure, values = curve
    oil_property = PROPERTIES[panel.names[0]]
    end = oil_property.range_end(oil)
    if end >= pressure[-1]:
        return
    beyond = pressure >= end
    at_end = panel.factor * _value(oil_property, oil, end)
    x, y = np.append(end, pressure[beyond]), np.append(at_end, values[beyond])
    ax.plot(1e-9 * x, y, color=colour, ls=":")
    ax.plot([1e-9 * end], [at_end], color=colour, **_DOT)


def over_temperature(report: OilReport) -> list[Axes]:
    """Draw the properties of an oil at ambient pressure over its range of temperatures. Returns axes of a new
    figure: viscosity, both pressure-viscosity coefficients, density, permittivity, conductivity and thermal
    properties as far as they are known; dots mark the temperatures of the report.
    """
    table = report.named.table
    known = [kelvin for kelvin in report.temperatures if kelvin is not None]
    ends = table.temperature_range or (min(_ENDS[0], *known), max(_ENDS[1], *known))
    kelvins = np.linspace(ends[0], ends[1], _FEWER)
    oils = [_oil_at(report, kelvin) for kelvin in kelvins.tolist()]
    panels = [panel for panel in _OVER_TEMPERATURE if _known(oils, panel, 0.0)]
    panels = [panel for panel in panels if not _flat(panel.names[0], report, 0.0)]
    axes = _axes_of(panels)
    if not axes:
        return axes
    for ax, panel in zip(axes, panels, strict=True):
        for name, (colour, dashes) in zip(panel.names, _LOOKS, strict=False):
            oil_property = PROPERTIES[name]
            values = panel.factor * np.array([_value(oil_property, oil, 0.0) for oil in oils])
            ax.plot(CELSIUS.of(kelvins), values, color=colour, ls=dashes, label=_NAMES.get(name, ""))
            marked = [panel.factor * _value(oil_property, oil, 0.0) for oil in report.oils]
            ax.plot(CELSIUS.of(np.array(known)), marked, color=colour, clip_on=False, **_DOT)
        _finish(ax, panel, _title(report, panel.names[0], 0.0), values)
        ax.set(xlabel="temperature [°C]", xlim=CELSIUS.of(kelvins[[0, -1]]))
        if len(panel.names) > 1:
            ax.legend(frameon=False)
    name_over(axes[0], _heading(report, "over temperature, at ambient pressure", 0.0))
    return axes


def _axes_of(panels: Sequence[_Panel]) -> list[Axes]:
    """Axes of a new figure for some panels, at most three side by side; those that are left over are gone."""
    if not panels:
        return []
    columns = min(len(panels), 3) if len(panels) != 4 else 2
    rows = math.ceil(len(panels) / columns)
    axes = new_panels(rows, columns, (3.3 * columns, 0.9 + 2.7 * rows))
    for ax in axes[len(panels) :]:
        ax.remove()
    return axes[: len(panels)]


def _colours(number: int) -> list[str]:
    """Colours of curves from cold to hot."""
    colours = line_colours()
    return [to_hex(colours(part)) for part in np.linspace(0.0, 1.0, max(number, 2))[:number]]


def _finish(ax: Axes, panel: _Panel, title: str, by_numbers: Array | None = None) -> None:
    """Label and scale the vertical axis, with the law and its kind above; ticks are powers or numbers."""
    ax.set_ylabel(panel.label)
    ax.set_title(title, loc="left")
    ax.grid(lw=0.4)
    if panel.log and by_numbers is not None:
        scale_axis(ax.yaxis, panel.label, values=by_numbers, log=True)
    elif panel.log:
        ax.set_yscale("log")
    else:
        ax.ticklabel_format(axis="y", useOffset=False)
        low, high = ax.get_ylim()
        if high - low < 0.02 * abs(high):
            ax.set_ylim(low - 0.05 * abs(high), high + 0.05 * abs(high))


def _title(report: OilReport, name: str, pressure: float) -> str:
    """Law of a property, and the kind of the weakest value behind it."""
    law, kind, _ = origin(report.named, PROPERTIES[name], pressure)
    return ": ".join(filter(None, (law, kind)))


def _heading(report: OilReport, over: str, pressure: float) -> str:
    """Lines of the title of a figure: the oil, what it is, and what is not known of it at a pressure [Pa]."""
    named = report.named
    missing = [
        oil_property.title
        for oil_property in PROPERTIES.values()
        if oil_property.over_pressure or pressure == 0.0
        if all(math.isnan(_value(oil_property, oil, pressure)) for oil in report.oils)
    ]
    lines = [f"{named.name or 'Oil'} {over}", named.title]
    if missing:
        lines.append(f"Not known: {', '.join(missing)}")
    return "\n".join(filter(None, lines))


def _legend(ax: Axes, report: OilReport, *, ends: bool) -> None:
    """Draw the legend: temperatures, ends of ranges if there are any, and pressures."""
    entries: list[Line2D] = []
    if any(kelvin is not None for kelvin in report.temperatures):
        entries = [line for line in ax.get_lines() if not str(line.get_label()).startswith("_")]
    if ends:
        look: dict[str, Any] = {"color": GREY, "ls": ":", "marker": "o", "ms": 4.0, "markevery": [0]}
        entries.append(Line2D([], [], label="end of the law's range", **look))
    if report.pressures:
        marks = ", ".join(f"{1e-9 * mark:g}" for mark in report.pressures)
        entries.append(Line2D([], [], color=GREY, lw=0.6, label=f"{marks} GPa"))
    if entries:
        ax.legend(handles=entries, loc="lower right", framealpha=1.0, edgecolor="none")


def save_oil(report: OilReport, folder: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Write the figures of an oil as files, one of each format. Returns files written; an oil whose viscosity
    does not depend on temperature has no figure over it.
    """
    draws = [over_pressure, *([over_temperature] if depends_on_temperature(report.named.table) else [])]
    files = []
    with style():
        for name, draw in zip(OIL_FIGURE_FILES, draws, strict=False):
            with drawing(name):
                if axes := draw(report):
                    files += save_figure(figure_of(axes[0]), folder / name, formats)
    return files
