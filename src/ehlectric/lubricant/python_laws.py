"""Laws of the oil that a user writes in Python: functions of pressure and temperature, sampled over
pressure.
"""

from __future__ import annotations

import hashlib
import math
import pickle
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Self, TypeAlias

import numpy as np
import scipy
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import InputError, short
from ehlectric.lubricant.oil import BoundLaw, Oil
from ehlectric.quantities.result_warnings import ResultWarning

# Property as a function of pressure [Pa] and temperature [K].
Function: TypeAlias = Callable[[Array, float], ArrayLike]

# Properties that may have a law of the user's own: smallest allowed value, and unit, for messages.
_LEAST = {"viscosity": 0.0, "density": 0.0, "permittivity": 1.0, "strength": 0.0}
_UNITS = {"viscosity": "Pa s", "density": "kg/m^3", "permittivity": "", "strength": "V/m"}

# Intervals of the samples; pressures up to which a law is sampled, and up to which it must have values, over
# the Hertz pressure. The pressure spike and the iterations of the film reach beyond the Hertz pressure. The
# number of samples also keeps three laws below the 64 kB of an attribute of HDF5.
_INTERVALS, _MOST, _NEEDED = 400, 4.0, 1.5

# A strength has a tenth of the samples: it becomes a table of the case.
_OF_STRENGTH = 10

# Properties that no pressure decreases, and the relative decrease between two samples that is rounding.
_RISING, _ROUNDING = ("viscosity", "density"), 1e-9

# Relative difference up to which a Hertz pressure equals the pressure of stored samples.
_SAME_PRESSURE = 1e-9


@dataclass(frozen=True)
class Laws:
    """Laws of a user's own, which replace the laws of a case.

    Attributes
    ----------
    viscosity, density, permittivity, strength : callable, optional
        Viscosity [Pa s], density [kg/m^3], relative permittivity and dielectric strength [V/m]: functions
        ``law(pressure, temperature)`` of an array of pressures [Pa] above the ambient one, and of a
        temperature [K]. They return an array of the same shape. An isothermal film calls them at the
        temperature of the contact, a thermal film at all its temperatures.

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

    def at(self, temperature: float, max_pressure: float) -> SampledLaws:
        """Return the laws at a temperature, sampled over pressure.

        Parameters
        ----------
        temperature : float
            Temperature [K].
        max_pressure : float
            Hertz pressure of the contact [Pa].

        Returns
        -------
        SampledLaws
            Values of the laws at pressures from 0 up to four times the Hertz pressure.

        Raises
        ------
        InputError
            If a law has no valid value up to 1.5 times the Hertz pressure.
        """
        names = self.names
        samples = {
            name: _sampled(name, names[name], getattr(self, name), temperature, max_pressure)
            for name in names
        }
        return SampledLaws(samples, temperature, max_pressure)

    def __deepcopy__(self, _: Any) -> Self:
        """Laws themselves, which do not change."""
        return self

    def __getstate__(self) -> dict[str, Any]:
        """Functions by property. Raises InputError if one of them cannot be pickled."""
        for key, name in self.names.items():
            try:
                pickle.dumps(getattr(self, key))
            except (AttributeError, TypeError, pickle.PicklingError):
                raise InputError(
                    f"laws.{key}",
                    got=f"{name}, which cannot be pickled",
                    takes="a function that is defined at the top level of a module",
                ) from None
        return dict(vars(self))


@dataclass(frozen=True, eq=False)
class Samples:
    """Values of a law over pressure at one temperature."""

    name: str
    # pressure and values: increasing pressures from 0 [Pa], and the values there, shape (n,).
    pressure: Array
    values: Array

    @cached_property
    def _curve(self) -> scipy.interpolate.CubicSpline:

        return scipy.interpolate.CubicSpline(self.pressure, np.log(self.values))

    @cached_property
    def _slope(self) -> scipy.interpolate.CubicSpline:
        return self._curve.derivative()

    def log(self, pressure: ArrayLike) -> tuple[Array, Array]:
        """Logarithm of the value divided by the value at zero pressure, and its derivative by pressure
        [1/Pa].

        Beyond the samples, where only iterations of a film go, the logarithm is continued by its last slope.
        """
        p = np.asarray(pressure, dtype=float)
        within = np.clip(p, 0.0, self.pressure[-1])
        slope = self._slope(within)
        value = self._curve(within) - math.log(self.values[0]) + slope * (p - within)
        return np.asarray(value), np.asarray(slope)

    def ratio(self, pressure: ArrayLike, _temperature: ArrayLike | None = None, /) -> tuple[Array, Array]:
        """Value divided by the value at zero pressure, and its derivative by pressure [1/Pa]."""
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
    """Values of laws of a user's own at one temperature, as a result and its file keep them."""

    samples: Mapping[str, Samples]  # samples by "viscosity", "density", "permittivity" and "strength"
    temperature: float  # [K]
    max_pressure: float  # Hertz pressure of the contact [Pa]
    # Values at further temperatures, which a thermal film needs in another process.
    others: Mapping[float, SampledLaws] = field(default_factory=dict)

    @property
    def names(self) -> dict[str, str]:
        """Names of the laws, by property."""
        return {key: samples.name for key, samples in self.samples.items()}

    def at(self, temperature: float, max_pressure: float) -> SampledLaws:
        """Laws at a temperature [K] for a Hertz pressure [Pa]. Raises InputError if there are no values."""
        laws = self if temperature == self.temperature else self.others.get(temperature)
        if laws is not None and math.isclose(max_pressure, laws.max_pressure, rel_tol=_SAME_PRESSURE):
            return laws
        raise InputError.worded(
            "laws",
            f"this result contains values of {', '.join(self.names.values())} at {self.temperature:.6g} K "
            f"for a maximum Hertzian pressure of {self.max_pressure / 1e9:.4g} GPa only, not at "
            f"{temperature:.6g} K and {max_pressure / 1e9:.4g} GPa; give the functions again, as in "
            "case.replace(laws=Laws(...))",
            takes="Laws of functions",
        )

    def same_values(self, other: SampledLaws) -> bool:
        """Whether the values of other laws are equal at the temperature of the contact."""
        return self.stored() == other.stored()

    @property
    def digest(self) -> str:
        """SHA-256 hash of all values, hexadecimal."""
        digest = hashlib.sha256()
        for laws in (self, *(self.others[temperature] for temperature in sorted(self.others))):
            digest.update(repr(laws.temperature).encode())
            for key in sorted(laws.samples):
                law = laws.samples[key]
                digest.update(
                    key.encode() + law.name.encode() + law.pressure.tobytes() + law.values.tobytes()
                )
        return digest.hexdigest()

    def applied(self, oil: Oil) -> Oil:
        """Oil whose own laws are replaced by these laws."""
        changes: dict[str, Any] = {"laws": {**oil.laws, **self.names}}
        if viscosity := self.samples.get("viscosity"):
            changes |= {"viscosity": float(viscosity.values[0]), "log_viscosity": viscosity.log_ratio}
            changes["laws"].pop("atmospheric", None)
        if density := self.samples.get("density"):
            changes |= {"density": float(density.values[0]), "density_ratio": density.ratio}
            heat = oil.heat_capacity_law
            if isinstance(heat, BoundLaw) and "density" in heat.parameters:
                parameters = {**heat.parameters, "density": changes["density"]}
                changes["heat_capacity_law"] = replace(heat, parameters=parameters)
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
        """Samples at the temperature of the contact as lists, for files."""
        return {
            key: {"name": law.name, "pressure": law.pressure.tolist(), "values": law.values.tolist()}
            for key, law in self.samples.items()
        }

    @classmethod
    def restored(cls, table: Mapping[str, Any], temperature: float, max_pressure: float) -> SampledLaws:
        """Laws of the lists that ``stored`` makes, at the temperature [K] and Hertz pressure [Pa] of their
        contact.
        """
        samples = {
            key: Samples(str(law["name"]), np.array(law["pressure"]), np.array(law["values"]))
            for key, law in table.items()
        }
        return cls(samples, temperature, max_pressure)


