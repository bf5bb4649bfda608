"""Solved bearings: totals from their contacts by hand, and what is said where nothing breaks down."""

import dataclasses
import json

import numpy as np
import pytest

from ehlectric.bearing.bearing_discharges import _first_of_least, bearing_voltage_ratio
from ehlectric.bearing.conditions import Solid
from ehlectric.bearing.impedance import oil_relaxation_time
from ehlectric.bearing.result import BearingResult, solve_bearing
from ehlectric.bearing.ring_contacts import ContactCurve
from ehlectric.bearing.solution import lambda_ratio, plate_capacitance
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, numbers_of, with_values


@pytest.fixture(scope="module")
def rollers():
    return solve_bearing(bearing_case(ROLLERS), workers=1)


@pytest.fixture(scope="module")
def axial():
    """Balls that a pure axial load presses all alike: one contact with either ring."""
    changes = {"bearing__radial_load": None, "bearing__axial_load": "60 N"}
    return solve_bearing(bearing_case(BALLS, **changes), workers=1)


def with_bearing(result, **values):
    """The result of a bearing whose file says something else that its contacts do not depend on."""
    solution = result.solution
    bearing = solution.case.bearing.model_copy(update=values)
    case = solution.case.model_copy(update={"bearing": bearing})
    return BearingResult(dataclasses.replace(solution, case=case))


def with_motor(result, motor):
    """The result of a bearing in another machine."""
    solution = result.solution
    case = solution.case.model_copy(update={"motor": motor})
    return BearingResult(dataclasses.replace(solution, case=case))


def strict(summary):
    """As summary.json has it: no NaN, no infinity."""
    return json.loads(json.dumps(summary, allow_nan=False))


@pytest.mark.slow
def test_rollers_are_solved(rollers):
    """A light load's film needs a long inlet, whose lack is warned of."""
    assert rollers.converged
    assert not [
        text for text in map(str, rollers.warnings) if "inlet is too short" in text or "do not use" in text
    ]
    found = strict(rollers.summary())
    told = rollers.warnings
    assert found["warnings"] == [warning.text for warning in told]
    assert found["warning_codes"] == [warning.code for warning in told]
    assert found["schema"] == "ehlectric.bearing/1"
    assert found["converged"]
    assert found["bearing"]["discretisation_error"] < 0.03
    assert found["bearing"]["interpolation_error"] < 0.1
    assert found["mechanics"]["residual"] < 1e-9


@pytest.mark.slow
def test_rows_make_the_total(rollers):
    """Series of inner and outer of every roller, added, is the capacitance at the first position."""
    rows = rollers.contacts()
    assert [(row["element"], row["ring"]) for row in rows] == [
        (k, r) for k in range(14) for r in ("inner", "outer")
    ]
    inner, outer = rows[::2], rows[1::2]
    together = [
        1.0 / (1.0 / a["capacitance"] + 1.0 / b["capacitance"]) for a, b in zip(inner, outer, strict=True)
    ]
    first = rollers.solution.circuits("oil")[0]
    assert first.capacitance == pytest.approx(sum(together), rel=1e-12, abs=0.0)
    for a, b in zip(inner, outer, strict=True):
        assert a["voltage_share"] + b["voltage_share"] == pytest.approx(1.0, rel=1e-12, abs=0.0)
        charge = a["voltage_share"] * a["capacitance"]
        assert b["voltage_share"] * b["capacitance"] == pytest.approx(charge, rel=1e-9, abs=0.0)
    firsts = [
        min(a["breakdown_voltage"] / a["voltage_share"], b["breakdown_voltage"] / b["voltage_share"])
        for a, b in zip(inner, outer, strict=True)
    ]
    assert first.first_break == pytest.approx(min(firsts), rel=1e-12, abs=0.0)
    # The ring's balance again, from the table.
    lifted = sum(row["load"] * np.cos(row["position"]) for row in inner)
    assert lifted == pytest.approx(3000.0, rel=1e-6, abs=0.0)


@pytest.mark.slow
def test_rows_without_load_have_no_hertz_contact(rollers):
    for row in rollers.contacts():
        loaded = row["load"] > 0.0
        assert row["solved"] == loaded
        assert (row["max_pressure"] is None) == (row["semi_axis_x"] is None) == (not loaded)
        assert row["lambda_ratio"] == pytest.approx(row["minimum_thickness"] / 0.03e-6, rel=1e-12, abs=0.0)
        # At speed no roller floats: the outer ring carries its centrifugal force.
        assert loaded or row["ring"] == "inner"


