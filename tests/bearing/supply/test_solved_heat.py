"""Film factor "solved" of a bearing: heat of its most loaded contacts, and what it needs."""

import dataclasses
import tomllib

import numpy as np
import pytest

from ehlectric import load, run_sweep
from ehlectric.app.compute.bearing_answers import quick_answer
from ehlectric.bearing import heated_contact
from ehlectric.bearing.preparation import largest_load, prepare_bearing, resolve_bearing
from ehlectric.bearing.quick_contacts import quick_case
from ehlectric.bearing.result import check_bearing, solve_bearing
from ehlectric.bearing.run import NETCDF, save
from ehlectric.bearing.stored import dataset_of, solution_of
from ehlectric.bearing.summary import summary_of
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.quantities.rows import value_at
from ehlectric.runtime.file_rules import UnfitError
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case
from tests.helpers.each import each

THERMAL = {
    "lubricant__temperature__thermal_conductivity": "0.14 W/m/K",
    "lubricant__heat_capacity": "2000 J/kg/K",
}


def case(tables=BALLS, factor="solved", **changes):
    changes = THERMAL | {"motor": None} | changes
    return bearing_case(tables, contacts="formula", bearing__film_factor=factor, **changes)


@pytest.fixture(scope="module")
def rollers():
    return solve_bearing(case(ROLLERS))


@pytest.mark.slow
def test_solved_factor_of_balls_is_near_to_the_formula():
    """Solved films in pure rolling are 0.6 to 2 % above Wilson and Sheu, by docs/validation/bearings.md."""
    quick = prepare_bearing(case(factor="inlet-shear"), 1)
    inner, _ = quick.rings
    solved, _ = heated_contact.solved_contact(case(), inner, largest_load(quick, inner))
    assert 1.0 < solved / quick.conditions.inner.film_factor < 1.03
    assert solved < 1.0


@pytest.mark.slow
@pytest.mark.parametrize("supply", [1.0, 0.6])
def test_films_of_the_bearing_have_the_solved_factor(rollers, supply):
    """The contacts have the films of the same number given; the supply multiplies the factor of the heat."""
    solution = solve_bearing(case(ROLLERS, bearing__supply=supply)).solution
    heat, found = rollers.solution.conditions.inner.film_factor, solution.conditions.inner
    assert (found.heat_factor, found.supply_factor, found.film_factor) == (heat, supply, heat * supply)
    given = solve_bearing(case(ROLLERS, factor=found.film_factor)).solution
    for name in ("central_thickness", "minimum_thickness", "inside"):
        films = (getattr(one.inner_curve.stack(), name) for one in (solution, given))
        np.testing.assert_allclose(*films, rtol=1e-12)
    factor = solution.conditions.part_of_film_factor("heat_factor")
    assert summary_of(solution)["bearing"]["heat_factor"] == factor


@pytest.mark.slow
def test_rollers_lose_more_film_the_faster_they_turn():
    """Heat goes with the square of the speed; at low speed nothing of the film is left to lose."""
    factors = [
        prepare_bearing(case(ROLLERS, bearing__inner_speed=f"{rpm} rpm"), 1).conditions.film_factor
        for rpm in (100, 1000, 4000, 12000)
    ]
    assert factors == sorted(factors, reverse=True)
    assert 0.998 < factors[0] < 1.0
    slow = [
        resolve_bearing(case(ROLLERS, "inlet-shear", bearing__inner_speed=f"{rpm} rpm"))
        for rpm in (100, 1000)
    ]
    for solved, formula in zip(factors, slow, strict=False):
        assert solved == pytest.approx(formula.film_factor, rel=0.03)


@pytest.mark.slow
@pytest.mark.gate
def test_warmer_elements_thin_the_film():
    """The element heats the oil in the inlet; without fits it is as warm as the rings."""
    fits = {
        "bearing__bore": "40 mm",
        "bearing__outer_diameter": "80 mm",
        "bearing__radial_clearance": None,
        "bearing__fits": {
            "unmounted_clearance": "40 um",
            "shaft_interference": "0 um",
            "housing_interference": "-10 um",
            "housing_material": "steel",
        },
    }
    usual = prepare_bearing(case(ROLLERS, **fits), 1).conditions
    fits["bearing__fits"] = fits["bearing__fits"] | {"element_temperature": "85 degC"}
    warm = prepare_bearing(case(ROLLERS, **fits), 1).conditions
    assert warm.inner.heat_factor < 0.97 * usual.inner.heat_factor
    assert warm.outer.heat_factor < 0.97 * usual.outer.heat_factor


@pytest.mark.slow
def test_an_eyring_stress_thins_the_film_a_little_more():
    plain = prepare_bearing(case(ROLLERS), 1).conditions.film_factor
    assert prepare_bearing(case(ROLLERS, lubricant__eyring_stress="1 MPa"), 1).conditions.film_factor < plain
    # A stress that is never reached leaves a Newtonian oil.
    stiff = prepare_bearing(case(ROLLERS, lubricant__eyring_stress="900 MPa"), 1).conditions
    assert stiff.film_factor == pytest.approx(plain, rel=1e-4)


