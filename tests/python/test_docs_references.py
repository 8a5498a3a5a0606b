"""What code says of a page is there, and what a page says of a file."""

import json
import re
import textwrap
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = [
    path
    for folder in ("native", "addon", "tests", "bench", "scripts", "blend_samples")
    for suffix in ("*.h", "*.cpp", "*.py", "*.sh")
    for path in sorted((ROOT / folder).rglob(suffix))
    if path != Path(__file__).resolve()
]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
TO_PAGE = re.compile(r'docs/(\w+\.md)(?:, "([^"]+)")?')
TO_FILE = re.compile(r"`((?:[\w.-]+/)+[\w.-]+\.(?:h|cpp|py|sh|json|txt|obj))`")
RELEASES = re.compile(r"(?:\.\./)+releases$")  # of the repository one is in, on its forge
FIGURES = json.loads((ROOT / "docs" / "figures.json").read_text(encoding="utf-8"))["shared"]["rows"]
MADE = ("build/", "out/", "dist/", "shared/")  # not in the repository


def comment_text(path):
    """A file without the marks and line ends of its comments, so that a reference may run over a line."""
    return re.sub(r"\s*\n\s*(?:///?|#)?\s*", " ", path.read_text(encoding="utf-8"))


def headings(page):
    return re.findall(r"^#+ (.+)$", (ROOT / "docs" / page).read_text(encoding="utf-8"), re.MULTILINE)


def references():
    for path in SOURCES:
        for page, heading in TO_PAGE.findall(comment_text(path)):
            yield pytest.param(page, heading, id=f"{path.relative_to(ROOT)}: {page} {heading}")


@pytest.mark.parametrize("page, heading", references())
def test_the_pages_and_headings_that_code_names_exist(page, heading):
    assert (ROOT / "docs" / page).exists()
    assert not heading or heading in headings(page)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_files_that_a_page_names_exist(page):
    named = set(TO_FILE.findall(page.read_text(encoding="utf-8")))
    missing = [
        name
        for name in sorted(named)
        if not name.startswith(MADE)
        and not any((base / name).exists() for base in (ROOT, ROOT / "docs", *(ROOT / "native").iterdir()))
    ]
    assert not missing


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for target, anchor in re.findall(r"\]\(([^)#\s]*)(#[\w-]+)?\)", page.read_text(encoding="utf-8")):
        if "://" in target or RELEASES.match(target):
            continue
        file = page.parent / target if target else page
        assert file.exists(), target
        if anchor:
            anchors = [
                "#" + re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
                for heading in re.findall(r"^#+ (.+)$", file.read_text(encoding="utf-8"), re.MULTILINE)
            ]
            assert anchor in anchors, target + anchor


def said(sentence):
    """What the pages say of a figure: page and figure."""
    texts = {page.name: re.sub(r"<!--.*?-->|\s+", " ", page.read_text(encoding="utf-8")) for page in PAGES}
    return [(name, figure) for name, text in texts.items() for figure in re.findall(sentence, re.sub(" +", " ", text))]


@pytest.mark.parametrize("name", FIGURES)
def test_all_pages_say_the_same_figure(name):
    value, sentence = FIGURES[name]
    found = said(sentence)
    assert len(found) >= 2 and {figure for _, figure in found} == {value}, found


def test_a_page_with_another_figure_is_seen(monkeypatch):
    name = next(iter(FIGURES))
    monkeypatch.setitem(FIGURES, name, ["another", FIGURES[name][1]])
    with pytest.raises(AssertionError):
        test_all_pages_say_the_same_figure(name)


@pytest.mark.parametrize("name, option", [("price of a part", "price"), ("darts of parts", "darts")])
def test_a_default_on_the_pages_is_the_one_of_the_table(name, option):
    table = json.loads((ROOT / "native" / "options" / "options.json").read_text(encoding="utf-8"))
    (row,) = [row for row in table if row["name"] == option and row["maps"] == "parts"]
    assert float(FIGURES[name][0]) == row["default"]


def test_the_program_of_the_cpp_page_is_the_one_that_the_tests_build():
    page = (ROOT / "docs" / "cpp.md").read_text(encoding="utf-8")
    program = (ROOT / "tests" / "consumer" / "page.cpp").read_text(encoding="utf-8")
    assert re.search(r"```cpp\n(.*?)```", page, re.DOTALL)[1] == program.partition("\n")[2]


def test_the_call_from_c_on_that_page_is_one_that_the_tests_build():
    page = (ROOT / "docs" / "cpp.md").read_text(encoding="utf-8")
    program = (ROOT / "tests" / "consumer" / "ring.c").read_text(encoding="utf-8")
    call = re.search(r"```c\n(.*?)```", page, re.DOTALL)[1]
    assert textwrap.indent(call, " " * 4) in program
