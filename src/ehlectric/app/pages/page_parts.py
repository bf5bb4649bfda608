"""Parts of the pages: headings, cards, fields, the short answer of narrow screens, tables, figures, jobs."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Collection, Iterable, Iterator, Mapping, Sized
from contextlib import contextmanager
from functools import cache, partial
from html import escape
from importlib import resources
from time import monotonic
from typing import Any
from weakref import WeakMethod

from nicegui import ui
from nicegui.element import Element
from nicegui.elements import plotly  # noqa: F401  # the module that figures load in the browser

from ehlectric.app.calls import Call
from ehlectric.app.session import Session
from ehlectric.app.view_models import Line
from ehlectric.app.work import Job, TimeLeft
from ehlectric.errors import InputError, LostError
from ehlectric.quantities.quantity import data_file


@cache
def page_texts(name: str) -> dict[str, Any]:
    """Part of ``page_texts.toml``, whose head says what its parts are."""
    part: dict[str, Any] = data_file("ehlectric.app", "page_texts.toml")[name]
    return part


@cache
def script(name: str) -> str:
    """JavaScript of a file that lies with the style sheets."""
    folder = resources.files("ehlectric.app").joinpath("static")
    return folder.joinpath(f"{name}.js").read_text(encoding="utf-8").rstrip()


def weakly(method: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Function that calls a method for as long as its object lives.

    The framework keeps the routes of uploads and the functions that they call long after the end of a page.
    With this function it does not keep the page as well.

    Examples
    --------
    >>> class Page:
    ...     def told(self, text):
    ...         return text.upper()
    >>> page = Page()
    >>> told = weakly(page.told)
    >>> told("a file")
    'A FILE'
    >>> del page
    >>> told("another") is None
    True
    """
    reference = WeakMethod(method)

    def call(argument: Any) -> Any:
        bound = reference()
        return None if bound is None else bound(argument)

    return call


def mark(element: Element, name: str, *, on: bool) -> None:
    """Add a class of the style sheets to an element, or remove it."""
    element.classes(add=name if on else None, remove=None if on else name)


def follow(element: Element, *, on: bool) -> None:
    """Dim a part that belongs to earlier inputs, with words that its new values follow, or show it again."""
    for name in ("stale", "follows"):
        mark(element, name, on=on)


def say(label: ui.label, text: str) -> None:
    """Show a text in a label; an empty text hides the label."""
    label.text = text
    label.set_visibility(bool(text))


# Time for which a short message is shown [s].
_BRIEF = 8.0


def brief(label: ui.label, text: str) -> None:
    """Show a short message in a label for a while; an empty text takes it away."""
    say(label, text)
    if not text:
        return

    def over() -> None:
        if label.text == text:
            label.set_visibility(False)

    with label:
        ui.timer(_BRIEF, over, once=True)


class _Shown(Element):
    """Element that sends to the browser only what changed."""

    def show(self, **props: Any) -> None:
        """Show other properties; nothing is sent where they are the present ones."""
        changed = {name: value for name, value in props.items() if self.props.get(name) != value}
        if changed:
            self.props.update(changed)
            self.update()

    def turn(self, **props: Any) -> None:
        """Show properties again, also where only the browser has others."""
        self.show(turn=int(self.props.get("turn", 0)) + 1, **props)


class Control(_Shown, component="../static/control.js"):
    """Field of a form.

    It emits ``commit`` with a text that was typed or chosen, and ``slide`` with a place from 0 to 1.
    """

    def __init__(self, key: str, **props: Any) -> None:
        super().__init__()
        self.props.update(testid=key.replace(".", "-"), **{"box-id": f"box{self.id}"}, **props)

    def focus(self) -> None:
        """Move the page and the focus to the field."""
        ui.run_javascript(
            f"const box = document.getElementById({json.dumps(self.props['box-id'])});"
            "if (box) { box.scrollIntoView({block: 'center'}); box.focus({preventScroll: true}); }"
        )


# Most entries of a list without a search.
_LONGEST_LIST = 6


def kind_of_list(options: Sized) -> str:
    """Kind of the field of a list to choose from: one with a search where it is long."""
    return "list" if len(options) <= _LONGEST_LIST else "search"


def control(
    name: str,
    label: str,
    typed: Callable[[str], Awaitable[None]],
    options: Mapping[str, str] | None = None,
    *,
    kind: str = "",
) -> Control:
    """Field for a text, or list of options to choose from, which can be searched where it is long, unless a
    kind is given.
    """
    kind = kind or ("text" if options is None else kind_of_list(options))
    listed = [{"value": value, "label": text, "group": ""} for value, text in (options or {}).items()]
    made = Control(name, kind=kind, label=label, options=listed)

    async def committed(event: Any) -> None:
        await typed(str(event.args).strip())

    made.on("commit", committed)
    return made


class GroupBox(_Shown, component="../static/group.js"):
    """Group of fields that opens and closes under its name, or another title; it emits ``switch``."""

    def __init__(self, name: str, **props: Any) -> None:
        super().__init__()
        self.props.update({"testid": name.lower().replace(" ", "-"), "title": name, **props})


