"""Oil by its name in the library, by a file with a table ``lubricant``, or by such a table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ehlectric.cases import library
from ehlectric.cases.amounts import Amount
from ehlectric.cases.library.oils import LibraryOil, library_oil, values_of
from ehlectric.cases.library.sources import Source
from ehlectric.cases.oils.laws import quantity_of
from ehlectric.cases.oils.lubricant import Lubricant
from ehlectric.cases.oils.over_temperature import TEMPERATURE
from ehlectric.cases.oils.properties import Properties
from ehlectric.cases.table import nearest, read_toml
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.conductivity import CONDUCTIVITY
from ehlectric.lubricant.oil import Oil

# Tables of a file that may give temperatures of its oil, with their keys.
_TEMPERATURES = {
    "contact": ("temperature",),
    "bearing": ("temperature", "inner_ring_temperature", "outer_ring_temperature"),
}

# Keys of an oil that say how it conducts.
_CONDUCTION = ("conductivity", "conductivity_law", "conductivity_table")


@dataclass(frozen=True)
class NamedOil:
    """Oil of the library or of a user, before a temperature is chosen.

    Attributes
    ----------
    name : str
        Name in the library, or of the file.
    title : str
        What the oil is, in one line; empty if nothing says it.
    given : mapping
        Table ``[lubricant]`` as it is written.
    table : Properties
        Parsed table, in which values may be missing.
    base : LibraryOil or None
        Oil of the library that the table names as its base; None without one.
    temperatures : tuple of float
        Temperatures of the contact, or of the bearing and its rings, in the file [K].

    Examples
    --------
    >>> oil = named_oil("n100")
    >>> oil.title, oil.needs
    ('N100, naphthenic mineral base oil without additives, ISO VG 100', ('relative_permittivity',))
    """

    name: str
    title: str
    given: Mapping[str, Any]
    table: Properties
    base: LibraryOil | None = None
    temperatures: tuple[float, ...] = ()

    @property
    def needs(self) -> tuple[str, ...]:
        """Keys of the base of which no source was found, and which the table does not give."""
        needs = () if self.base is None else self.base.needs
        return tuple(key for key in needs if self.given.get(key) is None)

    def source(self, key: str) -> Source | None:
        """Source of the value of a dotted key; None for a value that the table itself gives."""
        if key in values_of(self.given):
            return None
        known = {} if self.base is None else self.base.values()
        # A value of the data sheet of the base may stand beside another way to give the viscosity.
        for name in (key, f"temperature.{key}"):
            if self.base is not None and name in known:
                return self.base.source(name)
        table, _, name = key.rpartition(".")
        value = getattr(getattr(self.table, table) if table else self.table, name)
        return Source((key,), "assumed", "default of ehlectric", note=f"{key} = {value}, which is not given")


def named_oil(source: str | Path | Mapping[str, Any]) -> NamedOil:
    """Oil of the library by its name, or of a file or table of a user.

    Parameters
    ----------
    source : str, Path or mapping
        Name of the library; path of a case or bearing file, as a ``Path`` or as a string that ends in
        ``.toml``; or table ``[lubricant]`` of a case.

    Returns
    -------
    NamedOil
        Oil with its table, in which values may be missing.

    Raises
    ------
    InputError
        If there is no oil of this name, the file cannot be read or has no table ``lubricant``, or a value of
        the table is wrong.
    """
    if isinstance(source, Mapping):
        return _of_table("", "", source)
    if isinstance(source, Path) or source.endswith(".toml"):
        return _of_file(Path(source))
    names = library.lubricant_names()
    if source not in names:
        raise InputError(
            "oil",
            got=shown(source),
            takes=f"a .toml file, or a name of the library: {', '.join(names)}; nearest is "
            f"{nearest(source, names)!r}",
        )
    return _of_table(source, library_oil(source).title, {"base": source})


def _of_file(path: Path) -> NamedOil:
    """Oil of a file, at its temperatures and with the conductivity of its discharge."""
    tables = read_toml(path)
    table = tables.get("lubricant")
    if not isinstance(table, Mapping):
        raise InputError(path, "has no table [lubricant]", takes="a case, a bearing file or a file of an oil")
    kelvins = [
        _parsed(TEMPERATURE, tables, name, key) for name, keys in _TEMPERATURES.items() for key in keys
    ]
    conductivity = _parsed(quantity_of(CONDUCTIVITY), tables, "discharge", "conductivity")
    if conductivity is not None:
        # It holds in place of that of the oil, as in a solution.
        others = {key: value for key, value in table.items() if key not in _CONDUCTION}
        table = others | {"conductivity": conductivity}
    title = tables.get("title")
    return _of_table(
        path.name,
        title if isinstance(title, str) else "",
        table,
        tuple(sorted({kelvin for kelvin in kelvins if kelvin is not None})),
    )


def _parsed(quantity: Amount, tables: Mapping[str, Any], name: str, key: str) -> float | None:
    """Value of a key of a table of a file in SI units; None if the file does not give it."""
    table = tables.get(name)
    value = table.get(key) if isinstance(table, Mapping) else None
    if value is None:
        return None
    try:
        return quantity.parse(value, written=True)
    except InputError as error:
        raise error.retold(f"{name}.{key}", error.text) from None


def _of_table(
    name: str, title: str, given: Mapping[str, Any], temperatures: tuple[float, ...] = ()
) -> NamedOil:
    """Oil of a table; a table that contradicts itself is refused, and one that lacks values is not."""
    try:
        try:
            table: Properties = Lubricant.from_written(given)
        except InputError as error:
            if not error.is_missing:
                raise
            table = Properties.from_written(given)
    except InputError as error:
        raise error.under("lubricant") from None
    base = None if table.base is None else library_oil(table.base)
    return NamedOil(name, title, given, table, base, temperatures)


def oil(source: str | Path | Mapping[str, Any], temperature: str | float | None = None) -> Oil:
    """Oil at a temperature: its numbers, and its laws as functions of pressure.

    Parameters
    ----------
    source : str, Path or mapping
        Name of an oil of the library; path of a case or bearing file, as a ``Path`` or as a string that ends
        in ``.toml``; or table ``[lubricant]`` of a case, as a dictionary.
    temperature : str or float, optional
        Temperature with its unit, or in kelvin; by default that of the contact or the bearing in the file,
        if it has one alone. An oil whose viscosity does not depend on temperature needs none.

    Returns
    -------
    ehlectric.lubricant.oil.Oil
        Viscosity, coefficients, density and permittivity at zero pressure, and laws over pressure.

    Raises
    ------
    InputError
        If there is no oil of this name, a value of the oil is missing, or the temperature is missing or
        outside the range of the oil.

    Examples
    --------
    >>> fva = oil("fva-3", "90 degC")
    >>> round(fva.viscosity * 1e3, 2), round(fva.alpha_star * 1e9, 1)
    (12.85, 15.7)
    >>> permittivity = fva.permittivity(1e9, fva.density_ratio(1e9)[0])
    >>> round(float(permittivity), 3)
    2.331
    """
    found = named_oil(source)
    own = found.temperatures[0] if len(found.temperatures) == 1 else None
    kelvin = own if temperature is None else kelvin_of(temperature)
    try:
        lubricant = Lubricant.from_dict(found.given)
    except InputError as error:
        raise error.under("lubricant") from None
    return lubricant.at(kelvin, "temperature")


def kelvin_of(temperature: str | float, key: str = "temperature") -> float:
    """Temperature [K] from a string with its unit, or a number in kelvin.

    Raises
    ------
    InputError
        If it is no temperature of an oil.

    Examples
    --------
    >>> kelvin_of("40 degC")
    313.15
    """
    try:
        return TEMPERATURE.parse(temperature, written=isinstance(temperature, str))
    except InputError as error:
        raise error.retold(key, error.text) from None
