"""Server of the app: one process that serves the pages."""

from __future__ import annotations

import asyncio
import gc
import signal
import socket
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import uvicorn
from fastapi import FastAPI
from nicegui import Client, app, ui
from starlette.middleware.gzip import GZipMiddleware
from starlette.types import ASGIApp

from ehlectric.app.kept_answers import write
from ehlectric.app.pages import FIRST, PAGES
from ehlectric.app.security import (
    MOST_PAGES,
    Guard,
    log_in_single_lines,
    with_bounded_bodies,
    with_bounded_pages,
    with_policy,
)
from ehlectric.app.session import keep_in_memory
from ehlectric.app.work import Work
from ehlectric.runtime.locks import not_ignored
from ehlectric.runtime.memory import trim

# Time in which a browser may come back, as after a computer slept, before its session ends [s].
_RECONNECT = 20.0

# Time in which a browser connects to a page, where others wait for one [s].
_UNSEEN = 5.0

# Pages without a browser above which the oldest are given up, and how many then remain. A page has some
# thousand objects, 3 MB.
_MOST_UNSEEN, _KEPT_UNSEEN = 24, 12

# Time after which pages without a browser are given up, and the memory of closed pages is given back [s].
_GIVEN_BACK = 30.0

# Messages that a browser gets again when it comes back; figures are in them, so they are few.
_MESSAGES = 100

# Time after which the processes load where no browser has opened a page [s].
_UNVISITED = 2.0

# Time that open requests have to end when the server is stopped [s].
_GRACE = 1

# Smallest response that is compressed [bytes], and level of the compression. Level 9 takes three times as
# long for 5 % fewer bytes: compressing the 4.6 MB of Plotly would be a fifth of the work for a page. Pages
# for a browser on this machine are not compressed.
_COMPRESSED, _LEVEL = 1000, 4

# Largest message of a browser [bytes].
_LARGEST_MESSAGE = 4_000_000


def serve(guard: Guard, listening: socket.socket, work: Work, answers: Mapping[str, Any]) -> None:
    """Serve the pages until the process is stopped; ``answers`` are kept ones, by their keys."""
    config = uvicorn.Config(
        _application(guard, work),
        log_level="warning",
        access_log=False,
        ws="wsproto",
        ws_max_size=_LARGEST_MESSAGE,
        proxy_headers=False,
        server_header=False,
        lifespan="on",
        timeout_graceful_shutdown=_GRACE,
    )
    log_in_single_lines()
    _Server(config, work, answers).run(sockets=[listening])


class _Server(uvicorn.Server):
    """Server that answers the first page before a browser asks for it."""

    def __init__(self, config: uvicorn.Config, work: Work, answers: Mapping[str, Any]) -> None:
        super().__init__(config)
        self._work, self._answers = work, answers

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """Context in which signals end the server; also the signal of a closed terminal, unless it is
        ignored.
        """
        hangup = [number for number in not_ignored() if number.name == "SIGHUP"]
        with super().capture_signals():
            before = {number: signal.signal(number, self.handle_exit) for number in hangup}
            try:
                yield
            finally:
                for number, handler in before.items():
                    signal.signal(number, handler)

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        self._work.keep(self._answers)
        await super().startup(sockets)
        self._giving_back = asyncio.create_task(_give_back())
        if self._answers:
            # The processes load after the first page, which needs none of them, has loaded.
            app.on_connect(self._work.warm)
            asyncio.get_running_loop().call_later(_UNVISITED, self._work.warm)
        else:
            # While a browser loads the page, which gets the answers that are computed.
            self._first = asyncio.create_task(self._answer_first())

    async def _answer_first(self) -> None:
        """Answer the first page, and keep its fullest answer for later starts."""
        answers = await FIRST(self._work)
        if answers:
            await asyncio.to_thread(write, answers)


def _application(guard: Guard, work: Work) -> ASGIApp:
    """Pages, behind all that bounds and guards them."""
    keep_in_memory()
    for page in PAGES:
        page(work)
    app.on_page_exception(_show_fault)
    outer = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    ui.run_with(
        outer,
        title="ehlectric",
        language="en-US",
        tailwind=False,
        reconnect_timeout=_RECONNECT,
        message_history_length=_MESSAGES,
        gzip_middleware_factory=None,
        show_welcome_message=False,
    )
    paged = with_bounded_pages(with_bounded_bodies(outer), open_pages)
    answering = with_policy(paged)
    if guard.token:
        # Pages are compressed after their scripts got the nonce.
        answering = GZipMiddleware(answering, minimum_size=_COMPRESSED, compresslevel=_LEVEL)
    return guard.around(answering)


def open_pages() -> int:
    """Number of open pages; where they are many, those to which no browser has connected are given up."""
    unseen = sorted(page.created for page in Client.instances.values() if not page.has_socket_connection)
    if len(unseen) >= _MOST_UNSEEN:
        # Not those whose browser is away and may come back.
        Client.prune_instances(client_age_threshold=time.time() - unseen[-_KEPT_UNSEEN - 1])
        # Elements of a page refer to each other, so that only the collector frees them.
        gc.collect()
    if len(Client.instances) >= MOST_PAGES:
        Client.prune_instances(client_age_threshold=_UNSEEN)
    return len(Client.instances)


async def _give_back() -> None:
    """Give up pages without a browser from time to time, and free what closed pages leave."""
    known: set[str] = set()
    while True:
        await asyncio.sleep(_GIVEN_BACK)
        Client.prune_instances(client_age_threshold=_GIVEN_BACK)
        if not known <= Client.instances.keys():
            gc.collect()
            trim()
        known = set(Client.instances)


def _show_fault() -> None:
    """Content of a page that could not be built: a line; NiceGUI writes the traceback to the log."""
    with ui.element("main").props('role="alert"'):
        ui.label("This page has an error in the program; the log of the server has the details.")
        ui.link("Begin again", "/")
