"""Pages of docs/ as HTML for the add-on's zip, which the help buttons open.

Pictures are left out, as they are larger than the add-on. Links lead only to pages of the zip. A listed data file
becomes its table.
"""

import csv
import html
import re
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token

DOCS = Path(__file__).resolve().parents[1] / "docs"
DATA = re.compile(r"^- \[([^\]]+)\]\(([\w./]+\.csv)\)$", re.MULTILINE)
PAGES = ("guide", "troubleshooting")  # of docs/, in the zip
STYLE = (
    "body{max-width:50em;margin:2em auto;padding:0 1em;font:16px/1.5 sans-serif;color:#222;background:#fff}"
    "table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:.3em .6em;vertical-align:top;text-align:left}"
    "code,pre{background:#f2f2f2}pre{padding:.6em;overflow:auto}"
)


def page(markdown: str, title: str) -> str:
    """A whole page."""
    reader = MarkdownIt("commonmark").enable("table")
    tokens = reader.parse(DATA.sub(lambda data: f"{data[1]}:\n\n{_table(DOCS / data[2])}", markdown))
    for at, token in enumerate(tokens):
        if token.type == "heading_open":
            token.attrSet("id", anchor("".join(child.content for child in tokens[at + 1].children or [])))
        if token.children:
            token.children = _shown(token.children)
    body = reader.renderer.render(tokens, reader.options, {})
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title>'
            f"<style>{STYLE}</style></head>\n<body>\n{body}</body></html>\n")  # fmt: skip


def anchor(heading: str) -> str:
    """The id of a heading, as the links of the pages name it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def _table(file: Path) -> str:
    """The table of a data file in Markdown."""
    head, *rows = csv.reader(file.read_text(encoding="utf-8").splitlines())
    return "\n".join("| " + " | ".join(row) + " |" for row in (head, ["---"] * len(head), *rows))


def _shown(tokens: list[Token]) -> list[Token]:
    """A paragraph without pictures, its links to pages of the zip; of other links the words only."""
    shown, kept = [], [True]
    for token in tokens:
        if token.type == "link_open":
            target = str(token.attrGet("href"))
            name, _, place = target.partition("#")
            kept.append(not name or name.removesuffix(".md") in PAGES or target.startswith("https:"))
            if name.endswith(".md"):
                token.attrSet("href", name.removesuffix(".md") + ".html" + (f"#{place}" if place else ""))
        if token.type != "image" and (kept[-1] or not token.type.startswith("link_")):
            shown.append(token)
        if token.type == "link_close":
            kept.pop()
    return shown
