"""Bearings of all kinds by their designations: many points against each alone, files, and what is refused."""

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.bearing.bearing_discharges import breakdown_of
from ehlectric.bearing.bearing_kinds import KINDS
from ehlectric.bearing.loads.totals import mechanics_of
from ehlectric.bearing.many_points import columns_of
from ehlectric.bearing.rating_life import life_summary
from ehlectric.bearing.solution import capacitance
from ehlectric.bearing.solving import solution_of as bearing_solution
from ehlectric.bearing.stored import dataset_of, solution_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_kinds import KINDS_OF_BEARINGS
from ehlectric.formulas.inlet_supply import GEOMETRY_CONSTANTS
from ehlectric.quantities.inputs import inputs
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

PAIR = {"arrangement": "O", "preload": "200 N"}

# Bearing files by a name: base, loads and what else the kind needs.
BEARINGS = {
    "deep-groove": {"base": "6314-C3", "radial_load": "3 kN", "axial_load": "500 N"},
    "angular": {"base": "7210 BEP", "radial_load": "1 kN", "axial_load": "1.5 kN"},
    "angular pair": {"base": "7210 BEP", "radial_load": "2 kN", "pair": PAIR},
    "four-point": {
        "base": "QJ 208",
        "radial_load": "1 kN",
        "axial_load": "2 kN",
        "radial_clearance": "20 um",
    },
    "thrust": {"base": "51208", "axial_load": "3 kN"},
    "cylindrical": {"base": "NU 210 ECP", "radial_load": "3 kN", "radial_clearance": "20 um"},
    "needle": {"base": "HK 2020", "radial_load": "1 kN", "radial_clearance": "20 um"},
    "tapered": {"base": "32208", "radial_load": "3 kN", "axial_load": "2 kN"},
    "tapered pair": {"base": "32208", "radial_load": "3 kN", "axial_load": "500 N", "pair": PAIR},
    "thrust needle": {"base": "AXK 4060", "axial_load": "3 kN"},
}


def case_of(name, **more):
    """Bearing at 3000 rpm with films of the atlas, its motor, and its life."""
    table = {"inner_speed": "3000 rpm", "temperature": "60 degC", "composite_rq": "0.01 um"}
    other = BearingCase.from_toml(EXAMPLES / "bearing_6314.toml").to_dict()
    bearing = BEARINGS[name] | table | {"life": {"contamination_factor": 0.5}} | more
    return BearingCase.from_dict({**other, "bearing": bearing})


def numbers_of(case):
    """Capacitance, voltages, loads and lives by their keys in summary.json, without the uncertainty."""
    solution = bearing_solution(case)
    breakdown, mechanics = breakdown_of(solution), mechanics_of(solution.positions[0].equilibrium)
    return {
        "bearing.capacitance": capacitance(solution),
        "bearing.first_break": breakdown and breakdown.first_break,
        "bearing.shaft_first_break": breakdown and breakdown.shaft_first_break,
        **{f"mechanics.{key}": value for key, value in mechanics.items()},
        **{f"life.{key}": value for key, value in life_summary(solution).items()},
    }


def test_the_tables_of_kinds_agree():
    assert set(KINDS) == set(KINDS_OF_BEARINGS) == set(inputs()["bearing"]["kind"].choices)
    # SKF has no constant of radial needle bearings.
    assert set(KINDS) - set(GEOMETRY_CONSTANTS) == {"needle roller"}


@pytest.mark.slow
@pytest.mark.parametrize("name", list(BEARINGS))
def test_points_together_are_those_of_each_alone(name):
    case = case_of(name)
    load = "bearing.radial_load" if KINDS_OF_BEARINGS[case.bearing.kind].radial else "bearing.axial_load"
    own = getattr(case.bearing, load.removeprefix("bearing."))
    values = {load: own * np.array([0.4, 0.8, 1.1]), "bearing.inner_speed": np.array([150.0, 400.0, 900.0])}
    columns = columns_of(case.with_arrays(values))
    assert columns.solved.all()
    for k in range(3):
        alone = numbers_of(case.replace({key: float(array[k]) for key, array in values.items()}))
        for key, expected in alone.items():
            if expected is not None and key in columns.values:
                assert columns.values[key][k] == pytest.approx(expected, rel=2e-6, abs=1e-11), key


