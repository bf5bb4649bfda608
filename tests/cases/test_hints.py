"""Hints for unknown keys: they propose only keys that the file can use, whatever the key is."""

import re
import tomllib

import pytest

from ehlectric import BearingCase, Case, DriveCase, InputError
from ehlectric.cases.bearing_kinds import KEYS_OF_KINDS, KINDS_OF_BEARINGS
from ehlectric.cases.roughness_inputs import GENERATORS, Roughness
from ehlectric.cases.table import fields_within, nearest_key
from ehlectric.quantities.alternatives import DESCRIBED, MEASURED, ONLY
from ehlectric.sweep.sweep_inputs import Sweep
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

OF = {
    "line": {f"contact.{key}" for key in ONLY["line"]},
    "point": {f"contact.{key}" for key in ONLY["point"]}
    | {f"grid.{key}" for key in ("nodes_y", "side", "field_side", "field_nodes_y")}
    | {f"roughness.{key}" for key in ("correlation_length_y", "orientation", "position_y", "shift_y")},
}
OF["line"] |= {"discharge.length", "roughness.assume_transverse"}


def misspelt(key):
    """Wrong names near a key, which a person may write."""
    table, dot, leaf = key.rpartition(".")
    yield from (f"{table}{dot}{name}" for name in (f"{leaf}s", leaf[:-1], f"my_{leaf}", leaf.rstrip("_xy12")))


def proposed(key, model, given):
    return set(re.split(", | or ", nearest_key(key, model, given)))


@pytest.mark.parametrize("geometry", ["line", "point"])
def test_hints_of_contacts_are_of_the_same_geometry(geometry):
    other = OF["point" if geometry == "line" else "line"]
    given = {"contact": {"geometry": geometry}, "roughness": [{"file": "a.csv"}, {"generator": "gaussian"}]}
    wrong = [name for key in sorted(OF["line"] | OF["point"]) for name in misspelt(key)]
    wrong += [
        "contact.body_1.radius",
        "contact.body_2.r",
        "contact.radius",
        "contact.diameter",
        "contact.force",
    ]
    for name in wrong:
        assert not proposed(name, Case, given) & other, name


@each("number", ["1", "2"])
@each("name", ["radius", "Radius", "r", "diameter"])
def test_the_radius_of_a_body(number, name):
    key = f"contact.body_{number}.{name}"
    assert nearest_key(key, Case, {"contact": {}}) == f"contact.radius_{number}"
    of_point = nearest_key(key, Case, {"contact": {"geometry": "point"}})
    assert of_point == f"contact.body_{number}.radius_x or contact.body_{number}.radius_y"


LINE = {"load_per_length": "400 kN/m", "entrainment_speed": "2 m/s"}
STEEL = {"youngs_modulus": "206 GPa", "poissons_ratio": 0.3}


def test_the_error_of_a_case_and_of_a_sweep_of_it():
    contact = LINE | {"body_1": STEEL | {"radius": "60 mm"}, "body_2": STEEL | {"radius": "120 mm"}}
    with pytest.raises(InputError) as wrong:
        Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}})
    assert "contact.radius_1" in str(wrong.value)
    assert "radius_y" not in str(wrong.value)
    good = LINE | {"reduced_radius": "14 mm", "reduced_modulus": "226 GPa"}
    case = Case.from_dict({"contact": good, "lubricant": {"base": "paper"}})
    for key in ("contact.body_1.radius", "contact.radius"):
        with pytest.raises(InputError, match=r"contact\.radius_1") as wrong:
            Sweep.from_dict({"case": case, "vary": {key: [0.01, 0.02]}})
        assert "radius_x" not in str(wrong.value)
        with pytest.raises(InputError, match=r"contact\.radius_1") as wrong:
            case.replace({key: "10 mm"})
        assert "radius_x" not in str(wrong.value)


@pytest.mark.parametrize("kind", KINDS_OF_BEARINGS)
def test_hints_of_bearings_are_of_the_same_kind(kind):
    keys = KINDS_OF_BEARINGS[kind].keys
    foreign = {f"bearing.{key}" for key in KEYS_OF_KINDS if key not in keys}
    if "radial_clearance" not in keys:
        foreign |= {"bearing.clearance_class", "bearing.fits"}
    given = {"bearing": {"kind": kind}}
    for key in KEYS_OF_KINDS:
        for name in misspelt(f"bearing.{key}"):
            assert not proposed(name, BearingCase, given) & foreign, name
            ends = {f"drive_end.{one}" for one in foreign}
            assert not proposed(f"drive_end.{name}", DriveCase, {"drive_end": given}) & ends, name


def test_the_kind_of_a_designation_counts():
    with pytest.raises(InputError) as wrong:
        BearingCase.from_dict({"bearing": {"base": "NU 208 ECP", "iner_groove": "7 mm"}})
    assert "bearing.inner_groove" not in str(wrong.value)


def test_hints_of_rough_surfaces_are_of_their_generator():
    for generator, (needed, optional) in GENERATORS.items():
        own = {*needed, *optional}
        given = {"contact": {"geometry": "point"}, "roughness": [{"surface": 1, "generator": generator}]}
        others = {key for pair in GENERATORS.values() for key in (*pair[0], *pair[1])} - own
        for key in Roughness.model_fields:
            for name in misspelt(f"roughness.{key}"):
                assert not proposed(name, Case, given) & {f"roughness.{one}" for one in others}, name


def test_hints_of_a_source_are_of_its_kind():
    table = tomllib.loads((EXAMPLES / "drive.toml").read_text(encoding="utf-8"))
    measured = {"source": {"file": "a.csv"}}
    for key in fields_within(DriveCase):
        for name in misspelt(key) if key.startswith("source.") else ():
            assert not proposed(name, DriveCase, measured) & {f"source.{one}" for one in DESCRIBED}, name
            of_file = {f"source.{one}" for one in MEASURED if one not in ("file", "scale")}
            assert not proposed(name, DriveCase, table) & of_file, name
