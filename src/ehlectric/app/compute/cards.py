"""Numbers that a page shows large, from the rows of the table that the command prints."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from ehlectric.app.answers.number import Number
from ehlectric.app.answers.told import Told
from ehlectric.quantities.rows import Row


def cards(rows: Iterable[Row], keys: Sequence[str]) -> list[Number]:
    """Numbers of some keys, in the order of the keys; those that no row has are left out.

    A key of the form "film_formulas.*.minimum_thickness" takes the first row of this form.
    """
    known = {row.key: row for row in reversed([*rows]) if row.key}
    found = []
    for key in keys:
        head, star, tail = key.partition("*")
        own = [one for one in reversed(known) if star and one.startswith(head) and one.endswith(tail)]
        if key in known or own:
            found.append(card(known[own[0] if own else key]))
    return found


def card(row: Row) -> Number:
    """Number of a row, with its label as a heading.

    Examples
    --------
    >>> found = card(Row("margin", 1.2, note=", of the film", key="discharge.margin"))
    >>> found.label, found.text, found.note
    ('Margin', '1.2', 'of the film')
    """
    label = f"{row.name[:1].upper()}{row.name[1:]}"
    return Number(row.key, label, row.shown, row.unit, row.note.strip(" ,;:"), row.bound)


def concerned(key: str) -> str:
    """Key under which warnings name a quantity: that of a film or a voltage by formula is the solved one.

    Examples
    --------
    >>> concerned("film_formulas.moes.central_thickness"), concerned("field.capacitance_per_length")
    ('film.central_thickness', 'field.capacitance')
    """
    table, _, name = key.partition(".")
    solved = {"film_formulas": "film", "breakdown_by_formula": "discharge"}.get(table, table)
    return f"{solved}.{name.rpartition('.')[2]}".removesuffix("_per_length")


def with_warnings(
    numbers: Iterable[Number], told: Sequence[Told]
) -> tuple[tuple[Number, ...], tuple[Told, ...]]:
    """Numbers with the warnings that concern them, and the warnings that concern none of them."""
    placed = tuple(
        replace(one, told=tuple(each for each in told if concerned(one.key) in each.beside))
        for one in numbers
    )
    keys = {concerned(one.key) for one in placed}
    return placed, tuple(each for each in told if not keys & set(each.beside))
