"""Warnings and loops of a report: what a result lists of the surface."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from ._native import _koebe

# The kind of a warning's elements, by the warning's kind: "vertices", "faces", "loops" or "none".
WARNING_ELEMENTS: dict[str, str] = dict(_koebe.warning_elements)
_RENAMED = {"flaps": "ears"}  # kinds of results that 1.0 saved; to be read in 1.1 only


class Warning(Mapping[str, Any], UserWarning, RuntimeWarning):
    """A warning about a result, with kind, elements and text, as attributes and as a mapping's entries.

    kind       its subject, one of the keys of koebe.WARNING_ELEMENTS
    elements   numbers of the input's vertices, or of the result's faces or loops (see WARNING_ELEMENTS); ascending
    text       a sentence for people
    Where a function warns by Python's `warnings`, this is the category: warnings.filterwarnings("ignore",
    category=koebe.Warning), or "error".
    """

    def __init__(self, entries: Mapping[str, Any] | None = None, **more: Any) -> None:
        self._entries = {**(entries or {}), **more}
        if (kind := self._entries.get("kind")) in _RENAMED:
            self._entries["kind"] = _RENAMED[kind]
        super().__init__(self._entries.get("text", ""))

    def __getitem__(self, name: str) -> Any:
        return self._entries[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __getattr__(self, name: str) -> Any:
        try:
            return vars(self)["_entries"][name]
        except KeyError:
            raise AttributeError(f"Warning has no attribute '{name}'") from None

    def __reduce__(self) -> tuple[Any, ...]:
        return Warning, (self._entries,)

    def __repr__(self) -> str:
        return f"koebe.Warning({self._entries})"

    @property
    def of(self) -> str:
        """The kind of its elements."""
        return WARNING_ELEMENTS[self["kind"]]

    def renumbered(self, number: Any) -> "Warning":
        """A copy of the warning for a larger mesh: each element e becomes number[e]. Ascending, each number once."""
        elements = np.unique(np.asarray(number)[self["elements"]]).tolist() if self["elements"] else []
        text = self["text"]
        if elements:
            before, said, after = text.rpartition(f" is {self['elements'][0]}")
            text = before + (f" is {elements[0]}" if said else "") + after
        return Warning(kind=self["kind"], elements=elements, text=text)

    def __str__(self) -> str:
        return str(self["text"])


class Loop(np.ndarray):
    """A boundary loop of a result: an int32 array of its vertices, in order with the surface on the left.

    It has the figures of the report, too, by their names: loop["radius"], loop["off_circle"], "slit" in loop. `figures`
    lists them.
    Arrays made from it are plain ones.
    """

    figures: dict[str, Any]

    def __new__(cls, entry: Mapping[str, Any]) -> "Loop":
        """The loop of a report: its vertices, and its other entries."""
        made = np.asarray(entry["vertices"], dtype=np.int32).view(cls)
        made.figures = dict(entry)
        made.flags.writeable = False
        return made

    def __array_finalize__(self, other: Any) -> None:
        self.figures = {}

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            return np.asarray(self) if key == "vertices" else self.figures[key]
        return np.asarray(self)[key]

    def __contains__(self, key: Any) -> bool:
        return key in self.figures if isinstance(key, str) else key in np.asarray(self)

    def __deepcopy__(self, _: Any) -> "Loop":
        return self

    def __array_wrap__(self, array: Any, *_: Any) -> Any:
        return np.asarray(array)[()]

    def __reduce__(self) -> tuple[Any, ...]:
        return Loop, ({**self.figures, "vertices": np.asarray(self)},)
