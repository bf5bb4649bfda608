"""A coated, rough bearing with a cage: a meter reading, the share of the films, and energy of a discharge."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import epsilon_0

from ehlectric.bearing.bearing_discharges import Decay
from ehlectric.bearing.circuit import series
from ehlectric.bearing.impedance import impedance_of, oil_relaxation_time
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.summary import summary_of
from ehlectric.discharge.film_capacitance import roughness_factor
from ehlectric.sweep.sweep_inputs import breakdown_of
from tests.figures.bearing.test_save import by_hand
from tests.helpers.bearings import BALLS, bearing_case

COATING = {"ring": "outer", "thickness": "200 um", "relative_permittivity": 9.0, "area": "45 cm^2"}
# eps0 9 x 45 cm^2/200 um.
OF_COATING = epsilon_0 * 9.0 * 45e-4 / 200e-6


def solved(**changes):
    return solve_bearing(bearing_case(BALLS, contacts="formula", **changes), workers=1)


def totals(result):
    return summary_of(result.solution)["bearing"]


@pytest.fixture(scope="module")
def bare():
    return solved()


@pytest.fixture(scope="module")
def coated():
    coating = COATING | {"breakdown_voltage": "3 kV"}
    return solved(bearing__coating=coating, bearing__parallel_capacitance="30 pF")


def test_divider_of_films_coating_and_motor(bare, coated):
    plain, found = totals(bare), totals(coated)
    films = plain["capacitance"]
    assert found["capacitance"] == films
    assert found["coating_capacitance"] == pytest.approx(OF_COATING, rel=1e-12)
    share = OF_COATING / (OF_COATING + films)
    assert found["film_share"] == pytest.approx(share, rel=1e-12)
    assert found["coating_share"] == pytest.approx(1.0 - share, rel=1e-9)
    end = 30e-12 + films * OF_COATING / (films + OF_COATING)
    assert found["shaft_capacitance"] == pytest.approx(end, rel=1e-12)
    # 300 V, 20 pF to the winding, 1 nF to the frame, the same bearing at the other end.
    shaft = 300.0 * 20e-12 / (1.02e-9 + 2.0 * end)
    assert found["shaft_voltage"] == pytest.approx(shaft, rel=1e-12)
    assert found["film_voltage"] == pytest.approx(share * shaft, rel=1e-12)
    assert found["max_strength"] == pytest.approx(found["strength_per_volt"] * share * shaft, rel=1e-12)
    assert found["coating_margin"] == pytest.approx(3e3 / shaft, rel=1e-12)


def test_the_margin_is_that_of_the_shaft(bare, coated):
    plain, found = totals(bare), totals(coated)
    assert found["first_break"] == plain["first_break"]
    # Positions of the cage differ by little.
    assert found["shaft_first_break"] == pytest.approx(plain["first_break"] / found["film_share"], rel=2e-3)
    assert found["margin"] == pytest.approx(found["shaft_first_break"] / found["shaft_voltage"], rel=1e-12)
    assert plain["shaft_first_break"] == plain["first_break"]
    assert plain["shaft_ring_to_ring_breakdown"] == plain["ring_to_ring_breakdown"]
    assert (plain["film_share"], plain["coating_share"], plain["parallel_capacitance"]) == (1.0, None, 0.0)
    assert plain["shaft_capacitance"] == plain["capacitance"]


def test_a_discharge_releases_what_the_charges_lose(coated):
    """Energies before and after the films are shorted, with the charge of the shaft conserved."""
    found = totals(coated)
    films, shaft = found["capacitance"], found["shaft_voltage"]
    beside = 1.02e-9 + 30e-12 + found["shaft_capacitance"]
    across = found["film_voltage"]
    coating = shaft - across
    charge = beside * shaft + OF_COATING * coating
    before = 0.5 * (beside * shaft**2 + OF_COATING * coating**2 + films * across**2)
    after = 0.5 * charge**2 / (beside + OF_COATING)
    assert found["discharge_energy"] == pytest.approx(before - after, rel=1e-9)
    assert found["bearing_energy"] == pytest.approx(0.5 * films * across**2, rel=1e-12)


@pytest.mark.parametrize(("thickness", "share"), [("0.1 nm", 1.0), ("1 cm", 0.0)])
def test_ends_of_the_thickness(bare, thickness, share):
    """A coating of no thickness changes nothing; a thick one takes all."""
    found = totals(solved(bearing__coating=COATING | {"thickness": thickness, "area": "0.1 cm^2"}))
    if share:
        plain = totals(bare)
        for key in (
            "shaft_voltage",
            "margin",
            "ring_to_ring_margin",
            "discharge_energy",
            "meter_capacitance",
        ):
            assert found[key] == pytest.approx(plain[key], rel=1e-3)
    assert found["film_share"] == pytest.approx(share, abs=1e-3)


def test_the_roughness_acts_in_the_hertz_areas(bare):
    """Each contact by hand: its Hertz area times the factor at its central film."""
    rq, values = 0.03e-6, []
    for position in bare.solution.positions:
        rings = [
            ring.values.inside
            + ring.values.outside_oil
            + ring.values.hertz * (roughness_factor(ring.values.central_thickness / rq) - 1.0)
            for ring in position.rings
        ]
        values.append(np.sum(series(*rings)))
    found = totals(bare)
    assert found["capacitance_rough"] == pytest.approx(np.mean(values), rel=1e-12)
    assert found["meter_capacitance"] == found["capacitance_rough"]
    assert 1.0 < found["roughness_factor"] < roughness_factor(found["lambda_ratio"])
    smooth = totals(solved(bearing__composite_rq="1 nm"))
    assert smooth["roughness_factor"] == pytest.approx(1.0, abs=1e-4)


def test_the_hertz_area_is_a_part_of_the_film(bare):
    """eps0 eps_r A/h(0) raised by the pressure; less than the whole domain."""
    for position in bare.solution.positions:
        for ring in position.rings:
            hertz, plate = ring.values.hertz[ring.solved], ring.values.plate[ring.solved]
            assert np.all((hertz > plate) & (hertz < 1.5 * plate))
            assert np.all(hertz < ring.values.inside[ring.solved])
            assert not np.any(ring.values.hertz[~ring.solved])


def test_no_meter_where_asperities_touch():
    """A central film below 2 Rq has no factor; the smooth capacitance stays."""
    found = totals(solved(bearing__composite_rq="0.15 um"))
    assert (found["capacitance_rough"], found["roughness_factor"], found["meter_capacitance"]) == (None,) * 3
    assert found["capacitance"] > 0.0


def test_ceramic_elements_behind_a_coating():
    ceramic = {"bearing__element_material": "silicon-nitride", "bearing__coating": COATING}
    assert totals(solved(**ceramic))["meter_capacitance"] is None
    found = totals(solved(**ceramic, bearing__element_capacitance="0.5 pF"))
    assert found["meter_capacitance"] == pytest.approx(1.0 / (1.0 / 4.5e-12 + 1.0 / OF_COATING), rel=1e-12)


@pytest.mark.parametrize("part", [0.0, 0.3, 1.0])
def test_a_gap_filled_to_a_part(bare, part):
    """Between air and oil, each contact in proportion."""
    result = solved(bearing__fill=part)
    for mixed, plain in zip(result.solution.positions, bare.solution.positions, strict=True):
        for ring, other in zip(mixed.rings, plain.rings, strict=True):
            expected = (1.0 - part) * other.capacitance("air") + part * other.capacitance("oil")
            np.testing.assert_allclose(ring.capacitance(part), expected, rtol=1e-12)
    found = totals(result)
    low, high = (found[f"capacitance_{fill}"] * (1.0 + off) for fill, off in (("air", -1e-9), ("oil", 1e-9)))
    assert low <= found["capacitance"] <= high


def test_the_impedance_goes_from_shaft_to_housing():
    """1/(i w C_p + 1/(Z + 1/(i w C_c + 1/R))) of the impedance of the films, at all frequencies."""
    films = impedance_of(by_hand(positions=1).solution)
    tables = {"coating": COATING | {"resistance": "50 Mohm"}, "parallel_capacitance": "30 pF"}
    found = impedance_of(by_hand(positions=1, bearing=tables).solution)
    omega = 2j * math.pi * films.frequency
    coating = 1.0 / (omega * OF_COATING + 1.0 / 50e6)
    expected = 1.0 / (omega * 30e-12 + 1.0 / (films.values + coating))
    np.testing.assert_allclose(found.values, expected, rtol=1e-9)


def test_the_conductivity_of_the_discharge_comes_before_that_of_the_oil():
    """1 pS/m in the file's discharge, 1 nS/m of the oil at its temperature."""
    solution = solved(discharge__conductivity=None).solution
    assert oil_relaxation_time(solution) is None
    conditions = replace(solution.conditions, oil=replace(solution.conditions.oil, conductivity=1e-9))
    known = replace(solution, conditions=conditions)
    assert oil_relaxation_time(known) == pytest.approx(epsilon_0 * 2.4 / 1e-9, rel=1e-9)
    assert summary_of(known)["lubricant"]["conductivity"] == 1e-9
    both = replace(known, case=known.case.replace({"discharge.conductivity": "1 pS/m"}))
    assert oil_relaxation_time(both) == pytest.approx(epsilon_0 * 2.4 / 1e-12, rel=1e-9)


