"""
How good is voltage over film thickness?
========================================

A film is a thousand times longer than it is thick, and so the field should be V12/h(x), as between
parallel plates. The solved field shows the deviation.
"""

import matplotlib.pyplot as plt
import numpy as np

import ehlectric

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
# where the curvature of the walls is largest. Its sign changes there, since the field is stronger on a convex
# wall and weaker on a concave one. At the thinnest place, marked by the dotted line, the deviation is hardly
# visible.
ax = result.plot("field_deviation").axes[0]
b = result.conditions.half_width
ax.axvline(result.film.minimum_position / b, color="black", ls=":", lw=0.8)
ax.set_xlim(0.78, 1.02)
ax.get_legend().set_loc("lower right")

# %%
# V12/h_min is therefore below the maximum field by parts in a million. The thicker the film, the larger the
# difference, here from 0.25 to 32 m/s:
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
# Roughness makes the deviation larger, as the example with a measured surface shows.
