"""
Speed and load against the film-thickness formulas
==================================================

A film-thickness formula is a fit to films that were computed or measured when it was published. Here four
formulas are compared with the solved film, over two decades of speed at two loads.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

import ehlectric
from ehlectric.formulas.film_line import FORMULAS

case = ehlectric.Case.from_dict(
    {
        "contact": {
            "reduced_radius": "14.1 mm",
            "reduced_modulus": "226 GPa",
            "max_hertz_pressure": "1 GPa",
            "entrainment_speed": "1 m/s",
        },
        "lubricant": {"base": "paper"},
    }
)
speeds = np.geomspace(0.2, 20.0, 9)
loads = {"0.5 GPa": "#0072b2", "1.5 GPa": "#d55e00"}
solved = {
    pressure: [
        ehlectric.solve(
            case.replace({"contact.max_hertz_pressure": pressure, "contact.entrainment_speed": float(speed)}),
            require_convergence=True,
        )
        for speed in speeds
    ]
    for pressure in loads
}

# %%
# Not every formula gives both films: each figure shows the formulas for its film.
STYLES = {"dowson_higginson": "--", "dowson_toyoda": "-.", "pan_hamrock": ":", "moes": (0, (6, 2))}
NAMES = {name: (FORMULAS[name].name, style) for name, style in STYLES.items()}


def compare(quantity, label):
    """Draw solved films as dots and formulas as lines; below, the formulas divided by the solved film."""
    figure, (above, below) = plt.subplots(2, 1, figsize=(6.3, 5.4), sharex=True, height_ratios=(3, 2))
    drawn = []
    for pressure, colour in loads.items():
        films = np.array([getattr(result.film, quantity) for result in solved[pressure]])
        above.loglog(speeds, 1e6 * films, "o", ms=4, color=colour)
        for name, (title, style) in NAMES.items():
            formula = [vars(FORMULAS[name](r.conditions.contact))[quantity] for r in solved[pressure]]
            if formula[0] is None:
                continue
            if title not in drawn:
                drawn.append(title)
            above.loglog(speeds, 1e6 * np.array(formula), color=colour, ls=style, lw=1.0)
            below.semilogx(speeds, 100 * (np.array(formula) / films - 1), color=colour, ls=style, lw=1.0)
    keys = [Line2D([], [], color=c, marker="o", ms=4, lw=1, label=p) for p, c in loads.items()]
    keys += [Line2D([], [], color="black", ls=s, lw=1, label=t) for t, s in NAMES.values() if t in drawn]
    above.legend(handles=keys, title="dots: solved; lines: formulas", loc="upper left")
    above.set_ylabel(f"{label} [µm]")
    below.axhline(0.0, color="black", lw=0.6)
    below.set(xlabel="entrainment speed $(u_1 + u_2)/2$ [m/s]", ylabel="formula over\nsolved film $-$ 1 [%]")
    return figure


compare("minimum_thickness", r"minimum film $h_\mathrm{min}$")

# %%
compare("central_thickness", "central film $h(0)$")

# %%
# The formulas differ from the solved film by tens of per cent, and from each other by more. V12/h_min with
# the film of a formula is wrong by as much. The error estimates of the solver are much smaller:
worst = max(r.film.discretisation_error for rs in solved.values() for r in rs)
print(f"largest discretisation error of these {2 * speeds.size} films: {100 * worst:.2f} %")
