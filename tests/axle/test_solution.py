"""Static answer of an axle: today's divider, voltages by hand, films and ranks."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ehlectric import (
    AxleCase,
    BearingCase,
    InputError,
    evaluate,
    load,
    save,
    solve,
    solve_axle,
    solve_bearing,
)
from ehlectric.axle import solve_axles
from ehlectric.axle.axle_verdict import axle_verdict
from ehlectric.axle.measurable import _Probable as Probable
from ehlectric.axle.result import unused_keys
from ehlectric.axle.solution import AxleSolution, Element, named_warnings, solve_elements, thinnest_first
from ehlectric.axle.summary import axle_summary, ratio_word
from ehlectric.cases.drive_inputs import Breakdown, Circuit
from ehlectric.discharge.breakdown_rule import Chance
from ehlectric.drive.drive_bearings import bearing_element
from ehlectric.drive.network import HOUSING, WINDING, Film, Network
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable
from ehlectric.runs.axle_preview import preview
from ehlectric.tables.axle_tables import remedy_cells
from tests.axle.axles import ALONE, two_stages
from tests.helpers.drives import capacitive_divider

NANO = 1e-9


def by_hand(**changes):
    """Axle with the capacitances of three shafts that are small numbers of nanofarads."""
    case = two_stages(
        **{
            "source.dc_link": "900 V",
            "source.rise_time": "100 ns",
            "circuit.rotor_frame_capacitance": "0.5 nF",
            **changes,
        }
    )
    rows = [
        ("b1", "bearing", "rotor", HOUSING, 1.0, 3.0),
        ("m12", "mesh", "rotor", "intermediate", 1.0, 1.8),
        ("b2", "bearing", "intermediate", HOUSING, 5.0, 2.0),
        ("m23", "mesh", "intermediate", "output", 4.0, 0.74),
        ("b3", "bearing", "output", HOUSING, 11.0, 1.0),
    ]
    elements = tuple(
        Element(name, kind, first, second, NANO * value, limit, 0.0, 3.0)
        for name, kind, first, second, value, limit in rows
    )
    return AxleSolution(case, case.turning(), elements)


def test_voltages_by_hand():
    """By Cramer's rule: the determinant is 333.4 nF^3, and the potentials are 30 (134, 15, 4)/333.4 V."""
    expected = [30.0 * part / 333.4 for part in (134.0, 15.0, 4.0)]
    axle = by_hand()
    assert list(axle.potentials().values()) == pytest.approx(expected, rel=1e-12)
    assert list(axle.potentials("always").values()) == pytest.approx([30.0 / 17.6] * 3, rel=1e-12)
    assert list(axle.potentials(edge=100.0).values()) == pytest.approx([part / 3.0 for part in expected])


def test_the_first_element_depends_on_the_conduction_of_the_meshes():
    """Ratios of the voltages by hand to the breakdown voltages above."""
    axle = by_hand()
    assert axle.ranking()[0] == ("m12", pytest.approx(10.70786 / 1.8, rel=1e-5))
    assert [name for name, _ in axle.ranking("never")] == ["m12", "b1", "m23", "b2", "b3"]
    assert axle.ranking("always") == [
        (name, pytest.approx(30.0 / 17.6 / limit)) for name, limit in (("b3", 1.0), ("b2", 2.0), ("b1", 3.0))
    ]
    assert set(axle.changed_ranks) == {"b1", "b3"}


def touching_at(share, limits=1.0):
    """Axle by hand whose second mesh has touching summits and conducts for a share of the time."""
    axle = by_hand()
    elements = [
        replace(each, breakdown_voltage=None, touching=True, contact_time_share=share)
        if each.name == "m23"
        else replace(each, breakdown_voltage=limits * each.breakdown_voltage)
        for each in axle.elements
    ]
    return replace(axle, elements=tuple(elements))


