"""Films in which everything happens at once: all combinations converge and conserve oil, heat and load.

An effect that is absent changes nothing.
"""

from dataclasses import replace
from importlib import import_module
from itertools import product

import numpy as np
import pytest
from benchmarks.every_effect import case_of, design, solved
from scipy.integrate import cumulative_trapezoid, trapezoid
from scipy.interpolate import BarycentricInterpolator

from ehlectric import Case
from ehlectric.contact.preparation import prepare
from ehlectric.contact.setup import Setup
from ehlectric.film.heated_solution import solve_heated_film
from ehlectric.film.isothermal_film import solve_film, solve_point_film
from ehlectric.film.moving_patch import MovingFilm
from ehlectric.film.problem import OilSupply
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.runtime.threads import quiet_solution
from tests.helpers.hot import hot_contact, hot_oil

pytestmark = pytest.mark.convergence

STEEL = {"material": "steel", "density": 7850.0}
OIL = {"base": "fva-3", "eyring_stress": "5 MPa", "thermal_conductivity": 0.134, "heat_capacity": 2000.0}
NODES = {"line": 201, "point": 65}
SHAPES = {
    "line": {"reduced_radius": "14 mm"},
    "point": {"geometry": "point", "radius_x": "10 mm", "radius_y": "10 mm"},
}


def table(geometry, *, starved=False, hot=False, touching=False, rough=True):
    """Case of rollers or of a ball in FVA 3 at 40 degC."""
    contact = SHAPES[geometry] | {
        "reduced_modulus": "226 GPa",
        "max_hertz_pressure": "0.7 GPa",
        "entrainment_speed": "0.02 m/s" if touching else "1 m/s",
        "slide_to_roll_ratio": 0.3,
        "temperature": "40 degC",
        "boundary_film": "15 nm" if touching else "1 nm",
        "boundary_friction": 0.12,
        "body_1": STEEL,
        "body_2": STEEL,
    }
    wave = {"surface": 1, "generator": "sinusoid", "amplitude": "60 nm", "wavelength": "60 um"}
    if touching:
        wave |= {"amplitude": "150 nm", "wavelength": "40 um"}
    grid = {"nodes": NODES[geometry]} | ({"nodes_y": NODES[geometry]} if geometry == "point" else {})
    found = {"contact": contact, "lubricant": OIL, "grid": grid} | ({"roughness": [wave]} if rough else {})
    if hot:
        found["film"] = {"thermal": True, "rheology": "eyring"}
    if starved:
        found["inlet"] = {"oil_layer": "17 nm" if touching else "80 nm"}
    return found


def posed(geometry, **effects):
    """Film problem of a case."""
    case = Case.from_dict(table(geometry, **effects))
    return prepare(case).film_problem(Setup.of(case))


def film_of(problem):
    """Film in SI units."""
    return (solve_film if problem.width is None else solve_point_film)(problem)


COMBINATIONS = [
    pytest.param(
        geometry,
        effects,
        id=" ".join([geometry, *(name for name, there in effects.items() if there)]),
        # These take minutes together; the others take one or two seconds each.
        marks=[pytest.mark.slow] if effects["touching"] or (effects["hot"] and geometry == "point") else [],
    )
    for geometry in NODES
    for effects in (
        dict(zip(("starved", "hot", "touching"), each, strict=True))
        for each in product((False, True), repeat=3)
    )
]


@pytest.mark.slow
@pytest.mark.parametrize(("geometry", "effects"), COMBINATIONS)
def test_every_combination_at_rest_converges_and_conserves(geometry, effects):
    """Oil to 1e-6 of the mean flow, heat to 1 %, load to 1e-9."""
    film = film_of(posed(geometry, **effects))
    assert film.converged
    assert film.load_residual < 1e-9
    assert film.mass_residual is None or film.mass_residual < 1e-6
    assert bool(film.contact.any()) == effects["touching"]
    assert (film.film_fraction is not None) or not effects["starved"]
    if effects["hot"]:
        assert film.heated.energy_imbalance < 0.01
        assert film.heated.max_temperature_rise > 0.5


