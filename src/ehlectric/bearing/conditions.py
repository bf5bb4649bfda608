"""Conditions that the contacts of a bearing share: geometry, materials, and oil at its temperatures.

Conditions of many points are arrays of shape (n,), and floats where the points do not differ.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Generic, TypeVar

import numpy as np

from ehlectric.arrays import Mask, N, Numbers, as_float
from ehlectric.bearing.loads.geometry import Geometry
from ehlectric.bearing.mounted_clearance import MountedClearance
from ehlectric.cases import library
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.discharge.film_breakdown import dielectric_strength
from ehlectric.formulas import hertz
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.field_metadata import stored
from ehlectric.quantities.units import to_si

# Geometry of the bearing: BallBearing or RollerBearing.
G_co = TypeVar("G_co", bound=Geometry, covariant=True)


@dataclass(frozen=True)
class Solid:
    """Material of a ring or of the elements."""

    youngs_modulus: float  # young's modulus [Pa]
    poissons_ratio: float  # poisson's ratio, dimensionless
    density: float  # [kg/m^3]
    conducting: bool  # whether the material conducts electricity
    dielectric_strength: float | None = None  # [V/m]; None without a value in the library
    strength_of: str = ""  # material and norm that this strength is of

    @classmethod
    def of(cls, name: str) -> Solid:
        """Material of the library by its name."""
        table: dict[str, Any] = library.solid(name)
        return cls(
            to_si(table["youngs_modulus"], "Pa"),
            table["poissons_ratio"],
            to_si(table["density"], "kg/m**3"),
            table["conducting"],
            to_si(strength, "V/m") if (strength := table.get("dielectric_strength")) else None,
            table.get("dielectric_strength_of", ""),
        )

    @property
    def compliance(self) -> float:
        """Plane-strain compliance (1 - nu^2)/E [1/Pa]."""
        return hertz.body_compliance(self.youngs_modulus, self.poissons_ratio)


@dataclass(frozen=True)
class ContactFriction:
    """Friction and temperature of the most loaded contact with a ring, solved in pure rolling with its heat
    and with its supply of oil.
    """

    load: float = field(metadata=stored(rule="positive"))  # [N]
    # Hydrodynamic rolling force on each surface, the integral of h/2 dp/dx, over the load; dimensionless.
    rolling_coefficient: float = field(metadata=stored())
    power_loss: float = field(metadata=stored())  # power that the rolling takes [W]
    # Largest rise of the mid-film temperature up to the middle of the contact [K].
    inlet_temperature_rise: float = field(metadata=stored())
    # Largest rise of the mid-film temperature [K]; mostly at the pressure spike, where it grows with the
    # grid.
    max_temperature_rise: float = field(metadata=stored())
    # Estimated error of ``max_temperature_rise`` [K]; None if unknown.
    temperature_rise_error: float | None = field(metadata=stored(rule="finite or NaN", unknown=True))
    # Central thickness of the film [m]; None in results of versions whose contacts were flooded.
    solved_thickness: float | None = field(
        default=None,
        metadata=stored(name="solved_thickness", rule="not negative or NaN", needed=False, unknown=True),
    )
    # Layer of oil on both surfaces together that leads to the film of a given supply [m]; None without one.
    oil_layer: float | None = field(
        default=None, metadata=stored(rule="not negative or NaN", needed=False, unknown=True)
    )


@dataclass(frozen=True)
class RingConditions:
    """Conditions of the contacts with one ring: their films form at the temperature of the surfaces."""

    temperature: Numbers  # [K]
    # Oil at this temperature, with an ambient pressure of 0: pressures are relative to the ambient pressure.
    oil: Oil
    discharge: Discharge  # dielectric strength and conductivity at this temperature
    film_factor: Numbers  # film thickness / isothermal, fully flooded film thickness, dimensionless
    # heat_factor and supply_factor: parts of ``film_factor`` by the heat in the inlet and by the supply of
    # oil, dimensionless; None where only ``film_factor`` is known, which then contains both.
    heat_factor: Numbers | None = None
    supply_factor: Numbers | None = None
    # Part by the heat in the inlet as the formula has it; None where no heat is computed.
    inlet_shear_factor: Numbers | None = None
    # Friction of the most loaded contact; None where its heat is not solved.
    friction: ContactFriction | None = None

    def heated(self, factor: float, friction: ContactFriction | None = None) -> RingConditions:
        """Conditions with a solved factor of the heat and its friction; the factor of the supply stays."""
        supply = 1.0 if self.supply_factor is None else self.supply_factor
        return replace(self, film_factor=factor * supply, heat_factor=factor, friction=friction)


@dataclass(frozen=True)
class BearingConditions(Generic[G_co]):
    """Conditions that all contacts of a bearing share, SI units."""

    bearing: Bearing
    geometry: G_co
    element: Solid
    ring: Solid
    modulus: float  # reduced modulus E' of element and ring [Pa]
    oil: Oil  # oil outside the films, at its temperature
    discharge: Discharge  # dielectric strength and conductivity of the oil outside the films
    # inner and outer: oil, strength and film factor in the contacts with the inner and with the outer ring.
    inner: RingConditions
    outer: RingConditions
    # Clearances before mounting, mounted and in operation; None where that in operation is given.
    clearance: MountedClearance | None = None

    @property
    def rings(self) -> tuple[RingConditions, RingConditions]:
        """Conditions of the contacts with the inner and with the outer ring."""
        return self.inner, self.outer

    @property
    def refused(self) -> Mask:
        """Points of many at which the oil or its strength has no value at its temperature, the rule for the
        supply leaves next to no film, or the clearance in operation is beyond the model, shape (...).

        ``resolve_bearing`` of the single case of such a point raises its error.
        """
        values: list[Numbers | None] = [self.oil.viscosity]
        values += [number for ring in self.rings for number in (ring.oil.viscosity, ring.film_factor)]
        values += [each.temperature for each in (self.discharge, self.inner.discharge, self.outer.discharge)]
        values += [None if self.clearance is None else self.clearance.running.clearance]
        unknown = [np.isnan(value) for value in values if value is not None]
        return np.asarray(np.any(np.stack(np.broadcast_arrays(*unknown)), axis=0))

    @property
    def film_factor(self) -> Numbers:
        """Film factor of the ring whose films it reduces more, dimensionless, at most 1."""
        return as_float(np.minimum(self.inner.film_factor, self.outer.film_factor))

    def part_of_film_factor(self, name: str) -> Numbers | None:
        """``heat_factor``, ``supply_factor`` or ``inlet_shear_factor`` of the ring where it is smaller.

        None where it is not known of both rings.
        """
        factors = [getattr(ring, name) for ring in self.rings]
        return None if any(factor is None for factor in factors) else as_float(np.minimum(*factors))

    @property
    def ceramic(self) -> bool:
        """Whether the elements are insulators, so that nothing breaks down in the films."""
        return not self.element.conducting

    @property
    def ring_share(self) -> float:
        """Share of the ring in the compliance 2/E' of a contact, dimensionless."""
        return self.ring.compliance / (self.ring.compliance + self.element.compliance)


def gap_breakdown(discharge: Discharge, thickness: N) -> N:
    """Breakdown voltage [V] of uniform gaps of a thickness [m]; infinite without a strength.

    The strength is the one at ambient pressure. Many points are the last axis of the gaps, shape (m, ...).
    """
    if not discharge.has_strength:
        return thickness * 0.0 + np.inf
    strength: Any = as_float(dielectric_strength(discharge, np.zeros(())))
    voltage: N = strength * thickness
    return voltage
