"""Contacts of bearings against cases written by hand, wider domains, and loads solved in between."""

import dataclasses
import math

import numpy as np
import pytest

from ehlectric import Case, solve
from ehlectric.bearing.gaps import (
    RollerRaceway,
    groove_capacitance,
    match_film,
    outside_capacitance,
    roller_capacitance,
    roller_tails,
)
from ehlectric.bearing.result import check_bearing
from ehlectric.bearing.ring_contacts import ContactCurve, without_regime
from ehlectric.bearing.solution import ring_state
from ehlectric.contact.conditions import resolve_point
from ehlectric.formulas.hertz import dry_contact
from ehlectric.quantities.result_warnings import ResultWarning
from tests.helpers.bearings import (
    BALLS,
    ROLLERS,
    bearing_case,
    contact_case,
    contact_of,
    contact_solution,
    formula_contact,
    ring_of,
    solve_contact,
    with_values,
)
from tests.helpers.oils import alpha_star

# Rolling at 3000 rpm with the cage: n pi (d_m^2 - D^2)/(2 d_m) at zero contact angle.
SPEED = math.pi * 50.0 * (60e-3**2 - 11.906e-3**2) / (2.0 * 60e-3)


def of(tables, *, inner=True, speed=SPEED, **changes):
    """Contacts with a ring, and the table of the solver."""
    case = bearing_case(tables, **changes)
    return ring_of(case, inner=inner, speed=speed), case.solver.model_dump()


def solved(tables, load, *, inner=True, **changes):
    ring, solver = of(tables, inner=inner, **changes)
    return solve_contact(ring, load, solver)


@pytest.fixture(scope="module")
def light_ball():
    return solved(BALLS, 60.0)


@pytest.fixture(scope="module")
def rollers():
    """A roller's contact with the inner ring at six loads."""
    return ContactCurve.of(tuple(solved(ROLLERS, load) for load in np.geomspace(60.0, 3000.0, 6)))


def by_hand(contact, grid, discharge):
    """A case with the numbers that a 6208 and its oil at 70 degC have."""
    viscosity = 14.847e-6 * 838.90
    return Case.from_dict(
        {
            "contact": {"entrainment_speed": SPEED, "reduced_modulus": 208e9 / (1.0 - 0.3**2)} | contact,
            "lubricant": {
                "base": "paper",
                "viscosity": viscosity,
                "pressure_viscosity_coefficient": 0.67 * (math.log(viscosity) + 9.67) / 0.198e9,
                "ambient_pressure": 0.0,
            },
            "grid": grid,
            "discharge": {"dielectric_strength": "15 V/um"} | discharge,
        }
    )


@pytest.mark.slow
def test_a_ball_is_the_case_by_hand(light_ball):
    """Radii of a ball of 11.906 mm between (60 - 11.906)/2 and the groove of 0.52 balls; both steel."""
    values = light_ball.values
    ball = 11.906e-3 / 2.0
    race, groove = 30e-3 - ball, 0.52 * 11.906e-3
    contact = {
        "geometry": "point",
        "radius_x": 1.0 / (1.0 / ball + 1.0 / race),
        "radius_y": 1.0 / (1.0 / ball - 1.0 / groove),
        "load": 60.0,
    }
    result = solve(by_hand(contact, {"inlet": -9.0, "side": 3.5, "nodes": 257}, {}))
    # Two domains and grids: some thousandths of the film.
    assert values.minimum_thickness == pytest.approx(result.film.minimum_thickness, rel=0.02)
    assert values.central_thickness == pytest.approx(result.film.central_thickness, rel=0.02)
    assert values.max_pressure == pytest.approx(result.conditions.max_pressure, rel=1e-6, abs=0.0)
    assert values.semi_axis_y == pytest.approx(result.conditions.semi_axis_y, rel=1e-6, abs=0.0)
    assert values.breakdown_voltage == pytest.approx(result.discharge.breakdown_voltage, rel=0.02)
    assert values.plate == pytest.approx(result.discharge.capacitance_plate, rel=0.02)
    # Where the film is thinnest the field is the largest, but for a thousandth.
    assert values.breakdown_voltage == pytest.approx(15e6 * values.minimum_thickness, rel=3e-3)
    # What the field is at the breakdown voltage is the strength.
    at_breakdown = values.breakdown_voltage * values.strength_per_volt
    assert at_breakdown == pytest.approx(15e6, rel=1e-6, abs=0.0)
    assert light_ball.converged
    assert light_ball.error < 0.03


