"""Access to the pages: requests that are answered or refused, their size and number, and what pages may load.

A message of a browser that cannot be read, such as the message of a scanner, is one line of the log. The
libraries behind the pages write a traceback for each of them, by which anybody could fill the log and hide
the faults of the program. These faults keep their traceback.

Bound to this machine, the server answers only requests that name this machine, so that no other page in the
browser reaches it by a name of its own (DNS rebinding). Bound to another address, it asks for a token, which
the address of the first page holds and a cookie afterwards. Requests of other sites are refused.
"""

from __future__ import annotations

import ipaddress
import logging
import re
import secrets
import traceback
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from html import escape
from http.cookies import CookieError, SimpleCookie
from pathlib import PurePath
from types import TracebackType
from urllib.parse import parse_qsl, quote, urlencode, urlsplit

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.responses import HTMLResponse, PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from ehlectric.errors import printable

# Scripts need the nonce of their page, so that text which gets into a page never runs. Vue compiles its
# templates in the browser, which takes 'unsafe-eval'. Quasar and Plotly set styles on their elements, which
# takes 'unsafe-inline' for styles.
_POLICY = (
    "default-src 'self'; script-src 'self' 'nonce-{nonce}' 'unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self'; worker-src 'self' blob:; "
    "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
)

_HEADERS = (
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"no-referrer"),
    (b"x-frame-options", b"DENY"),
    (b"cross-origin-opener-policy", b"same-origin"),
    (b"cross-origin-resource-policy", b"same-origin"),
)

_SCRIPT = re.compile(rb"<script(?=[\s>])")


