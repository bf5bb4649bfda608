"""Contacts of all elements with one ring: conditions, grids, and solved contacts over their load."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import ClassVar, Generic, TypeAlias

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask, N, Numbers, as_float
from ehlectric.bearing.ball_gaps import DomainLaw
from ehlectric.bearing.conditions import BearingConditions, G_co, RingConditions
from ehlectric.bearing.gap_tables import rigid_balls, rigid_rollers
from ehlectric.bearing.gaps import (
    COARSE,
    Raceway,
    RollerRaceway,
    match_film,
    outside_capacitance,
    roller_tails,
)
from ehlectric.bearing.loads.geometry import BallBearing, ContactRadii, RollerBearing
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.cases.grid_inputs import DEFAULT_ENDS, Grid, Solver, point_grid
from ehlectric.contact import (
    FARTHEST_LINE,
    FARTHEST_POINT,
    WIDEST_POINT,
    Conditions,
    DomainRule,
    Ends,
    PointConditions,
    check_grid,
    check_pressure,
    check_width,
    default_side,
    least_pressure,
)
from ehlectric.errors import InputError
from ehlectric.film import Ellipse
from ehlectric.formulas.film_line import moes
from ehlectric.formulas.film_point import nijenbanning_venner_moes
from ehlectric.formulas.hertz import DryContact, dry_contact, line_half_width, line_max_pressure
from ehlectric.formulas.monotone_cubic import MonotoneCubic, end_slope, inner_slope
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.field_metadata import stored
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable
from ehlectric.runtime.display import Values, read_only_property

# Discretisation error of the minimum film, relative, to which the grid of each contact is refined.
REFINE = 0.02

# Domains of balls: the default domain of solved contacts is the shortest one. The domain costs below 1 % of
# the film, or 15 % where the load of a ball is very light.
BALL_DOMAINS = DomainLaw(
    inlet=-DEFAULT_ENDS[True][0],
    outlet=DEFAULT_ENDS[True][1],
    side=default_side,
    rule=DomainRule(
        upstream=10.0,
        downstream=1.0,
        sideways=4.0,
        most=(FARTHEST_POINT, 0.1 * FARTHEST_POINT, WIDEST_POINT),
    ),
)

# Domains for contacts of which only ratios of results are used: errors of polynomials and of integrals are
# about 1e-5. Their polynomials need the integrals of 20 to 100 contacts, and fewer contacts than 150 are
# integrated one by one.
_COARSE_DOMAINS = replace(BALL_DOMAINS, coarseness=1e3, least=150, nodes=COARSE)

# Domains of rollers cost 0.3 to 1.2 % of the film. Beyond a hundred half-widths the inlet has eight lengths,
# and three hundred half-widths at the most, which costs 2.5 % of the film and 1.3 % of the capacitance: with
# longer inlets the films of very lightly loaded rollers often did not converge.
_ROLLER_DOMAINS = DomainRule(
    upstream=10.0,
    downstream=2.0,
    far=100.0,
    upstream_far=8.0,
    most=(FARTHEST_LINE, FARTHEST_LINE, 1.0),
)


@cache
def _checked_grid(*, of_point: bool) -> Grid:
    """Grid of a heavy contact, from which the grids of all contacts are copied.

    Contacts with other loads have further ends and more nodes, which need no further check.
    """
    table = {"nodes": 129 if of_point else 801, "refine": REFINE}
    return Grid.from_dict(point_grid(table) if of_point else table)


# Largest film thickness over (f - 1/2) D, the difference of the radii of groove and ball, at which the film
# does not change contact angle and gap. For a roller, the largest length sqrt(2 R h) over which the film
# builds up, over the roller's radius, at which the roller is still a parabola.
_ROOM = 0.1

# Least entrainment speed of a contact [m/s], the same as in a case: slower contacts have no film, and the
# numbers of their film equations leave the range of floating-point arithmetic.
_LEAST_SPEED = 1e-9


@dataclass(frozen=True)
class RingContacts(Generic[G_co]):
    """Contacts of all elements with one ring, without their loads.

    Quantities of one bearing are numbers, quantities of many points of operation have the shape (...).
    """

    conditions: BearingConditions[G_co]
    inner: bool  # True for the inner ring, False for the outer ring
    angle: Numbers  # contact angle at which the radii are taken [rad]
    speed: Numbers  # entrainment speed (u1 + u2)/2 [m/s]

    @property
    def name(self) -> str:
        """Name of the ring, "inner" or "outer"."""
        return "inner" if self.inner else "outer"

    @property
    def _conditions(self) -> RingConditions:
        return self.conditions.inner if self.inner else self.conditions.outer

    @property
    def oil(self) -> Oil:
        """Oil in the contacts, at the temperature of the ring."""
        return self._conditions.oil

    @property
    def discharge(self) -> Discharge:
        """Dielectric strength and conductivity in the contacts, at the temperature of the ring."""
        return self._conditions.discharge

    @property
    def film_factor(self) -> Numbers:
        """Film thickness divided by the isothermal, fully flooded thickness, dimensionless, at most 1."""
        return self._conditions.film_factor

    @property
    def supply_factor(self) -> Numbers:
        """Part of the film factor by the supply of oil, dimensionless; 1 where it is not known."""
        return 1.0 if self._conditions.supply_factor is None else self._conditions.supply_factor

    @read_only_property
    def radii(self) -> ContactRadii:
        """Radii of element and ring at the contact angle [m]."""
        return self.conditions.geometry.radii(self.angle, inner=self.inner)

    @read_only_property
    def shape(self) -> tuple[int, ...]:
        """Shape (...) of the points of operation; () for one bearing."""
        radii, oil = self.radii, self.oil
        quantities = (self.angle, self.speed, self.conditions.modulus, self.film_factor, radii.radius_x)
        return np.broadcast_shapes(*map(np.shape, (*quantities, radii.radius_y, oil.viscosity)))

    @read_only_property
    def entrainment_speed(self) -> Numbers:
        """Entrainment speed [m/s]; of many points, NaN where it is too slow for a film."""
        if np.ndim(self.speed) == 0:
            return self.speed
        return np.where(self.speed >= _LEAST_SPEED, self.speed, np.nan)

    @read_only_property
    def unit_contact(self) -> DryContact:
        """Dry contact of a ball under a load of 1 N."""
        rx: Numbers = self.radii.radius_x
        ry: Numbers = self.radii.radius_y
        if np.ndim(rx) or np.ndim(ry):
            # Points without radii have no equilibrium; their numbers are not used.
            rx, ry = (np.where(np.isfinite(radius), radius, 1.0) for radius in (rx, ry))
        return dry_contact(1.0, rx, ry, self.conditions.modulus)

    @read_only_property
    def raceway(self: RingContacts[BallBearing]) -> Raceway:
        """Groove of the ring, with a ball at the contact angle."""
        geometry, shoulder_height = self.conditions.geometry, self.conditions.bearing.shoulder_height
        assert shoulder_height is not None
        first = geometry.first_angles[0 if self.inner else 1]
        # The halves of an arch are alike.
        angle = self.angle if first is None else as_float(np.abs(self.angle))
        return Raceway.of(
            geometry.ball_diameter,
            geometry.pitch_diameter,
            geometry.inner_groove if self.inner else geometry.outer_groove,
            shoulder_height,
            outer=not self.inner,
            contact_angle=angle,
            bottom_angle=geometry.bottom_angle,
            first_angle=first,
        )

    @read_only_property
    def ratio(self) -> Numbers:
        """Ratio of the semi-axes of a ball's contact, across over along entrainment."""
        return self.unit_contact.semi_axis_y / self.unit_contact.semi_axis_x

    @read_only_property
    def ellipse(self) -> Ellipse:
        """Shape of the dry contact of a ball."""
        return Ellipse.of(self.ratio, self.radii.radius_y / self.radii.radius_x)


