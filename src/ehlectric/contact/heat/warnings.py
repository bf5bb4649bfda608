"""Warnings about the heat and the shear of the film of a contact."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.contact.setup import Setup
from ehlectric.errors import ResultWarning
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.film.sheared.laws import UNBOUNDED
from ehlectric.film.thermal.oil import HotOil
from ehlectric.film.thermal.physics import Body, Physics
from ehlectric.film.thermal.result import HeatedFilm

# Hertz pressure from which the traction of a Newtonian film is meaningless [Pa]: at 1 GPa it is 5 to 30 times
# too large.
_NEWTONIAN = 0.5e9

# Shear stress over pressure above that of all oils: measured limits are 0.03 to 0.12.
_CARRIED = 0.15

# Slide-to-roll ratio from which there is a traction to warn of.
_PURE_ROLLING = 1e-4

# Peclet number u b/(2 kappa) of a body below which the conduction along its surface matters: of a line
# contact, whose conduction along is computed, near the steady state that a body at rest does not have.
_SLOW = {"line": 0.1, "point": 5.0}

# Error of the temperature rise over the rise, and of the balance of heat, above which there is a warning.
_RISE_ERROR, _IMBALANCE = 0.05, 0.02

# Error of the rise of which there is no warning [K].
_SMALL_ERROR = 0.1

# Position from which a maximum of the pressure is the spike, and the distance from it that counts as at the
# spike, in half-widths of the contact.
_OUTLET, _NEAR = 0.3, 0.05

# Rise whose error is of no interest [K], and rise from which the model is doubtful [K].
_SMALL_RISE, _LARGE_RISE = 1.0, 200.0

# Minimum film over the boundary film below which surfaces touch.
_TOUCHING = 1.01

# Temperatures at which the slope of the viscosity is looked at.
_SAMPLES = 50

_CELSIUS = 273.15


def heat_warnings(
    case: Case | Setup,
    conditions: Conditions | PointConditions,
    film: Film | PointFilm,
    physics: Physics | None,
) -> Iterator[ResultWarning]:
    """Warnings about a film with heat or shear; none for an isothermal Newtonian film.

    Parameters
    ----------
    case : Case or Setup
        Case of the contact.
    conditions : Conditions or PointConditions
        Operating conditions.
    film : Film or PointFilm
        Solved film.
    physics : Physics or None
        Heat and shear as they were solved.
    """
    heated = film.heated
    if heated is None or physics is None:
        return
    if not film.converged:
        simple = heated.isothermal_minimum_thickness
        thinnest = film.minimum_thickness if simple is None else min(simple, film.minimum_thickness)
        if film.status == "film collapsed" or thinnest < _TOUCHING * conditions.boundary_film:
            yield ResultWarning(
                "surfaces-touch",
                "the surfaces would touch: films whose surfaces touch are solved without the table [film] "
                "only; leave it out, lower the roughness, or raise speed or viscosity",
            )
        elif physics.thermal is not None:
            thicker = _thicker_from(physics.thermal.oil, conditions.max_pressure)
            if thicker is not None:
                text = _thicker(thicker, conditions.max_pressure)
                yield ResultWarning("film-temperature-range", f"{text}; give other laws of the lubricant")
        return
    if heated.isothermal_minimum_thickness is None:
        yield ResultWarning(
            "isothermal-unsolved",
            "the isothermal Newtonian film of this contact did not converge, so that the effect of heat and "
            "shear on the film is not known; the film itself may be used; try more solver.max_iterations "
            "or grid.nodes",
        )
    yield from _traction(heated, conditions)
    if physics.thermal is not None and isinstance(case, Case):
        yield from _temperatures(case, heated, physics.thermal.oil, conditions.max_pressure)
        yield from _accuracy(film, heated)
        for number, (body, speed) in enumerate(zip(physics.thermal.bodies, physics.speeds, strict=True), 1):
            yield from _slow(number, body, speed, conditions)


def unconverged_heat(heated: HeatedFilm, max_pressure: float) -> str:
    """Advice about a film with heat that did not converge at a Hertz pressure [Pa].

    Its turns of film and temperature have a limit of their own, so that more Newton steps do not help. What a
    finer grid does is not known before it is tried.
    """
    stress = float(np.max(np.abs(heated.shear_stress)))
    if heated.rheology == "newtonian" and not stress < _CARRIED * max_pressure:
        return (
            f"the film would have shear stresses up to {stress / max_pressure:.2g} times the Hertz pressure, "
            f"and oils carry less than {_CARRIED:g} times: no oil is Newtonian there; give "
            "lubricant.eyring_stress and film.rheology 'eyring'"
        )
    return (
        "its temperature and its pressure do not settle together, which more Newton steps do not change; "
        "another number of grid.nodes may, and film.thermal = false has no such turns"
    )


def _traction(heated: HeatedFilm, conditions: Conditions | PointConditions) -> Iterator[ResultWarning]:
    """Warning about the friction of a film at high pressure whose shear stress has no bound."""
    slides = abs(conditions.slide_to_roll_ratio) > _PURE_ROLLING
    if heated.rheology not in UNBOUNDED or not slides or conditions.max_pressure <= _NEWTONIAN:
        return
    assert heated.traction_coefficient is not None
    traction, above = f"{abs(heated.traction_coefficient):.3g}", f"{_NEWTONIAN / 1e9:g} GPa"
    numbers = f"the traction coefficient of {traction}"
    numbers += ", the temperature rise and the power loss" if heated.thermal else " and the power loss"
    if heated.rheology == "carreau" and heated.thermal:
        # Heat and Carreau's law keep the stress within the size of measured ones, but not below their limit.
        text = (
            f"{numbers} may be too large: above {above} the shear stress of oils has a limit, which the law "
            "of Carreau does not have; compare with film.rheology 'limiting'"
        )
    else:
        text = (
            f"do not use {numbers}: above {above} the stress of a {heated.rheology.capitalize()} film is "
            "several times too large, as it has no limit; give film.rheology 'eyring' or 'limiting'"
        )
    yield ResultWarning("newtonian-traction", text)


def _thicker_from(oil: HotOil, pressure: float) -> float | None:
    """Temperature [K] from which the laws of an oil make it thicker with temperature; None if nowhere."""
    temperature = np.linspace(oil.lowest, oil.highest, _SAMPLES)
    rises = oil.log_viscosity(np.full(_SAMPLES, pressure), temperature).by_temperature > 0.0
    return float(temperature[np.argmax(rises)]) if rises.any() else None


def _thicker(temperature: float, pressure: float) -> str:
    return (
        f"at {pressure / 1e9:.3g} GPa the laws of the oil make it thicker with temperature above "
        f"{temperature - _CELSIUS:.3g} °C, which no oil does"
    )


def _temperatures(
    case: Case, heated: HeatedFilm, oil: HotOil, max_pressure: float
) -> Iterator[ResultWarning]:
    """Warnings about temperatures at which oil, laws or model are not known."""
    found, known = heated.temperature_range, case.lubricant.temperature_range
    assert found is not None
    reasons = []
    if known is not None and not (known[0] <= found[0] and found[1] <= known[1]):
        reasons.append(
            f"the laws of the oil hold for {_celsius(*known)} (lubricant.temperature_range), and are "
            "extrapolated"
        )
    if not (oil.lowest <= found[0] and found[1] <= oil.highest):
        effect = ", whose effect is part of temperature_rise_error" if found[1] > oil.highest else ""
        reasons.append(
            f"its properties were taken from {_celsius(oil.lowest, oil.highest)}, and go on as straight "
            f"lines{effect}"
        )
    thicker = _thicker_from(oil, max_pressure)
    if thicker is not None and thicker < found[1]:
        reasons.append(_thicker(thicker, max_pressure))
    if reasons:
        text = f"the film has {_celsius(*found)}, but {'; '.join(reasons)}"
        yield ResultWarning("film-temperature-range", text)
    rise = heated.max_temperature_rise or 0.0
    if rise > _LARGE_RISE:
        yield ResultWarning(
            "film-very-hot",
            f"the film is up to {rise:.3g} K hotter at its middle than the oil in the inlet: oil and its "
            "additives do not stand this for long, and its laws are hardly known; check speeds and load",
        )


def _celsius(low: float, high: float) -> str:
    return f"{low - _CELSIUS:.4g} to {high - _CELSIUS:.4g} °C"


def _accuracy(film: Film | PointFilm, heated: HeatedFilm) -> Iterator[ResultWarning]:
    """Warning about a temperature rise that the grid does not resolve."""
    rise, error, lost = heated.max_temperature_rise, heated.temperature_rise_error, heated.energy_imbalance
    if rise is None or rise < _SMALL_RISE:
        return
    if error is not None and error > max(_SMALL_ERROR, _RISE_ERROR * rise):
        text = f"the temperature rise of {rise:.3g} K has an estimated error of {100 * error / rise:.2g} %"
        if _at_spike(film, heated):
            text += (
                ": it is that at the pressure spike, whose height depends on the grid; use more grid.nodes, "
                "or the temperature elsewhere in the film"
            )
        else:
            text += "; use more grid.nodes"
        yield ResultWarning("heat-unresolved", text)
    elif lost is not None and abs(lost) > _IMBALANCE:
        yield ResultWarning(
            "heat-unresolved",
            f"the balance of heat in the film is {100 * abs(lost):.2g} % off; use more grid.nodes",
        )


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
    """Warning about a surface that moves so slowly that its temperature is not that of the model."""
    peclet = speed * conditions.semi_axes[0] / (2.0 * body.diffusivity)
    if peclet < _SLOW[conditions.geometry]:
        along = "sideways" if conditions.geometry == "point" else "without a steady state"
        yield ResultWarning(
            "slow-body",
            f"surface {number} moves at {speed:.3g} m/s, a Peclet number of {peclet:.2g} below "
            f"{_SLOW[conditions.geometry]:g}: heat spreads in it {along}, which is left out, so that its "
            "temperature is an estimate",
        )
