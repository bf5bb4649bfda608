"""A dent that moves through a ball contact, measured by interferometry, against the transient film."""

import numpy as np
import pytest

from tests.motion.microdent import DENTS, MICRO, OPTICS_END, at, measured, passage

pytestmark = [pytest.mark.measured, pytest.mark.slow]


@pytest.fixture(scope="module")
def passed(tmp_path_factory):
    """Measured and computed profiles of each dent, computed once."""

    def solved(name):
        if name not in films:
            films[name] = passage(DENTS[name], tmp_path_factory.mktemp(name), nodes=129)
        x, middle, film = films[name]
        return [
            (place, h, dent, x, film[0] if dent is None else at(middle, film, dent))
            for place, h, dent in measured(name)
        ]

    films = {}
    return solved


def beside(x, film, dent, clear):
    """Positions in the Hertz zone at which a film is measured, farther from the dent than ``clear`` [µm]."""
    kept = (np.abs(x) < 110.0) & (film < OPTICS_END)
    return kept if dent is None else kept & (np.abs(x - dent) > clear)


def front(x, film, dent, level=225.0):
    """Position ahead of the dent at which the thick film that it sends ahead ends [µm]."""
    ahead = (x > dent + 22.0) & (x < 125.0)
    x, film = x[ahead], film[ahead]
    after = int(np.argmax(film < level))
    assert after > 0
    return np.interp(level, film[[after, after - 1]], x[[after, after - 1]])


def test_dent_in_pure_rolling(passed):
    """The dent passes without a trace: 10 nm of root mean square beside it."""
    for x, film, dent, at_x, computed in passed("rolling"):
        kept = beside(x, film, dent, 2.0 * DENTS["rolling"].radius / MICRO)
        off = np.interp(x[kept], at_x, computed) - film[kept]
        assert kept.sum() >= 14
        assert np.sqrt(np.mean(off**2)) < 10.5
        assert abs(np.mean(off)) < 10.0


def test_dent_slower_than_the_oil(passed):
    """The dent sends a thick film ahead, which travels at the mean speed, twice as fast as the dent.

    Its end is where it was measured, within 12 µm, and it is as thick within 15 %. Computed films
    show a deeper valley in front of it: three quarters of the measured film, as recorded here.
    """
    profiles = passed("sliding")
    ends = []
    for x, film, dent, at_x, computed in profiles[1:3]:
        ends.append((front(x, film, dent), front(at_x, computed, dent), dent))
        assert ends[-1][1] == pytest.approx(ends[-1][0], abs=12.0)
        ahead, ahead_x = (x > dent + 25.0) & (x < 115.0), (at_x > dent + 25.0) & (at_x < 115.0)
        assert computed[ahead_x].max() == pytest.approx(film[ahead].max(), rel=0.15)
        assert 0.70 < computed[ahead_x].min() / film[ahead].min() < 0.85
    (measured_1, computed_1, dent_1), (measured_2, computed_2, dent_2) = ends
    assert (measured_2 - measured_1) / (dent_2 - dent_1) == pytest.approx(2.0, abs=0.3)
    assert (computed_2 - computed_1) / (dent_2 - dent_1) == pytest.approx(2.0, abs=0.1)


def test_film_behind_the_slow_dent(passed):
    """Behind the dent the film is that of the smooth ball."""
    x, film, dent, at_x, computed = passed("sliding")[4]
    kept = beside(x, film, dent, 1.5 * DENTS["sliding"].radius / MICRO) & (x < dent)
    off = np.interp(x[kept], at_x, computed) - film[kept]
    assert kept.sum() > 30
    assert np.sqrt(np.mean(off**2)) < 15.0