@dataclass(frozen=True)
class BallContact:
    """Contact of a ball with a ring under a load, or of many balls.

    Many loads have the shape (m, ...), with the points of operation of the ring last, and so have all numbers
    of the contacts. A contact that is solved, or has a grid, has one load.
    """

    length: ClassVar[float] = 1.0  # results of a point contact are not per length

    ring: RingContacts[BallBearing]
    load: Numbers  # [N]
    coarse: bool = False  # whether only ratios of results are used, so that gaps are computed coarsely

    @read_only_property
    def dry(self) -> DryContact:
        """Dry contact under the load."""
        unit, root = self.ring.unit_contact, as_float(np.cbrt(self.load))
        return DryContact(
            semi_axis_x=unit.semi_axis_x * root,
            semi_axis_y=unit.semi_axis_y * root,
            max_pressure=unit.max_pressure * root,
            approach=unit.approach * root**2,
        )

    @read_only_property
    def conditions(self) -> PointConditions[Numbers]:
        """Operating conditions of the point contact, which ``check_contact`` may still refuse."""
        bearing, oil, radii, dry = self.ring.conditions, self.ring.oil, self.ring.radii, self.dry
        return PointConditions(
            radius_x=radii.radius_x,
            radius_y=radii.radius_y,
            reduced_modulus=bearing.modulus,
            load=self.load,
            entrainment_speed=self.ring.entrainment_speed,
            slide_to_roll_ratio=0.0,
            viscosity=oil.viscosity,
            pressure_viscosity_coefficient=oil.alpha_star,
            semi_axis_x=dry.semi_axis_x,
            semi_axis_y=dry.semi_axis_y,
            max_pressure=dry.max_pressure,
            side=default_side(self.ring.ratio),
            compliance_share=bearing.ring_share,
            film_factor=self.ring.film_factor,
        )

    @property
    def domains(self) -> DomainLaw:
        """Law of the domains of the films of many balls."""
        return _COARSE_DOMAINS if self.coarse else BALL_DOMAINS

    @property
    def axes(self) -> tuple[Numbers, Numbers]:
        """Semi-axes of the dry contact along and across entrainment [m]."""
        return self.dry.semi_axis_x, self.dry.semi_axis_y

    @property
    def area(self) -> Numbers:
        """Area of the dry contact [m^2]."""
        return as_float(np.pi * self.axes[0] * self.axes[1])

    @property
    def widths(self) -> tuple[tuple[Numbers, Numbers], ...]:
        """Semi-axes of the dry contact along and across, each with the smallest radius in its plane [m]."""
        radii = self.ring.radii
        along = _smallest(radii.radius_x, radii.ring_x, radii.element_x)
        across = _smallest(radii.radius_y, radii.ring_y, radii.element_y)
        return (self.axes[0], along), (self.axes[1], across)

    @read_only_property
    def film(self) -> Numbers:
        """Central film thickness [m] by the formula of Nijenbanning, Venner and Moes.

        The formula also holds for light contacts.
        """
        return nijenbanning_venner_moes(self.conditions.contact).central_thickness

    @property
    def thickest_film(self) -> Numbers:
        """Largest film thickness [m] for which there is room between ball and groove."""
        return _ROOM * self.ring.conditions.geometry.offsets[0 if self.ring.inner else 1]

    @read_only_property
    def _lengths(self) -> tuple[Numbers, Numbers]:
        """Lengths sqrt(2 R h) over which the pressure builds up, along and across, in semi-axes."""
        radii, axes = self.ring.radii, self.axes
        along, across = (
            np.sqrt(2.0 * radius * self.film) / axis
            for radius, axis in zip((radii.radius_x, radii.radius_y), axes, strict=True)
        )
        return along, across

    @read_only_property
    def domain(self) -> Ends:
        """Inlet, outlet and side in semi-axes of a domain wide enough for the thick film of a light load.

        Heavy loads have the default domain of point contacts.
        """
        law = self.domains
        return law.rule.ends((law.inlet, law.outlet, self.conditions.side), *self._lengths)

    @property
    def grid(self) -> Grid:
        """Grid of film and field in semi-axes, on the domain of the contact."""
        inlet, outlet, side = map(float, self.domain)
        nodes = max(129, 8 * math.ceil(inlet + outlet) + 1, 16 * math.ceil(side) + 1)
        ends = {"inlet": -inlet, "outlet": outlet, "side": side}
        return _checked_grid(of_point=True).model_copy(update=ends | {"nodes": nodes})

    @property
    def part_needed(self) -> Numbers:
        """Ends of the domain that the film needs over the largest ends: above 1 where it is cut off."""
        return self.domains.rule.part_needed(*self._lengths)

    def conditions_on(self, grid: Grid) -> PointConditions:
        """Operating conditions of a film on the domain of a grid."""
        assert grid.side is not None
        return PointConditions(**vars(self.conditions) | {"side": grid.side})

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
        raceway, modulus = self.ring.raceway, self.ring.conditions.modulus
        matched = match_film(raceway, self.dry, modulus, x=x[rim], y=y[rim], thickness=thickness[rim])
        return float(outside_capacitance(raceway, matched, domain)), float(matched.mismatch)


