"""Contacts of a bearing with one ring, solved over its loads: film, capacitance and breakdown voltage."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.bearing_duty import BearingDuty
from ehlectric.bearing_geometry import RollerBearing
from ehlectric.bearing_inputs import Bearing
from ehlectric.case import Case
from ehlectric.conditions import effective_alpha
from ehlectric.discharge_inputs import Discharge
from ehlectric.film_formulas import LineContact, moes
from ehlectric.groove_gap import Raceway, match_film, outside_capacitance
from ehlectric.hertz import line_half_width
from ehlectric.hertz_point import dry_contact
from ehlectric.point_conditions import default_side
from ehlectric.point_formulas import PointContact, nijenbanning_venner_moes
from ehlectric.point_result import PointResult
from ehlectric.result import Result
from ehlectric.roller_gap import RollerRace, roller_tails
from ehlectric.solver import solve
from ehlectric.typing import Array

# Domain of a lightly loaded contact in lengths over which its pressure builds up, before, beside and behind
# it. It costs below 1 % of the film, or 15 % where a ball hardly presses. And the most that a grid holds of
# what is before and beside, in semi-axes.
_ALONG, _ACROSS, _BEHIND, _MOST = 10.0, 4.0, 1.0, (48.0, 24.0)

# As much of rollers before and behind the contact: they cost 0.6 % of the film.
_LINE_INLET, _LINE_OUTLET = 10.0, 2.0

# Error of the minimum film that grids are refined to.
REFINE = 0.03


@dataclass(frozen=True)
class ContactSolution:
    """One loaded contact, SI units.

    Attributes
    ----------
    load : float
        [N].
    max_pressure, semi_axis_x, semi_axis_y : float
        Of the dry contact [Pa, m]; of a roller half of its length across.
    minimum_thickness, central_thickness : float
        Of the film [m].
    inside, outside_oil, outside_air : float
        Capacitance over the film's domain, and outside it with oil and with air there [F].
    plate : float
        eps0 eps_r A/h(0) [F].
    breakdown_voltage : float
        [V]; infinite without a strength.
    error : float or None
        Estimate of the film's discretisation error, relative.
    moes_m, moes_l : float
        Moes' groups.
    mismatch : float
        Largest difference of the gaps at the edge of the film's domain, relative.
    warnings : tuple of str
        Of its solution.
    """

    load: float
    max_pressure: float
    semi_axis_x: float
    semi_axis_y: float
    minimum_thickness: float
    central_thickness: float
    inside: float
    outside_oil: float
    outside_air: float
    plate: float
    breakdown_voltage: float
    error: float | None
    moes_m: float
    moes_l: float
    mismatch: float
    converged: bool
    warnings: tuple[str, ...]


@dataclass(frozen=True)
class Race:
    """The contacts of all elements with one ring: all but the load.

    Attributes
    ----------
    inner : bool
        Which ring.
    angle : float
        Contact angle that the radii are taken at [rad].
    speed : float
        Entrainment speed [m/s], the film factor in it.
    """

    inner: bool
    angle: float
    speed: float


def contact_case(
    duty: BearingDuty, race: Race, load: float, discharge: Discharge, solver: dict[str, Any]
) -> Case:
    """The case of one contact at a load [N]."""
    radii = duty.radii(race.angle, inner=race.inner)
    ring = {"youngs_modulus": duty.ring.youngs_modulus, "poissons_ratio": duty.ring.poissons_ratio}
    element = {
        "youngs_modulus": duty.element.youngs_modulus,
        "poissons_ratio": duty.element.poissons_ratio,
    }
    contact: dict[str, Any] = {"entrainment_speed": race.speed}
    if isinstance(duty.geometry, RollerBearing):
        contact |= {
            "radius_1": radii.ring_x,
            "radius_2": radii.element_x,
            "body_1": ring,
            "body_2": element,
            "load_per_length": load / duty.geometry.roller_length,
        }
        assess: dict[str, Any] = {"length": duty.geometry.roller_length}
        grid = _line_domain(duty, race, load)
    else:
        contact |= {
            "geometry": "point",
            "body_1": ring | {"radius_x": radii.ring_x, "radius_y": radii.ring_y},
            "body_2": element | {"radius_x": radii.element_x, "radius_y": radii.element_y},
            "load": load,
        }
        assess, grid = {}, _point_domain(duty, race, load)
    return Case.from_dict(
        {
            "contact": contact,
            # Pressures are those above ambient, which acts on the bodies from all sides.
            "lubricant": duty.lubricant.model_dump(exclude_none=True, exclude={"base"})
            | {"ambient_pressure": 0.0},
            "grid": grid | {"refine": REFINE},
            "discharge": discharge.model_dump(exclude_none=True) | assess,
            "solver": solver,
        }
    )


def _line_length(duty: BearingDuty, race: Race, load: float) -> float:
    """Length sqrt(2 R h) over which a roller's pressure builds up, in half-widths; load in N."""
    radius = duty.radii(race.angle, inner=race.inner).radius_x
    assert isinstance(duty.geometry, RollerBearing)
    width, alpha = load / duty.geometry.roller_length, effective_alpha(duty.lubricant)
    formula = moes(LineContact(radius, duty.modulus, width, race.speed, duty.lubricant.viscosity, alpha))
    assert formula.central_thickness is not None
    return math.sqrt(2.0 * radius * formula.central_thickness) / line_half_width(width, radius, duty.modulus)


