"""Description of a lubricant law: its function, its parameters, and warnings about its range.

A law of viscosity or density is ``law(pressure, temperature, *, parameters...) -> (value, derivative by
pressure)``. A law of permittivity is ``law(density_ratio, temperature, *, parameters...) -> value``. The
temperature [K] broadcasts with the first argument. Without a temperature, a law returns its value at the
temperature for which the case gives the parameters. An isothermal law always does so, in the shape of the
first argument.

To add a law, write its function and add a ``Law`` to the table of its module: ``VISCOSITY_LAWS``,
``DENSITY_LAWS`` or ``PERMITTIVITY_LAWS``. Add a ``Parameter`` to that entry for each new parameter. Nothing
else needs an edit: the keys of ``[lubricant]``, their bounds and messages, the labels of figures and the
table of keys in the documentation are all read from these tables.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import ResultWarning


class PressureLaw(Protocol):
    """Law of viscosity or density with fixed parameters, as a function of pressure and temperature."""

    def __call__(self, pressure: ArrayLike, temperature: ArrayLike | None = None, /) -> tuple[Array, Array]:
        """Value of the law and its derivative by pressure [1/Pa] at a pressure [Pa] and a temperature [K].

        The value is dimensionless: the density ratio, or the logarithm of the relative viscosity.
        """
        ...


class DensityRatioLaw(Protocol):
    """Law of permittivity with fixed parameters, as a function of density ratio and temperature."""

    def __call__(self, density_ratio: ArrayLike, temperature: ArrayLike | None = None, /) -> Array:
        """Relative permittivity, dimensionless, at a density ratio, dimensionless, and a temperature [K]."""
        ...


@dataclass(frozen=True)
class Derivation:
    """Relation that gives a parameter of a law from the viscosity eta0 [Pa s] and other parameters.

    Attributes
    ----------
    function : callable
        ``function(viscosity, *values)`` returns the value of the parameter in SI units.
    parameters : tuple of str
        Names of the other parameters, in the order of ``values``.
    """

    function: Callable[..., float]
    parameters: tuple[str, ...]


@dataclass(frozen=True)
class Parameter:
    """Parameter of a lubricant law: a key of ``[lubricant]`` with its unit, bounds and labels.

    Attributes
    ----------
    name : str
        Key of the case file, and keyword argument of the law's function.
    unit : str
        SI unit in the notation of pint; empty for a dimensionless parameter.
    meaning : str
        One sentence for the table of keys in the documentation, in Markdown.
    title, symbol : str
        Name and symbol on the axis of a figure. Without a title the axis shows the dotted key.
    least, most : float
        Smallest and largest allowed values in ``unit``.
    above, below : float
        Bounds in ``unit`` that are not allowed themselves.
    reason : str
        Reason for the bounds.
    derivation : Derivation, optional
        For a parameter that changes with temperature: the relation that gives its value at the temperature of
        a bearing, if the bearing file does not contain it.

    Examples
    --------
    >>> limit = Parameter("limiting_stress", "Pa", "of the oil", least=1e5, most=1e9)
    >>> limit.unit, limit.above
    ('Pa', -inf)
    """

    name: str
    unit: str
    meaning: str
    title: str = ""
    symbol: str = ""
    least: float = -math.inf
    most: float = math.inf
    above: float = -math.inf
    below: float = math.inf
    reason: str = ""
    derivation: Derivation | None = None


@dataclass(frozen=True)
class Law:
    """Law of the lubricant, an entry of the table of its module.

    Attributes
    ----------
    function : callable
        Function of the law; its keyword arguments are the names of the parameters.
    parameters : tuple of Parameter
        Parameters that the case must give.
    warnings : callable, optional
        ``warnings(max_pressure, viscosity, **parameters)`` yields a ``ResultWarning`` for each reason not to
        trust the law in a contact with this Hertz pressure [Pa] and viscosity eta0 [Pa s].
    hint : callable, optional
        ``hint(viscosity, given)`` returns a text for the end of the error message about missing parameters.
        ``given`` has the values of the parameters in the case, by name.

    Examples
    --------
    >>> Law(lambda pressure, temperature=None: (0.0, 0.0)).parameters
    ()
    """

    function: Callable[..., Any]
    parameters: tuple[Parameter, ...] = ()
    warnings: Callable[..., Iterator[ResultWarning]] | None = None
    hint: Callable[[float, Mapping[str, float]], str] | None = None
