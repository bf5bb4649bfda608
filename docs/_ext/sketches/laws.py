"""Viscosity and density of a mineral oil over pressure, by the laws of the program."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure

from ehlectric.arrays import Array
from ehlectric.lubricant.density import dowson_higginson, murnaghan, tait
from ehlectric.lubricant.viscosity import barus, roelands
from ehlectric.lubricant.yasutomi import yasutomi, yasutomi_viscosity
from sketches.pen import BLUE, GREEN, GREY, INK, RED, SIZE

# Shell T9 as later works quote Habchi et al. (2010).
_OIL = {
    "yasutomi_glass_viscosity": 1e12,
    "yasutomi_glass_temperature": 189.95,
    "yasutomi_a1": 188.86,
    "yasutomi_a2": 0.719e-9,
    "yasutomi_b1": 8.20e-9,
    "yasutomi_b2": -0.5278,
    "yasutomi_c1": 16.09,
    "yasutomi_c2": 17.38,
}
_STATE = {"k0_prime": 10.545, "k00": 9.234e9, "beta_k": 6.09e-3, "expansion": 7.734e-4}
_REFERENCE = 298.0


def laws() -> Figure:
    """Viscosity at 25 and 70 degC by Yasutomi, Roelands and Barus, and the density ratio at 70 degC."""
    figure = Figure(figsize=(8.6, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    p = np.linspace(0.0, 2e9, 401)
    for celsius, style in ((25, "-"), (70, "--")):
        for colour, name, law in _viscosities(celsius + 273.15):
            label = name if celsius == 25 else None
            left.plot(p / 1e9, law(p) / np.log(10.0), style, color=colour, lw=1.6, label=label)
    left.set(xlabel="pressure $p$ [GPa]", ylabel=r"$\log_{10}\,(\eta\,/\,$Pa s$)$", ylim=(-4.5, 15.0))
    left.axhline(12.0, color=GREY, lw=0.8)
    left.text(0.03, 12.3, "glass", size=SIZE - 1, color=GREY)
    left.legend(frameon=False, fontsize=SIZE - 1, loc="lower right", title="solid 25 °C, dashed 70 °C")
    for colour, name, ratio in _densities(p, 343.15):
        right.plot(p / 1e9, ratio, color=colour, lw=1.6, label=name)
    right.set(xlabel="pressure $p$ [GPa]", ylabel=r"density ratio $\rho/\rho_0$ at 70 °C")
    right.legend(frameon=False, fontsize=SIZE - 1, loc="upper left")
    for ax in (left, right):
        ax.tick_params(colors=INK, labelsize=SIZE - 1)
        ax.spines[["top", "right"]].set_visible(False)
    return figure


def _viscosities(temperature: float) -> list[tuple[str, str, Callable[[Array], Array]]]:
    """Colour, name and ln(eta / Pa s) of three laws with the same value and slope at zero pressure."""
    ambient = float(np.log(yasutomi_viscosity(temperature, **_OIL)))
    alpha = float(yasutomi(0.0, temperature, **_OIL)[1])
    return [
        (BLUE, "Yasutomi", lambda p: ambient + yasutomi(p, temperature, **_OIL)[0]),
        (
            GREEN,
            "Roelands, z = 0.67",
            lambda p: (
                ambient
                + roelands(
                    p, pressure_viscosity_coefficient=alpha, roelands_z=0.67, roelands_pressure=1.96e8
                )[0]
            ),
        ),
        (RED, "Barus", lambda p: ambient + barus(p, pressure_viscosity_coefficient=alpha)[0]),
    ]


def _densities(p: Array, temperature: float) -> list[tuple[str, str, Array]]:
    """Colour, name and density ratio of three laws; Murnaghan's has the bulk moduli of Tait's."""
    of_tait = {f"tait_{name}": value for name, value in _STATE.items()}
    of_murnaghan = {f"murnaghan_{name}": value for name, value in _STATE.items()}
    return [
        (BLUE, "Tait", tait(p, temperature, **of_tait, reference_temperature=_REFERENCE)[0]),
        (GREEN, "Murnaghan", murnaghan(p, temperature, **of_murnaghan, reference_temperature=_REFERENCE)[0]),
        (RED, "Dowson and Higginson", dowson_higginson(p, density_c1=0.59e9, density_c2=1.34)[0]),
    ]
