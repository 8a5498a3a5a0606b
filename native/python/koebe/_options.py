"""Options for the native module: TypeError for a wrong type, OptionError for a wrong value."""

import functools
import inspect
import math
import os
from collections.abc import Callable, Iterable, Mapping
from numbers import Integral, Real
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np

from ._arrays import as_values
from ._native import _koebe
from ._option_table import Row, rows
from ._types import Floats
from ._watched import call, take_old_names
from .errors import InputError, OptionError

Function = TypeVar("Function", bound=Callable[..., Any])
Native = TypeVar("Native")

_MOST = 2**31 - 1  # of a 32-bit integer
_OUTER = ("auto", "longest")  # choices of the outer loop; the next one is a vertex


def takes(
    of: str, /, *, old_names: Mapping[str, str] = MappingProxyType({}), **others: Any
) -> Callable[[Function], Function]:
    """Gives a function a map's options as keywords with their defaults, and describes them in its docstring.

    others   keywords beside the table's, with their defaults
    old_names    of arguments, new name: old
    The docstring has {options} at the place for the descriptions. The signature has the defaults without types, so that
    `help` is short: the types are in _signatures.py.
    """
    table = rows(of)
    defaults = {**{name: row.given for name, row in table.items()}, "mask": None, **others}

    def changed(function: Function) -> Function:
        @functools.wraps(function)
        def with_defaults(*arguments: Any, **given: Any) -> Any:
            take_old_names(function.__qualname__, given, old_names)
            for name in given:
                if name not in defaults and name not in positional:
                    raise TypeError(f"{function.__qualname__}() got an unexpected keyword argument {name!r}")
            given = {**defaults, **given}
            with call(function.__name__, given, "progress" in defaults) as results:
                results.append(function(*arguments, **given))
            return results[0]

        signature = inspect.signature(function)
        positional = {name: one for name, one in signature.parameters.items() if one.kind is one.POSITIONAL_OR_KEYWORD}
        named = [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default)
            for name, default in defaults.items()
        ]
        with_defaults.__signature__ = signature.replace(  # type: ignore[attr-defined]
            parameters=[*positional.values(), *named]
        )
        if function.__doc__:  # python -OO removes it
            said = "\n".join(row.text() for row in table.values())
            with_defaults.__doc__ = function.__doc__.replace("{options}", said.replace("\n", "\n    "))
        return with_defaults  # type: ignore[return-value]

    return changed


def filled(of: str, native: Native, given: Mapping[str, Any]) -> tuple[Native, dict[str, Any]]:
    """A map's native options, set to the given values, and these options for a report.

    Lists of numbers are left to the caller.
    """
    said = {}
    for name, row in rows(of).items():
        value = _checked(row, row.default if given[name] is row.given is None else given[name])
        if row.kind != "weights":
            said[name] = value or None if row.kind == "steps" else value
            _set(native, row, value)
        elif value is not None:
            said[name] = True
    return native, said


def vertex_weights(name: str, values: Any, count: int) -> Floats:
    """(V,) a weight in [0, 1] for each vertex, or empty."""
    if values is None:
        return np.zeros(0)
    array = as_values(values, name)
    if array.shape != (count,) or array.dtype.kind not in "fiu":
        raise InputError(f"{name} must be ({count},) real numbers, not {array.shape} {array.dtype}")
    wrong = np.flatnonzero(~((array >= 0) & (array <= 1)))
    if len(wrong):
        raise InputError(f"{len(wrong)} vertices have {name} not from 0 to 1", wrong.tolist(), "vertices")
    return array.astype(np.float64)


def _checked(row: Row, value: Any) -> Any:
    """The checked value of an option of any kind, as reports have it."""
    if value is None and row.default is None and row.kind in ("number", "vertex"):
        return None
    if row.kind == "number":
        return number(value, row)
    if row.kind == "integer":
        return whole(value, row.name, row.range["min"], row.range["max"])
    if row.kind == "flag":
        return flag(value, row.name)
    if row.kind == "choice":
        return choice_of(value, row.name, {word: word for word in row.words})
    if row.kind == "page":
        return page(value, row.name)
    if row.kind == "steps":
        return sweep(value, row.name)
    if row.kind == "vertex":
        return vertex(value, row.name)
    if row.kind == "loop":
        return value if isinstance(value, str) and outer_loop(value) else outer_loop(value)[1]
    return value


