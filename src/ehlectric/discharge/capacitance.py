"""Capacitance of a contact, by zone and by what fills its outlet, over the whole domain of its film."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array
from ehlectric.cases.discharge import Discharge
from ehlectric.discharge.columns import at_columns
from ehlectric.discharge.contact_size import Size
from ehlectric.discharge.layers import BARE, Layers
from ehlectric.discharge.outlet_filling import OUTLETS, filled_permittivity, oil_fraction
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.field.poisson import ATOM
from ehlectric.field.zones import line_zone_areas, point_zone_areas
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.lubricant.oil import Oil


def zone_capacitances(
    film: Film | PointFilm,
    field: Field | PointField,
    zones: tuple[Mapping[str, Array], Mapping[str, Array]],
    oil: Array,
    layers: Layers = BARE,
) -> dict[str, dict[str, float]]:
    """Capacitance of each zone, for each assumption about the filling of the gap behind the exit.

    Inside the field range the capacitance follows from the solved field, outside from a thin gap,
    eps0 eps/h per area. The thin gap is summed over the whole domain. The difference between the solved field
    and the thin gap is then added inside the field range. Where gas fills a part of the gap, both are scaled
    by ``filled_permittivity``. This agrees to 1e-5 with a field that is solved with the gas in the gap,
    because the walls diverge slowly behind the exit.

    Parameters
    ----------
    film, field : Film and Field, or PointFilm and PointField
        Solution of the contact.
    zones : pair of mapping
        Width [m] or area [m^2] of each node's part of a zone, by the name of the zone: one mapping for the
        film's nodes, and one for the columns of the field.
    oil : ndarray, shape of the film
        Relative permittivity of the oil at the film's nodes.
    layers : Layers
        Coating and roughness that change the capacitance of the film place by place.

    Returns
    -------
    dict of dict
        Capacitance per length [F/m] of a line contact, or capacitance [F] of a point contact, by the filling
        ("full", "fingers", "layers") and by the name of the zone.
    """
    fraction = film.film_fraction
    if fraction is None:
        fraction = oil_fraction(film.thickness, film.density, film.cavitated)
    gap = np.maximum(film.thickness, ATOM)
    by_outlet = {}
    for outlet in OUTLETS:
        permittivity = filled_permittivity(oil, fraction, outlet)
        thin = layers.density(epsilon_0 * permittivity / gap, permittivity)
        # The thin gap at the columns is interpolated from the film's nodes, not computed from the gap of the
        # field. It then cancels the sum over the nodes inside the field range, also if the columns are finer.
        thin_gap = at_columns(film, field, thin)
        solved = field.capacitance_density * at_columns(film, field, permittivity / oil)
        correction = layers.density(solved, at_columns(film, field, permittivity)) - thin_gap
        by_outlet[outlet] = {
            name: float(np.vdot(weights, thin) + np.vdot(zones[1][name], correction))
            for name, weights in zones[0].items()
        }
    return by_outlet


def capacitance_beyond(film: Film | PointFilm, permittivity: float) -> float:
    """Capacitance that a domain twice as large has more, were its gap full of oil.

    Outside of the film's domain the gap grows about as the square of the distance from the middle; close to
    the Hertz zone it grows faster, so that up to 30 % less is added. At s times the distance of an edge it is
    s^2 h, with the gap h at this edge. From s = 1 to 2 that makes eps x/(2 h) for each end of a line contact,
    and eps ln(2) times the integral of dA/h over the edge of a point contact, where dA is the distance of an
    edge from the middle times its length.

    Parameters
    ----------
    film : Film or PointFilm
        Film on its domain.
    permittivity : float
        Relative permittivity of the oil.

    Returns
    -------
    float
        Capacitance per length [F/m] of a line contact, or capacitance [F] of a point contact.
    """
    ends = film.thickness[[0, -1]]
    if isinstance(film, Film):
        around = float(np.sum(0.5 * np.abs(film.x[[0, -1]]) / ends))
    else:
        sides = film.thickness[:, [0, -1]]
        across = np.abs(film.x[[0, -1]]) @ np.trapezoid(1.0 / ends, film.y, axis=1)
        along = np.abs(film.y[[0, -1]]) @ np.trapezoid(1.0 / sides, film.x, axis=0)
        around = float(np.log(2.0) * (across + along))
    return float(epsilon_0 * permittivity * around)


@dataclass(frozen=True)
class Capacitances:
    """Capacitances of a contact: per length [F/m] for a line contact, [F] for a point contact.

    Attributes
    ----------
    capacitance : float
        Capacitance over the whole domain of the film.
    capacitance_beyond : float
        What ``capacitance`` would have more on a domain twice as large, were its gap full of oil.
    capacitance_hertz, capacitance_inlet, capacitance_outlet : float
        Capacitances of the Hertz zone, of the inlet before it, and of the outlet behind it.
    capacitance_sides : float or None
        Capacitance of the sides of a point contact; None for a line contact.
    capacitance_plate : float
        Capacitance of parallel plates over the Hertz zone, eps0 eps_r A/h(0), with eps_r at ambient pressure.
    capacitance_ratio : float
        ``capacitance`` over ``capacitance_plate``, dimensionless.
    capacitance_outlet_full, capacitance_outlet_fingers, capacitance_outlet_layers : float
        Capacitance of the outlet for each filling of the gap behind the exit.
    capacitance_full, capacitance_fingers, capacitance_layers : float
        Capacitance over the whole domain for each filling. In a point contact it affects the sides too.
    outlet : str
        Filling of the outlet on which ``capacitance`` and the energies are based.
    """

    capacitance: float
    capacitance_beyond: float
    capacitance_hertz: float
    capacitance_inlet: float
    capacitance_outlet: float
    capacitance_sides: float | None
    capacitance_plate: float
    capacitance_ratio: float
    capacitance_outlet_full: float
    capacitance_outlet_fingers: float
    capacitance_outlet_layers: float
    capacitance_full: float
    capacitance_fingers: float
    capacitance_layers: float
    outlet: str


def capacitances(
    discharge: Discharge,
    oil: Oil,
    semi_axes: tuple[float, ...],
    film: Film | PointFilm,
    field: Field | PointField,
) -> Capacitances:
    """Capacitances of the zones of a contact, for each filling of the outlet.

    Parameters
    ----------
    discharge : Discharge
        Inputs of the discharge, with the filling of the outlet.
    oil : Oil
        Oil, for its relative permittivity.
    semi_axes : tuple of float
        Half-width of a line contact, or semi-axes of a point contact along and across entrainment [m].
    film, field : Film and Field, or PointFilm and PointField
        Solution of the contact.

    Returns
    -------
    Capacitances
        Capacitances per length [F/m] of a line contact, or [F] of a point contact.
    """
    areas = line_zone_areas if len(semi_axes) == 1 else point_zone_areas
    zones = areas(film.axes, *semi_axes), areas(field.axes, *semi_axes)
    by_outlet = zone_capacitances(film, field, zones, oil.permittivity(film.pressure, film.density))
    chosen = by_outlet[discharge.outlet]
    total = {name: sum(parts.values()) for name, parts in by_outlet.items()}
    hertz = Size.of(semi_axes, discharge).hertz
    plate = epsilon_0 * oil.relative_permittivity * hertz / film.central_thickness
    return Capacitances(
        capacitance=total[discharge.outlet],
        capacitance_beyond=capacitance_beyond(film, oil.relative_permittivity),
        capacitance_hertz=chosen["hertz"],
        capacitance_inlet=chosen["inlet"],
        capacitance_outlet=chosen["outlet"],
        capacitance_sides=chosen.get("sides"),
        capacitance_plate=plate,
        capacitance_ratio=total[discharge.outlet] / plate,
        capacitance_outlet_full=by_outlet["full"]["outlet"],
        capacitance_outlet_fingers=by_outlet["fingers"]["outlet"],
        capacitance_outlet_layers=by_outlet["layers"]["outlet"],
        capacitance_full=total["full"],
        capacitance_fingers=total["fingers"],
        capacitance_layers=total["layers"],
        outlet=discharge.outlet,
    )
