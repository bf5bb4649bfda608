"""Film factors of a bearing from measured capacitances: mean, uncertainty, background, and rows left out."""

import csv
import io
import json
import math

import numpy as np
import pandas as pd
import pytest

import ehlectric
from ehlectric.bearing import measured_capacitance
from ehlectric.bearing.impedance import meter_capacitance
from ehlectric.bearing.measured_capacitance import Correction, FilmState, OperatingPoint
from ehlectric.bearing.preparation import with_film_factor
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError
from tests.bearing.measured.synthetic_capacitance import BACKGROUND, FACTOR, FILE, NOISE
from tests.bearing.measured.synthetic_capacitance import SPEEDS as SPEEDS_OF_FILE
from tests.helpers.bearings import BALLS, ROLLERS
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

AXIAL = BALLS | {"contacts": "formula", "bearing": BALLS["bearing"] | {"radial_load": 0.0}}
RPM = math.pi / 30.0
SPEEDS = (1500.0, 3000.0, 6000.0)
KELVIN = "bearing.temperature"


@pytest.fixture(scope="module")
def case():
    return BearingCase.from_dict(AXIAL)


@pytest.fixture(scope="module")
def exact(case):
    """Capacitances [F] at a film factor of 0.7."""
    points = [OperatingPoint.of(case, {"bearing.inner_speed": n * RPM}) for n in SPEEDS]
    return np.array([at.at(0.7).capacitance for at in points])


def table(values, **columns):
    return pd.DataFrame({"speed [rpm]": SPEEDS, "capacitance [pF]": 1e12 * values, **columns})


def test_rows_give_back_their_film_factor(case, exact):
    found = ehlectric.film_factors(case, table(exact + 5e-12), background="5 pF", uncertainty="1 %")
    assert found.columns["film_factor"] == pytest.approx([0.7] * 3, rel=1e-6)
    assert found.mean.value == pytest.approx(0.7, rel=1e-6)
    assert found.columns["capacitance"] == pytest.approx(exact)
    assert found.columns["fitted"] == pytest.approx(exact, rel=1e-6)
    assert found.background == 5e-12
    assert found.slope[0] == pytest.approx(0.0, abs=1e-6)
    assert [warning.code for warning in found.warnings] == ["formula-contacts"]


def test_a_measurement_without_any_usable_row_has_no_mean(case, exact):
    """All capacitances far below that of the computed films: each row has its reason, and nothing fails."""
    ranged = case.replace({"ranges": {KELVIN: ["60 degC", "80 degC"]}})
    found = ehlectric.film_factors(ranged, table(exact / 100.0), uncertainty="2 %")
    assert found.mean is None
    assert np.all(np.isnan(found.columns["film_factor"]))
    assert all(" 3 times" in reason for reason in found.reasons)
    assert json.loads(json.dumps(found.summary()))["rows_with_factor"] == 0
    for panel in found.plot().axes:
        low, high = panel.get_xlim()
        assert 0.0 < low < min(SPEEDS) < max(SPEEDS) < high < 2.0 * max(SPEEDS)


@pytest.mark.slow
@pytest.mark.gate
def test_uncertainty_is_that_of_a_higher_capacitance(case, exact):
    """One standard uncertainty more on a row moves its film factor by what the row states."""
    error = 0.01 * (exact + 5e-12)
    first = ehlectric.film_factors(case, table(exact + 5e-12), background=5e-12, uncertainty=0.01)
    more = ehlectric.film_factors(case, table(exact + 5e-12 + error), background=5e-12)
    moved = np.log(more.columns["film_factor"] / first.columns["film_factor"])
    stated = first.columns["factor_uncertainty"] / first.columns["film_factor"]
    assert stated == pytest.approx(-moved, rel=0.05)
    assert more.mean.basis == "scatter only"
    assert "scatter-only" in [warning.code for warning in more.warnings]


@pytest.mark.slow
@pytest.mark.gate
def test_the_parallel_capacitance_of_the_case_is_the_background(case, exact):
    """Its range is an error that all rows share: of the lower capacitances at high speed most."""
    key = "bearing.parallel_capacitance"
    ranged = case.replace({key: "5 pF", "ranges": {key: ["4 pF", "6 pF"]}})
    found = ehlectric.film_factors(ranged, table(exact + 5e-12), uncertainty="1 %")
    assert found.background == 5e-12
    assert found.columns["film_factor"] == pytest.approx([0.7] * 3, rel=1e-6)
    more = ehlectric.film_factors(ranged, table(exact + 5e-12), background="5.2 pF", uncertainty="1 %")
    moved = np.log(more.columns["film_factor"] / 0.7)
    part = found.columns["factor_systematic"] / found.columns["film_factor"]
    assert part == pytest.approx(moved / 0.2 / math.sqrt(3.0), rel=0.05)
    assert more.mean.systematic == 0.0


