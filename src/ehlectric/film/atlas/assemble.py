"""Table of the atlas from the files of its computation.

python -m ehlectric.film.atlas.assemble FOLDER ATLAS.npz
"""

from __future__ import annotations

import argparse
import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.atlas.coefficient import REFERENCE, OilGroups, reference_laws
from ehlectric.film.atlas.compute import rows_of
from ehlectric.film.atlas.fill import extend, fill_between, fill_beyond
from ehlectric.film.atlas.grids import LINES, POINTS, Axes
from ehlectric.film.atlas.groups import TOLERANCE, Groups
from ehlectric.film.atlas.measures import NAMES
from ehlectric.version import __version__

_CENTRAL, _MINIMUM, _MEAN, _PRESSURE, _ZONE = map(
    NAMES.index, ("central", "minimum", "mean", "pressure", "zone")
)
_PLACES = NAMES.index("minimum_x")

# Largest difference of the logarithms of the minimum film on two grids with which a node is taken. Side lobes
# that differ more are not resolved on either grid.
_RESOLVED = 0.3

# Least pressure in the middle that is stored, over the Hertz pressure: beside a spike the spline through the
# nodes of a grid goes below zero, and the density does not depend on lower ones.
_LEAST_PRESSURE = 0.03

# Largest Hertz pressure over 1/alpha of nodes that are extrapolated from lower ones, so that contacts below
# the largest that is solved lie in a cell.
_NEAR = 165.0

# Load group up to which nodes are not extrapolated: the spike of the pressure passes the centre.
_LIGHT = 40.0

# Least share of solved nodes of an outermost plane of the table that is kept.
_LEAST_SHARE = 0.05

# Largest relative difference of two grids that is extrapolated to a vanishing node spacing.
_SMALL = 0.2


def stored(groups: Groups, numbers: Array) -> Array:
    """Numbers of ``NAMES`` as the table stores them: logarithms of smooth ratios, and places.

    The central film is stored as a thickness, because rho h has a spike where the pressure has one. Where
    the spike passes the centre, the central film has a kink. The minimum, the mean and the mean of
    1/(rho h) do not, and are therefore stored without it.
    """
    logs = np.log(np.maximum(numbers[:_PLACES], 1e-12))
    logs[_PRESSURE] = max(logs[_PRESSURE], np.log(_LEAST_PRESSURE))
    peak = numbers[_PRESSURE] * groups.hertz_number / OilGroups.of(*reference_laws()).alpha
    logs[_ZONE] -= logs[_CENTRAL] - np.log(groups.formula)
    logs[_CENTRAL] -= float(np.log(reference_laws()[1](np.array([peak]))[0][0]))
    logs[[_CENTRAL, _MINIMUM, _MEAN]] -= np.log(groups.formula)
    return np.concatenate([logs, numbers[_PLACES:]])


def assembled(folder: Path, kind: str, axes: Axes) -> dict[str, Any]:
    """Arrays of one kind of contact: values, errors of discretisation, and solved nodes."""
    values = np.full((*axes.shape, len(NAMES)), np.nan)
    errors = np.zeros_like(values)
    solved = np.zeros(axes.shape, dtype=bool)
    dates, seconds = [], 0.0
    for at, row in rows_of(folder, kind, axes):
        dates.append(row["date"])
        seconds += row["seconds"]
        if row["status"] == "converged" and row["coarse"] is not None:
            values[at], errors[at], solved[at] = _extrapolated(axes.groups(at), row)
    values[~solved] = 0.0
    number = int(solved.sum())
    logs = [np.log(axis) for axis in axes.nodes]
    fill_between(values, errors, solved, logs)
    if axes.ratio is not None:
        wanted = np.zeros(axes.shape, dtype=bool)
        for at in np.ndindex(*axes.shape):
            wanted[at] = axes.load[at[0]] > _LIGHT and axes.groups(at).hertz_number <= _NEAR
        extend(values, errors, solved, wanted, logs)
    made = {
        "computed": [min(dates), max(dates)] if dates else [], "seconds": round(seconds), "solved": number,
    }  # fmt: skip
    indices = [list(range(size)) for size in solved.shape]
    for axis in reversed(range(solved.ndim)):
        # The ratio first: narrow contacts may not be solved yet.
        indices[axis] = _kept(solved[np.ix_(*indices)], axis)
    kept = np.ix_(*indices)
    values, errors, solved = values[kept], errors[kept], solved[kept]
    nodes = [axis[index.ravel()] for axis, index in zip(axes.nodes, kept, strict=True)]
    fill_beyond(values, solved, [np.log(axis) for axis in nodes])
    return {"values": values, "errors": errors, "solved": solved, "made": made, "nodes": nodes}


def _extrapolated(groups: Groups, row: dict[str, Any]) -> tuple[Array, Array, bool]:
    """Stored numbers at vanishing spacing, their errors, and whether the grids resolve the film."""
    grids = [row["fine"], row["coarse"]] + ([row["coarser"]] if row.get("coarser") else [])
    films = [stored(groups, np.array(grid)) for grid in grids]
    steps = [(finer - coarser) / 3.0 for finer, coarser in pairwise(films)]
    for step in steps:
        step[_PLACES:] = 0.0
    used = np.where(np.abs(steps[0]) < _SMALL / 3.0, steps[0], 0.0)
    # The extrapolated value is better than either grid; half of its step bounds its error. Where a third grid
    # gives nearly the same extrapolated value, an eighth of the step remains at least.
    error = 0.5 * np.abs(steps[0])
    if len(steps) > 1:
        change = 0.5 * np.abs(films[0] + steps[0] - films[1] - steps[1])
        error = np.minimum(error, np.maximum(0.25 * error, change))
    return films[0] + used, error, bool(3.0 * abs(steps[0][_MINIMUM]) < _RESOLVED)


def _kept(solved: Mask, axis: int) -> list[int]:
    """Indices along an axis without its ends where too few nodes are solved."""
    share = solved.mean(axis=tuple(i for i in range(solved.ndim) if i != axis))
    good = np.flatnonzero(share >= _LEAST_SHARE)
    return list(range(int(good[0]), int(good[-1]) + 1))


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
        provenance[kind] = made["made"] | {"nodes": made["solved"].shape}
    np.savez_compressed(chosen.table, provenance=json.dumps(provenance), **arrays)


if __name__ == "__main__":
    main()