@dataclass(frozen=True)
class RollerContact:
    """Contact of a roller with a ring under a load, or of many rollers.

    Many loads have the shape (m, ...), as the loads of balls.
    """

    ring: RingContacts[RollerBearing]
    load: Numbers  # [N]
    coarse: bool = False  # as for balls; the gaps of rollers take little time

    @property
    def length(self) -> Numbers:
        """Length of the roller [m]."""
        return self.ring.conditions.geometry.roller_length

    @read_only_property
    def conditions(self) -> Conditions[Numbers]:
        """Operating conditions of the line contact, which ``check_contact`` may still refuse."""
        bearing, oil, radii = self.ring.conditions, self.ring.oil, self.ring.radii
        radius, modulus, load_per_length = radii.radius_x, bearing.modulus, self.load / self.length
        return Conditions(
            reduced_radius=radius,
            reduced_modulus=modulus,
            load_per_length=load_per_length,
            entrainment_speed=self.ring.entrainment_speed,
            slide_to_roll_ratio=0.0,
            viscosity=oil.viscosity,
            pressure_viscosity_coefficient=oil.alpha_star,
            half_width=line_half_width(load_per_length=load_per_length, radius=radius, modulus=modulus),
            max_pressure=line_max_pressure(load_per_length=load_per_length, radius=radius, modulus=modulus),
            curvature_share=radius / radii.ring_x,
            compliance_share=bearing.ring_share,
            film_factor=self.ring.film_factor,
        )

    @property
    def axes(self) -> tuple[Numbers, Numbers]:
        """Half-width of the dry contact along entrainment, and half of its length across [m]."""
        return self.conditions.half_width, 0.5 * self.length

    @property
    def area(self) -> Numbers:
        """Area of the dry contact [m^2]."""
        return 4.0 * self.axes[0] * self.axes[1]

    @property
    def widths(self) -> tuple[tuple[Numbers, Numbers], ...]:
        """Half-width of the dry contact, with the smallest radius in its plane [m]."""
        radii = self.ring.radii
        return ((self.conditions.half_width, _smallest(radii.radius_x, radii.ring_x, radii.element_x)),)

    @read_only_property
    def film(self) -> Numbers:
        """Central film thickness [m] by the formula of Moes, which also holds for light contacts."""
        return moes(self.conditions.contact).central_thickness

    @property
    def thickest_film(self) -> Numbers:
        """Largest film thickness [m] for which the roller is a parabola where its film builds up."""
        radius = 0.5 * self.ring.conditions.geometry.roller_diameter
        return (_ROOM * radius) ** 2 / (2.0 * self.conditions.reduced_radius)

    @read_only_property
    def _build_up(self) -> Numbers:
        """Length sqrt(2 R h) over which the pressure builds up, in half-widths."""
        conditions = self.conditions
        return np.sqrt(2.0 * conditions.reduced_radius * self.film) / conditions.half_width

    @read_only_property
    def _domains(self) -> DomainRule:
        """Rule of the domain, whose ends are at most as far as a parabola describes the roller."""
        parabola = 0.5 * self.ring.radii.element_x / self.conditions.half_width
        longest = np.minimum(parabola, _ROLLER_DOMAINS.most[0])
        return replace(_ROLLER_DOMAINS, most=(longest, longest, 1.0))

    @read_only_property
    def domain(self) -> Ends:
        """Inlet and outlet in half-widths, long enough for the thick film of a light load; and 1."""
        inlet, outlet = DEFAULT_ENDS[False]
        return self._domains.ends((-inlet, outlet, 1.0), self._build_up)

    @property
    def grid(self) -> Grid:
        """Grid of film and field in half-widths, on the domain of the contact."""
        length = float(self._build_up)
        inlet, outlet, _ = map(float, self.domain)
        return _checked_grid(of_point=False).model_copy(
            update={
                "inlet": -inlet,
                "outlet": outlet,
                # A grid takes sixteen nodes or more in the Hertz zone.
                "nodes": max(801, 8 * math.ceil(inlet + outlet) + 1),
                # Grids reach a hundred half-widths for the field at the most, and 1.25 by default.
                "field_range": (
                    -max(1.25, min(length, inlet, 100.0)),
                    max(1.25, min(length, outlet, 100.0)),
                ),
            }
        )

    @property
    def part_needed(self) -> Numbers:
        """Inlet that the film needs over the largest inlet: above 1 where it is cut off."""
        return self._domains.part_needed(self._build_up)

    def conditions_on(self, _: Grid) -> Conditions:
        """Operating conditions of a film on the domain of a grid."""
        return Conditions(**vars(self.conditions))

    def around(self, nodes: tuple[Array, ...], thickness: Array) -> tuple[float, float]:
        """Capacitance in vacuum [F] between roller and raceway outside the domain of the film.

        ``nodes``, nodes of the film along entrainment [m], shape (nx,); ``thickness`` [m], shape (nx,). The
        second number belongs to a ball's contact: 0, as the gap outside continues the film.
        """
        (x,) = nodes
        ends = (float(x[0]), float(x[-1])), (float(thickness[0]), float(thickness[-1]))
        tails = roller_tails(roller_raceway_of(self.ring), self.conditions.half_width, *ends)
        return float(self.length * sum(tails)), 0.0


