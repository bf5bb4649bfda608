"""Parameters of the viscosity law that follow from the type of base oil in the data sheet."""

from __future__ import annotations

from ehlectric.cases.oils.properties import Properties
from ehlectric.lubricant.estimates import Estimate, alpha_estimate
from ehlectric.lubricant.temperature import Walther, density
from ehlectric.lubricant.viscosity import roelands_exponent

ALPHA, EXPONENT = "pressure_viscosity_coefficient", "roelands_z"


def of_base_oil(oil: Properties) -> frozenset[str]:
    """Names of the parameters that follow from ``temperature.base_oil``, because the table lacks them.

    Where neither the coefficient nor Roelands' exponent is given, the coefficient is estimated. The exponent
    follows from the coefficient by Roelands' relation. A given exponent leaves nothing to estimate.
    """
    if oil.temperature is None or oil.temperature.base_oil is None or oil.parameter(EXPONENT) is not None:
        return frozenset()
    return frozenset({EXPONENT} if oil.parameter(ALPHA) is not None else {ALPHA, EXPONENT})


def estimated_alpha(oil: Properties, temperature: float | None) -> Estimate | None:
    """Estimate of the coefficient at a temperature [K]; None where the table says what it is.

    Raises
    ------
    InputError
        If the viscosity is outside the range in which the estimate holds.
    """
    sheet = oil.temperature
    if sheet is None or sheet.base_oil is None or temperature is None or ALPHA not in of_base_oil(oil):
        return None
    walther = Walther.of(sheet.at_40(), sheet.at_100())
    return alpha_estimate(
        sheet.base_oil,
        walther.viscosity(temperature),
        slope=walther.b,
        density=density(sheet.density_15, sheet.expansion, temperature),
    )


def base_oil_values(oil: Properties, viscosity: float, temperature: float | None) -> dict[str, float]:
    """Values of the parameters that follow from the type of base oil, at a viscosity [Pa s]."""
    names = of_base_oil(oil)
    estimate = estimated_alpha(oil, temperature)
    alpha = oil.parameter(ALPHA) if estimate is None else estimate.value
    if alpha is None:
        return {}
    values = {ALPHA: alpha}
    constant = oil.parameter("roelands_pressure")
    if constant is not None:
        values[EXPONENT] = roelands_exponent(viscosity, alpha, constant)
    return {name: values[name] for name in names if name in values}
