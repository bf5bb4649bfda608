"""Starved central film of circular contacts over the layer of oil, beside the published relation.

python -m benchmarks.starvation    (minutes: writes the table of docs/data and its figure)
python -m benchmarks.starvation --figure    (figure from the existing table)

The relation h_c/h_ff = r/(1 + r^gamma)^(1/gamma) with r = h_oil/(rho_c h_ff) is that of F. Chevalier, A. A.
Lubrecht, P. M. E. Cann, F. Colin and G. Dalmaz, J. Tribol. 120 (1998) 126, doi:10.1115/1.2834175,
second-hand.
"""

from __future__ import annotations

import csv
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ehlectric import Case
from ehlectric.contact.conditions import PointConditions, resolve_point
from ehlectric.contact.problems import point_film_problem
from ehlectric.film.film_solver import starved_solution
from ehlectric.film.mesh import at_centre
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import OilSupply
from ehlectric.runtime.threads import quiet_solution

ROOT = Path(__file__).parents[1]
TABLE = ROOT / "docs/data/starvation.csv"
FIGURE = ROOT / "docs/figures/starvation.png"

HEADER = """\
# Starved over flooded central film of circular contacts, by benchmarks/starvation.py: r is the layer of oil
# over rho_c h_ff, meniscus its position on the centre line over the Hertz radius.
"""

# Load [N] and entrainment speed [m/s] of the contacts, steel bodies with R = 10 mm in the oil of the paper.
# At 2 N the flooded film changes by a tenth with the domain, and a meniscus of r = 3 lies at its edge.
CONTACTS = ((20.0, 2.0), (60.0, 2.0))
PARTS = (0.1, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0)
NODES = 129

# Exponents between which the published relation is drawn.
EXPONENTS = (2.0, 3.0, 4.0, 5.0)


def published(part: NDArray[np.float64], exponent: float) -> NDArray[np.float64]:
    """Starved over flooded central film for a layer r of oil."""
    ratio: NDArray[np.float64] = part / (1.0 + part**exponent) ** (1.0 / exponent)
    return ratio


def contact(load: float, speed: float) -> Case:
    """Circular contact of steel in the oil of the paper."""
    return Case.point(
        radius_x="10 mm",
        radius_y="10 mm",
        reduced_modulus="226 GPa",
        load=load,
        entrainment_speed=speed,
        lubricant="paper",
        grid={"nodes": NODES, "nodes_y": NODES},
    )


def compute() -> list[dict[str, float]]:
    """Rows of the table: groups of the contact, layer, ratio of films and meniscus."""
    rows = []
    for load, speed in CONTACTS:
        case = contact(load, speed)
        conditions: PointConditions = resolve_point(case)
        problem = point_film_problem(case, conditions)
        with quiet_solution():
            flooded = nested_iteration(problem, None)[-1]
            density, thickness = flooded.final.coefficients.density, flooded.state.thickness
            mass = at_centre(flooded.level.mesh, density * thickness)
            for part in PARTS:
                layer = part * mass / float(density[0, 0])
                supply = OilSupply(layer=lambda y, layer=layer: np.full(y.shape, layer))
                found = starved_solution(replace(problem, supply=supply), None)
                assert found.last.status == "converged"
                starved = found.starvation
                assert starved.film_ratio is not None
                place = np.nan if starved.meniscus is None else starved.meniscus / problem.scales.length
                row = {
                    "moes_m": conditions.contact.moes_m,
                    "moes_l": conditions.contact.moes_l,
                    "part": part,
                    "ratio": starved.film_ratio,
                    "meniscus": place,
                }
                print(", ".join(f"{name} {value:.4g}" for name, value in row.items()), flush=True)
                rows.append(row)
    return rows


def write(rows: list[dict[str, float]]) -> None:
    """Write the table."""
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        file.write(HEADER)
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows({name: f"{value:.5g}" for name, value in row.items()} for row in rows)


def read() -> list[dict[str, float]]:
    """Read the table."""
    with TABLE.open(encoding="utf-8") as file:
        lines = [line for line in file if not line.startswith("#")]
    return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(lines)]


def draw(rows: list[dict[str, float]]) -> None:
    """Draw the computed films over the layer, between the published relation of both exponents."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    figure, ax = plt.subplots(figsize=(5.6, 3.8), layout="constrained")
    parts = np.geomspace(0.05, 4.0, 200)
    for number, exponent in enumerate(EXPONENTS):
        shade = str(0.8 - 0.15 * number)
        ax.plot(parts, published(parts, exponent), color=shade, lw=1.0, label=rf"$\gamma$ = {exponent:g}")
    ax.plot(parts, np.minimum(parts, 1.0), "k:", lw=1.0, label="line contact")
    groups = dict.fromkeys((row["moes_m"], row["moes_l"]) for row in rows)
    for marker, (moes_m, moes_l) in zip("osD^v", groups, strict=False):
        of = [row for row in rows if (row["moes_m"], row["moes_l"]) == (moes_m, moes_l)]
        at, ratios = [row["part"] for row in of], [row["ratio"] for row in of]
        ax.plot(
            at, ratios, marker, ms=4.5, mfc="white", label=f"solved, $M$ = {moes_m:.3g}, $L$ = {moes_l:.3g}"
        )
    ax.set_xlabel(r"layer of oil $r = h_\mathrm{oil}/(\bar\rho_\mathrm{c} h_\mathrm{c,ff})$")
    ax.set_ylabel(r"central film, starved / flooded, $h_\mathrm{c}/h_\mathrm{c,ff}$")
    ax.set_xlim(0.0, 3.2)
    ax.set_ylim(0.0, 1.05)
    ax.legend(fontsize=8, frameon=False, loc="lower right")
    figure.savefig(FIGURE, dpi=150)


if __name__ == "__main__":
    if "--figure" not in sys.argv:
        write(compute())
    draw(read())