@pytest.mark.slow
def test_totals_are_means_and_least_over_a_pitch(rollers):
    circuits = rollers.solution.circuits("oil")
    found = numbers_of(rollers)["bearing"]
    assert len(circuits) > 1
    assert found["capacitance"] == pytest.approx(
        np.mean([c.capacitance for c in circuits]), rel=1e-12, abs=0.0
    )
    firsts = [c.first_break for c in circuits]
    assert found["first_break"] == pytest.approx(min(firsts), rel=1e-12, abs=0.0)
    assert found["first_break_mean"] == pytest.approx(np.mean(firsts), rel=1e-12, abs=0.0)
    assert found["ring_to_ring_breakdown"] >= found["first_break"]
    # The heaviest contact with the smaller radius, on the load line.
    assert found["first_break_at"] == "inner contact of element 0"


@pytest.mark.slow
def test_the_pitch_is_symmetric_about_its_middle(rollers):
    """A cage as far before the load line as behind it: the same totals."""
    totals = [c.capacitance for c in rollers.solution.circuits("oil")]
    assert totals[1:] == pytest.approx(totals[:0:-1], rel=1e-6, abs=0.0)


@pytest.mark.slow
def test_air_around_the_films(rollers):
    """Less than with oil, more than the films alone, and the fill of the file is the one that counts."""
    films = [
        np.sum(1.0 / (1.0 / p.inner.values.inside[s] + 1.0 / p.outer.values.inside[s]))
        for p in rollers.solution.positions
        for s in [p.inner.solved & p.outer.solved]
    ]
    oil, air = (rollers.capacitance(fill) for fill in ("oil", "air"))
    assert np.mean(films) < air < oil
    found = numbers_of(with_bearing(rollers, fill="air"))["bearing"]
    assert found["capacitance"] == found["capacitance_air"] == pytest.approx(air, rel=1e-12, abs=0.0)
    assert found["capacitance_oil"] == pytest.approx(oil, rel=1e-12, abs=0.0)


@pytest.mark.slow
def test_plates(rollers):
    """eps0 eps_r A/h(0) of the Hertz areas in series, from the rows of the first position."""
    rows = rollers.contacts()
    expected = 0.0
    for a, b in zip(rows[::2], rows[1::2], strict=True):
        if a["semi_axis_x"] and b["semi_axis_x"]:
            # Hertz area of a line: 2 b by its length; of the curve only its quantities are interpolated.
            c = [
                2.4 * 8.8541878128e-12 * 2.0 * row["semi_axis_x"] * 10e-3 / row["central_thickness"]
                for row in (a, b)
            ]
            expected += 1.0 / (1.0 / c[0] + 1.0 / c[1])
    first = BearingResult(dataclasses.replace(rollers.solution, positions=rollers.solution.positions[:1]))
    assert plate_capacitance(first.solution) == pytest.approx(expected, rel=2e-3, abs=0.0)
    found = numbers_of(rollers)["bearing"]
    assert found["capacitance_ratio"] == pytest.approx(found["capacitance"] / found["capacitance_plate"])


@pytest.mark.slow
def test_motor_by_hand(rollers):
    """300 V C_wr/(C_wr + C_rf + 2 C), and with a second bearing of 0.5 nF."""
    found = numbers_of(rollers)["bearing"]
    ratio = 20e-12 / (20e-12 + 1e-9 + 2.0 * found["capacitance"])
    assert found["bearing_voltage_ratio"] == pytest.approx(ratio, rel=1e-12, abs=0.0)
    assert found["shaft_voltage"] == pytest.approx(300.0 * ratio, rel=1e-12, abs=0.0)
    assert found["margin"] == pytest.approx(found["first_break"] / (300.0 * ratio), rel=1e-12, abs=0.0)
    through = found["ring_to_ring_breakdown"] / (300.0 * ratio)
    assert found["ring_to_ring_margin"] == pytest.approx(through, rel=1e-12, abs=0.0)
    solution = rollers.solution
    other = solution.case.motor.model_copy(update={"second_bearing_capacitance": 0.5e-9})
    unlike = numbers_of(with_motor(rollers, other))["bearing"]
    ratio = 20e-12 / (20e-12 + 1e-9 + 0.5e-9 + found["capacitance"])
    assert unlike["bearing_voltage_ratio"] == pytest.approx(ratio, rel=1e-12, abs=0.0)
    alone = numbers_of(with_motor(rollers, None))["bearing"]
    keys = ("bearing_voltage_ratio", "shaft_voltage", "margin", "ring_to_ring_margin")
    assert {alone[key] for key in keys} == {None}
    assert alone["first_break"] == found["first_break"]