def test_voltages_change_to_those_of_a_conducting_mesh_between_95_and_99_percent_of_contact():
    """Half of each network at 97 %: 30 (134, 15, 4)/333.4 V insulating, 30 (17, 1, 1)/43.2 V conducting.

    The mesh whose summits touch has the margin (1 - w)/w with the weight w of the insulating network.
    """
    insulating = [30.0 * part / 333.4 for part in (134.0, 15.0, 4.0)]
    conducting = [30.0 * part / 43.2 for part in (17.0, 1.0, 1.0)]
    for share, weight in ((0.9, 1.0), (0.96, 0.75), (0.97, 0.5), (0.98, 0.25), (0.99, 0.0)):
        axle = touching_at(share)
        expected = [
            weight * one + (1.0 - weight) * other for one, other in zip(insulating, conducting, strict=True)
        ]
        assert list(axle.potentials().values()) == pytest.approx(expected, rel=1e-9)
        ratios = dict(axle.ranking())
        assert ratios["m12"] == pytest.approx((expected[0] - expected[1]) / 1.8, rel=1e-9)
        if weight == 1.0:
            assert ratios["m23"] == np.inf
        elif weight:
            assert ratios["m23"] == pytest.approx(weight / (1.0 - weight), rel=1e-9)
        else:
            assert "m23" not in ratios
        assert dict(axle.ranking("never"))["m23"] == np.inf
        # The mesh opens at the voltage, and with the energy, of the network in which it insulates.
        energies, b2 = axle.energies(), Film("b2", "intermediate", HOUSING, 5.0 * NANO)
        if weight:
            assert energies["m23"] == pytest.approx(3.78049 * NANO, rel=1e-4)
        ends = [
            touching_at(at).network().breakdown(b2, touching_at(at).potentials()).energy for at in (0.5, 1.0)
        ]
        assert energies["b2"] == pytest.approx(weight * ends[0] + (1.0 - weight) * ends[1], rel=1e-9)
        assert list(axle.potentials("always").values()) == pytest.approx([30.0 / 17.6] * 3, rel=1e-12)


@pytest.mark.parametrize("limits", [1.0, 10.0, 30.0])
def test_no_margin_jumps_as_a_mesh_becomes_a_conductor(limits):
    """Steps of 2.5e-4 of the share of time, five times of an input that changes by 0.01 %: 10 % or 0.05."""
    shares = np.arange(0.94, 0.995, 2.5e-4)
    margins = np.array([1.0 / touching_at(share, limits).ranking()[0][1] for share in shares])
    changes = np.abs(np.diff(margins))
    assert np.all(changes < np.maximum(0.05, 0.1 * np.minimum(margins[1:], margins[:-1])))
    assert margins[0] == 0.0
    assert margins[-1] == pytest.approx(limits * 1.8 / (30.0 * 16.0 / 43.2), rel=1e-9)


def test_summits_that_touch_at_times_are_never_green():
    """All films hold ten times their voltage; the mesh opens for 1 to 5 % of the time."""
    found = {}
    for share in (0.96, 0.98, 0.989, 0.99):
        axle = touching_at(share, limits=100.0)
        first, verdict = axle_summary(axle)["first"], axle_verdict(axle)
        found[share] = first["element"], verdict.level, verdict.code
        assert ("95 to 99 % of the time" in verdict.text) == (share < 0.99)
        assert "between these times" not in verdict.text
    assert found == {
        0.96: ("m23", "red", "discharges-likely"),
        0.98: ("m23", "yellow", "discharges-possible"),
        0.989: ("m12", "yellow", "discharges-possible"),
        0.99: ("m12", "green", "breakdown-excluded"),
    }
    assert axle_summary(touching_at(0.98, limits=100.0))["first"]["margin"] == pytest.approx(3.0, rel=1e-9)


