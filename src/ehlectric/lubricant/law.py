"""A law of the lubricant, chosen by its name."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Law:
    """A law and the names of the parameters it takes, which are those of the case file."""

    function: Callable[..., Any]
    parameters: tuple[str, ...]
