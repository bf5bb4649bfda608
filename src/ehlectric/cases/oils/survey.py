"""Survey of an oil: each of its properties with its value, its law and the sources behind it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from ehlectric.cases.library.sources import KINDS, Source
from ehlectric.cases.oils.behind import (
    alpha_keys,
    conductivity_keys,
    density_keys,
    estimate_of,
    is_estimated,
    kinematic_keys,
    law_behind,
    of_law,
    permittivity_keys,
    relation_of,
    thermal_keys,
    viscosity_keys,
)
from ehlectric.cases.oils.estimates import ALPHA
from ehlectric.cases.oils.known import KnownOil
from ehlectric.cases.oils.named import NamedOil
from ehlectric.cases.oils.properties import Properties
from ehlectric.errors import InputError
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS

# Temperatures of a survey for which nobody names one [K]: 40, 60, 80 and 100 degC.
_USUAL = (313.15, 333.15, 353.15, 373.15)

# Kind of a value that a user's own table gives.
GIVEN = "given"


@dataclass(frozen=True)
class OilProperty:
    """Property of an oil.

    Attributes
    ----------
    name : str
        Name for programs.
    title : str
        Name for readers.
    unit : str
        SI unit in the notation of pint; empty for a dimensionless property.
    value : callable
        Value of an oil at a pressure [Pa]; None where it is not known.
    keys : callable
        Keys of ``[lubricant]`` that decide the value, as a function of the table and the pressure [Pa].
    laws : tuple of str
        Keys of ``LAWS`` of the laws over pressure; empty for a property without one.
    """

    name: str
    title: str
    unit: str
    value: Callable[[KnownOil, float], float | None]
    keys: Callable[[Properties, float], Iterable[str]]
    laws: tuple[str, ...] = ()

    @property
    def over_pressure(self) -> bool:
        """Whether the property changes with pressure."""
        return bool(self.laws)

    def range_end(self, oil: KnownOil) -> float:
        """Pressure at which the range of its laws ends [Pa]; infinite if there is no end."""
        return min((oil.range_end(key) for key in self.laws), default=math.inf)


@dataclass(frozen=True)
class SurveyLine:
    """Property of an oil at one pressure and several temperatures.

    Attributes
    ----------
    of : OilProperty
        Property.
    pressure : float
        Pressure [Pa]; zero for ambient pressure.
    values : tuple of float or None
        Value at each temperature, SI units; None where it is not known.
    law : str
        Name of the law; empty without one.
    kind : str
        Kind of the weakest source behind the values, or "given" for values of a user's own table; empty where
        nothing is known.
    sources : tuple of Source
        Sources behind the values, without those of a user's own table.
    """

    of: OilProperty
    pressure: float
    values: tuple[float | None, ...]
    law: str
    kind: str
    sources: tuple[Source, ...]

    @property
    def missing(self) -> bool:
        """Whether the property is not known at any of the temperatures."""
        return all(value is None for value in self.values)


def survey(named: NamedOil, oils: Sequence[KnownOil], pressures: Sequence[float]) -> Iterator[SurveyLine]:
    """Lines of a survey of an oil: every property at ambient pressure and at further pressures.

    Parameters
    ----------
    named : NamedOil
        Oil with the sources of its values.
    oils : sequence of KnownOil
        The oil at each temperature.
    pressures : sequence of float
        Pressures beside ambient pressure [Pa], for the properties that change with pressure.

    Yields
    ------
    SurveyLine
        Line of a property at a pressure, property by property. The density ratio has no line at ambient
        pressure, where it is 1.
    """
    for one in PROPERTIES.values():
        at = [0.0, *pressures] if one.over_pressure else [0.0]
        for pressure in at[1:] if one.name == "density_ratio" else at:
            values = tuple(_value(one, oil, pressure) for oil in oils)
            known = any(value is not None for value in values)
            behind = origin(named, one, pressure) if known else ("", "", ())
            yield SurveyLine(one, pressure, values, *behind)


def origin(named: NamedOil, one: OilProperty, pressure: float) -> tuple[str, str, tuple[Source, ...]]:
    """Name of the law of a property at a pressure [Pa], kind of its weakest source, and all its sources.

    Examples
    --------
    >>> from ehlectric.cases.oils.named import named_oil
    >>> law, kind, sources = origin(named_oil("fva-3"), PROPERTIES["density"], 0.0)
    >>> law, kind, len(sources)
    ('linear', 'read off a diagram', 1)
    """
    sources, given = _sources(named, one, pressure)
    kinds = [source.kind for source in sources]
    kind = max(kinds, key=KINDS.index, default=GIVEN if given else "")
    return law_behind(one.name, named.table, pressure), kind, sources


def depends_on_temperature(table: Properties) -> bool:
    """Whether the viscosity of an oil follows from its temperature."""
    return table.over_temperature or VISCOSITY_LAWS[table.viscosity_law].atmospheric is not None


def usual_temperatures(named: NamedOil) -> tuple[float | None, ...]:
    """Temperatures for a survey of an oil for which nobody names one [K].

    Those of the contact or bearing in the file of the oil; otherwise 40, 60, 80 and 100 degC if they lie
    in the range of the oil, or the ends of a range without them. An oil whose viscosity does not depend on
    temperature has None: its values hold at one temperature, which nobody may know.
    """
    if named.temperatures:
        return named.temperatures
    if not depends_on_temperature(named.table):
        return (None,)
    ends = named.table.temperature_range
    if ends is None:
        return _USUAL
    return tuple(kelvin for kelvin in _USUAL if ends[0] <= kelvin <= ends[1]) or ends


def _value(one: OilProperty, oil: KnownOil, pressure: float) -> float | None:
    """Value of a property; None where it is not known, or its law has none at this pressure."""
    try:
        return one.value(oil, pressure)
    except InputError:
        # The permittivity law has a pole below this pressure.
        return None


def _sources(named: NamedOil, one: OilProperty, pressure: float) -> tuple[tuple[Source, ...], bool]:
    """Sources behind a property, each once, and whether the table of a user gives a part of it."""
    keys = one.keys(named.table, pressure)
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


def _at(oil: KnownOil, choice: str, pressure: float) -> float | None:
    """Value of a law of an oil at a pressure; None if it has none."""
    law = oil.laws.get(choice)
    return None if law is None else float(law(np.array([pressure]))[0][0])


def _viscosity(oil: KnownOil, pressure: float) -> float | None:
    exponent = _at(oil, "viscosity_law", pressure) if pressure > 0.0 else 0.0
    if oil.viscosity is None or exponent is None:
        return None
    return oil.viscosity * float(np.exp(exponent))


def _kinematic(oil: KnownOil, _: float) -> float | None:
    return None if oil.viscosity is None or oil.density is None else oil.viscosity / oil.density


def _density(oil: KnownOil, pressure: float) -> float | None:
    ratio = _at(oil, "density_law", pressure) if pressure > 0.0 else 1.0
    return None if oil.density is None or ratio is None else oil.density * ratio


def _permittivity(oil: KnownOil, pressure: float) -> float | None:
    if pressure == 0.0:
        return oil.relative_permittivity
    law, ratio = oil.laws.get("permittivity_law"), _at(oil, "density_law", pressure)
    return None if law is None or ratio is None else float(law(ratio))


_ALL = (
    OilProperty("viscosity", "viscosity", "Pa*s", _viscosity, viscosity_keys, ("viscosity_law",)),
    OilProperty("kinematic_viscosity", "kinematic viscosity", "m**2/s", _kinematic, kinematic_keys),
    OilProperty(
        "pressure_viscosity_coefficient",
        "alpha (initial slope)",
        "1/Pa",
        lambda oil, _: oil.alpha,
        alpha_keys,
    ),
    OilProperty("alpha_star", "alpha* (film formulas)", "1/Pa", lambda oil, _: oil.alpha_star, alpha_keys),
    OilProperty("density", "density", "kg/m**3", _density, density_keys, ("density_law",)),
    OilProperty(
        "density_ratio",
        "density over ambient",
        "",
        lambda oil, pressure: _at(oil, "density_law", pressure),
        lambda table, _: of_law(table, "density_law"),
        ("density_law",),
    ),
    OilProperty(
        "relative_permittivity",
        "relative permittivity",
        "",
        _permittivity,
        permittivity_keys,
        ("permittivity_law", "density_law"),
    ),
    OilProperty("conductivity", "conductivity", "S/m", lambda oil, _: oil.conductivity, conductivity_keys),
    OilProperty(
        "thermal_conductivity",
        "thermal conductivity",
        "W/m/K",
        lambda oil, pressure: _at(oil, "thermal_conductivity_law", pressure),
        thermal_keys,
        ("thermal_conductivity_law",),
    ),
    OilProperty(
        "heat_capacity",
        "volumetric heat capacity",
        "J/m**3/K",
        lambda oil, pressure: _at(oil, "heat_capacity_law", pressure),
        lambda table, _: of_law(table, "heat_capacity_law"),
        ("heat_capacity_law",),
    ),
)

# Properties of an oil by name, in the order of tables.
PROPERTIES: Mapping[str, OilProperty] = MappingProxyType({one.name: one for one in _ALL})
