"""Contacts of a bearing with one ring, solved over its loads: film, capacitance and breakdown voltage."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import BearingConditions, Solid
from ehlectric.bearing.domain import line_domain, point_domain
from ehlectric.bearing.ring_contacts import (
    BallContact,
    Contact,
    RollerContact,
    around_ball,
    around_roller,
    of_contact,
)
from ehlectric.cases.case import Case
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.solver import solve
from ehlectric.errors import ResultWarning

# Error of the minimum film that grids are refined to.
REFINE = 0.03

# A number of one contact, or an array of them, one a contact.
N = TypeVar("N", float, Array)


@dataclass(frozen=True)
class ContactValues(Generic[N]):
    """Quantities of a contact that change with its load, SI units; numbers of one contact or arrays of many.

    Attributes
    ----------
    max_pressure, semi_axis_x, semi_axis_y : float or ndarray, shape (n,)
        Hertz pressure and semi-axes of the dry contact [Pa, m]; of a roller half of its length across.
    minimum_thickness, central_thickness : float or ndarray, shape (n,)
        Film thickness, or the gap of bodies that do not touch [m].
    inside, outside_oil, outside_air : float or ndarray, shape (n,)
        Capacitance over the film's domain, and outside it with oil and with air there [F].
    plate : float or ndarray, shape (n,)
        eps0 eps_r A/h(0) of the Hertz area [F].
    strength_per_volt : float or ndarray, shape (n,)
        Largest field strength over the contact's voltage [1/m].
    breakdown_voltage : float or ndarray, shape (n,)
        Breakdown voltage of the contact by itself [V]; infinite without a strength.
    """

    max_pressure: N
    semi_axis_x: N
    semi_axis_y: N
    minimum_thickness: N
    central_thickness: N
    inside: N
    outside_oil: N
    outside_air: N
    plate: N
    strength_per_volt: N
    breakdown_voltage: N

    def columns(self) -> tuple[N, ...]:
        """All quantities, in the order of their names above."""
        return tuple(vars(self).values())


@dataclass(frozen=True)
class ContactSolution:
    """One loaded contact, SI units.

    Attributes
    ----------
    load : float
        Load of the contact [N].
    values : ContactValues
        Film, capacitances and voltages.
    error : float or None
        Estimate of the film's discretisation error, relative.
    moes_m, moes_l : float
        Moes' groups.
    mismatch : float
        Largest difference of the gaps at the edge of the film's domain, relative.
    converged : bool
        Whether the film is converged.
    warnings : tuple of ResultWarning
        Warnings of its solution.
    """

    load: float
    values: ContactValues[float]
    error: float | None
    moes_m: float
    moes_l: float
    mismatch: float
    converged: bool
    warnings: tuple[ResultWarning, ...]


def ball_case(contact: BallContact, solver: dict[str, Any]) -> Case:
    """The case of a ball's contact, with the table ``[solver]`` of a bearing file."""
    conditions, radii = contact.ring.conditions, contact.ring.radii
    tables = {
        "geometry": "point",
        "body_1": _body(conditions.ring) | {"radius_x": radii.ring_x, "radius_y": radii.ring_y},
        "body_2": _body(conditions.element) | {"radius_x": radii.element_x, "radius_y": radii.element_y},
        "load": contact.load,
    }
    return _case(contact, tables, point_domain(contact), {}, solver)


def roller_case(contact: RollerContact, solver: dict[str, Any]) -> Case:
    """The case of a roller's contact, with the table ``[solver]`` of a bearing file."""
    conditions, radii = contact.ring.conditions, contact.ring.radii
    tables = {
        "radius_1": radii.ring_x,
        "radius_2": radii.element_x,
        "body_1": _body(conditions.ring),
        "body_2": _body(conditions.element),
        "load_per_length": contact.load / contact.length,
    }
    return _case(contact, tables, line_domain(contact), {"length": contact.length}, solver)


def _body(solid: Solid) -> dict[str, float]:
    return {"youngs_modulus": solid.youngs_modulus, "poissons_ratio": solid.poissons_ratio}


def _case(
    contact: Contact,
    tables: dict[str, Any],
    grid: dict[str, Any],
    discharge: dict[str, Any],
    solver: dict[str, Any],
) -> Case:
    """The case of a contact of either kind, from what is its own."""
    conditions: BearingConditions[Any] = contact.ring.conditions
    return Case.from_dict(
        {
            "contact": {"entrainment_speed": contact.ring.speed} | tables,
            # Pressures are those above ambient, which acts on the bodies from all sides.
            "lubricant": conditions.lubricant.model_dump(exclude_none=True, exclude={"base"})
            | {"ambient_pressure": 0.0},
            "grid": grid | {"refine": REFINE},
            "discharge": conditions.discharge.model_dump(exclude_none=True) | discharge,
            "solver": solver,
        }
    )


