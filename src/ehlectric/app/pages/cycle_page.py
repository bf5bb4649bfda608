"""Page of one tab whose inputs may have a duty cycle, which is computed after all other answers."""

from __future__ import annotations

import asyncio
from typing import ClassVar, Generic, Protocol, TypeVar, cast

from ehlectric.app.calls import Call
from ehlectric.app.form_fields.field import VEHICLE_TABLE
from ehlectric.app.latest_answer import LatestAnswer
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.answer_page import AnswerPage
from ehlectric.app.pages.duty_box import DutyField, DutyView
from ehlectric.app.session import Session
from ehlectric.app.view_models import DutyAnswer, PageAnswer
from ehlectric.errors import InputError, LostError

_NOT_COMPUTED = "The duty cycle is not computed; its field says why."


class CycleAnswer(Protocol):
    """Answer that may contain the result of a duty cycle."""

    @property
    def duty(self) -> DutyAnswer | None:
        """Result of the duty cycle; None if it follows, or without a cycle."""


class CycleView(Protocol):
    """Place of an answer with a place for the result of a duty cycle."""

    duty: DutyView

    def place(self, *, cycle: bool) -> None:
        """State what belongs to the operating point if there is a duty ``cycle``."""


A = TypeVar("A", bound=PageAnswer)


class CyclePage(AnswerPage[A], Generic[A]):
    """Page with a field for the file of a duty cycle, and a place for its result."""

    cycle: ClassVar[Call[DutyAnswer]]  # function that computes the result of a duty cycle
    or_solve: ClassVar[str]  # what else computes a cycle that takes too long

    def __init__(self, session: Session) -> None:
        super().__init__(session)
        # A duty cycle takes several seconds: it follows the whole answer, behind the answers of other tabs.
        self._cycle: LatestAnswer[Inputs, DutyAnswer] = LatestAnswer(
            self._cycle_of,
            show=lambda _, answer: self._show_cycle(answer),
            passing=lambda *_: None,
            refuse=self._refuse_cycle,
            behind=session.work.behind,
        )

    @property
    def cycle_view(self) -> CycleView:
        """Place of the answer."""
        return cast("CycleView", self.view)

    def build_boxes(self) -> None:
        """Build the field of a duty cycle."""
        self.duty = DutyField(self.session, self.form, self.kind)

    def show_boxes(self) -> None:
        """Show the present inputs in the field of the duty cycle."""
        self.duty.refresh()

    def close(self) -> None:
        """Want no further answers."""
        super().close()
        self._cycle.drop()

    async def _cycle_of(self, inputs: Inputs) -> DutyAnswer:
        async with self.session.work.behind:
            if inputs != self.session.inputs:
                raise LostError("the inputs have changed")
            return await self.session.work.quick(self.cycle, dict(inputs.table), self.session.made_folder)

    def _ask(self, *, at_once: bool = False) -> asyncio.Future[None]:
        self._cycle.drop()
        return super()._ask(at_once=at_once)

    def _show(self, inputs: Inputs, answer: A) -> None:
        super()._show(inputs, answer)
        self.show_duty(inputs, answer, getattr(answer, "duty", None))

    def show_duty(self, inputs: Inputs, answer: A, duty: DutyAnswer | None) -> None:
        """Show the result of the duty cycle, or compute it after the whole answer."""
        view = self.cycle_view.duty
        if self.duty.file is None:
            view.show(None)
        elif self.duty.lost:
            view.fail(_NOT_COMPUTED)
        elif duty is not None:
            self._show_cycle(duty)
        else:
            view.wait()
            if answer.whole:
                self._cycle.ask(inputs)

    def _put(self, answer: A) -> None:
        self.cycle_view.place(cycle=self.duty.file is not None)
        super()._put(answer)

    def _show_cycle(self, answer: DutyAnswer) -> None:
        self.cycle_view.duty.show(answer, self.session.named)

    def _refuse_cycle(self, error: Exception) -> None:
        if isinstance(error, InputError) and str(error.key).startswith(f"{VEHICLE_TABLE}."):
            self.form.tell(error)
        else:
            # A command and a solution have more time than an answer of the page.
            further = f"; {self.or_solve}" if isinstance(error, LostError) else ""
            self.duty.refuse(f"{error}{further}")
        self.cycle_view.duty.fail(_NOT_COMPUTED)

    def _refuse(self, error: Exception) -> None:
        super()._refuse(error)
        self._cycle.drop()
        self.cycle_view.duty.stop()
