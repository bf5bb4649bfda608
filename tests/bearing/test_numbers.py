"""A ball bearing whose rings differ, put together again from its elements, one contact at a time."""

import dataclasses
import math

import numpy as np
import pytest

from ehlectric.bearing.result import BearingResult, solve_bearing
from ehlectric.bearing.ring_contacts import ContactCurve, RingContacts
from ehlectric.bearing.solution import conducts, lambda_ratio
from tests.helpers.bearings import (
    BALLS,
    bearing_case,
    formula_contact,
    numbers_of,
    rigid_capacitance,
    with_values,
)

# Fast, so that the outer ring carries more; with a wider outer groove and room for unloaded balls.
CHANGES = {
    "contacts": "formula",
    "bearing__outer_groove": 0.53,
    "bearing__inner_speed": "9000 rpm",
    "bearing__radial_clearance": "30 um",
    "bearing__axial_load": "100 N",
}


@pytest.fixture(scope="module", params=["oil", "air"])
def result(request):
    return solve_bearing(bearing_case(BALLS, **CHANGES, bearing__fill=request.param))


def by_elements(result, at, fill):
    """Capacitance and breakdown voltage of all inner and of all outer contacts, each at its own load.

    Radii, angle and speed are those of the most loaded ball. Balls that touch nothing are rigid ones apart.
    """
    solution = result.solution
    first = solution.positions[0].equilibrium
    most = int(np.argmax(first.inner_load))
    parts = {}
    for name, inner in (("inner", True), ("outer", False)):
        angle = float(getattr(first, f"{name}_angle")[most])
        speed = float(getattr(first.speeds, f"{name}_entrainment")[most])
        ring = RingContacts(solution.conditions, inner, angle, speed)
        capacitances, strengths, films = [], [], []
        for load, gap in zip(getattr(at, f"{name}_load"), getattr(at, f"{name}_gap"), strict=True):
            if load > 0.0:
                contact = formula_contact(ring, float(load)).values
                around = contact.outside_oil if fill == "oil" else contact.outside_air
                capacitances.append(contact.inside + around)
                strengths.append(contact.breakdown_voltage)
                films.append(contact.minimum_thickness)
            else:
                vacuum = rigid_capacitance(ring, float(gap))
                capacitances.append((2.4 if fill == "oil" else 1.0) * vacuum)
                strengths.append(15e6 * float(gap))
        parts[name] = np.array(capacitances), np.array(strengths), min(films)
    return parts


@pytest.mark.slow
@pytest.mark.gate
def test_a_bearing_from_its_elements(result):
    """1/C = 1/C_i + 1/C_o, elements added; V/s of each contact, then what its partner holds.

    The result interpolates between six loads of a ring: some thousandths.
    """
    solution = result.solution
    found, fill = numbers_of(result)["bearing"], solution.case.bearing.fill
    totals, firsts, throughs, films = [], [], [], []
    for position, circuit in zip(solution.positions, result.solution.circuits(fill), strict=True):
        parts = by_elements(result, position.equilibrium, fill)
        (inner, inner_holds, inner_film), (outer, outer_holds, outer_film) = parts["inner"], parts["outer"]
        np.testing.assert_allclose(circuit.inner, inner, rtol=0.02)
        np.testing.assert_allclose(circuit.outer, outer, rtol=0.02)
        totals.append(np.sum(1.0 / (1.0 / inner + 1.0 / outer)))
        # The charge of both is one: the inner one has C_o/(C_i + C_o) of the voltage.
        at_inner, at_outer = inner_holds * (inner + outer) / outer, outer_holds * (inner + outer) / inner
        first = np.minimum(at_inner, at_outer)
        partner = np.where(at_inner <= at_outer, outer_holds, inner_holds)
        firsts.append(np.min(first))
        throughs.append(np.min(np.maximum(first, partner)))
        films.append(min(inner_film, outer_film))
    assert len(totals) == 8
    assert found["capacitance"] == pytest.approx(np.mean(totals), rel=5e-3)
    assert found["first_break"] == pytest.approx(min(firsts), rel=5e-3)
    assert found["first_break_mean"] == pytest.approx(np.mean(firsts), rel=5e-3)
    assert found["ring_to_ring_breakdown"] == pytest.approx(min(throughs), rel=5e-3)
    assert found["ring_to_ring_breakdown_mean"] == pytest.approx(np.mean(throughs), rel=5e-3)
    # At the first break the largest field of all is the strength of the oil, 15 V/um.
    at_break = found["first_break"] * found["strength_per_volt"]
    assert at_break == pytest.approx(15e6, rel=1e-3, abs=0.0)
    on_shaft = found["shaft_voltage"] * found["strength_per_volt"]
    assert found["max_strength"] == pytest.approx(on_shaft, rel=1e-12, abs=0.0)
    assert found["lambda_ratio"] == pytest.approx(min(films) / 0.03e-6, rel=5e-3)
    ratio = 20e-12 / (20e-12 + 1e-9 + 2.0 * np.mean(totals))
    assert found["bearing_voltage_ratio"] == pytest.approx(ratio, rel=1e-3)
    assert found["shaft_voltage"] == pytest.approx(300.0 * ratio, rel=1e-3)
    assert found["margin"] == pytest.approx(min(firsts) / (300.0 * ratio), rel=5e-3)
    assert found["ring_to_ring_margin"] == pytest.approx(min(throughs) / (300.0 * ratio), rel=5e-3)


