"""Measurements as data files: values with source, licence, conditions, uncertainty and how they were read."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd

from tests.helpers.places import MEASURED

# Lines of the header that every data file has; ``inputs`` stands where the program needs values of others.
NEEDED = ("source", "licence", "conditions", "uncertainty", "read")


@dataclass(frozen=True)
class Reference:
    """Measured values with the lines of their header.

    Attributes
    ----------
    table : pandas.DataFrame
        Measured values, in the units that the header gives.
    header : dict of str
        Lines of the header by their names.
    """

    table: pd.DataFrame
    header: dict[str, str]

    def column(self, name):
        """Values of a column as an array."""
        return self.table[name].to_numpy()


def load(name):
    """Data file ``name`` of ``tests/data/measured``, without its suffix."""
    path = MEASURED / f"{name}.csv"
    lines = [line[1:] for line in path.read_text("utf-8").splitlines() if line.startswith("#")]
    header = {key.strip(): text.strip() for key, _, text in (line.partition(":") for line in lines)}
    return Reference(pd.read_csv(path, comment="#"), header)


def film_log(temperature):
    """Rolling speeds [m/s] and logged films [nm] of the rig's log at a temperature, as in "40C"."""
    text = (MEASURED / "ploss_demo_12.txt").read_text("utf-8-sig")
    _, _, step = text.partition(f'"Film step {temperature}" started')
    rows = [line.split("\t")[:2] for line in step.split("\n\nStep ")[0].splitlines()[3:]]
    values = np.array([[float(value) for value in row] for row in rows if len(row) == 2])
    return values[:, 0] / 1000.0, values[:, 1]


def zero_checks(temperature):
    """Films [nm] that the rig logged at rest after the speeds of a temperature; they should be zero."""
    text = (MEASURED / "ploss_demo_12.txt").read_text("utf-8-sig")
    steps = text.split(f'"Zero check step {temperature} ')[1:]
    return [float(step.split("Film thickness = ")[1].split(" nm")[0]) for step in steps]


def exponent(speed, film):
    """Exponent of the film over the speed, by least squares of the logarithms."""
    return float(np.polyfit(np.log(speed), np.log(film), 1)[0])
