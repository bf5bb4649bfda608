"""Axles for tests: a shaft alone, and the e-axle with two stages whose loads a separate program computed."""

from ehlectric import AxleCase
from tests.helpers.places import EXAMPLES

SOURCE = {
    "dc_link": "900 V",
    "modulation": "space-vector",
    "switching_frequency": "10 kHz",
    "fundamental_frequency": "200 Hz",
    "modulation_index": 0.6,
    "rise_time": "100 ns",
}
CIRCUIT = {"winding_rotor_capacitance": "100 pF", "rotor_frame_capacitance": "1 nF"}
BEARING = {"base": "6208", "radial_clearance": "10 um", "composite_rq": "0.03 um"}

# Rotor with given loads, without gears.
ALONE = {
    "drive": {"speed": "6000 rpm", "torque": "30 N m", "temperature": "60 degC"},
    "shaft": [{"name": "rotor", "rotor": True}],
    "bearing": [
        {"shaft": "rotor", "at": "0 mm", "radial_load": "800 N", "axial_load": "100 N", **BEARING},
        {"shaft": "rotor", "at": "80 mm", "radial_load": "400 N", **BEARING},
    ],
    "source": SOURCE,
    "circuit": CIRCUIT,
    "lubricant": {"base": "fva-3"},
    "discharge": {"dielectric_strength": "15 V/um"},
}


def two_stages(**changes):
    """E-axle of the examples."""
    case = AxleCase.from_toml(EXAMPLES / "e_axle.toml")
    return case.replace(changes) if changes else case
