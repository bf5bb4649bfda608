"""Contacts of a bearing solved with heat and a supply of oil together: films, friction and share of time."""

import dataclasses
import math

import numpy as np
import pytest

from ehlectric import load
from ehlectric.bearing import film_factor, heated_contact
from ehlectric.bearing.bearing_touching import duty_of
from ehlectric.bearing.film_factor import rolling_power_loss, solved_scales
from ehlectric.bearing.heated_contact import solved_contact
from ehlectric.bearing.preparation import largest_load, prepare_bearing
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.run import NETCDF, save
from ehlectric.bearing.solution import conducts
from ehlectric.bearing.speed_curves import capacitive_speed
from ehlectric.bearing.stored import dataset_of, solution_of
from ehlectric.bearing.summary import summary_of
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case

SIZE = {"bearing__bore": "40 mm", "bearing__outer_diameter": "82 mm"}
THERMAL = {
    "bearing__film_factor": "solved",
    "lubricant__temperature__thermal_conductivity": "0.14 W/m/K",
    "lubricant__heat_capacity": "2000 J/kg/K",
    "motor": None,
}


def case(tables=ROLLERS, supply="flooded", **changes):
    changes = {"contacts": "formula", "bearing__supply": supply} | THERMAL | changes
    return bearing_case(tables, **changes)


def inner_contact(tables, supply):
    """Factor of the heat and friction of the most loaded inner contact."""
    own = case(tables, supply)
    prepared = prepare_bearing(case(tables, supply, bearing__film_factor="none"), 1)
    ring = prepared.rings[0]
    return solved_contact(own, ring, largest_load(prepared, ring))


@pytest.fixture(scope="module")
def contacts():
    return {supply: inner_contact(ROLLERS, supply) for supply in ("flooded", 1.0, 0.9, 0.5, 0.1)}


@pytest.fixture(scope="module")
def starved():
    return solve_bearing(case(supply=0.5))


@pytest.fixture(scope="module")
def flooded():
    return solve_bearing(case())


@pytest.mark.slow
def test_a_ratio_of_one_is_the_flooded_film(contacts):
    assert contacts[1.0] == contacts["flooded"]
    hot, grid = _last_hot()
    found, solved = heated_contact._starved(hot, grid, 1.0), heated_contact._solved(hot).friction
    for each in dataclasses.fields(found):
        own, other = getattr(found, each.name), getattr(solved, each.name)
        if each.name not in ("oil_layer", "temperature_rise_error"):
            assert own == pytest.approx(other, rel=1e-4 if "rise" in each.name else 1e-6)
    assert found.oil_layer > found.solved_thickness


def _last_hot():
    """Most loaded inner contact of the rollers as it is solved, with its grid."""
    own, prepared = case(), prepare_bearing(case(bearing__film_factor="none"), 1)
    ring = heated_contact._flooded(prepared.rings[0])
    contact = film_factor.kind_of(ring).contact(ring, largest_load(prepared, ring))
    hot = heated_contact._hot(own, contact)
    return hot, heated_contact._solved(hot).grid


@pytest.mark.slow
def test_less_oil_leaves_less_film_and_less_resistance(contacts):
    """The factor of the heat stays that of the flooded film, and the film is the ratio of the flooded one."""
    flooded = contacts["flooded"][1]
    falling = [contacts[supply] for supply in ("flooded", 0.9, 0.5, 0.1)]
    assert len({factor for factor, _ in falling}) == 1
    for ratio in (0.9, 0.5, 0.1):
        friction = contacts[ratio][1]
        assert friction.solved_thickness == pytest.approx(ratio * flooded.solved_thickness, rel=2e-4)
    for name in ("solved_thickness", "rolling_coefficient", "power_loss", "inlet_temperature_rise"):
        values = [getattr(friction, name) for _, friction in falling]
        assert values == sorted(values, reverse=True)
    layers = [contacts[ratio][1].oil_layer for ratio in (0.9, 0.5, 0.1)]
    assert layers == sorted(layers, reverse=True)
    # A short inlet loses more of the resistance than of the film; nearly nothing is left of it in the end.
    parts = [contacts[r][1].rolling_coefficient / flooded.rolling_coefficient for r in (0.9, 0.5, 0.1)]
    assert 0.5 < parts[0] < 0.9 * 0.9
    assert 0.05 < parts[1] < 0.5 * 0.5
    assert parts[2] < 0.1 * 0.1


@pytest.mark.slow
def test_resistance_is_that_of_the_starved_film(contacts):
    """By an own integral of h/2 dp/dx over the film with heat and supply."""
    hot, grid = _last_hot()
    film = hot.film(grid, heated_contact.OilSupply(film_ratio=0.5))
    own = float(np.sum(0.25 * (film.thickness[1:] + film.thickness[:-1]) * np.diff(film.pressure)))
    friction = contacts[0.5][1]
    assert friction.rolling_coefficient * hot.conditions.load_per_length == pytest.approx(own, rel=0.01)
    speed = hot.conditions.entrainment_speed
    assert friction.power_loss == pytest.approx(
        2.0 * speed * friction.rolling_coefficient * friction.load, rel=1e-9
    )


@pytest.mark.slow
def test_heat_and_supply_together_are_thinner_than_either(starved, flooded):
    both = starved.solution
    alone = (flooded.solution, solve_bearing(case(supply=0.5, bearing__film_factor="none")).solution)
    for other in alone:
        assert both.least_film < other.least_film
        assert both.conditions.film_factor < other.conditions.film_factor
    least = min(other.conditions.inner.film_factor for other in alone)
    own = both.conditions.inner
    assert own.film_factor == own.heat_factor * 0.5 == pytest.approx(0.974 * least, abs=0.01)


