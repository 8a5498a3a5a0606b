"""Results that are equal if all that they say is equal."""

from collections.abc import Mapping
from typing import Any

import numpy as np

_OF_THE_RUN = {"seconds", "peak_memory_mb"}  # not of the result


class Comparable:
    """Equal to another object of its class whose public attributes are equal: arrays number by number, NaN to NaN.

    Times and memory do not count.
    """

    def _compared(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if not name.startswith("_")}

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other) or not isinstance(other, Comparable):
            return NotImplemented
        return self is other or _same(self._compared(), other._compared())

    __hash__: Any = None


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        a, b = np.asarray(a), np.asarray(b)
        return bool(np.array_equal(a, b, equal_nan=a.dtype.kind == b.dtype.kind == "f"))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(_same(a[key], b[key]) for key in a.keys() - _OF_THE_RUN)
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)):
        return len(a) == len(b) and all(map(_same, a, b))
    return bool(a == b or (a != a and b != b))