def _line_domain(duty: BearingDuty, race: Race, load: float) -> dict[str, Any]:
    """Domain of a roller's contact at a load [N], long enough for the thick film of a light one too."""
    length, most = _line_length(duty, race, load), _line_most(duty, race, load)
    inlet = max(4.0, min(_LINE_INLET * length, most))
    outlet = max(2.0, min(_LINE_OUTLET * length, most))
    # Sixteen nodes in the Hertz zone are the least that a case takes.
    nodes = max(3201, 8 * math.ceil(inlet + outlet) + 1)
    # The field's ends are those of a case's.
    field = [-max(1.25, min(length, inlet, 100.0)), max(1.25, min(length, outlet, 100.0))]
    return {"inlet": -inlet, "outlet": outlet, "nodes": nodes, "field_range": field}


def _line_most(duty: BearingDuty, race: Race, load: float) -> float:
    """Half-widths to where a roller begins to fall away from a parabola, or what a grid takes."""
    radii = duty.radii(race.angle, inner=race.inner)
    assert isinstance(duty.geometry, RollerBearing)
    width = line_half_width(load / duty.geometry.roller_length, radii.radius_x, duty.modulus)
    return min(0.5 * radii.element_x / width, 1000.0)


def _point_lengths(duty: BearingDuty, race: Race, load: float) -> tuple[float, float, float]:
    """Lengths sqrt(2 R h) over which a ball's pressure builds up, in semi-axes, and the ratio of these."""
    radii = duty.radii(race.angle, inner=race.inner)
    viscosity, alpha = duty.lubricant.viscosity, effective_alpha(duty.lubricant)
    formula = nijenbanning_venner_moes(
        PointContact(radii.radius_x, radii.radius_y, duty.modulus, load, race.speed, viscosity, alpha)
    )
    assert formula.central_thickness is not None
    dry = dry_contact(load, radii.radius_x, radii.radius_y, duty.modulus)
    along, across = (
        math.sqrt(2.0 * radius * formula.central_thickness) / axis
        for radius, axis in ((radii.radius_x, dry.semi_axis_x), (radii.radius_y, dry.semi_axis_y))
    )
    return along, across, dry.semi_axis_y / dry.semi_axis_x


def _point_domain(duty: BearingDuty, race: Race, load: float) -> dict[str, Any]:
    """Domain and nodes of a ball's contact: as of other points, wider for a light load's thick film."""
    along, across, ratio = _point_lengths(duty, race, load)
    inlet, outlet = max(4.5, min(_ALONG * along, _MOST[0])), max(1.5, min(_BEHIND * along, 0.1 * _MOST[0]))
    side = max(default_side(ratio), min(1.0 + _ACROSS * across, _MOST[1]))
    nodes = max(257, 8 * math.ceil(inlet + outlet) + 1, 16 * math.ceil(side) + 1)
    return {"inlet": -inlet, "outlet": outlet, "side": side, "nodes": nodes}


def least_load(duty: BearingDuty, race: Race) -> float:
    """Load [N] below which a contact's film builds up over more than its domain can hold, to a third.

    Lighter contacts have thicker films than this one's, so that its voltage is a lower bound of theirs.
    """
    for load in np.geomspace(1e-6, 1e6, 121):
        if isinstance(duty.geometry, RollerBearing):
            fits = _LINE_INLET * _line_length(duty, race, load) <= _line_most(duty, race, load)
        else:
            along, across, _ = _point_lengths(duty, race, load)
            fits = _ALONG * along <= _MOST[0] and 1.0 + _ACROSS * across <= _MOST[1]
        if fits:
            return float(load)
    return math.inf


