"""Rows for tables of transient contacts: the schedule before a run, and the run."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

from ehlectric.cases.case import Case
from ehlectric.contact import KINDS, share_text
from ehlectric.quantities.result_bounds import moving_bounds
from ehlectric.quantities.results import MOTION_BOOK
from ehlectric.quantities.rows import Row, RowTexts, Summary, ValueWithNote, sheet_rows, value_at
from ehlectric.quantities.sheets import MOTION, MOTION_CHECK
from ehlectric.readable import readable
from ehlectric.tables.contact_tables import condition_rows


def schedule_rows(summary: Summary) -> Iterator[Row]:
    """Rows of the time steps and speeds of rough surfaces, from the summary of a case before its run."""
    book = MOTION_BOOK[summary["inputs"]["contact"]["geometry"]]
    return sheet_rows(MOTION_CHECK, book, summary, _WORDS)


def run_rows(summary: Summary) -> list[Row]:
    """Rows of the key figures of a transient run, below the operating conditions of its case."""
    case = Case.from_dict(summary["inputs"])
    conditions = KINDS[case.contact.geometry].resolve(case)
    book = MOTION_BOOK[case.contact.geometry]
    meniscus = partial(_meniscus, conditions.half_width)
    words = _WORDS | RowTexts(values={"film.meniscus_before": meniscus})
    rows = sheet_rows(MOTION, book, summary, words, moving_bounds(book))
    return [*condition_rows(case, conditions), *rows]


def _meniscus(half_width: float, summary: Summary) -> str | None:
    """Region where oil fills the gap before the motion and over time; None without a layer of oil."""
    film = summary["film"]
    if "oil_layer" not in film:
        return None
    places = [film[f"meniscus_{name}"] for name in ("before", "least", "largest")]
    if None in places:
        return "none: flooded"
    before, least, largest = (readable(place / half_width) for place in places)
    return f"x/b = {before} before the motion, {least} to {largest} over time"


def _touches(summary: Summary) -> bool:
    """Whether the surfaces touch at one time step."""
    return (value_at(summary, "asperities.load_share_largest") or 0.0) > 0.0


def _time(key: str, *, boundary: bool = False) -> Callable[[Summary], str]:
    """Note with a time of a summary, and that a value in a spot belongs to the boundary film."""

    def note(summary: Summary) -> str:
        time = value_at(summary, key)
        at = "" if time is None else f" at {readable(1e3 * time, 4)} ms"
        return f"{at}, in the boundary film" if boundary and _touches(summary) else at

    return note


def _speed(surface: int) -> Callable[[Summary], float | None]:
    """Speed of a surface [m/s]; None of a smooth one."""

    def value(summary: Summary) -> float | None:
        inputs = summary["inputs"]
        if surface not in (table["surface"] for table in inputs["roughness"]):
            return None
        ratio = summary["motion"][f"speed_ratio_{surface}"]
        return float(ratio * inputs["contact"]["entrainment_speed"])

    return value


def _load_share(summary: Summary) -> ValueWithNote:
    """Mean load share with no more digits than its change from a coarser grid leaves."""
    asperities = summary["asperities"]
    share, coarser = asperities["load_share_mean"], asperities["load_share_mean_coarser"]
    note = ", not known on a coarser grid"
    if coarser is not None:
        note = f", {share_text(coarser, share)} % on half the nodes"
    return ValueWithNote((share_text(share, coarser), "%"), note)


_WORDS = RowTexts(
    notes={
        "motion.duration": lambda s: f", {s['motion']['steps']} time steps",
        "film.minimum_thickness": _time("film.minimum_time", boundary=True),
        "field.max_strength": _time("field.max_strength_time", boundary=True),
        "field.local_maxima_quantiles.1": lambda s: f", {s['field']['local_maxima']} maxima",
        "discharge.breakdown_voltage": _time("discharge.breakdown_time", boundary=True),
        "asperities.load_share_largest": _time("asperities.load_share_largest_time"),
        "asperities.time_share": lambda s: f" of {s['asperities']['steps']} evaluated time steps",
    },
    values={
        "motion.speed_1": _speed(1),
        "motion.speed_2": _speed(2),
        "motion.halvings": lambda s: s["motion"]["halvings"] or None,
        "asperities.load_share_mean": _load_share,
    },
    holds={"touching": _touches},
)
