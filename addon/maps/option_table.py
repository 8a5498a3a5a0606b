# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of options: what each map can be asked for in Blender and by batch.py, and what is said of it."""

import dataclasses
import json
import math
import re
from pathlib import Path
from typing import Any

PACKED = Path(__file__).with_name("options.json")
LARGEST = 2**31 - 1  # of whole numbers, here and in the native module
SOURCE = Path(__file__).parents[2] / "native" / "options" / "options.json"  # of a checkout


@dataclasses.dataclass(frozen=True)
class Row:
    """An option.

    kind     "number", "integer", "flag", "choice", "loop", "vertex", "weights" or "text"
    maps     that have it
    choices  (word, label, what it means) each
    bounds   of a number: least, most, and whether these themselves are left out
    blender  what is other, or more, for the property
    """

    name: str
    kind: str
    maps: list[str]
    default: Any
    does: str
    more: list[str]
    choices: list[list[str]]
    bounds: tuple[float, float, bool, bool]
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
        """Why it cannot have this value, or nothing."""
        if self.kind in ("loop", "vertex") and not isinstance(value, str):
            return "" if value >= 0 else f"{value} is not a vertex index"
        if self.choices:
            return "" if value in self.words else f"{value!r} is not one of {', '.join(self.words)}"
        least, most, above, below = self.bounds
        if self.kind not in ("number", "integer"):
            return ""
        inside = (least < value if above else least <= value) and (value < most if below else value <= most)
        if inside and math.isfinite(value):
            return ""
        if above and most == math.inf:
            return f"{value} is not a number above {least:g}"
        if most >= LARGEST:
            return f"{value} is less than {least:g}"
        return f"{value} is not from {least:g} to {'below ' if below else ''}{most:g}"


def _row(entry: dict[str, Any]) -> Row:
    blender = entry.get("blender", {})
    found = re.fullmatch(r"([\[(])(\S+), (\S+)([\])])", entry.get("range", "(-inf, inf)"))
    assert found
    default = blender.get("default", entry["default"])
    own = [choice for choice in entry.get("choices", []) if choice[1]]  # those with a label
    fronts = entry.get("in", "command python blender batch").split()
    return Row(
        entry["name"], entry["kind"], blender.get("maps", entry["maps"]).split(),
        float(default) if entry["kind"] == "number" else default, blender.get("does", entry["does"]),
        [*([] if "more" in blender else entry.get("more", [])), *blender.get("more", [])],
        [*own, *blender.get("choices", [])],
        (float(found[2]), float(found[3]), found[1] == "(", found[4] == ")"),
        entry.get("unit"), "blender" in fronts, "batch" in fronts, "python" in fronts, blender,
    )  # fmt: skip


def _rows() -> dict[str, Row]:
    table = json.loads((PACKED if PACKED.exists() else SOURCE).read_text(encoding="utf-8"))
    rows = [_row(entry) for entry in table if not {"blender", "batch"}.isdisjoint(entry.get("in", "blender").split())]
    return {row.name: row for row in rows}


ROWS = _rows()


def rows_of(of: str) -> list[Row]:
    """The options of a map: of "uniformize", "parts", "sequence" or a domain."""
    return [row for row in ROWS.values() if of in row.maps]