def test_breaks_of_strengths_that_are_anything(result):
    """Strengths made up, so that what breaks first and what is through are not one, nor are its positions.

    By hand: V_i (C_i + C_o)/C_o and V_o (C_i + C_o)/C_i, the lesser first; through, the partner holds it all.
    """
    solution, fill = result.solution, result.solution.case.bearing.fill
    rng = np.random.default_rng(8)
    positions, firsts, throughs, names = [], [], [], []
    for position in solution.positions:
        inner, outer = (rng.uniform(1.0, 50.0, size) for size in (9, 9))
        positions.append(
            dataclasses.replace(
                position,
                inner=with_values(position.inner, breakdown_voltage=inner),
                outer=with_values(position.outer, breakdown_voltage=outer),
            )
        )
        one, other = position.inner.capacitance(fill), position.outer.capacitance(fill)
        breaks = np.array([inner * (one + other) / other, outer * (one + other) / one])
        first = breaks.min(axis=0)
        throughs.append(np.min(np.maximum(first, np.where(breaks[0] <= breaks[1], outer, inner))))
        firsts.append(np.min(first))
        k = int(np.argmin(first))
        names.append(f"{'inner' if breaks[0][k] <= breaks[1][k] else 'outer'} contact of element {k}")
    # Neither of the two is the other, and no mean is the least.
    assert min(throughs) > 1.1 * min(firsts)
    assert np.ptp(firsts) > 0.1
    found = BearingResult(dataclasses.replace(solution, positions=tuple(positions))).breaks()
    shaft = result.shaft_voltage
    expected = {
        "first_break": min(firsts),
        "first_break_mean": np.mean(firsts),
        "ring_to_ring_breakdown": min(throughs),
        "ring_to_ring_breakdown_mean": np.mean(throughs),
        "shaft_first_break": min(firsts),
        "shaft_ring_to_ring_breakdown": min(throughs),
        "margin": min(firsts) / shaft,
        "ring_to_ring_margin": min(throughs) / shaft,
    }
    assert found.pop("first_break_at") == names[int(np.argmin(firsts))]
    assert found == pytest.approx(expected, rel=1e-9, abs=0.0)


