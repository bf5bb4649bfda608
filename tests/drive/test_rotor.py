"""Drives whose bearings carry the weight of the rotor and further forces instead of given loads."""

import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import (
    BearingCase,
    DriveCase,
    Sweep,
    calibrate,
    evaluate,
    example,
    load,
    run_sweep,
    save,
    solve_drive,
)
from ehlectric.drive.drive_cycle import check_drive_cycle
from ehlectric.errors import InputError
from ehlectric.tables.drive_tables import end_cells
from tests.helpers.statics import by_vectors

ENDS = ("drive_end", "non_drive_end")
LOADS = ("radial_load", "axial_load")
ROTOR = {"mass": "18 kg", "mass_at": "90 mm", "drive_end_at": "0 mm", "non_drive_end_at": "180 mm"}


def tables(rotor=ROTOR, force=(), **drive):
    """Tables of the example without loads, with a rotor and its forces."""
    given = DriveCase.from_toml(example("drive.toml")).to_dict()
    for end in ENDS:
        for name in LOADS:
            given[end]["bearing"].pop(name)
    given["drive"] |= {"duration": "1 ms"} | drive
    return given | {"rotor": dict(rotor), "force": list(force), "remedies": []}


def loads(case):
    """Radial and axial loads of both bearings [N]."""
    return [[getattr(each.bearing, name) for name in LOADS] for each in case.bearings]


def sweep(case, key, values):
    """Sweep of a drive over an input."""
    return Sweep.from_dict({"case": case, "vary": {key: values}})


forces = st.tuples(st.floats(-0.3, 0.3), *[st.floats(-3e3, 3e3)] * 3)


@given(
    st.lists(forces, max_size=3),
    st.floats(0.1, 400.0),
    st.floats(-0.2, 0.4),
    st.floats(-math.pi, math.pi),
    st.sampled_from(ENDS),
)
def test_loads_are_the_loads_of_vector_statics(rows, mass, place, down, locating):
    """Against five equations of equilibrium, with weight in any direction."""
    rotor = {"mass": mass, "mass_at": place, "drive_end_at": 0.02, "non_drive_end_at": 0.2}
    force = [dict(zip(("at", "x", "y", "z"), row, strict=True)) for row in rows]
    weight = 9.80665 * mass * np.array([math.cos(down), math.sin(down), 0.0])
    on_rotor = [(weight, place), *((np.array(row[1:]), row[0]) for row in rows)]
    first, second = np.split(by_vectors(on_rotor, (0.02, 0.2)), [3])
    radial = [float(np.hypot(*first[:2])), float(np.hypot(*second))]
    axial = [abs(first[2]) * (end == locating) for end in ENDS]
    if min(map(max, zip(radial, axial, strict=True))) < 1.0 or max(axial) < 1e-3:
        return
    given_loads = tables(rotor | {"locating": locating}, force, gravity_direction=down)
    found = np.array(loads(DriveCase.from_dict(given_loads)))
    assert found[:, 0] == pytest.approx(radial, rel=1e-6, abs=1e-6)
    assert found[:, 1] == pytest.approx(axial, rel=1e-6, abs=1e-6)


def test_half_of_the_weight_at_each_end():
    """18 kg in the middle: 9 kg times 9.80665 m/s^2 each; a belt of 800 N, 60 mm outside, adds by hand."""
    case = DriveCase.from_dict(tables())
    assert loads(case) == [[pytest.approx(88.25985, rel=1e-12), 0.0]] * 2
    belt = case.replace(force=[{"at": "-60 mm", "x": "800 N"}])
    levers = np.array([800.0 * 240.0 / 180.0, 800.0 * 60.0 / 180.0])
    assert [row[0] for row in loads(belt)] == pytest.approx(np.hypot(levers, 88.25985).tolist(), rel=1e-12)
    assert loads(belt.replace({"force.1.x": 0.0}))[0][0] == pytest.approx(88.25985, rel=1e-12)
    assert loads(case.replace({"rotor.mass": "36 kg"}))[0][0] == pytest.approx(176.5197, rel=1e-12)


def test_a_case_keeps_its_rotor(tmp_path):
    """Written, pickled, stored and loaded, with the loads in its summary and not in its file."""
    case = DriveCase.from_dict(tables(force=[{"at": "-60 mm", "x": "800 N"}]))
    path = tmp_path / "drive.toml"
    path.write_text(case.to_toml())
    assert DriveCase.from_toml(path) == case == pickle.loads(pickle.dumps(case))
    assert "radial_load" not in case.to_toml()
    assert DriveCase.from_dict(case.all_inputs()) == case
    result = solve_drive(case)
    save(result, tmp_path / "out")
    summaries = [each.summary() for each in (result, load(tmp_path / "out"))]
    for summary in summaries:
        assert [[summary[end][name] for name in LOADS] for end in ENDS] == loads(case)
        assert summary["inputs"]["rotor"]["mass"] == 18.0


