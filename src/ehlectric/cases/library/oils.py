"""Oils of the library with the source of every value."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ehlectric.cases import library
from ehlectric.cases.library.sources import Kind, Source, sources_of, weakest

# Tables of [lubricant] whose keys have sources of their own, as dotted keys.
_NESTED = ("temperature",)


@dataclass(frozen=True)
class LibraryOil:
    """Oil of the library.

    Attributes
    ----------
    name : str
        Name of the oil, the value of ``lubricant.base``.
    title : str
        What the oil is, in one line.
    table : mapping
        Table ``[lubricant]`` in the form of a case file.
    sources : tuple of Source
        Sources of the values: each key has one.
    needs : tuple of str
        Keys of ``[lubricant]`` that a case must give, because no source of them was found.

    Examples
    --------
    >>> oil = library_oil("paper")
    >>> oil.source("roelands_z").kind, oil.needs
    ('assumed', ())
    """

    name: str
    title: str
    table: Mapping[str, Any]
    sources: tuple[Source, ...]
    needs: tuple[str, ...] = ()

    def values(self) -> dict[str, Any]:
        """Values of the oil as the file has them, by dotted key."""
        return values_of(self.table)

    @property
    def weakest(self) -> Kind | None:
        """Kind of the weakest source of all values."""
        return weakest(self.sources, self.values())

    def source(self, key: str) -> Source:
        """Source of the value of a dotted key.

        Raises
        ------
        KeyError
            If the oil has no value of this key.
        """
        for source in self.sources:
            if key in source.keys:
                return source
        raise KeyError(key)


def values_of(table: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a table ``[lubricant]`` by dotted key, as sources name them.

    Examples
    --------
    >>> values_of({"base": "paper", "temperature": {"iso_vg": 46}})
    {'base': 'paper', 'temperature.iso_vg': 46}
    """
    return dict(_values(table))


def _values(table: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    for key, value in table.items():
        if key in _NESTED and isinstance(value, Mapping):
            yield from ((f"{key}.{inner}", item) for inner, item in value.items())
        else:
            yield key, value


def library_oil(name: str) -> LibraryOil:
    """Oil of the library with its sources.

    Parameters
    ----------
    name : str
        Name of the oil, one of ``library.lubricant_names()``.

    Returns
    -------
    LibraryOil
        Title, values and sources of the oil.

    Examples
    --------
    >>> library_oil("paper").title
    'Lubricant of the paper, similar to a mineral oil'
    """
    file = library.tables("lubricant", name)
    return LibraryOil(name, file["title"], file["lubricant"], sources_of(file), tuple(file.get("needs", ())))


def library_oils() -> list[LibraryOil]:
    """All oils of the library, by name."""
    return [library_oil(name) for name in library.lubricant_names()]