Contact: TypeAlias = BallContact | RollerContact


def _smallest(*radii: Numbers) -> Numbers:
    """Smallest of several radii [m], of which negative radii belong to concave bodies."""
    first, *others = radii
    for radius in others:
        first = np.minimum(first, np.abs(radius))
    return as_float(first)


def _film_speed(contact: Contact) -> Numbers:
    """Entrainment speed of isothermal oil with the film of a contact [m/s]."""
    return contact.conditions.contact.entrainment_speed


def beyond_model(contact: Contact) -> Mask:
    """Whether contacts are too slow for a film, too wide for their bodies, or too lightly loaded, shape (m,
    ...).

    ``check_contact`` refuses such a contact, and says why.
    """
    conditions = contact.conditions
    held = _film_speed(contact) >= _LEAST_SPEED
    held = held & (conditions.max_pressure >= least_pressure(contact.ring.oil))
    for half_width, radius in contact.widths:
        held = held & (half_width <= 0.5 * radius)
    return np.asarray(~held)


def check_contact(contact: Contact, grid: Grid | None = None) -> None:
    """Refuse a contact that is beyond the model, or whose grid does not fit into the memory.

    ``grid``, grid of film and field, where these are to be solved. Raises InputError where the contact is too
    slow for a film, too wide for its bodies, or its Hertz pressure too low, with ring and load; where the
    permittivity of the oil has no value at the Hertz pressure; MemoryLimitError where the machine cannot hold
    film and field on the grid.
    """
    conditions = contact.conditions
    try:
        speed = _film_speed(contact)
        if speed < _LEAST_SPEED:
            raise InputError(
                "contact",
                f"the film would need an entrainment speed of {readable(float(speed))} m/s",
                takes=f"an inner_speed and a film_factor that give at least {_LEAST_SPEED:g} m/s",
            )
        for half_width, radius in contact.widths:
            check_width(float(half_width), float(radius))
        check_pressure(float(conditions.max_pressure), contact.ring.oil)
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
    where = f"{contact.ring.name} contact at {readable(float(contact.load), 4)} N"
    return error.with_text("bearing", f"{where}: {text}")


