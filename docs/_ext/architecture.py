"""Picture of the packages and their imports, drawn from the import contract and the imports themselves."""

from __future__ import annotations

import ast
import tomllib
from collections import Counter
from importlib import import_module
from pathlib import Path
from textwrap import fill
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch
from sphinx.application import Sphinx

import ehlectric

PACKAGE = Path(ehlectric.__file__).parent
_WIDTH, _HEIGHT, _FLOOR = 3.0, 0.92, 1.32  # of a box, and from layer to layer, in units of the picture
# Moved aside, so that arrows between other packages pass beside these boxes.
_SHIFTED = {"cases": 3.2, "lubricant": 0.3, "runtime": -0.3}
_COLOURS = {"arrow": "#7a869a", "box": "#e8eef7", "edge": "#34527a", "text": "#14263d"}


def layers(root: Path) -> list[list[str]]:
    """Packages of the import contract from the top, those of one layer together."""
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))
    contract = project["tool"]["importlinter"]["contracts"][0]["layers"]
    rows = [[name.strip() for name in layer.split("|")] for layer in contract]
    return [row for row in rows if any((PACKAGE / name).is_dir() for name in row)]


def imports() -> Counter[tuple[str, str]]:
    """Number of imports of modules of one package by modules of another."""
    found: Counter[tuple[str, str]] = Counter()
    for path in PACKAGE.rglob("*.py"):
        own = path.relative_to(PACKAGE).parts[0]
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith("ehlectric."):
                other = node.module.split(".")[1]
                if other != own and (PACKAGE / other).is_dir() and (PACKAGE / own).is_dir():
                    found[own, other] += 1
    return found


def direct(found: Counter[tuple[str, str]]) -> list[tuple[str, str]]:
    """Imports that do not follow from others: the upper package reaches the lower one by no other way."""
    below: dict[str, set[str]] = {}
    for upper, lower in found:
        below.setdefault(upper, set()).add(lower)

    def reached(name: str) -> set[str]:
        return set().union(*({other} | reached(other) for other in below.get(name, set())))

    return sorted(
        (upper, lower)
        for upper, lower in found
        if not any(lower in reached(other) for other in below[upper] - {lower})
    )


def draw(root: Path) -> Figure:
    """Packages as boxes in the layers of the import contract, with the imports between them as arrows."""
    rows = layers(root)
    figure = Figure(figsize=(6.2, 8.6), layout="constrained")
    ax = figure.add_subplot()
    places = {}
    for level, row in enumerate(reversed(rows)):
        for k, name in enumerate(row):
            shift = _SHIFTED.get(name, 0.0)
            places[name] = ((k - 0.5 * (len(row) - 1)) * (_WIDTH + 0.3) + shift, _FLOOR * level)
    for upper, lower in direct(imports()):
        (x0, y0), (x1, y1) = places[upper], places[lower]
        _arrow(ax, (x0, y0), (x1, y1))
    for name, (x, y) in places.items():
        _box(ax, name, x, y)
    ax.set_xlim(-5.2, 5.2)
    ax.set_ylim(-_HEIGHT, _FLOOR * (len(rows) - 1) + _HEIGHT)
    ax.axis("off")
    return figure


def _box(ax: Axes, name: str, x: float, y: float) -> None:
    corner = x - 0.5 * _WIDTH, y - 0.5 * _HEIGHT
    ax.add_patch(
        FancyBboxPatch(
            corner,
            _WIDTH,
            _HEIGHT,
            boxstyle="round,pad=0.02,rounding_size=0.1",
            fc=_COLOURS["box"],
            ec=_COLOURS["edge"],
            lw=1.0,
            zorder=3,
        )
    )
    first, *_ = (import_module(f"ehlectric.{name}").__doc__ or "").splitlines()
    text = fill(first.partition(":")[0].rstrip("."), 34)
    for height, size, words in ((0.26, 10.0, name), (-0.14, 6.8, text)):
        ax.text(x, y + height, words, ha="center", va="center", size=size, color=_COLOURS["text"], zorder=4)


def _arrow(ax: Axes, start: tuple[float, float], stop: tuple[float, float]) -> None:
    ax.add_patch(
        FancyArrowPatch(
            (start[0], start[1] - 0.5 * _HEIGHT),
            (stop[0], stop[1] + 0.5 * _HEIGHT + 0.02),
            arrowstyle="-|>",
            mutation_scale=9.0,
            lw=1.0,
            color=_COLOURS["arrow"],
            zorder=1,
        )
    )


def _write(app: Sphinx) -> None:
    folder = Path(app.srcdir) / "_generated"
    folder.mkdir(exist_ok=True)
    draw(Path(app.srcdir).parent).savefig(folder / "packages.svg")


def setup(app: Sphinx) -> dict[str, Any]:
    """Drawn before anything is read."""
    app.connect("builder-inited", _write, priority=100)
    return {"parallel_read_safe": True}
