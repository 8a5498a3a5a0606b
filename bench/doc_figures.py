#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the figures of README.md and docs/ (`make figures`), and writes them there.

    bench/doc_figures.py [measure] [TABLE ...]     measures into docs/figures.json, then writes the pages
    bench/doc_figures.py write                     writes the pages from docs/figures.json

In a page a table stands between <!-- figures: NAME --> and <!-- end -->, or some of its rows between
<!-- figures: NAME | ROW | ROW --> and <!-- end -->, some of its columns with
<!-- figures: NAME | ROW | ROW || COLUMN | COLUMN -->; a single figure of a table, TABLE/ROW/COLUMN, between
<!-- figure: TABLE/ROW/COLUMN --> and <!-- end -->, or its date, TABLE/date. The beginning of a row's or a column's name
stands for it, if no other begins so.
Rows whose meshes are not there keep what was measured before. bench/tests/test_docs_figures.py compares.
"""

import json
import re
import sys
from collections.abc import Iterable
from pathlib import Path

from doc_tables import ROOT, TABLES  # noqa: E402

FIGURES = ROOT / "docs" / "figures.json"
MARK = re.compile(r"(<!-- figures?: ([^>]*?) -->)(.*?)(<!-- end -->)", re.DOTALL)


def pages() -> list[Path]:
    return [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def load() -> dict:
    return json.loads(FIGURES.read_text(encoding="utf-8")) if FIGURES.exists() else {}


def save(figures: dict) -> None:
    FIGURES.write_text(json.dumps(figures, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def keep(name: str, head: list[str], rows: dict, command: str = "", date: str = "") -> None:
    """@param command that measures the table, if not this one @param date of what another day gives otherwise"""
    figures = load()
    figures[name] = {"command": command or f"bench/doc_figures.py measure {name}", "head": head, "rows": rows}
    if date:
        figures[name]["date"] = date
    save(figures)


def measure(names: list[str]) -> None:
    """The rows that can be measured here, table by table."""
    for name in names:
        table = TABLES[name]
        complete = len(table.available()) == len(table.rows) > 0
        rows = {} if complete else load().get(name, {}).get("rows", {})
        for row in table.available():
            cells = table.cells(row)
            print(name, "|", row, "|", " | ".join(cells), flush=True)
            if table.worth(cells):
                rows[row] = cells
            keep(name, table.head, rows)


def named(names: Iterable[str], start: str) -> str:
    """The name that is this, or else the only one that begins so."""
    (name,) = [name for name in names if name == start] or [name for name in names if name.startswith(start)]
    return name


def markdown(table: dict, rows: list[str] | None = None, columns: list[str] | None = None) -> str:
    """A measured table, or some of its rows and columns."""
    head, body = table["head"], table["rows"]
    places = [0, *(head.index(named(head[1:], column)) for column in columns or head[1:])]
    cells = [head, *([row, *body[row]] for row in (named(body, row) for row in rows or body))]
    first, *lines = ("| " + " | ".join(row[place] for place in places) + " |" for row in cells)
    return "\n".join([first, "|" + "---|" * len(places), *lines])


def figure(figures: dict, place: str) -> str:
    """One cell, TABLE/ROW/COLUMN, or TABLE/date."""
    name, row, *column = place.split("/")
    table = figures[name]
    if not column:
        return table[row]
    head, rows = table["head"][1:], table["rows"]
    return rows[named(rows, row)][head.index(named(head, *column))]


def filled(text: str, figures: dict) -> str:
    """A page with all its marked places as the figures say; a table that was never measured stays as it is."""

    def place(match: re.Match) -> str:
        start, name, _, end = match.groups()
        if re.split("/| ", name)[0] not in figures:
            return match[0]
        if "figures:" in start:
            chosen, _, columns = name.partition(" || ")
            name, *rows = chosen.split(" | ")
            return f"{start}\n\n{markdown(figures[name], rows, columns.split(' | ') if columns else None)}\n\n{end}"
        return f"{start}{figure(figures, name)}{end}"

    return MARK.sub(place, text)


def write() -> None:
    figures = load()
    for page in pages():
        page.write_text(filled(page.read_text(encoding="utf-8"), figures), encoding="utf-8")


def main() -> None:
    words = sys.argv[1:]
    if words[:1] != ["write"]:
        names = [word for word in words if word != "measure"]
        unknown = set(names) - set(TABLES)
        if unknown:
            sys.exit(f"no table {sorted(unknown)[0]}; there are {', '.join(TABLES)}")
        measure(names or list(TABLES))
    write()


if __name__ == "__main__":
    main()
