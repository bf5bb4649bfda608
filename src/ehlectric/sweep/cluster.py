"""Solution of the points of a sweep on a Dask cluster, given the address of its scheduler."""

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
from ehlectric.runtime.parallel.workers import Crew, packed_submit

# Time limit for the answer of an address, and for the reconnection to a lost scheduler [s].
ANSWER = 8.0

# Smallest number of points in flight. A cluster that adapts its workers to the queued work needs some points
# to start.
_LEAST = 64

# Interval between two requests for the number of workers [s].
_REFRESH = 2.0
_LOGGERS = ("distributed", "tornado", "asyncio")


@contextmanager
def cluster(address: str) -> Iterator[Crew]:
    """Context manager that connects to a Dask scheduler and yields a crew of its workers.

    Workers that join the cluster later are used too.

    Parameters
    ----------
    address : str
        Address of the scheduler, such as "tcp://10.0.0.1:8786".

    Yields
    ------
    Crew
        The workers of the cluster.

    Raises
    ------
    InputError
        If no scheduler answers at the address, or dask.distributed is not installed.

    Notes
    -----
    Log messages of Dask in this process are switched off: an error of one line reports a lost scheduler.
    """
    try:
        from distributed import Client
    except ImportError:
        raise InputError(
            "scheduler", "needs the package distributed; install it with: pip install 'ehlectric[cluster]'"
        ) from None
    _silence()
    with warnings.catch_warnings():
        # Dask warns if versions differ. If the difference breaks something, an error says so.
        warnings.simplefilter("ignore")
        try:
            asyncio.run(asyncio.wait_for(_ask(address), ANSWER))
            client = Client(address, timeout=ANSWER, set_as_default=False)
        except Exception as error:  # from the address, the socket, TLS or another kind of server
            reason = " ".join(str(error).split())[:200] or f"none in {ANSWER:g} s"
            raise InputError("scheduler", got=f"no answer from {shown(address)}, {reason}") from None
    try:
        with client.get_executor(pure=False) as executor:
            yield _crew(client, executor)
    finally:
        with suppress(Exception):
            client.close(timeout=1.0)


async def _ask(address: str) -> None:
    """Check that a scheduler answers: a client would wait for a server that listens but never answers."""
    from distributed import Security
    from distributed.core import rpc

    async with rpc(address, connection_args=Security().get_connection_args("client")) as there:
        kind = (await there.identity())["type"]
    if kind != "Scheduler":
        raise ValueError(f"it is a {kind.lower()}")


def _crew(client: Any, executor: Executor) -> Crew:
    """Crew of the workers of a connected client."""
    threads, asked_at = 0, -math.inf

    def width() -> int:
        """Number of points that the present workers may have in flight.

        The number of workers is requested at intervals only, because each request costs the scheduler time.
        """
        nonlocal threads, asked_at
        if client.status != "running":
            raise LostError("the connection is lost")
        if time.monotonic() - asked_at > _REFRESH:
            try:
                threads, asked_at = sum(client.nthreads().values()), time.monotonic()
            except Exception as error:  # from the connection
                raise LostError(" ".join(str(error).split())) from None
        return max(_LEAST, 3 * threads)

    return Crew(packed_submit(executor), width, waiting=lambda: "" if threads else "no workers yet")


def _silence() -> None:
    """Switch off the loggers of Dask: existing ones and, through their parents, loggers created later."""
    for name in (*_LOGGERS, *logging.root.manager.loggerDict):
        if name.partition(".")[0] in _LOGGERS:
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
