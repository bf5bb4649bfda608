"""Test bench of a bearing's subcircuit: the common-mode voltage and the capacitances of a motor."""

from __future__ import annotations

from collections.abc import Iterator

from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.bearings.motor import Motor
from ehlectric.drive.spice.subcircuit import Subcircuit
from ehlectric.drive.spice.text import SIGNATURE, Parameter, comment
from ehlectric.errors import InputError
from ehlectric.quantities.units import rpm
from ehlectric.version import __version__

# Number of periods of the inverter that are simulated, and of steps in an edge and in a period.
_PERIODS, _IN_EDGE, _IN_PERIOD = 4, 20, 20000

_ABOUT = (
    "common-mode voltage as a square wave between plus and minus its peak, from 0 V at the start, at the "
    "switching frequency of the inverter and with its edges, over winding and rotor to the shaft; replace it "
    "by your own waveform as a PWL source"
)


def drive_of(case: BearingCase) -> Motor:
    """Table ``[motor]`` of a bearing with all that a test bench needs.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing.

    Returns
    -------
    Motor
        Table with a switching frequency and a rise time.

    Raises
    ------
    InputError
        If the case has no motor, a key is missing, or an edge lasts half a period.
    """
    motor = case.motor
    if motor is None:
        raise InputError.missing("motor", "a table, for the drive of the test bench")
    for key in ("switching_frequency", "rise_time"):
        if getattr(motor, key) is None:
            raise InputError.missing(f"motor.{key}", "a value, for the voltage of the test bench")
    assert motor.switching_frequency is not None and motor.rise_time is not None
    half = 0.5 / motor.switching_frequency
    if motor.rise_time >= half:
        raise InputError(
            "motor.rise_time",
            got=f"{motor.rise_time:g} s",
            takes=f"less than {half:.3g} s, half a period of motor.switching_frequency",
        )
    return motor


def bench_lines(subcircuit: Subcircuit, library: str) -> Iterator[str]:
    """Lines of a test bench that simulates some periods of the inverter.

    Parameters
    ----------
    subcircuit : Subcircuit
        Subcircuit of the bearing.
    library : str
        Path of its file, relative to the test bench.

    Yields
    ------
    str
        Lines of the file; the first one is its title.

    Raises
    ------
    InputError
        As ``drive_of`` raises it.
    """
    motor, name = drive_of(subcircuit.case), subcircuit.name
    yield f"{SIGNATURE}test bench of {name}; ehlectric {__version__}"
    yield from comment(f"title: {subcircuit.case.title or '(none)'}")
    yield from comment(_ABOUT)
    yield f'.include "{library}"'
    for parameter in _parameters(subcircuit, motor):
        yield f".param {parameter.line}"
    wave = "{t_rise} {t_rise} {0.5/f_switch-t_rise} {1/f_switch}"
    yield f"V_upper winding middle PULSE(0 {{V_peak}} 0 {wave})"
    yield f"V_lower middle 0 PULSE(0 {{-V_peak}} {{0.5/f_switch}} {wave})"
    yield "C_wr winding shaft {C_wr}"
    yield "C_rf shaft 0 {C_rf}"
    speed = " speed={n_shaft}" if subcircuit.tabulated else ""
    yield "* the current of V_bearing is that of the bearing at the drive end"
    yield "V_bearing shaft inner 0"
    yield f"X_drive_end inner 0 {name}{speed}"
    yield from _second(subcircuit, motor, speed)
    yield f".param t_step={{max(t_rise/{_IN_EDGE},1/f_switch/{_IN_PERIOD})}} ; s, largest step"
    yield f".tran {{t_step}} {{{_PERIODS}/f_switch}} 0 {{t_step}}"
    yield ".meas tran common_mode_peak_to_peak PP V(winding)"
    yield ".meas tran shaft_peak_to_peak PP V(shaft)"
    yield ".meas tran shaft_highest MAX V(shaft)"
    yield ".meas tran shaft_lowest MIN V(shaft)"
    yield ".meas tran current_highest MAX I(V_bearing)"
    yield ".meas tran current_lowest MIN I(V_bearing)"
    yield ".end"


def _parameters(subcircuit: Subcircuit, motor: Motor) -> Iterator[Parameter]:
    """Parameters of the drive, from the table ``[motor]``."""
    assert motor.switching_frequency is not None and motor.rise_time is not None
    yield Parameter("V_peak", motor.common_mode_voltage, "V", "motor.common_mode_voltage, peak")
    yield Parameter("f_switch", motor.switching_frequency, "Hz", "motor.switching_frequency")
    yield Parameter("t_rise", motor.rise_time, "s", "motor.rise_time, of an edge")
    yield Parameter("C_wr", motor.winding_rotor_capacitance, "F", "motor.winding_rotor_capacitance")
    yield Parameter("C_rf", motor.rotor_frame_capacitance, "F", "motor.rotor_frame_capacitance")
    if motor.second_bearing_capacitance is not None:
        yield Parameter("C_second", motor.second_bearing_capacitance, "F", "motor.second_bearing_capacitance")
    if subcircuit.tabulated:
        yield Parameter("n_shaft", rpm(subcircuit.case.bearing.inner_speed), "rpm", "bearing.inner_speed")


def _second(subcircuit: Subcircuit, motor: Motor, speed: str) -> Iterator[str]:
    """Bearing at the other end: one like this one, or its given capacitance, which does not break down."""
    if motor.second_bearing_capacitance is None:
        yield f"X_other_end shaft 0 {subcircuit.name}{speed}"
        return
    yield "C_second shaft 0 {C_second}"
    resistance = subcircuit.default.resistance
    if subcircuit.default.state == "films" and resistance is not None:
        # The same oil: the same relaxation time as that of the first bearing.
        yield "* the other bearing has the same oil, and leaks with the same time constant"
        leak = resistance * subcircuit.default.capacitance / motor.second_bearing_capacitance
        yield f".param {Parameter('R_second', leak, 'Ohm', 'leak through the oil of the other bearing').line}"
        yield "R_second shaft 0 {R_second}"