def test_films_behind_a_coating_decay_as_in_small_steps():
    """Both capacitors, the shaft and the second bearing, by two thousand steps of the midpoint rule."""
    films, conductance, coating, beside, leak = 2.4e-10, 1.1e-5, 1.8e-9, 1.3e-9, 0.8e-5
    decay = Decay(films, conductance, 1.0 / coating, beside, leak)
    share = coating / (coating + films)
    voltages, step, time = np.array([share, 1.0 - share]), 5e-8, 1e-4

    def slope(v):
        # Current of V' = (i - G V)/C, V_c' = i/C_c, and (V + V_c)' = -(i + G_s (V + V_c))/C_s.
        i = (conductance * v[0] / films - leak * sum(v) / beside) / (1 / films + 1 / coating + 1 / beside)
        return np.array([(i - conductance * v[0]) / films, i / coating])

    assert decay.film_time_constant == pytest.approx(-voltages[0] / slope(voltages)[0], rel=1e-12)
    assert decay.time_constant == pytest.approx(-1.0 / sum(slope(voltages)), rel=1e-12)
    mean = 0.0
    for _ in range(round(time / step)):
        half = voltages + 0.5 * step * slope(voltages)
        mean += sum(half) * step / time
        voltages = voltages + step * slope(half)
    np.testing.assert_allclose(decay.after(time), voltages, rtol=1e-4)
    # A ramp is the mean of all steps within it.
    assert decay.after_rise(time) == pytest.approx(mean, rel=1e-4)


