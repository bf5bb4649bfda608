"""Functions of worker processes, by name, so that the process of the server need not load them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Generic, TypeVar, cast

T = TypeVar("T")


@dataclass(frozen=True)
class Call(Generic[T]):
    """Function of a worker process that returns a ``T``.

    Attributes
    ----------
    name : str
        Module in ``ehlectric.app.compute`` and function.

    Examples
    --------
    >>> Call("descriptions.field_help").function().__name__
    'field_help'
    """

    name: str

    def function(self) -> Callable[..., T]:
        """The function; this loads what it needs."""
        module, _, name = self.name.rpartition(".")
        return cast("Callable[..., T]", getattr(import_module(f"ehlectric.app.compute.{module}"), name))

    def __call__(self, *values: Any) -> T:
        """Call the function."""
        return self.function()(*values)
