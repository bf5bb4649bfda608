"""Preparation of a case: operating conditions, rough surfaces, checks, and the domain that the film needs.

Pressure that would build up upstream of the domain, or at its sides, is missing in the film. Its share falls
with about the cube of the distance. The pressure of a light contact with its thick film builds up over many
half-widths, so that its domain is enlarged until the missing share is below the target error.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.cases.grid_inputs import Grid, point_grid
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.contact_heat import physics_of
from ehlectric.contact.contact_kinds import KINDS, AnyKind
from ehlectric.contact.contact_memory import check_grid, check_memory
from ehlectric.contact.contact_refinement import Reach, Refinement, reach_of
from ehlectric.contact.film_domain import LARGER
from ehlectric.contact.problems import check_tolerance, domain_of, heights_of, spacings_of
from ehlectric.contact.setup import Setup
from ehlectric.contact.summary import breakdown_by_formula
from ehlectric.contact.warnings import case_warnings
from ehlectric.discharge.discharge_laws import MOST_MARGIN
from ehlectric.errors import InputError, shown
from ehlectric.film import MOST_OUTSIDE, Film, FilmProblem, Physics, PointFilm
from ehlectric.lubricant.python_laws import Laws, Recorder, SampledLaws
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable
from ehlectric.surfaces.generated_profiles import Domain
from ehlectric.surfaces.rough_surfaces import RoughMap, RoughSurface
from ehlectric.surfaces.surface_warnings import surface_warnings

# Places along each axis of a line and a point contact at which the heights in the Hertz zone are taken.
_ZONE_NODES = {1: 4001, 2: 401}


@dataclass(frozen=True)
class PreparedContact:
    """Contact that is ready to be solved, with its rough surfaces read from files or generated."""

    case: Case | Setup
    conditions: Conditions | PointConditions  # operating conditions, SI units
    domain: Domain  # domain in which the film is solved [m]
    # Rough surfaces, one for each table ``roughness`` of the case.
    rough: Sequence[RoughSurface] | Sequence[RoughMap] = ()
    physics: Physics | None = None  # heat and shear of the film; None of an isothermal Newtonian film

    @property
    def kind(self) -> AnyKind:
        """Functions of the kind of this contact, line or point."""
        return KINDS[self.conditions.geometry]

    def film_problem(self, setup: Setup, *, rough: bool = True) -> FilmProblem:
        """Film problem of the contact on the grid of a setup, with its roughness or with smooth surfaces."""
        surfaces = self.rough if rough else ()
        problem = self.kind.film_problem(setup, self.conditions, surfaces)
        return problem if self.physics is None else replace(problem, physics=self.physics)

    @cached_property
    def refinement(self) -> Refinement:
        """Film problem with its surfaces, and the grids of its refinement."""
        return Refinement.of(Setup.of(self.case), self.conditions.geometry, self.film_problem)

    @cached_property
    def reach(self) -> Reach | None:
        """Expected errors and times of the grids of a refinement; None of a grid that is not refined."""
        if self.case.grid.target is None:
            return None
        return reach_of(self.refinement, self.conditions.geometry)

    def composite_roughness(self) -> float | None:
        """Rq of the sum of both surfaces in the Hertz zone, undeformed [m]; None for smooth surfaces."""
        if not self.rough:
            return None
        semi_axes = self.conditions.semi_axes
        unit = np.linspace(-1.0, 1.0, _ZONE_NODES[len(semi_axes)])
        heights = heights_of(self.rough, *(axis * unit for axis in semi_axes)).sum(axis=0)
        distance = sum(part**2 for part in np.meshgrid(*[unit] * len(semi_axes)))
        return float(np.std(heights[distance <= 1.0]))

    def warnings(self) -> Iterator[ResultWarning]:
        """Warnings before the solution: about the operating conditions, rough surfaces and the refinement."""
        yield from case_warnings(self.case, self.conditions)
        yield from self.surface_warnings(self.case)
        yield from self.reach_warnings()

    def reach_warnings(self) -> Iterator[ResultWarning]:
        """Warning about the error that the grids of the refinement will probably reach."""
        yield from () if self.reach is None else self.reach.warnings()

    def surface_warnings(self, setup: Case | Setup) -> Iterator[ResultWarning]:
        """Warnings about the rough surfaces on the grid of a setup, or on the grids of a refinement."""
        spacings, finest = spacings_of(setup, self.conditions), tuple[float, ...]()
        if self.rough and setup.grid.target is not None and len(self.refinement.grids) > 1:
            last = replace(self.refinement.first, grid=self.refinement.grids[-1])
            finest = spacings_of(last, self.conditions)
        yield from surface_warnings(self.case.roughness, self.rough, self.domain, *spacings, finest=finest)


def prepare(case: Case) -> PreparedContact:
    """Check a case and prepare its contact, before any folder is made for its results.

    Raises an InputError if values contradict each other, the tolerance is too large, a surface cannot be
    used, or the case needs more than the available memory.
    """
    kind = KINDS[case.contact.geometry]
    conditions = kind.resolve(case)
    check_tolerance(case.solver)
    check_memory(case)
    domain = domain_of(case, conditions)
    physics = physics_of(case, conditions)
    _check_margin(case, conditions)
    return PreparedContact(case, conditions, domain, kind.rough(case.roughness, domain), physics)


def _check_margin(case: Case, conditions: Conditions | PointConditions) -> None:
    """Refuse a voltage so small that the margin of the film of a formula is above ``MOST_MARGIN``.

    The check omits strengths that need the field in the whole film.
    """
    estimate = breakdown_by_formula(case, conditions)
    if estimate is None:
        return
    least = estimate["breakdown_voltage"] / MOST_MARGIN
    if case.electric.voltage < least:
        raise InputError(
            "electric.potential_2",
            got=f"a voltage of {case.electric.voltage:g} V",
            # Rounding to two digits changes a number by at most 5 %.
            takes=f"at least {readable(1.05 * least, 2)} V: the margin is at most {MOST_MARGIN:.0e} there",
        )


def case_with_laws(case: object, laws: object) -> Case:
    """Case of a contact with laws of the user's own. Raises InputError for other laws, and for a bearing or a
    drive.
    """
    if not isinstance(laws, Laws | SampledLaws):
        raise InputError("laws", got=shown(type(laws).__name__), takes="Laws of functions")
    if not isinstance(case, Case):
        raise InputError.worded(
            "laws",
            f"are for the oil of one contact, not for a {type(case).__name__}; give its oil by the laws of "
            "[lubricant], for example viscosity_law",
            takes="a Case of a contact",
        )
    return case.with_laws(laws)


def portable(case: Case) -> Case:
    """Case for another process: functions of the user's own are replaced by all values that it needs.

    Raises InputError if a function has no valid value at a temperature or a pressure of the contact.
    """
    if not isinstance(case.user_laws, Laws):
        return case
    recorder = Recorder(case.user_laws)
    recorded = case.with_laws(recorder)
    conditions = KINDS[case.contact.geometry].resolve(recorded)
    physics_of(recorded, conditions)
    assert case.contact.temperature is not None
    return case.with_laws(recorder.recorded(case.contact.temperature, conditions.max_pressure))


# Part of the error asked for at which a longer domain aims, and bounds of the factor of one step.
_AIM, _LEAST, _MOST = 0.3, 1.25, 4.0

# Largest number of larger domains.
MOST_STEPS = 3

# Nodes in a half-width or semi-axis of the first grid, along and across, and the least number of nodes.
_DENSITY = {"line": (16, 0, 401), "point": (8, 16, 129)}


def widened(contact: PreparedContact, film: Film | PointFilm) -> PreparedContact | None:
    """Contact on a larger domain, where the domain of its film cuts off more than the target error.

    None where the domain is large enough or cannot be larger, where the grid has no target error, where
    surfaces are rough, and where oil is supplied at the inlet.
    """
    case, grid, loss = contact.case, contact.case.grid, film.domain_loss
    if loss is None or grid.target is None or not loss > grid.target:
        return None
    if contact.rough or case.inlet is not None:
        return None
    larger = _larger(contact, film, loss, grid.target)
    if larger is None:
        return None
    grid, side = larger
    conditions = contact.conditions
    case = replace(case, grid=grid) if isinstance(case, Setup) else case.model_copy(update={"grid": grid})
    if isinstance(conditions, PointConditions):
        conditions = replace(conditions, side=side)
    return replace(contact, case=case, conditions=conditions, domain=domain_of(case, conditions))


def _larger(
    contact: PreparedContact, film: Film | PointFilm, loss: float, target: float
) -> tuple[Grid, float] | None:
    """Grid and side of a larger domain; None where the film has the largest one."""
    grid, conditions = contact.case.grid, contact.conditions
    geometry = conditions.geometry
    rule, wide = LARGER[geometry], getattr(conditions, "side", 0.0)
    factor = min(_MOST, max(_LEAST, math.cbrt(loss / (_AIM * target))))
    if geometry == "point":
        # The load outside of the domain falls with its size.
        factor = max(factor, (film.load_deficit or 0.0) / (_AIM * MOST_OUTSIDE))
    length = math.sqrt(2.0 * film.central_thickness / film.scales.thickness)
    start, end = grid.ends
    across = 0.0
    if isinstance(conditions, PointConditions):
        across = length * math.sqrt(conditions.radius_y / conditions.radius_x) / conditions.ratio
    least = min(rule.most[0], factor * -start), end, min(rule.most[2], factor * wide)
    inlet, outlet, side = map(float, rule.ends(least, length, across))
    outlet, side = _rounded(outlet), _rounded(side)
    if inlet <= -start and side <= wide:
        return None
    ends = {"inlet": -_rounded(inlet), "outlet": outlet} | ({"side": side} if side else {})
    table = grid.model_dump(mode="json", exclude_none=True) | ends
    along, sideways, fewest = _DENSITY[geometry]
    nodes = max(fewest, along * math.ceil(inlet + outlet) + 1, sideways * math.ceil(side) + 1)
    table["nodes"] = max(nodes, table.get("nodes", 0))
    table["refine"] = table.pop("error", target)
    try:
        larger = Grid.from_dict(point_grid(table) if geometry == "point" else table)
        check_grid(geometry, larger.first(), rough=False)
    except InputError:
        return None
    return larger, side


def _rounded(length: float) -> float:
    """Length, rounded up to a half."""
    return math.ceil(2.0 * length) / 2.0
