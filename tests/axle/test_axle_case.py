"""Case of an axle: speeds, torques and loads of all shafts, its files, and inputs that it refuses."""

import math

import pytest

from ehlectric import AxleCase, DriveCase, InputError
from ehlectric.axle.many_axles import solve_axles
from ehlectric.axle.solution import loads_on_shafts, solve_elements
from tests.axle.axles import ALONE, BEARING, two_stages
from tests.gear.pairs import FZG_C_CASE
from tests.helpers.each import each
from tests.helpers.places import DATA, EXAMPLES


@pytest.mark.parametrize(
    ("torque", "radial", "axial"),
    [
        (
            "150 N m",
            [(4945.440, 2534.413), (11443.578, 15179.439), (6822.580, 14051.224)],
            [-3149.950, -2535.397, 5685.347],
        ),
        (
            "-150 N m",
            [(4298.173, 3164.348), (8581.013, 15102.733), (9690.202, 10886.516)],
            [3149.950, 2535.397, -5685.347],
        ),
    ],
)
def test_loads_of_an_axle(torque, radial, axial):
    """Loads [N] that a separate program computed, driving and coasting."""
    loads = list(loads_on_shafts(two_stages(**{"drive.torque": torque})).values())
    for of_shaft, expected, force in zip(loads, radial, axial, strict=True):
        assert of_shaft.radial == pytest.approx(expected, rel=2e-6)
        assert of_shaft.axial == pytest.approx(force, rel=2e-6)


def test_speeds_and_torques_follow_from_the_teeth():
    """Each mesh reverses the rotation; the power of all shafts is the power of the rotor."""
    case = two_stages(**{"drive.torque": "150 N m"})
    rotor, intermediate, output = case.turning().values()
    first, second = 67.0 / 23.0, 73.0 / 19.0
    assert intermediate.speed == pytest.approx(-rotor.speed / first, rel=1e-12)
    assert output.speed == pytest.approx(rotor.speed / first / second, rel=1e-12)
    assert output.torque == pytest.approx(1678.83295, rel=1e-8)
    for shaft in (intermediate, output):
        assert shaft.speed * shaft.torque == pytest.approx(rotor.speed * rotor.torque, rel=1e-12)


def test_a_mesh_gets_torque_speed_and_temperature_of_the_axle():
    """The flanks of the gear file are 5 K hotter than its oil."""
    case = two_stages(**{"drive.torque": "-20 N m", "drive.temperature": "70 degC"})
    turning = case.turning()
    first, second = (case.gear_case(number, turning).gear.operation for number in range(2))
    assert first.pinion_torque == pytest.approx(-20.0, rel=1e-12)
    assert second.pinion_torque == pytest.approx(-20.0 * 67.0 / 23.0, rel=1e-12)
    assert second.pinion_speed == pytest.approx(case.drive.speed * 23.0 / 67.0, rel=1e-12)
    assert (first.oil_temperature, first.bulk_temperature) == pytest.approx((343.15, 348.15), rel=1e-12)


def test_the_order_of_the_gears_changes_no_load():
    """Gear 1 of the second stage is on the intermediate shaft, so that torque passes from gear 1 to gear 2;
    with the output shaft as the rotor it passes from gear 2 to gear 1.
    """
    case = two_stages()
    turning = case.turning()
    table = case.to_dict()
    for shaft in table["shaft"]:
        shaft["rotor"] = shaft["name"] == "output"
    table["drive"] |= {"torque": turning["output"].torque, "speed": turning["output"].speed}
    reversed_case = AxleCase.from_dict(table)
    # The torque of the rotor now acts at the other end, so that all torques on the gears change their sign.
    back = reversed_case.turning()
    assert back["rotor"].speed == pytest.approx(turning["rotor"].speed, rel=1e-12)
    assert back["rotor"].torque == pytest.approx(turning["rotor"].torque, rel=1e-12)
    assert reversed_case.torque_of_gear(0, back) == pytest.approx(-30.0, rel=1e-12)


