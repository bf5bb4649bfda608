"""Loads of the bearings of three shafts, by statics: a separate program, equilibrium and symmetry."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import AxleCase, Sweep, evaluate, run_sweep, solve_axle
from ehlectric.axle import loads_on_shafts, solve_axles
from ehlectric.axle.shaft_loads import forces_of_mesh
from ehlectric.axle.solution import solve_elements
from ehlectric.errors import InputError
from ehlectric.formulas.shaft_statics import ForceAt, bearing_loads
from ehlectric.gear import GearPair
from ehlectric.gear.geometry import gear_pair
from tests.axle.axles import ALONE, two_stages
from tests.gear.pairs import FIRST_STAGE, SECOND_STAGE
from tests.helpers.statics import by_vectors

# Distances along z [m]: bearings of the three shafts, and their gears.
BEARINGS = ((0.0, 0.08), (0.0, 0.11), (0.0, 0.12))


def loads_of_axle(torque):
    """Loads of the bearings of an e-axle with two stages; centre lines at 0 and -40 degrees."""
    first, second = gear_pair(FIRST_STAGE), gear_pair(SECOND_STAGE)
    on_1, on_2 = forces_of_mesh(first, torque, "left", 0.0, (0.03, 0.03))
    further = first.ratio * torque
    # The mesh turns the intermediate shaft against the rotor: its torque has the other sign.
    on_2b, on_3 = forces_of_mesh(second, -further, "right", math.radians(-40.0), (0.075, 0.075))
    shafts = [[on_1], [on_2, on_2b], [on_3]]
    return [bearing_loads(forces, places) for forces, places in zip(shafts, BEARINGS, strict=True)]


@pytest.mark.parametrize(
    ("torque", "radial", "axial"),
    [
        (
            150.0,
            [(4945.440, 2534.413), (11443.578, 15179.439), (6822.580, 14051.224)],
            [-3149.950, -2535.397, 5685.347],
        ),
        (
            -150.0,
            [(4298.173, 3164.348), (8581.013, 15102.733), (9690.202, 10886.516)],
            [3149.950, 2535.397, -5685.347],
        ),
    ],
)
def test_loads_of_an_axle(torque, radial, axial):
    """Loads [N] that a separate program computed, driving and coasting."""
    for loads, expected, force in zip(loads_of_axle(torque), radial, axial, strict=True):
        assert loads.radial == pytest.approx(expected, rel=2e-6)
        assert loads.axial == pytest.approx(force, rel=2e-6)


@given(
    st.lists(
        st.tuples(*[st.floats(-1e4, 1e4)] * 3, *[st.floats(-0.2, 0.2)] * 3),
        min_size=1,
        max_size=4,
    ),
    st.floats(0.02, 0.3),
)
def test_the_shaft_is_in_equilibrium(rows, distance):
    """Forces and moments about both axes across the shaft add up to zero at any point."""
    forces = [ForceAt(np.array(row[:3]), np.array(row[3:])) for row in rows]
    loads = bearing_loads(forces, (0.01, 0.01 + distance))
    reactions = [
        ForceAt(np.array([*-loads.first, 0.0]), np.array([0.0, 0.0, 0.01])),
        ForceAt(np.array([*-loads.second, 0.0]), np.array([0.0, 0.0, 0.01 + distance])),
    ]
    everything = [*forces, *reactions]
    about = np.array([0.03, -0.02, 0.5])
    moment = sum(np.cross(each.point - about, each.force) for each in everything)
    # The axial force stays, on the axis of the shaft.
    moment += np.cross(np.zeros(3) - about, np.array([0.0, 0.0, -loads.axial]))
    assert sum(each.force for each in everything)[:2] == pytest.approx([0.0, 0.0], abs=1e-6)
    assert moment[:2] == pytest.approx([0.0, 0.0], abs=1e-5)


def test_the_power_of_the_forces_is_the_power_of_the_shafts():
    """The moment about each axis is the torque of its shaft: -T on gear 1, which the shaft drives with T."""
    pair: GearPair = gear_pair(FIRST_STAGE)
    on_1, on_2 = forces_of_mesh(pair, 150.0, "left", 0.7, (0.03, 0.04))
    assert np.cross(on_1.point, on_1.force)[2] == pytest.approx(-150.0, rel=1e-12)
    assert np.cross(on_2.point, on_2.force)[2] == pytest.approx(-150.0 * pair.ratio, rel=1e-12)


def test_bearings_at_one_place_are_refused():
    with pytest.raises(InputError, match="one place"):
        bearing_loads([], (0.1, 0.1))


@pytest.mark.parametrize(("down", "place"), [(-90.0, 0.06), (20.0, -0.03)])
def test_weight_and_forces_load_the_bearings(down, place):
    """Vector statics of a rotor of 12 kg with a belt beyond its bearings and a spring; signs included."""
    shaft = {"name": "rotor", "rotor": True, "mass": "12 kg", "mass_at": f"{place} m"}
    loads = ("radial_load", "axial_load")
    bearings = [
        {key: value for key, value in bearing.items() if key not in loads} | {"locating": number == 0}
        for number, bearing in enumerate(ALONE["bearing"])
    ]
    force = [
        {"shaft": "rotor", "at": "120 mm", "x": "300 N", "y": "-50 N"},
        {"shaft": "rotor", "at": "0 mm", "z": "-80 N"},
    ]
    drive = ALONE["drive"] | {"torque": 0.0, "gravity_direction": f"{down} deg"}
    case = AxleCase.from_dict(ALONE | {"drive": drive, "shaft": [shaft], "bearing": bearings, "force": force})
    weight = 12.0 * 9.80665 * np.array([math.cos(math.radians(down)), math.sin(math.radians(down)), 0.0])
    given = [(weight, place), (np.array([300.0, -50.0, 0.0]), 0.12), (np.array([0.0, 0.0, -80.0]), 0.0)]
    first, second = np.split(by_vectors(given, (0.0, 0.08)), [3])
    found = loads_on_shafts(case)["rotor"]
    # Bearings carry what the shaft puts on them, against their forces on the shaft.
    assert found.first == pytest.approx(-first[:2], rel=1e-9)
    assert found.second == pytest.approx(-second, rel=1e-9)
    assert found.axial == pytest.approx(-first[2], rel=1e-12)
    elements = solve_elements(case).elements
    radial = [float(np.hypot(*first[:2])), float(np.hypot(*second))]
    assert [each.radial_load for each in elements] == pytest.approx(radial, rel=1e-6)
    assert [each.axial_load for each in elements] == pytest.approx([-80.0, 0.0], rel=1e-6)
    changed = case.replace({"force.1.x": "600 N", "shaft.rotor.mass": "24 kg"})
    assert (changed.force[0].x, changed.shaft[0].mass) == (600.0, 24.0)
    assert [each.radial_load for each in solve_elements(changed).elements] != pytest.approx(radial, rel=0.1)


# Masses of the shafts of the e-axle of the examples, in the middle of their bearings.
MASSES = {"rotor": (12.0, 0.04), "intermediate": (5.0, 0.055), "output": (15.0, 0.06)}


def with_masses(**changes):
    masses = {f"shaft.{name}.mass": mass for name, (mass, _) in MASSES.items()}
    places = {f"shaft.{name}.mass_at": place for name, (_, place) in MASSES.items()}
    return two_stages(**{"remedies": []} | masses | places | changes)


def test_an_axle_that_coasts_has_the_loads_of_its_weight():
    """Half of the weight of each shaft on both of its bearings; small torques give almost the same answer."""
    coasting, light = (solve_elements(with_masses(**{"drive.torque": torque})) for torque in (0.0, 1e-4))
    halves = [0.5 * mass * 9.80665 for mass, _ in MASSES.values() for _ in range(2)]
    bearings, meshes = coasting.elements[:6], coasting.elements[6:]
    assert [each.radial_load for each in bearings] == pytest.approx(halves, rel=1e-6)
    assert [each.kind for each in meshes] == ["mesh", "mesh"]
    # Films fill half of the backlash of 60 and 80 um, less the height of the summits.
    strength = two_stages().discharge.dielectric_strength
    gaps = [each.breakdown_voltage / strength for each in meshes]
    assert gaps == pytest.approx([30e-6, 40e-6], rel=0.03)
    assert [code for code in (w.code for w in coasting.warnings) if code == "mesh-loose"] == ["mesh-loose"]
    for one, other in zip(coasting.elements, light.elements, strict=True):
        assert other.capacitance == pytest.approx(one.capacitance, rel=0.01)
    (together,) = solve_axles([coasting.case])
    assert together.voltages() == pytest.approx(coasting.voltages(), rel=1e-9)
    assert {w.code for w in together.warnings} == {w.code for w in coasting.warnings}


def test_a_shaft_without_weight_does_not_coast():
    with pytest.raises(InputError, match=r"drive\.torque") as refused:
        solve_elements(
            with_masses(**{"drive.torque": 0.0, "shaft.output.mass": None, "shaft.output.mass_at": None})
        )
    assert refused.value.key == "drive.torque"


def test_rows_of_a_cycle_that_coast_are_answered(tmp_path):
    """The row with no torque has the voltages of this axle."""
    cycle = tmp_path / "cycle.csv"
    cycle.write_text("time [s],torque [N m],speed [rpm]\n0,80,14000\n1,0,14000\n2,-30,14000\n")
    duty = solve_axle(with_masses(duty={"file": str(cycle)}), probable=False).duty
    assert duty.known.tolist() == [True, True, True]
    coasting = solve_elements(with_masses(**{"drive.torque": 0.0, "drive.speed": "14000 rpm"}))
    assert duty.voltages[1] == pytest.approx([*coasting.voltages().values()], rel=1e-9)


def loaded(**changes):
    """Rotor of 10 kg without given loads, with a force of 300 N +- 30 N."""
    bearings = [
        {key: value for key, value in bearing.items() if key not in ("radial_load", "axial_load")}
        for bearing in ALONE["bearing"]
    ]
    shaft = [{"name": "rotor", "rotor": True, "mass": "10 kg +- 2 kg", "mass_at": "20 mm"}]
    force = [{"shaft": "rotor", "at": "50 mm", "x": "300 N +- 30 N"}]
    return AxleCase.from_dict(ALONE | {"bearing": bearings, "shaft": shaft, "force": force} | changes)


def test_mass_and_force_with_an_uncertainty_have_ranges():
    ranges = {each.key: (each.low, each.high) for each in loaded().ranges}
    assert ranges == {"shaft.rotor.mass": (8.0, 12.0), "force.1.x": (270.0, 330.0)}
    keys = [each.key for each in solve_axle(loaded()).uncertainty.inputs]
    assert {"shaft.rotor.mass", "force.1.x"} <= {*keys}


def test_forces_and_the_direction_of_gravity_vary(tmp_path):
    """A force through 0 N, where weight is left; a direction along x adds to the force."""
    case = loaded().replace(ranges=None)
    margins = evaluate(case, {"force.1.x": [-300.0, 0.0, 300.0]})["first.margin"].values
    assert np.all(np.isfinite(margins))
    assert margins[0] == pytest.approx(margins[2], rel=1e-9)
    varied = Sweep.from_dict({"case": case, "vary": {"drive.gravity_direction": ["-90 deg", "0 deg"]}})
    with ThreadPoolExecutor(1) as executor:
        column = run_sweep(varied, tmp_path, executor).to_dataframe()["elements.rotor_2.radial_load"]
    weight = 10.0 * 9.80665 * 20.0 / 80.0
    assert column.tolist() == pytest.approx([math.hypot(187.5, weight), 187.5 + weight], rel=1e-6)


@pytest.mark.parametrize("name", ["winding", "source", "earth", "ring"])
def test_a_shaft_may_have_the_name_of_a_part_of_the_machine(name):
    """The voltage is that of a shaft with another name."""
    keys = {"common_mode_inductance": "1 mH", "ground_inductance": "1 uH", "cable_capacitance": "1 nF"}
    found = []
    for shaft in ("rotor", name):
        tables = ALONE | {"shaft": [{"name": shaft, "rotor": True}], "circuit": ALONE["circuit"] | keys}
        tables["bearing"] = [bearing | {"shaft": shaft} for bearing in ALONE["bearing"]]
        found.append(solve_elements(AxleCase.from_dict(tables)).potentials()[shaft])
    assert found[1] == found[0] > 1.0
