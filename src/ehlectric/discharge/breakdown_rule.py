"""The rule of every answer about breakdown: probability, level and first words of a verdict.

Breakdown is a margin below 1, or surfaces that touch. Its probability is the share of the points within what
is uncertain at which a bearing breaks down. A point without a result may lie on either side: the probability
then lies between two bounds, and the level follows these bounds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal, Self

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.readable import readable

# "green": no breakdown expected; "yellow": breakdown possible within what is uncertain; "red": breakdown
# expected, or surfaces that touch under a voltage; "grey": nothing to compare the breakdown voltage with.
Level = Literal["green", "yellow", "red", "grey"]

# Probabilities of breakdown below which it is not expected, below which it is possible, and above which it is
# expected; between the last two it is likely. The first one also is that at which a voltage of a Weibull law
# counts as safe.
UNLIKELY, EVEN, CERTAIN = 0.05, 0.5, 0.95

# Probabilities of the ends of the interval of the margin that is stated, and of its middle.
INTERVAL = (UNLIKELY, EVEN, CERTAIN)

# Part of a dielectric strength by which it may be wrong either way where no range of it is stated:
# engineering judgement.
STRENGTH_UNKNOWN = 0.2

# Standard deviations of a normal distribution within which the sampling error is at a confidence of 95 %.
_CONFIDENCE = 1.959963984540054

# First words of a verdict. All levels except the first and the last are "yellow".
EXCLUDED, POSSIBLE, LIKELY, EXPECTED = (
    "No breakdown expected",
    "Breakdown possible",
    "Breakdown likely",
    "Breakdown expected",
)
# First words where the computed margin is safe: something that the probability does not contain may lower it,
# or surfaces touch at times and discharge as they part.
UNKNOWN, DRIVE_UNKNOWN, TOUCHING_AT_TIMES = (
    "Breakdown not known",
    "Discharges not known",
    "Discharges possible",
)
# First words where surfaces touch and no voltage is computed: above the largest probability, and without one.
TOUCHING_EXPECTED, TOUCHING = "Discharges expected", "Discharges likely"


def level_of(low: float, high: float) -> Level:
    """Level of a verdict from the smallest and the largest margin that are possible.

    Examples
    --------
    >>> level_of(1.1, 1.5), level_of(0.8, 1.5), level_of(0.5, 0.8)
    ('green', 'yellow', 'red')
    """
    return "green" if low >= 1.0 else "red" if high < 1.0 else "yellow"


def lead_of(level: Level, *, likely: bool) -> str:
    """First words of a verdict with this level; ``likely``, whether breakdown is likelier than none."""
    if level == "yellow":
        return LIKELY if likely else POSSIBLE
    return EXCLUDED if level == "green" else EXPECTED


def doubted(
    level: Level, lead: str, *, doubts: bool, touching: bool = False, drive: bool = False
) -> tuple[Level, str]:
    """Level and first words of a verdict with what its margin does not contain.

    ``doubts``, whether something may lower the margin that neither its interval nor its probability
    contains; ``touching``, whether surfaces touch at times; ``drive``, whether the verdict is about the
    discharges of a drive. Doubts and touching surfaces change a green verdict only: the words of another one
    also hold for a larger probability.

    Examples
    --------
    >>> doubted("green", EXCLUDED, doubts=True)
    ('yellow', 'Breakdown not known')
    >>> doubted("yellow", LIKELY, doubts=True)
    ('yellow', 'Breakdown likely')
    """
    if level != "green" or not (doubts or touching):
        return level, lead
    if touching:
        return "yellow", TOUCHING_AT_TIMES
    return "yellow", DRIVE_UNKNOWN if drive else UNKNOWN


def strength_interval(margin: float) -> tuple[float, float]:
    """Margins at the smallest and the largest strength that is possible where no range of it is stated.

    Every breakdown voltage is proportional to the strength.
    """
    return (1.0 - STRENGTH_UNKNOWN) * margin, (1.0 + STRENGTH_UNKNOWN) * margin


def sampling_error(probability: float, number: int) -> float:
    """Half of Wilson's interval of a share of random points at a confidence of 95 %.

    Examples
    --------
    >>> round(sampling_error(0.5, 2048), 4), round(sampling_error(0.0, 2048), 4)
    (0.0216, 0.0009)
    """
    z2 = _CONFIDENCE**2 / number
    return math.sqrt(probability * (1.0 - probability) * z2 + 0.25 * z2**2) / (1.0 + z2)


# Sentence in place of the probability where only an estimate of it at once is known.
PROBABILITY_FOLLOWS = "The probability of breakdown follows."


@dataclass(frozen=True)
class Chance:
    """Probability of breakdown within what is uncertain, and what makes it so."""

    probability: float  # of the points that have a result
    error: float  # sampling error of the probability
    # low, median and high: margin at 5 %, 50 % and 95 %, dimensionless; 0 where surfaces touch. A point
    # without a result counts as touching in low and median, and as infinite in high.
    low: float
    median: float
    high: float
    # Name of the input that spreads the margin most, and its share of the variance of the logarithm of the
    # margin; empty for an estimate at once, which leaves out what changes the films.
    first: str = ""
    share: float = 0.0
    samples: int = 0  # number of points
    failed: int = 0  # number of points without a result
    neglected: tuple[str, ...] = ()  # ranges that are not in the probability, and why

    @classmethod
    def of(cls, margins: Array, failed: int = 0, **others: Any) -> Self:
        """Chance of a breakdown from the margins of the points with a result, shape (n,), 0 where surfaces
        touch, and the number of points without one. ``others``, further fields.

        Examples
        --------
        >>> chance = Chance.of(np.array([0.5, 1.5, 1.6, 1.7]), failed=4)
        >>> chance.probability, chance.bounds, chance.high
        (0.25, (0.125, 0.625), inf)
        """
        probability = float(np.mean(margins < 1.0))
        least = np.concatenate([np.zeros(failed), margins])
        low, median, high = np.quantile(least, INTERVAL).tolist()
        if failed:
            # No value lies between a margin and an infinite one.
            most = np.concatenate([margins, np.full(failed, np.inf)])
            high = float(np.quantile(most, CERTAIN, method="higher"))
        error = sampling_error(probability, margins.size)
        samples = margins.size + failed
        return cls(probability, error, low, median, high, samples=samples, failed=failed, **others)

    @property
    def bounds(self) -> tuple[float, float]:
        """Smallest and largest probability that points without a result allow."""
        return bounds_of(self.probability, self.samples, self.failed)

    @property
    def level(self) -> Level:
        """Level of a verdict by the bounds of the probability."""
        low, high = self.bounds
        if high < UNLIKELY:
            return "green"
        return "red" if low > CERTAIN else "yellow"

    @property
    def lead(self) -> str:
        """First words of a verdict by the bounds of the probability."""
        return lead_of(self.level, likely=self.bounds[0] > EVEN)

    @property
    def text(self) -> str:
        """Probability as text: with its sampling error, or between its bounds."""
        if self.failed:
            return bounds_text(*self.bounds)
        return chance_text(self.probability, self.error)

    @property
    def sentence(self) -> str:
        """Sentences about the probability, the interval of the margin, and the input to measure first.

        Examples
        --------
        >>> Chance(0.163, 0.016, 0.783, 1.474, 3.0, "rotor capacitance", 0.567).sentence
        'The probability of breakdown is 16 % (sampling error 1.6 %): within what is uncertain the margin is \
0.78 to 3.00 in 90 of 100 cases, 1.47 in the middle. Measure first: rotor capacitance, 57 % of the spread.'
        >>> print(Chance.of(np.array([0.5, 1.5]), failed=6, first="temperature", share=0.6).sentence)
        The probability of breakdown is between 12 and 88 %: 6 of 8 points within what is uncertain have no \
