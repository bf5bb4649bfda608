"""Reliability factor of all lives, and static safety, against ISO 281:2007 and ISO 76 by hand."""

import math

import numpy as np
import pytest

from ehlectric import BearingCase, evaluate, solve_bearing
from ehlectric.bearing.cycle_life import LIVES, cycle_life
from ehlectric.bearing.loads.life import reliability_factor, static_load, static_load_of_rollers
from ehlectric.errors import InputError
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

# ISO 281:2007, table 12: reliability [%] and a_1.
TABLE = {
    90: 1.0, 95: 0.64, 96: 0.55, 97: 0.47, 98: 0.37, 99: 0.25, 99.2: 0.22, 99.4: 0.19, 99.6: 0.16,
    99.8: 0.12, 99.9: 0.093, 99.92: 0.087, 99.94: 0.080, 99.95: 0.077,
}  # fmt: skip
# Lives with the factor a_1, and basic lives of 90 %.
SCALED = (
    *("reliable_life", "modified_life", "film_modified_life", "reliable_reference_life"),
    *("reference_modified_life", "film_reference_modified_life", "roughened_life"),
)
BASIC = ("basic_life", "reference_life")


def bearing(**changes):
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    life = {"contamination_factor": 0.5, "roughened_rq": "0.3 um"}
    return case.replace({"contacts": "formula", "bearing.life": life} | changes)


def test_the_table_of_the_standard():
    for percent, factor in TABLE.items():
        assert reliability_factor(percent / 100.0) == pytest.approx(factor, rel=1e-9)


def test_between_its_values_it_is_the_weibull_law_of_three_parameters():
    """a_1 = 0.95 (ln(1/S)/ln(1/0.9))^(2/3) + 0.05; the table rounds it by up to 2 %."""
    for reliability in np.linspace(0.9, 0.9995, 200):
        law = 0.95 * (math.log(1.0 / reliability) / math.log(1.0 / 0.9)) ** (2.0 / 3.0) + 0.05
        assert reliability_factor(reliability) == pytest.approx(law, rel=0.025)


def test_all_lives_but_the_basic_ones_have_the_factor():
    usual, reliable = (
        solve_bearing(bearing(**{"bearing.life.reliability": value}), workers=1).summary()["life"]
        for value in (0.9, "99 %")
    )
    assert (usual["reliability_factor"], reliable["reliability_factor"]) == (1.0, 0.25)
    for key in SCALED:
        assert reliable[key] == pytest.approx(0.25 * usual[key], rel=1e-12), key
    for key in (*BASIC, "life_factor", "static_safety"):
        assert reliable[key] == usual[key], key
    assert (usual["reliable_life"], usual["reliable_reference_life"]) == (
        usual["basic_life"],
        usual["reference_life"],
    )


def test_many_points_have_the_lives_of_each_point():
    values = [0.9, 0.95, 0.9995]
    found = evaluate(bearing(), {"bearing.life.reliability": ["90 %", "95 %", "99.95 %"]})
    for place, value in enumerate(values):
        alone = solve_bearing(bearing(**{"bearing.life.reliability": value}), workers=1).summary()["life"]
        for key in (*SCALED, *BASIC, "reliability_factor", "static_equivalent_load", "static_safety"):
            assert float(found[f"life.{key}"][place]) == pytest.approx(alone[key], rel=1e-8), key


def test_lives_of_a_duty_cycle_have_the_factor():
    given = {
        "speed": np.array([100.0, 300.0]), "duration": np.array([10.0, 20.0]),
        "radial_load": np.array([1000.0, 2000.0]), "axial_load": np.array([0.0, 100.0]),
    }  # fmt: skip
    values = {
        "viscosity": np.full(2, 2e-5), "lambda_ratio": np.full(2, 2.0),
        "reference_turns": np.array([3e9, 4e8]),
    }  # fmt: skip
    usual, reliable = (
        cycle_life(bearing(**{"bearing.life.reliability": value}), given, values, 30.0)
        for value in (0.9, 0.95)
    )
    assert set(LIVES) == {*SCALED, *BASIC}
    for key in LIVES:
        factor = 1.0 if key in BASIC else 0.64
        assert getattr(reliable, key) == pytest.approx(factor * getattr(usual, key), rel=1e-12), key


