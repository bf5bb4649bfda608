"""Solved contacts of a bearing with one ring over their load: films, capacitances, breakdown voltages."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Generic, TypeVar

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.arrays import Array
from ehlectric.bearing.domain import ball_grid, roller_grid
from ehlectric.bearing.ring_contacts import (
    BallContact,
    Contact,
    RollerContact,
    around_ball,
    around_roller,
    check_contact,
)
from ehlectric.cases.grid import Solver
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.solver import solve_contact
from ehlectric.errors import ResultWarning
from ehlectric.runtime.stored import stored
from ehlectric.runtime.values import Values

# Number of one contact, or array with a number for each contact.
N = TypeVar("N", float, Array)


@dataclass(frozen=True, eq=False, repr=False)
class ContactValues(Values, Generic[N]):
    """Quantities that change with the load, SI units: numbers of one contact or arrays of many.

    Attributes
    ----------
    max_pressure : float or ndarray, shape (n,)
        Hertz pressure of the dry contact [Pa].
    semi_axis_x, semi_axis_y : float or ndarray, shape (n,)
        Semi-axes of the dry contact along and across entrainment [m]; half of a roller's length across.
    minimum_thickness, central_thickness : float or ndarray, shape (n,)
        Film thickness, or the gap between bodies that do not touch [m].
    inside : float or ndarray, shape (n,)
        Capacitance over the domain of the film [F].
    outside_oil, outside_air : float or ndarray, shape (n,)
        Capacitance outside the domain of the film, with oil and with air in the gap [F].
    plate : float or ndarray, shape (n,)
        Capacitance eps0 eps_r A/h(0) of the Hertz area A as a plate [F].
    strength_per_volt : float or ndarray, shape (n,)
        Maximum field strength per volt on the contact [1/m].
    breakdown_voltage : float or ndarray, shape (n,)
        Voltage on the contact at which its film breaks down [V]; infinite without a strength.
    hertz : float or ndarray, shape (n,)
        Part of ``inside`` over the Hertz area [F]; NaN of a result that does not have it.
    """

    max_pressure: N = field(metadata=stored("", "Pa", "not negative"))
    semi_axis_x: N = field(metadata=stored("", "m", "not negative"))
    semi_axis_y: N = field(metadata=stored("", "m", "not negative"))
    minimum_thickness: N = field(metadata=stored("", "m", "not negative"))
    central_thickness: N = field(metadata=stored("", "m", "not negative"))
    inside: N = field(metadata=stored("", "F", "not negative"))
    outside_oil: N = field(metadata=stored("", "F", "not negative"))
    outside_air: N = field(metadata=stored("", "F", "not negative"))
    plate: N = field(metadata=stored("", "F", "not negative"))
    strength_per_volt: N = field(metadata=stored("", "1/m", "not negative"))
    breakdown_voltage: N = field(metadata=stored("", "V", "positive or infinite"))
    hertz: N = field(metadata=stored("", "F", "not negative or NaN"))

    def columns(self) -> tuple[N, ...]:
        """All quantities, in the order of the attributes."""
        return tuple(vars(self).values())


@dataclass(frozen=True, eq=False, repr=False)
class ContactSolution(Values):
    """Film, capacitances and voltages of one loaded contact, SI units.

    Attributes
    ----------
    load : float
        Load of the contact [N].
    values : ContactValues
        Film, capacitances and voltages.
    error : float or None
        Estimated error of the film, relative: of the discretisation, or as the atlas or a formula states it.
        None where it is unknown.
    moes_m, moes_l : float
        Load parameter M and lubricant parameter L of Moes, dimensionless.
    mismatch : float
        Largest relative difference, at the edge of the domain, between the film thickness and the gap
        outside.
    converged : bool
        Whether the film is converged.
    warnings : tuple of ResultWarning
        Warnings about the film and the field.
    """

    load: float = field(metadata=stored("", "N", "increasing"))
    values: ContactValues[float]
    error: float | None = field(metadata=stored("", "", "not negative or NaN", unknown=True))
    moes_m: float = field(metadata=stored("", "", "not negative"))
    moes_l: float = field(metadata=stored("", "", "not negative"))
    mismatch: float = field(metadata=stored("", "", "finite or NaN"))
    converged: bool = field(metadata=stored("", "", "0 or 1"))
    warnings: tuple[ResultWarning, ...]


def solve_ball(contact: BallContact, solver: Solver) -> ContactSolution:
    """Film and field of a ball's contact, and the capacitance outside its film.

    Parameters
    ----------
    contact : BallContact
        Contact and load.
    solver : Solver
        Table ``[solver]`` of the bearing file.

    Returns
    -------
    ContactSolution
        Numbers of the solved contact.

    Raises
    ------
    InputError
        As ``check_contact`` does.
    """
    grid, ring = ball_grid(contact), contact.ring
    check_contact(contact, grid)
    assert grid.side is not None
    conditions = replace(contact.conditions, side=grid.side)
    result = solve_contact(conditions, ring.oil, grid=grid, solver=solver, discharge=ring.discharge)
    assert isinstance(result, PointResult)
    film = result.film
    outside, mismatch = around_ball(contact, (film.x, film.y), film.thickness)
    axes = conditions.semi_axis_x, conditions.semi_axis_y
    return _solution(contact, result, axes=axes, outside=outside, mismatch=mismatch)


def solve_roller(contact: RollerContact, solver: Solver) -> ContactSolution:
    """Film and field of a roller's contact, and the capacitance outside its film.

    Parameters
    ----------
    contact : RollerContact
        Contact and load.
    solver : Solver
        Table ``[solver]`` of the bearing file.

    Returns
    -------
    ContactSolution
        Numbers of the solved contact.

    Raises
    ------
    InputError
        As ``check_contact`` does.
    """
    grid, ring, length = roller_grid(contact), contact.ring, contact.length
    check_contact(contact, grid)
    conditions = contact.conditions
    discharge = ring.discharge.model_copy(update={"length": length})
    result = solve_contact(conditions, ring.oil, grid=grid, solver=solver, discharge=discharge)
    assert isinstance(result, Result)
    film = result.film
    outside = around_roller(contact.ring, conditions.half_width, film.x, film.thickness)
    axes = conditions.half_width, 0.5 * length
    return _solution(contact, result, axes=axes, outside=outside, mismatch=0.0, length=length)


def _solution(
    contact: Contact,
    result: Result | PointResult,
    *,
    axes: tuple[float, float],
    outside: float,
    mismatch: float,
    length: float = 1.0,
) -> ContactSolution:
    """Numbers of a solved contact; ``length`` is that of a line contact [m], 1 for a point contact."""
    discharge, formulas = result.discharge, result.conditions.contact
    assert discharge is not None
    breakdown = discharge.breakdown_voltage
    values = ContactValues(
        max_pressure=result.conditions.max_pressure,
        semi_axis_x=axes[0],
        semi_axis_y=axes[1],
        minimum_thickness=result.film.minimum_thickness,
        central_thickness=result.film.central_thickness,
        inside=length * discharge.capacitance,
        outside_oil=outside * contact.ring.conditions.oil.relative_permittivity,
        outside_air=outside,
        plate=length * discharge.capacitance_plate,
        strength_per_volt=result.field.max_strength / result.field.voltage,
        breakdown_voltage=np.inf if breakdown is None else breakdown,
        hertz=length * discharge.capacitance_hertz,
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
    """Warnings without those that are not about a contact of a bearing.

    The domain of a contact suits its regime, and the voltage of a single contact is not that of the bearing.
    The films of light contacts are too thin by what their domain cuts off, which makes no margin too large:
    by 0.3 to 2.4 % under rollers, by more under balls that hardly press.
    """
    left_out = {"regime", "breakdown-expected", "inlet-too-short", "domain-too-small", "domain-far-too-small"}
    return tuple(warning for warning in warnings if warning.code not in left_out)


# Part of the largest load of a ring below which a contact is light: its film is thick, so that it never
# breaks down first and hardly changes the circuit of the bearing.
_LIGHT = 0.02


@dataclass(frozen=True, eq=False, repr=False)
class ContactCurve(Values):
    """Quantities of a contact over its load, interpolated between solved loads.

    Attributes
    ----------
    solutions : tuple of ContactSolution
        Solved contacts by increasing load.
    """

    solutions: tuple[ContactSolution, ...]

    @property
    def loads(self) -> Array:
        """Solved loads [N]."""
        return np.array([solution.load for solution in self.solutions])

    def stack(self) -> ContactValues[Array]:
        """Quantities at the solved loads, as arrays."""
        rows = [solution.values.columns() for solution in self.solutions]
        return ContactValues(*np.array(rows).T)

    def at(self, load: Array) -> ContactValues[Array]:
        """Quantities at loads [N], interpolated in the logarithms of load and quantity."""
        return ContactValues(*self._law(load))

    @cached_property
    def _law(self) -> _Interpolation:
        """Interpolation of all quantities."""
        return _Interpolation.of(self.loads, np.stack(self.stack().columns(), axis=-1))

    @cached_property
    def counted(self) -> ContactCurve:
        """Contacts whose films decide about the circuit: those that are not light."""
        least = _LIGHT * self.solutions[-1].load
        heavy = tuple(contact for contact in self.solutions if contact.load >= least)
        return self if len(heavy) == len(self.solutions) else ContactCurve(heavy)

    @cached_property
    def interpolation_error(self) -> float:
        """Largest relative error of capacitance and breakdown voltage when one solved load is left out.

        Without that load the distance of the loads is twice as large. The interpolation error with all loads
        is therefore expected to be smaller. The breakdown voltage of contacts with less than 2 % of the
        largest load does not count.
        """
        worst, loads, stack = 0.0, self.loads, self.stack()
        values = np.stack([stack.inside, stack.breakdown_voltage], axis=-1)
        for k in range(1, loads.size - 1):
            known = np.isfinite(values[k]) & [True, loads[k] >= _LIGHT * loads[-1]]
            others = np.delete(values[:, known], k, axis=0)
            left = _Interpolation.of(np.delete(loads, k), others)(loads[k : k + 1])
            worst = max([worst, *np.abs(left[:, 0] / values[k, known] - 1.0)])
        return float(worst)


@dataclass(frozen=True)
class _Interpolation:
    """Monotone interpolation of n columns of values over the load in the logarithms of both.

    Attributes
    ----------
    loads : ndarray, shape (m,)
        Loads [N].
    first : ndarray, shape (n,)
        Values at the smallest load; infinite for a column with any infinite value.
    between : PchipInterpolator or None
        Logarithm of the columns that are finite over that of the load; None for a single load.
    """

    loads: Array
    first: Array
    between: PchipInterpolator | None

    @classmethod
    def of(cls, loads: Array, values: Array) -> _Interpolation:
        """Interpolation of values of shape (m, n)."""
        finite = np.all(np.isfinite(values), axis=0)
        between = PchipInterpolator(np.log(loads), np.log(values[:, finite])) if loads.size > 1 else None
        return cls(loads, np.where(finite, values[0], np.inf), between)

    def __call__(self, load: Array) -> Array:
        """Values at k loads [N], shape (n, k); beyond the ends, those at the ends."""
        found = np.repeat(self.first[:, np.newaxis], np.size(load), axis=1)
        if self.between is not None:
            inside = np.clip(load, self.loads[0], self.loads[-1])
            found[np.isfinite(self.first)] = np.exp(self.between(np.log(inside))).T
        return found