class ThemeButton(Element, component="../static/theme.js"):
    """Button for light, dark, or the colours of the system."""


# Signs of the levels.
_SIGNS = {"green": "✓", "yellow": "!", "red": "✕", "grey": "?"}


def heading(text: str, level: int) -> Element:
    """Heading of a level from 1 to 6."""
    with ui.element(f"h{level}") as made:
        ui.html(escape(text), sanitize=False, tag="span")
    return made


def address_error(error: InputError | None) -> None:
    """Line on the error of a wrong address; nothing without one."""
    if error is not None:
        ui.label(str(error)).classes("wrong").props('role="alert" data-testid="error-address"')


def button(
    text: str, test: str, click: Callable[[], Any], look: str = "flat no-caps", *, primary: bool = False
) -> ui.button:
    """Button without a colour, or the main one of its part of the page."""
    made = ui.button(text, on_click=click, color=None).props(look)
    # A test identifier may hold a text of a user, which must not be parsed as properties.
    made.props["data-testid"] = test
    return made.classes("primary") if primary else made


def tool(text: str, test: str, click: Callable[[], Any]) -> ui.button:
    """Outlined button of a toolbar or of a row of downloads."""
    return ui.button(text, on_click=click).props(f'outline no-caps dense data-testid="{test}"')


def removable(text: str, name: str, remove: Callable[[], Any]) -> None:
    """Line with a button that removes what it names."""
    with ui.element("div").classes("other"):
        ui.label(text)
        removes = ui.button("Remove", on_click=remove).props("flat dense no-caps")
        removes.props["aria-label"] = f"Remove {name}"


class Choices:
    """Row of buttons of which one is pressed; ``choose`` is called with its name, or "" for none.

    The pressed one is released by a second press, unless one is ``always`` pressed.
    """

    def __init__(
        self, names: Iterable[str], label: str, choose: Callable[[str], object], *, always: bool = False
    ) -> None:
        self.chosen, self._choose, self._always = "", choose, always
        with ui.element("div").classes("buttons").props("role=group") as box:
            self._buttons = {
                name: button(
                    name,
                    f"choose-{name.lower().replace(' ', '-')}",
                    partial(self.press, name),
                    "no-caps dense",
                )
                for name in names
            }
        box.props["aria-label"] = label
        self.show("")

    def press(self, name: str) -> None:
        """Press a button, or release the pressed one."""
        self.show("" if name == self.chosen and not self._always else name)
        self._choose(self.chosen)

    def show(self, chosen: str) -> None:
        """Show a button as the pressed one."""
        self.chosen = chosen
        for name, element in self._buttons.items():
            element.props(f'aria-pressed="{str(name == chosen).lower()}"')
            mark(element, "primary", on=name == chosen)

    def offer(self, names: Collection[str]) -> None:
        """Hide all buttons except these; a hidden one is released."""
        for name, element in self._buttons.items():
            element.set_visibility(name in names)
        if self.chosen not in names:
            self.show(next(iter(names), "") if self._always else "")


@contextmanager
def card(title: str) -> Iterator[ui.element]:
    """Context of a section with a heading of level 2."""
    with ui.element("section").classes("card") as section:
        heading(title, 2)
        yield section


_TO_ANSWER = "() => document.querySelector('.answer')?.scrollIntoView({ block: 'start' })"


class Strip:
    """Short answer that stays at the top of a narrow screen while inputs change; build it in the page itself.

    A screen reader has the answer itself, so that it does not read this one; the button leads to it.
    """

    def __init__(self) -> None:
        with ui.element("div").classes("strip grey").props('data-testid="strip"') as self._box:
            self._word = ui.label().classes("word").props('aria-hidden="true"')
            self._numbers = ui.label().props('aria-hidden="true"')
            leads = ui.element("button").classes("to-answer").props('type="button" data-testid="to-answer"')
            leads.on("click", js_handler=_TO_ANSWER)
            with leads:
                ui.html("Answer", sanitize=False, tag="span")

    def show(
        self, level: str, word: str, numbers: Iterable[str] = (), *, bound: str = "", state: str = ""
    ) -> None:
        """Show the level of a verdict, its word and bound, and a few numbers such as the margin. ``state``
        contains words before them, such as "after the measurement".
        """
        self._box.classes(replace=f"strip {level}")
        self._word.text = f"{_SIGNS[level]} {word}"
        self._numbers.text = " · ".join(filter(None, [state, bound, *numbers]))

    def dim(self, *, dimmed: bool) -> None:
        """Dim the answer while it belongs to earlier inputs."""
        mark(self._box, "old", on=dimmed)


