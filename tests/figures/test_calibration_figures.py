"""Figure of a calibration: its title, and bars that end within the axes."""

from types import SimpleNamespace

import pytest

from ehlectric.calibration import Compared
from ehlectric.discharge.breakdown_rule import Chance
from ehlectric.figures.calibration_figures import figure
from ehlectric.figures.figure_names import CALIBRATION_FIGURE


def chance(probability, error):
    return Chance(probability, error, 0.5, 0.7, 0.6, 0.06, "temperature", 0.5)


def compared(low, high):
    ends, after = (low, 1.0, high), (0.95, 1.0, 1.05)
    return Compared("capacitance", "F", 0, None, 1.0, 0.03, ends, after, 1.0, 0.0, "", 0.0)


@pytest.fixture
def drawn():
    result = SimpleNamespace(
        title="",
        explained=True,
        inputs=(),
        rows=(compared(0.43, 2.0), compared(0.43, 1.4), compared(0.7, 1.2)),
        before=chance(0.86, 0.02),
        after=chance(1.0, 0.0065),
    )
    return figure(result, CALIBRATION_FIGURE)


def test_bars_end_within_the_axes(drawn):
    axes = drawn.axes[1]
    low, high = axes.get_xlim()
    ends = [(bar.get_x(), bar.get_x() + bar.get_width()) for bar in axes.patches]
    assert len(ends) == 6
    assert all(low < first < last < high for first, last in ends)


def test_title_has_the_bound_of_the_verdict(drawn):
    texts = " ".join(text.get_text() for text in [*drawn.axes[0].texts, drawn.axes[0].title, *drawn.texts])
    texts += drawn.axes[0].get_title(loc="left")
    # A share of 0 with the sampling error 0.0065 is below 1.3 % (Wilson's interval).
    assert "86 % before and above 98.7 % after" in " ".join(texts.split())
