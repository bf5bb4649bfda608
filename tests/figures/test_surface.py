"""Figures of surfaces: axes to one scale, units, and maps that have no height."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from ehlectric.figures.surface_figures import height_map, profile, save_surface
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import Profile

HEIGHTS = 1e-8 * np.random.default_rng(0).standard_normal((60, 40))


def test_maps_are_drawn_to_scale():
    """60 x 40 points, 1 and 2 um apart: the outer ones are half a spacing from the frame."""
    ax = Figure().subplots()
    assert height_map(Map(1e-6, 2e-6, HEIGHTS), ax) is ax
    assert ax.get_aspect() == 1.0
    assert (*ax.get_xlim(), *ax.get_ylim()) == pytest.approx((-30.0, 30.0, -40.0, 40.0))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("$x$ [µm]", "$y$ [µm]")
    (image,) = ax.images
    np.testing.assert_allclose(image.get_array().T * 1e-9, HEIGHTS - HEIGHTS.mean(), atol=1e-20)
    sq = 1e9 * np.std(HEIGHTS)
    assert " ".join(image.colorbar.ax.get_ylabel().split()) == f"height [nm], Sq = {sq:.3g} nm"


@pytest.mark.slow
@pytest.mark.parametrize(
    "heights", [HEIGHTS, np.zeros((60, 40)), HEIGHTS[:, :16]], ids=["rough", "flat", "narrow"]
)
def test_steps_are_saved(tmp_path, heights):
    surface = Map(1e-6, 2e-6, heights)
    for number, steps in enumerate(([("as read", surface)], [("as read", surface), ("form: line", surface)])):
        path = tmp_path / f"{number}.png"
        save_surface(steps, path)
        assert path.read_bytes().startswith(b"\x89PNG")


def test_a_negative_skewness_has_a_minus_sign():
    heights = -np.abs(HEIGHTS[:, 0])
    title = profile(Profile(1e-6, heights)).get_title(loc="left")
    assert "Rsk\u00a0−" in title
    assert "-" not in title


def test_profiles_keep_their_unit():
    ax = profile(Profile(1e-6, HEIGHTS[:, 0]))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("$x$ [µm]", "height [nm]")
