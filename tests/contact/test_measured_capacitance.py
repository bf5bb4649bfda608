"""Capacitance of a ball on a disc beside the computed one, to which nothing is added."""

import numpy as np
import pytest

from tests.helpers.ball_on_disc import OILS, STEEL, ball_on_disc, capacitances
from tests.helpers.measurements import load

pytestmark = pytest.mark.measured

METER = {"fill": "oil"}


def outside(values, air, oil):
    """Distances by which values lie outside the range from air to oil; negative within it."""
    return np.maximum(air - values, values - oil)


@pytest.mark.parametrize(
    ("nodes", "rows"), [(97, [2]), pytest.param(257, [0, 1, 2, 3], marks=pytest.mark.slow)]
)
def test_ball_on_steel(nodes, rows):
    """Both set-ups lie between a gap that is filled with air and one filled with oil, within 0.5 pF."""
    reference = load("ball_on_steel_capacitance")
    oil_at = {"temperature": "40 degC", "nodes": nodes}
    case = ball_on_disc(OILS["fva3_library"], disc=STEEL, meter=METER, **oil_at)
    _, air, oil = capacitances(case, reference.column("speed")[rows])
    assert np.all(oil - air > 3.0)
    for setup in ("setup_1", "setup_2"):
        assert np.max(outside(reference.column(setup)[rows], air, oil)) < 0.5


@pytest.mark.slow
def test_capacitance_over_the_film():
    """From 60 nm on between air and oil, within the scatter of 1.5 pF; thinner films have less than computed.

    At 25 nm they have 11 % less than with air around the film. A zero of the optics of 2 nm, as a rig of the
    same maker logged it, explains half of it, and one of 3 nm all.
    """
    reference = load("chromium_disc_capacitance")
    case = ball_on_disc(OILS["pao4"], nodes=257, meter=METER)
    film, air, oil = capacitances(case, (0.07, 0.13, 0.25, 0.6, 2.4))

    def beyond(zero, least):
        """Distances outside the range [pF], and the same over the capacitance."""
        measured, capacitance = reference.column("film"), reference.column("capacitance")
        kept = measured > least
        at = np.log(measured[kept] + zero)
        between = [np.exp(np.interp(at, np.log(film), np.log(part))) for part in (air, oil)]
        away = outside(capacitance[kept], *between)
        return np.max(away), np.max(away / capacitance[kept])

    assert beyond(0.0, 60.0)[0] < 1.5
    assert 0.08 < beyond(0.0, 24.0)[1] < 0.14
    assert beyond(2.0, 24.0)[1] < 0.06
    assert beyond(3.0, 24.0)[0] < 1.5
