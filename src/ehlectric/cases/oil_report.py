"""Report on an oil: each of its properties with its value, its law, the sources behind it, what is
missing, warnings.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from ehlectric.cases import library
from ehlectric.cases.amounts import Amount
from ehlectric.cases.case_oil import KnownOil, NamedOil, kelvin_of, known_oil, named_oil
from ehlectric.cases.library.library_oils import KINDS, Source
from ehlectric.cases.oil_inputs import ALPHA, LAWS, SHEET_VISCOSITY, Properties, of_base_oil
from ehlectric.errors import InputError, within
from ehlectric.lubricant.data_sheet import BASE_OILS
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS
from ehlectric.quantities.formats import CELSIUS
from ehlectric.quantities.result_warnings import ResultWarning

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
        return Source((ALPHA,), "by rule", ROELANDS, note=f"{note}{_replaced_note(table)}")
    if table.atmospheric_law is None or table.viscosity is None:
        return None
    note = "The coefficient, given at reference_temperature, changes with ln(viscosity) + 9.67."
    return Source((ALPHA,), "by rule", ROELANDS, note=note)


def _replaced_note(table: Properties) -> str:
    """Text with the coefficient of the base, where another viscosity takes its place."""
    old = None if table.base is None else library.lubricant(table.base).get(ALPHA)
    return "" if old is None else f" It replaces {old} of {table.base!r}, which belongs to another viscosity."


def law_behind(name: str, table: Properties, pressure: float) -> str:
    """Name of the law of a property at a pressure [Pa], or of that over temperature at ambient pressure. It
    is "table" for a measured table, and empty for a given number.
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
    """Keys of a law: its name, and the parameters that the table gives."""
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
    """Keys of the density ratio to the reference temperature; empty where it is not known."""
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
    has_law = VISCOSITY_LAWS[table.viscosity_law].atmospheric is not None
    if has_law:
        yield from of_law(table, "viscosity_law")
    elif table.atmospheric_law is not None:
        yield from of_law(table, "atmospheric_law")
    elif table.temperature is not None:
        # The thermal expansion does not count: 15 % of it change the density by 1 % over 100 K.
        yield from _of_sheet(table, (*SHEET_VISCOSITY, "density_15"))
    else:
        yield "viscosity"
    if pressure > 0.0 and not has_law:
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
    """Keys of the kinematic viscosity. Kinematic viscosities of a data sheet do not depend on the density."""
    sheet = table.temperature
    if sheet is not None and sheet.dynamic_viscosity_1 is None and sheet.dynamic_viscosity_2 is None:
        yield from _of_sheet(table, SHEET_VISCOSITY)
        return
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


# Temperatures of a survey for which nobody names one [K]: 40, 60, 80 and 100 degC.
_USUAL = (313.15, 333.15, 353.15, 373.15)

# Kind of a value that a user's own table gives.
GIVEN = "given"


@dataclass(frozen=True)
class OilProperty:
    """Property of an oil."""

    name: str
    title: str
    unit: str  # SI unit in the notation of pint; empty for a dimensionless property
    # Value of an oil at a pressure [Pa]; None where it is not known.
    value: Callable[[KnownOil, float], float | None]
    # Keys of ``[lubricant]`` that decide the value, as a function of the table and the pressure [Pa].
    keys: Callable[[Properties, float], Iterable[str]]
    laws: tuple[str, ...] = ()  # keys of ``LAWS`` of the laws over pressure; empty for a property without one

    @property
    def over_pressure(self) -> bool:
        """Whether the property changes with pressure."""
        return bool(self.laws)

    def range_end(self, oil: KnownOil) -> float:
        """Pressure at which the range of its laws ends [Pa]; infinite if there is no end."""
        return min((oil.range_end(key) for key in self.laws), default=math.inf)


@dataclass(frozen=True)
class SurveyLine:
    """Property of an oil at one pressure and several temperatures."""

    of: OilProperty
    pressure: float  # pressure [Pa]; zero for ambient pressure
    values: tuple[float | None, ...]  # value at each temperature, SI units; None where it is not known
    law: str  # name of the law; empty without one
    # Kind of the weakest source behind the values, or "given" for values of a user's own table; empty where
    # nothing is known.
    kind: str
    sources: tuple[Source, ...]  # sources behind the values, without sources of a user's own table

    @property
    def missing(self) -> bool:
        """Whether the property is not known at any of the temperatures."""
        return all(value is None for value in self.values)


