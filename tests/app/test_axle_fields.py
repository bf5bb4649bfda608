"""Fields of an axle: groups that follow its elements, and rules of its inputs, also for inputs of anybody."""

import pytest

from ehlectric.app.form_fields.axle_fields import (
    axle_groups,
    names_of,
    other_inputs,
    remedy_presets,
    request_of_rows,
    summary_of,
    with_bearing,
    with_force,
    with_link,
    with_shaft,
    without_shaft,
    without_table,
)
from ehlectric.app.form_fields.field_defaults import default_of
from ehlectric.app.form_fields.field_rules import changed
from ehlectric.app.form_fields.measured_fields import measured_fields
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import AXLE
from ehlectric.cases.axle_case import AxleCase
from ehlectric.errors import InputError
from tests.helpers.each import each

# Keys of the elements of the example.
ELEMENTS = [f"{name}_{n}" for name in names_of(AXLE) for n in (1, 2)] + ["mesh_1", "mesh_2"]


def test_every_element_has_a_group_with_its_fields():
    groups = {group.title: group for group in axle_groups(AXLE)}
    titles = [f"Bearing {n} of {name}" for name in names_of(AXLE) for n in (1, 2)]
    assert {*titles, "Gear mesh 1", "Gear mesh 2"} <= groups.keys()
    assert summary_of(AXLE, "Bearing 2 of intermediate") == "NU 207, 110 mm"
    # Keys without a field are listed below the form: a bulk temperature is in a field, a profile too.
    shown = {
        field.key.removesuffix(".1").removesuffix(".2") for group in groups.values() for field in group.fields
    }
    rest = {key for key in other_inputs(AXLE) if key not in shown}
    assert all(key.startswith(("bearings.", "breakdown.")) for key in rest), rest


def test_a_force_follows_its_shaft():
    """Its name, its removal, and the loads of bearings that then follow from statics."""
    loaded = with_force(AXLE)
    assert loaded.value("force") == [{"shaft": "output", "at": "0 mm", "x": "100 N"}]
    assert [group.title for group in axle_groups(loaded)].count("Force 1") == 1
    renamed = changed(loaded, {"shaft.3.name": "wheel"})
    assert renamed.value("force.1.shaft") == "wheel"
    assert without_shaft(renamed, 3).value("force") is None
    assert without_table(loaded, "force", 1) == AXLE
    bearings = [{"shaft": "a", "base": "6208", "radial_load": "1 kN"} for _ in range(2)]
    remedies = [{"title": "belt", "changes": {"force.2.x": "20 N"}}]
    both = with_force(AXLE).changed({"force.1.shaft": "rotor"})
    both = with_force(both).changed({"remedies": remedies})
    assert without_shaft(both, 1).value("remedies") == [{"title": "belt", "changes": {"force.1.x": "20 N"}}]
    assert with_force(Inputs({})).value("force.1.shaft") == ""
    alone = with_force(Inputs({"shaft": [{"name": "a"}], "bearing": bearings}))
    assert [bearing.keys() & {"radial_load"} for bearing in alone.value("bearing")] == [set(), set()]


def test_added_elements_make_a_valid_axle():
    for inputs in (with_shaft(AXLE), with_link(AXLE), with_force(AXLE), with_shaft(with_shaft(AXLE))):
        AxleCase.from_written(inputs.table)
    assert without_shaft(with_shaft(AXLE), 4) == AXLE
    lost = without_table(AXLE, "bearing", 6)
    AxleCase.from_written(with_bearing(lost, "output").table)


def test_a_new_designation_keeps_what_the_axle_gives():
    """No load, which follows from the gears, and no roughness, which all bearings share."""
    inputs = AXLE.changed({"bearings.composite_rq": "0.04 um", "bearing.4.composite_rq": None})
    bearing = changed(inputs, {"bearing.4.base": "32207"}).value("bearing.4")
    assert bearing["base"] == "32207"
    assert not {"axial_load", "radial_load", "composite_rq"} & bearing.keys()


@each("mesh", [1, 2])
def test_a_new_drawing_of_a_mesh_has_no_dimensions_of_the_example(mesh):
    """Its centre distance and tip diameters follow from the typed numbers, so that every step is valid."""
    pair, inputs = f"mesh.{mesh}.pair.gear", AXLE
    for key, value in {"teeth.2": 66, "normal_module": "2.25 mm", "helix_angle": "22 deg"}.items():
        inputs = changed(inputs, {f"{pair}.{key}": value})
        AxleCase.from_written(inputs.table)
    for key in ("centre_distance", "profile_shift", "tip_diameter"):
        assert inputs.value(f"{pair}.{key}") is None
    assert inputs.value(f"mesh.{3 - mesh}.pair") == AXLE.value(f"mesh.{3 - mesh}.pair")


