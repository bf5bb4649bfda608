"""Processes that do not import the script that starts them.

Processes of ``multiprocessing`` do, and a script that solves at its top level would then solve again in each
of them. Only functions and values of packages are handed to them: what a script defines, they cannot import.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing.context import SpawnContext, SpawnProcess
from types import ModuleType

# Two threads that start processes at once would leave the empty module behind, and so would a fork meanwhile.
_START_LOCK = threading.Lock()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(
        before=_START_LOCK.acquire,
        after_in_parent=_START_LOCK.release,
        after_in_child=_START_LOCK.release,
    )


class Process(SpawnProcess):
    """Process whose ``__main__`` is empty."""

    def start(self) -> None:
        """Start the process."""
        with _without_script():
            super().start()


class Context(SpawnContext):
    """Context of such processes for ``concurrent.futures``."""

    Process = Process


@contextmanager
def _without_script() -> Iterator[None]:
    """Context in which ``__main__`` is empty, without the file by which a new process would find the script.

    It lasts some milliseconds, in which other threads cannot pickle what the script defines.
    """
    with _START_LOCK:
        script = sys.modules["__main__"]
        sys.modules["__main__"] = ModuleType("__main__")
        try:
            yield
        finally:
            sys.modules["__main__"] = script
