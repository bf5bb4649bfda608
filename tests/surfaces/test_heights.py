"""Surfaces from arrays in Python: the heights that are given, in inputs that are frozen and can be stored."""

import pickle

import numpy as np
import pytest

import ehlectric
from ehlectric import Case, InputError
from ehlectric.cases.roughness_inputs import Roughness
from ehlectric.cases.surface_heights import Heights
from ehlectric.surfaces.rough_surfaces import measured, measured_map
from ehlectric.sweep.engine import case_key
from tests.helpers.each import each
from tests.helpers.surface_writers import MAP, x3p

PROFILE = 1e-8 * np.sin(np.arange(400) / 9)


def table(heights=PROFILE, **keys):
    return {"surface": 1, "heights": heights, "spacing": "0.15 um"} | keys


def line_case(heights=PROFILE, **keys):
    case = Case.from_toml(ehlectric.example("line_contact.toml"))
    return case.replace(roughness=[table(heights, **keys)])


def test_an_array_gives_the_surface_of_the_file_with_its_heights(tmp_path):
    """A map and a line of it: all steps, as the same heights in an X3P file."""
    path = str(x3p(tmp_path / "a.x3p", MAP))
    for keys, function in (({}, measured_map), ({"line": 3}, measured), ({"along": "column"}, measured_map)):
        read = function(Roughness(surface=1, file=path, **keys))
        given = function(Roughness(**table(MAP, spacing_y=3e-7, **keys)))
        for (_, expected), (_, actual) in zip(read.steps, given.steps, strict=True):
            np.testing.assert_allclose(actual.heights, expected.heights, rtol=1e-12)
        assert given.extent == pytest.approx(read.extent)


@each("kind", ["array", "list", "float32", "masked", "view", "lists"])
def test_kinds_of_arrays(kind):
    given = {
        "array": PROFILE, "list": PROFILE.tolist(), "float32": PROFILE.astype("f4"),
        "masked": np.ma.masked_array(PROFILE, PROFILE > 9e-9), "view": np.repeat(PROFILE, 2)[::2],
        "lists": MAP.tolist(),
    }[kind]  # fmt: skip
    heights = Roughness(**table(given)).heights
    expected = {"masked": np.where(PROFILE > 9e-9, np.nan, PROFILE), "lists": MAP}.get(kind, PROFILE)
    np.testing.assert_allclose(heights.values, expected, rtol=1e-7)


def test_heights_are_frozen_copies():
    mine = PROFILE.copy()
    roughness = Roughness(**table(mine))
    before = hash(roughness)
    mine[:] = 0.0
    assert hash(roughness) == before
    np.testing.assert_array_equal(np.asarray(roughness.heights), PROFILE)
    with pytest.raises(ValueError, match="read-only"):
        roughness.heights.values[0] = 1.0
    restored = pickle.loads(pickle.dumps(roughness))
    assert (restored, hash(restored)) == (roughness, before)
    with pytest.raises(ValueError, match="read-only"):
        restored.heights.values[0] = 1.0
    assert Roughness(**table(2 * PROFILE)) != roughness
    assert Roughness(**table([[*PROFILE], [*PROFILE]])) != roughness


def test_heights_with_voids_are_equal_to_themselves():
    holed = np.where(np.arange(400) == 7, np.nan, PROFILE)
    assert Heights(holed) == Heights(holed.copy())
    assert hash(Heights(holed)) == hash(Heights(np.negative(-holed)))
    assert measured(Roughness(**table(holed))).voids == pytest.approx(1 / 400)


def test_a_case_with_heights_is_stored(tmp_path):
    case = line_case()
    assert case.replace(title="other").roughness == case.roughness
    assert Case.from_dict(case.to_dict()) == case
    (tmp_path / "case.toml").write_text(case.to_toml())
    assert Case.from_toml(tmp_path / "case.toml") == case
    changed = case.replace({"roughness.1.heights": 2 * PROFILE})
    assert changed.roughness[0].heights == Heights(2 * PROFILE)
    assert case_key(changed) != case_key(case) == case_key(pickle.loads(pickle.dumps(case)))


@pytest.mark.slow
@pytest.mark.gate
def test_a_result_with_heights_is_saved_and_loaded(tmp_path):
    """Large enough for the limit of an attribute in old HDF5 files, 64 kB."""
    heights = np.resize(PROFILE, (30, 400))
    result = ehlectric.solve(line_case(heights, line=0).replace({"grid.nodes": 401, "grid.refine": None}))
    ehlectric.save(result, tmp_path)
    assert ehlectric.load(tmp_path).case == result.case


@each("keys, message", [
    ({"spacing": None}, "^spacing: missing"),
    ({"file": "a.csv"}, "file and heights|heights"),
    ({"generator": "pit"}, "heights"),
    ({"x_unit": "um"}, "^x_unit: .*heights"),
    ({"spacing_y": 1e-6}, "^spacing_y: "),
    ({"heights": np.zeros((2, 2, 2))}, r"heights: .*\(2, 2, 2\)"),
    ({"heights": ["a", "b"]}, "heights: "),
    ({"heights": [[1.0], [1.0, 2.0]]}, "heights: "),
    ({"heights": [np.inf]}, "heights: .*infinite"),
    ({"heights": []}, "heights: "),
    ({"heights": "surface.npy"}, "heights: .*file"),
    ({"heights": "400:AAAA"}, "heights: "),
])  # fmt: skip
def test_heights_that_are_no_surface(keys, message):
    given = {key: value for key, value in table(**keys).items() if value is not None}
    with pytest.raises(InputError, match=message):
        Roughness.from_dict(given)


@each("heights, message", [
    (np.full(400, 3e-7), "constant"),
    (PROFILE * 1e9, "slope"),
    (PROFILE * 1e-6, "1e-11 m"),
    (PROFILE[:10], " 10 points| 10 of 10"),
    (np.where(np.arange(400) % 3 == 0, np.nan, PROFILE), " 266 of 400"),
])  # fmt: skip
def test_heights_that_are_not_credible(heights, message):
    with pytest.raises(InputError, match=message):
        measured(Roughness(**table(heights)))