def solve_ball(contact: BallContact, solver: dict[str, Any]) -> ContactSolution:
    """Solve film and field of a ball's contact, and add the gap around them.

    Parameters
    ----------
    contact : BallContact
        Contact and load.
    solver : dict
        ``[solver]`` of the bearing file.

    Returns
    -------
    ContactSolution
        Film, field and the gap around them.
    """
    with of_contact(contact):
        result = solve(ball_case(contact, solver), beside_smooth=False)
    assert isinstance(result, PointResult)
    film, conditions = result.film, result.conditions
    axes = conditions.semi_axis_x, conditions.semi_axis_y
    outside, mismatch = around_ball(contact, (film.x, film.y), film.thickness)
    return _solution(contact, result, axes=axes, outside=outside, mismatch=mismatch)


def solve_roller(contact: RollerContact, solver: dict[str, Any]) -> ContactSolution:
    """Solve film and field of a roller's contact, and add the gap around them.

    Parameters
    ----------
    contact : RollerContact
        Contact and load.
    solver : dict
        ``[solver]`` of the bearing file.

    Returns
    -------
    ContactSolution
        Film, field and the gap around them.
    """
    with of_contact(contact):
        result = solve(roller_case(contact, solver), beside_smooth=False)
    assert isinstance(result, Result)
    film, width = result.film, result.conditions.half_width
    outside = around_roller(contact.ring, width, film.x, film.thickness)
    axes = width, 0.5 * contact.length
    return _solution(contact, result, axes=axes, outside=outside, mismatch=0.0, length=contact.length)


def _solution(
    contact: Contact,
    result: Result | PointResult,
    *,
    axes: tuple[float, float],
    outside: float,
    mismatch: float,
    length: float = 1.0,
) -> ContactSolution:
    """Numbers of a contact of either kind; capacitances of the result are per length where it is a line's."""
    discharge, formulas = result.discharge, result.conditions.formulas
    assert discharge is not None
    breakdown = discharge.breakdown_voltage
    values = ContactValues(
        max_pressure=result.conditions.max_pressure,
        semi_axis_x=axes[0],
        semi_axis_y=axes[1],
        minimum_thickness=result.film.minimum_thickness,
        central_thickness=result.film.central_thickness,
        inside=length * discharge.capacitance,
        outside_oil=outside * contact.ring.conditions.lubricant.relative_permittivity,
        outside_air=outside,
        plate=length * discharge.capacitance_plate,
        strength_per_volt=result.field.max_strength / result.field.voltage,
        breakdown_voltage=np.inf if breakdown is None else breakdown,
    )
    return ContactSolution(
        load=contact.load,
        values=values,
        error=result.film.discretisation_error,
        moes_m=formulas.moes_m,
        moes_l=formulas.moes_l,
        mismatch=mismatch,
        converged=result.converged,
        warnings=without_regime(result.warnings),
    )


def without_regime(warnings: Iterable[ResultWarning]) -> tuple[ResultWarning, ...]:
    """Warnings of a contact but for those of its regime: the domain of a light contact is chosen for it."""
    return tuple(warning for warning in warnings if warning.code != "regime")


@dataclass(frozen=True)
class ContactCurve:
    """A contact over its load, between the loads that were solved.

    Attributes
    ----------
    solutions : tuple of ContactSolution
        By increasing load.
    """

    solutions: tuple[ContactSolution, ...]

    @property
    def loads(self) -> Array:
        """Loads that were solved [N]."""
        return np.array([solution.load for solution in self.solutions])

    def stack(self) -> ContactValues[Array]:
        """Quantities at the loads that were solved, as arrays."""
        rows = [solution.values.columns() for solution in self.solutions]
        return ContactValues(*np.array(rows).T)

    def at(self, load: Array) -> ContactValues[Array]:
        """Quantities at loads [N], interpolated in the logarithms of both."""
        loads = self.loads
        return ContactValues(*(_interpolated(loads, column, load) for column in self.stack().columns()))

    @property
    def interpolation_error(self) -> float:
        """Largest relative error at a load, were it left out, of capacitance and breakdown voltage.

        At twice the distance of the loads it bounds what is left with all of them.
        """
        worst, loads, stack = 0.0, self.loads, self.stack()
        for k in range(1, loads.size - 1):
            for values in (stack.inside, stack.breakdown_voltage):
                if np.isfinite(values[k]):
                    left = _interpolated(np.delete(loads, k), np.delete(values, k), loads[k : k + 1])[0]
                    worst = max(worst, abs(left / values[k] - 1.0))
        return float(worst)


def _interpolated(loads: Array, values: Array, load: Array) -> Array:
    """Values at other loads [N], monotone in the logarithms of both; infinite where one of them is."""
    if not np.all(np.isfinite(values)):
        return np.full(np.shape(load), np.inf)
    if loads.size == 1:
        return np.full(np.shape(load), values[0])
    known = np.log(loads)
    between: Array = np.exp(
        PchipInterpolator(known, np.log(values))(np.clip(np.log(load), known[0], known[-1]))
    )
    return between
