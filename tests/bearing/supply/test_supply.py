"""Supply of oil to a bearing: film factor, half time, warnings and what a bearing file may say."""

import math

import numpy as np
import pytest

from ehlectric.bearing.film_factor import (
    film_note,
    half_time,
    supply_warning_conditions,
    supply_words,
    track_length,
)
from ehlectric.bearing.measured_capacitance import OperatingPoint
from ehlectric.bearing.preparation import prepare_bearing, resolve_bearing, with_film_factor
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.stored import dataset_of, solution_of
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError
from ehlectric.formulas.inlet_supply import replenishment_factor
from ehlectric.quantities.result_warnings import active
from ehlectric.tables.bearing_tables import film_factor_note
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, numbers_of
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

SIZE = {"bearing__bore": "40 mm", "bearing__outer_diameter": "80 mm"}
HEATED = {
    "bearing__film_factor": "inlet-shear",
    "lubricant__temperature__thermal_conductivity": "0.14 W/m/K",
}


def case(tables=BALLS, **changes):
    """Bearing of known size by formula, without a motor: its summary has no analysis of the margin."""
    return bearing_case(tables, contacts="formula", motor=None, **SIZE, **changes)


def parts_of(conditions):
    """Parts of the film factor by heat and by the supply of oil."""
    return tuple(conditions.part_of_film_factor(name) for name in ("heat_factor", "supply_factor"))


def test_factors_multiply():
    heat = resolve_bearing(case(**HEATED)).film_factor
    both = resolve_bearing(case(**HEATED, bearing__supply=0.7))
    assert both.film_factor == pytest.approx(0.7 * heat, rel=1e-12)
    assert parts_of(both) == (heat, 0.7)
    given = resolve_bearing(case(bearing__film_factor=0.9, bearing__supply=0.5))
    assert (given.film_factor, *parts_of(given)) == (0.45, None, 0.5)


def test_rule_takes_the_kinematic_viscosity_at_each_ring():
    """14.85 mm^2/s at 70 degC by ASTM D341 of the oil, and less at the warmer inner ring."""
    rings = {"bearing__inner_ring_temperature": "80 degC"}
    found = resolve_bearing(case(**rings, bearing__supply="grease"))
    for ring in (found.inner, found.outer):
        expected = replenishment_factor(
            100.0 * math.pi,
            ring.oil.viscosity / ring.oil.density,
            bore=0.04,
            outer_diameter=0.08,
            supply="grease",
            kind="deep-groove ball",
        )
        assert ring.supply_factor == pytest.approx(float(expected), rel=1e-12)
    assert parts_of(found)[1] == found.outer.supply_factor < found.inner.supply_factor
    assert found.outer.oil.viscosity / found.outer.oil.density == pytest.approx(14.85e-6, rel=1e-3)


@pytest.mark.parametrize("tables", [BALLS, ROLLERS], ids=["balls", "rollers"])
def test_flooded_is_what_it_was(tables):
    """Films of a flooded bearing are those of the whole film as a number, and no time is given."""
    flooded, whole = (
        solve_bearing(case(tables, bearing__supply=supply)).solution for supply in ("flooded", 1.0)
    )
    assert flooded.least_film == whole.least_film
    films = [
        [ring.values.central_thickness for position in one.positions for ring in position.rings]
        for one in (flooded, whole)
    ]
    np.testing.assert_array_equal(*films)
    conditions = flooded.conditions
    assert (conditions.film_factor, *parts_of(conditions)) == (1.0, 1.0, 1.0)
    assert half_time(flooded) is None
    assert not list(active(supply_warning_conditions(flooded)))


@pytest.mark.slow
def test_summary_of_a_greased_bearing():
    """Films are those of the same number as film factor; warnings say what the number rests on."""
    result = solve_bearing(case(bearing__supply="grease"))
    greased = result.summary()
    assert summary_of(solution_of(dataset_of(result.solution)))["bearing"] == greased["bearing"]
    factor = greased["bearing"]["supply_factor"]
    # The height of the summits that is not given follows the factor: isothermal films are smooth.
    given = solve_bearing(case(bearing__film_factor=factor, bearing__summit_height=0.0)).summary()
    assert greased["bearing"]["film_factor"] == factor == pytest.approx(0.94, abs=0.005)
    for key in ("capacitance", "first_break", "lambda_ratio"):
        assert greased["bearing"][key] == given["bearing"][key]
    assert {"supply-rule", "film-decays", "smooth-film"} <= set(greased["warning_codes"])
    assert "supply-low" not in greased["warning_codes"]


@pytest.mark.slow
@pytest.mark.gate
def test_starved_films_are_told():
    starved = solve_bearing(case(bearing__supply=0.3)).summary()
    assert {"supply-low", "film-factor-low"} <= set(starved["warning_codes"])
    assert not {"supply-rule", "film-decays"} & set(starved["warning_codes"])


@pytest.mark.parametrize(
    ("factor", "note", "row"),
    [
        (0.9, "factor of 0.9 and the oil supply", "factor of 0.9 and oil supply"),
        ("none", "from the oil supply", "oil supply"),
    ],
)
def test_parts_of_a_film_factor_are_all_named(factor, note, row):
    solution = solve_bearing(case(bearing__film_factor=factor, bearing__supply=0.8)).solution
    (told,) = active(film_note(solution))
    assert note in told.text
    inputs = {"film_factor": factor, "supply": 0.8}
    summary = {"bearing": {"film_factor": 0.72}, "inputs": {"bearing": inputs}}
    assert row in film_factor_note(summary)


