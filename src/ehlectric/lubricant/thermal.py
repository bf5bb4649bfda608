"""Parts that the laws of thermal conductivity and of heat capacity share."""

from __future__ import annotations

from collections.abc import Iterator

from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import ResultWarning
from ehlectric.lubricant.equation_of_state import tait
from ehlectric.lubricant.law import Parameter

# Largest pressure [Pa] and temperature [K] of the measurements behind the laws of Larsson et al.
LARSSON_PRESSURE, LARSSON_TEMPERATURE = 1.1e9, 380.15


def volume(pressure: ArrayLike, temperature: Array, state: dict[str, float]) -> tuple[Array, Array]:
    """Volume over that at zero pressure and the reference temperature, and its derivative by pressure."""
    ratio, slope = tait(pressure, temperature, **state)
    ambient = 1.0 + state["tait_expansion"] * (temperature - state["reference_temperature"])
    return ambient / ratio, -ambient * slope / ratio**2


def beyond_larsson(law: str, max_pressure: float, temperature: float | None) -> Iterator[ResultWarning]:
    """Warning that a contact is outside the measurements behind a law of Larsson et al."""
    hot = temperature is not None and temperature > LARSSON_TEMPERATURE
    if max_pressure > LARSSON_PRESSURE or hot:
        yield ResultWarning(
            "law-range",
            f"{law} 'larsson' was measured up to {LARSSON_PRESSURE / 1e9:g} GPa and 107 degC and is "
            "extrapolated in this contact",
        )


def number(
    name: str, unit: str, title: str, symbol: str, meaning: str, bounds: tuple[float, float], reason: str
) -> Parameter:
    """Parameter of a law from its name, unit, title, symbol, meaning, bounds and their reason."""
    least, most = bounds
    return Parameter(
        name, unit, title=title, symbol=symbol, meaning=meaning, least=least, most=most, reason=reason
    )


def larsson_constant(letter: str, k: int, of: str) -> Parameter:
    """Constant of the laws of Larsson et al., such as c1 [1/Pa]."""
    return number(
        f"larsson_{letter}{k}",
        "1/Pa",
        f"constant {letter}{k} of Larsson et al.",
        f"${letter}_{k}$",
        f"${letter}_{k}$ of the {of} by Larsson et al.",
        (0.0, 1e-7),
        "oils have 0.3 to 2 1/GPa",
    )
