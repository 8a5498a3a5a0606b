"""The pages of docs/ as the site has them: side by side, README.md as the front page, and a gallery of all pictures."""

import json
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SITE = ROOT / "docs" / "site"
WEB, TRY = ROOT / "dist" / "web", "try"  # the page for browsers, and its folder on the site
PROJECT = ("CHANGELOG.md", "CONTRIBUTING.md", "THIRD_PARTY.md")
LINK = re.compile(r"(\]\()(?!https?:|#)([^)\s]+)(\))")
PLACE = re.compile(r"^(?:\.\./)*(?:docs/)?(?:developers/)?")
FILE_NAME = re.compile(r"\[(?:docs/)?(?:developers/)?(\w+)\.(?:md|ipynb)\](\(\1\.)")
CONTENT = re.compile(r"^(?:(.+) <([\w/]+)>|(?!:)([\w/]+))$", re.MULTILINE)
PICTURE = re.compile(r"^!\[([^\]]+)\]\((images/[^)\s]+)\)", re.MULTILINE)
DATA = re.compile(r"^- \[([^\]]+)\]\(([\w./]+\.csv)\)$", re.MULTILINE)  # a list of data files
# Files and releases of the repository, which are not on the site.
ELSEWHERE = re.compile(r"\[([^\]]+)\]\((?:(?:\.\./)+releases|LICENSE|blend_samples/[\w.]+)\)")
SOME_ROWS = re.compile(r"<!-- figures: (\w+) \|.*?<!-- end -->", re.DOTALL)  # of a table of docs/figures.json
CODE = {"main.cpp", "examples.cpp", "CMakeLists.txt"}


def documents():
    """The pages and notebooks of docs/, and the pages for developers."""
    docs = ROOT / "docs"
    return sorted([*docs.glob("*.md"), *docs.glob("*.ipynb"), *docs.glob("developers/*.md")])


def flat(text):
    """The text with its links as they are where all pages lie side by side. A link named by its file gets a name."""
    titles = dict(contents())
    text = DATA.sub(table_of_file, ELSEWHERE.sub(r"\1", text))
    text = SOME_ROWS.sub(with_all_rows, text)
    text = LINK.sub(lambda link: link[1] + PLACE.sub("", link[2]).replace("README.md", "index.md") + link[3], text)
    return FILE_NAME.sub(lambda link: f"[{titles.get(link[1]) or link[1]}]" + link[2], text)


def table_of_file(data):
    """A folded table to sort (site.js) in place of a link to a data file, and the link below it."""
    file = PLACE.sub("", data[2])
    return (f"\n<details><summary>{data[1]}</summary>\n\n:::{{csv-table}}\n:file: {file}\n:header-rows: 1\n"
            f":class: sortable\n:::\n\n[{file}]({file})\n\n</details>\n")  # fmt: skip


def with_all_rows(some):
    """Some rows of a table, and the whole table below them, folded."""
    table = json.loads((ROOT / "docs" / "figures.json").read_text(encoding="utf-8"))[some[1]]
    rows = [table["head"], ["---"] * len(table["head"]), *([name, *cells] for name, cells in table["rows"].items())]
    lines = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    return (f"{some[0]}\n\n<details><summary>All {len(rows) - 2} rows, by {table['command']}</summary>\n\n"
            f":::{{table}}\n:class: sortable\n\n{lines}\n:::\n\n</details>\n")  # fmt: skip


def linked_files(page):
    """Files other than pages that a page of docs/ links: their names on the site, and the files."""
    text = ELSEWHERE.sub("", page.read_text(encoding="utf-8"))
    found = sorted({link[1].partition("#")[0] for link in LINK.findall(text)})
    return {PLACE.sub("", name): page.parent / name for name in found if not name.endswith((".md", ".ipynb"))}


def contents():
    """The pages in the site's lists: pairs of a name and a title, which may be empty."""
    text = (SITE / "contents.md").read_text(encoding="utf-8")
    return [(name or bare, title) for title, name, bare in CONTENT.findall(text)]


def gallery():
    """All pictures of the pages, in the order of the contents, each with its text and a link to its page."""
    made = "# Gallery\n\nEach picture leads to the page that explains it.\n\n:::::{container} gallery\n"
    shown = set()
    for name, _ in contents():
        page = ROOT / "docs" / f"{name}.md"
        if not page.is_file():
            continue
        for alt, picture in PICTURE.findall(page.read_text(encoding="utf-8")):
            if picture not in shown:
                alt = " ".join(alt.split())
                made += f"::::{{container}} card\n[![{alt}]({picture})]({page.name})\n\n{alt}\n::::\n"
                shown.add(picture)
    return made + ":::::\n"


def texts():
    """The pages: name -> text."""
    front = flat((ROOT / "README.md").read_text(encoding="utf-8"))
    if (WEB / "index.html").is_file():
        first = front.index("\n![")  # above the first picture
        front = f'{front[:first]}\n<a href="{TRY}/index.html?sample">Try it here, on a face</a>\n{front[first:]}'
    made = {"index.md": front + "\n" + (SITE / "contents.md").read_text(encoding="utf-8"), "gallery.md": gallery()}
    for path in documents():
        made[path.name] = flat(path.read_text(encoding="utf-8"))
    for name in PROJECT:
        made[name] = flat((ROOT / name).read_text(encoding="utf-8"))
    return made


def files():
    """Everything else that the pages show or link: name -> file."""
    made = {f"code/{name}": ROOT / "tests" / "consumer" / name for name in sorted(CODE)}
    made |= {f"images/{path.name}": path for path in sorted((ROOT / "docs" / "images").iterdir())}
    for path in documents():
        made |= linked_files(path)
    return made
