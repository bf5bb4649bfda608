"""Capacitance of a contact by zone and by the filling of its outlet, with coating and roughness.

Roughness raises the capacitance of a film by a factor, the mean of 1/gap times the film thickness. The
combined heights z of both surfaces have a Gaussian distribution with the root-mean-square height Rq. The gap
at a place is g = h + z, where h is the mean film thickness. The capacitance of a thin film is the mean of
eps/g. It is larger than eps/h, because a thin place adds more than a thick place takes away.

A place with a gap below a small ``touching`` gap belongs to an asperity in contact. It is a conductor, not a
capacitor, and is skipped. Without this limit the mean would be infinite, because the distribution has places
with any small gap.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Mask
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.constants import EPSILON_0
from ehlectric.discharge.discharge_laws import Size
from ehlectric.errors import InputError, shown
from ehlectric.field import ATOM, areas_by_zone
from ehlectric.formulas.gaussian import dawson
from ehlectric.formulas.polynomials import on_nodes
from ehlectric.lubricant.oil import Oil

if TYPE_CHECKING:
    from ehlectric.field import Field, PointField
    from ehlectric.film import Film, PointFilm


def at_columns(film: Film | PointFilm, field: Field | PointField, values: Array) -> Array:
    """Interpolate values linearly from the nodes of a film to the columns of its field."""
    # A column at the edge of the domain may be outside it because of rounding.
    columns = (np.clip(at, axis[0], axis[-1]) for at, axis in zip(field.axes, film.axes, strict=True))
    return on_nodes(values, film.axes, tuple(columns))


def oil_fraction(thickness: Array, density: Array, cavitated: Mask) -> Array:
    """Fraction of the gap that is filled with oil behind the exit of the film: (rho H)_exit/(rho H).

    Behind the exit no pressure gradient drives the oil. The oil that leaves the full film is carried on by
    surfaces that diverge. A rough film may cavitate and reform several times. The oil mass rho H that flows
    on is then at most the smallest oil mass at the exits upstream.

    ``thickness`` and ``density``, film thickness and density, in any unit; the first axis runs along
    entrainment, shape (nx,) or (nx, ny). Returns oil fraction from 0 to 1, dimensionless.

    Examples
    --------
    >>> h = np.array([4.0, 1.0, 1.0, 2.0, 4.0])
    >>> oil_fraction(h, np.ones(5), np.array([True, False, True, True, True])).tolist()
    [1.0, 1.0, 1.0, 0.5, 0.25]
    """
    mass = thickness * density
    exits = np.zeros_like(cavitated)
    exits[1:] = cavitated[1:] & ~cavitated[:-1]
    carried = np.minimum.accumulate(np.where(exits, mass, np.inf), axis=0)
    return np.divide(carried, mass, out=np.ones_like(mass), where=cavitated & (mass > carried))


# Functions of the oil's relative permittivity and the oil fraction that give the relative permittivity of the
# gap, by the name of the filling: only oil; fingers of oil from wall to wall with gas between
# them, in parallel; layers of oil on the walls with gas between them, in series.
OUTLETS: dict[str, Callable[[Array, Array], Array]] = {
    "full": lambda permittivity, _fraction: permittivity,
    "fingers": lambda permittivity, fraction: fraction * permittivity + (1.0 - fraction),
    "layers": lambda permittivity, fraction: 1.0 / (fraction / permittivity + (1.0 - fraction)),
}


@dataclass(frozen=True)
class Layers:
    """Coating in series with a film, and roughness of the surfaces of a smooth solved film.

    The coating is in series place by place: the gap h/eps becomes h/eps + t/eps_c. This neglects the field
    along the coating, which spreads the voltage where the film changes over a length below t.

    Examples
    --------
    A film of 0.5 um with a relative permittivity of 2.5, and a coating of 1.6 um with one of 8, share the
    voltage equally:

    >>> film = EPSILON_0 * 2.5 / 0.5e-6
    >>> round(float(Layers(coating=1.6e-6 / 8.0).density(film, 2.5) / film), 12)
    0.5
    """

    coating: float = 0.0  # thickness of the coating over its relative permittivity, t/eps_c [m]
    rq: float = 0.0  # combined root-mean-square height of both surfaces in the loaded contact [m]

    def density(self, film: ArrayLike, relative_permittivity: ArrayLike) -> Array:
        """Capacitance per area of film, coating and roughness together. ``film``, capacitance per area of the
        smooth film without coating [F/m^2], positive, shape (...); ``relative_permittivity``, relative
        permittivity in the film, dimensionless, shape (...). Returns capacitance per area [F/m^2], shape
        (...).
        """
        alone = np.asarray(film, dtype=float)
        permittivity = np.asarray(relative_permittivity, dtype=float)
        if self.coating > 0.0:
            alone = alone / (1.0 + alone * self.coating / EPSILON_0)
        if self.rq > 0.0:
            alone = alone * roughness_factor(EPSILON_0 * permittivity / alone / self.rq)
        return alone

    def film_share(self, film: ArrayLike) -> Array:
        """Share of the voltage that lies on the film, from only its capacitance per area [F/m^2]. ``film``,
        capacitance per area of the film without coating [F/m^2], shape (...). Returns share from 0 to 1,
        dimensionless; the rest lies on the coating, shape (...).
        """
        share: Array = 1.0 / (1.0 + np.asarray(film, dtype=float) * self.coating / EPSILON_0)
        return share


# Surfaces without a coating, whose roughness is in the film or is neglected.
BARE = Layers()


# Gap over Rq below which two surfaces are taken to touch. No source has this number: it is an assumption.
TOUCHING = 0.05

# Film thickness over Rq below which the factor depends on TOUCHING by about 0.12 for a factor of e.
LEAST_RATIO = 2.0

# Film thickness over Rq above which the touching places do not change the factor in double precision.
_FAR = 9.0

# Heights that count, in Rq, and quadrature nodes in the logarithm of the gap: accurate to 1e-10.
_HEIGHTS, _NODES = 9.0, 100


def roughness_factor(film_ratio: ArrayLike, *, touching: float = TOUCHING) -> Array:
    """Capacitance of a rough film divided by the capacitance of a smooth film of this mean thickness.

    ``film_ratio``, mean film thickness h over the combined root-mean-square height Rq of both surfaces,
    dimensionless, positive, shape (...); ``touching``, gap over Rq below which the surfaces touch,
    dimensionless, above 0 and below 1. Returns factor, dimensionless, shape (...); it is 1 + (Rq/h)^2 for a
    film that is thick compared to the roughness. Raises InputError where a ratio is not positive, or
    ``touching`` is out of range.

    The factor is the integral of (h/g) phi((g - h)/Rq)/Rq dg over all gaps g above ``touching`` Rq, with the
    standard normal density phi. Above h/Rq = 9 it is sqrt(2) (h/Rq) D(h/(sqrt(2) Rq)), the principal value
    of the integral over all gaps, with Dawson's integral D.

    The derivative of the factor by ln(touching) is -(h/Rq) phi(h/Rq): -0.01 at h/Rq = 3, -0.11 at 2 and -0.24
    at 1. Below ``LEAST_RATIO`` the factor is therefore an order of magnitude only. The heights are those in
    the loaded contact. A film under high pressure flattens long waves of the roughness, so the factor with
    the Rq of unloaded surfaces is an upper estimate.

    Examples
    --------
    A film of five times Rq, and the limit for thick films:

    >>> round(float(roughness_factor(5.0)), 4), 1.0 + 1.0 / 5.0**2
    (1.0462, 1.04)
    """
    ratio = np.asarray(film_ratio, dtype=float)
    if not np.all(ratio > 0.0):
        raise InputError("film_ratio", got=shown(film_ratio), takes="ratios h/Rq above 0")
    if not 0.0 < touching < 1.0:
        raise InputError("touching", got=shown(touching), takes="a gap over Rq above 0 and below 1")
    factor, near = np.empty(ratio.shape), ratio < _FAR
    # Dawson's integral at an infinite argument times that argument is not defined; its limit is reached here.
    far = np.minimum(ratio[~near], 1e8) / np.sqrt(2.0)
    factor[~near] = 2.0 * far * dawson(far)
    factor[near] = _thin_film_factor(ratio[near], touching)
    return factor


def _thin_film_factor(ratio: Array, touching: float) -> Array:
    """Factor of films with h/Rq up to ``_FAR`` by quadrature over the logarithm of the gap, shape (n,)."""
    first, last = np.log(touching), np.log(ratio + _HEIGHTS)
    thin = np.zeros_like(ratio)
    # One node after another, so that maps of a film need no memory for all nodes at once.
    for node, weight in zip(*_gauss(), strict=True):
        gap = np.exp(first + 0.5 * (last - first) * (node + 1.0))
        thin += weight * np.exp(-0.5 * (gap - ratio) ** 2)
    factor: Array = thin * ratio * 0.5 * (last - first) / np.sqrt(2.0 * np.pi)
    return factor


@cache
def _gauss() -> tuple[Array, Array]:
    """Nodes and weights of Gauss-Legendre quadrature on the interval from -1 to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    return nodes, weights


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
    and the thin gap is then added inside the field range. If gas fills a part of the gap, both are scaled
    by ``OUTLETS``. This agrees to 1e-5 with a field that is solved with the gas in the gap,
    because the walls diverge slowly behind the exit.

    ``zones``, width [m] or area [m^2] of each node's part of a zone, by the name of the zone: one mapping for
    the film's nodes, and one for the columns of the field. Returns capacitance per length [F/m] of a line
    contact, or capacitance [F] of a point contact, by the filling ("full", "fingers", "layers") and by the
    name of the zone.
    """
    fraction = film.film_fraction
    if fraction is None:
        fraction = oil_fraction(film.thickness, film.density, film.cavitated)
    gap = np.maximum(film.thickness, ATOM)
    by_outlet = {}
    for outlet, filled in OUTLETS.items():
        permittivity = filled(oil, fraction)
        thin = layers.density(EPSILON_0 * permittivity / gap, permittivity)
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

    Returns capacitance per length [F/m] of a line contact, or capacitance [F] of a point contact.
    """
    from ehlectric.film import Film  # late: bearings of the atlas do not need it

    ends = film.thickness[[0, -1]]
    if isinstance(film, Film):
        around = float(np.sum(0.5 * np.abs(film.x[[0, -1]]) / ends))
    else:
        sides = film.thickness[:, [0, -1]]
        across = np.abs(film.x[[0, -1]]) @ np.trapezoid(1.0 / ends, film.y, axis=1)
        along = np.abs(film.y[[0, -1]]) @ np.trapezoid(1.0 / sides, film.x, axis=0)
        around = float(np.log(2.0) * (across + along))
    return float(EPSILON_0 * permittivity * around)


