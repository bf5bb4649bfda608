"""
Is the grid fine enough?
========================

Every film includes an estimate of its discretisation error, from the two or three finest grids of the nested
iteration. Here it is compared with the true error, relative to a far finer grid.
"""

import matplotlib.pyplot as plt
import numpy as np

import ehlectric

case = ehlectric.Case.from_dict(
    {
        "contact": {
            "reduced_radius": "14.1 mm",
            "reduced_modulus": "226 GPa",
            "load_per_length": "1.57 MN/m",
            "entrainment_speed": "2 m/s",
        },
        "lubricant": {"base": "paper"},
    }
)
nodes = np.array([401, 801, 1601, 3201, 6401, 12_801, 25_601])
QUANTITIES = {
    "central_thickness": ("$h(0)$", "#0072b2"),
    "minimum_thickness": (r"$h_\mathrm{min}$", "#d55e00"),
}


def film(count, wedge):
    """Film on a grid of ``count`` nodes."""
    changes = {"grid.nodes": int(count), "grid.wedge": wedge}
    return ehlectric.solve(case.replace(changes), require_convergence=True).film


reference = film(204_801, "third-order")

# %%
# True errors of the central and of the minimum film, and the estimate, which is the larger one of the
# estimates for these two.
figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.6), sharey=True)
for ax, wedge in zip(axes, ("first-order", "second-order", "third-order"), strict=True):
    films = [film(n, wedge) for n in nodes]
    for quantity, (label, colour) in QUANTITIES.items():
        exact = getattr(reference, quantity)
        error = np.array([abs(getattr(f, quantity) / exact - 1) for f in films])
        ax.loglog(nodes, 100 * error, "o-", ms=4, color=colour, label=f"true error of {label}")
        order = -np.polyfit(np.log(nodes[3:]), np.log(error[3:]), 1)[0]
        print(f"{wedge} wedge, {quantity}: observed order {order:.2f} from {nodes[3]} nodes on")
    estimate = np.array([f.discretisation_error for f in films])
    ax.loglog(nodes, 100 * estimate, "x", ms=6, color="black", label="estimate")
    ax.set_title(f"{wedge} wedge", loc="left")
    ax.set_xlabel("nodes")
    ax.set_xticks(nodes[::2], [str(n) for n in nodes[::2]])
    ax.minorticks_off()
    ax.legend(loc="lower left")
axes[0].set_ylabel("relative error [%]")

# %%
# With the first-order wedge the central film converges with first order. With the wedges of second and third
# order it converges with second order, as the flow between the nodes is of second order. The third-order
# wedge comes with the exact mean of the fluidity, the reciprocal viscosity, between two nodes, and its errors
# are smaller by an order of magnitude. The minimum lies beside the pressure spike, a jump over two or three
# nodes on every grid, and converges more slowly. The estimate is not a bound of the error.
