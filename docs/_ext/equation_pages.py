"""Index of equations, from comments below the labels of displayed equations.

A comment such as ``% equation: reduced radius and modulus; ehlectric.formulas.hertz.reduced_radius`` follows
the line that ends an equation with its label. It gives the quantity and the function that computes it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

_COMMENT = "% equation:"
_EQUATION = re.compile(rf"^\$\$ \(([\w-]+)\)\n{_COMMENT} ([^;\n]+)(?:; ([\w.]+))?$", re.MULTILINE)


class Equation(NamedTuple):
    """An equation of a page: label, page relative to the pages, quantity, and path of the function or ""."""

    label: str
    page: Path
    quantity: str
    function: str


def equation_pages(root: Path) -> dict[str, str]:
    """Return the table of the page of equations by its name, from the pages below ``root``.

    Raises ValueError if a comment does not follow a label, and LookupError if a function does not exist.
    """
    lines = ["| quantity | equation | page | function |", "| --- | --- | --- | --- |"]
    titles = {}
    for equation in equations(root):
        if equation.page not in titles:
            text = (root / equation.page).read_text(encoding="utf-8")
            titles[equation.page] = text.split("# ", 1)[1].split("\n", 1)[0]
        page = f"[{titles[equation.page]}](/{equation.page.as_posix()})"
        function = f"`{equation.function}`" if equation.function else "–"
        lines.append(f"| {equation.quantity} | {{eq}}`{equation.label}` | {page} | {function} |")
    return {"equations": "\n".join(lines) + "\n"}


def equations(root: Path) -> Iterator[Equation]:
    """Yield the equations with a comment, page by page, and check their functions."""
    for path in sorted(root.glob("[a-z]*/*.md")):
        text = path.read_text(encoding="utf-8")
        page = path.relative_to(root)
        matches = list(_EQUATION.finditer(text))
        if len(matches) != text.count(f"\n{_COMMENT}"):
            raise ValueError(f"{page}: a comment '{_COMMENT}' must follow the label of an equation")
        for match in matches:
            label, quantity, function = match.groups(default="")
            if function:
                _check(page, function)
            yield Equation(label, page, quantity.strip(), function)


def _check(page: Path, function: str) -> None:
    """Raise LookupError unless a function or class, or the method of a class, exists."""
    module, *names = re.split(r"\.(?=[A-Z])|\.(?=\w+$)", function, maxsplit=1)
    thing = import_module(module)
    for name in ".".join(names).split("."):
        if not hasattr(thing, name):
            raise LookupError(f"{page}: {function} does not exist")
        thing = getattr(thing, name)
