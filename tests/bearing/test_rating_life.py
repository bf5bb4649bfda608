"""Rating life in the results of a bearing, against numbers by hand and printed ratings."""

import csv
import math

import numpy as np
import pytest

from ehlectric.bearing.loads.life import equivalent_load, life_factor
from ehlectric.bearing.rating_life import KEYS
from ehlectric.bearing.result import solve_bearing
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError
from ehlectric.formulas.load_ratings import ball_dynamic_rating
from ehlectric.sweep.evaluation import evaluate
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case
from tests.helpers.each import each
from tests.helpers.places import ROOT

CLEAN = {"bearing__life": {"contamination_factor": 0.5}}
# NSK's catalogue of the 6208.
PRINTED = {"contamination_factor": 0.5, "dynamic_rating": "29.1 kN", "static_rating": "17.9 kN"}


def life(tables=BALLS, **changes):
    solution = solve_bearing(bearing_case(tables, contacts="atlas", **changes), workers=1)
    return solution.summary(probable=False)["life"]


@pytest.mark.slow
@pytest.mark.gate
def test_without_its_table_there_is_no_life():
    assert life() == dict.fromkeys(KEYS)


@pytest.mark.slow
@pytest.mark.gate
def test_ball_bearing_by_hand():
    """6208 under 1800 N and 300 N: F_a/F_r = 0.167 is below e = 0.19, so P = F_r. L_10 = (29.1/1.8)^3
    million turns, at 3000 rpm 180 000 an hour."""
    found = life(bearing__life=PRINTED, bearing__inner_speed="3000 rpm")
    assert found["equivalent_load"] == 1800.0
    hours = (29.1 / 1.8) ** 3 * 1e6 / 180e3
    assert found["basic_life"] == pytest.approx(3600.0 * hours, rel=1e-9)
    assert found["fatigue_load_limit"] == pytest.approx(17_900.0 / 22.0, rel=1e-9)
    factor = life_factor("radial ball", found["film_viscosity_ratio"], 0.5 * 17_900.0 / 22.0 / 1800.0)
    assert found["film_life_factor"] == pytest.approx(factor, rel=1e-9)
    assert found["film_modified_life"] == pytest.approx(factor * found["basic_life"], rel=1e-9)


def walther(temperature, points):
    """Kinematic viscosity [mm^2/s] at a temperature [K] between two points, by ASTM D341."""
    logs = [(math.log10(t), math.log10(math.log10(nu + 0.7))) for t, nu in points.items()]
    (first, low), (last, high) = logs
    part = (math.log10(temperature) - first) / (last - first)
    return 10.0**10.0 ** (low + part * (high - low)) - 0.7


@pytest.mark.slow
@pytest.mark.gate
def test_modified_reference_life_uses_the_viscosity_of_the_oil():
    """ISO/TS 16281 takes kappa = nu/nu_1, with nu_1 = 4500/(3000 60)^0.5 mm^2/s at 3000 rpm and 60 mm, and
    P as the load whose basic life is the reference life. The film has a life with a name of its own.
    """
    found = life(bearing__life=PRINTED, bearing__inner_speed="3000 rpm")
    required = 4500.0 / math.sqrt(3000.0 * 60.0)
    kappa = walther(343.15, {313.15: 46.0, 373.15: 6.8}) / required
    assert found["rated_viscosity"] == pytest.approx(1e-6 * required, rel=1e-9)
    assert found["viscosity_ratio"] == pytest.approx(kappa, rel=2e-3)
    kappa = found["viscosity_ratio"]
    load = 29_100.0 / (found["reference_life"] * 3000.0 / 60.0 / 1e6) ** (1.0 / 3.0)
    part = 0.5 * 17_900.0 / 22.0 / load
    oil_part = 2.5671 - 1.9987 / kappa ** (0.071739 if kappa >= 1.0 else 0.19087)
    factor = min(50.0, 0.1 * (1.0 - oil_part**0.83 * part ** (1.0 / 3.0)) ** -9.3)
    expected = factor * found["reference_life"]
    assert found["reference_modified_life"] == pytest.approx(expected, rel=1e-6)
    of_film = life_factor("radial ball", found["film_viscosity_ratio"], part)
    assert found["film_reference_modified_life"] == pytest.approx(of_film * found["reference_life"], rel=1e-6)
    assert found["film_reference_modified_life"] > 1.5 * found["reference_modified_life"]


