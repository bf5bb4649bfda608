"""Requests that are refused, and headers that bind a page to its server."""

import asyncio
import re
from http.cookies import SimpleCookie

import pytest
from starlette.exceptions import HTTPException

from ehlectric.app.security import (
    Guard,
    is_any,
    is_loopback,
    with_bounded_bodies,
    with_bounded_pages,
    with_policy,
)
from tests.helpers.each import each

LOCAL = Guard("127.0.0.1", 8080)
OPEN = Guard("0.0.0.0", 8080, "the-token")


async def page(_scope, _receive, send):
    """Application that answers every request with a page."""
    html = [(b"content-type", b"text/html; charset=utf-8"), (b"content-length", b"1")]
    await send({"type": "http.response.start", "status": 200, "headers": html})
    await send({"type": "http.response.body", "body": b"<script>1</script>", "more_body": True})
    await send({"type": "http.response.body", "body": b"<script src=/a></script><scripts>"})


async def reader(_scope, receive, send):
    """Application that reads the whole body."""
    while (await receive()).get("more_body"):
        pass
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": b"read"})


def ask(application, path="/", *, kind="http", method="GET", bodies=(b"",), **headers):
    """Status, headers and body of a response; the close code of a refused socket."""
    path, _, query = path.partition("?")
    given = [(name.replace("_", "-").encode(), value.encode()) for name, value in headers.items()]
    scope = {"type": kind, "path": path, "query_string": query.encode(), "headers": given, "method": method}
    messages = [
        {"type": "http.request", "body": body, "more_body": number < len(bodies)}
        for number, body in enumerate(bodies, 1)
    ]
    sent = []

    async def receive():
        return messages.pop(0)

    async def send(message):
        sent.append(message)

    asyncio.run(application(scope, receive, send))
    if kind == "websocket":
        return next((message.get("code") for message in sent if message["type"] == "websocket.close"), 200)
    found = {key.decode().lower(): value.decode() for key, value in sent[0]["headers"]}
    return sent[0]["status"], found, b"".join(message.get("body", b"") for message in sent[1:])


@each("host", ["127.0.0.1:8080", "localhost:8080", "[::1]:8080", "localhost"])
def test_a_local_server_answers_requests_that_name_this_machine(host):
    assert ask(LOCAL.around(page), host=host)[0] == 200


@each(
    "headers",
    [
        {},
        {"host": ""},
        {"host": "attacker.example:8080"},
        {"host": "127.0.0.1.attacker.example"},
        {"host": "192.168.1.7:8080"},
        {"host": "[::1"},
        {"host": "localhost:8080", "origin": "http://attacker.example"},
        {"host": "localhost:8080", "origin": "http://localhost:9999"},
        {"host": "localhost:8080", "origin": "null"},
    ],
)
@each("kind", ["http", "websocket"])
def test_other_names_and_other_sites_are_refused(headers, kind):
    found = ask(LOCAL.around(page), "/_nicegui_ws/socket.io", kind=kind, **headers)
    assert (found if kind == "websocket" else found[0]) in (403, 1008)


def test_a_page_of_this_server_may_ask():
    assert ask(LOCAL.around(page), host="localhost:8080", origin="http://localhost:8080")[0] == 200


@each(
    "path, headers",
    [
        ("/", {}),
        ("/?token=", {}),
        ("/?token=another", {}),
        ("/", {"cookie": "ehlectric_token_8080=another"}),
        ("/", {"cookie": "ehlectric_token_9090=the-token"}),
        ("/", {"cookie": "a\x00;;=;"}),
        ("/?token=the-token", {"origin": "http://attacker.example"}),
    ],
)
def test_a_server_for_others_asks_for_its_token(path, headers):
    status, found, body = ask(OPEN.around(page), path, host="machine:8080", **headers)
    assert status == 403
    assert "the-token" not in str(found) + body.decode()


def test_the_token_becomes_a_cookie_and_leaves_the_address():
    status, headers, body = ask(
        OPEN.around(page), "/contact?a=1&token=the-token&b=%22%3E", host="machine:8080"
    )
    assert status == 200
    assert b'content="0; url=/contact?a=1&amp;b=%22%3E"' in body
    assert b"the-token" not in body
    assert headers["cache-control"] == "no-store"
    (cookie,) = SimpleCookie(headers["set-cookie"]).values()
    assert (cookie["httponly"], cookie["samesite"], cookie["path"]) == (True, "Strict", "/")
    given = f"{cookie.key}={cookie.value}"
    assert ask(OPEN.around(page), "/contact", host="machine:8080", cookie=given)[0] == 200


def test_the_token_leads_to_no_other_host():
    _, _, body = ask(OPEN.around(page), "//attacker.example?token=the-token", host="machine:8080")
    assert b"url=/attacker.example" in body


