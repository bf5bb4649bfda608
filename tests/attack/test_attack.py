"""No input makes a command break, hang or write elsewhere, and no kill loses or mixes results.

The seed is fixed, and each run takes a twentieth of the inputs and a tenth of the kills: ``make thorough``
takes all. ``python -m tests.attack --seed N --hours H`` draws others.
"""

from itertools import chain

import pytest

from tests.attack.attack import attack
from tests.attack.inputs import KINDS
from tests.attack.kills import SCENARIOS, kill
from tests.attack.runner import Runner
from tests.attack.stock import make
from tests.helpers.share import share, share_of

SEED = 20

# Inputs of a test, all of them: two workers share the tests.
BATCH = 250

# Parts of the inputs, and of the kills, that a run takes.
INPUTS, KILLS = 20, 10


@pytest.fixture(scope="session")
def runner(tmp_path_factory):
    with Runner(tmp_path_factory.mktemp("runner")) as server:
        yield server


@pytest.fixture(scope="session")
def stock(tmp_path_factory, runner):
    return make(tmp_path_factory.mktemp("stock") / "stock", runner)


BATCHES = list(
    chain.from_iterable(
        ((kind, start, min(start + BATCH, of.count)) for start in range(0, of.count, BATCH))
        for kind, of in KINDS.items()
    )
)


def test_the_attack_has_five_thousand_inputs():
    assert sum(end - start for _, start, end in BATCHES) == 5000


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "start", "end"), BATCHES)
def test_mutated_inputs(kind, start, end, stock, runner, tmp_path, record_property):
    numbers = share(range(start, end), INPUTS)
    report = attack(kind, numbers, SEED, stock, tmp_path, runner)
    record_property("attack", str(report))
    assert report.inputs == len(numbers)
    assert not report.faults


@pytest.mark.slow
@pytest.mark.parametrize("command", SCENARIOS)
def test_kills(command, stock, runner, tmp_path, record_property):
    kills = share_of(SCENARIOS[command].kills, KILLS)
    report = kill(command, kills, SEED, stock, tmp_path, runner)
    record_property("attack", str(report))
    assert report.inputs >= kills // 2
    assert not report.faults
