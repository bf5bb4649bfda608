"""The contacts of all elements with one ring at one position of the cage: film, capacitance, breakdown."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.conditions import BearingDuty
from ehlectric.bearing.contacts import ContactCurve
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.bearing.ring_contacts import Race, rigid_capacitance
from ehlectric.cases.bearing import Bearing
from ehlectric.cases.discharge import Discharge
from ehlectric.discharge.utilisation import dielectric_strength


@dataclass(frozen=True)
class RaceState:
    """Contacts with one ring, one number an element, SI units.

    Attributes
    ----------
    load, gap : ndarray, shape (n,)
        [N], and the distance where element and ring do not touch [m], 0 elsewhere.
    solved : ndarray of bool
        Whether film and field are solved ones; a gap of rigid bodies otherwise.
    max_pressure, semi_axis_x, semi_axis_y : ndarray
        Of the dry contact; 0 without load.
    minimum_thickness, central_thickness : ndarray
        Of the film, or the gap [m].
    inside, outside_oil, outside_air : ndarray
        Capacitance over the film, and around it with oil and with air [F].
    plate : ndarray
        eps0 eps_r A/h(0) of the Hertz area [F]; 0 without load.
    strength_per_volt : ndarray
        Largest field strength over the contact's voltage [1/m].
    breakdown_voltage : ndarray
        Of the contact by itself [V]; infinite without a strength.
    """

    load: Array
    gap: Array
    solved: Mask
    max_pressure: Array
    semi_axis_x: Array
    semi_axis_y: Array
    minimum_thickness: Array
    central_thickness: Array
    inside: Array
    outside_oil: Array
    outside_air: Array
    plate: Array
    strength_per_volt: Array
    breakdown_voltage: Array

    def capacitance(self, fill: str) -> Array:
        """Of each contact, with oil or air around the film [F]."""
        return self.inside + (self.outside_oil if fill == "oil" else self.outside_air)


# What a curve gives of a loaded contact.
_FROM_CURVE = (
    "max_pressure", "semi_axis_x", "semi_axis_y", "minimum_thickness", "central_thickness",
    "inside", "outside_oil", "outside_air", "plate", "strength_per_volt", "breakdown_voltage",
)  # fmt: skip


def race_state(
    bearing: Bearing,
    duty: BearingDuty,
    race: Race,
    curve: ContactCurve,
    *,
    discharge: Discharge,
    load: Array,
    gap: Array,
) -> RaceState:
    """Contacts of all elements with one ring.

    Parameters
    ----------
    bearing, duty, race : Bearing, BearingDuty and Race
        The bearing and the ring.
    curve : ContactCurve
        Its loaded contacts.
    discharge : Discharge
        Strength of the film.
    load, gap : ndarray, shape (n,)
        Load [N] and, without one, distance [m] of each element.

    Returns
    -------
    RaceState
        Contacts without load count as rigid bodies.
    """
    solved = load > 0.0
    found = {name: np.zeros_like(load) for name in _FROM_CURVE}
    for name in _FROM_CURVE:
        found[name][solved] = curve.at(name, load[solved])
    # Lighter loads than any that was solved have its film, but their own dry contact.
    lighter = np.minimum(1.0, load / curve.solutions[0].load)
    rollers = isinstance(duty.geometry, RollerBearing)
    power = 1.0 / 2.0 if rollers else 1.0 / 3.0
    for name in ("max_pressure", "semi_axis_x", *(() if rollers else ("semi_axis_y",))):
        found[name] *= lighter**power
    strength = float(dielectric_strength(discharge, np.zeros(1))[0])
    for k in np.flatnonzero(~solved):
        # No gap is narrower than the film that the lightest load leaves.
        apart = max(float(gap[k]), curve.solutions[0].central_thickness)
        vacuum = rigid_capacitance(bearing, duty, race, apart)
        found["minimum_thickness"][k] = found["central_thickness"][k] = apart
        found["outside_oil"][k] = vacuum * duty.lubricant.relative_permittivity
        found["outside_air"][k] = vacuum
        found["strength_per_volt"][k] = 1.0 / apart
        found["breakdown_voltage"][k] = strength * apart if discharge.has_strength else np.inf
    return RaceState(load=load, gap=gap, solved=solved, **found)
