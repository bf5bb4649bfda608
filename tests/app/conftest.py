"""The app in a real browser: Chromium of the system, driven by Playwright."""

import os
import re
import shutil
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from tests.app.driving import connected
from tests.helpers.app_server import AppServer
from tests.helpers.processes import PATIENCE

# Names under which systems install Chromium.
_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")

# Without a sandbox, which containers lack; without requests of the browser's own; and with WebGL in software.
_FLAGS = (
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--enable-unsafe-swiftshader",
    "--use-gl=angle",
    "--use-angle=swiftshader",
)

# Messages of the browser about itself, and about WebGL in software.
_HARMLESS = re.compile("GPU stall|GL Driver Message|WebGL")

# Plotly resizes a figure in its own time, also one that the page has replaced since.
_LATE = re.compile("Resize must be passed a displayed plot div element")

# Time after which a test gives up what it waits for [ms].
_PATIENCE = 1e3 * PATIENCE


def _program():
    """Path of Chromium; a test that needs it is skipped without it, unless it is required."""
    found = next(filter(None, map(shutil.which, _NAMES)), None)
    if found is None:
        told = "no Chromium on this machine; install it with: make browser"
        if os.environ.get("EHLECTRIC_BROWSER") == "required":
            pytest.fail(told)
        pytest.skip(told)
    return found


@pytest.fixture(scope="module")
def browser():
    """Chromium, which one module of tests shares: Playwright keeps an event loop for as long as it runs."""
    program = _program()
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=program, args=list(_FLAGS), timeout=_PATIENCE)
        yield chromium
        chromium.close()


@pytest.fixture(scope="session")
def app_server(tmp_path_factory):
    """Server of the app that tests share; see ``own_server`` for one that a test may stop."""
    _program()
    server = AppServer(tmp_path_factory.mktemp("app"), patient=True)
    yield server
    assert server.stop() == 0
    assert not list(server.folder.iterdir()), "nothing is written where the command was typed"
    assert not list(server.temporary.iterdir()), "temporary files end with the server"


@pytest.fixture
def own_server(tmp_path):
    """Start of a server, with options of the command, that ends with the test."""
    servers = []

    def start(*options, **limits):
        servers.append(AppServer(tmp_path, *options, patient=True, **limits))
        return servers[-1]

    yield start
    for server in servers:
        if server.process.poll() is None:
            server.stop()


@dataclass
class Watch:
    """What a page did: its requests, and what went wrong in it.

    Attributes
    ----------
    host : str
        Host and port of the server.
    requests : list of str
        Addresses of all requests.
    wrong : list of str
        Errors of the page, and requests to other hosts.
    """

    host: str
    requests: list[str] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)

    def of(self, page):
        """Watch a page."""
        page.on("console", self._said)
        page.on("pageerror", lambda error: self._failed(str(error)))
        page.on("request", lambda request: self._asked(request.url))
        page.on("websocket", lambda socket: self._asked(socket.url))
        return page

    def _failed(self, error):
        if not _LATE.search(error):
            self.wrong.append(f"error of a script: {error}")

    def _said(self, message):
        if message.type == "error" and not _HARMLESS.search(message.text):
            self.wrong.append(f"console: {message.text}")

    def _asked(self, url):
        self.requests.append(url)
        parts = urlsplit(url)
        if parts.scheme not in ("data", "blob") and parts.netloc != self.host:
            self.wrong.append(f"request to another host: {url}")


@pytest.fixture
def open_page(browser, own_server, request):
    """Function that opens a page of a server in a browser context of its own.

    A page that has an error in its console, or asks another host, fails the test; ``watch.wrong`` may be
    cleared by a test that provokes errors. Servers of the test end after its pages, which would miss them.
    """
    del own_server
    watches, contexts = [], []

    def opened(server, path="/", *, width=1280, height=900, **options):
        context = browser.new_context(viewport={"width": width, "height": height}, **options)
        contexts.append(context)
        context.set_default_timeout(_PATIENCE)
        page = context.new_page()
        page.watch = Watch(urlsplit(server.address).netloc)
        watches.append(page.watch)
        page.watch.of(page)
        target = server.address if path == "/" else f"{server.address.partition('?')[0].rstrip('/')}{path}"
        page.goto(target)
        connected(page)
        return page

    yield opened
    for context in contexts:
        context.close()
    wrong = [line for watch in watches for line in watch.wrong]
    assert not wrong, f"{request.node.name}: {wrong}"


@pytest.fixture
def page(open_page, app_server):
    """First page of the shared server."""
    return open_page(app_server)


@pytest.fixture
def screenshot(tmp_path):
    """Function that writes a screenshot of a page; the folder EHLECTRIC_SCREENSHOTS keeps it."""
    folder = Path(os.environ.get("EHLECTRIC_SCREENSHOTS") or tmp_path)
    folder.mkdir(parents=True, exist_ok=True)

    def taken(page, name):
        path = folder / f"{name}.png"
        page.screenshot(path=path, full_page=True, animations="disabled")
        return path

    return taken


@contextmanager
def no_answer_wrong(page):
    """Context in which errors of a page are not held against it, such as those of a server that is gone."""
    before = len(page.watch.wrong)
    yield
    del page.watch.wrong[before:]
