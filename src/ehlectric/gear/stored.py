"""Stored form of a gear pair's result, gear.nc: its variables in SI units, and the solution of such a file.

A file contains the case, the loads and films on the lines of contact, and the films at the points A to E. The
geometry follows from the case in closed form.
"""

from __future__ import annotations

import json
import math
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.bearing import StoredDuty, Stretch, UncertainInput
from ehlectric.cases.gear_case import GearCase
from ehlectric.gear.contact_lines import PlaneOfAction
from ehlectric.gear.contact_path import POINTS
from ehlectric.gear.flank_films import FlankFilms
from ehlectric.gear.flank_oil import flank_oils
from ehlectric.gear.load_sharing import LineLoads
from ehlectric.gear.mesh_duty import MeshDuty, MeshRows
from ehlectric.gear.solution import GearSolution, OperatingPair
from ehlectric.gear.uncertainty import MeshUncertainty, Spread
from ehlectric.runtime.file_rules import UnfitError, case_of, is_list, is_text, json_of, number_of, text_of
from ehlectric.runtime.netcdf import Layout
from ehlectric.runtime.stored import (
    Part,
    check_parts,
    many_numbers_of,
    numbers_of,
    read_many_numbers,
    read_numbers,
    values_of,
)

if TYPE_CHECKING:
    import xarray as xr

# Name and version of the layout of gear.nc.
SCHEMA = "ehlectric.gear.result/1"

_NODE, _POINT = ("node",), "point"
_SOLUTION, _LOADS = Part(GearSolution), Part(LineLoads)
# Places of the films are the places of the loads.
_FILMS = Part(FlankFilms, prefix="film_", axes={"place": _NODE})
_POINT_FILMS = Part(FlankFilms, prefix="point_", axes={"place": (_POINT,)})
# Attribute with the numbers of the distribution of the margin, and first letters of the names of its points.
_UNCERTAINTY = "uncertainty"
_DUTY = StoredDuty(MeshDuty, MeshRows, {"stretches": Stretch})
_SPREAD = Part(MeshUncertainty, prefix=f"{_UNCERTAINTY}_")
_PARTS = (_SOLUTION, _LOADS, _FILMS, _POINT_FILMS)

# Rounding of nodes that are computed again from the case [m].
_ROUNDING = 1e-9


def layout_of(
    solution: GearSolution,
    seconds: float,
    version: str,
    *,
    spread: Spread | None = None,
    duty: MeshDuty | None = None,
) -> Layout:
    """Variables and attributes of a gear.nc, SI units, from which ``solution_of`` makes an equal solution.

    ``spread``, distribution of the margin of a result with a probability of breakdown; ``duty``, its duty
    cycle.
    """
    return Layout(
        {
            **_SOLUTION.written(solution),
            **_LOADS.written(solution.loads),
            **_FILMS.written(solution.films),
            **_POINT_FILMS.written(solution.point_films),
            **_DUTY.variables(duty),
            **({} if spread is None or spread.points is None else _SPREAD.written(spread.points)),
            _POINT: (_POINT, list(POINTS)),
        },
        {
            "schema": SCHEMA,
            "version": version,
            "case": solution.case.to_toml(),
            "seconds": seconds,
            "probable": int(spread is not None),
            **_DUTY.attributes(duty),
            **_spread_attributes(spread),
        },
        storage={name: {"compression": "gzip"} for name in (*_FILMS.rules, "capacitance_of_lines")},
    )


