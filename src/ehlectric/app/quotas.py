"""Bounds of what browsers send and open: the size of a request, and the number of pages."""

from __future__ import annotations

from collections.abc import Callable

from starlette.exceptions import HTTPException

from ehlectric.app.security import Handler, Message, Receive, Scope, Send, headers_of, refuse

# Largest body of a request [bytes]: that of the largest text file of a surface that is read.
MOST_BODY = 100_000_000

# Bodies of all requests at once, which are kept in memory until a page takes them [bytes].
MOST_AT_ONCE = 3 * MOST_BODY

# Pages that are open at once.
MOST_PAGES = 200

# Requests below these paths open no page.
_PARTS = ("/_nicegui", "/favicon.ico")


def with_bounded_bodies(inner: Handler, most: int = MOST_BODY, at_once: int = MOST_AT_ONCE) -> Handler:
    """Application that refuses a request with a larger body, whether it tells its size or not.

    It also refuses a request when those that are being answered have large bodies together.

    Parameters
    ----------
    inner : callable
        Application.
    most : int
        Largest size of a body [bytes].
    at_once : int
        Largest size of the bodies of all requests that are being answered [bytes].
    """
    open_bodies = 0

    async def bounded(scope: Scope, receive: Receive, send: Send) -> None:
        nonlocal open_bodies
        if scope["type"] != "http":
            await inner(scope, receive, send)
            return
        told = headers_of(scope).get("content-length", "0")
        reason = f"A request has at most {most / 1e6:g} MB."
        if not told.isdecimal() or int(told) > most:
            await refuse(scope, send, 413, reason)
            return
        read = 0

        async def counted() -> Message:
            nonlocal read, open_bodies
            message = await receive()
            size = len(message.get("body", b""))
            read, open_bodies = read + size, open_bodies + size
            if read > most:
                raise HTTPException(413, reason)
            if open_bodies > at_once:
                raise HTTPException(503, "Too many files are being uploaded; try again.")
            return message

        try:
            await inner(scope, counted, send)
        finally:
            open_bodies -= read

    return bounded


def with_bounded_pages(inner: Handler, number: Callable[[], int], most: int = MOST_PAGES) -> Handler:
    """Application that opens no further page where many are open.

    Parameters
    ----------
    inner : callable
        Application.
    number : callable
        Returns the number of open pages.
    most : int
        Largest number of open pages.
    """

    async def bounded(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http" and not scope["path"].startswith(_PARTS) and number() >= most:
            await refuse(scope, send, 503, f"{most} pages are open; close one of them and try again.")
        else:
            await inner(scope, receive, send)

    return bounded
