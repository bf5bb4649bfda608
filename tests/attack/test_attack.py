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
from tests.commands.test_drive_command import SHORT
from tests.helpers.gate import gated
from tests.helpers.places import EXAMPLES
from tests.helpers.share import share, share_of

SEED = 20

# Inputs of a test, all of them: two workers share the tests.
BATCH = 250

# Parts of the inputs, of those of a user without a home, and of the kills, that a run takes.
INPUTS, POOR, KILLS = 20, 200, 10


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


@pytest.fixture(scope="module")
def poor(tmp_path_factory):
    with Runner(tmp_path_factory.mktemp("poor"), poor=True) as server:
        yield server


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_a_user_without_a_home_beside_a_thread_that_solves(kind, stock, poor, tmp_path):
    report = attack(kind, share(range(KINDS[kind].count), POOR), SEED, stock, tmp_path, poor)
    assert not report.faults


@pytest.mark.slow
def test_a_drive_of_a_user_without_a_home(poor, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "bearing.toml").write_text((EXAMPLES / "bearing_6208.toml").read_text("utf-8"), "utf-8")
    (tmp_path / "drive.toml").write_text(SHORT)
    for words in (("check", "drive.toml"), ("drive", "drive.toml", "-o", "out")):
        outcome = poor.run(*words, folder=tmp_path)
        assert outcome.status == 0, outcome.err
        assert "Traceback" not in outcome.err


@pytest.mark.slow
@pytest.mark.parametrize("command", gated(SCENARIOS, "run", "sweep"))
def test_kills(command, stock, runner, tmp_path, record_property):
    kills = share_of(SCENARIOS[command].kills, KILLS)
    report = kill(command, kills, SEED, stock, tmp_path, runner)
    record_property("attack", str(report))
    assert report.inputs >= kills // 2
    assert not report.faults
