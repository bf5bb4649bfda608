"""Contacts of all elements with one ring: conditions, grids, and solved contacts over their load."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import ClassVar, Generic, TypeAlias

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.arrays import Array, N, Numbers, as_float
from ehlectric.bearing.ball_gaps import DomainLaw
from ehlectric.bearing.conditions import BearingConditions, G_co, RingConditions
from ehlectric.bearing.gap_tables import rigid_balls, rigid_rollers
from ehlectric.bearing.gaps import (
    Raceway,
    RollerRaceway,
    match_film,
    outside_capacitance,
    roller_tails,
)
from ehlectric.bearing.loads.geometry import BallBearing, ContactRadii, RollerBearing
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.grid_inputs import DEFAULT_ENDS, Grid, Solver, point_grid
from ehlectric.contact.check import FARTHEST
from ehlectric.contact.conditions import (
    Conditions,
    PointConditions,
    check_pressure,
    check_width,
    default_side,
)
from ehlectric.contact.contact_memory import check_grid
from ehlectric.contact.solver import solve_contact
from ehlectric.errors import InputError, ResultWarning
from ehlectric.formulas.film_line import moes
from ehlectric.formulas.film_point import nijenbanning_venner_moes
from ehlectric.formulas.hertz import DryContact, dry_contact, line_half_width, line_max_pressure
from ehlectric.lubricant.oil import Oil
from ehlectric.runtime.stored import stored
from ehlectric.runtime.values import Values

# Discretisation error of the minimum film, relative, to which the grid of each contact is refined.
REFINE = 0.02

# Domain of a ball's contact ahead of it, beside it and behind it, in lengths sqrt(2 R h) over which the
# pressure builds up, and the most that a grid holds ahead and beside, in semi-axes. The domain costs below
# 1 % of the film, or 15 % where a ball hardly presses.
_ALONG, _ACROSS, _BEHIND, _MOST = 10.0, 4.0, 1.0, FARTHEST["point"]

# The same as a law of the domains of many balls: the default domain of solved contacts is the shortest one.
BALL_DOMAINS = DomainLaw(
    inlet=-DEFAULT_ENDS[True][0],
    outlet=DEFAULT_ENDS[True][1],
    side=default_side,
    along=_ALONG,
    behind=_BEHIND,
    across=_ACROSS,
    most=(_MOST[0], 0.1 * _MOST[0], _MOST[1]),
)

# Domain of a roller's contact ahead of it and behind it, in the same lengths; it costs 0.3 to 1.2 % of the
# film. Beyond a hundred half-widths the inlet has eight lengths, and three hundred half-widths at the most,
# which costs 2.5 % of the film and 1.3 % of the capacitance: with longer inlets the films of hardly loaded
# rollers often did not converge.
_LINE_INLET, _LINE_OUTLET = 10.0, 2.0
_LINE_FAR, _LINE_SHORTER, _LINE_MOST = 100.0, 8.0, FARTHEST["line"][0]


@lru_cache(maxsize=128)
def _point_grid(inlet: float, outlet: float, side: float, nodes: int) -> Grid:
    """Grid with lengths in semi-axes; it is made once, as most contacts have the same one."""
    table = {"inlet": -inlet, "outlet": outlet, "side": side, "nodes": nodes, "refine": REFINE}
    return Grid.from_dict(point_grid(table))


# Largest film thickness over (f - 1/2) D, the difference of the radii of groove and ball, at which the film
# does not change contact angle and gap. For a roller, the largest length sqrt(2 R h) over which the film
# builds up, over the roller's radius, at which the roller is still a parabola.
_ROOM = 0.1

# Least entrainment speed of a contact [m/s], the same as in a case: slower contacts have no film, and the
# numbers of their film equations leave the range of floating-point arithmetic.
_LEAST_SPEED = 1e-9


@dataclass(frozen=True)
class RingContacts(Generic[G_co]):
    """Contacts of all elements with one ring, without their loads."""

    conditions: BearingConditions[G_co]
    inner: bool  # True for the inner ring, False for the outer ring
    angle: float  # contact angle at which the radii are taken [rad]
    speed: float  # entrainment speed (u1 + u2)/2 [m/s]

    @property
    def name(self) -> str:
        """Name of the ring, "inner" or "outer"."""
        return "inner" if self.inner else "outer"

    @property
    def _own(self) -> RingConditions:
        return self.conditions.inner if self.inner else self.conditions.outer

    @property
    def oil(self) -> Oil:
        """Oil in the contacts, at the temperature of the ring."""
        return self._own.oil

    @property
    def discharge(self) -> Discharge:
        """Dielectric strength and conductivity in the contacts, at the temperature of the ring."""
        return self._own.discharge

    @property
    def film_factor(self) -> Numbers:
        """Film thickness over that of isothermal, fully flooded oil, dimensionless, at most 1."""
        return self._own.film_factor

    @property
    def radii(self) -> ContactRadii:
        """Radii of element and ring at the contact angle [m]."""
        return self.conditions.geometry.radii(self.angle, inner=self.inner)


@dataclass(frozen=True)
class BallContact:
    """Contact of a ball with a ring under a load."""

    length: ClassVar[float] = 1.0  # results of a point contact are not per length

    ring: RingContacts[BallBearing]
    load: float  # [N]

    @cached_property
    def dry(self) -> DryContact:
        """Dry contact under the load."""
        radii = self.ring.radii
        return dry_contact(self.load, radii.radius_x, radii.radius_y, self.ring.conditions.modulus)

    @cached_property
    def conditions(self) -> PointConditions:
        """Operating conditions of the point contact, which ``check_contact`` may still refuse."""
        bearing, oil, radii, dry = self.ring.conditions, self.ring.oil, self.ring.radii, self.dry
        return PointConditions(
            radius_x=radii.radius_x,
            radius_y=radii.radius_y,
            reduced_modulus=bearing.modulus,
            load=self.load,
            entrainment_speed=self.ring.speed,
            slide_to_roll_ratio=0.0,
            viscosity=oil.viscosity,
            pressure_viscosity_coefficient=oil.alpha_star,
            semi_axis_x=dry.semi_axis_x,
            semi_axis_y=dry.semi_axis_y,
            max_pressure=dry.max_pressure,
            side=default_side(dry.semi_axis_y / dry.semi_axis_x),
            compliance_share=bearing.ring_share,
            film_factor=self.ring.film_factor,
        )

    @property
    def axes(self) -> tuple[float, float]:
        """Semi-axes of the dry contact along and across entrainment [m]."""
        return self.dry.semi_axis_x, self.dry.semi_axis_y

    @property
    def area(self) -> float:
        """Area of the dry contact [m^2]."""
        return float(np.pi * self.axes[0] * self.axes[1])

    @property
    def widths(self) -> tuple[tuple[float, float], ...]:
        """Semi-axes of the dry contact along and across, each with the smallest radius in its plane [m]."""
        radii = self.ring.radii
        along = min(radii.radius_x, abs(radii.ring_x), abs(radii.element_x))
        across = min(radii.radius_y, abs(radii.ring_y), abs(radii.element_y))
        return (self.axes[0], along), (self.axes[1], across)

    @cached_property
    def film(self) -> float:
        """Central film thickness [m] by the formula of Nijenbanning, Venner and Moes.

        The formula holds for light contacts too.
        """
        return nijenbanning_venner_moes(self.conditions.contact).central_thickness

    @property
    def thickest_film(self) -> Numbers:
        """Largest film thickness [m] for which there is room between ball and groove."""
        return _ROOM * self.ring.conditions.geometry.offsets[0 if self.ring.inner else 1]

    @property
    def _lengths(self) -> tuple[float, float]:
        """Lengths sqrt(2 R h) over which the pressure builds up, along and across, in semi-axes."""
        radii, axes = self.ring.radii, self.axes
        along, across = (
            math.sqrt(2.0 * radius * self.film) / axis
            for radius, axis in zip((radii.radius_x, radii.radius_y), axes, strict=True)
        )
        return along, across

    @property
    def grid(self) -> Grid:
        """Grid of film and field in semi-axes, on a domain wide enough for the thick film of a light load.

        Heavy loads have the default domain of point contacts.
        """
        along, across = self._lengths
        inlet = max(4.5, min(_ALONG * along, _MOST[0]))
        outlet = max(1.5, min(_BEHIND * along, 0.1 * _MOST[0]))
        side = max(self.conditions.side, min(1.0 + _ACROSS * across, _MOST[1]))
        nodes = max(129, 8 * math.ceil(inlet + outlet) + 1, 16 * math.ceil(side) + 1)
        return _point_grid(inlet, outlet, side, nodes)

    @property
    def fits(self) -> bool:
        """Whether the domain holds the lengths over which the film builds up, along and across."""
        along, across = self._lengths
        return _ALONG * along <= _MOST[0] and 1.0 + _ACROSS * across <= _MOST[1]

    def conditions_on(self, grid: Grid) -> PointConditions:
        """Operating conditions of a film on the domain of a grid."""
        assert grid.side is not None
        return replace(self.conditions, side=grid.side)

    def around(self, nodes: tuple[Array, ...], thickness: Array) -> tuple[float, float]:
        """Capacitance between ball and groove outside the domain of the film, in vacuum.

        ``nodes``, nodes of the film along and across entrainment [m], shapes (nx,) and (ny,); ``thickness``
        [m], shape (nx, ny). Returns the capacitance [F], and the largest relative difference, at the edge of
        the domain, between the film thickness and the gap outside.
        """
        x, y = np.meshgrid(*nodes, indexing="ij")
        rim = np.ones_like(thickness, dtype=bool)
        rim[1:-1, 1:-1] = False
        domain = float(nodes[0][0]), float(nodes[0][-1]), float(nodes[1][-1])
        raceway, modulus = raceway_of(self.ring), self.ring.conditions.modulus
        matched = match_film(raceway, self.dry, modulus, x=x[rim], y=y[rim], thickness=thickness[rim])
        return as_float(outside_capacitance(raceway, matched, domain)), as_float(matched.mismatch)


@dataclass(frozen=True)
class RollerContact:
    """Contact of a roller with a ring under a load."""

    ring: RingContacts[RollerBearing]
    load: float  # [N]

    @property
    def length(self) -> Numbers:
        """Length of the roller [m]."""
        return self.ring.conditions.geometry.roller_length

    @cached_property
    def conditions(self) -> Conditions:
        """Operating conditions of the line contact, which ``check_contact`` may still refuse."""
        bearing, oil, radii = self.ring.conditions, self.ring.oil, self.ring.radii
        radius, modulus, load_per_length = radii.radius_x, bearing.modulus, self.load / self.length
        return Conditions(
            reduced_radius=radius,
            reduced_modulus=modulus,
            load_per_length=load_per_length,
            entrainment_speed=self.ring.speed,
            slide_to_roll_ratio=0.0,
            viscosity=oil.viscosity,
            pressure_viscosity_coefficient=oil.alpha_star,
            half_width=line_half_width(load_per_length, radius, modulus),
            max_pressure=line_max_pressure(load_per_length, radius, modulus),
            curvature_share=radius / radii.ring_x,
            compliance_share=bearing.ring_share,
            film_factor=self.ring.film_factor,
        )

    @property
    def axes(self) -> tuple[float, float]:
        """Half-width of the dry contact along entrainment, and half of its length across [m]."""
        return self.conditions.half_width, 0.5 * self.length

    @property
    def area(self) -> float:
        """Area of the dry contact [m^2]."""
        return 4.0 * self.axes[0] * self.axes[1]

    @property
    def widths(self) -> tuple[tuple[float, float], ...]:
        """Half-width of the dry contact, with the smallest radius in its plane [m]."""
        radii = self.ring.radii
        return ((self.conditions.half_width, min(radii.radius_x, abs(radii.ring_x), abs(radii.element_x))),)

    @cached_property
    def film(self) -> float:
        """Central film thickness [m] by the formula of Moes, which holds for light contacts too."""
        return moes(self.conditions.contact).central_thickness

    @property
    def thickest_film(self) -> Numbers:
        """Largest film thickness [m] for which the roller is a parabola where its film builds up."""
        radius = 0.5 * self.ring.conditions.geometry.roller_diameter
        return (_ROOM * radius) ** 2 / (2.0 * self.conditions.reduced_radius)

    @property
    def _build_up(self) -> float:
        """Length sqrt(2 R h) over which the pressure builds up, in half-widths."""
        conditions = self.conditions
        return math.sqrt(2.0 * conditions.reduced_radius * self.film) / conditions.half_width

    @property
    def _inlets(self) -> tuple[float, float]:
        """Inlet that the film needs, and the longest one, in half-widths.

        The longest one is as far as a parabola describes the roller, or what a grid holds.
        """
        length = self._build_up
        longest = min(0.5 * self.ring.radii.element_x / self.conditions.half_width, _LINE_MOST)
        return min(_LINE_INLET * length, max(_LINE_FAR, _LINE_SHORTER * length)), longest

    @property
    def grid(self) -> Grid:
        """Grid of film and field in half-widths, long enough for the thick film of a light load."""
        length, (needed, most) = self._build_up, self._inlets
        inlet, outlet = max(4.0, min(needed, most)), max(2.0, min(_LINE_OUTLET * length, most))
        return Grid.from_dict(
            {
                "inlet": -inlet,
                "outlet": outlet,
                # A grid takes sixteen nodes or more in the Hertz zone.
                "nodes": max(801, 8 * math.ceil(inlet + outlet) + 1),
                # Grids reach a hundred half-widths for the field at the most, and 1.25 by default.
                "field_range": [
                    -max(1.25, min(length, inlet, 100.0)),
                    max(1.25, min(length, outlet, 100.0)),
                ],
                "refine": REFINE,
            }
        )

    @property
    def fits(self) -> bool:
        """Whether the domain holds the length over which the film builds up."""
        needed, longest = self._inlets
        return needed <= longest

    def conditions_on(self, _: Grid) -> Conditions:
        """Operating conditions of a film on the domain of a grid."""
        return self.conditions

    def around(self, nodes: tuple[Array, ...], thickness: Array) -> tuple[float, float]:
        """Capacitance in vacuum [F] between roller and raceway outside the domain of the film.

        ``nodes``, nodes of the film along entrainment [m], shape (nx,); ``thickness`` [m], shape (nx,). The
        second number is that of a ball's contact: 0, as the gap outside continues the film.
        """
        (x,) = nodes
        ends = (float(x[0]), float(x[-1])), (float(thickness[0]), float(thickness[-1]))
        tails = roller_tails(roller_raceway_of(self.ring), self.conditions.half_width, *ends)
        return as_float(self.length * sum(tails)), 0.0


Contact: TypeAlias = BallContact | RollerContact


def check_contact(contact: Contact, grid: Grid | None = None) -> None:
    """Refuse a contact that is beyond the model, or whose grid does not fit into the memory.

    ``grid``, grid of film and field, where these are to be solved. Raises InputError where the contact is too
    slow for a film, too wide for its bodies, or its Hertz pressure too low, with ring and load; where the
    permittivity of the oil has no value at the Hertz pressure; MemoryLimitError where the machine cannot hold
    film and field on the grid.
    """
    conditions = contact.conditions
    try:
        # Entrainment speed of isothermal oil with this film.
        speed = conditions.contact.entrainment_speed
        if speed < _LEAST_SPEED:
            raise InputError(
                "contact",
                f"the film would be that of an entrainment speed of {speed:.3g} m/s",
                takes=f"an inner_speed and a film_factor that give at least {_LEAST_SPEED:g} m/s",
            )
        for half_width, radius in contact.widths:
            check_width(half_width, radius)
        check_pressure(conditions.max_pressure, contact.ring.oil)
        if grid is not None:
            check_grid(conditions.geometry, grid, rough=False)
    except InputError as error:
        raise error_of_contact(contact, error) from None


def error_of_contact(contact: Contact, error: InputError) -> InputError:
    """Error of a contact or its grid as an error of the bearing that names ring and load.

    Errors about other tables, such as the oil of the bearing file, stay as they are.
    """
    table = (error.key or "").partition(".")[0]
    if table not in ("contact", "grid"):
        return error
    text = error.text if error.key == "contact" else str(error)
    where = f"{contact.ring.name} contact at {contact.load:.4g} N"
    return error.retold("bearing", f"{where}: {text}")


def raceway_of(ring: RingContacts[BallBearing]) -> Raceway:
    """Groove of one ring, with a ball at the contact angle."""
    geometry, shoulder_height = ring.conditions.geometry, ring.conditions.bearing.shoulder_height
    assert shoulder_height is not None
    return Raceway.of(
        geometry.ball_diameter,
        geometry.pitch_diameter,
        geometry.inner_groove if ring.inner else geometry.outer_groove,
        shoulder_height,
        outer=not ring.inner,
        contact_angle=ring.angle,
    )


def roller_raceway_of(ring: RingContacts[RollerBearing]) -> RollerRaceway:
    """Raceway of one ring, with a roller on it."""
    radii = ring.radii
    return RollerRaceway(radii.element_x, abs(radii.ring_x), outer=not ring.inner)


def rigid_ball(ring: RingContacts[BallBearing], gap: Numbers) -> Numbers:
    """Capacitance in vacuum [F] of a rigid ball and its groove, a gap [m] apart, shape (...)."""
    return as_float(rigid_balls(raceway_of(ring), gap))


def rigid_roller(ring: RingContacts[RollerBearing], gap: Numbers) -> Numbers:
    """Capacitance in vacuum [F] of a rigid roller and its raceway, a gap [m] apart, shape (...)."""
    return as_float(ring.conditions.geometry.roller_length * rigid_rollers(roller_raceway_of(ring), gap))


@dataclass(frozen=True, eq=False, repr=False)
class ContactValues(Values, Generic[N]):
    """Quantities that change with the load, SI units: numbers of one contact or arrays of many."""

    # Hertz pressure of the dry contact [Pa], shape (n,).
    max_pressure: N = field(metadata=stored("", "Pa", "not negative"))
    # semi_axis_x and semi_axis_y: semi-axes of the dry contact along and across entrainment [m]; half of a
    # roller's length across, shape (n,).
    semi_axis_x: N = field(metadata=stored("", "m", "not negative"))
    semi_axis_y: N = field(metadata=stored("", "m", "not negative"))
    # minimum_thickness and central_thickness: film thickness, or the gap between bodies that do not touch
    # [m], shape (n,).
    minimum_thickness: N = field(metadata=stored("", "m", "not negative"))
    central_thickness: N = field(metadata=stored("", "m", "not negative"))
    # Capacitance over the domain of the film [F], shape (n,).
    inside: N = field(metadata=stored("", "F", "not negative"))
    # outside_oil and outside_air: capacitance outside the domain of the film, with oil and with air in the
    # gap [F], shape (n,).
    outside_oil: N = field(metadata=stored("", "F", "not negative"))
    outside_air: N = field(metadata=stored("", "F", "not negative"))
    # Capacitance eps0 eps_r A/h(0) of the Hertz area A as a plate [F], shape (n,).
    plate: N = field(metadata=stored("", "F", "not negative"))
    # Maximum field strength per volt on the contact [1/m], shape (n,).
    strength_per_volt: N = field(metadata=stored("", "1/m", "not negative"))
    # Voltage on the contact at which its film breaks down [V]; infinite without a strength, shape (n,).
    breakdown_voltage: N = field(metadata=stored("", "V", "positive or infinite"))
    # Part of ``inside`` over the Hertz area [F]; NaN of a result that does not have it, shape (n,).
    hertz: N = field(metadata=stored("", "F", "not negative or NaN"))

    def columns(self) -> tuple[N, ...]:
        """All quantities, in the order of the attributes."""
        return tuple(vars(self).values())


@dataclass(frozen=True, eq=False, repr=False)
class ContactSolution(Values):
    """Film, capacitances and voltages of one loaded contact, SI units."""

    load: float = field(metadata=stored("", "N", "increasing"))  # [N]
    values: ContactValues[float]  # film, capacitances and voltages
    # Estimated error of the film, relative: of the discretisation, or as the atlas or a formula states it.
    # None where it is unknown.
    error: float | None = field(metadata=stored("", "", "not negative or NaN", unknown=True))
    # moes_m and moes_l: load parameter M and lubricant parameter L of Moes, dimensionless.
    moes_m: float = field(metadata=stored("", "", "not negative"))
    moes_l: float = field(metadata=stored("", "", "not negative"))
    # Largest relative difference, at the edge of the domain, between the film thickness and the gap outside.
    mismatch: float = field(metadata=stored("", "", "finite or NaN"))
    converged: bool = field(metadata=stored("", "", "0 or 1"))
    warnings: tuple[ResultWarning, ...]  # warnings about the film and the field


def solve(contact: Contact, solver: Solver) -> ContactSolution:
    """Solve the film and the field of a contact; errors are those of ``check_contact``."""
    grid, ring = contact.grid, contact.ring
    check_contact(contact, grid)
    conditions = contact.conditions_on(grid)
    discharge = ring.discharge.model_copy(update={"length": contact.length})
    result = solve_contact(conditions, ring.oil, grid=grid, solver=solver, discharge=discharge)
    film, found = result.film, result.discharge
    assert found is not None
    breakdown = found.breakdown_voltage
    return solution_of(
        contact,
        (film.minimum_thickness, film.central_thickness),
        contact.around(film.axes, film.thickness),
        inside=contact.length * found.capacitance,
        plate=contact.length * found.capacitance_plate,
        strength_per_volt=result.field.max_strength / result.field.voltage,
        breakdown_voltage=np.inf if breakdown is None else breakdown,
        hertz=contact.length * found.capacitance_hertz,
        error=film.discretisation_error,
        converged=result.converged,
        warnings=without_regime(result.warnings),
    )


def solution_of(
    contact: Contact,
    films: tuple[float, float],
    around: tuple[float, float],
    *,
    error: float | None,
    converged: bool,
    warnings: tuple[ResultWarning, ...],
    **values: float,
) -> ContactSolution:
    """Solution of a contact.

    ``films``, minimum and central film thickness [m]; ``around``, the numbers of ``BallContact.around``;
    ``values``, the other values of ``ContactValues`` that do not follow from the dry contact.
    """
    outside, mismatch = around
    groups = contact.conditions.contact
    return ContactSolution(
        load=contact.load,
        values=ContactValues(
            max_pressure=contact.conditions.max_pressure,
            semi_axis_x=contact.axes[0],
            semi_axis_y=contact.axes[1],
            minimum_thickness=films[0],
            central_thickness=films[1],
            outside_oil=outside * contact.ring.conditions.oil.relative_permittivity,
            outside_air=outside,
            **values,
        ),
        error=error,
        moes_m=groups.moes_m,
        moes_l=groups.moes_l,
        mismatch=mismatch,
        converged=converged,
        warnings=warnings,
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
    """Quantities of a contact over its load, interpolated between solved loads."""

    solutions: tuple[ContactSolution, ...]  # solved contacts by increasing load

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
    def _law(self) -> Callable[[Array], Array]:
        """Quantities, shape (n, k), over k loads [N]."""
        return _interpolated(self.loads, np.stack(self.stack().columns(), axis=-1))

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
            left = _interpolated(np.delete(loads, k), others)(loads[k : k + 1])
            worst = max([worst, *np.abs(left[:, 0] / values[k, known] - 1.0)])
        return float(worst)


def _interpolated(loads: Array, values: Array) -> Callable[[Array], Array]:
    """Function of k loads [N] that interpolates values at m loads [N], shape (m, n), with a result (n, k).

    The interpolation is monotone in the logarithms of both. Beyond the ends the values are those at the ends.
    A column with any infinite value is infinite.
    """
    finite = np.all(np.isfinite(values), axis=0)
    ends = np.where(finite, values[0], np.inf)[:, np.newaxis]
    between = PchipInterpolator(np.log(loads), np.log(values[:, finite])) if loads.size > 1 else None

    def at(load: Array) -> Array:
        found = np.repeat(ends, np.size(load), axis=1)
        if between is not None:
            found[finite] = np.exp(between(np.log(np.clip(load, loads[0], loads[-1])))).T
        return found

    return at
