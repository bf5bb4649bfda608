"""A Dask cluster that solves the points of a sweep: connected to by the address of its scheduler."""

from __future__ import annotations

import asyncio
import logging
import math
import time
import warnings
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import contextmanager, suppress
from typing import Any

from ehlectric.errors import InputError, LostError, shown
from ehlectric.sweep.engine import Crew

# What an address has to answer, and the client to come back to a scheduler that is lost [s].
ANSWER = 8.0

# Points in flight at least: a cluster that grows with its work sees that there is some.
_LEAST = 64

# How often it is asked for its workers [s].
_REFRESH = 2.0
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
            "scheduler", "takes the package distributed; install it with: pip install 'ehlectric[cluster]'"
        ) from None
    _silence()
    with warnings.catch_warnings():
        # Of differing versions: what they break is told where it breaks.
        warnings.simplefilter("ignore")
        try:
            asyncio.run(asyncio.wait_for(_ask(address), ANSWER))
            client = Client(address, timeout=ANSWER, set_as_default=False)
        except Exception as error:  # of addresses, sockets, TLS and what else may answer there
            reason = " ".join(str(error).split())[:200] or f"none in {ANSWER:g} s"
            raise InputError("scheduler", got=f"no answer from {shown(address)}, {reason}") from None
    try:
        with client.get_executor(pure=False) as executor:
            yield _crew(client, executor)
    finally:
        with suppress(Exception):
            client.close(timeout=1.0)


async def _ask(address: str) -> None:
    """See whether a scheduler answers: a client would wait for what only listens."""
    from distributed import Security
    from distributed.core import rpc

    async with rpc(address, connection_args=Security().get_connection_args("client")) as there:
        kind = (await there.identity())["type"]
    if kind != "Scheduler":
        raise ValueError(f"it is a {kind.lower()}")


def _crew(client: Any, executor: Executor) -> Crew:
    threads, asked = 0, -math.inf

    def width() -> int:
        """How many points the workers of now may have in flight; to ask takes the scheduler a moment."""
        nonlocal threads, asked
        if client.status != "running":
            raise LostError("the connection is lost")
        if time.monotonic() - asked > _REFRESH:
            try:
                threads, asked = sum(client.nthreads().values()), time.monotonic()
            except Exception as error:  # of sockets and their wrappers
                raise LostError(" ".join(str(error).split())) from None
        return max(_LEAST, 3 * threads)

    return Crew(executor.submit, width, waiting=lambda: "" if threads else "no workers yet")


def _silence() -> None:
    """Loggers of Dask that are there and that come later say nothing."""
    for name in (*_LOGGERS, *logging.root.manager.loggerDict):
        if name.partition(".")[0] in _LOGGERS:
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
