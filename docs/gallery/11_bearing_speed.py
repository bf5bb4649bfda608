"""
A bearing over its speed
========================

A deep-groove ball bearing 6208 runs in a motor with a common-mode voltage of 300 V. Its films come
from the atlas of films, in about a second, with a stated error. Does a film break down, and below which
speed?
"""

import matplotlib.pyplot as plt

import ehlectric

bearing = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208")).replace({"contacts": "atlas"})
result = ehlectric.solve(bearing)

# %%
# The verdict compares the voltage of the first breakdown with the shaft voltage, and names its assumptions.
print(result.verdict.text)

# %%
# The figure shows both voltages over the speed. They intersect at the critical speed.
result.plot("breakdown_over_speed")

# %%
# The margin is the ratio of the first breakdown to the shaft voltage. It changes most with the dielectric
# strength, which is an assumption, and with the temperature.
for effect in result.margin_analysis.effects:
    print(f"{effect.label}: margin {effect.low_margin:.2f} to {effect.high_margin:.2f}")

# %%
# At a higher temperature the oil is thinner, and so are the films.
figure, ax = plt.subplots()
speeds = [1000, 2000, 3000, 4000, 6000]  # rpm
for temperature in (50, 70, 90):
    margins = []
    for speed in speeds:
        changes = {"bearing.temperature": f"{temperature} degC", "bearing.inner_speed": f"{speed} rpm"}
        margins.append(ehlectric.solve(bearing.replace(changes)).margin)
    ax.plot(speeds, margins, "o-", ms=4, label=f"{temperature} °C")
ax.axhline(1.0, color="black", lw=0.8, ls=":")
ax.set(xlabel="speed of the inner ring [rpm]", ylabel="margin (first breakdown / shaft voltage)")
ax.legend()
