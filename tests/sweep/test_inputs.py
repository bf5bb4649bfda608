"""Sweep files: what they mean, and the one line that each bad one gets."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import Case, InputError, Sweep
from ehlectric.cases.input_keys import input_field
from ehlectric.cases.table import number_of
from ehlectric.contact.conditions import resolve
from ehlectric.sweep.points import Range
from tests.commands.conftest import CASE as CASE_FILE
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES
from tests.helpers.sweeps import CASE, LOAD, NODES, PRESSURE, SPEED, TABLE, sweep_over

ROUGH = TABLE | {
    "roughness": [
        {"surface": 1, "generator": "sinusoid", "amplitude": 1e-8, "wavelength": 1e-4},
        {"surface": 2, "generator": "gaussian", "rq": 1e-8, "correlation_length": 1e-5, "seed": 1},
    ]
}


def test_values_are_those_of_the_case_in_si():
    sweep = sweep_over(
        {
            SPEED: ["1 m/s", 2, "300 mm/s"],
            LOAD: {"from": "0.2 MN/m", "to": "2 MN/m", "count": 3, "spacing": "log"},
            "grid.wedge": ["first-order", "second-order"],
            "grid.field_range": [[-1.0, 1], [-1.25, 1.25]],
            "lubricant.viscosity": {"from": 0.01, "to": 0.05, "count": 5},
        }
    )
    assert sweep.design == "grid"
    assert sweep.axes[SPEED] == (1.0, 2.0, 0.3)
    # Evenly in the logarithm: the middle is the geometric mean.
    assert sweep.axes[LOAD] == pytest.approx((2e5, math.sqrt(4e11), 2e6), rel=1e-14)
    assert sweep.axes["grid.wedge"] == ("first-order", "second-order")
    assert sweep.axes["grid.field_range"] == ([-1.0, 1.0], [-1.25, 1.25])
    assert sweep.axes["lubricant.viscosity"] == pytest.approx((0.01, 0.02, 0.03, 0.04, 0.05), rel=1e-14)
    assert sweep.size == 3 * 3 * 2 * 2 * 5 == len(list(sweep.points()))
    assert sweep.ranges == {}


def test_tables_may_nest_under_vary():
    nested = {
        "contact": {"entrainment_speed": [1.0], "load_per_length": {"from": 1e5, "to": 1e6, "count": 2}}
    }
    flat = {SPEED: [1.0], LOAD: {"from": 1e5, "to": 1e6, "count": 2}}
    assert sweep_over(nested).vary == sweep_over(flat).vary


def test_counts_of_a_range_are_whole():
    assert sweep_over({NODES: {"from": 101, "to": 201, "count": 4}}).axes[NODES] == (101, 134, 168, 201)
    random = sweep_over({NODES: {"from": 101, "to": 104}}, design="sobol", samples=16)
    assert {point[NODES] for point in random.points()} == {101, 102, 103, 104}


def test_a_sobol_design_has_ranges_and_a_seed():
    over = {SPEED: {"from": "1 m/s", "to": "4 m/s"}, LOAD: {"from": 1e5, "to": 1e6, "spacing": "log"}}
    sweep = sweep_over(over, design="sobol", samples=8)
    assert sweep.ranges == {SPEED: Range(1.0, 4.0), LOAD: Range(1e5, 1e6, "log")}
    assert (sweep.axes, sweep.seed, sweep.size) == ({}, 0, 8 * (2 + 2))
    points = list(sweep.points())
    assert len(points) == sweep.size
    assert points == list(sweep_over(over, design="sobol", samples=8, seed=0).points())
    assert points != list(sweep_over(over, design="sobol", samples=8, seed=1).points())


def test_ranges_of_python_are_taken_as_they_are():
    over = {SPEED: Range(1.0, 4.0, "log")}
    assert sweep_over(over, design="sobol", samples=2).ranges == over


@each(
    ("key", "value", "gone"),
    [
        (PRESSURE, 1e9, "load_per_length"),
        ("contact.speed_1", 3.0, "entrainment_speed"),
        ("contact.radius_1", 0.02, "reduced_radius"),
    ],
)
def test_a_varied_key_displaces_its_alternative(key, value, gone):
    others = {"contact.speed_1": {"contact.speed_2": [1.0]}, "contact.radius_1": {"contact.radius_2": [0.03]}}
    sweep = sweep_over({key: [value]} | others.get(key, {}))
    (inputs,) = sweep.points()
    case = sweep.case.replace(inputs)
    assert getattr(case.contact, gone) is None
    assert getattr(case.contact, key.partition(".")[2]) == value
    resolve(case)


def test_rough_surfaces_count_from_one():
    sweep = Sweep.from_dict(
        {"case": ROUGH, "vary": {"roughness.2.rq": ["20 nm"], "roughness.1.amplitude": [3e-9]}}
    )
    (inputs,) = sweep.points()
    first, second = sweep.case.replace(inputs).roughness
    assert (first.amplitude, second.rq, second.correlation_length) == (3e-9, 2e-8, 1e-5)


def test_replace_refuses_surfaces_that_are_not_there():
    rough = Case.from_dict(ROUGH)
    for case, changes, key, names in (
        (rough, {"roughness.3.rq": 1e-8}, "roughness.3.rq", ["'3'", "1 to 2"]),
        (CASE, {"roughness.1.rq": 1e-8}, "roughness.1.rq", ["'1'"]),
        (rough, {"roughness.1": {"rq": 1e-8}}, "roughness.1", ["table"]),
    ):
        with pytest.raises(InputError) as caught:
            case.replace(changes)
        assert is_one_line(caught.value, key, names), caught.value


def test_files_lie_relative_to_the_sweep(tmp_path):
    (tmp_path / "cases").mkdir()
    (tmp_path / "sweeps").mkdir()
    rough = '[[roughness]]\nsurface = 1\nfile = "surface.txt"\n'
    (tmp_path / "cases" / "case.toml").write_text(CASE_FILE + rough)
    path = tmp_path / "sweeps" / "sweep.toml"
    path.write_text(
        f'case = "../cases/case.toml"\n[vary]\nroughness.1.file = ["a.txt", "{tmp_path}/b.txt"]\n'
        '[vary.contact]\nentrainment_speed = ["1 m/s"]\n'
    )
    sweep = Sweep.from_toml(path)
    assert sweep.case.roughness[0].file == str(tmp_path / "sweeps/../cases/surface.txt")
    assert sweep.axes["roughness.1.file"] == (str(tmp_path / "sweeps/a.txt"), str(tmp_path / "b.txt"))
    assert sweep.axes[SPEED] == (1.0,)


def test_a_case_may_stand_in_the_sweep_itself(tmp_path):
    path = tmp_path / "sweep.toml"
    text = CASE_FILE.replace("[contact]", "[case.contact]").replace("[lubricant]", "[case.lubricant]")
    path.write_text(
        text.replace('title = "Test"', "").replace("[grid]", "[case.grid]") + f"[vary]\n'{SPEED}' = [1]\n"
    )
    assert Sweep.from_toml(path).case.grid.nodes == 801


def test_the_example_is_a_sweep():
    sweep = Sweep.from_toml(EXAMPLES / "sweep.toml")
    assert sweep.size == 30
    assert all(sweep.case.replace(inputs) for inputs in sweep.points())


# Each wrong table of varied keys: the key that its one line begins with, and what the line names.
VARIED_SPEED = f"vary.{SPEED}"
BAD = [
    ({}, "vary", []),
    ({"contact.entrainment_sped": [1]}, "vary.contact.entrainment_sped", [SPEED]),
    ({"contact": {"entrainment_sped": [1]}}, "vary.contact.entrainment_sped", []),
    ({"contact": [1]}, "vary.contact", ["table"]),
    ({"contact.body_1": [{}]}, "vary.contact.body_1", ["table", "contact.body_1.youngs_modulus"]),
    ({"roughness.1.rescale_r": [1]}, "vary.roughness.1.rescale_r", ["roughness.1.rescale_rq"]),
    ({"roughness.rescale_rq": [1]}, "vary.roughness.rescale_rq", ["list", "roughness.1.rescale_rq"]),
    ({"roughness": [[]]}, "vary.roughness", ["list"]),
    ({SPEED: "1 m/s"}, VARIED_SPEED, ["'1 m/s'", "list", "table"]),
    ({SPEED: 1.0}, VARIED_SPEED, ["1.0", "list"]),
    ({SPEED: []}, VARIED_SPEED, ["[]", "list"]),
    ({SPEED: ["1 m"]}, VARIED_SPEED, ["'1 m'", "unit"]),
    ({SPEED: [-1]}, VARIED_SPEED, ["-1", "1e-09"]),
    ({SPEED: [1, "1 m/s"]}, VARIED_SPEED, ["1.0", "twice"]),
    ({SPEED: {"from": 1, "to": 2}}, f"{VARIED_SPEED}.count", []),
    ({SPEED: {"from": 1, "to": 2, "count": 1}}, f"{VARIED_SPEED}.count", ["1"]),
    ({SPEED: {"from": 1, "to": 2, "count": True}}, f"{VARIED_SPEED}.count", ["True"]),
    ({SPEED: {"from": 1, "to": 2, "count": 10**7}}, f"{VARIED_SPEED}.count", ["10000000", "200000"]),
    ({SPEED: {"from": 1, "count": 2}}, f"{VARIED_SPEED}.to", ["m/s"]),
    ({SPEED: {"from": 1, "to": "2 kg", "count": 2}}, f"{VARIED_SPEED}.to", ["'2 kg'", "unit"]),
    ({SPEED: {"from": 2, "to": 1, "count": 2}}, f"{VARIED_SPEED}.to", ["got 1", "2"]),
    ({SPEED: {"from": 1, "to": 2, "cont": 2}}, f"{VARIED_SPEED}.cont", [f"{SPEED}.count"]),
    (
        {SPEED: {"from": 1, "to": 2, "count": 2, "spacing": "lin"}},
        f"{VARIED_SPEED}.spacing",
        ["'lin'", "'linear'", "'log'"],
    ),
    (
        {"contact.slide_to_roll_ratio": {"from": -1, "to": 1, "count": 2, "spacing": "log"}},
        "vary.contact.slide_to_roll_ratio.from",
        ["-1", "0", "'log'"],
    ),
    ({NODES: {"from": 101, "to": 103, "count": 4}}, f"vary.{NODES}.count", ["4", "101", "103"]),
    ({NODES: {"from": 101.5, "to": 103, "count": 2}}, f"vary.{NODES}.from", ["101.5", "whole"]),
    ({"grid.wedge": {"from": 1, "to": 2, "count": 2}}, "vary.grid.wedge", ["range", "list"]),
    ({"grid.field_range": {"from": 1, "to": 2, "count": 2}}, "vary.grid.field_range", ["range"]),
    (
        {"grid.wedge": ["fourth-order"]},
        "vary.grid.wedge",
        ["'fourth-order'", "'third-order'", "'second-order'", "'first-order'"],
    ),
    ({"lubricant.viscosity_law": ["roeland"]}, "vary.lubricant.viscosity_law", ["'roeland'", "'roelands'"]),
    ({SPEED: [1], "contact": {"entrainment_speed": [2]}}, VARIED_SPEED, ["twice"]),
    (
        {NODES: {"from": 101, "to": 10**5, "count": 10**4}, SPEED: {"from": 1, "to": 2, "count": 101}},
        "vary",
        ["1010000", "200000"],
    ),
    ({SPEED: {"start": 1.0, "stop": 2.0, "num": 3}}, VARIED_SPEED, ["start", "stop", "num", "from", "to"]),
]


def is_one_line(error, key, names):
    """Whether an error is one line that begins with a key and has all names."""
    text = str(error)
    return text.startswith(f"{key}: ") and "\n" not in text and all(name in text for name in names)


@each("vary, key, names", BAD)
def test_bad_sweeps_are_refused_in_one_line(vary, key, names):
    with pytest.raises(InputError) as caught:
        sweep_over(vary)
    assert is_one_line(caught.value, key, names), caught.value


RISING = {"from": 1, "to": 2}
# Keys beside a right case and a varied speed, or in their place.
BAD_KEYS = [
    ({"desing": "grid"}, "desing", ["design"]),
    ({"design": "random"}, "design", ["'random'", "'grid'", "'paired'", "'sobol'"]),
    ({"samples": 8}, "samples", ["grid"]),
    ({"seed": 8}, "seed", ["grid"]),
    ({"design": "sobol"}, VARIED_SPEED, ["from", "to", "sobol"]),
    ({"design": "sobol", "vary": {SPEED: RISING}}, "samples", ["missing", "sobol"]),
    ({"design": "sobol", "samples": 12, "vary": {SPEED: RISING}}, "samples", ["12"]),
    ({"design": "sobol", "samples": 8, "seed": -1, "vary": {SPEED: RISING}}, "seed", ["-1"]),
    (
        {"design": "sobol", "samples": 8, "vary": {SPEED: RISING | {"count": 3}}},
        f"{VARIED_SPEED}.count",
        ["sobol"],
    ),
    (
        {"design": "sobol", "samples": 2**16, "vary": dict.fromkeys((SPEED, LOAD), RISING)},
        "vary",
        ["262144", "200000"],
    ),
    ({"design": "paired", "vary": {SPEED: [1, 2], LOAD: [1e5]}}, "vary", [f"2 of {SPEED}", f"1 of {LOAD}"]),
    ({"vary": [1]}, "vary", ["[1]", "table"]),
    ({"case": {"contact": {}}}, "case.contact.reduced_radius", ["missing"]),
    ({"case": 3}, "case", ["3", "table"]),
    (
        {"case": bearing_case(BALLS), "vary": {"inner_speed": [1.0]}},
        "vary.inner_speed",
        ["bearing.inner_speed"],
    ),
]


@each("keys, key, names", BAD_KEYS)
def test_bad_keys_are_refused_in_one_line(keys, key, names):
    with pytest.raises(InputError) as caught:
        Sweep.from_dict({"case": CASE, "vary": {SPEED: [1.0]}} | keys)
    assert is_one_line(caught.value, key, names), caught.value


@each("missing", ["case", "vary"])
def test_keys_that_are_missing(missing):
    table = {"case": CASE, "vary": {SPEED: [1.0]}}
    del table[missing]
    with pytest.raises(InputError, match=rf"^{missing}: missing"):
        Sweep.from_dict(table)


def test_what_is_wrong_with_the_case_names_its_file(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text(f'case = "case.toml"\n[vary]\n"{SPEED}" = [1]\n')
    case = tmp_path / "case.toml"
    with pytest.raises(InputError, match=rf"^{re.escape(str(case))}: cannot be read, no such file"):
        Sweep.from_toml(path)
    case.write_text(CASE_FILE.replace("2 m/s", "2 m"))
    with pytest.raises(InputError, match=rf"^{re.escape(str(case))}: contact\.entrainment_speed: got '2 m'"):
        Sweep.from_toml(path)


@given(
    st.sampled_from(
        [SPEED, LOAD, NODES, "lubricant.roelands_z", "contact.body_1.youngs_modulus", "roughness.1.rq"]
    )
)
def test_numbers_of_the_case_are_known(key):
    number = number_of(input_field(key))
    assert getattr(number, "unit", "nodes") in ("m/s", "N/m", "nodes", "", "Pa", "m")


@each("key", ["title", "grid.wedge", "grid.field_range", "lubricant.base", "roughness.1.surface"])
def test_others_are_no_numbers(key):
    assert number_of(input_field(key)) is None


def test_values_may_be_arrays():
    speeds = np.array([1.0, 2.0, 4.0])
    base = {"case": CASE, "vary": {SPEED: speeds, "grid.nodes": np.array([801, 1601])}}
    listed = {"case": CASE, "vary": {SPEED: [1.0, 2.0, 4.0], "grid.nodes": [801, 1601]}}
    assert Sweep.from_dict(base).axes == Sweep.from_dict(listed).axes
    scalars = {"case": CASE, "vary": {SPEED: list(speeds), "grid.nodes": [np.int64(801), np.int64(1601)]}}
    assert Sweep.from_dict(scalars).axes == Sweep.from_dict(listed).axes
