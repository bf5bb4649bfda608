"""Library of bearings, oils, coatings and solids as the forms list it, read without the physics."""

from __future__ import annotations

from contextlib import suppress
from functools import cache
from typing import Any

from ehlectric.app.view_models import Choice
from ehlectric.cases import library
from ehlectric.errors import InputError
from ehlectric.quantities.quantity import data_file

# Headings in the lists, by kind of bearing or of oil, and by coated ring.
_HEADINGS: dict[str, str] = data_file("ehlectric.quantities", "form_fields.toml")["headings"]


@cache
def bearing(name: str) -> dict[str, Any]:
    """Return the table of a library bearing or of a maker's designation; empty for another name."""
    return library.bearing(name) if name in library.bearing_names() else _read(name)[1]


def designated(text: str) -> dict[str, str]:
    """Return the bearing name for a maker's designation, the designation, and its clearance class, by key of
    ``bearing``; the text itself without such a bearing.

    Examples
    --------
    >>> designated("6314-C3"), designated("6x14")
    ({'base': '6314', 'designation': '6314-C3', 'clearance_class': 'C3'}, {'base': '6x14'})
    """
    if text in library.bearing_names():
        return {"base": text}
    return _read(text)[0]


def contradicts(designation: str, clearance_class: str) -> bool:
    """Whether the class of clearance in a designation is another class; false for an unknown designation.

    Examples
    --------
    >>> contradicts("6314-C3", "C4"), contradicts("6314-C3", "C3"), contradicts("6x14-C3", "C4")
    (True, False, False)
    """
    from ehlectric.cases.bearing_inputs import is_of_another_class  # loads NumPy

    with suppress(InputError):
        return is_of_another_class(designation, clearance_class)
    return False


@cache
def _read(text: str) -> tuple[dict[str, str], dict[str, Any]]:
    """Name and class of the bearing with a designation, and its table; empty where there is none."""
    # The server loads no physics before somebody asks for a bearing that the library lacks.
    from ehlectric.cases.bearing_inputs import base_of

    try:
        named, table = base_of({"base": text})
    except InputError:
        return {"base": text}, {}
    return {key: str(value) for key, value in named.items()}, table


@cache
def oil(name: str) -> dict[str, Any]:
    """Table of an oil of the library; empty for another name."""
    return library.lubricant(name) if name in library.lubricant_names() else {}


def oil_title(name: str) -> str:
    """Title of an oil of the library."""
    return str(library.tables("lubricant", name)["title"])


@cache
def coating(name: str) -> dict[str, Any]:
    """Table of a coated ring of the library; empty for another name."""
    return library.coating(name) if name in library.coating_names() else {}


@cache
def oil_needs(name: str) -> tuple[str, ...]:
    """Keys that a case must give with an oil of the library."""
    known = name in library.lubricant_names()
    return tuple(library.tables("lubricant", name).get("needs", ())) if known else ()


@cache
def choices() -> dict[str, tuple[Choice, ...]]:
    """Choices by key: ``bearing.base``, ``lubricant.base``, ``bearing.coating.base`` and materials."""
    solids = {
        ("bearing.element_material", "bearing.ring_material"): library.solid_names(rolling=True),
        ("contact.body_1.material", "contact.body_2.material"): library.solid_names(thermal=True),
        ("bearing.fits.shaft_material", "bearing.fits.housing_material"): library.solid_names(),
        ("gear.material",): library.solid_names(conducting=True),
    }
    return {
        "bearing.base": tuple(map(_bearing, library.bearing_names())),
        "lubricant.base": tuple(map(_oil, library.lubricant_names())),
        "bearing.coating.base": tuple(map(_coating, library.coating_names())),
        **{
            key: tuple(Choice(name, name) for name in names) for keys, names in solids.items() for key in keys
        },
    }


def _bearing(name: str) -> Choice:
    table = bearing(name)
    size = " x ".join(table[key].removesuffix(" mm") for key in ("bore", "outer_diameter", "width"))
    elements = "rollers" if "roller_length" in table else "balls"
    label = f"{name.upper()}: {size} mm, {table['elements']} {elements}"
    return Choice(name, label, _HEADINGS[table["kind"]])


def _oil(name: str) -> Choice:
    file = library.tables("lubricant", name)
    kind = file["lubricant"].get("temperature", {}).get("base_oil", "")
    title = oil_title(name)
    group = _HEADINGS.get(kind) or _named(title)
    return Choice(name, title if title.lower().startswith(name.split("-")[0]) else f"{name}: {title}", group)


def _named(title: str) -> str:
    """Group of an oil by the words of its title."""
    words = title.lower()
    if "polyalphaolefin" in words or "fluid" in words:
        return "Synthetic oils"
    return "Mineral oils" if "mineral" in words else "Other liquids"


def _coating(name: str) -> Choice:
    table = coating(name)
    given = [f"{table[key]} {word}" for key, word in _COATING_WORDS.items() if key in table]
    return Choice(name, f"{name}: {', '.join(given)}", _HEADINGS[table["ring"]])


_COATING_WORDS = {"thickness": "thick", "breakdown_voltage": "breakdown"}
