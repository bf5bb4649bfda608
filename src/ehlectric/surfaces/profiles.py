"""Roughness profiles: form removal, Gaussian filter, cutting, and statistics.

Heights are positive out of the body, so that a peak narrows the gap. A profile is equally spaced, and its
midpoint lies at x = 0. Maps, in ``ehlectric.surfaces.maps``, go through the same steps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Generic, Literal, Protocol, Self, TypeAlias, TypeVar

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError

Form: TypeAlias = Literal["none", "mean", "line", "parabola"]
FORM_DEGREES: dict[str, int] = {"mean": 0, "line": 1, "parabola": 2}

# Constant of the Gaussian profile filter, for a transmission of one half at the cutoff (ISO 16610-21).
ALPHA = float(np.sqrt(np.log(2.0) / np.pi))

# Spacings in the shortest cutoff: in two of them the sampled weights pass 0.89 at the cutoff instead of 0.5.
LEAST_CUTOFF = 4.0

# Rq below which a profile is flat [m]: a hundredth of an atom, and more than rounding leaves of a constant.
FLAT = 1e-12

# Part of a profile over which its ends are blended or faded where it is continued.
TAPER = 0.05

# Points below which a profile has no statistics worth the name.
LEAST_POINTS = 16


def convolved(values: Array, kernel: Array) -> Array:
    """Full convolution of two arrays of n and m points along each axis by FFT, n + m - 1 points long."""
    from scipy.signal import fftconvolve  # half a second to import, and smooth contacts need none

    convolution: Array = fftconvolve(values, kernel)
    return convolution


@dataclass(frozen=True)
class Profile:
    """Equally spaced heights [m], positive out of the body."""

    spacing: float
    heights: Array  # (n,)

    @property
    def x(self) -> Array:
        """Positions, the midpoint at zero [m], shape (n,)."""
        n = self.heights.size
        return np.linspace(-0.5, 0.5, n) * ((n - 1) * self.spacing)

    @property
    def length(self) -> float:
        """Distance of the last point from the first [m]."""
        return (self.heights.size - 1) * self.spacing

    def with_heights(self, heights: Array) -> Self:
        """The profile with other heights at its points [m]."""
        return replace(self, heights=heights)


@dataclass(frozen=True)
class Statistics:
    """Amplitude and slope parameters of a profile, SI units.

    Attributes
    ----------
    rq, ra : float
        Root mean square and mean absolute height about the mean [m].
    rsk, rku : float
        Skewness and kurtosis, 0 and 3 for a Gaussian profile; 0 for a flat one.
    correlation_length : float
        Distance at which the autocorrelation falls to 1/e [m]; the length where it does not. The standard's
        autocorrelation length falls to 0.2.
    rms_slope, largest_slope : float
        Of the differences between neighbours; the standard takes its slopes over seven points.
    """

    rq: float
    ra: float
    rsk: float
    rku: float
    correlation_length: float
    rms_slope: float
    largest_slope: float


def statistics(profile: Profile) -> Statistics:
    """Statistics of a profile about its mean.

    Parameters
    ----------
    profile : Profile
        Two points at least.

    Returns
    -------
    Statistics
        Rq, Ra, Rsk and Rku as defined in ISO 21920-2, but over the whole profile as one section.

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
    """Where an autocovariance falls to 1/e of its first value [m]; its whole length where it does not."""
    below = np.flatnonzero(covariance < covariance[0] / np.e)
    if below.size == 0:
        return float((covariance.size - 1) * spacing)
    k = int(below[0])
    step = (covariance[k - 1] - covariance[0] / np.e) / (covariance[k - 1] - covariance[k])
    return float((k - 1 + step) * spacing)


def without_form(profile: Profile, form: Form) -> Profile:
    """The profile less its form, by least squares.

    Parameters
    ----------
    profile : Profile
        As measured.
    form : str
        "none", "mean", "line" or "parabola".

    Returns
    -------
    Profile
        Of the same length.

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
    """Weights of the Gaussian filter at the distances -reach to reach, their sum one.

    Parameters
    ----------
    spacing, cutoff : float
        Of the points, and the cutoff wavelength [m].
    length : float
        Of what is filtered [m].

    Returns
    -------
    ndarray, shape (2 reach + 1,)
        Beyond a distance of one cutoff the weight is a millionth of that in the middle.

    Raises
    ------
    InputError
        As ``waviness`` does.

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
    """Gaussian profile filter: the waves longer than a cutoff.

    The weight is exp(-pi (x/(alpha cutoff))^2)/(alpha cutoff) with alpha = sqrt(ln 2/pi): half of the
    amplitude passes at the cutoff, exp(-pi (alpha cutoff/wavelength)^2) at a wavelength.

    Parameters
    ----------
    profile : Profile
        What to filter; near its ends the weights are those of the part that is there.
    cutoff : float
        Cutoff wavelength [m], at most the length of the profile.

    Returns
    -------
    Profile
        Of the same length.

    Raises
    ------
    InputError
        Where the cutoff is longer than the profile, or shorter than the four spacings below which the
        sampled weights are no Gaussian any more.

    Notes
    -----
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
    """The profile less a length at each end [m].

    Raises
    ------
    InputError
        Where too little would be left.
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
    """What is done to a profile, in this order; None leaves a step out. Lengths in m.

    A form takes the mean out, again after the trim: a constant means nothing to a film, but it would to a
    cut. ``cutoff_long`` removes the waves longer than it, ``cutoff_short`` the shorter ones; ``trim`` is half
    of the longer of the two where it is not given.
    """

    form: Form = "none"
    cutoff_long: float | None = None
    cutoff_short: float | None = None
    trim: float | None = None
    rescale_rq: float | None = None
    truncate: float | None = None


class Points(Protocol):
    """Heights over equally spaced points: a profile or a map."""

    @property
    def heights(self) -> Array:
        """Heights [m]."""

    def with_heights(self, heights: Array) -> Self:
        """The same points with other heights [m]."""


S = TypeVar("S", bound=Points)


@dataclass(frozen=True)
class Operations(Generic[S]):
    """What the steps do to profiles or to maps: form removal, Gaussian filter, trim."""

    without_form: Callable[[S, Form], S]
    waviness: Callable[[S, float], S]
    trimmed: Callable[[S, float], S]


def rms(heights: Array) -> float:
    """Root mean square of heights about their mean [m]: Rq of a profile, Sq of a map."""
    return float(np.sqrt(np.mean((heights - np.mean(heights)) ** 2)))


def in_order(first: S, steps: Processing, do: Operations[S]) -> list[tuple[str, S]]:
    """A profile or map after every step of ``processed``, by the operations that fit it."""
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
    """A profile after every step, with what the step was; the first is the profile as it came.

    Parameters
    ----------
    profile : Profile
        As read or generated.
    steps : Processing
        What to do.

    Returns
    -------
    list of (str, Profile)
        Descriptions and profiles, in order.

    Raises
    ------
    InputError
        Where a step cannot be done.

    Examples
    --------
    >>> import numpy as np
    >>> profile = Profile(1e-7, 1e-8 * np.arange(100.0))
    >>> [name for name, _ in processed(profile, Processing(form="line"))]
    ['as read', 'form: line']
    """
    return in_order(profile, steps, Operations(without_form, waviness, trimmed))
