"""Access to the pages: requests that are answered, and requests that are refused.

Bound to this machine, the server answers only requests that name this machine, so that no other page in the
browser reaches it by a name of its own (DNS rebinding). Bound to another address, it asks for a token, which
the address of the first page holds and a cookie afterwards. Requests of other sites are refused.
"""

from __future__ import annotations

import ipaddress
import secrets
from collections.abc import Awaitable, Callable, Mapping, MutableMapping
from dataclasses import dataclass
from html import escape
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qsl, quote, urlencode, urlsplit

Scope = MutableMapping[str, Any]
Message = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Handler = Callable[[Scope, Receive, Send], Awaitable[None]]
Headers = list[tuple[bytes, bytes]]

# Name of the key of an address that holds the token.
_KEY = "token"

_OTHERS = "Requests of other sites are refused."


@dataclass(frozen=True)
class Guard:
    """Rules for requests to the server.

    Attributes
    ----------
    host : str
        Address that the server is bound to.
    port : int
        Its port.
    token : str
        Token that a request must have; empty where the server is bound to this machine.

    Examples
    --------
    >>> Guard.of("127.0.0.1", 8080).address
    'http://127.0.0.1:8080/'
    >>> Guard("0.0.0.0", 8080, "secret").address
    'http://localhost:8080/?token=secret'
    """

    host: str
    port: int
    token: str = ""

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

    def around(self, inner: Handler) -> Handler:
        """Application that refuses requests against the rules, and passes on all others."""

        async def guarded(scope: Scope, receive: Receive, send: Send) -> None:
            if scope["type"] not in ("http", "websocket"):
                await inner(scope, receive, send)
                return
            headers = headers_of(scope)
            reason = self.refused(headers) or _from_elsewhere(scope, headers)
            if reason:
                await refuse(scope, send, 403, reason)
            elif not self.token or self._has_cookie(headers):
                await inner(scope, receive, send)
            elif self._has_token(scope):
                await self._admit(scope, send)
            else:
                await refuse(scope, send, 403, "The address needs the token that the command printed.")

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

    async def _admit(self, scope: Scope, send: Send) -> None:
        """Give the cookie, and lead the browser to the address without the token.

        A page leads it on, because browsers do not send a strict cookie along a redirection from another
        site, such as that of a mail with the link.
        """
        query = urlencode([(key, value) for key, value in _query(scope) if key != _KEY])
        # One slash, because two would name another host.
        target = "/" + quote(scope["path"].lstrip("/\\")) + (f"?{query}" if query else "")
        cookie = f"{self.cookie}={self.token}; Path=/; HttpOnly; SameSite=Strict"
        page = f'<!DOCTYPE html><meta http-equiv="refresh" content="0; url={escape(target)}">'
        headers = [(b"content-type", b"text/html; charset=utf-8"), (b"set-cookie", cookie.encode())]
        await respond(send, 200, headers, page)


def is_loopback(host: str) -> bool:
    """Whether a name or address is that of this machine.

    Examples
    --------
    >>> [is_loopback(host) for host in ("localhost", "127.0.0.1", "::1", "0.0.0.0", "example.org")]
    [True, True, True, False, False]
    """
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host.strip("[]")).is_loopback
    except ValueError:
        return False


def is_any(host: str) -> bool:
    """Whether an address stands for all addresses of this machine.

    Examples
    --------
    >>> is_any("0.0.0.0"), is_any("127.0.0.1"), is_any("localhost")
    (True, False, False)
    """
    try:
        return ipaddress.ip_address(host).is_unspecified
    except ValueError:
        return False


def headers_of(scope: Scope) -> dict[str, str]:
    """Headers of a request by their names in small letters."""
    return {key.decode("latin-1"): value.decode("latin-1") for key, value in scope["headers"]}


async def refuse(scope: Scope, send: Send, status: int, reason: str) -> None:
    """Refuse a request with a status and a line of text."""
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008, "reason": reason})
    else:
        await respond(send, status, [(b"content-type", b"text/plain; charset=utf-8")], reason)


async def respond(send: Send, status: int, headers: Headers, text: str) -> None:
    """Send a whole response, which no cache keeps."""
    body = text.encode()
    further = [(b"cache-control", b"no-store"), (b"content-length", str(len(body)).encode())]
    await send({"type": "http.response.start", "status": status, "headers": [*headers, *further]})
    await send({"type": "http.response.body", "body": body})


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
