"""Statistics of touching asperities: pressure, area and number of spots, load and time shares, resistance.

The spectral moments m0, m2 and m4 are the mean squares of height, slope and curvature along a line over the
surface. For an isotropic Gaussian surface they give density, radius and heights of its summits.

No surface has these numbers of its own. Slope and curvature grow as finer waves are measured, without a limit
for most machined surfaces: m4, the density and the radius of the summits belong to the sampling interval.

Published fits give the share of the load that asperities carry against lambda. Lambda is the film thickness
divided by the composite roughness sqrt(Rq1^2 + Rq2^2) of the undeformed surfaces. The fits agree within a
factor of two below lambda 1.5 and differ by orders of magnitude above 2.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Self

import numpy as np
import scipy
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Numbers
from ehlectric.formulas.gaussian import erfc, normal_share

# Step and ends of the trapezoidal rule in u, where the height above the separation is
# t = scale exp(u - exp(-u)). The integrand falls off double exponentially at both ends.
_STEP, _FIRST, _LAST = 0.03, -4.5, 3.6

# Lowest separation in standard deviations: below it the integrand is a peak that the rule does not resolve.
LOWEST_SEPARATION = -12.0

_U = np.arange(_FIRST, _LAST + 0.5 * _STEP, _STEP)
_T = np.exp(_U - np.exp(-_U))
_WEIGHTS = _STEP * (1.0 + np.exp(-_U)) * _T

# Nodes of the rule for worn summits, and the interval above the separation that it covers: heights beyond
# it have no share left.
_NODES, _FARTHEST = 96, 24.0

# Separations that are integrated at once, so that a large array needs little memory.
_AT_ONCE = 4096


def greenwood_integral(order: float, separation: ArrayLike, highest: ArrayLike = np.inf) -> Array:
    """Integral F_n(l) = (2 pi)^(-1/2) Int_l^inf (s - l)^n exp(-s^2/2) ds over Gaussian heights.

    F_0 is the share of the summits that are higher than the separation, F_1 their mean overlap, F_3/2 and
    F_5/2 are in the pressures of Greenwood and Williamson and of Greenwood and Tripp.

    ``order``, order n >= 0, dimensionless; any real number; ``separation``, separation l in standard
    deviations of the heights, >= -12, shape (...); ``highest``, height in standard deviations, >= -12, to
    which all higher summits are worn down: s is the smaller of the Gaussian height and this one; infinite
    without wear, or finite numbers of shape (...). Returns
    value of the integral, dimensionless; its relative error is below 1e-11, with worn summits 1e-9,
    shape (...); it is zero where no summit reaches the separation. Raises ValueError if the order is
    negative, or a separation or the highest summit below -12 or not a number.

    J. A. Greenwood and J. H. Tripp, The contact of two nominally flat rough surfaces, Proc. Inst. Mech. Eng.
    185 (1970) 625-633. The integral is evaluated by the trapezoidal rule after a double exponential
    substitution. The fit 4.4086e-5 (4 - l)^6.804 for F_5/2, used in many programs, is 11 % low at l = 0 and
    98 % low at l = 3.5.

    Examples
    --------
    >>> greenwood_integral(2.5, [0.0, 2.0]).round(7).tolist()
    [0.6166342, 0.0054237]
    """
    at = np.asarray(separation, dtype=float)
    if not order >= 0.0:
        raise ValueError(f"the order of a Greenwood integral is at least 0, got {order:g}")
    if not np.all(at >= LOWEST_SEPARATION):
        raise ValueError(f"separations are at least {LOWEST_SEPARATION:g} standard deviations")
    if not np.all(np.greater_equal(highest, LOWEST_SEPARATION)):
        raise ValueError(f"the highest summit is at least at {LOWEST_SEPARATION:g} standard deviations")
    if order == 0.0:
        return np.where(at < highest, normal_share(-at), 0.0)
    if np.all(np.isfinite(highest)):
        return _worn(order, at, np.asarray(highest, dtype=float))
    flat = at.ravel()
    pieces = [_integrals(order, flat[k : k + _AT_ONCE]) for k in range(0, flat.size, _AT_ONCE)]
    return np.concatenate(pieces or [flat]).reshape(at.shape)


def _integrals(order: float, at: Array) -> Array:
    """Integrals of a flat array (n,) of separations, by t = scale exp(u - exp(-u)) with t = s - l."""
    # The integrand t^n exp(-l t - t^2/2) has its maximum at about this t.
    scale = _positive_root(at, order + 1.0)
    t = np.multiply.outer(scale, _T)
    values = np.exp(order * np.log(t) - 0.5 * (t + at[:, np.newaxis]) ** 2) @ _WEIGHTS
    integrals: Array = scale * values / np.sqrt(2.0 * np.pi)
    return integrals


def _worn(order: float, at: Array, highest: Array) -> Array:
    """Integrals where higher summits lie at ``highest``: lower summits by Gauss and Jacobi, and the rest."""
    width = np.maximum(np.minimum(highest, at + _FARTHEST) - at, 0.0)
    nodes, weights = _jacobi(order)
    t = np.multiply.outer(width, 0.5 * (1.0 + nodes))
    density = np.exp(-0.5 * (t + at[..., np.newaxis]) ** 2) / np.sqrt(2.0 * np.pi)
    below = (0.5 * width) ** (order + 1.0) * (density @ weights)
    worn = normal_share(-highest) * np.maximum(highest - at, 0.0) ** order
    integrals: Array = below + worn
    return integrals


@lru_cache(maxsize=16)
def _jacobi(order: float) -> tuple[Array, Array]:
    """Nodes and weights for the weight (1 + x)^order on -1 to 1; they take longer than the integrals."""
    nodes, weights = scipy.special.roots_jacobi(_NODES, 0.0, order)
    return nodes, weights


def _positive_root(at: Array, order: float) -> Array:
    """Positive root t of t^2 + l t = order, without cancellation for large l."""
    half = 0.5 * at
    far = np.sqrt(half**2 + order)
    return np.where(half > 0.0, order / (far + np.abs(half)), far - half)


def separation_of_gap(gap: ArrayLike, deviation: Numbers) -> Array:
    """Separation of the mean planes at which two rough surfaces have a mean gap.

    Overlapping peaks are pressed flat: a separation d has the mean gap d + sigma F_1(d/sigma). A film formula
    gives the volume of oil per area, which is this gap.

    ``gap`` [m], shape (...); ``deviation``, standard deviation of the gap [m], > 0. Returns distance of the
    mean planes of the undeformed roughness [m]; negative for gaps below 0.399 ``deviation``, shape (...).

    Examples
    --------
    >>> round(float(separation_of_gap(100e-9, 100e-9)) * 1e9, 1)
    89.9
    """
    target = np.maximum(np.asarray(gap, dtype=float) / deviation, 1e-3)
    # The gap is a convex function of the separation with slopes from 0 to 1. Newton's method from the right
    # therefore never steps over the solution, which is at most the gap itself.
    at = target
    for _ in range(100):
        excess = at + greenwood_integral(1.0, at) - target
        step = excess / normal_share(at)
        at = at - step
        if np.all(np.abs(step) <= 1e-14 * np.maximum(1.0, np.abs(at))):
            break
    return np.asarray(deviation * at)


# The variance of the summit heights is (1 - 0.8968/alpha) m0, with the printed constant.
_SUMMIT_VARIANCE = 0.8968

# Least bandwidth of an isotropic Gaussian surface.
LEAST_BANDWIDTH = 1.5

# Fewest intervals in the length of a profile: over fewer the mean squares mean nothing.
_LEAST_INTERVALS = 8


@dataclass(frozen=True)
class SpectralMoments:
    """Spectral moments of a line over a rough surface; the moments of two surfaces add up.

    Examples
    --------
    >>> both = SpectralMoments(1e-16, 1e-4, 1e9) + SpectralMoments(4e-16, 0.0, 0.0)
    >>> round(both.rq * 1e9, 2), round(both.bandwidth, 1)
    (22.36, 50.0)
    """

    m0: float  # mean square height about the mean, Rq^2 [m^2]
    m2: float  # mean square slope
    m4: float  # mean square of the second derivative [1/m^2]

    def __add__(self, other: Self) -> Self:
        """Moments of the gap between two surfaces whose heights are independent."""
        return type(self)(self.m0 + other.m0, self.m2 + other.m2, self.m4 + other.m4)

    @property
    def rq(self) -> float:
        """Root mean square height [m]."""
        return float(np.sqrt(self.m0))

    @property
    def bandwidth(self) -> float:
        """Nayak's bandwidth alpha = m0 m4/m2^2, at least 1.5 for an isotropic Gaussian surface; nan if flat.

        Few waves of one length have a small bandwidth, a spectrum over decades of wavelengths a large one.
        """
        return float(self.m0 * self.m4 / self.m2**2) if self.m2 > 0.0 else float("nan")

    def summits(self) -> Summits:
        """Summits of an isotropic Gaussian surface with these moments. Returns density m4/(6 sqrt(3) pi m2),
        radius (3/8) sqrt(pi/m4), and standard deviation of the heights sqrt((1 - 0.8968/alpha) m0). Raises
        ValueError if the surface is flat, or its bandwidth below 1.5: no isotropic Gaussian surface has these
        moments.

        P. R. Nayak, Random process model of rough surfaces, J. Lubr. Technol. 93 (1971) 398-407. J. I.
        McCool, Comparison of models for the contact of rough surfaces, Wear 107 (1986) 37-60. The radius is
        the radius of the mean curvature of all summits. Higher summits are sharper.

        Examples
        --------
        >>> summits = SpectralMoments(1e-14, 1e-3, 1e9).summits()
        >>> round(summits.density / 1e9, 1), round(summits.radius * 1e6, 1)
        (30.6, 21.0)
        """
        if not self.bandwidth >= LEAST_BANDWIDTH:
            raise ValueError(
                f"an isotropic Gaussian surface has a bandwidth of at least {LEAST_BANDWIDTH:g}, "
                f"got {self.bandwidth:.3g}"
            )
        return Summits(
            density=self.m4 / (6.0 * float(np.sqrt(3.0)) * np.pi * self.m2),
            radius=0.375 * float(np.sqrt(np.pi / self.m4)),
            height_deviation=float(summit_deviation(self.rq, self.bandwidth)),
        )


def profile_moments(heights: Array, spacing: float, interval: float | None = None) -> SpectralMoments:
    """Spectral moments of a profile at a sampling interval, from differences.

    Slope and second derivative are (z(x + d) - z(x))/d and (z(x + d) - 2 z(x) + z(x - d))/d^2 with the
    interval d. Differences are the standard of the contact models, and they need no periodic profile: in a
    power spectrum the step between both ends would dominate m4. A wave of the length L has the
    slope of the wave times sin(pi d/L)/(pi d/L), so that waves shorter than about four intervals are damped.

    ``heights``, heights at equally spaced points [m], shape (n,); ``spacing``, distance of the points [m];
    ``interval``, sampling interval d [m], rounded to a whole number of spacings and at least one; by default
    one. Returns m0 [m^2], m2, and m4 [1/m^2]. Raises ValueError if the profile is shorter than eight
    intervals.

    Rounding of the heights to steps s adds s^2/(6 d^2) to m2 and s^2/(2 d^4) to m4, if the errors of the
    points are independent. Noise of the instrument acts in the same way. Take an interval at which that is
    small.

    Examples
    --------
    >>> wave = 1e-7 * np.sin(2 * np.pi * np.arange(1000) / 100)
    >>> moments = profile_moments(wave, 1e-7)
    >>> round(moments.rq * 1e9, 2), round(moments.bandwidth, 2)
    (70.71, 1.0)
    """
    return _line_moments(heights[np.newaxis], spacing, interval)


@dataclass(frozen=True)
class MapMoments:
    """Spectral moments of a map along x and along y."""

    along_x: SpectralMoments
    along_y: SpectralMoments

    @property
    def isotropic(self) -> SpectralMoments:
        """Moments of the isotropic surface that stands for the map: geometric means of both directions.

        For an isotropic map this is the mean of both. For a surface with a lay it is an approximation after
        Sayles and Thomas (from memory), which keeps the product of both slopes.
        """
        x, y = self.along_x, self.along_y
        return SpectralMoments(x.m0, float(np.sqrt(x.m2 * y.m2)), float(np.sqrt(x.m4 * y.m4)))

    @property
    def slope_ratio(self) -> float:
        """Root mean square slope along x over that along y; nan for no slope. One if isotropic."""
        return float(np.sqrt(self.along_x.m2 / self.along_y.m2)) if self.along_y.m2 > 0.0 else float("nan")


def map_moments(
    heights: Array, spacing_x: float, spacing_y: float, interval: float | None = None
) -> MapMoments:
    """Spectral moments of a map along x and along y, from differences as in ``profile_moments``.

    ``heights`` [m], shape (nx, ny); ``spacing_x`` and ``spacing_y``, distances of the points along x and y
    [m]; ``interval``, sampling interval [m], rounded along each axis to a whole number of spacings and at
    least one; by default one spacing of each axis. Returns moments along both axes. Raises ValueError if a
    side of the map is shorter than eight intervals.

    Examples
    --------
    >>> wave = np.sin(2 * np.pi * np.arange(400) / 100)
    >>> found = map_moments(1e-7 * np.add.outer(wave, wave), 1e-7, 2e-7)
    >>> round(found.slope_ratio, 3), round(found.isotropic.rq * 1e9, 3)
    (2.0, 100.0)
    """
    return MapMoments(
        _line_moments(heights.T, spacing_x, interval), _line_moments(heights, spacing_y, interval)
    )


def _line_moments(lines: Array, spacing: float, interval: float | None) -> SpectralMoments:
    """Moments of lines along the last axis, shape (lines, n), with the mean of all heights as zero."""
    step = 1 if interval is None else max(1, round(interval / spacing))
    if lines.shape[-1] <= _LEAST_INTERVALS * step:
        raise ValueError(
            f"{lines.shape[-1]} points are fewer than {_LEAST_INTERVALS} sampling intervals of {step} points"
        )
    distance = step * spacing
    slopes = (lines[:, step:] - lines[:, :-step]) / distance
    curvatures = (slopes[:, step:] - slopes[:, :-step]) / distance
    m0, m2, m4 = float(np.var(lines)), float(np.mean(slopes**2)), float(np.mean(curvatures**2))
    return SpectralMoments(m0, m2, m4)


@dataclass(frozen=True, kw_only=True)
class Summits:
    """Summits of a rough surface: spherical caps of one radius with Gaussian heights.

    Numbers are floats, or have the shape (...) of the separations.
    """

    density: Numbers  # number of summits per area n [1/m^2], > 0
    radius: Numbers  # radius of the caps beta [m], > 0
    # Standard deviation of the summit heights [m], > 0. For two rough surfaces it belongs to the sum of both
    # heights, sqrt(sigma_s1^2 + sigma_s2^2).
    height_deviation: Numbers
    # Height above the mean of the summits, in standard deviations, to which all higher summits are worn down;
    # by default none is.
    highest: Numbers = np.inf

    @property
    def roughness_parameter(self) -> Numbers:
        """Product n beta sigma_s, dimensionless; 0.03 to 0.05 for many surfaces."""
        return self.density * self.radius * self.height_deviation


@dataclass(frozen=True)
class AsperityContact:
    """Contact of the summits at one separation or an array of separations."""

    pressure: Array  # asperity load per nominal area [Pa], shape (...)
    # Real contact area over nominal area, dimensionless. The models hold while it is small, shape (...).
    area_fraction: Array
    spots_per_area: Array  # number of contact spots per nominal area [1/m^2], shape (...)


def greenwood_williamson(separation: ArrayLike, summits: Summits, reduced_modulus: float) -> AsperityContact:
    """Contact of a rough surface and a flat one after Greenwood and Williamson.

    With l = d/sigma_s and E* = E'/2: pressure (4/3) n sqrt(beta) sigma_s^(3/2) E* F_3/2(l), real area
    fraction pi n beta sigma_s F_1(l), spots per area n F_0(l). Two rough surfaces are taken as the sum of
    both heights against a flat: then ``summits`` are the summits of the sum.

    ``separation``, distance d of the mean plane of the summits to the flat [m], >= -12 standard deviations,
    shape (...); ``reduced_modulus``, reduced modulus E' = 2 E* [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 -
    nu2^2)/E2. Raises ValueError if a separation is below -12 standard deviations.

    J. A. Greenwood and J. B. P. Williamson, Contact of nominally flat surfaces, Proc. R. Soc. A 295 (1966)
    300-319, doi:10.1098/rspa.1966.0242. Caps are elastic, have no effect on each other and do not merge.

    Examples
    --------
    >>> rough = Summits(density=2e11, radius=2e-6, height_deviation=100e-9)
    >>> contact = greenwood_williamson(200e-9, rough, 226e9)
    >>> round(float(contact.pressure) / 1e6, 2), round(float(contact.spots_per_area) / 1e9, 3)
    (8.96, 4.55)
    """
    level = np.asarray(separation, dtype=float) / summits.height_deviation
    n, beta, sigma = summits.density, summits.radius, summits.height_deviation
    stiffness = 4.0 / 3.0 * n * np.sqrt(beta) * sigma**1.5 * 0.5 * reduced_modulus
    return AsperityContact(
        pressure=stiffness * greenwood_integral(1.5, level, summits.highest),
        area_fraction=np.pi * summits.roughness_parameter * greenwood_integral(1.0, level, summits.highest),
        spots_per_area=n * greenwood_integral(0.0, level, summits.highest),
    )


def summit_deviation(rq: Numbers, bandwidth: Numbers) -> Numbers:
    """Return the standard deviation of the summit heights [m] of an isotropic Gaussian surface.

    It is Rq sqrt(1 - 0.8968/alpha). ``rq``, Rq of the surface, or of the sum of two surfaces [m], shape
    (...); ``bandwidth``, Nayak's bandwidth alpha, dimensionless, >= 1.5, shape (...).

    J. I. McCool, Comparison of models for the contact of rough surfaces, Wear 107 (1986) 37-60.

    Examples
    --------
    >>> round(float(summit_deviation(100e-9, 10.0)) * 1e9, 1)
    95.4
    """
    return rq * np.sqrt(1.0 - _SUMMIT_VARIANCE / bandwidth)


def summit_separation(separation: ArrayLike, rq: Numbers, bandwidth: Numbers) -> Array:
    """Return the distance to the mean summit plane for a distance to the mean surface plane.

    Summits lie higher than the surface. For an isotropic Gaussian surface their mean height above the mean
    plane is 4 Rq/sqrt(pi alpha), with Nayak's bandwidth alpha = m0 m4/m2^2.

    ``separation``, distance of the mean plane of the surface to the other one [m], shape (...); ``rq``, rq of
    the surface, or of the sum of two surfaces [m]; ``bandwidth``, nayak's bandwidth alpha of the same
    heights, dimensionless, >= 1.5. Returns distance of the mean plane of the summits to the other one [m],
    shape (...).

    J. I. McCool, Comparison of models for the contact of rough surfaces, Wear 107 (1986) 37-60.

    Examples
    --------
    >>> round(float(summit_separation(200e-9, 100e-9, 10.0)) * 1e9, 1)
    128.6
    """
    distance: Array = np.asarray(separation, dtype=float) - 4.0 * rq / np.sqrt(np.pi * bandwidth)
    return distance


@dataclass(frozen=True)
class ShareLaw:
    """Fit of the asperity load share over lambda, an entry of ``LOAD_SHARE``.

    Examples
    --------
    >>> round(float(LOAD_SHARE["clarke"].share(1.0)), 3)
    0.157
    """

    name: str
    # Function of lambda, array_like of shape (...), that returns the share from 0 to 1, shape (...). It
    # raises ``ValueError`` for a negative lambda.
    share: Callable[[ArrayLike], Array]
    source: str  # publication, and how far it is confirmed


def contact_probability(film_parameter: ArrayLike) -> Array:
    """Share of time in which a lubricated contact conducts, 1 - erf(lambda), after Clarke et al.

    ``film_parameter``, lambda, central film thickness over composite roughness, dimensionless, >= 0,
    shape (...). Returns share of time with metallic contact, dimensionless, from 1 at no film to 0,
    shape (...). Raises ValueError if a lambda is negative.

    Clarke et al. fitted electrical contact resistances of discs; it is quoted after Arana. Contact begins
    below lambda = 2 and rises steeply below 1. The fit is of one test rig: area of the contact, speed and
    spacing of the asperities are not in it, whereas they are in ``contact_time_share``.

    Examples
    --------
    >>> contact_probability([0.0, 1.0, 2.0]).round(4).tolist()
    [1.0, 0.1573, 0.0047]
    """
    return erfc(_checked(film_parameter))


def patir_cheng(film_parameter: ArrayLike) -> Array:
    """Asperity load share exp(-1.8 lambda^1.2), a fit to the model of Patir and Cheng. ``film_parameter``,
    lambda, dimensionless, >= 0, shape (...). Returns asperity load share, dimensionless, from 0 to 1,
    shape (...). Raises ValueError if a lambda is negative.

    Examples
    --------
    >>> round(float(patir_cheng(1.0)), 3)
    0.165
    """
    return np.exp(-1.8 * _checked(film_parameter) ** 1.2)


def zhou_hoeprich(film_parameter: ArrayLike) -> Array:
    """Asperity load share exp(-2.32 lambda^0.97) of roller raceways after Zhou and Hoeprich.

    The constants hold for the raceway of a tapered roller bearing 32216. A 32208 has 2.1 and 0.85.

    ``film_parameter``, lambda, dimensionless, >= 0, shape (...). Returns asperity load share, dimensionless,
    from 0 to 1, shape (...). Raises ValueError if a lambda is negative.

    Examples
    --------
    >>> round(float(zhou_hoeprich(1.0)), 3)
    0.098
    """
    return np.exp(-2.32 * _checked(film_parameter) ** 0.97)


def johnson_fit(film_parameter: ArrayLike) -> Array:
    """Asperity load share 1 - 1.21 lambda^0.64/(1 + 0.37 lambda^1.26), of the type of Johnson.

    The fraction reaches one near lambda = 2. Beyond, the expression becomes negative and then rises again:
    it is no fit there, and the share is zero.

    ``film_parameter``, lambda, dimensionless, >= 0, shape (...). Returns asperity load share, dimensionless,
    from 1 to 0, shape (...). Raises ValueError if a lambda is negative.

    Examples
    --------
    >>> johnson_fit([1.0, 3.0]).round(3).tolist()
    [0.117, 0.0]
    """
    at = _checked(film_parameter)
    return np.where(at < johnson_end(), 1.0 - _johnson_fraction(at), 0.0)


@cache
def johnson_end() -> float:
    """Lambda at which the Johnson-type fit reaches zero and its range ends, dimensionless."""
    # 1.21 x^0.64 - 1 - 0.37 x^1.26 is concave below its zero: Newton's method from the left rises to it.
    at, step = 1.0, math.inf
    while step > 1e-15 * at:
        excess = 1.21 * at**0.64 - 1.0 - 0.37 * at**1.26
        step = -excess / (1.21 * 0.64 * at**-0.36 - 0.37 * 1.26 * at**0.26)
        at += max(step, 0.0)
    return at


def _johnson_fraction(film_parameter: Array | float) -> Array | float:
    return 1.21 * film_parameter**0.64 / (1.0 + 0.37 * film_parameter**1.26)


def _checked(film_parameter: ArrayLike) -> Array:
    at = np.asarray(film_parameter, dtype=float)
    if not np.all(at >= 0.0):
        raise ValueError("lambda is a film thickness over a roughness, at least 0")
    return at


# Fits by name. Measurements and models of different contacts are in them: take their spread as the error.
LOAD_SHARE: dict[str, ShareLaw] = {
    "clarke": ShareLaw(
        "Clarke et al.",
        contact_probability,
        "Clarke et al., from electrical contact resistance of discs, as quoted by Arana; taken as load share",
    ),
    "patir_cheng": ShareLaw(
        "Patir-Cheng",
        patir_cheng,
        "fit to N. Patir and H. S. Cheng, J. Lubr. Technol. 100 (1978) 12-17, as quoted by Matsuyama",
    ),
    "zhou_hoeprich": ShareLaw(
        "Zhou-Hoeprich",
        zhou_hoeprich,
        "R. S. Zhou and M. R. Hoeprich, J. Tribol. 113 (1991) 590-597, constants quoted by Wingertszahn "
        "(2023) for a 32216; volume and pages from memory",
    ),
    "johnson": ShareLaw(
        "Johnson type",
        johnson_fit,
        "quoted as of the type of Johnson, Greenwood and Poon, Wear 19 (1972) 91-108; author of the fit "
        "not confirmed",
    ),
}


def load_shares(film_parameter: ArrayLike) -> dict[str, Array]:
    """Asperity load shares of every fit of ``LOAD_SHARE`` at the same lambda; their spread is their error.
    ``film_parameter``, lambda, dimensionless, >= 0, shape (...). Returns asperity load share by key of the
    fit, dimensionless, from 0 to 1, shape (...). Raises ValueError if a lambda is negative.

    Examples
    --------
    >>> {name: round(float(share), 2) for name, share in load_shares(0.5).items()}
    {'clarke': 0.48, 'patir_cheng': 0.46, 'zhou_hoeprich': 0.31, 'johnson': 0.33}
    """
    return {name: law.share(film_parameter) for name, law in LOAD_SHARE.items()}


def expected_spots(spots_per_area: ArrayLike, area: ArrayLike) -> Array:
    """Expected number of simultaneous spots in an area. ``spots_per_area``, spots per nominal area [1/m^2],
    >= 0, as in ``AsperityContact``, shape (...); ``area``, area of the contact, such as the area of the Hertz
    ellipse [m^2], >= 0, shape (...). Returns expected number of spots, dimensionless, shape (...).

    Examples
    --------
    >>> float(expected_spots(1e9, 1e-9))
    1.0
    """
    return np.multiply(spots_per_area, area)


def contact_time_share(expected: ArrayLike) -> Array:
    """Share of time with at least one spot, 1 - exp(-N), where N spots are expected at a time.

    Spots come and go independently of each other, so that their number is a Poisson variable. Asperities of
    a wavy or directional surface come in groups: then this share is an upper bound at the same N.

    ``expected``, expected number N of simultaneous spots, dimensionless, >= 0, shape (...). Returns share of
    time, dimensionless, from 0 to 1; accurate for small N too, shape (...). Raises ValueError if a number is
    negative.

    Examples
    --------
    >>> contact_time_share([0.0, 0.1, 1.0]).round(4).tolist()
    [0.0, 0.0952, 0.6321]
    """
    number = np.asarray(expected, dtype=float)
    if not np.all(number >= 0.0):
        raise ValueError("the expected number of spots is at least 0")
    share: Array = -np.expm1(-number)
    return share


def area_while_touching(contact: AsperityContact, area: ArrayLike) -> Array:
    """Mean real area of contact while there is at least one spot, A f/(1 - exp(-N)).

    With the real area fraction f and the number N = n A of spots that are expected in the nominal area A. Of
    few expected spots it is the mean area of one, f/n; of many it is A f.

    ``contact``, real area fraction and spots per area, shape (...); ``area``, nominal area, such as the area
    of the Hertz ellipse [m^2], >= 0, shape (...). Returns real area [m^2]; 0 where no spot is expected, shape
    (...).

    Examples
    --------
    Spots of 1e-13 m^2 each, of which a millionth, and of which a hundred are expected:

    >>> from ehlectric.formulas.asperities import AsperityContact
    >>> density = np.array([1e3, 1e11])
    >>> spots = AsperityContact(pressure=np.zeros(2), area_fraction=1e-13 * density, spots_per_area=density)
    >>> area_while_touching(spots, 1e-9).round(18).tolist()
    [1e-13, 1e-11]
    """
    nominal = np.asarray(area, dtype=float)
    share = contact_time_share(expected_spots(contact.spots_per_area, nominal))
    real = contact.area_fraction * nominal
    mean: Array = np.divide(real, share, out=np.zeros(np.broadcast(real, share).shape), where=share > 0.0)
    return mean


def bearing_time_share(inner: ArrayLike, outer: ArrayLike, axis: int = -1) -> Array:
    """Share of time in which a bearing conducts, 1 - prod_j (1 - p_inner_j p_outer_j) over its elements.

    An element conducts while both its contacts do; they are in series. One conducting element shorts the
    bearing; its elements are in parallel. All contacts are taken as independent of each other.

    ``inner`` and ``outer``, shares of time with contact at the inner and outer ring, for each element,
    dimensionless, 0 to 1, shape (..., elements). Returns share of time in which the bearing conducts,
    dimensionless; accurate for small shares too, shape (...). Raises ValueError if a share is not from 0 to
    1.

    A vibration or a change of load thins several films at once. If both contacts of an element close
    together, the element conducts more often than p_inner p_outer; if several elements close together,
    the bearing conducts less often than elements that close one after the other.

    Examples
    --------
    >>> round(float(bearing_time_share([0.5, 0.1], [0.2, 0.1])), 6)
    0.109
    """
    p, q = np.asarray(inner, dtype=float), np.asarray(outer, dtype=float)
    for each in (p, q):
        if not np.all((each >= 0.0) & (each <= 1.0)):
            raise ValueError("a share of time lies between 0 and 1")
    with np.errstate(divide="ignore"):  # the logarithm of no open time is minus infinity
        open_time = np.sum(np.log1p(-p * q), axis=axis)
    share: Array = -np.expm1(open_time)
    return share


# Rows of the matrix of distances that are held at a time.
_ROWS = 512


def holm_resistance(radius: ArrayLike, resistivity: float) -> Array:
    """Constriction resistance of a circular spot, rho/(2 a), after Holm.

    The current spreads into a half-space on both sides. Two metals count with the mean of their
    resistivities.

    ``radius`` [m], shape (...); ``resistivity``, resistivity rho of the bodies [ohm m]; about 2.2e-7 for the
    steel 100Cr6 (from memory). Returns resistance [ohm], shape (...).

    R. Holm, Electric Contacts, 4th ed., Springer 1967. It needs a spot that is much larger than the mean free
    path of the electrons; see ``spot_resistance``.

    Examples
    --------
    >>> holm_resistance([0.1e-6, 1e-6], 2.2e-7).round(3).tolist()
    [1.1, 0.11]
    """
    return resistivity / (2.0 * np.asarray(radius, dtype=float))


def sharvin_resistance(radius: ArrayLike, resistivity: float, mean_free_path: float) -> Array:
    """Resistance of a circular spot that electrons pass without a collision, 4 rho l/(3 pi a^2). ``radius``
    [m], shape (...); ``resistivity``, resistivity rho of the bodies [ohm m]; ``mean_free_path``, mean free
    path l of the electrons [m], a few nanometres in steel. Returns resistance [ohm], shape (...).

    Yu. V. Sharvin, Sov. Phys. JETP 21 (1965) 655.

    Examples
    --------
    >>> round(float(sharvin_resistance(1e-9, 2.2e-7, 2e-9)), 1)
    186.7
    """
    path_area = 3.0 * np.pi * np.asarray(radius, dtype=float) ** 2
    return 4.0 * resistivity * mean_free_path / path_area


def spot_resistance(radius: ArrayLike, resistivity: float, mean_free_path: float = 0.0) -> Array:
    """Resistance of a circular spot of any size: Sharvin's, and Holm's times Wexler's factor.

    R = 4 rho l/(3 pi a^2) + gamma(l/a) rho/(2 a) with gamma(K) = (1 + 0.83 K)/(1 + 1.33 K).

    ``radius`` [m], shape (...); ``resistivity``, resistivity rho of the bodies [ohm m]; ``mean_free_path``,
    mean free path l of the electrons [m], >= 0. Returns resistance [ohm], shape (...).

    G. Wexler, Proc. Phys. Soc. 89 (1966) 927-941. The factor is the fit of B. Nikolic and P. B. Allen, Phys.
    Rev. B 60 (1999) 3963, arXiv:cond-mat/9811296, to their exact solution; its constants are from memory.
    The exact conductance is within 11 % of the conductance of the plain sum of both resistances, and so is
    the conductance of the fit to a further 2 %.

    Examples
    --------
    >>> round(float(spot_resistance(0.5e-6, 2.2e-7)), 2), round(float(spot_resistance(5e-9, 2.2e-7, 2e-9)), 1)
    (0.22, 26.6)
    """
    factor = wexler_factor(mean_free_path / np.asarray(radius, dtype=float))
    return sharvin_resistance(radius, resistivity, mean_free_path) + factor * holm_resistance(
        radius, resistivity
    )


def wexler_factor(ratio: ArrayLike) -> Array:
    """Factor gamma of Holm's resistance in ``spot_resistance``; ``ratio``, mean free path divided by the
    radius of the spot, >= 0, shape (...).

    Examples
    --------
    >>> wexler_factor([0.0, 1.0]).round(3).tolist()
    [1.0, 0.785]
    """
    ratio = np.asarray(ratio, dtype=float)
    return np.asarray((1.0 + 0.83 * ratio) / (1.0 + 1.33 * ratio))


def greenwood_cluster(
    positions: ArrayLike, radii: ArrayLike, resistivity: float, mean_free_path: float = 0.0
) -> float:
    """Resistance of spots at given places, with currents in proportion to their radii, after Greenwood.

    R = sum a_i^2 R_i/(sum a_i)^2 + (rho/pi) sum_{i != j} (a_i a_j/s_ij)/(sum a_i)^2, with the resistances R_i
    of ``spot_resistance`` and the distances s_ij of the spots. Without a mean free path, the first term is
    rho/(2 sum a_i). For equal spots the second term is rho/(pi n^2) sum_{i != j} 1/s_ij.

    ``positions``, positions of the spots [m], all different, shape (n, 2); ``radii``, radii a_i of the spots
    [m], > 0; at least one, shape (n,); ``resistivity``, resistivity rho of the bodies [ohm m];
    ``mean_free_path``, mean free path of the electrons [m], >= 0. Returns resistance [ohm]; it is an upper
    bound of ``cluster_resistance``.

    J. A. Greenwood, Constriction resistance and the real area of contact, Br. J. Appl. Phys. 17 (1966)
    1621-1632 (from memory; the formula is derived from the potential of point sources on both half-spaces).
    Time and memory: n^2 and n.

    Examples
    --------
    Spots that are far apart are resistances in parallel:

    >>> round(greenwood_cluster([[0.0, 0.0], [1.0, 0.0]], [1e-6, 1e-6], 2.2e-7), 4)
    0.055
    """
    at, a = np.asarray(positions, dtype=float), np.asarray(radii, dtype=float)
    mutual = 0.0
    for first in range(0, a.size, _ROWS):
        rows = slice(first, first + _ROWS)
        mutual += float(a[rows] @ (_inverse_distances(at[rows], at, first) @ a))
    single = float(np.sum(a**2 * spot_resistance(a, resistivity, mean_free_path)))
    return (single + resistivity / np.pi * mutual) / float(np.sum(a)) ** 2


def cluster_resistance(
    positions: ArrayLike, radii: ArrayLike, resistivity: float, mean_free_path: float = 0.0
) -> float:
    """Resistance of spots at given places that all have the same voltage.

    The currents I_i follow from V = R_i I_i + (rho/pi) sum_{j != i} I_j/s_ij for every spot, with its own
    resistance R_i of ``spot_resistance``, rho/(2 a_i) without a free path. Spots in the middle of a cluster
    get less current than those at its edge.

    ``positions``, positions of the spots [m]; spots must not overlap, shape (n, 2); ``radii``, radii a_i of
    the spots [m], > 0; at least one, shape (n,); ``resistivity``, resistivity rho of the bodies [ohm m];
    ``mean_free_path`` [m]. Returns resistance [ohm].

    A spot acts on the others as a point: for two spots that touch this is wrong by a few per cent. Time and
    memory: n^3 and n^2; 2000 spots take a second.

    Examples
    --------
    >>> round(cluster_resistance([[0.0, 0.0]], [1e-6], 2.2e-7), 4)
    0.11
    """
    at, a = np.asarray(positions, dtype=float), np.asarray(radii, dtype=float)
    matrix = _inverse_distances(at, at, 0) / np.pi
    matrix[np.diag_indices(a.size)] = spot_resistance(a, 1.0, mean_free_path)
    return resistivity / float(np.sum(np.linalg.solve(matrix, np.ones(a.size))))


def _inverse_distances(rows: Array, at: Array, first: int) -> Array:
    """Reciprocal distances of some spots, from number ``first`` on, to all; zero of a spot to itself."""
    distance = np.hypot(rows[:, :1] - at[:, 0], rows[:, 1:] - at[:, 1])
    diagonal = np.arange(rows.shape[0])
    distance[diagonal, diagonal + first] = np.inf
    return 1.0 / distance


def film_resistance(area: ArrayLike, specific_resistance: float) -> Array:
    """Resistance of a boundary film over the real contact area, sigma_f/A_c, in series with the spots.
    ``area``, real contact area A_c [m^2], > 0, shape (...); ``specific_resistance``, resistance of the film
    times its area sigma_f [ohm m^2], thickness over conductivity. Returns resistance [ohm], shape (...).

    Examples
    --------
    >>> round(float(film_resistance(1e-12, 1e-9)))
    1000
    """
    return specific_resistance / np.asarray(area, dtype=float)