def test_shafts_with_a_coupling_turn_together():
    table = two_stages().to_dict()
    table["shaft"].append({"name": "wheel"})
    bearing = {**ALONE["bearing"][0], "shaft": "wheel"}
    table["bearing"] += [bearing, {**bearing, "at": "90 mm"}]
    table["link"] = [{"between": ["output", "wheel"], "kind": "insulated", "capacitance": "50 pF"}]
    turning = AxleCase.from_dict(table).turning()
    assert turning["wheel"] == turning["output"]


def test_a_case_is_written_and_read_again(tmp_path):
    case = two_stages()
    (tmp_path / "axle.toml").write_text(case.to_toml(), encoding="utf-8")
    assert AxleCase.from_toml(tmp_path / "axle.toml") == case
    assert AxleCase.from_dict(case.to_dict()) == case


def test_a_drive_file_without_shafts_is_a_drive():
    assert isinstance(DriveCase.from_toml(EXAMPLES / "drive.toml"), DriveCase)


def test_remedies_change_bearings_of_a_shaft_and_gear_files():
    case = two_stages()
    changes = {"bearing.rotor.base": "6308", "mesh.2.gear.flank_ra": "0.1 um", "link": []}
    changed = case.replace(changes)
    assert [bearing.keys["base"] for bearing in changed.bearing][:3] == ["6308", "6308", "6307"]
    assert changed.mesh[1].pair.gear.rq < case.mesh[1].pair.gear.rq
    assert changed.mesh[0] == case.mesh[0]
    ring, hybrid, *_ = case.variants()
    assert ring.circuit.grounding_ring_resistance == 1.0
    assert hybrid.bearing[1].keys["element_material"] == "silicon-nitride"
    assert not ring.remedies


def test_a_whole_file_of_an_axle_with_tapered_bearings():
    """Keys of all bearings, a ring by its kind, and all gear files; the tables of a simulation are kept."""
    case = AxleCase.from_toml(DATA / "axles" / "e_axle.toml")
    tables = [case.bearing_case(number, 100.0, 1000.0, 500.0).bearing for number in range(6)]
    assert [table.composite_rq for table in tables] == [6e-8] * 6
    assert [table.contact_resistance for table in tables] == [1.0] * 6
    assert (case.drive.duration, case.drive.seed, case.breakdown.arc_resistance) == (0.05, 1, 10.0)
    assert AxleCase.from_dict(case.to_dict()) == case
    hybrid, moved, smooth = case.variants()
    assert hybrid.link == ()
    assert [link.between for link in moved.link] == [("intermediate", "housing")]
    assert [mesh.pair.gear.flank_ra for mesh in smooth.mesh] == [(5e-8, 5e-8)] * 2


def test_keys_of_a_bearing_replace_keys_of_all_bearings():
    """Also their alternatives; heights with a normal distribution have the Rq sqrt(pi/2) Ra."""
    case = two_stages().replace({"bearings.composite_ra": 4e-8, "bearing.rotor.composite_rq": 1e-8})
    of_ra = 4e-8 * math.sqrt(0.5 * math.pi)
    rq = [case.bearing_case(n, 100.0, 1000.0, 0.0).bearing.composite_rq for n in range(6)]
    assert rq == pytest.approx([1e-8, 1e-8, of_ra, 5e-8, 2e-8, 2e-8], rel=1e-12)


def test_changes_of_links_and_shafts():
    ring = {"between": ["rotor", "housing"], "kind": "ring", "resistance": 1.0}
    case = two_stages(link=[ring, {**ring, "kind": "seal"}, ring])
    changed = case.replace({"link.ring.resistance": 2.0, "link.2.resistance": 3.0})
    assert [link.resistance for link in changed.link] == [2.0, 3.0, 2.0]
    assert [link.kind for link in case.replace({"link.ring.resistance": "none"}).link] == ["seal"]
    assert case.replace({"shaft.output.housing_capacitance": 1e-10}).shaft[2].housing_capacitance == 1e-10


