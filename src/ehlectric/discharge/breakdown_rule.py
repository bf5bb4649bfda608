"""The rule of every answer about breakdown: probability, level and code of a verdict.

Breakdown is a margin below 1, or surfaces that touch. Its probability is the share of the points within what
is uncertain at which a bearing breaks down. A point without a result may lie on either side: the probability
then lies between two bounds, and the level follows these bounds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from ehlectric.arrays import Array
from ehlectric.quantities.statement import Level, Statement
from ehlectric.quantities.verdict_texts import statement_text

# Probabilities of breakdown below which it is not expected, below which it is possible, and above which it is
# expected; between the last two it is likely. The first one is also the probability at which a voltage of a
# Weibull law counts as safe.
UNLIKELY, EVEN, CERTAIN = 0.05, 0.5, 0.95

# Probabilities of the ends of the interval of the margin that is stated, and of its middle.
INTERVAL = (UNLIKELY, EVEN, CERTAIN)

# Part of a dielectric strength by which it may be wrong either way where no range of it is stated:
# engineering judgement.
STRENGTH_UNKNOWN = 0.2

# Standard deviations of a normal distribution within which the sampling error is at a confidence of 95 %.
_CONFIDENCE = 1.959963984540054

# Codes of a verdict. The first one is of the level "green", the last one "red", and those between "yellow".
EXCLUDED, POSSIBLE, LIKELY, EXPECTED = (
    "breakdown-excluded",
    "breakdown-possible",
    "breakdown-likely",
    "breakdown-expected",
)
# Codes where the computed margin is safe: something that the probability does not contain may lower it, or
# surfaces touch at times and discharge as they part.
UNKNOWN, DRIVE_UNKNOWN, TOUCHING_AT_TIMES = (
    "breakdown-unknown",
    "discharges-unknown",
    "discharges-possible",
)
# Codes where surfaces touch and no voltage is computed: above the largest probability, and without one.
TOUCHING_EXPECTED, TOUCHING = "discharges-expected", "discharges-likely"


def level_of(low: float, high: float) -> Level:
    """Level of a verdict from the smallest and the largest margin that are possible.

    Examples
    --------
    >>> level_of(1.1, 1.5), level_of(0.8, 1.5), level_of(0.5, 0.8)
    ('green', 'yellow', 'red')
    """
    return "green" if low >= 1.0 else "red" if high < 1.0 else "yellow"


def code_of(level: Level, *, likely: bool) -> str:
    """Code of a verdict with this level; ``likely``, whether breakdown is likelier than none."""
    if level == "yellow":
        return LIKELY if likely else POSSIBLE
    return EXCLUDED if level == "green" else EXPECTED


def doubted(
    level: Level, code: str, *, doubts: bool, touching: bool = False, drive: bool = False
) -> tuple[Level, str]:
    """Level and code of a verdict with what its margin does not contain.

    ``doubts``, whether something may lower the margin that neither its interval nor its probability
    contains; ``touching``, whether surfaces touch at times; ``drive``, whether the verdict is about the
    discharges of a drive. Doubts and touching surfaces change a green verdict only: the code of another one
    also holds for a larger probability.

    Examples
    --------
    >>> doubted("green", EXCLUDED, doubts=True)
    ('yellow', 'breakdown-unknown')
    >>> doubted("yellow", LIKELY, doubts=True)
    ('yellow', 'breakdown-likely')
    """
    if level != "green" or not (doubts or touching):
        return level, code
    if touching:
        return "yellow", TOUCHING_AT_TIMES
    return "yellow", DRIVE_UNKNOWN if drive else UNKNOWN


def strength_interval(margin: float) -> tuple[float, float]:
    """Margins at the smallest and the largest strength that is possible where no range of it is stated.

    Every breakdown voltage is proportional to the strength.
    """
    return (1.0 - STRENGTH_UNKNOWN) * margin, (1.0 + STRENGTH_UNKNOWN) * margin


def sampling_error(probability: float, number: int) -> float:
    """Return half of Wilson's interval for a share of random points, at a confidence of 95 %.

    Examples
    --------
    >>> round(sampling_error(0.5, 2048), 4), round(sampling_error(0.0, 2048), 4)
    (0.0216, 0.0009)
    """
    z2 = _CONFIDENCE**2 / number
    return math.sqrt(probability * (1.0 - probability) * z2 + 0.25 * z2**2) / (1.0 + z2)


def share_interval(share: float, number: int) -> tuple[float, float]:
    """Return Wilson's interval for a share of random points, at a confidence of 95 %.

    Examples
    --------
    >>> [round(end, 4) for end in share_interval(0.05, 512)]
    [0.0342, 0.0725]
    """
    z2 = _CONFIDENCE**2 / number
    middle, error = (share + 0.5 * z2) / (1.0 + z2), sampling_error(share, number)
    return max(0.0, middle - error), min(1.0, middle + error)


# Sampling errors of the margin, as part of it, above which a statement contains no interval, and no number.
_ROUGH, _VAGUE = 0.2, 0.5


def _margin_error(*quantiles: tuple[Array, float]) -> float:
    """Largest relative sampling error of quantiles of margins, at a confidence of 95 %.

    ``share_interval`` has two ends. The error is half the distance between the margins at both ends, divided
    by their mean. ``quantiles``, margins and probability of each.
    """
    errors = []
    for margins, probability in quantiles:
        ends = share_interval(probability, margins.size)
        low, high = (float(np.quantile(margins, end, method="higher")) for end in ends)
        # Both ends may be 0 or infinite, and the quantile then has no error.
        errors.append(0.0 if low == high else 1.0 - 2.0 * low / (low + high))
    return max(errors)


@dataclass(frozen=True)
class Chance:
    """Probability of breakdown within the uncertain inputs, and the inputs that spread it most."""

    probability: float  # of the points that have a result
    error: float  # sampling error of the probability
    # low, median and high: margin at 5 %, 50 % and 95 %, dimensionless; 0 where surfaces touch. A point
    # without a result counts as touching in low and median, and as infinite in high.
    low: float
    median: float
    high: float
    # Largest sampling error of low, median and high, part of their value.
    margin_error: float = 0.0
    # Name of the input that spreads the margin most, and its share of the variance of the logarithm of the
    # margin; empty for an immediate estimate, which neglects inputs that change the films.
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
        least, most = (np.concatenate([margins, np.full(failed, end)]) for end in (0.0, np.inf))
        low, median, high = np.quantile(least, INTERVAL).tolist()
        if failed:
            # No value lies between a margin and an infinite one.
            high = float(np.quantile(most, CERTAIN, method="higher"))
        error = sampling_error(probability, margins.size)
        margin_error = _margin_error((least, UNLIKELY), (least, EVEN), (most, CERTAIN))
        others |= {"samples": least.size, "failed": failed}
        return cls(probability, error, low, median, high, margin_error, **others)

    @property
    def bounds(self) -> tuple[float, float]:
        """Smallest and largest probability that points without a result allow."""
        return bounds_of(self.probability, self.samples, self.failed)

    def is_settled(self, *, touching: bool) -> bool:
        """Whether the level stays the same within the sampling error. ``touching``, whether the level follows
        ``touching_rule``.

        Examples
        --------
        >>> margins = np.repeat([0.5, 1.5], [20, 492])
        >>> Chance.of(margins).is_settled(touching=False), Chance.of(margins[10:]).is_settled(touching=False)
        (False, True)
        """
        low, high = (share_interval(bound, self.samples) for bound in self.bounds)
        limits = [(low, CERTAIN)] if touching else [(high, UNLIKELY), (low, CERTAIN)]
        return all(limit < least or limit > most for (least, most), limit in limits)

    @property
    def level(self) -> Level:
        """Level of a verdict by the bounds of the probability."""
        low, high = self.bounds
        if high < UNLIKELY:
            return "green"
        return "red" if low > CERTAIN else "yellow"

    @property
    def code(self) -> str:
        """Code of a verdict by the bounds of the probability."""
        return code_of(self.level, likely=self.bounds[0] > EVEN)

    @property
    def text(self) -> str:
        """Probability as text: with its sampling error, or between its bounds."""
        return statement_text(self.stated)

    @property
    def brief(self) -> str:
        """Probability as text without its sampling error."""
        return self.text.partition(" (")[0]

    @property
    def stated(self) -> Statement:
        """Clause with the probability: with its sampling error, or between its bounds."""
        if self.failed:
            return Statement.of("chance-between", pair=self.bounds)
        return Statement.of("chance", pair=(self.probability, self.error))

    def statements(self, *, doubts: bool = False) -> tuple[Statement, ...]:
        """Statements on the probability with the interval of the margin, and on the input to measure first.

        ``doubts``, whether they say that the probability does not contain the doubts stated before. An
        estimate at once has a statement that the probability follows.

        Examples
        --------
        >>> chance = Chance(0.163, 0.032, 0.783, 1.474, 3.0, 0.06, "rotor capacitance", 0.567)
        >>> [one.code for one in chance.statements()]
        ['probability', 'measure-first']
        """
        if not self.first:
            return (Statement.of("probability-follows"),)
        without = Statement.of("without-doubts") if doubts else None
        about: dict[str, Any] = {
            "low": self.low,
            "median": self.median,
            "high": self.high,
            "off": self.margin_error,
        }
        if self.failed:
            about = {"failed": self.failed, "samples": self.samples}
        # The margin is 0 where surfaces touch.
        touch = not self.failed and self.high == 0.0
        return (
            Statement.of("probability-of-touching", probability=self.stated)
            if touch
            else Statement.of(self._code, probability=self.stated, doubts=without, **about),
            Statement.of(
                "measure-first-at-others" if self.failed else "measure-first",
                first=self.first,
                share=self.share,
            ),
        )

    @property
    def _code(self) -> str:
        """Code of the statement on the probability, with an interval or a bound of the margin, or without."""
        if self.failed:
            return "probability-between"
        # An infinite margin is no number: nothing breaks down there.
        finite = self.low < math.inf if math.isinf(self.high) else True
        if not finite or self.margin_error > _VAGUE or (self.low == 0.0 and math.isinf(self.high)):
            return "probability-only"
        if math.isinf(self.high):
            return "probability-above"
        return "probability-rough" if self.margin_error > _ROUGH else "probability"


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
    """Level and code of a verdict on surfaces that touch, for which no voltage is computed.

    Contacts that open discharge at any voltage. ``chance``, probability of breakdown, which counts touching
    surfaces; with the limits of all verdicts. None without one: then the verdict is red if the bearing
    is ``driven`` by a motor.

    Examples
    --------
    >>> touching_rule(None, driven=True), touching_rule(Chance.of(np.array([0.0, 1.2])), driven=True)
    (('red', 'discharges-likely'), ('yellow', 'discharges-possible'))
    """
    if chance is None:
        return "red" if driven else "yellow", TOUCHING
    least, _ = chance.bounds
    if least <= EVEN:
        return "yellow", TOUCHING_AT_TIMES
    return ("red", TOUCHING_EXPECTED) if least > CERTAIN else ("yellow", TOUCHING)