@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_lambda_is_that_of_the_thinnest_loaded_film(result, ring):
    """A film of 2 nm on one ring, at the last position, is the least; gaps without load are none."""
    solution = result.solution
    *others, last = solution.positions
    race = getattr(last, ring)
    loaded = np.flatnonzero(race.load > 0.0)
    films = race.values.minimum_thickness.copy()
    films[loaded[-1]] = 2e-9
    films[race.load == 0.0] = 1e-9
    thin = dataclasses.replace(last, **{ring: with_values(race, minimum_thickness=films)})
    found = dataclasses.replace(solution, positions=(*others, thin))
    assert lambda_ratio(found) == pytest.approx(2e-9 / 0.03e-6, rel=1e-12, abs=0.0)
    assert conducts(found)


def test_errors_are_the_larger_of_both_rings(result):
    """Of one ring interpolated exactly and of one whose contact in the middle is 10 % off its neighbours'."""
    solution = result.solution
    one = solution.outer_curve.solutions[-1]
    rows = [
        dataclasses.replace(with_values(one, inside=1e-11 * q**0.5), load=q, error=0.02)
        for q in (1.0, 10.0, 100.0)
    ]
    exact = ContactCurve.of(tuple(rows))
    off = dataclasses.replace(with_values(rows[1], inside=1.1 * rows[1].values.inside), error=0.01)
    bent = ContactCurve.of((rows[0], off, rows[2]))
    for inner, outer in ((exact, bent), (bent, exact)):
        curves = dataclasses.replace(solution, inner_curve=inner, outer_curve=outer)
        found = numbers_of(BearingResult(curves))["bearing"]
        assert found["interpolation_error"] == pytest.approx(1.0 - 1.0 / 1.1, rel=1e-9, abs=0.0)
        assert found["discretisation_error"] == 0.02
    # By formula there is no estimate of a film's error.
    assert numbers_of(result)["bearing"]["discretisation_error"] is None


def test_rings_have_the_angle_and_speed_of_the_most_loaded_balls(result):
    """At 9000 rpm the angles of both contacts differ, and the speed is w d_m (1 - g^2)/4 at both.

    The means, weighted with the 16th power of the load, are the values of the most loaded ball to 1e-5.
    """
    solution = result.solution
    at = solution.positions[0].equilibrium
    inner, outer = float(at.inner_angle[0]), float(at.outer_angle[0])
    assert np.argmax(at.inner_load) == 0
    assert inner > 1.02 * outer > 0.0
    assert solution.inner.inner
    assert not solution.outer.inner
    weights = at.inner_load**16 / np.sum(at.inner_load**16)
    inners, outers = (solution.inner, at.inner_angle, inner), (solution.outer, at.outer_angle, outer)
    for ring, angles, own in (inners, outers):
        assert ring.angle == pytest.approx(float(weights @ angles), rel=1e-12, abs=0.0)
        assert ring.angle == pytest.approx(own, rel=1e-5, abs=0.0)
    gamma = 11.906 / 60.0 * math.cos(0.5 * (inner + outer))
    speed = 9000.0 * 2.0 * math.pi / 60.0 * 60e-3 / 4.0 * (1.0 - gamma**2)
    assert [solution.inner.speed, solution.outer.speed] == pytest.approx([speed] * 2, rel=1e-5, abs=0.0)


def test_rows_are_those_of_the_elements(result):
    """Loads, angles, films and shares of the first position, the outer ring with its centrifugal force."""
    solution = result.solution
    at, fill = solution.positions[0].equilibrium, solution.case.bearing.fill
    parts = by_elements(result, at, fill)
    (inner, *_), (outer, *_) = parts["inner"], parts["outer"]
    for row in result.contacts():
        k, own, other = row["element"], *((inner, outer) if row["ring"] == "inner" else (outer, inner))
        assert row["position"] == pytest.approx(2.0 * math.pi * k / 9.0, rel=1e-12, abs=1e-15)
        assert row["load"] == pytest.approx(getattr(at, f"{row['ring']}_load")[k], rel=1e-12, abs=0.0)
        angle = getattr(at, f"{row['ring']}_angle")[k]
        assert row["contact_angle"] == pytest.approx(angle, rel=1e-12, abs=1e-15)
        assert row["capacitance"] == pytest.approx(own[k], rel=0.02)
        assert row["voltage_share"] == pytest.approx(other[k] / (own[k] + other[k]), abs=0.01)
        # Both by the least film: the field at 1 V on the bearing, and the voltage that makes it the strength.
        strength = 15e6 * row["voltage_share"] / row["breakdown_voltage"]
        assert row["strength_per_volt"] == pytest.approx(strength, rel=1e-3, abs=0.0)
        on_shaft = row["strength_per_volt"] * result.shaft_voltage
        assert row["max_strength"] == pytest.approx(on_shaft, rel=1e-9, abs=0.0)
        assert row["lambda_ratio"] == pytest.approx(row["minimum_thickness"] / 0.03e-6, rel=1e-12, abs=0.0)


