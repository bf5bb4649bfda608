"""Whole bearings, solved: loads that are chosen, contacts of elements between them, laws of scale."""

import re
from functools import partial

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.bearing.bearing_kinds import KINDS, kind_of
from ehlectric.bearing.preparation import least_load
from ehlectric.bearing.result import BearingResult, check_bearing, solve_bearing
from ehlectric.bearing.solving import POSITIONS
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.errors import MemoryLimitError
from ehlectric.formulas.film_point import PointContact, chittenden
from tests.helpers.bearings import (
    BALLS,
    ROLLERS,
    bearing_case,
    contact_case,
    numbers_of,
    ring_of,
    solve_contact,
)


@pytest.fixture(scope="module")
def rollers():
    return solve_bearing(bearing_case(ROLLERS), workers=1).solution


@pytest.mark.slow
def test_solved_loads_hold_those_of_all_elements(rollers):
    """Ten of each ring, evenly in their logarithm up to the largest, and light ones below."""
    for name, race, curve in (
        ("inner", rollers.inner, rollers.inner_curve),
        ("outer", rollers.outer, rollers.outer_curve),
    ):
        loads = np.array([solution.load for solution in curve.solutions])
        steps, evenly = np.diff(np.log(loads)), KINDS["cylindrical roller"].loads - 1
        np.testing.assert_allclose(steps[-evenly:], steps[-1], rtol=1e-9)
        # No decade is left empty: from the light end on, each step is longer than the one before.
        assert np.all(loads[1:] < 3.0 * loads[:-1])
        assert np.all(np.diff(steps[:-evenly]) > 0.0)
        of_elements = np.concatenate([getattr(p.equilibrium, f"{name}_load") for p in rollers.positions])
        assert loads[-1] == pytest.approx(np.max(of_elements), rel=1e-9, abs=0.0)
        # What is below a five hundredth of the largest, or has a film that no domain holds, is not reached.
        # An element without a load is lighter than all.
        least = np.min(of_elements)
        lightest = max(least, 0.002 * loads[-1], least_load(race))
        assert loads[0] <= lightest * (1.0 + 1e-9)
        # Nor is anything lighter solved.
        assert loads[0] == pytest.approx(lightest, rel=1e-9, abs=0.0)


@pytest.mark.slow
def test_positions_are_those_of_one_pitch(rollers):
    """The first has a roller on the load line; a pitch further everything comes again."""
    assert len(rollers.positions) == POSITIONS
    angles = [position.equilibrium.position[0] for position in rollers.positions]
    pitch = 2.0 * np.pi / 14
    np.testing.assert_allclose(
        np.mod(angles, 2.0 * np.pi), pitch * np.arange(POSITIONS) / POSITIONS, atol=1e-12
    )


@pytest.mark.slow
def test_an_elements_contact_is_the_one_solved_at_its_load(rollers):
    """Each loaded roller of the first position against its own solution: within the interpolation's error."""
    case, position = rollers.case, rollers.positions[0]
    for race, state, curve in (
        (rollers.inner, position.inner, rollers.inner_curve),
        (rollers.outer, position.outer, rollers.outer_curve),
    ):
        for k in np.flatnonzero(state.solved)[:3]:
            alone = solve_contact(race, float(state.load[k]), case.solver.model_dump()).values
            tolerance = curve.interpolation_error
            assert state.values.inside[k] == pytest.approx(alone.inside, rel=tolerance)
            assert state.values.breakdown_voltage[k] == pytest.approx(alone.breakdown_voltage, rel=tolerance)


@pytest.mark.slow
def test_entrainment_is_that_of_pure_rolling(rollers):
    """n pi (d_m^2 - D^2)/(2 d_m) at both rings, with the cage between them."""
    speed = np.pi * 50.0 * (60e-3**2 - 11e-3**2) / (2.0 * 60e-3)
    assert rollers.inner.speed == pytest.approx(speed, rel=1e-9, abs=0.0)
    assert rollers.outer.speed == pytest.approx(speed, rel=1e-9, abs=0.0)


