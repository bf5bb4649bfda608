"""Frame of every page: its head with links, light and dark, and the session of the tab."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib import resources

from nicegui import Client, ui

from ehlectric.app.inputs import Inputs
from ehlectric.app.pages.control import ThemeButton
from ehlectric.app.pages.parts import heading
from ehlectric.app.session import Session
from ehlectric.app.work import Work

# Links at the top: address, name.
LINKS = (
    ("/", "Bearing"),
    ("/drive", "Drive"),
    ("/contact", "Contact"),
    ("/sweep", "Sweep"),
    ("/compare", "Compare"),
)


# Time in which the server answers with a page, also where many ask at once [s].
PAGE_PATIENCE = 30.0


@cache
def _styles() -> tuple[str, ...]:
    """Style sheets of the pages; the common one comes first, so that the others may add to it."""
    files = resources.files("ehlectric.app").joinpath("static").iterdir()
    sheets = {file.name: file.read_text(encoding="utf-8") for file in files if file.name.endswith(".css")}
    return tuple(sheets[name] for name in sorted(sheets, key=lambda name: (name != _COMMON, name)))


_COMMON = "ehlectric.css"


@contextmanager
def framed(title: str, here: str) -> Iterator[None]:
    """Context in which the main part of a page is built."""
    for style in _styles():
        ui.add_css(style)
    with ui.element("header").classes("head"):
        ui.link("ehlectric", "/").classes("name")
        with ui.element("nav").props('aria-label="Pages"'):
            for address, name in LINKS:
                link = ui.link(name, address)
                if address == here:
                    link.props('aria-current="page"')
        ThemeButton()
    with ui.element("main").classes("page").props('tabindex="-1"') as main:
        ui.skip_link(target=main)
        heading(title, 1)
        yield


# Session of each tab, for the parts of its page. A session holds parts of the page that it tells of changes,
# and with them its tab: it is taken out when the tab ends.
_SESSIONS: dict[Client, Session] = {}


def session_here() -> Session | None:
    """Session of the present tab; None before it has one."""
    return _SESSIONS.get(ui.context.client)


def session_of(work: Work, inputs: Inputs) -> Session:
    """Session of the present tab, which ends with it."""
    session, client = Session(work, inputs), ui.context.client
    _SESSIONS[client] = session

    def end() -> None:
        del _SESSIONS[client]
        session.close()

    client.on_delete(end)
    return session


def show_address(inputs: Inputs, path: str) -> None:
    """Put the inputs into the address of the page."""
    ui.navigate.history.replace(f"{path}?{inputs.address()}")
