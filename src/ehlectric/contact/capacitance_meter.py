"""Capacitance that a meter reads between the two bodies of a contact, with its parts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.cases.contact_inputs import Contact
from ehlectric.cases.meter_inputs import Meter, body_radii
from ehlectric.constants import EPSILON_0
from ehlectric.contact.conditions import Conditions, PointConditions
from ehlectric.discharge.film_capacitance import LEAST_RATIO, Layers, zone_capacitances
from ehlectric.discharge.outer_gap import Bodies, Body, Outside, around_line, around_point
from ehlectric.field import ATOM, Field, PointField, areas_by_zone
from ehlectric.film import Film, PointFilm
from ehlectric.formulas.hertz import dry_contact
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable

Ring = tuple[float, float]
_EVERYWHERE: Ring = (0.0, np.inf)


def body_text(contact: Contact) -> str:
    """Words for the two bodies that face each other outside the film.

    Examples
    --------
    >>> given = {"reduced_radius": "10 mm", "reduced_modulus": "226 GPa", "load_per_length": 1e5}
    >>> body_text(Contact.from_dict(given | {"entrainment_speed": 1.0}))
    'cylinder of 10 mm on a plane'
    """
    smaller_first = sorted(body_radii(contact), key=lambda radii: -1.0 / radii[0])
    return " on a ".join(_words(*radii) for radii in smaller_first)


def _words(along: float, across: float) -> str:
    """Words for a body with these radii [m]."""
    if np.isinf(along) and np.isinf(across):
        return "plane"
    if np.isinf(across):
        return f"{'hollow ' if along < 0.0 else ''}cylinder of {readable(abs(along) * 1e3, 4)} mm"
    if along == across > 0.0:
        return f"ball of {readable(along * 1e3, 4)} mm"
    return (
        f"body of {readable(along * 1e3, 4)} mm along and {readable(across * 1e3, 4)} mm across entrainment"
    )


@dataclass(frozen=True)
class MeterProfile:
    """Capacitance between the bodies up to a distance from the contact, without what lies in parallel."""

    radius: Array  # distance from the middle of the contact, increasing [m], shape (n,)
    # filled, air and oil: capacitance up to this distance, with the gap outside the domain filled as the case
    # says, with air, and with oil [F], shape (n,).
    filled: Array
    air: Array
    oil: Array
    edge: float  # smallest distance of the edge of the film's domain from the contact [m]


def meter_profile(contact: Metered, distances: int = 80) -> MeterProfile:
    """Capacitance between the bodies of a solved contact up to a number of distances from it.

    The last distance encloses the whole gap.
    """
    coating = contact.layers.coating
    near, within = contact.nodes()
    outside = {
        "filled": contact.filled(coating),
        "air": contact.outside(1.0, coating),
        "oil": contact.outside(contact.oil_permittivity, coating),
    }
    edges = [abs(float(end)) for axis in contact.film.axes for end in (axis[0], axis[-1])]
    farthest = max(float(np.max(at)) for at, _ in ((near, within), *outside.values()))
    radius = np.geomspace(0.05 * min(contact.conditions.semi_axes), farthest, distances)
    inner = _up_to(radius, near, within)
    return MeterProfile(
        radius=radius,
        **{name: inner + _up_to(radius, at, values) for name, (at, values) in outside.items()},
        edge=min(edges),
    )


def _up_to(radius: Array, at: Array, values: Array) -> Array:
    """Sum of the values at distances up to each radius; at the distance of a node half of its value."""
    order = np.argsort(at)
    sums = np.cumsum(values[order])
    total: Array = np.interp(radius, at[order], sums - 0.5 * values[order], left=0.0)
    return np.where(radius >= at[order][-1], sums[-1], total)


@dataclass(frozen=True, kw_only=True)
class MeterReading:
    """Capacitance that a meter reads at the two bodies of a contact, and its parts, SI units.

    A value is None if the case lacks the input that it needs. The capacitances of the film's domain, of the
    gap outside and in parallel add up to ``capacitance``; a coating is in each of the first two.
    """

    capacitance: float  # capacitance that the meter reads [F]
    # capacitance_air and capacitance_oil: the same where air or oil fills the whole gap outside the film's
    # domain [F].
    capacitance_air: float
    capacitance_oil: float
    # capacitance_domain and capacitance_hertz: capacitance of the film's domain, and of the Hertz zone in it
    # [F].
    capacitance_domain: float
    capacitance_hertz: float
    # Capacitance between the bodies outside the domain, filled as the case says [F].
    capacitance_outside: float
    # capacitance_outside_air and capacitance_outside_oil: capacitance outside the domain in air and in oil
    # [F].
    capacitance_outside_air: float
    capacitance_outside_oil: float
    parallel_capacitance: float | None  # [F]
    # share_of_hertz, share_of_domain and share_of_outside: parts of the reading that are due to the Hertz
    # zone, the domain and the gap outside, dimensionless.
    share_of_hertz: float
    share_of_domain: float
    share_of_outside: float
    roughness_factor: float | None  # capacitance of the domain / with smooth surfaces, dimensionless
    film_ratio: float | None  # minimum film thickness over Rq, dimensionless
    capacitance_uncoated: float | None = None  # capacitance between the bodies without the coating [F]
    # Single capacitor in series with ``capacitance_uncoated`` that has the effect of the coating [F].
    coating_capacitance: float | None = None
    # coating_voltage_share and film_voltage_share: parts of the voltage on the coating and on the film at the
    # minimum film, dimensionless.
    coating_voltage_share: float | None = None
    film_voltage_share: float | None = None
    # Voltage between the bodies at which the film breaks down under its share [V].
    film_breakdown_voltage: float | None
    coating_breakdown_voltage: float | None = None  # voltage at which only the coating breaks down [V]
    breakdown_voltage: float | None  # voltage between the bodies at which both have broken down [V]
    length: float | None  # length of a line contact, or given width of a point contact [m]
    bodies: str  # words for the bodies that face each other outside the domain
    mismatch: float  # largest relative difference between film and outer gap at the edge of the domain

    def summary(self) -> dict[str, Any]:
        """All values, as in ``meter`` of summary.json."""
        return asdict(self)


@dataclass(frozen=True)
class Metered:
    """Solved contact of a case with a table ``meter``."""

    case: Case
    conditions: Conditions | PointConditions
    film: Film | PointFilm
    field: Field | PointField

    @property
    def meter(self) -> Meter:
        """Table ``meter`` of the case."""
        assert self.case.meter is not None
        return self.case.meter

    @property
    def length(self) -> float | None:
        """Length across entrainment, of the meter or of the discharge [m]."""
        discharge = self.case.discharge
        return self.meter.length or (None if discharge is None else discharge.length)

    @property
    def layers(self) -> Layers:
        """Coating and roughness of the meter's table."""
        coating = self.meter.coating
        return Layers(0.0 if coating is None else coating.thickness_in_vacuum, self.meter.rq or 0.0)

    def zones(self, part: Film | PointFilm | Field | PointField) -> dict[str, Array]:
        """Width [m] or area [m^2] of each zone at the nodes of the film, or at the columns of the field."""
        return areas_by_zone(part.axes, self.conditions.semi_axes)

    def domain(self, layers: Layers) -> dict[str, float]:
        """Capacitance of each zone of the film's domain [F]."""
        film, field, zones = self.film, self.field, (self.zones(self.film), self.zones(self.field))
        oil = self.case.oil.permittivity(film.pressure, film.density)
        discharge = self.case.discharge
        outlet = "full" if discharge is None else discharge.outlet
        by_zone = zone_capacitances(film, field, zones, oil, layers)[outlet]
        across = self.length if isinstance(film, Film) else 1.0
        assert across is not None
        return {name: across * value for name, value in by_zone.items()}

    def nodes(self) -> tuple[Array, Array]:
        """Distance from the contact [m] and capacitance [F] of the film's nodes, as of a thin gap."""
        film = self.film
        oil = self.case.oil.permittivity(film.pressure, film.density)
        thin = self.layers.density(EPSILON_0 * oil / np.maximum(film.thickness, ATOM), oil)
        thin = thin * sum(self.zones(film).values())
        at = np.sqrt(sum(axis**2 for axis in np.meshgrid(*film.axes, indexing="ij")))
        # The solved field, and gas in the outlet, change the sum by little; the places keep their shares.
        return at.ravel(), thin.ravel() * (sum(self.domain(self.layers).values()) / float(np.sum(thin)))

    def gap(self, ring: Ring = _EVERYWHERE) -> tuple[Outside, float]:
        """Gap between the bodies outside the domain of the film, and its mismatch with the film.

        If the case gives reduced radii only, a body with these radii lies on a plane. ``ring`` is the
        smallest and the largest distance from the contact [m]. The mismatch is the largest relative
        difference between gap and film at the edge of the domain, zero for a line contact.
        """
        conditions, film = self.conditions, self.film
        bodies = Bodies.of(
            *(Body(1.0 / along, 1.0 / across) for along, across in body_radii(self.case.contact))
        )
        if isinstance(film, PointFilm):
            assert isinstance(conditions, PointConditions)
            radii, modulus = (conditions.radius_x, conditions.radius_y), conditions.reduced_modulus
            dry = dry_contact(conditions.load, *radii, modulus)
            nodes: tuple[Array, Array, Array] = (film.x, film.y, film.thickness)
            return around_point(bodies, dry, modulus, nodes, width=self.meter.length, ring=ring)
        assert isinstance(conditions, Conditions) and self.length is not None
        ends, size = (film.x, film.thickness), (conditions.half_width, conditions.reduced_radius)
        return around_line(bodies, *size, ends, length=self.length, ring=ring), 0.0

    def outside(self, permittivity: float, coating: float, ring: Ring = _EVERYWHERE) -> tuple[Array, Array]:
        """Distance from the contact [m] and capacitance [F] of nodes outside the domain, in one medium."""
        gap, _ = self.gap(ring)
        return gap.radius, gap.capacitances(permittivity, coating)

    @property
    def oil_permittivity(self) -> float:
        """Relative permittivity of the oil at ambient pressure."""
        return float(self.case.oil.relative_permittivity)

    def filled(self, coating: float) -> tuple[Array, Array]:
        """Distance [m] and capacitance [F] of nodes outside the domain, filled as the case says."""
        oil, fill, radius = self.oil_permittivity, self.meter.fill, self.meter.oil_radius
        if radius is not None:
            parts = (
                self.outside(oil, coating, (0.0, radius)),
                self.outside(1.0, coating, (radius, np.inf)),
            )
            return np.concatenate([part[0] for part in parts]), np.concatenate([part[1] for part in parts])
        assert fill is not None
        at, wet = self.outside(oil, coating)
        return at, fill * wet + (1.0 - fill) * self.outside(1.0, coating)[1]

    def parts(self, layers: Layers) -> dict[str, float]:
        """Capacitances of domain, Hertz zone and outer gap with the given coating and roughness [F]."""
        zones, oil = self.domain(layers), self.oil_permittivity
        return {
            "capacitance_domain": sum(zones.values()),
            "capacitance_hertz": zones["hertz"],
            "capacitance_outside": float(np.sum(self.filled(layers.coating)[1])),
            "capacitance_outside_air": float(np.sum(self.outside(1.0, layers.coating)[1])),
            "capacitance_outside_oil": float(np.sum(self.outside(oil, layers.coating)[1])),
        }

    @property
    def film_share(self) -> float:
        """Part of the voltage that lies on the film where it is thinnest, dimensionless."""
        film = self.film
        permittivity = self.case.oil.permittivity(film.pressure, film.density)
        thinnest = np.argmin(film.thickness)
        return float(self.layers.film_share(EPSILON_0 * permittivity.flat[thinnest] / film.minimum_thickness))


