"""Elements of a form in the browser: a field with slider, box or list, a group of fields, and the colours."""

from __future__ import annotations

from typing import Any

from nicegui import ui
from nicegui.element import Element

# Time for which a short message is shown [s].
_BRIEF = 8.0


def brief(label: ui.label, text: str) -> None:
    """Show a short message in a label for a while; an empty text takes it away."""
    label.text = text
    label.set_visibility(bool(text))
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


class GroupBox(_Shown, component="../static/group.js"):
    """Group of fields that opens and closes; it emits ``switch``."""

    def __init__(self, name: str, **props: Any) -> None:
        super().__init__()
        self.props.update(testid=name.lower().replace(" ", "-"), **props)


class ThemeButton(Element, component="../static/theme.js"):
    """Button for light, dark, or the colours of the system."""