def test_a_ring_on_the_rotor_discharges_all_shafts_during_the_edge():
    """1 ohm and an edge of 100 ns: 0.3 V, b dV/dt R, as the time constant of 2.5 ns is short."""
    ring = [{"between": ["rotor", "housing"], "kind": "ring", "resistance": "1 ohm"}]
    potentials = by_hand(link=ring).potentials()
    assert list(potentials.values()) == pytest.approx((0.30000, 0.03358, 0.00896), abs=5e-6)
    given = by_hand(**{"circuit.grounding_ring_resistance": "1 ohm"}).potentials()
    assert list(given.values()) == pytest.approx(list(potentials.values()), rel=1e-12)


def test_a_ramp_on_one_node_is_the_solution_of_its_equation():
    """V = R b (V_s/t) (1 - exp(-t/(R C))) of a node with C and R."""
    films = (Film("w", WINDING, "a", 0.1 * NANO), Film("c", "a", HOUSING, 0.9 * NANO, False, 0.05))
    expected = 20.0 * 0.1 * NANO * 300.0 / 50e-9 * (1.0 - np.exp(-50.0 / 20.0))
    assert Network(("a",), films).potentials(300.0, 50e-9)["a"] == pytest.approx(expected, rel=1e-12)


def test_an_insulated_coupling_divides_and_a_spline_merges():
    """A large capacitance of a coupling is a spline."""
    table = two_stages().to_dict()
    table["shaft"].append({"name": "wheel"})
    bearing = {**ALONE["bearing"][0], "shaft": "wheel"}
    table["bearing"] += [bearing, {**bearing, "at": "90 mm"}]
    voltages = []
    for kind in ({"kind": "spline"}, {"kind": "insulated", "capacitance": 1e-3}):
        case = AxleCase.from_dict(table | {"link": [{"between": ["output", "wheel"], **kind}]})
        axle = AxleSolution(case, case.turning(), by_hand().elements)
        voltages.append(axle.potentials())
    assert voltages[0]["output"] == voltages[0]["wheel"]
    assert list(voltages[1].values()) == pytest.approx(list(voltages[0].values()), rel=1e-5)


def test_a_shaft_alone_has_the_divider_of_a_drive():
    """Mean capacitances of both bearings in the circuit of a drive, to the last digit."""
    case = AxleCase.from_dict(ALONE)
    axle = solve_elements(case)
    breakdown = Breakdown.from_dict(
        {"arc_resistance": 10.0, "extinction_voltage": "1 uV", "recovery_time": "100 ns"}
    )
    bearings = []
    for number, (radial, axial) in enumerate(((800.0, 100.0), (400.0, 0.0))):
        result = solve_bearing(case.bearing_case(number, case.drive.speed, radial, axial))
        element = bearing_element(result, breakdown)
        bearings.append(replace(element, capacitance=np.array([element.mean_capacitance])))
        assert axle.elements[number].breakdown_voltage == pytest.approx(np.min(element.breakdown), rel=1e-12)
    divider, _ = capacitive_divider(Circuit.from_dict(ALONE["circuit"]), bearings)
    assert axle.potentials()["rotor"] == divider * 300.0


def test_ceramic_elements_without_a_capacitance_bound_the_voltages():
    """Divider by hand, C_wr/(C_wr + C_rf + C_1 + C_2), C_1 of the hybrid bearing as computed and 0."""
    first, second = ALONE["bearing"]
    case = AxleCase.from_dict(ALONE | {"bearing": [first | {"element_material": "silicon-nitride"}, second]})
    solution = solve_elements(case)
    hybrid, steel = (element.capacitance for element in solution.elements)
    low, high = (case.edge * 0.1 / (1.1 + (steel + part * hybrid) / NANO) for part in (1.0, 0.0))
    (without,) = solution.ends_of_bounds
    assert [solution.potentials()["rotor"], without.potentials()["rotor"]] == pytest.approx(
        [low, high], rel=1e-5
    )
    text = next(warning.text for warning in solution.warnings if warning.code == "capacitance-bound")
    assert text.startswith("bearing 1 of rotor: the elements are ceramic")
    assert f"rotor {readable(low)} to {readable(high)} V" in text
    # The level is that of both ends; it is not known if a strength less by 20 % matters at one of them only.
    assert high > 1.06 * low
    for limit, level in ((0.5 * low, "red"), (1.03 * low / 0.8, "grey"), (3.0 * high, "green")):
        elements = tuple(
            replace(each, breakdown_voltage=limit if each.name == "bearing 2 of rotor" else None)
            for each in solution.elements
        )
        assert axle_verdict(replace(solution, elements=elements)).level == level
    given = case.replace(
        {"bearing.rotor.element_capacitance": "1 pF", "bearing.rotor.element_material": "silicon-nitride"}
    )
    assert (given.tables_of_bearings[0].capacitance_is_bound, solve_elements(given).ends_of_bounds) == (
        False,
        (),
    )


