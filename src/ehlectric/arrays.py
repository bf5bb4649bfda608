"""Types of NumPy arrays that all packages share."""

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
ComplexArray: TypeAlias = NDArray[np.complex128]
Mask: TypeAlias = NDArray[np.bool_]
IntArray: TypeAlias = NDArray[np.intp]