def test_the_table_shows_the_factor_only_for_another_reliability():
    keys = {"life.reliability_factor", "life.reliable_life", "life.reliable_reference_life"}
    for value, shown in ((0.9, set()), (0.97, keys)):
        result = solve_bearing(bearing(**{"bearing.life.reliability": value}), workers=1)
        rows = total_rows(result.summary())
        found = {row.key: row.text for row in rows}
        assert keys & set(found) == shown
        assert "life.static_safety" in found


@each("given", [99, "99", "89.9 %", "99.96 %", 1.0, "high"])
def test_other_reliabilities_are_refused(given):
    with pytest.raises(InputError) as caught:
        bearing(**{"bearing.life.reliability": given})
    assert caught.value.key == "bearing.life.reliability"
    assert "0.9995" in str(caught.value)


@each(
    "loads, angle, rows, expected",
    [
        # X_0 and Y_0 of the catalogue of Koyo (JTEKT), static equivalent load, and of ISO 76.
        ((1000.0, 0.0), 0.0, 1, 1000.0),
        ((1000.0, 500.0), 0.0, 1, 1000.0),
        ((1000.0, 1000.0), 0.0, 1, 0.6 * 1000 + 0.5 * 1000),
        ((1000.0, 2000.0), 15.0, 1, 0.5 * 1000 + 0.46 * 2000),
        ((1000.0, 2000.0), 30.0, 1, 0.5 * 1000 + 0.33 * 2000),
        ((1000.0, 4000.0), 40.0, 1, 0.5 * 1000 + 0.26 * 4000),
        ((1000.0, 1000.0), 40.0, 1, 1000.0),
        ((1000.0, 2000.0), 15.0, 2, 1000 + 0.92 * 2000),
        ((1000.0, 2000.0), 30.0, 2, 1000 + 0.66 * 2000),
        ((1000.0, -2000.0), 40.0, 2, 1000 + 0.52 * 2000),
        ((1000.0, 2000.0), 35.0, 2, 1000 + 0.58 * 2000),
    ],
)
def test_static_loads_of_balls(loads, angle, rows, expected):
    assert static_load(*loads, math.radians(angle), rows) == pytest.approx(expected, rel=1e-12)


def test_static_loads_of_rollers():
    """ISO 76: Y_0 = 0.22 cot(a) of one row and 0.44 cot(a) of two rows."""
    angle = math.radians(15.0)
    assert static_load_of_rollers(1000.0, 2000.0, angle) == pytest.approx(500.0 + 440.0 / math.tan(angle))
    assert static_load_of_rollers(1000.0, 2000.0, angle, 2) == pytest.approx(1000.0 + 880.0 / math.tan(angle))
    assert static_load_of_rollers(1000.0, 100.0, angle) == 1000.0
    assert static_load_of_rollers(1000.0, 0.0) == 1000.0
    assert math.isnan(static_load(1000.0, 100.0, math.radians(10.0)))


@each(
    "name, load",
    [
        ("bearing_thrust", lambda bearing: bearing.axial_load),
        ("bearing_needle", lambda bearing: bearing.radial_load),
        ("bearing_tapered_pair", lambda b: b.radial_load + 0.44 / math.tan(b.contact_angle) * b.axial_load),
        ("bearing_four_point", lambda b: b.radial_load + 0.58 * b.axial_load),
    ],
)
def test_static_safety_of_kinds_of_bearings(name, load):
    """P_0 by hand, and s_0 = C_0/P_0."""
    case = BearingCase.from_toml(EXAMPLES / f"{name}.toml")
    case = case.replace({"contacts": "formula", "bearing.life": {"contamination_factor": 0.5}})
    found = solve_bearing(case, workers=1).summary()["life"]
    assert found["static_equivalent_load"] == pytest.approx(load(case.bearing), rel=1e-12)
    assert found["static_safety"] == pytest.approx(found["static_rating"] / load(case.bearing), rel=1e-12)


def test_the_minimum_static_safety_of_a_cycle_counts_rows_at_rest(tmp_path):
    """Heaviest row: 5 kN at a standstill, of C_0 = 17.9 kN."""
    file = tmp_path / "cycle.csv"
    file.write_text(
        "time [s],speed [rpm],radial load [N]\n0,1000,1000\n10,0,5000\n20,2000,2000\n30,2000,2000\n"
    )
    result = solve_bearing(bearing(**{"bearing.axial_load": 0.0, "duty.file": str(file)}), workers=1)
    assert result.duty is not None
    assert result.summary()["duty"]["static_safety"] == pytest.approx(17.9e3 / 5e3, rel=1e-9)
    assert result.summary()["life"]["static_safety"] == pytest.approx(17.9e3 / 1800.0, rel=1e-9)
