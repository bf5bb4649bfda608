"""Messages of browsers that are none of the protocol, such as those of a scanner: one line of the log each.

The libraries behind the pages write a traceback for each of them, by which anybody could fill the log and
hide the faults of the program. These faults keep their traceback.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator
from pathlib import PurePath
from types import TracebackType

from ehlectric.errors import printable

# Loggers that tell of an error in a message, and packages that read messages.
_LOGGERS = ("asyncio", "uvicorn.error", "engineio.server", "socketio.server")
_READERS = ("engineio", "socketio")
_PROGRAM = __name__.partition(".")[0]

# Longest text of an error that is told, since it may quote the message [characters].
_LONGEST = 200


def tell_in_one_line() -> None:
    """Let the loggers of the server tell of a message that cannot be read in one line."""
    for name in _LOGGERS:
        logger = logging.getLogger(name)
        if not any(isinstance(each, _OneLine) for each in logger.filters):
            logger.addFilter(_OneLine())


class _OneLine(logging.Filter):
    """Filter that shortens records of errors in messages, and passes all records on."""

    def filter(self, record: logging.LogRecord) -> bool:
        """Shorten a record where its error is one of a message."""
        error = record.exc_info[1] if record.exc_info else None
        if error is not None and _is_of_a_message(error.__traceback__):
            text = printable(" ".join(f"{type(error).__name__}: {error}".split()))[:_LONGEST]
            record.msg, record.args = "a message of a browser cannot be read: %s", (text,)
            record.exc_info = record.exc_text = None
        return True


def _is_of_a_message(trace: TracebackType | None) -> bool:
    """Whether an error was raised where a message is read, and not in the code of the pages behind it."""
    found = False
    for path in _paths(trace):
        if path.parent.name in _READERS:
            found = True
        elif _PROGRAM in path.parts:
            # What guards requests comes before the message is read, and the pages come after.
            found = False
    return found


def _paths(trace: TracebackType | None) -> Iterator[PurePath]:
    """Files of a traceback, the outermost first."""
    while trace is not None:
        yield PurePath(trace.tb_frame.f_code.co_filename)
        trace = trace.tb_next
