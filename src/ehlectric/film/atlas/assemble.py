"""Table of the atlas from the files of its computation.

python -m ehlectric.film.atlas.assemble FOLDER ATLAS.npz
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.atlas.coefficient import REFERENCE, OilGroups, reference_laws
from ehlectric.film.atlas.grids import LINES, POINTS, Axes
from ehlectric.film.atlas.groups import TOLERANCE, Groups
from ehlectric.film.atlas.measures import NAMES
from ehlectric.version import __version__

_CENTRAL, _MINIMUM, _MEAN, _PRESSURE = map(NAMES.index, ("central", "minimum", "mean", "pressure"))
_PLACES = NAMES.index("minimum_x")

# Largest load group of points in the table. Beyond, 513 nodes do not resolve the side lobes, and the minimum
# film is up to 20 % too thin on both grids.
_MOST_LOAD = 5000.0

# Least share of solved nodes of an outermost plane of the table that is kept.
_LEAST_SHARE = 0.5

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
            at = tuple(row["at"])
            unresolved = axes.ratio is not None and axes.load[at[0]] > _MOST_LOAD
            if row["status"] != "converged" or row["coarse"] is None or unresolved:
                continue
            fine, coarse = (stored(axes.groups(at), np.array(row[grid])) for grid in ("fine", "coarse"))
            step = (fine - coarse) / 3.0
            step[_PLACES:] = 0.0
            values[at] = fine + np.where(np.abs(step) < _SMALL / 3.0, step, 0.0)
            # The extrapolated value is better than either grid; half of its step bounds its error.
            errors[at] = 0.5 * np.abs(step)
            solved[at] = True
    fill(values, solved)
    made = {"computed": [min(dates), max(dates)] if dates else [], "seconds": round(seconds)}
    indices = [list(range(size)) for size in solved.shape]
    for axis in reversed(range(solved.ndim)):
        # The ratio first: narrow contacts may not be solved yet.
        indices[axis] = _kept(solved[np.ix_(*indices)], axis)
    kept = np.ix_(*indices)
    values, errors, solved = values[kept], errors[kept], solved[kept]
    fill(values, solved)
    nodes = [axis[index.ravel()] for axis, index in zip(axes.nodes, kept, strict=True)]
    return {"values": values, "errors": errors, "solved": solved, "made": made, "nodes": nodes}


def _kept(solved: Mask, axis: int) -> list[int]:
    """Indices along an axis without its ends where less than half of the nodes are solved."""
    share = solved.mean(axis=tuple(i for i in range(solved.ndim) if i != axis))
    good = np.flatnonzero(share >= _LEAST_SHARE)
    return list(range(int(good[0]), int(good[-1]) + 1))


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
        for name, nodes in zip(("load", "lubricant", "ratio"), made["nodes"], strict=False):
            arrays[f"{kind}_{name}"] = nodes
        provenance[kind] = made["made"] | {"nodes": made["solved"].shape, "solved": int(made["solved"].sum())}
    np.savez_compressed(chosen.table, provenance=json.dumps(provenance), **arrays)


if __name__ == "__main__":
    main()
