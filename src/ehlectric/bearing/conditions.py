"""A bearing file in numbers: geometry, oil at its temperature, kinematics and the load on every contact."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.bearing.loads.balls import BallEquilibrium, ball_equilibrium
from ehlectric.bearing.loads.geometry import BallBearing, ContactRadii, RollerBearing
from ehlectric.bearing.loads.kinematics import rolling_speeds
from ehlectric.bearing.loads.ring import Duty
from ehlectric.bearing.loads.rollers import RollerEquilibrium, roller_equilibrium
from ehlectric.cases import library
from ehlectric.cases.bearing import ROLLERS, Bearing
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.lubricant import Lubricant
from ehlectric.cases.quantity import to_si
from ehlectric.errors import InputError
from ehlectric.formulas import hertz_line as hertz
from ehlectric.lubricant.temperature import inlet_shear_factor

# Exponent of the entrainment product in the film: of Hamrock and Dowson for points, of Dowson and Toyoda for
# lines.
POINT_EXPONENT, LINE_EXPONENT = 0.67, 0.69


@dataclass(frozen=True)
class Solid:
    """Elastic constants and density of a material, SI units, and whether it conducts."""

    youngs_modulus: float
    poissons_ratio: float
    density: float
    conducting: bool

    @classmethod
    def of(cls, name: str) -> Solid:
        """A material of the library."""
        table: dict[str, Any] = library.solid(name)
        return cls(
            to_si(table["youngs_modulus"], "Pa"),
            table["poissons_ratio"],
            to_si(table["density"], "kg/m**3"),
            table["conducting"],
        )

    @property
    def compliance(self) -> float:
        """(1 - nu^2)/E [1/Pa]."""
        return hertz.body_compliance(self.youngs_modulus, self.poissons_ratio)


@dataclass(frozen=True)
class BearingDuty:
    """What a bearing's contacts have in common.

    Attributes
    ----------
    geometry : BallBearing or RollerBearing
        Internal geometry.
    element, ring : Solid
        Materials.
    modulus : float
        E' of element and ring [Pa].
    lubricant : Lubricant
        At the temperature of the bearing.
    film_factor : float
        Part of the isothermal, fully flooded film that there is.
    entrainment_factor : float
        That by which the entrainment product is multiplied for it.
    """

    geometry: BallBearing | RollerBearing
    element: Solid
    ring: Solid
    modulus: float
    lubricant: Lubricant
    film_factor: float
    entrainment_factor: float

    @classmethod
    def of(cls, case: BearingCase) -> BearingDuty:
        """The duty of a bearing file."""
        bearing = case.bearing
        element, ring = Solid.of(bearing.element_material), Solid.of(bearing.ring_material)
        lubricant = case.lubricant.at(bearing.temperature)
        with _keys_of_bearing():
            geometry = geometry_of(bearing)
        factor = _film_factor(case, geometry, lubricant)
        exponent = LINE_EXPONENT if isinstance(geometry, RollerBearing) else POINT_EXPONENT
        return cls(
            geometry=geometry,
            element=element,
            ring=ring,
            modulus=hertz.reduced_modulus(element.compliance, ring.compliance),
            lubricant=lubricant,
            film_factor=factor,
            entrainment_factor=factor ** (1.0 / exponent),
        )

    def equilibria(self, bearing: Bearing, positions: int) -> list[BallEquilibrium] | list[RollerEquilibrium]:
        """Equilibrium at positions of the cage over a pitch, the first with an element on the load line."""
        pitch = 2.0 * math.pi / bearing.elements
        given = self.modulus, self.element.density
        with _keys_of_bearing():
            duties = [
                Duty(bearing.radial_load, bearing.axial_load, bearing.inner_speed, cage_angle=angle)
                for angle in pitch * np.arange(positions) / positions
            ]
            if isinstance(self.geometry, RollerBearing):
                return [roller_equilibrium(self.geometry, duty, *given) for duty in duties]
            return [ball_equilibrium(self.geometry, duty, *given) for duty in duties]

    def radii(self, angle: float, *, inner: bool) -> ContactRadii:
        """Radii of a contact at a contact angle [rad]."""
        if isinstance(self.geometry, RollerBearing):
            return self.geometry.radii(inner=inner)
        return self.geometry.radii(angle, inner=inner)


@contextmanager
def _keys_of_bearing() -> Iterator[None]:
    """Errors of geometry and loads, which name a key, with the table of it."""
    try:
        yield
    except InputError as error:
        raise error.under("bearing") from None


def geometry_of(bearing: Bearing) -> BallBearing | RollerBearing:
    """Internal geometry of a bearing file."""
    if bearing.kind == ROLLERS:
        assert bearing.roller_length is not None and bearing.radial_clearance is not None
        assert bearing.profile is not None
        return RollerBearing(
            bearing.elements,
            bearing.element_diameter,
            bearing.pitch_diameter,
            bearing.roller_length,
            bearing.radial_clearance,
            bearing.profile,
        )
    assert bearing.inner_groove is not None and bearing.outer_groove is not None
    return BallBearing(
        bearing.elements,
        bearing.element_diameter,
        bearing.pitch_diameter,
        bearing.inner_groove,
        bearing.outer_groove,
        bearing.radial_clearance,
        bearing.contact_angle,
    )


def _film_factor(case: BearingCase, geometry: BallBearing | RollerBearing, lubricant: Lubricant) -> float:
    """Part of the isothermal film, of what the file says."""
    given = case.bearing.film_factor
    if isinstance(given, float):
        return given
    if given == "none":
        return 1.0
    oil = case.lubricant.temperature
    assert oil is not None and oil.thermal_conductivity is not None
    # The speed of pure rolling at the free contact angle: it hardly changes with the loaded one.
    angle = geometry.free_angle if isinstance(geometry, BallBearing) else 0.0
    bearing = case.bearing
    speeds = rolling_speeds(
        bearing.element_diameter, bearing.pitch_diameter, bearing.inner_speed, contact_angle=angle
    )
    slope = case.lubricant.walther().slope(case.bearing.temperature) + oil.expansion
    return inlet_shear_factor(
        lubricant.viscosity, slope, float(speeds.inner_entrainment), oil.thermal_conductivity
    )
