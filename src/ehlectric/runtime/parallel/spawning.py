"""Processes that do not import the script that starts them.

Those of ``multiprocessing`` do, and a script that solves at its top level would then solve again in each of
them. Only functions of packages are called here, so that nothing of the script is needed.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing.context import SpawnContext, SpawnProcess
from types import ModuleType


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
    """Context in which ``__main__`` has no file, by which a new process would find it."""
    script = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = script