def test_the_example_of_an_axle():
    """Loads and voltages agree with the network and statics; coasting changes loads, and not the speeds."""
    driving, coasting = (solve_axle(two_stages(**{"drive.torque": torque})) for torque in (30.0, -30.0))
    assert driving.solution.ranking()[0][0] == "mesh of rotor and intermediate"
    assert "bearing 2 of output is first" in driving.verdict.text
    assert driving.verdict.level == "red"
    summary = driving.summary()
    rows = {row["element"]: row for row in summary["elements"]}
    assert rows["mesh of intermediate and output"]["state"] == "conducts"
    assert rows["mesh of intermediate and output"]["voltage"] == 0.0
    # The loads of the separate program at 150 N m, in proportion to the torque.
    assert rows["bearing 1 of rotor"]["radial_load"] == pytest.approx(4945.440 / 5.0, rel=2e-6)
    assert rows["bearing 1 of rotor"]["axial_load"] == pytest.approx(-3149.950 / 5.0, rel=2e-6)
    other = {row["element"]: row for row in coasting.summary()["elements"]}
    assert other["bearing 1 of rotor"]["radial_load"] == pytest.approx(4298.173 / 5.0, rel=2e-6)
    assert other["bearing 1 of rotor"]["axial_load"] == pytest.approx(3149.950 / 5.0, rel=2e-6)


def test_an_element_parallel_to_a_conducting_one_has_no_energy():
    """A bearing of the rotor that conducts holds the shaft at the housing."""
    axle = by_hand()
    closed = replace(axle.elements[0], name="b0", contact_time_share=1.0)
    shorted = AxleSolution(axle.case, axle.turning, (closed, *axle.elements))
    rows = {row["element"]: row for row in axle_summary(shorted)["elements"]}
    assert rows["b1"]["voltage"] == 0.0
    assert rows["b1"]["energy"] is None
    assert rows["b0"]["state"] == "conducts"


def test_remedies_of_the_example():
    """A ring on the rotor has the voltage b dV/dt R. Hybrid bearings raise the voltage of the rotor. A first
    stage that conducts makes one node of all shafts.
    """
    result = solve_axle(two_stages())
    alone = result.solution.potentials()
    ring, hybrid, other, conducting = (remedy.potentials() for remedy in result.remedies)
    assert ring["rotor"] == pytest.approx(100e-12 * 800.0 / 3.0 / 50e-9, rel=1e-3)
    assert hybrid["rotor"] > alone["rotor"]
    assert (
        dict(result.remedies[1].ranking())["mesh of rotor and intermediate"] > result.solution.ranking()[0][1]
    )
    assert other["intermediate"] < 0.1 * alone["intermediate"]
    assert other["rotor"] > 0.9 * alone["rotor"]
    assert conducting == result.solution.potentials("always")
    rows = result.summary()["remedies"]
    assert [row["title"] for row in rows] == [remedy.title for remedy in result.case.remedies]


