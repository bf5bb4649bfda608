"""Duty cycle of examples/measurements: the WLTC of class 3b at the motor of a car with stated assumptions.

    python -m tests.bearing.duty.wltc_duty

computes the file again from the vehicle speeds in it, as after a change of an assumption.
"""

import math

import numpy as np

from tests.helpers.places import EXAMPLES

FILE = EXAMPLES / "measurements" / "wltc_class_3b_motor.csv"
RATIO, WHEEL, PINION, SHARE, EFFICIENCY = 9.0, 0.317, 0.028, 0.6, 0.97
MASS, ROLLING, DRAG, WEIGHT = 1700.0, 130.0, 0.39, 75.0
COLD, WARM, WARMING = 23.0, 80.0, 600.0

HEAD = f"""\
# WLTC of class 3b (Worldwide harmonized Light vehicles Test Cycle) at the motor of an electric car.
# Vehicle speed: UN Global Technical Regulation No. 15, Annex 1, a row a second, 1800 s, 23.27 km; the numbers
# as in the Python package wltp 0.1.2a0 of the Joint Research Centre of the European Commission.
# All else follows from ASSUMPTIONS, by tests/bearing/duty/wltc_duty.py:
# motor speed: gear ratio {RATIO:g}, wheel radius {WHEEL:g} m;
# torque: mass {MASS:g} kg, resistance {ROLLING:g} N + {DRAG:g} kg/m v^2, efficiency {EFFICIENCY:g};
# radial load: {WEIGHT:g} N of the rotor + {SHARE:g} of the force on a pinion of {1e3 * PINION:g} mm radius,
# pressure angle 20 deg;
# temperature: {COLD:g} degC, where the test begins, to {WARM:g} degC, time constant {WARMING:g} s.
time [s],vehicle speed [km/h],speed [rpm],torque [N m],radial load [N],temperature [degC]
"""


def vehicle_speeds():
    """Speeds of the vehicle [km/h] in the file, a row a second."""
    rows = [line for line in FILE.read_text(encoding="utf-8").splitlines() if line[0].isdigit()]
    return np.array([float(row.split(",")[1]) for row in rows])


def text(speeds):
    """Content of the file for speeds of the vehicle [km/h]."""
    speed, time = speeds / 3.6, np.arange(len(speeds), dtype=float)
    moving = speed > 0.0
    force = np.where(moving, MASS * np.gradient(speed) + ROLLING + DRAG * speed**2, 0.0)
    torque = force * WHEEL / RATIO * np.where(force > 0.0, 1.0 / EFFICIENCY, EFFICIENCY)
    load = WEIGHT + SHARE * np.abs(torque) / PINION / math.cos(math.radians(20.0))
    rpm = speed / WHEEL * RATIO * 30.0 / math.pi
    warm = WARM - (WARM - COLD) * np.exp(-time / WARMING)
    rows = zip(time, speeds, rpm, torque, load, warm, strict=True)
    return HEAD + "".join(f"{t:.0f},{v:.1f},{n:.1f},{m:.1f},{f:.0f},{c:.1f}\n" for t, v, n, m, f, c in rows)


if __name__ == "__main__":
    FILE.write_text(text(vehicle_speeds()), encoding="utf-8")