def survey(named: NamedOil, oils: Sequence[KnownOil], pressures: Sequence[float]) -> Iterator[SurveyLine]:
    """Lines of a survey of an oil: every property at ambient pressure and at further pressures.
    ``pressures``, pressures in addition to ambient pressure [Pa], for the properties that change with
    pressure.
    """
    for quantity in PROPERTIES.values():
        at = [0.0, *pressures] if quantity.over_pressure else [0.0]
        for pressure in at[1:] if quantity.name == "density_ratio" else at:
            values = tuple(_value(quantity, oil, pressure) for oil in oils)
            known = any(value is not None for value in values)
            behind = origin(named, quantity, pressure) if known else ("", "", ())
            yield SurveyLine(quantity, pressure, values, *behind)


def origin(named: NamedOil, quantity: OilProperty, pressure: float) -> tuple[str, str, tuple[Source, ...]]:
    """Name of the law of a property at a pressure [Pa], kind of its weakest source, and all its sources.

    Examples
    --------
    >>> from ehlectric.cases.case_oil import named_oil
    >>> law, kind, sources = origin(named_oil("fva-3"), PROPERTIES["density"], 0.0)
    >>> law, kind, len(sources)
    ('linear', 'read off a diagram', 1)
    """
    sources, given = _sources(named, quantity, pressure)
    kinds = [source.kind for source in sources]
    kind = max(kinds, key=KINDS.index, default=GIVEN if given else "")
    return law_behind(quantity.name, named.table, pressure), kind, sources


def depends_on_temperature(table: Properties) -> bool:
    """Whether the viscosity of an oil follows from its temperature."""
    return table.over_temperature or VISCOSITY_LAWS[table.viscosity_law].atmospheric is not None


def usual_temperatures(named: NamedOil) -> tuple[float | None, ...]:
    """Temperatures for a survey of an oil for which nobody names one [K].

    Temperatures of the contact or bearing in the file of the oil; otherwise 40, 60, 80 and 100 degC if they
    lie in the range of the oil, or the ends of a range without them. An oil whose viscosity does not depend
    on temperature has None: its values hold at one temperature, which nobody may know.
    """
    if named.temperatures:
        return named.temperatures
    if not depends_on_temperature(named.table):
        return (None,)
    ends = named.table.temperature_range
    if ends is None:
        return _USUAL
    return tuple(kelvin for kelvin in _USUAL if ends[0] <= kelvin <= ends[1]) or ends


def _value(quantity: OilProperty, oil: KnownOil, pressure: float) -> float | None:
    """Value of a property; None where it is not known, or its law has none at this pressure."""
    try:
        return quantity.value(oil, pressure)
    except InputError:
        # The permittivity law has a pole below this pressure.
        return None


def _sources(named: NamedOil, quantity: OilProperty, pressure: float) -> tuple[tuple[Source, ...], bool]:
    """Sources behind a property, each once, and whether the table of a user gives a part of it."""
    keys = quantity.keys(named.table, pressure)
    sources = [source for key in keys for source in _behind(named, key)]
    return tuple(dict.fromkeys(source for source in sources if source is not None)), None in sources


def _behind(named: NamedOil, key: str) -> Iterator[Source | None]:
    """Sources of the value of a key; None for a value that the table of a user gives."""
    table = named.table
    if is_estimated(table, key):
        yield estimate_of(table)
        return
    if key != ALPHA or table.parameter(ALPHA) is not None:
        yield named.source(key)
    relation = relation_of(table) if key == ALPHA else None
    if relation is not None:
        yield relation


def _at(oil: KnownOil, pressure: float, choice: str) -> float | None:
    """Value of a law of an oil at a pressure; None if it has none."""
    law = oil.laws.get(choice)
    return None if law is None else float(law(np.array([pressure]))[0][0])


