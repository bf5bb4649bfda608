"""Page of a bearing, which says whether it sparks, and what changes that."""

from __future__ import annotations

import asyncio
from typing import Any

from fastapi import Request
from nicegui import ui

from ehlectric.app.answers.bearing import BearingAnswer
from ehlectric.app.answers.calls import BEARING_QUICK, BEARING_SOLVED, BEARING_WHOLE
from ehlectric.app.fields import BEARING_GROUPS
from ehlectric.app.following import Following
from ehlectric.app.inputs import Inputs
from ehlectric.app.pages.bearing_answer import AnswerView
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.frame import PAGE_PATIENCE, framed, session_of, show_address
from ehlectric.app.pages.parts import Strip
from ehlectric.app.pages.solving import Solving, Words
from ehlectric.app.pages.starts import BEARING
from ehlectric.app.pages.toolbar import Toolbar
from ehlectric.app.session import Session
from ehlectric.app.work import Work
from ehlectric.errors import InputError

# Numbers of the short answer.
_SHORT = ("bearing.capacitance", "bearing.margin")

_WORDS = Words(
    solve="Solve the contacts",
    show_solved="Show the solved contacts",
    show_quick="Show the quick answer",
    back="Back to the solved inputs",
    earlier="The solved result is of earlier inputs.",
    running="The contacts being solved are those of earlier inputs.",
    done="The contacts of earlier inputs are solved.",
    cancelled="Cancelled: no contacts were kept.",
    failed="Not solved",
    beyond="or solved contacts",
)

# Time for which the page waits for its first answer before it is sent without one [s].
_FIRST = 1.0


def add(work: Work) -> None:
    """Add the page to the server."""

    @ui.page("/", response_timeout=PAGE_PATIENCE)
    async def page(request: Request) -> None:
        inputs, error = Inputs.of_link(request.query_params.multi_items(), BEARING)
        page = BearingPage(session_of(work, inputs))
        ui.context.client.on_delete(page.close)
        with framed("Does this bearing spark?", "/"):
            page.build(error)
        # The first answer comes with the page, unless the processes are still starting.
        await asyncio.wait([page.refresh()], timeout=_FIRST)


class BearingPage:
    """Page of one tab.

    Parameters
    ----------
    session : Session
        Session of the tab.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        work = session.work
        self._following: Following[Inputs, BearingAnswer] = Following(
            lambda inputs: work.quick(BEARING_QUICK, dict(inputs.table), session.made_folder),
            lambda inputs: work.quick(BEARING_WHOLE, dict(inputs.table), session.made_folder),
            show=self._show,
            passing=lambda _, answer: self._put(answer),
            refuse=self._refuse,
            behind=work.behind,
        )

    def build(self, error: InputError | None) -> None:
        """Build the form and the places of the answer; with the error of a wrong address."""
        self._strip = Strip()
        Toolbar(self.session, "/", self.shown_again)
        self._address = ui.label(_wrong(error)).classes("notice wrong")
        self._address.props('role="alert" data-testid="error-address"').set_visibility(error is not None)
        with ui.element("div").classes("columns"):
            self.form = Form(BEARING_GROUPS, self.session.inputs, self.change)
            with ui.element("section").classes("answer").props('aria-label="Answer"'):
                self.solving = Solving(BEARING_SOLVED, _WORDS, self.session, self._ask, self.go_to)
                self._notice = ui.label().classes("notice wrong").props('data-testid="notice"')
                self._notice.set_visibility(False)
                button = ui.button("Go to the field", on_click=self.form.go_to_wrong, color=None)
                button.props("no-caps dense data-testid=to-field")
                button.bind_visibility_from(
                    self._notice, "visible", lambda told: told and self.form.wrong is not None
                )
                self.view = AnswerView()
                self._downloads = Downloads(self.session, "bearing", self.solving.folder)

    async def change(self, key: str, value: Any) -> None:
        """Take over a changed input, and answer."""
        self.session.history.push(self.session.inputs.changed({key: value}))
        self._show_address()
        self.refresh()

    def go_to(self, inputs: Inputs) -> None:
        """Make other inputs the present ones, as after a step back."""
        self.session.history.push(inputs)
        self.shown_again()

    def shown_again(self) -> None:
        """Show the present inputs in the form and in the address, and answer them."""
        self.form.set(self.session.inputs)
        self._show_address()
        self.refresh()

    def _show_address(self) -> None:
        """Put the inputs into the address; one that cannot hold them stays as it is."""
        self._address.set_visibility(False)
        if self.session.inputs.linkable:
            show_address(self.session.inputs, "/")

    def refresh(self) -> asyncio.Future[None]:
        """Answer the present inputs.

        Returns
        -------
        asyncio.Future
            Ends with the answer at once.
        """
        self.solving.forget()
        return self._ask()

    def close(self) -> None:
        """Want no further answers."""
        self._following.drop()

    def _ask(self) -> asyncio.Future[None]:
        """Show the solved answer where there is one, or ask for the quick one; the one before is dimmed."""
        solved = self.solving.answer()
        if solved is None:
            self._dim(dimmed=True)
            return self._following.ask(self.session.inputs)
        self._following.drop()
        self._show(self.session.inputs, solved)
        ended = asyncio.get_running_loop().create_future()
        ended.set_result(None)
        return ended

    def _show(self, _: Inputs, answer: BearingAnswer) -> None:
        self._put(answer)
        self._dim(dimmed=False)
        self.form.tell(None)
        self._notice.set_visibility(False)
        self.solving.show(answer)
        self._downloads.look()

    def _put(self, answer: BearingAnswer) -> None:
        self.view.show(answer)
        named = [one for one in answer.shown if one.key in _SHORT and one.known]
        texts = [" ".join(filter(None, [one.label, one.bound, one.text, one.unit])) for one in named]
        self._strip.show(answer.level, answer.judged.lead, texts, bound=answer.judged.bound)

    def _dim(self, *, dimmed: bool) -> None:
        self.view.dim(dimmed=dimmed)
        self._strip.dim(dimmed=dimmed)

    def _refuse(self, error: Exception) -> None:
        self.form.tell(error)
        self.view.stop()
        self.solving.show(None, error)
        earlier = ". The answer below is that to earlier inputs." if self.view.shown else ""
        self._notice.text = f"{self.form.words(error)}{earlier}"
        self._notice.set_visibility(True)


def _wrong(error: InputError | None) -> str:
    return "" if error is None else f"{error}. The example is shown in place of the inputs of the address."