@pytest.mark.slow
def test_a_film_factor_thins_the_films(rollers):
    """By about its own part, and voltages with them; the entrainment speed is the true one."""
    lean = solve_bearing(
        bearing_case(ROLLERS, bearing__film_factor=0.7, bearing__summit_height=0.0), workers=1
    ).solution
    assert lean.inner.speed == rollers.inner.speed
    thick, thin = (s.inner_curve.solutions[-1].values.central_thickness for s in (rollers, lean))
    # The solved film goes with a power of the speed that is a little above the formula's 0.69.
    assert thin / thick == pytest.approx(0.7, rel=0.03)
    breaks = [numbers_of(BearingResult(s))["bearing"]["first_break"] for s in (rollers, lean)]
    assert breaks[1] / breaks[0] == pytest.approx(0.7, rel=0.05)


def test_progress_counts_the_contacts():
    told = []
    changes = {"bearing__radial_clearance": "-20 um", "bearing__radial_load": "1 N"}
    solution = solve_bearing(
        bearing_case(ROLLERS, **changes),
        progress=lambda done, number, text: told.append((done, number, text)),
        workers=1,
    ).solution
    number = len(solution.inner_curve.solutions) + len(solution.outer_curve.solutions)
    assert [row[:2] for row in told] == [(k, number) for k in range(number + 1)]
    assert told[-1][2].startswith("contact with")
    # Interference presses all rollers, nearly alike.
    assert all(np.all(p.inner.solved) for p in solution.positions)


@pytest.mark.parametrize("tables", [BALLS, ROLLERS], ids=["balls", "rollers"])
def test_below_the_least_load_a_domain_is_at_its_end(tables):
    """Lengths that the film of rigid bodies builds up over grow as the load falls; cases stay valid ones."""
    case = bearing_case(tables)
    ring = ring_of(case, inner=False, speed=4.5)
    least = least_load(ring)
    inlets = []
    for load in least * np.array([4.0, 1.0, 0.25, 1e-3]):
        made = contact_case(ring, float(load), case.solver.model_dump())
        axis = resolve_point(made).semi_axis_x if tables is BALLS else resolve(made).half_width
        inlets.append(-made.grid.inlet * axis)
    # A roller's film goes with 1/w, and the length with its root: 2 from 4 w to w, or nearly, as yet; a long
    # inlet is a fifth shorter.
    assert 1.5 < inlets[1] / inlets[0] < 2.5
    # Without an end they would again be twice as long.
    assert inlets[2] < 1.3 * inlets[1]
    assert inlets[3] < 1.3 * inlets[1]


@pytest.mark.parametrize("tables", [BALLS, ROLLERS], ids=["balls", "rollers"])
@pytest.mark.parametrize("speed", [1e-3, 4.5, 300.0])
def test_at_the_least_load_a_film_needs_the_largest_domain(tables, speed):
    ring = ring_of(bearing_case(tables), inner=False, speed=speed)
    needed = kind_of(ring).contact(ring, least_load(ring)).part_needed
    assert 1.0 - 1e-7 < needed <= 1.0


@pytest.mark.parametrize("contacts", ["solved", "formula"])
def test_a_load_wider_than_the_balls_is_refused_before_anything_is_solved(contacts):
    """200 kN on a ball bearing of 60 mm: dry contacts of a centimetre on balls of twelve millimetres.

    Both rings have such contacts. The check before a command and the solver name the same one.
    """
    case = bearing_case(BALLS, contacts=contacts, bearing__radial_load="200 kN")
    reasons = []
    for refuse in (check_bearing, partial(solve_bearing, workers=1)):
        with pytest.raises(InputError, match=r"^bearing: outer contact at .* N: .*wide") as caught:
            refuse(case)
        reasons.append(str(caught.value))
    assert reasons[0] == reasons[1]


@pytest.mark.parametrize(("tables", "size"), [(BALLS, "129 x 129"), (ROLLERS, "801")])
def test_a_contact_beyond_the_memory_is_named(monkeypatch, tables, size):
    """By both that check and solve; the contact is one of the ring's, its grid no table of the file."""
    monkeypatch.setattr("ehlectric.contact.contact_memory.available_memory", lambda: 1e6)
    case = bearing_case(tables)
    for refused in (check_bearing, lambda case: solve_bearing(case, workers=1)):
        with pytest.raises(MemoryLimitError) as error:
            refused(case)
        assert error.value.key == "bearing"
        line = rf"bearing: (inner|outer) contact at [\d.]+ N: grid\.nodes: .* {size} "
        assert re.match(line, str(error.value))


