"""A Dask cluster that solves the points of a sweep: connected to by the address of its scheduler."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress

from ehlectric.errors import InputError, shown
from ehlectric.sweep_engine import Crew, crew_of

# What an address has to answer, and the client to come back to a scheduler that is lost [s].
ANSWER = 8.0

# Points in flight at least: a cluster that grows with its work sees that there is some.
_LEAST = 64

_LOGGERS = ("distributed", "tornado", "asyncio")


@contextmanager
def cluster(address: str) -> Iterator[Crew]:
    """A crew of the workers of a Dask scheduler, also of those that come later.

    Parameters
    ----------
    address : str
        Of the scheduler, as "tcp://10.0.0.1:8786".

    Raises
    ------
    InputError
        Where nobody answers there, or dask.distributed is not installed.

    Notes
    -----
    What Dask logs in this process is silenced: a lost scheduler is told in one line.
    """
    try:
        from distributed import Client
    except ImportError:
        raise InputError(
            "scheduler: takes the package distributed; install it with: pip install 'ehlectric[cluster]'"
        ) from None
    with warnings.catch_warnings():
        # Of differing versions: what they break is told where it breaks.
        warnings.simplefilter("ignore")
        _silence()
        try:
            client = Client(address, timeout=ANSWER, set_as_default=False)
        except Exception as error:  # of addresses, sockets, TLS and what else may answer there
            reason = " ".join(str(error).split())[:200] or type(error).__name__
            raise InputError(f"scheduler: nobody answers at {shown(address)}, {reason}") from None
    try:
        with client.get_executor(pure=False) as executor:
            submit = crew_of(executor).submit

            def threads() -> int:
                return sum(client.nthreads().values())

            yield Crew(
                submit,
                lambda: max(_LEAST, 3 * threads()),
                remark=lambda: "" if threads() else "no workers yet",
            )
    finally:
        with suppress(Exception):
            client.close(timeout=1.0)


def _silence() -> None:
    """Loggers of Dask that are there and that come later say nothing."""
    for name in (*_LOGGERS, *logging.root.manager.loggerDict):
        if name.partition(".")[0] in _LOGGERS:
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
