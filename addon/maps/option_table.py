# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of options: the options of each map in Blender and in batch.py, and their texts."""

import dataclasses
import json
import math
import operator
from pathlib import Path
from typing import Any

LARGEST = 2**31 - 1  # of whole numbers, here and in the native module
SOURCE = Path(__file__).parents[2] / "native" / "options"  # in a checkout
RANGE = {"above": (operator.gt, "above"), "min": (operator.ge, "from"),
         "max": (operator.le, "to"), "below": (operator.lt, "to below")}  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Row:
    """An option.

    kind     "number", "integer", "flag", "choice", "loop", "vertex", "weights" or "text"
    maps     that have the option
    choices  (word, label, meaning) each
    range    of a number: min, max, above, below
    blender  different or additional values for the property
    """

    name: str
    kind: str
    maps: list[str]
    default: Any
    does: str
    more: list[str]
    choices: list[list[str]]
    range: dict[str, float]
    unit: str | None
    is_property: bool
    is_flag: bool
    is_native: bool
    blender: dict[str, Any]

    @property
    def words(self) -> list[str]:
        """The words of a choice."""
        return [word for word, _, _ in self.choices]

    def problem(self, value: Any) -> str:
        """Why it cannot have this value, or empty."""
        if self.kind in ("loop", "vertex") and not isinstance(value, str):
            return "" if value >= 0 else f"{value} is not a vertex index"
        if self.choices:
            return "" if value in self.words else f"{value!r} is not one of {', '.join(self.words)}"
        if self.kind not in ("number", "integer"):
            return ""
        if math.isfinite(value) and all(RANGE[key][0](value, bound) for key, bound in self.range.items()):
            return ""
        return f"{value} is not a number {' '.join(f'{RANGE[key][1]} {bound}' for key, bound in self.range.items())}"


def _row(entry: dict[str, Any]) -> Row:
    blender = entry.get("blender", {})
    default = blender.get("default", entry["default"])
    own = [choice for choice in entry.get("choices", []) if choice[1]]  # the choices with a label
    fronts = entry.get("in", "command python blender batch").split()
    return Row(
        entry["name"], entry["kind"], blender.get("maps", entry["maps"]).split(),
        float(default) if entry["kind"] == "number" else default, blender.get("does", entry["does"]),
        [*([] if "more" in blender else entry.get("more", [])), *blender.get("more", [])],
        [*own, *blender.get("choices", [])],
        entry.get("range", {}),
        entry.get("unit"), "blender" in fronts, "batch" in fronts, "python" in fronts, blender,
    )  # fmt: skip


def table_file(name: str) -> Path:
    """A file of native/options/, which is beside this one in the add-on's zip."""
    packed = Path(__file__).with_name(name)
    return packed if packed.exists() else SOURCE / name


def table(name: str) -> Any:
    """One of the tables that the command, Python and the add-on have in common: "options", "exit_codes"."""
    return json.loads(table_file(f"{name}.json").read_text(encoding="utf-8"))


def _table() -> list[dict[str, Any]]:
    options: list[dict[str, Any]] = table("options")
    return options


def own_rows(of: str) -> dict[str, Row]:
    """The options of an operator whose properties are its own: in `ROWS` their names may be of others."""
    return {entry["name"]: _row(entry) for entry in _table() if of in entry["maps"].split() and "blender" in entry}


def _rows() -> dict[str, Row]:
    shown = {"blender", "batch"}
    rows = [_row(entry) for entry in _table() if not shown.isdisjoint(entry.get("in", "blender").split())]
    return {row.name: row for row in rows}


def solver_default(of: str, name: str) -> Any:
    """The default of a map's option in the solver, which no property or flag here sets."""
    return next(entry["default"] for entry in _table() if name == entry["name"] and of in entry["maps"].split())


ROWS = _rows()


def rows_of(of: str) -> list[Row]:
    """The options of a map: of "uniformize", "parts", "sequence" or a domain."""
    return [row for row in ROWS.values() if of in row.maps]