def rows_of_life(**changes):
    """Texts of the rows of the rating life by key."""
    solution = solve_bearing(bearing_case(BALLS, contacts="atlas", **changes), workers=1)
    rows = total_rows(solution.summary(probable=False))
    return {row.key.removeprefix("life."): row.text for row in rows if row.key.startswith("life.")}


@pytest.mark.slow
def test_the_table_shows_what_the_lives_follow_from():
    found = rows_of_life(bearing__life=PRINTED, bearing__inner_speed="3000 rpm")
    assert found["dynamic_rating"].startswith("29\xa0100 N")
    assert found["static_rating"].startswith("17\xa0900 N")
    assert found["fatigue_load_limit"].startswith("814 N")
    assert found["equivalent_load"].startswith("1800 N")
    assert found["rated_viscosity"].startswith("10.6 mm²/s")
    assert "viscosity_ratio" in found


def printed():
    """Printed ratings [N] and kinds by the name of a bearing of the usual series."""
    with (ROOT / "src/ehlectric/cases/library/series.csv").open(encoding="utf-8") as file:
        return {row["designation"]: row for row in csv.DictReader(line for line in file if line[0] != "#")}


OF_SERIES = {
    "nk-19/20": {"radial_load": "1 kN", "radial_clearance": "10 um"},
    "6809": {"radial_load": "500 N", "radial_clearance": "10 um"},
    "6314": {"radial_load": "2 kN", "radial_clearance": "10 um"},
    "6214": {"radial_load": "2 kN", "radial_clearance": "10 um"},
    "7210-b": {"radial_load": "1 kN", "axial_load": "500 N"},
    "32208": {"radial_load": "2 kN", "axial_load": "800 N"},
    "nu-310": {"radial_load": "2 kN", "radial_clearance": "20 um"},
    "51208": {"axial_load": "2 kN"},
    "axk-2542": {"axial_load": "1 kN"},
    "na-4904": {"radial_load": "1 kN", "radial_clearance": "20 um"},
}


def of_base(base, life=None, **keys):
    case = BearingCase.of(
        base=base,
        lubricant={"base": "iso-vg-46"},
        contacts="formula",
        inner_speed="1000 rpm",
        temperature="60 degC",
        composite_rq="0.05 um",
        life={"contamination_factor": 0.5} | (life or {}),
        **keys,
    )
    return case, solve_bearing(case, workers=1).summary(probable=False)["life"]


@pytest.mark.slow
@each("base", list(OF_SERIES))
def test_printed_ratings_of_the_series_are_those_of_the_life(base):
    """L_10 follows from the printed C in the table of the series and from P of the summary."""
    _, found = of_base(base, **OF_SERIES[base])
    row = printed()[base]
    assert found["dynamic_rating"] == pytest.approx(float(row["dynamic"]), rel=1e-9)
    assert found["static_rating"] == pytest.approx(float(row["static"]), rel=1e-9)
    assert found["dynamic_rating_source"].startswith("printed by")
    power = 10.0 / 3.0 if "roller" in row["kind"] else 3.0
    hours = 1e6 / 6e4 * (float(row["dynamic"]) / found["equivalent_load"]) ** power
    assert found["basic_life"] / 3600.0 == pytest.approx(hours, rel=1e-9)


@pytest.mark.slow
@pytest.mark.gate
def test_ratings_come_from_the_file_then_the_designation_then_the_elements():
    keys = OF_SERIES["6809"]
    case, found = of_base("6809", {"dynamic_rating": "7 kN"}, **keys)
    assert (found["dynamic_rating"], found["dynamic_rating_source"]) == (7000.0, "given")
    assert (found["static_rating"], found["static_rating_source"]) == (6150.0, "printed by NSK for the 6809")
    table = case.bearing.model_dump(exclude_none=True) | {"life": {"contamination_factor": 0.5}}
    del table["base"]
    own = {key: table[key] for key in table if key not in ("summit_height",)}
    alone = BearingCase.from_dict({"bearing": own, "lubricant": {"base": "iso-vg-46"}, "contacts": "formula"})
    found = solve_bearing(alone, workers=1).summary(probable=False)["life"]
    sizes = (own["elements"], own["element_diameter"], own["pitch_diameter"])
    assert found["dynamic_rating"] == pytest.approx(ball_dynamic_rating(*sizes), rel=1e-12)
    assert found["dynamic_rating_source"] == "computed from the elements by ISO 281"


