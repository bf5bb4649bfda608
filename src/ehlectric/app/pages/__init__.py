"""Pages of the app: what a browser shows, and what it does with what is typed there."""

from __future__ import annotations

from collections.abc import Callable

from ehlectric.app.pages import bearing_page, compare_page, contact_page, sweep_page
from ehlectric.app.pages import drive_page as drive
from ehlectric.app.work import Work

# Functions that add a page to the server, in the order of the links at its top.
PAGES: tuple[Callable[[Work], None], ...] = (
    bearing_page.add,
    drive.add,
    contact_page.add,
    sweep_page.add,
    compare_page.add,
)
