"""Estimate of the time that a job still takes, from the rate of its progress."""

from __future__ import annotations

from dataclasses import dataclass

# Time after which a rate is known well enough to be told [s].
_SOON = 3.0


@dataclass
class Remaining:
    """Estimate for the part of a job that is under way.

    Attributes
    ----------
    text : str
        Name of the part.
    of, done : int
        Steps of the part, and those done when it was first seen, as of a job that is resumed.
    since : float
        Time at which it was first seen [s].

    Examples
    --------
    >>> left = Remaining()
    >>> left.told("time steps", 0, 200, now=0.0), left.told("time steps", 50, 200, now=60.0)
    ('', 'about 3 min left')
    >>> left.told("drawing", 1, 2, now=61.0)
    ''
    """

    text: str = ""
    of: int = 0
    done: int = 0
    since: float = 0.0

    def told(self, text: str, done: int, of: int, *, now: float) -> str:
        """Words about the time that is left; empty where it is not known yet."""
        if (text, of) != (self.text, self.of) or done < self.done:
            self.text, self.of, self.done, self.since = text, of, done, now
        gone = now - self.since
        if not of or done <= self.done or gone < _SOON:
            return ""
        left = gone * (of - done) / (done - self.done)
        if left < 60.0:
            return f"about {max(1.0, left):.0f} s left"
        return f"about {left / 60.0:.0f} min left"