@pytest.mark.slow
def test_relaxation_time_is_permittivity_over_conductivity(rollers):
    """2.4 * 8.854e-12 F/m over 1 pS/m: 21.25 s."""
    assert oil_relaxation_time(rollers.solution) == pytest.approx(
        2.4 * 8.8541878e-12 / 1e-12, rel=1e-6, abs=0.0
    )


BREAKS = (
    "first_break", "first_break_mean", "first_break_at", "ring_to_ring_breakdown",
    "ring_to_ring_breakdown_mean", "margin", "ring_to_ring_margin",
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "lubrication", "code"),
    [
        (0.5, "boundary lubrication", "touching"),
        (0.99, "boundary lubrication", "touching"),
        (1.01, "mixed lubrication", "partial-film"),
        (2.99, "mixed lubrication", "partial-film"),
        (3.01, "full film", None),
    ],
)
def test_lambda(rollers, ratio, lubrication, code):
    """Roughness so that the least film of all loaded contacts is that many times of it."""
    least = min(row["minimum_thickness"] for row in rollers.contacts() if row["solved"])
    least = min(least, lambda_ratio(rollers.solution) * 0.03e-6)
    rough = with_bearing(rollers, composite_rq=least / ratio)
    found = strict(rough.summary())
    assert found["bearing"]["lambda_ratio"] == pytest.approx(ratio, rel=1e-9, abs=0.0)
    assert found["bearing"]["lubrication_state"] == lubrication
    shorted = ratio < 1.0
    assert (found["bearing"]["lubrication"] == "conducting") == shorted
    said = [one for one in found["warning_codes"] if one in ("touching", "partial-film")]
    assert said == ([] if code is None else [code])
    for key in (*BREAKS, "bearing_voltage_ratio", "shaft_voltage"):
        assert (found["bearing"][key] is None) == shorted
    for key in ("voltage_share", "strength_per_volt", "max_strength", "breakdown_voltage"):
        assert {row[key] is None for row in found["contacts"]} == {shorted}
    assert found["bearing"]["capacitance"] > 0.0


@pytest.mark.slow
def test_without_a_strength_there_are_no_voltages(rollers):
    endless = [
        dataclasses.replace(
            position,
            **{
                name: with_values(race, breakdown_voltage=np.full_like(race.load, np.inf))
                for name, race in (("inner", position.inner), ("outer", position.outer))
            },
        )
        for position in rollers.solution.positions
    ]
    result = BearingResult(dataclasses.replace(rollers.solution, positions=tuple(endless)))
    found = strict(result.summary())
    assert {found["bearing"][key] for key in BREAKS} == {None}
    assert {row["breakdown_voltage"] for row in found["contacts"]} == {None}
    assert found["bearing"]["shaft_voltage"] > 0.0


@pytest.mark.slow
def test_ceramic_elements(rollers):
    """No equipotential: an upper bound or the given capacitance of each, and nothing that breaks down.

    From a bound follows no voltage of the divider, from 14 times 3 pF that of 20 pF/(20 pF + 1 nF + 84 pF).
    """
    solution = rollers.solution
    conditions = dataclasses.replace(solution.conditions, element=Solid.of("silicon-nitride"))
    ceramic = with_bearing(
        BearingResult(dataclasses.replace(solution, conditions=conditions)),
        element_material="silicon-nitride",
    )
    found = strict(ceramic.summary())
    assert {found["bearing"][key] for key in BREAKS} == {None}
    assert found["warning_codes"].count("capacitance-bound") == 1
    assert found["bearing"]["bearing_voltage_ratio"] is None
    assert found["bearing"]["shaft_voltage"] is None
    given = with_bearing(ceramic, element_capacitance=3e-12)
    assert given.capacitance("oil") == pytest.approx(14 * 3e-12, rel=1e-12, abs=0.0)
    assert "capacitance-bound" not in {one.code for one in given.warnings}
    ratio = 20.0 / (20.0 + 1000.0 + 84.0)
    assert bearing_voltage_ratio(given.solution) == pytest.approx(ratio, rel=1e-12, abs=0.0)
    assert given.shaft_voltage == pytest.approx(300.0 * ratio, rel=1e-12, abs=0.0)
    for result in (ceramic, given):
        found = strict(result.summary())
        keys = ("capacitance_ratio", "capacitance_plate", "strength_per_volt")
        assert {found["bearing"][key] for key in keys} == {None}
        keys = ("capacitance", "voltage_share", "strength_per_volt", "breakdown_voltage")
        assert {row[key] for row in found["contacts"] for key in keys} == {None}


