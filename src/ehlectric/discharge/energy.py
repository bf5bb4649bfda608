"""Energy of a discharge, the pit that it melts, and the current density."""

from __future__ import annotations

from dataclasses import dataclass

from ehlectric.cases.discharge import Discharge
from ehlectric.discharge.contact_size import Size
from ehlectric.discharge.laws import (
    CURRENT_DENSITY_LIMITS,
    melted_volume,
    pit_diameter,
    stored_energy,
)


@dataclass(frozen=True)
class DischargeCosts:
    """Energy of a discharge, size of the pit that it melts, and current density.

    A value is None if the case lacks an input that it needs.

    Attributes
    ----------
    contact_energy : float or None
        Energy C V^2/2 stored in the contact at the voltage of the case [J].
    discharge_energy : float or None
        Energy C V^2/2 stored in the contact and in the external capacitance, at the voltage of the case [J].
    breakdown_energy : float or None
        Energy C V^2/2 stored in the contact and in the external capacitance, at the breakdown voltage [J].
    pit_volume : float or None
        Volume of one surface that ``discharge_energy`` melts [m^3].
    pit_diameter : float or None
        Diameter of a hemisphere of that volume [m].
    current_density : float or None
        Peak current over the area of the dry contact [A/m^2].
    current_density_limits : tuple of float or None
        Published limits of the current density [A/m^2].
    """

    contact_energy: float | None = None
    discharge_energy: float | None = None
    breakdown_energy: float | None = None
    pit_volume: float | None = None
    pit_diameter: float | None = None
    current_density: float | None = None
    current_density_limits: tuple[float, ...] | None = None


def discharge_costs(
    discharge: Discharge, capacitance: float, voltage: float, breaking_voltage: float | None, size: Size
) -> DischargeCosts:
    """Energy of a discharge, size of the pit that it melts, and apparent current density.

    Parameters
    ----------
    discharge : Discharge
        Inputs of the discharge, with external capacitance, pit and peak current.
    capacitance : float
        Capacitance per length of a line contact [F/m], or of a point contact [F].
    voltage : float
        Voltage of the case [V].
    breaking_voltage : float or None
        Breakdown voltage [V]; None if it is unknown.
    size : Size
        Size of the dry contact.

    Returns
    -------
    DischargeCosts
        Values in SI units; None if the case lacks an input that a value needs.
    """
    total, external = size.total(capacitance), discharge.external_capacitance
    together = None if total is None or external is None else total + external
    energy = _energy(together, voltage)
    volume = (
        None
        if discharge.pit is None or energy is None
        else melted_volume(energy, discharge.pit.efficiency, discharge.pit.melting_energy)
    )
    current = discharge.peak_current
    area = None if current is None else size.total(size.hertz)
    return DischargeCosts(
        contact_energy=_energy(total, voltage),
        discharge_energy=energy,
        breakdown_energy=_energy(together, breaking_voltage),
        pit_volume=volume,
        pit_diameter=None if volume is None else pit_diameter(volume),
        current_density=None if current is None or area is None else current / area,
        current_density_limits=None if area is None else CURRENT_DENSITY_LIMITS,
    )


def _energy(capacitance: float | None, voltage: float | None) -> float | None:
    return None if capacitance is None or voltage is None else stored_energy(capacitance, voltage)
