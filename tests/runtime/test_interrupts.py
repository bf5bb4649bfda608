"""Signals that stop the program: held back where they would do harm, ignored where the user says so."""

import os
import signal

import pytest

from ehlectric.runtime.locks import held_back
from ehlectric.runtime.worker_processes import without_interrupts

NUMBERS = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]


@pytest.fixture(params=NUMBERS)
def number(request):
    before = signal.getsignal(request.param)
    yield request.param
    signal.signal(request.param, before)


def test_a_signal_that_comes_meanwhile_is_delivered_at_the_end(number):
    came, before = [], signal.getsignal(signal.SIGINT)
    signal.signal(number, lambda *_: came.append(number))
    with without_interrupts():
        signal.raise_signal(number)
        signal.raise_signal(signal.SIGINT)
        assert came == []
    assert came == [number]
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.parametrize("context", [held_back, without_interrupts])
def test_an_ignored_signal_stays_ignored_also_by_processes_that_are_started(number, context):
    """As after nohup: a handler would be the default again in a new process."""
    signal.signal(number, signal.SIG_IGN)
    with context():
        assert signal.getsignal(number) is signal.SIG_IGN
    os.kill(os.getpid(), number)
    assert signal.getsignal(number) is signal.SIG_IGN
