"""
A ball bearing, and how fine its grid must be
=============================================

The ball of a deep groove ball bearing 6208 runs on its inner ring under 600 N, in mineral oil of ISO VG 68 at
70 °C with 5 V across the film. The groove conforms closely to the ball. The Hertzian contact is a long
ellipse across entrainment, and the film is thin compared with it. Both make this contact harder to solve than
a ball on a plane.
"""

import matplotlib.pyplot as plt
import numpy as np

import ehlectric

case = ehlectric.Case.from_dict(
    {
        "contact": {
            "geometry": "point",
            "load": "600 N",
            "entrainment_speed": "4 m/s",
            # The inner ring below, convex along entrainment, and its groove concave across it.
            "body_1": {
                "radius_x": "24 mm",
                "radius_y": "-6.191 mm",
                "youngs_modulus": "206 GPa",
                "poissons_ratio": 0.3,
            },
            "body_2": {
                "radius_x": "5.953 mm",
                "radius_y": "5.953 mm",
                "youngs_modulus": "206 GPa",
                "poissons_ratio": 0.3,
            },
        },
        "lubricant": {
            "viscosity": "17 mPa s",
            "viscosity_law": "roelands",
            "pressure_viscosity_coefficient": "19 1/GPa",
            "roelands_z": 0.666,
            "roelands_pressure": "0.196 GPa",
            "density_law": "dowson-higginson",
            "density_c1": "0.59 GPa",
            "density_c2": 1.34,
            "relative_permittivity": 2.2,
        },
        "electric": {"potential_1": "0 V", "potential_2": "5 V"},
    }
)

# %%
# The grid is doubled twice, from 129 x 129 nodes. The error estimate, from the finest grids of each
# solution, is large as long as the constriction at the exit is only a few nodes wide.
nodes = np.array([129, 257, 513])
results = {n: ehlectric.solve(case.replace({"grid.nodes": int(n)}), require_convergence=True) for n in nodes}
for n, result in results.items():
    film = result.film
    print(
        f"{n:>3} x {n:<3}  minimum {1e6 * film.minimum_thickness:.3f} µm, central "
        f"{1e6 * film.central_thickness:.3f} µm, estimated error {100 * film.discretisation_error:.2g} %"
    )
films = {
    "minimum film": [result.film.minimum_thickness for result in results.values()],
    "central film": [result.film.central_thickness for result in results.values()],
}
figure, (left, right) = plt.subplots(1, 2, figsize=(6.8, 3.2))
for label, thickness in films.items():
    left.semilogx(nodes, 1e6 * np.array(thickness), "o-", ms=4, label=label)
left.set(xlabel="nodes either way", ylabel="film thickness [µm]", ylim=(0, None))
left.legend(loc="lower right")
right.loglog(nodes, [100 * r.film.discretisation_error for r in results.values()], "x-", color="black", ms=6)
right.set(xlabel="nodes either way", ylabel="estimated error [%]", ylim=(1, 40))
right.set_yticks([1, 3, 10, 30], ["1", "3", "10", "30"])
for ax in (left, right):
    ax.set_xticks(nodes, [str(n) for n in nodes])
    ax.minorticks_off()

# %%
# ``grid.refine`` does this automatically: with ``refine = "3 %"`` the grid is doubled until the estimate is
# below 3 %, here up to the last of these grids. The ellipse, and the formulas compared with the solved film:
result = results[513]
conditions, film = result.conditions, result.film
print(f"semi-axes         {1e6 * conditions.semi_axis_x:.0f} and {1e6 * conditions.semi_axis_y:.0f} µm")
print(f"Hertzian pressure    {1e-9 * conditions.max_pressure:.2f} GPa")
for name, formula in result.formulas().items():
    for quantity, thickness in vars(formula).items():
        if thickness is not None:
            off = 100 * (thickness / getattr(film, quantity) - 1)
            print(f"{name:<26}{quantity:<19}{1e6 * thickness:.3f} µm, {off:+.0f} %")

# %%
# A long ellipse is drawn with entrainment pointing down; its narrow axis is stretched. The film in its
# middle is that of a line contact, thinnest along the exit.
result.plot("film_map")

# %%
# The field, drawn in the same way.
result.plot("field_map")

# %%
# The key figures. In a bearing this contact is in series with that of the ball on the outer ring, and
# the balls are in parallel.
field = result.field
print(f"maximum field     {1e-6 * field.max_strength:.1f} V/µm")
print(f"V12/h_min         {1e-6 * field.voltage / film.minimum_thickness:.1f} V/µm")
print(f"capacitance       {1e12 * field.capacitance:.1f} pF")
for name, zone in result.zones.items():
    print(f"  {name:<15} {1e12 * field.capacitance_of(zone):.1f} pF")
