"""Rolling resistance of bearings: solved films over load, sums over all elements, and what stands beside."""

import dataclasses
import math

import numpy as np
import pytest

from ehlectric import load
from ehlectric.bearing.bearing_kinds import kind_of
from ehlectric.bearing.conditions import ContactFriction
from ehlectric.bearing.film_factor import rolling_force, rolling_power_loss
from ehlectric.bearing.preparation import largest_load, prepare_bearing, with_film_factor
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.ring_contacts import solve
from ehlectric.bearing.run import NETCDF, save
from ehlectric.bearing.stored import dataset_of, solution_of
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.grid_inputs import Grid, Solver, point_grid
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.setup import Setup
from ehlectric.runtime.file_rules import UnfitError
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case

HOT = {
    "bearing__film_factor": "solved",
    "lubricant__temperature__thermal_conductivity": "0.14 W/m/K",
    "lubricant__heat_capacity": "2000 J/kg/K",
    "motor": None,
}
KEYS = {
    "rolling_power_loss",
    "rolling_moment",
    *(
        f"{ring}_{key}"
        for ring in ("inner", "outer")
        for key in (
            "rolling_coefficient",
            "contact_power_loss",
            "inlet_temperature_rise",
            "max_temperature_rise",
            "temperature_rise_error",
        )
    ),
}


def case(tables, **changes):
    return bearing_case(tables, **({"contacts": "formula"} | HOT | changes))


@pytest.fixture(scope="module")
def rollers():
    return solve_bearing(case(ROLLERS)).solution


def integrated(contact, grid):
    """Rolling force [N] or [N/m] of an isothermal film: own integral of h/2 dp/dx over the whole domain."""
    conditions = contact.conditions
    if grid.side is not None:
        conditions = dataclasses.replace(conditions, side=grid.side)
    kind = KINDS[conditions.geometry]
    setup = Setup(contact.ring.oil, grid, solver=Solver())
    film = kind.solve_film(kind.film_problem(setup, conditions, ()))
    assert film.converged
    along = 0.25 * (film.thickness[1:] + film.thickness[:-1]) * np.diff(film.pressure, axis=0)
    force = np.sum(along, axis=0)
    return float(force if force.ndim == 0 else np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(film.y)))


def flooded(tables):
    """Contacts of the inner ring with isothermal films, and the load of the most loaded one [N]."""
    prepared = prepare_bearing(bearing_case(tables, contacts="formula"), 1)
    return prepared.rings[0], largest_load(prepared, prepared.rings[0])


def forces(ring, loads, grids):
    """Forces of solved films [N] at several loads, and those of the formula, which the first one scales."""
    kind, length = kind_of(ring), ring.conditions.bearing.roller_length or 1.0
    solved = [
        length * integrated(kind.contact(ring, value), grid) for value, grid in zip(loads, grids, strict=True)
    ]
    first = ContactFriction(loads[0], solved[0] / loads[0], math.nan, math.nan, math.nan, None)
    return np.array(solved), rolling_force(ring, first, np.array(loads))


def test_rolling_force_of_solved_rollers_does_not_depend_on_heavy_loads():
    """Biboulet and Houpert: exponent 0 from M of 2 on, and a half for light loads. Zhou has 0.246 for all."""
    ring, most = flooded(ROLLERS)
    loads = [part * most for part in (1.0, 0.5, 0.03, 0.01)]
    # The inlets reach twenty lengths over which the pressure builds up.
    grids = [
        Grid.from_dict({"inlet": 2.0 * own.inlet, "outlet": own.outlet, "nodes": nodes})
        for own, nodes in (
            (kind_of(ring).contact(ring, value).grid, nodes)
            for value, nodes in zip(loads, (801, 801, 1601, 2401), strict=True)
        )
    ]
    solved, scaled = forces(ring, loads, grids)
    assert math.log(solved[0] / solved[1]) / math.log(2.0) == pytest.approx(0.0, abs=0.03)
    assert math.log(solved[2] / solved[3]) / math.log(3.0) == pytest.approx(0.5, abs=0.05)
    np.testing.assert_allclose(scaled, solved, rtol=0.13)


@pytest.mark.slow
def test_rolling_force_of_solved_balls_goes_with_the_width():
    """Biboulet and Houpert: the cube root of the load, less a little where M comes near to 6.6."""
    ring, most = flooded(BALLS)
    loads = [most, 0.1 * most]
    grids = [
        Grid.from_dict(point_grid({"inlet": inlet, "outlet": 1.5, "side": side, "nodes": 257, "nodes_y": 65}))
        for inlet, side in ((-9.0, 2.7), (-14.7, 2.9))
    ]
    solved, scaled = forces(ring, loads, grids)
    assert math.log10(solved[0] / solved[1]) == pytest.approx(1.0 / 3.0, abs=0.06)
    np.testing.assert_allclose(scaled, solved, rtol=0.04)