@pytest.mark.slow
def test_mechanics_of_the_summary(result):
    """The largest load is an outer one; F_c, cage and entrainment by the closed formulas of pure rolling."""
    solution = result.solution
    summary, at = result.summary(), solution.positions[0].equilibrium
    found = summary["mechanics"]
    omega = 9000.0 * 2.0 * math.pi / 60.0
    gamma = 11.906 / 60.0 * np.cos(0.5 * (at.inner_angle + at.outer_angle))
    cage = np.average(0.5 * omega * (1.0 - gamma), weights=at.inner_load)
    assert found["cage_speed"] == pytest.approx(cage, rel=1e-9, abs=0.0)
    mass = 7830.0 * math.pi / 6.0 * 11.906e-3**3
    assert found["centrifugal_force"] == pytest.approx(mass * 30e-3 * cage**2, rel=1e-9, abs=0.0)
    entrainment = np.max(omega * 60e-3 / 4.0 * (1.0 - gamma**2))
    assert found["entrainment_speed"] == pytest.approx(entrainment, rel=1e-9, abs=0.0)
    # On the load line the outer contact carries the inner one's load and F_c, nearly along each other.
    assert found["max_load"] > np.max(at.inner_load) + 0.9 * found["centrifugal_force"]
    spin = omega * (1.0 - gamma**2) * 60.0 / (2.0 * 11.906)
    sine = np.sin(0.5 * (at.inner_angle + at.outer_angle))
    moments = mass * 11.906e-3**2 / 10.0 * spin * 0.5 * omega * (1.0 - gamma) * sine
    assert found["gyroscopic_moment"] == pytest.approx(np.max(moments), rel=1e-9, abs=0.0)
    axial = at.inner_load * np.sin(at.inner_angle)
    # About the centre of the inner groove centres' circle, d_m/2 + (f_i - 1/2) D cos a_0.
    distance = (0.52 + 0.53 - 1.0) * 11.906e-3
    lever = 30e-3 + 0.02 * 11.906e-3 * (1.0 - 15e-6 / distance)
    assert found["moment"] == pytest.approx(lever * axial @ np.cos(at.position), rel=1e-9, abs=0.0)
    # The ball on the load line sees the ring's displacement, less the clearance, in both its contacts.
    inner, outer = 0.02 * 11.906e-3 + at.inner_approach[0], 0.03 * 11.906e-3 + at.outer_approach[0]
    radial = inner * np.cos(at.inner_angle[0]) + outer * np.cos(at.outer_angle[0])
    along = inner * np.sin(at.inner_angle[0]) + outer * np.sin(at.outer_angle[0])
    assert found["radial_displacement"] == pytest.approx(radial - (distance - 15e-6), rel=1e-6, abs=0.0)
    assert found["axial_displacement"] == pytest.approx(along, rel=1e-9, abs=0.0)
    eta = 14.847e-6 * 838.90
    assert summary["lubricant"]["viscosity"] == pytest.approx(eta, rel=1e-4, abs=0.0)
    alpha = 0.67 * (math.log(eta) + 9.67) / 0.198e9
    assert summary["lubricant"]["pressure_viscosity_coefficient"] == pytest.approx(alpha, rel=1e-4, abs=0.0)
