"""Values of a lubricant of the library under those of a case, without the library's alternatives to them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.cases.oils.laws import base_values, law_parameters
from ehlectric.cases.oils.temperature import SHEET_VISCOSITY
from ehlectric.lubricant.atmospheric import ATMOSPHERIC_LAWS

# Keys of a base that are left out where the case gives one of the keys before them.
_REPLACED: tuple[tuple[tuple[str, ...], tuple[str, ...]], ...] = (
    (("relative_permittivity", "permittivity_table"), ("relative_permittivity", "permittivity_table")),
    (("conductivity", "conductivity_table"), ("conductivity", "conductivity_law", "conductivity_table")),
)


def with_base(table: Any) -> Any:
    """Add to a table the values of the lubricant that ``base`` names in the library.

    Values of the table replace those of the library. Where the table says in another way how viscous the oil
    is, the library's way is left out: a viscosity, a law over temperature, or a data sheet. With a data sheet
    or a law over temperature that has no viscosity as its parameter, the parameters that follow from the
    viscosity are left out, too. The density of a data sheet takes the place of the library's.

    Values of the library's data sheet stay unless the table replaces them: those whose keys a data sheet of
    the table does not give, and the thermal conductivity beside every way to give the viscosity.

    Raises
    ------
    InputError
        If the library has no lubricant of this name.
    """
    base = base_values(table)
    if not base or not isinstance(table, Mapping):
        return table
    left_out = _replaced(table) | _other_viscosity(table)
    kept = {key: value for key, value in base.items() if key not in left_out}
    sheet, own = base.get("temperature"), table.get("temperature")
    if isinstance(sheet, Mapping) and isinstance(own, Mapping):
        return kept | {**table, "temperature": _with_sheet(sheet, own)}
    if isinstance(sheet, Mapping) and "temperature" in left_out and "thermal_conductivity" in sheet:
        kept["thermal_conductivity"] = sheet["thermal_conductivity"]
    return kept | dict(table)


def _with_sheet(sheet: Mapping[str, Any], own: Mapping[Any, Any]) -> dict[Any, Any]:
    """Data sheet of a table, with those values of the library's sheet that it does not replace."""
    given = {key for key, value in own.items() if value is not None}
    # The viscosities of two oils are not mixed.
    left_out = given.union(SHEET_VISCOSITY) if given.intersection(SHEET_VISCOSITY) else given
    return {key: value for key, value in sheet.items() if key not in left_out} | dict(own)


def displace_oil(table: dict[str, Any], changes: Mapping[str, Any]) -> None:
    """Remove from the table of an oil the keys that changed keys replace, as ``with_base`` leaves them out.

    Parameters
    ----------
    table : dict
        Table ``lubricant`` of a case, changed in place.
    changes : mapping
        New values of this table; those of a data sheet as a table under ``temperature``.

    Examples
    --------
    >>> table = {"atmospheric_law": "vogel", "viscosity_law": "modulus"}
    >>> displace_oil(table, {"viscosity": 0.05})
    >>> table
    {'viscosity_law': 'modulus'}
    """
    displaced = _replaced(changes)
    if changes.get("conductivity_table") is None:
        # A conductivity is a parameter of its law.
        displaced -= {"conductivity_law"}
    ways = [key for key in ("temperature", "atmospheric_law") if changes.get(key) is not None]
    # A change within the same way, such as a grade of the same data sheet, replaces nothing.
    if not any(table.get(key) is not None for key in ways):
        displaced |= _other_viscosity(changes)
    if not ways and _has_viscosity(table.get("atmospheric_law")):
        displaced -= {"atmospheric_law"}
    for key in displaced - changes.keys():
        table.pop(key, None)


def _replaced(table: Mapping[Any, Any]) -> set[str]:
    """Keys that alternatives in a table take the place of, permittivity and conductivity."""
    pairs = [keys for given, keys in _REPLACED if any(table.get(key) is not None for key in given)]
    return {key for keys in pairs for key in keys}


def _other_viscosity(table: Mapping[Any, Any]) -> set[str]:
    """Keys of a base that give the viscosity in another way than the table does."""
    sheet = table.get("temperature")
    derived = {name for name, parameter in law_parameters().items() if parameter.derivation}
    if sheet is not None:
        if isinstance(sheet, Mapping) and sheet.get("base_oil") is not None:
            # The type of base oil gives the coefficient in place of the exponent of another oil.
            derived.add("roelands_z")
        return {"viscosity", "atmospheric_law", "density", *derived}
    name = table.get("atmospheric_law")
    if name is not None:
        # The coefficient of a base belongs to its viscosity, which such a law has at a reference temperature.
        return {"temperature"} if _has_viscosity(name) else {"viscosity", "temperature", *derived}
    if table.get("viscosity") is not None:
        return {"atmospheric_law", "temperature"}
    return set()


def _has_viscosity(name: Any) -> bool:
    """Whether a law over temperature has the viscosity at a reference temperature as a parameter."""
    law = ATMOSPHERIC_LAWS.get(name) if isinstance(name, str) else None
    return law is not None and any(parameter.name == "viscosity" for parameter in law.parameters)
