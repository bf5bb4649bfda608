"""
Stationary and moving roughness
===============================

The lower surface of a contact of the paper, 1 GPa at 4 m/s, is wavy. The waviness is either stationary, with
the other surface sliding over it, or carried along in pure rolling, as real roughness is. At one instant both
lie at the same position, and film, pressure and field are compared. ``examples/moving_roughness.toml`` is the
same contact on twice the nodes, for a longer time.
"""

from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
import numpy as np

import ehlectric
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import MotionRun, read_motion
from ehlectric.motion.summary import coincident_instant, summary_of

case = ehlectric.Case.from_dict(
    {
        "contact": {
            "reduced_radius": "14.1 mm",
            "reduced_modulus": "226 GPa",
            "max_hertz_pressure": "1 GPa",
            "entrainment_speed": "4 m/s",
            "slide_to_roll_ratio": 0.0,
        },
        "lubricant": {"base": "paper"},
        "roughness": [
            {"surface": 1, "generator": "sinusoid", "amplitude": "50 nm", "wavelength": "50 um"},
        ],
        "electric": {"potential_1": "0 V", "potential_2": "2 V"},
        "grid": {"nodes": 801},
        "motion": {"passes": 1.1, "record": 161},
    }
)
with TemporaryDirectory() as folder:
    run_motion(case, folder)
    motion = read_motion(folder)

# %%
# Both wavinesses at the instant at which they lie at the same position. The black line is the film before the
# roughness arrives, that of smooth surfaces. The pressure flattens the stationary waviness; the film varies
# only because the oil is denser where the pressure is higher. With moving waviness the inlet lets alternately
# more and less oil through, and this oil is carried through the contact with the surface: the film keeps the
# waviness, and the pressure hardly varies.
run = MotionRun.of(motion)
frame = coincident_instant(run)
b = run.conditions.half_width
x = motion["x"] / b
panels = {
    "thickness": ("film [µm]", 1e6, (0.65, 1.1)),
    "pressure": ("pressure [GPa]", 1e-9, (0.0, 1.5)),
    "strength": ("field [V/µm]", 1e-6, (1.5, 3.0)),
}
figure, axes = plt.subplots(3, 1, figsize=(6.3, 6.6), sharex=True)
for ax, (name, (label, scale, limits)) in zip(axes, panels.items(), strict=True):
    ax.plot(x, scale * motion[f"stationary_{name}"], label="stationary")
    ax.plot(x, scale * motion[name][frame], label="moving")
    ax.plot(x, scale * motion[name][0], color="black", lw=0.8, label="before the motion")
    ax.set(ylabel=label, ylim=limits, xlim=(-1.25, 1.25))
axes[0].legend(ncols=3, loc="upper center")
axes[-1].set_xlabel("$x/b$")

# %%
# The film over position and time, from shortly before the front of the roughness arrives. The stripes are
# parallel to the dashed line, on which oil travels; the waviness does not decay on its way.
late = slice(73, None)
time = 1e3 * motion["frame_time"][late]
inside = np.abs(x) < 1.25
figure, ax = plt.subplots(figsize=(6.3, 3.6))
film = ax.pcolormesh(x[inside], time, 1e6 * motion["thickness"][late, inside], vmin=0.65, vmax=1.0)
pace = 1e-3 * case.contact.entrainment_speed / b
ax.plot([-1.2, 1.2], 0.3 + np.array([-1.2, 1.2]) / pace, color="white", ls="--", lw=1.0)
ax.set(xlabel="$x/b$", ylabel="time [ms]", xlim=(-1.2, 1.2), ylim=(float(time[0]), float(time[-1])))
figure.colorbar(film, label="film [µm]")

# %%
# In numbers. At the instant of equal position the minimum film and the maximum field hardly differ, because
# of the chance position of the crests; over time they do. One instant says little about a contact whose
# roughness moves, and the stationary film is no bound for it.
summary = summary_of(motion)
alike, film, field, still = (summary[key] for key in ("beside_stationary", "film", "field", "stationary"))
rows = (
    ("at equal position", *(alike[key] for key in ("minimum_thickness", "maximum_strength"))),
    ("extremes over time", film["minimum_thickness"], field["max_strength"]),
    ("stationary", still["minimum_thickness"], still["max_strength"]),
    ("before the motion", film["before"], field["before"]),
)
for text, thickness, strength in rows:
    print(f"{text:18} minimum film {1e6 * thickness:.3f} µm, maximum field {1e-6 * strength:.3f} V/µm")
print(
    f"largest differences at that instant: film {1e9 * alike['thickness_largest_difference']:.0f} nm, "
    f"pressure {1e-9 * alike['pressure_largest_difference']:.2f} GPa, "
    f"field {1e-6 * alike['strength_largest_difference']:.2f} V/µm"
)
