"""Laws of the oil that a user writes in Python: functions of pressure and temperature, sampled over
pressure.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike
from scipy.interpolate import CubicSpline

from ehlectric.arrays import Array
from ehlectric.errors import InputError, ResultWarning, short
from ehlectric.lubricant.oil import Oil

# Property as a function of pressure [Pa] and temperature [K].
Function: TypeAlias = Callable[[Array, float], ArrayLike]

# Properties that may have a law of the user's own: smallest allowed value, and unit, for messages.
_LEAST = {"viscosity": 0.0, "density": 0.0, "permittivity": 1.0, "strength": 0.0}
_UNITS = {"viscosity": "Pa s", "density": "kg/m^3", "permittivity": "", "strength": "V/m"}

# Intervals of the samples; pressures up to which a law is sampled, and up to which it must have values, over
# the Hertz pressure. The pressure spike and the iterations of the film reach beyond the Hertz pressure. The
# number of samples also keeps three laws below the 64 kB of an attribute of HDF5.
_INTERVALS, _MOST, _NEEDED = 400, 4.0, 1.5

# Of the samples of a strength, each of this number is kept.
OF_STRENGTH = 10


@dataclass(frozen=True)
class Laws:
    """Laws of a user's own, in place of those of a case.

    Attributes
    ----------
    viscosity, density, permittivity, strength : callable, optional
        Viscosity [Pa s], density [kg/m^3], relative permittivity and dielectric strength [V/m]: functions
        ``law(pressure, temperature)`` of an array of pressures [Pa] above the ambient one, and of the
        temperature of the contact [K]. They return an array of the same shape.

    Examples
    --------
    >>> def doubling(pressure, temperature):
    ...     return 0.04 * 2.0 ** (pressure / 30e6)
    >>> Laws(viscosity=doubling).names
    {'viscosity': 'doubling (Python function)'}
    """

    viscosity: Function | None = None
    density: Function | None = None
    permittivity: Function | None = None
    strength: Function | None = None

    @property
    def names(self) -> dict[str, str]:
        """Names of the functions, by property."""
        return {
            name: f"{short(getattr(law, '__name__', type(law).__name__))} (Python function)"
            for name, law in vars(self).items()
            if law is not None
        }

    def sampled(self, temperature: float | None, max_pressure: float) -> SampledLaws:
        """Laws at the temperature of a contact, sampled over pressure.

        Parameters
        ----------
        temperature : float or None
            Temperature of the contact [K].
        max_pressure : float
            Hertz pressure of the contact [Pa].

        Returns
        -------
        SampledLaws
            Values of the laws at pressures from 0 up to four times the Hertz pressure.

        Raises
        ------
        InputError
            If the temperature is missing, or a law has no valid value up to 1.5 times the Hertz pressure.
        """
        if temperature is None:
            raise InputError.worded(
                "contact.temperature", "missing; a law of your own needs it", takes="a temperature"
            )
        names = self.names
        return SampledLaws(
            {
                name: _sampled(name, names[name], getattr(self, name), temperature, max_pressure)
                for name in names
            }
        )


@dataclass(frozen=True, eq=False)
class Samples:
    """Values of a law over pressure at one temperature."""

    name: str
    # pressure and values: increasing pressures from 0 [Pa], and the values there, shape (n,).
    pressure: Array
    values: Array

    @cached_property
    def _curve(self) -> CubicSpline:
        return CubicSpline(self.pressure, np.log(self.values))

    @cached_property
    def _slope(self) -> CubicSpline:
        return self._curve.derivative()

    def log(self, pressure: ArrayLike) -> tuple[Array, Array]:
        """Logarithm of the value over that at zero pressure, and its derivative by pressure [1/Pa].

        Beyond the samples, where only iterations of a film go, the logarithm is continued by its last slope.
        """
        p = np.asarray(pressure, dtype=float)
        within = np.clip(p, 0.0, self.pressure[-1])
        slope = self._slope(within)
        value = self._curve(within) - math.log(self.values[0]) + slope * (p - within)
        return np.asarray(value), np.asarray(slope)

    def ratio(self, pressure: ArrayLike, _temperature: ArrayLike | None = None, /) -> tuple[Array, Array]:
        """Value over that at zero pressure, and its derivative by pressure [1/Pa]."""
        value, slope = self.log(pressure)
        ratio = np.exp(value)
        return ratio, ratio * slope

    def log_ratio(self, pressure: ArrayLike, _temperature: ArrayLike | None = None, /) -> tuple[Array, Array]:
        """Logarithm of ``ratio``, and its derivative by pressure [1/Pa]."""
        return self.log(pressure)

    def at(self, pressure: ArrayLike, _density_ratio: ArrayLike | None = None, /) -> Array:
        """Value at a pressure [Pa]."""
        return np.asarray(self.values[0] * self.ratio(pressure)[0])


@dataclass(frozen=True, eq=False)
class SampledLaws:
    """Laws of a user's own at the temperature of a contact."""

    samples: Mapping[str, Samples]  # samples by "viscosity", "density", "permittivity" and "strength"

    @property
    def names(self) -> dict[str, str]:
        """Names of the laws, by property."""
        return {key: samples.name for key, samples in self.samples.items()}

    def applied(self, oil: Oil) -> Oil:
        """Oil with these laws in place of its own."""
        changes: dict[str, Any] = {"laws": {**oil.laws, **self.names}}
        if viscosity := self.samples.get("viscosity"):
            changes |= {"viscosity": float(viscosity.values[0]), "log_viscosity": viscosity.log_ratio}
            changes["laws"].pop("atmospheric", None)
        if density := self.samples.get("density"):
            changes |= {"density": float(density.values[0]), "density_ratio": density.ratio}
        if permittivity := self.samples.get("permittivity"):
            changes |= {"relative_permittivity": float(permittivity.values[0])}
            changes |= {"permittivity": permittivity.at}
        kept = tuple(check for check in oil.checks if getattr(check, "of", None) not in self.samples)
        return replace(oil, checks=kept, film_checks=(self.exceeded,), **changes)

    def exceeded(self, max_pressure: float) -> Iterator[ResultWarning]:
        """Warnings about laws that a film with this maximum pressure [Pa] leaves."""
        for key, samples in self.samples.items():
            last = samples.pressure[-1]
            if max_pressure > last:
                yield ResultWarning.of(
                    "law-range",
                    "python_law",
                    pressure=max_pressure / 1e9,
                    quantity=key,
                    law=samples.name,
                    last=last / 1e9,
                )

    def stored(self) -> dict[str, Any]:
        """Samples as lists, for files; of a dielectric strength, which the case has too, every tenth."""
        stored = {}
        for key, law in self.samples.items():
            part = slice(None, None, OF_STRENGTH if key == "strength" else 1)
            stored[key] = {
                "name": law.name,
                "pressure": law.pressure[part].tolist(),
                "values": law.values[part].tolist(),
            }
        return stored

    @classmethod
    def restored(cls, table: Mapping[str, Any]) -> SampledLaws:
        """Laws of the lists that ``stored`` makes."""
        return cls(
            {
                key: Samples(str(law["name"]), np.array(law["pressure"]), np.array(law["values"]))
                for key, law in table.items()
            }
        )


