"""Remedies on the page of a bearing: buttons, and what the pressed one makes of its voltages and margin."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from nicegui import ui

from ehlectric.app.calls import REMEDY_QUICK, REMEDY_WHOLE, Call
from ehlectric.app.catalogue import choices, oil_needs
from ehlectric.app.form_fields.drive_fields import BEARING_REMEDIES, remedy_at_bearing, with_remedy
from ehlectric.app.latest_answer import LatestAnswer
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import PATHS, address_of, drive_with
from ehlectric.app.pages.page_parts import Choices, Control, follow, heading, say
from ehlectric.app.pages.result_parts import table_html
from ehlectric.app.session import Session
from ehlectric.app.view_models import RemedyAnswer
from ehlectric.errors import InputError

_OIL = "Other oil"

_SECOND = (
    "The drive has this bearing at both ends, instead of the given capacitance of the second bearing: "
    "its shaft voltage differs."
)

# Bearing, and its drive with the remedy.
Both = tuple[Inputs, Inputs]


class RemediesBox:
    """Place for the buttons, the table of the pressed button, and the link into its drive."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._pressed = False  # whether a remedy was just pressed, whose effect is brought into sight
        self._oil = ""  # oil of the list; empty for the first that differs from the bearing's oil
        self.latest_answer: LatestAnswer[Both, RemedyAnswer] = LatestAnswer(
            lambda both: self._answer(REMEDY_QUICK, both),
            [lambda both: self._answer(REMEDY_WHOLE, both)],
            show=lambda _, answer: self._show(answer),
            passing=lambda *_: None,
            refuse=lambda error: self._tell(str(error)),
            behind=session.work.behind,
        )
        with ui.element("section").classes("helps").props('aria-label="What would help"') as self._box:
            self._box.props('data-testid="helps"')
            heading("What would help", 2)
            self._choices = Choices(BEARING_REMEDIES, "Mitigation measures", self._press)
            self._list = Control("remedy.oil", kind="list", label="Oil", options=_oils())
            self._list.on("commit", self._other_oil)
            with ui.element("div").props('aria-live="polite" data-testid="helps-effect"') as self._effect:
                self._table = ui.html("", sanitize=False)
                self._assumed = ui.label().classes("soft").props('data-testid="helps-assumed"')
                self._link = ui.link("See it in its drive", PATHS["drive"]).props('data-testid="helps-drive"')
                self._message = ui.label().classes("soft").props('role="status" data-testid="helps-told"')
        for part in (self._box, self._list, self._effect):
            part.set_visibility(False)

    async def _answer(self, call: Call[RemedyAnswer], both: Both) -> RemedyAnswer:
        bearing, drive = (dict(inputs.table) for inputs in both)
        return await self._session.work.quick(call, bearing, drive, self._session.made_folder)

    def wait(self) -> None:
        """Dim what belongs to earlier inputs."""
        self.latest_answer.drop()
        follow(self._effect, on=bool(self._table.content))

    def offer(self) -> Mapping[str, Any] | None:
        """Offer what the present bearing has not yet. Returns the pressed remedy; None without one."""
        inputs = self._session.inputs
        remedies = {name: remedy_at_bearing(inputs, name, self._oil) for name in BEARING_REMEDIES}
        self._box.set_visibility(True)
        self._choices.offer([name for name, remedy in remedies.items() if remedy is not None])
        return remedies.get(self._choices.chosen)

    def refresh(self) -> None:
        """Ask for the effect of the pressed remedy."""
        self.latest_answer.drop()
        inputs = self._session.inputs.changed({"duty": None})
        remedy = self.offer()
        self._effect.set_visibility(remedy is not None)
        self._list.set_visibility(remedy is not None and self._choices.chosen == _OIL)
        if remedy is not None:
            self._ask(inputs, remedy)

    def _ask(self, inputs: Inputs, remedy: Mapping[str, Any]) -> None:
        self._list.show(text=remedy["changes"].get("bearings.lubricant.base", ""))
        try:
            remedies = with_remedy(Inputs(), remedy["title"], remedy["changes"])
            drive = drive_with(inputs).changed({"remedies": remedies})
        except InputError as error:
            self._tell(str(error))
            return
        say(self._assumed, remedy["assumed"].format(rise=drive.value("source.rise_time")))
        self._link.set_visibility(drive.linkable)
        self._link.props["href"] = address_of(PATHS["drive"], drive)
        self._link.update()
        second = inputs.value("motor.second_bearing_capacitance") is not None
        say(self._message, _SECOND if second else "")
        follow(self._effect, on=bool(self._table.content))
        self.latest_answer.ask((inputs, drive))

    def _show(self, answer: RemedyAnswer) -> None:
        self._table.content = table_html(answer.table)
        if self._pressed:
            self._pressed = False
            element = f'document.getElementById("{self._effect.html_id}")'
            with self._effect:
                ui.run_javascript(f"setTimeout(() => {element}?.scrollIntoView({{block: 'nearest'}}), 50)")
        self._effect.props(f'data-whole="{str(answer.whole).lower()}"')
        follow(self._effect, on=False)

    def _tell(self, text: str) -> None:
        """Say why there is no effect."""
        self._table.content = ""
        self._link.set_visibility(False)
        follow(self._effect, on=False)
        say(self._message, text)

    def _press(self, name: str) -> None:
        """Show the effect of a pressed remedy, on the screen where it is below."""
        self._pressed = bool(name)
        self.refresh()

    def _other_oil(self, event: Any) -> None:
        self._oil = str(event.args)
        self.refresh()


def _oils() -> list[dict[str, str]]:
    """Entries of the oils of the library that have all that films and voltages need."""
    oils = (oil for oil in choices()["lubricant.base"] if not oil_needs(oil.name))
    return [{"value": oil.name, "label": oil.label, "group": oil.group} for oil in oils]