def roller_raceway_of(ring: RingContacts[RollerBearing]) -> RollerRaceway:
    """Raceway of one ring, with a roller on it."""
    radii = ring.radii
    # The flat washer of a thrust bearing is a large circle.
    race = np.minimum(np.abs(radii.ring_x), _FLAT * radii.element_x)
    return RollerRaceway(radii.element_x, as_float(race), outer=not ring.inner)


# Radius divided by the radius of the roller at which a raceway is flat: its curvature changes the gap by
# 1e-6.
_FLAT = 1e6


def rigid_ball(ring: RingContacts[BallBearing], gap: Numbers) -> Numbers:
    """Capacitance in vacuum [F] of a rigid ball and its groove, a gap [m] apart, shape (...)."""
    return as_float(rigid_balls(ring.raceway, gap))


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
    """Solve the film and the field of a contact; raises the errors of ``check_contact``."""
    from ehlectric.contact import solve_contact  # late: bearings of the atlas do not need it

    grid, ring = contact.grid, contact.ring
    check_contact(contact, grid)
    conditions = contact.conditions_on(grid)
    discharge = ring.discharge.model_copy(update={"length": contact.length})
    result = solve_contact(conditions, ring.oil, grid=grid, solver=solver, discharge=discharge)
    film, assessment = result.film, result.discharge
    assert assessment is not None
    breakdown = assessment.breakdown_voltage
    return solution_of(
        contact,
        (film.minimum_thickness, film.central_thickness),
        contact.around(film.axes, film.thickness),
        inside=contact.length * assessment.capacitance,
        plate=contact.length * assessment.capacitance_plate,
        strength_per_volt=result.field.max_strength / result.field.voltage,
        breakdown_voltage=np.inf if breakdown is None else breakdown,
        hertz=contact.length * assessment.capacitance_hertz,
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
        load=float(contact.load),
        values=ContactValues(
            max_pressure=float(contact.conditions.max_pressure),
            semi_axis_x=float(contact.axes[0]),
            semi_axis_y=float(contact.axes[1]),
            minimum_thickness=films[0],
            central_thickness=films[1],
            outside_oil=outside * float(contact.ring.conditions.oil.relative_permittivity),
            outside_air=outside,
            **values,
        ),
        error=error,
        moes_m=float(groups.moes_m),
        moes_l=float(groups.moes_l),
        mismatch=mismatch,
        converged=converged,
        warnings=warnings,
    )


