"""No input makes a command break, hang or write elsewhere, and no kill loses or mixes results.

The seed is fixed. ``python -m tests.attack --seed N --hours H`` draws others.
"""

from itertools import chain

import pytest

from tests.attack.attack import attack
from tests.attack.inputs import KINDS
from tests.attack.kills import SCENARIOS, kill
from tests.attack.runner import Runner
from tests.attack.stock import make

SEED = 20

# Inputs of a test: two workers share them.
BATCH = 250


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
    report = attack(kind, range(start, end), SEED, stock, tmp_path, runner)
    record_property("attack", str(report))
    assert report.inputs == end - start
    assert not report.faults


@pytest.mark.slow
@pytest.mark.parametrize("command", SCENARIOS)
def test_kills(command, stock, runner, tmp_path, record_property):
    report = kill(command, SCENARIOS[command].kills, SEED, stock, tmp_path, runner)
    record_property("attack", str(report))
    assert report.inputs >= SCENARIOS[command].kills // 2
    assert not report.faults
