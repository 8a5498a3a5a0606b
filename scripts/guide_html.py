"""Pages of docs/ as HTML for the add-on's zip, which the help buttons open. Standard library only.

It knows the Markdown that these pages have: headings, paragraphs, lists, tables, fenced code, links, pictures.
Pictures are left out, as they are larger than the add-on. Links lead only to pages of the zip.
"""

import html
import re
from collections.abc import Iterator

PAGES = ("guide", "troubleshooting")  # of docs/, in the zip
STYLE = (
    "body{max-width:50em;margin:2em auto;padding:0 1em;font:16px/1.5 sans-serif;color:#222;background:#fff}"
    "table{border-collapse:collapse}td,th{border:1px solid #ccc;padding:.3em .6em;vertical-align:top;text-align:left}"
    "code,pre{background:#f2f2f2}pre{padding:.6em;overflow:auto}"
)
LIST = re.compile(r"(- |\d+\. )")
BLOCK = re.compile(r"(#|\||```|- |\d+\. )")  # how a line begins that ends a paragraph


def page(markdown: str, title: str) -> str:
    """A whole page."""
    body = "\n".join(_blocks(markdown.splitlines()))
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title>'
            f"<style>{STYLE}</style></head>\n<body>\n{body}\n</body></html>\n")  # fmt: skip


def anchor(heading: str) -> str:
    """The id of a heading, as the links of the pages name it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def _blocks(lines: list[str]) -> Iterator[str]:
    """Each block's HTML."""
    at = 0
    while at < len(lines):
        line, begin = lines[at], at
        at += 1
        if line.startswith("```"):
            at = next(index for index in range(at, len(lines)) if lines[index].startswith("```")) + 1
            yield f"<pre>{html.escape(chr(10).join(lines[begin + 1 : at - 1]))}</pre>"
        elif line.startswith("#"):
            level, heading = line.split(" ", 1)
            yield f'<h{len(level)} id="{anchor(heading)}">{_inline(heading)}</h{len(level)}>'
        elif line.startswith("|"):
            while at < len(lines) and lines[at].startswith("|"):
                at += 1
            yield _table(lines[begin:at])
        elif LIST.match(line):
            while at < len(lines) and (LIST.match(lines[at]) or lines[at].startswith("  ")):
                at += 1
            yield _list(lines[begin:at])
        elif line.strip():
            while at < len(lines) and lines[at].strip() and not BLOCK.match(lines[at]):
                at += 1
            text = _inline(" ".join(lines[begin:at]))
            if text:
                yield f"<p>{text}</p>"


def _table(lines: list[str]) -> str:
    rows = [[_inline(cell.strip()) for cell in line.strip().strip("|").split("|")] for line in lines]
    kinds = ["th", *["td"] * (len(rows) - 1)]
    made = ["".join(f"<{kind}>{cell}</{kind}>" for cell in row) for kind, row in zip(kinds, rows, strict=True)]
    return "<table>" + "".join(f"<tr>{row}</tr>" for row in [made[0], *made[2:]]) + "</table>"  # 1: the rule


def _list(lines: list[str]) -> str:
    items: list[str] = []
    for line in lines:
        if LIST.match(line):
            items.append(LIST.sub("", line, count=1))
        else:
            items[-1] += " " + line.strip()
    kind = "ul" if lines[0].startswith("-") else "ol"
    return f"<{kind}>" + "".join(f"<li>{_inline(item)}</li>" for item in items) + f"</{kind}>"


def _inline(text: str) -> str:
    """Code, links, bold and italics; code is taken out first, as it may hold their signs."""
    codes: list[str] = []

    def keep(match: re.Match[str]) -> str:
        codes.append(html.escape(match[1]))
        return f"\0{len(codes) - 1}\0"

    text = html.escape(re.sub(r"`([^`]*)`", keep, re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)), quote=False)
    text = re.sub(r"\[([^\]]*)\]\(([^)]*)\)", _link, text)
    text = re.sub(r"\*\*(.+?)\*\*", r"<strong>\1</strong>", text)
    text = re.sub(r"\*(.+?)\*", r"<em>\1</em>", text)
    return re.sub("\0(\\d+)\0", lambda match: f"<code>{codes[int(match[1])]}</code>", text).strip()


def _link(match: re.Match[str]) -> str:
    text, target = match.groups()
    name, _, place = target.partition("#")
    if name and name.removesuffix(".md") not in PAGES and not target.startswith("https:"):
        return text
    if name.endswith(".md"):
        target = name.removesuffix(".md") + ".html" + (f"#{place}" if place else "")
    return f'<a href="{html.escape(target)}">{text}</a>'
