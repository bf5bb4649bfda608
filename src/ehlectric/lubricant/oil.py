"""Oil at one temperature, or at the temperature of each of many points: its numbers, and its laws over
pressure.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Mask, Numbers, as_float
from ehlectric.lubricant.law import PressureLaw, is_many
from ehlectric.lubricant.viscosity import initial_alpha, reciprocal_asymptotic_alpha, unfinished_share
from ehlectric.quantities.result_warnings import ResultWarning

# What the laws of an oil describe, in the order of files.
LAW_NAMES = (
    *("atmospheric", "viscosity", "density", "permittivity", "conductivity"),
    *("thermal_conductivity", "heat_capacity", "strength"),
)

# Share of the integral of alpha* beyond its end above which a warning reports that it has no definite value.
_UNFINISHED = 0.01

# Permittivity as a function of pressure [Pa] and density ratio.
Permittivity = Callable[[ArrayLike, ArrayLike], Array]


@dataclass(frozen=True)
class BoundLaw:
    """Law with the parameters of an oil, at the temperature of the oil unless another one is given.

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> law = BoundLaw(barus, {"pressure_viscosity_coefficient": 2e-8}, 313.15)
    >>> float(law(1e9)[0])
    20.0
    """

    function: Callable[..., Any]
    parameters: Mapping[str, Numbers]  # values of its parameters by name, SI units
    temperature: Numbers | None = None  # temperature of the oil [K]; None if the case gives none

    @property
    def many(self) -> bool:
        """Whether the law has parameters or temperatures of many points."""
        return is_many(self.temperature, *self.parameters.values())

    def __call__(self, argument: ArrayLike, temperature: ArrayLike | None = None, /) -> Any:
        """Value of the law at a pressure [Pa] or a density ratio, and at a temperature [K]."""
        at = self.temperature if temperature is None else temperature
        return self.function(argument, at, **self.parameters)


@dataclass(frozen=True)
class OfDensity:
    """Permittivity of a law over density ratio, as a function of pressure and density ratio."""

    law: Callable[[ArrayLike], Array]  # relative permittivity as a function of the density ratio

    def __call__(self, pressure: ArrayLike, density_ratio: ArrayLike) -> Array:  # noqa: ARG002
        """Relative permittivity at a density ratio; the pressure acts only through it."""
        return self.law(density_ratio)


class LawCheck(Protocol):
    """Check of a law in contacts."""

    def __call__(self, max_pressure: float) -> Iterator[ResultWarning]:
        """Warnings about the law in a contact with this Hertz pressure [Pa]."""

    def codes(self, max_pressure: Array) -> Iterator[tuple[int, str]]:
        """Places of many points and the codes of their warnings, at Hertz pressures [Pa], shape (n,)."""


@dataclass(frozen=True)
class RangeCheck:
    """Check of a law's range in a contact, with the parameters of an oil."""

    function: Callable[..., Iterator[ResultWarning]]
    viscosity: Numbers  # viscosity of the oil at zero pressure [Pa s]
    parameters: Mapping[str, Numbers]  # values of the parameters by name, SI units
    temperature: Numbers | None = None  # temperature of the oil [K]; None if the case gives none
    of: str = ""  # what the law describes, one of ``LAW_NAMES``

    def __call__(self, max_pressure: float) -> Iterator[ResultWarning]:
        """Warnings about the law in a contact with this Hertz pressure [Pa]."""
        yield from self.function(max_pressure, self.viscosity, self.temperature, **self.parameters)

    def codes(self, max_pressure: Array) -> Iterator[tuple[int, str]]:
        """Places of many points and the codes of their warnings, at their Hertz pressures [Pa], shape (n,).

        The functions make texts of one point; a call for each point takes some microseconds.
        """

        def column(values: Numbers | None) -> list[Any]:
            if values is None:
                return [None] * max_pressure.size
            row: list[Any] = np.broadcast_to(values, max_pressure.shape).tolist()
            return row

        names, columns = list(self.parameters), [column(values) for values in self.parameters.values()]
        points = zip(
            max_pressure.tolist(), column(self.viscosity), column(self.temperature), *columns, strict=True
        )
        for place, (pressure, viscosity, temperature, *values) in enumerate(points):
            parameters = dict(zip(names, values, strict=True))
            for warning in self.function(pressure, viscosity, temperature, **parameters):
                yield place, warning.code


