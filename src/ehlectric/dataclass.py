"""The decorator ``dataclass`` of the standard library, in a tenth of its time at import.

The standard library writes the source of six methods of a frozen class and compiles it at import, in half a
millisecond; a command imports some hundred of these classes. Here only ``__init__`` is compiled, when it is
first used.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from operator import attrgetter
from reprlib import recursive_repr
from typing import TYPE_CHECKING, Any


class _Factory:
    """Default of an argument whose value a function makes."""

    def __repr__(self) -> str:
        return "<factory>"


_FACTORY = _Factory()


class _Init:
    """Method ``__init__`` of a class, which is compiled at its first use."""

    def __init__(self, cls: type) -> None:
        self.cls = cls

    def __get__(self, instance: object, owner: type) -> Any:
        # If several threads compile it at once, each of the functions is right.
        made = _compiled(self.cls)
        self.cls.__init__ = made  # type: ignore[misc]
        return made.__get__(instance, owner)


def _compiled(cls: Any) -> Any:
    """The method ``__init__`` of a class, with the arguments that the standard library gives it."""
    fields = dataclasses.fields(cls)
    known: dict[str, object] = {"_FACTORY": _FACTORY, "_set": object.__setattr__}
    arguments: dict[bool, list[str]] = {False: [], True: []}
    lines = []
    for each in fields:
        name, default, value = each.name, "", each.name
        if each.default_factory is not dataclasses.MISSING:
            known[f"_make_{name}"] = each.default_factory
            default, value = "=_FACTORY", f"_make_{name}() if {name} is _FACTORY else {name}"
            value = value if each.init else f"_make_{name}()"
        elif each.default is not dataclasses.MISSING:
            known[f"_default_{name}"] = each.default
            default = f"=_default_{name}"
        if each.init:
            arguments[bool(each.kw_only)].append(name + default)
        if each.init or value != name:
            lines.append(f" _set(self, {name!r}, {value})")
    if hasattr(cls, "__post_init__"):
        lines.append(" self.__post_init__()")
    written = ", ".join(["self", *arguments[False], *(["*"] if arguments[True] else []), *arguments[True]])
    exec("\n".join([f"def __init__({written}):", *(lines or [" pass"])]), known)
    made: Any = known["__init__"]
    made.__annotations__ = {each.name: each.type for each in fields if each.init} | {"return": None}
    made.__qualname__, made.__module__ = f"{cls.__qualname__}.__init__", cls.__module__
    return made


@recursive_repr()
def _repr(self: Any) -> str:
    """Text of an object: its class, and its fields with their values."""
    shown = [f"{each.name}={getattr(self, each.name)!r}" for each in dataclasses.fields(self) if each.repr]
    return f"{type(self).__qualname__}({', '.join(shown)})"


def _values_of(names: list[str]) -> Callable[[object], tuple[object, ...]]:
    """Function of an object that returns its values by their names."""
    if len(names) > 1:
        return attrgetter(*names)
    return lambda instance: tuple(getattr(instance, name) for name in names)


def _compare(cls: Any) -> None:
    """Give a class its methods that compare objects by the values of fields."""
    fields = dataclasses.fields(cls)
    compared = _values_of([each.name for each in fields if each.compare])
    hashed = _values_of([each.name for each in fields if (each.compare if each.hash is None else each.hash)])

    def equal(self: object, other: object) -> bool:
        return compared(self) == compared(other) if type(other) is type(self) else NotImplemented

    def hash_of(self: object) -> int:
        return hash(hashed(self))

    if "__eq__" not in vars(cls):
        cls.__eq__ = equal
    if vars(cls).get("__hash__") is None:
        cls.__hash__ = hash_of


def _freeze(cls: Any) -> None:
    """Give a class its methods that refuse to set and to delete attributes."""

    def refuse(instance: object, name: str, verb: str) -> None:
        if type(instance) is cls or name in cls.__dataclass_fields__:
            raise dataclasses.FrozenInstanceError(f"cannot {verb} field {name!r}")

    def set_attribute(self: object, name: str, value: object) -> None:
        refuse(self, name, "assign to")
        super(cls, self).__setattr__(name, value)

    def delete_attribute(self: object, name: str) -> None:
        refuse(self, name, "delete")
        super(cls, self).__delattr__(name)

    cls.__setattr__, cls.__delattr__ = set_attribute, delete_attribute


def _frozen(
    cls: Any,
    *,
    eq: bool = True,
    repr: bool = True,  # noqa: A002  # as in the standard library
    kw_only: bool = False,
) -> Any:
    """The class as a frozen dataclass."""
    params = (getattr(base, "__dataclass_params__", None) for base in cls.__mro__[1:])
    if any(each is not None and each.frozen for each in params):
        # A frozen class of another library, whose methods are complete.
        return dataclasses.dataclass(cls, frozen=True, eq=eq, repr=repr, kw_only=kw_only)
    dataclasses.dataclass(cls, init=False, repr=False, eq=False, kw_only=kw_only)
    if "__init__" not in vars(cls):
        cls.__init__ = _Init(cls)
    if repr and "__repr__" not in vars(cls):
        cls.__repr__ = _repr
    if eq:
        _compare(cls)
    _freeze(cls)
    return cls


if TYPE_CHECKING:
    from dataclasses import dataclass as dataclass
else:

    def dataclass(cls: type | None = None, /, *, frozen: bool = False, **options: bool) -> Any:
        """As ``dataclasses.dataclass``, with a frozen class in less time.

        Examples
        --------
        >>> @dataclass(frozen=True)
        ... class Load:
        ...     force: float
        >>> Load(3.0)
        Load(force=3.0)
        """
        made = _frozen if frozen else dataclasses.dataclass
        return (lambda cls: made(cls, **options)) if cls is None else made(cls, **options)
