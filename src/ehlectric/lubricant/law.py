"""Description of a lubricant law: its function, its parameters, and warnings about its range and the glass
transition.

A law of viscosity, density, thermal conductivity or heat capacity is ``law(pressure, temperature, *,
parameters...) -> (value, derivative by pressure)``. A law of permittivity is ``law(density_ratio,
temperature, *, parameters...) -> value``. A law at ambient pressure, of viscosity or electrical conductivity,
is ``law(temperature, *, parameters...) -> value``. The temperature [K] broadcasts with the first argument,
and so do the parameters: they are floats, or arrays of shape (n,) of n points, which are the last axis.
Without a temperature, a law returns its value at the temperature for which the case gives the parameters. An
isothermal law always does so, in the shape of the first argument. A law that changes with temperature raises
``InputError`` without one. A temperature of NaN marks a point that was refused before: the law has
NaN there, and no error.

To add a law, write its function and add a ``Law`` to the table of its module: ``VISCOSITY_LAWS``,
``ATMOSPHERIC_LAWS``, ``DENSITY_LAWS``, ``PERMITTIVITY_LAWS``, ``CONDUCTIVITY_LAWS``,
``THERMAL_CONDUCTIVITY_LAWS`` or ``HEAT_CAPACITY_LAWS``. Add a line to ``parameters.toml`` for each new
parameter, or give the entry a ``Parameter``. Nothing else needs an edit: the keys of ``[lubricant]``, their
bounds and messages, the labels of figures and the table of keys in the documentation are read from these
tables. A function that does not take arrays of parameters and temperatures is called for one point after the
other with ``numpy.vectorize`` where many points are computed at once, which takes some microseconds for each
pressure and point. A law without values at some temperatures reports this by ``Law.holds``; an error of its
function applies to all points.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from inspect import signature
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Mask, Numbers
from ehlectric.errors import InputError
from ehlectric.quantities.quantity import Bounds, Quantity, data_file
from ehlectric.quantities.result_warnings import ResultWarning


class PressureLaw(Protocol):
    """Law of viscosity or density with fixed parameters, as a function of pressure and temperature."""

    def __call__(self, pressure: ArrayLike, temperature: ArrayLike | None = None, /) -> tuple[Array, Array]:
        """Value of the law and its derivative by pressure [1/Pa] at a pressure [Pa] and a temperature [K].

        The value is dimensionless: the density ratio, or the logarithm of the relative viscosity.
        """
        ...


@dataclass(frozen=True)
class Derivation:
    """Relation that gives a parameter of a law from the viscosity eta0 [Pa s] and other parameters."""

    # ``function(viscosity, *values)`` returns the value of the parameter in SI units.
    function: Callable[..., Numbers]
    parameters: tuple[str, ...]


@dataclass(frozen=True)
class Parameter(Bounds):
    """Parameter of a lubricant law: a key of ``[lubricant]`` with its unit, bounds and labels.

    Examples
    --------
    >>> limit = Parameter("limiting_stress", "Pa", "of the oil", least=1e5, most=1e9)
    >>> limit.unit, limit.above
    ('Pa', -inf)
    """

    name: str  # key of the case file, and keyword argument of the law's function
    unit: str  # SI unit in the notation of pint; empty for a dimensionless parameter
    meaning: str = ""  # one sentence for the table of keys in the documentation, in Markdown
    # title and symbol: name and symbol on the axis of a figure.
    title: str = ""
    symbol: str = ""
    # For a parameter that changes with temperature: the relation that gives its value at the temperature of a
    # bearing, if the bearing file does not contain it.
    derivation: Derivation | None = None

    @property
    def quantity(self) -> Quantity:
        """Meaning, unit, label and symbol of the parameter."""
        shown = "°C" if self.unit == "K" and not self.difference else ""
        label = self.title or self.name.replace("_", " ")
        return Quantity(self.meaning, self.unit, label, self.symbol, shown=shown)


@cache
def _parameters() -> dict[str, Parameter]:
    """Parameters of ``parameters.toml`` by their names."""
    entries = data_file("ehlectric.lubricant", "parameters.toml")
    return {name: Parameter(name, **entry) for name, entry in entries.items()}


def parameter(name: str) -> Parameter:
    """Parameter of ``parameters.toml`` by its name."""
    return _parameters()[name]


def parameters_of(*functions: Callable[..., Any]) -> tuple[Parameter, ...]:
    """Parameters of a law: arguments by keyword of its function, and of those to which it passes others."""
    arguments = (argument for function in functions for argument in signature(function).parameters.values())
    return tuple(parameter(argument.name) for argument in arguments if argument.kind is argument.KEYWORD_ONLY)


@dataclass(frozen=True)
class Law:
    """Law of the lubricant, an entry of the table of its module.

    Examples
    --------
    >>> Law(lambda pressure, temperature=None: (0.0, 0.0)).parameters
    ()
    """

    function: Callable[..., Any]  # function of the law; its keyword arguments are the names of the parameters
    parameters: tuple[Parameter, ...] = ()  # parameters that the case must give
    # ``warnings(max_pressure, viscosity, temperature, **parameters)`` yields a ``ResultWarning`` for each
    # reason not to trust the law in a contact with this Hertz pressure [Pa], viscosity eta0 [Pa s] and
    # temperature [K]. The temperature is None where the case gives none.
    warnings: Callable[..., Iterator[ResultWarning]] | None = None
    # ``hint(viscosity, given)`` returns a text for the end of the error message about missing parameters.
    hint: Callable[[Numbers, Mapping[str, Numbers]], str] | None = None
    needs_temperature: bool = False
    # ``holds(temperature, **parameters)`` returns for each point whether the law has a value at its
    # temperature [K]; None for a law that has one at all temperatures.
    holds: Callable[..., Mask] | None = None
    # ``atmospheric(temperature, **parameters)`` returns the viscosity eta0 [Pa s] at zero pressure and a
    # temperature [K], for a viscosity law that has one of its own.
    atmospheric: Callable[..., Array] | None = None
    # Name of the parameter of a density law that is the thermal expansion of the volume at zero pressure.
    thermal_expansion: str | None = None


def is_many(*values: Any) -> bool:
    """Whether one of some numbers is an array of many points.

    Examples
    --------
    >>> is_many(1.0, None), is_many(1.0, np.ones(3))
    (False, True)
    """
    return any(getattr(value, "ndim", 0) for value in values)


def same(first: Numbers | None, second: Numbers | None) -> bool:
    """Whether two numbers are equal; arrays, which are not compared, are the same object.

    Examples
    --------
    >>> same(313.15, 313.15), same(np.array([313.15]), np.array([313.15]))
    (True, False)
    """
    return first is second or (not is_many(first, second) and bool(first == second))


def over_points(function: Callable[..., Any]) -> Callable[..., Any]:
    """Function of a law for parameters and temperatures of many points. A function that takes no arrays is
    called for one point after the other.

    Examples
    --------
    >>> import math
    >>> over_points(lambda temperature, *, b: math.exp(b / temperature))(300.0, b=np.array([0.0, 300.0]))
    array([1.        , 2.71828183])
    """

    def call(*arguments: Any, **parameters: Any) -> Any:
        try:
            return function(*arguments, **parameters)
        except InputError:
            raise
        except (TypeError, ValueError):
            return np.vectorize(function)(*arguments, **parameters)

    return call


def required(temperature: ArrayLike | None, law: str) -> Array:
    """Temperature [K] that a law needs, as an array. Raises InputError if there is none.

    Examples
    --------
    >>> float(required(313.15, "viscosity_law 'yasutomi'"))
    313.15
    """
    if temperature is None:
        raise InputError.worded("temperature", f"missing; {law} needs it", takes="a temperature")
    return np.asarray(temperature, dtype=float)


def refused(values: Array, allowed: Mask, unit: str) -> str:
    """First value that a law does not allow, with its unit, for a message; empty if all are allowed or NaN.

    Examples
    --------
    >>> refused(np.array([1.0, -2.0]), np.array([True, False]), "Pa s")
    '-2 Pa s'
    """
    wrong = values[~(allowed | np.isnan(values))]
    return f"{float(wrong.flat[0]):.5g} {unit}".strip() if wrong.size else ""


def within(temperature: ArrayLike | None, law: str, least: Numbers, most: Numbers, reason: str) -> Array:
    """Temperatures [K] that a law needs, as an array. Raises InputError if there is none, or one is outside
    the range of the law, whose ends are not part of it; the message names the law and its range. Temperatures
    that are NaN are returned as they are.

    Examples
    --------
    >>> float(within(313.15, "viscosity_law 'yasutomi'", 190.0, np.inf, "its glass transition"))
    313.15
    """
    at = required(temperature, law)
    inside = np.asarray((at > least) & (at < most))
    if inside.all():
        return at
    wrong = ~(inside | np.isnan(at))
    if np.any(wrong):
        first, least, most = (np.broadcast_to(value, wrong.shape)[wrong][0] for value in (at, least, most))
        ends = [f"above {least:.5g} K"] * math.isfinite(least) + [f"below {most:.5g} K"] * math.isfinite(most)
        raise InputError(
            "temperature",
            got=f"{first:.5g} K;",
            takes=f"{' and '.join(ends)}, the range of {law}: {reason}",
        )
    return at


# Viscosity at the glass transition [Pa s], by its usual definition. An oil that is as viscous does not flow
# in the time that it spends in a contact.
GLASS_VISCOSITY = 1e12

# Largest ln(eta/eta0) of a law that does not know the viscosity eta0 at zero pressure. An oil of 1 mPa s
# reaches the glass transition at ln(1e12/1e-3) = 34.5; a thicker oil reaches it earlier.
LARGEST_EXPONENT = 35.0


def glass_warnings(law: str, max_pressure: float, cap: float, limit: str) -> Iterator[ResultWarning]:
    """Warning that the Hertz pressure of a contact exceeds the pressure at which a law is capped.
    ``max_pressure`` [Pa]; ``cap``, pressure at which the cap of the law begins [Pa]; infinite if the law has
    none.

    Examples
    --------
    >>> [warning.code for warning in glass_warnings("yasutomi", 2e9, 1.08e9, "1e12 Pa s")]
    ['law-range']
    """
    if max_pressure > cap:
        yield ResultWarning.of("law-range", "glass", cap=cap / 1e9, law=law, limit=limit)