@pytest.mark.usefixtures("rollers")
def test_a_contact_is_solved_once():
    """Strength, roughness and motor change no film."""
    known = heated_contact._solved.cache_info().misses
    prepare_bearing(
        case(ROLLERS, bearing__composite_rq="0.1 um", discharge__dielectric_strength="20 V/um"), 4
    )
    assert heated_contact._solved.cache_info().misses == known


@pytest.mark.slow
def test_stored_results_keep_the_factor(rollers, tmp_path, monkeypatch):
    save(rollers, tmp_path)
    monkeypatch.setattr(heated_contact, "_solved", None)
    assert summary_of(load(tmp_path / NETCDF).solution) == summary_of(rollers.solution)


def test_stored_results_without_a_factor_are_refused(rollers):
    dataset = dataset_of(rollers.solution)
    for broken in (None, [0.9], [0.9, -1.0]):
        dataset.attrs["heat_factor"] = broken
        if broken is None:
            del dataset.attrs["heat_factor"]
        with pytest.raises(UnfitError, match="heat_factor"):
            solution_of(dataset)
    assert "heat_factor" not in dataset_of(solve_bearing(case(ROLLERS, "none")).solution).attrs


def test_an_unconverged_film_has_no_factor(monkeypatch):
    """No number stands for it: the error names ring and load, and becomes exit status 3."""
    solve = KINDS["line"].solve_film
    unconverged = dataclasses.replace(
        KINDS["line"], solve_film=lambda problem: dataclasses.replace(solve(problem), status="stalled")
    )
    monkeypatch.setitem(heated_contact.KINDS, "line", unconverged)
    with pytest.raises(ConvergenceError, match=r"film_factor 'solved': inner contact at .* N: "):
        prepare_bearing(case(ROLLERS, bearing__inner_speed="777 rpm"), 1)


@pytest.mark.slow
@pytest.mark.gate
def test_an_isothermal_film_that_did_not_converge_gives_no_factor():
    """With three Newton steps only the film with heat converges, which takes more of them in its turns."""
    with pytest.raises(ConvergenceError, match=r" N: .*solver\.max_iterations"):
        prepare_bearing(case(ROLLERS, solver__max_iterations=3), 1)


def test_quick_analyses_take_the_formula(monkeypatch):
    """Checks and curves over the speed would otherwise solve dozens of films."""
    monkeypatch.setattr(heated_contact, "_solved", None)
    check_bearing(case())
    changed, _ = quick_case(case())
    assert changed.bearing.film_factor == "inlet-shear"
    assert quick_case(case(factor=0.8))[0].bearing.film_factor == 0.8


@pytest.mark.slow
def test_a_sweep_varies_the_word(tmp_path):
    """A sweep has the factor of each word beside it; that of a material without values is told."""
    table = case(ROLLERS, "none", bearing__inner_speed="6000 rpm")
    (tmp_path / "bearing.toml").write_text(table.to_toml(), encoding="utf-8")
    (tmp_path / "sweep.toml").write_text(
        'case = "bearing.toml"\n[vary]\nbearing.film_factor = ["none", "inlet-shear", "solved"]\n'
        'bearing.element_material = ["steel", "silicon-nitride"]\n',
        encoding="utf-8",
    )
    results = run_sweep(str(tmp_path / "sweep.toml"), tmp_path / "out", workers=1)
    factors = [value_at(point.summary or {}, "lubricant.film_factor") for point in results.points]
    assert factors[:2] == [1.0, 1.0]
    assert 1.0 > factors[2] == factors[3]
    assert factors[4] == pytest.approx(factors[2], rel=0.05)
    assert factors[4] != factors[2]
    assert factors[5] is None
    assert "'silicon-nitride'" in results.points[5].reason


def test_the_app_answers_at_once_by_the_formula(monkeypatch):
    monkeypatch.setattr(heated_contact, "_solved", None)
    answer = quick_answer(tomllib.loads(case(ROLLERS).to_toml()))
    assert answer.numbers["heat_factor"] == resolve_bearing(case(ROLLERS, "inlet-shear")).inner.heat_factor


@each(
    "changes, line",
    [
        (
            {"lubricant__heat_capacity": None},
            r"lubricant\.heat_capacity: missing.* heat_capacity_law",
        ),
        (
            {"lubricant__temperature__thermal_conductivity": None},
            r"lubricant\.thermal_conductivity: missing.* thermal_conductivity_law.* film_factor",
        ),
        (
            {"lubricant": {"base": "paper", "viscosity": "20 mPa s"}},
            r"lubricant\.atmospheric_law: missing.* \[lubricant\.temperature\].* film_factor",
        ),
        (
            {"bearing__element_material": "silicon-nitride"},
            r"bearing\.element_material: 'silicon-nitride'.* film_factor",
        ),
    ],
)
def test_what_is_missing_is_named(changes, line):
    with pytest.raises(InputError, match=f"^{line}"):
        case(**changes)
