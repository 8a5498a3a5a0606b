"""Options as the native module takes them: TypeError for a wrong type, OptionError for a wrong value."""

import math
from collections.abc import Mapping
from numbers import Integral, Real
from typing import Any

import numpy as np

from ._native import _koebe
from .errors import InputError, OptionError

_MOST = 2**31 - 1  # of a 32-bit integer


def choice(value: Any, option: str, enumeration: Any) -> Any:
    """The member of a native enumeration with this name."""
    return choice_of(value, option, enumeration.__members__)


def choice_of(value: Any, option: str, members: Mapping[str, Any]) -> Any:
    """What this name stands for."""
    _require(value, option, str, "a text")
    if value not in members:
        raise OptionError(f"{option} must be one of {', '.join(members)}, not {value!r}")
    return members[value]


def sweep(value: Any, option: str) -> list[list[int]]:
    """The loops that each step of a sweep opens."""
    if value is None:
        return []
    if isinstance(value, (str, bytes)):
        raise TypeError(f"{option} must be a list of steps, each a list of loops, not {value!r}")
    listed = [[step] if isinstance(step, Integral) else step for step in value]
    steps = [[whole(loop, option, least=0) for loop in step] for step in listed]
    if not steps or not all(steps):
        raise OptionError(f"{option} must have steps, and each step loops, not {value!r}")
    return steps


def flag(value: Any, option: str) -> bool:
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{option} must be True or False, not {value!r}")
    return bool(value)


def whole(value: Any, option: str, least: int, most: int = _MOST) -> int:
    _require(value, option, Integral, "a whole number")
    if not least <= value <= most:
        raise OptionError(f"{option} must be a whole number from {least} to {most}, not {value!r}")
    return int(value)


def positive(value: Any, option: str) -> float:
    _require(value, option, Real, "a number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not 0.0 < number < math.inf:
        raise OptionError(f"{option} must be positive and finite, not {value!r}")
    return number


def share(value: Any, option: str) -> float:
    _require(value, option, Real, "a number")
    if not 0 <= value <= 1:
        raise OptionError(f"{option} must be from 0 to 1, not {value!r}")
    return float(value)


def outer_loop(value: Any) -> tuple["_koebe.OuterLoop", int]:
    """Which loop goes to the unit circle, and a vertex of it, -1 where none is given."""
    if isinstance(value, str):
        if value not in ("auto", "longest"):
            raise OptionError(f"outer must be 'auto', 'longest' or a vertex of the loop, not {value!r}")
        return (_koebe.OuterLoop.automatic if value == "auto" else _koebe.OuterLoop.longest), -1
    _require(value, "outer", Integral, "'auto', 'longest' or a vertex of the loop")
    if not 0 <= value <= _MOST:
        raise InputError(f"vertex {value} does not exist: outer must be a vertex of a boundary loop", [int(value)])
    return _koebe.OuterLoop.vertex, int(value)


def vertex(value: Any, option: str) -> int:
    """A vertex of the surface, -1 where none is given."""
    if value is None:
        return -1
    _require(value, option, Integral, "a vertex")
    if not 0 <= value <= _MOST:
        raise InputError(f"vertex {value} does not exist: {option} must be a vertex of the surface", [int(value)])
    return int(value)


def callback(value: Any, option: str) -> Any:
    if value is not None and not callable(value):
        raise TypeError(f"{option} must be a function, not {value!r}")
    return value


def token(value: Any, option: str) -> "_koebe.CancelToken":
    """The token, or one that nobody raises."""
    if value is None:
        return _koebe.CancelToken()
    _require(value, option, _koebe.CancelToken, "a CancelToken")
    return value


def _require(value: Any, option: str, kind: Any, name: str) -> None:
    if not isinstance(value, kind) or isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{option} must be {name}, not {value!r}")
