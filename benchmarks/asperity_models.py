"""Statistical models of asperities beside contacts that are solved with a moving rough surface.

python -m benchmarks.asperity_models             (tables from the stored contacts, in seconds)
python -m benchmarks.asperity_models --figure    (and the figure of the documentation)
python -m benchmarks.asperity_models --solve     (solves the contacts that are not stored; half an hour)

The models take the numbers of the same surface, and the mean film of the solved contact.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from benchmarks.film_mixed import RoughBodies, masjedi_khonsari_point
from benchmarks.flattened_waves import flattened, point_amplitude_ratio
from benchmarks.greenwood_tripp import greenwood_tripp
from benchmarks.moving_asperities import POSED, Posed, Solved, solved, store, stored
from ehlectric.arrays import Array
from ehlectric.contact.conditions import PointConditions
from ehlectric.contact.preparation import prepare
from ehlectric.formulas.asperities import (
    LOAD_SHARE,
    AsperityContact,
    SpectralMoments,
    Summits,
    contact_time_share,
    expected_spots,
    greenwood_williamson,
    separation_of_gap,
    summit_separation,
)
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.surface_warnings import surface_moments

FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "asperity_models.png"

# Hardness of bearing steel of 700 HV for Masjedi and Khonsari [Pa].
HARDNESS = 7e9

# Shares below this are not told apart, and it is the lowest one of the figure.
LEAST = 1e-4


@dataclass(frozen=True)
class Surface:
    """Surface of a contact where it passes through the Hertz zone, and the numbers that models take.

    Attributes
    ----------
    undeformed, pressed : SpectralMoments
        Moments of the heights, and of the heights under the pressure of the film after Venner and Lubrecht.
    modulus : float
        Reduced modulus [Pa].
    pressure, zone : float
        Mean Hertz pressure [Pa], and area of the Hertz zone [m^2].
    masjedi_khonsari : float or None
        Load share by the formula.
    """

    undeformed: SpectralMoments
    pressed: SpectralMoments
    modulus: float
    pressure: float
    zone: float
    masjedi_khonsari: float | None

    @classmethod
    def of(cls, posed: Posed) -> Surface:
        """Surface of a contact; it is generated, and nothing is solved."""
        prepared = prepare(posed.case)
        contact = TransientContact.of(posed.case, prepared.rough)
        conditions, whole = contact.conditions, contact.roughness.surfaces[0].steps[-1][1]
        assert isinstance(whole, Map)
        assert isinstance(conditions, PointConditions)
        half_width, across = conditions.semi_axes
        band = Map(whole.spacing_x, whole.spacing_y, whole.heights[:, np.abs(whole.y) <= across])
        point = conditions.contact

        def kept(wavelength: Array) -> Array:
            return point_amplitude_ratio(wavelength, half_width, point.moes_m, point.moes_l)

        pressed = flattened(band.heights, (band.spacing_x, band.spacing_y), kept)
        undeformed, zone = surface_moments(band), np.pi * half_width * across
        share = masjedi_khonsari_point(point, RoughBodies(roughness=undeformed.rq, hardness=HARDNESS))
        return cls(
            undeformed=undeformed,
            pressed=surface_moments(Map(band.spacing_x, band.spacing_y, pressed)),
            modulus=point.reduced_modulus,
            pressure=conditions.carried_load / zone,
            zone=zone,
            masjedi_khonsari=share.asperity_share,
        )


def one_rough(moments: SpectralMoments, gap: ArrayLike, modulus: float) -> AsperityContact:
    """Contact of a surface and a flat with a mean gap, after Greenwood and Williamson."""
    separation = separation_of_gap(gap, moments.rq)
    distance = summit_separation(separation, moments.rq, moments.bandwidth)
    return greenwood_williamson(distance, moments.summits(), modulus)


def two_rough(moments: SpectralMoments, gap: ArrayLike, modulus: float) -> AsperityContact:
    """Contact of two equal surfaces whose heights sum up to these moments, after Greenwood and Tripp."""
    half = SpectralMoments(0.5 * moments.m0, 0.5 * moments.m2, 0.5 * moments.m4)
    each = half.summits()
    both = Summits(
        density=each.density, radius=each.radius, height_deviation=np.sqrt(2.0) * each.height_deviation
    )
    separation = separation_of_gap(gap, moments.rq)
    # The summits of both surfaces stand above their mean planes.
    distance = separation - 2.0 * (separation - summit_separation(separation, half.rq, half.bandwidth))
    return greenwood_tripp(distance, both, modulus)


@dataclass(frozen=True)
class Compared:
    """A solved contact and the models at its mean film.

    Attributes
    ----------
    row : Solved
        Means of the solved contact.
    surface : Surface
        Its surface.
    """

    row: Solved
    surface: Surface

    @property
    def gap(self) -> float:
        """Mean film of the Hertz zone [m]."""
        return 1e-9 * self.row.mean_film

    @property
    def film_parameter(self) -> float:
        """Lambda: mean film over the Rq before the surfaces are deformed."""
        return self.gap / self.surface.undeformed.rq

    @property
    def deformed_parameter(self) -> float:
        """Lambda with the Rq that is left in the contact."""
        return self.row.mean_film / self.row.rq_deformed

    @property
    def contacts(self) -> dict[str, AsperityContact]:
        """Contact by name of the model, at the mean film."""
        surface = self.surface
        return {
            "GW": one_rough(surface.undeformed, self.gap, surface.modulus),
            "GT": two_rough(surface.undeformed, self.gap, surface.modulus),
            "GW flattened": one_rough(surface.pressed, self.gap, surface.modulus),
        }

    @property
    def shares(self) -> dict[str, float]:
        """Load share by name of the model; the fits take lambda before and after deformation."""
        found = {
            name: min(1.0, float(contact.pressure) / self.surface.pressure)
            for name, contact in self.contacts.items()
        }
        for key in ("clarke", "patir_cheng"):
            law = LOAD_SHARE[key]
            found[law.name] = float(law.share(self.film_parameter))
            found[f"{law.name}, deformed"] = float(law.share(self.deformed_parameter))
        known = self.surface.masjedi_khonsari
        return found | {"Masjedi-Khonsari": float("nan") if known is None else known}

    @property
    def spots(self) -> dict[str, float]:
        """Number of spots at a time by name of the model."""
        return {
            name: float(expected_spots(contact.spots_per_area, self.surface.zone))
            for name, contact in self.contacts.items()
        }


@cache
def compared() -> tuple[Compared, ...]:
    """Stored contacts beside the models."""
    return tuple(Compared(row, Surface.of(row.posed)) for row in stored())


def _cell(value: float) -> str:
    """Two digits of a share; 0 for nothing, and an empty cell where there is no value."""
    if np.isnan(value):
        return ""
    return "0" if value == 0.0 else "< 0.0001" if value < LEAST else f"{float(f'{value:.2g}'):g}"


def _line(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def load_line(each: Compared) -> str:
    """Line of a contact in the table of load shares."""
    row, shares = each.row, each.shares
    error = f" ± {_cell(row.load_share_error)}" if row.load_share >= LEAST else ""
    models = ("GW", "GT", "GW flattened", "Patir-Cheng", "Clarke et al.", "Masjedi-Khonsari")
    cells = [f"{each.film_parameter:.2f}", f"{each.deformed_parameter:.2f}", _cell(row.load_share) + error]
    return _line([name_of(row.posed), *cells, *(_cell(shares[name]) for name in models)])


def time_line(each: Compared) -> str:
    """Line of a contact in the table of areas, spots, and shares of time with at least one spot."""
    row, spots = each.row, each.spots
    cells = [
        row.area_share,
        row.spots,
        *(spots[name] for name in ("GW", "GW flattened")),
        row.time_share,
        float(contact_time_share(row.spots)),
    ]
    return _line([name_of(row.posed), f"{each.film_parameter:.2f}", *map(_cell, cells)])


def load_table() -> list[str]:
    """Lines of the table of load shares."""
    head = "surface, nodes | λ | λ deformed | solved | GW | GT | GW flattened | Patir-Cheng | Clarke"
    names = [*head.split(" | "), "Masjedi-Khonsari"]
    return [_line(names), _line(["---"] * len(names)), *map(load_line, compared())]


def time_table() -> list[str]:
    """Lines of the table of areas, spots, and shares of time with at least one spot."""
    head = "surface, nodes | λ | area | spots: solved | GW | GW flattened | time: solved | of solved spots"
    names = head.split(" | ")
    return [_line(names), _line(["---"] * len(names)), *map(time_line, compared())]


def name_of(posed: Posed) -> str:
    """Correlation length, nodes and sliding of a contact in a table."""
    sliding = f", sliding {posed.slide_to_roll_ratio:g}" if posed.slide_to_roll_ratio else ""
    return f"{posed.correlation_length:g} µm, {posed.nodes}²{sliding}"


def _drawn(nodes: int) -> list[Compared]:
    """Contacts of the figure on a grid, by lambda: those that roll on the surface of long waves."""
    chosen = [
        each
        for each in compared()
        if (each.row.correlation_length, each.row.slide_to_roll_ratio, each.row.nodes) == (30.0, 0.0, nodes)
        and not np.isnan(each.row.load_share)
    ]
    return sorted(chosen, key=lambda each: each.film_parameter)


def _points(axis: Any, chosen: list[Compared], values: list[float], **style: Any) -> None:
    """Points over lambda; on a logarithmic axis those below its end are triangles at the end."""
    at, shown = np.array([each.film_parameter for each in chosen]), np.array(values)
    below = shown < LEAST if axis.get_yscale() == "log" else np.zeros(shown.shape, dtype=bool)
    axis.plot(at[~below], shown[~below], "o", ms=6, clip_on=False, zorder=3, **style)
    axis.plot(at[below], np.full(int(below.sum()), 1.3 * LEAST), "v", ms=6, **style)


def draw() -> None:
    """Load share and area, and the share of time with contact, over lambda."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    figure, (top, bottom) = plt.subplots(2, 1, figsize=(5.4, 8.0), sharex=True)
    figure.subplots_adjust(left=0.14, right=0.96, top=0.86, bottom=0.065, hspace=0.3)
    coarse, fine = _drawn(65), _drawn(129)
    levels = np.linspace(0.3, 3.0, 100)
    surface, at = coarse[0].surface, [each.film_parameter for each in coarse]
    whole = one_rough(surface.undeformed, levels * surface.undeformed.rq, surface.modulus)
    flat = [each.contacts["GW flattened"] for each in coarse]
    top.set_yscale("log")
    top.plot(levels, LOAD_SHARE["patir_cheng"].share(levels), "C0:", label="load, Patir-Cheng")
    top.plot(levels, whole.pressure / surface.pressure, "C0", label="load, Greenwood-Williamson")
    top.plot(at, [each.shares["GW flattened"] for each in coarse], "C0--", label="load, flattened waves")
    top.plot(levels, whole.area_fraction, "C3", label="area, Greenwood-Williamson")
    top.plot(at, [float(each.area_fraction) for each in flat], "C3--", label="area, flattened waves")
    times = contact_time_share(whole.spots_per_area * surface.zone)
    bottom.plot(levels, times, "C0", label="Greenwood-Williamson")
    times = contact_time_share([each.spots["GW flattened"] for each in coarse])
    bottom.plot(at, times, "C0--", label="flattened waves")
    bottom.plot(levels, LOAD_SHARE["clarke"].share(levels), "C2-.", label="Clarke, 1 − erf λ")
    for nodes, chosen in ((65, coarse), (129, fine)):
        for colour, what, key in (("C0", "load", "load_share"), ("C3", "area", "area_share")):
            face = colour if nodes == 65 else "white"
            _points(top, chosen, [getattr(each.row, key) for each in chosen], color=colour, mfc=face)
            top.plot([], [], "o", color=colour, mfc=face, label=f"{what}, solved, {nodes}² nodes")
        face = "k" if nodes == 65 else "white"
        _points(bottom, chosen, [each.row.time_share for each in chosen], color="k", mfc=face)
        bottom.plot([], [], "o", color="k", mfc=face, label=f"solved, {nodes}² nodes")
    top.set(ylabel="share of the load, of the Hertz zone", ylim=(LEAST, 1.0), xlim=(0.3, 3.0))
    bottom.set(xlabel="λ, mean film over undeformed Rq", ylabel="share of time with contact", ylim=(0, 1))
    for axis in (top, bottom):
        axis.legend(fontsize=9, loc="lower left", bbox_to_anchor=(-0.15, 1.0), ncols=2, frameon=False)
    figure.savefig(FIGURE, dpi=150)


def main() -> None:
    """Solve the contacts that are not stored, and print the tables of those that are."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--solve", action="store_true", help="solve the contacts that are not stored")
    parser.add_argument("--figure", action="store_true", help="draw the figure of the documentation")
    options = parser.parse_args()
    if options.solve:
        known = {row.posed for row in stored()}
        for posed in POSED:
            if posed not in known:
                store(solved(posed))
    print("\n".join([*load_table(), "", *time_table()]))
    for row in stored():
        if row.failure:
            print(f"{name_of(row.posed)}, {row.film:g}: {row.done} of {row.steps} steps, {row.failure}")
    if options.figure:
        draw()


if __name__ == "__main__":
    main()