@pytest.mark.parametrize(
    "tables", [pytest.param(BALLS, id="balls", marks=pytest.mark.slow), pytest.param(ROLLERS, id="rollers")]
)
def test_the_solved_contact_has_the_force_of_its_own_film(tables, rollers):
    """On the domain of the bearing, isothermal: heat takes some per cent of the force, as of the film."""
    ring, most = flooded(tables)
    kind, solution = kind_of(ring), rollers if tables is ROLLERS else solve_bearing(case(BALLS)).solution
    friction, length = solution.conditions.inner.friction, solution.case.bearing.roller_length or 1.0
    own = kind.contact(ring, most).grid
    across = {} if own.side is None else {"side": own.side, "nodes_y": 65}
    table = {"inlet": own.inlet, "outlet": own.outlet, "nodes": 129 if across else 401, **across}
    grid = Grid.from_dict(point_grid(table) if across else table)
    isothermal = length * integrated(kind.contact(ring, most), grid)
    assert friction.load == pytest.approx(most, rel=1e-12)
    assert 0.96 < friction.rolling_coefficient * most / isothermal < 0.99
    assert friction.power_loss == pytest.approx(
        2.0 * friction.rolling_coefficient * most * ring.speed, rel=1e-9
    )


def test_heat_of_the_solved_contact(rollers):
    """The inlet is some kelvins warmer than the ring; the peak behind the middle cannot be less."""
    for own in (rollers.conditions.inner, rollers.conditions.outer):
        friction = own.friction
        assert 1.0 < friction.inlet_temperature_rise < 4.0
        assert friction.max_temperature_rise >= friction.inlet_temperature_rise
        assert friction.temperature_rise_error > 0.0


def test_power_of_rollers_is_the_sum_of_all_contacts(rollers):
    """By hand: the force goes with m/(1 + (0.9655 m)^10)^(1/10) and M = m^2."""

    def part(heavy):
        root = math.sqrt(heavy)
        return root / (1.0 + (1.4 / 1.45 * root) ** 10) ** 0.1

    by_hand = 0.0
    for ring, own in ((rollers.inner, rollers.conditions.inner), (rollers.outer, rollers.conditions.outer)):
        radius, modulus, length = ring.radii.radius_x, rollers.conditions.modulus, 0.01
        speed = 2.0 * own.oil.viscosity * ring.speed / (modulus * radius)

        one, scale = own.friction, length * modulus * radius * math.sqrt(speed)
        for position in rollers.positions:
            loads = position.inner.load if ring.inner else position.outer.load
            total = sum(part(newton / scale) for newton in loads if newton > 0.0)
            force = one.rolling_coefficient * one.load * total / part(one.load / scale)
            by_hand += 2.0 * ring.speed * force / len(rollers.positions)
    assert rolling_power_loss(rollers) == pytest.approx(by_hand, rel=1e-9)


@pytest.mark.slow
def test_moment_of_balls_is_of_the_size_of_a_makers_rolling_moment():
    """SKF: R1 d_m^1.96 F_r^0.54 (nu n)^0.6 N mm times its factor of the inlet, R1 = 3.9e-7 of series 62."""
    for rpm in (1000, 3000, 6000):
        radial = case(BALLS, bearing__axial_load="0 N", bearing__inner_speed=f"{rpm} rpm")
        summary = summary_of(solve_bearing(radial).solution)
        nu = 1e6 * summary["lubricant"]["viscosity"] / summary["lubricant"]["density"]
        inlet = 1.0 / (1.0 + 1.84e-9 * (rpm * 60.0) ** 1.28 * nu**0.64)
        maker = 3.9e-7 * 60.0**1.96 * 1800.0**0.54 * (nu * rpm) ** 0.6 * inlet
        assert 1e3 * summary["bearing"]["rolling_moment"] == pytest.approx(maker, rel=0.3)


def test_summary_has_the_friction_and_both_factors(rollers):
    found = summary_of(rollers)["bearing"]
    assert found.keys() >= KEYS
    assert all(found[key] > 0.0 for key in KEYS)
    omega = 3000.0 * math.pi / 30.0
    assert found["rolling_moment"] * omega == pytest.approx(found["rolling_power_loss"], rel=1e-12)
    assert found["heat_factor"] != found["inlet_shear_factor"]
    assert found["heat_factor"] == pytest.approx(found["inlet_shear_factor"], rel=0.03)


@pytest.mark.parametrize(("factor", "known"), [("none", False), ("inlet-shear", True), (0.9, False)])
def test_without_solved_heat_there_is_no_friction(factor, known):
    found = summary_of(solve_bearing(case(ROLLERS, bearing__film_factor=factor)).solution)["bearing"]
    assert {found[key] for key in KEYS} == {None}
    assert found["inlet_shear_factor"] == (found["heat_factor"] if known else None)