@pytest.mark.slow
def test_printed_ratings_follow_the_elements_of_a_file_without_a_step():
    """One ball less changes the printed rating by the ratio of both ratings of ISO 281; equal values of the
    file change nothing."""
    case, usual = of_base("6214", **OF_SERIES["6214"])
    bearing = case.bearing
    sizes = bearing.element_diameter, bearing.pitch_diameter
    _, same = of_base(
        "6214", **OF_SERIES["6214"], elements=bearing.elements, element_diameter=bearing.element_diameter
    )
    assert same["dynamic_rating"] == usual["dynamic_rating"]
    _, less = of_base("6214", **OF_SERIES["6214"], elements=bearing.elements - 1)
    ratio = ball_dynamic_rating(bearing.elements - 1, *sizes) / ball_dynamic_rating(bearing.elements, *sizes)
    assert less["dynamic_rating"] == pytest.approx(usual["dynamic_rating"] * ratio, rel=1e-9)
    assert less["dynamic_rating_source"].endswith("scaled to these elements")
    found = evaluate(case, {"bearing.element_diameter": sizes[0] * np.array([1.0 - 1e-6, 1.0, 1.0 + 1e-6])})
    assert np.ptp(found["life.basic_life"].values) < 2e-5 * usual["basic_life"]


@pytest.mark.slow
def test_reference_lives_scale_with_the_printed_rating():
    """The rating of an element is proportional to C: the reference life of rollers follows C^4."""
    _, usual = of_base("nu-310", **OF_SERIES["nu-310"])
    _, less = of_base("nu-310", {"dynamic_rating": 0.9 * usual["dynamic_rating"]}, **OF_SERIES["nu-310"])
    assert less["reference_life"] == pytest.approx(0.9**4 * usual["reference_life"], rel=1e-6)


@pytest.mark.slow
def test_lives_above_a_million_hours_are_not_numbers_in_texts():
    """The number in the summary remains: 29.1 kN and 100 N are 2.5e13 revolutions, 1.4e8 h at 3000 rpm."""
    changes = {"bearing__life": PRINTED, "bearing__inner_speed": "3000 rpm"}
    loads = {"bearing__radial_load": "100 N", "bearing__axial_load": "0 N"}
    assert rows_of_life(**changes, **loads)["basic_life"] == "above 1\xa0000\xa0000 h"
    hours = 291.0**3 * 1e6 / 180e3
    assert life(**changes, **loads)["basic_life"] == pytest.approx(3600.0 * hours, rel=1e-9)


@pytest.mark.slow
@pytest.mark.gate
def test_own_ratings_are_the_printed_ones_within_a_per_cent():
    own, printed = life(**CLEAN), life(bearing__life=PRINTED)
    assert own["dynamic_rating"] == pytest.approx(printed["dynamic_rating"], rel=0.01)
    assert own["static_rating"] == pytest.approx(printed["static_rating"], rel=0.01)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("tables", "power", "stress", "changes"),
    [(BALLS, 0.0, 1.0, {"bearing__axial_load": 0.0}), (ROLLERS, 2.0 / 3.0, 0.83, {})],
)
def test_reference_life_is_near_the_basic_one(tables, power, stress, changes):
    """Half of the ring is loaded without clearance, as ISO 281 takes it.

    With rollers the reference life falls with the power 4 of the load and the basic one with 10/3, and its
    ratings are larger by the stress at the ends, λν = 0.83 in ISO/TS 16281.
    """
    found = life(tables, **CLEAN, bearing__radial_clearance="0 um", bearing__inner_speed="500 rpm", **changes)
    steeper = (found["dynamic_rating"] / found["equivalent_load"]) ** power / stress**4
    assert found["reference_life"] == pytest.approx(steeper * found["basic_life"], rel=0.15)


@pytest.mark.slow
def test_clearance_shortens_the_reference_life_only():
    tight, loose = (life(**CLEAN, bearing__radial_clearance=play) for play in ("0 um", "40 um"))
    assert loose["basic_life"] == tight["basic_life"]
    assert loose["reference_life"] < 0.95 * tight["reference_life"]


