"""Tables of the oils of the library and of types of base oil, written from the files and the code."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from ehlectric.cases.library.library_oils import LibraryOil, library_oils
from ehlectric.lubricant.data_sheet import BASE_OILS, Gold

_DASH = "\N{EN DASH}"


def oil_pages() -> dict[str, str]:
    """Text of each table by the name of its file: list of oils, values with sources, types of base oil."""
    oils = library_oils()
    listed = [
        [f'`"{oil.name}"`', oil.title, ", ".join(f"`{key}`" for key in oil.needs) or _DASH] for oil in oils
    ]
    return {
        "oils": _table(["name", "oil", "what the case must give"], listed),
        "oil_values": "\n".join(map(_values, oils)),
        "base_oils": _table(["base_oil", "correlation", "scatter", "source"], map(_base_oil, BASE_OILS)),
    }


def _values(oil: LibraryOil) -> str:
    """Heading of an oil, and its values in the groups of their sources."""
    values = oil.values()
    rows = []
    for source in oil.sources:
        held = ", ".join(f"`{key}` {_value(values[key])}" for key in source.keys)
        doi = f", [doi:{source.doi}](https://doi.org/{source.doi})" if source.doi else ""
        rows.append([held, source.kind, f"{_typeset(source.citation)}{doi}", _typeset(source.note) or _DASH])
    head = f"### {oil.name}\n\n{oil.title}.\n\n"
    return head + _table(["values", "kind", "source", "remark"], rows)


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "; ".join(f"{key}: {_value(item)}" for key, item in value.items())
    if isinstance(value, list):
        return ", ".join(map(_value, value))
    return _typeset(str(value))


def _typeset(text: str) -> str:
    """Text of a file in ASCII with the signs of print: superscripts, degrees, and minus before a number."""
    signs = {"^2": "\N{SUPERSCRIPT TWO}", "^3": "\N{SUPERSCRIPT THREE}", "degC": "\N{DEGREE SIGN}C"}
    for written, sign in signs.items():
        text = text.replace(written, sign)
    return re.sub(r"(?:(?<=\s)|^)-(?=\d)", "\N{MINUS SIGN}", text)


def _base_oil(name: str) -> list[str]:
    kind = BASE_OILS[name]
    form = "So and Klaus"
    if isinstance(kind.correlation, Gold):
        form = rf"$\alpha = {kind.correlation.s}\,\nu^{{{kind.correlation.t}}}$"
    return [f'`"{name}"`', form, f"{100.0 * kind.scatter:.0f} %", kind.source]


def _table(head: list[str], rows: Iterable[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "".join("| " + " | ".join(cell.replace("|", r"\|") for cell in line) + " |\n" for line in lines)
