"""The roughness of a case: what is put on the contact, what is refused, and what is said beforehand."""

import numpy as np
import pytest

from ehlectric import Case, InputError
from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import domain_of, spacings_of
from ehlectric.runs.preview import preview_of
from ehlectric.surfaces.profiles import Profile
from ehlectric.surfaces.rough_surfaces import measured, rough_surfaces
from ehlectric.surfaces.surface_warnings import profile_variance_beyond as variance_beyond
from ehlectric.surfaces.surface_warnings import surface_warnings
from tests.conftest import PAPER_CONTACT
from tests.helpers.each import each
from tests.helpers.surface_writers import MAP, al3d
from tests.surfaces.test_files import DATA, DEKTAK

GAUSSIAN = {"surface": 1, "generator": "gaussian", "rq": "10 nm", "correlation_length": "10 um", "seed": 3}
SELF_AFFINE = {
    "surface": 1, "generator": "self-affine", "rq": "10 nm", "hurst": 0.8, "rolloff_wavelength": "50 um",
    "seed": 3,
}  # fmt: skip
CONTOUR = {"surface": 1, "file": str(DATA / "hfm-1.hfm")}
X = np.linspace(-3e-4, 3e-4, 1001)


def case_of(*tables, load=3.925e5, **grid):
    """A contact of 1 GPa: half-width 0.25 mm, domain 1.5 mm."""
    contact = PAPER_CONTACT | {"load_per_length": load}
    return Case.from_dict(
        {"contact": contact, "lubricant": {"base": "paper"}, "roughness": list(tables), "grid": grid}
    )


def surfaces_of(*tables, **changes):
    case = case_of(*tables, **changes)
    return rough_surfaces(case.roughness, domain_of(case, resolve(case)))


def texts_of(*tables, **changes):
    case = case_of(*tables, **changes)
    conditions = resolve(case)
    domain = domain_of(case, conditions)
    rough = rough_surfaces(case.roughness, domain)
    return list(map(str, surface_warnings(case.roughness, rough, domain, *spacings_of(case, conditions))))


@each("table", [GAUSSIAN, SELF_AFFINE])
@each("changes", [{"load": 4.2e5}, {"inlet": -6.0}, {"outlet": 2.3}, {"nodes": 801}], ids=str)
def test_a_seed_is_one_surface_whatever_the_contact(table, changes):
    (one,), (other,) = surfaces_of(table), surfaces_of(table, **changes)
    np.testing.assert_allclose(other.height(X), one.height(X), rtol=0.0, atol=1e-18)


@each("steps", [{}, {"shift": "1 mm"}, {"cutoff_long": "80 um"}, {"trim": "0.1 mm"}])
def test_made_surfaces_need_no_continuation(steps):
    assert texts_of(GAUSSIAN | steps) == []
    (plain,), (other,) = surfaces_of(GAUSSIAN), surfaces_of(GAUSSIAN | steps)
    if "shift" in steps:
        # The same surface, moved, where the one that is not still has its own points.
        at = X[X > 0.0]
        np.testing.assert_allclose(other.height(at), plain.height(at - 1e-3), rtol=0.0, atol=1e-18)


LONG_WAVES = [
    (
        GAUSSIAN | {"correlation_length": "0.16 mm"},
        "^roughness.correlation_length: .*0.00016 m",
    ),
    (
        SELF_AFFINE | {"rolloff_wavelength": "1 m"},
        "^roughness.rolloff_wavelength: .* 1 m.* 0.00015",
    ),
    (GAUSSIAN | {"correlation_length": "1 nm"}, "^roughness.correlation_length: .* 3.2"),
    (SELF_AFFINE | {"shortest_wavelength": "1 nm"}, "^roughness.shortest_wavelength: "),
]


@pytest.mark.slow
@pytest.mark.parametrize(("table", "message"), LONG_WAVES)
def test_waves_too_long_or_too_short_are_refused(table, message):
    with pytest.raises(InputError, match=message) as caught:
        surfaces_of(table)
    assert "\n" not in str(caught.value)


