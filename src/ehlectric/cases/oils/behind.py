"""Keys of the table ``lubricant`` behind each property of an oil, and the law that makes them a property."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ehlectric.cases import library
from ehlectric.cases.library.sources import Source
from ehlectric.cases.oils.estimates import ALPHA, of_base_oil
from ehlectric.cases.oils.laws import LAWS
from ehlectric.cases.oils.properties import Properties
from ehlectric.cases.oils.temperature import SHEET_VISCOSITY
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.estimates import BASE_OILS
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS

# Publication of the relation between coefficient, exponent and viscosity.
ROELANDS = (
    "C. J. A. Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of "
    "lubricating oils, thesis, Delft, 1966, as later works quote it"
)

# Keys of the data sheet that give the density.
_SHEET_DENSITY = ("density_15", "expansion")


def is_estimated(table: Properties, key: str) -> bool:
    """Whether a key is the pressure-viscosity coefficient, and is estimated from the type of base oil."""
    return key == ALPHA and ALPHA in of_base_oil(table)


def estimate_of(table: Properties) -> Source:
    """Source of the estimated pressure-viscosity coefficient of an oil with a type of base oil."""
    assert table.temperature is not None and table.temperature.base_oil is not None
    kind = BASE_OILS[table.temperature.base_oil]
    note = f"For base oils of type {table.temperature.base_oil}; scatter {100.0 * kind.scatter:.0f} %."
    return Source((ALPHA,), "estimated", kind.source, note=note)


def relation_of(table: Properties) -> Source | None:
    """Source of the relation that gives the coefficient at a temperature; None if nothing follows from it.

    Roelands' relation gives the pressure-viscosity coefficient where neither the table nor the type of base
    oil does, and changes a coefficient that is given for a reference temperature. It is a source where the
    oil of a base is changed: an oil of the user's own has it with the parameters of its law.
    """
    if table.base is None:
        return None
    parameter = next((p for p in VISCOSITY_LAWS[table.viscosity_law].parameters if p.name == ALPHA), None)
    if parameter is None or parameter.derivation is None or is_estimated(table, ALPHA):
        return None
    of = ", ".join(parameter.derivation.parameters)
    if table.parameter(ALPHA) is None:
        note = f"The coefficient follows from {of} and the viscosity at the temperature."
        return Source((ALPHA,), "by rule", ROELANDS, note=f"{note}{_in_place_of(table)}")
    if table.atmospheric_law is None or table.viscosity is None:
        return None
    note = "The coefficient, given at reference_temperature, changes with ln(viscosity) + 9.67."
    return Source((ALPHA,), "by rule", ROELANDS, note=note)


def _in_place_of(table: Properties) -> str:
    """Text with the coefficient of the base, where another viscosity takes its place."""
    own = None if table.base is None else library.lubricant(table.base).get(ALPHA)
    return "" if own is None else f" It replaces {own} of {table.base!r}, which belongs to another viscosity."


def law_behind(name: str, table: Properties, pressure: float) -> str:
    """Name of the law of a property at pressure, or of that over temperature at ambient pressure.

    Parameters
    ----------
    name : str
        Name of the property.
    table : Properties
        Table of the oil.
    pressure : float
        Pressure [Pa]; zero for ambient pressure.

    Returns
    -------
    str
        Name of the law, "table" for a measured table, or empty for a given number.
    """
    match name:
        case "viscosity" | "kinematic_viscosity" if pressure == 0.0:
            return _viscosity_law(table)
        case "viscosity" | "pressure_viscosity_coefficient" | "alpha_star":
            return table.viscosity_law
        case "density" if pressure == 0.0:
            return _density_law(table)
        case "density" | "density_ratio":
            return table.density_law
        case "relative_permittivity" if pressure == 0.0:
            if table.permittivity_table is not None:
                return "table"
            return table.permittivity_law if _of_reference(table) else ""
        case "relative_permittivity":
            return table.permittivity_law
        case "conductivity" if table.conductivity_table is not None:
            return "table"
    return table.law(f"{name}_law") or "constant"


def _viscosity_law(table: Properties) -> str:
    """Name of the law of the viscosity over temperature; empty for a given viscosity."""
    if VISCOSITY_LAWS[table.viscosity_law].atmospheric is not None:
        return table.viscosity_law
    return table.atmospheric_law or ("ASTM D341" if table.over_temperature else "")


def of_law(table: Properties, choice: str) -> Iterator[str]:
    """Keys of a law: its name, and those of its parameters that the table gives."""
    name = table.law(choice)
    if name is None:
        return
    if getattr(table, choice) is not None:
        yield choice
    for parameter in LAWS[choice][name].parameters:
        if table.parameter(parameter.name) is not None:
            yield parameter.name


def _of_sheet(table: Properties, keys: Iterable[str]) -> Iterator[str]:
    """Dotted keys of those values that the data sheet has."""
    yield from (f"temperature.{key}" for key in keys if getattr(table.temperature, key, None) is not None)


def _of_reference(table: Properties) -> tuple[str, ...]:
    """Keys of the density over that at the reference temperature; empty where it is not known."""
    if table.reference_temperature is None:
        return ()
    by_law = DENSITY_LAWS[table.density_law].thermal_expansion
    name = by_law or "thermal_expansion"
    return (name, "reference_temperature") if table.parameter(name) is not None else ()


def _density_law(table: Properties) -> str:
    """Name of the law of the density over temperature; empty for a given density."""
    if table.temperature is not None:
        return "linear"
    if not _of_reference(table):
        return ""
    return "linear" if DENSITY_LAWS[table.density_law].thermal_expansion is None else table.density_law


def viscosity_keys(table: Properties, pressure: float) -> Iterator[str]:
    """Keys of the viscosity."""
    own = VISCOSITY_LAWS[table.viscosity_law].atmospheric is not None
    if own:
        yield from of_law(table, "viscosity_law")
    elif table.atmospheric_law is not None:
        yield from of_law(table, "atmospheric_law")
    elif table.temperature is not None:
        yield from _of_sheet(table, (*SHEET_VISCOSITY, *_SHEET_DENSITY))
    else:
        yield "viscosity"
    if pressure > 0.0 and not own:
        yield from alpha_keys(table, pressure)


def alpha_keys(table: Properties, _: float) -> Iterator[str]:
    """Keys of the pressure-viscosity coefficients."""
    yield from of_law(table, "viscosity_law")
    if is_estimated(table, ALPHA):
        yield from ("temperature.base_oil", ALPHA)
    elif table.parameter(ALPHA) is None and relation_of(table) is not None:
        yield ALPHA


def density_keys(table: Properties, pressure: float) -> Iterator[str]:
    """Keys of the density."""
    if table.temperature is not None:
        yield from _of_sheet(table, _SHEET_DENSITY)
    else:
        yield from ("density", *_of_reference(table))
    if pressure > 0.0:
        yield from of_law(table, "density_law")


def kinematic_keys(table: Properties, pressure: float) -> Iterator[str]:
    """Keys of the kinematic viscosity."""
    yield from dict.fromkeys([*viscosity_keys(table, pressure), *density_keys(table, pressure)])


def permittivity_keys(table: Properties, pressure: float) -> Iterator[str]:
    """Keys of the relative permittivity."""
    if table.permittivity_table is not None:
        yield "permittivity_table"
    else:
        reference = _of_reference(table)
        yield from ("relative_permittivity", *reference)
        if reference and pressure == 0.0:
            yield "permittivity_law"
    if pressure > 0.0:
        yield "permittivity_law"
        yield from of_law(table, "density_law")


def conductivity_keys(table: Properties, _: float) -> Iterator[str]:
    """Keys of the electrical conductivity."""
    if table.conductivity_table is not None:
        yield "conductivity_table"
    else:
        yield from of_law(table, "conductivity_law")


def thermal_keys(table: Properties, _: float) -> Iterator[str]:
    """Keys of the thermal conductivity."""
    if table.law("thermal_conductivity_law") is not None:
        yield from of_law(table, "thermal_conductivity_law")
    else:
        yield from _of_sheet(table, ("thermal_conductivity",))