def meter_reading(contact: Metered, film_breakdown: float | None) -> MeterReading:
    """Capacitance that a meter reads between the bodies of a contact, with its parts and breakdown voltages.

    ``film_breakdown`` is the breakdown voltage of only the film [V], None if it is not known.
    """
    meter, layers = contact.meter, contact.layers
    parts: dict[str, Any] = contact.parts(layers)
    parallel, domain = meter.parallel_capacitance or 0.0, parts["capacitance_domain"]
    whole = domain + parts["capacitance_outside"] + parallel
    smooth = sum(contact.domain(Layers(coating=layers.coating)).values())
    _, mismatch = contact.gap()
    return MeterReading(
        capacitance=whole,
        capacitance_air=domain + parts["capacitance_outside_air"] + parallel,
        capacitance_oil=domain + parts["capacitance_outside_oil"] + parallel,
        **parts,
        parallel_capacitance=meter.parallel_capacitance,
        share_of_hertz=parts["capacitance_hertz"] / whole,
        share_of_domain=domain / whole,
        share_of_outside=parts["capacitance_outside"] / whole,
        roughness_factor=None if meter.rq is None else domain / smooth,
        film_ratio=contact.film.minimum_thickness / meter.rq if meter.rq else None,
        **_coating(contact, domain + parts["capacitance_outside"], film_breakdown),
        length=contact.length,
        bodies=body_text(contact.case.contact),
        mismatch=mismatch,
    )


