"""A random case has one value, or one reason, in every way of asking for it.

Each run takes a few of 125 cases of each kind, and ``make thorough`` all of them. ``python -m
tests.attack.agreement --seed N`` draws others.
"""

import pytest

from tests.attack.agreement import KINDS_OF_CASES, differences
from tests.helpers.share import share

SEED = 11

# Cases of each kind, and the part of them that a run takes.
CASES, PART = 125, 60


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS_OF_CASES)
def test_every_way_has_one_value(kind, tmp_path):
    for number in share(range(CASES), PART):
        folder = tmp_path / str(number)
        folder.mkdir()
        found, outcome = differences(kind, SEED, number, folder)
        assert found == [], (number, outcome)
