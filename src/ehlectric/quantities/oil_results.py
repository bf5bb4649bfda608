"""Results of an oil at the temperature of a contact."""

from __future__ import annotations

from ehlectric.quantities.quantity import Keys, Quantity, under

# What the laws of an oil describe, in the order of files.
LAW_NAMES = (
    *("atmospheric", "viscosity", "density", "permittivity", "conductivity"),
    *("thermal_conductivity", "heat_capacity", "strength"),
)

OIL_KEYS: Keys = {
    "name": Quantity("name of the oil in the library; null for another"),
    "temperature": Quantity(
        "temperature of the oil in the contacts; null where the case gives none",
        "K",
        "temperature of the oil",
        shown="°C",
    ),
    "viscosity": Quantity(
        "viscosity of the oil at ambient pressure and that temperature",
        "Pa*s",
        "viscosity at ambient pressure",
        r"$\eta_0$",
        shown="mPa s",
    ),
    "pressure_viscosity_coefficient": Quantity(
        "slope of the logarithm of the viscosity at zero pressure and that temperature",
        "1/Pa",
        "pressure-viscosity coefficient",
        r"$\alpha$",
        shown="1/GPa",
    ),
    "alpha_star": Quantity(
        "reciprocal asymptotic pressure-viscosity coefficient at that temperature, which film formulas and "
        "the group L take",
        "1/Pa",
        "pressure-viscosity coefficient α*",
        "",
        shown="1/GPa",
    ),
    "density": Quantity("density at ambient pressure; null where it is not known", "kg/m**3", "density"),
    "relative_permittivity": Quantity(
        "relative permittivity at ambient pressure", "", "relative permittivity", r"$\varepsilon_\mathrm{r}$"
    ),
    "conductivity": Quantity(
        "electrical conductivity, that of `[discharge]` or else of the oil; null where it is not known",
        "S/m",
        "conductivity of the oil",
        r"$\sigma$",
    ),
    **under(
        "laws",
        {name: Quantity(f"law of the {name.replace('_', ' ')}; null without one") for name in LAW_NAMES},
    ),
}
