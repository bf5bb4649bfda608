"""Keys of an oil at its temperature in summary.json."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey, under
from ehlectric.lubricant.oil import LAW_NAMES

OIL_KEYS: Keys = {
    "name": ResultKey("name of the oil in the library; null for another"),
    "temperature": ResultKey(
        "temperature of the oil in the contacts; null where the case gives none",
        "K",
        "temperature of the oil",
    ),
    "viscosity": ResultKey(
        "viscosity of the oil at ambient pressure and that temperature", "Pa*s", "viscosity", r"$\eta_0$"
    ),
    "pressure_viscosity_coefficient": ResultKey(
        "slope of the logarithm of the viscosity at zero pressure and that temperature",
        "1/Pa",
        "pressure-viscosity coefficient",
        r"$\alpha$",
    ),
    "alpha_star": ResultKey(
        "reciprocal asymptotic pressure-viscosity coefficient at that temperature, which film formulas and "
        "the group L take",
        "1/Pa",
        "reciprocal asymptotic coefficient",
        r"$\alpha^*$",
    ),
    "density": ResultKey("density at ambient pressure; null where it is not known", "kg/m**3", "density"),
    "relative_permittivity": ResultKey(
        "relative permittivity at ambient pressure", "", "relative permittivity", r"$\varepsilon_\mathrm{r}$"
    ),
    "conductivity": ResultKey(
        "electrical conductivity, that of `[discharge]` or else of the oil; null where it is not known",
        "S/m",
        "conductivity of the oil",
        r"$\sigma$",
    ),
    **under(
        "laws",
        {name: ResultKey(f"law of the {name.replace('_', ' ')}; null without one") for name in LAW_NAMES},
    ),
}