@each("name", ["angular pair", "four-point", "thrust", "tapered pair", "thrust needle"])
def test_a_solution_comes_back_from_its_file(name):
    solution = bearing_solution(case_of(name))
    found = solution_of(dataset_of(solution))
    assert found == solution
    assert found.positions[0].tracks == (2 if name == "four-point" else 1)


@each(
    "name, changes, text",
    [
        ("tapered", {"axial_load": "10 N"}, "axial_load: got 10 N"),
        ("tapered", {"radial_clearance": "10 um"}, "radial_clearance: is not used by a bearing of kind"),
        ("thrust", {"radial_load": "10 N"}, "radial_load: got 10 N; expected 0 in a thrust ball bearing"),
        ("needle", {"axial_load": "10 N"}, "axial_load: got 10 N; expected 0 in a needle roller bearing"),
        ("needle", {"supply": "grease"}, "supply: got 'grease'; .* no constant"),
        ("deep-groove", {"pair": PAIR}, "pair: is not used by a bearing of kind 'deep-groove ball'"),
        ("tapered", {"pair": {"arrangement": "O"}}, "pair.preload: missing"),
        ("tapered", {"pair": PAIR | {"axial_clearance": "1 um"}}, "pair.preload: got it and axial_clearance"),
        ("tapered", {"pair": PAIR | {"arrangement": "T"}}, "pair.arrangement: "),
        ("cylindrical", {"inner_ring": False}, "inner_ring: is not used"),
    ],
)
def test_what_a_kind_refuses(name, changes, text):
    with pytest.raises(InputError, match=rf"^bearing\.{text}"):
        bearing_solution(case_of(name, **changes))


def test_a_pair_has_twice_of_one_bearing():
    """With a preload and without a load the pair has the capacitance of two bearings under the preload."""
    pair = case_of("tapered pair", radial_load="1 N", axial_load="0 N", pair=PAIR | {"preload": "2 kN"})
    one = numbers_of(case_of("tapered", radial_load="0.5 N", axial_load="2 kN"))
    both = numbers_of(pair)
    assert both["bearing.capacitance"] == pytest.approx(2.0 * one["bearing.capacitance"], rel=1e-3)
    assert both["bearing.first_break"] == pytest.approx(one["bearing.first_break"], rel=1e-3)
    # ISO 281: two rows have the rating of one by 2^(7/9), and ISO 76 twice its static rating.
    assert both["life.dynamic_rating"] == pytest.approx(2.0 ** (7.0 / 9.0) * one["life.dynamic_rating"])
    assert both["life.static_rating"] == pytest.approx(2.0 * one["life.static_rating"])


def test_arrangements_carry_the_same_loads():
    """Both rings stay parallel."""
    pairs = (PAIR | {"arrangement": name} for name in ("O", "X"))
    one, other = (numbers_of(case_of("angular pair", pair=pair)) for pair in pairs)
    assert one == other


@each("name", ["thrust", "thrust needle"])
def test_an_even_load_has_the_basic_life(name):
    """Where all elements carry the same, ISO/TS 16281 and ISO 281 have the same life of balls."""
    life = numbers_of(case_of(name, inner_speed="10 rpm", composite_rq="1 nm"))
    ratio = life["life.reference_life"] / life["life.basic_life"]
    # Of rollers the load of the reference life has the power 4 in place of 10/3, and the ratings of thrust
    # rollers are divided by 0.73.
    part = life["life.equivalent_load"] / life["life.dynamic_rating"]
    expected = 1.0 if name == "thrust" else part ** (10.0 / 3.0 - 4.0) / 0.73**4
    assert ratio == pytest.approx(expected, rel=1e-3)
