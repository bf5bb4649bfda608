"""Rows of the tables of transient contacts: of a schedule before a run, and of a run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.cases.row import Row, rows_of
from ehlectric.motion.keys import LINE_KEYS
from ehlectric.motion.schedule import Schedule


def schedule_rows(schedule: Schedule, entrainment_speed: float) -> Iterator[Row]:
    """Rows of a schedule: its duration, its steps, and the speeds of the rough surfaces.

    Parameters
    ----------
    schedule : Schedule
        Time steps of a run.
    entrainment_speed : float
        Entrainment speed of the contact [m/s].

    Yields
    ------
    Row
        Values in SI units.
    """
    moments = schedule.moments()
    yield Row("motion", schedule.end * schedule.time, "ms", f" in {schedule.steps} steps")
    yield Row("  of oil in a step", schedule.courant, note="grid spacings", digits=".3g")
    for surface in schedule.rough:
        yield Row(f"  surface {surface}, rough", schedule.speed_of(surface) * entrainment_speed, "m/s")
    for name, key in (("covers the contact from", "covered_from"), ("lies as in the case at", "coincident")):
        if key in moments:
            yield Row(f"  {name}", moments[key], "ms")


def run_rows(summary: Mapping[str, Any]) -> list[Row]:
    """Rows of the key figures of a transient run.

    Parameters
    ----------
    summary : mapping
        Summary of the run, as ``summary_of`` gives it.

    Returns
    -------
    list of Row
        Values in SI units. The number of halved time steps is left out where it is 0.
    """
    motion, field = summary["motion"], summary["field"]
    summary = {**summary, "motion": {**motion, "halvings": motion["halvings"] or None}}
    entries = (
        ("time", "motion.duration", "ms", f" in {motion['steps']} steps"),
        ("smallest film", "film.minimum_thickness", "µm"),
        ("  at", "film.minimum_time", "ms"),
        ("  before the motion", "film.before", "µm"),
        ("  held still", "stationary.minimum_thickness", "µm"),
        ("largest pressure", "film.max_pressure", "GPa"),
        ("  held still", "stationary.max_pressure", "GPa"),
        ("voltage", "field.voltage", "V"),
        ("largest field", "field.max_strength", "V/µm"),
        ("  at", "field.max_strength_time", "ms"),
        ("  before the motion", "field.before", "V/µm"),
        ("  held still", "stationary.max_strength", "V/µm"),
        ("  above 90 % of it", "field.share_above_90", "%", " of the time"),
        ("local maxima, median", "field.local_maxima_quantiles.1", "V/µm", f" of {field['local_maxima']}"),
        ("  95 %", "field.local_maxima_quantiles.2", "V/µm"),
        ("breakdown voltage", "discharge.breakdown_voltage", "V", ", least over time"),
        ("where both lie alike, at", "beside_stationary.time", "ms"),
        ("  smallest film, moving", "beside_stationary.minimum_thickness", "µm"),
        ("  held still", "beside_stationary.minimum_thickness_stationary", "µm"),
        ("  largest field, moving", "beside_stationary.maximum_strength", "V/µm"),
        ("  held still", "beside_stationary.maximum_strength_stationary", "V/µm"),
        ("time steps halved", "motion.halvings", "", "times, where one was not found"),
        ("Newton steps a time step", "motion.newton_per_step", ""),
        ("took", "seconds", "s"),
    )
    return list(rows_of(LINE_KEYS, summary, entries))
