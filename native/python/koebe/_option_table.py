"""The table of options (options.json): the options of each map, their ranges and descriptions."""

import functools
import json
import operator
import textwrap
from dataclasses import dataclass
from pathlib import Path
from typing import Any

_BULLET = 13  # characters of a name in a docstring
_RANGE = {"above": (operator.gt, "above"), "min": (operator.ge, "from"),
          "max": (operator.le, "to"), "below": (operator.lt, "to below")}  # fmt: skip


def table(name: str) -> Any:
    """A table that the command and Python have in common: "options" or "exit_codes"."""
    return json.loads(Path(__file__).with_name(f"{name}.json").read_text("utf-8"))


DONE, _, WRONG_USAGE, REFUSED, NOT_CONVERGED, INTERRUPTED = (code for _, code, _ in table("exit_codes"))


@dataclass(frozen=True)
class Row:
    """An option of one map.

    default   the value without the option
    given     the default in a call: None where the table decides
    words     of a choice, or of a loop, with the meaning of each
    range     of a number: min, max, above, below
    """

    name: str
    kind: str
    default: Any
    given: Any
    does: str
    more: tuple[str, ...]
    words: dict[str, str]
    range: dict[str, Any]
    of_mesh_engine: bool

    @property
    def range_text(self) -> str:
        """The range of a number in words."""
        return " ".join(f"{_RANGE[key][1]} {bound}" for key, bound in self.range.items())

    def has(self, number: float) -> bool:
        """Whether a number is in the range."""
        return all(_RANGE[key][0](number, bound) for key, bound in self.range.items())

    def text(self) -> str:
        """The option's text in a docstring."""
        words = "; ".join(f"{word!r}: {means}" for word, means in self.words.items())
        if self.kind == "loop":
            words += "; or a vertex of it"
        parts = [self.does, *([words] if words else []), *self.more]
        if self.given != self.default:
            parts.append(f"{self.given}: {self.default}")
        prefix = "with engine='mesh': " if self.of_mesh_engine else ""
        return textwrap.fill(
            f"{self.name:<{_BULLET - 2}}  {prefix}{'. '.join(parts)}", 116, subsequent_indent=" " * _BULLET
        )


@functools.cache
def rows(of: str) -> dict[str, Row]:
    """The options of a map in Python, by their names."""
    return {
        row["name"]: Row(
            row["name"],
            row["kind"],
            row["default"],
            row.get("python", row)["default"],
            row.get("of", {}).get(of, row["does"]),
            tuple(row.get("more", ())),
            {word: means for word, _, means in row.get("choices", ())},
            row.get("range", {}),
            "with" in row,
        )
        for row in table("options")
        if of in row["maps"].split() and "python" in row.get("in", "python")
    }
