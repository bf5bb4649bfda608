"""Roughness profiles: form removal, Gaussian filter, trimming and statistics.

Heights are positive out of the body, so that a peak narrows the gap. The points of a profile are equally
spaced, and its midpoint lies at x = 0. Maps are treated in ``ehlectric.surfaces.maps``, with the same
processing steps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Generic, Literal, Protocol, Self, TypeAlias, TypeVar

import numpy as np
import scipy

from ehlectric.arrays import Array
from ehlectric.errors import InputError

Form: TypeAlias = Literal["none", "mean", "line", "parabola"]
FORM_DEGREES: dict[str, int] = {"mean": 0, "line": 1, "parabola": 2}

# Constant of the Gaussian profile filter, for a transmission of one half at the cutoff (ISO 16610-21).
ALPHA = float(np.sqrt(np.log(2.0) / np.pi))

# Smallest cutoff wavelength in spacings of the points. With two spacings the transmission of the sampled
# weights at the cutoff is 0.89 instead of 0.5.
LEAST_CUTOFF = 4.0

# Rq below which a profile counts as flat [m]: a hundredth of an atom, but above the rounding of a constant.
FLAT = 1e-12

# Fraction of a profile's length over which each end is blended or faded for its continuation.
TAPER = 0.05

# Fewest points of a profile, and of a map along each axis: statistics of fewer points mean nothing.
LEAST_POINTS = 16


def convolved(values: Array, kernel: Array) -> Array:
    """Full convolution of two arrays by FFT: n and m points along an axis give n + m - 1 points."""
    convolution: Array = scipy.signal.fftconvolve(values, kernel)
    return convolution


@dataclass(frozen=True)
class Profile:
    """Roughness profile: heights (n,) at points of equal spacing, both [m]; positive out of the body."""

    spacing: float
    heights: Array

    @property
    def x(self) -> Array:
        """Positions of the points [m], zero at the midpoint, shape (n,)."""
        n = self.heights.size
        return np.linspace(-0.5, 0.5, n) * ((n - 1) * self.spacing)

    @property
    def length(self) -> float:
        """Distance between the first and the last point [m]."""
        return (self.heights.size - 1) * self.spacing

    def with_heights(self, heights: Array) -> Self:
        """Profile with the same points and other heights [m]."""
        return replace(self, heights=heights)


@dataclass(frozen=True)
class Statistics:
    """Amplitude and slope parameters of a profile, SI units."""

    # rq and ra: root mean square and mean absolute height about the mean [m].
    rq: float
    ra: float
    rsk: float
    rku: float
    # Distance at which the autocorrelation falls to 1/e [m]; the length of the profile if it does not fall so
    # far.
    correlation_length: float
    # rms_slope and largest_slope: root mean square and largest magnitude of the slope, from differences
    # between neighbours. ISO 21920-2 takes slopes over seven points.
    rms_slope: float
    largest_slope: float


def statistics(profile: Profile) -> Statistics:
    """Amplitude and slope parameters of a profile, with heights about its mean. ``profile``, profile with at
    least two points. Returns rq, Ra, Rsk and Rku as defined in ISO 21920-2, but over the whole profile as one
    section; correlation length and slopes.

    Examples
    --------
    A sine has Rq = amplitude/sqrt(2) and a kurtosis of 1.5:

    >>> import numpy as np
    >>> sine = Profile(1e-8, 1e-7 * np.sin(2 * np.pi * np.arange(10000) / 1000))
    >>> round(statistics(sine).rq / 1e-7, 4), round(statistics(sine).rku, 3)
    (0.7071, 1.5)
    """
    z = profile.heights - np.mean(profile.heights)
    slopes = np.diff(z) / profile.spacing
    rq = float(np.sqrt(np.mean(z**2)))
    flat = rq == 0.0
    return Statistics(
        rq=rq,
        ra=float(np.mean(np.abs(z))),
        rsk=0.0 if flat else float(np.mean(z**3) / rq**3),
        rku=0.0 if flat else float(np.mean(z**4) / rq**4),
        correlation_length=profile.length if flat else _correlation_length(z, profile.spacing),
        rms_slope=float(np.sqrt(np.mean(slopes**2))),
        largest_slope=float(np.max(np.abs(slopes))),
    )


def _correlation_length(z: Array, spacing: float) -> float:
    covariance = convolved(z, z[::-1])[z.size - 1 :] / np.arange(z.size, 0, -1)
    return first_below(covariance, spacing)


def first_below(covariance: Array, spacing: float) -> float:
    """Distance at which an autocovariance (n,) falls to 1/e of its first value [m].

    ``spacing`` is the distance between lags [m]. If the autocovariance does not fall so far, the distance is
    the largest lag.
    """
    below = np.flatnonzero(covariance < covariance[0] / np.e)
    if below.size == 0:
        return float((covariance.size - 1) * spacing)
    k = int(below[0])
    step = (covariance[k - 1] - covariance[0] / np.e) / (covariance[k - 1] - covariance[k])
    return float((k - 1 + step) * spacing)


def without_form(profile: Profile, form: Form) -> Profile:
    """Profile of the same length without its form, which is fitted by least squares and subtracted.

    Examples
    --------
    >>> import numpy as np
    >>> bent = Profile(1.0, np.arange(20.0) ** 2)
    >>> bool(np.allclose(without_form(bent, "parabola").heights, 0.0, atol=1e-9))
    True
    """
    if form == "none":
        return profile
    t = profile.x / max(profile.length, profile.spacing)
    fit = np.polynomial.Polynomial.fit(t, profile.heights, FORM_DEGREES[form])
    return replace(profile, heights=profile.heights - fit(t))


def gaussian_weights(spacing: float, cutoff: float, length: float) -> Array:
    """Weights of the Gaussian filter along one axis, normalised to the sum one.

    ``spacing`` and ``cutoff``, distance between neighbouring points, and cutoff wavelength [m]; ``length``,
    length of the profile, or of the shorter side of the map, that is filtered [m]. Returns weights at the
    distances -reach to reach, in points, shape (2 reach + 1,). Raises InputError if the cutoff is longer than
    ``length``, or shorter than four spacings.

    Examples
    --------
    >>> weights = gaussian_weights(1.0, 8.0, 100.0)
    >>> weights.size, round(float(weights.sum()), 12)
    (17, 1.0)
    """
    if not LEAST_CUTOFF * spacing <= cutoff <= length:
        raise InputError(
            "cutoff",
            got=f"{cutoff * 1e6:.4g} µm",
            takes="a length between four spacings and the whole surface, "
            f"{LEAST_CUTOFF * 1e6 * spacing:.4g} to {1e6 * length:.4g} µm",
        )
    reach = int(np.ceil(cutoff / spacing))
    distance = np.arange(-reach, reach + 1) * spacing
    weights = np.exp(-np.pi * (distance / (ALPHA * cutoff)) ** 2)
    normalised: Array = weights / weights.sum()
    return normalised


def waviness(profile: Profile, cutoff: float) -> Profile:
    """Waviness of a profile: Gaussian filter that passes wavelengths above a cutoff.

    The weight is exp(-pi (x/(alpha cutoff))^2)/(alpha cutoff) with alpha = sqrt(ln 2/pi). The transmission at
    a wavelength is exp(-pi (alpha cutoff/wavelength)^2), one half at the cutoff.

    ``cutoff``, cutoff wavelength [m], from four spacings to the length of the profile. Returns waviness, of
    the same length. Raises InputError if the cutoff is longer than the profile, or shorter than four
    spacings.

    ISO 16610-21.

    Examples
    --------
    >>> import numpy as np
    >>> profile = Profile(0.1, np.sin(2 * np.pi * np.arange(4000) * 0.1 / 8.0))
    >>> round(float(np.max(waviness(profile, 8.0).heights[1000:3000])), 3)
    0.5
    """
    weights = gaussian_weights(profile.spacing, cutoff, profile.length)
    reach = weights.size // 2
    total = convolved(profile.heights, weights)[reach : reach + profile.heights.size]
    share = convolved(np.ones_like(profile.heights), weights)
    return replace(profile, heights=total / share[reach : reach + profile.heights.size])


def trimmed(profile: Profile, length: float) -> Profile:
    """Profile without a piece of ``length`` [m] at each end.

    Raises ``InputError`` if fewer than 16 points are left.
    """
    n = round(length / profile.spacing)
    left = profile.heights.size - 2 * n
    if left < LEAST_POINTS:
        raise InputError(
            "trim",
            got=f"{length * 1e6:.4g} µm, which leaves {max(left, 0)} of {profile.heights.size} points;",
            takes=f"a length that leaves {LEAST_POINTS}",
        )
    return replace(profile, heights=profile.heights[n : n + left])


@dataclass(frozen=True)
class Processing:
    """Processing steps of a profile or a map, in their order; a step whose value is None is skipped."""

    form: Form = "none"  # form to remove: "none", "mean", "line" or "parabola"
    # cutoff_long and cutoff_short: cutoff wavelengths [m]; longer waves than ``cutoff_long``, shorter than
    # ``cutoff_short`` are removed.
    cutoff_long: float | None = None
    cutoff_short: float | None = None
    trim: float | None = None  # length cut off at each end [m]; by default half of the longer cutoff
    rescale_rq: float | None = None  # rq, or Sq for a map, to which the heights are scaled [m]
    truncate: float | None = None  # height at which peaks and depth at which valleys are cut off [m]


class Points(Protocol):
    """Protocol of a profile or a map: heights at equally spaced points."""

    @property
    def heights(self) -> Array:
        """Heights [m]."""

    def with_heights(self, heights: Array) -> Self:
        """Profile or map with the same points and other heights [m]."""


S = TypeVar("S", bound=Points)


@dataclass(frozen=True)
class Operations(Generic[S]):
    """Functions of the processing steps for profiles or for maps: form removal, Gaussian filter, trim."""

    without_form: Callable[[S, Form], S]
    waviness: Callable[[S, float], S]
    trimmed: Callable[[S, float], S]


def rms(heights: Array) -> float:
    """Root mean square of heights about their mean [m]: Rq of a profile, Sq of a map."""
    return float(np.sqrt(np.mean((heights - np.mean(heights)) ** 2)))


def in_order(first: S, steps: Processing, do: Operations[S]) -> list[tuple[str, S]]:
    """Process a profile or a map, and return it after every step with a description of the step.

    ``do`` has the operations for the kind of surface; ``first`` is the unprocessed surface.
    """
    done = [("as read", first)]

    def add(name: str, after: S) -> None:
        done.append((name, after))

    if steps.form != "none":
        add(f"form: {steps.form}", do.without_form(done[-1][1], steps.form))
    if steps.cutoff_long is not None:
        before = done[-1][1]
        short = before.heights - do.waviness(before, steps.cutoff_long).heights
        add(f"cutoff_long: {steps.cutoff_long * 1e6:.4g} µm", before.with_heights(short))
    if steps.cutoff_short is not None:
        add(f"cutoff_short: {steps.cutoff_short * 1e6:.4g} µm", do.waviness(done[-1][1], steps.cutoff_short))
    cutoffs = [c for c in (steps.cutoff_long, steps.cutoff_short) if c is not None]
    trim = steps.trim if steps.trim is not None else 0.5 * max(cutoffs, default=0.0)
    if trim > 0.0:
        rest = do.trimmed(done[-1][1], trim)
        centred = rest if steps.form == "none" else do.without_form(rest, "mean")
        add(f"trim: {trim * 1e6:.4g} µm at each end", centred)
    if steps.rescale_rq is not None:
        rq = rms(done[-1][1].heights)
        if rq < FLAT:
            raise InputError("rescale_rq", got="a flat surface", takes="one with some height")
        scaled = done[-1][1].heights * (steps.rescale_rq / rq)
        add(f"rescale_rq: {steps.rescale_rq * 1e9:.4g} nm", done[-1][1].with_heights(scaled))
    if steps.truncate is not None:
        cut = np.clip(done[-1][1].heights, -steps.truncate, steps.truncate)
        add(f"truncate: {steps.truncate * 1e9:.4g} nm", done[-1][1].with_heights(cut))
    return done


def processed(profile: Profile, steps: Processing) -> list[tuple[str, Profile]]:
    """Process a profile, and return it after every step with a description of the step. Returns description
    and profile after each step, in order; the first entry is the unprocessed profile. Raises InputError if a
    step is not possible with this profile.

    Examples
    --------
    >>> import numpy as np
    >>> profile = Profile(1e-7, 1e-8 * np.arange(100.0))
    >>> [name for name, _ in processed(profile, Processing(form="line"))]
    ['as read', 'form: line']
    """
    return in_order(profile, steps, Operations(without_form, waviness, trimmed))
