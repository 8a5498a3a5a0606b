"""Results: equal if all that they say is equal. They do not change, show themselves, and go into files."""

import dataclasses
import os
from collections.abc import Iterator, Mapping
from html import escape
from importlib import import_module
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

    def __ne__(self, other: object) -> bool:  # a tuple has its own
        return not self == other

    __hash__: Any = None


class Result(Comparable):
    """What a function returns: its attributes and arrays do not change, and it can be saved, plotted and pickled."""

    def __post_init__(self) -> None:
        self._set(**vars(self))

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{name} of a {type(self).__name__} cannot change")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"{name} of a {type(self).__name__} cannot change")

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        self._set(**state)

    def _set(self, **values: Any) -> None:
        """Take values as attributes while the result is made, in the place of earlier ones: arrays as read-only."""
        vars(self).update({name: fixed(value) for name, value in values.items()})

    def _state(self) -> dict[str, Any]:
        """What makes it again: its attributes, or the fields of a dataclass."""
        if dataclasses.is_dataclass(self):
            return {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        return dict(vars(self))

    @classmethod
    def _made(cls, state: Mapping[str, Any]) -> "Result":
        """The result of a state. Raises TypeError for another class's state."""
        if dataclasses.is_dataclass(cls):
            return cls(**state)
        made = cls.__new__(cls)
        made._set(**state)
        return made

    def _drawing(self) -> dict[str, Any]:
        """What a picture shows: `corners` (n, 3, 2) or (n, 3, 3) of triangles, `circles` (centers, radii), `points`
        (n, 2), `bars` (n, 2), from where to where, or the histogram of `values`."""
        return {}

    def _lines(self) -> list[str]:
        """What a notebook says beside the picture."""
        return [repr(self).strip("<>")]

    def _picture(self) -> str:
        """The drawing as SVG."""
        return str(import_module(".io.picture", __package__).drawing_svg(self._drawing()))

    def _repr_html_(self) -> str:
        """A picture and the figures, as a notebook shows them."""
        lines = "<br/>".join(map(escape, [*self._lines(), *map(str, getattr(self, "warnings", ()))]))
        return f'<div style="display:flex;gap:1em">{self._picture()}<div>{lines}</div></div>'

    def plot(self, **how: Any) -> Any:
        """A figure of the result: koebe.plot(result, ...)."""
        return import_module("._plot", __package__).plot(self, **how)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the result to a file for `koebe.load`: NumPy's .npz. The file is complete or absent.

        For a mesh of another package its arrays are kept, not the mesh.
        """
        import_module("._saved", __package__).save(self, path)


class TupleResult(Result):
    """A result that is a tuple, too. The tuple's class comes second."""

    def __new__(cls, *values: Any) -> Any:
        return super().__new__(cls, *map(fixed, values))

    def _compared(self) -> dict[str, Any]:
        return self._state()

    def _state(self) -> dict[str, Any]:
        return {**self._asdict(), **vars(self)}  # type: ignore[attr-defined]

    @classmethod
    def _made(cls, state: Mapping[str, Any]) -> "TupleResult":
        names = cls._fields  # type: ignore[attr-defined]
        made = cls(*(state[name] for name in names))
        made._set(**{name: value for name, value in state.items() if name not in names})
        return made


def subclasses(cls: type[Any]) -> Iterator[type[Any]]:
    """The class and all classes made of it."""
    yield cls
    for one in cls.__subclasses__():
        yield from subclasses(one)


def fixed(value: Any) -> Any:
    """The value, an array or a list of arrays as read-only views."""
    if type(value) is np.ndarray:
        value = value.view()
        value.flags.writeable = False
    elif type(value) in (list, tuple) and type(next(iter(value), None)) is np.ndarray:
        return type(value)(map(fixed, value))
    return value


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        a, b = np.asarray(a), np.asarray(b)
        return bool(np.array_equal(a, b, equal_nan=a.dtype.kind in "fc" and b.dtype.kind in "fc"))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return a.keys() == b.keys() and all(_same(a[key], b[key]) for key in a.keys() - _OF_THE_RUN)
    if isinstance(a, (list, tuple)) and isinstance(b, (list, tuple)) and not isinstance(a, Comparable):
        return len(a) == len(b) and all(map(_same, a, b))
    return bool(a == b or (a != a and b != b))
