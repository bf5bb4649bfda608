"""Cases of many points of a bearing: arrays for keys, their units, bounds and lengths."""

import numpy as np
import pytest

from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError
from tests.helpers.bearings import BALLS_IN_SI

TABLE = {
    "bearing": BALLS_IN_SI,
    "lubricant": {"base": "iso-vg-46", "relative_permittivity": 2.2},
    "discharge": {"dielectric_strength": 1e7},
    "motor": {
        "common_mode_voltage": 300.0,
        "winding_rotor_capacitance": 5e-11,
        "rotor_frame_capacitance": 1e-9,
        "switching_frequency": 1e4,
        "rise_time": 1e-7,
    },
    "ranges": {"bearing.radial_load": [900.0, 1100.0]},
}
CASE = BearingCase.from_dict(TABLE)


def test_keys_of_all_tables_take_arrays():
    values = {
        "bearing.inner_speed": np.array([100.0, 200.0, 300.0]),
        "bearing.radial_load": ["1 kN", "1500 N", 2e3],
        "lubricant.temperature.kinematic_viscosity_40": [40e-6, 46e-6, 50e-6],
        "lubricant.relative_permittivity": (2.1, 2.2, 2.3),
        "discharge.dielectric_strength": ["10 V/um", "20 V/um", "30 V/um"],
        "motor.common_mode_voltage": np.array([300, 310, 320]),
    }
    many = CASE.with_arrays(values)
    assert many.shape == (3,)
    assert set(many.arrays()) == set(values)
    assert many.bearing.radial_load.tolist() == [1000.0, 1500.0, 2000.0]
    assert many.discharge.dielectric_strength.tolist() == [1e7, 2e7, 3e7]
    assert many.bearing.temperature == CASE.bearing.temperature
    assert CASE.shape == ()


def test_one_point_is_the_case_with_its_numbers():
    values = {"bearing.inner_speed": np.array([100.0, 250.0]), "lubricant.roelands_z": np.array([0.6, 0.65])}
    many = CASE.with_arrays(values)
    alone = many.single(1)
    assert alone == CASE.replace({"bearing.inner_speed": 250.0, "lubricant.roelands_z": 0.65})
    assert alone.shape == ()


def test_arrays_replace_alternatives():
    """A viscosity at 40 degC takes the place of the grade, and one of all temperatures that of the sheet."""
    many = CASE.with_arrays({"lubricant.temperature.kinematic_viscosity_40": [46e-6, 68e-6]})
    assert many.lubricant.temperature.iso_vg is None
    given = {"lubricant.viscosity": [0.02, 0.03], "lubricant.pressure_viscosity_coefficient": [1e-8, 2e-8]}
    paper = CASE.replace({"lubricant.base": "paper", "lubricant.relative_permittivity": 2.2})
    assert paper.with_arrays(given).lubricant.pressure_viscosity_coefficient.tolist() == [1e-8, 2e-8]


def test_a_range_of_an_array_is_left_out():
    assert CASE.ranges is not None
    assert CASE.with_arrays({"bearing.radial_load": [500.0, 2000.0]}).ranges is None


def test_arrays_are_copies_that_cannot_be_changed():
    given = np.array([100.0, 200.0])
    many = CASE.with_arrays({"bearing.inner_speed": given})
    given[0] = -1.0
    assert many.bearing.inner_speed[0] == 100.0
    with pytest.raises(ValueError, match="read-only"):
        many.bearing.inner_speed[0] = 1.0


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"bearing.radial_load": [1.0, -2.0, -3.0]}, r"^bearing\.radial_load: got -2\.0.* 0.*index 1"),
        ({"bearing.radial_load": np.array([1.0, 2.0, -3.0])}, r"^bearing\.radial_load: .*-3.*index 2"),
        ({"bearing.radial_load": np.array([1.0, np.nan])}, r"^bearing\.radial_load: .*nan.*index 1"),
        ({"bearing.radial_load": ["1 kN", "2 kV"]}, r"^bearing\.radial_load: got '2 kV'.*index 1"),
        ({"bearing.inner_speed": np.array([3000, 4000])}, r"^bearing\.inner_speed: .*3000.* rpm.*index 0"),
        ({"bearing.temperature": np.array([343.15, 70])}, r"^bearing\.temperature: got .*70.*index 1"),
        (
            {"bearing.radial_load": [1.0, 2.0], "bearing.inner_speed": [1.0]},
            r"inner_speed: got 1 .* 2, as many",
        ),
        ({"bearing.radial_lod": [1.0]}, r"^bearing\.radial_lod: unknown key.*radial_load"),
        ({"bearing.elements": [8, 9]}, r"^bearing\.elements: .*one value for all points"),
        ({"bearing.film_factor": [0.5, 0.6]}, r"^bearing\.film_factor: .*one value for all points"),
        ({"contacts": ["atlas", "formula"]}, r"^contacts: .*one value for all points"),
        ({"discharge.outlet": ["full"]}, r"^discharge\.outlet: .*one value for all points"),
        ({"bearing.fits": [1.0]}, r"^bearing\.fits: is a table"),
        ({"bearing.radial_load": 1000.0}, r"^bearing\.radial_load: got 1000\.0; expected an array"),
        ({"bearing.radial_load": "1 kN"}, r"^bearing\.radial_load: got '1 kN'; expected an array"),
        ({"bearing.radial_load": [[1.0]]}, r"^bearing\.radial_load: got \[1\.0\].*index 0"),
        ({"bearing.radial_load": np.ones((2, 2))}, r"^bearing\.radial_load: .* expected an array"),
        ({"bearing.radial_load": []}, r"^bearing\.radial_load: .* expected an array"),
        ({}, "at least one key"),
    ],
)
def test_wrong_arrays(values, message):
    with pytest.raises(InputError, match=message):
        CASE.with_arrays(values)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"bearing.radial_load": [1.0, 0.0]}, r"^bearing\.radial_load: missing.*index 1"),
        ({"bearing.bore": [0.04, 0.05, 0.03]}, r"^bearing\.bore: .*inner raceway.*index 1"),
        ({"motor.rise_time": [1e-7, 1e-7, 2e-4]}, r"^motor\.rise_time: .*index 2"),
    ],
)
def test_rules_between_keys(values, message):
    with pytest.raises(InputError, match=message):
        CASE.with_arrays(values)


def test_a_class_of_clearance_has_one_bore():
    case = CASE.replace({"bearing.clearance_class": "C3"})
    with pytest.raises(InputError, match=r"^bearing\.bore: .*'C3'"):
        case.with_arrays({"bearing.bore": [0.04, 0.041]})
    assert case.with_arrays({"bearing.radial_clearance": [1e-5, 2e-5]}).bearing.clearance_class is None


def test_a_case_of_many_points_has_no_file():
    many = CASE.with_arrays({"bearing.radial_load": [1.0, 2.0]})
    assert repr(many) == "<BearingCase 6208, 2 points>"
    for write in (many.to_dict, many.to_toml):
        with pytest.raises(InputError, match=r"^bearing\.radial_load: got an array"):
            write()
    with pytest.raises(InputError, match="a case of one point"):
        many.with_arrays({"bearing.inner_speed": [1.0, 2.0]})


@pytest.mark.slow
def test_pint_quantities_keep_their_units():
    pint = pytest.importorskip("pint")
    unit = pint.get_application_registry()
    many = CASE.with_arrays({"bearing.radial_load": np.array([1.0, 2.0]) * unit.kN})
    assert many.bearing.radial_load.tolist() == [1000.0, 2000.0]
