"""Laws of a discharge: breakdown voltage and probability, energy, pit size, current density, and charge
relaxation time.

All quantities are in SI units. The field is proportional to the voltage, so one solution serves all voltages.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from operator import add, truediv
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.cases.discharge_inputs import Discharge, Pit
from ehlectric.constants import EPSILON_0
from ehlectric.field import areas
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.quantity import data_file

if TYPE_CHECKING:
    from ehlectric.film import Film, PointFilm

T = TypeVar("T")

# Lateral size of the pits that discharges leave in bearings: maximum and mean [m].
LARGEST_PIT, MEAN_PIT = 4.0e-6, 1.7e-6

# Film thickness below which electrons tunnel through the film in large numbers [m].
TUNNELLING = 2e-9

# Largest margin. A larger margin follows from a voltage or a capacitance that no machine has.
MOST_MARGIN = 1e6

# Published limits of the apparent current density, peak current over Hertz area, above which bearings are
# damaged [A/m^2].
CURRENT_DENSITY_LIMITS = (1e5, 3e5, 8e5)

# Sources and assumptions of those values of a summary that do not follow only from case and solution.
SOURCES: Mapping[str, str] = data_file("ehlectric.quantities", "discharge_sources.toml")

# Utilisation is the ratio of field strength to dielectric strength. The zone that breaks down first is where
# the utilisation is at least this part of its maximum.
BREAKING = 0.95


def breakdown_voltage(voltage: float, strength: Array, dielectric_strength: Array | float) -> float:
    """Voltage at which the field first reaches the dielectric strength: V_b = V/max(E/E_b). ``voltage``,
    voltage V at which the field was solved [V]; ``strength``, field strength E [V/m], shape (...);
    ``dielectric_strength``, dielectric strength E_b at the same positions [V/m], shape (...). Returns
    breakdown voltage V_b [V].

    Examples
    --------
    >>> breakdown_voltage(2.0, np.array([5e6, 10e6]), 15e6)
    3.0
    """
    return float(voltage / np.max(strength / dielectric_strength))


@dataclass(frozen=True)
class WeakestLink:
    """Weibull law of breakdown for a solved field: P(V) = 1 - exp(-(V/V_0)^m).

    The exponent (V/V_0)^m is the integral of (E/E_0)^m dA/A_0. The field strength E is proportional to the
    voltage V, so V_0 describes the whole field. A larger stressed area is more likely to break down.

    W. Weibull, J. Appl. Mech. 18 (1951) 293, doi:10.1115/1.4010337.

    Examples
    --------
    A uniform field of half the scale E_0 over four reference areas, with m = 2, gives the exponent 1:

    >>> law = WeakestLink.of(10.0, np.full(4, 5e6), np.full(4, 1e-6), 10e6, 2.0, 1e-6)
    >>> law.characteristic_voltage, round(law.probability(10.0), 4)
    (10.0, 0.6321)
    """

    shape: float  # weibull shape m, dimensionless
    characteristic_voltage: float  # voltage V_0 at which the probability of breakdown is 1 - 1/e, 63.2 % [V]

    @classmethod
    def of(
        cls, voltage: float, strength: Array, areas: Array, scale: float, shape: float, reference_area: float
    ) -> WeakestLink:
        """Weibull law of a solved field. ``voltage``, voltage at which the field was solved [V]; ``strength``
        and ``areas``, field strength E [V/m], and the area on which it acts [m^2], shape (...); ``scale``,
        ``shape`` and ``reference_area``, scale E_0 [V/m], shape m, and reference area A_0 [m^2] of the
        Weibull law.
        """
        largest = float(np.max(strength))
        # The field strength is divided by its maximum, as a high power of the undivided strength would
        # overflow.
        area = float(np.vdot((strength / largest) ** shape, areas))
        return cls(shape, voltage * scale / largest * (reference_area / area) ** (1.0 / shape))

    def probability(self, voltage: float) -> float:
        """Probability of breakdown at a voltage [V], from 0 to 1."""
        with np.errstate(over="ignore", under="ignore"):
            exponent = np.power(voltage / self.characteristic_voltage, self.shape)
        return float(-np.expm1(-exponent))

    def voltage(self, probability: float) -> float:
        """Voltage [V] at which breakdown has a given probability, above 0 and below 1."""
        exponent = -np.log1p(-probability)
        return float(self.characteristic_voltage * exponent ** (1.0 / self.shape))


def stored_energy(capacitance: Numbers, voltage: Numbers) -> Numbers:
    """Energy stored in a capacitance C [F] at a voltage V [V], C V^2/2 [J].

    Examples
    --------
    >>> round(stored_energy(1e-9, 20.0) * 1e9, 9)
    200.0
    """
    return 0.5 * capacitance * voltage**2


def melted_volume(energy: Numbers, efficiency: Numbers, melting_energy: Numbers) -> Numbers:
    """Volume of one surface that a discharge melts: efficiency times energy over melting energy. ``energy``
    [J]; ``efficiency``, part of the energy that melts one surface, from 0 to 1, dimensionless;
    ``melting_energy``, energy to heat and melt the material, per volume [J/m^3]. Returns melted volume [m^3].

    Examples
    --------
    >>> round(melted_volume(1e-6, 0.2, 1e10) * 1e18, 9)
    20.0
    """
    return efficiency * energy / melting_energy


def known(law: Callable[..., T], *values: Numbers | None) -> T | None:
    """Value of a law; None where one of its arguments is not known."""
    return None if any(value is None for value in values) else law(*values)


def known_of(record: Any, name: str) -> Any:
    """Attribute of a record; None without the record."""
    return None if record is None else getattr(record, name)


def volume_of_pit(pit: Pit | None, energy: Numbers | None) -> Numbers | None:
    """Volume that a discharge of an energy [J] melts [m^3]; None without the table ``pit`` or an energy."""
    return None if pit is None else known(melted_volume, energy, pit.efficiency, pit.melting_energy)


def pit_diameter(volume: Numbers) -> Numbers:
    """Diameter d of a hemispherical pit [m] from its volume V = pi d^3/12 [m^3].

    Examples
    --------
    >>> round(float(pit_diameter(np.pi / 12.0)), 12)
    1.0
    """
    return np.cbrt(12.0 * volume / np.pi)


def relaxation_time(relative_permittivity: Numbers, conductivity: Numbers) -> Numbers:
    """Charge relaxation time of a dielectric, eps0 eps_r/sigma [s], with the conductivity sigma [S/m].

    Above the frequency 1/(2 pi tau), where tau is this time, the film is a capacitor; below it, a resistor.

    Examples
    --------
    >>> round(relaxation_time(2.4, 1e-12), 2)
    21.25
    """
    return EPSILON_0 * relative_permittivity / conductivity


def compared_with_limits(density: float) -> str:
    """Text about which of the published limits are below an apparent current density [A/m^2] lies.

    Examples
    --------
    >>> compared_with_limits(0.364e6)
    'above 2 of the 3 published limits for bearings (0.1, 0.3 and 0.8 A/mm²)'
    """
    *first, last = (f"{1e-6 * limit:g}" for limit in CURRENT_DENSITY_LIMITS)
    above, count = sum(density > limit for limit in CURRENT_DENSITY_LIMITS), len(CURRENT_DENSITY_LIMITS)
    part = f"{above or 'none'} of the {count}"
    return f"above {part} published limits for bearings ({', '.join(first)} and {last} A/mm²)"


@dataclass(frozen=True)
class Size:
    """Size of the dry contact."""

    half_width: float  # half-width of a line contact, or semi-axis of a point contact along entrainment [m]
    hertz: float  # width of a dry line contact [m], or area of a dry point contact [m^2]
    # Length of a line contact [m], None if the case does not give it; 1 for a point contact.
    length: float | None
    line: bool

    @classmethod
    def of(cls, semi_axes: tuple[float, ...], discharge: Discharge) -> Size:
        """Size of a dry contact from its half-width [m], or from its two semi-axes [m]."""
        b = semi_axes[0]
        if len(semi_axes) == 1:
            return cls(b, 2.0 * b, discharge.length, line=True)
        return cls(b, np.pi * b * semi_axes[1], 1.0, line=False)

    def total(self, per_length: float) -> float | None:
        """Value of the whole contact from a value per length; None for a line contact of unknown length.

        A value of a point contact is returned unchanged.
        """
        return None if self.length is None else self.length * per_length


@dataclass(frozen=True)
class DischargeCosts:
    """Energy of a discharge, size of the pit that it melts, and current density.

    A value is None if the case lacks an input that it needs.
    """

    contact_energy: float | None = None  # energy C V^2/2 stored in the contact at the voltage of the case [J]
    # Energy C V^2/2 stored in the contact and in the external capacitance, at the voltage of the case [J].
    discharge_energy: float | None = None
    # Energy C V^2/2 stored in the contact and in the external capacitance, at the breakdown voltage [J].
    breakdown_energy: float | None = None
    pit_volume: float | None = None  # volume of one surface that ``discharge_energy`` melts [m^3]
    pit_diameter: float | None = None  # diameter of a hemisphere of that volume [m]
    current_density: float | None = None  # peak current over the area of the dry contact [A/m^2]
    current_density_limits: tuple[float, ...] | None = None  # published limits of the current density [A/m^2]


def discharge_costs(
    discharge: Discharge, capacitance: float, voltage: float, breaking_voltage: float | None, size: Size
) -> DischargeCosts:
    """Energy of a discharge, size of the pit that it melts, and apparent current density.

    ``capacitance``, capacitance per length of a line contact [F/m], or of a point contact [F]; ``voltage``
    [V]; ``breaking_voltage``, breakdown voltage [V]; None if it is unknown. Returns values in SI units; None
    if the case lacks an input that a value needs.
    """
    total, current = size.total(capacitance), discharge.peak_current
    together = known(add, total, discharge.external_capacitance)
    energy = known(stored_energy, together, voltage)
    volume = volume_of_pit(discharge.pit, energy)
    area = None if current is None else size.total(size.hertz)
    numbers = {
        "contact_energy": known(stored_energy, total, voltage),
        "discharge_energy": energy,
        "breakdown_energy": known(stored_energy, together, breaking_voltage),
        "pit_volume": volume,
        "pit_diameter": known(pit_diameter, volume),
        "current_density": known(truediv, current, area),
    }
    return DischargeCosts(
        **{name: known(float, value) for name, value in numbers.items()},
        current_density_limits=None if area is None else CURRENT_DENSITY_LIMITS,
    )


@dataclass(frozen=True)
class Leakage:
    """Leakage of charge through the oil at ambient pressure; None if the conductivity is unknown."""

    relaxation_time: Numbers | None = None  # charge relaxation time eps0 eps_r/sigma [s]
    # Frequency above which the film is a capacitor, 1/(2 pi ``relaxation_time``) [Hz].
    corner_frequency: Numbers | None = None


def conductivity_of(discharge: Discharge | None, oil: Oil) -> Numbers | None:
    """Electrical conductivity [S/m] of the table ``discharge``, or else of the oil; None without one."""
    given = None if discharge is None else discharge.conductivity
    return oil.conductivity if given is None else given


def leakage(
    discharge: Discharge,
    oil: Oil,
    film: Film | PointFilm | None = None,
    semi_axes: tuple[float, ...] = (),
) -> Leakage:
    """Leakage of charge through an oil at ambient pressure. ``discharge``, inputs of the discharge; its
    conductivity, if it has one, holds at any temperature; ``semi_axes``, half-width or semi-axes of the Hertz
    zone of the film [m]. Returns relaxation time and corner frequency.
    """
    conductivity = conductivity_of(discharge, oil)
    if conductivity is None:
        return Leakage()
    over = None if discharge.conductivity is not None else oil.conductivity_over
    if over is not None and film is not None and film.temperature is not None:
        conductivity = mean_conductivity(film, over(film.temperature), semi_axes)
    time = relaxation_time(oil.relative_permittivity, conductivity)
    return Leakage(relaxation_time=time, corner_frequency=1.0 / (2.0 * np.pi * time))


def mean_conductivity(film: Film | PointFilm, conductivity: Array, semi_axes: tuple[float, ...]) -> float:
    """Mean conductivity of the oil in the Hertz zone, weighted by the conductance of the film.

    ``conductivity``, electrical conductivity of the oil at the nodes [S/m], shape (nx,) or (nx, ny);
    ``semi_axes``, half-width or semi-axes of the Hertz zone [m]. Returns int sigma/h dA over Int 1/h dA
    [S/m]: the oil columns of the zone lie side by side between the walls.
    """
    places = np.meshgrid(*film.axes, indexing="ij")
    zone = sum((at / half) ** 2 for at, half in zip(places, semi_axes, strict=True)) <= 1.0
    weights = np.where(zone, areas(film.axes) / film.thickness, 0.0)
    return float(np.sum(weights * conductivity) / np.sum(weights))
