"""Processes that do not import the script that starts them."""

import sys
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import pytest

from ehlectric.runtime import spawning
from ehlectric.runtime.spawning import Context


@pytest.mark.slow
def test_threads_that_start_processes_at_once_leave_the_script_in_its_place():
    script = sys.modules["__main__"]

    def swap(_number):
        with spawning._without_script():
            return sys.modules["__main__"] is not script

    with ThreadPoolExecutor(8) as threads:
        assert all(threads.map(swap, range(4000)))
    assert sys.modules["__main__"] is script


@pytest.mark.slow
def test_processes_call_functions_of_packages():
    script = sys.modules["__main__"]
    with ProcessPoolExecutor(2, mp_context=Context()) as pool:
        assert list(pool.map(divmod, (7, 9), (2, 4))) == [(3, 1), (2, 1)]
    assert sys.modules["__main__"] is script
