"""
Inner ring, outer ring: the shape of both walls
===============================================

The film depends only on the reduced radius and the reduced modulus. The field depends on each wall: a roller
between two rings has one contact with a convex raceway and one with a concave raceway. The film of the second
is a curved strip.
"""

import matplotlib.pyplot as plt

import ehlectric

steel = {"youngs_modulus": "206 GPa", "poissons_ratio": 0.3}
nitride = {"youngs_modulus": "310 GPa", "poissons_ratio": 0.26}
common = {"max_hertz_pressure": "1.2 GPa", "entrainment_speed": "5 m/s", "body_1": steel}
contacts = {
    "equal cylinders": {"radius_1": "12 mm", "radius_2": "12 mm", "body_2": steel},
    "on a plane": {"radius_1": "6 mm", "radius_2": "1 km", "body_2": steel},
    "in a concave ring": {"radius_1": "5 mm", "radius_2": "-30 mm", "body_2": steel},
    "plane of silicon nitride": {"radius_1": "6 mm", "radius_2": "1 km", "body_2": nitride},
}
results = {
    name: ehlectric.solve(
        ehlectric.Case.from_dict({"contact": common | contact, "lubricant": {"base": "paper"}}),
        require_convergence=True,
    )
    for name, contact in contacts.items()
}

# %%
# The reduced radius is 6 mm in all cases, so that the first three films are equal in thickness. Their
# positions differ. Heights are drawn enlarged.
figure, axes = plt.subplots(2, 2, figsize=(6.3, 4.6), sharex=True, sharey=True)
for ax, (name, result) in zip(axes.flat, results.items(), strict=True):
    field = result.field
    x = field.x / result.conditions.half_width
    ax.fill_between(x, 1e6 * field.y[:, 0], 1e6 * field.y[:, -1], color="#56b4e9", alpha=0.5, lw=0)
    ax.plot(x, 1e6 * field.y[:, 0], x, 1e6 * field.y[:, -1], color="black", lw=0.8)
    ax.set_title(name, loc="left")
for ax in axes[-1]:
    ax.set_xlabel("$x/b$")
for ax in axes[:, 0]:
    ax.set_ylabel("height $y$ [µm]")

# %%
# The curvature of the film as a whole changes the maximum field by a ten-thousandth: its radius is
# millimetres, the film a fraction of a micrometre. At the same Hertzian pressure, the stiffer body makes the
# contact narrower and the capacitance smaller.
print(f"{'contact':26}{'h_min [µm]':>12}{'E max [V/µm]':>14}{'over V12/h_min - 1':>20}{'C [nF/m]':>10}")
for name, result in results.items():
    film, field = result.film, result.field
    over = field.max_strength * film.minimum_thickness / field.voltage - 1
    print(
        f"{name:26}{1e6 * film.minimum_thickness:12.4f}{1e-6 * field.max_strength:14.4f}"
        f"{over:20.1e}{1e9 * field.capacitance:10.3f}"
    )