@pytest.mark.slow
def test_ceramic_elements_insulate_where_they_touch(rollers):
    """A lambda of a half: no conductor, and with a given capacitance a shaft voltage as ever."""
    conditions = dataclasses.replace(rollers.solution.conditions, element=Solid.of("silicon-nitride"))
    ceramic = BearingResult(dataclasses.replace(rollers.solution, conditions=conditions))
    rough = {"composite_rq": 2.0 * lambda_ratio(ceramic.solution) * 0.03e-6, "element_capacitance": 3e-12}
    touching = with_bearing(ceramic, **rough)
    found = strict(touching.summary())
    assert found["bearing"]["lubrication_state"] == "boundary lubrication"
    assert found["bearing"]["shaft_voltage"] > 0.0


@pytest.mark.slow
def test_a_weibull_strength_is_that_of_all_contacts(rollers):
    """From the rows of the first position: sum of (share V/V_k)^m is 1 at the first break."""
    position = rollers.solution.positions[0]
    one = dataclasses.replace(position, shape=8.0)
    weibull = BearingResult(dataclasses.replace(rollers.solution, positions=(one,)))
    first = weibull.breaks()["first_break"]
    used = [first * row["voltage_share"] / row["breakdown_voltage"] for row in weibull.contacts()]
    assert sum(part**8.0 for part in used) == pytest.approx(1.0, rel=1e-9, abs=0.0)
    assert weibull.breaks()["first_break_at"] == "inner contact of element 0"
    assert np.argmax(used) == 0
    certain = BearingResult(dataclasses.replace(rollers.solution, positions=(position,))).breaks()
    assert first < certain["first_break"]
    assert weibull.breaks()["ring_to_ring_breakdown"] == certain["ring_to_ring_breakdown"]


@pytest.mark.slow
def test_probability_of_breakdown_at_the_shaft_voltage(rollers):
    """From the rows of the only position: no contact breaks down with the product of exp(-(V_k/V_k1)^m)."""
    position = rollers.solution.positions[0]
    one = dataclasses.replace(position, shape=8.0)
    weibull = BearingResult(dataclasses.replace(rollers.solution, positions=(one,)))
    summary = weibull.summary()
    found, shaft = summary["bearing"]["breakdown_probability"], summary["bearing"]["shaft_voltage"]
    used = [shaft * row["voltage_share"] / row["breakdown_voltage"] for row in weibull.contacts()]
    intact = np.prod([np.exp(-(part**8.0)) for part in used])
    assert 0.0 < found < 1.0
    assert found == pytest.approx(1.0 - intact, rel=1e-9, abs=0.0)
    (row,) = (row for row in total_rows(summary) if row.key == "bearing.breakdown_probability")
    assert float(row.shown) == pytest.approx(100.0 * found, rel=0.05)
    # Without scatter, and without a voltage, there is no probability.
    assert numbers_of(rollers)["bearing"]["breakdown_probability"] is None
    assert numbers_of(with_motor(weibull, None))["bearing"]["breakdown_probability"] is None


@pytest.mark.slow
def test_a_contact_that_is_not_converged(rollers):
    solution = rollers.solution
    first, *others = solution.outer_curve.solutions
    curve = ContactCurve.of((dataclasses.replace(first, converged=False), *others))
    failed = BearingResult(dataclasses.replace(solution, outer_curve=curve))
    assert not failed.converged
    assert not strict(failed.summary())["converged"]


# Of warnings that contacts are given here.
CODE = "outlet-too-short"


