"""Generators of the case file and the functions that make their surfaces name the same parameters."""

from inspect import Parameter, signature

import pytest

from ehlectric.cases.roughness_inputs import GENERATORS, SHAPES
from ehlectric.surfaces import generated_maps, generated_profiles
from tests.helpers.each import each

# Keys of point contacts, whose functions alone know a second direction.
ACROSS = {"orientation", "position_y"}


def keywords(function):
    """Keywords of a function, and those of them without a default."""
    given = {p.name: p for p in signature(function).parameters.values() if p.kind is Parameter.KEYWORD_ONLY}
    return set(given), {name for name, p in given.items() if p.default is Parameter.empty}


def test_every_shape_has_a_profile_and_a_map():
    assert set(SHAPES) == set(generated_profiles.SHAPES) == set(generated_maps.SHAPES)
    assert set(SHAPES) < set(GENERATORS)


@pytest.mark.parametrize("name", SHAPES)
def test_keys_of_a_shape_are_the_keywords_of_its_functions(name):
    needed, optional = map(set, GENERATORS[name])
    assert keywords(generated_maps.SHAPES[name]) == (needed | optional, needed)
    assert keywords(generated_profiles.SHAPES[name]) == ((needed | optional) - ACROSS, needed)


@each("module", [generated_profiles, generated_maps])
@each("name", sorted(set(GENERATORS) - set(SHAPES)))
def test_random_surfaces_take_all_that_their_generators_need(module, name):
    needed, _ = GENERATORS[name]
    assert set(needed) <= keywords(getattr(module, name.replace("-", "_")))[0]