@pytest.mark.slow
@pytest.mark.gate
def test_a_film_that_discharges_within_a_period_is_told():
    leaky = {"discharge__conductivity": "10 uS/m", "motor__switching_frequency": "10 kHz"}
    result = solved(**leaky, bearing__coating=COATING)
    found = totals(result)
    assert found["switching_period"] == pytest.approx(1e-4)
    assert found["film_time_constant"] < 1e-4
    assert found["film_voltage_after_period"] == pytest.approx(
        found["film_voltage"] * math.exp(-1e-4 / found["film_time_constant"]), rel=1e-6
    )
    # The coating keeps its charge, and the shaft a part of its voltage.
    assert found["shaft_voltage_after_period"] > 2.0 * found["film_voltage_after_period"]
    assert "100 µs" in result.verdict.text


def test_a_coating_below_the_shaft_voltage_is_told():
    result = solved(bearing__coating=COATING | {"strength": "10 kV/m"})
    assert "coating-breakdown" in {one.code for one in result.warnings}


def test_sweeps_of_a_coated_bearing_compare_voltages_of_the_shaft():
    coated = bearing_case(BALLS, bearing__coating=COATING)
    assert breakdown_of(coated).value == "bearing.shaft_first_break"
    assert breakdown_of(coated, "bearing.ring_to_ring_margin").value == "bearing.shaft_ring_to_ring_breakdown"
    assert breakdown_of(bearing_case(BALLS)).value == "bearing.first_break"
