"""Table of the atlas from the files of its computation.

python -m ehlectric.atlas.assemble FOLDER ATLAS.npz
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.atlas.coefficient import REFERENCE, OilGroups, reference_laws
from ehlectric.atlas.grids import LINES, POINTS, Axes
from ehlectric.atlas.groups import TOLERANCE, Groups
from ehlectric.atlas.measures import NAMES
from ehlectric.version import __version__

_CENTRAL, _MINIMUM, _MEAN, _PRESSURE = map(NAMES.index, ("central", "minimum", "mean", "pressure"))
_PLACES = NAMES.index("minimum_x")

# Largest relative difference of two grids that is extrapolated to a vanishing node spacing.
_SMALL = 0.2


def stored(groups: Groups, numbers: Array) -> Array:
    """Numbers of ``NAMES`` as the table stores them: logarithms of smooth ratios, and places.

    The central film is stored as a thickness, because rho h has a spike where the pressure has one.
    """
    logs = np.log(np.maximum(numbers[:_PLACES], 1e-12))
    peak = numbers[_PRESSURE] * groups.hertz_number / OilGroups.of(*reference_laws()).alpha
    logs[_CENTRAL] -= float(np.log(reference_laws()[1](np.array([peak]))[0][0]))
    logs[[_MINIMUM, _MEAN]] -= logs[_CENTRAL]
    logs[_CENTRAL] -= np.log(groups.formula)
    return np.concatenate([logs, numbers[_PLACES:]])


def assembled(folder: Path, kind: str, axes: Axes) -> dict[str, Any]:
    """Arrays of one kind of contact: values, errors of discretisation, and solved nodes."""
    values = np.full((*axes.shape, len(NAMES)), np.nan)
    errors = np.zeros_like(values)
    solved = np.zeros(axes.shape, dtype=bool)
    dates, seconds = [], 0.0
    for file in sorted(folder.glob(f"{kind}-*.jsonl")):
        for line in file.read_text(encoding="utf-8").splitlines():
            row = json.loads(line)
            dates.append(row["date"])
            seconds += row["seconds"]
            if row["status"] != "converged" or row["coarse"] is None:
                continue
            at = tuple(row["at"])
            fine, coarse = (stored(axes.groups(at), np.array(row[grid])) for grid in ("fine", "coarse"))
            step = (fine - coarse) / 3.0
            step[_PLACES:] = 0.0
            values[at] = fine + np.where(np.abs(step) < _SMALL / 3.0, step, 0.0)
            errors[at] = np.abs(step)
            solved[at] = True
    fill(values, solved)
    made = {"computed": [min(dates), max(dates)] if dates else [], "seconds": round(seconds)}
    return {"values": values, "errors": errors, "solved": solved, "made": made}


def fill(values: Array, solved: Mask) -> None:
    """Fill nodes that were not solved from the nearest solved ones, so that splines have values there.

    A table is not read in a cell with such a node; they only support its neighbours.
    """
    where = np.argwhere(solved)
    for at in np.argwhere(~solved):
        near = where[np.argmin(np.sum((where - at) ** 2, axis=1))]
        values[tuple(at)] = values[tuple(near)]


def main() -> None:
    """Write the table of all solved nodes, with its provenance."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("table", type=Path)
    chosen = parser.parse_args()
    arrays: dict[str, Any] = {}
    provenance: dict[str, Any] = {
        "version": __version__, "oil": REFERENCE, "tolerance": TOLERANCE, "names": NAMES,
    }  # fmt: skip
    for kind, axes in (("points", POINTS), ("lines", LINES)):
        made = assembled(chosen.folder, kind, axes)
        arrays |= {f"{kind}_values": made["values"].astype(np.float32)}
        arrays |= {f"{kind}_errors": made["errors"].astype(np.float32), f"{kind}_solved": made["solved"]}
        arrays |= {f"{kind}_load": axes.load, f"{kind}_lubricant": axes.lubricant}
        if axes.ratio is not None:
            arrays[f"{kind}_ratio"] = axes.ratio
        provenance[kind] = made["made"] | {"nodes": axes.shape, "solved": int(made["solved"].sum())}
    np.savez_compressed(chosen.table, provenance=json.dumps(provenance), **arrays)


if __name__ == "__main__":
    main()