def solution_of(dataset: xr.Dataset) -> tuple[GearSolution, float, str]:
    """Solution, computing time [s] and version of a dataset of ``layout_of``. Raises UnfitError where a
    variable or an attribute is missing, or is not as it was written.
    """
    attributes = dataset.attrs
    case = case_of(attributes, GearCase.from_dict)
    check_parts(dataset, _PARTS)
    if dataset.sizes[_POINT] != len(POINTS):
        raise UnfitError(f"it has {dataset.sizes[_POINT]} values along {_POINT}, not {len(POINTS)}")
    values, at = values_of(dataset), OperatingPair.of(case)
    loads = LineLoads(**_LOADS.read(values))
    _check_nodes(at.plane, loads)
    solution = GearSolution(
        case=case,
        pair=at.pair,
        plane=at.plane,
        flanks=at.flanks(case, flank_oils(case.lubricant, np.array([at.bulk_temperature])).each[0]),
        loads=loads,
        films=FlankFilms(**_FILMS.read(values)),
        point_films=FlankFilms(**_POINT_FILMS.read(values)),
        bulk_temperature=at.bulk_temperature,
        stiffness=at.stiffness,
        **_SOLUTION.read(values),
    )
    return solution, number_of(attributes, "seconds"), text_of(attributes, "version")


def _spread_attributes(spread: Spread | None) -> dict[str, str]:
    """Attributes with the numbers and the inputs of a distribution, or with the reason for which there is
    none.
    """
    if spread is None:
        return {}
    points, names = spread.points, _UNCERTAINTY
    if points is None:
        return {f"{names}_missing": spread.missing}
    return {
        names: numbers_of(points),
        f"{names}_inputs": many_numbers_of(points.inputs),
        f"{names}_left_out": json.dumps(points.left_out),
    }


def spread_of(dataset: xr.Dataset) -> Spread | None:
    """Distribution of the margin in a dataset of ``layout_of``. Raises UnfitError as ``duty_of`` does.

    None if the result has no probability, or if an earlier version wrote the file without its points.
    """
    attributes = dataset.attrs
    if f"{_UNCERTAINTY}_missing" in attributes:
        return Spread(None, text_of(attributes, f"{_UNCERTAINTY}_missing"))
    if _UNCERTAINTY not in attributes:
        return None
    check_parts(dataset, [_SPREAD])
    texts = partial(is_list, right=is_text)
    inputs = read_many_numbers(UncertainInput, attributes, f"{_UNCERTAINTY}_inputs")
    shares = ("first_order", "total")
    numbers = read_numbers(MeshUncertainty, attributes, _UNCERTAINTY)
    return Spread(
        MeshUncertainty(
            **_SPREAD.read(values_of(dataset)),
            **{**numbers, "predicted": _or_nan(numbers["predicted"])},
            inputs=tuple(
                UncertainInput(**{**row, **{name: _or_nan(row[name]) for name in shares}}) for row in inputs
            ),
            left_out=tuple(json_of(attributes, f"{_UNCERTAINTY}_left_out", texts)),
        )
    )


def _or_nan(value: float | None) -> float:
    return math.nan if value is None else value


def duty_of(dataset: xr.Dataset) -> MeshDuty | None:
    """Result of the duty cycle in a dataset of ``layout_of``; None without one. Raises UnfitError where a
    variable or an attribute is missing, or is not as it was written.
    """
    return _DUTY.read(dataset)


def _check_nodes(plane: PlaneOfAction, loads: LineLoads) -> None:
    """Check that lines and films belong to the gear pair: each node is on a line of contact, and the lengths
    add up to the length of all lines.
    """
    path = plane.path
    if not math.isclose(float(np.sum(loads.weights)), 1.0, rel_tol=_ROUNDING):
        raise UnfitError("phase_weight is not a part of the phase")
    known = range(loads.phases.size)
    if not np.array_equal(np.unique(loads.phase), known) or np.any(np.diff(loads.phase) < 0):
        raise UnfitError("node_phase is not the number of a phase")
    begin = (loads.phases[loads.phase] + loads.line) * path.base_pitch
    places = path.start + begin + loads.across * math.tan(path.base_helix_angle)
    lengths = [plane.length(phase) for phase in loads.phases.tolist()]
    for name, off in {
        "place": np.abs(places - loads.places),
        "across": np.abs(loads.across - 0.5 * plane.face_width) - 0.5 * plane.face_width,
        "length": np.abs(loads.along(np.ones_like(loads.length)) - lengths),
    }.items():
        if np.any(off > _ROUNDING):
            raise UnfitError(f"{name} does not belong to the gear pair of its case")
    if not np.any(loads.load > 0.0):
        raise UnfitError("load has no number")