@pytest.mark.slow
def test_power_of_a_starved_bearing(starved, flooded, contacts):
    """All its contacts have the part of the most loaded one."""
    part = contacts[0.5][1].rolling_coefficient / contacts["flooded"][1].rolling_coefficient
    whole, less = (rolling_power_loss(one.solution) for one in (flooded, starved))
    assert less / whole == pytest.approx(part, rel=0.02)
    rows = {row.key: row.text for row in total_rows(starved.summary())}
    assert ", of starved contacts" in rows["bearing.rolling_power_loss"]


def test_a_rule_is_a_factor_on_film_and_resistance(flooded):
    """SKF publishes it for the rolling moment: no film is solved with it."""
    known = heated_contact._starved.cache_info().misses
    greased = solve_bearing(case(supply="grease", **SIZE)).solution
    assert heated_contact._starved.cache_info().misses == known
    own, other = greased.conditions.inner, flooded.solution.conditions.inner
    for name in ("rolling_coefficient", "power_loss", "solved_thickness"):
        assert getattr(own.friction, name) == pytest.approx(
            own.supply_factor * getattr(other.friction, name), rel=1e-9
        )
    assert own.friction.oil_layer is None
    rows = {row.key: row.text for row in total_rows(summary_of(greased))}
    assert "by SKF's replenishment factor" in rows["bearing.rolling_power_loss"]


@pytest.mark.slow
@pytest.mark.gate
def test_share_of_time_is_that_of_the_solved_film(starved):
    """Clarke's 1 - erf(lambda) of the most loaded contact, with the film that was solved for it."""
    found, friction = starved.summary()["bearing"], starved.solution.conditions.inner.friction
    share = 1.0 - math.erf(friction.solved_thickness / starved.solution.case.bearing.composite_rq)
    contact = max(
        (row for row in starved.summary()["contacts"] if row["ring"] == "inner"), key=lambda row: row["load"]
    )
    assert contact["load"] == pytest.approx(friction.load, rel=1e-9)
    assert contact["contact_time_share"] == pytest.approx(share, rel=1e-6)
    assert found["inner_solved_thickness"] == friction.solved_thickness
    # The lambda ratio of a row stays that of its own film.
    rq = starved.solution.case.bearing.composite_rq
    assert contact["central_lambda_ratio"] == pytest.approx(contact["central_thickness"] / rq, rel=1e-12)


def test_films_without_solved_heat_are_not_scaled():
    solution = solve_bearing(case(bearing__film_factor="inlet-shear")).solution
    assert solved_scales(solution) == (1.0, 1.0)


@pytest.mark.slow
def test_speed_of_the_capacitive_regime_follows_the_solved_film():
    """At this speed the share of time is 1 %, or surfaces part: of the same scaled films."""
    rough = solve_bearing(case(supply=0.5, bearing__composite_rq="0.06 um", bearing__summit_height=0.0))
    duty, speed = duty_of(rough.solution), capacitive_speed(rough.solution)
    assert not conducts(rough.solution)
    assert (duty.behaviour == "capacitive") == (speed < rough.case.bearing.inner_speed)
    plain = duty_of(rough.solution, ring_scales=(1.0, 1.0))
    scales = solved_scales(rough.solution)
    assert (duty.contact_time_share < plain.contact_time_share) == (min(scales) > 1.0)


@pytest.mark.slow
@pytest.mark.gate
def test_an_unconverged_starved_film_has_no_friction(monkeypatch, tmp_path):
    """Films have both factors all the same; a note says what is missing, also of a stored result."""
    monkeypatch.setattr(heated_contact, "_starved", lambda *_: None)
    result = solve_bearing(case(supply=0.8))
    conditions = result.solution.conditions
    assert conditions.inner.film_factor == conditions.inner.heat_factor * 0.8
    assert conditions.inner.friction is None
    assert rolling_power_loss(result.solution) is None
    assert "starved-film-unsolved" in result.summary()["warning_codes"]
    save(result, tmp_path)
    assert load(tmp_path / NETCDF).summary() == result.summary()


def test_stored_starved_friction(starved):
    dataset = dataset_of(starved.solution)
    assert solution_of(dataset).conditions.outer.friction == starved.solution.conditions.outer.friction
    # Version 1.0 has neither: its friction is that of flooded contacts, as its table says.
    for name in ("solved_thickness", "solved_oil_layer"):
        del dataset.attrs[name]
    old = solution_of(dataset)
    assert old.conditions.inner.friction.solved_thickness is None
    assert solved_scales(old) == (1.0, 1.0)
    rows = {row.key: row.text for row in total_rows(summary_of(old))}
    assert ", of flooded contacts" in rows["bearing.rolling_power_loss"]


@pytest.mark.slow
def test_balls_with_heat_and_supply():
    flooded, starved = (inner_contact(BALLS, supply)[1] for supply in ("flooded", 0.7))
    assert starved.solved_thickness == pytest.approx(0.7 * flooded.solved_thickness, rel=2e-4)
    assert 0.1 < starved.rolling_coefficient / flooded.rolling_coefficient < 0.7 * 0.7
    # A wide ellipse takes hardly more oil than a line: the layer is about the film at ambient density.
    assert 1.0 < starved.oil_layer / starved.solved_thickness < 1.35
