"""Sheets of all kinds of results, from ``sheets.toml``: the quantities that each shows, by section.

The terminal, the notebook and the report show whole sheets; a page shows the same rows, and its cards large.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ehlectric.quantities.alternatives import with_groups
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.rows import Section, Sheet

_READ = data_file("ehlectric.quantities", "sheets.toml")
_SECTIONS = {
    name: Section(section["heading"], with_groups(section["keys"]), section.get("only", ""))
    for name, section in _READ["sections"].items()
}


def _sheet(name: str) -> Sheet:
    return tuple(_SECTIONS[section] for section in _READ["sheets"][name])


def _cards(name: str) -> Mapping[str, tuple[str, ...]]:
    """Keys that a page shows large, each with those that stand small below it."""
    return {key: tuple(further) for key, further in _READ["cards"][name].items()}


# Sheets of results, and of cases before they are solved; a drive next to its remedies.
CONTACT, CHECK = _sheet("contact"), _sheet("contact_check")
MOTION, MOTION_CHECK = _sheet("motion"), _sheet("motion_check")
BEARING, BEARING_CHECK = _sheet("bearing"), _sheet("bearing_check")
DRIVE, DRIVE_CHECK, REMEDIES = _sheet("drive"), _sheet("drive_check"), _sheet("remedies")
GEAR = _sheet("gear")

# Keys that are shown only where a condition holds, by its name.
CONTACT_ONLY, BEARING_ONLY = (_READ["only"][name] for name in ("contact", "bearing"))

# Cards of the pages. A spot may be in the middle of a contact whose surfaces touch, so that its mean film
# says more than the central one.
CONTACT_CARDS, CHECK_CARDS = _cards("contact"), _cards("contact_check")
TOUCHING_CARDS, SPOT_CARDS = _cards("touching_contact"), _cards("spots")
BEARING_CARDS, DRIVE_CARDS, GEAR_CARDS = _cards("bearing"), _cards("drive"), _cards("gear")

# Formula by geometry of the film of the estimated breakdown voltage, which pages show and compare with
# heights of roughness: the formulas that give the films of a bearing without solution.
BREAKDOWN_FORMULAS = {"line": "pan_hamrock", "point": "chittenden"}

# Large numbers of the first page of a report, each with those that stand small below it.
FIRST_PAGE_OF_BEARING, FIRST_PAGE_OF_DRIVE = _cards("first_page_of_bearing"), _cards("first_page_of_drive")
FIRST_PAGE_OF_GEAR = _cards("first_page_of_gear")

# Numbers of the rating life on this page.
FIRST_PAGE_OF_LIFE: Mapping[str, tuple[str, ...]] = {
    place: tuple(keys) for place, keys in _READ["first_page_of_life"].items()
}

# Columns of the tables of all contacts of a bearing: of its loads, of its films, and on its page.
LOAD_COLUMNS, FILM_COLUMNS, PAGE_COLUMNS = (
    tuple[str, ...](_READ["columns"][name]) for name in ("loads", "films", "page")
)

# Main results of two cases next to each other, what a remedy changes of a bearing, and how far its solved
# contacts differ from quick ones.
COMPARED, REMEDIED, DIFFERENCES = (
    tuple[str, ...](_READ["main"][name]) for name in ("compared", "remedies", "differences")
)

# Columns of rough surfaces, of oils and of sweeps, voltages that belong together, and values in words.
SURFACES, OILS, SWEEP_COLUMNS, BREAKDOWNS, VALUES = (
    _READ[name] for name in ("surfaces", "oils", "sweep_columns", "breakdowns", "values")
)

# Inputs and results of sweeps, on a page and in a report.
SWEEPS: Mapping[str, tuple[str, ...]] = {name: with_groups(keys) for name, keys in _READ["sweeps"].items()}


def at_ends(keys: Iterable[str], ends: Iterable[str] = ENDS) -> Iterator[str]:
    """Keys in which "end" stands for each of some ends of a drive.

    Examples
    --------
    >>> list(at_ends(["drive.power", "end.power"]))
    ['drive.power', 'drive_end.power', 'non_drive_end.power']
    """
    for key in keys:
        table, _, name = key.partition(".")
        yield from (f"{end}.{name}" for end in ends) if table == "end" else (key,)


# What two cases next to each other show among their inputs, or what is no result of either.
NOT_COMPARED = frozenset((*CHECK[0].keys, *BEARING[0].keys, *CHECK[-1].keys, "formula_error"))
