"""Films between the flanks of a gear pair, on all lines of contact over a phase of the mesh. SI units.

Each place of a line of contact is a line contact of two cylinders with the radii of curvature of the flanks,
rho_t/cos beta_b in the plane normal to the teeth, the line load w and the mean speed u_m. Its film is a
smooth, fully flooded film from the atlas, of an oil that has the temperature of the flanks, times the factor
of inlet shear heating in pure rolling. Solved films of gears confirm this factor within 2 %, and contradict
its term of sliding.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.cases.contact_inputs import Body
from ehlectric.cases.film_inputs import check_thermal_oil, thermal_properties
from ehlectric.cases.gear_case import GearCase
from ehlectric.errors import InputError
from ehlectric.film import ContactFilm, contact_film
from ehlectric.formulas.film_line import LineContact, pan_hamrock
from ehlectric.formulas.hertz import line_half_width, line_max_pressure
from ehlectric.formulas.inlet_supply import inlet_shear_factor
from ehlectric.gear.contact_path import ContactPath
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.field_metadata import stored

# Relative error of films from formulas for line contacts: they differ from solved films by up to this part.
FORMULA_ERROR = 0.4


@dataclass(frozen=True)
class Flanks:
    """Flanks of a gear pair at an operating point."""

    path: ContactPath
    ratio: float  # u = z2/z1
    pinion_speed: float  # omega_1 [rad/s], positive
    modulus: float  # reduced modulus E' [Pa]
    temperature: float  # temperature of the flanks, and of the oil that enters [K]
    oil: Oil  # oil at this temperature
    # Temperature coefficient of the viscosity [1/K] and conductivity [W/(m K)] of the oil; without a slope
    # the films are isothermal.
    slope: float | None
    conductivity: float

    def normal_radii(self, places: Array) -> tuple[Array, Array]:
        """Radii of curvature of both flanks in the plane normal to the teeth [m], negative if concave."""
        cosine = math.cos(self.path.base_helix_angle)
        first, second = self.path.transverse_radii(places)
        return np.asarray(first) / cosine, np.asarray(second) / cosine


# Metadata of numbers at the places of films, NaN where there is no contact.
_positive = partial(stored, "place", rule="not negative or NaN")


@dataclass(frozen=True)
class FlankFilms:
    """Line contacts at places of the lines of contact; arrays of one shape (...), NaN without a contact."""

    places: Array = field(metadata=_positive("m"))  # g on the path of contact
    load: Array = field(metadata=_positive("N/m"))  # w
    reduced_radius: Array = field(metadata=_positive("m"))  # rho_n
    mean_speed: Array = field(metadata=_positive("m/s"))  # u_m
    # v_1 - v_2
    sliding_speed: Array = field(metadata=stored("place", "m/s", "finite or NaN"))
    half_width: Array = field(metadata=_positive("m"))  # of the dry contact
    max_pressure: Array = field(metadata=_positive("Pa"))  # Hertz pressure
    central: Array = field(metadata=_positive("m"))  # central film thickness
    minimum: Array = field(metadata=_positive("m"))  # smallest film thickness
    heat_factor: Array = field(metadata=_positive(""))  # factor of heat in both thicknesses
    friction: Array = field(metadata=_positive(""))  # friction coefficient of the film; NaN if not solved
    error: Array = field(metadata=_positive(""))  # relative error of the isothermal films
    # Whether the atlas contains the contact.
    known: Mask = field(metadata=stored("place", "", "0 or 1", dtype="i1"))
    # Isothermal films with the numbers of the atlas; None of a solution, which has used them.
    atlas: ContactFilm | None = None

    @property
    def thinnest(self) -> tuple[int, ...]:
        """Index of the smallest film."""
        return tuple(int(i) for i in np.unravel_index(int(np.nanargmin(self.minimum)), self.minimum.shape))

    @property
    def slide_to_roll_ratio(self) -> Array:
        """Sliding speed divided by the mean speed, dimensionless."""
        return self.sliding_speed / self.mean_speed


def flank_films(flanks: Flanks, places: Array, load: Array, *, by_formula: bool = False) -> FlankFilms:
    """Films at places g on the path of contact [m] under line loads [N/m], arrays of one shape (...).

    Places without a load, 0 or NaN, have no film: NaN. ``by_formula``, films of Pan and Hamrock instead of
    the atlas; their shape, on which the capacitance depends, is from the atlas.
    """
    carried = np.where(np.nan_to_num(load) > 0.0, load, np.nan)
    radius = np.asarray(flanks.path.reduced_radius(places))
    first, second = flanks.path.speeds(places, flanks.pinion_speed, flanks.ratio)
    speed = 0.5 * (np.asarray(first) + second)
    contact = LineContact(
        reduced_radius=radius,
        reduced_modulus=flanks.modulus,
        load_per_length=carried,
        entrainment_speed=speed,
        viscosity=flanks.oil.viscosity,
        pressure_viscosity_coefficient=flanks.oil.alpha_star,
    )
    film = contact_film(contact, flanks.oil, beyond=True)
    central, minimum = film.central_thickness, film.minimum_thickness
    error = np.maximum(film.errors["central"], film.errors["minimum"])
    if by_formula:
        formula = pan_hamrock(contact)
        central, minimum = formula.central_thickness, formula.minimum_thickness
        error = np.where(np.isnan(carried), np.nan, FORMULA_ERROR)
    heat = np.ones_like(speed)
    if flanks.slope is not None:
        heat = np.asarray(inlet_shear_factor(flanks.oil.viscosity, flanks.slope, speed, flanks.conductivity))
    return FlankFilms(
        places=places,
        load=carried,
        reduced_radius=radius,
        mean_speed=speed,
        sliding_speed=np.asarray(flanks.path.sliding_speed(places, flanks.pinion_speed, flanks.ratio)),
        half_width=np.asarray(
            line_half_width(load_per_length=carried, radius=radius, modulus=flanks.modulus)
        ),
        max_pressure=np.asarray(
            line_max_pressure(load_per_length=carried, radius=radius, modulus=flanks.modulus)
        ),
        central=heat * central,
        minimum=heat * minimum,
        heat_factor=heat,
        friction=np.full_like(speed, np.nan),
        error=np.asarray(error),
        known=np.broadcast_to(film.film.known, np.shape(radius)),
        atlas=film,
    )


def without_heat(case: GearCase, temperature: float) -> InputError | None:
    """Why the films of a gear pair are solved without heat: a thermal property that the file does not give;
    None if it gives all. ``temperature`` of the flanks [K].
    """
    try:
        check_thermal_oil(case.lubricant, temperature)
        thermal_properties(Body.from_dict({"material": case.gear.material}), "gear.material")
    except InputError as error:
        return error
    return None
