"""Figures as data: what a page draws, and what it says about it in words."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Shown:
    """Figure of an answer.

    Attributes
    ----------
    name : str
        Name for a file and for tests, such as "film-map".
    title : str
        Heading above the figure.
    label : str
        Text for a screen reader: what the figure shows, with its main numbers.
    plot : mapping
        Figure of Plotly: data, layout and config, of built-in types.
    caption : str
        What a reader must know of the figure, such as what was left out.
    """

    name: str
    title: str
    label: str
    plot: Mapping[str, Any]
    caption: str = ""
