"""Laws of viscosity that describe a measured table over pressure and temperature, with their deviations."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.lubricant.law import parameter
from ehlectric.lubricant.viscosity import (
    ROELANDS_CONSTANT,
    VISCOSITY_LAWS,
    reciprocal_asymptotic_alpha,
    roelands_alpha,
)
from ehlectric.lubricant.viscosity_over_temperature import ATMOSPHERIC_LAWS, ROELANDS_TEMPERATURE
from ehlectric.quantities.result_warnings import ResultWarning

# Roelands' constant p0 [Pa].
_P0 = 1.962e8

# Viscosity at the glass transition [Pa s], which a table does not determine.
_GLASS = 1e12

# Largest relative deviation of a law from a row: above the first one a warning is issued, above the
# second one the table is refused.
_DEVIATES, _REFUSED = 0.05, 0.5

# Share of the integral of 1/alpha* above the table from which a warning is issued.
_EXTRAPOLATED = 0.1

# Relative scatter of measured viscosities below which a better fit is not evidence for a law.
_SCATTER = 1e-4

# Temperatures of one row and of another one that are equal [K].
_LEVEL = 0.5

# Pressures up to this one are ambient [Pa].
_AMBIENT = 2e6

# Deviation of a law that has no value, as ln(viscosity).
_FAR = 100.0

Values = dict[str, float]


@dataclass(frozen=True)
class ViscosityFit:
    """Law of a table of viscosities: its keys in ``[lubricant]``, and its deviations from the table."""

    keys: Mapping[str, float | str]  # names and parameters of the laws, SI units
    rows: int
    rms: float  # root mean square of the deviations of ln(viscosity)
    worst: float  # largest relative deviation of the viscosity
    highest: float  # highest pressure of the table [Pa]; 0 for a table at ambient pressure
    # Share of the integral of 1/alpha* above the table, at its middle temperature; 0 at ambient pressure.
    share: float
    temperatures: tuple[float, float] | None  # lowest and highest temperature of the table [K]

    @property
    def law(self) -> str:
        """Names of the laws."""
        names = (self.keys.get("atmospheric_law"), self.keys.get("viscosity_law"))
        return " and ".join(str(name) for name in dict.fromkeys(names) if name)


def log_viscosity(keys: Mapping[str, float | str], pressure: Array, temperature: Array) -> Array:
    """Return ln(viscosity/(1 Pa s)) of laws with their parameters, shape (n,).

    ``keys``, names and parameters as in ``[lubricant]``, SI units; ``pressure`` [Pa] and ``temperature`` [K],
    shape (n,). A pressure-viscosity coefficient that belongs to a reference temperature changes with ln(eta0)
    + 9.67, as in Roelands' relation.
    """
    numbers: Values = {key: float(value) for key, value in keys.items() if not isinstance(value, str)}
    law = VISCOSITY_LAWS[str(keys.get("viscosity_law", "constant"))]
    needed: dict[str, object] = {p.name: numbers[p.name] for p in law.parameters}
    if law.atmospheric is not None:
        ambient = law.atmospheric(temperature, **needed)
    elif "atmospheric_law" in keys:
        over = ATMOSPHERIC_LAWS[str(keys["atmospheric_law"])]
        ambient = over.function(temperature, **{p.name: numbers[p.name] for p in over.parameters})
    else:
        ambient = np.full(pressure.shape, numbers["viscosity"])
    alpha = numbers.get("pressure_viscosity_coefficient")
    if alpha is not None and "atmospheric_law" in keys and "viscosity" in numbers:
        relation = roelands_alpha(ambient, 1.0, 1.0) / roelands_alpha(numbers["viscosity"], 1.0, 1.0)
        needed["pressure_viscosity_coefficient"] = alpha * relation
    total: Array = np.log(ambient) + law.function(pressure, temperature, **needed)[0]
    return total


@dataclass(frozen=True)
class _Model:
    """Laws that may describe a table."""

    names: Mapping[str, str]
    free: tuple[str, ...]  # parameters that are fitted
    starts: Sequence[Values]  # values from which the fit begins


# Parameters whose logarithm is fitted.
_POSITIVE = frozenset(
    {
        *("viscosity", "vogel_viscosity", "vogel_b", "pressure_viscosity_coefficient", "roelands_pressure"),
        *(
            "roelands_s0",
            "yasutomi_a1",
            "yasutomi_a2",
            "yasutomi_b1",
            "yasutomi_c1",
            "yasutomi_c2",
            "roelands_z",
        ),
    }
)


@lru_cache(maxsize=16)
def fit_viscosity(
    pressure: tuple[float, ...] | None,
    temperature: tuple[float, ...] | None,
    viscosity: tuple[float, ...],
    law: str | None = None,
    reference: float | None = None,
) -> ViscosityFit:
    """Fit the laws of viscosity to a table, and return the law with the best description.

    ``pressure`` [Pa], None for a table at ambient pressure; ``temperature`` [K], None for a table without
    temperature; ``viscosity`` [Pa s], each of shape (n,); ``law``, name of the viscosity law, None for any;
    ``reference``, temperature of the reference viscosity of Roelands' law over temperature [K].

    Squares of the deviations of ln(viscosity) are minimised. Of several laws, the law with the minimum of the
    Bayesian information criterion n ln(s^2) + k ln(n) is chosen, with the mean square s^2 of the deviations
    and the number k of parameters (G. Schwarz, Ann. Stat. 6 (1978) 461, doi:10.1214/aos/1176344136).

    Raises InputError if no law describes the table, or its rows are too few.

    Examples
    --------
    >>> fit = fit_viscosity((0.0, 1e8, 2e8), None, (0.04, 0.04 * math.exp(2.0), 0.04 * math.exp(4.0)))
    >>> fit.keys["viscosity_law"], round(fit.keys["pressure_viscosity_coefficient"] * 1e9, 3)
    ('barus', 20.0)
    """
    eta = np.log(np.array(viscosity))
    p = np.zeros(eta.size) if pressure is None else np.array(pressure)
    t = None if temperature is None else np.array(temperature)
    over_temperature = t is not None and bool(np.ptp(t) > _LEVEL)
    over_pressure = bool(np.any(p > _AMBIENT))
    at = np.full(eta.size, 313.15) if t is None else t
    models = _models(
        p, at, eta, law, reference, over_temperature=over_temperature, over_pressure=over_pressure
    )
    best: tuple[float, dict[str, float | str], Array] | None = None
    for model in models:
        spare = 2 if len(model.free) > 4 else 0
        if eta.size < len(model.free) + spare:
            continue
        fit = _fitted(model, p, at, eta)
        if fit is None:
            continue
        keys, deviations = fit
        mean = float(np.mean(deviations**2)) + _SCATTER**2
        score = eta.size * math.log(mean) + len(model.free) * math.log(eta.size)
        if best is None or score < best[0]:
            best = score, keys, deviations
    if best is None:
        got = f"has {eta.size} rows, to which no law can be fitted"
        raise InputError("viscosity_table", got, takes="more rows over pressure and temperature")
    _, keys, deviations = best
    worst = float(np.max(np.expm1(np.abs(deviations))))
    if worst > _REFUSED:
        line = int(np.argmax(np.abs(deviations)))
        got = f"row {line + 1} differs by {100.0 * worst:.0f} % from every law of viscosity"
        takes = "Newtonian viscosities: rows at a low shear rate, one oil, and the units of the head"
        raise InputError("viscosity_table", got, takes=takes)
    ends = None if t is None else (float(t.min()), float(t.max()))
    rms = float(np.sqrt(np.mean(deviations**2)))
    highest = float(p.max())
    share = _share_above(keys, float(np.median(at)), highest) if over_pressure else 0.0
    return ViscosityFit(keys, eta.size, rms, worst, highest, share, ends)


def _models(
    p: Array,
    t: Array,
    eta: Array,
    law: str | None,
    reference: float | None,
    *,
    over_temperature: bool,
    over_pressure: bool,
) -> Iterator[_Model]:
    """Laws that may describe a table, each with the values from which its fit begins."""
    places, ambient, alpha = _ambient(p, t, eta)
    of_pressure = (
        [*_pressure_laws(places, alpha, over_temperature=over_temperature)]
        if over_pressure
        else [_Model({}, (), [{}])]
    )
    of_temperature = (
        [*_temperature_laws(places, ambient, reference)]
        if over_temperature
        else [_Model({}, ("viscosity",), [{"viscosity": math.exp(float(np.mean(ambient)))}])]
    )
    for first in of_pressure:
        if over_pressure and law is not None and first.names["viscosity_law"] != law:
            continue
        for second in of_temperature:
            starts = [{**upper, **lower} for upper in first.starts for lower in second.starts]
            yield _Model({**second.names, **first.names}, (*second.free, *first.free), starts)
    if over_temperature and over_pressure and law in (None, "yasutomi"):
        yield _yasutomi()


def _ambient(p: Array, t: Array, eta: Array) -> tuple[Array, Array, Array]:
    """Temperatures [K], and ln(viscosity) and its slope at zero pressure [1/Pa] there, estimated."""
    places, ambient, slopes = [], [], []
    for level in np.unique(np.round(t / _LEVEL)):
        rows = np.flatnonzero(np.round(t / _LEVEL) == level)
        low = rows[np.argsort(p[rows])][:3]
        slope = 2e-8
        if np.ptp(p[low]) > 0.0:
            slope = float(np.polyfit(p[low], eta[low], 1)[0])
        places.append(float(np.mean(t[rows])))
        ambient.append(float(np.mean(eta[low] - slope * p[low])))
        slopes.append(slope)
    alphas = np.clip(slopes, 1e-9, 1e-7)
    return np.array(places), np.array(ambient), alphas


def _pressure_laws(places: Array, alpha: Array, *, over_temperature: bool) -> Iterator[_Model]:
    start = {"pressure_viscosity_coefficient": float(np.mean(alpha))}
    yield _Model({"viscosity_law": "barus"}, (*start,), [start])
    rest = {"roelands_pressure": _P0, "roelands_z": 0.6}
    yield _Model({"viscosity_law": "roelands"}, (*start, "roelands_z"), [start | rest])
    yield _Model(
        {"viscosity_law": "roelands"}, (*start, *rest), [start | rest, start | rest | {"roelands_z": 0.3}]
    )
    if over_temperature:
        slope, level = np.polyfit(places, 1.0 / alpha, 1) if places.size > 1 else (0.0, 5e7)
        moduli = {
            "modulus_a1": float(level),
            "modulus_a2": float(slope),
            "modulus_b1": 0.03,
            "modulus_b2": 0.0,
        }
        yield _Model({"viscosity_law": "modulus"}, (*moduli,), [moduli])


def _temperature_laws(places: Array, ambient: Array, reference: float | None) -> Iterator[_Model]:
    reduced = ambient + ROELANDS_CONSTANT
    at = float(np.median(places)) if reference is None else reference
    if np.all(reduced > 0.0) and at > ROELANDS_TEMPERATURE:
        ratio = np.log((places - ROELANDS_TEMPERATURE) / (at - ROELANDS_TEMPERATURE))
        slope, level = np.polyfit(ratio, np.log(reduced), 1)
        start = {
            "viscosity": math.exp(math.exp(float(level)) - ROELANDS_CONSTANT),
            "reference_temperature": at,
            "roelands_s0": max(0.2, -float(slope)),
        }
        yield _Model({"atmospheric_law": "roelands"}, ("viscosity", "roelands_s0"), [start])
    if places.size > 2:
        starts = []
        for pole in (120.0, 150.0, 175.0):
            b, log_k = np.polyfit(1.0 / (places - pole), ambient, 1)
            if b > 0.0:
                starts.append(
                    {"vogel_viscosity": math.exp(float(log_k)), "vogel_b": float(b), "vogel_c": pole}
                )
        yield _Model({"atmospheric_law": "vogel"}, ("vogel_viscosity", "vogel_b", "vogel_c"), starts[-1:])


def _yasutomi() -> _Model:
    """Improved law of Yasutomi, with the usual viscosity at the glass transition, 1e12 Pa s."""
    start = {
        "yasutomi_glass_viscosity": _GLASS,
        "yasutomi_glass_temperature": 195.0,
        "yasutomi_a1": 180.0,
        "yasutomi_a2": 0.7e-9,
        "yasutomi_b1": 8e-9,
        "yasutomi_b2": -0.5,
        "yasutomi_c1": 16.0,
        "yasutomi_c2": 20.0,
    }
    free = tuple(name for name in start if name != "yasutomi_glass_viscosity")
    return _Model({"viscosity_law": "yasutomi"}, free, [start])


def _fitted(model: _Model, p: Array, t: Array, eta: Array) -> tuple[dict[str, float | str], Array] | None:
    """Keys of a law with fitted parameters, and the deviations of ln(viscosity); None if it does not fit."""
    best: tuple[float, dict[str, float | str], Array] | None = None
    for start in model.starts:
        scale = {name: max(abs(start[name]), 1e-3 * _width(name)) for name in model.free}

        def keys_of(x: Array, start: Values = start, scale: Values = scale) -> dict[str, float | str]:
            values: dict[str, float | str] = {**start, **model.names}
            for name, value in zip(model.free, x.tolist(), strict=True):
                values[name] = start[name] * math.exp(value) if name in _POSITIVE else value * scale[name]
            return values

        def deviations(x: Array, keys: Callable[[Array], dict[str, float | str]] = keys_of) -> Array:
            with np.errstate(all="ignore"):
                try:
                    gap = log_viscosity(keys(x), p, t) - eta
                except (InputError, OverflowError):
                    return np.full(eta.shape, _FAR)
            return np.asarray(np.clip(np.nan_to_num(gap, nan=_FAR), -_FAR, _FAR))

        x0 = np.array([0.0 if name in _POSITIVE else start[name] / scale[name] for name in model.free])
        solution = scipy.optimize.least_squares(
            deviations, x0, x_scale="jac", xtol=1e-14, ftol=1e-14, gtol=1e-14, max_nfev=400
        )
        keys = keys_of(solution.x)
        allowed = all(parameter(name).allow(float(keys[name])) for name in model.free)
        if allowed and (best is None or solution.cost < best[0]):
            best = float(solution.cost), keys, deviations(solution.x)
    return None if best is None else best[1:]


def _width(name: str) -> float:
    """Size of usual values of a parameter, where its value may be 0."""
    return {"modulus_a1": 1e8, "modulus_a2": 1e5, "modulus_b1": 0.1, "modulus_b2": 1e-3}.get(name, 1.0)


def fit_warnings(
    max_pressure: float,
    viscosity: float,
    temperature: float | None = None,
    *,
    rows: float,
    rms: float,
    worst: float,
    highest: float,
    share: float,
    law: str = "",
) -> Iterator[ResultWarning]:
    """Note about the law of a viscosity table; warnings if it deviates, or the contact leaves the table."""
    yield ResultWarning.of(
        "viscosity-table", "fit", rows=int(rows), law=law, rms=100.0 * rms, worst=100.0 * worst
    )
    if share > _EXTRAPOLATED:
        yield ResultWarning.of("viscosity-table-short", share=100.0 * share, highest=highest / 1e9)
    if worst > _DEVIATES:
        yield ResultWarning.of("viscosity-table-deviates", worst=100.0 * worst, law=law)
    if 0.0 < highest < max_pressure:
        yield ResultWarning.of("law-range", "viscosity_table", highest=highest / 1e9, law=law)


def _share_above(keys: Mapping[str, float | str], temperature: float, highest: float) -> float:
    """Share of the integral of eta0/eta over pressure, 1/alpha*, that lies above a pressure [Pa]."""
    ambient = log_viscosity(keys, np.zeros(1), np.full(1, temperature))

    def law(pressure: ArrayLike, _temperature: ArrayLike | None = None, /) -> tuple[Array, Array]:
        p = np.asarray(pressure, dtype=float)
        total = log_viscosity(keys, p.ravel(), np.full(p.size, temperature)) - ambient
        return total.reshape(p.shape), np.zeros_like(p)

    pressures = np.linspace(0.0, highest, 401)
    below = float(np.trapezoid(np.exp(-law(pressures)[0]), pressures))
    return max(0.0, 1.0 - below * float(reciprocal_asymptotic_alpha(law)))