@each(
    "key, value, words",
    [
        ("bearing.wheel.base", "6308", "'wheel'"),
        ("bearing.rotor", "6308", "bearing.SHAFT.KEY"),
        ("mesh.3.gear.flank_ra", "1 um", "'3'"),
        ("mesh.x", "1 um", "mesh.NUMBER.KEY"),
        ("mesh.1.gear.flank_rb", "1 um", "flank_ra"),
        ("drive.spede", 1.0, "drive.speed"),
        ("shaft.wheel.housing_capacitance", 1e-9, "'wheel'"),
        ("link.ring.resistance", 1.0, "no link"),
        ("bearings.radial_load", 1.0, "[[bearing]]"),
        ("bearings.composite_rz", 1.0, "composite_rq"),
        ("bearings", 1.0, "a table"),
    ],
)
def test_wrong_changes_are_refused(key, value, words):
    case = two_stages(remedies=[{"title": "A", "changes": {key: value}}])
    with pytest.raises(InputError, match=r"^remedies\.1\.changes\.") as refused:
        case.variants()
    assert words in str(refused.value)


def _changed(key, change):
    """Tables of the example with a change of one of its tables."""
    table = two_stages().to_dict()
    table[key] = change(table[key])
    return table


def _first(**entries):
    """Change of the first table of a list."""
    return lambda rows: [{**rows[0], **entries}, *rows[1:]]


def _loop(rows):
    """Meshes with a second path between the first and the last shaft."""
    return [*rows, {**rows[0], "gears": ["rotor", "output"]}]


def _tapered(rows):
    """Bearings of which the first is a tapered roller bearing."""
    kept = {key: value for key, value in rows[0].items() if key != "radial_clearance"}
    return [{**kept, "base": "32208", "profile": "logarithmic"}, *rows[1:]]


REFUSED = [
    ("mesh", _first(gears=["rotor", "wheel"]), "mesh.1.gears", "'wheel'"),
    ("mesh", _first(gears=["rotor", "rotor"]), "mesh.1.gears", "two different"),
    ("mesh", _first(gears=["rotor"]), "mesh.1.gears", "two"),
    ("mesh", _loop, "mesh.2.gears", "ratios that agree"),
    ("mesh", lambda rows: [*rows, rows[0]], "mesh.3.gears", "two paths"),
    ("mesh", lambda rows: rows[:1], "shaft.3.name", "'output'"),
    ("shaft", _first(rotor=False), "shaft.1.rotor", "no shaft"),
    ("shaft", lambda rows: [{**row, "rotor": True} for row in rows], "shaft.3.rotor", "3 shafts"),
    ("shaft", lambda rows: [*rows, rows[1]], "shaft.4.name", "'intermediate'"),
    ("shaft", lambda rows: [*rows, {"name": "wheel"}], "shaft.4.name", "no path to the housing"),
    ("bearing", lambda rows: [*rows, {**rows[0], "at": 0.1}], "bearing.7.shaft", "3 on shaft 'rotor'"),
    ("bearing", lambda rows: rows[1:], "bearing.1.shaft", "1 on shaft 'rotor'"),
    ("bearing", _first(locating=False), "bearing.2.locating", "'rotor'"),
    ("bearing", _first(shaft="wheel"), "bearing.1.shaft", "'wheel'"),
    ("bearing", _first(radial_load="1 kN"), "bearing.1.radial_load", "'rotor'"),
    ("bearing", _first(inner_speed="1 rpm"), "bearing.1.inner_speed", "drive"),
    ("bearing", _tapered, "bearing.2.base", "adjusted"),
    ("bearing", _first(radial_lode=1.0), "bearing.1.radial_lode", "unknown key"),
    (
        "link",
        lambda _: [{"between": ["rotor", "x"], "kind": "ring", "resistance": 1.0}],
        "link.1.between",
        "'x'",
    ),
    ("link", lambda _: [{"between": ["rotor", "housing"], "kind": "ring"}], "link.1.resistance", "missing"),
    ("link", lambda _: [{"between": ["rotor", "housing"], "kind": "spline"}], "link.1.kind", "housing"),
    ("drive", lambda row: {**row, "torque": 0.0}, "drive.torque", "0"),
]


