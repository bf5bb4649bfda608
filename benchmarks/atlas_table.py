"""Table of the atlas from its solved nodes; nodes without a film are filled from their neighbours.

python -m benchmarks.atlas_table FOLDER ATLAS.npz
"""

from __future__ import annotations

import argparse
import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BSpline, make_interp_spline

from benchmarks.atlas_nodes import LINES, POINTS, Axes, rows_of
from ehlectric.arrays import Array, Mask
from ehlectric.film.atlas.atlas_films import REFERENCE, OilGroups, reference_laws
from ehlectric.film.atlas.atlas_groups import Groups
from ehlectric.film.atlas.atlas_problem import TOLERANCE
from ehlectric.film.atlas.atlas_table import HALVED, NAMES
from ehlectric.version import __version__

_CENTRAL, _MINIMUM, _MEAN, _PRESSURE, _ZONE = map(
    NAMES.index, ("central", "minimum", "mean", "pressure", "zone")
)

# Share of solved nodes, over the largest of all planes, above which a plane serves to fill others.
_FULL = 0.75


def fill_between(values: Array, errors: Array, solved: Mask, logs: list[Array]) -> None:
    """Fill nodes between solved ones of a line along an axis, and take them as solved.

    Parameters
    ----------
    values, errors : ndarray, shape (..., n)
        Stored numbers at the nodes and their errors; changed.
    solved : ndarray of bool, shape (...)
        Nodes with a film; changed.
    logs : list of ndarray
        Logarithms of the nodes along each axis.

    Notes
    -----
    The second axis is filled first, then the first one of the planes that are mostly solved, the third, and
    the first one of all others. The numbers are those of a cubic spline through the solved nodes of the line.
    To the errors of the neighbours a fifth of the error is added that a spline through every second solved
    node has.
    """
    _fill_lines(values, errors, solved, logs, 1)
    if solved.ndim == 3:
        full = _full_planes(solved)
        for plane in full:
            at = (slice(None), slice(None), plane)
            _fill_lines(values[at], errors[at], solved[at], logs, 0)
        _fill_planes(values, errors, solved, logs, full)
        _fill_lines(values, errors, solved, logs, 2)
    _fill_lines(values, errors, solved, logs, 0)


def _full_planes(solved: Mask) -> NDArray[np.intp]:
    """Planes of the third axis that are solved for most nodes of the first one."""
    share = solved.mean(axis=(0, 1))
    return np.flatnonzero(share > _FULL * np.max(share))


def _fill_planes(
    values: Array, errors: Array, solved: Mask, logs: list[Array], full: NDArray[np.intp]
) -> None:
    """Fill planes of the third axis that are solved for few nodes of the first one, beside the full ones.

    A spline along the third axis through the other planes is off by little, and this changes slowly along the
    first axis: the difference at the solved nodes is interpolated, and kept beyond the last of them, where it
    is added to the error.
    """
    for plane in np.setdiff1d(np.arange(full[0], full[-1]), full):
        for j in range(solved.shape[1]):
            line, x = (slice(None), j, plane), logs[2]
            around = [np.intersect1d(full, np.flatnonzero(known)) for known in solved[:, j]]
            inside = np.array([known.size > 1 and known[0] < plane < known[-1] for known in around])
            guess = np.zeros_like(values[line])
            for i in np.flatnonzero(inside):
                guess[i] = _spline(x, around[i], values[i, j])(x[plane])
            known = solved[line] & inside
            if np.count_nonzero(known) < 3:
                continue
            off, doubt, filled = values[line] - guess, errors[line].copy(), known.copy()
            _fill_line(logs[0], off, doubt, filled)
            nodes = np.flatnonzero(filled)
            for i in np.flatnonzero(inside & ~solved[line]):
                near = nodes[np.argmin(np.abs(nodes - i))]
                beyond = np.abs(off[near]) if near != i else 0.0
                values[i, j, plane] = guess[i] + off[near]
                errors[i, j, plane] = np.max(errors[i, j, around[i]], axis=0) + doubt[near] + beyond
                solved[i, j, plane] = True


def _fill_lines(values: Array, errors: Array, solved: Mask, logs: list[Array], axis: int) -> None:
    """Fill the nodes between solved ones of all lines along an axis; the arrays are changed."""
    on_lines, off_lines = np.moveaxis(values, axis, 0), np.moveaxis(errors, axis, 0)
    mask = np.moveaxis(solved, axis, 0)
    for at in np.ndindex(*mask.shape[1:]):
        line = (slice(None), *at)
        known = np.flatnonzero(mask[line])
        # Two solved nodes serve for the one ratio of the semi-axes between them.
        if known.size >= 3 or (axis == 2 and known.size == 2 and known[1] - known[0] == 2):
            _fill_line(logs[axis], on_lines[line], off_lines[line], mask[line])


def _fill_line(x: Array, values: Array, errors: Array, solved: Mask) -> None:
    """Fill the nodes of one line between its solved ones; the arrays are changed."""
    known = np.flatnonzero(solved)
    between = np.setdiff1d(np.arange(known[0], known[-1]), known)
    if not between.size:
        return
    every = np.unique(np.append(known[::2], known[-1]))
    missed = np.abs(_spline(x, every, values)(x[known]) - values[known])
    if known.size == 2:
        missed += np.abs(values[known[1]] - values[known[0]])
    # A node of the coarser spline has no difference of its own, but those of its neighbours.
    wide = np.pad(missed, [(1, 1), (0, 0)], mode="edge")
    missed = HALVED * np.maximum(np.maximum(wide[:-2], wide[1:-1]), wide[2:])
    total = make_interp_spline(x[known], errors[known] + missed, 1)
    filled = _spline(x, known, values)(x[between])
    values[between], errors[between], solved[between] = filled, total(x[between]), True


