"""Value to whose spread the inputs of a Sobol design are ranked."""

from ehlectric.sweep.sweep_inputs import main_value, ranked_value
from tests.helpers.bearings import BALLS, bearing_case


def test_a_bearing_with_a_motor_is_ranked_by_its_margin():
    """The capacitances of the motor change the shaft voltage and no breakdown voltage."""
    case = bearing_case(BALLS).replace({"discharge.dielectric_strength": "15 V/um"})
    table = {key: value for key, value in case.to_dict().items() if key != "motor"}
    alone = type(case).from_dict(table)
    motor = {"common_mode_voltage": "300 V", "winding_rotor_capacitance": "20 pF"}
    driven = alone.replace(motor=motor | {"rotor_frame_capacitance": "1 nF"})
    assert (ranked_value(driven), ranked_value(alone)) == ("bearing.margin", "bearing.first_break")
    assert main_value(driven) == "bearing.first_break"
