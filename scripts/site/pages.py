"""The pages of docs/ as the site has them: side by side, README.md as the front page, and a gallery of all pictures."""

import csv
import io
import json
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SITE = ROOT / "docs" / "site"
PROJECT = ("CHANGELOG.md", "CONTRIBUTING.md", "THIRD_PARTY.md")
LINK = re.compile(r"(\]\()(?!https?:|#)([^)\s]+)(\))")
PLACE = re.compile(r"^(?:\.\./)*(?:docs/)?(?:developers/)?")
FILE_NAME = re.compile(r"\[(?:docs/)?(?:developers/)?(\w+)\.(?:md|ipynb)\](\(\1\.)")
CONTENT = re.compile(r"^(?:(.+) <([\w/]+)>|(?!:)([\w/]+))$", re.MULTILINE)
PICTURE = re.compile(r"^!\[([^\]]+)\]\((images/[^)\s]+)\)", re.MULTILINE)
DATA = re.compile(r"^- \[([^\]]+)\]\((data/\w+\.csv)\)$", re.MULTILINE)  # a list of data files
MEASURED = re.compile(r"^- \[([^\]]*`(\w+)`)\]\(figures\.json\)$", re.MULTILINE)  # a list of tables of figures.json
# Files and releases of the repository, which are not on the site.
ELSEWHERE = re.compile(r"\[([^\]]+)\]\((?:(?:\.\./)+releases|LICENSE|blend_samples/[\w.]+)\)")
CODE = {"main.cpp", "examples.cpp", "CMakeLists.txt"}


def documents():
    """The pages and notebooks of docs/, and the pages for developers."""
    docs = ROOT / "docs"
    return sorted([*docs.glob("*.md"), *docs.glob("*.ipynb"), *docs.glob("developers/*.md")])


def flat(text):
    """The text with its links as they are where all pages lie side by side. A link named by its file gets a name."""
    titles = dict(contents())
    text = DATA.sub(lambda data: table(*data.groups()), ELSEWHERE.sub(r"\1", text))
    text = MEASURED.sub(lambda data: table(data[1], "figures.json", measured(data[2])), text)
    text = LINK.sub(lambda link: link[1] + PLACE.sub("", link[2]) + link[3], text)
    return FILE_NAME.sub(lambda link: f"[{titles.get(link[1]) or link[1]}]" + link[2], text)


def measured(name):
    """The rows of a table of figures.json as CSV."""
    found = json.loads((ROOT / "docs" / "figures.json").read_text(encoding="utf-8"))[name]
    text = io.StringIO()
    rows = [[row, *cells] for row, cells in found["rows"].items()]
    csv.writer(text, lineterminator="\n").writerows([found["head"], *rows])
    return text.getvalue()


def table(title, file, rows=""):
    """A folded table to sort (sort.js) of a data file, or of rows of it, in place of a link to it."""
    source = "" if rows else f":file: {file}\n"
    return (f"\n<details><summary>{title.replace('`', '')}</summary>\n\n:::{{csv-table}}\n{source}:header-rows: 1\n"
            f":class: sortable\n\n{rows}:::\n\n[{file}]({file})\n\n</details>\n")  # fmt: skip


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
