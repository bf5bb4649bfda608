"""Law of the lubricant: a function chosen by its name, and the parameters it takes as data.

A law of pressure is ``law(pressure, temperature, *, parameters...) -> (value, derivative by pressure)``; a
law of the permittivity is ``law(density_ratio, temperature, *, parameters...) -> value``. The temperature [K]
broadcasts with the first argument. Without one, a law gives its value at the temperature for which the case
states its parameters; an isothermal law always does so, in the shape of the first argument.

To add a law, write its function and enter it in the table of its module: ``VISCOSITY_LAWS``,
``DENSITY_LAWS`` or ``PERMITTIVITY_LAWS``. A parameter that is new is a ``Parameter`` in that entry. The keys
of ``[lubricant]``, with their bounds and messages, are read from these tables whenever a case is read, and so
are the labels of figures and the table of keys in the documentation; nothing else is to be edited.
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
    """A law of pressure with the values of its parameters."""

    def __call__(self, pressure: ArrayLike, temperature: ArrayLike | None = None, /) -> tuple[Array, Array]:
        """Value, dimensionless, and derivative by pressure [1/Pa], at pressure [Pa] and temperature [K]."""
        ...


class DensityRatioLaw(Protocol):
    """A law of the density ratio with the values of its parameters."""

    def __call__(self, density_ratio: ArrayLike, temperature: ArrayLike | None = None, /) -> Array:
        """Value, dimensionless, at a density ratio, dimensionless, and a temperature [K]."""
        ...


@dataclass(frozen=True)
class Derivation:
    """How a parameter follows from the viscosity eta0 [Pa s] and other parameters.

    Attributes
    ----------
    function : callable
        ``function(viscosity, *values)``, the value of the parameter, SI.
    parameters : tuple of str
        Names of the other parameters.
    """

    function: Callable[..., float]
    parameters: tuple[str, ...]


@dataclass(frozen=True)
class Parameter:
    """Parameter of a law: a key of ``[lubricant]`` with its unit, its bounds and its texts.

    Attributes
    ----------
    name : str
        Key of the case file, and keyword of the law's function.
    unit : str
        SI unit as pint writes it; empty where there is none.
    meaning : str
        One sentence for the table of keys, in Markdown.
    title, symbol : str
        Name and symbol on the axis of a figure; the dotted key stands there without a title.
    least, most, above, below : float
        Bounds in ``unit``; ``above`` and ``below`` are not allowed themselves.
    reason : str
        Why the bounds are there.
    derivation : Derivation, optional
        For a parameter that changes with temperature: how a bearing's lubricant computes it at the
        bearing's temperature where the file does not give it.

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
    """A law of the lubricant as its module's table holds it.

    Attributes
    ----------
    function : callable
        The law; its keywords are the names of the parameters.
    parameters : tuple of Parameter
        What the case gives for it.
    warnings : callable, optional
        ``warnings(max_pressure, viscosity, **parameters)`` yields a ``ResultWarning`` for each reason not to
        trust the law in a contact of that Hertz pressure [Pa] and that viscosity eta0 [Pa s].
    hint : callable, optional
        ``hint(viscosity, given)`` returns what the message on a missing parameter adds at its end; ``given``
        holds the values of the law's parameters by name, without those that are missing.

    Examples
    --------
    >>> Law(lambda pressure, temperature=None: (0.0, 0.0)).parameters
    ()
    """

    function: Callable[..., Any]
    parameters: tuple[Parameter, ...] = ()
    warnings: Callable[..., Iterator[ResultWarning]] | None = None
    hint: Callable[[float, Mapping[str, float]], str] | None = None