@each("table, change, key, words", REFUSED)
def test_contradictions_are_refused(table, change, key, words):
    with pytest.raises(InputError) as refused:
        AxleCase.from_dict(_changed(table, change))
    assert refused.value.key == key
    assert words in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_shaft_that_drives_two_shafts_names_both_meshes():
    table = two_stages().to_dict()
    table["shaft"].append({"name": "other"})
    table["bearing"] += [{**row, "shaft": "other"} for row in table["bearing"][4:6]]
    table["mesh"].append({**table["mesh"][1], "gears": ["intermediate", "other"], "at": [0.09, 0.075]})
    with pytest.raises(InputError, match=r"'output' by mesh\.2\.gears and 'other' by mesh\.3") as refused:
        AxleCase.from_dict(table)
    assert refused.value.key == "mesh.3.gears"


def test_bearings_at_one_place_are_named():
    table = two_stages().to_dict()
    table["bearing"][3]["at"] = table["bearing"][2]["at"]
    with pytest.raises(InputError, match=r"bearing\.3 of shaft 'intermediate'.*bearing 2 of") as refused:
        loads_on_shafts(AxleCase.from_dict(table))
    assert refused.value.key == "bearing.4.at"


def test_a_shaft_without_gears_needs_loads():
    table = {**ALONE, "bearing": [ALONE["bearing"][0], {**ALONE["bearing"][1]}]}
    del table["bearing"][1]["radial_load"]
    with pytest.raises(InputError, match=r"bearing\.2\.radial_load"):
        AxleCase.from_dict(table)
    assert math.isclose(AxleCase.from_dict(ALONE).edge, 300.0)


def test_faces_of_a_mesh_that_do_not_overlap_are_refused():
    table = two_stages().to_dict()
    table["mesh"][1]["at"] = [0.075, 0.125]
    with pytest.raises(InputError, match=r"75 mm and 0.125 m.*one origin for all shafts") as refused:
        AxleCase.from_dict(table)
    assert refused.value.key == "mesh.2.at"


@pytest.mark.parametrize("solved", [solve_elements, lambda case: next(iter(solve_axles([case])))])
def test_a_torque_that_a_bearing_cannot_carry_is_named_with_its_load(solved):
    """A torque in N mm, typed as N m: 40 times the load that a separate program computed for 150 N m."""
    case = two_stages(**{"drive.torque": "6000 N m"})
    try:
        error = solved(case)
    except InputError as refused:
        error = refused
    assert error.key == "drive.torque"
    assert error.text.startswith(
        "got 6000 N m, with which bearing 1 of rotor carries 197.8 kN of radial load"
    )


@pytest.mark.parametrize("solved", [solve_elements, lambda case: next(iter(solve_axles([case])))])
def test_a_bearing_that_no_gear_loads_is_named(solved):
    """Statics: a spur gear in the plane of a bearing loads this bearing alone."""
    places = [(shaft, at) for shaft in ("rotor", "out") for at in ("0 mm", "200 mm")]
    mesh = {"gears": ["rotor", "out"], "at": ["0 mm", "0 mm"], "direction": "0 deg", "pair": FZG_C_CASE}
    table = {
        **ALONE,
        "shaft": [*ALONE["shaft"], {"name": "out"}],
        "bearing": [{"shaft": shaft, "at": at, **BEARING} for shaft, at in places],
        "mesh": [mesh],
    }
    loads = loads_on_shafts(AxleCase.from_dict(table))["rotor"]
    # Printed: radius of the working circle 36.6 mm, and working pressure angle.
    force = 30.0 / 36.6e-3 / math.cos(math.radians(22.4388))
    assert loads.radial == pytest.approx([force, 0.0], rel=1e-4, abs=1e-6)
    try:
        error = solved(AxleCase.from_dict(table))
    except InputError as refused:
        error = refused
    assert error.key == "bearing.2.at"
    assert "the forces on the shaft do not load the bearing" in error.text
    assert "(bearing 2 of rotor)" in error.text


