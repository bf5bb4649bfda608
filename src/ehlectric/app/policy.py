"""Content security policy: pages load and run only content of this server."""

from __future__ import annotations

import re
import secrets

from ehlectric.app.security import Handler, Message, Receive, Scope, Send

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


def with_policy(inner: Handler) -> Handler:
    """Application whose responses say what a browser may load and run.

    Parameters
    ----------
    inner : callable
        Application, whose pages come uncompressed.
    """

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
