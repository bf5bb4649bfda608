"""Constructors of cases that take keywords: their signatures and tables, and types for type checkers.

A value is a float in SI units, a text with a unit, or a quantity of pint. Every other value is refused when
the case is made, by the same checks as those of a case file.
"""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol, TypeAlias, TypeVar, cast

from ehlectric.errors import InputError

F = TypeVar("F", bound=Callable[..., Any])


class HasUnit(Protocol):
    """Number with a unit, such as a quantity of pint."""

    @property
    def magnitude(self) -> Any:
        """Number in the unit of the quantity."""
        ...

    def to(self, other: Any = None, /) -> Any:
        """Quantity in another unit."""
        ...


# Value of a key: a float in SI units, a text with a unit, or a quantity.
Value: TypeAlias = float | str | HasUnit

# Tables by key, as in a case file.
Keys: TypeAlias = Mapping[str, Any]


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


def split(keywords: Mapping[str, Any], names: type) -> tuple[dict[str, Any], dict[str, Any]]:
    """Keywords that a ``TypedDict`` names, and all others.

    Keywords of the ``TypedDict`` that are None are left out.

    Examples
    --------
    >>> from typing import TypedDict
    >>> Tables = TypedDict("Tables", {"lubricant": str, "discharge": None})
    >>> split({"lubricant": "paper", "discharge": None, "load": 1.0}, Tables)
    ({'lubricant': 'paper'}, {'load': 1.0})
    """
    tables = {name: keywords[name] for name in keys_of(names) if keywords.get(name) is not None}
    return tables, {name: value for name, value in keywords.items() if name not in names.__annotations__}
