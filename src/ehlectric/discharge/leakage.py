"""Leakage of charge through the oil: relaxation time and corner frequency."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.discharge import Discharge
from ehlectric.discharge.laws import relaxation_time
from ehlectric.field.zones import areas
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.lubricant.oil import Oil


@dataclass(frozen=True)
class Leakage:
    """Leakage of charge through the oil at ambient pressure; None if the conductivity is unknown.

    Attributes
    ----------
    relaxation_time : float or None
        Charge relaxation time eps0 eps_r/sigma [s].
    corner_frequency : float or None
        Frequency above which the film is a capacitor, 1/(2 pi ``relaxation_time``) [Hz].
    """

    relaxation_time: float | None = None
    corner_frequency: float | None = None


def conductivity_of(discharge: Discharge | None, oil: Oil) -> float | None:
    """Electrical conductivity [S/m] of the table ``discharge``, or else of the oil; None without one."""
    given = None if discharge is None else discharge.conductivity
    return oil.conductivity if given is None else given


def leakage(
    discharge: Discharge,
    oil: Oil,
    film: Film | PointFilm | None = None,
    semi_axes: tuple[float, ...] = (),
) -> Leakage:
    """Leakage of charge through an oil at ambient pressure.

    Parameters
    ----------
    discharge : Discharge
        Inputs of the discharge; its conductivity, if it has one, holds at any temperature.
    oil : Oil
        Oil at the temperature of the inlet.
    film : Film or PointFilm, optional
        Film. In a film with heat, the conductivity is the mean over its Hertz zone.
    semi_axes : tuple of float, optional
        Half-width or semi-axes of the Hertz zone of the film [m].

    Returns
    -------
    Leakage
        Relaxation time and corner frequency.
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

    Parameters
    ----------
    film : Film or PointFilm
        Film.
    conductivity : ndarray, shape (nx,) or (nx, ny)
        Electrical conductivity of the oil at the nodes [S/m].
    semi_axes : tuple of float
        Half-width or semi-axes of the Hertz zone [m].

    Returns
    -------
    float
        Int sigma/h dA over Int 1/h dA [S/m]: the oil columns of the zone lie side by side between the walls.
    """
    places = np.meshgrid(*film.axes, indexing="ij")
    zone = sum((at / half) ** 2 for at, half in zip(places, semi_axes, strict=True)) <= 1.0
    weights = np.where(zone, areas(film.axes) / film.thickness, 0.0)
    return float(np.sum(weights * conductivity) / np.sum(weights))
