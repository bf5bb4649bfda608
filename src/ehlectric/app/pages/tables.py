"""Tables of the page that compares, as HTML in which every text of a user is escaped."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape

from ehlectric.app.answers.compare import Effect, InputRow, Result
from ehlectric.app.answers.files import file_title

# Words of the signs of inputs, for readers who cannot see that a row is marked.
_SIGNS = {"=": "equal", "≠": "≠ differs", "only A": "only in A", "only B": "only in B"}


def inputs_table(rows: Sequence[InputRow], labels: Mapping[str, str]) -> str:
    """Table of the inputs that differ, and of all others in a part that can be opened.

    Parameters
    ----------
    rows : sequence of InputRow
        Inputs of both cases.
    labels : mapping of str to str
        Names of the inputs by key.
    """
    differ = [row for row in rows if row.sign != "="]
    equal = [row for row in rows if row.sign == "="]
    first = (
        "<p>Both cases have the same inputs.</p>" if not differ else _inputs(differ, labels, "inputs-differ")
    )
    return f"{first}{_details(f'{len(equal)} inputs that are equal', _inputs(equal, labels, 'inputs-equal'))}"


def effects_table(effects: Sequence[Effect]) -> str:
    """Table of the results that decide, and of all others in a part that can be opened."""
    main = [effect for effect in effects if effect.either.main]
    others = [effect for effect in effects if not effect.either.main]
    return _effects(main) + _details(f"{len(others)} further results", _effects(others))


def _inputs(rows: Iterable[InputRow], labels: Mapping[str, str], test: str) -> str:
    body = ""
    for row in rows:
        own = _quoted(f"input-{row.key.replace('.', '-')}")
        body += (
            f"<tr{' class=differs' if row.sign != '=' else ''} data-testid={own}>"
            f"<th scope=row>{_named(labels.get(row.key, ''), row.key)}</th>"
            f"<td>{escape(row.first) or '–'}</td><td>{escape(row.second) or '–'}</td>"
            f"<td>{_SIGNS[row.sign]}</td></tr>"
        )
    return _table(("input", "A", "B", "A and B"), body, test)


def _effects(effects: Iterable[Effect]) -> str:
    body, group = "", None
    for effect in effects:
        either = effect.either
        if either.group != group:
            group = either.group
            body += f"<tr class=grouped><th colspan=4 scope=rowgroup>{escape(group)}</th></tr>"
        test = f"effect-{file_title(either.name)}"
        differs = "" if effect.words == "no change" else " class=differs"
        body += (
            f"<tr{differs} data-testid={_quoted(test)}><th scope=row>{escape(either.name)}</th>"
            f"{_cell(effect.first)}{_cell(effect.second)}<td>{escape(effect.words)}</td></tr>"
        )
    return _table(("result", "A", "B", "from A to B"), body, "effects")


def _cell(result: Result | None) -> str:
    if result is None:
        return "<td>–</td>"
    note = f"<span class=note>{escape(result.note)}</span>" if result.note else ""
    return f"<td>{escape(result.shown)}{note}</td>"


def _named(label: str, key: str) -> str:
    """Name of an input with its key beneath."""
    return f"{escape(label)}<span class=note>{escape(key)}</span>" if label else escape(key)


def _table(heads: Iterable[str], body: str, test: str) -> str:
    head = "".join(f"<th scope=col>{head}</th>" for head in heads)
    words = test.replace("-", " ")
    return (
        f'<div class=scroll tabindex=0 role=region aria-label="{words}"><table data-testid={test}>'
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>"
    )


def _details(words: str, inner: str) -> str:
    return f"<details><summary>{words}</summary>{inner}</details>"


def _quoted(text: str) -> str:
    return f'"{escape(text, quote=True)}"'