def _viscosity(oil: KnownOil, pressure: float) -> float | None:
    exponent = _at(oil, pressure, "viscosity_law") if pressure > 0.0 else 0.0
    if oil.viscosity is None or exponent is None:
        return None
    return oil.viscosity * float(np.exp(exponent))


def _kinematic(oil: KnownOil, _: float) -> float | None:
    return None if oil.viscosity is None or oil.density is None else oil.viscosity / oil.density


def _density(oil: KnownOil, pressure: float) -> float | None:
    ratio = _at(oil, pressure, "density_law") if pressure > 0.0 else 1.0
    return None if oil.density is None or ratio is None else oil.density * ratio


def _permittivity(oil: KnownOil, pressure: float) -> float | None:
    if pressure == 0.0:
        return oil.relative_permittivity
    law, ratio = oil.laws.get("permittivity_law"), _at(oil, pressure, "density_law")
    return None if law is None or ratio is None else float(law(ratio))


def _of_law(
    name: str,
    title: str,
    unit: str,
    choice: str,
    keys: Callable[[Properties, float], Iterable[str]] | None = None,
) -> OilProperty:
    """Property that is the value of a law over pressure; its keys are the keys of the law by default."""
    value = partial(_at, choice=choice)
    return OilProperty(name, title, unit, value, keys or partial(_law_keys, choice), (choice,))


def _law_keys(choice: str, table: Properties, _: float) -> Iterator[str]:
    """Keys of a law, whatever the pressure."""
    return of_law(table, choice)


_CONDUCTIVITY, _CAPACITY = "thermal_conductivity_law", "heat_capacity_law"
_ALL = (
    OilProperty("viscosity", "viscosity", "Pa*s", _viscosity, viscosity_keys, ("viscosity_law",)),
    OilProperty("kinematic_viscosity", "kinematic viscosity", "m**2/s", _kinematic, kinematic_keys),
    OilProperty(ALPHA, "alpha (initial slope)", "1/Pa", lambda oil, _: oil.alpha, alpha_keys),
    OilProperty(
        "alpha_star", "alpha* (reciprocal asymptotic)", "1/Pa", lambda oil, _: oil.alpha_star, alpha_keys
    ),
    OilProperty("density", "density", "kg/m**3", _density, density_keys, ("density_law",)),
    _of_law("density_ratio", "density over ambient", "", "density_law"),
    OilProperty(
        "relative_permittivity",
        "relative permittivity",
        "",
        _permittivity,
        permittivity_keys,
        ("permittivity_law", "density_law"),
    ),
    OilProperty("conductivity", "conductivity", "S/m", lambda oil, _: oil.conductivity, conductivity_keys),
    _of_law("thermal_conductivity", "thermal conductivity", "W/m/K", _CONDUCTIVITY, thermal_keys),
    _of_law("heat_capacity", "volumetric heat capacity", "J/m**3/K", _CAPACITY),
)

# Properties of an oil by name, in the order of tables.
PROPERTIES: Mapping[str, OilProperty] = MappingProxyType({quantity.name: quantity for quantity in _ALL})


PRESSURE = Amount("Pa", least=0.0, most=2e10, reason="in the oil; contacts of steel reach 4 GPa")