def solve_contact(
    bearing: Bearing, duty: BearingDuty, race: Race, load: float, discharge: Discharge, solver: dict[str, Any]
) -> ContactSolution:
    """Solve one contact of a bearing at a load.

    Parameters
    ----------
    bearing, duty : Bearing and BearingDuty
        The bearing.
    race : Race
        Which contact.
    load : float
        [N].
    discharge : Discharge
        Strength of the film.
    solver : dict
        ``[solver]`` of the case.

    Returns
    -------
    ContactSolution
        Film, field and the gap around them.
    """
    result = solve(contact_case(duty, race, load, discharge, solver), beside_smooth=False)
    found = result.discharge
    assert found is not None
    length = duty.geometry.roller_length if isinstance(duty.geometry, RollerBearing) else 1.0
    if isinstance(result, PointResult):
        outside, mismatch = _around_ball(bearing, duty, race, result)
        axes = result.conditions.semi_axis_x, result.conditions.semi_axis_y
    else:
        outside, mismatch = _around_roller(duty, race, result), 0.0
        axes = result.conditions.half_width, 0.5 * length
    breaks = found.breakdown_voltage
    formulas = result.conditions.formulas
    return ContactSolution(
        load=load,
        max_pressure=result.conditions.max_pressure,
        semi_axis_x=axes[0],
        semi_axis_y=axes[1],
        minimum_thickness=result.film.minimum_thickness,
        central_thickness=result.film.central_thickness,
        inside=length * found.capacitance,
        outside_oil=outside * duty.lubricant.relative_permittivity,
        outside_air=outside,
        plate=length * found.capacitance_plate,
        breakdown_voltage=np.inf if breaks is None else breaks,
        error=result.film.discretisation_error,
        moes_m=formulas.moes_m,
        moes_l=formulas.moes_l,
        mismatch=mismatch,
        converged=result.converged,
        warnings=result.warnings,
    )


def raceway_of(bearing: Bearing, race: Race) -> Raceway:
    """The groove of one ring around a ball."""
    groove = bearing.inner_groove if race.inner else bearing.outer_groove
    assert groove is not None and bearing.shoulder_height is not None
    return Raceway.of(
        bearing.element_diameter,
        bearing.pitch_diameter,
        groove,
        bearing.shoulder_height,
        outer=not race.inner,
        contact_angle=race.angle,
    )


def _around_ball(bearing: Bearing, duty: BearingDuty, race: Race, result: PointResult) -> tuple[float, float]:
    """Capacitance outside a film in vacuum [F], and how badly the gaps fit at its edge."""
    film, raceway = result.film, raceway_of(bearing, race)
    conditions = result.conditions
    x, y = np.meshgrid(film.x, film.y, indexing="ij")
    rim = np.ones_like(film.thickness, dtype=bool)
    rim[1:-1, 1:-1] = False
    dry = dry_contact(conditions.load, conditions.radius_x, conditions.radius_y, duty.modulus)
    contact = match_film(raceway, dry, duty.modulus, x[rim], y[rim], film.thickness[rim])
    domain = float(film.x[0]), float(film.x[-1]), float(film.y[-1])
    return outside_capacitance(raceway, contact, domain), contact.mismatch


def _around_roller(duty: BearingDuty, race: Race, result: Result) -> float:
    """Capacitance outside a roller's film in vacuum [F]."""
    assert isinstance(duty.geometry, RollerBearing)
    radii = duty.radii(0.0, inner=race.inner)
    film = result.film
    around = RollerRace(radii.element_x, abs(radii.ring_x), outer=not race.inner)
    tails = roller_tails(
        around,
        result.conditions.half_width,
        (float(film.x[0]), float(film.x[-1])),
        (float(film.thickness[0]), float(film.thickness[-1])),
    )
    return duty.geometry.roller_length * sum(tails)


@dataclass(frozen=True)
class ContactCurve:
    """A contact over its load, between the loads that were solved.

    Attributes
    ----------
    solutions : tuple of ContactSolution
        By increasing load.
    light : bool
        Whether the first is of an element that is hardly loaded, far below the others.
    """

    solutions: tuple[ContactSolution, ...]
    light: bool = False

    def at(self, quantity: str, load: Array) -> Array:
        """A quantity at loads [N], interpolated in the logarithms of both."""
        return self._interpolated(quantity, load, range(len(self.solutions)))

    def _interpolated(self, quantity: str, load: Array, among: Sequence[int]) -> Array:
        loads = np.log([self.solutions[k].load for k in among])
        values = np.array([getattr(self.solutions[k], quantity) for k in among])
        if not np.all(np.isfinite(values)):
            return np.full(np.shape(load), np.inf)
        at = np.clip(np.log(load), loads[0], loads[-1])
        if len(among) == 1:
            return np.full(np.shape(load), values[0])
        found: Array = np.exp(PchipInterpolator(loads, np.log(values))(at))
        return found

    @property
    def interpolation_error(self) -> float:
        """Largest relative error at a load, were it left out, of capacitance and breakdown voltage.

        At twice the distance of the loads it bounds what is left with all of them.
        """
        worst = 0.0
        for k in range(2 if self.light else 1, len(self.solutions) - 1):
            others = [j for j in range(len(self.solutions)) if j != k]
            for quantity in ("inside", "breakdown_voltage"):
                value = getattr(self.solutions[k], quantity)
                if np.isfinite(value):
                    load = np.array([self.solutions[k].load])
                    found = self._interpolated(quantity, load, others)[0]
                    worst = max(worst, abs(found / value - 1.0))
        return worst
