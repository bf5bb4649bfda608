"""Values of a lubricant of the library under those of a case, without the library's alternatives to them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.cases.oils.laws import base_values, law_parameters
from ehlectric.lubricant.atmospheric import ATMOSPHERIC_LAWS

# Keys of a base that are left out where the case gives one of the keys before them.
_REPLACED: tuple[tuple[tuple[str, ...], tuple[str, ...]], ...] = (
    (("relative_permittivity", "permittivity_table"), ("relative_permittivity", "permittivity_table")),
    (("conductivity", "conductivity_table"), ("conductivity", "conductivity_law", "conductivity_table")),
)


def with_base(table: Any) -> Any:
    """Add to a table the values of the lubricant that ``base`` names in the library.

    Values of the table replace those of the library. Where the table says in another way how viscous the oil
    is, the library's way is left out: a viscosity, a law over temperature, or a data sheet. With a law over
    temperature or a data sheet, the parameters that follow from the viscosity are left out, too. The density
    of a data sheet takes the place of the library's.

    Raises
    ------
    InputError
        If the library has no lubricant of this name.
    """
    base = base_values(table)
    if not base or not isinstance(table, Mapping):
        return table
    left_out = _replaced(table) | _other_viscosity(table)
    return {key: value for key, value in base.items() if key not in left_out} | dict(table)


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
    law = ATMOSPHERIC_LAWS.get(table.get("atmospheric_law", ""))
    if law is not None and not ways and any(parameter.name == "viscosity" for parameter in law.parameters):
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
    if table.get("atmospheric_law") is not None:
        return {"viscosity", "temperature", *derived}
    if table.get("viscosity") is not None:
        return {"atmospheric_law", "temperature"}
    return set()
