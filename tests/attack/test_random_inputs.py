"""Random files of every kind: no traceback, no word where a number stands, no film thicker than its room, and
one reason by ``check`` and by the command. Each run takes 40 valid files of a kind, ``make thorough`` 200.
"""

import numpy as np
import pytest

from ehlectric.bearing import uncertainty
from ehlectric.drive import drive_cycle
from tests.attack.random_inputs import NOT_VALID, drawn, faults
from tests.helpers.full_cases import OF_DUTY
from tests.helpers.input_effects import MODELS
from tests.helpers.share import share_of

SEED = 23

# Valid files of each kind, and the part of them that a run takes.
FILES, PART = 200, 5

# Least share of the valid files that are solved, so that the test is one of answers.
SOLVED = 0.25


@pytest.mark.slow
@pytest.mark.parametrize("kinds", [*([kind] for kind in MODELS), OF_DUTY], ids=[*MODELS, "duty"])
def test_answers_are_numbers_or_reasons(kinds, tmp_path, monkeypatch):
    monkeypatch.setattr(drive_cycle, "SIMULATED", 4)
    monkeypatch.setattr(uncertainty, "STAGES", (128,))
    outcomes, wrong = [], {}
    for number in range(50 * FILES):
        kind = kinds[number % len(kinds)]
        found, outcome = faults(kind, drawn(kind, np.random.default_rng([SEED, number])), tmp_path)
        outcomes += [] if outcome == NOT_VALID else [outcome]
        if found:
            wrong[number] = found
        if len(outcomes) == share_of(FILES, PART):
            break
    assert wrong == {}
    assert outcomes.count("solved") >= SOLVED * share_of(FILES, PART), outcomes
