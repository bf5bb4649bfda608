"""Rows of the tables of transient contacts: of a schedule before a run, and of a run."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.cases.case import Case
from ehlectric.contact.kinds import KINDS
from ehlectric.contact.spots.warnings import share_text
from ehlectric.motion.schedule import Schedule
from ehlectric.quantities.motion_results import LINE_KEYS
from ehlectric.quantities.quantity import Bound
from ehlectric.quantities.rows import Row, rows_of, value_at
from ehlectric.tables.contact import condition_rows

# The film is isothermal and fully flooded: real films are thinner, so that their field is higher, and they
# break down at lower voltages.
_AT_MOST = ("discharge.breakdown_voltage", "discharge.margin")
_AT_LEAST = (
    "field.max_strength",
    "field.before",
    "field.local_maxima_quantiles.1",
    "field.local_maxima_quantiles.2",
    "stationary.max_strength",
    "beside_stationary.maximum_strength",
    "beside_stationary.maximum_strength_stationary",
)
_BOUNDS: Mapping[str, Bound] = {key: "≤" if key in _AT_MOST else "≥" for key in (*_AT_MOST, *_AT_LEAST)}

# Heading after whose rows those of asperities come.
_LAST_OF_RUN = "electric field"


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
    yield Row("motion of the roughness")
    yield Row("duration of the motion", schedule.end * schedule.time, "ms", f", {schedule.steps} time steps")
    yield Row("oil travel per time step / grid spacing", schedule.courant, digits=".3g")
    for surface in schedule.rough:
        speed = schedule.speed_of(surface) * entrainment_speed
        yield Row(f"speed of rough surface {surface}", speed, "m/s")
    for name, key in (
        ("roughness fills the Hertz zone from", "covered_from"),
        ("roughness at its place in the case at", "coincident"),
    ):
        if key in moments:
            yield Row(name, moments[key], "ms")


def run_rows(summary: Mapping[str, Any]) -> list[Row]:
    """Rows of the key figures of a transient run.

    Parameters
    ----------
    summary : mapping
        Summary of the run, as ``summary_of`` gives it.

    Returns
    -------
    list of Row
        Values in SI units, without numbers that are None and without the number of halvings if it is 0.
    """
    case = Case.from_dict(summary["inputs"])
    conditions = KINDS[case.contact.geometry].resolve(case)
    halvings = summary["motion"]["halvings"] or None
    shown = {**summary, "motion": {**summary["motion"], "halvings": halvings}}
    rows = [*condition_rows(case, conditions)]
    for heading, entries in _entries(summary):
        found = list(rows_of(LINE_KEYS, shown, entries, _BOUNDS))
        rows += [Row(heading), *found] if found else []
        if heading == "film":
            rows += _supply(summary, conditions.half_width)
        if heading == _LAST_OF_RUN:
            rows += _touching_rows(summary)
    return rows


def _supply(summary: Mapping[str, Any], half_width: float) -> Iterator[Row]:
    """Rows of the layer of oil of a run; none where the case gives no layer."""
    film = summary["film"]
    if "oil_layer" not in film:
        return
    yield Row("layer of oil before the contact", film["oil_layer"], "µm", ", on both surfaces together")
    places = [film[f"meniscus_{name}"] for name in ("before", "least", "largest")]
    if None in places:
        yield Row("meniscus, where oil fills the gap", "none: flooded")
        return
    before, least, largest = (f"{place / half_width:.3g}" for place in places)
    over_time = f", {least} to {largest} over time"
    yield Row("meniscus, where oil fills the gap", f"x/b = {before} before the motion{over_time}")


def _entries(summary: Mapping[str, Any]) -> Iterator[tuple[str, tuple[tuple[str, ...], ...]]]:
    """Headings of the table of a run, each with the entries of its rows as ``rows_of`` expects them."""
    steps, peaks = summary["motion"]["steps"], summary["field"]["local_maxima"]
    film_at, field_at = _time(summary, "film.minimum_time"), _time(summary, "field.max_strength_time")
    breakdown_at = _time(summary, "discharge.breakdown_time")
    if _touches(summary):
        film_at, field_at, breakdown_at = (
            f"{at}, in the boundary film" for at in (film_at, field_at, breakdown_at)
        )
    yield (
        "motion of the roughness",
        (("duration of the motion", "motion.duration", "ms", f", {steps} time steps"),),
    )
    yield (
        "film",
        (
            ("minimum film, moving roughness", "film.minimum_thickness", "µm", film_at),
            ("discretisation error in space and time", "film.discretisation_error", "%"),
            ("minimum film, stationary roughness", "stationary.minimum_thickness", "µm"),
            ("minimum film before the motion", "film.before", "µm"),
            ("maximum pressure, moving roughness", "film.max_pressure", "GPa"),
            ("maximum pressure, stationary roughness", "stationary.max_pressure", "GPa"),
        ),
    )
    yield (
        _LAST_OF_RUN,
        (
            ("maximum field, moving roughness", "field.max_strength", "V/µm", field_at),
            ("error of the maximum field", "field.max_strength_error", "%"),
            ("maximum field, stationary roughness", "stationary.max_strength", "V/µm"),
            ("maximum field before the motion", "field.before", "V/µm"),
            ("time above 90 % of the maximum field", "field.share_above_90", "%", " of the evaluated time"),
            ("local field maxima, median", "field.local_maxima_quantiles.1", "V/µm", f", {peaks} maxima"),
            ("local field maxima, 95 % quantile", "field.local_maxima_quantiles.2", "V/µm"),
            ("minimum breakdown voltage", "discharge.breakdown_voltage", "V", breakdown_at),
            ("margin (breakdown / applied voltage)", "discharge.margin", ""),
        ),
    )
    yield (
        "moving and stationary, same position",
        (
            ("time of the same position", "beside_stationary.time", "ms"),
            ("minimum film then, moving", "beside_stationary.minimum_thickness", "µm"),
            ("minimum film then, stationary", "beside_stationary.minimum_thickness_stationary", "µm"),
            ("maximum field then, moving", "beside_stationary.maximum_strength", "V/µm"),
            (
                "maximum field then, stationary",
                "beside_stationary.maximum_strength_stationary",
                "V/µm",
            ),
        ),
    )
    yield (
        "run",
        (
            ("halvings of time steps", "motion.halvings", ""),
            ("Newton steps per time step", "motion.newton_per_step", ""),
            ("computing time", "seconds", "s"),
        ),
    )


def _touches(summary: Mapping[str, Any]) -> bool:
    """Whether the surfaces touch at one time step; summaries of earlier versions say nothing of it."""
    return bool("asperities" in summary and summary["asperities"]["load_share_largest"] > 0.0)


def _touching_rows(summary: Mapping[str, Any]) -> Iterator[Row]:
    """Rows of the asperities that touch; none where the surfaces do not touch at any time."""
    if not _touches(summary):
        return
    found = summary["asperities"]
    share, coarser = found["load_share_mean"], found["load_share_mean_coarser"]
    on_half = ", not known on a coarser grid"
    if coarser is not None:
        on_half = f", {share_text(coarser, share)} % on half the nodes"
    name, largest_at = "load share of the asperities", _time(summary, "asperities.load_share_largest_time")
    yield Row("asperities that touch")
    yield Row(f"{name}, mean", share_text(share, coarser), "%", on_half)
    yield Row(f"{name}, largest", found["load_share_largest"], "%", largest_at, digits=".2g")
    of = ", of the Hertz zone"
    yield Row("real contact, mean", found["contact_area_share_mean"], "%", of, digits=".2g")
    yield Row("number of spots, mean", found["spots_mean"], digits=".3g")
    of = f" of {found['steps']} evaluated time steps"
    yield Row("time with at least one spot", found["time_share"], "%", of, digits=".3g")


def _time(summary: Mapping[str, Any], key: str) -> str:
    """Note with a time of a summary; empty where the summary has none."""
    time = value_at(summary, key)
    return "" if time is None else f" at {1e3 * time:.4g} ms"
