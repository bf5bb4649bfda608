"""Pages of the app: what a browser shows, and what it does with what is typed there."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from typing import Any

from ehlectric.app.pages import (
    axle_page,
    bearing_page,
    compare_page,
    contact_page,
    drive_page,
    gear_page,
    sweep_page,
)
from ehlectric.app.work import Work

# Functions that add a page to the server, in the order of the links at its top.
PAGES: tuple[Callable[[Work], None], ...] = (
    bearing_page.BearingPage.add,
    drive_page.DrivePage.add,
    gear_page.GearPage.add,
    axle_page.AxlePage.add,
    contact_page.ContactPage.add,
    sweep_page.add,
    compare_page.add,
)

# Computes the answers to the inputs with which the first page begins; returns the fullest one by its key.
FIRST: Callable[[Work], Coroutine[Any, Any, dict[str, Any]]] = bearing_page.BearingPage.answer_start