@dataclass(frozen=True, eq=False)
class OilReport:
    """Properties of an oil at temperatures and pressures."""

    named: NamedOil
    oils: tuple[KnownOil, ...]
    pressures: tuple[float, ...]  # pressures in addition to ambient pressure [Pa]
    lines: tuple[SurveyLine, ...]  # every property at every pressure, with the values at all temperatures
    # Warnings about laws and estimates, with the temperature at which they hold.
    warnings: tuple[ResultWarning | str, ...]

    @property
    def temperatures(self) -> tuple[float | None, ...]:
        """Temperatures [K]; None for values that hold at the temperature of a contact."""
        return tuple(oil.temperature for oil in self.oils)

    @property
    def sources(self) -> tuple[Source, ...]:
        """Sources behind all lines, each once, in the order of the lines."""
        return tuple(dict.fromkeys(source for line in self.lines for source in line.sources))

    @property
    def missing(self) -> tuple[str, ...]:
        """Lines that say which keys are missing, and for what."""
        return tuple(dict.fromkeys(str(error) for oil in self.oils for error in oil.missing.values()))

    def beyond(self, line: SurveyLine, oil: KnownOil) -> bool:
        """Whether a line lies beyond the range of its law, at the temperature of an oil."""
        return line.pressure > 0.0 and line.pressure > line.of.range_end(oil)

    def summary(self) -> dict[str, Any]:
        """Content of the report as nested tables and lists, SI units, for JSON."""
        number = {source: k for k, source in enumerate(self.sources)}
        return {
            "name": self.named.name,
            "title": self.named.title,
            "temperature_range": self.named.table.temperature_range,
            "temperatures": self.temperatures,
            "properties": [
                {
                    "name": line.of.name,
                    "unit": line.of.unit,
                    "pressure": line.pressure,
                    "values": line.values,
                    "beyond_range": [self.beyond(line, oil) for oil in self.oils],
                    "law": line.law,
                    "kind": line.kind,
                    "sources": [number[source] for source in line.sources],
                }
                for line in self.lines
            ],
            "sources": [
                {"kind": s.kind, "citation": s.citation, "doi": s.doi, "note": s.note} for s in self.sources
            ],
            "missing": self.missing,
            "needs": self.named.needs,
            "warnings": [{"code": getattr(at, "code", None), "text": str(at)} for at in self.warnings],
        }


def oil_report(
    source: str | Path | Mapping[str, Any],
    temperatures: Sequence[str | float] = (),
    pressures: Sequence[str | float] = (),
) -> OilReport:
    """Report on every property of an oil from the library, a file or a table. Properties of which a value is
    missing are marked. Raises InputError if there is no such oil, or a temperature is outside its range.

    Examples
    --------
    >>> report = oil_report("fva-3", ["40 degC"], ["1 GPa"])
    >>> line = report.lines[0]
    >>> line.of.name, round(line.values[0], 4), line.law, line.kind
    ('viscosity', 0.0845, 'vogel', 'fitted')
    """
    named = named_oil(source)
    kelvins = [kelvin_of(text, "--temperature") for text in temperatures]
    pascals = sorted({_pascal(text) for text in pressures} - {0.0})
    if kelvins:
        oils = tuple(known_oil(named.table, kelvin, "--temperature") for kelvin in kelvins)
    else:
        oils = tuple(_usual(named))
    lines = tuple(survey(named, oils, pascals))
    return OilReport(named, oils, tuple(pascals), lines, tuple(_warnings(oils, max(pascals, default=0.0))))


def _usual(named: NamedOil) -> Iterator[KnownOil]:
    """Oil at the usual temperatures at which all its laws have a value."""
    refused: list[InputError] = []
    kelvins = usual_temperatures(named)
    for kelvin in kelvins:
        try:
            yield known_oil(named.table, kelvin, "--temperature")
        except InputError as error:
            refused.append(error)
    if len(refused) == len(kelvins):
        raise refused[0]


def celsius(temperature: float | None) -> str:
    """Temperature [K] as text in degrees Celsius; empty without one.

    Examples
    --------
    >>> celsius(313.15)
    '40 °C'
    """
    return "" if temperature is None else f"{round(CELSIUS.of(temperature), 6):g} °C"


def _pascal(pressure: str | float) -> float:
    with within("--pressure"):
        return PRESSURE.parse(pressure)


def _warnings(oils: Sequence[KnownOil], pressure: float) -> Iterator[ResultWarning | str]:
    """Warnings of the oil at its temperatures: ends of ranges of all, and each other warning once."""
    known: set[str] = set()
    for oil in oils:
        at = "" if oil.temperature is None else f"at {celsius(oil.temperature)}, "
        for warning in oil.warnings(pressure):
            if warning.code == "law-range" or warning.code not in known:
                known.add(warning.code)
                # The laws warn of the Hertzian pressure of a contact; here it is a pressure in the oil.
                text = warning.text.replace("the maximum Hertzian pressure", "the pressure")
                yield replace(warning, text=at + text)
        try:
            PROPERTIES["relative_permittivity"].value(oil, pressure)
        except InputError as error:
            yield f"{at}{error}"
    if not depends_on_temperature(oils[0].table) and oils[0].temperature is not None:
        yield "the viscosity of this oil is one number: it is shown as it is given, at any temperature"