@pytest.mark.slow
def test_a_hot_starved_film_that_touches_is_the_same_from_both_ways(monkeypatch):
    """A film on 65 nodes starts from the isothermal film, and from a coarser grid that is fine enough."""
    problem = posed("point", starved=True, hot=True, touching=True)
    usual = film_of(problem)
    monkeypatch.setattr(import_module("ehlectric.film.heated_solution"), "_LEAST_OF_SPOTS", 33)
    quick = film_of(problem)
    # The ways differ: the films are no copies of each other.
    assert not np.array_equal(quick.thickness, usual.thickness)
    for film in (quick, usual):
        assert film.converged
    assert np.array_equal(quick.contact, usual.contact)
    np.testing.assert_allclose(quick.thickness, usual.thickness, rtol=2e-3)
    cold = [film.heated.isothermal_central_thickness for film in (quick, usual)]
    assert cold[0] == pytest.approx(cold[1], rel=2e-3)
    rises = [film.heated.max_temperature_rise for film in (quick, usual)]
    assert rises[0] == pytest.approx(rises[1], rel=6e-3)


@pytest.mark.slow
@pytest.mark.gate
def test_the_temperature_of_a_rough_starved_film_is_the_one_of_its_last_step():
    """The heat of line 129 of the random contacts balances; its last Newton step moves the heat by 5 %."""
    record = solved("lines", design("lines")[129], 60.0)
    assert record["status"] == "converged"
    assert record["imbalance"] < 0.01


@pytest.mark.slow
@pytest.mark.gate
def test_heat_is_carried_by_the_oil_that_passes_the_contact():
    """Line 283 of the random contacts, whose gap is full from the second node on, as far as its cavity."""
    case = case_of("lines", design("lines")[283])
    grid = solve_heated_film(prepare(case).film_problem(Setup.of(case))).refined.last
    assert grid.filled[[0, 1, -1], 0].tolist() == [False, True, False]
    stream = grid.iteration.stream(grid, grid.heat, grid.law)
    behind = np.tensordot(stream.across.weights, stream.mass * stream.u, axes=1)[-1]
    np.testing.assert_allclose(stream.through[0], behind[0], rtol=1e-3)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("hot", [False, True])
def test_a_layer_that_floods_is_no_supply(hot):
    """To 1e-8 of the film, and of a hot film to a fiftieth of the tolerance of its turns."""
    problem = posed("line", hot=hot, rough=False)
    flooded = film_of(problem)
    thick = 1.3 * flooded.central_thickness / problem.scales.thickness
    supplied = replace(problem, supply=OilSupply(layer=lambda y: np.full(y.shape, thick)))
    np.testing.assert_allclose(film_of(supplied).thickness, flooded.thickness, rtol=1e-6 if hot else 1e-8)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("starved", [False, True])
