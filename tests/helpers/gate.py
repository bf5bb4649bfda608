"""Cases of a parametrised test that every change must pass."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import pytest


def gated(cases: Iterable[Any], *chosen: Any) -> list[Any]:
    """Return the cases, with the marker ``gate`` on the chosen ones.

    Use it if the cases are computed; in a written list, use ``pytest.param(..., marks=pytest.mark.gate)``.
    A case of several arguments is a tuple.
    """
    cases = list(cases)
    assert all(case in cases for case in chosen), "a chosen case is not among the cases"
    return [_marked(case) if case in chosen else case for case in cases]


def _marked(case: Any) -> Any:
    return pytest.param(*(case if isinstance(case, tuple) else (case,)), marks=pytest.mark.gate)
