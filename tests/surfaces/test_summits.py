"""Summits of profiles and maps over the sampling interval, and their table."""

import numpy as np
import pytest

from ehlectric.surfaces import generated_maps, generated_profiles
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import Profile
from ehlectric.surfaces.surface_warnings import summit_statistics, surface_moments
from ehlectric.tables.surface_tables import summits_table

LENGTH = 1e-5


def profile():
    return generated_profiles.gaussian(rq=1e-7, correlation_length=LENGTH, length=2000 * LENGTH, seed=1)


def square():
    return generated_maps.gaussian(
        rq=1e-7, correlation_length=LENGTH, reach_x=40 * LENGTH, reach_y=40 * LENGTH, seed=2
    )


def texts(table):
    return [[str(cell) for cell in column.cells] for column in table.columns]


@pytest.mark.parametrize("made", [profile, square])
def test_a_gaussian_surface_of_known_summits(made):
    """Autocorrelation exp(-(r/l)^2): m2 = 2 Rq^2/l^2, m4 = 12 Rq^2/l^4, alpha = 3, apart from sampling."""
    finest = summit_statistics(made())[0]
    assert finest["bandwidth"] == pytest.approx(3.0, rel=0.07)
    assert finest["summit_density"] == pytest.approx(6 / (6 * np.sqrt(3) * np.pi * LENGTH**2), rel=0.07)
    assert finest["summit_radius"] == pytest.approx(0.375 * np.sqrt(np.pi / 12) * LENGTH**2 / 1e-7, rel=0.07)
    assert finest["summit_deviation"] == pytest.approx(1e-7 * np.sqrt(1 - 0.8968 / 3), rel=0.07)


@pytest.mark.parametrize("made", [profile, square])
def test_intervals(made):
    surface = made()
    rows = summit_statistics(surface)
    spacing = surface.spacing if isinstance(surface, Profile) else surface.spacing_x
    assert [row["interval"] / spacing for row in rows] == pytest.approx([1, 2, 4, 8, 16][: len(rows)])
    for row in rows:
        moments = surface_moments(surface, row["interval"])
        assert (row["m0"], row["m2"], row["m4"]) == (moments.m0, moments.m2, moments.m4)
    assert ("slope_ratio" in rows[0]) == isinstance(surface, Map)


def test_a_short_surface_has_its_spacing_only():
    short = Profile(1e-6, np.random.default_rng(1).standard_normal(40) * 1e-8)
    assert [row["interval"] for row in summit_statistics(short)] == [1e-6]


@pytest.mark.parametrize(
    "surface",
    [
        Profile(1e-6, np.zeros(100)),
        Map(1e-6, 1e-6, np.zeros((20, 30))),
        Profile(1e-6, 1e-7 * np.sin(2 * np.pi * np.arange(1000) / 50)),
    ],
    ids=["flat profile", "flat map", "sinusoid"],
)
def test_surfaces_without_random_summits(surface):
    rows = summit_statistics(surface)
    assert all(row[key] is None for row in rows for key in ("summit_density", "summit_radius"))
    assert (rows[0]["bandwidth"] is None) == (rows[0]["m2"] == 0.0)
    assert "\N{EN DASH}" in texts(summits_table(rows))[5]


def test_units_of_the_table():
    row = {
        "interval": 2e-6, "m0": 4e-16, "m2": 3e-5, "m4": 5e6, "bandwidth": 6.0,
        "summit_density": 7e9, "summit_radius": 8e-6, "summit_deviation": 9e-9, "slope_ratio": 1.0,
    }  # fmt: skip
    assert [cells[0] for cells in texts(summits_table([row]))] == [
        "2", "400", "30", "5", "6", "7e+03", "8", "9", "1.00",
    ]  # fmt: skip
