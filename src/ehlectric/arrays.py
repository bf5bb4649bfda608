"""Types of NumPy arrays that all packages share."""

from typing import Any, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]
Mask: TypeAlias = NDArray[np.bool_]
IntArray: TypeAlias = NDArray[np.intp]

# Number of one point of operation, or the numbers of many points: a float, or an array of shape (...).
Numbers: TypeAlias = Any

# The same in a function whose result has the type of its arguments.
N = TypeVar("N", float, Array)