def _spline(x: Array, nodes: NDArray[np.intp], values: Array) -> BSpline:
    return make_interp_spline(x[nodes], values[nodes], min(3, nodes.size - 1))


def extend(values: Array, errors: Array, solved: Mask, wanted: Mask, logs: list[Array]) -> None:
    """Fill wanted nodes at the upper end of a line along the second axis, and take them as solved.

    Parameters
    ----------
    values, errors, solved, logs : as in ``fill_between``
        Arrays of the table; changed.
    wanted : ndarray of bool, shape (...)
        Nodes to fill; those between or below solved ones stay.

    Notes
    -----
    Beyond the largest Hertz pressure that is solved films follow powers. The numbers lie on the parabola
    through the last three solved nodes of the line; twice its difference from the line through the last two
    is added to the error of the last node.
    """
    x = logs[1]
    for i, *rest in np.ndindex(solved.shape[0], *solved.shape[2:]):
        line = (i, slice(None), *rest)
        known = np.flatnonzero(solved[line])
        beyond = np.flatnonzero(wanted[line] & ~solved[line])
        beyond = beyond[beyond > known[-1]] if known.size >= 3 else beyond[:0]
        if beyond.size:
            last = known[-3:]
            curve = make_interp_spline(x[last], values[line][last], 2)(x[beyond])
            straight = make_interp_spline(x[last[1:]], values[line][last[1:]], 1)(x[beyond])
            values[line][beyond] = curve
            errors[line][beyond] = errors[line][last[-1]] + 2.0 * np.abs(curve - straight)
            solved[line][beyond] = True


# Ratio of the semi-axes below which the heaviest contacts are not solved, as their side lobes are too narrow;
# error of what is extrapolated, of all numbers and of the minimum film, for each step of the load by a factor
# of e. Central and minimum films of nodes at N of 2500 that are left out, and extrapolated from 1100, are up
# to 5 and 7 % off; those of two nodes at 5500, from 2500, are 0.1 and 6 % off.
_NARROW, _PER_STEP, _MINIMUM_PER_STEP = 1.0, 0.02, 0.05


def extend_heavy(values: Array, errors: Array, solved: Mask, wanted: Mask, axes: Axes) -> None:
    """Fill wanted nodes beyond the heaviest solved one of wide contacts, and take them as solved.

    Parameters
    ----------
    values, errors, solved, wanted : as in ``extend``
        Arrays of the table; changed.
    axes : Axes
        Nodes of the table.

    Notes
    -----
    Heavy films follow powers of the load: the numbers lie on the line through the last two solved nodes. To
    the error of the last node the difference from the parabola through the last three is added, and a part
    that grows with the distance.
    """
    assert axes.ratio is not None
    x = np.log(axes.load)
    for j, k in np.ndindex(*solved.shape[1:]):
        line = (slice(None), j, k)
        known = np.flatnonzero(solved[line])
        if axes.ratio[k] >= _NARROW or known.size < 3:
            continue
        beyond = np.arange(known[-1] + 1, x.size)
        beyond = beyond[wanted[line][beyond]]
        if beyond.size:
            last = known[-3:]
            curve = make_interp_spline(x[last], values[line][last], 2)(x[beyond])
            straight = make_interp_spline(x[last[1:]], values[line][last[1:]], 1)(x[beyond])
            values[beyond, j, k] = straight
            steps = (x[beyond] - x[last[-1]])[:, np.newaxis]
            errors[beyond, j, k] = errors[line][last[-1]] + np.abs(curve - straight) + _PER_STEP * steps
            errors[beyond, j, k, _MINIMUM] += (_MINIMUM_PER_STEP - _PER_STEP) * steps[:, 0]
            solved[beyond, j, k] = True


def fill_beyond(values: Array, solved: Mask, logs: list[Array]) -> None:
    """Fill all nodes that are left, so that splines have values there: by lines through two solved nodes.

    A table is not read in a cell with such a node; they only support its neighbours.
    """
    known = solved.copy()
    for axis in (1, 0, *range(solved.ndim - 1, 1, -1)):
        lines, mask = np.moveaxis(values, axis, 0), np.moveaxis(known, axis, 0)
        for at in np.ndindex(*mask.shape[1:]):
            line, found = (slice(None), *at), np.flatnonzero(mask[(slice(None), *at)])
            for i in range(mask.shape[0]) if found.size >= 2 else ():
                if not mask[(i, *at)]:
                    a, b = sorted(found, key=lambda node: abs(node - i))[:2]
                    part = (logs[axis][i] - logs[axis][a]) / (logs[axis][b] - logs[axis][a])
                    lines[line][i] = (1.0 - part) * lines[line][a] + part * lines[line][b]
            if found.size >= 2:
                mask[line] = True
    where = np.argwhere(known)
    for node in np.argwhere(~known):
        values[tuple(node)] = values[tuple(where[np.argmin(np.sum((where - node) ** 2, axis=1))])]


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
    peak = max(0.0, numbers[_PRESSURE]) * groups.hertz_number / OilGroups.of(*reference_laws()).alpha
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
        extend_heavy(values, errors, solved, wanted, axes)
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