def with_policy(inner: ASGIApp) -> ASGIApp:
    """Application whose responses say what a browser may load and run."""

    async def marked(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http":
            await inner(scope, receive, _Marked(send))
        else:
            await inner(scope, receive, send)

    return marked


class _Marked:
    """Sender of a response that adds the headers, and the nonce to the scripts of a page."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._nonce = secrets.token_urlsafe(16)
        self._start: Message | None = None
        self._body = b""

    async def __call__(self, message: Message) -> None:
        if message["type"] == "http.response.start":
            policy = _POLICY.format(nonce=self._nonce).encode()
            further = [*_HEADERS, (b"content-security-policy", policy)]
            message["headers"] = [*message.get("headers", []), *further]
            kinds = [value for key, value in message["headers"] if key.lower() == b"content-type"]
            if any(kind.startswith(b"text/html") for kind in kinds):
                self._start = message
                return
        if self._start is None:
            await self._send(message)
        elif message["type"] == "http.response.body":
            self._body += message.get("body", b"")
            if not message.get("more_body"):
                await self._send_page(self._start)

    async def _send_page(self, start: Message) -> None:
        """Send a page, whose scripts got the nonce."""
        body = _SCRIPT.sub(f'<script nonce="{self._nonce}"'.encode(), self._body)
        others = [pair for pair in start["headers"] if pair[0].lower() != b"content-length"]
        start["headers"] = [*others, (b"content-length", str(len(body)).encode())]
        await self._send(start)
        await self._send({"type": "http.response.body", "body": body})


# Largest body of a request [bytes]: the largest text file of a surface that is read.
MOST_BODY = 100_000_000

# Bodies of all requests at once, which are kept in memory until a page takes them [bytes].
MOST_AT_ONCE = 3 * MOST_BODY

# Pages that are open at once.
MOST_PAGES = 200

# Requests below these paths open no page.
_PARTS = ("/_nicegui", "/favicon.ico")


def with_bounded_bodies(inner: ASGIApp, most: int = MOST_BODY, at_once: int = MOST_AT_ONCE) -> ASGIApp:
    """Application that refuses a request with a larger body, whether it states its size or not.

    It also refuses a request when those that are being answered have large bodies together.

    ``most`` is the largest size of a body [bytes], and ``at_once`` the size of the bodies of all requests
    that are being answered [bytes].
    """
    open_bodies = 0

    async def bounded(scope: Scope, receive: Receive, send: Send) -> None:
        nonlocal open_bodies
        if scope["type"] != "http":
            await inner(scope, receive, send)
            return
        stated_size = Headers(scope=scope).get("content-length", "0")
        reason = f"A request has at most {most / 1e6:g} MB."
        if not stated_size.isdecimal() or int(stated_size) > most:
            await refuse(scope, receive, send, 413, reason)
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


def with_bounded_pages(inner: ASGIApp, number: Callable[[], int], most: int = MOST_PAGES) -> ASGIApp:
    """Application that opens no further page where many are open."""

    async def bounded(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "http" and not scope["path"].startswith(_PARTS) and number() >= most:
            await refuse(
                scope, receive, send, 503, f"{most} pages are open; close one of them and try again."
            )
        else:
            await inner(scope, receive, send)

    return bounded


# Loggers of the server, which report requests and errors in messages, and packages that read messages.
_OWN = "ehlectric.app"
_LOGGERS = ("asyncio", "uvicorn.error", "engineio.server", "socketio.server", "nicegui", _OWN)
_READERS = ("engineio", "socketio")
_PROGRAM = __name__.partition(".")[0]

# Longest text that is logged, since it may quote an address or a message [characters].
_LONGEST = 200


def log_in_single_lines() -> None:
    """Make the loggers of the server report a message that cannot be read in one line, and requests without
    characters that control a terminal.
    """
    for name in _LOGGERS:
        logger = logging.getLogger(name)
        if not any(isinstance(each, _OneLine) for each in logger.filters):
            logger.addFilter(_OneLine())


class _OneLine(logging.Filter):
    """Filter that shortens records of errors in messages and escapes all texts, and passes all records on."""

    def filter(self, record: logging.LogRecord) -> bool:
        """Shorten a record where its error is one of a message, and escape its text."""
        error = record.exc_info[1] if record.exc_info else None
        if error is not None and _is_of_a_message(error.__traceback__):
            text = printable(" ".join(f"{type(error).__name__}: {error}".split()))[:_LONGEST]
            record.msg, record.args = "a message of a browser cannot be read: %s", (text,)
            record.exc_info = record.exc_text = None
            return True
        # An error of the program has its lines, and what comes from outside is on one line.
        text, of_program = record.getMessage(), record.name == _OWN or error is not None
        escaped = _escaped(text) if of_program else printable(text)[:_LONGEST]
        if escaped != text:
            record.msg, record.args = "%s", (escaped,)
        if error is not None:
            record.exc_text = _escaped("".join(traceback.format_exception(error)).rstrip())
        return True


def _escaped(text: str) -> str:
    """Text whose lines have no characters that control a terminal."""
    return "\n".join(map(printable, text.splitlines()))


def _is_of_a_message(trace: TracebackType | None) -> bool:
    """Whether an error was raised where a message is read, and not in the code of the pages behind it."""
    in_reader = False
    for path in _paths(trace):
        if path.parent.name in _READERS:
            in_reader = True
        elif _PROGRAM in path.parts:
            # What guards requests comes before the message is read, and the pages come after.
            in_reader = False
    return in_reader


def _paths(trace: TracebackType | None) -> Iterator[PurePath]:
    """Files of a traceback, the outermost first."""
    while trace is not None:
        yield PurePath(trace.tb_frame.f_code.co_filename)
        trace = trace.tb_next


# Name of the key of an address that holds the token.
_KEY = "token"

# Header of a response that no cache keeps.
_UNCACHED = {"cache-control": "no-store"}

_OTHERS = "Requests of other sites are refused."


@dataclass(frozen=True)
class Guard:
    """Rules for requests to the server.

    Examples
    --------
    >>> Guard.of("127.0.0.1", 8080).address
    'http://127.0.0.1:8080/'
    >>> Guard("0.0.0.0", 8080, "secret").address
    'http://localhost:8080/?token=secret'
    """

    host: str  # address that the server is bound to
    port: int
    token: str = ""  # token that a request must have; empty where the server is bound to this machine

    @classmethod
    def of(cls, host: str, port: int) -> Guard:
        """Guard of an address, with a new token unless it is this machine's own."""
        return cls(host, port, "" if is_loopback(host) else secrets.token_urlsafe(32))

    @property
    def address(self) -> str:
        """Address of the first page, with the token if there is one."""
        name = "localhost" if is_any(self.host) else f"[{self.host}]" if ":" in self.host else self.host
        return f"http://{name}:{self.port}/" + (f"?{_KEY}={self.token}" if self.token else "")

    @property
    def cookie(self) -> str:
        """Name of the cookie; browsers share cookies between the ports of a machine."""
        return f"ehlectric_{_KEY}_{self.port}"

    def around(self, inner: ASGIApp) -> ASGIApp:
        """Application that refuses requests against the rules, and passes on all others."""

        async def guarded(scope: Scope, receive: Receive, send: Send) -> None:
            if scope["type"] not in ("http", "websocket"):
                await inner(scope, receive, send)
                return
            headers = Headers(scope=scope)
            reason = self.refused(headers) or _from_elsewhere(scope, headers)
            if reason:
                await refuse(scope, receive, send, 403, reason)
            elif not self.token or self._has_cookie(headers):
                await inner(scope, receive, send)
            elif self._has_token(scope):
                await self._admit(scope, receive, send)
            else:
                await refuse(
                    scope, receive, send, 403, "The address needs the token that the command printed."
                )

        return guarded

    def refused(self, headers: Mapping[str, str]) -> str:
        """Reason why a request is refused whether it has the token or not; empty where there is none."""
        if not self.token and not is_loopback(_name(headers.get("host", ""))):
            return "This server answers only requests to localhost."
        origin = headers.get("origin")
        if origin is not None and _host(origin) != headers.get("host"):
            return _OTHERS
        return ""

    def _is_token(self, given: str) -> bool:
        return secrets.compare_digest(given.encode(), self.token.encode())

    def _has_cookie(self, headers: Mapping[str, str]) -> bool:
        try:
            cookie = SimpleCookie(headers.get("cookie", "")).get(self.cookie)
        except CookieError:
            return False
        return cookie is not None and self._is_token(cookie.value)

    def _has_token(self, scope: Scope) -> bool:
        """Whether this is a request of a page whose address holds the token."""
        if scope["type"] != "http" or scope["method"] != "GET":
            return False
        return any(self._is_token(value) for key, value in _query(scope) if key == _KEY)

    async def _admit(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Give the cookie, and lead the browser to the address without the token.

        A page leads it on, because browsers do not send a strict cookie along a redirection from another
        site, such as a mail with the link.
        """
        query = urlencode([(key, value) for key, value in _query(scope) if key != _KEY])
        # One slash, because two would name another host.
        target = "/" + quote(scope["path"].lstrip("/\\")) + (f"?{query}" if query else "")
        cookie = f"{self.cookie}={self.token}; Path=/; HttpOnly; SameSite=Strict"
        page = f'<!DOCTYPE html><meta http-equiv="refresh" content="0; url={escape(target)}">'
        await HTMLResponse(page, headers={**_UNCACHED, "set-cookie": cookie})(scope, receive, send)


def is_loopback(host: str) -> bool:
    """Whether a name or address denotes this machine.

    Examples
    --------
    >>> [is_loopback(host) for host in ("localhost", "127.0.0.1", "::1", "0.0.0.0", "example.org")]
    [True, True, True, False, False]
    """
    address = _address(host.strip("[]"))
    return host == "localhost" or (address is not None and address.is_loopback)


def is_any(host: str) -> bool:
    """Whether an address stands for all addresses of this machine.

    Examples
    --------
    >>> is_any("0.0.0.0"), is_any("127.0.0.1"), is_any("localhost")
    (True, False, False)
    """
    address = _address(host)
    return address is not None and address.is_unspecified


def _address(host: str) -> ipaddress.IPv4Address | ipaddress.IPv6Address | None:
    """Address of a host; None for a name."""
    try:
        return ipaddress.ip_address(host)
    except ValueError:
        return None


async def refuse(scope: Scope, receive: Receive, send: Send, status: int, reason: str) -> None:
    """Refuse a request with a status and a line of text."""
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": reason})
    else:
        await PlainTextResponse(reason, status, _UNCACHED)(scope, receive, send)


def _query(scope: Scope) -> list[tuple[str, str]]:
    return parse_qsl(scope.get("query_string", b"").decode("latin-1"), keep_blank_values=True)


def _from_elsewhere(scope: Scope, headers: Mapping[str, str]) -> str:
    """Reason why a request that the page of another site makes is refused; empty for one that a user makes.

    Browsers say from where a request comes. A link may lead here from anywhere. A page that another site
    loads in the background, as an image or in a frame, would take the room of those that people see.
    """
    if headers.get("sec-fetch-site") not in ("cross-site", "same-site"):
        return ""
    opened = (scope.get("method"), headers.get("sec-fetch-mode"), headers.get("sec-fetch-dest"))
    return "" if opened == ("GET", "navigate", "document") else _OTHERS


def _host(origin: str) -> str | None:
    """Host and port of an origin; None where it is none."""
    try:
        return urlsplit(origin).netloc
    except ValueError:
        return None


def _name(host: str) -> str:
    """Name of a host header, without its port."""
    try:
        return urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return ""