@pytest.mark.slow
def test_half_time_goes_with_the_film_and_the_track():
    """t = 3/(rate h^2), so that half the film takes four times as long; rollers have no such time."""
    times = []
    for factor in (0.8, 0.4):
        summary = solve_bearing(case(bearing__supply=factor)).summary()
        rows = [row for row in summary["contacts"] if row["ring"] == "inner"]
        film = max(rows, key=lambda row: row["load"])["central_thickness"]
        times.append(summary["bearing"]["film_half_time"] * film**2)
    assert times[0] == pytest.approx(times[1], rel=1e-9)
    rollers = numbers_of(solve_bearing(case(ROLLERS, bearing__supply="grease")))
    assert rollers["bearing"]["film_half_time"] is None


def test_half_time_of_a_6208_is_of_the_order_of_seconds():
    """Another author has 1 to 11 s for films of 0.3 um of a 6208 with ISO VG 46."""
    half = numbers_of(solve_bearing(case(bearing__supply=0.9)))["bearing"]["film_half_time"]
    assert 1.0 < half < 11.0


def test_tracks_of_all_contacts_are_those_of_the_bearing():
    """The tracks on both rings and once around every ball, shared by the 2 Z contacts."""
    conditions = resolve_bearing(case())
    lengths = sum(track_length(conditions, 0.2, inner=inner) for inner in (True, False))
    assert 9.0 * lengths == pytest.approx(math.pi * (2.0 * 0.06 + 9.0 * 0.011906), rel=1e-12)


def test_a_measured_factor_contains_the_supply():
    greased = case(bearing__supply="grease")
    changed = with_film_factor(prepare_bearing(greased, 1), 0.6).conditions
    assert (changed.film_factor, *parts_of(changed)) == (0.6, None, None)
    states = [OperatingPoint.of(one, {}).at(0.6) for one in (greased, case())]
    assert states[0] == states[1]


@each(
    "changes, line",
    [
        ({"bearing__supply": "greased"}, r"bearing\.supply: .*'greased'.*'flooded', 'oil-bath', "),
        ({"bearing__supply": 0}, r"bearing\.supply: .* 0;.*'flooded'"),
        ({"bearing__supply": 1.5}, r"bearing\.supply: .* 1\.5;.*'flooded'"),
        ({"bearing__supply": [0.5]}, r"bearing\.supply: .* \[0\.5\];.*'flooded'"),
        ({"bearing__supply": True}, r"bearing\.supply: .* True;.*'flooded'"),
        ({"bearing__supply": "grease", "bearing__bore": None}, r"bearing\.bore: missing"),
        (
            {"bearing__supply": "oil-jet", "bearing__outer_diameter": None},
            r"bearing\.outer_diameter: missing.* supply",
        ),
        (
            {"bearing__supply": "grease", "lubricant": {"base": "paper"}},
            r"lubricant\.density: missing.* supply 'grease'",
        ),
    ],
)
def test_refused_supplies(changes, line):
    with pytest.raises(InputError, match=f"^{line}"):
        bearing_case(BALLS, **(SIZE | changes))


def test_a_rule_that_leaves_no_film_is_refused():
    """With 1000 mm^2/s or more at 20 degC the exponent is 6e-8 * 1000 * 15 000 * 120 * sqrt(3.1/80) = 21."""
    cold = case(
        bearing__supply="grease",
        bearing__temperature="20 degC",
        bearing__inner_speed="15000 rpm",
        lubricant__temperature__kinematic_viscosity_40="460 mm^2/s",
        lubricant__temperature__kinematic_viscosity_100="31 mm^2/s",
    )
    with pytest.raises(InputError, match=r"bearing\.supply: .*'grease'.* 15000 rpm"):
        resolve_bearing(cold)


def test_a_number_needs_no_dimensions():
    assert bearing_case(BALLS, bearing__supply=0.5).bearing.supply == 0.5


def test_words_of_a_verdict():
    words = {
        (): {"bearing__supply": 0.6},
        ("0.9",): {"bearing__supply": 0.6, "bearing__film_factor": 0.9},
        ("grease", "inlet shear heating"): {"bearing__supply": "grease", **HEATED},
    }
    for parts, changes in words.items():
        text = supply_words(solve_bearing(case(**changes)).solution)
        assert text.startswith("0.939 " if "grease" in parts else "0.6 ")
        assert [part for part in ("0.9", "grease", "inlet shear heating") if f" {part}" in text] == [*parts]


@pytest.mark.slow
def test_films_by_rule_have_two_critical_speeds():
    """The film goes as n^0.67 exp(-c n): the margin is below 1 on both sides of a band of speeds."""
    changes = {
        "contacts": "formula",
        "bearing.supply": "grease",
        "bearing.temperature": "20 degC",
        "bearing.inner_speed": "4000 rpm",
    }
    base = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace(changes)
    margin = numbers_of(solve_bearing(base))["bearing"]["margin"]
    # The first breakdown goes with the strength: the margin is now 1.5 at the speed of the file.
    result = solve_bearing(base.replace({"discharge.dielectric_strength": 15e6 * 1.5 / margin}))
    speeds = result.margin_analysis.speeds
    assert speeds.critical < base.bearing.inner_speed < speeds.upper
    for speed in (speeds.critical, speeds.upper):
        at = result.case.replace({"bearing.inner_speed": speed})
        assert numbers_of(solve_bearing(at))["bearing"]["margin"] == pytest.approx(1.0, abs=1e-2)
    assert "by grease" in result.verdict.text
