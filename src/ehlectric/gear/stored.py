"""Stored form of a gear pair's result, gear.nc: its variables in SI units, and the solution of such a file.

A file contains the case, the loads and films on the lines of contact, and the films at the points A to E. The
geometry follows from the case in closed form.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.bearing import StoredDuty, Stretch
from ehlectric.cases.gear_case import GearCase
from ehlectric.gear.contact_lines import PlaneOfAction
from ehlectric.gear.contact_path import POINTS
from ehlectric.gear.flank_films import FlankFilms
from ehlectric.gear.flank_oil import flank_oils
from ehlectric.gear.load_sharing import LineLoads
from ehlectric.gear.mesh_duty import MeshDuty, MeshRows
from ehlectric.gear.solution import GearSolution, OperatingPair
from ehlectric.runtime.file_rules import UnfitError, case_of, number_of, text_of
from ehlectric.runtime.netcdf import Layout
from ehlectric.runtime.stored import Part, check_parts, values_of

if TYPE_CHECKING:
    import xarray as xr

# Name and version of the layout of gear.nc.
SCHEMA = "ehlectric.gear.result/1"

_NODE, _POINT = ("node",), "point"
_SOLUTION, _LOADS = Part(GearSolution), Part(LineLoads)
# Places of the films are the places of the loads.
_FILMS = Part(FlankFilms, prefix="film_", axes={"place": _NODE})
_POINT_FILMS = Part(FlankFilms, prefix="point_", axes={"place": (_POINT,)})
_DUTY = StoredDuty(MeshDuty, MeshRows, {"stretches": Stretch})
_PARTS = (_SOLUTION, _LOADS, _FILMS, _POINT_FILMS)

# Rounding of nodes that are computed again from the case [m].
_ROUNDING = 1e-9


def layout_of(
    solution: GearSolution, seconds: float, version: str, *, probable: bool, duty: MeshDuty | None = None
) -> Layout:
    """Variables and attributes of a gear.nc, SI units, from which ``solution_of`` makes an equal solution.

    ``probable``, whether the result contains the probability of breakdown; ``duty``, its duty cycle.
    """
    return Layout(
        {
            **_SOLUTION.written(solution),
            **_LOADS.written(solution.loads),
            **_FILMS.written(solution.films),
            **_POINT_FILMS.written(solution.point_films),
            **_DUTY.variables(duty),
            _POINT: (_POINT, list(POINTS)),
        },
        {
            "schema": SCHEMA,
            "version": version,
            "case": solution.case.to_toml(),
            "seconds": seconds,
            "probable": int(probable),
            **_DUTY.attributes(duty),
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
