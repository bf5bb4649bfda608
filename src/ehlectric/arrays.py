"""Types of NumPy arrays that all packages share, and values of one point or of many."""

from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar, overload

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]
Mask: TypeAlias = NDArray[np.bool_]
IntArray: TypeAlias = NDArray[np.intp]

# Number of one point of operation, or the numbers of many points: a float, or an array of shape (...).
Numbers: TypeAlias = float | Array

# Condition at one point of operation, or the conditions at many points.
Booleans: TypeAlias = bool | np.bool_ | Mask

# Texts of many points, shape (...).
Texts: TypeAlias = NDArray[np.str_]

# The same in a function whose result has the type of its arguments.
N = TypeVar("N", float, Array, Numbers)

# Type of the numbers of a class: floats, unless it is declared for many points.
if TYPE_CHECKING:
    from typing_extensions import TypeVar as DefaultTypeVar

    V = DefaultTypeVar("V", float, Numbers, default=float)
else:
    V = TypeVar("V", float, Numbers)


@overload
def where(known: Booleans, values: Array) -> Array: ...


@overload
def where(known: Booleans, values: Numbers) -> Numbers | None: ...


def where(known: Booleans, values: Numbers) -> Numbers | None:
    """Values where they are known: of one point the value or None, of many points NaN instead of None.

    ``known``, whether each point has its value, shape (...); ``values``, shape (...).

    Examples
    --------
    >>> where(False, 3.0), where(True, 3.0), where(np.array([True, False]), np.array([3.0, 4.0])).tolist()
    (None, 3.0, [3.0, nan])
    """
    if np.ndim(known) == np.ndim(values) == 0:
        return as_float(values) if known else None
    return np.where(known, values, np.nan)


def any_of(*conditions: Booleans) -> Booleans:
    """Return whether any of some conditions, of shape () or (...), holds at each point; False without one.

    Examples
    --------
    >>> any_of(False, np.array([True, False])).tolist(), any_of()
    ([True, False], False)
    """
    holds: Booleans = False
    for condition in conditions:
        holds = holds | condition
    return holds


def largest_nearby(values: Array) -> Array:
    """Return at each node the largest value of the node and its neighbours, including diagonal neighbours.

    Examples
    --------
    >>> largest_nearby(np.array([3.0, 1.0, 0.0, 2.0])).tolist()
    [3.0, 3.0, 2.0, 2.0]
    """
    for axis in range(values.ndim):
        ends = [(1, 1) if k == axis else (0, 0) for k in range(values.ndim)]
        values = np.max(sliding_window_view(np.pad(values, ends, mode="edge"), 3, axis), axis=-1)
    return values


def as_float(values: Numbers | np.floating[Any] | NDArray[np.floating[Any]]) -> Numbers:
    """Values of one point as a float of Python, of many points as they are.

    Examples
    --------
    >>> as_float(np.float64(2.0)), as_float(np.array([2.0, 3.0])).tolist()
    (2.0, [2.0, 3.0])
    """
    return float(values) if np.ndim(values) == 0 else np.asarray(values)


def labels(*choices: tuple[Booleans, str | Texts] | str | Texts) -> str | Texts:
    """Text for each point: the text of the first condition that holds, or the last one.

    ``choices``, pairs of a condition of shape (...) and its text, and the text of all other points. Returns a
    text for one point, an array of texts for many.

    Examples
    --------
    >>> labels((False, "low"), "high"), labels((np.array([True, False]), "low"), "high").tolist()
    ('high', ['low', 'high'])
    """
    pairs = [choice for choice in choices if isinstance(choice, tuple)]
    other = choices[-1]
    assert not isinstance(other, tuple)
    if all(np.ndim(condition) == 0 for condition, _ in pairs):
        return next((text for condition, text in pairs if condition), other)
    return np.select(
        [np.asarray(condition) for condition, _ in pairs], [np.asarray(text) for _, text in pairs], other
    )
