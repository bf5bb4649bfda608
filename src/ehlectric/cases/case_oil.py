"""Oil of a case: the table `lubricant`, the oil at a temperature that follows from its keys, and oils by
their names.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any, Self, TypeVar

import numpy as np
import scipy
from pydantic import model_validator

from ehlectric.arrays import Array, Numbers, as_float
from ehlectric.cases import library
from ehlectric.cases.amounts import Amount, with_bounds
from ehlectric.cases.library.library_oils import LibraryOil, Source, library_oil, values_of
from ehlectric.cases.oil_inputs import (
    LAWS,
    TEMPERATURE,
    Properties,
    base_oil_values,
    check_parameters,
    check_viscosity,
    estimated_alpha,
    law_parameters,
    of_base_oil,
    refuse_missing,
)
from ehlectric.cases.roughness_inputs import find_files
from ehlectric.cases.table import nearest, read_toml
from ehlectric.cases.viscosity_tables import table_check
from ehlectric.errors import InputError, shown, within
from ehlectric.lubricant.data_sheet import Estimate
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.electrical_laws import CONDUCTIVITY, PERMITTIVITY_LAWS
from ehlectric.lubricant.heat_laws import constant_thermal_conductivity
from ehlectric.lubricant.law import Law, is_many, over_points, required, same
from ehlectric.lubricant.oil import BoundLaw, OfDensity, Oil, RangeCheck
from ehlectric.lubricant.properties_over_temperature import density, interpolated
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS, initial_alpha, reciprocal_asymptotic_alpha
from ehlectric.quantities.formats import CELSIUS
from ehlectric.quantities.result_warnings import ResultWarning

# Difference of temperatures over which the slope of the viscosity is taken [K].
_STEP = 1e-3


@contextmanager
def of_table(temperature: str) -> Iterator[None]:
    """Context in which errors about the temperature get its key, and others the table ``lubricant``."""
    try:
        yield
    except InputError as error:
        if error.key == "temperature":
            raise error.with_text(temperature, error.text) from None
        raise error.under("lubricant") from None


def oil_at(oil: Properties, temperature: Numbers | None, key: str) -> Oil:
    """Oil at a temperature [K], or at the temperature of its contact; see ``Lubricant.at``."""
    many = is_many(temperature, *oil.arrays().values())
    with of_table(key):
        given, temperature = temperature, _checked(oil, temperature)
        viscosity, density_of = viscosity_at(oil, temperature), density_at(oil, temperature)
        permittivity = permittivity_at(oil, temperature)
        known = {"relative_permittivity": permittivity}
        if density_of is not None:
            known["density"] = density_of
        names = law_names(oil)
        laws = {name: bound(oil, name, temperature, viscosity, known) for name in names}
        conductivity = conductivity_at(oil, temperature, laws.get("conductivity_law"))
        # A law without a value at the temperature is refused here, with the key of the temperature.
        first = [laws[name](np.zeros(()))[1] for name in ("viscosity_law", "density_law")]
        ranges = (range_check(oil, key, temperature, viscosity) for key in names)
        table = table_check(oil.viscosity_table, _known(oil), temperature, viscosity)
        checks: tuple[Estimate | RangeCheck | None, ...] = (estimated_alpha(oil, temperature), *ranges, table)
        if many:
            values = (viscosity, permittivity, 0.0 if conductivity is None else conductivity, *first)
            viscosity = as_float(np.where(np.isfinite(sum(values)), viscosity, math.nan))
        return Oil(
            viscosity=viscosity,
            relative_permittivity=permittivity,
            ambient_pressure=oil.ambient_pressure,
            log_viscosity=laws["viscosity_law"],
            density_ratio=laws["density_law"],
            permittivity=OfDensity(laws["permittivity_law"]),
            thermal_conductivity_law=laws.get("thermal_conductivity_law") or sheet_conductivity(oil),
            heat_capacity_law=laws.get("heat_capacity_law"),
            laws={name.removesuffix("_law"): law for name, law in names.items()},
            checks=tuple(check for check in checks if check is not None),
            inputs={} if many else oil.model_dump(mode="json", exclude_none=True),
            name=oil.base or "",
            temperature=given,
            density=density_of,
            conductivity=conductivity,
            conductivity_over=conductivity_over(oil, laws.get("conductivity_law")),
        )


def _known(oil: Properties) -> dict[str, Any]:
    """Laws of viscosity of an oil, and all parameters, by the keys of ``[lubricant]``."""
    names = ("viscosity_law", "atmospheric_law")
    keys = (*law_parameters(*names), "viscosity", "reference_temperature")
    return {name: getattr(oil, name) for name in names} | {name: oil.parameter(name) for name in keys}


def law_names(oil: Properties) -> dict[str, str]:
    """Names of the laws of an oil, by the keys of ``LAWS``."""
    names = {key: oil.law(key) for key in LAWS}
    return {key: name for key, name in names.items() if name is not None}


def _checked(oil: Properties, temperature: Numbers | None) -> Numbers | None:
    """Temperature [K] at which an oil has values; of many points, points at which it has none have NaN.
    Raises InputError if the temperature of all points is outside the range of the oil.
    """
    if temperature is None:
        return None
    if not is_many(temperature):
        check_range(oil, float(temperature))
        return _held_by_laws(oil, temperature)
    tables = (oil.permittivity_table, oil.conductivity_table)
    for ends in (oil.temperature_range, *(table.temperature for table in tables if table is not None)):
        if ends is not None:
            inside = np.greater_equal(temperature, ends[0]) & np.less_equal(temperature, ends[-1])
            temperature = np.where(inside, temperature, math.nan)
    return _held_by_laws(oil, temperature)


def _held_by_laws(oil: Properties, temperature: Numbers) -> Numbers:
    """Temperature [K]; of many points, NaN where a law of the oil does not hold at it."""
    if not is_many(temperature, *oil.arrays().values()):
        return temperature
    for key, name in law_names(oil).items():
        law = LAWS[key][name]
        if law.holds is not None:
            holds = law.holds(temperature, **_given(oil, law))
            if is_many(holds):
                temperature = np.where(holds, temperature, math.nan)
    return temperature


def bound(
    oil: Properties, key: str, temperature: Numbers | None, viscosity: Numbers, known: Mapping[str, Numbers]
) -> BoundLaw:
    """Law of an oil for a key of ``LAWS``, with its parameters at a temperature [K]. ``temperature``,
    temperature [K]; None if there is none; ``viscosity``, viscosity of the oil at zero pressure and this
    temperature [Pa s]. Raises InputError if the law needs a temperature and gets none.
    """
    name = oil.law(key)
    assert name is not None
    law = LAWS[key][name]
    if law.needs_temperature:
        required(temperature, f"{key} {name!r}")
    values = _parameters(oil, law, viscosity, temperature)
    names = {parameter.name for parameter in law.parameters}
    values |= {name: value for name, value in known.items() if name in names}
    bound = BoundLaw(law.function, values, temperature)
    return replace(bound, function=over_points(law.function)) if bound.many else bound


def sheet_conductivity(oil: Properties) -> BoundLaw | None:
    """Thermal conductivity of a data sheet, which is constant; None if there is none."""
    value = None if oil.temperature is None else oil.temperature.thermal_conductivity
    return None if value is None else BoundLaw(constant_thermal_conductivity, {"thermal_conductivity": value})


def conductivity_at(oil: Properties, temperature: Numbers | None, law: BoundLaw | None) -> Numbers | None:
    """Electrical conductivity at a temperature [S/m], by the table or the law of an oil; None without one."""
    table = oil.conductivity_table
    if table is not None:
        name = "lubricant.conductivity_table"
        at = required(temperature, name)
        return as_float(interpolated(at, table.temperature, table.conductivity, table=name, arrhenius=True))
    return None if law is None else as_float(law.function(temperature, **law.parameters))


def conductivity_over(oil: Properties, law: BoundLaw | None) -> Callable[[Array], Array] | None:
    """Electrical conductivity over temperature; None without one.

    In a film that heats itself the end values of a table hold beyond its ends.
    """
    table = oil.conductivity_table
    if table is not None:
        return partial(_held, temperatures=table.temperature, conductivities=table.conductivity)
    return None if law is None else partial(law.function, **law.parameters)


def _held(temperature: Array, *, temperatures: Sequence[float], conductivities: Sequence[float]) -> Array:
    """Conductivity of a table at temperatures [K], with its end values beyond its ends."""
    within = np.clip(temperature, temperatures[0], temperatures[-1])
    name = "lubricant.conductivity_table"
    return interpolated(within, temperatures, conductivities, table=name, arrhenius=True)


def check_range(oil: Properties, temperature: float | None) -> None:
    """Refuse a temperature outside the range for which the data of the oil hold."""
    if temperature is None or oil.temperature_range is None:
        return
    low, high = oil.temperature_range
    if not low <= temperature <= high:
        whose = f"{oil.base!r}" if oil.base else "the oil"
        raise InputError(
            "temperature",
            got=f"{CELSIUS.of(temperature):.4g} degC",
            takes=f"{CELSIUS.of(low):.4g} to {CELSIUS.of(high):.4g} degC, for which the laws of {whose} hold "
            "(lubricant.temperature_range)",
        )


def viscosity_at(oil: Properties, temperature: Numbers | None) -> Numbers:
    """Viscosity of an oil at zero pressure and a temperature [K], in Pa s. Raises InputError if the viscosity
    depends on a temperature that is not given, or has no value at it.
    """
    law = viscosity_over_temperature(oil)
    if law is None:
        assert oil.viscosity is not None
        return oil.viscosity
    return law(as_float(required(temperature, "the viscosity of the oil")))


def viscosity_over_temperature(oil: Properties) -> Callable[[Numbers], Numbers] | None:
    """Viscosity at zero pressure [Pa s] as a function of temperature [K]; None for a given viscosity."""
    entry = VISCOSITY_LAWS[oil.viscosity_law]
    if entry.atmospheric is not None:
        atmospheric = over_points(entry.atmospheric)
        return lambda at: as_float(atmospheric(at, **_given(oil, entry)))
    if oil.atmospheric_law is not None:
        law = LAWS["atmospheric_law"][oil.atmospheric_law]
        function = over_points(law.function)
        return lambda at: as_float(function(at, **_given(oil, law)))
    sheet = oil.temperature
    if sheet is not None:
        walther = sheet.walther()
        return lambda at: walther.viscosity(at) * density(sheet.density_15, sheet.expansion, at)
    return None


def viscosity_follows(oil: Properties) -> bool:
    """Whether the viscosity of an oil at zero pressure follows from its temperature."""
    return oil.over_temperature or VISCOSITY_LAWS[oil.viscosity_law].atmospheric is not None


def depends_on_temperature(oil: Properties) -> bool:
    """Whether viscosity, density or permittivity of an oil change with its temperature.

    Each may do so by a law that needs the temperature, by a table, or by thermal expansion.
    """
    if viscosity_over_temperature(oil) is not None or oil.permittivity_table is not None:
        return True
    of_films = ("viscosity_law", "density_law", "permittivity_law")
    if any(LAWS[key][getattr(oil, key)].needs_temperature for key in of_films):
        return True
    return density_over_reference(oil, oil.reference_temperature) is not None


def temperature_coefficient(oil: Properties, temperature: Numbers) -> Numbers | None:
    """Temperature coefficient of the viscosity, -d ln(eta)/dT [1/K]; None for a given viscosity."""
    law = viscosity_over_temperature(oil)
    if law is None:
        return None
    cold, warm = (_held_by_laws(oil, temperature + step) for step in (-_STEP, _STEP))
    return as_float(np.log(law(cold) / law(warm)) / (2.0 * _STEP))


def density_at(oil: Properties, temperature: Numbers | None) -> Numbers | None:
    """Density of an oil at zero pressure and a temperature [K], in kg/m^3; None if it is not known.

    A density without a reference temperature or without an expansion holds at the temperature.
    """
    if oil.temperature is not None and temperature is not None:
        return density(oil.temperature.density_15, oil.temperature.expansion, temperature)
    ratio = density_over_reference(oil, temperature)
    return None if oil.density is None else oil.density * (1.0 if ratio is None else ratio)


def density_over_reference(oil: Properties, temperature: Numbers | None) -> Numbers | None:
    """Density at zero pressure / density at the reference temperature; None if it is not known."""
    if temperature is None or oil.reference_temperature is None:
        return None
    difference = temperature - oil.reference_temperature
    by_law = DENSITY_LAWS[oil.density_law].thermal_expansion
    if by_law is not None:
        expansion = oil.parameter(by_law)
        return 1.0 / (1.0 + (0.0 if expansion is None else expansion) * difference)
    return None if oil.thermal_expansion is None else 1.0 - oil.thermal_expansion * difference


def _given(oil: Properties, law: Law) -> dict[str, Numbers]:
    """Values of those parameters of a law that the table gives, by name, SI units."""
    values = {parameter.name: oil.parameter(parameter.name) for parameter in law.parameters}
    return {name: value for name, value in values.items() if value is not None}


def _parameters(
    oil: Properties, law: Law, viscosity: Numbers, temperature: Numbers | None
) -> dict[str, Numbers]:
    """Parameters of a law at a temperature [K] at which the oil has this viscosity [Pa s].

    Those that the table lacks follow from the viscosity, or from the type of base oil. Those that it gives
    for the reference temperature change with the viscosity as the relation between them says.
    """
    names = {parameter.name for parameter in law.parameters}
    follows = names & of_base_oil(oil)
    estimated = base_oil_values(oil, viscosity, temperature) if follows else {}
    values = {name: value for name, value in estimated.items() if name in names} | _given(oil, law)
    for parameter in law.parameters:
        rule = parameter.derivation
        if rule is None:
            continue
        of = [oil.parameter(name) for name in rule.parameters]
        if parameter.name not in values:
            values[parameter.name] = rule.function(viscosity, *of)
        elif oil.atmospheric_law is not None and oil.viscosity is not None:
            # Parameters that a law such as Barus' does not have are factors, which cancel in the ratio.
            of = [1.0 if value is None else value for value in of]
            ratio = rule.function(viscosity, *of) / rule.function(oil.viscosity, *of)
            values[parameter.name] = values[parameter.name] * ratio
    return values


def permittivity_at(oil: Properties, temperature: Numbers | None) -> Numbers:
    """Relative permittivity at zero pressure and a temperature [K]."""
    table = oil.permittivity_table
    if table is not None:
        name = "lubricant.permittivity_table"
        at = required(temperature, name)
        return as_float(interpolated(at, table.temperature, table.relative_permittivity, table=name))
    assert oil.relative_permittivity is not None
    ratio = density_over_reference(oil, temperature)
    if ratio is None:
        return oil.relative_permittivity
    law = PERMITTIVITY_LAWS[oil.permittivity_law]
    return as_float(over_points(law.function)(ratio, temperature, **_given(oil, law)))


def range_check(
    oil: Properties, key: str, temperature: Numbers | None, viscosity: Numbers
) -> RangeCheck | None:
    """Check of the range of a law, for a key of ``LAWS``; None if the law has no range."""
    name = oil.law(key)
    assert name is not None
    law = LAWS[key][name]
    if law.warnings is None:
        return None
    parameters = _parameters(oil, law, viscosity, temperature)
    return RangeCheck(law.warnings, viscosity, parameters, temperature, key.removesuffix("_law"))


class Lubricant(Properties):
    """Properties of a lubricant, and its laws over pressure and temperature.

    Examples
    --------
    >>> oil = Lubricant.from_dict({"base": "paper", "viscosity_law": "barus"})
    >>> oil.parameter("pressure_viscosity_coefficient")
    2.2e-08
    """

    @model_validator(mode="after")
    def _check(self) -> Self:
        """Check that values are given in one way, and that no parameter of a law is missing."""
        refuse_missing(self)
        keys = ("relative_permittivity", "permittivity_table")
        self.check_alternatives(keys, f"either {' or '.join(keys)}")
        ends = self.temperature_range
        if ends is not None and not (len(ends) == 2 and ends[0] < ends[1]):
            raise InputError(
                "temperature_range", got=list(ends), takes="the lowest and the highest temperature"
            )
        return self

    def at(self, temperature: Numbers | None, key: str = "contact.temperature") -> Oil:
        """Numbers and laws of the oil at a temperature [K], or at the temperatures of many points, shape
        (n,). Raises InputError if the oil needs a temperature and none is given, or if a law has no value at
        this temperature. Of many points, points at which the oil has no value are ``Oil.refused``.

        Examples
        --------
        >>> table = {"kinematic_viscosity_40": "46 mm^2/s", "kinematic_viscosity_100": "6.8 mm^2/s"}
        >>> table |= {"density_15": "870 kg/m^3"}
        >>> oil = Lubricant.from_dict({"base": "paper", "temperature": table}).at(343.15)
        >>> round(oil.viscosity * 1e3, 2), round(oil.alpha * 1e9, 1)
        (12.46, 17.9)
        """
        latest = _latest[-1] if _latest else None
        if latest is None or latest[0] is not self or not same(latest[1], temperature):
            # Tables are frozen, so that one table at one temperature always has one oil.
            latest = (self, temperature, oil_at(self, temperature, key))
            _latest[:] = [latest]
        return latest[2]


# Oil that was made last, with its table and its temperature; a solution asks for its oil many times.
_latest: list[tuple[Lubricant, Numbers | None, Oil]] = []


def refusals(
    lubricant: Lubricant, temperature: Numbers | None, key: str = "contact.temperature"
) -> list[InputError | None]:
    """Errors of many points at which an oil has no value at its temperature [K]; None at the other points.

    Each is the error that ``Lubricant.at`` raises for the oil and the temperature of the one point.

    Examples
    --------
    >>> oil = Lubricant.from_dict({"base": "fva-3"})
    >>> print(refusals(oil, np.array([313.15, 500.0]))[1])  # doctest: +ELLIPSIS
    contact.temperature: got 226.9 degC; expected ...
    """
    refused = lubricant.at(temperature, key).refused
    errors: list[InputError | None] = [None] * np.size(refused)
    for index in np.flatnonzero(refused).tolist():
        at = temperature if temperature is None else np.broadcast_to(temperature, refused.shape)[index]
        try:
            lubricant.single(index).at(None if at is None else float(at), key)
        except InputError as error:
            errors[index] = error
    return errors


T = TypeVar("T")

# Largest pressure at which the end of a law's range is sought [Pa], and the error of the answer [Pa].
_HIGHEST, _CLOSE = 1e11, 1.0


@dataclass(frozen=True, eq=False)
class KnownOil:
    """Oil at one temperature as far as its table goes.

    An oil of which a value is missing cannot be solved with. Its other properties are computed here all the
    same, and no value takes the place of the missing one.

    Examples
    --------
    >>> oil = known_oil(Properties.from_dict({"base": "n100"}), 313.15)
    >>> round(oil.viscosity, 4), round(oil.alpha_star * 1e9, 1), oil.relative_permittivity
    (0.0867, 27.3, None)
    >>> print(*oil.missing.values())  # doctest: +ELLIPSIS
    lubricant.relative_permittivity: missing; permittivity_law 'clausius-mossotti' needs it; the library ...
    """

    table: Properties
    temperature: float | None  # temperature [K]; None for an oil without temperature
    # viscosity, density, relative_permittivity and conductivity: viscosity [Pa s], density [kg/m^3], relative
    # permittivity and electrical conductivity [S/m] at zero pressure; None where they are not known.
    viscosity: float | None
    density: float | None
    relative_permittivity: float | None
    conductivity: float | None
    laws: Mapping[str, BoundLaw]
    checks: Mapping[str, RangeCheck] = field(default_factory=dict)
    missing: Mapping[str, InputError] = field(default_factory=dict)

    @cached_property
    def alpha(self) -> float | None:
        """Slope of ln(eta) at zero pressure [1/Pa]; None where it is not known."""
        law = self.laws.get("viscosity_law")
        return None if law is None else float(initial_alpha(law))

    @cached_property
    def alpha_star(self) -> float | None:
        """Reciprocal asymptotic pressure-viscosity coefficient [1/Pa]; None where it is not known."""
        law = self.laws.get("viscosity_law")
        return None if law is None else float(reciprocal_asymptotic_alpha(law))

    def warnings(self, max_pressure: float) -> Iterator[ResultWarning]:
        """Warnings about the laws at pressures up to a largest one [Pa], and about an estimate."""
        estimate = estimated_alpha(self.table, self.temperature)
        if estimate is not None and "viscosity_law" in self.laws:
            yield from estimate(max_pressure)
        for check in self.checks.values():
            yield from check(max_pressure)

    def range_end(self, key: str) -> float:
        """Pressure at which the range of a law ends [Pa], by key of ``LAWS``; infinite if it has no end.

        It is the lowest Hertz pressure at which the law has the warning "law-range".

        Examples
        --------
        >>> oil = known_oil(Properties.from_dict({"base": "shell-t9"}), 313.15)
        >>> round(oil.range_end("viscosity_law") / 1e9, 2), oil.range_end("permittivity_law")
        (1.28, inf)
        """
        check = self.checks.get(key)
        if check is None or not _beyond(check, _HIGHEST):
            return math.inf
        return float(
            scipy.optimize.bisect(lambda pressure: _beyond(check, pressure) - 0.5, 0.0, _HIGHEST, xtol=_CLOSE)
        )


def _beyond(check: RangeCheck, pressure: float) -> bool:
    return any(warning.code == "law-range" for warning in check(pressure))


def _number(value: Numbers | None) -> float | None:
    return None if value is None else float(value)


def known_oil(table: Properties, temperature: float | None, key: str = "temperature") -> KnownOil:
    """Oil at a temperature as far as its table goes.

    ``temperature`` is the absolute temperature [K]; it is None for an oil whose values hold at the
    temperature of its contact. The oil has the properties that are known, and an error for each value that
    is missing. Raises InputError if a temperature is needed and missing, or outside the range of the oil or
    of a law, or if the table contradicts itself.
    """
    with of_table(key):
        check_range(table, temperature)
        reader = _OilValues(table, temperature)
        viscosity = reader.value(reader.viscosity)
        density, permittivity = _number(density_at(table, temperature)), reader.value(reader.permittivity)
        known = {"density": density, "relative_permittivity": permittivity}
        values = {name: value for name, value in known.items() if value is not None}
        laws = dict(reader.laws(viscosity, values))
        # Only laws of viscosity depend on the viscosity.
        at = math.nan if viscosity is None else viscosity
        checks = {name: range_check(table, name, temperature, at) for name in laws}
        sheet = sheet_conductivity(table)
        if sheet is not None:
            laws.setdefault("thermal_conductivity_law", sheet)
        conductivity = _number(conductivity_at(table, temperature, laws.get("conductivity_law")))
    return KnownOil(
        table,
        temperature,
        viscosity,
        density,
        permittivity,
        conductivity,
        laws,
        {name: check for name, check in checks.items() if check is not None},
        reader.missing,
    )


@dataclass(frozen=True)
class _OilValues:
    """Values and laws of an oil that are complete, and errors of those that are not."""

    table: Properties
    temperature: float | None
    missing: dict[str, InputError] = field(default_factory=dict)

    def value(self, function: Callable[[], T]) -> T | None:
        """Value of a function; None where a key of the table is missing for it."""
        try:
            return function()
        except InputError as error:
            if error.key == "temperature" or not error.is_missing:
                raise
            self.missing[f"lubricant.{error.key}"] = error.under("lubricant")
            return None

    def complete(self, choice: str) -> str:
        """Name of the law for a key of ``LAWS``, whose parameters are all known."""
        name = law_names(self.table)[choice]
        check_parameters(self.table, choice, LAWS[choice][name])
        return name

    def viscosity(self) -> float:
        """Viscosity at zero pressure [Pa s]."""
        check_viscosity(self.table)
        if LAWS["viscosity_law"][self.table.viscosity_law].atmospheric is not None:
            self.complete("viscosity_law")
        elif self.table.atmospheric_law is not None:
            self.complete("atmospheric_law")
        return float(viscosity_at(self.table, self.temperature))

    def permittivity(self) -> float:
        """Relative permittivity at zero pressure."""
        self.complete("permittivity_law")
        return float(permittivity_at(self.table, self.temperature))

    def laws(self, viscosity: float | None, values: Mapping[str, float]) -> Iterator[tuple[str, BoundLaw]]:
        """Laws of which all parameters are known, at the temperature."""
        for choice in law_names(self.table):
            without = choice == "viscosity_law" and viscosity is None
            if choice == "atmospheric_law" or without or not self.value(partial(self.complete, choice)):
                continue
            law = bound(
                self.table, choice, self.temperature, math.nan if viscosity is None else viscosity, values
            )
            if choice not in ("permittivity_law", "conductivity_law"):
                # A law without a value at the temperature raises its error here.
                law(np.zeros(1))
            yield choice, law


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

    Examples
    --------
    >>> oil = named_oil("n100")
    >>> oil.title, oil.needs
    ('N100, naphthenic mineral base oil without additives, ISO VG 100', ('relative_permittivity',))
    """

    name: str
    title: str  # what the oil is, in one line; empty if nothing says it
    given: Mapping[str, Any]  # table ``[lubricant]`` as it is written
    table: Properties  # parsed table, in which values may be missing
    base: LibraryOil | None = None  # oil of the library that the table names as its base; None without one
    # Temperatures of the contact, or of the bearing and its rings, in the file [K].
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
        rows = self.table.viscosity_table
        if rows is not None and key in _known(self.table):
            file = "" if rows.file is None else f" of {Path(rows.file).name}"
            note = f"Fitted to the {len(rows.viscosity)} rows of viscosity_table."
            return Source((key,), "fitted", f"viscosity table{file}", note=note)
        known = {} if self.base is None else self.base.values()
        # A value of the data sheet of the base may be used together with another way to give the viscosity.
        for name in (key, f"temperature.{key}"):
            if self.base is not None and name in known:
                return self.base.source(name)
        table, _, name = key.rpartition(".")
        value = getattr(getattr(self.table, table) if table else self.table, name)
        return Source((key,), "assumed", "default of ehlectric", note=f"{key} = {value}, which is not given")


