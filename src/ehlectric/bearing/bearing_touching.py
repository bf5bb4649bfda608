"""Asperity contact in a bearing: load shares, share of time with conduction, and electrical behaviour."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, overload

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers, labels, where
from ehlectric.bearing.film_factor import solved_scales
from ehlectric.bearing.solution import (
    BearingSolution,
    RingState,
    conducts,
    dry_areas,
)
from ehlectric.formulas.asperities import (
    LOWEST_SEPARATION,
    AsperityContact,
    Summits,
    area_while_touching,
    bearing_time_share,
    contact_probability,
    contact_time_share,
    expected_spots,
    greenwood_williamson,
    johnson_end,
    load_shares,
    separation_of_gap,
    summit_deviation,
    summit_separation,
)
from ehlectric.quantities.statement import Statement

# Law of ``LOAD_SHARE`` whose asperity load share is given; the others are its spread. It is one of the two
# that are models of a load share at any lambda: Clarke's is a share of time, Johnson's ends near lambda 2.
DEFAULT_SHARE = "patir_cheng"

# Shares of time up to which a bearing is called capacitive, and from which it is called resistive. Within 1 %
# of either end the time-averaged current or charge equals the value of the one state to 1 %, which is less
# than the error of any film. Such a bearing still discharges at times: 1 % of the time is minutes in a day.
CAPACITIVE, RESISTIVE = 0.01, 0.99


def behaviour_clause(duty: BearingDuty) -> Statement:
    """Clause about a bearing: its electrical behaviour, and how long contacts short it."""
    if duty.insulated:
        return Statement.of("regime-insulated", share=duty.touching_time_share)
    if duty.behaviour == "intermittent" and duty.contact_time_share <= CAPACITIVE:
        # No voltage is computed, so that the bearing is not called capacitive.
        return Statement.of("regime-opening", share=duty.contact_time_share)
    return Statement.of("regime", regime=duty.behaviour, share=duty.contact_time_share)


@dataclass(frozen=True, eq=False)
class RingDuty:
    """Asperities in the contacts of all elements with one ring at one position of the cage."""

    # Central film thickness over composite roughness, dimensionless; infinite without load, shape (..., n).
    central_lambda_ratio: Array
    # asperity_share, asperity_share_low and asperity_share_high: share of the load on asperities by
    # ``DEFAULT_SHARE``, and the least and the largest of all laws, shape (..., n).
    asperity_share: Array
    asperity_share_low: Array
    asperity_share_high: Array
    # Share of time with metallic contact by Clarke's fit over lambda, shape (..., n).
    contact_probability: Array
    # Expected number of simultaneous spots in the Hertz area; None without summits, shape (..., n).
    expected_spots: Array | None
    # Share of time with metallic contact: from the expected spots, or by Clarke's fit without summits,
    # shape (..., n).
    contact_time_share: Array
    # Mean area of the spots together, while there are any [m^2]; None without summits, shape (..., n).
    real_area: Array | None = None


@dataclass(frozen=True, eq=False)
class BearingDuty:
    """Asperities in a whole bearing; numbers of many points have the shape (...)."""

    # Contacts with the inner and the outer ring at each position of the cage.
    rings: tuple[tuple[RingDuty, RingDuty], ...]
    # Share of time in which at least one element touches both rings, mean over the positions.
    touching_time_share: Numbers
    clarke_time_share: Numbers  # contact time share with Clarke's fit for each contact
    insulated: bool  # whether ceramic elements or a coating insulate, so that the bearing never conducts
    model: str  # what the share of time of a contact is from: "clarke" or "greenwood_williamson"
    behaviour: Any  # electrical behaviour of each point in one word, shape (...)

    @property
    def contact_time_share(self) -> Numbers:
        """Share of time in which the bearing conducts from shaft to housing by metallic contact."""
        return 0.0 * self.touching_time_share if self.insulated else self.touching_time_share

    @property
    def real_area(self) -> Numbers | None:
        """Real area of contact of all elements that touch both rings, while any does [m^2].

        Each has the smaller one of its two contacts; mean over time and positions. None without summits, and
        where nothing touches.
        """
        areas: Numbers = 0.0
        for inner, outer in self.rings:
            if inner.real_area is None or outer.real_area is None:
                return None
            weight = inner.contact_time_share * outer.contact_time_share
            areas = areas + np.sum(weight * np.minimum(inner.real_area, outer.real_area), axis=-1)
        return where(areas > 0.0, self._while_touching(areas / len(self.rings)))

    @property
    def closed(self) -> Numbers:
        """Mean number of elements that touch both rings at a time, while any does; 0 where none ever does."""
        shares = [np.sum(a.contact_time_share * b.contact_time_share, axis=-1) for a, b in self.rings]
        return self._while_touching(np.mean(shares, axis=0))

    def _while_touching(self, mean: Numbers) -> Numbers:
        """Mean over the time in which any element touches, from the mean over all time; 0 where none does."""
        share = self.touching_time_share
        return np.where(share > 0.0, mean / np.where(share > 0.0, share, 1.0), 0.0)[()]


def duty_of(
    solution: BearingSolution, *, film_scale: float = 1.0, ring_scales: tuple[float, float] | None = None
) -> BearingDuty:
    """Load shares of asperities, and shares of time with contact, in a solved bearing.

    ``film_scale`` is a factor on all film thicknesses, for films of estimated contacts that are scaled to
    solved films. ``ring_scales`` are further factors on the central films of the contacts with each ring; by
    default the factors by which its most loaded contact has the film that was solved with heat and supply,
    where there is one. Films belong to smooth surfaces, and the roughness belongs to the unloaded surfaces,
    which pressure flattens. An element conducts while both its contacts do, and one element shorts the
    bearing. All contacts are taken as independent.
    """
    inner, outer = solved_scales(solution) if ring_scales is None else ring_scales
    rings = tuple(
        (
            _ring(solution, position.inner, film_scale, inner),
            _ring(solution, position.outer, film_scale, outer),
        )
        for position in solution.positions
    )
    coated = solution.case.bearing.coating is not None
    insulated = solution.conditions.ceramic or coated
    touching = _mean_share([(a.contact_time_share, b.contact_time_share) for a, b in rings])
    share = 0.0 * touching if insulated else touching
    return BearingDuty(
        rings=rings,
        touching_time_share=touching,
        clarke_time_share=_mean_share([(a.contact_probability, b.contact_probability) for a, b in rings]),
        insulated=insulated,
        model="clarke" if solution.case.bearing.summits is None else "greenwood_williamson",
        behaviour=behaviour_of(share, touching=conducts(solution, film_scale=film_scale) & (not coated)),
    )


def behaviour_of(share: Numbers, *, touching: Any = False) -> Any:
    """Return the electrical behaviour of a bearing: "capacitive", "intermittent" or "resistive".

    ``share``, share of time in which the bearing conducts, dimensionless, shape (...); ``touching``, whether
    asperity contact is frequent and no voltage is computed, shape (...).

    Examples
    --------
    >>> behaviour_of(1e-4), behaviour_of(0.3), behaviour_of(0.995), behaviour_of(1e-4, touching=True)
    ('capacitive', 'intermittent', 'resistive', 'intermittent')
    """
    return labels(
        (share > RESISTIVE, "resistive"), (touching | (share > CAPACITIVE), "intermittent"), "capacitive"
    )


def _mean_share(pairs: list[tuple[Array, Array]]) -> Numbers:
    """Share of time in which a bearing conducts, mean over the positions, from the shares of its contacts."""
    inner, outer = (np.array(column) for column in zip(*pairs, strict=True))
    mean: Numbers = np.mean(bearing_time_share(inner, outer), axis=0)
    return mean


def _ring(solution: BearingSolution, ring: RingState, film_scale: float, thickness_factor: float) -> RingDuty:
    """Asperities in the contacts with one ring; elements without load have none.

    ``thickness_factor`` is the factor on the films from which shares and spots follow.
    """
    bearing, loaded = solution.case.bearing, ring.solved
    central = film_scale * ring.values.central_thickness[loaded]
    film = thickness_factor * central
    rq = _of_contacts(bearing.composite_rq, loaded)

    def whole(values: Array, otherwise: float = 0.0) -> Array:
        column = np.full(loaded.shape, otherwise)
        column[loaded] = values
        return column

    ratio = film / rq
    shares, probability = load_shares(ratio), contact_probability(ratio)
    # Johnson's fit ends at a share of 0, and is no lower bound beyond its range.
    beyond = {"johnson": ratio >= johnson_end()}
    low = np.min([np.where(beyond.get(name, False), np.inf, each) for name, each in shares.items()], axis=0)
    spots, real, time_share = None, None, probability
    if bearing.summits is not None:
        area = dry_areas(solution, ring)[loaded]
        touching = _touching(solution, film, loaded)
        number = expected_spots(touching.spots_per_area, area)
        time_share = contact_time_share(number)
        spots, real = whole(number), whole(area_while_touching(touching, area))
    return RingDuty(
        central_lambda_ratio=whole(central / rq, np.inf),
        asperity_share=whole(shares[DEFAULT_SHARE]),
        asperity_share_low=whole(low),
        asperity_share_high=whole(np.max(list(shares.values()), axis=0)),
        contact_probability=whole(probability),
        expected_spots=spots,
        contact_time_share=whole(time_share),
        real_area=real,
    )


@overload
def _of_contacts(values: Numbers, loaded: Mask) -> Numbers: ...


@overload
def _of_contacts(values: Numbers | None, loaded: Mask) -> Numbers | None: ...


def _of_contacts(values: Numbers | None, loaded: Mask) -> Numbers | None:
    """Values of the points for each of their loaded contacts, shape (k,); a float or None stays one."""
    if values is None or np.ndim(values) == 0:
        return values
    return np.broadcast_to(np.asarray(values)[..., np.newaxis], loaded.shape)[loaded]


def _touching(solution: BearingSolution, film: Array, loaded: Mask) -> AsperityContact:
    """Asperities of loaded contacts with a central film [m], after Greenwood and Williamson."""
    bearing = solution.case.bearing
    assert bearing.summits is not None
    given = {name: _of_contacts(value, loaded) for name, value in vars(bearing.summits).items()}
    rq, bandwidth = _of_contacts(bearing.composite_rq, loaded), given["bandwidth"]
    deviation, separation = given["height_deviation"], separation_of_gap(film, rq)
    if bandwidth is not None:
        deviation, separation = (
            summit_deviation(rq, bandwidth),
            summit_separation(separation, rq, bandwidth),
        )
    summits = Summits(
        density=given["density"],
        radius=given["radius"],
        height_deviation=rq if deviation is None else deviation,
        highest=np.inf if given["highest"] is None else given["highest"],
    )
    # Summits of nearly one height all touch from a separation on that is below the range of the integrals.
    level = np.maximum(separation, LOWEST_SEPARATION * summits.height_deviation)
    return greenwood_williamson(level, summits, solution.conditions.modulus)


def duty_summary(solution: BearingSolution, duty: BearingDuty) -> dict[str, Any]:
    """Return electrical behaviour, shares of time and load shares, as in ``bearing`` of summary.json."""
    rq = solution.case.bearing.composite_rq
    values: dict[str, Any] = {
        "electrical_behaviour": duty.behaviour,
        "contact_time_share": duty.contact_time_share,
        "insulating_time_share": 1.0 - duty.touching_time_share,
        "touching_time_share": duty.touching_time_share,
        "clarke_time_share": duty.clarke_time_share,
        "contact_model": duty.model,
    }
    for k, name in enumerate(("inner", "outer")):
        least = [position.rings[k].least_film for position in solution.positions]
        values[f"{name}_lambda_ratio"] = np.min(np.array(least), axis=0) / rq
    for k, name in enumerate(("inner", "outer")):
        values[f"{name}_contact_time_share"] = _largest([rings[k].contact_time_share for rings in duty.rings])
    all_of = [ring for rings in duty.rings for ring in rings]
    for key in ("asperity_share", "asperity_share_low", "asperity_share_high"):
        values[key] = _largest([getattr(ring, key) for ring in all_of])
    spots = [ring.expected_spots for ring in all_of if ring.expected_spots is not None]
    return values | {"expected_spots": _largest(spots) if spots else None, "real_area": duty.real_area}


def _largest(of_contacts: list[Array]) -> Numbers:
    """Largest value of all contacts at all positions of the cage, shape (...)."""
    largest: Numbers = np.max(of_contacts, axis=(0, -1))
    return largest


def contact_duty(ring: RingDuty, k: int) -> dict[str, Any]:
    """Values of the contact of element ``k`` with a ring, for a row of ``contacts``."""
    of_contact = {name: None if values is None else values[k] for name, values in vars(ring).items()}
    del of_contact["real_area"]
    return of_contact
