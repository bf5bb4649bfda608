"""Log of the package by the standard library: the logger ``ehlectric``.

Progress of the solvers has the level INFO for each contact and DEBUG for each step; warnings of results have
the level WARNING. Nothing is printed unless a program asks for it, as with ``logging.basicConfig``. The
logger ``ehlectric.machine`` tells what the machine lacks; the command line prints it.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable

from ehlectric.errors import ResultWarning, printable

LOGGER = logging.getLogger("ehlectric")
LOGGER.addHandler(logging.NullHandler())

MACHINE = LOGGER.getChild("machine")

_LEVELS = {"note": logging.INFO, "warning": logging.WARNING, "severe": logging.WARNING}


def log_warnings(title: str, warnings: Iterable[ResultWarning]) -> None:
    """Log the warnings of a result: notes at the level INFO, the others at WARNING."""
    of = f"{title}: " if title else ""
    for warning in warnings:
        LOGGER.log(_LEVELS[warning.severity], "%s [%s]", printable(f"{of}{warning}"), warning.code)
