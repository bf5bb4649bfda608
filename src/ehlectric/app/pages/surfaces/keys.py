"""Fields of one table of an input file, with the error of each beside it."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from html import escape
from typing import Any

from nicegui import ui

from ehlectric.app.roughness_keys import RoughKey, value_of

Changed = Callable[[str, Any], Awaitable[None]]


class Keys:
    """Fields of a table.

    Parameters
    ----------
    table : str
        Name of the table, before the keys in errors and in test marks.
    keys : sequence of RoughKey
        Fields in their order.
    values : mapping
        Present values by key.
    changed : callable
        Called with a key and its new value, None for an empty field.
    """

    def __init__(
        self, table: str, keys: Sequence[RoughKey], values: Mapping[str, Any], changed: Changed
    ) -> None:
        self._table, self._changed = table, changed
        self._errors: dict[str, tuple[ui.label, ui.element]] = {}
        with ui.element("div").classes("key-fields"):
            for key in keys:
                self._field(key, values.get(key.key))

    def tell(self, error: Exception | None) -> bool:
        """Show an error beside its field, and take away others; False where no field here has its key."""
        name = str(getattr(error, "key", None) or "").removeprefix(f"{self._table}.")
        for key, (label, box) in self._errors.items():
            wrong = error is not None and key == name
            label.text = str(error) if wrong else ""
            label.set_visibility(wrong)
            box.props(f"aria-invalid={'true' if wrong else 'false'}")
        return name in self._errors

    def _field(self, key: RoughKey, value: Any) -> None:
        async def typed(event: Any) -> None:
            found = event.args if isinstance(event.args, str) else ""
            keep(found)
            await self._changed(key.key, value_of(key, found))

        name = f"{self._table}-{key.key}"
        text = "true" if value is True else "" if value is None else str(value)
        with ui.element("div").classes("key"):
            ui.html(escape(key.label), sanitize=False, tag="label").props(f'for="{name}"')
            box, keep = _box(key, text)
            box.props(f'id="{name}" data-testid="field-{name}" aria-describedby="{name}-error"')
            box.on("change", typed, js_handler="(event) => emit(event.target.value)")
            label = ui.label().classes("error").props(f'id="{name}-error" role="alert"')
            label.props(f'data-testid="error-{name}"')
            label.set_visibility(False)
            self._errors[key.key] = (label, box)


def _box(key: RoughKey, text: str) -> tuple[ui.element, Callable[[str], None]]:
    """Field, and the function that keeps what was typed there when the page draws it again."""
    if not key.choices:
        box = ui.element("input").props('type="text" autocomplete="off" spellcheck="false"')
        box.props["placeholder"] = f"for example {key.example}" if key.example else ""

        def typed(found: str) -> None:
            # The attribute, not the value: each answer draws the whole page again, and would write the value
            # over what is being typed.
            box.props["^value"] = found

        typed(text)
        return box, typed
    options: dict[str, ui.html] = {}
    with ui.element("select") as box:
        for choice, label in key.choices.items():
            options[choice] = ui.html(escape(label), sanitize=False, tag="option")
            options[choice].props["value"] = choice

    def chosen(found: str) -> None:
        for choice, option in options.items():
            option.props.set_bool("selected", choice == (found or next(iter(key.choices))))

    chosen(text)
    return box, chosen