@dataclass(frozen=True, eq=False)
class Oil:
    """Oil at one temperature, or at many points with their temperatures and properties.

    Numbers of the oil are floats, or arrays of shape (n,) of n points; those that do not differ between
    points may stay floats. The points are the last axis of the pressures and density ratios that the laws of
    many points take. A point at which the oil has no value has NaN for its viscosity and its laws.

    Examples
    --------
    >>> from ehlectric.lubricant.density import incompressible
    >>> from ehlectric.lubricant.electrical_laws import constant_permittivity
    >>> from ehlectric.lubricant.viscosity import barus
    >>> eps = OfDensity(BoundLaw(constant_permittivity, {"relative_permittivity": 2.2}))
    >>> law = BoundLaw(barus, {"pressure_viscosity_coefficient": 2e-8})
    >>> oil = Oil(0.04, 2.2, 1e5, law, BoundLaw(incompressible, {}), eps)
    >>> oil.alpha, round(oil.alpha_star * 1e9, 6)
    (2e-08, 20.0)
    """

    viscosity: Numbers  # viscosity eta0 at zero pressure [Pa s]
    relative_permittivity: Numbers  # relative permittivity at zero pressure, dimensionless
    ambient_pressure: float  # pressure around the contact [Pa]
    # ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa].
    log_viscosity: PressureLaw
    # Density divided by the density at zero pressure, and its derivative [1/Pa], as a function of the
    # pressure [Pa].
    density_ratio: PressureLaw
    # Relative permittivity as a function of the pressure [Pa] and of the density ratio.
    permittivity: Permittivity
    # Names of the laws by "viscosity", "density", "permittivity" and others that the oil has.
    laws: Mapping[str, str] = field(default_factory=dict)
    # Checks of the laws' ranges: each yields warnings about a contact with a Hertz pressure [Pa].
    checks: tuple[LawCheck, ...] = ()
    # Checks that yield warnings about a solved film with a maximum pressure [Pa].
    film_checks: tuple[Callable[[float], Iterator[ResultWarning]], ...] = ()
    # Keys of the case from which the oil is made, SI units, for files.
    inputs: Mapping[str, Any] = field(default_factory=dict)
    name: str = ""  # name of the oil in the library; empty for an oil of the user's own
    temperature: Numbers | None = None  # temperature [K]; None if the case gives none
    # density and conductivity: density [kg/m^3] and electrical conductivity [S/m] at zero pressure; None
    # where they are not known.
    density: Numbers | None = None
    conductivity: Numbers | None = None
    # Electrical conductivity [S/m] as a function of the temperature [K]; None where it is not known.
    conductivity_over: Callable[[Array], Array] | None = None
    # thermal_conductivity_law and heat_capacity_law: thermal conductivity [W/(m K)] and volumetric heat
    # capacity [J/(m^3 K)], each with its derivative by pressure, as functions of the pressure [Pa]; None
    # where they are not known.
    thermal_conductivity_law: PressureLaw | None = None
    heat_capacity_law: PressureLaw | None = None

    @property
    def refused(self) -> Mask:
        """Points at which the oil has no value at its temperature, shape (...); ``case_oil.refusals`` has the
        error of each.
        """
        return np.asarray(np.isnan(self.viscosity))

    def warnings(self, max_pressure: float) -> Iterator[ResultWarning]:
        """Warnings about the laws in a contact with this Hertz pressure [Pa]."""
        for check in self.checks:
            yield from check(max_pressure)
        if unfinished_share(self.log_viscosity) > _UNFINISHED:
            yield ResultWarning.of("law-range", "no_alpha_star", law=self.laws.get("viscosity", ""))

    def codes(self, max_pressure: Array) -> Iterator[tuple[str, Mask]]:
        """Codes of the warnings about the laws at many points, and which points have them, shape (n,).

        ``max_pressure``, Hertz pressures of the points [Pa], shape (n,).
        """
        for check in self.checks:
            masks: dict[str, Mask] = {}
            for place, code in check.codes(max_pressure):
                masks.setdefault(code, np.zeros(max_pressure.shape, dtype=bool))[place] = True
            yield from masks.items()
        yield "law-range", np.asarray(unfinished_share(self.log_viscosity) > _UNFINISHED)

    @cached_property
    def alpha(self) -> Numbers:
        """Pressure-viscosity coefficient alpha, the slope of ln(eta) at zero pressure [1/Pa]."""
        return initial_alpha(self.log_viscosity)

    @cached_property
    def alpha_star(self) -> Numbers:
        """Reciprocal asymptotic pressure-viscosity coefficient alpha* [1/Pa]; film formulas take it."""
        return reciprocal_asymptotic_alpha(self.log_viscosity)

    def summary(self) -> dict[str, Any]:
        """Numbers of the oil at zero pressure, SI units, and names of its laws, for summary.json."""
        return {
            "name": self.name or None,
            "temperature": self.temperature,
            "viscosity": self.viscosity,
            "pressure_viscosity_coefficient": self.alpha,
            "alpha_star": self.alpha_star,
            "density": self.density,
            "relative_permittivity": self.relative_permittivity,
            "conductivity": self.conductivity,
            "laws": {name: self.laws.get(name) for name in LAW_NAMES},
        }

    @property
    def thermal_conductivity(self) -> Numbers | None:
        """Thermal conductivity at zero pressure [W/(m K)]; None where it is not known."""
        return None if self.thermal_conductivity_law is None else _at_zero(self.thermal_conductivity_law)

    @property
    def heat_capacity(self) -> Numbers | None:
        """Volumetric heat capacity at zero pressure [J/(m^3 K)]; None where it is not known."""
        return None if self.heat_capacity_law is None else _at_zero(self.heat_capacity_law)


def _at_zero(law: PressureLaw) -> Numbers:
    return as_float(law(np.zeros(()))[0])
