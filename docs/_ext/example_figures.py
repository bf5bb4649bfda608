"""Figures of examples, which the landing page and the guide show, as the commands draw them."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

import ehlectric

_MEASURED = ("--measured", "measurements/bearing_6208_capacitance.csv", "--background", "12 pF")

# Arguments of the command in the folder of the examples, and the figures that are shown, by folder.
_RUNS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "bearing_6208": (
        ("bearing", "bearing_6208.toml"),
        ("breakdown_over_speed.png", "bearing_loads.png", "bearing_circuit.png"),
    ),
    "compared": (
        ("bearing", "bearing_6208.toml", "--contacts", "formula", *_MEASURED),
        ("measured_and_computed.png",),
    ),
    "calibration": (("calibrate", "bearing_measured.toml"), ("calibration.png",)),
    "duty_wltc": (("bearing", "duty_wltc.toml"), ("bearing_duty.png",)),
    "duty_gear": (("gear", "duty_gear.toml"), ("gear_duty.png",)),
    "duty_drive": (("drive", "duty_drive.toml"), ("drive_duty.png",)),
    "drive": (
        ("drive", "drive.toml"),
        (
            *("drive_voltages.png", "drive_histogram.png", "drive_spectrum.png"),
            *("drive_discharges.png", "drive_remedies.png"),
        ),
    ),
    "belt_drive": (("drive", "belt_drive.toml"), ("drive_forces.png",)),
    "e_axle": (("drive", "e_axle.toml"), ("axle_network.png", "axle_forces.png", "axle_remedies.png")),
    "oil_contact": (("run", "oil_contact.toml"), ("meter.png",)),
    "hot_contact": (("run", "hot_contact.toml"), ("temperature.png",)),
    "breakdown_probability_map": (
        ("sweep", "breakdown_probability_map.toml"),
        ("map_uncertainty.breakdown_probability.png",),
    ),
    "gear_map": (("sweep", "gear_map.toml"), ("map_mesh.contact_time_share.png",)),
    "e_axle_map": (("sweep", "e_axle_map.toml"), ("map_first.element.png",)),
    "traction_curve": (("sweep", "traction_curve.toml"), ("lines_film.traction_coefficient.png",)),
}

# Arguments of a second command, which draws figures in the folder that the first one wrote.
_THEN = {
    "breakdown_probability_map": (
        *("--x", "bearing.inner_speed", "--y", "bearing.temperature"),
        *("--value", "uncertainty.breakdown_probability"),
    ),
    "gear_map": (
        *("--x", "gear.operation.pinion_speed", "--y", "gear.operation.pinion_torque"),
        *("--value", "mesh.contact_time_share"),
    ),
    "e_axle_map": ("--x", "drive.speed", "--y", "drive.torque", "--value", "first.element"),
    "traction_curve": (
        *("--x", "contact.slide_to_roll_ratio", "--y", "film.thermal"),
        *("--value", "film.traction_coefficient"),
    ),
}


def _write(app: Sphinx) -> None:
    """Run the commands as a user does, where the code or an example is newer than the figures."""
    examples = Path(app.srcdir).parent / "examples"
    sources = [*examples.rglob("*.*"), *Path(ehlectric.__file__).parent.rglob("*.py")]
    newest = max(path.stat().st_mtime for path in sources)
    for name, (arguments, shown) in _RUNS.items():
        folder = Path(app.srcdir) / "_generated" / name
        if all((folder / file).exists() and (folder / file).stat().st_mtime > newest for file in shown):
            continue
        shutil.rmtree(folder, ignore_errors=True)
        command = [sys.executable, "-m", "ehlectric", *arguments, "-o", str(folder), "--quiet"]
        done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=examples)
        if not done.returncode and name in _THEN:
            drawing = [sys.executable, "-m", "ehlectric", "map", str(folder), *_THEN[name], "--quiet"]
            done = subprocess.run(drawing, capture_output=True, text=True, check=False, cwd=examples)
        missing = [file for file in shown if not (folder / file).exists()]
        if done.returncode or missing:
            raise ExtensionError(f"figures of {name} {missing}: status {done.returncode}, {done.stderr}")


def setup(app: Sphinx) -> dict[str, Any]:
    """Drawn before anything is read."""
    app.connect("builder-inited", _write, priority=100)
    return {"parallel_read_safe": True}