def test_where_the_instrument_has_its_zero_means_nothing():
    """Heights near 106 mm: a cut at 50 nm once made a plane of them."""
    raw, cut = surfaces_of(CONTOUR)[0], surfaces_of(CONTOUR | {"truncate": "1 um"})[0]
    assert [name for name, _ in raw.steps] == ["as read", "form: mean"]
    assert np.mean(raw.steps[0][1].heights) == pytest.approx(0.1066, rel=1e-3, abs=0.0)
    assert np.mean(raw.steps[1][1].heights) == pytest.approx(0.0, abs=1e-15)
    np.testing.assert_allclose(cut.height(X), np.clip(raw.height(X), -1e-6, 1e-6), rtol=0.0, atol=1e-12)
    assert np.std(cut.height(np.linspace(-2.3e-3, 2.3e-3, 5001))) > 5e-7


@pytest.mark.slow
def test_a_cut_that_takes_much_is_said():
    (said,) = [text for text in texts_of(CONTOUR | {"truncate": "50 nm"}) if "truncate" in text]
    share = np.mean(np.abs(surfaces_of(CONTOUR)[0].steps[1][1].heights) > 50e-9)
    assert f"truncate cuts {100 * share:.2g} % of the points" in said
    paper = {
        "surface": 1,
        "file": str(DEKTAK),
        "form": "parabola",
        "cutoff_long": "80 um",
        "truncate": "50 nm",
    }
    assert not any("truncate" in text for text in texts_of(paper, nodes=6401))


@pytest.mark.slow
@pytest.mark.parametrize("extend", ["mirror", "repeat", "flat"])
def test_nothing_is_above_a_cut(extend):
    """A spline through cut heights overshoots them by some per cent between the points."""
    table = {
        "surface": 1,
        "file": str(DEKTAK),
        "form": "parabola",
        "cutoff_long": "80 um",
        "truncate": "50 nm",
    }
    (surface,) = surfaces_of(table | {"extend": extend})
    heights = surface.height(np.linspace(-7e-4, 7e-4, 200_001))
    assert np.max(np.abs(heights)) == 50e-9


def test_voids_of_the_line_that_is_used(tmp_path):
    heights = MAP.copy()
    heights[2, 7:10] = 1e30
    path = str(al3d(tmp_path / "a.al3d", heights))
    (first, third) = surfaces_of({"surface": 1, "file": path}, {"surface": 2, "file": path, "line": 2})
    assert (first.describe()["voids"], first.warnings) == (0.0, ())
    assert third.describe()["voids"] == pytest.approx(3 / 31)
    assert "9.7 % of the line of surface 2 contained no data" in third.warnings[0].text
    assert measured(case_of({"surface": 2, "file": path, "line": 2}).roughness[0]).warnings == third.warnings


SINUSOID = {"surface": 1, "generator": "sinusoid", "amplitude": "20 nm"}
ASPERITY = {"surface": 2, "generator": "asperity", "height": "20 nm"}
PIT = {"surface": 1, "generator": "pit", "depth": "20 nm"}

# 1601 nodes are 0.936 um apart; 8 of them are 7.49 um.
SHAPES = [
    (SINUSOID | {"wavelength": "7.4 um"}, "the sinusoid of surface 1, whose wavelength is 7.4 µm"),
    (SINUSOID | {"wavelength": "7.6 um"}, None),
    (ASPERITY | {"width": "7.4 um"}, "the asperity of surface 2, whose width is 7.4 µm"),
    (ASPERITY | {"width": "7.6 um"}, None),
    (ASPERITY | {"width": "1 um", "position": "90 mm"}, None),
    (PIT | {"width": "7.6 um"}, None),
    (PIT | {"width": "7.6 um", "rim": "5 nm"}, "the rim of the pit of surface 1, whose width is 3.8 µm"),
    (PIT | {"width": "15.2 um", "rim": "5 nm"}, None),
]


