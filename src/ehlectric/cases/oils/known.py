"""Oil at a temperature as far as its table goes: each property by itself, and those that are missing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import TypeVar

import numpy as np
from scipy.optimize import bisect

from ehlectric.cases.oils.checks import check_parameters, check_viscosity
from ehlectric.cases.oils.estimates import estimated_alpha
from ehlectric.cases.oils.laws import LAWS
from ehlectric.cases.oils.properties import Properties
from ehlectric.cases.oils.resolution import (
    bound,
    check_range,
    conductivity_at,
    density_at,
    law_names,
    of_table,
    permittivity_at,
    range_check,
    sheet_conductivity,
    viscosity_at,
)
from ehlectric.errors import InputError, ResultWarning
from ehlectric.lubricant.alpha import initial_alpha, reciprocal_asymptotic_alpha
from ehlectric.lubricant.oil import BoundLaw, RangeCheck

T = TypeVar("T")

# Largest pressure at which the end of a law's range is sought [Pa], and the error of the answer [Pa].
_HIGHEST, _CLOSE = 1e11, 1.0


@dataclass(frozen=True, eq=False)
class KnownOil:
    """Oil at one temperature as far as its table goes.

    An oil of which a value is missing cannot be solved with. Its other properties are computed here all the
    same, and no value takes the place of the missing one.

    Attributes
    ----------
    table : Properties
        Table of the oil.
    temperature : float or None
        Temperature [K]; None for an oil without temperature.
    viscosity, density, relative_permittivity, conductivity : float or None
        Viscosity [Pa s], density [kg/m^3], relative permittivity and electrical conductivity [S/m] at zero
        pressure; None where they are not known.
    laws : mapping of str to BoundLaw
        Laws of which all parameters are known, by key of ``LAWS``.
    checks : mapping of str to RangeCheck
        Checks of the ranges of these laws, by key of ``LAWS``.
    missing : mapping of str to InputError
        Errors of the values that are missing, by dotted key.

    Examples
    --------
    >>> oil = known_oil(Properties.from_dict({"base": "n100"}), 313.15)
    >>> round(oil.viscosity, 4), round(oil.alpha_star * 1e9, 1), oil.relative_permittivity
    (0.0867, 27.3, None)
    >>> print(*oil.missing.values())  # doctest: +ELLIPSIS
    lubricant.relative_permittivity: missing; permittivity_law 'clausius-mossotti' needs it; the library ...
    """

    table: Properties
    temperature: float | None
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
        return None if law is None else initial_alpha(law)

    @cached_property
    def alpha_star(self) -> float | None:
        """Reciprocal asymptotic pressure-viscosity coefficient [1/Pa]; None where it is not known."""
        law = self.laws.get("viscosity_law")
        return None if law is None else reciprocal_asymptotic_alpha(law)

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
        return float(bisect(lambda pressure: _beyond(check, pressure) - 0.5, 0.0, _HIGHEST, xtol=_CLOSE))


def _beyond(check: RangeCheck, pressure: float) -> bool:
    return any(warning.code == "law-range" for warning in check(pressure))


def known_oil(table: Properties, temperature: float | None, key: str = "temperature") -> KnownOil:
    """Oil at a temperature as far as its table goes.

    Parameters
    ----------
    table : Properties
        Table of the oil. Values may be missing.
    temperature : float or None
        Absolute temperature [K]; None for an oil whose values hold at the temperature of its contact.
    key : str, optional
        Key of the temperature, for messages.

    Returns
    -------
    KnownOil
        Properties that are known, and errors of the values that are missing.

    Raises
    ------
    InputError
        If a temperature is needed and missing, or outside the range of the oil or of a law, or if the table
        contradicts itself.
    """
    with of_table(key):
        check_range(table, temperature)
        found = _Found(table, temperature)
        viscosity = found.value(found.viscosity)
        density, permittivity = density_at(table, temperature), found.value(found.permittivity)
        known = {"density": density, "relative_permittivity": permittivity}
        values = {name: value for name, value in known.items() if value is not None}
        laws = dict(found.laws(viscosity, values))
        # Only laws of viscosity depend on the viscosity.
        at = math.nan if viscosity is None else viscosity
        checks = {name: range_check(table, name, temperature, at) for name in laws}
        sheet = sheet_conductivity(table)
        if sheet is not None:
            laws.setdefault("thermal_conductivity_law", sheet)
        conductivity = conductivity_at(table, temperature, laws.get("conductivity_law"))
    return KnownOil(
        table,
        temperature,
        viscosity,
        density,
        permittivity,
        conductivity,
        laws,
        {name: check for name, check in checks.items() if check is not None},
        found.missing,
    )


@dataclass(frozen=True)
class _Found:
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
        return viscosity_at(self.table, self.temperature)

    def permittivity(self) -> float:
        """Relative permittivity at zero pressure."""
        self.complete("permittivity_law")
        return permittivity_at(self.table, self.temperature)

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
                # A law that has no value at the temperature says so here.
                law(np.zeros(1))
            yield choice, law