def test_voltages_of_a_remedy_are_lower_bounds_where_it_gives_no_capacitance(tmp_path):
    """Ceramic elements of a remedy without their capacitance: its shaft voltages are lower bounds, and the
    axle as it is has none.
    """
    hybrid = {"title": "Hybrid", "changes": {"bearing.rotor.element_material": "silicon-nitride"}}
    solved = solve_axle(two_stages(remedies=[hybrid]))
    save(solved, tmp_path)
    for result in (solved, load(tmp_path)):
        heads, *rows = remedy_cells(result.summary())
        assert heads == ("U/V_b", "as it is", "Hybrid")
        voltages = {row[0]: row[1:] for row in rows if row[0].startswith("U of")}
        assert len(voltages) == 3
        for as_it_is, remedied in voltages.values():
            assert not as_it_is.startswith("≥")
            assert remedied.startswith("≥ ")
        (warning,) = result.warnings_of_remedies
        assert warning.code == "capacitance-bound"
        assert warning.text.startswith(
            "Hybrid: bearing 1 of rotor, bearing 2 of rotor: the elements are ceramic"
        )


def test_conduction_of_the_gear_file_is_kept():
    table = two_stages().to_dict()
    table["mesh"][0]["pair"]["gear"]["contact"] = {"conduction": "always"}
    result = solve(table)
    assert result.solution.potentials()["rotor"] == result.solution.potentials()["intermediate"]
    assert result.verdict.margin > 0.0
    assert "conducts" in result.verdict.text


def test_contacts_of_an_axle():
    """``drive.contacts`` is the method of all bearings and meshes; films of formulas are within 30 %."""
    atlas, formula = (solve_elements(two_stages(**{"drive.contacts": way})) for way in ("atlas", "formula"))
    assert solve_elements(two_stages()).elements == atlas.elements
    assert "formula-contacts" in [warning.code for warning in formula.warnings]
    for first, second in zip(atlas.elements, formula.elements, strict=True):
        assert first.capacitance != second.capacitance
        assert second.lambda_ratio == pytest.approx(first.lambda_ratio, rel=0.3)


@pytest.mark.slow
def test_solved_contacts_of_a_mesh_and_a_bearing():
    """Solved films are within the error of the atlas, some percent."""
    case = two_stages(**{"drive.contacts": "solved"})
    turning = case.turning()
    assert case.gear_case(0, turning).contacts == "solved"
    solved, quick = (
        solve_bearing(each.bearing_case(0, turning["rotor"].speed, 989.1, 630.0), workers=1)
        for each in (case, two_stages())
    )
    assert solved.case.contacts == "solved"
    assert solved.solution.least_film == pytest.approx(quick.solution.least_film, rel=0.03)


def test_without_a_strength_no_element_touches():
    """Without a strength no breakdown voltage is known, whether summits touch or not: nothing is ranked."""
    table = two_stages(remedies=[]).to_dict()
    table.pop("discharge")
    solution = solve_elements(AxleCase.from_dict(table))
    assert not any(element.touching for element in solution.elements)
    assert solution.ranking() == []
    assert {*map(ratio_word, axle_summary(solution)["elements"])} == {"no V_b", "conducts"}


def test_a_margin_of_zero_recommends_no_measurement():
    """The shares belong to a spread of the margin, which is 0 where summits touch at almost all points."""
    for high, recommended in ((0.0, False), (0.3, True)):
        chance = Chance(0.99, 0.01, 0.0, 0.0, high, first="torque", share=0.4, samples=512)
        verdict = axle_verdict(by_hand(), Probable(chance))
        assert ("measure-first" in [reason.code for reason in verdict.reasons]) == recommended


def test_a_warning_of_many_elements_has_the_numbers_of_the_thinnest_film():
    elements = [replace(by_hand().elements[0], name=f"b{k}", lambda_ratio=float(k)) for k in (3, 1, 5, 2, 4)]
    warnings = [(each.name, (ResultWarning("row-unloaded", f"number {each.name}."),)) for each in elements]
    (text,) = (str(each) for each in named_warnings(thinnest_first(elements, warnings)))
    assert text == "b1: number b1. The same holds for b2, b3 and 2 others, with other numbers."
    (text,) = (str(each) for each in named_warnings(thinnest_first(elements, warnings[:3])))
    assert text == "b1: number b1. The same holds for b3, b5, with other numbers."
    alike = [(name, (ResultWarning("row-unloaded", "number 7."),)) for name in ("b1", "b3")]
    assert [str(each) for each in named_warnings(alike)] == ["b1: number 7. The same holds for b3."]