@each("table, message", SHAPES)
def test_shapes_finer_than_the_grid_are_said(table, message):
    said = texts_of(table, nodes=1601)
    if message is None:
        assert said == []
    else:
        assert len(said) == 1
        assert f"does not resolve {message}. The error estimate is not meaningful" in said[0]


def test_variance_that_the_grid_misses_is_said():
    """Of two waves 9 to 1 in power: a tenth lies beyond the grid's two spacings, or none."""
    k = np.arange(6000)
    profile = Profile(0.1e-6, 3e-8 * np.sin(2 * np.pi * k / 200) + 1e-8 * np.sin(2 * np.pi * k / 15))
    assert variance_beyond(profile, 1 / 2e-6, (-1.0, 1.0)) == pytest.approx(0.1, rel=1e-2, abs=0.0)
    assert variance_beyond(profile, 1 / 1e-6, (-1.0, 1.0)) < 1e-6
    rough = SELF_AFFINE | {"hurst": 0.3, "shortest_wavelength": "1 um"}
    (said,) = texts_of(rough, nodes=1601)
    assert "of the variance of surface 1" in said
    assert "cutoff_short of at least 3.75 µm" in said
    # That cutoff does it: nothing beyond is left.
    assert texts_of(rough | {"cutoff_short": "3.75 um"}, nodes=1601) == []
    assert texts_of(rough, nodes=12_801) == []


def test_one_seed_for_two_surfaces_is_said():
    (said,) = texts_of(GAUSSIAN, GAUSSIAN | {"surface": 2})
    assert "2 rough surfaces have the seed 3" in said
    assert texts_of(GAUSSIAN, GAUSSIAN | {"surface": 2, "seed": 4}) == []


# Half-width by Hertz, (8 W R / (pi E'))^(1/2) [µm], and spacings of 401 nodes on 6 half-widths and of the
# grid that is three times refined, by a half each time. A wave needs eight spacings.
HALF_WIDTH = 1e6 * np.sqrt(8.0 * 3.925e5 * 0.0141 / (np.pi * 226e9))
FIRST, FINEST = 6.0 * HALF_WIDTH / 400, 6.0 * HALF_WIDTH / 3200


@each(
    "wavelength, grid, refine, spacing",
    [
        (8.1 * FIRST, "", 0.05, 0.0),
        (7.9 * FIRST, "first grid", 0.05, FIRST),
        (8.1 * FINEST, "first grid", 0.05, FIRST),
        (7.9 * FINEST, "finest grid", 0.05, FINEST),
        (8.1 * FINEST, "grid spacing", None, FIRST),
    ],
)
def test_a_check_names_the_grid_of_a_refinement_that_does_not_resolve_a_wave(
    wavelength, grid, refine, spacing
):
    waves = {"surface": 1, "generator": "sinusoid", "amplitude": "10 nm", "wavelength": f"{wavelength} um"}
    case = case_of(waves, nodes=401, **({} if refine is None else {"refine": refine}))
    texts = [each.text for each in preview_of(case).warnings if each.code == "roughness-unresolved"]
    assert len(texts) == bool(grid)
    for text in texts:
        assert grid in text
        assert f"{spacing:.3g} µm" in text


def test_a_check_compares_both_surfaces_with_the_grids_of_a_refinement():
    """The finest grid of 1.87 µm resolves a correlation length of 4 µm, and misses one of 3 µm."""
    made = [GAUSSIAN | {"surface": k, "correlation_length": f"{k + 2} um"} for k in (1, 2)]
    case = case_of(*made, nodes=401, refine=0.05, most_nodes=801)
    texts = [each.text for each in preview_of(case).warnings if each.code == "roughness-unresolved"]
    assert [("surface 1" in text, "finest" in text) for text in texts] == [(True, True), (False, False)]