def test_the_rotor_replaces_the_loads_of_bearing_files(tmp_path):
    """As the speed of a drive replaces the speeds of its bearings."""
    given_loads = tables()
    bearing = DriveCase.from_toml(example("drive.toml")).drive_end
    (tmp_path / "bearing.toml").write_text(bearing.to_toml())
    path = tmp_path / "drive.toml"
    del given_loads["non_drive_end"]
    given_loads["drive_end"] = bearing
    assert loads(DriveCase.from_dict(given_loads))[0][0] == pytest.approx(88.25985)
    text = DriveCase.from_dict(tables()).to_toml()
    head = text[: text.index("[drive_end]")] + '[drive_end]\nfile = "bearing.toml"\n'
    path.write_text(head)
    assert loads(DriveCase.from_toml(path))[1][0] == pytest.approx(88.25985)


@pytest.mark.parametrize(
    ("changes", "key", "text"),
    [
        ({"rotor.non_drive_end_at": 0.0}, "rotor.non_drive_end_at", "at one place"),
        ({"force": [{"at": 0.0, "z": "9 N"}]}, "rotor.locating", "missing"),
        ({"rotor.mass_at": None}, "rotor.mass_at", "missing"),
        ({"rotor.mass_at": 0.0}, "rotor", "do not load the bearing at non_drive_end"),
        ({"rotor": None, "force": [{"at": 0.0, "x": "9 N"}]}, "rotor", "places of both bearings"),
        ({"drive_end.bearing.radial_load": "9 N"}, "drive_end.bearing.radial_load", "follows from"),
        ({"bearings.bearing.axial_load": "9 N"}, "bearings.bearing.axial_load", "follows from"),
        ({"force.1.x": "9 N"}, "force.1.x", "no tables"),
    ],
)
def test_wrong_rotors_are_refused(changes, key, text):
    with pytest.raises(InputError, match=text) as refused:
        DriveCase.from_dict(tables()).replace(changes)
    assert refused.value.key == key


def test_loads_next_to_a_rotor_are_refused_all_at_once():
    given_loads = tables()
    for end in ENDS:
        given_loads[end]["bearing"]["radial_load"] = "1 kN"
    given_loads["drive_end"]["ranges"] = {"bearing.axial_load": [0.0, 10.0]}
    with pytest.raises(InputError) as refused:
        DriveCase.from_dict(given_loads)
    assert [error.key for error in refused.value.several] == [
        "drive_end.bearing.radial_load",
        "drive_end.ranges.bearing.axial_load",
        "non_drive_end.bearing.radial_load",
    ]


def test_wrong_tables_of_a_rotor_are_named_with_other_wrong_keys():
    given_loads = tables({**ROTOR, "mass": "-1 kg", "weight": "9 N"})
    given_loads["drive_end"]["bearing"]["elements"] = 0
    with pytest.raises(InputError) as refused:
        DriveCase.from_dict(given_loads)
    keys = {error.key for error in refused.value.several}
    assert keys >= {"rotor.mass", "rotor.weight", "drive_end.bearing.elements"}


def test_single_inclined_rows_are_refused():
    """Their axial loads depend on each other."""
    given_loads = tables()
    for end in ENDS:
        kept = ("inner_speed", "temperature", "composite_rq")
        keys = {key: given_loads[end]["bearing"][key] for key in kept}
        given_loads[end]["bearing"] = {"base": "7208-B", **keys}
    with pytest.raises(InputError, match="axle of one shaft") as refused:
        DriveCase.from_dict(given_loads)
    assert refused.value.key == "drive_end.bearing.base"


def test_sweeps_vary_the_mass_and_refuse_loads(tmp_path):
    """A rate for each mass; a load that follows is refused before the first point."""
    case = DriveCase.from_dict(tables())
    results = run_sweep(sweep(case, "rotor.mass", ["9 kg", "90 kg"]), tmp_path / "out", workers=1)
    radial = results.values("drive_end.radial_load")
    assert radial == pytest.approx([44.129925, 441.29925], rel=1e-12)
    for bad in ("drive_end.bearing.radial_load", "bearings.bearing.axial_load"):
        with pytest.raises(InputError, match="follows from") as refused:
            sweep(case, bad, ["1 kN", "2 kN"])
        assert refused.value.key == f"vary.{bad}"
        with pytest.raises(InputError, match="follows from"):
            evaluate(case, {bad: [1000.0, 2000.0]})
    both = evaluate(case, {"drive.speed": ["1000 rpm", "3000 rpm"]})
    heavy = evaluate(case.replace({"rotor.mass": "180 kg"}), {"drive.speed": ["1000 rpm", "3000 rpm"]})
    name = "drive_end.bearing.capacitance"
    assert np.all(heavy[name].values > both[name].values)


def test_duty_cycles_vary_no_loads_of_a_rotor(tmp_path):
    cycle = tmp_path / "cycle.csv"
    cycle.write_text("time [s],speed [rpm],radial load [N]\n0,3000,100\n1,2000,200\n")
    case = DriveCase.from_dict(tables() | {"duty": {"file": str(cycle)}})
    with pytest.raises(InputError, match="radial_load, which follow") as refused:
        check_drive_cycle(case)
    assert refused.value.key == "duty.file"