@pytest.mark.parametrize("inner", [True, False])
def test_a_roller_is_the_case_by_hand(inner):
    """Rollers of 11 mm on cylinders of (60 -+ 11)/2 mm, 10 mm long: capacitance and load of their length."""
    roller = 5.5e-3
    race = 30e-3 - roller if inner else -30e-3 - roller
    found = solved(ROLLERS, 1200.0, inner=inner)
    contact = {"reduced_radius": 1.0 / (1.0 / roller + 1.0 / race), "load_per_length": 1200.0 / 10e-3}
    result = solve(by_hand(contact, {"inlet": -10.0, "nodes": 6401}, {"length": 10e-3}))
    assert found.values.minimum_thickness == pytest.approx(result.film.minimum_thickness, rel=3e-3)
    assert found.values.central_thickness == pytest.approx(result.film.central_thickness, rel=3e-3)
    assert found.values.plate == pytest.approx(0.01 * result.discharge.capacitance_plate, rel=3e-3)
    assert found.values.semi_axis_x == pytest.approx(result.conditions.half_width, rel=1e-6, abs=0.0)
    assert found.values.semi_axis_y == pytest.approx(5e-3, rel=1e-12, abs=0.0)
    assert found.values.breakdown_voltage == pytest.approx(result.discharge.breakdown_voltage, rel=3e-3)


def test_moes_groups_by_hand(light_ball):
    """M = F/(E' Rx^2) U^(-3/4) and L = alpha E' U^(1/4), U = eta0 u_s/(E' Rx) with u_s of both surfaces."""
    modulus, viscosity = 208e9 / (1.0 - 0.3**2), 14.847e-6 * 838.90
    rx = 1.0 / (2.0 / 11.906e-3 + 2.0 / (60e-3 - 11.906e-3))
    u = viscosity * 2.0 * SPEED / (modulus * rx)
    assert light_ball.moes_m == pytest.approx(60.0 / (modulus * rx**2) * u**-0.75, rel=1e-3, abs=0.0)
    alpha = alpha_star(0.67 * (math.log(viscosity) + 9.67) / 0.198e9)
    assert light_ball.moes_l == pytest.approx(alpha * modulus * u**0.25, rel=1e-3, abs=0.0)


@pytest.mark.slow
def test_the_whole_of_a_ball_in_another_domain(light_ball):
    """Film by hand within 7 semi-axes before it and 3 beside, the gap of its groove around that."""
    values = light_ball.values
    ball, groove = 11.906e-3 / 2.0, 0.52 * 11.906e-3
    contact = {
        "geometry": "point",
        "radius_x": 1.0 / (1.0 / ball + 1.0 / (30e-3 - ball)),
        "radius_y": 1.0 / (1.0 / ball - 1.0 / groove),
        "load": 60.0,
    }
    result = solve(by_hand(contact, {"inlet": -7.0, "side": 3.0, "nodes": 257}, {}))
    outside, mismatch = around(of(BALLS)[0], result)
    assert 0.0 < mismatch < 0.1
    assert 0.0 < light_ball.mismatch < 0.1
    whole = result.discharge.capacitance + 2.4 * outside
    assert values.inside + values.outside_oil == pytest.approx(whole, rel=0.01)
    assert values.outside_oil == pytest.approx(2.4 * values.outside_air, rel=1e-12, abs=0.0)
    assert values.inside == pytest.approx(result.discharge.capacitance, rel=0.1)


def test_a_solution_tells_what_its_case_does():
    """Estimate of its film's error, whether it converged, and warnings but for those of light loads."""
    ring, solver = of(ROLLERS)
    for options, converged in ((solver, True), (solver | {"max_iterations": 1}, False)):
        result = solve(contact_case(ring, 1200.0, options))
        found = solve_contact(ring, 1200.0, options)
        assert found.error == result.film.discretisation_error
        assert (found.error is not None) == found.converged == result.converged == converged
        assert found.error is None or 0.0 < found.error < 0.03
        assert set(found.warnings) <= set(result.warnings)
        assert bool(found.warnings) != converged


