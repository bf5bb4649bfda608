"""Every number of a bearing of every kind, at several points together: each point is the bearing alone.

Each run takes every number of all kinds together, and a share of the other tests. ``make thorough`` takes
all of them.
"""

from itertools import product

import numpy as np
import pytest

from tests.helpers.gate import gated
from tests.helpers.kinds_of_bearings import KINDS, OIL, bearing_of, differences, near, numbers_of
from tests.helpers.share import share

# Steps of the numbers between points.
_STEP = 2e-3


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("kind", "key", "values"),
    [
        ("thrust needle", "bearing.roller_length", [7e-3, 7.5e-3, 8e-3]),
        ("tapered pair", "bearing.roller_length", [15e-3, 16e-3]),
        ("thrust ball", "bearing.inner_groove", [0.53, 0.54]),
        ("thrust ball", "bearing.outer_groove", [0.53, 0.54]),
        ("cylindrical", "lubricant.density_c1", [5.5e8, 5.9e8]),
        ("cylindrical", "lubricant.density_c2", [1.3, 1.34, 1.36]),
        ("needle with a coating", "bearing.summits.density", [1e10, 2e10]),
        ("needle with a coating", "bearing.summits.height_deviation", [8e-8, 9e-8]),
        ("needle with a coating", "bearing.coating.thickness", [1e-3, 1.1e-3]),
    ],
)
def test_a_number_that_differs_between_points(kind, key, values):
    assert differences(bearing_of(kind, contacts="formula"), {key: values}) == []


def test_limits_of_the_current_density_are_no_values_of_three_points():
    """A bearing has three published limits, and here as many points."""
    case = bearing_of("thrust needle", contacts="formula")
    assert differences(case, {"discharge.peak_current": [1.0, 2.0, 3.0]}) == []


def test_light_loads_of_elements_are_no_unusual_pressures():
    """The least loaded rollers of the largest load that is too low have some megapascals."""
    case = bearing_of("tapered", contacts="formula")
    loads = {"bearing.radial_load": [3.0, 3000.0], "bearing.axial_load": [1.2, 2000.0]}
    assert differences(case, loads) == []


def test_the_viscosity_of_the_library_is_noted_where_it_is_used():
    case = bearing_of("thrust needle", contacts="formula", lubricant={"base": "paper"})
    assert differences(case, {"lubricant.viscosity": [0.04, 0.039, 0.04]}) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", gated(KINDS, "needle with a coating"))
def test_all_numbers_together(kind):
    """Numbers of points are numbers of elements, limits, tracks and positions of the cage, too."""
    rng = np.random.default_rng(5)
    for contacts, sizes in (("atlas", (1, 2, 3, 4, 8)), ("formula", (3,))):
        case = bearing_of(kind, contacts=contacts)
        for size in (*sizes, case.bearing.elements):
            given = {
                key: near(key, value, rng.uniform(0.0, _STEP, size))
                for key, value in numbers_of(case).items()
            }
            assert differences(case, given, points=[0, size - 1]) == [], (contacts, size)


@pytest.mark.slow
@pytest.mark.parametrize("kind", share(list(KINDS), 4))
def test_each_number(kind):
    case = bearing_of(kind)
    wrong = {}
    for key, value in numbers_of(case).items():
        found = differences(case, {key: near(key, value, np.array([0.0, _STEP]))}, points=[1])
        if found:
            wrong[key] = found
    assert wrong == {}