def test_limits_of_angles_are_in_degrees():
    table = two_stages().to_dict()
    table["mesh"][0]["direction"] = "400 deg"
    with pytest.raises(InputError, match="at least -361 deg and at most 361 deg"):
        AxleCase.from_dict(table)


def test_an_axle_that_does_not_turn_is_refused():
    with pytest.raises(InputError, match="the axle does not turn"):
        two_stages(**{"drive.speed": "0 rpm"})


def test_a_mesh_that_raises_the_speed_has_a_note():
    """The shafts of the second stage, with 19 and 73 teeth, are swapped, which turns the output faster."""
    table = two_stages(remedies=[]).to_dict()
    usual = solve_elements(AxleCase.from_dict(table))
    table["mesh"][1]["gears"] = ["output", "intermediate"]
    swapped = solve_elements(AxleCase.from_dict(table))
    (note,) = (warning for warning in swapped.warnings if warning.code == "speed-raised")
    assert "shaft output" in note.text
    assert "speed-raised" not in [warning.code for warning in usual.warnings]


def test_all_wrong_tables_are_named_at_once():
    """Each with its key, and with the names of shafts; also ranges and remedies."""
    tables = two_stages(remedies=[]).to_dict()
    force = [{"at": 0.0, "x": "1 N"}, {"shaft": "nope", "at": "0 mm"}]
    link = [{"between": ["rotor", "x"], "kind": "ring", "resistance": "1 ohm"}]
    ranges = {"force.1.x": ["1 N", "2 N"], "shaft.nope.mass": ["1 kg", "2 kg"]}
    changes = [{"title": key, "changes": {key: "3 N"}} for key in ("force.1.x", "shaft.nope.mass")]
    alone = {**ALONE, "bearing": [{"shaft": "rotor", "at": at, "base": "6208"} for at in ("0 mm", "80 mm")]}
    expected = {
        ("force.1.shaft", "force.2.shaft", "link.1.between"): lambda: AxleCase.from_dict(
            tables | {"force": force, "link": link}
        ),
        ("force.1.x", "shaft.nope.mass"): lambda: AxleCase.from_dict(tables | {"ranges": ranges}),
        ("remedies.1.changes.force.1.x", "remedies.2.changes.shaft.nope.mass"): lambda: AxleCase.from_dict(
            tables | {"remedies": changes}
        ).variants(),
        ("bearing.1.radial_load", "bearing.2.radial_load"): lambda: AxleCase.from_dict(alone),
    }
    for keys, make in expected.items():
        with pytest.raises(InputError) as refused:
            make()
        assert tuple(error.key for error in refused.value.several) == keys
        if keys[0] == "force.1.shaft":
            assert "'rotor', 'intermediate', 'output'" in str(refused.value)


def test_an_uncertainty_of_one_bearing_names_its_shaft():
    """A range holds for both bearings of a shaft."""
    tables = two_stages().to_dict()
    tables["bearing"][1]["composite_rq"] = "0.1 um +- 0.02 um"
    with pytest.raises(InputError, match=r"bearing\.rotor\.composite_rq' in \[ranges\]") as refused:
        AxleCase.from_dict(tables)
    assert refused.value.key == "bearing.2.composite_rq"
