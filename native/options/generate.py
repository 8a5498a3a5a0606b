#!/usr/bin/env python3
"""Write what the build needs of the tables of options, warnings and exit codes. Standard library only.

Usage: generate.py FOLDER        writes there what differs: C++ for every layer, and _signatures.py
"""

import csv
import json
import sys
from pathlib import Path
from typing import Any


def table(name: str) -> Any:
    """One of the tables: "options" or "exit_codes"."""
    return json.loads(Path(__file__).with_name(f"{name}.json").read_text(encoding="utf-8"))


def warnings() -> list[list[str]]:
    """The rows of the table of warnings, which docs/troubleshooting.md shows."""
    with Path(__file__).with_name("warnings.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))[1:]


ROWS: list[dict[str, Any]] = table("options")

TYPES = {"number": "float", "integer": "int", "flag": "bool", "vertex": "int | None", "page": "str",
         "steps": "Sequence[Sequence[int]] | None", "weights": "Any", "array": "Any"}  # fmt: skip


def rows_in(*fronts: str) -> list[dict[str, Any]]:
    """The rows that a front has: "command", "python", or "arrays" for arguments of Python that are no options."""
    return [row for row in ROWS if {*fronts} & {*row.get("in", fronts[0]).split()}]


def header(text: str, body: str) -> str:
    """A header of the namespace koebe."""
    head = f"// {text}, written by options/generate.py.\n#pragma once\n\nnamespace koebe {{\n\n"
    return f"{head}{body}\n}}  // namespace koebe\n"


def option_rows() -> str:
    """Initializers of the command's OptionRow. A row with other sentences for some maps becomes several."""
    lines = []
    for row in rows_in("command"):
        own = row.get("of", {})
        choices = row.get("choices", [])
        said = {name: does for name, does in own.items() if name in row["maps"].split()}
        common = " ".join(name for name in row["maps"].split() if name not in own)
        said[common] = row["does"] + "".join(f"\n{word}: {means}" for word, _, means in choices)
        bounds = ", ".join(f".{key} = {row['range'][key]}" for key in sorted(row.get("range", ())))
        words = "|".join(word for word, _, _ in choices)
        rest = f'"{row["kind"]}", "{row.get("unit", "")}", "{words}", "{row.get("with", "")}", {{{bounds}}}'
        lines += [f'{{"{row["name"]}", "{maps}", R"({does})", {rest}}},\n' for maps, does in said.items()]
    return "".join(lines)


def each_option() -> str:
    """The function that finds the options among the members of a struct."""
    fronts = {"command", "python", "arrays"}
    rows = sorted(ROWS, key=lambda row: "uniformize" not in row["maps"].split())  # in the order that its help has
    names = dict.fromkeys(row["name"] for row in rows if fronts & {*row.get("in", "command").split()})
    visits = "".join(
        f'    if constexpr (requires {{ &Options::{name}; }}) visit("{name}", &Options::{name});\n' for name in names
    )
    says = "Calls visit(name, pointer to member) for each member of a struct that is an option, in the table's order."
    body = f"template <typename Options, typename Visit>\nvoid each_option(Visit&& visit)\n{{\n{visits}}}\n"
    return header("Finds the options of a struct of options", f"/// {says}\n{body}")


def warning_kind() -> str:
    """The header with the kinds of warnings."""
    kinds = "".join(f"    {kind},  ///< {text}\n" for kind, _, text, *_ in warnings())
    count = f"inline constexpr int warning_kind_count = {len(warnings())};"
    return header("The kinds of warnings", f"enum class WarningKind {{\n{kinds}}};\n\n{count}\n")


def warning_rows() -> str:
    """For each kind of warning its name and what it lists, in the order of the enumeration."""
    return "".join(f'{{"{kind}", ElementKind::{elements}}},\n' for kind, elements, *_ in warnings())


def exit_codes() -> str:
    """The header with the command's exit codes."""
    codes = "".join(f"    {name} = {code},  ///< {means}\n" for name, code, means in table("exit_codes"))
    return header("The command's exit codes", f"enum ExitCode {{\n{codes}}};\n")


def python_type(row: dict[str, Any]) -> str:
    """The type of an option in a call."""
    words = f"Literal[{', '.join(json.dumps(word) for word, _, _ in row.get('choices', ()))}]"
    kind: str = {"choice": words, "loop": f"{words} | int"}.get(row["kind"]) or TYPES[row["kind"]]
    may_be_none = "python" in row or (row["kind"] == "number" and row["default"] is None)
    return f"{kind} | None" if may_be_none else kind


def signatures() -> str:
    """The module koebe._signatures: for each map a TypedDict of what its function takes."""
    text = '''"""What the functions of the maps take, for type checkers: made of options.json by options/generate.py."""

import typing
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

from ._progress import RunOptions, SurfaceOptions

if TYPE_CHECKING:
    from typing_extensions import Unpack as Unpack
else:  # in typing itself from Python 3.11 on
    Unpack = getattr(typing, "Unpack", None)
'''
    text += f"\nRims = {python_type(next(row for row in ROWS if row['maps'] == 'module'))}\n"
    rows = rows_in("python", "arrays")
    for name in dict.fromkeys(name for row in rows for name in row["maps"].split()):
        # `uniformize` has overloads for `cut`, which decides the type of its result; `Surface` takes no callbacks.
        fields = "".join(f"    {row['name']}: {python_type(row)}\n" for row in rows
                         if name in row["maps"].split() and (name, row["name"]) != ("uniformize", "cut"))  # fmt: skip
        base = "SurfaceOptions" if name == "sequence" else "RunOptions"
        text += f'\n\nclass {name.capitalize()}Options({base}, total=False):\n    """Options of {name}."""\n\n{fields}'
    return text


def main() -> None:
    folder = Path(sys.argv[1])
    texts = {"option_rows.inc": option_rows(), "each_option.h": each_option(), "_signatures.py": signatures(),
             "core/warning_kind.h": warning_kind(), "warning_rows.inc": warning_rows(),
             "exit_code.h": exit_codes()}  # fmt: skip
    for name, text in texts.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.is_file() or path.read_text(encoding="utf-8") != text:  # what is equal is not compiled again
            path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
