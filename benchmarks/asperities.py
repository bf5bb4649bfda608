"""Statistical models of touching asperities beside each other: ``python -m benchmarks.asperities``.

Prints the fit of F_5/2 beside the integral, and load shares, spots and duty of an example over lambda. With
``--figure`` the figure of the documentation is drawn too.
"""

import argparse
from pathlib import Path

import numpy as np

from benchmarks.flattened_waves import flattened, point_amplitude_ratio
from benchmarks.load_sharing import film_under_share, load_sharing
from ehlectric.cases.roughness_inputs import Roughness
from ehlectric.formulas.asperities import (
    LOAD_SHARE,
    SpectralMoments,
    contact_time_share,
    expected_spots,
    greenwood_integral,
    greenwood_williamson,
    load_shares,
    profile_moments,
    summit_separation,
)
from ehlectric.surfaces.profiles import rms
from ehlectric.surfaces.rough_surfaces import measured

FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "asperities.png"

# Example: the most loaded inner contact of a 6208, 876 N with a Hertz pressure of 1.88 GPa. Both surfaces
# together have an Rq of 30 nm, the bandwidth 6 and 2e5 summits per square millimetre.
MODULUS, PRESSURE, AREA = 226e9, 1.88e9 / 1.5, 876.0 / (1.88e9 / 1.5)
RQ, BANDWIDTH, DENSITY = 30e-9, 6.0, 2e11

# Semi-axis along entrainment and Moes' groups of the example with a fluid of 3.4 mPa s at 1000 rpm.
HALF_WIDTH, MOES_M, MOES_L = 155e-6, 3.1e4, 5.9
PROFILE = Path(__file__).parents[1] / "examples" / "surfaces" / "dektak-1.csv"

# Exponent of the film over the fluid's share: a - b of Hamrock and Dowson, see ``film_under_share``.
EXPONENT = 0.14


def example():
    """Moments of the sum of both surfaces of the example."""
    waves = 6.0 * np.sqrt(3.0) * np.pi * DENSITY
    m2 = RQ**2 * waves / BANDWIDTH
    return SpectralMoments(RQ**2, m2, waves * m2)


def fit(level):
    """Fit of F_5/2 that many programs use; zero above l = 4."""
    return 4.4086e-5 * np.maximum(4.0 - level, 0.0) ** 6.804


def shared(film_parameter):
    """Load sharing of the example over lambda of smooth surfaces, and its contact with a flat."""
    summits = example().summits()

    def contact(separation):
        return greenwood_williamson(summit_separation(separation, RQ, BANDWIDTH), summits, MODULUS)

    film = film_under_share(np.asarray(film_parameter) * RQ, EXPONENT)
    found = load_sharing(film, lambda distance: contact(distance).pressure, PRESSURE, roughness=RQ)
    return found, contact(found.separation)


def tables():
    """Print the tables of the documentation."""
    print("| l | F_5/2 | fit | fit/F_5/2 - 1 |\n| --- | --- | --- | --- |")
    for level in (0.0, 1.0, 2.0, 3.0, 3.5):
        exact = float(greenwood_integral(2.5, level))
        print(f"| {level:g} | {exact:.5g} | {fit(level):.5g} | {100 * (fit(level) / exact - 1):.0f} % |")
    moments = example()
    summits = moments.summits()
    print(f"\nexample: slope {np.sqrt(moments.m2):.3g}, radius {summits.radius * 1e6:.3g} um,", end=" ")
    print(f"sigma_s {summits.height_deviation * 1e9:.3g} nm, n beta sigma {summits.roughness_parameter:.3g}")
    levels = np.array([0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0])
    found, contact = shared(levels)
    spots = expected_spots(contact.spots_per_area, AREA)
    laws = load_shares(levels)
    print("\n| lambda | share | spots | duty |", " | ".join(law.name for law in LOAD_SHARE.values()), "|")
    for k, level in enumerate(levels):
        cells = [found.asperity_share[k], spots[k], contact_time_share(spots[k])]
        cells += [share[k] for share in laws.values()]
        print(f"| {level:g} |", " | ".join(f"{float(cell):.2g}" for cell in cells), "|")


def flattening():
    """Print the spots of the measured profile on both surfaces of the example, before and under the film."""
    table = {"surface": 1, "file": str(PROFILE), "form": "parabola", "cutoff_long": "80 um"}
    profile = measured(Roughness.from_dict(table)).steps[-1][1]
    heights = profile.heights * (RQ / np.sqrt(2.0) / rms(profile.heights))

    def ratio(wavelength):
        return point_amplitude_ratio(wavelength, HALF_WIDTH, MOES_M, MOES_L)

    print("\n| heights | Rq | m4 | density | spots at a film of 60 nm |")
    for name, each in (("undeformed", heights), ("flattened", flattened(heights, profile.spacing, ratio))):
        one = profile_moments(each, profile.spacing)
        both = one + one
        contact = greenwood_williamson(
            summit_separation(60e-9, both.rq, both.bandwidth), both.summits(), MODULUS
        )
        spots = float(expected_spots(contact.spots_per_area, AREA))
        density = both.summits().density
        print(f"| {name} | {both.rq * 1e9:.3g} nm | {both.m4:.3g} | {density:.3g} | {spots:.2g} |")


def draw():
    """Shares over lambda, and the integral F_5/2 beside its fit."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(8.0, 3.6), layout="constrained")
    levels = np.linspace(0.02, 4.0, 400)
    for key, share in load_shares(levels).items():
        left.semilogy(levels, np.where(share > 0.0, share, np.nan), lw=1.2, label=LOAD_SHARE[key].name)
    sharing, _ = shared(levels)
    left.semilogy(levels, sharing.asperity_share, "k", lw=1.6, label="load sharing, example")
    left.set(
        xlabel="film parameter λ", ylabel="share of the load on asperities", ylim=(1e-5, 1.2), xlim=(0, 4)
    )
    left.set_title("Fits agree below λ = 1.5", fontsize=10)
    left.legend(fontsize=8)
    at = np.linspace(0.0, 3.98, 400)
    right.semilogy(at, greenwood_integral(2.5, at), "k", lw=1.6, label="integral")
    right.semilogy(at, fit(at), "C3--", lw=1.2, label="fit 4.4086e-5 (4 − l)^6.804")
    right.set(xlabel="separation over standard deviation l", ylabel="$F_{5/2}$", ylim=(1e-7, 1), xlim=(0, 4))
    right.set_title("The usual fit is too low", fontsize=10)
    right.legend(fontsize=8)
    figure.savefig(FIGURE, dpi=150)


def main():
    """Tables, and the figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--figure", action="store_true", help="draw the figure of the documentation")
    tables()
    flattening()
    if parser.parse_args().figure:
        draw()


if __name__ == "__main__":
    main()