def without_regime(warnings: Iterable[ResultWarning]) -> tuple[ResultWarning, ...]:
    """Warnings without those that are not about a contact of a bearing.

    The domain of a contact suits its regime, and the voltage of a single contact is not the voltage of the
    bearing. The films of light contacts are too thin by what their domain cuts off, which makes no margin too
    large: by 0.3 to 2.4 % under rollers, by more under very lightly loaded balls. Inputs of the bearing have
    checks of their own, and light contacts of every bearing have unusual pressures.
    """
    of_domain = {"inlet-too-short", "domain-too-small", "domain-far-too-small"}
    left_out = {"regime", "breakdown-expected", "value-unusual", *of_domain}
    return tuple(warning for warning in warnings if warning.code not in left_out)


# Part of the largest load of a ring below which a contact is light: its film is thick, so that it never
# breaks down first and barely changes the circuit of the bearing. A load of this part is solved, to rounding.
_LIGHT, _ROUNDED = 0.02, 1.0 - 1e-9


@dataclass(frozen=True, eq=False, repr=False)
class ContactCurve(Values):
    """Quantities of contacts over their load, interpolated between m loads, of one bearing or many points.

    Arrays of many points of operation have the shape (..., m), arrays of one bearing (m,). Points with fewer
    loads than others have ``used`` False at the first ones.
    """

    loads: Array  # [N], increasing where they are used
    values: ContactValues[Array]
    error: Array  # relative error of the films; NaN where it is unknown
    # moes_m and moes_l: load parameter M and lubricant parameter L of Moes, dimensionless.
    moes_m: Array
    moes_l: Array
    mismatch: Array  # largest relative difference at the edge of the domain; see ``ContactSolution``
    converged: Mask
    used: Mask  # contacts between which quantities are interpolated; there is at least the last one
    # Warnings about the film and the field of each contact in use of a single bearing.
    warnings_of: Callable[[], Sequence[tuple[ResultWarning, ...]]] = field(compare=False)
    left: Mask | None = field(default=None, compare=False)  # contacts of the atlas that it does not have
    # Quantities that follow from another one, or from the "load": its name, and the exponent of their power.
    follows: Mapping[str, tuple[str, float]] = field(default_factory=dict, compare=False)
    # Points of operation with a contact beyond the model, shape (...); their numbers have no meaning.
    refused: Mask | bool = field(default=False, compare=False)

    @classmethod
    def of(cls, solutions: Sequence[ContactSolution]) -> ContactCurve:
        """Curve through solved contacts of one bearing by increasing load."""

        def column(name: str) -> Array:
            return np.array([getattr(contact, name) for contact in solutions], dtype=float)

        rows = [contact.values.columns() for contact in solutions]
        return cls(
            loads=column("load"),
            values=ContactValues(*np.array(rows, dtype=float).T),
            error=column("error"),
            moes_m=column("moes_m"),
            moes_l=column("moes_l"),
            mismatch=column("mismatch"),
            converged=np.array([contact.converged for contact in solutions]),
            used=np.ones(len(solutions), dtype=bool),
            warnings_of=_Given(tuple(contact.warnings for contact in solutions)),
        )

    def __eq__(self, other: object) -> bool:
        """Whether two curves are equal, curves of single bearings with their warnings."""
        if not isinstance(other, ContactCurve):
            return NotImplemented
        if not super().__eq__(other):
            return False
        return self.loads.ndim > 1 or self.warnings == other.warnings

    __hash__ = None

    @read_only_property
    def warnings(self) -> tuple[tuple[ResultWarning, ...], ...]:
        """Warnings about each contact in use, of a single bearing."""
        return tuple(self.warnings_of())

    @read_only_property
    def solutions(self) -> tuple[ContactSolution, ...]:
        """Contacts of a single bearing by increasing load."""
        used = self.used
        rows = zip(*(column[used].tolist() for column in self.values.columns()), strict=True)
        return tuple(
            ContactSolution(
                load=load,
                values=ContactValues(*row),
                error=None if math.isnan(error) else error,
                moes_m=moes_m,
                moes_l=moes_l,
                mismatch=mismatch,
                converged=converged,
                warnings=warnings,
            )
            for row, load, error, moes_m, moes_l, mismatch, converged, warnings in zip(
                rows, *(column[used].tolist() for column in self._numbers), self.warnings, strict=True
            )
        )

    @property
    def _numbers(self) -> tuple[Array | Mask, ...]:
        """Numbers of each contact other than its values, in the order of ``ContactSolution``."""
        return self.loads, self.error, self.moes_m, self.moes_l, self.mismatch, self.converged

    @property
    def first(self) -> IntArray:
        """Place of the first load in use, shape (...)."""
        return np.asarray(self.used.shape[-1] - np.count_nonzero(self.used, axis=-1))

    @property
    def least_load(self) -> Numbers:
        """Least load in use [N], shape (...)."""
        return self._at_first(self.loads)

    @property
    def thickest_film(self) -> Numbers:
        """Central film thickness at the least load [m], shape (...)."""
        return self._at_first(self.values.central_thickness)

    def _at_first(self, column: Array) -> Numbers:
        """Number at the first load in use, shape (...)."""
        return as_float(np.take_along_axis(column, self.first[..., np.newaxis], -1)[..., 0])

    @property
    def largest_error(self) -> Numbers:
        """Largest relative error of the films that is known, shape (...)."""
        known = self.used & ~np.isnan(self.error)
        return as_float(np.max(np.where(known, self.error, 0.0), axis=-1))

    def stack(self) -> ContactValues[Array]:
        """Quantities at the loads of a single bearing, as arrays."""
        return ContactValues(*(column[self.used] for column in self.values.columns()))

    def at(self, load: Array) -> ContactValues[Array]:
        """Quantities at loads [N], shape (..., k), interpolated in the logarithms of load and quantity.

        The interpolation is monotone. Beyond the ends the values equal the values at the ends. A quantity
        with any infinite value is infinite.
        """
        names, finite, between = self._law
        load = np.clip(load, np.asarray(self.least_load)[..., np.newaxis], self.loads[..., -1:])
        rows = np.ascontiguousarray(np.exp(between(np.log(load))))
        if not finite.all():
            rows = np.where(finite[..., np.newaxis], rows, np.inf)
        values = dict(zip(names, rows, strict=True))
        for name, (base, exponent) in self.follows.items():
            at, last = (load, self.loads) if base == "load" else (values[base], getattr(self.values, base))
            factor = getattr(self.values, name)[..., -1:]
            values[name] = factor * _power(at / last[..., -1:], exponent)
        return ContactValues(**values)

    @read_only_property
    def _law(self) -> tuple[list[str], Mask, MonotoneCubic]:
        """Quantities that are interpolated, whether they are finite, shape (n, ...), and their logarithms."""
        names = [name for name in vars(self.values) if name not in self.follows]
        columns = np.stack([getattr(self.values, name) for name in names])
        finite = np.all(np.isfinite(columns) | ~self.used, axis=-1)
        logs = np.log(np.where(finite[..., np.newaxis] & self.used, columns, 1.0))
        return names, finite, MonotoneCubic(np.log(self.loads), logs, self.first)

    @read_only_property
    def counted(self) -> ContactCurve:
        """Contacts whose films decide about the circuit: those that are not light."""
        heavy = self.used & self._heavy
        if np.array_equal(heavy, self.used):
            return self
        warnings = _Heavy(self, heavy[self.used]) if self.loads.ndim == 1 else self.warnings_of
        return replace(self, used=heavy, warnings_of=warnings)

    @property
    def _heavy(self) -> Mask:
        """Loads that are not light."""
        return self.loads >= _ROUNDED * _LIGHT * self.loads[..., -1:]

    @read_only_property
    def interpolation_error(self) -> Numbers:
        """Largest relative error of capacitance and breakdown voltage when one load is omitted, shape (...).

        Without that load the distance of the loads is twice as large. The interpolation error with all loads
        is therefore expected to be smaller. The breakdown voltage of contacts with less than 2 % of the
        largest load does not count.
        """
        if self.loads.shape[-1] < 3:
            return as_float(np.zeros(self.loads.shape[:-1]))
        values = np.stack([self.values.inside, self.values.breakdown_voltage])
        finite = np.isfinite(values) | ~self.used
        # A quantity that is infinite at another load is also infinite where this load is omitted.
        others = np.all(finite, axis=-1, keepdims=True)
        logs = np.log(np.where(others & self.used, values, 1.0))
        missed = np.abs(np.exp(left_out(np.log(self.loads), logs, self.first) - logs[..., 1:-1]) - 1.0)
        missed = np.where(others, missed, np.inf)
        counts = finite[..., 1:-1] & np.stack([np.ones_like(self.used), self._heavy])[..., 1:-1]
        inner = np.arange(1, self.loads.shape[-1] - 1) > self.first[..., np.newaxis]
        return as_float(np.max(np.where(counts & inner, missed, 0.0), axis=(0, -1)))