def warned(result, name, texts):
    """The result with warnings of the contacts with one ring, a list for each."""
    curve = getattr(result.solution, f"{name}_curve")
    contacts = zip(curve.solutions, texts, strict=True)
    changed = tuple(
        dataclasses.replace(contact, warnings=tuple(ResultWarning(CODE, text) for text in found))
        for contact, found in contacts
    )
    curve = ContactCurve.of(changed)
    return BearingResult(dataclasses.replace(result.solution, **{f"{name}_curve": curve}))


@pytest.mark.slow
def test_what_contacts_share_is_said_once(axial):
    """One contact with either ring here: both, or one."""
    loads = [c.solutions[0].load for c in (axial.solution.inner_curve, axial.solution.outer_curve)]
    both = warned(warned(axial, "inner", [["thin oil", "a"]]), "outer", [["thin oil", "b"]])
    told = [text for text in map(str, both.warnings) if text.endswith(("thin oil", ": a", ": b"))]
    assert [warning.code for warning in both.warnings].count(CODE) == 3
    assert told == [
        "thin oil",
        f"inner contact at {loads[0]:.4g} N: a",
        f"outer contact at {loads[1]:.4g} N: b",
    ]


@pytest.mark.slow
def test_what_some_contacts_share_names_their_loads(rollers):
    curve = rollers.solution.inner_curve
    loads = [contact.load for contact in curve.solutions]
    assert len(loads) > 3
    heavy = [["Barus"] if load >= loads[2] else [] for load in loads]
    told = [text for text in map(str, warned(rollers, "inner", heavy).warnings) if "Barus" in text]
    assert told == [f"{len(loads) - 2} inner contacts at {loads[2]:.4g} to {loads[-1]:.4g} N: Barus"]


@pytest.mark.slow
def test_film_factor_is_told(rollers):
    assert any(text.startswith("bearing.film_factor is none:") for text in map(str, rollers.warnings))
    assert numbers_of(rollers)["bearing"]["film_factor"] == 1.0
    conditions = rollers.solution.conditions
    outer = dataclasses.replace(conditions.outer, film_factor=0.7)
    conditions = dataclasses.replace(conditions, outer=outer)
    lean = BearingResult(dataclasses.replace(rollers.solution, conditions=conditions))
    assert not any(text.startswith("bearing.film_factor is none:") for text in map(str, lean.warnings))
    (smooth,) = (one.text for one in lean.warnings if one.code == "smooth-film")
    assert "0.7" in smooth
    assert numbers_of(lean)["bearing"]["film_factor"] == 0.7
    # A one that is given is told as what it is.
    one = with_bearing(rollers, film_factor=1.0)
    assert any(text.startswith("bearing.film_factor is 1:") for text in map(str, one.warnings))


@pytest.mark.slow
def test_pure_axial_load_is_shared_equally(axial):
    """All elements alike, so the bearing is nine of one, and each breaks at the same voltage."""
    for position in axial.solution.positions:
        for race in (position.inner, position.outer):
            for name in ("load", "inside", "outside_oil", "breakdown_voltage", "minimum_thickness"):
                values = race.load if name == "load" else getattr(race.values, name)
                np.testing.assert_allclose(values, values[0], rtol=1e-7)
        circuit = position.circuit("oil")
        assert circuit.capacitance == pytest.approx(9.0 * circuit.elements[0], rel=1e-6, abs=0.0)
    totals = [c.capacitance for c in axial.solution.circuits("oil")]
    assert totals == pytest.approx([totals[0]] * len(totals), rel=1e-6, abs=0.0)
    found = strict(axial.summary())["bearing"]
    assert found["first_break_mean"] == pytest.approx(found["first_break"], rel=1e-6, abs=0.0)
    assert found["interpolation_error"] == 0.0
    rows = axial.contacts()
    sines = [row["load"] * np.sin(row["contact_angle"]) for row in rows[::2]]
    assert sum(sines) == pytest.approx(60.0, rel=1e-6, abs=0.0)


@pytest.mark.slow
def test_plates_hold_less_than_the_bearing(axial, rollers):
    """h(0) is about the thickest of the Hertz zone, and there is oil and gap around it."""
    for result in (axial, rollers):
        assert numbers_of(result)["bearing"]["capacitance_ratio"] > 1.0


