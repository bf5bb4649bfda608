"""Share of time in which asperities touch: in the contacts of a bearing, and in the whole bearing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.solution import BearingSolution, RingState, lubrication
from ehlectric.cases.bearings.bearing import ROLLERS
from ehlectric.formulas.asperities.integrals import LOWEST_SEPARATION, separation_of_gap
from ehlectric.formulas.asperities.intermittency import (
    area_while_touching,
    bearing_time_share,
    contact_time_share,
    expected_spots,
)
from ehlectric.formulas.asperities.shares import LOAD_SHARE, contact_probability, johnson_end, load_shares
from ehlectric.formulas.asperities.spectrum import SpectralMoments
from ehlectric.formulas.asperities.statistical import (
    AsperityContact,
    Summits,
    greenwood_williamson,
    summit_separation,
)

# Law of ``LOAD_SHARE`` whose asperity load share is given; the others are its spread. It is one of the two
# that are models of a load share at any lambda: Clarke's is a share of time, Johnson's ends near lambda 2.
DEFAULT_SHARE = "patir_cheng"

# Shares of time up to which a bearing is called capacitive, and from which it is called resistive. Within 1 %
# of either end the time-averaged current or charge is that of the one state to 1 %, which is less than the
# error of any film. Such a bearing still discharges at times: 1 % of the time is minutes in a day.
CAPACITIVE, RESISTIVE = 0.01, 0.99

# What the share of time of a contact is from, without and with ``[bearing.summits]``.
_MODELS = {False: "clarke", True: "greenwood_williamson"}


@dataclass(frozen=True, eq=False)
class RingDuty:
    """Asperities in the contacts of all elements with one ring at one position of the cage.

    Attributes
    ----------
    central_lambda_ratio : ndarray, shape (n,)
        Central film thickness over composite roughness, dimensionless; infinite without load.
    asperity_share, asperity_share_low, asperity_share_high : ndarray, shape (n,)
        Share of the load on asperities by ``DEFAULT_SHARE``, and the least and the largest of all laws.
    contact_probability : ndarray, shape (n,)
        Share of time with metallic contact by Clarke's fit over lambda.
    expected_spots : ndarray, shape (n,), or None
        Expected number of simultaneous spots in the Hertz area; None without summits.
    contact_time_share : ndarray, shape (n,)
        Share of time with metallic contact: from the expected spots, or by Clarke's fit without summits.
    real_area : ndarray, shape (n,), or None
        Mean area of the spots together, while there are any [m^2]; None without summits.
    """

    central_lambda_ratio: Array
    asperity_share: Array
    asperity_share_low: Array
    asperity_share_high: Array
    contact_probability: Array
    expected_spots: Array | None
    contact_time_share: Array
    real_area: Array | None = None


@dataclass(frozen=True, eq=False)
class BearingDuty:
    """Asperities in a whole bearing.

    Attributes
    ----------
    rings : tuple of (RingDuty, RingDuty)
        Contacts with the inner and the outer ring at each position of the cage.
    touching_time_share : float
        Share of time in which at least one element touches both rings, mean over the positions.
    clarke_time_share : float
        The same with Clarke's fit for each contact.
    insulated : bool
        Whether ceramic elements or a coating insulate, so that the bearing never conducts.
    model : str
        What the share of time of a contact is from: "clarke" or "greenwood_williamson".
    regime : str
        Regime in one word, as ``regime_of`` gives it.
    """

    rings: tuple[tuple[RingDuty, RingDuty], ...]
    touching_time_share: float
    clarke_time_share: float
    insulated: bool
    model: str
    regime: str

    @property
    def contact_time_share(self) -> float:
        """Share of time in which the bearing conducts from shaft to housing by metallic contact."""
        return 0.0 if self.insulated else self.touching_time_share

    @property
    def real_area(self) -> float | None:
        """Real area of contact of all elements that touch both rings, while any does [m^2].

        Each has the smaller one of its two contacts; mean over time and positions. None without summits, and
        where nothing touches.
        """
        areas = 0.0
        for inner, outer in self.rings:
            if inner.real_area is None or outer.real_area is None:
                return None
            weight = inner.contact_time_share * outer.contact_time_share
            areas += float(np.sum(weight * np.minimum(inner.real_area, outer.real_area)))
        return areas / len(self.rings) / self.touching_time_share if areas else None

    @property
    def closed(self) -> float:
        """Mean number of elements that touch both rings at a time, while any does; 0 where none ever does."""
        number = np.mean([np.sum(a.contact_time_share * b.contact_time_share) for a, b in self.rings])
        return float(number) / self.touching_time_share if self.touching_time_share else 0.0


def duty_of(solution: BearingSolution, *, film_scale: float = 1.0) -> BearingDuty:
    """Load shares of asperities and shares of time with contact in a solved bearing.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.
    film_scale : float
        Factor on all film thicknesses, dimensionless; for films of a quick way, scaled to solved ones.

    Returns
    -------
    BearingDuty
        Contacts at each position of the cage, and the whole bearing.

    Notes
    -----
    Films are those of smooth surfaces, and the roughness is that of the unloaded surfaces, which pressure
    flattens. An element conducts while both its contacts do, and one element shorts the bearing
    (``asperities.intermittency``). All contacts are taken as independent.
    """
    rings = tuple(
        (_ring(solution, position.inner, film_scale), _ring(solution, position.outer, film_scale))
        for position in solution.positions
    )
    coated = solution.case.bearing.coating is not None
    insulated = solution.conditions.ceramic or coated
    touching = _mean_share([(a.contact_time_share, b.contact_time_share) for a, b in rings])
    state = lubrication(solution, film_scale=film_scale)
    share = 0.0 if insulated else touching
    return BearingDuty(
        rings=rings,
        touching_time_share=touching,
        clarke_time_share=_mean_share([(a.contact_probability, b.contact_probability) for a, b in rings]),
        insulated=insulated,
        model=_MODELS[solution.case.bearing.summits is not None],
        regime=regime_of(share, touching=state == "conducting" and not coated),
    )


def regime_of(share: float, *, touching: bool = False) -> str:
    """Regime of a bearing in one word: "capacitive", "intermittent" or "resistive".

    Parameters
    ----------
    share : float
        Share of time in which the bearing conducts, dimensionless.
    touching : bool
        Whether its least lambda ratio is below 1, where no voltage is computed. It is not called capacitive
        then, whatever the share: laws of the share are least certain there.

    Examples
    --------
    >>> regime_of(1e-4), regime_of(0.3), regime_of(0.995), regime_of(1e-4, touching=True)
    ('capacitive', 'intermittent', 'resistive', 'intermittent')
    """
    if share > RESISTIVE:
        return "resistive"
    return "intermittent" if touching or share > CAPACITIVE else "capacitive"


def _mean_share(pairs: list[tuple[Array, Array]]) -> float:
    """Share of time in which a bearing conducts, mean over the positions, from the shares of its contacts."""
    inner, outer = (np.array(column) for column in zip(*pairs, strict=True))
    return float(np.mean(bearing_time_share(inner, outer)))


def _ring(solution: BearingSolution, ring: RingState, film_scale: float) -> RingDuty:
    """Asperities in the contacts with one ring; elements without load have none."""
    bearing, loaded = solution.case.bearing, ring.solved
    film = film_scale * ring.values.central_thickness[loaded]

    def whole(values: Array, otherwise: float = 0.0) -> Array:
        column = np.full(loaded.shape, otherwise)
        column[loaded] = values
        return column

    ratio = film / bearing.composite_rq
    shares, probability = load_shares(ratio), contact_probability(ratio)
    low = np.min([_in_range(name, share, ratio) for name, share in shares.items()], axis=0)
    spots, real, time_share = None, None, probability
    if bearing.summits is not None:
        factor = 4.0 if bearing.kind == ROLLERS else np.pi
        area = factor * ring.values.semi_axis_x[loaded] * ring.values.semi_axis_y[loaded]
        touching = _touching(solution, film)
        number = expected_spots(touching.spots_per_area, area)
        time_share = contact_time_share(number)
        spots, real = whole(number), whole(area_while_touching(touching, area))
    return RingDuty(
        central_lambda_ratio=whole(ratio, np.inf),
        asperity_share=whole(shares[DEFAULT_SHARE]),
        asperity_share_low=whole(low),
        asperity_share_high=whole(np.max(list(shares.values()), axis=0)),
        contact_probability=whole(probability),
        expected_spots=spots,
        contact_time_share=whole(time_share),
        real_area=real,
    )


def _in_range(name: str, share: Array, ratio: Array) -> Array:
    """Load share by a law, infinite beyond its range: Johnson's fit ends at a share of 0."""
    assert name in LOAD_SHARE
    return np.where(ratio < johnson_end(), share, np.inf) if name == "johnson" else share


def _touching(solution: BearingSolution, film: Array) -> AsperityContact:
    """Asperities of contacts with a central film [m], after Greenwood and Williamson."""
    bearing = solution.case.bearing
    given, rq = bearing.summits, bearing.composite_rq
    assert given is not None
    deviation, separation = given.height_deviation or rq, separation_of_gap(film, rq)
    if given.bandwidth is not None:
        # Of the moments only m0 and the bandwidth m0 m4/m2^2 count for the heights of the summits.
        deviation = SpectralMoments(rq**2, 1.0, given.bandwidth / rq**2).summits().height_deviation
        separation = summit_separation(separation, rq, given.bandwidth)
    highest = np.inf if given.highest is None else given.highest
    summits = Summits(density=given.density, radius=given.radius, height_deviation=deviation, highest=highest)
    # Summits of nearly one height all touch from a separation on that is below the range of the integrals.
    level = np.maximum(separation, LOWEST_SEPARATION * deviation)
    return greenwood_williamson(level, summits, solution.conditions.modulus)