@pytest.mark.parametrize("changes", [{"bearing__inner_speed": 1e-9}, {"bearing__film_factor": 1e-7}])
@pytest.mark.parametrize("contacts", ["solved", "formula"])
@pytest.mark.parametrize("tables", [BALLS, ROLLERS])
def test_a_bearing_without_a_film_is_refused(tables, contacts, changes):
    """At 1e-10 m/s nothing of an atom's size is left of a film: no solver is begun."""
    case = bearing_case(tables, contacts=contacts, **changes)
    for refused in (check_bearing, lambda case: solve_bearing(case, workers=1)):
        with pytest.raises(InputError, match=r"^bearing: \w+ contact at .* N: .*film"):
            refused(case)


@pytest.mark.parametrize("tables", [BALLS, ROLLERS])
def test_formulas_take_piezoviscous_oils(tables):
    case = bearing_case(tables, contacts="formula", lubricant__viscosity_law="constant")
    for refused in (check_bearing, solve_bearing):
        with pytest.raises(InputError, match=r"^lubricant\.viscosity_law: .*'constant'"):
            refused(case)
    check_bearing(case.replace({"contacts": "solved"}))


def test_an_oil_below_freezing_is_doubted():
    """ASTM D341 goes on below any pour point."""
    for temperature, doubted in (("-10 degC", True), ("70 degC", False)):
        case = bearing_case(BALLS, contacts="formula", bearing__temperature=temperature)
        texts = list(map(str, solve_bearing(case).warnings))
        assert any(text.startswith("bearing.temperature is") for text in texts) == doubted
        # A bearing's contacts have no grid that its file could change.
        assert not any("grid." in text for text in texts)


@pytest.mark.slow
def test_a_6208_as_a_whole_and_between_the_loads_that_were_solved():
    """Beside the formulas, Chittenden's for such ellipses; light contacts each beside its own solution.

    Between 3.3 and 42 N the film of rigid bodies turns into that of bodies that deform; with no load between
    them it was up to a third off.
    """
    case = bearing_case(BALLS)
    result = solve_bearing(case)
    solution = result.solution
    found = numbers_of(result)["bearing"]
    assert result.converged
    assert found["discretisation_error"] < 0.03
    assert not [
        text for text in map(str, result.warnings) if "too short" in text or "does not cavitate" in text
    ]
    formula = numbers_of(solve_bearing(case.replace({"contacts": "formula"})))["bearing"]
    for key in ("capacitance", "capacitance_plate", "first_break", "ring_to_ring_breakdown", "lambda_ratio"):
        assert formula[key] == pytest.approx(found[key], rel=0.3), key
    oil = solution.conditions.oil
    for race, curve in ((solution.inner, solution.inner_curve), (solution.outer, solution.outer_curve)):
        radii = race.radii
        for contact in curve.solutions:
            film = chittenden(
                PointContact(
                    radius_x=radii.radius_x, radius_y=radii.radius_y, load=contact.load,
                    reduced_modulus=solution.conditions.modulus, entrainment_speed=race.speed,
                    viscosity=oil.viscosity, pressure_viscosity_coefficient=oil.alpha_star,
                )
            )  # fmt: skip
            if contact.moes_m > 100.0:
                assert contact.values.central_thickness == pytest.approx(film.central_thickness, rel=0.15)
            assert contact.mismatch < 0.1
    curve, race = solution.outer_curve, solution.outer
    for load in (4.22, 5.35, 13.15):
        alone = solve_contact(race, load, case.solver.model_dump()).values
        for name in ("inside", "breakdown_voltage"):
            at = getattr(curve.at(np.array([load])), name)[0]
            assert at == pytest.approx(getattr(alone, name), rel=curve.interpolation_error), (
                name,
                load,
            )
            assert at == pytest.approx(getattr(alone, name), rel=0.02), (name, load)