def _set(native: Any, row: Row, value: Any) -> None:
    holder = next((one for one in (native, getattr(native, "mesh", None)) if hasattr(one, row.name)), None)
    if row.kind == "loop":
        native.outer, native.outer_vertex = outer_loop(value)
    elif row.kind == "choice":
        setattr(holder, row.name, number_of(value, row.name, row.words))
    elif holder is not None:
        setattr(holder, row.name, -1 if row.kind == "vertex" and value is None else value)


def number_of(value: Any, option: str, words: Iterable[str]) -> int:
    """The place of a word among the words of a choice: the number of the library's enumerator."""
    return choice_of(value, option, {word: number for number, word in enumerate(words)})


def choice_of(value: Any, option: str, members: Mapping[str, Any]) -> Any:
    """The member with this name."""
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


def page(value: Any, option: str) -> str:
    """A valid name of a page size, for example A4."""
    _require(value, option, str, "a text")
    if problem := _koebe.page_problem(value):
        raise OptionError(f"{option} {problem}")
    return str(value)


def whole(value: Any, option: str, least: int, most: int = _MOST) -> int:
    _require(value, option, Integral, "a whole number")
    if not least <= value <= most:
        raise OptionError(f"{option} must be a whole number from {least} to {most}, not {value!r}")
    return int(value)


def number(value: Any, row: Row) -> float:
    _require(value, row.name, Real, "a number")
    try:
        found = float(value)
    except OverflowError:
        found = math.inf
    if not (math.isfinite(found) and row.has(found)):
        raise OptionError(f"{row.name} must be a finite number {row.range_text}, not {value!r}")
    return found


def outer_loop(value: Any) -> tuple[int, int]:
    """The number of the choice of the loop for the unit circle, and a vertex of it, or -1 without one."""
    if isinstance(value, str):
        if value not in _OUTER:
            raise OptionError(f"outer must be 'auto', 'longest' or a vertex of the loop, not {value!r}")
        return _OUTER.index(value), -1
    _require(value, "outer", Integral, "'auto', 'longest' or a vertex of the loop")
    if not 0 <= value <= _MOST:
        raise InputError(f"vertex {value} does not exist: outer must be a vertex of a boundary loop", [int(value)])
    return len(_OUTER), int(value)


def vertex(value: Any, option: str) -> int:
    """A vertex of the surface; -1 for None."""
    if value is None:
        return -1
    _require(value, option, Integral, "a vertex")
    if not 0 <= value <= _MOST:
        raise InputError(f"vertex {value} does not exist: {option} must be a vertex of the surface", [int(value)])
    return int(value)


def callback(value: Any, option: str) -> Any:
    if value is None or value is False:
        return None
    if not callable(value):
        raise TypeError(f"{option} must be a function, or False, not {value!r}")
    return value


def path_of(value: Any, option: str = "path") -> str:
    """A file's path as text."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{option} must be a file's path, not {value!r}")
    text = os.fspath(value)
    if not isinstance(text, str) or "\0" in text:
        raise OptionError(f"{option} is no file's path: {text!r}")
    return text


def listed(value: Any, option: str) -> list[Any]:
    """The entries of a list, or of anything else that has some."""
    if isinstance(value, (str, bytes)) or not isinstance(value, Iterable):
        raise TypeError(f"{option} must be a list, not {value!r}")
    try:
        return list(value)
    except TypeError:  # such as an array without dimensions
        raise TypeError(f"{option} must be a list, not {value!r}") from None


def token(value: Any, option: str) -> "_koebe.CancelToken":
    """The token, or a new token for None."""
    if value is None:
        return _koebe.CancelToken()
    _require(value, option, _koebe.CancelToken, "a CancelToken")
    return value


def _require(value: Any, option: str, kind: Any, name: str) -> None:
    if not isinstance(value, kind) or isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{option} must be {name}, not {value!r}")
