"""Values of inputs and results: equality and representation of objects with arrays, and their display in
notebooks.

Display of results and cases: one line, a table in a notebook, and figures by name.
The tables and figures are in the packages ``tables`` and ``figures``, which lie above the results that they
show. This module finds their functions by name when they are first needed, as pandas finds its plotting
backend. It is the only place where a lower package calls an upper one.
"""

from __future__ import annotations

import io
import os
import sys
import textwrap
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import fields, is_dataclass
from functools import cached_property, partial
from importlib import import_module
from types import NoneType
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Self, TypeGuard, TypeVar, overload

import numpy as np

from ehlectric.errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure


T = TypeVar("T")
R = TypeVar("R")

# Kinds of results. The functions that draw a result are in a table by its kind.
ResultKind = Literal[
    "contact", "bearing", "drive", "gear", "axle", "motion", "sweep", "measurement", "calibration"
]

# Longest representation [characters].
WIDTH = 200


class Values:
    """Base class of frozen dataclasses with arrays: they can be compared, and print as one short line.

    Two instances are equal if they are of the same class and all of their fields are equal: arrays to the
    last bit, with NaN equal to NaN. Fields with ``compare=False``, such as computing times, are ignored.
    Like arrays, the instances cannot be hashed. A subclass is decorated with
    ``dataclass(frozen=True, eq=False, repr=False)``.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True, eq=False, repr=False)
    ... class Film(Values):
    ...     thickness: np.ndarray
    ...     status: str = "converged"
    >>> film = Film(np.array([1e-6, np.nan]))
    >>> film, film == Film(np.array([1e-6, np.nan])), film == Film(np.zeros(2))
    (Film(thickness=float64 (2,), status='converged'), True, False)
    """

    # Names of fields and properties that contain no arrays, but many other values.
    NO_ARRAYS: ClassVar[frozenset[str]] = frozenset()

    __hash__: ClassVar[None]  # type: ignore[assignment]  # as of every class with only __eq__

    def __eq__(self, other: object) -> bool:
        return same(self, other) if type(self) is type(other) else NotImplemented

    def __repr__(self) -> str:
        return shortened(f"{type(self).__name__}({', '.join(_entries(self))})")

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        # Pickles do not contain that an array is read-only.
        self._make_read_only()

    def _make_read_only(self) -> None:
        """Make all arrays of the instance read-only."""
        read_only([value for name, value in self.__dict__.items() if name not in self.NO_ARRAYS])


def read_only(value: T) -> T:
    """Value itself, with all arrays in it made read-only: in dataclasses, mappings, lists and datasets.

    Examples
    --------
    >>> read_only({"pressure": np.zeros(2)})["pressure"][0] = 1.0
    Traceback (most recent call last):
    ValueError: assignment destination is read-only
    """
    left: list[Any] = [value]
    seen: set[int] = set()
    while left:
        item = left.pop()
        if isinstance(item, np.ndarray):
            item.flags.writeable = False
        elif not isinstance(item, _SCALARS) and id(item) not in seen:
            seen.add(id(item))
            left += _parts(item)
    return value


# Types of values that contain nothing else.
_SCALARS = (float, int, str, NoneType, np.generic)


def _parts(item: Any) -> Iterable[Any]:
    """Values in a mapping, list, dataclass or dataset."""
    if isinstance(item, list | tuple):
        return item
    if is_dataclass(item):
        return getattr(item, "__dict__", {}).values()
    if hasattr(item, "identical"):
        return [variable.values for variable in item.variables.values()]
    return item.values() if isinstance(item, Mapping) else ()


class read_only_property(cached_property[R]):  # noqa: N801  # as cached_property
    """Property of a result that is computed once, and whose arrays are read-only."""

    @overload
    def __get__(self, result: None, owner: type[Any] | None = None) -> Self: ...

    @overload
    def __get__(self, result: object, owner: type[Any] | None = None) -> R: ...

    def __get__(self, result: object, owner: type[Any] | None = None) -> R | Self:
        value = super().__get__(result, owner)
        return value if result is None else read_only(value)


def shortened(text: str) -> str:
    """Text on one line, cut to the longest representation."""
    return textwrap.shorten(text, WIDTH, placeholder=" ...)")


def _entries(values: Any) -> Iterator[str]:
    """Fields of a dataclass as name=value; of an array its type and shape, of other objects their class."""
    for field in fields(values):
        value = getattr(values, field.name)
        if isinstance(value, np.ndarray):
            text = f"{value.dtype} {value.shape}"
        elif value is None or isinstance(value, str | bool | int | float):
            text = repr(value)
        else:
            text = f"<{type(value).__name__}>"
        yield f"{field.name}={text}"


def same(value: Any, other: Any) -> bool:
    """Whether two values are equal: arrays to the last bit, NaN equal to NaN, dataclasses field by field.

    Examples
    --------
    >>> same([1.0, float("nan")], [1.0, float("nan")]), same(np.zeros(2), np.zeros(3))
    (True, False)
    """
    if value is other:
        return True
    if isinstance(value, np.ndarray) or isinstance(other, np.ndarray):
        return _same_arrays(np.asarray(value), np.asarray(other))
    if isinstance(value, float) and isinstance(other, float):
        return value == other or (value != value and other != other)
    if type(value) is not type(other):
        return bool(value == other)
    if isinstance(value, Mapping) and not hasattr(value, "identical"):
        return value.keys() == other.keys() and all(same(value[key], other[key]) for key in value)
    if isinstance(value, list | tuple):
        return len(value) == len(other) and all(map(same, value, other))
    if is_dataclass(value):
        compared = (field.name for field in fields(value) if field.compare)
        return all(same(getattr(value, name), getattr(other, name)) for name in compared)
    # Datasets of xarray compare name, attributes and values, NaN equal, by this method.
    return bool(value.identical(other) if hasattr(value, "identical") else value == other)