result. Measure first: temperature, 60 % of the spread at the other points.
        """
        return self.sentence_with(doubts=False)

    def sentence_with(self, *, doubts: bool) -> str:
        """Sentences as ``sentence``, which say that the probability does not contain the ``doubts``."""
        if not self.first:
            return PROBABILITY_FOLLOWS
        of_known = " at the other points" if self.failed else ""
        without = ", which does not contain this," if doubts else ""
        return (
            f"The probability of breakdown{without} is {self.text}: {self._margins}. "
            f"Measure first: {self.first}, {100.0 * self.share:.0f} % of the spread{of_known}."
        )

    @property
    def _margins(self) -> str:
        """Clause about the margins, or about the points without one."""
        if self.failed:
            return f"{self.failed} of {self.samples} points within what is uncertain have no result"
        low, median, high = map(ratio_text, (self.low, self.median, self.high))
        interval = f"the margin is {low} to {high} in 90 of 100 cases, {median} in the middle"
        return f"within what is uncertain {interval}"


def bounds_of(share: float, samples: int, failed: int) -> tuple[float, float]:
    """Smallest and largest share of all points, from the share of the points with a result.

    Examples
    --------
    >>> bounds_of(0.5, 100, 20)
    (0.4, 0.6)
    """
    known = 1.0 - failed / samples if failed else 1.0
    return share * known, 1.0 - (1.0 - share) * known


def touching_rule(chance: Chance | None, *, driven: bool) -> tuple[Level, str]:
    """Level and first words of a verdict on surfaces that touch, for which no voltage is computed.

    Contacts that open discharge at any voltage: such a verdict is red as soon as breakdown is likely.
    ``chance``, probability of breakdown, which counts touching surfaces; None without one: then the verdict
    is red if the bearing is ``driven`` by a motor.

    Examples
    --------
    >>> touching_rule(None, driven=True), touching_rule(Chance.of(np.array([0.0, 1.2])), driven=True)
    (('red', 'Discharges likely'), ('yellow', 'Discharges possible'))
    """
    if chance is None:
        return "red" if driven else "yellow", TOUCHING
    least, _ = chance.bounds
    if least <= EVEN:
        return "yellow", TOUCHING_AT_TIMES
    return "red", TOUCHING_EXPECTED if least > CERTAIN else TOUCHING


def at_an_end(probability: float, error: float) -> bool:
    """Whether a probability differs from 0 or from 1 by less than its sampling error."""
    return min(probability, 1.0 - probability) < error


def chance_text(probability: float, error: float) -> str:
    """Probability with its sampling error as text.

    Examples
    --------
    >>> chance_text(0.163, 0.016), chance_text(0.0, 0.0009), chance_text(1.0, 0.0009)
    ('16 % (sampling error 1.6 %)', 'below 0.09 %', 'above 99.9 %')
    """
    if not at_an_end(probability, error):
        return f"{readable(100.0 * probability, 2)} % (sampling error {readable(100.0 * error, 2)} %)"
    if probability < error:
        return f"below {readable(100.0 * (probability + error), 1)} %"
    return f"above {readable(100.0 * (probability - error))} %"


# Difference of the bounds of a probability below which they are one number.
ONE_NUMBER = 1e-9


def mean_text(probability: float, low: float, high: float) -> str:
    """Mean probability as text, or its bounds if points without a result leave it open.

    Examples
    --------
    >>> mean_text(0.694, 0.694, 0.694), mean_text(0.5, 0.165, 0.5664)
    ('69 %', 'between 16 and 57 %')
    """
    return f"{readable(100.0 * probability, 2)} %" if high - low < ONE_NUMBER else bounds_text(low, high)


def bounds_text(low: float, high: float) -> str:
    """Probability between bounds as text.

    Examples
    --------
    >>> bounds_text(0.165, 0.5664)
    'between 16 and 57 %'
    """
    return f"between {readable(100.0 * low, 2)} and {readable(100.0 * high, 2)} %"


def ratio_text(ratio: Numbers) -> str:
    """Ratio as text with two digits behind the point; more where it would be rounded to 1.

    Examples
    --------
    >>> ratio_text(1.4432), ratio_text(0.9981), ratio_text(0.0123), ratio_text(2345.6)
    ('1.44', '0.9981', '0.012', '2300')
    """
    if not 0.1 <= ratio < 100.0:
        return readable(ratio, 2)
    text = f"{ratio:.2f}"
    return readable(ratio, 4) if text == "1.00" else text
