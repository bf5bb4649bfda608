"""Oil at a temperature, from the keys of the table ``lubricant``."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.oils.estimates import base_oil_values, estimated_alpha, of_base_oil
from ehlectric.cases.oils.laws import LAWS
from ehlectric.cases.oils.properties import Properties
from ehlectric.errors import InputError, ResultWarning
from ehlectric.lubricant.density import DENSITY_LAWS
from ehlectric.lubricant.law import Law
from ehlectric.lubricant.oil import BoundLaw, OfDensity, Oil, RangeCheck
from ehlectric.lubricant.permittivity import PERMITTIVITY_LAWS
from ehlectric.lubricant.temperature import Walther, density, interpolated
from ehlectric.lubricant.thermal_conductivity import constant_thermal_conductivity
from ehlectric.lubricant.viscosity import VISCOSITY_LAWS

# Difference of temperatures over which the slope of the viscosity is taken [K].
_STEP = 1e-3

CELSIUS = 273.15


@contextmanager
def of_table(temperature: str) -> Iterator[None]:
    """Context in which errors about the temperature get its key, and others the table ``lubricant``."""
    try:
        yield
    except InputError as error:
        if error.key == "temperature":
            raise error.retold(temperature, error.text) from None
        raise error.under("lubricant") from None


def oil_at(oil: Properties, temperature: float | None, key: str) -> Oil:
    """Oil at a temperature [K], or at that of its contact if none is given; see ``Lubricant.at``."""
    with of_table(key):
        check_range(oil, temperature)
        viscosity, density_of = viscosity_at(oil, temperature), density_at(oil, temperature)
        permittivity = permittivity_at(oil, temperature)
        known = {"relative_permittivity": permittivity}
        if density_of is not None:
            known["density"] = density_of
        names = law_names(oil)
        laws = {name: bound(oil, name, temperature, viscosity, known) for name in names}
        for name in ("viscosity_law", "density_law"):
            # A law that has no value at the temperature says so here, with the key of the temperature.
            laws[name](np.zeros(1))
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
            checks=tuple(_checks(oil, names, viscosity, temperature)),
            inputs=oil.model_dump(mode="json", exclude_none=True),
            name=oil.base or "",
            temperature=temperature,
            density=density_of,
            conductivity=conductivity_at(oil, temperature, laws.get("conductivity_law")),
            conductivity_over=conductivity_over(oil, laws.get("conductivity_law")),
        )


def law_names(oil: Properties) -> dict[str, str]:
    """Names of the laws of an oil, by the keys of ``LAWS``."""
    names = {key: oil.law(key) for key in LAWS}
    return {key: name for key, name in names.items() if name is not None}


def bound(
    oil: Properties, key: str, temperature: float | None, viscosity: float, known: Mapping[str, float]
) -> BoundLaw:
    """Law of an oil for a key of ``LAWS``, with its parameters at a temperature [K].

    Parameters
    ----------
    oil : Properties
        Table of the oil, with all parameters of this law.
    key : str
        Key of ``LAWS`` for which the oil has a law.
    temperature : float or None
        Temperature [K]; None if there is none.
    viscosity : float
        Viscosity of the oil at zero pressure and this temperature [Pa s].
    known : mapping
        Parameters that are known at the temperature, SI units, which replace those of the table.

    Raises
    ------
    InputError
        If the law needs a temperature and gets none.
    """
    name = oil.law(key)
    assert name is not None
    law = LAWS[key][name]
    if law.needs_temperature:
        _needs(temperature, f"{key} {name!r}")
    values = _parameters(oil, law, viscosity, temperature)
    own = {parameter.name for parameter in law.parameters}
    values |= {name: value for name, value in known.items() if name in own}
    return BoundLaw(law.function, values, temperature)


def sheet_conductivity(oil: Properties) -> BoundLaw | None:
    """Thermal conductivity of a data sheet, which is constant; None if there is none."""
    value = None if oil.temperature is None else oil.temperature.thermal_conductivity
    return None if value is None else BoundLaw(constant_thermal_conductivity, {"thermal_conductivity": value})


def conductivity_at(oil: Properties, temperature: float | None, law: BoundLaw | None) -> float | None:
    """Electrical conductivity at a temperature [S/m], by the table or the law of an oil; None without one."""
    table = oil.conductivity_table
    if table is not None:
        at = _needs(temperature, "lubricant.conductivity_table")
        name = "lubricant.conductivity_table"
        return float(interpolated(at, table.temperature, table.conductivity, table=name, arrhenius=True))
    return None if law is None else float(law.function(temperature, **law.parameters))


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


def _needs(temperature: float | None, what: str) -> float:
    """Temperature, which is needed for something.

    Raises
    ------
    InputError
        If there is none.
    """
    if temperature is None:
        raise InputError.worded("temperature", f"missing; {what} needs it", takes="a temperature")
    return temperature


def check_range(oil: Properties, temperature: float | None) -> None:
    """Refuse a temperature outside the range for which the data of the oil hold."""
    if temperature is None or oil.temperature_range is None:
        return
    low, high = oil.temperature_range
    if not low <= temperature <= high:
        whose = f"{oil.base!r}" if oil.base else "the oil"
        raise InputError(
            "temperature",
            got=f"{temperature - CELSIUS:.4g} degC",
            takes=f"{low - CELSIUS:.4g} to {high - CELSIUS:.4g} degC, for which the laws of {whose} hold "
            "(lubricant.temperature_range)",
        )


def viscosity_at(oil: Properties, temperature: float | None) -> float:
    """Viscosity of an oil at zero pressure and a temperature [K], in Pa s.

    Raises
    ------
    InputError
        If the viscosity depends on a temperature that is not given, or has no value at it.
    """
    law = viscosity_over_temperature(oil)
    if law is None:
        assert oil.viscosity is not None
        return oil.viscosity
    return law(_needs(temperature, "the viscosity of the oil"))


def viscosity_over_temperature(oil: Properties) -> Callable[[float], float] | None:
    """Viscosity at zero pressure [Pa s] as a function of temperature [K]; None for a given viscosity."""
    own = VISCOSITY_LAWS[oil.viscosity_law]
    if own.atmospheric is not None:
        return lambda at: float(own.atmospheric(at, **_given(oil, own)))  # type: ignore[misc]
    if oil.atmospheric_law is not None:
        law = LAWS["atmospheric_law"][oil.atmospheric_law]
        return lambda at: float(law.function(at, **_given(oil, law)))
    sheet = oil.temperature
    if sheet is not None:
        walther = Walther.of(sheet.at_40(), sheet.at_100())
        return lambda at: walther.viscosity(at) * density(sheet.density_15, sheet.expansion, at)
    return None


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


def temperature_coefficient(oil: Properties, temperature: float) -> float | None:
    """Temperature coefficient of the viscosity, -d ln(eta)/dT [1/K]; None for a given viscosity."""
    law = viscosity_over_temperature(oil)
    if law is None:
        return None
    return math.log(law(temperature - _STEP) / law(temperature + _STEP)) / (2.0 * _STEP)


def density_at(oil: Properties, temperature: float | None) -> float | None:
    """Density of an oil at zero pressure and a temperature [K], in kg/m^3; None if it is not known.

    A density without a reference temperature or without an expansion is that at the temperature.
    """
    if oil.temperature is not None and temperature is not None:
        return density(oil.temperature.density_15, oil.temperature.expansion, temperature)
    ratio = density_over_reference(oil, temperature)
    return None if oil.density is None else oil.density * (1.0 if ratio is None else ratio)


def density_over_reference(oil: Properties, temperature: float | None) -> float | None:
    """Density at zero pressure over that at the reference temperature; None if it is not known."""
    if temperature is None or oil.reference_temperature is None:
        return None
    difference = temperature - oil.reference_temperature
    by_law = DENSITY_LAWS[oil.density_law].thermal_expansion
    if by_law is not None:
        return 1.0 / (1.0 + (oil.parameter(by_law) or 0.0) * difference)
    return None if oil.thermal_expansion is None else 1.0 - oil.thermal_expansion * difference


def _given(oil: Properties, law: Law) -> dict[str, float]:
    """Values of those parameters of a law that the table gives, by name, SI units."""
    values = {parameter.name: oil.parameter(parameter.name) for parameter in law.parameters}
    return {name: value for name, value in values.items() if value is not None}


def _parameters(oil: Properties, law: Law, viscosity: float, temperature: float | None) -> dict[str, float]:
    """Parameters of a law at a temperature [K] at which the oil has this viscosity [Pa s].

    Those that the table lacks follow from the viscosity, or from the type of base oil. Those that it gives
    for the reference temperature change with the viscosity as the relation between them says.
    """
    own = {parameter.name for parameter in law.parameters}
    follows = own & of_base_oil(oil)
    estimated = base_oil_values(oil, viscosity, temperature) if follows else {}
    values = {name: value for name, value in estimated.items() if name in own} | _given(oil, law)
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
            values[parameter.name] *= rule.function(viscosity, *of) / rule.function(oil.viscosity, *of)
    return values


def permittivity_at(oil: Properties, temperature: float | None) -> float:
    """Relative permittivity at zero pressure and a temperature [K]."""
    table = oil.permittivity_table
    if table is not None:
        at = _needs(temperature, "lubricant.permittivity_table")
        name = "lubricant.permittivity_table"
        return float(interpolated(at, table.temperature, table.relative_permittivity, table=name))
    assert oil.relative_permittivity is not None
    ratio = density_over_reference(oil, temperature)
    if ratio is None:
        return oil.relative_permittivity
    law = PERMITTIVITY_LAWS[oil.permittivity_law]
    return float(law.function(ratio, temperature, **_given(oil, law)))


def _checks(
    oil: Properties, names: Iterable[str], viscosity: float, temperature: float | None
) -> Iterator[Callable[[float], Iterator[ResultWarning]]]:
    """Checks of the ranges of those laws that have one, and the estimate of a coefficient."""
    estimate = estimated_alpha(oil, temperature)
    if estimate is not None:
        yield estimate
    for key in names:
        check = range_check(oil, key, temperature, viscosity)
        if check is not None:
            yield check


def range_check(oil: Properties, key: str, temperature: float | None, viscosity: float) -> RangeCheck | None:
    """Check of the range of a law, for a key of ``LAWS``; None if the law has no range."""
    name = oil.law(key)
    assert name is not None
    law = LAWS[key][name]
    if law.warnings is None:
        return None
    parameters = _parameters(oil, law, viscosity, temperature)
    return RangeCheck(law.warnings, viscosity, parameters, temperature, key.removesuffix("_law"))
