"""The types of arrays: what a type checker knows of a result's numbers."""

from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
Ints: TypeAlias = NDArray[np.int32]  # of vertices, triangles, loops
Whole: TypeAlias = NDArray[np.integer[Any]]  # of any width
Complex: TypeAlias = NDArray[np.complex128]
Bools: TypeAlias = NDArray[np.bool_]
Values: TypeAlias = NDArray[Any]  # a field: numbers, or labels of any kind