@pytest.mark.parametrize(("kind", "method"), [("websocket", "GET"), ("http", "POST")])
def test_only_pages_take_the_token_from_the_address(kind, method):
    found = ask(OPEN.around(page), "/?token=the-token", kind=kind, method=method, host="machine:8080")
    assert (found if kind == "websocket" else found[0]) in (403, 1008)


def test_every_server_for_others_has_a_token_of_its_own():
    one, other = Guard.of("0.0.0.0", 8080), Guard.of("0.0.0.0", 8080)
    assert len(one.token) >= 43  # 256 bits
    assert one.token != other.token
    assert Guard.of("::1", 8080) == Guard("::1", 8080)
    assert Guard.of("::1", 8080).address == "http://[::1]:8080/"


def test_names_of_addresses():
    assert [is_loopback(host) for host in ("127.8.8.8", "localhost.", "")] == [True, False, False]
    assert [is_any(host) for host in ("::", "0.0.0.0", "10.0.0.1")] == [True, True, False]


def test_scripts_of_a_page_have_the_nonce_of_its_policy():
    _, headers, body = ask(with_policy(page))
    policy = headers["content-security-policy"]
    (nonce,) = re.findall(r"'nonce-([^']+)'", policy)
    assert body.decode() == (
        f'<script nonce="{nonce}">1</script><script nonce="{nonce}" src=/a></script><scripts>'
    )
    assert headers["content-length"] == str(len(body))
    scripts = next(part for part in policy.split(";") if part.strip().startswith("script-src"))
    assert "'unsafe-inline'" not in scripts
    assert not re.search("https?:", policy)
    assert ask(with_policy(page))[1]["content-security-policy"] != policy
    assert headers["x-content-type-options"] == "nosniff"


def test_a_large_body_is_refused_before_it_is_read():
    limited = with_bounded_bodies(reader, most=10)
    assert ask(limited, content_length="10", bodies=(b"1" * 10,))[0] == 200
    assert ask(limited, content_length="11")[0] == 413
    assert ask(limited, content_length="-1")[0] == 413


def test_a_large_body_that_does_not_tell_its_size_is_refused():
    limited = with_bounded_bodies(reader, most=10)
    assert ask(limited, bodies=(b"12345", b"67890"))[0] == 200
    with pytest.raises(HTTPException) as caught:
        ask(limited, bodies=(b"12345", b"678901"))
    assert caught.value.status_code == 413


def test_pages_beyond_their_number_are_refused():
    limited = with_bounded_pages(page, lambda: 3, most=3)
    assert ask(limited, "/")[0] == 503
    assert ask(limited, "/_nicegui/3.18.0/static/nicegui.js")[0] == 200
    assert ask(with_bounded_pages(page, lambda: 2, most=3), "/")[0] == 200


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_a_page_of_another_site_loads_nothing_in_the_background(site):
    """As an image or in a frame; a link that a user follows leads here from anywhere."""
    own = {"host": "localhost:8080", "sec_fetch_site": site}
    for mode, dest in (
        ("no-cors", "image"),
        ("navigate", "iframe"),
        ("cors", "empty"),
        ("no-cors", "script"),
    ):
        background = {"sec_fetch_mode": mode, "sec_fetch_dest": dest, **own}
        assert ask(LOCAL.around(page), **background)[0] == 403
    followed = {"sec_fetch_mode": "navigate", "sec_fetch_dest": "document", **own}
    assert ask(LOCAL.around(page), **followed)[0] == 200
    assert ask(LOCAL.around(page), method="POST", **followed)[0] == 403


@each("origin", ["http://[", "http://[::1", "//", "\\"])
def test_an_origin_that_is_none_is_that_of_another_site(origin):
    assert ask(LOCAL.around(page), host="localhost:8080", origin=origin)[0] == 403


def test_the_address_without_the_token_is_on_this_server():
    """Browsers drop a tab from an address, and two slashes name another host."""
    status, _, body = ask(OPEN.around(page), "/\t/evil.example?token=the-token", host="any")
    assert status == 200
    assert b'url=/%09/evil.example"' in body


def test_bodies_of_all_requests_are_bounded_together():
    """A request that is being answered keeps its body in memory until then."""

    async def run():
        answered = asyncio.Event()

        async def slow(_scope, receive, _send):
            while (await receive()).get("more_body"):
                pass
            await answered.wait()

        bounded = with_bounded_bodies(slow, most=60, at_once=100)

        async def request(*bodies):
            left = list(bodies)

            async def receive():
                return {"type": "http.request", "body": left.pop(0), "more_body": bool(left)}

            await bounded({"type": "http", "path": "/", "headers": []}, receive, None)

        early = asyncio.create_task(request(bytes(60)))
        await asyncio.sleep(0)
        with pytest.raises(HTTPException, match="503"):
            await request(bytes(30), bytes(30))
        answered.set()
        await early
        await request(bytes(30), bytes(30))

    asyncio.run(run())