def test_a_doubt_about_the_oil_is_said_once():
    """A given alpha that Roelands' z is not for, of all contacts; Barus' law, of those above 0.5 GPa."""
    given = bearing_case(BALLS, contacts="formula", lubricant__pressure_viscosity_coefficient="10 1/GPa")
    told = [text for text in map(str, solve_bearing(given).warnings) if "roelands_z" in text]
    assert len(told) == 1
    assert told[0].startswith("lubricant.roelands_z")
    assert "0.67" in told[0]
    barus = {"lubricant__viscosity_law": "barus", "lubricant__pressure_viscosity_coefficient": "18 1/GPa"}
    found = solve_bearing(bearing_case(BALLS, contacts="formula", **barus))
    told = [text for text in map(str, found.warnings) if "Barus" in text]
    assert len(told) == 1
    curves = found.solution.inner_curve, found.solution.outer_curve
    heavy = [[c.load for c in curve.solutions if c.values.max_pressure > 0.5e9] for curve in curves]
    names = [
        f"{len(those)} {ring} contacts at {those[0]:.4g} to {those[-1]:.4g} N"
        for ring, those in zip(("inner", "outer"), heavy, strict=True)
    ]
    assert told[0].startswith(", ".join(names) + ": ")
    assert "0.5 GPa" in told[0]


@pytest.mark.slow
def test_a_weibull_strength_from_the_file():
    """Solved rollers: the shape of the file is that of the circuit, and the warning tells the probability."""
    law = {"scale": "15 V/um", "shape": 10.0, "reference_area": "1 mm^2"}
    changes = {"discharge__dielectric_strength": None, "discharge__weibull": law}
    result = solve_bearing(bearing_case(ROLLERS, **changes))
    assert {position.shape for position in result.solution.positions} == {10.0}
    assert any("63.2 %" in text for text in map(str, result.warnings))
    found = result.breaks()
    least = min(float(np.min(circuit.first_breaks)) for circuit in result.solution.circuits("oil"))
    assert 28.0 ** (-1.0 / 10.0) * least < found["first_break"] < least
    assert found["ring_to_ring_breakdown"] > found["first_break"]


def test_a_contact_breaks_down_at_its_voltage_over_its_share():
    """Two contacts in series share the voltage: the bearing carries more than either."""
    result = solve_bearing(bearing_case(BALLS, contacts="formula"), workers=1)
    rows = result.contacts()
    for row in rows:
        assert row["bearing_breakdown_voltage"] * row["voltage_share"] == pytest.approx(
            row["breakdown_voltage"]
        )
        assert row["bearing_breakdown_voltage"] > 1.2 * row["breakdown_voltage"]
    at_first_position = min(row["bearing_breakdown_voltage"] for row in rows)
    assert result.breaks()["first_break"] == pytest.approx(at_first_position, rel=0.02)
    frame = result.to_dataframe()
    assert frame.attrs["units"]["bearing_breakdown_voltage"] == "V"
    assert set(frame.attrs["descriptions"]) == set(frame.columns)


def test_the_fill_of_a_capacitance_is_oil_or_air():
    result = solve_bearing(bearing_case(BALLS, contacts="formula", bearing__fill="air"), workers=1)
    assert result.capacitance() == result.capacitance("air") < result.capacitance("oil")
    with pytest.raises(InputError, match=r"^fill: .*'water'.*'oil', 'air'.* 0 to 1"):
        result.capacitance("water")


def test_margin_is_first_breakdown_over_shaft_voltage():
    motor = {"common_mode_voltage": "300 V", "winding_rotor_capacitance": "20 pF"}
    motor |= {"rotor_frame_capacitance": "1 nF"}
    case = bearing_case(BALLS).replace({"contacts": "formula", "discharge.dielectric_strength": "15 V/um"})
    with_one = solve_bearing(case.replace(motor=motor), workers=1)
    first = with_one.breaks()["first_break"]
    without = {key: table for key, table in case.to_dict().items() if key != "motor"}
    assert with_one.margin == pytest.approx(first / with_one.shaft_voltage, rel=1e-12)
    assert solve_bearing(BearingCase.from_dict(without), workers=1).margin is None


def test_rounding_does_not_choose_the_element_that_breaks_down_first():
    """Voltages that differ by rounding are equal: the first one counts, and a lower one counts always."""
    equal = np.array([[2.0 + 4e-16, 2.0, 3.0], [2.0, 2.0 - 1e-3, 1.5]])
    assert _first_of_least(equal, axis=-1).tolist() == [0, 2]
    assert _first_of_least(equal.T, axis=0).tolist() == [0, 2]
