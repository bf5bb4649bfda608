"""Handlers that do not keep their page."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from weakref import WeakMethod


def weakly(method: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Function that calls a method for as long as its object lives.

    The framework keeps the routes of uploads, and with them what they call, for long after the page has
    ended. With this function it does not keep the page, too.

    Parameters
    ----------
    method : bound method
        Method of an object that the page keeps, with one argument.

    Examples
    --------
    >>> class Page:
    ...     def told(self, text):
    ...         return text.upper()
    >>> page = Page()
    >>> told = weakly(page.told)
    >>> told("a file")
    'A FILE'
    >>> del page
    >>> told("another") is None
    True
    """
    reference = WeakMethod(method)

    def call(argument: Any) -> Any:
        bound = reference()
        return None if bound is None else bound(argument)

    return call
