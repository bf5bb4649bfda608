"""Bearings of all kinds against an independent calculation, at random points of operation.

Loads of all elements and displacement of the ring agree to 1e-6; so do the contact angles, and the gaps of
elements without load. The capacitance in oil and the voltage at which the first contact breaks down agree to
2 %. Light contacts have the films of rigid bodies, which the room of their elements bounds.
"""

import numpy as np
import pytest

from ehlectric.bearing.preparation import equilibria_of, resolve_bearing
from ehlectric.bearing.solution import capacitance
from ehlectric.bearing.solving import solution_of
from ehlectric.cases.bearing_case import BearingCase
from tests.helpers.independent_bearings import Oil, electric_of, loads_of

pytestmark = pytest.mark.reference

POINTS = 20
BOTH_PAIRS = "preload", "axial_clearance"

# Static load rating over Z D^2 of balls and Z D L of rollers is about this [Pa].
OF_BALLS, OF_ROLLERS = 12e6, 40e6


def balls(draw, *, largest=0.3, shoulder=0.32):
    """Dimensions of balls and grooves; ``largest`` is that of D/d_m."""
    pitch = draw.uniform(0.02, 0.12)
    size = draw.uniform(0.12, largest) * pitch
    most = int(np.pi / np.arcsin(size / pitch))
    return {
        "elements": int(draw.integers(max(5, most // 2), max(6, int(0.95 * most)))),
        "element_diameter": size,
        "pitch_diameter": pitch,
        "inner_groove": draw.uniform(0.51, 0.54),
        "outer_groove": draw.uniform(0.51, 0.54),
        "shoulder_height": shoulder,
    }


def rollers(draw, *, largest=0.22, lengths=(1.0, 2.2)):
    """Dimensions of rollers; ``lengths`` are the least and the largest of L/D."""
    pitch = draw.uniform(0.02, 0.12)
    size = draw.uniform(0.08, largest) * pitch
    most = int(np.pi / np.arcsin(size / pitch))
    return {
        "elements": int(draw.integers(max(7, most // 2), max(8, int(0.95 * most)))),
        "element_diameter": size,
        "pitch_diameter": pitch,
        "roller_length": draw.uniform(*lengths) * size,
        "profile": str(draw.choice(["none", "logarithmic"])),
    }


def rating(table):
    """Load of a size that the elements of one row carry [N]."""
    size, number = table["element_diameter"], table["elements"]
    if "roller_length" in table:
        return OF_ROLLERS * number * size * table["roller_length"]
    return OF_BALLS * number * size**2


def part(draw):
    """Part of a rating, from light to heavy loads."""
    return 10.0 ** draw.uniform(-2.3, -0.7)


def speed(draw, table):
    """Speed of the inner ring [rad/s]; the speed in rpm times d_m in mm is 20 000 to 500 000."""
    return 10.0 ** draw.uniform(4.3, 5.7) / (1e3 * table["pitch_diameter"]) * np.pi / 30.0


def deep_groove(draw):
    table = balls(draw)
    touch = (table["inner_groove"] + table["outer_groove"] - 1.0) * table["element_diameter"]
    load = part(draw) * rating(table)
    return table | {
        "radial_clearance": touch * draw.uniform(-0.002, 0.04),
        "radial_load": load,
        "axial_load": load * draw.choice([0.0, 0.2, 0.5]),
    }


def angular_contact(draw):
    table = balls(draw) | {"contact_angle": np.radians(draw.uniform(15.0, 40.0))}
    load = part(draw) * rating(table)
    aside = np.tan(table["contact_angle"])
    return table | {"radial_load": load, "axial_load": load * aside * draw.uniform(0.8, 3.0)}


def pair(draw, load, size):
    """Second row with a preload, or with an axial play."""
    key = draw.choice(BOTH_PAIRS)
    value = load * 10.0 ** draw.uniform(-1.5, 0.3) if key == "preload" else size * draw.uniform(0.0, 3e-3)
    return {"pair": {"arrangement": str(draw.choice(["O", "X"])), str(key): value}}


def angular_contact_pair(draw):
    table = balls(draw) | {"contact_angle": np.radians(draw.uniform(15.0, 40.0))}
    load = part(draw) * rating(table)
    table |= {"radial_load": load, "axial_load": load * draw.choice([0.0, 0.3, 0.8])}
    return table | pair(draw, load, table["element_diameter"])


def four_point(draw):
    table = balls(draw, shoulder=0.4) | {"contact_angle": np.radians(draw.uniform(28.0, 38.0))}
    touch = (table["inner_groove"] + table["outer_groove"] - 1.0) * table["element_diameter"]
    load = part(draw) * rating(table)
    return table | {
        "radial_clearance": touch * draw.uniform(-0.001, 0.06),
        "radial_load": load * (radial := draw.choice([0.0, 1.0, 1.0])),
        "axial_load": load * draw.choice([0.0, 0.3, 1.0] if radial else [1.0]),
    }


def thrust_ball(draw):
    table = balls(draw, largest=0.22)
    # Contacts with both washers move outwards by the same angle only in equal grooves.
    table["outer_groove"] = table["inner_groove"]
    return table | {"axial_load": part(draw) * rating(table) * 3.0}


def cylindrical(draw):
    table = rollers(draw)
    return table | {
        "radial_clearance": table["element_diameter"] * draw.uniform(-2e-4, 4e-3),
        "radial_load": part(draw) * rating(table),
    }


def needles(draw):
    table = rollers(draw, largest=0.12, lengths=(2.2, 7.0))
    return table | {
        "radial_clearance": table["element_diameter"] * draw.uniform(-2e-4, 4e-3),
        "radial_load": part(draw) * rating(table),
        "inner_ring": bool(draw.choice([True, False])),
    }


def tapered(draw):
    table = rollers(draw) | {"contact_angle": np.radians(draw.uniform(8.0, 30.0))}
    load = part(draw) * rating(table)
    least = np.tan(table["contact_angle"]) / np.cos(np.pi / table["elements"])
    return table | {"radial_load": load, "axial_load": load * least * draw.uniform(1.02, 3.0)}


def tapered_pair(draw):
    table = rollers(draw) | {"contact_angle": np.radians(draw.uniform(8.0, 30.0))}
    load = part(draw) * rating(table)
    table |= {"radial_load": load, "axial_load": load * draw.choice([0.0, 0.2, 0.6])}
    return table | pair(draw, load, table["element_diameter"])


def thrust_needles(draw):
    table = rollers(draw, largest=0.1, lengths=(1.5, 4.0))
    return table | {"axial_load": part(draw) * rating(table) * 3.0}


KINDS = {
    "deep-groove ball": ("deep-groove ball", deep_groove),
    "angular-contact ball": ("angular-contact ball", angular_contact),
    "pair of angular-contact ball": ("angular-contact ball", angular_contact_pair),
    "four-point contact ball": ("four-point contact ball", four_point),
    "thrust ball": ("thrust ball", thrust_ball),
    "cylindrical roller": ("cylindrical roller", cylindrical),
    "needle roller": ("needle roller", needles),
    "tapered roller": ("tapered roller", tapered),
    "pair of tapered roller": ("tapered roller", tapered_pair),
    "thrust needle roller": ("thrust needle roller", thrust_needles),
}


def point(name, number):
    """Table of a bearing of a kind and its oil, at one of the random points of operation."""
    draw = np.random.default_rng([list(KINDS).index(name), number])
    kind, drawn = KINDS[name]
    table = {"kind": kind, **drawn(draw)}
    table = {key: float(value) if isinstance(value, np.floating) else value for key, value in table.items()}
    table["inner_speed"] = float(speed(draw, table))
    viscosity, alpha = 10.0 ** draw.uniform(-2.3, -1.0), draw.uniform(12e-9, 24e-9)
    return table, Oil(float(viscosity), float(alpha), float(draw.uniform(2.1, 2.8)), 15e6)


def case_of(table, oil):
    """Bearing file of a table and its oil, with contacts by formula."""
    lubricant = {
        "viscosity": oil.viscosity,
        "pressure_viscosity_coefficient": oil.alpha,
        "viscosity_law": "barus",
        "density_law": "dowson-higginson",
        "density_c1": 0.59e9,
        "density_c2": 1.34,
        "permittivity_law": "clausius-mossotti",
        "relative_permittivity": oil.permittivity,
    }
    conditions = {"temperature": 343.15, "composite_rq": 1e-9, "summit_height": 0.0, "film_factor": "none"}
    return BearingCase.from_dict(
        {
            "bearing": table | conditions,
            "lubricant": lubricant,
            "discharge": {"dielectric_strength": oil.strength},
            "contacts": "formula",
        }
    )


def differences(found, own):
    """Largest differences of loads, displacement of the ring, and angles and gaps of both contacts.

    They are relative to the largest load, the length of the displacement, 1 rad and the largest gap.
    """

    def both(name):
        return np.stack([getattr(found, f"inner_{name}"), getattr(found, f"outer_{name}")])

    ring = np.array([getattr(found, f"{way}_displacement") for way in ("radial", "lateral", "axial")])
    loaded = own.load > 1e-6 * np.max(own.load)
    return {
        "load": np.max(np.abs(both("load") - own.load)) / np.max(own.load),
        "ring": np.linalg.norm(ring - own.ring) / np.linalg.norm(own.ring),
        "angle": np.max(np.abs(both("angle") - own.angle), where=loaded, initial=0.0),
        "gap": np.max(np.abs(both("gap") - own.gap)) / max(np.max(own.gap), 1e-7),
    }


@pytest.mark.slow
@pytest.mark.parametrize("name", KINDS)
def test_loads_and_displacement(name):
    for number in range(POINTS):
        table, oil = point(name, number)
        (found,) = equilibria_of(resolve_bearing(case_of(table, oil)), 1)
        found = differences(found, loads_of(table))
        assert max(found.values()) < 1e-6, (number, found)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("name", KINDS)
def test_loads_with_the_cage_turned(name):
    """A quarter, a half and three quarters of a pitch on; the last one mirrors the first."""
    for number in range(5):
        table, oil = point(name, number)
        places = equilibria_of(resolve_bearing(case_of(table, oil)), 4)
        for quarter in (1, 2, 3):
            found = differences(places[quarter], loads_of(table, quarter / 4.0))
            assert max(found.values()) < 1e-6, (number, quarter, found)


def check_electric(table, oil, positions=1):
    """Mean capacitance over positions of the cage, and the least voltage of a first breakdown."""
    solution = solution_of(case_of(table, oil), positions=positions)
    places = [loads_of(table, k / positions) for k in range(positions)]
    largest = np.max([loads.load for loads in places], axis=(0, 2))
    own, first = zip(*(electric_of(table, oil, loads, largest) for loads in places), strict=True)
    breaks = [circuit.first_break for circuit in solution.circuits("oil")]
    assert capacitance(solution) == pytest.approx(np.mean(own), rel=0.02)
    assert np.min(breaks) == pytest.approx(np.min(first), rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("name", KINDS)
def test_capacitance_and_breakdown(name):
    for number in range(3):
        check_electric(*point(name, number))


@pytest.mark.slow
@pytest.mark.parametrize("name", KINDS)
def test_capacitance_and_breakdown_of_all_points(name):
    for number in range(3, POINTS):
        check_electric(*point(name, number))


@pytest.mark.slow
@pytest.mark.parametrize("name", KINDS)
def test_capacitance_and_breakdown_over_positions_of_the_cage(name):
    for number in range(2):
        check_electric(*point(name, number), positions=4)