def _coating(contact: Metered, coated: float, film_breakdown: float | None) -> dict[str, Any]:
    """Breakdown voltages, and the values of a coating, if there is one.

    ``coated`` is the capacitance between the bodies with their coating [F].
    """
    coating = contact.meter.coating
    if coating is None:
        return {"film_breakdown_voltage": film_breakdown, "breakdown_voltage": film_breakdown}
    bare = contact.parts(Layers(rq=contact.layers.rq))
    uncoated = bare["capacitance_domain"] + bare["capacitance_outside"]
    share = contact.film_share
    breakdown = None if coating.strength is None else coating.strength * coating.thickness
    film = None if film_breakdown is None else film_breakdown / share
    both = None
    if breakdown is not None and film is not None and film_breakdown is not None:
        # Either part breaks down first, and the whole voltage then lies on the other one.
        both = min(max(film, breakdown), max(breakdown / (1.0 - share), film_breakdown))
    return {
        "capacitance_uncoated": uncoated,
        "coating_capacitance": 1.0 / (1.0 / coated - 1.0 / uncoated),
        "coating_voltage_share": 1.0 - share,
        "film_voltage_share": share,
        "film_breakdown_voltage": film,
        "coating_breakdown_voltage": breakdown,
        "breakdown_voltage": both,
    }


def meter_warnings(case: Any, film: Film | PointFilm) -> Iterator[ResultWarning]:
    """Warnings of a film too thin for a roughness factor, and of a coating that the field does not have."""
    meter = case.meter if isinstance(case, Case) else None
    if meter is None or not film.converged:
        return
    if meter.coating is not None:
        yield ResultWarning.of("coating-in-series")
    elif meter.rq and (ratio := film.minimum_thickness / meter.rq) < LEAST_RATIO:
        yield ResultWarning.of("roughness-factor-rough", ratio=ratio, least=LEAST_RATIO)