def named_oil(source: str | Path | Mapping[str, Any]) -> NamedOil:
    """Oil of the library by its name, or of a file or table of a user. Values may be missing in its table.
    Raises InputError if there is no oil of this name, the file cannot be read or has
    no table ``lubricant``, or a value of the table is wrong.
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
    find_files(tables, path.parent)
    table = Lubricant.of_name(tables.get("lubricant"))
    if not isinstance(table, Mapping):
        raise InputError(path, "has no table [lubricant]", takes="a case, a bearing file or a file of an oil")
    kelvins = [
        _parsed(TEMPERATURE, tables, name, key) for name, keys in _TEMPERATURES.items() for key in keys
    ]
    conductivity = _parsed(with_bounds(Amount, CONDUCTIVITY), tables, "discharge", "conductivity")
    if conductivity is not None:
        # It replaces the conductivity of the oil, as in a solution.
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
    with within(f"{name}.{key}"):
        return quantity.parse(value, written=True)


def _of_table(
    name: str, title: str, given: Mapping[str, Any], temperatures: tuple[float, ...] = ()
) -> NamedOil:
    """Oil of a table; a table that contradicts itself is refused, and one that lacks values is not."""
    with within("lubricant"):
        try:
            table: Properties = Lubricant.from_written(given)
        except InputError as error:
            if not error.is_missing:
                raise
            table = Properties.from_written(given)
    base = None if table.base is None else library_oil(table.base)
    return NamedOil(name, title, given, table, base, temperatures)


def oil(source: str | Path | Mapping[str, Any], temperature: str | float | None = None) -> Oil:
    """Return an oil at a temperature: its numbers, and its laws as functions of pressure.

    Parameters
    ----------
    source : str, Path or mapping
        Name of an oil of the library; path of a case or bearing file, as a ``Path`` or as a string that ends
        in ``.toml``; or table ``[lubricant]`` of a case, as a dictionary.
    temperature : str or float, optional
        Temperature with its unit, or in kelvin; by default the temperature of the contact or the bearing in
        the file, if it has only one. An oil whose viscosity does not depend on temperature needs none.

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
    named = named_oil(source)
    sheet_temperature = named.temperatures[0] if len(named.temperatures) == 1 else None
    kelvin = sheet_temperature if temperature is None else kelvin_of(temperature)
    with within("lubricant"):
        lubricant = Lubricant.from_dict(named.given)
    return lubricant.at(kelvin, "temperature")


def kelvin_of(temperature: str | float, key: str = "temperature") -> float:
    """Temperature [K] from a string with its unit, or a number in kelvin. Raises InputError if it is no
    temperature of an oil.

    Examples
    --------
    >>> kelvin_of("40 degC")
    313.15
    """
    with within(key):
        return TEMPERATURE.parse(temperature, written=isinstance(temperature, str))