@dataclass(frozen=True)
class Capacitances:
    """Capacitances of a contact: per length [F/m] for a line contact, [F] for a point contact."""

    capacitance: float  # capacitance over the whole domain of the film
    # What ``capacitance`` would have more on a domain twice as large, were its gap full of oil.
    capacitance_beyond: float
    # capacitance_hertz, capacitance_inlet and capacitance_outlet: capacitances of the Hertz zone, of the
    # inlet before it, and of the outlet behind it.
    capacitance_hertz: float
    capacitance_inlet: float
    capacitance_outlet: float
    capacitance_sides: float | None  # capacitance of the sides of a point contact; None for a line contact
    # Capacitance of parallel plates over the Hertz zone, eps0 eps_r A/h(0), with eps_r at ambient pressure.
    capacitance_plate: float
    capacitance_ratio: float  # ``capacitance`` over ``capacitance_plate``, dimensionless
    # capacitance_outlet_full, capacitance_outlet_fingers and capacitance_outlet_layers: capacitance of the
    # outlet for each filling of the gap behind the exit.
    capacitance_outlet_full: float
    capacitance_outlet_fingers: float
    capacitance_outlet_layers: float
    # capacitance_full, capacitance_fingers and capacitance_layers: capacitance over the whole domain for each
    # filling. In a point contact it also affects the sides.
    capacitance_full: float
    capacitance_fingers: float
    capacitance_layers: float
    outlet: str  # filling of the outlet on which ``capacitance`` and the energies are based