@pytest.mark.parametrize("torque", ["1e-9 N m", "-1e-8 N m"])
def test_a_torque_that_loads_no_bearing_is_named(torque):
    with pytest.raises(InputError, match="bearings of rotor carry") as caught:
        solve_elements(two_stages(remedies=[]).replace({"drive.torque": torque}))
    assert caught.value.key == "drive.torque"


@pytest.mark.parametrize("resistance", ["0 ohm", "50 ohm", "100 kohm"])
def test_the_overshoot_of_a_choke(resistance):
    """Of L, R and C of winding and rotor by hand: 1 + exp(-pi D/sqrt(1 - D^2)), D = R/2 sqrt(C/L)."""
    keys = {"common_mode_inductance": "1 mH", "common_mode_resistance": resistance}
    axle = solve_elements(AxleCase.from_dict(ALONE | {"circuit": ALONE["circuit"] | keys}))
    winding, frame = (
        axle.case.circuit.capacitances[f"{key}_capacitance"] for key in ("winding_rotor", "rotor_frame")
    )
    below = frame + sum(each.capacitance for each in axle.elements)
    capacitance = winding * below / (winding + below)
    damping = 0.5 * axle.case.circuit.common_mode_resistance * math.sqrt(capacitance / 1e-3)
    expected = 1.0 if damping >= 1.0 else 1.0 + math.exp(-math.pi * damping / math.sqrt(1.0 - damping**2))
    assert axle.overshoot == pytest.approx(expected, rel=1e-6)
    assert ("edge-rings" in [each.code for each in axle.warnings]) == (expected > 1.05)


@pytest.mark.parametrize(
    ("circuit", "drive", "words"),
    [
        ({"cable_capacitance": "1 nF"}, {}, "without an inductance"),
        (
            {"common_mode_inductance": "1 mH", "frame_earth_capacitance": "1 nF"},
            {},
            "circuit.ground_inductance",
        ),
        ({}, {"gravity_direction": "0 deg"}, "without a mass"),
    ],
)
def test_keys_that_need_another_key_are_named(circuit, drive, words):
    tables = {"circuit": ALONE["circuit"] | circuit, "drive": ALONE["drive"] | drive}
    notes = [str(note) for note in unused_keys(AxleCase.from_dict(ALONE | tables))]
    assert len(notes) == 1
    assert words in notes[0]


def test_a_bearing_with_its_own_oil(tmp_path):
    """A greased bearing is the bearing of a bearing file with this oil and strength; others keep theirs."""
    plain = two_stages()
    tables = plain.to_dict()
    tables["bearing"][1] |= {"lubricant": {"base": "iso-vg-46"}, "discharge": {"dielectric_strength": 25e6}}
    case = AxleCase.from_dict(tables)
    path = tmp_path / "axle.toml"
    path.write_text(case.to_toml())
    assert AxleCase.from_toml(path) == case
    one, other = solve_elements(plain).elements, solve_elements(case).elements
    of_axle = plain.bearing_case(1, plain.drive.speed, other[1].radial_load, abs(other[1].axial_load))
    file = of_axle.to_dict() | {"lubricant": {"base": "iso-vg-46"}}
    summary = solve_bearing(BearingCase.from_dict(file)).summary()["bearing"]
    assert other[1].capacitance == pytest.approx(summary["shaft_capacitance"], rel=1e-12)
    at_15 = summary["shaft_ring_to_ring_breakdown"]
    assert other[1].breakdown_voltage == pytest.approx(25.0 / 15.0 * at_15, rel=1e-12)
    changed = [a != b for a, b in zip(one, other, strict=True)]
    assert changed == [number == 1 for number in range(len(one))]
    (together,) = solve_axles([case])
    expected = [each.capacitance for each in other]
    assert [each.capacitance for each in together.elements] == pytest.approx(expected, rel=1e-9)


