"""Films between the flanks of a gear pair, on all lines of contact over a phase of the mesh. SI units.

Each place of a line of contact is a line contact of two cylinders with the radii of curvature of the flanks,
rho_t/cos beta_b in the plane normal to the teeth, the line load w and the mean speed u_m. Its film is a
smooth, fully flooded film from the atlas, of an oil that has the temperature of the flanks, times the factor
of inlet shear heating in pure rolling. Solved films of gears confirm this factor within 2 %, and contradict
its term of sliding.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from functools import cache, cached_property, partial

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.cases.contact_inputs import Body
from ehlectric.cases.film_inputs import check_thermal_oil, thermal_properties
from ehlectric.cases.gear_case import GearCase
from ehlectric.errors import InputError
from ehlectric.film import Groups
from ehlectric.formulas.film_line import LineContact, pan_hamrock
from ehlectric.formulas.hertz import line_half_width, line_max_pressure
from ehlectric.formulas.inlet_supply import inlet_shear_factor
from ehlectric.gear.contact_path import ContactPath
from ehlectric.gear.film_table import FilmShape, FilmTable
from ehlectric.gear.flank_oil import FlankOil
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
    oil: FlankOil


# Metadata of numbers at the places of films, NaN where there is no contact.
_positive = partial(stored, "place", rule="not negative or NaN")


# Relative difference of equal films that are interpolated in different tables.
_ROUNDING = 1e-9


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

    def some(self, which: slice | IntArray) -> FlankFilms:
        """Some of the films of shape (n,)."""
        return FlankFilms(**{name: getattr(self, name)[which] for name in _names()})

    @cached_property
    def thinnest(self) -> int:
        """Number of the smallest film; the first number if films differ by rounding only."""
        least = float(np.nanmin(self.minimum))
        return int(np.argmax(self.minimum <= (1.0 + _ROUNDING) * least))

    @property
    def slide_to_roll_ratio(self) -> Array:
        """Sliding speed divided by the mean speed, dimensionless."""
        return self.sliding_speed / self.mean_speed


@cache
def _names() -> tuple[str, ...]:
    """Names of the fields of films."""
    return tuple(each.name for each in fields(FlankFilms))


@dataclass(frozen=True, eq=False)
class PlacedContacts:
    """Line contacts at places of the path of contact, with the coefficient of the atlas; shape (n,)."""

    places: Array  # g [m]
    load: Array  # line loads [N/m]
    contact: LineContact
    groups: Groups  # M and L


def contacts_of(flanks: Flanks, places: Array, load: Array) -> PlacedContacts:
    """Line contacts at places g [m] under line loads [N/m], shape (n,)."""
    first, second = flanks.path.speeds(places, flanks.pinion_speed, flanks.ratio)
    contact = LineContact(
        reduced_radius=np.asarray(flanks.path.reduced_radius(places)),
        reduced_modulus=flanks.modulus,
        load_per_length=load,
        entrainment_speed=0.5 * (np.asarray(first) + second),
        viscosity=flanks.oil.viscosity,
        pressure_viscosity_coefficient=flanks.oil.film_coefficient,
    )
    return PlacedContacts(places, load, contact, Groups(contact.moes_m, contact.moes_l))


def flank_films(
    flanks: Flanks, placed: PlacedContacts, table: FilmTable, *, by_formula: bool = False
) -> tuple[FlankFilms, FilmShape]:
    """Films of n line contacts, and their numbers of the atlas.

    Places without a load have no film: NaN. ``by_formula``, films of Pan and Hamrock instead of the atlas;
    their shape, on which the capacitance depends, is from the atlas.
    """
    places, load, contact = placed.places, placed.load, placed.contact
    carried = np.where(load > 0.0, load, np.nan)
    radius, speed = np.asarray(contact.reduced_radius), np.asarray(contact.entrainment_speed)
    scale = np.sqrt(2.0 * contact._u)
    # A place without a load has the numbers of the lightest load of the table.
    shape = table(placed.groups)
    central, minimum, error = radius * scale * shape.central, radius * scale * shape.minimum, shape.error
    if by_formula:
        star = flanks.oil.alpha_star
        loaded = replace(contact, load_per_length=carried, pressure_viscosity_coefficient=star)
        formula = pan_hamrock(loaded)
        central, minimum = np.asarray(formula.central_thickness), np.asarray(formula.minimum_thickness)
        error = np.full_like(radius, FORMULA_ERROR)
    heat = np.ones_like(speed)
    oil = flanks.oil
    if oil.slope is not None:
        heat = np.asarray(inlet_shear_factor(oil.viscosity, oil.slope, speed, oil.thermal_conductivity))
    none = np.where(load > 0.0, 1.0, np.nan)
    width = np.asarray(line_half_width(load_per_length=carried, radius=radius, modulus=flanks.modulus))
    films = FlankFilms(
        places=places,
        load=carried,
        reduced_radius=radius,
        mean_speed=speed,
        sliding_speed=np.asarray(flanks.path.sliding_speed(places, flanks.pinion_speed, flanks.ratio)),
        half_width=width,
        max_pressure=np.asarray(
            line_max_pressure(load_per_length=carried, radius=radius, modulus=flanks.modulus)
        ),
        central=heat * central * none,
        minimum=heat * minimum * none,
        heat_factor=heat,
        friction=np.full_like(speed, np.nan),
        error=error * none,
        known=shape.known,
    )
    return films, shape


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