def left_out(x: Array, y: Array, first: IntArray) -> Array:
    """Values at the inner nodes of monotone curves that each omit this node, shape (c, ..., m - 2).

    ``x``, increasing abscissae, shape (..., m); ``y``, values, shape (c, ..., m); ``first``, place of the
    first node in use, shape (...), at least one before the inner nodes whose result is used.
    """
    size = x.shape[-1]
    place = np.arange(1, size - 1)
    # The interval without the node, and its neighbours before and after it, where there are any.
    before, after = place - 1, place + 1
    further, beyond = np.maximum(place - 2, 0), np.minimum(place + 2, size - 1)
    steps, chords = [], []
    for low, high in ((further, before), (before, after), (after, beyond)):
        step = x[..., high] - x[..., low]
        step = np.where(step > 0.0, step, 1.0)
        steps.append(step)
        chords.append((y[..., high] - y[..., low]) / step)
    at_start, at_end = before == first[..., np.newaxis], after == size - 1
    left = np.where(
        at_start,
        np.where(at_end, chords[1], end_slope(steps[1], steps[2], chords[1], chords[2])),
        inner_slope(steps[0], steps[1], chords[0], chords[1]),
    )
    right = np.where(
        at_end,
        np.where(at_start, chords[1], end_slope(steps[1], steps[0], chords[1], chords[0])),
        inner_slope(steps[1], steps[2], chords[1], chords[2]),
    )
    t = (x[..., 1:-1] - x[..., :-2]) / steps[1]
    rest = 1.0 - t
    ends = (1.0 + 2.0 * t) * rest**2 * y[..., :-2] + t**2 * (3.0 - 2.0 * t) * y[..., 2:]
    return ends + steps[1] * (t * rest**2 * left - t**2 * rest * right)


def _power(ratio: Array, exponent: float) -> Numbers:
    """Power of a ratio; powers of dry contacts and of proportional quantities take little time."""
    if exponent == 1.0:
        return ratio
    if exponent == -1.0:
        return 1.0 / ratio
    if exponent == 1.0 / 3.0:
        return np.cbrt(ratio)
    return np.sqrt(ratio) if exponent == 0.5 else ratio**exponent


@dataclass(frozen=True)
class _Given:
    """Warnings of contacts that are known."""

    warnings: tuple[tuple[ResultWarning, ...], ...]

    def __call__(self) -> tuple[tuple[ResultWarning, ...], ...]:
        return self.warnings


@dataclass(frozen=True, eq=False)
class _Heavy:
    """Warnings of those contacts of a curve that are not light."""

    curve: ContactCurve
    heavy: Mask

    def __call__(self) -> tuple[tuple[ResultWarning, ...], ...]:
        return tuple(
            warnings for warnings, heavy in zip(self.curve.warnings, self.heavy, strict=True) if heavy
        )
