"""Circuits simulated by the real ngspice, which reads netlists as a user's simulator does."""

import re
import subprocess

import numpy as np

from tests.helpers.programs import program

_VALUE = re.compile(r"^(?:\w+\.)?(\w+)\s*=\s*(-?\d\.\d+e[+-]\d+)", re.MULTILINE)


def run_netlist(path):
    """Run a file by ngspice in batch mode; its numbers by their names."""
    done = subprocess.run(
        [program("ngspice"), "-b", path.name], cwd=path.parent, capture_output=True, text=True, timeout=300
    )
    output = done.stdout + done.stderr
    assert done.returncode == 0, output
    assert not re.search(r"error|warning|singular|failed|no such", output, re.IGNORECASE), output
    return {name: float(value) for name, value in _VALUE.findall(output)}


def simulate(folder, lines, *commands):
    """Simulate lines of a circuit beside its commands; the numbers that they print, by their names."""
    path = folder / "circuit.cir"
    control = [".control", "set numdgt=12", *commands, "quit 0", ".endc", ".end"]
    path.write_text("\n".join(["* circuit under test", *lines, *control]) + "\n")
    return run_netlist(path)


def waveform(folder, lines, tran, vector):
    """Times [s] and values of a vector in a transient analysis."""
    simulate(folder, lines, tran, "set wr_singlescale", f"wrdata wave {vector}")
    times, values = np.loadtxt(folder / "wave", unpack=True)
    return times, values