def test_a_calibrated_drive_has_given_loads():
    """The loads are uncertain inputs, and a corrected load follows from no rotor."""
    measured = {"measured": {"capacitance": "150 pF +- 5 %"}}
    case = DriveCase.from_dict(tables(ROTOR | {"mass": "180 kg"}) | measured)
    result = calibrate(case)
    assert result.case.rotor is None
    given = DriveCase.from_dict(case.with_given_loads.to_dict())
    assert loads(given) == loads(case)
    assert calibrate(given).case == result.case


def test_a_force_is_changed_by_its_keys():
    case = DriveCase.from_dict(tables(force=[{"at": "50 mm", "y": "200 N"}]))
    assert case.replace({"force.1.y": "300 N"}).force[0].y == 300.0
    with pytest.raises(InputError, match=r"^force\.1: is a table; .* as force\.1\.(at|x|y|z)$"):
        case.replace({"force.1": {"at": "60 mm"}})
    with pytest.raises(InputError, match=r"^force\.2: .* a number from 1 to 1$"):
        case.replace({"force.2": {"at": "60 mm"}})


def test_gravity_without_a_mass_is_named():
    light = {key: value for key, value in ROTOR.items() if not key.startswith("mass")}
    case = DriveCase.from_dict(tables(light, [{"at": "90 mm", "x": "1 kN"}], gravity_direction="0 deg"))
    notes = [warning for warning in solve_drive(case).warnings if warning.code == "key-unused"]
    assert ["drive.gravity_direction" in note.text for note in notes] == [True]
    turned = DriveCase.from_dict(tables(gravity_direction="0 deg"))
    assert "key-unused" not in [warning.code for warning in solve_drive(turned).warnings]


@pytest.mark.parametrize(
    "ranges",
    [{"bearing": {"radial_load": [1.0, 2000.0]}}, {"bearing.radial_load": [1.0, 2000.0]}],
    ids=["nested", "dotted"],
)
def test_ranges_of_loads_are_refused(ranges):
    """In tables, and in changes of them."""
    given_loads = tables()
    given_loads["drive_end"]["ranges"] = ranges
    for make in (
        lambda: DriveCase.from_dict(given_loads),
        lambda: DriveCase.from_dict(tables()).replace({"drive_end.ranges": ranges}),
    ):
        with pytest.raises(InputError, match="follows from") as refused:
            make()
        assert refused.value.key == "drive_end.ranges.bearing.radial_load"


def test_loads_next_to_the_name_of_a_bearing_file_are_refused(tmp_path):
    (tmp_path / "bearing.toml").write_text(DriveCase.from_toml(example("drive.toml")).drive_end.to_toml())
    text = DriveCase.from_dict(tables()).to_toml()
    head = text[: text.index("[drive_end]")] + '[drive_end]\nfile = "bearing.toml"\n'
    path = tmp_path / "drive.toml"
    path.write_text(head + '[drive_end.bearing]\nradial_load = "5 kN"\n')
    with pytest.raises(InputError, match="follows from") as refused:
        DriveCase.from_toml(path)
    assert refused.value.key == "drive_end.bearing.radial_load"


def test_errors_of_one_bearing_are_named_once():
    """The other end is equal, and is not in the file."""
    given_loads = tables()
    del given_loads["non_drive_end"]
    given_loads["drive_end"]["bearing"]["composite_rq"] = "-1 um"
    with pytest.raises(InputError) as refused:
        DriveCase.from_dict(given_loads)
    assert "non_drive_end" not in str(refused.value)
    thrust = {"base": "51208", "axial_load": "1 kN", "composite_rq": "0.05 um"}
    table = {**tables()["drive_end"], "bearing": {**thrust, "inner_speed": 100.0, "temperature": 350.0}}
    given_loads["drive_end"] = BearingCase.from_dict(table)
    with pytest.raises(InputError, match="radial") as refused:
        DriveCase.from_dict(given_loads)
    assert refused.value.key == "drive_end.bearing.radial_load"


def test_a_calibrated_drive_drops_measures_of_its_rotor():
    changes = ({"rotor.mass": "9 kg"}, {"drive.speed": "1000 rpm"})
    remedies = [{"title": str(n), "changes": change} for n, change in enumerate(changes)]
    case = DriveCase.from_dict(tables() | {"remedies": remedies})
    kept = case.with_given_loads
    assert [remedy.title for remedy in kept.remedies] == ["1"]
    assert len(kept.variants()) == 1


def test_numbers_of_both_ends_have_their_units():
    """1.07 kN and 281 N stand in one row."""
    case = DriveCase.from_dict(tables(force=[{"at": "-60 mm", "x": "800 N"}]))
    blocks = (block for _, block in end_cells(solve_drive(case).summary()))
    rows = {row[0]: row[1:] for block in blocks for row in block}
    assert rows["radial load"] == ("1.07 kN", "281 N", "")
    assert rows["axial load"] == ("0", "0", "N")


def test_forces_are_no_keys_of_points():
    case = DriveCase.from_dict(tables(force=[{"at": "-60 mm", "x": "800 N"}]))
    for key in ("force.1.x", "rotor.mass"):
        with pytest.raises(InputError, match="a key of the drive itself"):
            evaluate(case, {key: [18.0, 36.0]})