@pytest.mark.slow
@pytest.mark.parametrize("kind", share(list(KINDS), 2))
def test_points_of_all_regimes_together(kind):
    rng = np.random.default_rng(1)
    case, number = bearing_of(kind), 10
    given = {
        "bearing.composite_rq": 10.0 ** rng.uniform(-8.0, -6.6, number),
        "bearing.inner_speed": 10.0 ** rng.uniform(0.0, 3.2, number),
        "bearing.temperature": rng.uniform(270.0, 400.0, number),
    }
    loads = [key for key in ("radial_load", "axial_load") if key in KINDS[kind]]
    given |= {f"bearing.{key}": 10.0 ** rng.uniform(1.0, 4.3, number) for key in loads}
    assert differences(case, given) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    "kind",
    gated(
        [kind for kind, table in KINDS.items() if "axial_load" in table and "radial_load" in table], "tapered"
    ),
)
def test_points_whose_elements_share_the_load_evenly(kind):
    """Of some of these points all elements carry one load, and of others each carries its own."""
    given = {
        "bearing.radial_load": [0.0, 1.0, 10.0, 1000.0, 0.0, 3000.0],
        "bearing.axial_load": [1000.0, 1000.0, 1000.0, 10.0, 300.0, 3000.0],
    }
    assert differences(bearing_of(kind), given) == []


TAIT = {
    "density_law": "tait",
    "tait_k0_prime": 10.5,
    "tait_k00": 9.2e9,
    "tait_beta_k": 6.1e-3,
    "tait_expansion": 7.7e-4,
    "reference_temperature": 298.15,
}
MURNAGHAN = {key.replace("tait", "murnaghan"): value for key, value in TAIT.items()} | {
    "density_law": "murnaghan"
}
TEMPERATURES = [280.0, 320.0, 360.0]
OILS = {
    "library with a law of temperature": {"base": "fva-3"},
    "library with tables": {"base": "m100"},
    "e-axle fluid": {"base": "e-axle-fluid"},
    "one viscosity": {"base": "paper"},
    "barus": {**OIL, "viscosity_law": "barus", "pressure_viscosity_coefficient": "20 1/GPa"},
    "incompressible": {**OIL, "density_law": "incompressible"},
    "tait": {**OIL, **TAIT},
    "murnaghan": {**OIL, **MURNAGHAN},
    "doolittle": {
        **TAIT,
        "density": 850.0,
        "relative_permittivity": 2.2,
        "viscosity_law": "doolittle",
        "doolittle_viscosity": 0.02,
        "doolittle_b": 4.7,
        "doolittle_r0": 0.66,
        "doolittle_epsilon": -1e-3,
    },
    "yasutomi": {
        "density_law": "dowson-higginson",
        "density_c1": 5.9e8,
        "density_c2": 1.34,
        "density": 850.0,
        "relative_permittivity": 2.2,
        "viscosity_law": "yasutomi",
        "yasutomi_glass_viscosity": 1e12,
        "yasutomi_glass_temperature": 190.0,
        "yasutomi_a1": 190.0,
        "yasutomi_a2": 7e-10,
        "yasutomi_b1": 7e-9,
        "yasutomi_b2": -0.4,
        "yasutomi_c1": 16.0,
        "yasutomi_c2": 24.0,
        "thermal_conductivity_law": "constant",
        "thermal_conductivity": 0.13,
    },
    "tables over temperature": {
        **OIL,
        "permittivity_table": {
            "temperature": TEMPERATURES,
            "relative_permittivity": [2.4, 2.3, 2.2],
        },
        "conductivity_table": {"temperature": TEMPERATURES, "conductivity": [1e-13, 1e-12, 1e-11]},
    },
    "arrhenius": {
        **OIL,
        "conductivity_law": "arrhenius",
        "conductivity": 1e-12,
        "conductivity_activation": 4e4,
        "conductivity_temperature": 313.15,
    },
}


@pytest.mark.slow
@pytest.mark.parametrize(("name", "kind"), share(list(product(OILS, ["deep groove", "cylindrical"])), 3))
def test_each_number_of_an_oil(kind, name):
    discharge = {"dielectric_strength": "15 V/um"}
    case, wrong = bearing_of(kind, lubricant=OILS[name], discharge=discharge), {}
    for key, value in numbers_of(case).items():
        if key.startswith("lubricant"):
            found = differences(case, {key: near(key, value, np.array([0.0, _STEP]))}, points=[1])
            if found:
                wrong[key] = found
    assert wrong == {}