def scrolling_table(name: str, heads: Iterable[str], body: str, test: str = "", caption: str = "") -> str:
    """Table that scrolls within its own box; the rows of its body, and its caption, are HTML."""
    head = "".join(f'<th scope="col">{escape(text)}</th>' for text in heads)
    table = f"{caption}<thead><tr>{head}</tr></thead><tbody>{body}</tbody>"
    return (
        f'<div class="scroll" tabindex="0" role="region" aria-label="{escape(name)}">'
        f'<table data-testid="{test}">{table}</table></div>'
    )


def lines_html(lines: Iterable[Line], caption: str) -> str:
    """Table of the lines that the command prints, with a caption for screen readers."""
    rows = []
    for line in lines:
        name, look = escape(line.name), " class=alarm" if line.alarm else ""
        if line.text:
            rows.append(f"<tr{look}><th scope=row>{name}</th><td>{escape(line.text)}</td></tr>")
        else:
            rows.append(f"<tr><th scope=rowgroup colspan=2>{name}</th></tr>")
    head = f"<caption class=unseen>{escape(caption)}</caption>"
    return f"<div class=scroll><table class=rows>{head}<tbody>{''.join(rows)}</tbody></table></div>"


class Plot(Element, component="../static/figure.js"):
    """Figure of Plotly that can be zoomed; the browser gets the whole figure once, and then what changed."""

    def __init__(self, figure: Mapping[str, Any], label: str) -> None:
        super().__init__()
        self.classes("figure js-plotly-plot")
        self._content: dict[str, Any] = {}
        self._revision = 0
        # A browser that missed a change gets the whole figure.
        self.on("behind", self.update)
        self.show(figure, label)

    def show(self, figure: Mapping[str, Any], label: str) -> None:
        """Show a figure; ``label`` says to a screen reader what it shows."""
        before, self._content = self._content, {**figure, "label": label}
        changes = [*changes_of(before, self._content)]
        if not changes:
            return
        self._revision += 1
        with self.props.suspend_updates():
            # As items: in a text of properties, a label could hold further properties, which browsers run.
            self.props.update(options=self._content, revision=self._revision)
        if before.keys() == self._content.keys():
            self.run_method("change", self._revision, changes)
        else:
            self.update()


def changes_of(
    before: Any, after: Any, path: tuple[str | int, ...] = ()
) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Paths of the parts of a figure that changed, with their new values.

    Examples
    --------
    >>> before = {"data": [{"name": "film", "y": [1.0, 2.0]}, {"name": "gap", "y": [3.0]}], "layout": {}}
    >>> after = {"data": [{"name": "film", "y": [1.0, 4.0]}, {"name": "gap", "y": [3.0]}], "layout": {}}
    >>> [*changes_of(before, after)]
    [(('data', 0, 'y'), [1.0, 4.0])]
    """
    if isinstance(before, Mapping) and isinstance(after, Mapping) and before.keys() == after.keys():
        for key, value in after.items():
            yield from changes_of(before[key], value, (*path, key))
    elif _alike(before, after):
        for place, value in enumerate(after):
            yield from changes_of(before[place], value, (*path, place))
    elif before != after:
        yield path, after


def _alike(before: Any, after: Any) -> bool:
    """Whether both are lists of as many tables."""
    lists = isinstance(before, list) and isinstance(after, list) and len(before) == len(after)
    return lists and all(isinstance(part, Mapping) for part in (*before, *after))


class JobBox:
    """Progress of a job, with a button that cancels it.

    ``done`` is called with the job when it has ended in any way, ``refused`` with the error where it cannot
    be started.
    """

    def __init__(
        self, session: Session, done: Callable[[Job], Any], refused: Callable[[LostError], object]
    ) -> None:
        self._session, self._done, self._refused = session, done, refused
        self._job: Job | None = None
        self._left = TimeLeft()
        with ui.element("div").classes("job").props('aria-live="polite"') as self._box:
            self._bar = ui.element("progress").props('max=1 aria-label="Progress" data-testid="progress"')
            self._text = ui.label().classes("job-text")
            button("Cancel", "cancel", self.cancel)
        self._timer = ui.timer(0.2, self._look, active=False)
        self._box.set_visibility(False)

    def start(self, function: Call[Any], *values: Any) -> Job | None:
        """Start a job, and show it until it ends; None where it is refused."""
        try:
            self._job = self._session.work.start(function, *values)
        except LostError as error:
            self._refused(error)
            return None
        self._left = TimeLeft()
        self._box.set_visibility(True)
        self._timer.activate()
        return self._job

    def cancel(self) -> None:
        """Cancel the job."""
        if self._job is not None:
            self._job.cancel()

    async def _look(self) -> None:
        job = self._job
        if job is None:
            return
        self._bar.props(f"value={job.done / job.of:.4f}" if job.of else "", remove="" if job.of else "value")
        left = self._left.text_of(job.text, job.done, job.of, now=monotonic())
        count = f"{job.text}: {job.done} of {job.of}" if job.of else job.text
        self._text.text = ", ".join(filter(None, [count, left]))
        if job.over:
            self._timer.deactivate()
            self._box.set_visibility(False)
            self._job = None
            awaitable = self._done(job)
            if awaitable is not None:
                await awaitable
