"""One rough ball over speed: its contacts, the formula of Masjedi and Khonsari, and the figure."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from tests.helpers.mixed_films import at_film, gaussian, rough_point

from benchmarks.film_mixed import RoughBodies, masjedi_khonsari_point
from benchmarks.mixed_store import POINT_GRIDS, Contact, Record, composite_roughness
from ehlectric.contact.preparation import prepare
from ehlectric.formulas.asperities import LOAD_SHARE, load_shares

FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "mixed_sweep.png"

# Hardness of bearing steel of 700 HV, for the formula of Masjedi and Khonsari.
HARDNESS = 7e9

SWEPT = gaussian(100e-9, 34e-6)
SWEPT_LAMBDAS = tuple(float(ratio) for ratio in np.geomspace(0.01, 3.0, 12))


def sweep_series() -> list[Contact]:
    """One rough ball over speed, on three grids."""
    return [
        Contact("swept", point=True, table=SWEPT, nodes=nodes, ratio=ratio)
        for nodes in POINT_GRIDS
        for ratio in SWEPT_LAMBDAS
    ]


def formula_share(ratio: float) -> float | None:
    """Load share of the rough ball by the formula of Masjedi and Khonsari."""
    case = rough_point(SWEPT, nodes=65, speed=0.1)
    rq = composite_roughness(case)
    conditions = prepare(at_film(case, ratio * rq)).conditions
    return masjedi_khonsari_point(
        conditions.contact, RoughBodies(roughness=rq, hardness=HARDNESS)
    ).asperity_share


def converged(record: Record | None) -> bool:
    """Whether there is a converged film."""
    return record is not None and record["status"] == "converged"


def draw(grids_: dict[int, list[Record | None]]) -> None:
    """Share, area and film over lambda."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(7.2, 4.6), layout="constrained", sharex=True)
    fine = np.geomspace(SWEPT_LAMBDAS[0], SWEPT_LAMBDAS[-1], 200)
    for key, share in load_shares(fine).items():
        left.semilogx(fine, share, lw=1.2, label=LOAD_SHARE[key].name)
    known = [(ratio, formula_share(ratio)) for ratio in map(float, fine[::5])]
    given = np.array([(ratio, share) for ratio, share in known if share is not None])
    left.semilogx(given[:, 0], given[:, 1], "C7--", lw=1.6, label="Masjedi-Khonsari")
    for (nodes, series), style in zip(grids_.items(), (":", "--", "-"), strict=False):
        films = [each for each in series if each is not None and converged(each)]
        at, rq = [film["ratio"] for film in films], films[0]["rq"]
        drawn = {"ls": style, "lw": 1.6, "marker": "o", "ms": 3.5, "label": f"solved, {nodes}² nodes"}
        left.semilogx(at, [film["share"] for film in films], color="k", **drawn)
        right.loglog(at, [max(film["area"], 1e-9) for film in films], f"C3{style}", lw=1.6)
        films = [film for film in films if "mean_film" in film]
        at = [film["ratio"] for film in films]
        right.loglog(at, [film["mean_film"] / rq for film in films], f"C0{style}", lw=1.6)
    label = "λ, smooth film over Rq"
    left.set(xlabel=label, ylabel="share of the load on asperities", ylim=(0.0, 1.02))
    left.set_title("Solved asperities carry\nless than fits say", fontsize=11)
    figure.legend(loc="outside lower center", ncols=3, fontsize=9)
    right.set(xlabel=label, ylim=(1e-4, 10.0))
    right.set_title("Finer grids have\nfewer spots", fontsize=11)
    right.text(0.3, 1.2, "mean film outside\nthe spots over Rq", color="C0", ha="right", fontsize=10)
    right.text(0.3, 2e-3, "part of the Hertz\nzone in contact", color="C3", fontsize=10)
    figure.savefig(FIGURE, dpi=150)