def test_the_roughness_of_all_bearings_is_in_the_field_of_each_bearing():
    groups = {group.title: group for group in axle_groups(AXLE)}
    fields = {field.key: field for field in groups["Bearing 1 of rotor"].fields}
    assert AXLE.value("bearing.1.composite_rq") is None
    assert fields["bearing.1.composite_rq"].shown(AXLE)
    assert default_of(AXLE, "bearing.1.composite_rq") == AXLE.value("bearings.composite_rq") == "0.03 um"
    of_ra = AXLE.changed({"bearing.1.composite_ra": "0.02 um"})
    way = fields["bearing.1.way_roughness"]
    assert way.alternatives[way.alternative(of_ra)].label == "Ra and a factor"
    assert [fields[f"bearing.1.composite_{name}"].shown(of_ra) for name in ("rq", "ra")] == [False, True]


def test_two_tapered_bearings_are_typed_one_after_the_other():
    """The first asks for the second, and both ask for preload or play; nothing else contradicts them."""
    one = changed(AXLE, {"bearing.3.base": "32008"})
    error = request_of_rows(one, refusal(one))
    assert (error.key, error.is_missing) == ("bearing.4.base", True)
    both = changed(one, {"bearing.4.base": "32207"})
    assert (refusal(both).key, refusal(both).is_missing) == ("shaft.2.adjustment.preload", True)
    fields = [field for group in axle_groups(both) for field in group.fields]
    asked = {field.key for field in fields if ".adjustment." in field.key and field.shown(both)}
    assert asked == {f"shaft.2.adjustment.{name}" for name in ("arrangement", "preload", "axial_play")}
    played = changed(both, {"shaft.2.adjustment.axial_play": "0 um"})
    AxleCase.from_written(played.table)
    preloaded = changed(played, {"shaft.2.adjustment.preload": "500 N"})
    assert preloaded.value("shaft.2.adjustment") == {"arrangement": "O", "preload": "500 N"}
    # Other bearings have no adjustment, and one of them carries the axial force.
    balls = changed(changed(preloaded, {"bearing.3.base": "6307"}), {"bearing.4.base": "nu-207"})
    assert (balls.value("shaft.2.adjustment"), balls.value("bearing.3.locating")) == (None, True)
    AxleCase.from_written(balls.table)


def refusal(inputs):
    """Error of the inputs of an axle."""
    with pytest.raises(InputError) as caught:
        AxleCase.from_written(inputs.table)
    return caught.value


def test_numbers_in_remedies_follow_a_removed_mesh():
    changes = [{"mesh.1.gear.flank_ra": "1 um"}, {"mesh.2.gear.flank_ra": "1 um"}]
    remedies = [{"title": str(n), "changes": each} for n, each in enumerate(changes)]
    ranges = {"mesh.1.gear.flank_ra": ["1 um", "2 um"], "mesh.2.gear.flank_ra": ["1 um", "3 um"]}
    after = without_table(AXLE.changed({"remedies": remedies, "ranges": ranges}), "mesh", 1)
    assert after.value("ranges") == {"mesh.1.gear.flank_ra": ["1 um", "3 um"]}
    assert after.value("remedies") == [{"title": "1", "changes": {"mesh.1.gear.flank_ra": "1 um"}}]


def test_measured_values_stay_with_their_elements():
    """Keys of elements and shafts follow from names and numbers, as ``AxleCase`` makes them."""
    values = {f"elements.{key}.capacitance": f"{n} pF +- 5 %" for n, key in enumerate(ELEMENTS, 1)}
    values["shafts.output.voltage"] = "9 V +- 3 %"
    inputs = AXLE.changed({f"measured.{key}": value for key, value in values.items()})

    def capacitances(after):
        AxleCase.from_written(after.table)
        elements = after.value("measured.elements").items()
        return {key: int(each["capacitance"].split()[0]) for key, each in elements}

    renamed = changed(inputs, {"shaft.3.name": "wheel"})
    assert capacitances(renamed)["wheel_2"] == capacitances(inputs)["output_2"] == 6
    assert renamed.value("measured.shafts") == {"wheel": {"voltage": "9 V +- 3 %"}}
    without = without_table(inputs, "bearing", 3).changed({"bearing.3.locating": True})
    values_of_bearings = without.value("measured.elements")
    assert values_of_bearings["intermediate_1"] == {"capacitance": "4 pF +- 5 %"}
    assert "intermediate_2" not in values_of_bearings
    assert capacitances(with_bearing(without, "intermediate"))["mesh_2"] == 8
    short = without_shaft(inputs, 3)
    assert {"output_1", "mesh_2"}.isdisjoint(short.value("measured.elements"))
    assert short.value("measured.shafts") is None


@each(
    "changes",
    [
        {"measured": "rotor"},
        {"measured": {"elements": 1, "shafts": {"rotor": "9 V"}}},
        {"shaft": [1, "rotor"]},
        {"shaft": "rotor"},
        {"bearing": [{}, 3]},
        {"mesh": [{"gears": "rotor", "pair": []}]},
        {"link": [{"between": [{}]}]},
        {"remedies": [{"changes": ["link"]}, 1]},
        {"bearings": ["6208"]},
    ],
)
def test_inputs_of_anybody_have_groups(changes):
    inputs = AXLE.changed(changes)
    for group in axle_groups(inputs):
        summary_of(inputs, group.title)
    measured_fields("axle", inputs)
    other_inputs(inputs)
    remedy_presets(inputs)
    with_link(without_table(inputs, "mesh", 1))
    changed(inputs, {"bearing.1.base": "6308", "shaft.1.name": "wheel"})
