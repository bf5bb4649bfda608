"""Films by formulas beside those of the atlas: ``python -m benchmarks.atlas_formulas``.

The contacts are those of the bearings of the catalogue that lie in the atlas. Powers of M, L and k are fitted
to one half of them and judged on the other. With ``--figure`` the figure of the documentation is drawn too.
"""

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.atlas_catalogue import catalogue_contacts
from benchmarks.atlas_nodes import groups_of
from ehlectric.errors import InputError
from ehlectric.film.atlas.atlas_films import OilGroups, atlas_film, reference_laws
from ehlectric.formulas import film_line, film_point
from ehlectric.lubricant.viscosity import reciprocal_asymptotic_alpha

FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "atlas_formulas.png"

# Speed parameter eta0 u_s/(E' R) with which formulas are evaluated; it cancels.
SPEED = 1e-11

FORMULAS: dict[str, tuple[Any, ...]] = {
    "points": tuple(film_point.FORMULAS.values()),
    "lines": tuple(film_line.FORMULAS.values()),
}
FILMS = ("central", "minimum")


def formula_film(formula, groups, moes_l):
    """Central and minimum film by a formula in Moes' unit, with L of its coefficient; NaN for none."""
    speed, coefficient = 0.5 * SPEED, moes_l / SPEED**0.25
    if groups.ratio is None:
        contact = film_line.LineContact(
            reduced_radius=1.0,
            reduced_modulus=1.0,
            load_per_length=groups.moes_m * SPEED**0.5,
            entrainment_speed=speed,
            viscosity=1.0,
            pressure_viscosity_coefficient=coefficient,
        )
    else:
        load = groups.moes_m * SPEED**0.75
        contact = film_point.PointContact(
            radius_x=1.0,
            radius_y=groups.radius_ratio,
            reduced_modulus=1.0,
            load=load,
            entrainment_speed=speed,
            viscosity=1.0,
            pressure_viscosity_coefficient=coefficient,
        )
    film = formula(contact)
    found = (film.central_thickness, film.minimum_thickness)
    return [np.nan if thickness is None else thickness / SPEED**0.5 for thickness in found]


def basis(groups, order):
    """Constant and logarithms of M, L and, for points, k; with ``order`` 2 their products as well."""
    logs = [np.log(groups.moes_m), np.log(groups.moes_l)]
    logs += [] if groups.ratio is None else [np.log(groups.ratio)]
    products = [a * b for i, a in enumerate(logs) for b in logs[i:]] if order == 2 else []
    return [1.0, *logs, *products]


def fitted(contacts, films, order):
    """Numbers of a fit of the logarithm of films."""
    rows = np.array([basis(contact.groups, order) for contact in contacts])
    return np.linalg.lstsq(rows, np.log(films), rcond=None)[0]


def row(name, film, formula, off):
    """Row of the table from relative differences."""
    median, most, worst = 100.0 * np.quantile(np.abs(off), [0.5, 0.95, 1.0])
    return f"| {name} | {film} | {formula} | {median:.2g} % | {most:.2g} % | {worst:.2g} % |"


def table(kind):
    """Print the rows of one kind of contact, "points" or "lines"."""
    found = [(contact, contact.film) for contact in catalogue_contacts(kind)]
    inside = [(contact, film) for contact, film in found if film is not None]
    print(f"\n{kind}: {len(inside)} of {len(found)} in the atlas, {100 * len(inside) / len(found):.0f} %\n")
    contacts = [contact for contact, _ in inside]
    films = {name: np.array([getattr(film, name) for _, film in inside]) for name in FILMS}
    print(
        "stated error:",
        {
            name: [
                f"{100 * q:.1f} %"
                for q in np.quantile([film.errors[name] for _, film in inside], [0.5, 0.95])
            ]
            for name in FILMS
        },
    )
    print("\n| | film | formula | median | 95 % | worst |\n| --- | --- | --- | --- | --- | --- |")
    made = {
        formula.name: np.array([formula_film(formula, c.groups, c.moes_l) for c in contacts])
        for formula in FORMULAS[kind]
    }
    half = np.random.default_rng(15).permutation(len(contacts)) % 2 == 0
    first = [contact for contact, taken in zip(contacts, half, strict=True) if taken]
    for column, film in enumerate(FILMS):
        for name, values in made.items():
            if not np.isnan(values[:, column]).any():
                print(row(kind, film, name, values[:, column] / films[film] - 1.0))
        for order in (1, 2):
            numbers = fitted(first, films[film][half], order)
            rows = np.array([basis(contact.groups, order) for contact in contacts])[~half]
            name = "M^{1:.3f} L^{2:.3f}".format(*numbers) + (
                f" k^{numbers[3]:.3f}" if kind == "points" else ""
            )
            name = f"{np.exp(numbers[0]):.3f} {name}" if order == 1 else "polynomial of second order"
            print(row(kind, film, name, np.exp(rows @ numbers) / films[film][~half] - 1.0))


def curves(ratio, lubricant, loads):
    """Film of the atlas and of the formulas over the load group: dict of arrays, NaN outside the atlas."""
    laws = reference_laws()
    share = reciprocal_asymptotic_alpha(laws[0]) / OilGroups.of(*laws).alpha
    found = {"atlas": []} | {formula.name: [] for formula in FORMULAS["points"]}
    for load in loads:
        groups = groups_of(load, lubricant / load ** (1.0 / 6.0), ratio)
        try:
            found["atlas"].append(atlas_film(groups, laws).central)
        except InputError:
            found["atlas"].append(np.nan)
        for formula in FORMULAS["points"]:
            found[formula.name].append(formula_film(formula, groups, groups.moes_l * share)[0])
    return {name: np.array(values) for name, values in found.items()}


def draw():
    """Central films over N for three ratios of the semi-axes, and each formula over the atlas."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    from ehlectric.film.atlas.atlas_table import table as atlas_table

    axis = atlas_table("points").axes[0]
    loads = np.geomspace(axis[0], axis[-1], 400)
    figure, axes = plt.subplots(2, 3, figsize=(8.0, 5.0), sharex=True, sharey="row", layout="constrained")
    for (upper, lower), ratio in zip(axes.T, (1.0, 4.5, 9.5), strict=True):
        found = curves(ratio, 35.0, loads)
        for number, (name, values) in enumerate(found.items()):
            style = (
                {"color": "k", "lw": 1.6, "zorder": 5}
                if number == 0
                else {"color": f"C{number - 1}", "lw": 1.2}
            )
            upper.plot(loads, values, label=name, **style)
            lower.plot(loads, 100.0 * (values / found["atlas"] - 1.0), **style)
        upper.set(title=f"k = {ratio:g}", xscale="log", yscale="log")
        lower.set(xlabel="N", ylim=(-15.0, 45.0))
        for part in (upper, lower):
            part.grid(alpha=0.3)
    axes[0, 0].set_ylabel(r"$h(0)/(R\sqrt{\eta_0 u_s/(E'R)})$")
    axes[1, 0].set_ylabel("over the atlas, less one [%]")
    axes[0, 2].legend(fontsize="small", frameon=False)
    figure.savefig(FIGURE, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--figure", action="store_true", help="draw the figure as well")
    chosen = parser.parse_args()
    for kind in ("points", "lines"):
        table(kind)
    if chosen.figure:
        draw()


if __name__ == "__main__":
    main()
