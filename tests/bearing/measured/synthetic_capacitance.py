"""Synthetic measurement of examples/measurements: the model at a known film factor, with noise.

    python -m tests.bearing.measured.synthetic_capacitance

writes the file again, as after a change of the model.
"""

import math

import numpy as np

from ehlectric.bearing.measured_capacitance import OperatingPoint
from ehlectric.cases.bearing_case import BearingCase
from tests.helpers.places import EXAMPLES

FILE = EXAMPLES / "measurements" / "bearing_6208_capacitance.csv"
FACTOR, BACKGROUND, NOISE, SEED = 0.7, 12e-12, 0.02, 17
SPEEDS = (1000, 1300, 1800, 2500, 3500, 4500, 6000, 8000)

HEAD = f"""\
# SYNTHETIC, not measured: computed by ehlectric for examples/bearing_6208.toml with contacts by formula,
# a film factor of {FACTOR}, {1e12 * BACKGROUND:g} pF in parallel, {100 * NOISE:g} % of noise (seed {SEED}).
# Written by tests/bearing/measured/synthetic_capacitance.py.
speed [rpm],capacitance [pF],uncertainty [%]
"""


def text():
    """Content of the file."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "formula"})
    rng = np.random.default_rng(SEED)
    lines = [HEAD]
    for speed in SPEEDS:
        point = OperatingPoint.of(case, {"bearing.inner_speed": speed * math.pi / 30.0})
        value = (point.at(FACTOR).capacitance + BACKGROUND) * (1.0 + NOISE * rng.standard_normal())
        lines.append(f"{speed},{1e12 * value:.1f},{100 * NOISE:g}\n")
    return "".join(lines)


if __name__ == "__main__":
    FILE.write_text(text(), encoding="utf-8")
