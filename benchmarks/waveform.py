"""Reading and resampling of a waveform of ten million samples: python -m benchmarks.waveform [SAMPLES]

A file of "time,value" lines is written into a folder for temporary files, read, and resampled to larger
steps. Seconds are of the processor; the memory is the largest that the process had. For comparison, the time
in which Python splits the lines of the same file at their commas.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from ehlectric.drive.measured_source import resample
from ehlectric.drive.waveform.waveform_file import read_waveform

# Sampling interval [s] and samples that are written at once.
STEP, CHUNK = 4e-9, 100_000


def write(path: Path, count: int) -> None:
    """Staircase of an inverter with noise, in a file of two columns."""
    rng = np.random.default_rng(0)
    with path.open("w") as file:
        file.write("Time (s),CH1 (V)\n")
        for begin in range(0, count, CHUNK):
            k = np.arange(begin, min(begin + CHUNK, count))
            values = 300.0 * np.rint(2.0 * np.sin(k / 7770.0)) / 2.0 + rng.normal(size=k.size)
            rows = zip((k * STEP - 1e-3).tolist(), values.tolist(), strict=True)
            file.write("".join(f"{at:.8e},{value:.3f}\n" for at, value in rows))


def peak() -> float:
    """Largest memory of this process so far [MB]."""
    status = Path("/proc/self/status").read_text()
    return 1024 * int(status.partition("VmHWM:")[2].split()[0]) / 1e6


def split(path: Path) -> None:
    """Split all lines, as a reader without a parser of its own does first."""
    with path.open() as file:
        for line in file:
            line.split(",")


def seconds(work, *arguments):
    began = time.process_time()
    found = work(*arguments)
    return found, time.process_time() - began


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000_000
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scope.csv"
        write(path, count)
        print(f"{count} samples, {path.stat().st_size / 1e6:.0f} MB; program {peak():.0f} MB")
        (waveform, warnings), reading = seconds(read_waveform, path)
        print(f"read in {reading:.2f} s, peak {peak():.0f} MB; {[warning.code for warning in warnings]}")
        _, splitting = seconds(split, path)
        print(f"Python splits its lines in {splitting:.2f} s")
        for step in (1e-6, 1.3e-8):
            coarse, filtering = seconds(resample, waveform, step)
            print(
                f"resampled to {step:g} s ({coarse.values.size}) in {filtering:.2f} s, peak {peak():.0f} MB"
            )
