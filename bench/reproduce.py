# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper again: its Tables 1 and 2, its Theorems 1.1 and 1.2, and its figures, from real runs.

    bench/reproduce.py [--quick] [--publish]

Leaves out/reproduce/*.md, *.json and *.svg and prints the tables. --quick: the figures, the rates and the smallest
surface of the tables. --publish: the pictures go to docs/images/paper_*.svg too, and the scans to docs/figures.json.
The other tables of docs/reproduction.md are `make figures`'s: bench/doc_figures.py measure table_1 table_2 rates
predicted choices twin heads.
"""

import argparse
import json
from pathlib import Path

import convergence  # noqa: E402
import doc_figures  # noqa: E402
import doc_tables  # noqa: E402
import domain_figures  # noqa: E402
import level_sets  # noqa: E402
import process_figures  # noqa: E402
import scan_table  # noqa: E402
import two_heads  # noqa: E402
from scan_table import MESHES, RUNS, SURFACES, measure, result_cells  # noqa: E402, F401: for the tests

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "out" / "reproduce"
IMAGES = ROOT / "docs" / "images"
TABLES = ("table_1", "table_2", "predicted", "choices", "twin", "heads")
QUICK = "Fig. 2"  # the rows that --quick measures begin so
FIGURES = process_figures.FIGURES | domain_figures.FIGURES | two_heads.FIGURES


def write(name, text, folder=OUT):
    (folder / name).write_text(text, encoding="utf-8")


def draw(publish):
    """All pictures."""
    koebe = doc_tables.python_package()
    pictures = {name: draw_one(koebe) for name, draw_one in FIGURES.items()}
    pictures |= level_sets.pictures(OUT)
    for name, picture in pictures.items():
        print(name, f"{len(picture):,} bytes", flush=True)
        write(f"{name}.svg", picture)
        if publish:
            write(f"paper_{name}.svg", picture, IMAGES)


def theorems(publish):
    """The errors of the circles step by step, as a table and as a picture."""
    rates = convergence.run()
    write("rates.json", json.dumps(rates, indent=1) + "\n")
    write("rates.svg", convergence.plot(rates))
    if publish:
        write("paper_rates.svg", convergence.plot(rates), IMAGES)
    rows = {
        f"{title}, {engine}": convergence.cells(*rates[domain][engine].values())
        for domain, title in convergence.DOMAINS.items()
        for engine in convergence.ENGINES
    }
    tell("rates", convergence.HEAD, rows)


def tell(name, head, rows):
    table = doc_figures.markdown({"head": head, "rows": rows})
    write(f"{name}.md", table + "\n")
    print(table, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--publish", action="store_true")
    options = parser.parse_args()
    OUT.mkdir(parents=True, exist_ok=True)

    draw(options.publish)
    theorems(options.publish)
    for name in TABLES:
        table = doc_tables.TABLES[name]
        rows = [row for row in table.rows if not options.quick or name in ("choices", "heads") or row.startswith(QUICK)]
        if rows:
            tell(name, table.head, {row: table.cells(row) for row in rows})
    if not options.quick:
        rows = scan_table.compare(SURFACES, 3)
        write("scans.json", json.dumps(rows, indent=1) + "\n")
        tell("scans", scan_table.HEAD, scan_table.table(rows))
        if options.publish:
            doc_figures.keep("scans", scan_table.HEAD, scan_table.table(rows), "make reproduce")


if __name__ == "__main__":
    main()
