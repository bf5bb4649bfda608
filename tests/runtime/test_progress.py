"""Time that is left of a job: it is shown only as long as it can be right."""

import io

import pytest
from rich.console import Console
from rich.progress import Progress

from ehlectric.commands import terminal
from ehlectric.runtime.progress import Remaining


def test_the_time_counts_down_and_is_withdrawn_when_it_is_over():
    """A bearing whose last contact takes 70 s, after eleven of 2 s each."""
    left = Remaining()
    left.step(0, 12, now=0.0)
    for done in range(1, 12):
        left.step(done, 12, now=2.0 * done)
    assert left.seconds(now=22.0) == pytest.approx(2.0)
    assert left.seconds(now=23.5) == pytest.approx(0.5)
    assert all(left.seconds(now=22.0 + wait) is None for wait in (2.0, 10.0, 69.0))
    left.step(12, 12, now=92.0)
    assert left.seconds(now=92.0) is None


def test_another_part_has_its_own_time():
    """Drawing of ten figures, after a hundred solutions of 0.1 s each."""
    left = Remaining()
    for done in range(101):
        left.step(done, 100, now=0.1 * done)
    left.step(0, 10, now=10.0)
    assert left.seconds(now=12.0) is None
    left.step(1, 10, now=17.0)
    assert left.seconds(now=17.0) == pytest.approx(63.0)
    # A part without a number of steps has no time.
    left.step(0, 0, now=18.0)
    assert left.seconds(now=80.0) is None


def test_a_job_that_is_resumed_counts_its_own_steps():
    left = Remaining()
    left.step(150, 200, now=0.0)
    left.step(160, 200, now=20.0)
    assert left.seconds(now=20.0) == pytest.approx(80.0)


def test_the_bar_forgets_the_rate_of_the_part_before(monkeypatch):
    """The bar said "0:00:02" for all of the time in which figures were drawn, whose number is not told."""
    now = [0.0]
    monkeypatch.setattr(terminal.time, "monotonic", lambda: now[0])
    bar = Progress(console=Console(file=io.StringIO()), get_time=lambda: now[0])
    show = terminal.parted(bar)
    for done in range(8):
        now[0] = 2.0 * done
        show(done, 8, "contacts")
    assert str(bar.tasks[0].fields["left"]) == "0:00:02 left"
    show(0, 0, "drawing figures")
    for wait in (0.0, 1.0, 70.0):
        now[0] = 14.0 + wait
        (task,) = bar.tasks
        assert (task.description, task.total, task.time_remaining) == ("drawing figures", None, None)
        assert str(task.fields["left"]) == ""