def test_a_boundary_film_that_is_thin_changes_no_hot_film(starved):
    """To 1e-8 of the film: nowhere do the surfaces touch."""
    problem = posed("line", starved=starved, hot=True, rough=False)
    without = film_of(replace(problem, boundary_film=0.0))
    np.testing.assert_allclose(film_of(problem).thickness, without.thickness, rtol=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize(
    "effects", [{"starved": True}, {"touching": True}, {"starved": True, "touching": True}]
)
def test_a_newtonian_rheology_is_the_film_without_it(effects):
    """To 1e-8: the flux law of a sheared oil has that of a Newtonian one as its limit."""
    case = table("line", **effects)
    plain = film_of(posed("line", **effects))
    case = Case.from_dict(case | {"film": {"rheology": "newtonian"}})
    sheared = film_of(prepare(case).film_problem(Setup.of(case)))
    assert sheared.converged
    np.testing.assert_allclose(sheared.central_thickness, plain.central_thickness, rtol=1e-8)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("part", [0.3, 0.8])
def test_oil_that_conducts_all_heat_leaves_a_starved_film_isothermal(part):
    """To 1e-6: with 1.4e4 W/(m K) in the oil and 1e9 in the bodies no temperature builds up."""
    body = {"thermal_conductivity": 1e9}
    problem = hot_contact(hot_oil(conductivity=1.4e4), nodes=201, speed=2.0, body=body)
    layer = part * film_of(replace(problem, physics=None)).central_thickness / problem.scales.thickness
    problem = replace(problem, supply=OilSupply(layer=lambda y: np.full(y.shape, layer)), wedge_order=3)
    hot, cold = film_of(problem), film_of(replace(problem, physics=None))
    assert hot.film_fraction is not None
    np.testing.assert_allclose(hot.thickness, cold.thickness, rtol=1e-6)


def sliding():
    """Film problem of starved hot rollers, one of which hardly moves and conducts heat to the inlet."""
    case = table("line", starved=True, hot=True)
    case["contact"] |= {"slide_to_roll_ratio": 1.9}
    case = Case.from_dict(case | {"inlet": {"oil_layer": "60 nm"}})
    return prepare(case).film_problem(Setup.of(case))


def carried_across(problem, temperature, zeta):
    """Mass that flows past each node of a full gap without a pressure gradient, over rho_0 h u_m, (nx,).

    The stress is uniform across the gap, so that the shear rate goes with the fluidity.
    """
    thermal, slip = problem.physics.thermal, problem.physics.slide_to_roll_ratio
    fine, cold = np.linspace(0.0, 1.0, 401), np.full(1, thermal.inlet_temperature)
    profile = BarycentricInterpolator(zeta, temperature)(fine)
    ambient = np.full(1, problem.scales.ambient_pressure)
    rate = np.exp(-thermal.oil.log_viscosity(ambient, profile).value)
    density = thermal.oil.density(ambient, profile).value / thermal.oil.density(np.zeros(1), cold).value
    share = cumulative_trapezoid(rate, fine, axis=0, initial=0.0)
    return trapezoid(density * (1.0 - 0.5 * slip + slip * share / share[-1]), fine, axis=0)


@pytest.mark.slow
@pytest.mark.gate
def test_a_hot_film_of_sliding_surfaces_gets_its_layer_and_no_more():
    """The slow surface is hot ahead of the contact, and the oil there moves with the fast one.

    Every section of the inlet cavity passes the layer of oil, at the face behind a node with the mean of
    both nodes' gaps and temperatures: to 1e-3, as the mean of two flows is not the flow of the mean.
    """
    problem = sliding()
    film = film_of(problem)
    drift = carried_across(problem, film.heated.temperature, film.heated.zeta) - 1.0
    gap, fraction = film.thickness, film.film_fraction
    at_faces = 0.25 * (gap[1:] + gap[:-1]) * (drift[1:] + drift[:-1])
    layer = fraction[:-1] * (gap[:-1] + at_faces)
    meniscus = int(np.argmax(fraction == 1.0))
    assert meniscus > 80
    assert 0.05 < np.max(drift[:meniscus]) < 0.15
    # Pressure drives oil back into the node before the meniscus.
    np.testing.assert_allclose(layer[1 : meniscus - 1], 60e-9, rtol=1e-3)
    # The pressure compresses the oil.
    assert film.central_thickness < 60e-9


def moving(geometry, **effects):
    """Moving film of a case whose wave passes through the contact."""
    found = table(geometry, **effects) | {"motion": {"passes": 1.0}}
    found["grid"] = {"nodes": 101} if geometry == "line" else {"nodes": 65, "nodes_y": 65}
    case = Case.from_dict(found)
    contact = TransientContact.of(case, prepare(case).rough)
    return contact, MovingFilm(contact.problem, contact.moving_gap)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("hot", [False, True])
@pytest.mark.parametrize("starved", [False, True])
def test_without_motion_every_film_stays(hot, starved):
    """After 30 steps to 1e-7 of the film, with heat to what its iteration leaves of the temperature."""
    contact, _ = moving("line", starved=starved, hot=hot)
    still = MovingFilm(contact.problem, lambda _time, x, y: np.zeros((x.size, y.size)))
    with quiet_solution():
        history = still.start(contact.schedule.step)
        first = history.now
        for _ in range(30):
            history = still.film.advance(history, contact.schedule.step)
    np.testing.assert_allclose(history.now.state.thickness, first.state.thickness, rtol=2e-5 if hot else 1e-7)
    if starved:
        np.testing.assert_allclose(history.now.mass[:30], first.mass[:1].repeat(30, axis=0), rtol=1e-9)
    if hot:
        np.testing.assert_allclose(history.now.warmth.middle, first.warmth.middle, atol=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("geometry", ["line", "point"])
@pytest.mark.parametrize("touching", [False, True])
@pytest.mark.parametrize("hot", [False, True])
@pytest.mark.parametrize("starved", [False, True])
def test_every_combination_in_motion_converges(geometry, starved, hot, touching):
    """Forty steps, in which the wave reaches the contact of a line; the load is carried at each."""
    contact, film = moving(geometry, starved=starved, hot=hot, touching=touching)
    steps = min(contact.schedule.steps, 300 if geometry == "line" else 40)
    with quiet_solution():
        history = film.start(contact.schedule.step)
        for _ in range(steps):
            history = film.film.advance(history, contact.schedule.step)
    level = film.film.level
    load = float(np.vdot(level.weights, history.now.state.pressure))
    assert load == pytest.approx(level.load, rel=1e-9)
    assert np.all(history.now.oil_fraction >= 0.0)
