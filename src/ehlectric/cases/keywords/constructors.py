"""Signatures and tables of the constructors of cases that take keywords."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

F = TypeVar("F", bound=Callable[..., Any])


def takes(keys: type) -> Callable[[F], F]:
    """Decorator that shows the keys of a ``TypedDict`` in the signature of a function of ``**keywords``.

    Editors and ``help`` then list them by name.
    """

    def decorated(function: F) -> F:
        signature = inspect.signature(function)
        *first, _ = signature.parameters.values()
        kind = inspect.Parameter.KEYWORD_ONLY
        named = [inspect.Parameter(key, kind, default=None) for key in keys_of(keys)]
        function.__signature__ = signature.replace(parameters=[*first, *named])  # type: ignore[attr-defined]
        return function

    return decorated


def keys_of(keys: type) -> Sequence[str]:
    """Names of the keys of a ``TypedDict``."""
    return list(keys.__annotations__)


def tables(**named: Any) -> dict[str, Any]:
    """Tables of a case by name, without those that are None; the name of a lubricant becomes its table.

    Examples
    --------
    >>> tables(lubricant="paper", discharge=None)
    {'lubricant': {'base': 'paper'}}
    """
    given = {name: table for name, table in named.items() if table is not None}
    if isinstance(given.get("lubricant"), str):
        given["lubricant"] = {"base": given["lubricant"]}
    return given
