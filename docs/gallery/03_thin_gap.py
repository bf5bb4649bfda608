"""
How good is voltage over film thickness?
========================================

A film is a thousand times longer than it is thick, and so the field should be V12/h(x), as between
parallel plates. How far it is not, the solved field says.
"""

import matplotlib.pyplot as plt
import numpy as np

import ehlectric
from ehlectric.figures.contact import line as plot

case = ehlectric.Case.from_dict(
    {
        "contact": {
            "reduced_radius": "14.1 mm",
            "reduced_modulus": "226 GPa",
            "max_hertz_pressure": "1 GPa",
            "entrainment_speed": "4 m/s",
        },
        "lubricant": {"base": "paper"},
        "grid": {"nodes": 12_801},
    }
)
result = ehlectric.solve(case)

# %%
# The deviation from V12/h in per mille, enlarged around the exit. It is largest below the pressure spike,
# where the walls turn most sharply; it changes its sign there, as a field is stronger on a wall that
# bulges and weaker on one that is hollow. At the thinnest place, marked by the dotted line, it is hardly
# to be seen.
ax = plot.field_deviation(result, plt.subplots()[1])
b = result.conditions.half_width
ax.axvline(result.film.minimum_position / b, color="black", ls=":", lw=0.8)
ax.set_xlim(0.78, 1.02)
ax.get_legend().set_loc("lower right")

# %%
# So V12/h_min falls short of the largest field by parts in a million, and by the more the thicker the
# film. Here from 0.25 to 32 m/s:
speeds = np.geomspace(0.25, 32.0, 8)
excess, films = [], []
for speed in speeds:
    solved = ehlectric.solve(case.replace({"contact.entrainment_speed": float(speed)}))
    films.append(solved.film.minimum_thickness)
    excess.append(solved.thin_gap_error)
figure, ax = plt.subplots()
ax.loglog(1e6 * np.array(films), 1e6 * np.abs(excess), "o-", ms=4)
ax.set(
    ylim=(1, 100),
    xlabel=r"minimum film $h_\mathrm{min}$ [µm]",
    ylabel=r"$1 - (V_{12}/h_\mathrm{min})/|E|_\mathrm{max}$ [ppm]",
)

# %%
# Roughness changes this picture, as the example with a measured surface shows.