def test_the_oil_of_a_bearing_is_changed_by_its_shaft():
    """In ``replace`` and in ``evaluate``; a wrong key is named."""
    case = two_stages(**{"bearing.rotor.lubricant": {"base": "fva-3"}})
    assert [each.lubricant is None for each in case.bearing] == [False, False, True, True, True, True]
    thin = case.replace({"bearing.rotor.lubricant.viscosity": "20 mPa s"})
    assert thin.bearing[0].lubricant.viscosity == 0.02
    key = "bearing.rotor.discharge.dielectric_strength"
    limits = evaluate(case, {key: ["15 V/um", "30 V/um"]})["elements.rotor_1.breakdown_voltage"].values
    assert limits[1] == pytest.approx(2.0 * limits[0], rel=1e-9)
    ranged = case.replace(ranges={key: ["10 V/um", "30 V/um"]}, **{key: "20 V/um"})
    assert ranged.value_of(key) == 20e6
    with pytest.raises(InputError, match=r"lubricant\.viscosity") as refused:
        case.replace({"bearing.rotor.lubricant.visc": 1.0})
    assert {each.key for each in refused.value.several} == {f"bearing.{n}.lubricant.visc" for n in (1, 2)}


def test_a_check_solves_no_films():
    """Also where a gear file asks for solved contacts; its films are those of the atlas."""
    solved, atlas = (
        preview(two_stages(**{"mesh.1.contacts": way, "remedies": []})).summary for way in ("solved", "atlas")
    )
    assert solved["inputs"]["drive"]["contacts"] == "atlas"
    assert [row["capacitance"] for row in solved["elements"]] == [
        row["capacitance"] for row in atlas["elements"]
    ]


def test_strengths_of_single_bearings_in_probabilities():
    """A range of the axle's strength does not change a bearing with its own strength; its own range does."""
    key = "bearing.rotor.discharge.dielectric_strength"
    base = two_stages(remedies=[], **{key: "15 V/um", "discharge.dielectric_strength": "80 V/um"})
    exact = {key: ["15 V/um", "15.001 V/um"]}
    spread = {key: ["15 V/um", "150 V/um"]}
    wide = {"discharge.dielectric_strength": ["15 V/um", "150 V/um"]}

    def chances(**ranges):
        result = solve_axle(base.replace(ranges=ranges)).summary()["uncertainty"]["elements"]
        return {row["element"]: row["breakdown_probability"] for row in result}

    known, widened, own = chances(**exact), chances(**exact, **wide), chances(**spread)
    name = "bearing 1 of rotor"
    assert widened[name] == pytest.approx(known[name], abs=0.05)
    assert own[name] < known[name] - 0.3


def test_a_new_strength_of_one_bearing_keeps_the_other_keys():
    """They begin with the keys of the axle."""
    case = two_stages(remedies=[], **{"discharge.conductivity": "1 nS/m"})
    changed = case.replace({"bearing.rotor.discharge.dielectric_strength": "30 V/um"})
    assert changed.bearing[0].discharge.conductivity == case.discharge.conductivity
    other = case.replace({"bearing.rotor.lubricant.base": "fva-3"})
    assert (other.bearing[0].lubricant.base, other.bearing[2].lubricant) == ("fva-3", None)
    assert other.replace({"bearing.rotor.lubricant": None}) == case


def test_strengths_of_bearings_are_a_strength():
    """The axle itself has none."""
    strength = {"bearing.rotor.discharge": {"dielectric_strength": "15 V/um"}}
    case = two_stages(remedies=[], discharge={"dielectric_strength": None}, **strength)
    result = solve_axle(case)
    assert result.verdict.level != "grey"
    assert result.summary()["first"]["element"].endswith("of rotor")
    assert result.uncertainty is not None
