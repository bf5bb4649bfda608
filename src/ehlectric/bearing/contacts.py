"""Contacts of a bearing with one ring, solved over its loads: film, capacitance and breakdown voltage."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.arrays import Array
from ehlectric.bearing.conditions import BearingDuty
from ehlectric.bearing.domain import line_domain, point_domain
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.bearing.ring_contacts import Race, around_ball, around_roller, of_contact, point_contact
from ehlectric.cases.bearing import Bearing
from ehlectric.cases.case import Case
from ehlectric.cases.discharge import Discharge
from ehlectric.contact.results import PointResult
from ehlectric.contact.solver import solve
from ehlectric.errors import ResultWarning

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
    strength_per_volt : float
        Largest field strength over the contact's voltage [1/m].
    breakdown_voltage : float
        [V]; infinite without a strength.
    error : float or None
        Estimate of the film's discretisation error, relative.
    moes_m, moes_l : float
        Moes' groups.
    mismatch : float
        Largest difference of the gaps at the edge of the film's domain, relative.
    warnings : tuple of ResultWarning
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
    strength_per_volt: float
    breakdown_voltage: float
    error: float | None
    moes_m: float
    moes_l: float
    mismatch: float
    converged: bool
    warnings: tuple[ResultWarning, ...]


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
        grid = line_domain(duty, race, load)
    else:
        contact |= {
            "geometry": "point",
            "body_1": ring | {"radius_x": radii.ring_x, "radius_y": radii.ring_y},
            "body_2": element | {"radius_x": radii.element_x, "radius_y": radii.element_y},
            "load": load,
        }
        assess, grid = {}, point_domain(duty, race, load)
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


def solve_contact(
    bearing: Bearing,
    duty: BearingDuty,
    race: Race,
    load: float,
    *,
    discharge: Discharge,
    solver: dict[str, Any],
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
    with of_contact(race, load):
        result = solve(contact_case(duty, race, load, discharge, solver), beside_smooth=False)
    found = result.discharge
    assert found is not None
    length = duty.geometry.roller_length if isinstance(duty.geometry, RollerBearing) else 1.0
    if isinstance(result, PointResult):
        nodes = result.film.x, result.film.y
        contact = point_contact(duty, race, load)
        outside, mismatch = around_ball(bearing, contact, race, nodes, result.film.thickness)
        axes = result.conditions.semi_axis_x, result.conditions.semi_axis_y
    else:
        width, film = result.conditions.half_width, result.film
        outside, mismatch = around_roller(duty, race, width, film.x, film.thickness), 0.0
        axes = width, 0.5 * length
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
        strength_per_volt=result.field.max_strength / result.field.voltage,
        breakdown_voltage=np.inf if breaks is None else breaks,
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
        for k in range(1, len(self.solutions) - 1):
            others = [j for j in range(len(self.solutions)) if j != k]
            for quantity in ("inside", "breakdown_voltage"):
                value = getattr(self.solutions[k], quantity)
                if np.isfinite(value):
                    load = np.array([self.solutions[k].load])
                    found = self._interpolated(quantity, load, others)[0]
                    worst = max(worst, abs(found / value - 1.0))
        return worst