@pytest.mark.slow
@pytest.mark.gate
def test_magnitude_and_phase_are_taken_as_well(case, exact):
    admittance = 1e-7 + 2j * np.pi * 2e4 * exact
    z = 1.0 / admittance
    frame = pd.DataFrame(
        {
            "speed [rpm]": SPEEDS,
            "impedance [kOhm]": np.abs(z) / 1e3,
            "phase [deg]": np.degrees(np.angle(z)),
            "frequency [kHz]": 20.0,
        }
    )
    found = ehlectric.film_factors(case, frame)
    assert found.columns["film_factor"] == pytest.approx([0.7] * 3, rel=1e-6)
    assert found.columns["parallel_resistance"] == pytest.approx([1e7] * 3, rel=1e-6)


@pytest.mark.slow
@pytest.mark.gate
def test_rows_out_of_reach_are_marked_and_others_go_on(case, exact):
    values = exact * [1.0, 0.01, 60.0]
    found = ehlectric.film_factors(case, table(values), uncertainty="1 %")
    assert found.found.tolist() == [True, False, False]
    assert " 3 times" in found.reasons[1]
    assert found.reasons[2] not in ("", found.reasons[1])
    assert (found.mean.rows, found.mean.value) == (1, pytest.approx(0.7, rel=1e-6))
    warning = next(warning for warning in found.warnings if warning.code == "rows-without-factor")
    assert "2 of 3 rows" in warning.text
    assert "line 2 (" in warning.text


def test_films_thicker_than_computed_have_factors_above_one(case):
    thick = OperatingPoint.of(case, {}).at(1.6).capacitance
    found = ehlectric.film_factors(case, pd.DataFrame({"capacitance [pF]": [1e12 * thick]}))
    assert found.mean.value == pytest.approx(1.6, rel=1e-6)
    assert found.mean.low is None


def test_a_measured_temperature_is_that_of_its_row(case):
    warm = OperatingPoint.of(case, {KELVIN: 363.15}).at(0.7).capacitance
    frame = pd.DataFrame({"temperature [degC]": [90.0], "capacitance [pF]": [1e12 * warm]})
    assert ehlectric.film_factors(case, frame).mean.value == pytest.approx(0.7, rel=1e-6)


def test_rings_keep_their_difference_from_a_measured_temperature(case):
    """An inner ring 10 K warmer than the 70 degC of the oil has 100 degC where 90 degC were measured."""
    warmer = case.replace({"bearing.inner_ring_temperature": "80 degC"})
    at = {KELVIN: 363.15, "bearing.inner_ring_temperature": 373.15}
    warm = OperatingPoint.of(warmer, at).at(0.7).capacitance
    frame = pd.DataFrame({"temperature [degC]": [90.0], "capacitance [pF]": [1e12 * warm]})
    assert ehlectric.film_factors(warmer, frame).mean.value == pytest.approx(0.7, rel=1e-6)


@pytest.mark.slow
def test_a_range_moves_the_factor_as_its_ends_do(case, exact):
    """Half of the change of ln f between a case 4 K colder and 4 K warmer, over the square root of three."""
    ranged = case.replace({"ranges": {KELVIN: ["66 degC", "74 degC"]}})
    found = ehlectric.film_factors(ranged, table(exact), uncertainty="1 %")
    ends = [
        ehlectric.film_factors(case.replace({KELVIN: at}), table(exact)).columns["film_factor"]
        for at in ("66 degC", "74 degC")
    ]
    expected = 0.5 * np.abs(np.log(ends[1] / ends[0])) / math.sqrt(3.0)
    found_part = found.columns["factor_systematic"] / found.columns["film_factor"]
    assert found_part == pytest.approx(expected, rel=0.03)
    assert found.mean.systematic == pytest.approx(np.mean(expected), rel=0.05)
    assert found.mean.high - found.mean.low > 2 * 1.95 * 0.7 * found.mean.systematic


@pytest.mark.slow
@pytest.mark.gate
def test_a_factor_that_changes_with_the_speed_is_told(case):
    points = [OperatingPoint.of(case, {"bearing.inner_speed": n * RPM}) for n in SPEEDS]
    values = np.array([at.at(f).capacitance for at, f in zip(points, (0.9, 0.7, 0.5), strict=True)])
    found = ehlectric.film_factors(case, table(values), uncertainty="1 %")
    assert "factor-varies" in [warning.code for warning in found.warnings]
    assert found.slope[0] == pytest.approx(math.log(0.5 / 0.9) / math.log(4.0), abs=0.03)


def test_files_hold_what_the_result_has(case, exact):
    found = ehlectric.film_factors(case, table(exact, remark="=1+1"), uncertainty="1 %")
    contents = found.contents()
    assert set(contents) == {"measured.json", "measured.csv"}
    assert json.loads(contents["measured.json"]) == found.summary()
    file = io.BytesIO()
    contents["measured.csv"](file)
    rows = list(csv.DictReader(io.StringIO(file.getvalue().decode())))
    assert [float(row["film_factor [-]"]) for row in rows] == found.columns["film_factor"].tolist()
    assert set(found.to_dataframe().attrs["units"]) == set(found.columns)


