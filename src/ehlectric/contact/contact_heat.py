"""Heat and shear in the film of a contact: solver input; numbers, files and warnings of results."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.film_inputs import thermal_properties
from ehlectric.contact.conditions import Conditions, PointConditions, surface_ratios
from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError
from ehlectric.film import UNBOUNDED, Body, Film, HeatedFilm, HotOil, Physics, PointFilm, Rheology, Thermal
from ehlectric.lubricant.oil import Oil
from ehlectric.lubricant.python_laws import OwnLaws, SampledLaws
from ehlectric.quantities.formats import CELSIUS
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable

# Keys of the temperatures of the oil in the inlet and of both bodies.
_TEMPERATURES = ("contact.temperature", "contact.temperature_1", "contact.temperature_2")


def physics_of(case: Case | Setup, conditions: Conditions | PointConditions) -> Physics | None:
    """Rheology, speeds, bodies and hot oil of the film of a contact; None for an isothermal Newtonian film.

    Raises an InputError if a surface moves against entrainment in a thermal film, or if the oil has no values
    at the temperatures of the film.

    Examples
    --------
    >>> from ehlectric.contact.conditions import resolve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "entrainment_speed": 4.0}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "slide_to_roll_ratio": 0.5}
    >>> oil = {"base": "paper", "eyring_stress": "5 MPa"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": oil, "film": {"rheology": "eyring"}})
    >>> found = physics_of(case, resolve(case))
    >>> found.speeds, found.rheology.constants
    ((5.0, 3.0), {'eyring_stress': 5000000.0})
    """
    if not isinstance(case, Case) or case.film is None:
        return None
    speed = conditions.entrainment_speed
    first, second = (speed * ratio for ratio in surface_ratios(conditions.slide_to_roll_ratio))
    return Physics(
        rheology=Rheology(case.film.rheology, case.film.constants(case.lubricant)),
        speeds=(first, second),
        viscosity=conditions.viscosity,
        thermal=_thermal(case, conditions, (first, second)) if case.film.thermal else None,
        boundary_friction=case.contact.boundary_friction,
    )


def _thermal(case: Case, conditions: Conditions | PointConditions, speeds: tuple[float, float]) -> Thermal:
    """Bodies and oil of a thermal film."""
    contact = case.contact
    if min(speeds) < 0.0:
        raise InputError(
            "contact.slide_to_roll_ratio",
            got=f"{conditions.slide_to_roll_ratio:g}, at which surface {1 + speeds.index(min(speeds))} moves "
            "against entrainment",
            takes="-2 to 2 for a thermal film",
        )
    assert contact.temperature is not None
    inlet = contact.temperature
    warm = tuple(inlet if t is None else t for t in (contact.temperature_1, contact.temperature_2))
    bodies = tuple(
        Body(temperature, **thermal_properties(contact.value(name), f"contact.{name}"))
        for name, temperature in zip(("body_1", "body_2"), warm, strict=True)
    )
    return Thermal(
        bodies=(bodies[0], bodies[1]),
        inlet_temperature=inlet,
        oil=hot_oil(
            case.lubricant, (inlet, *warm), conditions.max_pressure, _TEMPERATURES, laws=case.user_laws
        ),
    )


def heat_summary(heated: HeatedFilm | None) -> dict[str, Any]:
    """Numbers of heat and shear for the table ``film`` of summary.json; empty for a film without them."""
    if heated is None:
        return {}
    return {
        "rheology": heated.rheology,
        "thermal": heated.thermal,
        "max_temperature_rise": heated.max_temperature_rise,
        "temperature_rise_error": heated.temperature_rise_error,
        "traction_coefficient": heated.traction_coefficient,
        "rolling_coefficient": heated.rolling_coefficient,
        "power_loss": heated.power_loss,
        "energy_imbalance": heated.energy_imbalance,
        "isothermal": {
            "minimum_thickness": heated.isothermal_minimum_thickness,
            "central_thickness": heated.isothermal_central_thickness,
        },
    }


# Hertz pressure from which the traction of a Newtonian film is meaningless [Pa]: at 1 GPa it is 5 to 30 times
# too large.
_NEWTONIAN = 0.5e9

# Shear stress divided by pressure, above the values of all oils: measured limits are 0.03 to 0.12.
_CARRIED = 0.15

# Slide-to-roll ratio from which there is a traction to warn of.
_PURE_ROLLING = 1e-4

# Peclet number u b/(2 kappa) of a body below which the conduction along its surface matters: of a line
# contact, whose conduction along is computed, near the steady state that a body at rest does not have.
_SLOW = {"line": 0.1, "point": 5.0}

# Error of the temperature rise over the rise, and of the balance of heat, above which there is a warning.
_RISE_ERROR, _IMBALANCE = 0.05, 0.01

# Error of the rise of which there is no warning [K].
_SMALL_ERROR = 0.1

# Position from which a maximum of the pressure is the spike, and the distance from it that counts as at the
# spike, in half-widths of the contact.
_OUTLET, _NEAR = 0.3, 0.05

# Rise whose error is of no interest [K], and rise from which the model is doubtful [K].
_SMALL_RISE, _LARGE_RISE = 1.0, 200.0

# Temperatures at which the slope of the viscosity is looked at, and the slope of ln(eta) that is more than
# rounding [1/K].
_SAMPLES, _RISES = 50, 1e-6


def heat_warnings(
    case: Case | Setup,
    conditions: Conditions | PointConditions,
    film: Film | PointFilm,
    physics: Physics | None,
) -> Iterator[ResultWarning]:
    """Warnings about a film with heat or shear; none for an isothermal Newtonian film."""
    heated = film.heated
    if heated is None or physics is None:
        return
    if not film.converged:
        if physics.thermal is not None:
            thicker = _thicker_from(physics.thermal.oil, conditions.max_pressure)
            if thicker is not None:
                text = _thicker(thicker, conditions.max_pressure)
                yield ResultWarning.of("film-temperature-range", "not_converged", thicker=text)
        return
    if heated.isothermal_minimum_thickness is None:
        yield ResultWarning.of("isothermal-unsolved")
    slides = abs(conditions.slide_to_roll_ratio) > _PURE_ROLLING
    if heated.thermal and slides and film.contact.any() and physics.boundary_friction is None:
        yield ResultWarning.of("spot-heat-unknown")
    yield from _traction(heated, conditions)
    if physics.thermal is not None and isinstance(case, Case):
        yield from _temperatures(case, heated, physics.thermal.oil, conditions.max_pressure)
        yield from _accuracy(film, heated)
        for number, (body, speed) in enumerate(zip(physics.thermal.bodies, physics.speeds, strict=True), 1):
            yield from _slow(number, body, speed, conditions)


def unconverged_heat(heated: HeatedFilm, max_pressure: float, *, rough: bool) -> str:
    """Advice about a film with heat that did not converge at a Hertz pressure [Pa].

    The iteration between film and temperature has its own limit, so that more Newton steps do not help. The
    effect of a finer grid is not known before it is solved.
    """
    stress = float(np.max(np.abs(heated.shear_stress)))
    if heated.rheology == "newtonian" and not stress < _CARRIED * max_pressure:
        return (
            f"The film would have shear stresses up to {readable(stress / max_pressure, 2)} times the "
            f"maximum Hertzian pressure, but oils carry less than {_CARRIED:g} times. Give "
            "lubricant.eyring_stress, and set film.rheology to 'eyring'"
        )
    if heated.unsettled is not None:
        return unsettled_heat(heated.unsettled, reached_rise(heated), rough=rough)
    return (
        f"Temperature and pressure do not converge together ({reached_rise(heated)}), also with more Newton "
        "steps. Try another number of grid.nodes, or film.thermal = false"
    )


def unsettled_heat(unsettled: tuple[float, float, float], reached: str, *, rough: bool) -> str:
    """Reason and advice about a film that converges in each turn while its temperature does not.

    ``unsettled`` is the change of temperature [K] and the position, as in ``HeatedFilm``, and ``reached`` the
    temperature rise in words.

    Examples
    --------
    >>> text = unsettled_heat((17.3, 0.28, 0.0), "last rise 90 K", rough=False)
    >>> text.split("temperature ")[1].split(": ")[0]
    '(energy equation) still changes by 17 K at x/b = 0.28 (last rise 90 K)'
    """
    change, x, y = unsettled
    place = f"(x, y)/b = ({x:.2f}, {y:.2f})" if y else f"x/b = {x:.2f}"
    advice = "try another number of grid.nodes, or film.thermal = false"
    if rough:
        advice = f"use a longer cutoff_short or a lower roughness, or {advice}"
    return (
        f"The film converges, and its temperature (energy equation) still changes by {readable(change, 2)} K "
        f"at {place} ({reached}): {advice}"
    )


def reached_rise(heated: HeatedFilm) -> str:
    """Temperature rise in the last iteration of a film that is not converged, in words."""
    return f"last temperature rise {readable(heated.max_temperature_rise or 0.0)} K"


def _traction(heated: HeatedFilm, conditions: Conditions | PointConditions) -> Iterator[ResultWarning]:
    """Warning about the friction of a film at high pressure whose shear stress has no bound."""
    slides = abs(conditions.slide_to_roll_ratio) > _PURE_ROLLING
    if heated.rheology not in UNBOUNDED or not slides or conditions.max_pressure <= _NEWTONIAN:
        return
    assert heated.traction_coefficient is not None
    numbers = f"the traction coefficient of {readable(abs(heated.traction_coefficient))}"
    numbers += ", the temperature rise and the power loss" if heated.thermal else " and the power loss"
    # Heat and Carreau's law keep the stress within the size of measured ones, but not below their limit.
    law = "carreau" if heated.rheology == "carreau" and heated.thermal else "unbounded"
    rheology = heated.rheology.capitalize()
    yield ResultWarning.of(
        "newtonian-traction", law, numbers=numbers, above=_NEWTONIAN / 1e9, rheology=rheology
    )


def _thicker_from(oil: HotOil, pressure: float) -> float | None:
    """Temperature [K] from which the laws of an oil make it thicker with temperature; None if nowhere."""
    temperature = np.linspace(oil.lowest, oil.highest, _SAMPLES)
    rises = oil.log_viscosity(np.full(_SAMPLES, pressure), temperature).by_temperature > _RISES
    return float(temperature[np.argmax(rises)]) if rises.any() else None


def _thicker(temperature: float, pressure: float) -> str:
    return (
        f"at {readable(pressure / 1e9)} GPa the laws of the oil make it thicker with temperature above "
        f"{readable(CELSIUS.of(temperature))} °C, which no oil does"
    )


def _temperatures(
    case: Case, heated: HeatedFilm, oil: HotOil, max_pressure: float
) -> Iterator[ResultWarning]:
    """Warnings about temperatures at which oil, laws or model are not known."""
    reached, known = heated.temperature_range, case.lubricant.temperature_range
    if case.user_laws is not None and "viscosity" in case.user_laws.names:
        known = None  # the range of the laws that are replaced
    assert reached is not None
    reasons = []
    if known is not None and not (known[0] <= reached[0] and reached[1] <= known[1]):
        reasons.append(
            f"the laws of the oil hold for {_celsius(*known)} (lubricant.temperature_range), and are "
            "extrapolated"
        )
    if not (oil.lowest <= reached[0] and reached[1] <= oil.highest):
        effect = " (temperature_rise_error contains the effect)" if reached[1] > oil.highest else ""
        reasons.append(
            f"its properties were sampled from {_celsius(oil.lowest, oil.highest)}, and are extrapolated "
            f"linearly{effect}"
        )
    thicker = _thicker_from(oil, max_pressure)
    if thicker is not None and thicker < reached[1]:
        reasons.append(_thicker(thicker, max_pressure))
    if reasons:
        yield ResultWarning.of(
            "film-temperature-range", "converged", temperatures=_celsius(*reached), reasons="; ".join(reasons)
        )
    rise = heated.max_temperature_rise or 0.0
    if rise > _LARGE_RISE:
        yield ResultWarning.of("film-very-hot", rise=rise)


def _celsius(low: float, high: float) -> str:
    return f"{readable(CELSIUS.of(low), 4)} to {CELSIUS.text(high)}"


def _accuracy(film: Film | PointFilm, heated: HeatedFilm) -> Iterator[ResultWarning]:
    """Warning about a temperature rise that the grid does not resolve."""
    rise, error, lost = heated.max_temperature_rise, heated.temperature_rise_error, heated.energy_imbalance
    if rise is None or rise < _SMALL_RISE:
        return
    if error is not None and error > max(_SMALL_ERROR, _RISE_ERROR * rise):
        where = "spike" if _at_spike(film, heated) else "rise"
        yield ResultWarning.of("heat-unresolved", where, rise=rise, percent=100 * error / rise)
    elif lost is not None and abs(lost) > _IMBALANCE:
        yield ResultWarning.of("heat-unresolved", "balance", percent=100 * abs(lost))


def _at_spike(film: Film | PointFilm, heated: HeatedFilm) -> bool:
    """Whether the hottest node at mid-film is at the pressure spike, a maximum near the outlet."""
    assert heated.mid_temperature is not None
    along, *across = np.unravel_index(np.argmax(heated.mid_temperature), film.pressure.shape)
    pressure = film.pressure[:, across[0]] if across else film.pressure
    x = film.x / film.scales.length
    peaks = 1 + np.flatnonzero((pressure[1:-1] > pressure[:-2]) & (pressure[1:-1] >= pressure[2:]))
    return bool(np.any((x[peaks] > _OUTLET) & (np.abs(x[peaks] - x[along]) < _NEAR)))


def _slow(
    number: int, body: Body, speed: float, conditions: Conditions | PointConditions
) -> Iterator[ResultWarning]:
    """Warning about a surface that moves so slowly that the model does not give its temperature."""
    peclet = speed * conditions.semi_axes[0] / (2.0 * body.diffusivity)
    if peclet < _SLOW[conditions.geometry]:
        spread = "sideways" if conditions.geometry == "point" else "without a steady state"
        yield ResultWarning.of(
            "slow-body",
            surface=number,
            speed=speed,
            peclet=peclet,
            least=_SLOW[conditions.geometry],
            spread=spread,
        )


# Temperatures over which the laws of the oil are taken: that far below the coldest part at the inlet, since
# oil that expands in the outlet cools by some kelvins, and that far above the hottest one [K].
_BELOW, _ABOVE = 20.0, 250.0

# Steps by which the range shrinks where a law has no value at its end [K], and its smallest part above the
# inlet.
_STEP, _LEAST = 10.0, 30.0

# Largest number of such steps in the search for a temperature that a message may name.
_SEARCHED = 100


def oil_over_temperature(lubricant: Lubricant) -> Callable[[float], Oil]:
    """Oil as a function of temperature, also beyond the range of its measurements.

    The film is nearly always hotter than the oil in the inlet, so that ``temperature_range`` does not bound
    its temperatures; a warning reports when they leave it. Electrical properties have no part in the film.
    """
    mechanical = lubricant.model_copy(
        update={
            "temperature_range": None,
            "permittivity_table": None,
            "conductivity_table": None,
            "conductivity_law": None,
            "relative_permittivity": 1.0,
        }
    )
    return lambda temperature: mechanical.at(temperature)


def _with_laws(oil_at: Callable[[float], Oil], laws: OwnLaws, max_pressure: float) -> Callable[[float], Oil]:
    """Oil as a function of temperature, with a user's own laws at each temperature."""
    return lambda temperature: laws.at(temperature, max_pressure).applied(oil_at(temperature))


def hot_oil(
    lubricant: Lubricant,
    temperatures: tuple[float, ...],
    max_pressure: float,
    keys: tuple[str, ...] = (),
    *,
    laws: OwnLaws | None = None,
) -> HotOil:
    """Oil over pressure and temperature for the energy equation of a film.

    The oil reaches from 20 K below the lowest of the ``temperatures``, the temperatures of the inlet and of
    both bodies [K], to 250 K above the highest, or as far as its laws have values up to the Hertz pressure
    [Pa]. Raises an InputError, which names one of the ``keys``, if they have none near these temperatures.
    """
    oil_at = oil_over_temperature(lubricant)
    if laws is not None:
        # A law without values at the inlet is named, and so is a file that has values at the inlet only.
        laws.at(temperatures[0], max_pressure)
        if isinstance(laws, SampledLaws) and not laws.others:
            laws.at(max(temperatures) + _ABOVE, max_pressure)
        oil_at = _with_laws(oil_at, laws, max_pressure)
    ends = []
    for extreme, furthest, least in ((min, -_BELOW, 0.0), (max, _ABOVE, _LEAST)):
        start = extreme(temperatures)
        end = _end(oil_at, start, furthest, least, max_pressure)
        if end is None:
            key = keys[temperatures.index(start)] if keys else None
            raise _no_values(oil_at, start, np.copysign(least, furthest), max_pressure, key)
        ends.append(end)
    return HotOil.through(oil_at, *ends)


def _end(
    oil_at: Callable[[float], Oil], start: float, furthest: float, least: float, max_pressure: float
) -> float | None:
    """End of the range [K]: as far from ``start`` as the laws of the oil have values; None if nowhere."""
    away = abs(furthest)
    while away >= least:
        end = start + np.copysign(away, furthest)
        if _has_values(oil_at, end, max_pressure):
            return float(end)
        away -= _STEP
    return None


def _no_values(
    oil_at: Callable[[float], Oil], start: float, beyond: float, max_pressure: float, key: str | None
) -> InputError:
    """Error of a temperature [K] from which the film reaches ``beyond`` [K], where an oil has no values."""
    needed = start + beyond
    what = f"has no viscosity, density or thermal properties at {CELSIUS.text(needed)}"
    if key is None:
        text = f"{what}, a temperature that the film may reach; choose other laws for a thermal film"
        return InputError.worded("lubricant", text)
    towards = np.copysign(_STEP, -beyond)
    known = (needed + k * towards for k in range(1, _SEARCHED))
    end = next((at for at in known if _has_values(oil_at, at, max_pressure)), None)
    takes = "other laws of the lubricant"
    if end is not None:
        takes = f"at {'least' if towards > 0.0 else 'most'} {CELSIUS.text(end - beyond)}, or {takes}"
    return InputError(
        key,
        f"got {CELSIUS.text(start)}, with which the film may reach "
        f"{CELSIUS.text(needed)}, where the "
        "lubricant has no viscosity, density or thermal properties",
        takes=takes,
    )


def _has_values(oil_at: Callable[[float], Oil], temperature: float, max_pressure: float) -> bool:
    """Whether the laws of an oil have values at a temperature and at pressures up to the largest."""
    pressure = np.array([0.0, 0.5, 1.0]) * max_pressure
    try:
        with np.errstate(all="ignore"):
            oil = oil_at(temperature)
            laws = (oil.log_viscosity, oil.density_ratio, oil.thermal_conductivity_law, oil.heat_capacity_law)
            values = [law(pressure)[0] for law in laws if law is not None]
    except (InputError, ArithmeticError, ValueError):
        return False
    thermal = [value for value in values[1:] if not np.all(value > 0.0)]
    finite = all(bool(np.all(np.isfinite(value))) for value in values)
    return not thermal and finite and float(oil.viscosity) > 0.0