@pytest.mark.slow
@pytest.mark.gate
def test_a_given_film_factor_has_no_friction():
    """Films of another thickness are not those whose friction was solved."""
    changed = with_film_factor(prepare_bearing(case(ROLLERS), 1), 0.8).conditions
    assert changed.inner.friction is None
    assert changed.part_of_film_factor("inlet_shear_factor") is None


@pytest.mark.slow
@pytest.mark.gate
def test_stored_friction(rollers, tmp_path):
    """A file keeps it; one of films of another thickness has none, and a damaged one is refused."""
    result = solve_bearing(case(ROLLERS))
    save(result, tmp_path)
    assert load(tmp_path / NETCDF).solution.conditions.outer.friction == rollers.conditions.outer.friction
    dataset = dataset_of(rollers)
    dataset.attrs["solved_temperature_rise_error"] = [np.nan, 1.0]
    assert solution_of(dataset).conditions.inner.friction.temperature_rise_error is None
    for broken in ({"solved_load": [0.0, 1.0]}, {"solved_power_loss": [np.nan, 1.0]}):
        with pytest.raises(UnfitError, match=next(iter(broken))):
            solution_of(dataset.assign_attrs(broken))
    for name in [name for name in dataset.attrs if name.startswith("solved_")]:
        del dataset.attrs[name]
    without = solution_of(dataset)
    assert without.conditions.inner.friction is None
    assert without.conditions.inner.heat_factor == rollers.conditions.inner.heat_factor
    assert without.conditions.outer.heat_factor == rollers.conditions.outer.heat_factor
    assert summary_of(without)["bearing"]["rolling_power_loss"] is None
    assert not [name for name in dataset_of(without).attrs if name.startswith("solved_")]


def test_table_says_what_the_power_is_of(rollers):
    rows = {row.key: row.text for row in total_rows(summary_of(rollers))}
    power = summary_of(rollers)["bearing"]["rolling_power_loss"]
    assert rows["bearing.rolling_power_loss"].startswith(f"{power:.4g} W")
    without = summary_of(solve_bearing(case(ROLLERS, bearing__film_factor=0.9)).solution)
    assert "bearing.rolling_power_loss" not in {row.key for row in total_rows(without)}


def film_exponent(solution, isothermal):
    """Exponent with which the factor acts on the solved film of the most loaded inner contact."""
    ring, most = prepare_bearing(isothermal, 1).rings[0], solution.inner_curve.solutions[-1]
    plain = solve(kind_of(ring).contact(ring, most.load), Solver())
    ratio = most.values.central_thickness / plain.values.central_thickness
    return math.log(ratio) / math.log(solution.conditions.inner.film_factor)


@pytest.mark.slow
def test_solved_rollers_with_solved_heat(rollers):
    """Films and friction are both solved: the friction is that beside contacts by formula."""
    solution = solve_bearing(case(ROLLERS, contacts="solved"), workers=1).solution
    assert solution.converged
    assert solution.conditions.inner.friction == rollers.conditions.inner.friction
    assert rolling_power_loss(solution) == pytest.approx(rolling_power_loss(rollers), rel=1e-12)
    assert film_exponent(solution, bearing_case(ROLLERS)) == pytest.approx(1.0, abs=0.1)
    assert summary_of(solution)["bearing"]["contacts"] == "solved"


@pytest.mark.slow
def test_solved_balls_with_solved_heat(tmp_path):
    """Balls under axial load alone have one load on each ring: films of the factor, friction, file."""
    axial = {
        "bearing__radial_load": "0 N",
        "bearing__axial_load": "500 N",
        "bearing__inner_speed": "10000 rpm",
    }
    result = solve_bearing(case(BALLS, contacts="solved", **axial), workers=1)
    solution, totals = result.solution, summary_of(result.solution)["bearing"]
    assert result.converged
    assert len(solution.inner_curve.solutions) == len(solution.outer_curve.solutions) == 1
    factor, friction = solution.conditions.inner.film_factor, solution.conditions.inner.friction
    assert factor == solution.conditions.inner.heat_factor < 0.9
    # All nine balls have the same load, so that nothing is scaled.
    each = friction.power_loss + solution.conditions.outer.friction.power_loss
    assert totals["rolling_power_loss"] == pytest.approx(9.0 * each, rel=1e-3)
    # Solved films grow with a power of the speed above that by which the factor acts, about 0.72 for 0.67.
    assert film_exponent(solution, bearing_case(BALLS, **axial)) == pytest.approx(1.07, abs=0.05)
    save(result, tmp_path)
    assert load(tmp_path / NETCDF).summary()["bearing"] == result.summary()["bearing"]
