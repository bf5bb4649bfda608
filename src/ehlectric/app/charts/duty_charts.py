"""Figures over a duty cycle, for a page."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from ehlectric.app.charts.plotly_panels import Plot, kept_nodes, stack
from ehlectric.bearing import DutyResult, lubrication_names
from ehlectric.figures.data import Along, Panel
from ehlectric.figures.duty_panels import duty_panels, gear_duty_panels, time_axis
from ehlectric.gear import MeshDuty, mesh_states
from ehlectric.quantities.formats import rpm_text, scale_of
from ehlectric.readable import readable

# Heads of the table over the time, and largest number of its rows.
DUTY_HEADS = ("time [s]", "speed [rpm]", "temperature [°C]", "λ", "margin", "state")
MOST_DUTY_ROWS = 200
MESH_DUTY_HEADS = (
    "time [s]", "torque [N m]", "speed [rpm]", "flanks [°C]", "λ", "breakdown [V]", "margin", "state"
)  # fmt: skip


def duty_figure(duty: DutyResult) -> Plot:
    """Speed, lambda ratio and margin over the time, with bands of the states behind them."""
    return cycle_plot(time_axis(duty.rows), duty_panels(duty))


def mesh_duty_figure(duty: MeshDuty, summits: float) -> Plot:
    """Speed, torque, lambda ratio and breakdown voltage over the time, with bands of the states of the mesh.
    ``summits``, height of the highest summits in units of the composite Rq.
    """
    return cycle_plot(time_axis(duty.rows), gear_duty_panels(duty, summits))


def cycle_plot(along: Along, panels: Iterable[Panel]) -> Plot:
    """Panels over the time of a duty cycle; the first one has the speed, and names the bands."""
    shown = [*_named_once(panels)]
    titles, seen = {panel.title for panel in shown}, set[str]()
    made = stack(along, shown)
    for trace in made["data"]:
        # The axis of a curve names it, but where a panel has several; these stand in the legend once.
        name = trace.get("name", "")
        trace["showlegend"] = trace["showlegend"] and name not in titles | seen
        seen.add(name)
    # Speeds are written in full, without a k for a thousand.
    made["layout"]["yaxis"]["tickformat"] = "~f"
    return made


def _named_once(panels: Iterable[Panel]) -> Iterator[Panel]:
    """Panels with common bands, which only the first panel names."""
    for number, panel in enumerate(panels):
        areas = [replace(area, name="" if number else area.name) for area in panel.areas]
        yield replace(panel, areas=areas)


def duty_rows(duty: DutyResult) -> list[tuple[str, ...]]:
    """Cells of the table over the time, of rows evenly spaced in the file."""
    rows, celsius = duty.rows, scale_of("°C")
    names = lubrication_names(rows.state, rows.lambda_ratio)
    return [
        (
            readable(rows.time[k], 6),
            rpm_text(rows.speed[k]),
            readable(celsius.of(float(rows.temperature[k])), 4),
            *(_known(column[k]) for column in (rows.lambda_ratio, rows.margin)),
            names[k],
        )
        for k in kept_nodes(rows.time.size, MOST_DUTY_ROWS).tolist()
    ]


def mesh_duty_rows(duty: MeshDuty) -> list[tuple[str, ...]]:
    """Cells of the table of a gear pair over the time, of rows evenly spaced in the file."""
    rows, celsius, names = duty.rows, scale_of("°C"), mesh_states(duty.rows)
    return [
        (
            readable(rows.time[k], 6),
            readable(rows.torque[k], 4),
            rpm_text(rows.speed[k]),
            _known(celsius.of(float(rows.flank_temperature[k])), 4),
            *(_known(column[k]) for column in (rows.lambda_ratio, rows.breakdown_voltage, rows.margin)),
            names[k],
        )
        for k in kept_nodes(rows.time.size, MOST_DUTY_ROWS).tolist()
    ]


def _known(value: float, digits: int = 3) -> str:
    """Number of a cell, or "none"."""
    return readable(value, digits) if value == value else "none"