def is_laws(table: Any) -> bool:
    """Whether a table is one that ``SampledLaws.stored`` makes."""
    return isinstance(table, dict) and all(key in _LEAST and _is_samples(law) for key, law in table.items())


def _is_samples(law: Any) -> bool:
    if not isinstance(law, dict) or set(law) != {"name", "pressure", "values"}:
        return False
    try:
        pressure, values = (np.asarray(law[key], dtype=float) for key in ("pressure", "values"))
    except (TypeError, ValueError):
        return False
    right = pressure.ndim == 1 and pressure.shape == values.shape and pressure.size > 1
    return bool(right and np.all(np.diff(pressure) > 0.0) and np.all(np.isfinite(values) & (values > 0.0)))


def _sampled(key: str, name: str, law: Function, temperature: float, max_pressure: float) -> Samples:
    """Samples of a law up to four times the Hertz pressure [Pa], or up to where its values end."""
    # Dense at low pressures, where the film is formed.
    pressure = _MOST * max_pressure * np.linspace(0.0, 1.0, _INTERVALS + 1) ** 2
    with np.errstate(all="ignore"):
        values = np.asarray(law(pressure.copy(), temperature), dtype=float)
    if values.shape == ():
        values = np.full_like(pressure, float(values))
    if values.shape != pressure.shape:
        raise InputError(
            f"laws.{key}",
            got=f"{name}, which returns an array of shape {values.shape} for one of shape {pressure.shape}",
            takes="a function that returns one value for each pressure",
        )
    right = np.isfinite(values) & (values >= _LEAST[key]) & (values > 0.0) & (values < 1e300)
    end = int(np.argmin(right)) if not np.all(right) else pressure.size
    if end < 2 or pressure[end - 1] < _NEEDED * max_pressure:
        bad = values[min(end, pressure.size - 1)]
        least = "1 or more" if _LEAST[key] else "above 0"
        raise InputError(
            f"laws.{key}",
            got=f"{bad:g} {_UNITS[key]}".strip()
            + f" of {name} at {pressure[min(end, pressure.size - 1)] / 1e9:.4g} GPa and {temperature:g} K",
            takes=f"a finite value {least}, up to {_NEEDED * max_pressure / 1e9:.3g} GPa, 1.5 times the "
            "Hertz pressure",
        )
    return Samples(name, pressure[:end], values[:end])
