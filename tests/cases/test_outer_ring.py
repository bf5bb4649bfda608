"""A rotating outer ring is not modelled, and refused by name in every way of input."""

import pytest

from ehlectric import BearingCase, DriveCase, InputError, Sweep, evaluate
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES


@pytest.fixture(scope="module")
def case():
    return BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")


@each("name", ["outer_speed", "outer_ring_speed", "outer_ring_rotates", "rotating_ring", "housing_speed"])
def test_it_is_refused_by_name(case, name):
    key = f"bearing.{name}"
    drive = DriveCase.from_toml(EXAMPLES / "drive.toml")
    tables = case.to_dict()
    for call in (
        lambda: BearingCase.from_dict(tables | {"bearing": tables["bearing"] | {name: "100 rpm"}}),
        lambda: BearingCase.of(**tables["bearing"], **{name: "100 rpm"}, lubricant=tables["lubricant"]),
        lambda: case.replace({key: "100 rpm"}),
        lambda: Sweep.from_dict({"case": case, "vary": {key: ["100 rpm", "200 rpm"]}}),
        lambda: evaluate(case, {key: ["100 rpm", "200 rpm"]}),
        lambda: drive.replace({f"bearings.{key}": "100 rpm"}),
    ):
        with pytest.raises(InputError) as caught:
            call()
        assert "outer ring is not modelled" in str(caught.value), str(caught.value)
        assert str(caught.value.key).endswith(key)


@each("name", ["outer_speed", "rotating_ring", "external_rotor"])
def test_it_is_refused_in_a_drive(name):
    drive = DriveCase.from_toml(EXAMPLES / "drive.toml")
    with pytest.raises(InputError, match=r"outer ring.* not modelled"):
        drive.replace({f"drive.{name}": "100 rpm"})
