"""Box of the remedies of a drive: a short list of usual ones, and those of the file."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import Any

from nicegui import ui

from ehlectric.app.fields.drive_rules import PRESETS, changes_of, remedies_of, with_remedy, without_remedy
from ehlectric.app.pages.control import GroupBox
from ehlectric.app.session import Session

REMEDIES = "remedies"


class RemedyBox:
    """Group with a box to tick for each usual remedy, and a list of the others of the file.

    Parameters
    ----------
    session : Session
        Session of the tab.
    change : callable
        Called with key and new value, as by a form.
    """

    def __init__(self, session: Session, change: Callable[[str, Any], Awaitable[None]]) -> None:
        self._session, self._change = session, change
        self._boxes: dict[str, tuple[ui.checkbox, ui.label, ui.element]] = {}
        with (
            ui.element("div").classes("form").props('role="form" aria-label="Remedies"'),
            GroupBox("Remedies", title="Remedies to compare", opened=True),
        ):
            ui.label("Each is simulated beside the drive, with the same random numbers.").classes(
                "field-help"
            )
            for title in PRESETS:
                self._preset(title)
            self._others = ui.element("div")
        self.refresh()

    def refresh(self) -> None:
        """Show the remedies of the present inputs, as after an undo."""
        given = remedies_of(self._session.inputs)
        for title, (box, note, place) in self._boxes.items():
            found = given.get(title)
            changes = changes_of(self._session.inputs, title) if found is None else found
            place.set_visibility(changes is not None)
            box.set_value(found is not None)
            note.text = _text(changes or {})
        self._others.clear()
        with self._others:
            for title, changes in given.items():
                if title not in PRESETS:
                    self._other(title, changes)

    def _preset(self, title: str) -> None:
        with ui.element("div").classes("remedy") as place:
            box = ui.checkbox(title, on_change=partial(self._switched, title))
            box.props("dense").props["data-testid"] = f"remedy-{_name(title)}"
            note = ui.label().classes("field-note")
        self._boxes[title] = (box, note, place)

    async def _switched(self, title: str, event: Any) -> None:
        inputs = self._session.inputs
        if bool(event.value) == (title in remedies_of(inputs)):
            return
        changes = changes_of(inputs, title) if event.value else None
        after = without_remedy(inputs, title) if changes is None else with_remedy(inputs, title, changes)
        await self._put(after)

    def _other(self, title: str, changes: Mapping[str, Any]) -> None:
        async def removed() -> None:
            await self._put(without_remedy(self._session.inputs, title))

        with ui.element("div").classes("other"):
            ui.label(f"{title}: {_text(changes)}")
            button = ui.button("Remove", on_click=removed).props("flat dense no-caps")
            button.props["aria-label"] = f"Remove the remedy {title}"

    async def _put(self, remedies: list[Any]) -> None:
        await self._change(REMEDIES, remedies or None)
        self.refresh()


def _text(changes: Mapping[str, Any]) -> str:
    return ", ".join(f"{key} = {value}" for key, value in changes.items())


def _name(title: str) -> str:
    return title.lower().replace(" ", "-")
