"""Temperatures of oil and rings: which holds where, and what each of them moves."""

import pytest

from ehlectric import InputError
from ehlectric.bearing.preparation import resolve_bearing
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.summary import summary_of
from ehlectric.bearing.uncertain_inputs import usual_changes
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.tables.bearing_tables import input_rows
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each

TABLE = {"temperature": ["40 degC", "100 degC"], "strength": ["20 V/um", "14 V/um"]}
OVER_TEMPERATURE = {"discharge__dielectric_strength": None, "discharge__strength_table": TABLE}


def at(oil=None, inner=None, outer=None, **changes):
    """A 6208 with these temperatures in degC."""
    given = {"temperature": oil, "inner_ring_temperature": inner, "outer_ring_temperature": outer}
    texts = {f"bearing__{key}": value and f"{value} degC" for key, value in given.items()}
    return bearing_case(BALLS, **texts | changes)


def temperatures(case):
    """Temperatures of oil and rings in degC, as resolved."""
    conditions = resolve_bearing(case)
    parts = conditions.oil, conditions.inner.oil, conditions.outer.oil
    return tuple(round(part.temperature - 273.15, 9) for part in parts)


@each(
    "given, found",
    [
        ((70, None, None), (70, 70, 70)),
        ((None, 80, None), (80, 80, 80)),
        ((None, None, 60), (60, 60, 60)),
        ((70, 80, None), (70, 80, 70)),
        ((70, None, 60), (70, 70, 60)),
        ((70, 80, 60), (70, 80, 60)),
    ],
)
def test_one_temperature_holds_for_all_and_that_of_the_oil_for_a_ring_without(given, found):
    case = at(*given)
    assert temperatures(case) == found
    assert BearingCase.from_dict(case.to_dict()) == case


@pytest.mark.parametrize("rings", [(None, None), (80, 60)])
def test_the_temperature_of_the_oil_is_not_guessed(rings):
    with pytest.raises(InputError, match=r"^bearing\.temperature: missing"):
        at(None, *rings)


def test_a_changed_ring_changes_what_follows_from_it():
    """The only temperature that is given stays that of all parts; beside another it is that of the ring."""
    changes = {"bearing.inner_ring_temperature": "90 degC"}
    assert temperatures(at(None, 80).replace(changes)) == (90, 90, 90)
    assert temperatures(at(70).replace(changes)) == (70, 90, 70)


@pytest.mark.slow
def test_films_form_at_the_temperature_of_their_ring():
    """Inner contacts with an inner ring of 90 degC are those of a bearing of 90 degC, outer ones stay."""
    mixed, cold, hot = (
        solve_bearing(at(*given, contacts="formula", **OVER_TEMPERATURE), workers=1).solution
        for given in ((70, 90, 70), (70, None, None), (90, None, None))
    )
    for name in ("minimum_thickness", "inside", "breakdown_voltage", "max_pressure"):
        for own, curve in ((hot, "inner_curve"), (cold, "outer_curve")):
            found, expected = (getattr(each, curve).solutions[-1].values for each in (mixed, own))
            assert getattr(found, name) == pytest.approx(getattr(expected, name), rel=1e-12, abs=0.0)
    # 15 V/um at 90 degC, 17 at 70, in a film of thickness h.
    inner, outer = (curve.solutions[-1].values for curve in (mixed.inner_curve, mixed.outer_curve))
    assert inner.breakdown_voltage == pytest.approx(15e6 * inner.minimum_thickness, rel=1e-9, abs=0.0)
    assert outer.breakdown_voltage == pytest.approx(17e6 * outer.minimum_thickness, rel=1e-9, abs=0.0)


def test_an_unloaded_element_has_the_strength_of_the_oil():
    """17 V/um at 70 degC in the gap of an element that the inner ring of 90 degC does not touch."""
    solution = solve_bearing(at(70, 90, contacts="formula", **OVER_TEMPERATURE), workers=1).solution
    inner = solution.positions[0].inner
    apart = ~inner.solved
    assert apart.any()
    gaps = inner.values.minimum_thickness[apart]
    assert inner.values.breakdown_voltage[apart] == pytest.approx(17e6 * gaps, rel=1e-9, abs=0.0)


def test_inlet_heat_is_that_of_each_ring():
    """Thin warm oil is heated less in its inlet, so that less of its film is lost."""
    shear = {
        "bearing__film_factor": "inlet-shear",
        "lubricant__temperature__thermal_conductivity": "0.14 W/m/K",
    }
    mixed, cold, hot = (resolve_bearing(at(*given, **shear)) for given in ((70, 90), (70,), (90,)))
    assert mixed.inner.film_factor == hot.inner.film_factor > mixed.outer.film_factor
    assert mixed.film_factor == mixed.outer.film_factor == cold.film_factor


def test_summary_and_table_name_both_rings():
    summary = summary_of(solve_bearing(at(70, 90, contacts="formula"), workers=1).solution)
    oil = summary["lubricant"]
    assert [oil[f"{ring}_temperature"] for ring in ("inner", "outer")] == pytest.approx([363.15, 343.15])
    assert oil["inner_viscosity"] < oil["outer_viscosity"] == oil["viscosity"]
    rows = {row.key: row.shown for row in input_rows(summary)}
    assert (rows["lubricant.temperature"], rows["lubricant.inner_temperature"]) == ("70", "90")
    assert "lubricant.outer_temperature" not in rows


def test_errors_and_warnings_name_the_ring():
    with pytest.raises(InputError, match=r"^bearing\.inner_ring_temperature: .* 383\.15 K"):
        resolve_bearing(at(70, 110, **OVER_TEMPERATURE))
    with pytest.raises(InputError, match=r"^bearing\.temperature: .* 383\.15 K"):
        resolve_bearing(at(110, 70, **OVER_TEMPERATURE))


def test_the_margin_over_temperature_warms_all_parts_together():
    """A change by 10 K is one of oil, ring and housing at once; other parts follow theirs."""
    fits = {"unmounted_clearance": "24 um", "shaft_interference": "5 um", "housing_interference": "0 um"}
    fits |= {"housing_material": "cast-iron", "housing_temperature": "50 degC"}
    sizes = {"bearing__radial_clearance": None, "bearing__bore": "40 mm", "bearing__outer_diameter": "80 mm"}
    case = at(70, 85, bearing__fits=fits, **sizes)
    changes = {change.key: change for change in usual_changes(case, case.to_dict())}
    warmth = changes["bearing.temperature"]
    for step, end in zip((-10.0, 10.0), warmth.ends, strict=True):
        bearing = case.replace(warmth.changes(end)).bearing
        found = *bearing.temperatures().values(), bearing.fits.housing_temperature
        assert found == pytest.approx([value + 273.15 + step for value in (70, 85, 50)], rel=1e-12)
    clearance = changes["bearing.fits.unmounted_clearance"]
    assert clearance.ends == pytest.approx((19e-6, 29e-6), rel=1e-12)
    assert "bearing.radial_clearance" not in changes