@dataclass(frozen=True, eq=False)
class Recorder:
    """Laws of functions that keep all values that they are asked for, for a process without the functions."""

    laws: Laws
    known: dict[float, SampledLaws] = field(default_factory=dict)

    @property
    def names(self) -> dict[str, str]:
        """Names of the laws, by property."""
        return self.laws.names

    def at(self, temperature: float, max_pressure: float) -> SampledLaws:
        """Laws at a temperature [K] for a Hertz pressure [Pa]."""
        laws = self.laws.at(temperature, max_pressure)
        self.known[temperature] = laws
        return laws

    def recorded(self, temperature: float, max_pressure: float) -> SampledLaws:
        """Values at the temperature of a contact [K], and at all others that were asked for."""
        return replace(self.laws.at(temperature, max_pressure), others=dict(self.known))


# Laws of a case: functions, values that a file keeps, or functions whose values are recorded.
OwnLaws: TypeAlias = Laws | SampledLaws | Recorder


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
    intervals = _INTERVALS // _OF_STRENGTH if key == "strength" else _INTERVALS
    pressure = _MOST * max_pressure * np.linspace(0.0, 1.0, intervals + 1) ** 2
    try:
        with np.errstate(all="ignore"):
            values = np.asarray(law(pressure.copy(), temperature), dtype=float)
    except Exception as error:
        raise InputError(
            f"laws.{key}",
            got=f"{type(error).__name__} ({short(str(error))}) of {name} at {temperature:g} K",
            takes="a function of an array of pressures [Pa] and a temperature [K]",
        ) from error
    if values.shape == ():
        values = np.full_like(pressure, float(values))
    if values.shape != pressure.shape:
        raise InputError(
            f"laws.{key}",
            got=f"{name}, which returns an array of shape {values.shape} for one of shape {pressure.shape}",
            takes="a function that returns one value for each pressure",
        )
    right = np.isfinite(values) & (values >= _LEAST[key]) & (values > 0.0) & (values < 1e300)
    if key in _RISING:
        # Beyond a pole a formula may have finite values again.
        with np.errstate(all="ignore"):
            right[1:] &= values[1:] >= (1.0 - _ROUNDING) * values[:-1]
    end = int(np.argmin(right)) if not np.all(right) else pressure.size
    if end < 2 or pressure[end - 1] < _NEEDED * max_pressure:
        bad = values[min(end, pressure.size - 1)]
        least = "1 or more" if _LEAST[key] else "above 0"
        least += ", which does not decrease with pressure" if key in _RISING else ""
        raise InputError(
            f"laws.{key}",
            got=f"{bad:g} {_UNITS[key]}".strip()
            + f" of {name} at {pressure[min(end, pressure.size - 1)] / 1e9:.4g} GPa and {temperature:g} K",
            takes=f"a finite value {least}, up to {_NEEDED * max_pressure / 1e9:.3g} GPa, 1.5 times the "
            "maximum Hertzian pressure",
        )
    return Samples(name, pressure[:end], values[:end])