def capacitances(
    discharge: Discharge,
    oil: Oil,
    semi_axes: tuple[float, ...],
    film: Film | PointFilm,
    field: Field | PointField,
) -> Capacitances:
    """Capacitances of the zones of a contact, for each filling of the outlet.

    ``semi_axes`` are the half-width of a line contact, or the semi-axes of a point contact along and across
    entrainment [m].
    """
    zones = areas_by_zone(film.axes, semi_axes), areas_by_zone(field.axes, semi_axes)
    by_outlet = zone_capacitances(film, field, zones, oil.permittivity(film.pressure, film.density))
    zones_of: dict[str, Any] = {f"capacitance_{name}": at for name, at in by_outlet[discharge.outlet].items()}
    of_outlet = {f"capacitance_outlet_{name}": parts["outlet"] for name, parts in by_outlet.items()}
    total = {name: sum(parts.values()) for name, parts in by_outlet.items()}
    hertz = Size.of(semi_axes, discharge).hertz
    plate = EPSILON_0 * oil.relative_permittivity * hertz / film.central_thickness
    return Capacitances(
        capacitance=total[discharge.outlet],
        capacitance_beyond=capacitance_beyond(film, float(oil.relative_permittivity)),
        **{"capacitance_sides": None} | zones_of,
        capacitance_plate=float(plate),
        capacitance_ratio=float(total[discharge.outlet] / plate),
        **of_outlet,
        **{f"capacitance_{name}": whole for name, whole in total.items()},
        outlet=discharge.outlet,
    )
