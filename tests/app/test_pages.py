"""Number of open pages, and log of messages that are none of the protocol."""

import logging
import sys
import time

import pytest
from nicegui import Client

from ehlectric.app import security, server
from ehlectric.app.security import MOST_PAGES


class Page:
    """What the server knows of a page: when it was asked for, and whether a browser is connected to it."""

    def __init__(self, pages, number, age, connected, *, away=False):
        self.id, self.has_socket_connection, self.created = number, connected, time.time() - age
        self._delete_tasks = {"document": None} if away else {}
        self.delete = lambda: pages.pop(number)


@pytest.fixture
def pages(monkeypatch):
    found = {}
    monkeypatch.setattr(Client, "instances", found)
    return found


def test_of_many_pages_without_a_browser_the_oldest_are_given_up(pages):
    """Requests by a program, one after the other: a few pages stay, and those of browsers."""
    pages[0] = Page(pages, 0, 1000.0, connected=True)
    pages[1] = Page(pages, 1, 1000.0, connected=False, away=True)
    largest = 0
    for number in range(2, 200):
        pages[number] = Page(pages, number, 200.0 - number, connected=False)
        largest = max(largest, server.open_pages())
    assert largest <= server._MOST_UNSEEN + 1
    assert {0, 1, 199} <= set(pages)
    assert sorted(pages) == [0, 1, *range(202 - len(pages), 200)]


def test_pages_without_a_browser_are_given_up_where_others_wait(pages, monkeypatch):
    monkeypatch.setattr(server, "_MOST_UNSEEN", 2 * MOST_PAGES)
    old = server._UNSEEN + 1.0
    kept = [(old, True, False), (old, False, True), (0.0, False, False)]
    for number in range(MOST_PAGES - 1):
        age, connected, away = kept[number] if number < len(kept) else (old, False, False)
        pages[number] = Page(pages, number, age, connected, away=away)
    # Nobody waits yet.
    assert server.open_pages() == MOST_PAGES - 1
    pages[MOST_PAGES] = Page(pages, MOST_PAGES, old, connected=False)
    assert server.open_pages() == len(kept)
    assert list(pages) == [0, 1, 2]


def test_an_error_of_the_program_keeps_its_traceback():
    """Also one that a message of a browser has led to."""
    places = {"of a message": "engineio/packet.py", "of a page": "ehlectric/app/pages/form.py"}
    for first, last in (places.values(), reversed(places.values())):
        code = f"exec(compile('1 / 0', {f'/packages/{last}'!r}, 'exec'))"
        try:
            exec(compile(code, f"/packages/{first}", "exec"))
        except ZeroDivisionError:
            record = logging.LogRecord("asyncio", logging.ERROR, "", 0, "two\nlines", (), sys.exc_info())
        assert security._OneLine().filter(record)
        assert (record.exc_info is None) == ("engineio" in last)
        assert ("\n" in record.getMessage()) == ("engineio" not in last)


@pytest.mark.parametrize("name", ["nicegui", "uvicorn.error", "asyncio"])
def test_an_address_reaches_the_terminal_without_characters_that_control_it(name, caplog):
    security.log_in_single_lines()
    logger, path = logging.getLogger(name), "http://127.0.0.1/\x1b]0;PWN\x07\nuser: " + 500 * "x"
    with caplog.at_level(logging.WARNING, logger=name):
        logger.warning("%s not found", path)
        logger.warning("an address of %s", "http://127.0.0.1/bearing")
    first, second = caplog.messages
    assert first.isprintable()
    assert first.startswith(r"http://127.0.0.1/\x1b]0;PWN\x07\nuser: xx")
    assert len(first) == 200
    assert second == "an address of http://127.0.0.1/bearing"


def test_the_traceback_of_a_process_is_logged_whole_and_escaped(caplog):
    security.log_in_single_lines()
    trace = "Traceback\n" + 20 * "  File solution.py\n" + "ValueError: bad \x1b[31m path"
    with caplog.at_level(logging.ERROR):
        logging.getLogger("ehlectric.app").error("%s", trace)
        try:
            raise ValueError("bad \x1b[31m path")
        except ValueError:
            logging.getLogger("nicegui").exception("a fault")
    first, second = caplog.records
    assert first.getMessage() == trace.replace("\x1b", r"\x1b")
    assert r"ValueError: bad \x1b[31m path" in caplog.handler.format(second)
    assert "\x1b" not in caplog.text