def _same_arrays(value: np.ndarray[Any, Any], other: np.ndarray[Any, Any]) -> bool:
    """Whether two arrays have the same type, shape and values."""
    if value.dtype != other.dtype or value.shape != other.shape:
        return False
    return np.array_equal(value, other, equal_nan=value.dtype.kind in "fc")


def is_number(value: object) -> TypeGuard[int | float]:
    """Whether a value is a number of Python; a bool is none, though Python counts it as an int.

    Examples
    --------
    >>> [is_number(value) for value in (1, 0.5, True, "1", None)]
    [True, True, False, False, False]
    """
    return isinstance(value, int | float) and not isinstance(value, bool)


# Functions of upper packages: (module, name).
_TABLE = ("ehlectric.tables.html_tables", "html_of")
_FIGURE = ("ehlectric.figures.result_figures", "figure")
_DEFAULT = ("ehlectric.figures.result_figures", "default_figure")

# Resolution of a figure in a notebook [dots per inch].
_SCREEN = 110


def _call(function: tuple[str, str], *values: Any, **options: Any) -> Any:
    module, name = function
    if function is not _TABLE:
        import_matplotlib()
    return getattr(import_module(module), name)(*values, **options)


def import_matplotlib() -> None:
    """Import matplotlib, also if MPLBACKEND names a backend that is not installed.

    The kernel of a notebook hands MPLBACKEND on to the scripts that it starts, also in another environment.
    Figures of this package need no backend; matplotlib chooses one itself if it refuses the name. Raises
    InputError if matplotlib cannot read its file of settings.
    """
    if "matplotlib" in sys.modules:
        return
    name = os.environ.pop("MPLBACKEND", "")
    try:
        import matplotlib as mpl
    except UnicodeDecodeError:
        where = "in this folder or in the folder of its settings"
        raise InputError(f"the matplotlibrc {where} is not a text file in UTF-8") from None
    finally:
        if name:
            os.environ["MPLBACKEND"] = name
    if name:
        with suppress(ValueError):
            mpl.rcParams["backend"] = name


def headline(title: str, *parts: str | None, verdict: object = None) -> str:
    """Title, key numbers and level of a verdict on one line; parts that are None or empty are skipped.

    Examples
    --------
    >>> headline("6208", "minimum film 0.4 µm", None)
    "'6208': minimum film 0.4 µm"
    """
    level = getattr(verdict, "level", None)
    numbers = ", ".join(filter(None, [*parts, f"verdict {level}" if level else None]))
    return ": ".join(filter(None, [repr(textwrap.shorten(title, 60)) if title else "", numbers]))


class Tabled:
    """Object that a notebook shows as a table, and that prints as one short line, ``_headline``."""

    def _headline(self) -> str:
        """Title and key numbers on one line, for the representation."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return shortened(f"<{type(self).__name__} {self._headline()}>")

    def __str__(self) -> str:
        return repr(self)

    def _repr_html_(self) -> str:
        return str(_call(_TABLE, self))


class Shown(Tabled, Values):
    """Result that prints as one line, that a notebook shows as a table, and that draws its figures.

    Its arrays are read-only.
    """

    result_kind: ClassVar[ResultKind]

    def __post_init__(self) -> None:
        self._make_read_only()

    def plot(self, name: str | None = None, **options: Any) -> Figure:
        """Figure of this result.

        Parameters
        ----------
        name : str, optional
            Name of the figure, with or without ".png", such as "field_map". By default the figure that shows
            most about a result of this kind. ``ehlectric.figure_names`` lists the names.
        **options
            ``style``, "screen", "journal" or "dark"; and of the figures of a sweep ``x``, ``y``, ``value``
            and ``at``, see ``ehlectric.figures.sweep_figures.figure``.

        Returns
        -------
        matplotlib.figure.Figure
            Figure. A notebook shows it if it is the last line of a cell; in a script, ``savefig`` writes it
            as PNG, SVG or PDF.

        Raises
        ------
        InputError
            If the result has no figure of this name, or its figures have no such option.
        """
        if name is None:
            name, chosen = _call(_DEFAULT, self, **options)
            options = chosen | options
        return shown(_call(_FIGURE, self, name, **options))


def shown(figure: Figure) -> Figure:
    """Figure that a notebook shows as an image, whatever its backend is.

    A figure that is not made by pyplot has no display of its own in a notebook.
    """
    figure._repr_png_ = partial(_png, figure)  # type: ignore[attr-defined]
    return figure


def _png(figure: Figure) -> bytes:
    """Figure as a PNG image of the resolution of a screen."""
    image = io.BytesIO()
    figure.savefig(image, format="png", dpi=_SCREEN)
    return image.getvalue()
