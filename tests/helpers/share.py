"""How many of many random examples a run takes: a part of them, or all of them by ``make thorough``."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TypeVar

Example = TypeVar("Example")

THOROUGH = "EHLECTRIC_THOROUGH" in os.environ


def share(examples: Sequence[Example], part: int) -> Sequence[Example]:
    """Every ``part``-th of the examples, the same ones in each run; all of them where the run is thorough."""
    return examples if THOROUGH else examples[::part]


def share_of(count: int, part: int) -> int:
    """Number of the examples that a run draws one after the other: ``count``, or a ``part``-th of them."""
    return count if THOROUGH else -(-count // part)
