"""Energy of a discharge through a bearing, the pit that it melts, and the apparent current density."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.breakdown import breakdown_of
from ehlectric.bearing.meter.reading import shaft_capacitance, shaft_path
from ehlectric.bearing.shaft_voltage import film_voltage
from ehlectric.bearing.solution import BearingSolution, RingState, capacitance, insulating
from ehlectric.cases.bearings.bearing import ROLLERS
from ehlectric.cases.discharge import Pit
from ehlectric.discharge.laws import (
    CURRENT_DENSITY_LIMITS,
    beside_limits,
    melted_volume,
    pit_diameter,
    stored_energy,
)
from ehlectric.errors import ResultWarning


@dataclass(frozen=True)
class BearingCosts:
    """Energy of a discharge through a bearing, the pit that it melts, and the current density.

    A value is None if the case lacks an input that it needs. Energies and pits are None for ceramic elements,
    and below a lambda ratio of 1, where no voltage is computed.

    Attributes
    ----------
    discharged_capacitance : float or None
        Capacitance that a discharge through the films empties [F]: that of the films, and those between the
        shaft and everything else, which a coating on a ring puts in series with its own.
    bearing_energy : float or None
        Energy C V^2/2 that is stored in the films alone, at the shaft voltage [J].
    discharge_energy : float or None
        Energy C V^2/2 of ``discharged_capacitance`` at the shaft voltage, of which V is across the films [J].
    breakdown_energy : float or None
        Energy C V^2/2 that is stored in ``discharged_capacitance``, at the first breakdown [J].
    pit_volume : float or None
        Volume of one surface that ``discharge_energy`` melts [m^3].
    pit_diameter : float or None
        Diameter of a hemisphere of that volume [m].
    breakdown_pit_diameter : float or None
        Diameter of the hemisphere that ``breakdown_energy`` melts [m].
    hertz_area : float
        Area of the dry contacts through which a current flows [m^2]: the smaller contact of every element
        that both rings load, with the cage at its first position.
    current_density : float or None
        Peak current over ``hertz_area`` [A/m^2].
    element_current_density : float or None
        Peak current over the smaller contact of the most loaded element, as if it flowed through this
        element alone [A/m^2].
    current_density_limits : tuple of float or None
        Published limits of ``current_density`` [A/m^2].
    """

    discharged_capacitance: float | None
    bearing_energy: float | None
    discharge_energy: float | None
    breakdown_energy: float | None
    pit_volume: float | None
    pit_diameter: float | None
    breakdown_pit_diameter: float | None
    hertz_area: float
    current_density: float | None
    element_current_density: float | None
    current_density_limits: tuple[float, ...] | None


def bearing_costs(solution: BearingSolution) -> BearingCosts:
    """Energy of a discharge through a solved bearing, the pit that it melts, and the current density.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    BearingCosts
        Values in SI units.

    Notes
    -----
    One discharge empties all of the charge. Winding and frame have fixed potentials meanwhile, so that their
    capacitances to the rotor and those of both bearings are parallel. If the first breakdown leaves the other
    contact of its element intact, the energy flows only at the ring-to-ring breakdown.

    Behind a coating of the capacitance C_c, a discharge of films of the capacitance C at the voltage V moves
    the charge of all other capacitances C_s of the shaft only as far as the coating lets it pass. The energy
    that the discharge releases is V^2/2 [C + C_s C_c/(C_s + C_c)].
    """
    case, breakdown = solution.case, breakdown_of(solution)
    across = film_voltage(solution) if insulating(solution) else None
    total, pit = _discharged(solution), case.discharge.pit
    discharged, at_break = _energy(total, across), None
    if breakdown is not None:
        at_break = _energy(total, breakdown.first_break)
    areas = conducting_areas(solution)
    whole, largest = float(np.sum(areas)), float(np.max(areas))
    current = case.discharge.peak_current
    volume = _melted(pit, discharged)
    at_first = _melted(pit, at_break)
    return BearingCosts(
        discharged_capacitance=total,
        bearing_energy=None if across is None else stored_energy(capacitance(solution), across),
        discharge_energy=discharged,
        breakdown_energy=at_break,
        pit_volume=volume,
        pit_diameter=None if volume is None else pit_diameter(volume),
        breakdown_pit_diameter=None if at_first is None else pit_diameter(at_first),
        hertz_area=whole,
        current_density=None if current is None or not whole else current / whole,
        element_current_density=None if current is None or not largest else current / largest,
        current_density_limits=None if current is None else CURRENT_DENSITY_LIMITS,
    )


def _discharged(solution: BearingSolution) -> float | None:
    """Capacitance that a discharge empties [F]; None where nothing says what is connected to the bearing."""
    if not insulating(solution):
        return None
    case, own, path = solution.case, capacitance(solution), shaft_path(solution)
    motor, external = case.motor, case.discharge.external_capacitance
    if motor is not None:
        second = motor.second_bearing_capacitance
        beside = motor.winding_rotor_capacitance + motor.rotor_frame_capacitance + path.parallel
        return own + path.behind_coating(beside + (shaft_capacitance(solution) if second is None else second))
    return None if external is None else own + path.behind_coating(external + path.parallel)


def _energy(total: float | None, voltage: float | None) -> float | None:
    return None if total is None or voltage is None else stored_energy(total, voltage)


def _melted(pit: Pit | None, energy: float | None) -> float | None:
    """Volume of one surface that an energy [J] melts [m^3]; None where one of both is not known."""
    if pit is None or energy is None:
        return None
    return melted_volume(energy, pit.efficiency, pit.melting_energy)


def conducting_areas(solution: BearingSolution) -> Array:
    """Area of the smaller dry contact of each element, shape (n,) [m^2]; 0 where a ring does not load it."""
    factor = 4.0 if solution.case.bearing.kind == ROLLERS else np.pi

    def area(ring: RingState) -> Array:
        return factor * ring.values.semi_axis_x * ring.values.semi_axis_y

    inner, outer = solution.positions[0].rings
    return np.minimum(area(inner), area(outer))


def current_warnings(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warning of an apparent current density above the lowest of the published limits."""
    density = bearing_costs(solution).current_density
    if density is None or density <= CURRENT_DENSITY_LIMITS[0]:
        return
    yield ResultWarning(
        "current-density-high",
        f"the apparent current density is {1e-6 * density:.3g} A/mm², the peak current over the Hertz areas: "
        f"{beside_limits(density)}",
    )
