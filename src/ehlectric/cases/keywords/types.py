"""Keywords of the constructors of cases, with their types for editors and type checkers.

A value is a float in SI units, a text with a unit, or a quantity of pint. Every other value is refused when
the case is made, by the same checks as those of a case file.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, TypeAlias, TypedDict


class HasUnit(Protocol):
    """Number with a unit, such as a quantity of pint."""

    @property
    def magnitude(self) -> Any:
        """Number in the unit of the quantity."""
        ...

    def to(self, other: Any = None, /) -> Any:
        """Quantity in another unit."""
        ...


# Value of a key: a float in SI units, a text with a unit, or a quantity.
Value: TypeAlias = float | str | HasUnit

# Tables by key, as in a case file.
Keys: TypeAlias = Mapping[str, Any]


class LineKeys(TypedDict, total=False):
    """Keys of the table ``contact`` of a line contact; the units of floats are in brackets.

    Attributes
    ----------
    reduced_radius, radius_1, radius_2 : float, str or quantity
        Reduced radius, or radii of both bodies, negative for a concave one [m].
    reduced_modulus : float, str or quantity
        Reduced modulus E' with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [Pa].
    body_1, body_2 : mapping
        ``youngs_modulus`` [Pa] and ``poissons_ratio`` of both bodies, in place of the reduced modulus, and
        their thermal properties.
    load_per_length, max_hertz_pressure : float, str or quantity
        Load per length [N/m] or Hertz pressure [Pa].
    entrainment_speed, slide_to_roll_ratio, speed_1, speed_2 : float, str or quantity
        Mean speed of the surfaces [m/s] with the slide-to-roll ratio, or the speeds of both [m/s].
    temperature : float, str or quantity
        Absolute temperature of oil and surfaces [K]; write "70 degC" for degrees Celsius.
    temperature_1, temperature_2 : float, str or quantity
        Bulk temperatures of both bodies of a thermal film [K].
    boundary_film : float, str or quantity
        Gap at which the surfaces touch [m].
    hardness : float, str or quantity
        Largest pressure where the surfaces touch [Pa].
    boundary_friction : float, str or quantity
        Friction coefficient where the surfaces touch and slide, dimensionless.
    """

    reduced_radius: Value
    radius_1: Value
    radius_2: Value
    reduced_modulus: Value
    body_1: Keys
    body_2: Keys
    load_per_length: Value
    max_hertz_pressure: Value
    entrainment_speed: Value
    temperature: Value
    temperature_1: Value
    temperature_2: Value
    slide_to_roll_ratio: Value
    speed_1: Value
    speed_2: Value
    boundary_film: Value
    hardness: Value
    boundary_friction: Value


class PointKeys(TypedDict, total=False):
    """Keys of the table ``contact`` of a point contact; the units of floats are in brackets.

    Attributes
    ----------
    radius_x, radius_y : float, str or quantity
        Reduced radii along and across entrainment [m].
    reduced_modulus : float, str or quantity
        Reduced modulus E' with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 [Pa].
    body_1, body_2 : mapping
        ``youngs_modulus`` [Pa] and ``poissons_ratio``, or ``radius_x`` and ``radius_y`` [m], of both bodies,
        in place of the reduced values, and their thermal properties.
    load, max_hertz_pressure : float, str or quantity
        Load [N] or Hertz pressure [Pa].
    entrainment_speed, slide_to_roll_ratio, speed_1, speed_2 : float, str or quantity
        Mean speed of the surfaces [m/s] with the slide-to-roll ratio, or the speeds of both [m/s].
    temperature : float, str or quantity
        Absolute temperature of oil and surfaces [K]; write "70 degC" for degrees Celsius.
    temperature_1, temperature_2 : float, str or quantity
        Bulk temperatures of both bodies of a thermal film [K].
    boundary_film : float, str or quantity
        Gap at which the surfaces touch [m].
    hardness : float, str or quantity
        Largest pressure where the surfaces touch [Pa].
    boundary_friction : float, str or quantity
        Friction coefficient where the surfaces touch and slide, dimensionless.
    """

    radius_x: Value
    radius_y: Value
    reduced_modulus: Value
    body_1: Keys
    body_2: Keys
    load: Value
    max_hertz_pressure: Value
    entrainment_speed: Value
    temperature: Value
    temperature_1: Value
    temperature_2: Value
    slide_to_roll_ratio: Value
    speed_1: Value
    speed_2: Value
    boundary_film: Value
    hardness: Value
    boundary_friction: Value


class BearingKeys(TypedDict, total=False):
    """Keys of the table ``bearing``; the units of floats are in brackets.

    Attributes
    ----------
    base, kind, profile, element_material, ring_material : str
        Names: bearing of the library, kind of the bearing, profile of rollers, materials.
    elements : int
        Number of rolling elements.
    bore, outer_diameter, width, element_diameter, pitch_diameter, roller_length : float, str or quantity
        Geometry [m].
    inner_groove, outer_groove : float
        Groove radii divided by the ball diameter.
    clearance_class : str
        "C2", "CN", "C3", "C4" or "C5" of ISO 5753-1 for the bore, in place of ``radial_clearance``.
    radial_clearance, contact_angle, shoulder_height : float, str or quantity
        Clearance [m], free contact angle [rad], and height of the shoulder over the element diameter.
    element_capacitance : float, str or quantity
        Capacitance of a ceramic element [F].
    radial_load, axial_load : float, str or quantity
        Loads [N].
    inner_speed : float, str or quantity
        Rotational speed of the inner ring: "3000 rpm", or a float in rad/s; a whole number is refused.
    temperature, inner_ring_temperature, outer_ring_temperature : float, str or quantity
        Absolute temperatures of the oil and of the rings [K]; write "70 degC" for degrees Celsius.
    composite_rq : float, str or quantity
        Rq of both surfaces together [m].
    summits : mapping
        Table of the summits of the roughness.
    contact_resistance : float, str or quantity
        Resistance of one contact while its asperities touch [Ohm].
    fill : str or float
        "oil" or "air" around the films, or the part filled with oil, from 0 to 1.
    film_factor : float or str
        Factor on the isothermal, fully flooded film, "none", "inlet-shear" or "solved".
    supply : float or str
        Way in which oil is supplied, such as "grease", or film over the fully flooded one.
    fits : mapping
        Clearance before mounting, interferences, shaft and housing, in place of ``radial_clearance``.
    parallel_capacitance : float, str or quantity
        Capacitance of cage, shields and wiring [F].
    coating : mapping
        Table of an insulating coating on a ring.
    """

    base: str
    kind: str
    elements: int
    bore: Value
    outer_diameter: Value
    width: Value
    element_diameter: Value
    pitch_diameter: Value
    inner_groove: Value
    outer_groove: Value
    roller_length: Value
    profile: str
    shoulder_height: Value
    radial_clearance: Value
    clearance_class: str
    contact_angle: Value
    element_material: str
    ring_material: str
    element_capacitance: Value
    radial_load: Value
    axial_load: Value
    inner_speed: Value
    temperature: Value
    inner_ring_temperature: Value
    outer_ring_temperature: Value
    composite_rq: Value
    summits: Keys
    contact_resistance: Value
    fill: float | str
    film_factor: float | str
    supply: float | str
    fits: Keys
    parallel_capacitance: Value
    coating: Keys
