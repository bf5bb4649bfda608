"""Pages of the app: what a browser shows, and what it does with what is typed there."""

from __future__ import annotations

from collections.abc import Callable

from ehlectric.app.pages import bearing, compare, contact, sweep
from ehlectric.app.pages.drive import page as drive
from ehlectric.app.work import Work

# Functions that add a page to the server, in the order of the links at its top.
PAGES: tuple[Callable[[Work], None], ...] = (bearing.add, drive.add, contact.add, sweep.add, compare.add)
