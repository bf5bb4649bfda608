"""
At what voltage does the film break down?
=========================================

With a ``[discharge]`` table the result of a contact contains its breakdown voltage, its capacitance and the
energy of a spark. The strengths, the shape of the Weibull law, the length of the line and the external
capacitance are assumptions here, since no such values are published for a film.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

import ehlectric
from ehlectric.discharge.discharge_laws import MEAN_PIT, WeakestLink, stored_energy

VOLTAGE = 5.0
case = ehlectric.Case.from_dict(
    {
        "contact": {
            "reduced_radius": "14.1 mm",
            "reduced_modulus": "226 GPa",
            "max_hertz_pressure": "1 GPa",
            "entrainment_speed": "1 m/s",
        },
        "lubricant": {"base": "paper"},
        "electric": {"potential_1": "0 V", "potential_2": f"{VOLTAGE} V"},
        "grid": {"inlet": -6.0, "nodes": 4801},
        "discharge": {
            "dielectric_strength": "15 V/um",
            "length": "10 mm",
            "external_capacitance": "1 nF",
        },
    }
)
speeds = np.geomspace(0.25, 8.0, 6)
pressures = {"1 GPa": "#0072b2", "2 GPa": "#d55e00"}
solved = {
    pressure: [
        ehlectric.solve(
            case.replace({"contact.max_hertz_pressure": pressure, "contact.entrainment_speed": float(speed)}),
            require_convergence=True,
        )
        for speed in speeds
    ]
    for pressure in pressures
}

# %%
# With a constant strength of 15 V/µm the breakdown voltage is the strength times the minimum film. At speeds
# below the intersection with the voltage of the case the film breaks down.
figure, ax = plt.subplots()
for pressure, colour in pressures.items():
    breaks = [result.discharge.breakdown_voltage for result in solved[pressure]]
    ax.loglog(speeds, breaks, "o-", ms=4, color=colour, label=pressure)
ax.axhline(VOLTAGE, color="black", ls="--", lw=0.9)
ax.annotate(
    f"voltage of the case, {VOLTAGE:g} V", (speeds[0], VOLTAGE), xytext=(0, 4), textcoords="offset points"
)
ax.set(xlabel="entrainment speed $(u_1 + u_2)/2$ [m/s]", ylabel="breakdown voltage $V_b$ [V]", ylim=(1, 20))
ax.set_xticks([0.25, 0.5, 1, 2, 4, 8], ["0.25", "0.5", "1", "2", "4", "8"])
ax.set_yticks([1, 2, 5, 10, 20], ["1", "2", "5", "10", "20"])
ax.minorticks_off()
ax.legend(title="Hertzian pressure", loc="lower right")

# %%
# A Weibull law instead, with the same scale, a shape of 10 and a reference area of 1 mm²: in a longer line
# more film is stressed, and it breaks down at a lower voltage. The film is not solved again; only the
# assessment of the discharge changes. Upper panel: dots at 63.2 %, bars from 5 to 95 %. The dotted line is
# the constant strength.
result = solved["1 GPa"][3]
weibull = {"scale": "15 V/um", "shape": 10, "reference_area": "1 mm^2"}
lengths = {"1 mm": "#56b4e9", "10 mm": "#0072b2", "100 mm": "black"}
voltages = np.linspace(2.0, 12.0, 241)
figure, (above, below) = plt.subplots(2, 1, figsize=(6.3, 4.2), sharex=True, height_ratios=(1, 3))
names = []
for row, (length, colour) in enumerate(lengths.items()):
    law = result.case.replace({"discharge.weibull": weibull, "discharge.length": length})
    assessment = replace(result, case=law).discharge
    low, middle, high = (
        assessment.breakdown_voltage_low,
        assessment.breakdown_voltage,
        assessment.breakdown_voltage_high,
    )
    above.plot([low, high], [row, row], "|-", ms=8, color=colour)
    above.plot(middle, row, "o", ms=5, color=colour)
    link = WeakestLink(law.discharge.weibull.shape, middle)
    below.plot(voltages, [link.probability(voltage) for voltage in voltages], color=colour)
    area = 1e6 * 2.0 * result.conditions.half_width * law.discharge.length
    names.append(f"{length} long, {area:.3g} mm²")
    print(f"{length:>6}: {low:.2f} V at 5 %, {middle:.2f} V at 63.2 %, {high:.2f} V at 95 %")
above.set(yticks=range(3), yticklabels=names, ylim=(2.6, -0.6))
for ax in (above, below):
    ax.axvline(result.discharge.breakdown_voltage, color="black", ls=":", lw=0.9)
below.set(xlabel="voltage [V]", ylabel="probability of breakdown", ylim=(0, 1), xlim=(2, 12))

# %%
# The energy of a spark at the breakdown voltage, for a line of 10 mm. The energy of the contact alone falls
# as the film gets thinner: its capacitance is proportional to 1/h, the square of its voltage to h². The
# external capacitance, here 1 nF for the rotor, is constant. The grey line is the energy that melts a
# hemisphere 1.7 µm wide, the mean pit of Plazenet et al. as quoted by Morris et al., with 10.2 GJ/m³ for iron
# and an efficiency of 0.183, which is an assumption.
pit = 10.2e9 * np.pi * MEAN_PIT**3 / 12.0 / 0.183
figure, ax = plt.subplots()
for pressure, colour in pressures.items():
    assessments = [result.discharge for result in solved[pressure]]
    whole = [1e9 * a.breakdown_energy for a in assessments]
    alone = [1e9 * stored_energy(0.01 * a.capacitance, a.breakdown_voltage) for a in assessments]
    ax.loglog(speeds, whole, "o-", ms=4, color=colour, label=f"{pressure}, with the rotor")
    ax.loglog(speeds, alone, "o--", ms=4, mfc="white", color=colour, label=f"{pressure}, contact alone")
ax.axhline(1e9 * pit, color="0.5", lw=0.9)
ax.annotate(
    "melts a pit of 1.7 µm",
    (speeds[0], 1e9 * pit),
    xytext=(0, 4),
    textcoords="offset points",
    color="0.35",
)
ax.set(xlabel="entrainment speed $(u_1 + u_2)/2$ [m/s]", ylabel="energy of the spark [nJ]", ylim=(0.2, 300))
ax.set_xticks([0.25, 0.5, 1, 2, 4, 8], ["0.25", "0.5", "1", "2", "4", "8"])
ax.set_yticks([1, 10, 100], ["1", "10", "100"])
ax.minorticks_off()
ax.legend(loc="lower right")

# %%
# Where the breakdown energy is below the grey line the film is thin, and sparks occur at low voltages with
# little energy. A spark that melts such a pit requires a thick film or a larger capacitance.
for pressure in pressures:
    discharge = solved[pressure][3].discharge
    print(
        f"{pressure}, 2 m/s: {1e9 * discharge.capacitance:.1f} nF/m, {discharge.capacitance_ratio:.2f} times "
        f"the plate value, zone of {1e6 * discharge.zone_size:.1f} µm, "
        f"{discharge.zone_over_mean_pit:.0f} mean pits wide"
    )