@pytest.mark.slow
@pytest.mark.parametrize(("tables", "load", "exponent"), [(BALLS, 60.0, 0.67), (ROLLERS, 1200.0, 0.69)])
def test_a_film_factor_acts_once(tables, load, exponent):
    """The film of a factor is that of a case at the speed u factor^(1/exponent); the ring's speed stays u."""
    factor = 0.7
    ring, solver = of(tables, bearing__film_factor=factor)
    conditions = contact_of(ring, load).conditions
    assert (ring.speed, conditions.entrainment_speed, conditions.film_factor) == (SPEED, SPEED, factor)
    slower, _ = of(tables, speed=SPEED * factor ** (1.0 / exponent))
    # Domain and first grid follow the thinner film, too.
    assert contact_of(ring, load).grid == contact_of(slower, load).grid
    case = contact_case(slower, load, solver)
    found, result = solve_contact(ring, load, solver), solve(case)
    for name in ("minimum_thickness", "central_thickness"):
        assert getattr(found.values, name) == pytest.approx(getattr(result.film, name), rel=1e-9, abs=0.0)
    assert found.values.breakdown_voltage == pytest.approx(
        result.discharge.breakdown_voltage, rel=1e-9, abs=0.0
    )
    formula, thin = formula_contact(ring, load), formula_contact(slower, load)
    assert formula.values.columns() == pytest.approx(thin.values.columns(), rel=1e-9, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("tables", [BALLS, ROLLERS], ids=["balls", "rollers"])
def test_a_contact_of_a_bearing_makes_no_case(monkeypatch, tables):
    ring, solver = of(tables)

    def refuse(*_arguments, **_keywords):
        raise AssertionError("a contact of a bearing has no case")

    for name in ("from_dict", "model_validate", "__init__"):
        monkeypatch.setattr(Case, name, refuse)
    check_bearing(bearing_case(tables))
    assert solve_contact(ring, 60.0, solver).converged
    assert formula_contact(ring, 60.0).converged


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("load", [5.0, 60.0, 1200.0])
def test_a_rollers_capacitance_does_not_depend_on_where_its_film_ends(load):
    """Film and tails beside a domain twice as long: within 1 %, the film's own part of that with it.

    Three hundred half-widths, where the longest inlets end, are seven of its lengths at 5 N, not ten.
    """
    ring, solver = of(ROLLERS, inner=False)
    found = solve_contact(ring, load, solver)
    case = contact_case(ring, load, solver)
    twice = {f"grid.{end}": 2.0 * getattr(case.grid, end) for end in ("inlet", "outlet")}
    result = solve(case.replace(twice | {"grid.nodes": 2 * case.grid.nodes - 1}))
    film = result.film
    ends = [(float(a[0]), float(a[-1])) for a in (film.x, film.thickness)]
    tails = roller_tails(RollerRaceway(5.5e-3, 35.5e-3, outer=True), result.conditions.half_width, *ends)
    whole = 0.01 * (result.discharge.capacitance + 2.4 * sum(tails))
    short = load == 5.0
    assert found.values.inside + found.values.outside_oil == pytest.approx(
        whole, rel=0.015 if short else 0.01
    )
    assert found.values.minimum_thickness == pytest.approx(
        film.minimum_thickness, rel=0.03 if short else 0.015
    )
    assert found.values.inside < 0.01 * result.discharge.capacitance
    assert found.values.outside_oil == pytest.approx(2.4 * found.values.outside_air, rel=1e-12, abs=0.0)


@pytest.mark.slow
@pytest.mark.parametrize(("load", "film", "whole"), [(3.3, 0.2, 0.03), (20.0, 0.01, 0.01)])
def test_a_balls_film_in_a_domain_twice_as_large(load, film, whole):
    """The film of balls that hardly press builds up far ahead: the domain costs less than these parts."""
    ring, solver = of(BALLS, inner=False)
    found = solve_contact(ring, load, solver)
    case = contact_case(ring, load, solver)
    wide = {key: 2.0 * getattr(case.grid, key) for key in ("inlet", "side")}
    nodes = 2 * case.grid.nodes - 1
    result = solve(case.replace({f"grid.{k}": v for k, v in wide.items()} | {"grid.nodes": nodes}))
    assert found.values.minimum_thickness == pytest.approx(result.film.minimum_thickness, rel=film + 0.01)
    outside, mismatch = around(ring, result)
    assert mismatch < 0.1
    together = result.discharge.capacitance + 2.4 * outside
    assert found.values.inside + found.values.outside_oil == pytest.approx(together, rel=whole)
    assert found.values.inside < result.discharge.capacitance


def around(ring, result):
    """Capacitance in vacuum outside a solved film, and how the gaps fit at its edge."""
    film, conditions = result.film, result.conditions
    x, y = np.meshgrid(film.x, film.y, indexing="ij")
    rim = np.ones(x.shape, dtype=bool)
    rim[1:-1, 1:-1] = False
    modulus = ring.conditions.modulus
    dry = dry_contact(conditions.load, conditions.radius_x, conditions.radius_y, modulus)
    raceway = ring.raceway
    contact = match_film(raceway, dry, modulus, x=x[rim], y=y[rim], thickness=film.thickness[rim])
    ends = float(film.x[0]), float(film.x[-1]), float(film.y[-1])
    return outside_capacitance(raceway, contact, ends), contact.mismatch


@pytest.mark.slow
def test_a_balls_capacitance_falls_with_speed():
    """At 890 N: the Hertz part as the inverse of h(0), the whole less steeply.

    A film between the 0.67 of Hamrock and Dowson's fit and the 0.75 of the limit of heavily loaded contacts,
    M^(-1/12) L^(3/4) (Nijenbanning, Venner and Moes). The Hertz part is extrapolated from two grids, since
    the thinner film has the larger error.
    """
    speeds = SPEED * np.array([1.0, 4.0])
    hertz, whole = [], []
    for speed in speeds:
        ring, solver = of(BALLS, speed=float(speed))
        case = contact_case(ring, 890.0, solver)
        coarse, fine = (solve(case.replace({"grid.refine": None, "grid.nodes": n})) for n in (257, 513))
        parts = [result.discharge.capacitance_hertz for result in (coarse, fine)]
        hertz.append(parts[1] + (parts[1] - parts[0]) / 3.0)
        whole.append(fine.discharge.capacitance + 2.4 * around(ring, fine)[0])
    slopes = [np.polyfit(np.log(speeds), np.log(c), 1)[0] for c in (hertz, whole)]
    assert -0.75 < slopes[0] < -0.67
    assert slopes[0] + 0.1 < slopes[1] < -0.4


def test_a_rollers_capacitance_falls_with_speed():
    """The Hertz part falls with between 0.69, Dowson and Toyoda's, and the limit M^(-1/8) L^(3/4), 0.75."""
    speeds = SPEED * np.array([0.5, 1.0, 2.0])
    hertz, whole = [], []
    for speed in speeds:
        ring, solver = of(ROLLERS, speed=float(speed))
        hertz.append(solve(contact_case(ring, 2000.0, solver)).discharge.capacitance_hertz)
        found = solve_contact(ring, 2000.0, solver)
        whole.append(found.values.inside + found.values.outside_oil)
    slopes = [np.polyfit(np.log(speeds), np.log(c), 1)[0] for c in (hertz, whole)]
    assert -0.75 < slopes[0] < -0.69
    assert slopes[0] + 0.05 < slopes[1] < -0.4


def test_more_load_and_capacitance(rollers):
    """The heavier, the more capacitance and the lower the voltage, where bodies deform: M above 3."""
    heavy = [c for c in rollers.solutions if c.moes_m > 3.0]
    assert len(heavy) >= 3
    assert np.all(np.diff([c.values.inside for c in heavy]) > 0.0)
    assert np.all(np.diff([c.values.breakdown_voltage for c in heavy]) < 0.0)
    assert all(c.values.outside_oil > 0.0 for c in heavy)


def test_a_curve_gives_back_its_solutions(rollers):
    loads = np.array([c.load for c in rollers.solutions])
    for name in ("inside", "breakdown_voltage", "minimum_thickness", "outside_oil", "max_pressure"):
        exact = [getattr(c.values, name) for c in rollers.solutions]
        np.testing.assert_allclose(getattr(rollers.at(loads), name), exact, rtol=1e-9)


def test_between_its_loads_a_curve_is_as_good_as_it_says(rollers):
    """Against contacts solved halfway between all of its loads."""
    for low, high in zip(rollers.solutions[:-1], rollers.solutions[1:], strict=True):
        between = solved(ROLLERS, math.sqrt(low.load * high.load))
        for name in ("inside", "breakdown_voltage"):
            found = getattr(rollers.at(np.array([between.load])), name)[0]
            error = abs(found / getattr(between.values, name) - 1.0)
            assert error < rollers.interpolation_error, (name, between.load)
    assert rollers.interpolation_error < 0.05


@pytest.mark.parametrize("inner", [True, False])
def test_a_6208_is_where_its_contacts_are_known_to_be(inner):
    """M of 1300 to 10 000 and L of 10 to 23 at 870 N, estimated apart from this package."""
    ring, solver = of(BALLS, inner=inner)
    case = contact_case(ring, 870.0, solver)
    groups = resolve_point(case).contact
    assert 1300.0 < groups.moes_m < 10_000.0
    assert 10.0 < groups.moes_l < 23.0


def powers(loads):
    """Made-up contacts whose quantities are powers of the load."""
    one = contact_solution(
        load=1.0, max_pressure=1e8, semi_axis_x=1e-5, semi_axis_y=1e-4, minimum_thickness=4e-7,
        central_thickness=5e-7, inside=2e-11, outside_oil=1e-11, outside_air=5e-12, plate=1e-11,
        strength_per_volt=2.5e6, breakdown_voltage=6.0, error=0.01, moes_m=10.0, moes_l=10.0,
        mismatch=0.0, converged=True, warnings=(),
    )  # fmt: skip
    rows = [
        dataclasses.replace(with_values(one, inside=2e-11 * q**0.6, breakdown_voltage=6.0 * q**-0.07), load=q)
        for q in loads
    ]
    return ContactCurve.of(tuple(rows))


def test_warnings_of_the_regime_are_left_out_by_their_code():
    """Whatever their words are."""
    others = [
        ResultWarning("tunnelling", "isoviscous-rigid regime"),
        ResultWarning("plastic-deformation", ""),
    ]
    regime = ResultWarning("regime", "isoviscous-rigid regime")
    assert without_regime([others[0], regime, others[1]]) == tuple(others)


def test_powers_of_the_load_are_interpolated_exactly():
    curve = powers([1.0, 7.0, 100.0, 900.0])
    load = np.geomspace(1.0, 900.0, 31)
    np.testing.assert_allclose(curve.at(load).inside, 2e-11 * load**0.6, rtol=1e-9)
    np.testing.assert_allclose(curve.at(load).breakdown_voltage, 6.0 * load**-0.07, rtol=1e-9)
    assert curve.interpolation_error < 1e-9


def test_the_interpolation_error_is_that_of_a_contact_left_out():
    """One of a power law 10 % off: from its neighbours it would be itself over 1.1."""
    curve = powers([1.0, 10.0, 100.0])
    off = with_values(curve.solutions[1], inside=1.1 * curve.solutions[1].values.inside)
    bent = ContactCurve.of((curve.solutions[0], off, curve.solutions[2]))
    assert bent.interpolation_error == pytest.approx(1.0 - 1.0 / 1.1, rel=1e-9, abs=0.0)


def test_beyond_its_loads_a_curve_has_its_ends():
    curve = powers([1.0, 100.0])
    np.testing.assert_allclose(curve.at(np.array([0.1, 1e4])).inside, 2e-11 * np.array([1.0, 100**0.6]))
    one = powers([5.0])
    np.testing.assert_allclose(one.at(np.array([1.0, 5.0, 9.0])).inside, 2e-11 * 5.0**0.6)
    assert one.interpolation_error == 0.0


def test_without_a_strength_nothing_breaks():
    found = solved(ROLLERS, 500.0, discharge=None)
    assert found.values.breakdown_voltage == np.inf
    assert np.all(ContactCurve.of((found,)).at(np.array([1.0, 500.0])).breakdown_voltage == np.inf)


@pytest.mark.parametrize("inner", [True, False])
def test_elements_without_load_are_rigid_bodies_apart(inner):
    """Ball in groove and roller in race of the gap's own functions, and strength times gap."""
    for tables in (BALLS, ROLLERS):
        ring, _ = of(tables, inner=inner)
        load, gap = np.array([100.0, 0.0, 0.0]), np.array([0.0, 5e-6, 20e-6])
        state = ring_state(ring, powers([1.0, 1000.0]), load=load, gap=gap, room=gap)
        if tables is BALLS:
            expected = [groove_capacitance(ring.raceway, g) for g in gap[1:]]
        else:
            around_roller = RollerRaceway(5.5e-3, 24.5e-3 if inner else 35.5e-3, outer=not inner)
            expected = [0.01 * roller_capacitance(around_roller, g) for g in gap[1:]]
        np.testing.assert_allclose(state.capacitance("air")[1:], expected, rtol=1e-12)
        np.testing.assert_allclose(state.capacitance("oil")[1:], 2.4 * np.array(expected), rtol=1e-12)
        np.testing.assert_allclose(state.values.breakdown_voltage[1:], 15e6 * gap[1:], rtol=1e-12)
        assert list(state.solved) == [True, False, False]
        assert state.values.inside[0] == pytest.approx(2e-11 * 100.0**0.6, rel=1e-9, abs=0.0)
        assert state.capacitance("oil")[0] == pytest.approx(state.values.inside[0] + 1e-11, rel=1e-9, abs=0.0)
        np.testing.assert_array_equal(state.values.plate[1:], 0.0)
