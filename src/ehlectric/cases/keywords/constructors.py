"""Signatures and tables of the constructors of cases that take keywords."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Sequence
from typing import Any, TypeVar, cast

from ehlectric.errors import InputError

F = TypeVar("F", bound=Callable[..., Any])


def takes(keys: type) -> Callable[[F], F]:
    """Decorator that shows the keys of a ``TypedDict`` in the signature of a function of ``**keywords``.

    Editors and ``help`` then list them by name. A call without the lubricant raises an InputError.
    """

    def decorated(function: F) -> F:
        signature = inspect.signature(function)
        *first, _ = signature.parameters.values()
        kind = inspect.Parameter.KEYWORD_ONLY
        named = [inspect.Parameter(key, kind, default=None) for key in keys_of(keys)]

        @functools.wraps(function)
        def called(*values: Any, **keywords: Any) -> Any:
            if "lubricant" not in keywords:
                raise InputError.missing(
                    "lubricant", "its table, or the name of one of the library, as 'paper'"
                )
            return function(*values, **keywords)

        called.__signature__ = signature.replace(parameters=[*first, *named])  # type: ignore[attr-defined]
        return cast("F", called)

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