@pytest.mark.slow
def test_roughened_raceways_shorten_the_life():
    smooth, rough = (
        life(bearing__life={"contamination_factor": 0.5, "roughened_rq": rq}) for rq in ("0.03 um", "0.5 um")
    )
    # The roughness of the case itself is 0.03 um.
    assert smooth["roughened_life"] == pytest.approx(smooth["film_reference_modified_life"], rel=1e-9)
    assert rough["roughened_life"] < 0.3 * smooth["roughened_life"]


@each(
    ("degrees", "axial", "part", "expected"),
    [
        (0.0, 300.0, 1.38, 1000.0),  # below e = 0.30
        (0.0, 500.0, 1.38, 560.0 + 1.45 * 500.0),
        (0.0, 500.0, 6.89, 560.0 + 500.0),
        (15.0, 600.0, 1.43, 440.0 + 1.19 * 600.0),
        (40.0, 1000.0, 1.0, 1000.0),  # below e = 1.14
        (40.0, 2000.0, 1.0, 350.0 + 0.57 * 2000.0),
        (30.0, 1000.0, 1.0, 390.0 + 760.0),
    ],
)
def test_equivalent_load_of_the_printed_tables(degrees, axial, part, expected):
    assert equivalent_load(1000.0, axial, np.deg2rad(degrees), part) == pytest.approx(expected, rel=1e-9)


@each("degrees", [10.0, 50.0])
def test_contact_angles_without_a_table_have_no_load(degrees):
    assert np.isnan(equivalent_load(1000.0, 500.0, np.deg2rad(degrees), 1.0))


@pytest.mark.slow
def test_many_points_are_single_ones():
    case = bearing_case(BALLS, contacts="atlas", **CLEAN)
    loads = [900.0, 1800.0, 5000.0]
    found = evaluate(case, {"bearing.radial_load": loads})
    for index, load in enumerate(loads):
        one = life(**CLEAN, bearing__radial_load=load)
        for key in ("equivalent_load", "basic_life", "reference_modified_life", "film_life_factor"):
            assert found[f"life.{key}"].values[index] == pytest.approx(one[key], rel=1e-6), (load, key)


@each(
    ("table", "key"),
    [
        ({}, "bearing.life.contamination_factor"),
        ({"contamination_factor": 0.0}, "bearing.life.contamination_factor"),
        ({"contamination_factor": 1.2}, "bearing.life.contamination_factor"),
        ({"contamination_factor": 0.5, "dynamic_rating": "-1 kN"}, "bearing.life.dynamic_rating"),
        ({"contamination_factor": 0.5, "rating": "1 kN"}, "bearing.life.rating"),
        ({"contamination_factor": 0.5, "roughened_rq": "0.01 um"}, "bearing.life.roughened_rq"),
    ],
)
def test_wrong_tables_name_their_key(table, key):
    with pytest.raises(InputError) as error:
        bearing_case(BALLS, bearing__life=table)
    assert error.value.key == key


@pytest.mark.slow
@each(
    ("changes", "text"),
    [
        ({"bearing__inner_groove": 0.54}, "grooves up to 0.52"),
        ({"bearing__element_material": "silicon-nitride"}, "steel elements"),
        ({"bearing__radial_load": "15 kN"}, "of the dynamic rating"),
        ({"bearing__life": PRINTED | {"fatigue_load_limit": "40 kN"}}, "above the static rating"),
        ({"bearing__composite_rq": "2 um"}, "viscosity ratio of"),
    ],
)
def test_what_the_standards_do_not_cover_is_said(changes, text):
    case = bearing_case(BALLS, contacts="atlas", **(CLEAN | changes))
    summary = solve_bearing(case, workers=1).summary(probable=False)
    assert "life-outside" in summary["warning_codes"]
    assert any(text in told for told in summary["warnings"])


def test_an_over_moulded_ring_has_no_fits():
    fits = {"shaft_interference": "10 um", "housing_interference": "0 um", "housing_material": "aluminium"}
    with pytest.raises(InputError, match="over-moulded"):
        bearing_case(
            BALLS,
            bearing__coating="over-moulded",
            bearing__outer_diameter="80 mm",
            bearing__width="18 mm",
            bearing__bore="40 mm",
            bearing__radial_clearance=None,
            bearing__fits=fits | {"unmounted_clearance": "20 um", "housing_diameter": "120 mm"},
        )