@each(
    "options, words",
    [
        ({"background": "900 nF"}, "background"),
        ({"background": "-1 pF"}, "^background: .*'-1 pF'"),
        ({"background": "1 nm"}, "^background: .*'1 nm'"),
        ({"uncertainty": "0 %"}, "^uncertainty: .*'0 %'"),
        ({"contacts": "guessed"}, "^contacts: .*'guessed'"),
    ],
)
def test_wrong_options_are_one_line(case, exact, options, words):
    with pytest.raises(InputError, match=words):
        ehlectric.film_factors(case, table(exact), **options)


def test_bearings_and_columns_without_a_film_factor_are_refused(case, exact):
    ceramic = case.replace({"bearing.element_material": "silicon-nitride"})
    with pytest.raises(InputError, match=r"element_material: .*'silicon-nitride'"):
        ehlectric.film_factors(ceramic, table(exact))
    with pytest.raises(InputError, match="'speed"):
        ehlectric.film_factors(case, pd.DataFrame({"speed [m/s]": [1.0], "capacitance [pF]": [100.0]}))
    with pytest.raises(InputError, match="capacitance: "):
        ehlectric.film_factors(case, pd.DataFrame({"speed [rpm]": [1000.0]}))
    many = pd.DataFrame({"speed [rpm]": np.arange(1, 1500), "capacitance [pF]": 100.0})
    with pytest.raises(InputError, match="1499"):
        ehlectric.film_factors(case, many)


def test_a_correction_multiplies_what_the_formulas_say():
    table = Correction(np.log([1e-10, 4e-10]), np.log([[1.1, 0.8], [1.1, 0.8]]), 4)
    state = table.of(FilmState(2e-10, 3.0))
    assert (state.capacitance, state.lambda_ratio) == (pytest.approx(2.2e-10), pytest.approx(2.4))
    assert Correction.none().of(state) is state


@pytest.mark.slow
def test_solved_contacts_enter_by_their_ratio_to_the_atlas(case, monkeypatch):
    """Contacts "solved" by the atlas, with films 5 % thicker than its own."""
    quick = case.replace({"contacts": "atlas"})
    points = [OperatingPoint.of(quick, {"bearing.inner_speed": n * RPM}) for n in SPEEDS]
    exact = np.array([at.at(0.7).capacitance for at in points])
    solve = measured_capacitance.solution_of_prepared

    def thicker(solved_case, prepared, **options):
        if solved_case.contacts != "solved":
            return solve(solved_case, prepared, **options)
        factor = 1.05 * prepared.conditions.film_factor
        return solve(solved_case.replace({"contacts": "atlas"}), with_film_factor(prepared, factor))

    monkeypatch.setattr(measured_capacitance, "solution_of_prepared", thicker)
    found = ehlectric.film_factors(case, table(exact), contacts="solved", uncertainty="1 %")
    assert found.columns["film_factor"] == pytest.approx([0.7 / 1.05] * 3, rel=1e-3)
    assert found.solves == 2 * 3
    assert found.contacts == "solved"


@pytest.mark.slow
def test_a_solved_bearing_gives_back_its_film_factor():
    """Line contacts of rollers, solved at a speed and a film factor that the table does not have."""
    case = BearingCase.from_dict(ROLLERS | {"contacts": "solved"})
    changes = {"bearing.inner_speed": 4500 * RPM, "bearing.film_factor": 0.8}
    measured = 1e12 * meter_capacitance(ehlectric.solve_bearing(case.replace(changes)).solution)
    frame = pd.DataFrame({"speed [rpm]": [4500.0], "capacitance [pF]": [measured]})
    found = ehlectric.film_factors(case, frame, uncertainty="1 %")
    assert found.mean.value == pytest.approx(0.8, rel=5e-3)
    by_formula = ehlectric.film_factors(case, frame, uncertainty="1 %", contacts="formula")
    assert abs(by_formula.mean.value - 0.8) > 5 * abs(found.mean.value - 0.8)


@pytest.mark.slow
def test_the_synthetic_example_gives_back_its_film_factor():
    """Its true factor lies in the stated interval, and the interval is no wider than 8 %."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    found = ehlectric.film_factors(case, FILE, background=BACKGROUND, contacts="formula")
    assert found.mean.low < FACTOR < found.mean.high
    assert found.mean.high - found.mean.low < 0.08
    assert found.mean.statistical == pytest.approx(NOISE / math.sqrt(len(SPEEDS_OF_FILE)) * 1.5, rel=0.3)
    assert "SYNTHETIC" in FILE.read_text(encoding="utf-8").splitlines()[0]
