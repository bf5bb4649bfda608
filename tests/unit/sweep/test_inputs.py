"""Sweep files: what they mean, and the one line that each bad one gets."""

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import Case, InputError, Sweep
from ehlectric.cases.input_keys import input_field, number_of
from ehlectric.contact.resolve import resolve
from ehlectric.sweep.results import Range
from tests.cli.conftest import CASE as CASE_FILE
from tests.helpers.bearings import BALLS, bearing_case
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


@pytest.mark.parametrize(
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
    with pytest.raises(InputError, match=r"roughness\.3\.rq: got '3' .* expected a number from 1 to 2"):
        rough.replace({"roughness.3.rq": 1e-8})
    with pytest.raises(
        InputError, match=r"roughness\.1\.rq: got '1' .* expected none, as there are no tables"
    ):
        CASE.replace({"roughness.1.rq": 1e-8})
    with pytest.raises(InputError, match=r"roughness\.1: is a table; expected one of its keys"):
        rough.replace({"roughness.1": {"rq": 1e-8}})


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


# Each bad sweep with a part of the one line it gets.
# ruff: noqa: E501
BAD = [
    ({}, r"^vary: got no key; expected at least one key of the case"),
    (
        {"contact.entrainment_sped": [1]},
        r"^vary\.contact\.entrainment_sped: unknown key; the nearest known one is contact\.entrainment_speed$",
    ),
    ({"contact": {"entrainment_sped": [1]}}, r"^vary\.contact\.entrainment_sped: unknown key"),
    ({"contact": [1]}, r"^vary\.contact: is a table; expected one of its keys"),
    (
        {"contact.body_1": [{}]},
        r"^vary\.contact\.body_1: is a table; expected one of its keys, as contact\.body_1\.youngs_modulus",
    ),
    (
        {"roughness.1.rescale_r": [1]},
        r"^vary\.roughness\.1\.rescale_r: unknown key; the nearest known one is roughness\.1\.rescale_rq$",
    ),
    (
        {"roughness.rescale_rq": [1]},
        r"^vary\.roughness\.rescale_rq: is a list of tables; expected .* roughness\.1\.rescale_rq",
    ),
    ({"roughness": [[]]}, r"^vary\.roughness: is a list of tables"),
    (
        {SPEED: "1 m/s"},
        r"^vary\.contact\.entrainment_speed: got '1 m/s'; expected a list of values or a table",
    ),
    ({SPEED: 1.0}, r"^vary\.contact\.entrainment_speed: got 1\.0; expected a list"),
    ({SPEED: []}, r"^vary\.contact\.entrainment_speed: got \[\]; expected a list"),
    ({SPEED: ["1 m"]}, r"^vary\.contact\.entrainment_speed: got '1 m' \(m is not a unit of this quantity\)"),
    ({SPEED: [-1]}, r"^vary\.contact\.entrainment_speed: got -1; expected .* at least 1e-09"),
    (
        {SPEED: [1, "1 m/s"]},
        r"^vary\.contact\.entrainment_speed: got 1\.0 twice; expected values that differ",
    ),
    ({SPEED: {"from": 1, "to": 2}}, r"^vary\.contact\.entrainment_speed\.count: missing"),
    ({SPEED: {"from": 1, "to": 2, "count": 1}}, r"\.count: got 1; expected how many values"),
    ({SPEED: {"from": 1, "to": 2, "count": True}}, r"\.count: got True; expected"),
    ({SPEED: {"from": 1, "to": 2, "count": 10**7}}, r"\.count: got 10000000; expected .* to 200000"),
    (
        {SPEED: {"from": 1, "count": 2}},
        r"^vary\.contact\.entrainment_speed\.to: missing; expected a number in m/s",
    ),
    (
        {SPEED: {"from": 1, "to": "2 kg", "count": 2}},
        r"\.to: got '2 kg' \(kg is not a unit of this quantity\)",
    ),
    ({SPEED: {"from": 2, "to": 1, "count": 2}}, r"\.to: got 1; expected more than from, 2$"),
    (
        {SPEED: {"from": 1, "to": 2, "cont": 2}},
        r"\.cont: unknown key; the nearest known one is contact\.entrainment_speed\.count",
    ),
    (
        {SPEED: {"from": 1, "to": 2, "count": 2, "spacing": "lin"}},
        r"\.spacing: got 'lin'; expected 'linear' or 'log'",
    ),
    (
        {"contact.slide_to_roll_ratio": {"from": -1, "to": 1, "count": 2, "spacing": "log"}},
        r"\.from: got -1; expected more than 0 with spacing 'log'",
    ),
    (
        {NODES: {"from": 101, "to": 103, "count": 4}},
        r"^vary\.grid\.nodes\.count: got 4; expected at most the whole numbers from 101 to 103",
    ),
    (
        {NODES: {"from": 101.5, "to": 103, "count": 2}},
        r"^vary\.grid\.nodes\.from: got 101\.5; expected a whole number",
    ),
    (
        {"grid.wedge": {"from": 1, "to": 2, "count": 2}},
        r"^vary\.grid\.wedge: got a range; expected a list of values, because the key is not a number",
    ),
    ({"grid.field_range": {"from": 1, "to": 2, "count": 2}}, r"^vary\.grid\.field_range: got a range"),
    (
        {"grid.wedge": ["fourth-order"]},
        r"^vary\.grid\.wedge: got 'fourth-order'; expected 'third-order', 'second-order' or 'first-order'",
    ),
    (
        {"lubricant.viscosity_law": ["roeland"]},
        r"^vary\.lubricant\.viscosity_law: got 'roeland'; .* nearest is 'roelands'",
    ),
    (
        {SPEED: [1], "contact": {"entrainment_speed": [2]}},
        r"^vary\.contact\.entrainment_speed: is given twice",
    ),
    (
        {NODES: {"from": 101, "to": 10**5, "count": 10**4}, SPEED: {"from": 1, "to": 2, "count": 101}},
        r"^vary: got 1010000 points; expected at most 200000",
    ),
]


@pytest.mark.parametrize(("vary", "message"), BAD)
def test_bad_sweeps_are_refused_in_one_line(vary, message):
    with pytest.raises(InputError, match=message) as caught:
        sweep_over(vary)
    assert "\n" not in str(caught.value)


BAD_KEYS = [
    ({"desing": "grid"}, r"^desing: unknown key; the nearest known one is design"),
    ({"design": "random"}, r"^design: got 'random'; expected 'grid', 'paired' or 'sobol'"),
    ({"samples": 8}, r"^samples: is not used by a grid design"),
    ({"seed": 8}, r"^seed: is not used by a grid design"),
    ({"design": "sobol"}, r"expected a table with from and to in a sobol design"),
    (
        {"design": "sobol", "vary": {SPEED: {"from": 1, "to": 2}}},
        r"^samples: missing; a sobol design needs it",
    ),
    (
        {"design": "sobol", "samples": 12, "vary": {SPEED: {"from": 1, "to": 2}}},
        r"^samples: got 12; expected a power of two",
    ),
    (
        {"design": "sobol", "samples": 8, "seed": -1, "vary": {SPEED: {"from": 1, "to": 2}}},
        r"^seed: got -1; expected a whole number",
    ),
    (
        {"design": "sobol", "samples": 8, "vary": {SPEED: {"from": 1, "to": 2, "count": 3}}},
        r"\.count: is not used by a sobol design",
    ),
    (
        {"design": "sobol", "samples": 2**16, "vary": {key: {"from": 1, "to": 2} for key in (SPEED, LOAD)}},
        r"^vary: got 262144 points; expected at most 200000",
    ),
    (
        {"design": "paired", "vary": {SPEED: [1, 2], LOAD: [1e5]}},
        r"^vary: got 2 of contact\.entrainment_speed, 1 of contact\.load_per_length; expected as many of each",
    ),
    ({"vary": [1]}, r"^vary: got \[1\]; expected a table"),
    ({"case": {"contact": {}}}, r"^case\.contact\.reduced_radius: missing; expected either"),
    ({"case": 3}, r"^case: got 3; expected a table"),
]


@pytest.mark.parametrize(("keys", "message"), BAD_KEYS)
def test_bad_keys_are_refused_in_one_line(keys, message):
    with pytest.raises(InputError, match=message) as caught:
        Sweep.from_dict({"case": CASE, "vary": {SPEED: [1.0]}} | keys)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("missing", ["case", "vary"])
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


@pytest.mark.parametrize(
    "key", ["title", "grid.wedge", "grid.field_range", "lubricant.base", "roughness.1.surface"]
)
def test_others_are_no_numbers(key):
    assert number_of(input_field(key)) is None


def test_values_may_be_arrays():
    speeds = np.array([1.0, 2.0, 4.0])
    base = {"case": CASE, "vary": {SPEED: speeds, "grid.nodes": np.array([801, 1601])}}
    listed = {"case": CASE, "vary": {SPEED: [1.0, 2.0, 4.0], "grid.nodes": [801, 1601]}}
    assert Sweep.from_dict(base).axes == Sweep.from_dict(listed).axes
    scalars = {"case": CASE, "vary": {SPEED: list(speeds), "grid.nodes": [np.int64(801), np.int64(1601)]}}
    assert Sweep.from_dict(scalars).axes == Sweep.from_dict(listed).axes


def test_an_unknown_key_of_a_bearing_is_answered_with_one_of_a_bearing():
    with pytest.raises(
        InputError, match=r"inner_speed: unknown key; the nearest known one is bearing\.inner_speed$"
    ):
        Sweep.from_dict({"case": bearing_case(BALLS), "vary": {"inner_speed": ["1000 rpm", "2000 rpm"]}})


def test_the_keys_of_a_range_are_told():
    vary = {SPEED: {"start": 1.0, "stop": 2.0, "num": 3}}
    match = rf"^vary\.{SPEED}: got a table of start, stop, num; expected a list of values, or a table of from, to, "
    with pytest.raises(InputError, match=match):
        Sweep.from_dict({"case": CASE, "vary": vary})
